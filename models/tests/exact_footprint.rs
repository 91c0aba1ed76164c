// SPDX-License-Identifier: MIT OR Apache-2.0
//! The exact footprint: its bound against the exact value, its level, and what it must not depend on.

use relief_models::exact_footprint::{exact, golden};
use relief_models::filter_level::level;
use relief_models::perspective_correct::{Axis, inverse};
use relief_models::step::{MAX_COMPONENTS, Vertex};
use relief_models::vertex_transform::lane;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, bound: u64) -> u64 {
        self.bits() % bound
    }
    /// Any signed number of so many bits or less, and the ends of the format.
    fn signed(&mut self, bits: u32) -> i64 {
        match self.below(32) {
            0 => -(1 << (bits - 1)),
            1 => (1 << (bits - 1)) - 1,
            2 => 0,
            _ => (self.bits() as i64) >> (64 - bits as u64 + self.below(bits.into())),
        }
    }
}

/// A vertex with its differences on a map.
#[derive(Clone, Debug)]
struct Case {
    vertex: Vertex,
    differences: Vec<Vertex>,
    guard_bits: u32,
    axes: [Axis; 2],
}

fn of(u: i64, v: i64, c: i64) -> Vertex {
    let mut vertex = [0; MAX_COMPONENTS];
    (vertex[lane::U], vertex[lane::U + 1], vertex[lane::C]) = (u, v, c);
    vertex
}

impl Case {
    fn golden(&self) -> u32 {
        golden(&self.vertex, &self.differences, self.guard_bits, &self.axes, inverse(self.vertex[lane::C]))
    }

    /// Texels, from the integers: nothing cancels in f64.
    fn true_value(&self) -> f64 {
        let c = i128::from(self.vertex[lane::C]);
        let along = |k: usize| {
            let cross = |d: &Vertex| {
                let terms =
                    [i128::from(d[lane::U + k]) * c, i128::from(self.vertex[lane::U + k]) * i128::from(d[lane::C])];
                (terms[0] - terms[1]).abs() as f64
            };
            let unit = (f64::from(self.axes[k].texel_bits) - f64::from(self.guard_bits)).exp2();
            self.differences.iter().map(cross).sum::<f64>() / (c as f64 * c as f64) * unit
        };
        along(0).max(along(1))
    }

    /// Any lengths of lanes and differences; half of them such that the footprint is one of a map, 2^-2 to 2^16 texels.
    fn any(random: &mut Random) -> Self {
        let bits = random.below(31);
        let c = match random.below(16) {
            0 => 1 << bits,
            1 => (1 << 31) - 1,
            2 => 1,
            _ => (1 << bits) + random.below(1 << bits) as i64,
        };
        let guard_bits = random.below(17) as u32;
        let mut differences: Vec<Vertex> = Vec::new();
        let axes = [0; 2].map(|_| Axis { size: 512, repeat: true, texel_bits: 1 + random.below(15) as u32 });
        let lanes = match random.below(4) {
            0 => [random.signed(32), random.signed(32)],
            _ => [0; 2].map(|_| random.below(c as u64 + 1) as i64),
        };
        for _ in 0..1 + random.below(2) {
            let width = 33 + guard_bits;
            let any = |random: &mut Random| of(random.signed(width), random.signed(width), random.signed(width));
            differences.push(match random.below(8) {
                0 => [0; MAX_COMPONENTS],
                1..4 => any(random),
                _ => {
                    // D_u = u D_c + du c: a step of c by up to a half of it, and a du of 2^-2 to 2^16 texels.
                    let d_c = random.signed(62) as f64 * 2f64.powi(-62) * c as f64;
                    let lane = |random: &mut Random, k: usize| {
                        let texels = (random.below(1 << 20) as f64 / f64::from(1 << 20) * 18.0 - 2.0).exp2();
                        let du = texels * (-f64::from(axes[k].texel_bits)).exp2() * c as f64;
                        let du = if random.below(2) == 0 { du } else { -du };
                        let scaled = (lanes[k] as f64 / c as f64 * d_c + du) * f64::from(1u32 << guard_bits);
                        let most = f64::from(1u32 << 31) * f64::from(1u32 << guard_bits);
                        scaled.clamp(-most, most - 1.0).round() as i64
                    };
                    of(lane(random, 0), lane(random, 1), (d_c * f64::from(1u32 << guard_bits)).round() as i64)
                }
            });
        }
        Self { vertex: of(lanes[0], lanes[1], c), differences, guard_bits, axes }
    }
}

/// What F may lack: four mantissas, and a unit a step.
const RELATIVE: f64 = 1.0 / 16384.0;
const UNITS: f64 = 2.0;

#[test]
fn exact_footprint_is_below_by_at_most_its_bound() {
    let mut random = Random(7);
    let (mut worst, mut octaves, mut near, mut seen) = (0.0f64, 0.0f64, 0, [0; 16]);
    for number in 0..4_000_000 {
        let case = Case::any(&mut random);
        let (got, exact) = (case.golden(), case.true_value() * 65536.0);
        let units = f64::from(got);
        // f64 rounds, and saturation takes what is above.
        assert!(units <= exact * (1.0 + 1e-12), "{number}: {case:?} {got} {exact}");
        let most = exact.min(u32::MAX.into());
        assert!(units > most * (1.0 - RELATIVE) - UNITS, "{number}: {case:?} {got} {exact}");
        let levels = 1 + random.below(16) as u32;
        let l = level(got, levels);
        seen[l as usize] += 1;
        let by = |units: f64| level(units.min(u32::MAX.into()) as u32, levels);
        if l != by(exact) {
            near += 1;
            assert_eq!(l, by(exact * (1.0 - RELATIVE) - UNITS), "{number}: {case:?} {got} {exact}");
        }
        if exact <= u32::MAX.into() && exact >= 2f64.powf(16.5) {
            worst = worst.max(1.0 - units / exact);
            octaves = octaves.max((exact / units).log2());
        }
    }
    println!(
        "seed 7: below by {worst:.2e} = {octaves:.2e} octaves, bound {RELATIVE:.2e}; {near} levels lower; {seen:?}"
    );
    assert!(worst > RELATIVE / 2.0 && seen.iter().all(|count| *count > 1000), "{worst:e}, {seen:?}");
}

