// SPDX-License-Identifier: MIT OR Apache-2.0
//! What must hold of the beats of one base triangle, in exact integers wherever it can be.

use relief_models::fixed::wrap;
use relief_models::remesher::{BaseTriangle, Case, Format, Place, Rung, Setup, exact, golden, observe};
use relief_models::step::{Kind, LeftCommand, RightCommand, Step, Vertex};
use relief_models::strip_unit::{self, StripUnit};
use rustc_hash::{FxHashMap, FxHashSet};

pub const FORMAT: Format =
    Format { components: 2, vertex_bits: 32, guard_bits: 13, coordinate_bits: 16, column_depth: 4096 };

/// Fails the check of one base triangle with a reason.
macro_rules! ensure {
    ($holds:expr, $($reason:tt)*) => {
        let holds: bool = $holds;
        if !holds {
            return Err(format!($($reason)*));
        }
    };
}

/// A base triangle whose data is decided by its corners, over the whole range of the format.
pub fn base(format: &Format, corners: [[i32; 3]; 3]) -> BaseTriangle {
    let mut state = corners.as_flattened().iter().fold(0x1234_5678_9abc_def1u64, |state, &x| {
        (state ^ u64::from(x as u32)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29)
    });
    let mut data = [[0; 16]; 3];
    for component in data.iter_mut().flat_map(|vertex| &mut vertex[..format.components]) {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *component = wrap((state >> 7) as i64, format.vertex_bits);
    }
    BaseTriangle { corners, data }
}

/// The beats of a base triangle with their rungs.
pub struct Run {
    pub format: Format,
    pub base: BaseTriangle,
    pub setup: Setup,
    pub beats: Vec<(Step, Rung)>,
}

impl Run {
    pub fn new(format: &Format, base: &BaseTriangle) -> Self {
        let mut beats = Vec::new();
        observe(format, base, &mut |step, rung| beats.push((*step, *rung)));
        Self { format: *format, base: *base, setup: Setup::new(format, base), beats }
    }
    pub fn steps(&self) -> Vec<Step> {
        self.beats.iter().map(|(step, _)| *step).collect()
    }
    /// The triangles of the sweep itself.
    pub fn emitted(&self) -> Vec<[Place; 3]> {
        self.beats.iter().flat_map(|(step, rung)| rung.triangles(step)).collect()
    }
    /// The vertices in the order in which they were sent.
    pub fn sent(&self) -> Vec<(Place, Vertex)> {
        let mut sent = Vec::new();
        for (step, rung) in &self.beats {
            if step.sends_left() {
                sent.push((rung.next_left, step.left_vertex));
            }
            if step.sends_right() {
                sent.push((rung.next_right, step.right_vertex));
            }
        }
        sent
    }
    /// Column and row of a place in the mirrored plane, rounded half up: straight from the corners.
    fn cell(&self, place: Place) -> [i64; 2] {
        let axes = [(self.setup.sweep, self.setup.mirror_sweep), (self.setup.side, self.setup.mirror_side)];
        axes.map(|(axis, mirrored)| {
            let corner = |k: usize| i64::from(self.base.corners[k][axis]);
            let (over, under) = match place {
                Place::Corner(k) => (corner(k.into()), 1),
                Place::Edge { edge, index } => {
                    let e = &self.setup.edges[usize::from(edge)];
                    let (n, j) = (i64::from(e.segments), i64::from(index));
                    (corner(e.low) * (n - j) + corner(e.high) * j, n)
                }
                Place::Interior { sweep, side } => (if axis == self.setup.sweep { sweep } else { side }.into(), 1),
            };
            let over = if mirrored { -over } else { over };
            (2 * over + under).div_euclid(2 * under)
        })
    }
    /// The vertices of base edge `edge` in winding order, both corners included.
    pub fn edge_places(&self, edge: usize) -> Vec<Place> {
        let e = &self.setup.edges[edge];
        let mut inside: Vec<_> = (1..e.segments).map(|index| Place::Edge { edge: edge as u8, index }).collect();
        if e.low != edge {
            inside.reverse();
        }
        let ends = [edge, (edge + 1) % 3].map(|corner| Place::Corner(corner as u8));
        [vec![ends[0]], inside, vec![ends[1]]].concat()
    }
    /// Whether `place` lies on the base edge between two corners.
    fn on_edge(&self, place: Place, from: usize, to: usize) -> bool {
        match place {
            Place::Corner(k) => usize::from(k) == from || usize::from(k) == to,
            Place::Edge { edge, .. } => usize::from(edge) == if (from + 1) % 3 == to { from } else { to },
            Place::Interior { .. } => false,
        }
    }
}

