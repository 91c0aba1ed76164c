// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reads a text file in blocks of whole lines and parses the blocks side by side.
//!
//! Each batch is gone through twice: a counting pass gives every block the number of its first line (and what else the
//! format counts), so that the parser can name lines in its errors and resolve relative indices, whichever core it
//! runs on. Results are merged in file order, so the outcome does not depend on the number of cores.

use std::io::Read;

use rayon::prelude::*;

use super::{InputError, Place, Progress, Source};

/// Large enough that a block's work outweighs its scheduling, small enough that its vertices stay in the cache.
const BLOCK_BYTES: usize = 2 << 20;

/// What lies before a block in its file.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Start {
    /// Lines before the block.
    pub(super) lines: u64,
    /// Things that the format counts before the block.
    pub(super) counted: u64,
}

/// One format's way with a block.
pub(super) trait BlockParser: Sync {
    /// What a block becomes.
    type Parsed: Send;
    /// The number of things in the block that later blocks need the count of.
    fn count(&self, block: &[u8]) -> u64;
    /// Parses a block; the error is the line (counted from 0 within the block) and a sentence.
    fn parse(&self, block: &[u8], start: Start) -> Result<Self::Parsed, (u64, String)>;
}

/// Parses all of `source` and hands the blocks to `merge` in order.
pub(super) fn parse_blocks<P: BlockParser>(
    source: Source<'_>,
    parser: &P,
    progress: &dyn Progress,
    mut merge: impl FnMut(P::Parsed) -> Result<(), InputError>,
) -> Result<(), InputError> {
    let Source { name, size, bytes, .. } = source;
    progress.phase("reading", size);
    let (mut start, mut done, mut at_end) = (Start::default(), 0, false);
    let mut left_over = Vec::new();
    // Two blocks a core, so that a core that is slowed down by others does not hold up the batch.
    let batch = 2 * rayon::current_num_threads();
    while !at_end {
        let mut blocks = Vec::with_capacity(batch);
        while blocks.len() < batch && !at_end {
            let mut block = std::mem::take(&mut left_over);
            at_end = fill(&mut block, bytes)
                .map_err(|error| InputError::new(name, Place::File, format!("cannot be read: {error}")))?;
            if !at_end {
                match memchr::memrchr(b'\n', &block) {
                    Some(newline) => left_over = block.split_off(newline + 1),
                    // A line longer than the block: read on.
                    None => {
                        left_over = block;
                        continue;
                    }
                }
            }
            done += block.len() as u64;
            blocks.push(block);
        }
        let counts: Vec<(u64, u64)> = blocks
            .par_iter()
            .map(|block| (memchr::memchr_iter(b'\n', block).count() as u64, parser.count(block)))
            .collect();
        let starts: Vec<Start> = counts
            .iter()
            .map(|(lines, counted)| {
                let next = Start { lines: start.lines + lines, counted: start.counted + counted };
                std::mem::replace(&mut start, next)
            })
            .collect();
        let parsed: Vec<_> = blocks.par_iter().zip(&starts).map(|(block, start)| parser.parse(block, *start)).collect();
        for (result, start) in parsed.into_iter().zip(&starts) {
            merge(
                result
                    .map_err(|(line, message)| InputError::new(name, Place::Line(start.lines + line + 1), message))?,
            )?;
        }
        progress.advance(done);
    }
    Ok(())
}

/// Appends up to a block's worth of bytes; true at the end of the file.
fn fill(block: &mut Vec<u8>, bytes: &mut dyn Read) -> std::io::Result<bool> {
    let read = bytes.take(BLOCK_BYTES as u64).read_to_end(block)?;
    Ok(read < BLOCK_BYTES)
}

/// The lines of a block with their numbers, counted from 0, without what ends them.
pub(super) fn lines(block: &[u8]) -> impl Iterator<Item = (u64, &[u8])> {
    let mut start = 0;
    let ends = memchr::memchr_iter(b'\n', block).chain((block.last() != Some(&b'\n')).then_some(block.len()));
    ends.enumerate().map(move |(number, end)| {
        let line = &block[start..end];
        start = end + 1;
        (number as u64, line)
    })
}
