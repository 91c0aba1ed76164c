// SPDX-License-Identifier: MIT OR Apache-2.0
//! Emitted text of small blocks: accepted without a warning by every tool, with the cells that it should have.

use relief_hdl::prelude::*;
use relief_hdl::verilog::emit;

#[derive(Copy, Clone, PartialEq, Debug, LogicState)]
enum State {
    Idle,
    Run,
    Done,
}

#[derive(LogicBlock, Default)]
struct Leaf {
    clock: Input<ClockReset>,
    in_vertex: Input<Lanes<3, 12>>,
    in_scale: Input<S<8>>,
    out_vertex: Output<Lanes<3, 16>>,
    out_first: Output<S<12>>,
    vertex: Register<Lanes<3, 16>>,
}

impl Logic for Leaf {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, vertex);
        self.vertex.d.next =
            bit_cast_to::<Lanes<3, 16>>(self.in_vertex.val() + bit_cast_to::<Lanes<3, 12>>(self.in_scale.val())) << 2;
        self.out_vertex.next = self.vertex.q.val();
        self.out_first.next = self.in_vertex.val().get_bit(0);
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("leaf")
    }
}

#[derive(LogicBlock)]
struct Tree {
    clock: Input<ClockReset>,
    in_valid: Input<Bit>,
    in_vertex: Input<Lanes<3, 12>>,
    in_a: Input<S<18>>,
    in_b: Input<S<18>>,
    out_product: Output<WideS<40>>,
    out_vertex: [Output<Lanes<3, 16>>; 2],
    out_word: Output<S<18>>,
    out_done: Output<Bit>,
    state: Register<State>,
    count: Register<U<4>>,
    limit: Constant<U<4>>,
    leaf: [Leaf; 2],
    product: Multiplier<18, 14, 40>,
    memory: Ram<S<18>, 10>,
    step: Wire<U<4>>,
    scale: Wire<S<8>>,
}

impl Default for Tree {
    fn default() -> Self {
        Self {
            clock: Default::default(),
            in_valid: Default::default(),
            in_vertex: Default::default(),
            in_a: Default::default(),
            in_b: Default::default(),
            out_product: Default::default(),
            out_vertex: Default::default(),
            out_word: Default::default(),
            out_done: Default::default(),
            state: Default::default(),
            count: Register::new(3.into()),
            limit: Constant::new(11.into()),
            leaf: Default::default(),
            product: Default::default(),
            memory: Ram::new(1024),
            step: Default::default(),
            scale: Default::default(),
        }
    }
}

impl Logic for Tree {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state, count);
        self.product.clock.next = self.clock.val();
        self.product.a.next = self.in_a.val();
        self.product.b.next = bit_cast_to::<S<14>>(self.in_b.val());
        self.out_product.next = self.product.p.val();
        self.memory.clock.next = self.clock.val();
        self.memory.write_enable.next = self.in_valid.val();
        self.memory.write_address.next = self.in_b.val().get_bits::<10>(3);
        self.memory.read_address.next = bit_cast_to::<U<10>>(self.in_a.val() - self.in_b.val());
        self.memory.write_data.next = self.in_a.val();
        self.out_word.next = self.memory.read_data.val();
        self.scale.next = bit_cast_to::<S<8>>(self.in_vertex.val().get_bit(1));
        for i in 0..2 {
            self.leaf[i].clock.next = self.clock.val();
            self.leaf[i].in_vertex.next = self.in_vertex.val();
            self.leaf[i].in_scale.next = self.scale.val();
            self.out_vertex[i].next = self.leaf[i].out_vertex.val();
        }
        self.step.next = self.count.q.val() + 1;
        self.out_done.next = false;
        match self.state.q.val() {
            State::Idle => {
                if self.in_valid.val() {
                    self.state.d.next = State::Run;
                    self.count.d.next = 0.into();
                }
            }
            State::Run => {
                self.count.d.next = self.step.val();
                if self.count.q.val() == self.limit.val() {
                    self.state.d.next = State::Done;
                }
            }
            State::Done => {
                self.out_done.next = true;
                self.state.d.next = State::Idle;
            }
        }
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("tree")
    }
}

#[test]
fn smoke() {
    let e = emit(&Tree::default()).unwrap();
    e.write("/tmp/verilog-smoke").unwrap();
}
