// SPDX-License-Identifier: MIT OR Apache-2.0
//! Divider, multiplier and memories, stepped cycle by cycle.

use proptest::prelude::*;
use relief_hdl::prelude::*;
use relief_hdl::primitives::Divider;

/// Lets a block without sub-blocks under gates settle, and clocks it.
fn step<B: Block + Latch>(block: &mut B) {
    for _ in 0..4 {
        block.update_all();
    }
    block.latch(false);
}

/// Divides in hardware: quotient and remainder of each lane, and the cycles from start to done.
fn divide<const L: usize, const Q: usize, const R: usize>(x: [i128; L], y: i64) -> ([i64; L], [i64; L], usize) {
    let mut divider = Divider::<L, Q, R>::default();
    divider.latch(true);
    divider.high.next = Lanes::new(x.map(|x| (x >> Q) as i64));
    divider.low.next = Lanes::new(x.map(|x| x as i64));
    divider.divisor.next = S::new(y);
    divider.start.next = true;
    step(&mut divider);
    divider.start.next = false;
    let mut cycles = 1;
    loop {
        divider.update_all();
        let done = divider.done.val();
        step(&mut divider);
        if done {
            divider.update_all();
            assert!(!divider.busy.val(), "the divider is free behind its last cycle");
            return (*divider.quotient.val().get(), *divider.remainder.val().get(), cycles);
        }
        cycles += 1;
        assert!(cycles < 200, "the divider does not end");
    }
}

