// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes JUnit XML of what `cargo test` prints: `cargo test 2>&1 | cargo run --example junit > junit.xml`. `tests/run --junit`
//! calls it.
//!
//! Every suite has to hold as many tests as its summary counts, so that no test is lost between what other programs print;
//! where one does not, the exit code is 1.

use std::io::{Read, Write, stdin, stdout};
use std::process::ExitCode;

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// What has been read of a suite.
#[derive(Default)]
struct Suite {
    name: String,
    /// Name and verdict: `ok`, `FAILED`, `ignored`.
    cases: Vec<(String, String)>,
    /// A test whose verdict stands on a line of its own, behind what other programs have printed.
    open: Option<String>,
    /// What failed tests have printed.
    outputs: Vec<(String, String)>,
}

impl Suite {
    fn case(&mut self, name: &str, verdict: &str) {
        let word = verdict.split([' ', ',']).next().unwrap_or_default();
        match word {
            "ok" | "FAILED" | "ignored" => self.cases.push((name.to_owned(), word.to_owned())),
            _ => self.open = Some(name.to_owned()),
        }
    }

    fn count(&self, verdict: &str) -> usize {
        self.cases.iter().filter(|case| case.1 == verdict).count()
    }

    fn report(&self) -> TestSuite {
        let mut suite = TestSuite::new(self.name.as_str());
        for (name, verdict) in &self.cases {
            let status = match verdict.as_str() {
                "ok" => TestCaseStatus::success(),
                "ignored" => TestCaseStatus::skipped(),
                _ => {
                    let mut failed = TestCaseStatus::non_success(NonSuccessKind::Failure);
                    let output = self.outputs.iter().find(|(of, _)| of == name).map_or("", |(_, text)| text);
                    failed.set_message(output.lines().find(|line| !line.is_empty()).unwrap_or("failed"));
                    failed.set_description(output);
                    failed
                }
            };
            let mut case = TestCase::new(name.as_str(), status);
            case.set_classname(self.name.as_str());
            suite.add_test_case(case);
        }
        suite
    }
}

/// The number before a word of the summary.
fn number(summary: &str, word: &str) -> Option<usize> {
    let before = summary.split_once(word)?.0.trim_end();
    before.rsplit([' ', '.', ';']).next()?.parse().ok()
}

/// The report, and what does not add up.
fn convert(text: &str) -> (Report, Vec<String>) {
    let (mut report, mut odd) = (Report::new("cargo test"), Vec::new());
    let mut suite = Suite::default();
    let mut printing: Option<(String, String)> = None;
    let mut name = String::new();
    for line in text.lines() {
        let code = line.trim_start();
        if let Some(rest) = code.strip_prefix("Running ").or(code.strip_prefix("Doc-tests ")) {
            // `unittests src/lib.rs (target/release/deps/relief-0123)`
            name = rest.split(" (").next().unwrap_or(rest).to_owned();
        } else if line.starts_with("running ") && line.contains(" test") {
            suite = Suite { name: name.clone(), ..Suite::default() };
        } else if let Some(summary) = line.strip_prefix("test result: ") {
            suite.outputs.extend(printing.take());
            for (word, verdict) in [("passed", "ok"), ("failed", "FAILED"), ("ignored", "ignored")] {
                let (counted, found) = (number(summary, word), suite.count(verdict));
                if counted != Some(found) {
                    odd.push(format!("{}: {found} tests {word}, and the summary is: {summary}", suite.name));
                }
            }
            report.add_test_suite(suite.report());
            suite = Suite::default();
        } else if let Some(failed) = line.strip_prefix("---- ").and_then(|rest| rest.strip_suffix(" stdout ----")) {
            suite.outputs.extend(printing.take());
            printing = Some((failed.to_owned(), String::new()));
        } else if line == "failures:" {
            suite.outputs.extend(printing.take());
        } else if let Some((_, output)) = &mut printing {
            *output += line;
            output.push('\n');
        } else if let Some((test, verdict)) = line.strip_prefix("test ").and_then(|rest| rest.split_once(" ... ")) {
            suite.case(test, verdict);
        } else if ["ok", "FAILED"].contains(&line)
            && let Some(test) = suite.open.take()
        {
            suite.case(&test, line);
        }
    }
    if report.test_suites.is_empty() {
        odd.push("there is no test".to_owned());
    }
    (report, odd)
}

fn main() -> ExitCode {
    let mut bytes = Vec::new();
    if let Err(error) = stdin().read_to_end(&mut bytes) {
        eprintln!("the output of cargo test cannot be read: {error}");
        return ExitCode::FAILURE;
    }
    let (report, odd) = convert(&String::from_utf8_lossy(&bytes));
    let written = report.to_string().map_err(|error| error.to_string());
    if let Err(error) = written.and_then(|text| stdout().write_all(text.as_bytes()).map_err(|error| error.to_string()))
    {
        eprintln!("the report cannot be written: {error}");
        return ExitCode::FAILURE;
    }
    odd.iter().for_each(|line| eprintln!("{line}"));
    if odd.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOG: &str = "\
     Running unittests src/lib.rs (target/release/deps/relief-01)

running 0 tests

test result: ok. 0 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s

     Running tests/a.rs (target/release/deps/a-01)

running 4 tests
SKIPPED z3: install the Debian package z3
test a_is_right ... ok
test b_is_right ... FAILED
test c_is_long ... ignored, it takes minutes
test d_is_right ... SKIPPED fusesoc: install it
ok

failures:

---- b_is_right stdout ----

thread 'b_is_right' panicked at tests/a.rs:1:1:
1 < 2 & 3

failures:
    b_is_right

test result: FAILED. 2 passed; 1 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.10s

";

    #[test]
    fn junit_holds_every_test_and_what_a_failed_one_said() {
        let (report, odd) = convert(LOG);
        assert_eq!(odd, Vec::<String>::new());
        let text = report.to_string().unwrap();
        assert_eq!(text.matches("<testcase ").count(), 4, "{text}");
        assert_eq!([text.matches("<failure").count(), text.matches("<skipped").count()], [1, 1], "{text}");
        assert!(text.contains("1 &lt; 2 &amp; 3") && text.contains("classname=\"tests/a.rs\""), "{text}");
    }

    #[test]
    fn junit_notices_a_test_that_got_lost() {
        let (_, odd) = convert(&LOG.replace("test a_is_right ... ok\n", ""));
        assert_eq!(odd.len(), 1);
        assert!(odd[0].contains("tests/a.rs: 1 tests passed"), "{odd:?}");
        assert_eq!(convert("nothing").1, ["there is no test"]);
    }
}
