// SPDX-License-Identifier: MIT OR Apache-2.0
//! The schedule of the engine: what each part does in each of the 64 cycles of a round.
//!
//! A vertex takes two rounds, its steps 0 to 127; while it is in the second one, the next vertex is in the first. Every
//! product begins at a step of its own modulo 64, and each field of the word is written for the cycle in which its part
//! needs it, so nothing is delayed in hardware. The word of a step stands in the cycle behind it.
//!
//! | steps    | products | result |   D = 18 steps from a last product to its result
//! |----------|----------|--------|
//! | 0 .. 8   | rotation position                    | z at 20, x at 23, y at 26 |
//! | 27 .. 36 | normals of the volume of sight       | outcode |
//! | 37, 38   | z - z0                               | bit 0 of outside |
//! | 40       | z0 / z, 1/z stands at 42             | c at 58 |
//! | 48, 49   | x / z, y / z                         | at 66, 67 |
//! | 50 .. 58 | rotation normal                      | at 70, 73, 76 |
//! | 59 .. 61 | 2 (u, v, rho) / 2                    | at 77, 78, 79; the beat is taken |
//! | 62       | the line of -log2 c                  | at 80 |
//! | 73, 74   | f x / z, f y / z                     | X, Y at 91, 92 |
//! | 75 .. 82 | guard band                           | bits 1 .. 4 of outside |
//! | 83 .. 88 | normal, u, v, rho times c            | lanes at 101 .. 106 |
//! | 103, 107 | X / cell, Y / cell                   | corner at 121, 125 |
//! | 105, 106 | -log2 c octave - bias                | corner at 124 |
//!
//! What a vertex stores stands for 64 steps, then the next one's comes: x, y and z are read until 82, before 87, 90 and 84.

use super::{coefficient, term};
use crate::prelude::*;

/// Steps of a round.
pub const ROUND: usize = 64;
/// The step in which the last lane of the beat is read: the beat is taken in the next one.
pub const READ: usize = 62;
/// Where the words of the small memory stand: the vertex in view space, then what comes between.
mod work {
    pub const NORMAL: i64 = 3;
    pub const TEXEL: i64 = 6;
    pub const LOGARITHM: i64 = 9;
    pub const SLOPE: i64 = 10;
    pub const PIXEL: i64 = 12;
    pub const COUNT: usize = 14;
}

/// Where the first factor comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum A {
    Input(i64),
    Work(i64),
    Term(i64),
    Along,
}

/// Where the second factor comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum B {
    Literal(i64),
    Coefficient(i64),
    /// The coefficient for a record, the literal for a vertex in view space.
    Rotation(i64, i64),
    Inverse,
    C,
    Fall,
}

/// What a sum begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
enum From {
    Zero,
    Term(i64),
    /// The term for a record, zero for a vertex in view space.
    Translation(i64),
    Logarithm,
    /// -2^16
    Minus,
}

/// One word.
#[derive(Clone, Copy, Debug, Default)]
struct Word {
    issued: bool,
    a_source: i64,
    a_address: i64,
    reads: bool,
    term: i64,
    b_source: i64,
    coefficient: i64,
    rotates: bool,
    literal: i64,
    view: i64,
    from: i64,
    first: bool,
    amount: i64,
    relative: bool,
    side: bool,
    inverted: bool,
    rounds: bool,
    clamps: bool,
    checks_slope: bool,
    checks_lane: bool,
    stores: bool,
    store_address: i64,
    data: i64,
    corner: i64,
    keeps_c: bool,
    keeps_zeros: bool,
    keeps_inverse: bool,
    keeps_logarithm: bool,
    copies: bool,
}

struct Table([Word; ROUND]);

