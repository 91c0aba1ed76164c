// SPDX-License-Identifier: MIT OR Apache-2.0
//! The command line: parses, hands over to one file of `cli/` a subcommand, and turns the outcome into an exit code.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod chart;
mod cli;

/// Synthesizable displacement-mapping hardware: models, checks and files around it.
///
/// Exit codes: 0 everything agreed, 1 a mismatch or a failed check, 2 bad input.
#[derive(Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(cli::run::Arguments),
    Bake(cli::bake::Arguments),
    Tessellate(cli::tessellate::Arguments),
    Stability(cli::stability::Arguments),
    Blocks(cli::blocks::Arguments),
    Check(cli::check::Arguments),
    CheckMesh(cli::check_mesh::Arguments),
    Measure(cli::measure::Arguments),
    Chart(cli::chart::Arguments),
    Silhouette(cli::silhouette::Arguments),
    Normals(cli::normals::Arguments),
    Plan(cli::plan::Arguments),
    Wagging(cli::wagging::Arguments),
    Emit(cli::emit::Arguments),
    Synth(cli::synth::Arguments),
    Prove(cli::prove::Arguments),
    Sim(cli::sim::Arguments),
    Remesh(cli::remesh::Arguments),
}

fn main() -> ExitCode {
    // What is half-written when somebody stops the program goes with it, and so do the programs that it has started. Without
    // the handler they would only stay.
    let _ = ctrlc::set_handler(|| {
        relief_testbench::cosim::program::stop_all();
        relief_testbench::output::remove_unfinished();
        std::process::exit(130);
    });
    let outcome = match Arguments::parse().command {
        Command::Run(arguments) => cli::run::run(&arguments),
        Command::Bake(arguments) => cli::bake::run(&arguments),
        Command::Tessellate(arguments) => cli::tessellate::run(&arguments),
        Command::Stability(arguments) => cli::stability::run(&arguments),
        Command::Blocks(arguments) => cli::blocks::run(&arguments),
        Command::Check(arguments) => cli::check::run(&arguments),
        Command::CheckMesh(arguments) => cli::check_mesh::run(&arguments),
        Command::Measure(arguments) => cli::measure::run(&arguments),
        Command::Chart(arguments) => cli::chart::run(&arguments),
        Command::Silhouette(arguments) => cli::silhouette::run(&arguments),
        Command::Normals(arguments) => cli::normals::run(&arguments),
        Command::Plan(arguments) => cli::plan::run(&arguments),
        Command::Wagging(arguments) => cli::wagging::run(&arguments),
        Command::Emit(arguments) => cli::emit::run(&arguments),
        Command::Synth(arguments) => cli::synth::run(&arguments),
        Command::Prove(arguments) => cli::prove::run(&arguments),
        Command::Sim(arguments) => cli::sim::run(&arguments),
        Command::Remesh(arguments) => cli::remesh::run(&arguments),
    };
    match outcome {
        Ok(outcome) => outcome.into(),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
