// SPDX-License-Identifier: MIT OR Apache-2.0
//! What cannot be translated exactly is refused, in a sentence that names the block, the signal and the remedy.

#![allow(non_snake_case)] // One block has a field that must be refused for it.

use relief_hdl::prelude::*;
use relief_hdl::verilog::emit;
use rust_hdl_core::prelude::{BlackBox, InOut, Signal, Wrapper};

/// A block with the given fields and kernel. The kernel comes with its signature and attribute, because `self` is hygienic.
macro_rules! kernel {
    ($name:ident { $($fields:tt)* } $($update:tt)*) => {
        #[derive(LogicBlock, Default)]
        struct $name { $($fields)* }
        impl Logic for $name {
            $($update)*
            fn timing(&self) -> Vec<TimingInfo> {
                module_name("refused")
            }
        }
    };
}

#[derive(Copy, Clone, PartialEq, Debug, LogicState)]
enum State {
    Idle,
    #[allow(dead_code)]
    Run,
}

fn refused<B: Block + Default>(parts: &[&str]) {
    let sentence = match emit(&B::default()) {
        Ok(emission) => panic!("not refused:\n{}", emission.top_module().source),
        Err(error) => error.to_string(),
    };
    for part in parts {
        assert!(sentence.contains(part), "{sentence}\nlacks: {part}");
    }
}

kernel!(Latch { a: Input<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    if self.a.val() { self.y.next = true; }
});
kernel!(LatchInMatch { s: Input<State>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    match self.s.val() { State::Idle => { self.y.next = true; } State::Run => {} }
});
kernel!(ReadEarly { a: Input<S<8>>, w: Wire<S<8>>, y: Output<S<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.w.val();
    self.w.next = self.a.val();
});
kernel!(ReadOnOnePath { a: Input<Bit>, w: Wire<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    if self.a.val() { self.w.next = true; }
    self.y.next = self.w.val();
    self.w.next = false;
});
kernel!(WrittenLate { a: Input<S<8>>, w: Wire<S<8>>, y: Output<S<8>> } #[hdl_gen] fn update(&mut self) {
    self.w.next = self.a.val();
    self.y.next = self.w.val();
    self.w.next = -self.a.val();
});
kernel!(WritesInput { a: Input<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val();
    self.a.next = true;
});
kernel!(Undriven { a: Input<Bit>, y: Output<Bit>, z: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val();
});

#[test]
fn assignments_must_be_complete_and_ordered() {
    refused::<Latch>(&["top (relief_refused)", "`y` is not assigned on every path", "latch", "default"]);
    refused::<LatchInMatch>(&["`y` is not assigned on every path"]);
    refused::<ReadEarly>(&["`w` is read before it is assigned"]);
    refused::<ReadOnOnePath>(&["`w` is read before it is assigned on every path"]);
    refused::<WrittenLate>(&["`w` is assigned again after it was read", "second wire"]);
    refused::<WritesInput>(&["writes `a`", "an input of the block"]);
    refused::<Undriven>(&["`z` is never driven"]);
}

kernel!(Leaf { clock: Input<ClockReset>, d: Input<Bit>, q: Output<Bit>, r: Register<Bit> } #[hdl_gen] fn update(&mut self) {
    self.r.clock.next = self.clock.val();
    self.r.d.next = self.d.val();
    self.q.next = self.r.q.val();
});
kernel!(NoChildInput { clock: Input<ClockReset>, r: Register<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.r.clock.next = self.clock.val();
    self.y.next = self.r.q.val();
});
kernel!(NoChildClock { a: Input<Bit>, r: Register<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.r.d.next = self.a.val();
    self.y.next = self.r.q.val();
});
kernel!(GatedClock { clock: Input<ClockReset>, a: Input<Bit>, r: Register<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    if self.a.val() { self.r.clock.next = self.clock.val(); }
    self.r.d.next = self.a.val();
    self.y.next = self.r.q.val();
});
kernel!(OtherClock { clk: Input<ClockReset>, a: Input<Bit>, r: Register<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.r.clock.next = self.clk.val();
    self.r.d.next = self.a.val();
    self.y.next = self.r.q.val();
});
kernel!(WritesChildOutput { clock: Input<ClockReset>, r: Register<Bit>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    dff_setup!(self, clock, r);
    self.r.q.next = true;
    self.y.next = self.r.q.val();
});
kernel!(Grandchild { clock: Input<ClockReset>, leaf: Leaf, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.leaf.clock.next = self.clock.val();
    self.leaf.d.next = true;
    self.y.next = self.leaf.r.q.val();
});