/// Six times the signed volume of the barycentric coordinates: positive if the triangle winds as its base triangle.
pub fn winding([a, b, c]: [[i64; 3]; 3]) -> i128 {
    let m = |x: i64, y: i64| i128::from(x) * i128::from(y);
    i128::from(a[0]) * (m(b[1], c[2]) - m(b[2], c[1])) - i128::from(a[1]) * (m(b[0], c[2]) - m(b[2], c[0]))
        + i128::from(a[2]) * (m(b[0], c[1]) - m(b[1], c[0]))
}

/// I1 to I4: positive triangles whose common boundary is the base triangle's, once round, are a tiling of it.
pub fn tiling(run: &Run) -> Result<(), String> {
    let triangles = run.emitted();
    let mut directed = FxHashSet::default();
    let mut vertices = FxHashSet::default();
    for triangle in &triangles {
        let weights = triangle.map(|place| exact::barycentric(&run.base, &run.setup, place));
        ensure!(winding(weights) > 0, "I2: {triangle:?} is inverted or flat");
        for (k, &place) in triangle.iter().enumerate() {
            vertices.insert(place);
            ensure!(directed.insert((place, triangle[(k + 1) % 3])), "I3: an edge of {triangle:?} is used twice");
            if matches!(place, Place::Interior { .. }) {
                ensure!(weights[k].iter().all(|&w| w > 0), "I4: {place:?} is not strictly inside");
            }
        }
    }
    let mut border = directed.iter().filter(|&&(a, b)| !directed.contains(&(b, a))).count();
    let undirected = (directed.len() + border) / 2;
    for edge in 0..3 {
        for pair in run.edge_places(edge).windows(2) {
            let (once, back) = ((pair[0], pair[1]), (pair[1], pair[0]));
            ensure!(directed.contains(&once) && !directed.contains(&back), "I1: segment {pair:?} is missing");
            border -= 1;
        }
    }
    ensure!(border == 0, "I3: {border} open edges that are not segments of a base edge");
    let euler = vertices.len() as i64 - undirected as i64 + triangles.len() as i64;
    ensure!(euler == 1, "I3: V-E+F = {euler}");
    if run.setup.case == Case::Point {
        ensure!(triangles.len() == 1, "I8: {} triangles for one grid point", triangles.len());
    }
    if run.setup.double_area == 0 {
        let inside = vertices.iter().any(|place| matches!(place, Place::Interior { .. }));
        ensure!(!inside, "I8: an interior vertex between collinear corners");
    }
    Ok(())
}

