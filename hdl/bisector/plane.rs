// SPDX-License-Identifier: MIT OR Apache-2.0
//! A word for every vertex of the lattice.
//!
//! Vertices (u, v) with u and v below 2^K have the address v << K | u, and the highest two bits of it choose one of four
//! memories; those with u = 2^K or v = 2^K stand in a fifth one. So no address has to be added up, and the large memories are
//! powers of two deep. Block RAMs lie all over the part: each of the four has an address and a `go` of its own.
//!
//! | stage      | what it does                                           |   Golden: models::bisector::golden   Error 0
//! | s1_address | the address of each memory                             |   Latency 5; holds while `go` is low
//! | s2_read    | all memories                                           |
//! | s3_output  | their output registers                                 |
//! | s4_quarter | registers between them and the choice                  |
//! | s5_word    | the word                                               |
//!
//! A word is written two cycles after `write`; reading it in these cycles gives anything.

use crate::prelude::*;

/// Plane of words of `W` bits for lattices of up to 2^K steps, K >= 2: C = K + 1, H = K + 2, A = 2 K - 2.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct BisectorPlane<const C: usize, const H: usize, const A: usize, const W: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// The same as `go`, while something is read: for a memory each, and the first one for the rim.
    pub go_0: Input<Bit>,
    pub go_1: Input<Bit>,
    pub go_2: Input<Bit>,
    pub go_3: Input<Bit>,
    pub u: Input<U<C>>,
    pub v: Input<U<C>>,
    pub word: Output<U<W>>,
    pub write: Input<Bit>,
    pub write_u: Input<U<C>>,
    pub write_v: Input<U<C>>,
    pub write_data: Input<U<W>>,
    inside_0: RegisteredRam<U<W>, A, true>,
    inside_1: RegisteredRam<U<W>, A, true>,
    inside_2: RegisteredRam<U<W>, A, true>,
    inside_3: RegisteredRam<U<W>, A, true>,
    rim: RegisteredRam<U<W>, H, true>,
    s1_address_0: DataRegister<U<A>>,
    s1_address_1: DataRegister<U<A>>,
    s1_address_2: DataRegister<U<A>>,
    s1_address_3: DataRegister<U<A>>,
    s1_address_rim: DataRegister<U<H>>,
    s1_rim: DataRegister<Bit>,
    s1_high: DataRegister<Bit>,
    s1_odd: DataRegister<Bit>,
    s2_rim: DataRegister<Bit>,
    s2_high: DataRegister<Bit>,
    s2_odd: DataRegister<Bit>,
    s3_rim: DataRegister<Bit>,
    s3_high: DataRegister<Bit>,
    s3_odd: DataRegister<Bit>,
    s4_rim: DataRegister<Bit>,
    s4_high: DataRegister<Bit>,
    s4_odd: DataRegister<Bit>,
    s4_word_0: DataRegister<U<W>>,
    s4_word_1: DataRegister<U<W>>,
    s4_word_2: DataRegister<U<W>>,
    s4_word_3: DataRegister<U<W>>,
    s4_word_rim: DataRegister<U<W>>,
    s5_word: DataRegister<U<W>>,
    pitch: Constant<U<4>>,
    mask: Constant<U<C>>,
    quarter: Constant<U<C>>,
    middle: Constant<U<C>>,
    behind: Constant<U<C>>,
    upper: Constant<U<H>>,
    reads_right: Wire<Bit>,
    reads_below: Wire<Bit>,
    writes_right: Wire<Bit>,
    writes_below: Wire<Bit>,
    writes_rim: Wire<Bit>,
    writes_high: Wire<Bit>,
    writes_odd: Wire<Bit>,
    writes_inside: Wire<Bit>,
    read_at: Wire<U<A>>,
    write_at: Wire<U<A>>,
    read_rim: Wire<U<H>>,
    write_rim: Wire<U<H>>,
}

