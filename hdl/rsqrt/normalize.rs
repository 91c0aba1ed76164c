// SPDX-License-Identifier: MIT OR Apache-2.0
//! A vector to length 1.
//!
//! `n = v / |v|`, of the 16 leading bits of the longest component; a common positive factor changes nothing but rounding
//!
//! | port   | format        | meaning |   Latency 43, interval 1; holds while `go` is low
//! | components | 3 x signed 32 | |   Golden: models::rsqrt::normalize
//! | unit   | 3 x SQ1.16    | 1.0 is representable; the zero vector stays what it is |
//!
//! | stage          | operation                                     | width |
//! | s1_size        | absolute values                               | 32 bits |
//! | s2_any         | their OR, as long as the longest              | 32 bits |
//! | s3 .. s7       | its leading zeros                             | |
//! | s8, s9_long    | the vector shifted left by them               | signed 33 |
//! | s10_short       | its 16 upper bits, rounded half up            | at most 2^16: signed 18 |
//! | s11 .. s14_square | the sum of their squares                      | at most 3 2^32: 34 bits |
//! | s15_square     | two bits less if it has 33 or 34              | UQ2.30, [1, 4) |
//! | s16 .. s38     | its reciprocal root                           | UQ0.32 |
//! | s39 .. s42_unit | components times root                         | signed 50, of which the upper 33 matter |
//! | s43_unit       | rounded half up                               | SQ1.16 |

use super::InverseRoot;
use crate::pipeline::{DspProduct, Leading, LongDelay};
use crate::prelude::*;

/// Normaliser of vectors.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Normalize {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub components: Input<Lanes<3, 32>>,
    pub unit: Output<Lanes<3, 18>>,
    s1_size_x: DataRegister<U<32>>,
    s1_size_y: DataRegister<U<32>>,
    s1_size_z: DataRegister<U<32>>,
    s1_vector: DataRegister<Lanes<3, 32>>,
    s2_any: DataRegister<U<48>>,
    s2_vector: DataRegister<Lanes<3, 32>>,
    leading: Leading,
    s3_vector: DataRegister<Lanes<3, 32>>,
    s4_vector: DataRegister<Lanes<3, 32>>,
    s5_vector: DataRegister<Lanes<3, 32>>,
    s6_vector: DataRegister<Lanes<3, 32>>,
    s7_vector: DataRegister<Lanes<3, 32>>,
    s8_long: DataRegister<Lanes<3, 33>>,
    s8_fine: DataRegister<U<5>>,
    s9_long: DataRegister<Lanes<3, 33>>,
    s10_short: DataRegister<Lanes<3, 18>>,
    s13_x: DspProduct<18, 18, 36>,
    s13_y: DspProduct<18, 18, 36>,
    s13_z: DspProduct<18, 18, 36>,
    s14_square: DataRegister<U<34>>,
    s15_square: DataRegister<U<32>>,
    s15_wide: DataRegister<Bit>,
    inverse: InverseRoot,
    s38_short: LongDelay<54, 8, 10, 10>,
    s42_wide: LongDelay<1, 7, 10, 10>,
    s41_x_low: DspProduct<18, 18, 36>,
    s41_x_high: DspProduct<18, 18, 36>,
    s41_y_low: DspProduct<18, 18, 36>,
    s41_y_high: DspProduct<18, 18, 36>,
    s41_z_low: DspProduct<18, 18, 36>,
    s41_z_high: DspProduct<18, 18, 36>,
    s42_unit: DataRegister<Lanes<3, 36>>,
    s43_unit: DataRegister<Lanes<3, 18>>,
    vector_x: Wire<S<32>>,
    vector_y: Wire<S<32>>,
    vector_z: Wire<S<32>>,
    size_x: Wire<S<32>>,
    size_y: Wire<S<32>>,
    size_z: Wire<S<32>>,
    zeros: Wire<U<5>>,
    coarse: Wire<U<5>>,
    wide: Wire<Bit>,
    short_x: Wire<S<18>>,
    short_y: Wire<S<18>>,
    short_z: Wire<S<18>>,
    late_x: Wire<S<18>>,
    late_y: Wire<S<18>>,
    late_z: Wire<S<18>>,
    root_low: Wire<S<18>>,
    root_high: Wire<S<18>>,
    unit_x: Wire<S<36>>,
    unit_y: Wire<S<36>>,
    unit_z: Wire<S<36>>,
    units_x: Wire<Lanes<3, 36>>,
    units_y: Wire<Lanes<3, 36>>,
    units: Wire<Lanes<3, 36>>,
    half_units: Wire<Lanes<3, 36>>,
    one: Constant<Lanes<3, 33>>,
    one_unit: Constant<Lanes<3, 36>>,
}

