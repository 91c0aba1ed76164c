// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep-line: columns of the remeshing plane from left to right, and the side walk that ladders two of them.

use super::edge::{Walker, add};
use super::port::{Observer, Place, Port};
use super::setup::{Case, Setup};
use super::{BaseTriangle, Format};

/// Sends the beats of `base` to `observer`, with the component loops unrolled for the format.
pub(super) fn run<O: Observer>(format: &Format, base: &BaseTriangle, setup: &Setup, observer: &mut O) {
    macro_rules! dispatch {
        ($($n:literal)*) => {
            match format.components {
                $($n => remesh::<$n, O>(format, base, setup, observer),)*
                // `validate` has refused every other number.
                _ => {}
            }
        };
    }
    dispatch!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
}

/// The upper edge of a sub-triangle, standing on its first vertex not yet consumed.
struct Upper<const N: usize> {
    walker: Walker<N>,
    /// The edge CB that follows once the walker is through with AC (only where C is above A in an increasing triangle).
    then: Option<Walker<N>>,
}

impl<const N: usize> Upper<N> {
    /// Column of the vertex relative to the sub-triangle's first one. Only the end may stand in the last column
    /// (amendment A2), and AC of the poly-line lies in the first.
    #[inline(always)]
    fn column(&self, first: i32, columns: i32) -> i32 {
        match self.then {
            Some(_) => 0,
            None if self.walker.at_end() => columns,
            None => (self.walker.column() - first).min(columns - 1),
        }
    }
    /// Still on AC of the poly-line, before C.
    #[inline(always)]
    const fn before_c(&self) -> bool {
        self.then.is_some() && !self.walker.at_end()
    }
    /// Goes to the next vertex; C is a vertex of AC, so CB is entered behind it.
    #[inline(always)]
    fn advance(&mut self) {
        if self.walker.at_end()
            && let Some(next) = self.then.take()
        {
            self.walker = next;
        }
        self.walker.advance();
    }
}

/// The chain of interior cursors' feet: vertex data at (column, row) of the primary edge's rounded vertex.
struct Foot<const N: usize> {
    accumulator: [i64; N],
    row: i32,
    sweep_difference: [i64; N],
    side_difference: [i64; N],
}

impl<const N: usize> Foot<N> {
    /// Moves to the next column, to `row`, which is at most one away.
    #[inline(always)]
    fn advance(&mut self, row: i32) {
        add(&mut self.accumulator, &self.sweep_difference);
        let delta = i64::from(row - self.row);
        for c in 0..N {
            self.accumulator[c] = self.accumulator[c].wrapping_add(delta.wrapping_mul(self.side_difference[c]));
        }
        self.row = row;
    }
}

/// What is particular to a sub-triangle.
struct Sub<const N: usize> {
    /// Number, 0 or 1.
    index: u8,
    /// Winding, where it opens at a corner that the upper edge shares; `None` where it continues the one before.
    start: Option<bool>,
    /// Column of its first vertex in the plane, `columns` of it to sweep.
    first: i32,
    columns: i32,
    /// The plane is swept from right to left (the second half of a roof).
    from_right: bool,
    /// It ends in the point B rather than in a column.
    to_point: bool,
    /// The base edge in place of its last column (amendment A3), from its lower end.
    column_edge: Option<Walker<N>>,
    /// A strip follows it without a corner in between.
    continues: bool,
    /// It is the base triangle's last.
    finishes: bool,
}

/// The sub-triangles of a base triangle.
fn remesh<const N: usize, O: Observer>(format: &Format, base: &BaseTriangle, setup: &Setup, observer: &mut O) {
    let mut port = Port::<N, O>::new(format, &base.data, observer);
    let [a, b, c] = setup.roles;
    let [at_a, at_b, at_c] = setup.plane;
    let [k1, k2] = setup.columns.map(|k| k as i32);
    let walk = |from, to, at, target| Walker::<N>::new(&setup.edges, from, to, at, target);
    let lanes = |v: &crate::step::Vertex| -> [i64; N] { std::array::from_fn(|k| v[k]) };
    let mut foot = Foot {
        accumulator: std::array::from_fn(|k| base.data[a][k] << format.guard_bits),
        row: at_a[1],
        sweep_difference: lanes(&setup.sweep_difference),
        side_difference: lanes(&setup.side_difference),
    };
    let origin = foot.accumulator;
    let mut primary = walk(a, b, at_a, at_b);
    let roof = match setup.case {
        Case::Point => return port.point(),
        Case::Roof => true,
        Case::Increasing | Case::Decreasing => false,
    };
    if k1 > 0 {
        let sub = Sub {
            index: 0,
            start: Some(setup.swap),
            first: at_a[0],
            columns: k1,
            from_right: false,
            to_point: false,
            column_edge: (k2 == 0).then(|| walk(b, c, at_b, at_c)),
            continues: !roof && k2 > 0,
            finishes: k2 == 0,
        };
        let mut upper = Upper { walker: walk(a, c, at_a, at_c), then: None };
        sweep(&mut port, setup, sub, &mut primary, &mut foot, &mut upper);
    }
    if k2 == 0 {
        return;
    }
    let mirrored = |[column, row]: [i32; 2]| [-column, row];
    let sub = Sub {
        index: 1,
        start: (roof || k1 == 0).then_some(setup.swap ^ roof),
        first: if roof { -at_b[0] } else { at_c[0] },
        columns: k2,
        from_right: roof,
        to_point: !roof,
        column_edge: (roof && k1 == 0).then(|| walk(a, c, mirrored(at_a), mirrored(at_c))),
        continues: false,
        finishes: true,
    };
    let mut upper;
    if roof {
        primary = walk(b, a, mirrored(at_b), mirrored(at_a));
        upper = Upper { walker: walk(b, c, mirrored(at_b), mirrored(at_c)), then: None };
        foot.accumulator = origin;
        // Both halves descend from A, or their interior vertices of C's column would differ (amendment A6).
        let [columns, rows] = [0, 1].map(|axis| i64::from(at_b[axis]) - i64::from(at_a[axis]));
        for ((sum, sweep), side) in
            foot.accumulator.iter_mut().zip(&mut foot.sweep_difference).zip(&foot.side_difference)
        {
            *sum = sum.wrapping_add(columns.wrapping_mul(*sweep)).wrapping_add(rows.wrapping_mul(*side));
            *sweep = sweep.wrapping_neg();
        }
        foot.row = at_b[1];
    } else {
        let onward = walk(c, b, at_c, at_b);
        upper = if k1 == 0 {
            Upper { walker: walk(a, c, at_a, at_c), then: Some(onward) }
        } else {
            Upper { walker: onward, then: None }
        };
    }
    sweep(&mut port, setup, sub, &mut primary, &mut foot, &mut upper);
}