impl<const C: usize, const H: usize, const A: usize, const W: usize> Default for BisectorPlane<C, H, A, W> {
    fn default() -> Self {
        Self {
            rim: RegisteredRam::new((3 << (C - 1)) + 1),
            pitch: Constant::new(U::new(C as i64 - 1)),
            mask: Constant::new(U::new((1 << (C - 1)) - 1)),
            quarter: Constant::new(U::new(1 << (C - 3))),
            middle: Constant::new(U::new(1 << (C - 2))),
            behind: Constant::new(U::new(1 << (C - 1))),
            upper: Constant::new(U::new(1 << C)),
            clock: Input::default(),
            go: Input::default(),
            go_0: Input::default(),
            go_1: Input::default(),
            go_2: Input::default(),
            go_3: Input::default(),
            u: Input::default(),
            v: Input::default(),
            word: Output::default(),
            write: Input::default(),
            write_u: Input::default(),
            write_v: Input::default(),
            write_data: Input::default(),
            inside_0: RegisteredRam::default(),
            inside_1: RegisteredRam::default(),
            inside_2: RegisteredRam::default(),
            inside_3: RegisteredRam::default(),
            s1_address_0: DataRegister::default(),
            s1_address_1: DataRegister::default(),
            s1_address_2: DataRegister::default(),
            s1_address_3: DataRegister::default(),
            s1_address_rim: DataRegister::default(),
            s1_rim: DataRegister::default(),
            s1_high: DataRegister::default(),
            s1_odd: DataRegister::default(),
            s2_rim: DataRegister::default(),
            s2_high: DataRegister::default(),
            s2_odd: DataRegister::default(),
            s3_rim: DataRegister::default(),
            s3_high: DataRegister::default(),
            s3_odd: DataRegister::default(),
            s4_rim: DataRegister::default(),
            s4_high: DataRegister::default(),
            s4_odd: DataRegister::default(),
            s4_word_0: DataRegister::default(),
            s4_word_1: DataRegister::default(),
            s4_word_2: DataRegister::default(),
            s4_word_3: DataRegister::default(),
            s4_word_rim: DataRegister::default(),
            s5_word: DataRegister::default(),
            reads_right: Wire::default(),
            reads_below: Wire::default(),
            writes_right: Wire::default(),
            writes_below: Wire::default(),
            writes_rim: Wire::default(),
            writes_high: Wire::default(),
            writes_odd: Wire::default(),
            writes_inside: Wire::default(),
            read_at: Wire::default(),
            write_at: Wire::default(),
            read_rim: Wire::default(),
            write_rim: Wire::default(),
        }
    }
}