#[test]
fn divider_is_exact_over_all_inputs_of_small_widths() {
    // Q = 5: quotients -16..=15; R = 6: 2y < 2^5.
    let mut checked = 0;
    for y in 1..16i64 {
        for q in -16..16i128 {
            for r in 0..i128::from(y) {
                let x = q * i128::from(y) + r;
                let (quotient, remainder, cycles) = divide::<1, 5, 6>([x], y);
                assert_eq!((i128::from(quotient[0]), i128::from(remainder[0])), (q, r), "{x} / {y}");
                assert_eq!(cycles, Divider::<1, 5, 6>::LATENCY, "{x} / {y}");
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 32 * (1..16).sum::<i32>());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]
    #[test]
    fn divider_is_exact_at_the_remesher_s_widths(
        y in 1i64..1 << 29,
        q in prop::array::uniform3(prop_oneof![Just(-(1i64 << 45)), Just((1i64 << 45) - 1), -(1i64 << 45)..1 << 45]),
        part in prop::array::uniform3(0.0f64..1.0),
    ) {
        let r: [i64; 3] = std::array::from_fn(|k| ((part[k] * y as f64) as i64).clamp(0, y - 1));
        let x = std::array::from_fn(|k| i128::from(q[k]) * i128::from(y) + i128::from(r[k]));
        let (quotient, remainder, _) = divide::<3, 46, 31>(x, y);
        prop_assert_eq!((quotient, remainder), (q, r));
    }

    #[test]
    fn multiplier_is_exact_a_cycle_later(a in any::<i64>(), b in any::<i64>()) {
        let mut multiplier = Multiplier::<46, 17, 63>::default();
        (multiplier.a.next, multiplier.b.next) = (S::new(a), S::new(b));
        multiplier.latch(false);
        let expected = i128::from(S::<46>::new(a).get()) * i128::from(S::<17>::new(b).get());
        prop_assert_eq!(multiplier.p.val().get(), expected);
    }

    #[test]
    fn ram_reads_first_and_a_cycle_later(writes in prop::collection::vec((any::<bool>(), 0i64..5, any::<i64>(), 0i64..5), 1..200)) {
        let mut ram = Ram::<Lanes<3, 20>, 3>::new(5);
        let mut words = [Lanes::default(); 5];
        for (enable, at, value, read) in writes {
            ram.write_enable.next = enable;
            ram.write_address.next = U::new(at);
            ram.write_data.next = Lanes::new([value, !value, value >> 3]);
            ram.read_address.next = U::new(read);
            ram.latch(false);
            prop_assert_eq!(ram.read_data.val(), words[read as usize]);
            if enable {
                words[at as usize] = Lanes::new([value, !value, value >> 3]);
            }
        }
    }
}

/// Steps a registered RAM of 5 words beside a list of words. A word that is written while it is read means nothing.
fn registered_ram_follows<const LATE: bool>(steps: &[[i64; 6]]) -> Result<(), TestCaseError> {
    let mut ram = RegisteredRam::<S<20>, 3, LATE>::new(5);
    let mut words = [S::<20>::default(); 5];
    let (mut late, mut word, mut held) = (None, Some(words[0]), Some(words[0]));
    for &[write, at, value, read, enable, output_enable] in steps {
        (ram.write_enable.next, ram.enable.next, ram.output_enable.next) =
            (write == 1, enable == 1, output_enable == 1);
        (ram.write_address.next, ram.read_address.next) = (U::new(at), U::new(read));
        ram.write_data.next = S::new(value);
        ram.latch(false);
        let asked = (write == 1).then_some((at, S::new(value)));
        let written = if LATE { std::mem::replace(&mut late, asked) } else { asked };
        if output_enable == 1 {
            held = word;
        }
        if enable == 1 {
            word = written.is_none_or(|(at, _)| at != read).then_some(words[read as usize]);
        }
        if let Some((at, value)) = written {
            words[at as usize] = value;
        }
        if let Some(held) = held {
            prop_assert_eq!(ram.read_data.val(), held);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn registered_ram_reads_two_cycles_later_and_holds(
        steps in prop::collection::vec([0i64..2, 0i64..5, -500_000i64..500_000, 0i64..5, 0i64..2, 0i64..2], 1..200),
    ) {
        registered_ram_follows::<false>(&steps)?;
        registered_ram_follows::<true>(&steps)?;
    }
}

proptest! {
    /// Steps a RAM of 8 words beside a list of words. What is read of a word that is written means nothing.
    #[test]
    fn two_port_ram_reads_at_both_ports_two_cycles_later_and_holds(
        steps in prop::collection::vec([0i64..2, 0i64..8, -500_000i64..500_000, 0i64..8, 0i64..2, 0i64..2], 1..200),
    ) {
        let mut ram = TwoPortRam::<S<20>, 3>::default();
        let mut words = [S::<20>::default(); 8];
        let (mut word, mut held) = ([Some(words[0]); 2], [Some(words[0]); 2]);
        for [write, at, value, second, enable, output_enable] in steps {
            (ram.write_enable.next, ram.enable.next, ram.output_enable.next) =
                (write == 1, enable == 1, output_enable == 1);
            (ram.address.next, ram.second_address.next) = (U::new(at), U::new(second));
            ram.write_data.next = S::new(value);
            ram.latch(false);
            if output_enable == 1 {
                held = word;
            }
            if enable == 1 {
                word = [at, second].map(|read| (write == 0 || at != read).then_some(words[read as usize]));
            }
            if write == 1 {
                words[at as usize] = S::new(value);
            }
            for (data, held) in [ram.read_data.val(), ram.second_data.val()].into_iter().zip(held) {
                if let Some(held) = held {
                    prop_assert_eq!(data, held);
                }
            }
        }
    }
}

#[test]
fn multiplier_takes_the_minimum_of_both_formats() {
    let mut multiplier = Multiplier::<4, 4, 8>::default();
    (multiplier.a.next, multiplier.b.next) = (S::MIN, S::MIN);
    multiplier.latch(false);
    assert_eq!(multiplier.p.val(), 64);
}

#[test]
fn rom_reads_its_words_a_cycle_later() {
    let words: Vec<S<9>> = (-3..4).map(S::from).collect();
    let mut rom = Rom::<S<9>, 3>::new("seven", words.clone());
    for (at, word) in words.iter().enumerate() {
        rom.read_address.next = U::new(at as i64);
        rom.latch(false);
        assert_eq!(rom.read_data.val(), *word);
    }
    rom.enable.next = false;
    rom.read_address.next = U::new(0);
    rom.latch(false);
    assert_eq!(rom.read_data.val(), words[6], "holds without enable");
}

#[test]
fn register_obeys_reset_before_enable() {
    let mut register = Register::<S<5>>::new(S::new(-7));
    register.latch(true);
    assert_eq!(register.q.val(), -7);
    register.d.next = S::new(3);
    register.enable.next = false;
    register.latch(false);
    assert_eq!(register.q.val(), -7, "holds without enable");
    register.enable.next = true;
    register.latch(false);
    assert_eq!(register.q.val(), 3);
    register.latch(true);
    assert_eq!(register.q.val(), -7, "reset wins");
    let mut data = DataRegister::<S<5>>::default();
    data.d.next = S::new(9);
    data.latch(true);
    assert_eq!(data.q.val(), 9, "a data register has no reset");
}
