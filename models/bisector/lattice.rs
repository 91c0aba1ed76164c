// SPDX-License-Identifier: MIT OR Apache-2.0
//! Right isosceles triangles on the virtual lattice: corners, children, and the two that share a midpoint.

/// The virtual lattice of a map: `(N + 1)^2` vertices, `N = 2^levels >= max(width, height) - 1`.
///
/// A vertex (u, v) stands at (min(u, width - 1), min(v, height - 1)) of the map. A triangle whose corners all lie at or
/// beyond one rim has no area, nor has any below it: it is *dead*.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lattice {
    /// Columns of the map, 2 to 4097.
    pub width: u32,
    /// Rows of the map, 2 to 4097.
    pub height: u32,
    /// log2 N, 0 to 12.
    pub levels: u32,
    /// The roots share the diagonal (0, N)-(N, 0) rather than (0, 0)-(N, N).
    pub mirrored: bool,
}

/// The largest side of a map.
pub const MAX_SIDE: u32 = 4097;

impl Lattice {
    /// The smallest lattice that holds a map; `None` unless both sides are 2 to [`MAX_SIDE`].
    pub fn of(width: u32, height: u32, mirrored: bool) -> Option<Self> {
        let sound = |side: u32| (2..=MAX_SIDE).contains(&side);
        let levels = (width.max(height).max(2) - 1).next_power_of_two().trailing_zeros();
        (sound(width) && sound(height)).then_some(Self { width, height, levels, mirrored })
    }
    /// N, the largest coordinate.
    pub const fn side(&self) -> u32 {
        1 << self.levels
    }
    /// Number of lattice vertices.
    pub const fn vertices(&self) -> usize {
        (self.side() as usize + 1) * (self.side() as usize + 1)
    }
    /// The number of a lattice vertex, row by row.
    #[inline]
    pub const fn index(&self, [u, v]: [u32; 2]) -> usize {
        v as usize * (self.side() as usize + 1) + u as usize
    }
    /// Where in the map a lattice vertex stands.
    #[inline]
    pub fn clamp(&self, [u, v]: [u32; 2]) -> [u32; 2] {
        [u.min(self.width - 1), v.min(self.height - 1)]
    }
    /// The two triangles that the lattice begins with. Each is walked from its corner `a` to its corner `b`, so that the
    /// second goes on where the first ends, and ends where that begins.
    pub fn roots(&self) -> [Node; 2] {
        let centre = self.side();
        let direction = if self.mirrored { 1 } else { 7 };
        let root = |direction| Node { u: centre, v: centre, level: self.levels, direction };
        [root(direction), root((direction + 4) & 7)]
    }
    /// Whether a triangle has no area in the map.
    #[inline]
    pub fn is_dead(&self, node: Node) -> bool {
        let [lowest_u, lowest_v] = node.lowest();
        lowest_u >= 2 * (self.width as i32 - 1) || lowest_v >= 2 * (self.height as i32 - 1)
    }
    /// The triangles whose hypotenuse has its midpoint at a vertex: two inside the lattice, one at its rim, none for its
    /// four corners.
    pub fn nodes_at(&self, [u, v]: [u32; 2]) -> impl Iterator<Item = Node> + use<> {
        let side = self.side();
        let corner = u.is_multiple_of(side) && v.is_multiple_of(side);
        let step = if corner { 1 } else { 1 << (u | v).trailing_zeros() };
        // Which neighbour at distance `step` is an odd multiple of two steps.
        let odd = |at: u32| ((at + step) / (2 * step)) & 1 == 1;
        let direction = match ((u & step) != 0, (v & step) != 0) {
            // The hypotenuse joins the corner of odd multiples with the one across; the apexes are the other two.
            (true, true) if step == side / 2 => self.roots()[0].direction,
            (true, true) => {
                if odd(u) == odd(v) {
                    7
                } else {
                    1
                }
            }
            (true, false) => 2,
            (false, _) => 0,
        };
        let node = Node { u: 2 * u, v: 2 * v, level: step.trailing_zeros() + 1, direction };
        let inside = move |node: &Node| {
            let apex = node.apex().map(|at| (0..=2 * side as i32).contains(&at));
            !corner && apex[0] && apex[1]
        };
        [node, Node { direction: direction ^ 4, ..node }].into_iter().filter(inside)
    }
}

/// A right isosceles triangle: the midpoint m of its hypotenuse, and the way from there to its apex.
///
/// ```text
/// c = m + s dir(d)      apex                  s = 2^level in half steps of the lattice
/// a = m + s dir(d + 2)  ends of the           dir(0..8) = (1,0) (1,1) (0,1) (-1,1) (-1,0) (-1,-1) (0,-1) (1,-1)
/// b = m + s dir(d + 6)  hypotenuse            (a, b, c) turns from u to v
/// ```
///
/// Its halves are (c, a, m) with direction d + 5, and (b, c, m) with d + 3; their level is one less when d is even.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Node {
    /// Midpoint, in half steps.
    pub u: u32,
    /// Midpoint, in half steps.
    pub v: u32,
    /// log2 of s; 0 is a triangle whose midpoint is no lattice vertex, a leaf.
    pub level: u32,
    /// Eighth turns from u towards v; odd when the hypotenuse is a diagonal.
    pub direction: u8,
}

/// The eight directions.
const DIRECTIONS: [[i32; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

impl Node {
    #[inline]
    fn towards(self, turn: u8) -> [i32; 2] {
        let [du, dv] = DIRECTIONS[usize::from((self.direction + turn) & 7)];
        [self.u as i32 + (du << self.level), self.v as i32 + (dv << self.level)]
    }
    /// c, in half steps.
    #[inline]
    pub fn apex(self) -> [i32; 2] {
        self.towards(0)
    }
    /// a, b and c in lattice steps. The triangle must lie in the lattice.
    #[inline]
    pub fn corners(self) -> [[u32; 2]; 3] {
        [2, 6, 0].map(|turn| self.towards(turn).map(|at| (at >> 1) as u32))
    }
    /// The lattice vertex at which the triangle can be split.
    #[inline]
    pub fn midpoint(self) -> Option<[u32; 2]> {
        (self.level > 0).then_some([self.u >> 1, self.v >> 1])
    }
    /// The half at a, (c, a, m), and the half at b, (b, c, m). Only for triangles with a midpoint.
    #[inline]
    pub fn halves(self) -> [Node; 2] {
        let level = self.level - u32::from(self.direction & 1 == 0);
        [5, 3].map(|turn| {
            let direction = (self.direction + turn) & 7;
            // From m to the half's midpoint is against the half's own direction.
            let [du, dv] = DIRECTIONS[usize::from(direction)];
            let (u, v) = (self.u as i32 - (du << level), self.v as i32 - (dv << level));
            Node { u: u as u32, v: v as u32, level, direction }
        })
    }
    /// Whether it is walked from b to a: every second generation is, and so are the triangles of level and plumb
    /// hypotenuse.
    #[inline]
    pub fn reversed(self) -> bool {
        self.direction & 1 == 0
    }
    /// Smallest coordinates of the three corners, in half steps.
    #[inline]
    fn lowest(self) -> [i32; 2] {
        let [a, b, c] = [2, 6, 0].map(|turn| self.towards(turn));
        [0, 1].map(|axis| a[axis].min(b[axis]).min(c[axis]))
    }
}
