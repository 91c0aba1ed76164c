// SPDX-License-Identifier: MIT OR Apache-2.0
//! A bound on the error, in map units.

use std::fmt;
use std::str::FromStr;

/// A fraction of two integers, from 0 to 65535.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tolerance {
    over: u32,
    under: u32,
}

/// The largest denominator: sums of 45 bits times it have to fit.
const LARGEST_UNDER: u32 = 10_000;

impl Tolerance {
    /// `over / under` in lowest terms; `None` unless it is from 0 to 65535 and the denominator at most 10,000.
    pub fn new(over: u32, under: u32) -> Option<Tolerance> {
        let mut terms = [over, under];
        while terms[1] > 0 {
            terms = [terms[1], terms[0] % terms[1]];
        }
        let (over, under) = (over.checked_div(terms[0])?, under.checked_div(terms[0])?);
        let sound = (1..=LARGEST_UNDER).contains(&under) && u64::from(over) <= 65535 * u64::from(under);
        sound.then_some(Tolerance { over, under })
    }
    /// The numerator.
    pub const fn over(self) -> u32 {
        self.over
    }
    /// The denominator, 1 to 10,000.
    pub const fn under(self) -> u32 {
        self.under
    }
    /// In doubles.
    pub fn value(self) -> f64 {
        f64::from(self.over) / f64::from(self.under)
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.under == 1 { write!(f, "{}", self.over) } else { write!(f, "{}/{}", self.over, self.under) }
    }
}

impl FromStr for Tolerance {
    type Err = String;
    fn from_str(text: &str) -> Result<Tolerance, String> {
        let digits = |text: &str| (!text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())).then_some(());
        let whole = |text: &str| digits(text).and_then(|()| text.parse::<u32>().ok());
        let parsed = if let Some((over, under)) = text.split_once('/') {
            whole(over).zip(whole(under))
        } else if let Some((units, fraction)) = text.split_once('.') {
            let under = (fraction.len() <= 4).then(|| 10u32.pow(fraction.len() as u32));
            let parts = whole(units).zip(whole(fraction)).zip(under);
            parts.and_then(|((units, part), under)| Some((units.checked_mul(under)?.checked_add(part)?, under)))
        } else {
            whole(text).map(|units| (units, 1))
        };
        parsed.and_then(|(over, under)| Tolerance::new(over, under)).ok_or_else(|| {
            format!(
                "`{text}` is no bound; a number of map units from 0 to 65535 such as 20, 16.8 (up to four decimals) or 50/3 \
                 (down to {LARGEST_UNDER}ths) is expected"
            )
        })
    }
}
