// SPDX-License-Identifier: MIT OR Apache-2.0
//! From beats to the four words of a rectangle: the front of both sums.
//!
//! word(x, y) = (y - 1) * width + x - 1; row 0 and column 0 have no word, they are zero
//!
//! | stage      | what it does                              |   Latency 10, interval 1; holds while `go` is low
//! | s1_beat    | takes a beat, keeps the size              |   Golden: models::sat_fetch   Error 0
//! | s2 to s6   | both axes, cut or slid: SatSpan           |
//! | s7_factors | rows above, and the rectangle's sides     |
//! | s8_product | rows times width, and the area            |
//! | s9_words   | four words, and which of them are zero    |
//! | s10_inside  | whether they are in the memory            |

use super::SatSpan;
use crate::prelude::*;

/// Sides of `M` bits, M <= 13, corners of `X` = M + 2, areas of `R` = 2 M, words of `T` bits, T <= 27, sums of `B`.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct SatCorners<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    /// A beat is taken, if `go`.
    pub valid: Input<Bit>,
    pub kind: Input<U<2>>,
    pub width: Input<U<M>>,
    pub height: Input<U<M>>,
    pub slide: Input<Bit>,
    pub corner_x: Input<S<X>>,
    pub corner_y: Input<S<X>>,
    pub columns: Input<U<M>>,
    pub rows: Input<U<M>>,
    pub value: Input<U<B>>,
    /// A rectangle, or a load that is to be stored; and an error of whatever stands here.
    pub fetch: Output<Bit>,
    pub load: Output<Bit>,
    pub fails: Output<Bit>,
    /// Words of the corners (behind, behind), (first, behind), (behind, first), (first, first), as x, y.
    pub word_0: Output<U<T>>,
    pub word_1: Output<U<T>>,
    pub word_2: Output<U<T>>,
    pub word_3: Output<U<T>>,
    pub zero: Output<U<4>>,
    pub area: Output<U<R>>,
    pub load_value: Output<U<B>>,
    sized: Register<Bit>,
    side_x: DataRegister<U<M>>,
    side_y: DataRegister<U<M>>,
    slides: DataRegister<Bit>,
    s1_fetch: Register<Bit>,
    s1_load: Register<Bit>,
    s1_fails: Register<Bit>,
    s1_x: DataRegister<S<X>>,
    s1_y: DataRegister<S<X>>,
    s1_a: DataRegister<U<M>>,
    s1_b: DataRegister<U<M>>,
    s1_value: DataRegister<U<B>>,
    s1_blank: DataRegister<Bit>,
    span_x: SatSpan,
    span_y: SatSpan,
    s2_fetch: Register<Bit>,
    s2_load: Register<Bit>,
    s2_fails: Register<Bit>,
    s2_width: DataRegister<S<14>>,
    s2_value: DataRegister<U<B>>,
    s3_fetch: Register<Bit>,
    s3_load: Register<Bit>,
    s3_fails: Register<Bit>,
    s3_width: DataRegister<S<14>>,
    s3_value: DataRegister<U<B>>,
    s4_fetch: Register<Bit>,
    s4_load: Register<Bit>,
    s4_fails: Register<Bit>,
    s4_width: DataRegister<S<14>>,
    s4_value: DataRegister<U<B>>,
    s5_fetch: Register<Bit>,
    s5_load: Register<Bit>,
    s5_fails: Register<Bit>,
    s5_width: DataRegister<S<14>>,
    s5_value: DataRegister<U<B>>,
    s6_fetch: Register<Bit>,
    s6_load: Register<Bit>,
    s6_fails: Register<Bit>,
    s6_width: DataRegister<S<14>>,
    s6_value: DataRegister<U<B>>,
    s7_fetch: Register<Bit>,
    s7_load: Register<Bit>,
    s7_fails: Register<Bit>,
    s7_width: DataRegister<S<14>>,
    s7_upper: DataRegister<S<14>>,
    s7_lower: DataRegister<S<14>>,
    s7_columns: DataRegister<S<14>>,
    s7_rows: DataRegister<S<14>>,
    s7_x0: DataRegister<S<14>>,
    s7_x1: DataRegister<S<14>>,
    s7_zero_x0: DataRegister<Bit>,
    s7_zero_x1: DataRegister<Bit>,
    s7_zero_y0: DataRegister<Bit>,
    s7_zero_y1: DataRegister<Bit>,
    s7_value: DataRegister<U<B>>,
    s8_fetch: Register<Bit>,
    s8_load: Register<Bit>,
    s8_fails: Register<Bit>,
    s8_upper: Multiplier<14, 14, 28>,
    s8_lower: Multiplier<14, 14, 28>,
    s8_area: Multiplier<14, 14, 28>,
    s8_x0: DataRegister<U<28>>,
    s8_x1: DataRegister<U<28>>,
    s8_zero: DataRegister<U<4>>,
    s8_value: DataRegister<U<B>>,
    s9_fetch: Register<Bit>,
    s9_load: Register<Bit>,
    s9_fails: Register<Bit>,
    s9_word_0: DataRegister<U<28>>,
    s9_word_1: DataRegister<U<28>>,
    s9_word_2: DataRegister<U<28>>,
    s9_word_3: DataRegister<U<28>>,
    s9_zero: DataRegister<U<4>>,
    s9_area: DataRegister<U<R>>,
    s9_value: DataRegister<U<B>>,
    s10_fetch: Register<Bit>,
    s10_load: Register<Bit>,
    s10_fails: Register<Bit>,
    s10_word_0: DataRegister<U<T>>,
    s10_word_1: DataRegister<U<T>>,
    s10_word_2: DataRegister<U<T>>,
    s10_word_3: DataRegister<U<T>>,
    s10_zero: DataRegister<U<4>>,
    s10_area: DataRegister<U<R>>,
    s10_value: DataRegister<U<B>>,
    beat: Wire<Bit>,
    size: Wire<Bit>,
    loads: Wire<Bit>,
    fetches: Wire<Bit>,
    sound: Wire<Bit>,
    outside: Wire<Bit>,
    zero_corner: Wire<U<4>>,
    product: Wire<U<28>>,
    fit_0: Wire<U<28>>,
    fit_1: Wire<U<28>>,
    fit_2: Wire<U<28>>,
    fit_3: Wire<U<28>>,
    beyond: Wire<U<4>>,
    used: Wire<U<4>>,
    too_large: Wire<Bit>,
    limit: Constant<U<R>>,
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> Default
    for SatCorners<M, X, R, T, B>
{
    fn default() -> Self {
        // The smallest area whose brightest texels wrap, area * 65535 >= 2^B; no area reaches 2^R - 1.
        let limit = (1u64 << B).div_ceil(65_535).min((1 << R) - 1);
        Self {
            clock: Input::default(),
            go: Input::default(),
            valid: Input::default(),
            kind: Input::default(),
            width: Input::default(),
            height: Input::default(),
            slide: Input::default(),
            corner_x: Input::default(),
            corner_y: Input::default(),
            columns: Input::default(),
            rows: Input::default(),
            value: Input::default(),
            fetch: Output::default(),
            load: Output::default(),
            fails: Output::default(),
            word_0: Output::default(),
            word_1: Output::default(),
            word_2: Output::default(),
            word_3: Output::default(),
            zero: Output::default(),
            area: Output::default(),
            load_value: Output::default(),
            sized: Register::default(),
            side_x: DataRegister::default(),
            side_y: DataRegister::default(),
            slides: DataRegister::default(),
            s1_fetch: Register::default(),
            s1_load: Register::default(),
            s1_fails: Register::default(),
            s1_x: DataRegister::default(),
            s1_y: DataRegister::default(),
            s1_a: DataRegister::default(),
            s1_b: DataRegister::default(),
            s1_value: DataRegister::default(),
            s1_blank: DataRegister::default(),
            span_x: SatSpan::default(),
            span_y: SatSpan::default(),
            s2_fetch: Register::default(),
            s2_load: Register::default(),
            s2_fails: Register::default(),
            s2_width: DataRegister::default(),
            s2_value: DataRegister::default(),
            s3_fetch: Register::default(),
            s3_load: Register::default(),
            s3_fails: Register::default(),
            s3_width: DataRegister::default(),
            s3_value: DataRegister::default(),
            s4_fetch: Register::default(),
            s4_load: Register::default(),
            s4_fails: Register::default(),
            s4_width: DataRegister::default(),
            s4_value: DataRegister::default(),
            s5_fetch: Register::default(),
            s5_load: Register::default(),
            s5_fails: Register::default(),
            s5_width: DataRegister::default(),
            s5_value: DataRegister::default(),
            s6_fetch: Register::default(),
            s6_load: Register::default(),
            s6_fails: Register::default(),
            s6_width: DataRegister::default(),
            s6_value: DataRegister::default(),
            s7_fetch: Register::default(),
            s7_load: Register::default(),
            s7_fails: Register::default(),
            s7_width: DataRegister::default(),
            s7_upper: DataRegister::default(),
            s7_lower: DataRegister::default(),
            s7_columns: DataRegister::default(),
            s7_rows: DataRegister::default(),
            s7_x0: DataRegister::default(),
            s7_x1: DataRegister::default(),
            s7_zero_x0: DataRegister::default(),
            s7_zero_x1: DataRegister::default(),
            s7_zero_y0: DataRegister::default(),
            s7_zero_y1: DataRegister::default(),
            s7_value: DataRegister::default(),
            s8_fetch: Register::default(),
            s8_load: Register::default(),
            s8_fails: Register::default(),
            s8_upper: Multiplier::default(),
            s8_lower: Multiplier::default(),
            s8_area: Multiplier::default(),
            s8_x0: DataRegister::default(),
            s8_x1: DataRegister::default(),
            s8_zero: DataRegister::default(),
            s8_value: DataRegister::default(),
            s9_fetch: Register::default(),
            s9_load: Register::default(),
            s9_fails: Register::default(),
            s9_word_0: DataRegister::default(),
            s9_word_1: DataRegister::default(),
            s9_word_2: DataRegister::default(),
            s9_word_3: DataRegister::default(),
            s9_zero: DataRegister::default(),
            s9_area: DataRegister::default(),
            s9_value: DataRegister::default(),
            s10_fetch: Register::default(),
            s10_load: Register::default(),
            s10_fails: Register::default(),
            s10_word_0: DataRegister::default(),
            s10_word_1: DataRegister::default(),
            s10_word_2: DataRegister::default(),
            s10_word_3: DataRegister::default(),
            s10_zero: DataRegister::default(),
            s10_area: DataRegister::default(),
            s10_value: DataRegister::default(),
            beat: Wire::default(),
            size: Wire::default(),
            loads: Wire::default(),
            fetches: Wire::default(),
            sound: Wire::default(),
            outside: Wire::default(),
            zero_corner: Wire::default(),
            product: Wire::default(),
            fit_0: Wire::default(),
            fit_1: Wire::default(),
            fit_2: Wire::default(),
            fit_3: Wire::default(),
            beyond: Wire::default(),
            used: Wire::default(),
            too_large: Wire::default(),
            limit: Constant::new(U::new(limit as i64)),
        }
    }
}

