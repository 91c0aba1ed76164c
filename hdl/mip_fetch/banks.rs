// SPDX-License-Identifier: MIT OR Apache-2.0
//! Four parity banks: four texels round a point a cycle, or one sample written.
//!
//! bank = (j & 1) * 2 + (i & 1), word = base + (j >> 1) * pitch + (i >> 1)
//!
//! | stage        | what it does                               |   Latency 7, interval 1; holds while `go` is low
//! | s1_product   | rows times pitch, columns plus base        |   Golden: models::mip_fetch   Error 0
//! | s2_word      | words of the four banks                    |
//! | s3_check     | words compared with the depth; a load picks its bank |
//! | s4_read      | the memories, read or written              |
//! | s5_register  | the register behind each memory            |
//! | s6_data      | half of the way from there; what lies beyond the memory, and every texel of a `blank` fetch, is zero |
//! | s7_texel     | banks to texels                            |
//!
//! `beyond` comes with s2_word. A load gives all banks the same word, and its parity picks the bank. The block RAMs lie
//! far apart, so what goes to all of them comes from registers.

use crate::prelude::*;

/// Four banks of 2^A words, `M` bits of a half side.
#[derive(Clone, Debug, Default, LogicBlock)]
#[allow(missing_docs)]
pub struct MipBanks<const M: usize, const A: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub base: Input<U<A>>,
    pub pitch: Input<U<M>>,
    pub even_column: Input<U<M>>,
    pub odd_column: Input<U<M>>,
    pub even_row: Input<U<M>>,
    pub odd_row: Input<U<M>>,
    /// Four flags, from the lowest bit: the first column is odd, the first row is; both columns are one, both rows are.
    pub flags: Input<U<4>>,
    pub blank: Input<Bit>,
    pub write: Input<Bit>,
    pub write_data: Input<U<16>>,
    pub beyond: Output<Bit>,
    pub t00: Output<S<17>>,
    pub t10: Output<S<17>>,
    pub t01: Output<S<17>>,
    pub t11: Output<S<17>>,
    s1_even_rows: Multiplier<14, 14, 28>,
    s1_odd_rows: Multiplier<14, 14, 28>,
    s1_even_column: DataRegister<U<28>>,
    s1_odd_column: DataRegister<U<28>>,
    s1_flags: DataRegister<U<4>>,
    s1_blank: DataRegister<Bit>,
    s1_write: Register<Bit>,
    s1_data: DataRegister<U<16>>,
    s2_word_0: DataRegister<U<28>>,
    s2_word_1: DataRegister<U<28>>,
    s2_word_2: DataRegister<U<28>>,
    s2_word_3: DataRegister<U<28>>,
    s2_flags: DataRegister<U<4>>,
    s2_blank: DataRegister<Bit>,
    s2_write: Register<Bit>,
    s2_data: DataRegister<U<16>>,
    bank_0: RegisteredRam<U<16>, A, true>,
    bank_1: RegisteredRam<U<16>, A, true>,
    bank_2: RegisteredRam<U<16>, A, true>,
    bank_3: RegisteredRam<U<16>, A, true>,
    s3_address_0: DataRegister<U<A>>,
    s3_address_1: DataRegister<U<A>>,
    s3_address_2: DataRegister<U<A>>,
    s3_address_3: DataRegister<U<A>>,
    s3_zero: DataRegister<U<4>>,
    s3_flags: DataRegister<U<4>>,
    s4_flags: DataRegister<U<4>>,
    s5_zero: DataRegister<U<4>>,
    s4_zero: DataRegister<U<4>>,
    /// Parities of the first and the second column, and of the first and the second row.
    s5_parities: DataRegister<U<4>>,
    s6_parities: DataRegister<U<4>>,
    s6_data_0: DataRegister<S<17>>,
    s6_data_1: DataRegister<S<17>>,
    s6_data_2: DataRegister<S<17>>,
    s6_data_3: DataRegister<S<17>>,
    s7_t00: DataRegister<S<17>>,
    s7_t10: DataRegister<S<17>>,
    s7_t01: DataRegister<S<17>>,
    s7_t11: DataRegister<S<17>>,
    /// The words of the banks, as far as they fit an address.
    fit_0: Wire<U<28>>,
    fit_1: Wire<U<28>>,
    fit_2: Wire<U<28>>,
    fit_3: Wire<U<28>>,
    beyond_0: Wire<Bit>,
    beyond_1: Wire<Bit>,
    beyond_2: Wire<Bit>,
    beyond_3: Wire<Bit>,
    writes: Wire<Bit>,
    data_0: Wire<S<17>>,
    data_1: Wire<S<17>>,
    data_2: Wire<S<17>>,
    data_3: Wire<S<17>>,
    even_first: Wire<S<17>>,
    even_second: Wire<S<17>>,
    odd_first: Wire<S<17>>,
    odd_second: Wire<S<17>>,
    second_column: Wire<Bit>,
    second_row: Wire<Bit>,
}