#[test]
fn exact_footprint_of_f64_is_that_of_the_integers() {
    let mut random = Random(8);
    for number in 0..200_000 {
        let case = Case::any(&mut random);
        let unit = (-f64::from(case.guard_bits)).exp2();
        let differences: Vec<_> = case.differences.iter().map(|d| d.map(|lane| lane as f64 * unit)).collect();
        let got = exact(&case.vertex.map(|lane| lane as f64), &differences, &case.axes);
        // Its terms may cancel.
        let c = case.vertex[lane::C] as f64;
        let term = |d: &Vertex| {
            let most = |k: usize| {
                let texels = f64::from(case.axes[k].texel_bits).exp2() / c * unit;
                (d[lane::U + k].abs() as f64 + (case.vertex[lane::U + k] as f64 / c * d[lane::C] as f64).abs()) * texels
            };
            most(0) + most(1)
        };
        let terms: f64 = case.differences.iter().map(term).sum();
        assert!((got - case.true_value()).abs() <= 1e-15 * terms, "{number}: {case:?}");
    }
}

#[test]
fn exact_footprint_does_not_depend_on_the_unit_or_the_period() {
    let mut random = Random(9);
    let (mut shifted, mut turned) = (0, 0);
    for _ in 0..500_000 {
        let case = Case::any(&mut random);
        let f = case.golden();
        let minus = |d: &Vertex| d.map(|lane| -lane);
        assert_eq!(Case { differences: case.differences.iter().map(minus).collect(), ..case.clone() }.golden(), f);
        let reversed = Case { differences: case.differences.iter().rev().copied().collect(), ..case.clone() };
        assert_eq!(reversed.golden(), f);
        // Lanes of fewer bits, as narrow width sets have them, and what fills them up.
        if case.vertex.iter().all(|lane| lane.abs() < 1 << 23) {
            let up = |vertex: &Vertex| vertex.map(|lane| lane << 8);
            let differences = case.differences.iter().map(up).collect();
            assert_eq!(Case { vertex: up(&case.vertex), differences, ..case.clone() }.golden(), f);
            shifted += 1;
        }
        // The other side of a seam: u a half of 2^texel_bits texels further on.
        let even = case.vertex[lane::C] % 2 == 0 && case.differences.iter().all(|d| d[lane::C] % 2 == 0);
        if even {
            let mut over = case.clone();
            over.vertex[lane::U] += over.vertex[lane::C] / 2;
            over.differences.iter_mut().for_each(|d| d[lane::U] += d[lane::C] / 2);
            assert_eq!(over.golden(), f);
            turned += 1;
        }
    }
    assert!(shifted > 100_000 && turned > 50_000, "{shifted} {turned}");
}

#[test]
fn exact_footprint_of_what_is_known() {
    let axis = |texel_bits| Axis { size: 512, repeat: false, texel_bits };
    let half = 1 << 30;
    let with = |differences: &[Vertex], guard_bits, c| {
        let (differences, axes) = (differences.to_vec(), [axis(9), axis(8)]);
        Case { vertex: of(64 << 22, 0, c), differences, guard_bits, axes }.golden()
    };
    let step = of(1 << 20, 0, 0);
    assert_eq!(with(&[step], 0, half), 0x7fff);
    assert_eq!(with(&[step, step], 0, half), 0xfffe);
    // The larger axis counts: 2^23 of v is 2 texels, with 13 bits more as with none.
    assert_eq!(with(&[of(1 << 20, 1 << 23, 0)], 0, half), 0x1_fffe);
    assert_eq!(with(&[of(1 << 33, 1 << 36, 0)], 13, half), 0x1_fffe);
    // Without a step there is no footprint; one of c alone moves u = 1/4, and steps whose texels stand still do not.
    assert_eq!(with(&[], 0, half), 0);
    assert_eq!(with(&[[0; MAX_COMPONENTS]; 2], 13, half), 0);
    assert_eq!(with(&[of(0, 0, 1 << 20)], 0, half), 0x1fff);
    assert_eq!(with(&[of(1 << 18, 0, 1 << 20)], 0, half), 0);
    // The ends of the formats: saturated, for each step and for both; below 1 unit c counts as 1.
    let least = of(-(1 << 48), -(1 << 48), -(1 << 48));
    assert_eq!(with(&[least, least], 16, 1), u32::MAX);
    assert_eq!(with(&[step, step], 0, 1), u32::MAX);
    assert_eq!(with(&[of(3 << 29, 0, 0), of(1 << 13, 0, 0)], 0, 1 << 22), u32::MAX);
    assert_eq!([with(&[step], 13, 0), with(&[step], 13, -5)], [with(&[step], 13, 1); 2]);
    assert_eq!(with(&[of(0, 0, 1)], 16, (1 << 31) - 1), 0);
}