impl<const M: usize, const X: usize, const R: usize, const T: usize, const B: usize> Logic
    for SatCorners<M, X, R, T, B>
{
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, span_x, span_y, s8_upper, s8_lower, s8_area);
        dff_setup!(self, clock, sized, side_x, side_y, slides, s1_fetch, s1_load, s1_fails, s1_x, s1_y, s1_a, s1_b);
        dff_setup!(self, clock, s1_value, s1_blank, s2_fetch, s2_load, s2_fails, s2_width, s2_value, s3_fetch);
        dff_setup!(self, clock, s3_load, s3_fails, s3_width, s3_value, s4_fetch, s4_load, s4_fails, s4_width);
        dff_setup!(self, clock, s4_value, s5_fetch, s5_load, s5_fails, s5_width, s5_value, s6_fetch, s6_load);
        dff_setup!(self, clock, s6_fails, s6_width, s6_value, s7_fetch, s7_load, s7_fails, s7_width, s7_upper);
        dff_setup!(self, clock, s7_lower, s7_columns, s7_rows, s7_x0, s7_x1, s7_zero_x0, s7_zero_x1, s7_zero_y0);
        dff_setup!(self, clock, s7_zero_y1, s7_value, s8_fetch, s8_load, s8_fails, s8_x0, s8_x1, s8_zero, s8_value);
        dff_setup!(self, clock, s9_fetch, s9_load, s9_fails, s9_word_0, s9_word_1, s9_word_2, s9_word_3, s9_zero);
        dff_setup!(self, clock, s9_area, s9_value, s10_fetch, s10_load, s10_fails, s10_word_0, s10_word_1);
        dff_setup!(self, clock, s10_word_2, s10_word_3, s10_zero, s10_area, s10_value);

        // s1_beat
        self.beat.next = self.go.val() && self.valid.val();
        self.size.next = self.beat.val() && self.kind.val() == 0;
        self.loads.next = self.beat.val() && self.kind.val() == 1;
        self.fetches.next = self.beat.val() && self.kind.val() >= 2;
        self.sound.next = self.width.val() != 0 && self.height.val() != 0;
        if self.size.val() {
            self.sized.d.next = self.sound.val();
            self.side_x.d.next = self.width.val();
            self.side_y.d.next = self.height.val();
            self.slides.d.next = self.slide.val();
        }
        if self.go.val() {
            self.s1_fetch.d.next = self.fetches.val();
            self.s1_load.d.next = self.loads.val() && self.sized.q.val();
            self.s1_fails.d.next = (self.size.val() && !self.sound.val())
                || ((self.loads.val() || self.fetches.val()) && !self.sized.q.val());
            self.s1_blank.d.next = !self.sized.q.val();
            self.s1_x.d.next = self.corner_x.val();
            self.s1_y.d.next = self.corner_y.val();
            self.s1_a.d.next = self.columns.val();
            self.s1_b.d.next = self.rows.val();
            self.s1_value.d.next = self.value.val();
        }

        // s2 to s6: the spans. Sides of 13 bits are positive in 14 and 18.
        self.span_x.go.next = self.go.val();
        self.span_x.corner.next = bit_cast_to::<S<18>>(self.s1_x.q.val());
        self.span_x.size.next = bit_cast_to::<S<18>>(self.s1_a.q.val());
        self.span_x.side.next = bit_cast_to::<S<18>>(self.side_x.q.val());
        self.span_x.slide.next = self.slides.q.val();
        self.span_x.load.next = self.s1_load.q.val();
        self.span_x.blank.next = self.s1_blank.q.val();
        self.span_y.go.next = self.go.val();
        self.span_y.corner.next = bit_cast_to::<S<18>>(self.s1_y.q.val());
        self.span_y.size.next = bit_cast_to::<S<18>>(self.s1_b.q.val());
        self.span_y.side.next = bit_cast_to::<S<18>>(self.side_y.q.val());
        self.span_y.slide.next = self.slides.q.val();
        self.span_y.load.next = self.s1_load.q.val();
        self.span_y.blank.next = self.s1_blank.q.val();
        self.outside.next = self.span_x.outside.val() || self.span_y.outside.val();
        if self.go.val() {
            self.s2_fetch.d.next = self.s1_fetch.q.val();
            self.s2_load.d.next = self.s1_load.q.val();
            self.s2_fails.d.next = self.s1_fails.q.val();
            self.s2_width.d.next = bit_cast_to::<S<14>>(self.side_x.q.val());
            self.s2_value.d.next = self.s1_value.q.val();
            self.s3_fetch.d.next = self.s2_fetch.q.val();
            self.s3_load.d.next = self.s2_load.q.val() && !self.outside.val();
            self.s3_fails.d.next = self.s2_fails.q.val() || self.outside.val();
            self.s3_width.d.next = self.s2_width.q.val();
            self.s3_value.d.next = self.s2_value.q.val();
            self.s4_fetch.d.next = self.s3_fetch.q.val();
            self.s4_load.d.next = self.s3_load.q.val();
            self.s4_fails.d.next = self.s3_fails.q.val();
            self.s4_width.d.next = self.s3_width.q.val();
            self.s4_value.d.next = self.s3_value.q.val();
            self.s5_fetch.d.next = self.s4_fetch.q.val();
            self.s5_load.d.next = self.s4_load.q.val();
            self.s5_fails.d.next = self.s4_fails.q.val();
            self.s5_width.d.next = self.s4_width.q.val();
            self.s5_value.d.next = self.s4_value.q.val();
            self.s6_fetch.d.next = self.s5_fetch.q.val();
            self.s6_load.d.next = self.s5_load.q.val();
            self.s6_fails.d.next = self.s5_fails.q.val();
            self.s6_width.d.next = self.s5_width.q.val();
            self.s6_value.d.next = self.s5_value.q.val();
        }

        // s7_factors: 13 bits each. What row 0 and column 0 make of it is never used.
        if self.go.val() {
            self.s7_fetch.d.next = self.s6_fetch.q.val();
            self.s7_load.d.next = self.s6_load.q.val();
            self.s7_fails.d.next = self.s6_fails.q.val();
            self.s7_width.d.next = self.s6_width.q.val();
            self.s7_value.d.next = self.s6_value.q.val();
            self.s7_upper.d.next = self.span_y.behind.val() - 1;
            self.s7_lower.d.next = self.span_y.first.val() - 1;
            self.s7_columns.d.next = self.span_x.behind.val() - self.span_x.first.val();
            self.s7_rows.d.next = self.span_y.behind.val() - self.span_y.first.val();
            self.s7_x0.d.next = self.span_x.first.val() - 1;
            self.s7_x1.d.next = self.span_x.behind.val() - 1;
            self.s7_zero_x0.d.next = self.span_x.first.val() == 0;
            self.s7_zero_x1.d.next = self.span_x.behind.val() == 0;
            self.s7_zero_y0.d.next = self.span_y.first.val() == 0;
            self.s7_zero_y1.d.next = self.span_y.behind.val() == 0;
        }

        // s8_product: 13 x 13 bits.
        self.s8_upper.enable.next = self.go.val();
        self.s8_upper.a.next = self.s7_upper.q.val();
        self.s8_upper.b.next = self.s7_width.q.val();
        self.s8_lower.enable.next = self.go.val();
        self.s8_lower.a.next = self.s7_lower.q.val();
        self.s8_lower.b.next = self.s7_width.q.val();
        self.s8_area.enable.next = self.go.val();
        self.s8_area.a.next = self.s7_columns.q.val();
        self.s8_area.b.next = self.s7_rows.q.val();
        self.zero_corner.next = bit_cast_to::<U<4>>(self.s7_zero_x1.q.val() || self.s7_zero_y1.q.val())
            | (bit_cast_to::<U<4>>(self.s7_zero_x0.q.val() || self.s7_zero_y1.q.val()) << 1)
            | (bit_cast_to::<U<4>>(self.s7_zero_x1.q.val() || self.s7_zero_y0.q.val()) << 2)
            | (bit_cast_to::<U<4>>(self.s7_zero_x0.q.val() || self.s7_zero_y0.q.val()) << 3);
        if self.go.val() {
            self.s8_fetch.d.next = self.s7_fetch.q.val();
            self.s8_load.d.next = self.s7_load.q.val();
            self.s8_fails.d.next = self.s7_fails.q.val();
            self.s8_value.d.next = self.s7_value.q.val();
            self.s8_x0.d.next = bit_cast_to::<U<28>>(self.s7_x0.q.val());
            self.s8_x1.d.next = bit_cast_to::<U<28>>(self.s7_x1.q.val());
            self.s8_zero.d.next = self.zero_corner.val();
        }

        // s9_words: below 2^26 each, and so is the area.
        self.product.next = bit_cast_to::<U<28>>(self.s8_area.p.val());
        self.too_large.next = bit_cast_to::<U<R>>(self.product.val()) >= self.limit.val();
        if self.go.val() {
            self.s9_fetch.d.next = self.s8_fetch.q.val();
            self.s9_load.d.next = self.s8_load.q.val();
            self.s9_fails.d.next = self.s8_fails.q.val() || (self.s8_fetch.q.val() && self.too_large.val());
            self.s9_value.d.next = self.s8_value.q.val();
            self.s9_word_0.d.next = bit_cast_to::<U<28>>(self.s8_upper.p.val()) + self.s8_x1.q.val();
            self.s9_word_1.d.next = bit_cast_to::<U<28>>(self.s8_upper.p.val()) + self.s8_x0.q.val();
            self.s9_word_2.d.next = bit_cast_to::<U<28>>(self.s8_lower.p.val()) + self.s8_x1.q.val();
            self.s9_word_3.d.next = bit_cast_to::<U<28>>(self.s8_lower.p.val()) + self.s8_x0.q.val();
            self.s9_zero.d.next = self.s8_zero.q.val();
            self.s9_area.d.next = bit_cast_to::<U<R>>(self.product.val());
        }

        // s10_inside: words beyond the memory are zero, and an error if they are looked for.
        self.fit_0.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s9_word_0.q.val()));
        self.fit_1.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s9_word_1.q.val()));
        self.fit_2.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s9_word_2.q.val()));
        self.fit_3.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s9_word_3.q.val()));
        self.beyond.next = bit_cast_to::<U<4>>(self.fit_0.val() != self.s9_word_0.q.val())
            | (bit_cast_to::<U<4>>(self.fit_1.val() != self.s9_word_1.q.val()) << 1)
            | (bit_cast_to::<U<4>>(self.fit_2.val() != self.s9_word_2.q.val()) << 2)
            | (bit_cast_to::<U<4>>(self.fit_3.val() != self.s9_word_3.q.val()) << 3);
        self.used.next = self.beyond.val() & !self.s9_zero.q.val();
        if self.go.val() {
            self.s10_fetch.d.next = self.s9_fetch.q.val();
            self.s10_load.d.next = self.s9_load.q.val() && !self.beyond.val().get_bit(0);
            self.s10_fails.d.next = self.s9_fails.q.val()
                || (self.s9_fetch.q.val() && self.used.val() != 0)
                || (self.s9_load.q.val() && self.beyond.val().get_bit(0));
            self.s10_word_0.d.next = bit_cast_to::<U<T>>(self.s9_word_0.q.val());
            self.s10_word_1.d.next = bit_cast_to::<U<T>>(self.s9_word_1.q.val());
            self.s10_word_2.d.next = bit_cast_to::<U<T>>(self.s9_word_2.q.val());
            self.s10_word_3.d.next = bit_cast_to::<U<T>>(self.s9_word_3.q.val());
            self.s10_zero.d.next = self.s9_zero.q.val() | self.beyond.val();
            self.s10_area.d.next = self.s9_area.q.val();
            self.s10_value.d.next = self.s9_value.q.val();
        }
        self.fetch.next = self.s10_fetch.q.val();
        self.load.next = self.s10_load.q.val();
        self.fails.next = self.s10_fails.q.val();
        self.word_0.next = self.s10_word_0.q.val();
        self.word_1.next = self.s10_word_1.q.val();
        self.word_2.next = self.s10_word_2.q.val();
        self.word_3.next = self.s10_word_3.q.val();
        self.zero.next = self.s10_zero.q.val();
        self.area.next = self.s10_area.q.val();
        self.load_value.next = self.s10_value.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_corners")
    }
}

