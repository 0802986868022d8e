//! `ferry maps`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;

use ferry_core::map::{Maze, MazeFamily};

#[derive(clap::Subcommand)]
pub enum Command {
    /// Write generated mazes as SVG files
    Generate(Generation),
}

#[derive(clap::Args)]
pub struct Generation {
    /// Kind of maze: tubes, trees and stones are for training, the others for testing
    #[arg(long, value_parser = family)]
    family: MazeFamily,
    /// Seed of the first maze
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of mazes, with consecutive seeds
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    count: u64,
    /// Folder for the files, such as tubes-1.svg
    #[arg(long)]
    out: PathBuf,
}

fn family(name: &str) -> Result<MazeFamily, String> {
    let named = MazeFamily::ALL.into_iter().find(|family| family.as_str() == name);
    let known = MazeFamily::ALL.map(MazeFamily::as_str).join(", ");
    named.ok_or_else(|| format!("there is no family {name:?}; there are {known}"))
}

pub fn run(Command::Generate(arguments): &Command) -> anyhow::Result<ExitCode> {
    let Generation { family, seed, count, out } = arguments;
    let last = seed.checked_add(count - 1).with_context(|| format!("--seed: {seed} and {count} more is too large"))?;
    std::fs::create_dir_all(out).with_context(|| format!("--out: {}", out.display()))?;
    for seed in *seed..=last {
        let Maze { width_mm, map } = Maze::generate(*family, seed)?;
        let path = out.join(format!("{}.svg", map.name()));
        std::fs::write(&path, map.svg()).with_context(|| format!("--out: {}", path.display()))?;
        println!("{}  {width_mm:.0} mm wide", path.display());
    }
    Ok(ExitCode::SUCCESS)
}
