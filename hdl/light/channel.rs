// SPDX-License-Identifier: MIT OR Apache-2.0
//! One channel of the colour: its albedo, and what the surface sends of the light that falls on it.
//!
//! ```text
//! albedo = from + (to - from) along     reflected = albedo diffuse + highlight     colour = albedo ambient + reflected light
//! ```
//!
//! | port           | format     | meaning |   Latency 144 from s1, interval 1; holds while `go` is low
//! | ramp_0 .. ramp_4, ambient | UQ1.16 | at most 1.0, at s1 |
//! | light          | UQ3.16     | at most 4.0, at s1 |
//! | at, along      | unsigned 2, UQ0.14 | place on the ramp, at s8 |
//! | diffuse        | UQ1.16     | at most 1.0, at s134 |
//! | highlight      | UQ2.32     | at most 1.0, at s137 |
//! | colour         | unsigned 8 | at s145: saturates |
//!
//! | stage              | operation                          | width |
//! | s9                 | the colours below and above        | |
//! | s10 .. s14_albedo  | what is between them               | UQ1.16 |
//! | s15 .. s17_ambient | albedo times ambient, which waits  | UQ1.16 |
//! | s135 .. s138_reflected | albedo times diffuse, and highlight | at most 2.0: UQ2.16 |
//! | s139 .. s142_lit   | times light                        | at most 8.0: UQ5.16 |
//! | s143, s144_cut     | and ambient, at most 1.0           | UQ1.16 |
//! | s145_colour        | times 255, rounded half up         | 8 bits |

use crate::pipeline::{Delay, DspProduct, FarDelay};
use crate::prelude::*;

/// Channel of a colour.
#[derive(Clone, Debug, LogicBlock)]
#[allow(missing_docs)]
pub struct Channel {
    pub clock: Input<ClockReset>,
    pub go: Input<Bit>,
    pub ramp_0: Input<U<17>>,
    pub ramp_1: Input<U<17>>,
    pub ramp_2: Input<U<17>>,
    pub ramp_3: Input<U<17>>,
    pub ramp_4: Input<U<17>>,
    pub ambient: Input<U<17>>,
    pub light: Input<U<19>>,
    pub at: Input<U<2>>,
    pub along: Input<U<14>>,
    pub diffuse: Input<U<17>>,
    pub highlight: Input<U<34>>,
    pub colour: Output<U<8>>,
    s8_ramp_0: Delay<17, 7>,
    s8_ramp_1: Delay<17, 7>,
    s8_ramp_2: Delay<17, 7>,
    s8_ramp_3: Delay<17, 7>,
    s8_ramp_4: Delay<17, 7>,
    s9_from: DataRegister<U<17>>,
    s9_to: DataRegister<U<17>>,
    s9_along: DataRegister<U<14>>,
    s10_from: DataRegister<U<17>>,
    s10_span: DataRegister<S<18>>,
    s10_along: DataRegister<U<14>>,
    s13_step: DspProduct<18, 15, 33>,
    s11_from: DataRegister<U<17>>,
    s12_from: DataRegister<U<17>>,
    s13_from: DataRegister<U<17>>,
    s14_albedo: DataRegister<U<17>>,
    s14_ambient: Delay<17, 13>,
    s17_ambient: DspProduct<18, 18, 36>,
    s142_ambient: FarDelay<17, 14, 13>,
    s134_albedo: FarDelay<17, 13, 16>,
    s138_light: FarDelay<19, 15, 17>,
    s137_diffuse: DspProduct<18, 18, 36>,
    s138_reflected: DataRegister<U<18>>,
    s141_lit: DspProduct<18, 18, 36>,
    s139_upper: DataRegister<U<20>>,
    s140_upper: DataRegister<U<20>>,
    s141_upper: DataRegister<U<20>>,
    s142_lit: DataRegister<U<21>>,
    s143_sum: DataRegister<U<22>>,
    s144_cut: DataRegister<U<17>>,
    s145_colour: DataRegister<U<8>>,
    from: Wire<U<17>>,
    to: Wire<U<17>>,
    reflected: Wire<U<35>>,
    reflected_low: Wire<U<17>>,
    light_1: Wire<U<20>>,
    reflected_1: Wire<U<20>>,
    reflected_2: Wire<U<20>>,
    cut: Wire<U<25>>,
    scaled: Wire<U<25>>,
    one: Constant<U<22>>,
}