latches! { [const M: usize, const X: usize, const R: usize, const T: usize, const B: usize] SatCorners<M, X, R, T, B>: sized, side_x, side_y, slides, s1_fetch, s1_load, s1_fails, s1_x, s1_y, s1_a, s1_b, s1_value, s1_blank, s2_fetch, s2_load, s2_fails, s2_width, s2_value, s3_fetch, s3_load, s3_fails, s3_width, s3_value, s4_fetch, s4_load, s4_fails, s4_width, s4_value, s5_fetch, s5_load, s5_fails, s5_width, s5_value, s6_fetch, s6_load, s6_fails, s6_width, s6_value, s7_fetch, s7_load, s7_fails, s7_width, s7_upper, s7_lower, s7_columns, s7_rows, s7_x0, s7_x1, s7_zero_x0, s7_zero_x1, s7_zero_y0, s7_zero_y1, s7_value, s8_fetch, s8_load, s8_fails, s8_x0, s8_x1, s8_zero, s8_value, s9_fetch, s9_load, s9_fails, s9_word_0, s9_word_1, s9_word_2, s9_word_3, s9_zero, s9_area, s9_value, s10_fetch, s10_load, s10_fails, s10_word_0, s10_word_1, s10_word_2, s10_word_3, s10_zero, s10_area, s10_value, span_x, span_y, s8_upper, s8_lower, s8_area }