/// I4 to I7, the shape of the strips, and the book of the column memory.
pub fn strips(run: &Run) -> Result<(), String> {
    let [a, b, c] = run.setup.roles;
    let roof = run.setup.case == Case::Roof;
    let on_upper = |sub: u8, place: Place| match (sub, roof) {
        (0, _) => run.on_edge(place, a, c),
        (_, true) => run.on_edge(place, b, c),
        (_, false) => run.on_edge(place, c, b) || (run.setup.columns[0] == 0 && run.on_edge(place, a, c)),
    };
    let mut strips = [0u32; 2];
    let mut before: Option<&(Step, Rung)> = None;
    // Of the strip at hand: beats, vertices taken from the upper edge, first rows of both sides, column edge vertices.
    let (mut beats, mut taken, mut rows, mut column_edge) = (0, 0, [0, 0], 0);
    for (at, beat @ (step, rung)) in run.beats.iter().enumerate() {
        ensure!(step.last == (at + 1 == run.beats.len()), "`last` is {} in beat {at}", step.last);
        ensure!(step.sends_left() || step.left_vertex == [0; 16], "a left vertex that is not sent is not zero");
        ensure!(step.sends_right() || step.right_vertex == [0; 16], "a right vertex that is not sent is not zero");
        ensure!(rung.stored[0] + rung.stored[1] <= run.format.column_depth, "the column memory overflows");
        if run.setup.case == Case::Point {
            continue;
        }
        let k = usize::from(rung.sub);
        match step.kind {
            Kind::Start | Kind::Init => {
                if step.kind == Kind::Init {
                    let (_, last) = before.ok_or("the first beat is an Init")?;
                    ensure!(last.stored[0] == 0, "Init: the left side has left {} vertices behind", last.stored[0]);
                }
                ensure!(rung.strip == strips[k], "I7: strip {} comes after strip {}", rung.strip, strips[k]);
                strips[k] += 1;
                let [left, right] = [rung.next_left, rung.next_right].map(|place| run.cell(place)[1]);
                ensure!((left - right).abs() <= 1, "I5: the primary edge's row goes from {left} to {right}");
                // The upper edge's first vertex stands in the strip's left column, unless the start corner does.
                let [column, _] = run.cell(rung.edge);
                let first = match (rung.sub, roof) {
                    (0, _) => run.setup.plane[0][0],
                    (_, true) => -run.setup.plane[1][0],
                    (_, false) => run.setup.plane[2][0],
                };
                let column = if k == 1 && roof { mirrored_column(run, rung.edge) } else { column } - i64::from(first);
                let owned = column.min(i64::from(run.setup.columns[k]) - 1) == i64::from(rung.strip);
                ensure!(owned || step.kind == Kind::Start, "I5: column {} has no upper-edge vertex", rung.strip);
                (beats, taken, rows, column_edge) = (0, 1, [left, right], 0);
            }
            Kind::Fan => {
                taken += 1;
            }
            Kind::Step => {
                beats += 1;
                ensure!(
                    step.left != LeftCommand::Ref || step.right != RightCommand::Ref,
                    "beat {at} moves neither side"
                );
                taken += i64::from(step.left != LeftCommand::Ref && on_upper(rung.sub, rung.next_left));
                let right_on_edge = step.right == RightCommand::Edge;
                column_edge +=
                    i64::from(step.right == RightCommand::Set && !matches!(rung.next_right, Place::Interior { .. }));
                let ends = run.beats.get(at + 1).is_none_or(|(next, _)| matches!(next.kind, Kind::Start | Kind::Init));
                if right_on_edge {
                    ensure!(ends, "I6: right is on the upper edge before the strip ends");
                    ensure!(on_upper(rung.sub, rung.next_right), "I6: the right vertex is not on the upper edge");
                    ensure!(on_upper(rung.sub, rung.next_left), "I6: right reaches the upper edge before left");
                }
                if ends {
                    let top = |place, row: i64| (run.cell(place)[1] - row).max(0);
                    let bound = top(rung.next_left, rows[0]) + top(rung.next_right, rows[1]) + taken + column_edge;
                    ensure!(beats <= bound, "I7: {beats} beats in a strip of at most {bound}");
                }
            }
        }
        if let Some((_, last)) = before
            && last.sub == rung.sub
        {
            ensure!(rung.edge_row >= last.edge_row, "I5: the upper edge falls");
        }
        if !(k == 1 && roof) {
            ensure!(run.cell(rung.edge)[1] == i64::from(rung.edge_row), "the upper edge's row is off");
        }
        before = Some(beat);
    }
    ensure!(strips == run.setup.columns, "I7: {strips:?} strips in {:?} columns", run.setup.columns);
    Ok(())
}