#[test]
fn children_must_be_driven_and_share_the_clock() {
    refused::<NoChildInput>(&["`r.d` is never driven"]);
    refused::<NoChildClock>(&["`r.clock` is never driven"]);
    refused::<GatedClock>(&["assignment to `r.clock`", "a clock is gated", "unconditionally"]);
    refused::<OtherClock>(&["a clock under another name", "call it `clock`"]);
    refused::<WritesChildOutput>(&["writes `r.q`", "an output of a child"]);
    refused::<Grandchild>(&["`leaf.r.q` is no signal", "grandchild be reached through ports"]);
}

kernel!(LiteralTooLarge { a: Input<U<8>>, y: Output<U<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val() + 256;
});
kernel!(LiteralNegative { y: Output<U<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = (-1).into();
});
kernel!(AlwaysFalse { a: Input<U<8>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val() < 0;
});
kernel!(AlwaysTrue { a: Input<S<8>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val() <= 127;
});
kernel!(BeyondBits { a: Input<S<8>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val().get_bit(8);
});
kernel!(BeyondRange { a: Input<S<8>>, y: Output<U<4>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val().get_bits::<4>(5);
});
kernel!(BeyondLanes { a: Input<Lanes<3, 8>>, y: Output<S<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val().get_bit(3);
});
kernel!(ComputedIndex { a: Input<S<8>>, k: Input<U<2>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val().get_bit(self.k.val().index() + 1);
});
kernel!(NegativeShift { a: Input<S<8>>, y: Output<S<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val() << -1;
});
kernel!(WideShift { a: Input<S<8>>, k: Input<U<40>>, y: Output<S<8>> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val() >> self.k.val();
});
kernel!(StockBits { a: Input<Bits<8>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val().any();
});
kernel!(Binding { s: Input<State>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    match self.s.val() { State::Idle => { self.y.next = true; } _other => { self.y.next = false; } }
});
kernel!(Frozen { w: Wire<S<8>>, y: Output<S<16>> } #[hdl_gen] fn update(&mut self) {
    self.w.next = 3.into();
    if self.w.val() == 2 { self.y.next = 1.into(); } else { self.y.next = bit_cast_to::<S<16>>(self.w.val()); }
});

#[test]
fn expressions_must_be_exact() {
    refused::<LiteralTooLarge>(&["assignment to `y`", "literal 256 does not fit unsigned 8"]);
    refused::<LiteralNegative>(&["literal -1 does not fit unsigned 8"]);
    refused::<AlwaysFalse>(&["comparing unsigned 8 with the literal 0"]);
    refused::<AlwaysTrue>(&["comparing signed 8 with the literal 127"]);
    refused::<BeyondBits>(&["index 8 lies outside signed 8"]);
    refused::<BeyondRange>(&["range 5 + 4 lies outside signed 8"]);
    refused::<BeyondLanes>(&["index 3 lies outside 3 x signed 8"]);
    refused::<ComputedIndex>(&["arithmetic in an index", "compute the index in a `Wire` first"]);
    refused::<NegativeShift>(&["a negative shift amount"]);
    refused::<WideShift>(&["less than 32 bits"]);
    refused::<StockBits>(&["`a`", "rust-hdl's own type `Bits::<8>`"]);
    refused::<Binding>(&["the arm `_other` which is no variant", "`Enum::Variant` or `_`"]);
    refused::<Frozen>(&["a choice between constants for `y`", "hold the result in a `Constant`"]);
}

kernel!(Keyword { a: Input<Bit>, table: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.table.next = self.a.val();
});
kernel!(Capital { a: Input<Bit>, N: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.N.next = self.a.val();
});
kernel!(Clash { clock: Input<ClockReset>, r: Register<Bit>, r_q: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    dff_setup!(self, clock, r);
    self.r_q.next = self.r.q.val();
});
kernel!(MemoryClash { clock: Input<ClockReset>, r: Wire<U<1>>, r_memory: Output<U<4>>, r_rom: Rom4 } #[hdl_gen] fn update(&mut self) {
    self.r_rom.clock.next = self.clock.val();
    self.r.next = 0.into();
    self.r_memory.next = self.r_rom.q.val();
});
kernel!(LoopName { i: Input<Bit>, y: [Output<Bit>; 2] } #[hdl_gen] fn update(&mut self) {
    for i in 0..2 { self.y[i].next = self.i.val(); }
});

