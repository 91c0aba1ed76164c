// SPDX-License-Identifier: MIT OR Apache-2.0
//! A long vector to one of 16 bits, for [`UnitVector`](super::UnitVector).
//!
//! `shortened = v / 2^(length - 16)` rounded half up; v = +-(2^16 along_x, 2^16 along_y, along_z), and its longest component has
//! `length` bits
//!
//! | port  | format        | meaning |   Latency 15, interval 1; holds while `go` is low
//! | along_x, along_y | signed 54 | not the minimum |
//! | along_z | signed 92   | not the minimum |
//! | flip  | Bit           | -v instead of v |
//! | shortened | 3 x signed 18 | the zero vector becomes (0, 0, -2^15) |   Golden: models::rsqrt::normalize_wide
//!
//! | stage         | operation                                       | width |
//! | s1, s2        | -v, of z first the lower half                   | |
//! | s3            | v or -v, and absolute values                    | 53 and 91 bits |
//! | s4_any        | their OR, as long as the longest                | 91 bits |
//! | s5_upper      | whether it has more than 45 bits                | |
//! | s6            | v shifted left by 46 if not, and its upper part | 63 bits are left: 45 to shift away, 17 and sign |
//! | s7 .. s11     | leading zeros of the upper or lower part        | at most 45; 63 of zero |
//! | s12 .. s14    | shifted left by them                            | 33, 21, 18 bits |
//! | s15_short     | rounded half up                                 | at most 2^16: signed 18 |

use crate::pipeline::{Delay, Leading};
use crate::prelude::*;

/// Shortener of vectors.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Shorten {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub along_x: Input<S<54>>,
    pub along_y: Input<S<54>>,
    pub along_z: Input<WideS<92>>,
    pub flip: Input<Bit>,
    pub shortened: Output<Lanes<3, 18>>,
    s1_x: DataRegister<S<54>>,
    s1_y: DataRegister<S<54>>,
    s1_z: DataRegister<WideS<92>>,
    s1_flip: DataRegister<Bit>,
    s1_minus_x: DataRegister<S<54>>,
    s1_minus_y: DataRegister<S<54>>,
    /// 46 bits and a carry.
    s1_minus_low: DataRegister<U<47>>,
    s2_x: DataRegister<S<54>>,
    s2_y: DataRegister<S<54>>,
    s2_z: DataRegister<WideS<92>>,
    s2_flip: DataRegister<Bit>,
    s2_minus_x: DataRegister<S<54>>,
    s2_minus_y: DataRegister<S<54>>,
    s2_minus_z: DataRegister<WideS<92>>,
    s3_x: DataRegister<S<54>>,
    s3_y: DataRegister<S<54>>,
    s3_z: DataRegister<WideS<92>>,
    s3_size_x: DataRegister<U<53>>,
    s3_size_y: DataRegister<U<53>>,
    s3_size_z: DataRegister<WideU<91>>,
    s4_x: DataRegister<S<54>>,
    s4_y: DataRegister<S<54>>,
    s4_z: DataRegister<WideS<92>>,
    s4_any: DataRegister<WideU<91>>,
    s5_x: DataRegister<S<54>>,
    s5_y: DataRegister<S<54>>,
    s5_z: DataRegister<WideS<92>>,
    s5_any: DataRegister<WideU<91>>,
    s5_upper: DataRegister<Bit>,
    s6_x: DataRegister<S<63>>,
    s6_y: DataRegister<S<63>>,
    s6_z: DataRegister<S<63>>,
    s6_any: DataRegister<U<48>>,
    s11_leading: Leading,
    s11_x: Delay<63, 5>,
    s11_y: Delay<63, 5>,
    s11_z: Delay<63, 5>,
    s12_long: DataRegister<Lanes<3, 33>>,
    s12_zeros: DataRegister<U<6>>,
    s13_long: DataRegister<Lanes<3, 21>>,
    s13_zeros: DataRegister<U<6>>,
    s14_long: DataRegister<Lanes<3, 19>>,
    s14_zero: DataRegister<Bit>,
    s15_short: DataRegister<Lanes<3, 18>>,
    carried: Wire<U<46>>,
    size_x: Wire<S<54>>,
    size_y: Wire<S<54>>,
    size_z: Wire<WideS<92>>,
    wide_x: Wire<S<63>>,
    wide_y: Wire<S<63>>,
    wide_z: Wire<S<63>>,
    late_x: Wire<Lanes<3, 63>>,
    late_y: Wire<Lanes<3, 63>>,
    late: Wire<Lanes<3, 63>>,
    z_late: Wire<S<63>>,
    y_late: Wire<S<63>>,
    x_late: Wire<S<63>>,
    coarse: Wire<U<6>>,
    middle: Wire<U<6>>,
    fine: Wire<U<6>>,
    zero: Wire<Bit>,
    one: Constant<Lanes<3, 19>>,
    towards_the_eye: Constant<Lanes<3, 18>>,
}