/// Column of an upper-edge vertex in the twice mirrored plane of a roof's second half.
fn mirrored_column(run: &Run, place: Place) -> i64 {
    let mirrored =
        Run { setup: Setup { mirror_sweep: !run.setup.mirror_sweep, ..run.setup }, beats: Vec::new(), ..*run };
    mirrored.cell(place)[0]
}

/// The strip unit's triangles are the sweep's, and so is the reference's, with the same data; a vertex has the same bits
/// whenever it is sent.
pub fn decoding(run: &Run) -> Result<Vec<[Vertex; 3]>, String> {
    let steps = run.steps();
    let sent = run.sent();
    let mut bits = FxHashMap::default();
    for (place, vertex) in &sent {
        ensure!(bits.entry(*place).or_insert(*vertex) == vertex, "I4: {place:?} was sent with different bits");
    }
    let decoded = strip_unit::exact(&steps).ok_or("the reference cannot decode the beats")?;
    let places: Vec<_> = decoded.iter().map(|triangle| triangle.map(|index| sent[index].0)).collect();
    ensure!(places == run.emitted(), "the decoded triangles are not the emitted ones");
    let mut unit = StripUnit::new(run.format.column_depth);
    let mut triangles = Vec::with_capacity(decoded.len());
    for (step, rung) in &run.beats {
        triangles.extend(unit.accept(step).triangles());
        ensure!(!unit.error(), "the column memory is misused");
        ensure!(unit.stored() == rung.stored.iter().sum::<usize>(), "the book of the column memory is wrong");
    }
    let data: Vec<_> = decoded.iter().map(|triangle| triangle.map(|index| sent[index].1)).collect();
    ensure!(triangles == data, "the strip unit's vertices are not those sent");
    Ok(triangles)
}

/// Every vertex sent is as near to the exact one as its bound says; corners are exact.
pub fn errors(run: &Run) -> Result<(), String> {
    // f64 carries 53 bits, less a few for the arithmetic.
    let slack = f64::from(run.format.vertex_bits as i32 - 50).exp2();
    for (place, vertex) in run.sent() {
        ensure!(vertex[run.format.components..].iter().all(|&x| x == 0), "a component that the format lacks is sent");
        let exact = exact::vertex(&run.base, &run.setup, place);
        let bound = exact::bound(&run.setup, run.format.guard_bits, place) + slack;
        for (sent, exact) in vertex.iter().zip(exact).take(run.format.components) {
            let error = modulo(*sent as f64 - exact, run.format.vertex_bits);
            ensure!(error.abs() <= bound, "{place:?}: {sent} is {error} from {exact}, bound {bound}");
            ensure!(!matches!(place, Place::Corner(_)) || *sent == exact as i64, "{place:?} is not exact");
        }
    }
    Ok(())
}

/// `difference` less the multiple of 2^bits that is nearest: outputs wrap.
pub fn modulo(difference: f64, bits: u32) -> f64 {
    let range = f64::from(bits as i32).exp2();
    difference - range * (difference / range).round()
}

/// `golden` sends what `observe` does.
pub fn golden_is_observed(run: &Run) -> Result<(), String> {
    let mut beats = Vec::new();
    golden(&run.format, &run.base, &mut |step| beats.push(*step));
    ensure!(beats == run.steps(), "golden and observe send different beats");
    Ok(())
}

/// All of the above for one base triangle.
pub fn all(format: &Format, base: &BaseTriangle) -> Result<(), String> {
    base.validate(format).map_err(|error| error.to_string())?;
    let run = Run::new(format, base);
    tiling(&run)
        .and_then(|()| strips(&run))
        .and_then(|()| decoding(&run).map(drop))
        .and_then(|()| errors(&run))
        .and_then(|()| golden_is_observed(&run))
        .map_err(|reason| format!("{:?} {:?} {format:?}: {reason}", base.corners, run.setup.case))
}