impl Default for Normalize {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            components: Input::default(),
            unit: Output::default(),
            s1_size_x: DataRegister::default(),
            s1_size_y: DataRegister::default(),
            s1_size_z: DataRegister::default(),
            s1_vector: DataRegister::default(),
            s2_any: DataRegister::default(),
            s2_vector: DataRegister::default(),
            leading: Leading::default(),
            s3_vector: DataRegister::default(),
            s4_vector: DataRegister::default(),
            s5_vector: DataRegister::default(),
            s6_vector: DataRegister::default(),
            s7_vector: DataRegister::default(),
            s8_long: DataRegister::default(),
            s8_fine: DataRegister::default(),
            s9_long: DataRegister::default(),
            s10_short: DataRegister::default(),
            s13_x: DspProduct::default(),
            s13_y: DspProduct::default(),
            s13_z: DspProduct::default(),
            s14_square: DataRegister::default(),
            s15_square: DataRegister::default(),
            s15_wide: DataRegister::default(),
            inverse: InverseRoot::default(),
            s38_short: LongDelay::default(),
            s42_wide: LongDelay::default(),
            s41_x_low: DspProduct::default(),
            s41_x_high: DspProduct::default(),
            s41_y_low: DspProduct::default(),
            s41_y_high: DspProduct::default(),
            s41_z_low: DspProduct::default(),
            s41_z_high: DspProduct::default(),
            s42_unit: DataRegister::default(),
            s43_unit: DataRegister::default(),
            vector_x: Wire::default(),
            vector_y: Wire::default(),
            vector_z: Wire::default(),
            size_x: Wire::default(),
            size_y: Wire::default(),
            size_z: Wire::default(),
            zeros: Wire::default(),
            coarse: Wire::default(),
            wide: Wire::default(),
            short_x: Wire::default(),
            short_y: Wire::default(),
            short_z: Wire::default(),
            late_x: Wire::default(),
            late_y: Wire::default(),
            late_z: Wire::default(),
            root_low: Wire::default(),
            root_high: Wire::default(),
            unit_x: Wire::default(),
            unit_y: Wire::default(),
            unit_z: Wire::default(),
            units_x: Wire::default(),
            units_y: Wire::default(),
            units: Wire::default(),
            half_units: Wire::default(),
            one: Constant::new(Lanes::new([1; 3])),
            one_unit: Constant::new(Lanes::new([1; 3])),
        }
    }
}

impl Normalize {
    /// Cycles from vector to unit vector.
    pub const LATENCY: usize = 43;
}