impl Table {
    fn at(&mut self, step: usize) -> &mut Word {
        &mut self.0[step % ROUND]
    }
    fn term(&mut self, step: usize, address: i64) {
        let word = self.at(step);
        assert!(!word.reads, "step {step} reads two terms");
        (word.reads, word.term) = (true, address);
    }
    fn product(&mut self, step: usize, a: A, b: B) {
        if let A::Term(address) = a {
            self.term(step, address);
        }
        let word = self.at(step);
        assert!(!word.issued, "two products at step {step}");
        word.issued = true;
        (word.a_source, word.a_address) = match a {
            A::Input(lane) => (0, lane),
            A::Work(address) => (1, address),
            A::Term(_) => (2, 0),
            A::Along => (3, 0),
        };
        (word.b_source, word.coefficient, word.literal) = match b {
            B::Literal(literal) => (0, 0, literal),
            B::Coefficient(address) | B::Rotation(address, _) => (1, address, 0),
            B::Inverse => (2, 0, 0),
            B::C => (3, 0, 0),
            B::Fall => (4, 0, 0),
        };
        if let B::Rotation(_, literal) = b {
            (word.rotates, word.literal) = (true, literal);
        }
    }
    /// The sum of products at the steps from `step` on; its last step.
    fn sum(&mut self, step: usize, from: From, products: &[(A, B)]) -> usize {
        for (k, (a, b)) in products.iter().enumerate() {
            self.product(step + k, *a, *b);
        }
        if let From::Term(address) | From::Translation(address) = from {
            self.term(step + 8, address);
        }
        self.at(step + 9).from = match from {
            From::Zero => 0,
            From::Term(_) => 1,
            From::Translation(_) => 2,
            From::Logarithm => 4,
            From::Minus => 8,
        };
        self.at(step + 10).first = true;
        step + products.len() - 1
    }
    /// Where the sign of a sum goes.
    fn side(&mut self, last: usize, inverted: bool) {
        let word = self.at(last + 11);
        (word.side, word.inverted) = (true, inverted);
    }
    /// A sum without its lower `bits` bits, of which the highest one may round.
    fn shift(&mut self, last: usize, bits: i64, rounds: bool) {
        self.at(last + 10).amount = bits - 1;
        self.at(last + 14).rounds = rounds;
    }
    /// As many bits less as z has leading zeros of 48.
    fn shift_by_length(&mut self, last: usize, bits: i64) {
        self.shift(last, bits, false);
        self.at(last + 10).relative = true;
    }
    fn store(&mut self, last: usize, address: i64) {
        let word = self.at(last + 17);
        (word.stores, word.store_address) = (true, address);
    }
}

fn table() -> [Word; ROUND] {
    let mut t = Table([Word::default(); ROUND]);
    // Position, z first, and normal.
    for (place, row) in [(0, 2i64), (3, 0), (6, 1)] {
        let products: Vec<_> = (0..3)
            .map(|k| (A::Input(k), B::Rotation(coefficient::ROTATION + 3 * row + k, i64::from(k == row) << 16)))
            .collect();
        let last = t.sum(place, From::Translation(term::TRANSLATION + row), &products);
        t.shift(last, 16, true);
        t.store(last, row);
    }
    for row in 0..3 {
        let products: Vec<_> = (0..3)
            .map(|k| (A::Input(3 + k), B::Rotation(coefficient::ROTATION + 3 * row + k, i64::from(k == row) << 30)))
            .collect();
        let last = t.sum(50 + 3 * row as usize, From::Zero, &products);
        t.shift(last, 30, true);
        t.store(last, work::NORMAL + row);
    }
    for k in 0..3 {
        let last = t.sum(READ - 3 + k as usize, From::Zero, &[(A::Input(6 + k), B::Literal(2))]);
        t.shift(last, 1, false);
        t.store(last, work::TEXEL + k);
    }

    // Sides: x or y and z, or z alone.
    let side = |k: i64| B::Coefficient(coefficient::SIDES + k);
    for (k, across) in [0, 0, 1, 1].into_iter().enumerate() {
        let products = [(A::Work(across), side(2 * k as i64)), (A::Work(2), side(2 * k as i64 + 1))];
        let last = t.sum(27 + 2 * k, From::Term(term::REACH + k as i64), &products);
        t.side(last, false);
    }
    for k in 0..2 {
        let last = t.sum(35 + k as usize, From::Term(term::REACH + 4 + k), &[(A::Work(2), side(8 + k))]);
        t.side(last, false);
    }
    let last = t.sum(37, From::Zero, &[(A::Work(2), B::Literal(1)), (A::Term(term::Z0), B::Literal(-1))]);
    t.side(last, false);
    // g z + floor(f x / 2^16) < 0 is g 2^16 z + f x < 0; g z - floor(..) < 0 is f x - g 2^16 z - 2^16 >= 0.
    const GUARD: i64 = 8190 << 16;
    for (place, across, minus) in [(75, 0, false), (77, 0, true), (79, 1, false), (81, 1, true)] {
        let (from, guard) = if minus { (From::Minus, -GUARD) } else { (From::Zero, GUARD) };
        let products = [(A::Work(across), B::Coefficient(coefficient::FOCAL)), (A::Work(2), B::Literal(guard))];
        let last = t.sum(place, from, &products);
        t.side(last, minus);
    }

    // 1/z = inverse 2^-(32 + length), c = z0 / z, slopes with 34 fraction bits.
    t.at(24).keeps_zeros = true;
    t.at(40).keeps_inverse = true;
    t.sum(40, From::Zero, &[(A::Term(term::Z0), B::Inverse)]);
    t.shift_by_length(40, 48);
    t.at(56).clamps = true;
    t.at(57).keeps_c = true;
    for k in 0..2 {
        let step = 48 + k as usize;
        t.sum(step, From::Zero, &[(A::Work(k), B::Inverse)]);
        t.shift_by_length(step, 45);
        t.at(step + 16).checks_slope = true;
        t.store(step, work::SLOPE + k);
        let step = 73 + k as usize;
        t.sum(step, From::Zero, &[(A::Work(work::SLOPE + k), B::Coefficient(coefficient::FOCAL))]);
        t.shift(step, 32, true);
        t.at(step + 16).checks_lane = true;
        t.at(step + 17).data = 1 + k;
        t.store(step, work::PIXEL + k);
        let step = 103 + 4 * k as usize;
        t.sum(step, From::Zero, &[(A::Work(work::PIXEL + k), B::Coefficient(coefficient::INVERSE_CELL))]);
        t.shift(step, 42, true);
        t.at(step + 17).corner = 1 + k;
    }
    for k in 0..6 {
        let step = 83 + k as usize;
        t.sum(step, From::Zero, &[(A::Work(work::NORMAL + k), B::C)]);
        t.shift(step, if k < 3 { 30 } else { 32 }, true);
        t.at(step + 16).clamps = k < 3;
        t.at(step + 17).data = 4 + k;
    }

    // The logarithm of c, and what it is in voxels; the bias comes with 10 fraction bits.
    t.at(63).keeps_logarithm = true;
    t.sum(62, From::Logarithm, &[(A::Along, B::Fall)]);
    t.shift(62, 25, false);
    t.store(62, work::LOGARITHM);
    let products = [
        (A::Work(work::LOGARITHM), B::Coefficient(coefficient::OCTAVE)),
        (A::Term(term::BIAS), B::Literal(-(1 << 30))),
    ];
    let last = t.sum(105, From::Zero, &products);
    t.shift(last, 40, true);
    t.at(last + 17).corner = 3;

    // What leaves, when the vertex before has left: factors that pass by, flags and c.
    for (lane, step) in [75, 79, 76, 83, 84, 85, 86, 87, 88].into_iter().enumerate() {
        t.at(step + 2).view = 1 + lane as i64;
    }
    t.at(95).copies = true;
    t.0
}

