// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finds blocks, width sets and engines by the names that the command line gives.

use relief_hdl::widths::{WIDTH_SETS, WidthSet};
use relief_testbench::binding::{BLOCKS, Binding, expect_offered, find};
use relief_testbench::check::Engine;
use relief_testbench::cosim::tools;

/// A block by its name.
pub fn block(name: &str) -> Result<&'static dyn Binding, String> {
    let names = || BLOCKS.iter().map(|block| block.name()).collect::<Vec<_>>().join(", ");
    find(name).ok_or_else(|| format!("there is no block `{name}`; the blocks are {}", names()))
}

/// The blocks of these names, each once, in the order given; every block when there is no name.
pub fn blocks(names: &[String]) -> Result<Vec<&'static dyn Binding>, String> {
    if names.is_empty() {
        return Ok(BLOCKS.to_vec());
    }
    let mut blocks: Vec<&'static dyn Binding> = Vec::new();
    for name in names {
        let block = block(name)?;
        if blocks.iter().all(|known| known.name() != block.name()) {
            blocks.push(block);
        }
    }
    Ok(blocks)
}

/// Those of the blocks that a width set offers. Blocks that were named must be offered, others are left out.
pub fn offered(
    blocks: &[&'static dyn Binding],
    names: &[String],
    set: &WidthSet,
) -> Result<Vec<&'static dyn Binding>, String> {
    if !names.is_empty() {
        blocks.iter().try_for_each(|block| expect_offered(*block, set))?;
    }
    Ok(blocks.iter().copied().filter(|block| block.offered(set)).collect())
}

/// A width set by its name; the default one for none.
pub fn width_set(name: Option<&str>) -> Result<&'static WidthSet, String> {
    let Some(name) = name else { return Ok(&WIDTH_SETS[0]) };
    let names = || WIDTH_SETS.iter().map(|set| set.name).collect::<Vec<_>>().join(", ");
    let known = WIDTH_SETS.iter().find(|set| set.name == name);
    known.ok_or_else(|| format!("there is no width set `{name}`; --param takes {}", names()))
}

/// The engines of an option, with those left out because a program is missing and what to install.
pub struct Engines {
    /// Those to run.
    pub run: Vec<Engine>,
    /// Those that cannot run.
    pub skipped: Vec<(Engine, tools::Missing)>,
}

/// The engines of `--engine`: an engine that is named must be installed; of `all`, one that is not is left out, unless
/// the variable CI is set, so that nothing is left out there unseen.
pub fn engines(name: &str) -> Result<Engines, Box<dyn std::error::Error>> {
    let (mut run, mut skipped) = (Vec::new(), Vec::new());
    let all = name == "all";
    let wanted = match all {
        true => Engine::ALL.to_vec(),
        false => vec![name.parse::<Engine>().map_err(|error| format!("{error}, all"))?],
    };
    for engine in wanted {
        match engine.missing() {
            None => run.push(engine),
            Some(missing) if !all || is_ci() => return Err(missing.into()),
            Some(missing) => skipped.push((engine, missing)),
        }
    }
    Ok(Engines { run, skipped })
}

fn is_ci() -> bool {
    std::env::var("CI").is_ok_and(|value| !matches!(value.as_str(), "" | "0" | "false"))
}