impl Default for Shorten {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            along_x: Input::default(),
            along_y: Input::default(),
            along_z: Input::default(),
            flip: Input::default(),
            shortened: Output::default(),
            s1_x: DataRegister::default(),
            s1_y: DataRegister::default(),
            s1_z: DataRegister::default(),
            s1_flip: DataRegister::default(),
            s1_minus_x: DataRegister::default(),
            s1_minus_y: DataRegister::default(),
            s1_minus_low: DataRegister::default(),
            s2_x: DataRegister::default(),
            s2_y: DataRegister::default(),
            s2_z: DataRegister::default(),
            s2_flip: DataRegister::default(),
            s2_minus_x: DataRegister::default(),
            s2_minus_y: DataRegister::default(),
            s2_minus_z: DataRegister::default(),
            s3_x: DataRegister::default(),
            s3_y: DataRegister::default(),
            s3_z: DataRegister::default(),
            s3_size_x: DataRegister::default(),
            s3_size_y: DataRegister::default(),
            s3_size_z: DataRegister::default(),
            s4_x: DataRegister::default(),
            s4_y: DataRegister::default(),
            s4_z: DataRegister::default(),
            s4_any: DataRegister::default(),
            s5_x: DataRegister::default(),
            s5_y: DataRegister::default(),
            s5_z: DataRegister::default(),
            s5_any: DataRegister::default(),
            s5_upper: DataRegister::default(),
            s6_x: DataRegister::default(),
            s6_y: DataRegister::default(),
            s6_z: DataRegister::default(),
            s6_any: DataRegister::default(),
            s11_leading: Leading::default(),
            s11_x: Delay::default(),
            s11_y: Delay::default(),
            s11_z: Delay::default(),
            s12_long: DataRegister::default(),
            s12_zeros: DataRegister::default(),
            s13_long: DataRegister::default(),
            s13_zeros: DataRegister::default(),
            s14_long: DataRegister::default(),
            s14_zero: DataRegister::default(),
            s15_short: DataRegister::default(),
            carried: Wire::default(),
            size_x: Wire::default(),
            size_y: Wire::default(),
            size_z: Wire::default(),
            wide_x: Wire::default(),
            wide_y: Wire::default(),
            wide_z: Wire::default(),
            late_x: Wire::default(),
            late_y: Wire::default(),
            late: Wire::default(),
            z_late: Wire::default(),
            y_late: Wire::default(),
            x_late: Wire::default(),
            coarse: Wire::default(),
            middle: Wire::default(),
            fine: Wire::default(),
            zero: Wire::default(),
            one: Constant::new(Lanes::new([1; 3])),
            towards_the_eye: Constant::new(Lanes::new([0, 0, -1 << 15])),
        }
    }
}

impl Shorten {
    /// Cycles from vector to short vector.
    pub const LATENCY: usize = 15;
}