/// Sweeps one sub-triangle: its strips, from the primary edge's walker and the foot to the upper edge.
fn sweep<const N: usize, O: Observer>(
    port: &mut Port<'_, N, O>,
    setup: &Setup,
    sub: Sub<N>,
    primary: &mut Walker<N>,
    foot: &mut Foot<N>,
    upper: &mut Upper<N>,
) {
    let place = |column: i32, row: i32| Place::Interior {
        sweep: if sub.from_right != setup.mirror_sweep { -column } else { column },
        side: if setup.mirror_side { -row } else { row },
    };
    if sub.start.is_some() {
        upper.advance();
    }
    let side_difference = foot.side_difference;
    for strip in 0..sub.columns {
        let last_strip = strip == sub.columns - 1;
        let again = !last_strip || sub.continues;
        let closes = last_strip && sub.finishes;
        let to_point = last_strip && sub.to_point;
        let mut column_edge = if last_strip { sub.column_edge } else { None };
        let (left_column, right_column) = (sub.first + strip, sub.first + strip + 1);
        if O::WATCHES {
            (port.rung.sub, port.rung.strip) = (sub.index, strip as u32);
            (port.rung.edge, port.rung.edge_row) = (upper.walker.place(), upper.walker.row());
        }

        let below = *primary;
        let (mut left_cursor, mut left_row) = (foot.accumulator, primary.row());
        primary.advance();
        let mut right_row = primary.row();
        foot.advance(right_row);
        let mut right_cursor = foot.accumulator;
        let mut on_edge = false;
        match sub.start {
            Some(swap) if strip == 0 => {
                on_edge = true;
                port.start(swap, &below, primary);
            }
            _ => port.init(below.place(), primary),
        }
        if let Some(walker) = &mut column_edge {
            walker.advance();
        }

        loop {
            let left_ends = on_edge || left_row + 1 >= upper.walker.row();
            let stored = port.left_stored();
            if to_point {
                if left_ends && !upper.before_c() {
                    return fan(port, upper, closes);
                }
                if upper.before_c() {
                    port.left_edge(&upper.walker);
                    upper.advance();
                } else {
                    add(&mut left_cursor, &side_difference);
                    left_row += 1;
                    port.left_interior(&left_cursor, place(left_column, left_row));
                }
                port.step(false);
                continue;
            }
            // Whether the right side may move to an interior (or column edge) vertex; else only the upper edge is left.
            let inside = |upper: &Upper<N>, right_row: i32, column_edge: &Option<Walker<N>>| match column_edge {
                Some(walker) => !walker.at_end(),
                // `>=`: the edge's row may be the primary edge's own (amendments A1, A3).
                None => right_row + 1 < upper.walker.row(),
            };
            let finished = |upper: &Upper<N>| upper.column(sub.first, sub.columns) > strip;

            let mut fin = finished(upper);
            let mut move_right = fin || (left_row > right_row && inside(upper, right_row, &column_edge));
            if !move_right {
                move_right = left_row == right_row;
                if left_ends {
                    port.left_edge(&upper.walker);
                    left_row = upper.walker.row();
                    on_edge = true;
                    upper.advance();
                    fin = finished(upper);
                } else {
                    add(&mut left_cursor, &side_difference);
                    left_row += 1;
                    port.left_interior(&left_cursor, place(left_column, left_row));
                }
            }
            let mut done = false;
            if move_right {
                if inside(upper, right_row, &column_edge) {
                    if let Some(walker) = &mut column_edge {
                        port.right_column(walker);
                        walker.advance();
                    } else {
                        add(&mut right_cursor, &side_difference);
                        right_row += 1;
                        port.right_interior(&right_cursor, place(right_column, right_row), stored, again);
                    }
                } else if fin {
                    port.right_edge(&upper.walker);
                    done = true;
                }
            }
            if O::WATCHES {
                (port.rung.edge, port.rung.edge_row) = (upper.walker.place(), upper.walker.row());
            }
            port.step(done && closes);
            if done {
                break;
            }
        }
    }
}

/// Closes the strip that ends in the point B: the upper edge's vertices of the last column lie on a line with B, so they
/// fan about the last left vertex below the edge (amendment A4).
fn fan<const N: usize, O: Observer>(port: &mut Port<'_, N, O>, upper: &mut Upper<N>, closes: bool) {
    port.fan(&upper.walker);
    loop {
        upper.advance();
        port.left_edge(&upper.walker);
        let done = upper.then.is_none() && upper.walker.at_end();
        port.step(done && closes);
        if done {
            return;
        }
    }
}