impl<const C: usize, const H: usize, const A: usize, const W: usize> Logic for BisectorPlane<C, H, A, W> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, inside_0, inside_1, inside_2, inside_3, rim);
        dff_setup!(
            self,
            clock,
            s1_address_0,
            s1_address_1,
            s1_address_2,
            s1_address_3,
            s1_address_rim,
            s1_rim,
            s1_high,
            s1_odd,
            s2_rim
        );
        dff_setup!(self, clock, s2_high, s2_odd, s3_rim, s3_high, s3_odd, s4_rim, s4_high, s4_odd, s4_word_0);
        dff_setup!(self, clock, s4_word_1, s4_word_2, s4_word_3, s4_word_rim, s5_word);
        // 2^K has no bit in common with the coordinates before it.
        self.reads_right.next = (self.u.val() & self.behind.val()) != 0;
        self.reads_below.next = (self.v.val() & self.behind.val()) != 0;
        self.read_at.next = (bit_cast_to::<U<A>>(self.v.val()) << self.pitch.val())
            | bit_cast_to::<U<A>>(self.u.val() & self.mask.val());
        // The last row behind the last column: at most 3 2^K.
        self.read_rim.next = bit_cast_to::<U<H>>(self.v.val());
        if self.reads_below.val() {
            self.read_rim.next = bit_cast_to::<U<H>>(self.u.val()) | self.upper.val();
        }
        self.writes_right.next = (self.write_u.val() & self.behind.val()) != 0;
        self.writes_below.next = (self.write_v.val() & self.behind.val()) != 0;
        self.writes_high.next = (self.write_v.val() & self.middle.val()) != 0;
        self.writes_odd.next = (self.write_v.val() & self.quarter.val()) != 0;
        self.writes_rim.next = self.writes_right.val() || self.writes_below.val();
        self.writes_inside.next = self.write.val() && !self.writes_rim.val();
        self.write_at.next = (bit_cast_to::<U<A>>(self.write_v.val()) << self.pitch.val())
            | bit_cast_to::<U<A>>(self.write_u.val() & self.mask.val());
        self.write_rim.next = bit_cast_to::<U<H>>(self.write_v.val());
        if self.writes_below.val() {
            self.write_rim.next = bit_cast_to::<U<H>>(self.write_u.val()) | self.upper.val();
        }
        self.inside_0.enable.next = self.go_0.val();
        self.inside_0.output_enable.next = self.go_0.val();
        self.inside_0.read_address.next = self.s1_address_0.q.val();
        self.inside_0.write_enable.next = self.writes_inside.val() && !self.writes_high.val() && !self.writes_odd.val();
        self.inside_0.write_address.next = self.write_at.val();
        self.inside_0.write_data.next = self.write_data.val();
        if self.go_0.val() {
            self.s1_address_0.d.next = self.read_at.val();
        }
        self.inside_1.enable.next = self.go_1.val();
        self.inside_1.output_enable.next = self.go_1.val();
        self.inside_1.read_address.next = self.s1_address_1.q.val();
        self.inside_1.write_enable.next = self.writes_inside.val() && !self.writes_high.val() && self.writes_odd.val();
        self.inside_1.write_address.next = self.write_at.val();
        self.inside_1.write_data.next = self.write_data.val();
        if self.go_1.val() {
            self.s1_address_1.d.next = self.read_at.val();
        }
        self.inside_2.enable.next = self.go_2.val();
        self.inside_2.output_enable.next = self.go_2.val();
        self.inside_2.read_address.next = self.s1_address_2.q.val();
        self.inside_2.write_enable.next = self.writes_inside.val() && self.writes_high.val() && !self.writes_odd.val();
        self.inside_2.write_address.next = self.write_at.val();
        self.inside_2.write_data.next = self.write_data.val();
        if self.go_2.val() {
            self.s1_address_2.d.next = self.read_at.val();
        }
        self.inside_3.enable.next = self.go_3.val();
        self.inside_3.output_enable.next = self.go_3.val();
        self.inside_3.read_address.next = self.s1_address_3.q.val();
        self.inside_3.write_enable.next = self.writes_inside.val() && self.writes_high.val() && self.writes_odd.val();
        self.inside_3.write_address.next = self.write_at.val();
        self.inside_3.write_data.next = self.write_data.val();
        if self.go_3.val() {
            self.s1_address_3.d.next = self.read_at.val();
        }
        self.rim.enable.next = self.go_0.val();
        self.rim.output_enable.next = self.go_0.val();
        self.rim.read_address.next = self.s1_address_rim.q.val();
        self.rim.write_enable.next = self.write.val() && self.writes_rim.val();
        self.rim.write_address.next = self.write_rim.val();
        self.rim.write_data.next = self.write_data.val();
        if self.go_0.val() {
            self.s1_address_rim.d.next = self.read_rim.val();
        }
        self.word.next = self.s5_word.q.val();
        if self.go.val() {
            self.s1_rim.d.next = self.reads_right.val() || self.reads_below.val();
            self.s1_high.d.next = (self.v.val() & self.middle.val()) != 0;
            self.s1_odd.d.next = (self.v.val() & self.quarter.val()) != 0;
            self.s2_rim.d.next = self.s1_rim.q.val();
            self.s2_high.d.next = self.s1_high.q.val();
            self.s2_odd.d.next = self.s1_odd.q.val();
            self.s3_rim.d.next = self.s2_rim.q.val();
            self.s3_high.d.next = self.s2_high.q.val();
            self.s3_odd.d.next = self.s2_odd.q.val();
            self.s4_rim.d.next = self.s3_rim.q.val();
            self.s4_high.d.next = self.s3_high.q.val();
            self.s4_odd.d.next = self.s3_odd.q.val();
            self.s4_word_0.d.next = self.inside_0.read_data.val();
            self.s4_word_1.d.next = self.inside_1.read_data.val();
            self.s4_word_2.d.next = self.inside_2.read_data.val();
            self.s4_word_3.d.next = self.inside_3.read_data.val();
            self.s4_word_rim.d.next = self.rim.read_data.val();
            self.s5_word.d.next = self.s4_word_0.q.val();
            if self.s4_rim.q.val() {
                self.s5_word.d.next = self.s4_word_rim.q.val();
            } else if self.s4_high.q.val() {
                self.s5_word.d.next = self.s4_word_2.q.val();
                if self.s4_odd.q.val() {
                    self.s5_word.d.next = self.s4_word_3.q.val();
                }
            } else if self.s4_odd.q.val() {
                self.s5_word.d.next = self.s4_word_1.q.val();
            }
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name(format!("bisector_plane{W}"))
    }
}

latches! { [const C: usize, const H: usize, const A: usize, const W: usize] BisectorPlane<C, H, A, W>: inside_0, inside_1, inside_2, inside_3, rim, s1_address_0, s1_address_1, s1_address_2, s1_address_3, s1_address_rim, s1_rim, s1_high, s1_odd, s2_rim, s2_high, s2_odd, s3_rim, s3_high, s3_odd, s4_rim, s4_high, s4_odd, s4_word_0, s4_word_1, s4_word_2, s4_word_3, s4_word_rim, s5_word }
