// SPDX-License-Identifier: MIT OR Apache-2.0
//! No kernel of this crate holds what the kernel macro drops silently, and the scan finds it where it is planted.

use relief_hdl::verilog::{scan_kernels, scan_match_guards};
use std::path::{Path, PathBuf};

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()) {
        if entry.is_dir() {
            sources(&entry, out);
        } else if entry.extension().is_some_and(|e| e == "rs") {
            out.push(entry);
        }
    }
}

#[test]
fn kernels_hold_nothing_that_the_macro_drops() {
    let (mut files, mut kernels) = (vec![], 0);
    sources(Path::new(env!("CARGO_MANIFEST_DIR")), &mut files);
    // These two hold on purpose what is to be found and refused.
    let planted = ["tests/verilog_source.rs", "tests/verilog_refusals.rs"];
    for file in files.iter().filter(|f| !planted.iter().any(|p| f.ends_with(p))) {
        let text = std::fs::read_to_string(file).unwrap();
        kernels += text.matches("#[hdl_gen]").count();
        let findings = scan_kernels(&text);
        assert!(findings.is_empty(), "{}: {findings:#?}", file.display());
    }
    assert!(kernels > 0, "the scan saw no kernel");
}

/// A source whose kernel is `body`.
fn kernel(body: &str) -> String {
    format!("impl Logic for X {{\n    #[hdl_gen]\n    fn update(&mut self) {{\n{body}\n    }}\n}}\n")
}

#[test]
fn a_planted_guard_is_found() {
    let body = "match self.s.val() {\n    S::A if self.x.val() => {}\n    S::B => { self.y.next = 1.into(); }\n    \
                S::C if (self.a.val(), self.b.val()).0 => (),\n    _ => {}\n}";
    let lines: Vec<usize> = scan_match_guards(&kernel(body)).iter().map(|f| f.line).collect();
    assert_eq!(lines, [5, 7]);
    let bare = scan_match_guards(&kernel("match x { S::A\n        if y\n        => z, _ => w }"));
    assert_eq!(bare.len(), 1);
}

#[test]
fn strings_comments_and_other_functions_are_passed_over() {
    let quiet = [
        kernel("// S::A if x => {}\n/* S::A if x => /* nested */ 0..=3 */ match s { S::A => if x {} }"),
        kernel("println!(\"S::A if x => \\\" {} }\"); match s { S::A => { if x { y } } S::B => {} }"),
        kernel("if x { match s { S::A => {} _ => {} } } else if y { match s { S::A => {} } }"),
        kernel("let c = '\"'; match s { '{' => {} _ => {} }"),
        format!("{}fn other() {{ match s {{ S::A if x => {{}} _ => {{}} }} }}", kernel("")),
        "fn other() { r#\"#[hdl_gen] fn update() { match s { A if b => {} } }\"#; }".into(),
    ];
    for source in quiet {
        assert_eq!(scan_kernels(&source), [], "{source}");
    }
}

#[test]
fn other_dropped_constructs_are_found() {
    let found = |body: &str| scan_kernels(&kernel(body)).len();
    assert_eq!(found("for i in 0..=3 { self.a[i].next = self.b[i].val(); }"), 1);
    assert_eq!(found("for i in 0..3 { self.a[i].next = self.b[i].val(); }"), 0);
    assert_eq!(found("#[cfg(test)]\nself.a.next = self.b.val();"), 1);
    assert_eq!(found("self.a.next = self.v.val().get_bit(self.k.val().index());"), 0);
    assert_eq!(found("self.a.next = self.v.val().get_bits::<4>(self.k.val().index());"), 0);
    assert_eq!(found("self.a.next = self.v.val().replace_bit(self.k.val().index(), true);"), 0);
    assert_eq!(found("self.a.next = self.v.val().get_bit(self.k.val().index() + 1);"), 1);
    assert_eq!(found("self.a.next = self.k.val().index() < self.j.val().index();"), 2);
    assert_eq!(found("self.a.next = bits_reversed(self.k.val());"), 1);
    assert_eq!(found("self.a.next = bit_cast_to::<S<8>>(self.k.val());"), 0);
    assert_eq!(found("self.bits.d.next = self.bits.q.val();"), 0);
}
