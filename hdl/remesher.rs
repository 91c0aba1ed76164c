// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sweep-line remesher: base triangles in, strip steps out. One step a cycle where the sweep allows; the set-up of
//! the next base triangle overlaps the sweep of the present one.
//!
//! ```text
//! in -> triangle_setup -+-> edge_setup ------+-> sweep -> walkers -+-----------+-> queue -> out (the step port)
//!                       +-> interior_setup --+   scalars  vertices +-> commands +
//! ```
//! (Gumhold & Huettner 1999, section 3, with the amendments that make it a tiling; see docs/blocks/remesher.md.)
//!
//! Interval: one step a cycle, but a base triangle takes max(3 W + 31, 2 W + 3 L + 58) cycles at most in
//! its set-up, which it waits for. Latency: 11 more. A stall of `out` stops the sweep by way of the queue; the walkers, which
//! hold the wide registers, never stall.
//!
//! | port            | format           | range |
//! | in_p0..p2       | 3 x signed N     | grid corners, whole      |   Golden: models::remesher::golden
//! | in_v0..v2       | L x signed V     | vertex data, whole       |   Error: edge n 2^-(g+1), interior (i+j) 2^-(g+1),
//! | out_kind        | unsigned 2       | 0 step, 1 start, 2 init, 3 fan |   plus 1/2 of the rounding, units of V
//! | out_left        | unsigned 2       | 0 ref, 1 set, 2 recall, 3 edge |
//! | out_right       | unsigned 2       | 0 ref, 1 set, 2 store, 3 edge  |
//! | out_swap, out_last | Bit           | winding; last beat of the base triangle |
//! | out_*_vertex    | L x signed V     | meaningful where the command sends a vertex |

mod commands;
mod edge_measure;
mod edge_setup;
mod interior_setup;
mod lane_divider;
mod queue;
mod sweep;
mod triangle_setup;
mod upper_edge;
mod walkers;

pub use commands::Commands;
pub use edge_measure::EdgeMeasure;
pub use edge_setup::{EdgeSetup, EdgeState};
pub use interior_setup::{InteriorSetup, InteriorState};
pub use lane_divider::LaneDivider;
pub use queue::StepQueue;
pub use sweep::{OpCode, Sweep, SweepState};
pub use triangle_setup::{SetupState, TriangleSetup};
pub use upper_edge::UpperEdge;
pub use walkers::Walkers;

use crate::prelude::*;

/// The remesher. `L` components of `V` bits, accumulators of `W` = V + g + 1, `N` bits of coordinate; and derived from
/// them `X` = W + 2, `T` = N + 3, `A` = 2 N + 3, `P` = W + T; counters of `K` bits for the column memory.
#[derive(Clone, Debug, LogicBlock)]
pub struct Remesher<
    const L: usize,
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
> {
    /// Clock and reset.
    pub clock: Input<ClockReset>,
    /// A beat stands at the input.
    pub in_valid: Input<Bit>,
    /// It is taken at this edge.
    pub in_ready: Output<Bit>,
    /// Grid corner P0, voxels.
    pub in_p0: Input<Lanes<3, N>>,
    /// Grid corner P1.
    pub in_p1: Input<Lanes<3, N>>,
    /// Grid corner P2.
    pub in_p2: Input<Lanes<3, N>>,
    /// Vertex data of P0.
    pub in_v0: Input<Lanes<L, V>>,
    /// Vertex data of P1.
    pub in_v1: Input<Lanes<L, V>>,
    /// Vertex data of P2.
    pub in_v2: Input<Lanes<L, V>>,
    /// A beat stands at the output.
    pub out_valid: Output<Bit>,
    /// It is taken at this edge.
    pub out_ready: Input<Bit>,
    /// 0 step, 1 start, 2 init, 3 fan.
    pub out_kind: Output<U<2>>,
    /// Left command: 0 ref, 1 set, 2 recall, 3 edge.
    pub out_left: Output<U<2>>,
    /// Right command: 0 ref, 1 set, 2 store, 3 edge.
    pub out_right: Output<U<2>>,
    /// Read a triangle (a, b, c) as (a, c, b).
    pub out_swap: Output<Bit>,
    /// The last beat of its base triangle.
    pub out_last: Output<Bit>,
    /// Vertex for the left side; means something where the left command is set.
    pub out_left_vertex: Output<Lanes<L, V>>,
    /// Vertex for the right side; means something unless the right command is ref.
    pub out_right_vertex: Output<Lanes<L, V>>,
    triangle: Gated<TriangleSetup<L, V, N, T, A>>,
    edges: Gated<EdgeSetup<L, V, W, X, T>>,
    interior: Gated<InteriorSetup<L, V, W, T, A, P>>,
    sweep: Gated<Sweep<T>>,
    walkers: Gated<Walkers<L, V, W, X>>,
    commands: Gated<Commands<K>>,
    queue: Gated<StepQueue<L, V>>,
}

