// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random stalls between the blocks of an emitted design.
//!
//! Ports of the design can be held up from outside, streams between its blocks cannot: so their emitted text is changed.
//! What a block sends goes through a gate, which shows it to the block behind only now and then; a beat that was shown
//! stays. It is the same design with more registers between its blocks, and it has to send the same beats.

use super::{CosimError, Design, io_error};
use std::fs;
use std::path::Path;

const GATE: &str = include_str!("stall_gate.sv");

/// How often streams are held up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stalls {
    /// Cycles of a hundred, about, in which a stream is held up; below 100, or nothing ever moves.
    pub percent: u8,
    /// Which of all patterns.
    pub seed: u32,
}

/// A stream that leaves a block of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// The module in which the block stands.
    pub module: &'static str,
    /// The block.
    pub instance: &'static str,
    /// Its ports: valid and ready.
    pub ports: [&'static str; 2],
}

impl Design {
    /// Puts a gate behind each of the links. The files of the design are overwritten, and one is added.
    ///
    /// # Errors
    /// One of the links is not in its module's text, or a file cannot be read or written.
    pub fn stall(&mut self, links: &[Link], stalls: Stalls) -> Result<(), CosimError> {
        for (k, link) in links.iter().enumerate() {
            let file = format!("{}.sv", link.module);
            let missing = || CosimError::Design {
                top: self.top.clone(),
                reason: format!("{link:?} has no place in the text of its module"),
            };
            let path = self.sources.iter().find(|path| path.ends_with(&file)).ok_or_else(missing)?;
            let text = fs::read_to_string(path).map_err(io_error(format!("reading `{}`", path.display())))?;
            let gated = gated(&text, link, k as u32, stalls).ok_or_else(missing)?;
            fs::write(path, gated).map_err(io_error(format!("writing `{}`", path.display())))?;
        }
        let path =
            self.sources.first().and_then(|path| path.parent()).unwrap_or(Path::new("")).join("relief_stall_gate.sv");
        fs::write(&path, GATE).map_err(io_error(format!("writing `{}`", path.display())))?;
        self.sources.push(path);
        Ok(())
    }
}

/// A module's text with a gate behind one of its blocks.
fn gated(text: &str, link: &Link, number: u32, stalls: Stalls) -> Option<String> {
    let Link { instance, ports: [valid, ready], .. } = link;
    // `    relief_NAME instance (` to `    );`
    let name = text.find(&format!(" {instance} (\n"))?;
    let begin = text[..name].rfind('\n')? + 1;
    let end = begin + text[begin..].find("\n    );")?;
    let net = |port: &str| {
        let (_, rest) = text[begin..end].split_once(&format!(".{port}("))?;
        Some(rest.split_once(')')?.0.to_owned())
    };
    let (valid_net, ready_net) = (net(valid)?, net(ready)?);
    let block = text[begin..end]
        .replace(&format!(".{valid}({valid_net})"), &format!(".{valid}({valid_net}_source)"))
        .replace(&format!(".{ready}({ready_net})"), &format!(".{ready}({ready_net}_source)"));
    // Odd, so that it is not 0; any bits besides.
    let seed = stalls.seed.wrapping_mul(0x9e37_79b9) ^ number.wrapping_mul(0x85eb_ca6b) | 1;
    let closed = (u32::from(stalls.percent) * 128).div_ceil(100).min(127);
    let gate = format!(
        "    wire  {valid_net}_source;\n    wire  {ready_net}_source;\n    relief_stall_gate #(.SEED(32'd{seed}), \
         .CLOSED(7'd{closed})) {instance}_gate (\n        .clock(clock),\n        .reset(reset),\n        \
         .source_valid({valid_net}_source),\n        .source_ready({ready_net}_source),\n        \
         .sink_valid({valid_net}),\n        .sink_ready({ready_net})\n    );\n"
    );
    Some(format!("{}{gate}{block}{}", &text[..begin], &text[end..]))
}
