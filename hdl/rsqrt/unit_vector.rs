// SPDX-License-Identifier: MIT OR Apache-2.0
//! A vector of the right length for the root, to length 1.
//!
//! `n = v / |v|`
//!
//! | port       | format        | meaning |   Latency 33, interval 1; holds while `go` is low
//! | components | 3 x signed 18 | magnitudes of at most 2^16, and of 2^15 or more for the longest; or zero |
//! | unit       | 3 x SQ1.16    | 1.0 is representable; zero stays zero |   Golden: models::rsqrt::unit
//!
//! | stage           | operation                                     | width |
//! | s1 .. s4_square | the sum of the squares                        | at most 3 2^32: 34 bits |
//! | s5_square       | two bits less if it has 33 or 34              | UQ2.30, [1, 4) |
//! | s6 .. s28       | its reciprocal root                           | UQ0.32 |
//! | s29 .. s32_unit | components times root                         | signed 50, of which the upper 33 matter |
//! | s33_unit        | rounded half up                               | SQ1.16 |
//!
//! Its casts are none that the root has, too: Verilator 5.006 would take the one for the other where a block has two of these.

use super::InverseRoot;
use crate::pipeline::{DspProduct, LongDelay};
use crate::prelude::*;

/// Vector over its length.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct UnitVector {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub components: Input<Lanes<3, 18>>,
    pub unit: Output<Lanes<3, 18>>,
    s3_x: DspProduct<18, 18, 36>,
    s3_y: DspProduct<18, 18, 36>,
    s3_z: DspProduct<18, 18, 36>,
    s4_square: DataRegister<S<36>>,
    s5_square: DataRegister<U<32>>,
    s5_wide: DataRegister<Bit>,
    inverse: InverseRoot,
    s28_short: LongDelay<54, 8, 10, 10>,
    s32_wide: LongDelay<1, 7, 10, 10>,
    s31_x_low: DspProduct<18, 18, 36>,
    s31_x_high: DspProduct<18, 18, 36>,
    s31_y_low: DspProduct<18, 18, 36>,
    s31_y_high: DspProduct<18, 18, 36>,
    s31_z_low: DspProduct<18, 18, 36>,
    s31_z_high: DspProduct<18, 18, 36>,
    s32_unit: DataRegister<Lanes<3, 36>>,
    s33_unit: DataRegister<Lanes<3, 18>>,
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
    one_unit: Constant<Lanes<3, 36>>,
}

impl Default for UnitVector {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            components: Input::default(),
            unit: Output::default(),
            s3_x: DspProduct::default(),
            s3_y: DspProduct::default(),
            s3_z: DspProduct::default(),
            s4_square: DataRegister::default(),
            s5_square: DataRegister::default(),
            s5_wide: DataRegister::default(),
            inverse: InverseRoot::default(),
            s28_short: LongDelay::default(),
            s32_wide: LongDelay::default(),
            s31_x_low: DspProduct::default(),
            s31_x_high: DspProduct::default(),
            s31_y_low: DspProduct::default(),
            s31_y_high: DspProduct::default(),
            s31_z_low: DspProduct::default(),
            s31_z_high: DspProduct::default(),
            s32_unit: DataRegister::default(),
            s33_unit: DataRegister::default(),
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
            one_unit: Constant::new(Lanes::new([1; 3])),
        }
    }
}

impl UnitVector {
    /// Cycles from vector to unit vector.
    pub const LATENCY: usize = 33;
}

