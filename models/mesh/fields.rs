// SPDX-License-Identifier: MIT OR Apache-2.0
//! The words of a line, and the sentences about them.

use super::exact::Scaled;

/// Words of a line, separated by ASCII white space, counted from 1.
pub(crate) struct Fields<'a> {
    rest: &'a [u8],
    index: usize,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(line: &'a [u8]) -> Fields<'a> {
        Fields { rest: line, index: 0 }
    }

    /// What has not been read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next word.
    #[inline]
    pub(crate) fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|byte| !is_space(*byte))?;
        let word = &self.rest[start..];
        let end = word.iter().position(|byte| is_space(*byte)).unwrap_or(word.len());
        self.rest = &word[end..];
        self.index += 1;
        Some(&word[..end])
    }

    /// The next word, or the sentence that it is missing.
    #[inline]
    pub(crate) fn expect(&mut self, what: &str) -> Result<&'a [u8], String> {
        self.next().ok_or_else(|| format!("field {} is missing; {what} is expected", self.index + 1))
    }

    /// The next word as an integer that is less than 2^63 in magnitude.
    #[inline]
    pub(super) fn integer(&mut self, what: &str) -> Result<i64, String> {
        let word = self.expect(what)?;
        parse_integer(word).ok_or_else(|| self.wrong(word, &format!("is not {what}")))
    }

    /// The next word as a decimal.
    #[inline]
    pub(super) fn decimal(&mut self, what: &str) -> Result<Scaled, String> {
        let word = self.expect(what)?;
        Scaled::from_decimal(word).map_err(|why| self.wrong(word, &format!("{why}; {what} is expected")))
    }

    /// A sentence about the word that was read last.
    pub(crate) fn wrong(&self, word: &[u8], what: &str) -> String {
        format!("field {} {} {what}", self.index, quoted(word))
    }
}

/// ASCII white space, without the newline's privilege: lines have been cut before.
#[inline]
pub(super) fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0x0B | 0x0C)
}

/// A word of a file in backquotes: shortened, and without control characters.
pub(crate) fn quoted(word: &[u8]) -> String {
    let shown = String::from_utf8_lossy(&word[..word.len().min(40)]).escape_debug().to_string();
    if word.len() > 40 { format!("`{shown}...`") } else { format!("`{shown}`") }
}

/// An optional sign and 1 to 19 digits; `None` on anything else and on overflow.
#[inline]
pub(crate) fn parse_integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    if digits.is_empty() || digits.len() > 19 {
        return None;
    }
    let mut value = 0u64;
    for byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        // 19 digits stay below 10^19 < 2^64.
        value = value * 10 + u64::from(digit);
    }
    let value = i64::try_from(value).ok()?;
    Some(if negative { -value } else { value })
}