impl<const M: usize, const A: usize> Logic for MipBanks<M, A> {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, s1_even_rows, s1_odd_rows, bank_0, bank_1, bank_2, bank_3);
        dff_setup!(self, clock, s1_even_column, s1_odd_column, s1_flags, s1_blank, s1_write, s1_data);
        dff_setup!(self, clock, s2_word_0, s2_word_1, s2_word_2, s2_word_3, s2_flags, s2_blank, s2_write, s2_data);
        dff_setup!(self, clock, s3_zero, s3_flags, s4_zero, s5_parities, s7_t00, s7_t10, s7_t01, s7_t11);
        dff_setup!(
            self,
            clock,
            s3_address_0,
            s3_address_1,
            s3_address_2,
            s3_address_3,
            s4_flags,
            s5_zero,
            s6_parities,
            s6_data_0
        );
        dff_setup!(self, clock, s6_data_1, s6_data_2, s6_data_3);

        // s1_product: 13 x 13 bits at most; the sums fit 28 bits with a base of up to 27.
        self.s1_even_rows.enable.next = self.go.val();
        self.s1_odd_rows.enable.next = self.go.val();
        self.s1_even_rows.a.next = bit_cast_to::<S<14>>(self.even_row.val());
        self.s1_even_rows.b.next = bit_cast_to::<S<14>>(self.pitch.val());
        self.s1_odd_rows.a.next = bit_cast_to::<S<14>>(self.odd_row.val());
        self.s1_odd_rows.b.next = bit_cast_to::<S<14>>(self.pitch.val());
        if self.go.val() {
            self.s1_even_column.d.next =
                bit_cast_to::<U<28>>(self.base.val()) + bit_cast_to::<U<28>>(self.even_column.val());
            self.s1_odd_column.d.next =
                bit_cast_to::<U<28>>(self.base.val()) + bit_cast_to::<U<28>>(self.odd_column.val());
            self.s1_flags.d.next = self.flags.val();
            self.s1_blank.d.next = self.blank.val();
            self.s1_write.d.next = self.write.val();
            self.s1_data.d.next = self.write_data.val();
            // s2_word
            self.s2_word_0.d.next = bit_cast_to::<U<28>>(self.s1_even_rows.p.val()) + self.s1_even_column.q.val();
            self.s2_word_1.d.next = bit_cast_to::<U<28>>(self.s1_even_rows.p.val()) + self.s1_odd_column.q.val();
            self.s2_word_2.d.next = bit_cast_to::<U<28>>(self.s1_odd_rows.p.val()) + self.s1_even_column.q.val();
            self.s2_word_3.d.next = bit_cast_to::<U<28>>(self.s1_odd_rows.p.val()) + self.s1_odd_column.q.val();
            self.s2_flags.d.next = self.s1_flags.q.val();
            self.s2_blank.d.next = self.s1_blank.q.val();
            self.s2_write.d.next = self.s1_write.q.val();
            self.s2_data.d.next = self.s1_data.q.val();
        }
        self.fit_0.next = bit_cast_to::<U<28>>(bit_cast_to::<U<A>>(self.s2_word_0.q.val()));
        self.fit_1.next = bit_cast_to::<U<28>>(bit_cast_to::<U<A>>(self.s2_word_1.q.val()));
        self.fit_2.next = bit_cast_to::<U<28>>(bit_cast_to::<U<A>>(self.s2_word_2.q.val()));
        self.fit_3.next = bit_cast_to::<U<28>>(bit_cast_to::<U<A>>(self.s2_word_3.q.val()));
        self.beyond_0.next = self.fit_0.val() != self.s2_word_0.q.val();
        self.beyond_1.next = self.fit_1.val() != self.s2_word_1.q.val();
        self.beyond_2.next = self.fit_2.val() != self.s2_word_2.q.val();
        self.beyond_3.next = self.fit_3.val() != self.s2_word_3.q.val();
        self.beyond.next = self.beyond_0.val() || self.beyond_1.val() || self.beyond_2.val() || self.beyond_3.val();

        // s3_check, s4_read
        self.writes.next = self.go.val() && self.s2_write.q.val() && !self.beyond_0.val();
        self.bank_0.enable.next = self.go.val();
        self.bank_0.output_enable.next = self.go.val();
        self.bank_1.enable.next = self.go.val();
        self.bank_1.output_enable.next = self.go.val();
        self.bank_2.enable.next = self.go.val();
        self.bank_2.output_enable.next = self.go.val();
        self.bank_3.enable.next = self.go.val();
        self.bank_3.output_enable.next = self.go.val();
        self.bank_0.read_address.next = self.s3_address_0.q.val();
        self.bank_1.read_address.next = self.s3_address_1.q.val();
        self.bank_2.read_address.next = self.s3_address_2.q.val();
        self.bank_3.read_address.next = self.s3_address_3.q.val();
        self.bank_0.write_address.next = bit_cast_to::<U<A>>(self.s2_word_0.q.val());
        self.bank_1.write_address.next = bit_cast_to::<U<A>>(self.s2_word_1.q.val());
        self.bank_2.write_address.next = bit_cast_to::<U<A>>(self.s2_word_2.q.val());
        self.bank_3.write_address.next = bit_cast_to::<U<A>>(self.s2_word_3.q.val());
        self.bank_0.write_data.next = self.s2_data.q.val();
        self.bank_1.write_data.next = self.s2_data.q.val();
        self.bank_2.write_data.next = self.s2_data.q.val();
        self.bank_3.write_data.next = self.s2_data.q.val();
        self.bank_0.write_enable.next =
            self.writes.val() && !self.s2_flags.q.val().get_bit(0) && !self.s2_flags.q.val().get_bit(1);
        self.bank_1.write_enable.next =
            self.writes.val() && self.s2_flags.q.val().get_bit(0) && !self.s2_flags.q.val().get_bit(1);
        self.bank_2.write_enable.next =
            self.writes.val() && !self.s2_flags.q.val().get_bit(0) && self.s2_flags.q.val().get_bit(1);
        self.bank_3.write_enable.next =
            self.writes.val() && self.s2_flags.q.val().get_bit(0) && self.s2_flags.q.val().get_bit(1);

        // s5_register to s7_texel
        self.data_0.next = bit_cast_to::<S<17>>(self.bank_0.read_data.val());
        if self.s5_zero.q.val().get_bit(0) {
            self.data_0.next = 0.into();
        }
        self.data_1.next = bit_cast_to::<S<17>>(self.bank_1.read_data.val());
        if self.s5_zero.q.val().get_bit(1) {
            self.data_1.next = 0.into();
        }
        self.data_2.next = bit_cast_to::<S<17>>(self.bank_2.read_data.val());
        if self.s5_zero.q.val().get_bit(2) {
            self.data_2.next = 0.into();
        }
        self.data_3.next = bit_cast_to::<S<17>>(self.bank_3.read_data.val());
        if self.s5_zero.q.val().get_bit(3) {
            self.data_3.next = 0.into();
        }
        // In the even and in the odd row: the first and the second column's texel.
        self.even_first.next = self.s6_data_0.q.val();
        self.odd_first.next = self.s6_data_2.q.val();
        if self.s6_parities.q.val().get_bit(0) {
            self.even_first.next = self.s6_data_1.q.val();
            self.odd_first.next = self.s6_data_3.q.val();
        }
        self.even_second.next = self.s6_data_0.q.val();
        self.odd_second.next = self.s6_data_2.q.val();
        if self.s6_parities.q.val().get_bit(1) {
            self.even_second.next = self.s6_data_1.q.val();
            self.odd_second.next = self.s6_data_3.q.val();
        }
        // The second neighbour has the other parity, unless it is the first.
        self.second_column.next = self.s4_flags.q.val().get_bit(0) == self.s4_flags.q.val().get_bit(2);
        self.second_row.next = self.s4_flags.q.val().get_bit(1) == self.s4_flags.q.val().get_bit(3);
        if self.go.val() {
            self.s3_flags.d.next = self.s2_flags.q.val();
            self.s3_address_0.d.next = bit_cast_to::<U<A>>(self.s2_word_0.q.val());
            self.s3_address_1.d.next = bit_cast_to::<U<A>>(self.s2_word_1.q.val());
            self.s3_address_2.d.next = bit_cast_to::<U<A>>(self.s2_word_2.q.val());
            self.s3_address_3.d.next = bit_cast_to::<U<A>>(self.s2_word_3.q.val());
            if self.s2_blank.q.val() {
                self.s3_zero.d.next = 15.into();
            } else {
                self.s3_zero.d.next = bit_cast_to::<U<4>>(self.beyond_0.val())
                    | (bit_cast_to::<U<4>>(self.beyond_1.val()) << 1)
                    | (bit_cast_to::<U<4>>(self.beyond_2.val()) << 2)
                    | (bit_cast_to::<U<4>>(self.beyond_3.val()) << 3);
            }
            self.s4_zero.d.next = self.s3_zero.q.val();
            self.s4_flags.d.next = self.s3_flags.q.val();
            self.s5_zero.d.next = self.s4_zero.q.val();
            self.s6_parities.d.next = self.s5_parities.q.val();
            self.s6_data_0.d.next = self.data_0.val();
            self.s6_data_1.d.next = self.data_1.val();
            self.s6_data_2.d.next = self.data_2.val();
            self.s6_data_3.d.next = self.data_3.val();
            self.s5_parities.d.next = bit_cast_to::<U<4>>(self.s4_flags.q.val().get_bit(0))
                | (bit_cast_to::<U<4>>(self.second_column.val()) << 1)
                | (bit_cast_to::<U<4>>(self.s4_flags.q.val().get_bit(1)) << 2)
                | (bit_cast_to::<U<4>>(self.second_row.val()) << 3);
            self.s7_t00.d.next = self.even_first.val();
            self.s7_t10.d.next = self.even_second.val();
            if self.s6_parities.q.val().get_bit(2) {
                self.s7_t00.d.next = self.odd_first.val();
                self.s7_t10.d.next = self.odd_second.val();
            }
            self.s7_t01.d.next = self.even_first.val();
            self.s7_t11.d.next = self.even_second.val();
            if self.s6_parities.q.val().get_bit(3) {
                self.s7_t01.d.next = self.odd_first.val();
                self.s7_t11.d.next = self.odd_second.val();
            }
        }
        self.t00.next = self.s7_t00.q.val();
        self.t10.next = self.s7_t10.q.val();
        self.t01.next = self.s7_t01.q.val();
        self.t11.next = self.s7_t11.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("mip_banks")
    }
}

latches! { [const M: usize, const A: usize] MipBanks<M, A>: s1_even_rows, s1_odd_rows, s1_even_column, s1_odd_column, s1_flags, s1_blank, s1_write, s1_data, s2_word_0, s2_word_1, s2_word_2, s2_word_3, s2_flags, s2_blank, s2_write, s2_data, bank_0, bank_1, bank_2, bank_3, s3_address_0, s3_address_1, s3_address_2, s3_address_3, s3_zero, s3_flags, s4_flags, s4_zero, s5_zero, s5_parities, s6_parities, s6_data_0, s6_data_1, s6_data_2, s6_data_3, s7_t00, s7_t10, s7_t01, s7_t11 }