impl Logic for UnitVector {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self, clock, s3_x, s3_y, s3_z, inverse, s28_short, s32_wide, s31_x_low, s31_x_high, s31_y_low, s31_y_high,
            s31_z_low, s31_z_high
        );
        dff_setup!(self, clock, s4_square, s5_square, s5_wide, s32_unit, s33_unit);
        self.unit.next = self.s33_unit.q.val();

        // s1 to s5
        self.short_x.next = self.components.val().get_bit(0);
        self.short_y.next = self.components.val().get_bit(1);
        self.short_z.next = self.components.val().get_bit(2);
        self.s3_x.go.next = self.go.val();
        self.s3_x.a.next = self.short_x.val();
        self.s3_x.b.next = self.short_x.val();
        self.s3_y.go.next = self.go.val();
        self.s3_y.a.next = self.short_y.val();
        self.s3_y.b.next = self.short_y.val();
        self.s3_z.go.next = self.go.val();
        self.s3_z.a.next = self.short_z.val();
        self.s3_z.b.next = self.short_z.val();
        self.wide.next = self.s4_square.q.val().get_bits::<2>(32).any();

        // s6 to s28
        self.inverse.go.next = self.go.val();
        self.inverse.number.next = self.s5_square.q.val();
        self.s28_short.go.next = self.go.val();
        self.s28_short.value.next = bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_x.val()))
            | (bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_y.val())) << 18)
            | (bit_cast_to::<U<54>>(bit_cast_to::<U<18>>(self.short_z.val())) << 36);
        self.s32_wide.go.next = self.go.val();
        self.s32_wide.value.next = bit_cast_to::<U<1>>(self.s5_wide.q.val());

        // s29 to s32
        self.late_x.next = bit_cast_to::<S<18>>(self.s28_short.delayed.val().get_bits::<18>(0));
        self.late_y.next = bit_cast_to::<S<18>>(self.s28_short.delayed.val().get_bits::<18>(18));
        self.late_z.next = bit_cast_to::<S<18>>(self.s28_short.delayed.val().get_bits::<18>(36));
        self.root_low.next = bit_cast_to::<S<18>>(self.inverse.root.val() & 0x1_ffff);
        self.root_high.next = bit_cast_to::<S<18>>(self.inverse.root.val() >> 17);
        self.s31_x_low.go.next = self.go.val();
        self.s31_x_low.a.next = self.late_x.val();
        self.s31_x_low.b.next = self.root_low.val();
        self.s31_x_high.go.next = self.go.val();
        self.s31_x_high.a.next = self.late_x.val();
        self.s31_x_high.b.next = self.root_high.val();
        self.s31_y_low.go.next = self.go.val();
        self.s31_y_low.a.next = self.late_y.val();
        self.s31_y_low.b.next = self.root_low.val();
        self.s31_y_high.go.next = self.go.val();
        self.s31_y_high.a.next = self.late_y.val();
        self.s31_y_high.b.next = self.root_high.val();
        self.s31_z_low.go.next = self.go.val();
        self.s31_z_low.a.next = self.late_z.val();
        self.s31_z_low.b.next = self.root_low.val();
        self.s31_z_high.go.next = self.go.val();
        self.s31_z_high.a.next = self.late_z.val();
        self.s31_z_high.b.next = self.root_high.val();
        self.unit_x.next =
            bit_cast_to::<S<36>>(self.s31_x_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s31_x_high.p.val());
        self.unit_y.next =
            bit_cast_to::<S<36>>(self.s31_y_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s31_y_high.p.val());
        self.unit_z.next =
            bit_cast_to::<S<36>>(self.s31_z_low.p.val() >> 17) + bit_cast_to::<S<36>>(self.s31_z_high.p.val());
        self.units_x.next = bit_cast_to::<Lanes<3, 36>>(self.unit_x.val());
        self.units_y.next = self.units_x.val().replace_bit(1, self.unit_y.val());
        self.units.next = self.units_y.val().replace_bit(2, self.unit_z.val());

        // s33: 31 bits behind the point of the root, or 32, of which 17 are gone and one is the half.
        self.half_units.next = self.s32_unit.q.val() >> 13;
        if self.s32_wide.delayed.val().any() {
            self.half_units.next = self.s32_unit.q.val() >> 14;
        }

        if self.go.val() {
            self.s4_square.d.next = bit_cast_to::<S<36>>(self.s3_x.p.val())
                + bit_cast_to::<S<36>>(self.s3_y.p.val())
                + bit_cast_to::<S<36>>(self.s3_z.p.val());
            self.s5_wide.d.next = self.wide.val();
            self.s5_square.d.next = self.s4_square.q.val().get_bits::<32>(0);
            if self.wide.val() {
                self.s5_square.d.next = self.s4_square.q.val().get_bits::<32>(2);
            }
            self.s32_unit.d.next = self.units.val();
            self.s33_unit.d.next = bit_cast_to::<Lanes<3, 18>>((self.half_units.val() + self.one_unit.val()) >> 1);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("unit_vector")
    }
}

latches! { [] UnitVector: s3_x, s3_y, s3_z, inverse, s28_short, s32_wide, s31_x_low, s31_x_high, s31_y_low, s31_y_high, s31_z_low, s31_z_high, s4_square, s5_square, s5_wide, s32_unit, s33_unit }