/// Puts fields of so many bits side by side, the first one lowest.
fn pack(fields: &[(i64, u32)]) -> i64 {
    fields.iter().rev().fold(0, |word, (value, bits)| {
        assert!((0..1 << bits).contains(value), "{value} does not fit {bits} bits");
        word << bits | value
    })
}

fn issue(w: &Word) -> U<23> {
    let fields = [(w.a_source, 2), (w.a_address, 4), (w.term, 4), (w.b_source, 3), (w.coefficient, 5)];
    U::new(pack(&fields) | i64::from(w.rotates) << 18 | w.view << 19)
}

fn result(w: &Word) -> U<34> {
    let bit = |flag: bool| (i64::from(flag), 1);
    U::new(pack(&[
        (w.from, 4),
        bit(w.first),
        (w.amount, 6),
        bit(w.relative),
        bit(w.side),
        bit(w.inverted),
        bit(w.rounds),
        bit(w.clamps),
        bit(w.checks_slope),
        bit(w.checks_lane),
        bit(w.stores),
        (w.store_address, 4),
        (w.data, 4),
        (w.corner, 2),
        bit(w.keeps_c),
        bit(w.keeps_zeros),
        bit(w.keeps_inverse),
        bit(w.keeps_logarithm),
        bit(w.copies),
    ]))
}

