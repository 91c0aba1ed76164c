// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constant loops and the indexes of arrays: `divs[i + 1]$x` becomes `divs$3$x`, as `Probe` calls it.

/// Replaces every `[index]` of a name by `$value`. None when an index is not made of literals and loop variables.
pub(super) fn resolve(name: &str, loops: &[(String, i128)]) -> Option<String> {
    let mut out = String::new();
    let mut rest = name;
    while let Some((before, after)) = rest.split_once('[') {
        let (index, behind) = after.split_once(']')?;
        let mut parser = Parser { text: index, loops };
        let value = parser.sum()?;
        if !parser.text.is_empty() || value < 0 {
            return None;
        }
        out += &format!("{before}${value}");
        rest = behind;
    }
    Some(out + rest)
}

/// Arithmetic of `usize` on literals and loop variables.
struct Parser<'a> {
    text: &'a str,
    loops: &'a [(String, i128)],
}

impl<'a> Parser<'a> {
    fn eat(&mut self, symbols: &[char]) -> Option<char> {
        let c = self.text.chars().next().filter(|c| symbols.contains(c))?;
        self.text = &self.text[1..];
        Some(c)
    }
    fn sum(&mut self) -> Option<i128> {
        let mut value = self.product()?;
        while let Some(op) = self.eat(&['+', '-']) {
            let right = self.product()?;
            value = if op == '+' { value.checked_add(right)? } else { value.checked_sub(right)? };
        }
        Some(value)
    }
    fn product(&mut self) -> Option<i128> {
        let mut value = self.atom()?;
        while let Some(op) = self.eat(&['*', '/', '%']) {
            let right = self.atom()?;
            value = match op {
                '*' => value.checked_mul(right)?,
                '/' => value.checked_div(right)?,
                _ => value.checked_rem(right)?,
            };
        }
        Some(value)
    }
    fn atom(&mut self) -> Option<i128> {
        if self.eat(&['(']).is_some() {
            let value = self.sum()?;
            self.eat(&[')'])?;
            return Some(value);
        }
        let end = self.text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(self.text.len());
        let (word, rest) = self.text.split_at(end);
        self.text = rest;
        let number = word.trim_end_matches("usize").replace('_', "");
        match number.parse() {
            Ok(value) => Some(value),
            Err(_) => self.loops.iter().rev().find(|(n, _)| n == word).map(|(_, value)| *value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::resolve;

    #[test]
    fn resolve_evaluates_indexes_as_rust_does() {
        let loops = [("i".to_string(), 4), ("j".to_string(), 1)];
        let cases = [
            ("x", Some("x")),
            ("divs[i]$x", Some("divs$4$x")),
            ("a[i-1-2]$b[2*(j+1)]", Some("a$1$b$4")),
            ("a[i/3%2]", Some("a$1")),
            ("a[0usize]", Some("a$0")),
            ("a[N-1]", None),
            ("a[j-2]", None),
            ("a[k$val()$index()]", None),
        ];
        for (name, expected) in cases {
            assert_eq!(resolve(name, &loops).as_deref(), expected, "{name}");
        }
    }
}
