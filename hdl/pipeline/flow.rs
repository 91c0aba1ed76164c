// SPDX-License-Identifier: MIT OR Apache-2.0
//! The handshake of a straight pipeline of N stages: which stages hold a beat, and two places behind the last one.
//!
//! What everything waits for, `go`, is a register: the whole pipeline stands once a second result waits behind one that
//! is not taken.
//!
//! | port      | meaning |   Latency N + 1, interval 1   Golden: none, it changes nothing
//! | in_valid  | a beat stands at the first stage; it is taken while `go` is high |
//! | go        | all stages move; `in_ready` of the block |
//! | value     | what the last stage holds |
//! | out_*     | the results, under the rules of a stream |

use crate::prelude::*;

/// Flow of results of `P` bits, P <= 127, through `N` stages, N <= 127.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Flow<const N: usize, const P: usize> {
    pub clock: Input<ClockReset>,
    pub in_valid: Input<Bit>,
    pub go: Output<Bit>,
    pub value: Input<WideU<P>>,
    pub out_valid: Output<Bit>,
    pub out_ready: Input<Bit>,
    pub out_value: Output<WideU<P>>,
    /// Stages that hold a beat, the first one in the lowest bit.
    sending: Register<WideU<N>>,
    moves: Register<Bit>,
    sent_valid: Register<Bit>,
    sent: DataRegister<WideU<P>>,
    spare_valid: Register<Bit>,
    spare: DataRegister<WideU<P>>,
    last: Constant<WideU<N>>,
    arrives: Wire<Bit>,
    out_free: Wire<Bit>,
    spare_behind: Wire<Bit>,
}

impl<const N: usize, const P: usize> Default for Flow<N, P> {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            in_valid: Input::default(),
            go: Output::default(),
            value: Input::default(),
            out_valid: Output::default(),
            out_ready: Input::default(),
            out_value: Output::default(),
            sending: Register::default(),
            moves: Register::new(true),
            sent_valid: Register::default(),
            sent: DataRegister::default(),
            spare_valid: Register::default(),
            spare: DataRegister::default(),
            last: Constant::new(WideU::new(1 << (N - 1))),
            arrives: Wire::default(),
            out_free: Wire::default(),
            spare_behind: Wire::default(),
        }
    }
}

impl<const N: usize, const P: usize> Logic for Flow<N, P> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, sending, moves, sent_valid, sent, spare_valid, spare);
        self.go.next = self.moves.q.val();
        self.out_valid.next = self.sent_valid.q.val();
        self.out_value.next = self.sent.q.val();
        self.arrives.next = self.moves.q.val() && (self.sending.q.val() & self.last.val()).any();
        self.out_free.next = !self.sent_valid.q.val() || self.out_ready.val();
        self.spare_behind.next = !self.out_free.val() && (self.spare_valid.q.val() || self.arrives.val());
        self.spare_valid.d.next = self.spare_behind.val();
        self.moves.d.next = !self.spare_behind.val();
        if self.out_free.val() {
            self.sent_valid.d.next = self.spare_valid.q.val() || self.arrives.val();
            self.sent.d.next = self.value.val();
            if self.spare_valid.q.val() {
                self.sent.d.next = self.spare.q.val();
            }
        }
        if self.moves.q.val() {
            self.sending.d.next = (self.sending.q.val() << 1) | bit_cast_to::<WideU<N>>(self.in_valid.val());
            self.spare.d.next = self.value.val();
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("flow_{N}_of_{P}"))
    }
}

latches! { [const N: usize, const P: usize] Flow<N, P>: sending, moves, sent_valid, sent, spare_valid, spare }
