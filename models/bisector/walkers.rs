// SPDX-License-Identifier: MIT OR Apache-2.0
//! The walkers, turn by turn: which triangles they emit, and in which order.

use super::{Lattice, Node, Steering};

/// The ways a strip can grow: the new vertex takes the place of the left or of the right one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left vertex goes.
    Left,
    /// The right vertex goes.
    Right,
}

/// A triangle of the map's lattice in the order of its strip; (left, right, new) turns from u to v.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Left vertex, right vertex and new vertex, clamped to the map.
    pub corners: [[u32; 2]; 3],
    /// Which vertex the new one replaces in its strip.
    pub side: Side,
    /// Left and right vertex are not those that the walker's last triangle left.
    pub start: bool,
    /// The walker, one of [`WALKERS`]; each makes strips of its own.
    pub walker: u8,
}

/// What a draw has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles emitted.
    pub triangles: u64,
    /// Triangles visited: errors read, and leaves without a midpoint.
    pub visits: u64,
    /// Strips.
    pub strips: u64,
    /// Turns, of which a walker without work lets pass its own: the cycles of the hardware's walk.
    pub turns: u64,
    /// Triangles that a walker took from another one's stack.
    pub thefts: u64,
    /// The deepest stack.
    pub deepest: usize,
}

/// A node on its way along the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry {
    node: Node,
    /// The curve enters over the hypotenuse, rather than over the leg at its first end.
    enters_long: bool,
    /// It leaves over the hypotenuse, rather than over the leg at its last end.
    leaves_long: bool,
}

/// Entries that a stack can hold: two a level, and the root.
pub const STACK: usize = 32;

/// Walkers. The first two begin at the roots, the others by taking from a stack.
pub const WALKERS: usize = 8;

/// Turns from a walker's own to the one behind which it looks for work.
const SEARCH: usize = 2;

/// Walkers that it looks at, by the turns that theirs came before its own.
const VICTIMS: [usize; 3] = [1, 3, 5];

#[derive(Clone, Debug)]
struct Walker {
    visiting: Option<Entry>,
    /// A ring: entries leave at the top, and at the bottom for other walkers.
    stack: [Entry; STACK],
    bottom: usize,
    length: usize,
    /// Something was taken from it since its last turn: that is enough.
    robbed: bool,
    /// What it took: it visits that from its next turn on.
    taken: Option<Entry>,
    /// Left and right vertex that the last triangle left.
    rung: Option<[[u32; 2]; 2]>,
}

impl Walker {
    fn new(root: Node, begins: bool) -> Self {
        let root = Entry { node: root, enters_long: false, leaves_long: false };
        let visiting = begins.then_some(root);
        Self { visiting, stack: [root; STACK], bottom: 0, length: 0, robbed: false, taken: None, rung: None }
    }
    #[inline]
    fn push(&mut self, entry: Entry) {
        self.stack[(self.bottom + self.length) % STACK] = entry;
        self.length += 1;
    }
    #[inline]
    fn pop(&mut self) -> Option<Entry> {
        self.length = self.length.checked_sub(1)?;
        Some(self.stack[(self.bottom + self.length) % STACK])
    }
    fn pop_bottom(&mut self) -> Entry {
        let entry = self.stack[self.bottom];
        self.bottom = (self.bottom + 1) % STACK;
        self.length -= 1;
        entry
    }
    #[inline]
    fn is_idle(&self) -> bool {
        self.visiting.is_none() && self.length == 0 && self.taken.is_none()
    }
    /// Gives its bottom away where more than that is left, once between two turns.
    fn give(&mut self) -> Option<Entry> {
        let gives = self.length > 1 && !self.robbed;
        self.robbed |= gives;
        gives.then(|| self.pop_bottom())
    }
}

/// Walks the map and hands its triangles to `sink`, in the order of the hardware.
pub fn golden<S: Steering>(lattice: &Lattice, steering: &S, sink: &mut impl FnMut(&Triangle)) -> Counts {
    let roots = lattice.roots();
    let mut walkers: [Walker; WALKERS] = std::array::from_fn(|at| Walker::new(roots[at % 2], at < 2));
    let mut counts = Counts { visits: 2, ..Counts::default() };
    let mut turn = 0;
    while !walkers.iter().all(Walker::is_idle) {
        let walker = &mut walkers[turn];
        walker.robbed = false;
        walker.visiting = match walker.visiting {
            Some(entry) if splits(lattice, steering, entry.node) => walker.split(lattice, entry),
            Some(entry) => {
                let triangle = walker.leaf(lattice, entry, turn as u8);
                counts.triangles += 1;
                counts.strips += u64::from(triangle.start);
                sink(&triangle);
                walker.pop()
            }
            None => walker.taken.take(),
        };
        counts.deepest = counts.deepest.max(walker.length);
        counts.visits += u64::from(walker.visiting.is_some());
        let before = |walker: usize, turns: usize| (walker + WALKERS - turns) % WALKERS;
        let thief = before(turn, SEARCH);
        if walkers[thief].is_idle() {
            walkers[thief].taken = VICTIMS.into_iter().find_map(|turns| walkers[before(thief, turns)].give());
            counts.thefts += u64::from(walkers[thief].taken.is_some());
        }
        counts.turns += 1;
        turn = (turn + 1) % WALKERS;
    }
    counts
}

#[inline]
fn splits<S: Steering>(lattice: &Lattice, steering: &S, node: Node) -> bool {
    node.midpoint().is_some_and(|m| steering.splits(lattice, node, m))
}

impl Walker {
    /// Goes on into the half at the entry, and leaves the other one for later. A dead half is left out.
    #[inline]
    fn split(&mut self, lattice: &Lattice, entry: Entry) -> Option<Entry> {
        let [at_a, at_b] = entry.node.halves();
        let (first, second) = if entry.node.reversed() { (at_b, at_a) } else { (at_a, at_b) };
        let first = Entry { node: first, enters_long: !entry.enters_long, leaves_long: false };
        let second = Entry { node: second, enters_long: false, leaves_long: !entry.leaves_long };
        match (lattice.is_dead(first.node), lattice.is_dead(second.node)) {
            (false, false) => {
                self.push(second);
                Some(first)
            }
            (false, true) => Some(first),
            (true, false) => Some(second),
            (true, true) => self.pop(),
        }
    }

    /// The triangle of a leaf. From a to b, or from b to a; over the hypotenuse the apex is new, over the leg the last end.
    /// What goes is the first end, or the apex where the hypotenuse is the way out.
    #[inline]
    fn leaf(&mut self, lattice: &Lattice, entry: Entry, walker: u8) -> Triangle {
        let [a, b, c] = entry.node.corners().map(|corner| lattice.clamp(corner));
        let reversed = entry.node.reversed();
        let over_leg = if reversed { [b, c, a] } else { [c, a, b] };
        let entered = if entry.enters_long { [a, b, c] } else { over_leg };
        let start = self.rung != Some([entered[0], entered[1]]);
        let long = entry.enters_long && !start;
        let corners = if long { entered } else { over_leg };
        let side = if (long || entry.leaves_long) != reversed { Side::Left } else { Side::Right };
        let [left, right, new] = corners;
        self.rung = Some(if side == Side::Left { [new, right] } else { [left, new] });
        Triangle { corners, side, start, walker }
    }
}