impl Logic for Shorten {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s11_leading, s11_x, s11_y, s11_z);
        dff_setup!(
            self,
            clock,
            s1_x,
            s1_y,
            s1_z,
            s1_flip,
            s1_minus_x,
            s1_minus_y,
            s1_minus_low,
            s2_x,
            s2_y,
            s2_z,
            s2_flip,
            s2_minus_x,
            s2_minus_y,
            s2_minus_z,
            s3_x,
            s3_y,
            s3_z,
            s3_size_x,
            s3_size_y,
            s3_size_z,
            s4_x,
            s4_y,
            s4_z,
            s4_any,
            s5_x,
            s5_y,
            s5_z,
            s5_any,
            s5_upper,
            s6_x,
            s6_y,
            s6_z,
            s6_any,
            s12_long,
            s12_zeros,
            s13_long,
            s13_zeros,
            s14_long,
            s14_zero,
            s15_short
        );
        self.shortened.next = self.s15_short.q.val();

        // s2, s3
        self.carried.next = bit_cast_to::<U<46>>(!(self.s1_z.q.val() >> 46))
            + bit_cast_to::<U<46>>(self.s1_minus_low.q.val().get_bit(46));
        self.size_x.next = self.s2_x.q.val();
        if self.s2_x.q.val() < 0 {
            self.size_x.next = self.s2_minus_x.q.val();
        }
        self.size_y.next = self.s2_y.q.val();
        if self.s2_y.q.val() < 0 {
            self.size_y.next = self.s2_minus_y.q.val();
        }
        self.size_z.next = self.s2_z.q.val();
        if self.s2_z.q.val() < 0 {
            self.size_z.next = self.s2_minus_z.q.val();
        }

        // s6: of 92 bits the upper 63, or those that come there from 46 places below.
        self.wide_x.next = bit_cast_to::<S<63>>(self.s5_x.q.val());
        self.wide_y.next = bit_cast_to::<S<63>>(self.s5_y.q.val());
        self.wide_z.next = bit_cast_to::<S<63>>(self.s5_z.q.val());

        // s7 to s14
        self.s11_leading.go.next = self.go.val();
        self.s11_leading.value.next = self.s6_any.q.val();
        self.s11_x.go.next = self.go.val();
        self.s11_x.value.next = bit_cast_to::<U<63>>(self.s6_x.q.val());
        self.s11_y.go.next = self.go.val();
        self.s11_y.value.next = bit_cast_to::<U<63>>(self.s6_y.q.val());
        self.s11_z.go.next = self.go.val();
        self.s11_z.value.next = bit_cast_to::<U<63>>(self.s6_z.q.val());
        self.x_late.next = bit_cast_to::<S<63>>(self.s11_x.delayed.val());
        self.y_late.next = bit_cast_to::<S<63>>(self.s11_y.delayed.val());
        self.z_late.next = bit_cast_to::<S<63>>(self.s11_z.delayed.val());
        self.late_x.next = bit_cast_to::<Lanes<3, 63>>(self.x_late.val());
        self.late_y.next = self.late_x.val().replace_bit(1, self.y_late.val());
        self.late.next = self.late_y.val().replace_bit(2, self.z_late.val());
        self.coarse.next = self.s11_leading.zeros.val() & 0x30;
        self.middle.next = self.s12_zeros.q.val() & 0x0c;
        self.fine.next = self.s13_zeros.q.val() & 0x03;
        self.zero.next = self.s13_zeros.q.val().get_bit(5) && self.s13_zeros.q.val().get_bit(4);

        if self.go.val() {
            self.s1_x.d.next = self.along_x.val();
            self.s1_y.d.next = self.along_y.val();
            self.s1_z.d.next = self.along_z.val();
            self.s1_flip.d.next = self.flip.val();
            self.s1_minus_x.d.next = -self.along_x.val();
            self.s1_minus_y.d.next = -self.along_y.val();
            self.s1_minus_low.d.next = bit_cast_to::<U<47>>(bit_cast_to::<U<46>>(!self.along_z.val())) + 1;
            self.s2_x.d.next = self.s1_x.q.val();
            self.s2_y.d.next = self.s1_y.q.val();
            self.s2_z.d.next = self.s1_z.q.val();
            self.s2_flip.d.next = self.s1_flip.q.val();
            self.s2_minus_x.d.next = self.s1_minus_x.q.val();
            self.s2_minus_y.d.next = self.s1_minus_y.q.val();
            self.s2_minus_z.d.next = (bit_cast_to::<WideS<92>>(self.carried.val()) << 46)
                | bit_cast_to::<WideS<92>>(self.s1_minus_low.q.val().get_bits::<46>(0));
            self.s3_x.d.next = self.s2_x.q.val();
            self.s3_y.d.next = self.s2_y.q.val();
            self.s3_z.d.next = self.s2_z.q.val();
            if self.s2_flip.q.val() {
                self.s3_x.d.next = self.s2_minus_x.q.val();
                self.s3_y.d.next = self.s2_minus_y.q.val();
                self.s3_z.d.next = self.s2_minus_z.q.val();
            }
            self.s3_size_x.d.next = bit_cast_to::<U<53>>(self.size_x.val());
            self.s3_size_y.d.next = bit_cast_to::<U<53>>(self.size_y.val());
            self.s3_size_z.d.next = bit_cast_to::<WideU<91>>(self.size_z.val());
            self.s4_x.d.next = self.s3_x.q.val();
            self.s4_y.d.next = self.s3_y.q.val();
            self.s4_z.d.next = self.s3_z.q.val();
            self.s4_any.d.next = (bit_cast_to::<WideU<91>>(self.s3_size_x.q.val() | self.s3_size_y.q.val()) << 16)
                | self.s3_size_z.q.val();
            self.s5_x.d.next = self.s4_x.q.val();
            self.s5_y.d.next = self.s4_y.q.val();
            self.s5_z.d.next = self.s4_z.q.val();
            self.s5_any.d.next = self.s4_any.q.val();
            self.s5_upper.d.next = self.s4_any.q.val().get_bits::<46>(45).any();
            if self.s5_upper.q.val() {
                self.s6_x.d.next = self.wide_x.val() >> 13;
                self.s6_y.d.next = self.wide_y.val() >> 13;
                self.s6_z.d.next = bit_cast_to::<S<63>>(self.s5_z.q.val() >> 29);
                self.s6_any.d.next = self.s5_any.q.val().get_bits::<48>(43);
            } else {
                self.s6_x.d.next = self.wide_x.val() << 33;
                self.s6_y.d.next = self.wide_y.val() << 33;
                self.s6_z.d.next = self.wide_z.val() << 17;
                self.s6_any.d.next = bit_cast_to::<U<48>>(self.s5_any.q.val()) << 3;
            }
            self.s12_long.d.next = bit_cast_to::<Lanes<3, 33>>((self.late.val() << self.coarse.val()) >> 30);
            self.s12_zeros.d.next = self.s11_leading.zeros.val();
            self.s13_long.d.next = bit_cast_to::<Lanes<3, 21>>((self.s12_long.q.val() << self.middle.val()) >> 12);
            self.s13_zeros.d.next = self.s12_zeros.q.val();
            self.s14_long.d.next = bit_cast_to::<Lanes<3, 19>>((self.s13_long.q.val() << self.fine.val()) >> 3);
            self.s14_zero.d.next = self.zero.val();
            self.s15_short.d.next = bit_cast_to::<Lanes<3, 18>>((self.s14_long.q.val() + self.one.val()) >> 1);
            if self.s14_zero.q.val() {
                self.s15_short.d.next = self.towards_the_eye.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("shorten")
    }
}

latches! { [] Shorten: s11_leading, s11_x, s11_y, s11_z, s1_x, s1_y, s1_z, s1_flip, s1_minus_x, s1_minus_y, s1_minus_low, s2_x, s2_y, s2_z, s2_flip, s2_minus_x, s2_minus_y, s2_minus_z, s3_x, s3_y, s3_z, s3_size_x, s3_size_y, s3_size_z, s4_x, s4_y, s4_z, s4_any, s5_x, s5_y, s5_z, s5_any, s5_upper, s6_x, s6_y, s6_z, s6_any, s12_long, s12_zeros, s13_long, s13_zeros, s14_long, s14_zero, s15_short }