impl Logic for Normalize {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, leading, s13_x, s13_y, s13_z, inverse, s38_short, s42_wide);
        clock!(self, clock, s41_x_low, s41_x_high, s41_y_low, s41_y_high, s41_z_low, s41_z_high);
        dff_setup!(self, clock, s1_size_x, s1_size_y, s1_size_z, s1_vector, s2_any, s2_vector, s3_vector, s4_vector);
        dff_setup!(
            self, clock, s5_vector, s6_vector, s7_vector, s8_long, s8_fine, s9_long, s10_short, s14_square, s15_square,
            s15_wide
        );
        dff_setup!(self, clock, s42_unit, s43_unit);
        self.unit.next = self.s43_unit.q.val();

        // s1: the minimum becomes itself, which is right without a sign.
        self.vector_x.next = self.components.val().get_bit(0);
        self.vector_y.next = self.components.val().get_bit(1);
        self.vector_z.next = self.components.val().get_bit(2);
        self.size_x.next = self.vector_x.val();
        if self.vector_x.val() < 0 {
            self.size_x.next = -self.vector_x.val();
        }
        self.size_y.next = self.vector_y.val();
        if self.vector_y.val() < 0 {
            self.size_y.next = -self.vector_y.val();
        }
        self.size_z.next = self.vector_z.val();
        if self.vector_z.val() < 0 {
            self.size_z.next = -self.vector_z.val();
        }

        // s8: 16 of the 48 bits are always zero, so the shift is zeros - 16.
        self.leading.go.next = self.go.val();
        self.leading.value.next = self.s2_any.q.val();
        self.zeros.next = bit_cast_to::<U<5>>(self.leading.zeros.val()) ^ 0x10;
        self.coarse.next = self.zeros.val() & 0x18;

        // s11 to s15
        self.short_x.next = self.s10_short.q.val().get_bit(0);
        self.short_y.next = self.s10_short.q.val().get_bit(1);
        self.short_z.next = self.s10_short.q.val().get_bit(2);
        self.s13_x.go.next = self.go.val();
        self.s13_x.a.next = self.short_x.val();
        self.s13_x.b.next = self.short_x.val();
        self.s13_y.go.next = self.go.val();
        self.s13_y.a.next = self.short_y.val();
        self.s13_y.b.next = self.short_y.val();
        self.s13_z.go.next = self.go.val();
        self.s13_z.a.next = self.short_z.val();
        self.s13_z.b.next = self.short_z.val();
        self.wide.next = self.s14_square.q.val().get_bits::<2>(32).any();

        // s16 to s38
        self.inverse.go.next = self.go.val();
        self.inverse.number.next = self.s15_square.q.val();
        self.s38_short.go.next = self.go.val();
        self.s38_short.value.next = bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_x.val()))
            | (bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_y.val())) << 18)
            | (bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_z.val())) << 36);
        self.s42_wide.go.next = self.go.val();
        self.s42_wide.value.next = bit_cast_to::<U<1>>(self.s15_wide.q.val());

        // s39 to s42
        self.late_x.next = bit_cast_to::<S<18>>(self.s38_short.delayed.val().get_bits::<18>(0));
        self.late_y.next = bit_cast_to::<S<18>>(self.s38_short.delayed.val().get_bits::<18>(18));
        self.late_z.next = bit_cast_to::<S<18>>(self.s38_short.delayed.val().get_bits::<18>(36));
        self.root_low.next = bit_cast_to::<S<18>>(self.inverse.root.val().get_bits::<17>(0));
        self.root_high.next = bit_cast_to::<S<18>>(self.inverse.root.val().get_bits::<15>(17));
        self.s41_x_low.go.next = self.go.val();
        self.s41_x_low.a.next = self.late_x.val();
        self.s41_x_low.b.next = self.root_low.val();
        self.s41_x_high.go.next = self.go.val();
        self.s41_x_high.a.next = self.late_x.val();
        self.s41_x_high.b.next = self.root_high.val();
        self.s41_y_low.go.next = self.go.val();
        self.s41_y_low.a.next = self.late_y.val();
        self.s41_y_low.b.next = self.root_low.val();
        self.s41_y_high.go.next = self.go.val();
        self.s41_y_high.a.next = self.late_y.val();
        self.s41_y_high.b.next = self.root_high.val();
        self.s41_z_low.go.next = self.go.val();
        self.s41_z_low.a.next = self.late_z.val();
        self.s41_z_low.b.next = self.root_low.val();
        self.s41_z_high.go.next = self.go.val();
        self.s41_z_high.a.next = self.late_z.val();
        self.s41_z_high.b.next = self.root_high.val();
        self.unit_x.next =
            bit_cast_to::<S<36>>(self.s41_x_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s41_x_high.p.val());
        self.unit_y.next =
            bit_cast_to::<S<36>>(self.s41_y_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s41_y_high.p.val());
        self.unit_z.next =
            bit_cast_to::<S<36>>(self.s41_z_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s41_z_high.p.val());
        self.units_x.next = bit_cast_to::<Lanes<3, 36>>(self.unit_x.val());
        self.units_y.next = self.units_x.val().replace_bit(1, self.unit_y.val());
        self.units.next = self.units_y.val().replace_bit(2, self.unit_z.val());

        // s43: 31 bits behind the point of the root, or 32, of which 17 are gone and one is the half.
        self.half_units.next = self.s42_unit.q.val() >> 13;
        if self.s42_wide.delayed.val().any() {
            self.half_units.next = self.s42_unit.q.val() >> 14;
        }

        if self.go.val() {
            self.s1_size_x.d.next = bit_cast_to::<U<32>>(self.size_x.val());
            self.s1_size_y.d.next = bit_cast_to::<U<32>>(self.size_y.val());
            self.s1_size_z.d.next = bit_cast_to::<U<32>>(self.size_z.val());
            self.s1_vector.d.next = self.components.val();
            self.s2_any.d.next =
                bit_cast_to::<U<48>>(self.s1_size_x.q.val() | self.s1_size_y.q.val() | self.s1_size_z.q.val());
            self.s2_vector.d.next = self.s1_vector.q.val();
            self.s3_vector.d.next = self.s2_vector.q.val();
            self.s4_vector.d.next = self.s3_vector.q.val();
            self.s5_vector.d.next = self.s4_vector.q.val();
            self.s6_vector.d.next = self.s5_vector.q.val();
            self.s7_vector.d.next = self.s6_vector.q.val();
            self.s8_long.d.next = bit_cast_to::<Lanes<3, 33>>(self.s7_vector.q.val()) << self.coarse.val();
            self.s8_fine.d.next = self.zeros.val() & 0x07;
            self.s9_long.d.next = self.s8_long.q.val() << self.s8_fine.q.val();
            self.s10_short.d.next = bit_cast_to::<Lanes<3, 18>>(((self.s9_long.q.val() >> 15) + self.one.val()) >> 1);
            self.s14_square.d.next = bit_cast_to::<U<34>>(self.s13_x.p.val())
                + bit_cast_to::<U<34>>(self.s13_y.p.val())
                + bit_cast_to::<U<34>>(self.s13_z.p.val());
            self.s15_wide.d.next = self.wide.val();
            self.s15_square.d.next = self.s14_square.q.val().get_bits::<32>(0);
            if self.wide.val() {
                self.s15_square.d.next = self.s14_square.q.val().get_bits::<32>(2);
            }
            self.s42_unit.d.next = self.units.val();
            self.s43_unit.d.next = bit_cast_to::<Lanes<3, 18>>((self.half_units.val() + self.one_unit.val()) >> 1);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("normalize")
    }
}

ports! {
    [] Normalize {
        inputs: go, components;
        outputs: unit;
        blocks: leading, inverse, s38_short, s42_wide;
        state: leading, s13_x, s13_y, s13_z, inverse, s38_short, s42_wide, s41_x_low, s41_x_high, s41_y_low, s41_y_high, s41_z_low, s41_z_high, s1_size_x, s1_size_y, s1_size_z, s1_vector, s2_any, s2_vector, s3_vector, s4_vector, s5_vector, s6_vector, s7_vector, s8_long, s8_fine, s9_long, s10_short, s14_square, s15_square, s15_wide, s42_unit, s43_unit
    }
}