/// Two memories of one name with different words.
#[derive(LogicBlock)]
struct Rom4 {
    clock: Input<ClockReset>,
    q: Output<U<4>>,
    a: Rom<U<4>, 1>,
    b: Rom<U<4>, 1>,
}
impl Default for Rom4 {
    fn default() -> Self {
        let rom = |word: i64| Rom::new("table", vec![U::new(word), U::new(word)]);
        Self { clock: Input::default(), q: Output::default(), a: rom(1), b: rom(2) }
    }
}
impl Logic for Rom4 {
    #[hdl_gen]
    fn update(&mut self) {
        self.a.clock.next = self.clock.val();
        self.b.clock.next = self.clock.val();
        self.a.read_address.next = 0.into();
        self.b.read_address.next = 0.into();
        self.q.next = self.a.read_data.val() + self.b.read_data.val();
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("rom4")
    }
}

/// A block with a const generic, which a kernel may use in types and loop bounds only.
#[derive(LogicBlock, Default)]
struct Generic<const N: usize> {
    a: Input<U<8>>,
    y: Output<Bit>,
}
impl<const N: usize> Logic for Generic<N> {
    #[hdl_gen]
    fn update(&mut self) {
        self.y.next = self.a.val().get_bit(N);
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("generic")
    }
}

#[test]
fn names_must_be_free_and_known() {
    refused::<Keyword>(&["`table` is a keyword of SystemVerilog", "choose another"]);
    refused::<Capital>(&["`N` is not a lower-case identifier"]);
    refused::<Clash>(&["`r_q`", "`r.q`", "rename one of them"]);
    refused::<MemoryClash>(&["the file `table.hex`", "other contents"]);
    refused::<LoopName>(&["a loop variable `i` with the name of a signal", "rename the loop variable"]);
    refused::<Generic<3>>(&["`N` is no signal", "`Constant` field"]);
}

/// Blocks without a kernel of their own.
macro_rules! without_kernel {
    ($name:ident $hdl:expr) => {
        #[derive(LogicBlock, Default)]
        struct $name {
            a: Input<Bit>,
        }
        impl Logic for $name {
            fn update(&mut self) {}
            fn hdl(&self) -> Verilog {
                $hdl
            }
            fn timing(&self) -> Vec<TimingInfo> {
                module_name("foreign")
            }
        }
    };
}
without_kernel!(Empty Verilog::Empty);
without_kernel!(Black Verilog::Blackbox(BlackBox { code: String::new(), name: String::new() }));
without_kernel!(Wrapped Verilog::Wrapper(Wrapper { code: String::new(), cores: String::new() }));

kernel!(BothWays { a: Input<Bit>, pin: Signal<InOut, U<8>>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.y.next = self.a.val();
});

#[derive(LogicBlock, Default)]
struct Nameless {
    a: Input<Bit>,
    y: Output<Bit>,
}
impl Logic for Nameless {
    #[hdl_gen]
    fn update(&mut self) {
        self.y.next = self.a.val();
    }
}

/// A block of one name and two widths.
#[derive(LogicBlock, Default)]
struct Sized<const N: usize> {
    a: Input<U<N>>,
    y: Output<Bit>,
}
impl<const N: usize> Logic for Sized<N> {
    #[hdl_gen]
    fn update(&mut self) {
        self.y.next = self.a.val().any();
    }
    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sized")
    }
}
kernel!(TwoSizes { a: Sized<2>, b: Sized<3>, y: Output<Bit> } #[hdl_gen] fn update(&mut self) {
    self.a.a.next = 0.into();
    self.b.a.next = 0.into();
    self.y.next = self.a.y.val() && self.b.y.val();
});

#[test]
fn modules_must_be_kernels_with_a_name() {
    refused::<Empty>(&["a block without a kernel", "#[hdl_gen]"]);
    refused::<Black>(&["a black box"]);
    refused::<Wrapped>(&["a wrapper"]);
    refused::<BothWays>(&["`pin`", "InOutParameter"]);
    refused::<Nameless>(&["no module name", "module_name"]);
    refused::<TwoSizes>(&["`top.a` and `top.b`", "relief_sized", "into the module name"]);
}
