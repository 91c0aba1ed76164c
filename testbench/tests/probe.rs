// SPDX-License-Identifier: MIT OR Apache-2.0
//! A block of stock signals and registers shows its values under readable names.

use relief_hdl::signal::{ClockReset, Input, Lanes, Output, S};
use relief_testbench::probe::BlockProbe;
use relief_waves::{Group, Kind, Value, VcdRecorder, gtkw, read};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::DFF;
use std::fs::File;

#[derive(Copy, Clone, PartialEq, Debug, LogicState)]
enum State {
    Idle,
    Count,
    Done,
}

#[derive(Copy, Clone, PartialEq, Debug, Default, LogicStruct)]
struct Pair {
    flag: Bit,
    number: Bits<7>,
}

/// Counts while it is enabled, in a register of each kind.
#[derive(LogicBlock)]
struct Counter {
    pub clock: Signal<In, Clock>,
    pub enable: Signal<In, Bit>,
    pub total: Signal<Out, Bits<40>>,
    pub difference: Signal<Local, Signed<6>>,
    pub pair: Signal<Local, Pair>,
    state: DFF<State>,
    stages: [DFF<Bits<12>>; 2],
    total_so_far: DFF<Bits<40>>,
    step: Constant<Bits<40>>,
    top: Constant<Bits<40>>,
}

impl Default for Counter {
    fn default() -> Self {
        Self {
            clock: Default::default(),
            enable: Default::default(),
            total: Default::default(),
            difference: Default::default(),
            pair: Default::default(),
            state: Default::default(),
            stages: Default::default(),
            total_so_far: Default::default(),
            step: Constant::new(0x1_0000_0007u64.into()),
            top: Constant::new(0x14_0000_0000u64.into()),
        }
    }
}

impl Logic for Counter {
    fn update(&mut self) {
        let so_far = self.total_so_far.q.val();
        self.state.clock.next = self.clock.val();
        self.total_so_far.clock.next = self.clock.val();
        self.stages.iter_mut().for_each(|stage| stage.clock.next = self.clock.val());
        self.total_so_far.d.next = if self.enable.val() { so_far + self.step.val() } else { so_far };
        self.state.d.next = match (so_far > self.top.val(), self.enable.val()) {
            (true, _) => State::Done,
            (false, true) => State::Count,
            (false, false) => State::Idle,
        };
        self.stages[0].d.next = so_far.get_bits::<12>(0);
        self.stages[1].d.next = self.stages[0].q.val();
        self.difference.next = signed_bit_cast::<6, 12>(bits_as_signed(so_far.get_bits::<12>(0)));
        self.pair.next = Pair { flag: self.enable.val(), number: so_far.get_bits::<7>(3) };
        self.total.next = so_far;
    }
    fn connect(&mut self) {
        self.total.connect();
    }
    fn hdl(&self) -> Verilog {
        Verilog::Empty
    }
}

/// The block's own cast overflows its stack on the minimum, so the test keeps to what it needs: a sign.
fn bits_as_signed(value: Bits<12>) -> Signed<12> {
    Signed::<12>::from(-(value.to_u64() as i64 % 16))
}

fn settle(block: &mut Counter) {
    loop {
        block.update_all();
        if !block.has_changed() {
            return;
        }
    }
}