impl Default for Channel {
    fn default() -> Self {
        Self {
            clock: Input::default(),
            go: Input::default(),
            ramp_0: Input::default(),
            ramp_1: Input::default(),
            ramp_2: Input::default(),
            ramp_3: Input::default(),
            ramp_4: Input::default(),
            ambient: Input::default(),
            light: Input::default(),
            at: Input::default(),
            along: Input::default(),
            diffuse: Input::default(),
            highlight: Input::default(),
            colour: Output::default(),
            s8_ramp_0: Delay::default(),
            s8_ramp_1: Delay::default(),
            s8_ramp_2: Delay::default(),
            s8_ramp_3: Delay::default(),
            s8_ramp_4: Delay::default(),
            s9_from: DataRegister::default(),
            s9_to: DataRegister::default(),
            s9_along: DataRegister::default(),
            s10_from: DataRegister::default(),
            s10_span: DataRegister::default(),
            s10_along: DataRegister::default(),
            s13_step: DspProduct::default(),
            s11_from: DataRegister::default(),
            s12_from: DataRegister::default(),
            s13_from: DataRegister::default(),
            s14_albedo: DataRegister::default(),
            s14_ambient: Delay::default(),
            s17_ambient: DspProduct::default(),
            s142_ambient: FarDelay::default(),
            s134_albedo: FarDelay::default(),
            s138_light: FarDelay::default(),
            s137_diffuse: DspProduct::default(),
            s138_reflected: DataRegister::default(),
            s141_lit: DspProduct::default(),
            s139_upper: DataRegister::default(),
            s140_upper: DataRegister::default(),
            s141_upper: DataRegister::default(),
            s142_lit: DataRegister::default(),
            s143_sum: DataRegister::default(),
            s144_cut: DataRegister::default(),
            s145_colour: DataRegister::default(),
            from: Wire::default(),
            to: Wire::default(),
            reflected: Wire::default(),
            reflected_low: Wire::default(),
            light_1: Wire::default(),
            reflected_1: Wire::default(),
            reflected_2: Wire::default(),
            cut: Wire::default(),
            scaled: Wire::default(),
            one: Constant::new(U::new(1 << 16)),
        }
    }
}

impl Channel {
    /// Cycles from the first stage to the colour.
    pub const LATENCY: usize = 144;
}

impl Logic for Channel {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(
            self,
            clock,
            s8_ramp_0,
            s8_ramp_1,
            s8_ramp_2,
            s8_ramp_3,
            s8_ramp_4,
            s13_step,
            s14_ambient,
            s17_ambient,
            s142_ambient,
            s134_albedo,
            s138_light,
            s137_diffuse,
            s141_lit
        );
        dff_setup!(
            self,
            clock,
            s9_from,
            s9_to,
            s9_along,
            s10_from,
            s10_span,
            s10_along,
            s11_from,
            s12_from,
            s13_from,
            s14_albedo,
            s138_reflected,
            s139_upper,
            s140_upper,
            s141_upper,
            s142_lit,
            s143_sum,
            s144_cut,
            s145_colour
        );
        self.colour.next = self.s145_colour.q.val();

        // s2 to s14
        self.s8_ramp_0.go.next = self.go.val();
        self.s8_ramp_0.value.next = self.ramp_0.val();
        self.s8_ramp_1.go.next = self.go.val();
        self.s8_ramp_1.value.next = self.ramp_1.val();
        self.s8_ramp_2.go.next = self.go.val();
        self.s8_ramp_2.value.next = self.ramp_2.val();
        self.s8_ramp_3.go.next = self.go.val();
        self.s8_ramp_3.value.next = self.ramp_3.val();
        self.s8_ramp_4.go.next = self.go.val();
        self.s8_ramp_4.value.next = self.ramp_4.val();
        self.from.next = self.s8_ramp_0.delayed.val();
        self.to.next = self.s8_ramp_1.delayed.val();
        if self.at.val() == 1 {
            self.from.next = self.s8_ramp_1.delayed.val();
            self.to.next = self.s8_ramp_2.delayed.val();
        } else if self.at.val() == 2 {
            self.from.next = self.s8_ramp_2.delayed.val();
            self.to.next = self.s8_ramp_3.delayed.val();
        } else if self.at.val() == 3 {
            self.from.next = self.s8_ramp_3.delayed.val();
            self.to.next = self.s8_ramp_4.delayed.val();
        }
        self.s13_step.go.next = self.go.val();
        self.s13_step.a.next = self.s10_span.q.val();
        self.s13_step.b.next = bit_cast_to::<S<15>>(self.s10_along.q.val());