/// The schedule.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Schedule {
    pub clock: Input<ClockReset>,
    pub step: Input<U<6>>,
    /// First factor: 0 lane of the beat, 1 word of the small memory, 2 a term, 3 along the line of the logarithm.
    pub a_source: Output<U<2>>,
    pub a_address: Output<U<4>>,
    pub term: Output<U<4>>,
    /// Second factor: 0 literal, 1 coefficient, 2 1/z, 3 c, 4 the line's fall.
    pub b_source: Output<U<3>>,
    pub coefficient: Output<U<5>>,
    /// A vertex in view space takes the literal.
    pub rotates: Output<Bit>,
    pub literal: Output<S<33>>,
    /// The first factor is a lane of the vertex in view space, counted from 1.
    pub view: Output<U<4>>,
    /// A sum begins with: bit 0 a term, 1 a term but for a vertex in view space, 2 the logarithm, 3 -2^16.
    pub from: Output<U<4>>,
    pub begins: Output<Bit>,
    pub amount: Output<U<6>>,
    pub relative: Output<Bit>,
    pub side: Output<Bit>,
    pub inverted: Output<Bit>,
    pub rounds: Output<Bit>,
    pub clamps: Output<Bit>,
    pub checks_slope: Output<Bit>,
    pub checks_lane: Output<Bit>,
    pub stores: Output<Bit>,
    pub store_address: Output<U<4>>,
    /// The result is a lane, counted from 1.
    pub data: Output<U<4>>,
    /// The result is a grid coordinate, counted from 1.
    pub corner: Output<U<2>>,
    pub keeps_c: Output<Bit>,
    pub keeps_zeros: Output<Bit>,
    pub keeps_inverse: Output<Bit>,
    pub keeps_logarithm: Output<Bit>,
    pub copies: Output<Bit>,
    issues: Rom<U<23>, 6>,
    literals: Rom<S<33>, 6>,
    results: Rom<U<34>, 6>,
}

impl Schedule {
    /// Words of the small memory.
    pub const WORK: usize = work::COUNT;
}

impl Default for Schedule {
    fn default() -> Self {
        let table = table();
        Self {
            clock: Input::default(),
            step: Input::default(),
            a_source: Output::default(),
            a_address: Output::default(),
            term: Output::default(),
            b_source: Output::default(),
            coefficient: Output::default(),
            rotates: Output::default(),
            literal: Output::default(),
            view: Output::default(),
            from: Output::default(),
            begins: Output::default(),
            amount: Output::default(),
            relative: Output::default(),
            side: Output::default(),
            inverted: Output::default(),
            rounds: Output::default(),
            clamps: Output::default(),
            checks_slope: Output::default(),
            checks_lane: Output::default(),
            stores: Output::default(),
            store_address: Output::default(),
            data: Output::default(),
            corner: Output::default(),
            keeps_c: Output::default(),
            keeps_zeros: Output::default(),
            keeps_inverse: Output::default(),
            keeps_logarithm: Output::default(),
            copies: Output::default(),
            issues: Rom::new("relief_transform_issues", table.iter().map(issue).collect()),
            literals: Rom::new("relief_transform_literals", table.iter().map(|w| S::new(w.literal)).collect()),
            results: Rom::new("relief_transform_results", table.iter().map(result).collect()),
        }
    }
}

impl Logic for Schedule {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, issues, literals, results);
        self.issues.read_address.next = self.step.val();
        self.literals.read_address.next = self.step.val();
        self.results.read_address.next = self.step.val();
        self.a_source.next = self.issues.read_data.val().get_bits::<2>(0);
        self.a_address.next = self.issues.read_data.val().get_bits::<4>(2);
        self.term.next = self.issues.read_data.val().get_bits::<4>(6);
        self.b_source.next = self.issues.read_data.val().get_bits::<3>(10);
        self.coefficient.next = self.issues.read_data.val().get_bits::<5>(13);
        self.rotates.next = self.issues.read_data.val().get_bit(18);
        self.view.next = self.issues.read_data.val().get_bits::<4>(19);
        self.literal.next = self.literals.read_data.val();
        self.from.next = self.results.read_data.val().get_bits::<4>(0);
        self.begins.next = self.results.read_data.val().get_bit(4);
        self.amount.next = self.results.read_data.val().get_bits::<6>(5);
        self.relative.next = self.results.read_data.val().get_bit(11);
        self.side.next = self.results.read_data.val().get_bit(12);
        self.inverted.next = self.results.read_data.val().get_bit(13);
        self.rounds.next = self.results.read_data.val().get_bit(14);
        self.clamps.next = self.results.read_data.val().get_bit(15);
        self.checks_slope.next = self.results.read_data.val().get_bit(16);
        self.checks_lane.next = self.results.read_data.val().get_bit(17);
        self.stores.next = self.results.read_data.val().get_bit(18);
        self.store_address.next = self.results.read_data.val().get_bits::<4>(19);
        self.data.next = self.results.read_data.val().get_bits::<4>(23);
        self.corner.next = self.results.read_data.val().get_bits::<2>(27);
        self.keeps_c.next = self.results.read_data.val().get_bit(29);
        self.keeps_zeros.next = self.results.read_data.val().get_bit(30);
        self.keeps_inverse.next = self.results.read_data.val().get_bit(31);
        self.keeps_logarithm.next = self.results.read_data.val().get_bit(32);
        self.copies.next = self.results.read_data.val().get_bit(33);
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("transform_schedule")
    }
}

latches! { [] Schedule: issues, literals, results }