#[test]
fn probe_shows_registers_states_and_fields_by_readable_names() -> Result<(), Box<dyn std::error::Error>> {
    let mut block = Counter::default();
    block.connect_all();
    let mut probe = BlockProbe::new("counter", &block)?;
    let names: Vec<String> = probe.tree().places().into_iter().map(|place| place.path).collect();
    let expected = [
        "enable",
        "total",
        "difference",
        "pair.flag",
        "pair.number",
        "state",
        "stages[0]",
        "stages[1]",
        "total_so_far",
    ];
    assert_eq!(names, expected.map(|name| format!("counter.{name}")));
    let state = probe.tree().find("counter.state").map(|place| place.signal.kind.clone());
    assert_eq!(state, Some(Kind::Enum(["Idle", "Count", "Done"].map(String::from).to_vec())));

    let folder = tempfile::tempdir()?;
    let path = folder.path().join("counter.vcd");
    let mut recorder = VcdRecorder::new(File::create(&path)?, probe.tree().clone(), 5..60);
    let mut seen = Vec::new();
    for cycle in 0..80u64 {
        block.enable.next = cycle % 3 != 0;
        block.clock.next = false.into();
        settle(&mut block);
        if recorder.wants(cycle) {
            let sample = probe.sample(&block);
            recorder.sample(cycle, sample)?;
        }
        seen.push((block.total.val().to_u64(), block.stages[1].q.val().to_u64(), block.state.q.val()));
        block.clock.next = true.into();
        settle(&mut block);
    }
    assert_eq!(recorder.finish()?, Some(5..60));

    let waves = read(&path)?;
    assert_eq!(waves.cycles(), 5..60);
    let mut states = Vec::new();
    for cycle in waves.cycles() {
        let value = |name: &str| waves.value(name, cycle).cloned().unwrap_or_else(|| panic!("{name} in {cycle}"));
        let unsigned = |name: &str| value(name).unsigned().map(|number| number as u64);
        let (total, stage, state) = seen[cycle as usize];
        assert_eq!(unsigned("counter.total"), Some(total));
        assert_eq!(unsigned("counter.total_so_far"), Some(total));
        assert_eq!(unsigned("counter.stages[1]"), Some(stage));
        assert_eq!(unsigned("counter.pair.number"), Some(total >> 3 & 127));
        assert_eq!(unsigned("counter.pair.flag"), Some(u64::from(cycle % 3 != 0)));
        assert_eq!(value("counter.difference").signed(), Some(-i128::from((total & 0xfff) % 16)));
        assert_eq!(value("counter.state"), Value::Text(format!("{state:?}")));
        states.push(state);
    }
    // The run must have gone through all of them, or the comparison says little.
    assert!([State::Idle, State::Count, State::Done].iter().all(|state| states.contains(state)));
    assert!(gtkw(probe.tree(), &Group::of_scopes(probe.tree()), "counter.vcd").is_ok());
    Ok(())
}

#[test]
fn probe_opens_registers_on_demand() -> Result<(), Box<dyn std::error::Error>> {
    let block = Counter::default();
    let probe = BlockProbe::with_registers_open("counter", &block)?;
    assert!(probe.tree().find("counter.state.d").is_some());
    assert!(probe.tree().find("counter.stages[1].q").is_some());
    assert!(probe.tree().find("counter.step").is_none(), "constants are left out");
    Ok(())
}

/// The project's own ports: packed lanes, and a clock that brings the reset along.
#[derive(Default, LogicBlock)]
struct Through {
    pub clock: Input<ClockReset>,
    pub in_vertex: Input<Lanes<3, 46>>,
    pub out_vertex: Output<Lanes<3, 46>>,
    inner: Inner,
}

#[derive(Default, LogicBlock)]
struct Inner {
    pub clock: Input<ClockReset>,
    pub value: Input<S<33>>,
}

impl Logic for Inner {
    fn update(&mut self) {}
    fn connect(&mut self) {}
    fn hdl(&self) -> Verilog {
        Verilog::Empty
    }
}

impl Logic for Through {
    fn update(&mut self) {
        self.inner.clock.next = self.clock.val();
        self.inner.value.next = S::new(-5);
        self.out_vertex.next = self.in_vertex.val();
    }
    fn connect(&mut self) {}
    fn hdl(&self) -> Verilog {
        Verilog::Empty
    }
}

#[test]
fn probe_packs_lanes_and_shows_one_reset() -> Result<(), Box<dyn std::error::Error>> {
    let mut block = Through::default();
    block.connect_all();
    let mut probe = BlockProbe::new("through", &block)?;
    let names: Vec<String> = probe.tree().places().into_iter().map(|place| place.path).collect();
    assert_eq!(names, ["reset", "in_vertex", "out_vertex", "inner.value"].map(|name| format!("through.{name}")));
    let kind = probe.tree().find("through.in_vertex").map(|place| place.signal.kind.clone());
    assert_eq!(kind, Some(Kind::Lanes { lanes: 3, bits: 46 }));
    let lanes = [-(1 << 45), 1, (1 << 45) - 1];
    block.clock.next.reset = true;
    block.in_vertex.next = Lanes::new(lanes);
    block.update_all();
    let packed = (0..3).fold([0u128; 2], |[low, high], lane| {
        let value = (lanes[lane] as u128) & ((1 << 46) - 1);
        if lane < 2 { [low | value << (46 * lane), high] } else { [low | value << 92, high | value >> 36] }
    });
    let vertex = [packed[0] as u64, (packed[0] >> 64) as u64, packed[1] as u64];
    let inner = -5i64 as u64 & ((1 << 33) - 1);
    assert_eq!(probe.sample(&block), [&[1][..], &vertex, &vertex, &[inner]].concat());
    Ok(())
}