impl<
    const L: usize,
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
> Remesher<L, V, W, X, N, T, A, P, K>
{
    /// A remesher for a strip unit whose column memory holds `depth` vertices.
    pub fn new(depth: usize) -> Self {
        assert!(T == N + 3 && A == 2 * N + 3, "T is N + 3 and A is 2 N + 3");
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            in_ready: Output::default(),
            in_p0: Input::default(),
            in_p1: Input::default(),
            in_p2: Input::default(),
            in_v0: Input::default(),
            in_v1: Input::default(),
            in_v2: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_kind: Output::default(),
            out_left: Output::default(),
            out_right: Output::default(),
            out_swap: Output::default(),
            out_last: Output::default(),
            out_left_vertex: Output::default(),
            out_right_vertex: Output::default(),
            triangle: Gated::default(),
            edges: Gated::default(),
            interior: Gated::default(),
            sweep: Gated::default(),
            walkers: Gated::default(),
            commands: Gated::new(Commands::new(depth)),
            queue: Gated::default(),
        }
    }
}

impl<
    const L: usize,
    const V: usize,
    const W: usize,
    const X: usize,
    const N: usize,
    const T: usize,
    const A: usize,
    const P: usize,
    const K: usize,
> Logic for Remesher<L, V, W, X, N, T, A, P, K>
{
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, triangle, edges, interior, sweep, walkers, commands, queue);
        self.triangle.in_valid.next = self.in_valid.val();
        self.triangle.in_p0.next = self.in_p0.val();
        self.triangle.in_p1.next = self.in_p1.val();
        self.triangle.in_p2.next = self.in_p2.val();
        self.triangle.in_v0.next = self.in_v0.val();
        self.triangle.in_v1.next = self.in_v1.val();
        self.triangle.in_v2.next = self.in_v2.val();
        self.in_ready.next = self.triangle.in_ready.val();
        self.triangle.units_busy.next = self.edges.busy.val() || self.interior.busy.val();
        self.triangle.record_ready.next = self.walkers.record_ready.val();
        self.edges.start.next = self.triangle.edge_start.val();
        self.interior.start.next = self.triangle.interior_start.val();
        self.edges.corner_a.next = self.triangle.corner_a.val();
        self.edges.corner_b.next = self.triangle.corner_b.val();
        self.edges.corner_c.next = self.triangle.corner_c.val();
        self.interior.corner_a.next = self.triangle.corner_a.val();
        self.interior.corner_b.next = self.triangle.corner_b.val();
        self.interior.corner_c.next = self.triangle.corner_c.val();
        self.walkers.corner_a.next = self.triangle.corner_a.val();
        self.walkers.corner_b.next = self.triangle.corner_b.val();
        self.walkers.corner_c.next = self.triangle.corner_c.val();
        self.edges.n_ab.next = self.triangle.n_ab.val();
        self.edges.n_ac.next = self.triangle.n_ac.val();
        self.edges.n_bc.next = self.triangle.n_bc.val();
        self.edges.a_hi_ab.next = self.triangle.a_hi_ab.val();
        self.edges.a_hi_ac.next = self.triangle.a_hi_ac.val();
        self.edges.b_hi_bc.next = self.triangle.b_hi_bc.val();
        self.walkers.a_hi_ab.next = self.triangle.a_hi_ab.val();
        self.walkers.a_hi_ac.next = self.triangle.a_hi_ac.val();
        self.walkers.b_hi_bc.next = self.triangle.b_hi_bc.val();
        self.interior.s_b.next = self.triangle.s_b.val();
        self.interior.s_c.next = self.triangle.s_c.val();
        self.interior.d_b.next = self.triangle.d_b.val();
        self.interior.d_c.next = self.triangle.d_c.val();
        self.interior.area2.next = self.triangle.area2.val();
        self.interior.roof.next = self.triangle.roof.val();
        self.sweep.record_valid.next = self.triangle.record_valid.val();
        self.sweep.record_n_ab.next = self.triangle.n_ab.val();
        self.sweep.record_n_ac.next = self.triangle.n_ac.val();
        self.sweep.record_n_bc.next = self.triangle.n_bc.val();
        self.sweep.record_s_b.next = self.triangle.s_b.val();
        self.sweep.record_s_c.next = self.triangle.s_c.val();
        self.sweep.record_d_b.next = self.triangle.d_b.val();
        self.sweep.record_d_c.next = self.triangle.d_c.val();
        self.sweep.record_roof.next = self.triangle.roof.val();
        self.sweep.record_point.next = self.triangle.point.val();
        self.sweep.record_swap.next = self.triangle.swap.val();
        self.walkers.step_ab.next = self.edges.step_ab.val();
        self.walkers.step_ac.next = self.edges.step_ac.val();
        self.walkers.step_bc.next = self.edges.step_bc.val();
        self.walkers.start_ab.next = self.edges.start_ab.val();
        self.walkers.start_ac.next = self.edges.start_ac.val();
        self.walkers.start_bc.next = self.edges.start_bc.val();
        self.walkers.side.next = self.interior.side.val();
        self.walkers.sweep.next = self.interior.sweep.val();
        self.walkers.base_b.next = self.interior.base_b.val();
        self.walkers.op_valid.next = self.sweep.op_valid.val();
        self.walkers.op_code.next = self.sweep.op_code.val();
        self.walkers.op_left.next = self.sweep.op_left.val();
        self.walkers.op_right.next = self.sweep.op_right.val();
        self.walkers.op_second.next = self.sweep.op_second.val();
        self.walkers.op_on_bc.next = self.sweep.op_on_bc.val();
        self.walkers.op_at_end.next = self.sweep.op_at_end.val();
        self.walkers.op_climbs.next = self.sweep.op_climbs.val();
        self.walkers.op_falls.next = self.sweep.op_falls.val();
        self.walkers.op_column_edge.next = self.sweep.op_column_edge.val();
        self.walkers.op_edge.next = self.sweep.op_edge.val();
        self.walkers.op_right_edge.next = self.sweep.op_right_edge.val();
        self.walkers.op_advance.next = self.sweep.op_advance.val();
        self.walkers.op_turn.next = self.sweep.op_turn.val();
        self.walkers.op_keep.next = self.sweep.op_keep.val();
        self.walkers.op_swap.next = self.sweep.op_swap.val();
        self.walkers.op_last.next = self.sweep.op_last.val();
        self.sweep.room.next = self.queue.room.val();
        self.commands.in_valid.next = self.walkers.out_valid.val();
        self.commands.in_kind.next = self.walkers.out_kind.val();
        self.commands.in_left.next = self.walkers.out_left.val();
        self.commands.in_right.next = self.walkers.out_right.val();
        self.commands.in_keep.next = self.walkers.out_keep.val();
        self.commands.in_swap.next = self.walkers.out_swap.val();
        self.commands.in_last.next = self.walkers.out_last.val();
        self.queue.in_valid.next = self.commands.out_valid.val();
        self.queue.in_kind.next = self.commands.out_kind.val();
        self.queue.in_left.next = self.commands.out_left.val();
        self.queue.in_right.next = self.commands.out_right.val();
        self.queue.in_swap.next = self.commands.out_swap.val();
        self.queue.in_last.next = self.commands.out_last.val();
        self.queue.in_left_vertex.next = self.walkers.out_left_vertex.val();
        self.queue.in_right_vertex.next = self.walkers.out_right_vertex.val();
        self.out_valid.next = self.queue.out_valid.val();
        self.out_kind.next = self.queue.out_kind.val();
        self.out_left.next = self.queue.out_left.val();
        self.out_right.next = self.queue.out_right.val();
        self.out_swap.next = self.queue.out_swap.val();
        self.out_last.next = self.queue.out_last.val();
        self.out_left_vertex.next = self.queue.out_left_vertex.val();
        self.out_right_vertex.next = self.queue.out_right_vertex.val();
        self.queue.out_ready.next = self.out_ready.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("remesher")
    }
}

ports! {
    [const L: usize, const V: usize, const W: usize, const X: usize, const N: usize, const T: usize, const A: usize,
     const P: usize, const K: usize] Remesher<L, V, W, X, N, T, A, P, K> {
        inputs: in_valid, in_p0, in_p1, in_p2, in_v0, in_v1, in_v2, out_ready;
        outputs: in_ready, out_valid, out_kind, out_left, out_right, out_swap, out_last, out_left_vertex,
            out_right_vertex;
        blocks: triangle, edges, interior, sweep, walkers, commands, queue;
        state: triangle, edges, interior, sweep, walkers, commands, queue
    }
}
