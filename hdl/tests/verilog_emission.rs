// SPDX-License-Identifier: MIT OR Apache-2.0
//! Emitted text of small blocks: accepted without a warning by every tool, with the cells that it should have.

mod common;

use common::{Bench, Random, Rng, folder, lint, replay, run, tool};
use relief_hdl::prelude::*;
use relief_hdl::verilog::{Direction, emit};

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
fn modules_are_named_once_and_in_order() {
    let emission = emit(&Tree::default()).unwrap();
    let names: Vec<&str> = emission.modules.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["relief_leaf", "relief_tree"], "two leaves of one body are one module");
    assert_eq!(emission.top, "relief_tree");
    let ports = &emission.top_module().ports;
    assert_eq!(ports[0].name, "clock");
    assert_eq!(ports[1].name, "reset");
    let vertex = ports.iter().find(|p| p.name == "out_vertex_1").unwrap();
    assert_eq!((vertex.bits, vertex.lanes, vertex.signed, vertex.direction), (48, 3, true, Direction::Output));
    for module in &emission.modules {
        assert!(!module.source.replace("$signed", "").replace("$unsigned", "").contains('$'), "{}", module.source);
    }
}

#[test]
fn text_reads_as_the_kernel_does() {
    let emission = emit(&Tree::default()).unwrap();
    let text = &emission.top_module().source;
    for line in [
        "    input  wire  [35:0] in_vertex,          // 3 x signed 12",
        "    localparam [1:0] State_Run = 2'd1;",
        "    localparam [3:0] limit = 4'd11; // unsigned 4",
        "    assign step = count_q + 4'd1;",
        "    assign memory_read_address = s18_to_u10($signed({in_a - in_b}));",
        "                if (count_q == limit) begin",
        "        else state_q <= state_d;",
    ] {
        assert!(text.contains(&format!("{line}\n")), "{line}\nis not in\n{text}");
    }
}

#[test]
fn clocked_blocks_agree_in_three_simulators() {
    let mut block = Tree::default();
    let mut bench = Bench::new(&block);
    lint("emission_lint", &bench.emission, &[]);
    let mut rng = Rng(3);
    // Memory and product have no reset: every word is written before anything is compared.
    bench.skip = 1100;
    for row in 0..4000usize {
        let filling = row < bench.skip;
        block.clock.next.reset = row < 2 || rng.below(100) == 0;
        block.in_valid.next = filling || bool::random(&mut rng);
        block.in_vertex.next = Lanes::random(&mut rng);
        block.in_a.next = S::random(&mut rng);
        block.in_b.next = if filling { S::new((row as i64 & 1023) << 3) } else { S::random(&mut rng) };
        bench.record(&mut block);
        for level in [true, false] {
            block.clock.next.clk = level;
            common::settle(&mut block);
        }
    }
    assert_eq!(replay("emission", &[bench]), 2900);
}

#[test]
fn synthesis_finds_the_memory_and_the_multiplier() {
    if !tool("yosys", "yosys") {
        return;
    }
    let folder = folder("emission_yosys");
    let emission = emit(&Tree::default()).unwrap();
    emission.write(&folder).unwrap();
    assert_eq!(std::fs::read_to_string(folder.join("filelist.f")).unwrap(), "relief_leaf.sv\nrelief_tree.sv\n");
    let script = "read_verilog -sv relief_leaf.sv relief_tree.sv; synth_ecp5 -top relief_tree; check -assert; stat";
    let text = run(&folder, "yosys", &["-p", script]);
    // The last statistics are those of the mapped design.
    let statistics = text.rsplit("design hierarchy").next().unwrap();
    let count = |cell: &str| -> usize {
        let line = statistics.lines().find(|l| l.split_whitespace().next() == Some(cell));
        line.and_then(|l| l.split_whitespace().nth(1)).map_or(0, |n| n.parse().unwrap())
    };
    assert_eq!(count("DP16KD"), 1, "{statistics}");
    assert_eq!(count("MULT18X18D"), 1, "{statistics}");
    assert!(!text.contains("Latch inferred"), "{text}");
}