        // s15 to s17, and what waits
        self.s14_ambient.go.next = self.go.val();
        self.s14_ambient.value.next = self.ambient.val();
        self.s17_ambient.go.next = self.go.val();
        self.s17_ambient.a.next = bit_cast_to::<S<18>>(self.s14_albedo.q.val());
        self.s17_ambient.b.next = bit_cast_to::<S<18>>(self.s14_ambient.delayed.val());
        self.s142_ambient.go.next = self.go.val();
        self.s142_ambient.value.next = bit_cast_to::<U<17>>(self.s17_ambient.p.val() >> 16);
        self.s134_albedo.go.next = self.go.val();
        self.s134_albedo.value.next = self.s14_albedo.q.val();
        self.s138_light.go.next = self.go.val();
        self.s138_light.value.next = self.light.val();

        // s135 to s138
        self.s137_diffuse.go.next = self.go.val();
        self.s137_diffuse.a.next = bit_cast_to::<S<18>>(self.s134_albedo.delayed.val());
        self.s137_diffuse.b.next = bit_cast_to::<S<18>>(self.diffuse.val());
        self.reflected.next =
            bit_cast_to::<U<35>>(self.s137_diffuse.p.val()) + bit_cast_to::<U<35>>(self.highlight.val());

        // s139 to s142: one bit of what is reflected and two of the light stand above a digit.
        self.reflected_low.next = self.s138_reflected.q.val().get_bits::<17>(0);
        self.s141_lit.go.next = self.go.val();
        self.s141_lit.a.next = bit_cast_to::<S<18>>(self.reflected_low.val());
        self.s141_lit.b.next = bit_cast_to::<S<18>>(self.s138_light.delayed.val().get_bits::<17>(0));
        self.light_1.next = 0.into();
        if self.s138_reflected.q.val().get_bit(17) {
            self.light_1.next = bit_cast_to::<U<20>>(self.s138_light.delayed.val());
        }
        self.reflected_1.next = 0.into();
        if self.s138_light.delayed.val().get_bit(17) {
            self.reflected_1.next = bit_cast_to::<U<20>>(self.reflected_low.val());
        }
        self.reflected_2.next = 0.into();
        if self.s138_light.delayed.val().get_bit(18) {
            self.reflected_2.next = bit_cast_to::<U<20>>(self.reflected_low.val()) << 1;
        }

        // s145: times 255, and the half.
        self.cut.next = bit_cast_to::<U<25>>(self.s144_cut.q.val());
        self.scaled.next = (self.cut.val() << 8) - self.cut.val() + 0x8000;

        if self.go.val() {
            self.s9_from.d.next = self.from.val();
            self.s9_to.d.next = self.to.val();
            self.s9_along.d.next = self.along.val();
            self.s10_from.d.next = self.s9_from.q.val();
            self.s10_span.d.next =
                bit_cast_to::<S<18>>(self.s9_to.q.val()) - bit_cast_to::<S<18>>(self.s9_from.q.val());
            self.s10_along.d.next = self.s9_along.q.val();
            self.s11_from.d.next = self.s10_from.q.val();
            self.s12_from.d.next = self.s11_from.q.val();
            self.s13_from.d.next = self.s12_from.q.val();
            self.s14_albedo.d.next = self.s13_from.q.val() + bit_cast_to::<U<17>>(self.s13_step.p.val() >> 14);
            self.s138_reflected.d.next = bit_cast_to::<U<18>>(self.reflected.val() >> 16);
            self.s139_upper.d.next = self.light_1.val() + self.reflected_1.val() + self.reflected_2.val();
            self.s140_upper.d.next = self.s139_upper.q.val();
            self.s141_upper.d.next = self.s140_upper.q.val();
            self.s142_lit.d.next = bit_cast_to::<U<21>>(self.s141_lit.p.val() >> 16)
                + (bit_cast_to::<U<21>>(self.s141_upper.q.val()) << 1);
            self.s143_sum.d.next =
                bit_cast_to::<U<22>>(self.s142_lit.q.val()) + bit_cast_to::<U<22>>(self.s142_ambient.delayed.val());
            self.s144_cut.d.next = bit_cast_to::<U<17>>(self.s143_sum.q.val());
            if self.s143_sum.q.val() > self.one.val() {
                self.s144_cut.d.next = bit_cast_to::<U<17>>(self.one.val());
            }
            self.s145_colour.d.next = bit_cast_to::<U<8>>(self.scaled.val() >> 16);
        }
    }

    fn timing(&self) -> Vec<TimingInfo> {
        module_name("channel")
    }
}

latches! { [] Channel: s8_ramp_0, s8_ramp_1, s8_ramp_2, s8_ramp_3, s8_ramp_4, s13_step, s14_ambient, s17_ambient, s142_ambient, s134_albedo, s138_light, s137_diffuse, s141_lit, s9_from, s9_to, s9_along, s10_from, s10_span, s10_along, s11_from, s12_from, s13_from, s14_albedo, s138_reflected, s139_upper, s140_upper, s141_upper, s142_lit, s143_sum, s144_cut, s145_colour }
