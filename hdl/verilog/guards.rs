// SPDX-License-Identifier: MIT OR Apache-2.0
//! Scan of kernel sources for what rust-hdl's macro drops before the syntax tree, so that no back-end can see it.

/// Something in a kernel that simulates in one way and would be emitted in another.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct GuardFinding {
    /// Line, counted from 1.
    pub line: usize,
    /// The line's text.
    pub text: String,
    /// What is wrong, and what to write in its place.
    pub what: &'static str,
}

const GUARD: &str = "the guard of a match arm is dropped: use an `if` inside the arm";
const INCLUSIVE: &str = "the `=` of `..=` is dropped: use `..`";
const CONDITIONAL: &str = "a `cfg` is dropped: choose by a `Constant`";
const INDEX: &str = "`.index()` is dropped: it may only end the index of `get_bit`, `get_bits` or `replace_bit`";
const CALL: &str = "a function whose name begins like a cast is taken for one: only `bit_cast_to` is";

/// Match arms with a guard inside `#[hdl_gen]` functions. Strings and comments are passed over.
pub fn scan_match_guards(source: &str) -> Vec<GuardFinding> {
    scan_kernels(source).into_iter().filter(|f| f.what == GUARD).collect()
}

/// Everything inside `#[hdl_gen]` functions that the macro drops: guards, inclusive ranges, `cfg` on statements,
/// `.index()` in arithmetic or comparisons, and functions mistaken for casts.
pub fn scan_kernels(source: &str) -> Vec<GuardFinding> {
    let code = blank(source);
    let mut findings = vec![];
    let mut add = |at: usize, what| {
        let line = source[..at].matches('\n').count();
        let text = source.lines().nth(line).unwrap_or("").trim().to_string();
        findings.push(GuardFinding { line: line + 1, text, what });
    };
    let mut from = 0;
    while let Some(found) = code[from..].find("#[hdl_gen]") {
        let Some(start) = code[from + found..].find('{').map(|k| from + found + k) else { break };
        let end = closing(&code, start);
        for (k, _) in code[start..end].match_indices("=>").map(|(k, m)| (start + k, m)) {
            if words(arm(&code[start..k])).any(|w| w == "if") {
                add(k, GUARD);
            }
        }
        for (pattern, what) in [("..=", INCLUSIVE), ("#[cfg", CONDITIONAL)] {
            for (k, _) in code[start..end].match_indices(pattern) {
                add(start + k, what);
            }
        }
        for (k, m) in code[start..end].match_indices(".index()") {
            if !is_index(&code[start..start + k], &code[start + k + m.len()..end]) {
                add(start + k, INDEX);
            }
        }
        for (k, _) in code[start..end].match_indices(['b', 'B']).map(|(k, m)| (start + k, m)) {
            if is_false_cast(&code[start..k], &code[k..end]) {
                add(k, CALL);
            }
        }
        from = end;
    }
    findings
}

/// The source with comments, strings and characters replaced by blanks, at the same places.
fn blank(source: &str) -> String {
    let bytes = source.as_bytes();
    let mut out: Vec<u8> = bytes.to_vec();
    let mut k = 0;
    while k < bytes.len() {
        let rest = &source.as_bytes()[k..];
        let hashes = rest.iter().skip(1).take_while(|b| **b == b'#').count();
        let starts_word = k == 0 || !(bytes[k - 1].is_ascii_alphanumeric() || bytes[k - 1] == b'_');
        let length = if rest.starts_with(b"//") {
            rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len())
        } else if rest.starts_with(b"/*") {
            comment(rest)
        } else if rest[0] == b'r' && starts_word && rest.get(1 + hashes) == Some(&b'"') {
            let close = format!("\"{}", "#".repeat(hashes));
            find(&rest[2 + hashes..], close.as_bytes()).map_or(rest.len(), |p| p + 2 + hashes + close.len())
        } else if rest[0] == b'"' {
            let mut end = 1;
            while end < rest.len() && rest[end] != b'"' {
                end += if rest[end] == b'\\' { 2 } else { 1 };
            }
            (end + 1).min(rest.len())
        } else if rest[0] == b'\'' && rest.get(1) == Some(&b'\\') {
            find(&rest[3..], b"'").map_or(1, |p| p + 4)
        } else if rest[0] == b'\'' && rest.get(2) == Some(&b'\'') {
            3
        } else {
            k += 1;
            continue;
        };
        out[k..k + length].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
        k += length;
    }
    String::from_utf8_lossy(&out).into_owned()
}

/// Length of a block comment, which may hold others.
fn comment(text: &[u8]) -> usize {
    let (mut depth, mut k) = (0, 0);
    while k < text.len() {
        match &text[k..] {
            rest if rest.starts_with(b"/*") => (depth, k) = (depth + 1, k + 2),
            rest if rest.starts_with(b"*/") => (depth, k) = (depth - 1, k + 2),
            _ => k += 1,
        }
        if depth == 0 {
            break;
        }
    }
    k
}

fn find(text: &[u8], what: &[u8]) -> Option<usize> {
    text.windows(what.len()).position(|w| w == what)
}

/// Where the bracket at `start` closes.
fn closing(code: &str, start: usize) -> usize {
    let mut depth = 0;
    for (k, c) in code[start..].char_indices() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            return start + k;
        }
    }
    code.len()
}

/// The pattern and guard at the end of `before`, which ends at `=>`.
fn arm(before: &str) -> &str {
    let mut depth = 0;
    for (k, c) in before.char_indices().rev() {
        depth += i32::from(matches!(c, ')' | ']')) - i32::from(matches!(c, '(' | '['));
        if depth == 0 && matches!(c, '{' | '}' | ',') {
            return &before[k + 1..];
        }
    }
    before
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}

/// Whether an `.index()` between these texts ends the index of a selection, behind a plain path.
fn is_index(before: &str, after: &str) -> bool {
    let mut depth = 0;
    let mut start = before.len();
    for (k, c) in before.char_indices().rev() {
        depth += i32::from(matches!(c, ')' | ']')) - i32::from(matches!(c, '(' | '['));
        let part = c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '(' | ')' | '[' | ']') || c.is_whitespace();
        if depth < 0 || !part {
            break;
        }
        start = k;
    }
    let call = before[..start].trim_end();
    let ends = matches!(after.trim_start().chars().next(), Some(')' | ','));
    let name = call.strip_suffix('(').map(str::trim_end).unwrap_or("");
    let selects = ["get_bit", "replace_bit"].iter().any(|n| name.ends_with(n))
        || name.ends_with('>') && name.rsplit_once("::<").is_some_and(|(n, _)| n.ends_with("get_bits"));
    ends && selects
}

/// Whether a word begins here that the macro takes for a cast, and that is none.
fn is_false_cast(before: &str, here: &str) -> bool {
    let starts = !before.ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | ':'));
    let word = words(here).next().unwrap_or("");
    let called = here[word.len()..].trim_start().starts_with(['(', ':']);
    let prefix = ["bit_cast", "bits", "Bits"].iter().any(|p| word.starts_with(p));
    starts && called && prefix && word != "bit_cast_to"
}
