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
//! | s11 .. s43     | over its length, [`UnitVector`]               | SQ1.16 |

use super::UnitVector;
use crate::pipeline::Leading;
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
    unit_vector: UnitVector,
    vector_x: Wire<S<32>>,
    vector_y: Wire<S<32>>,
    vector_z: Wire<S<32>>,
    size_x: Wire<S<32>>,
    size_y: Wire<S<32>>,
    size_z: Wire<S<32>>,
    zeros: Wire<U<5>>,
    coarse: Wire<U<5>>,
    one: Constant<Lanes<3, 33>>,
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
            unit_vector: UnitVector::default(),
            vector_x: Wire::default(),
            vector_y: Wire::default(),
            vector_z: Wire::default(),
            size_x: Wire::default(),
            size_y: Wire::default(),
            size_z: Wire::default(),
            zeros: Wire::default(),
            coarse: Wire::default(),
            one: Constant::new(Lanes::new([1; 3])),
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
        clock!(self, clock, leading, unit_vector);
        dff_setup!(self, clock, s1_size_x, s1_size_y, s1_size_z, s1_vector, s2_any, s2_vector, s3_vector, s4_vector);
        dff_setup!(self, clock, s5_vector, s6_vector, s7_vector, s8_long, s8_fine, s9_long, s10_short);
        self.unit.next = self.unit_vector.unit.val();

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

        // s11 to s43
        self.unit_vector.go.next = self.go.val();
        self.unit_vector.components.next = self.s10_short.q.val();

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
        blocks: leading, unit_vector;
        state: leading, unit_vector, s1_size_x, s1_size_y, s1_size_z, s1_vector, s2_any, s2_vector, s3_vector, s4_vector, s5_vector, s6_vector, s7_vector, s8_long, s8_fine, s9_long, s10_short
    }
}
