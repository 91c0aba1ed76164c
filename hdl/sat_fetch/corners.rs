// SPDX-License-Identifier: MIT OR Apache-2.0
//! From beats to the four words of a rectangle: the front of both sums.
//!
//! word(x, y) = (y - 1) * width + x - 1; row 0 and column 0 have no word, they are zero
//!
//! | stage      | what it does                              |   Latency 4, interval 1; holds while `go` is low
//! | s1_beat    | takes a beat, keeps the size              |   Golden: models::sat_fetch   Error 0
//! | s2_span    | both axes, cut or slid                    |
//! | s3_product | rows times width, and the area            |
//! | s4_words   | four words, and which of them are zero    |

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
    s2_x0: DataRegister<S<14>>,
    s2_x1: DataRegister<S<14>>,
    s2_y0: DataRegister<S<14>>,
    s2_y1: DataRegister<S<14>>,
    s2_width: DataRegister<S<14>>,
    s2_value: DataRegister<U<B>>,
    s3_fetch: Register<Bit>,
    s3_load: Register<Bit>,
    s3_fails: Register<Bit>,
    s3_upper: Multiplier<14, 14, 28>,
    s3_lower: Multiplier<14, 14, 28>,
    s3_area: Multiplier<14, 14, 28>,
    s3_x0: DataRegister<U<28>>,
    s3_x1: DataRegister<U<28>>,
    s3_zero: DataRegister<U<4>>,
    s3_value: DataRegister<U<B>>,
    s4_fetch: Register<Bit>,
    s4_load: Register<Bit>,
    s4_fails: Register<Bit>,
    s4_word_0: DataRegister<U<28>>,
    s4_word_1: DataRegister<U<28>>,
    s4_word_2: DataRegister<U<28>>,
    s4_word_3: DataRegister<U<28>>,
    s4_zero: DataRegister<U<4>>,
    s4_area: DataRegister<U<R>>,
    s4_value: DataRegister<U<B>>,
    beat: Wire<Bit>,
    size: Wire<Bit>,
    loads: Wire<Bit>,
    fetches: Wire<Bit>,
    sound: Wire<Bit>,
    outside: Wire<Bit>,
    zero_x0: Wire<Bit>,
    zero_x1: Wire<Bit>,
    zero_y0: Wire<Bit>,
    zero_y1: Wire<Bit>,
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
            s2_x0: DataRegister::default(),
            s2_x1: DataRegister::default(),
            s2_y0: DataRegister::default(),
            s2_y1: DataRegister::default(),
            s2_width: DataRegister::default(),
            s2_value: DataRegister::default(),
            s3_fetch: Register::default(),
            s3_load: Register::default(),
            s3_fails: Register::default(),
            s3_upper: Multiplier::default(),
            s3_lower: Multiplier::default(),
            s3_area: Multiplier::default(),
            s3_x0: DataRegister::default(),
            s3_x1: DataRegister::default(),
            s3_zero: DataRegister::default(),
            s3_value: DataRegister::default(),
            s4_fetch: Register::default(),
            s4_load: Register::default(),
            s4_fails: Register::default(),
            s4_word_0: DataRegister::default(),
            s4_word_1: DataRegister::default(),
            s4_word_2: DataRegister::default(),
            s4_word_3: DataRegister::default(),
            s4_zero: DataRegister::default(),
            s4_area: DataRegister::default(),
            s4_value: DataRegister::default(),
            beat: Wire::default(),
            size: Wire::default(),
            loads: Wire::default(),
            fetches: Wire::default(),
            sound: Wire::default(),
            outside: Wire::default(),
            zero_x0: Wire::default(),
            zero_x1: Wire::default(),
            zero_y0: Wire::default(),
            zero_y1: Wire::default(),
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
        clock!(self, clock, s3_upper, s3_lower, s3_area);
        dff_setup!(self, clock, sized, side_x, side_y, slides, s1_fetch, s1_load, s1_fails, s1_x, s1_y);
        dff_setup!(self, clock, s1_a, s1_b, s1_value, s1_blank, s2_fetch, s2_load, s2_fails, s2_x0, s2_x1);
        dff_setup!(self, clock, s2_y0, s2_y1, s2_width, s2_value, s3_fetch, s3_load, s3_fails, s3_x0, s3_x1);
        dff_setup!(
            self, clock, s3_zero, s3_value, s4_fetch, s4_load, s4_fails, s4_word_0, s4_word_1, s4_word_2, s4_word_3
        );
        dff_setup!(self, clock, s4_zero, s4_area, s4_value);

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

        // s2_span: sides of 13 bits are positive in 14 and 18.
        self.span_x.corner.next = bit_cast_to::<S<18>>(self.s1_x.q.val());
        self.span_x.size.next = bit_cast_to::<S<18>>(self.s1_a.q.val());
        self.span_x.side.next = bit_cast_to::<S<18>>(self.side_x.q.val());
        self.span_x.slide.next = self.slides.q.val();
        self.span_x.load.next = self.s1_load.q.val();
        self.span_y.corner.next = bit_cast_to::<S<18>>(self.s1_y.q.val());
        self.span_y.size.next = bit_cast_to::<S<18>>(self.s1_b.q.val());
        self.span_y.side.next = bit_cast_to::<S<18>>(self.side_y.q.val());
        self.span_y.slide.next = self.slides.q.val();
        self.span_y.load.next = self.s1_load.q.val();
        self.outside.next = self.span_x.outside.val() || self.span_y.outside.val();
        if self.go.val() {
            self.s2_fetch.d.next = self.s1_fetch.q.val();
            self.s2_load.d.next = self.s1_load.q.val() && !self.outside.val();
            self.s2_fails.d.next = self.s1_fails.q.val() || self.outside.val();
            self.s2_width.d.next = bit_cast_to::<S<14>>(self.side_x.q.val());
            self.s2_value.d.next = self.s1_value.q.val();
            self.s2_x0.d.next = self.span_x.first.val();
            self.s2_x1.d.next = self.span_x.behind.val();
            self.s2_y0.d.next = self.span_y.first.val();
            self.s2_y1.d.next = self.span_y.behind.val();
            // Without a size there is no entry.
            if self.s1_blank.q.val() {
                self.s2_x0.d.next = 0.into();
                self.s2_x1.d.next = 0.into();
                self.s2_y0.d.next = 0.into();
                self.s2_y1.d.next = 0.into();
            }
        }

        // s3_product: 13 x 13 bits. What row 0 and column 0 make of it is never used.
        self.s3_upper.enable.next = self.go.val();
        self.s3_upper.a.next = self.s2_y1.q.val() - 1;
        self.s3_upper.b.next = self.s2_width.q.val();
        self.s3_lower.enable.next = self.go.val();
        self.s3_lower.a.next = self.s2_y0.q.val() - 1;
        self.s3_lower.b.next = self.s2_width.q.val();
        self.s3_area.enable.next = self.go.val();
        self.s3_area.a.next = self.s2_x1.q.val() - self.s2_x0.q.val();
        self.s3_area.b.next = self.s2_y1.q.val() - self.s2_y0.q.val();
        self.zero_x0.next = self.s2_x0.q.val() == 0;
        self.zero_x1.next = self.s2_x1.q.val() == 0;
        self.zero_y0.next = self.s2_y0.q.val() == 0;
        self.zero_y1.next = self.s2_y1.q.val() == 0;
        self.zero_corner.next = bit_cast_to::<U<4>>(self.zero_x1.val() || self.zero_y1.val())
            | (bit_cast_to::<U<4>>(self.zero_x0.val() || self.zero_y1.val()) << 1)
            | (bit_cast_to::<U<4>>(self.zero_x1.val() || self.zero_y0.val()) << 2)
            | (bit_cast_to::<U<4>>(self.zero_x0.val() || self.zero_y0.val()) << 3);
        if self.go.val() {
            self.s3_fetch.d.next = self.s2_fetch.q.val();
            self.s3_load.d.next = self.s2_load.q.val();
            self.s3_fails.d.next = self.s2_fails.q.val();
            self.s3_value.d.next = self.s2_value.q.val();
            self.s3_x0.d.next = bit_cast_to::<U<28>>(self.s2_x0.q.val()) - 1;
            self.s3_x1.d.next = bit_cast_to::<U<28>>(self.s2_x1.q.val()) - 1;
            self.s3_zero.d.next = self.zero_corner.val();
        }

        // s4_words: below 2^26 each, and so is the area.
        self.product.next = bit_cast_to::<U<28>>(self.s3_area.p.val());
        self.too_large.next = bit_cast_to::<U<R>>(self.product.val()) >= self.limit.val();
        if self.go.val() {
            self.s4_fetch.d.next = self.s3_fetch.q.val();
            self.s4_load.d.next = self.s3_load.q.val();
            self.s4_fails.d.next = self.s3_fails.q.val() || (self.s3_fetch.q.val() && self.too_large.val());
            self.s4_value.d.next = self.s3_value.q.val();
            self.s4_word_0.d.next = bit_cast_to::<U<28>>(self.s3_upper.p.val()) + self.s3_x1.q.val();
            self.s4_word_1.d.next = bit_cast_to::<U<28>>(self.s3_upper.p.val()) + self.s3_x0.q.val();
            self.s4_word_2.d.next = bit_cast_to::<U<28>>(self.s3_lower.p.val()) + self.s3_x1.q.val();
            self.s4_word_3.d.next = bit_cast_to::<U<28>>(self.s3_lower.p.val()) + self.s3_x0.q.val();
            self.s4_zero.d.next = self.s3_zero.q.val();
            self.s4_area.d.next = bit_cast_to::<U<R>>(self.product.val());
        }
        self.fit_0.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s4_word_0.q.val()));
        self.fit_1.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s4_word_1.q.val()));
        self.fit_2.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s4_word_2.q.val()));
        self.fit_3.next = bit_cast_to::<U<28>>(bit_cast_to::<U<T>>(self.s4_word_3.q.val()));
        self.beyond.next = bit_cast_to::<U<4>>(self.fit_0.val() != self.s4_word_0.q.val())
            | (bit_cast_to::<U<4>>(self.fit_1.val() != self.s4_word_1.q.val()) << 1)
            | (bit_cast_to::<U<4>>(self.fit_2.val() != self.s4_word_2.q.val()) << 2)
            | (bit_cast_to::<U<4>>(self.fit_3.val() != self.s4_word_3.q.val()) << 3);
        // What is looked for beyond the memory.
        self.used.next = self.beyond.val() & !self.s4_zero.q.val();
        self.fetch.next = self.s4_fetch.q.val();
        self.load.next = self.s4_load.q.val() && !self.beyond.val().get_bit(0);
        self.fails.next = self.s4_fails.q.val()
            || (self.s4_fetch.q.val() && self.used.val() != 0)
            || (self.s4_load.q.val() && self.beyond.val().get_bit(0));
        self.word_0.next = bit_cast_to::<U<T>>(self.s4_word_0.q.val());
        self.word_1.next = bit_cast_to::<U<T>>(self.s4_word_1.q.val());
        self.word_2.next = bit_cast_to::<U<T>>(self.s4_word_2.q.val());
        self.word_3.next = bit_cast_to::<U<T>>(self.s4_word_3.q.val());
        self.zero.next = self.s4_zero.q.val() | self.beyond.val();
        self.area.next = self.s4_area.q.val();
        self.load_value.next = self.s4_value.q.val();
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("sat_corners")
    }
}

latches! { [const M: usize, const X: usize, const R: usize, const T: usize, const B: usize] SatCorners<M, X, R, T, B>: sized, side_x, side_y, slides, s1_fetch, s1_load, s1_fails, s1_x, s1_y, s1_a, s1_b, s1_value, s1_blank, s2_fetch, s2_load, s2_fails, s2_x0, s2_x1, s2_y0, s2_y1, s2_width, s2_value, s3_fetch, s3_load, s3_fails, s3_x0, s3_x1, s3_zero, s3_value, s4_fetch, s4_load, s4_fails, s4_word_0, s4_word_1, s4_word_2, s4_word_3, s4_zero, s4_area, s4_value, s3_upper, s3_lower, s3_area }
