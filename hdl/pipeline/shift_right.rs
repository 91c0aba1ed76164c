// SPDX-License-Identifier: MIT OR Apache-2.0
//! An arithmetic shift to the right, two levels of multiplexers a stage.
//!
//! | port    | format     | meaning |   Latency 3, interval 1
//! | value   | signed W   | |   Golden: `>>`, error 0
//! | amount  | unsigned 6 | |
//! | shifted | signed W   | floor(value / 2^amount) |

use crate::prelude::*;

/// Shift of `W` bits.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct ShiftRight<const W: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub value: Input<WideS<W>>,
    pub amount: Input<U<6>>,
    pub shifted: Output<WideS<W>>,
    s1_value: DataRegister<WideS<W>>,
    s1_amount: DataRegister<U<6>>,
    s2_value: DataRegister<WideS<W>>,
    s2_amount: DataRegister<U<6>>,
    s3_value: DataRegister<WideS<W>>,
    coarse: Wire<U<6>>,
    middle: Wire<U<6>>,
    fine: Wire<U<6>>,
}

impl<const W: usize> ShiftRight<W> {
    /// Cycles from value to shifted value.
    pub const LATENCY: usize = 3;
}

impl<const W: usize> Logic for ShiftRight<W> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, s1_value, s1_amount, s2_value, s2_amount, s3_value);
        self.shifted.next = self.s3_value.q.val();
        self.coarse.next = self.amount.val() & 0x30;
        self.middle.next = self.s1_amount.q.val() & 0x0c;
        self.fine.next = self.s2_amount.q.val() & 0x03;
        if self.go.val() {
            self.s1_value.d.next = self.value.val() >> self.coarse.val();
            self.s1_amount.d.next = self.amount.val();
            self.s2_value.d.next = self.s1_value.q.val() >> self.middle.val();
            self.s2_amount.d.next = self.s1_amount.q.val();
            self.s3_value.d.next = self.s2_value.q.val() >> self.fine.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("shift_right_{W}"))
    }
}

latches! { [const W: usize] ShiftRight<W>: s1_value, s1_amount, s2_value, s2_amount, s3_value }
