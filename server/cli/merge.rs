//! `ferry merge`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;

use super::evaluate::Output;
use crate::evaluate::{Part, Report, merge};
use crate::files::read_at_most;

/// Largest file of a shard.
const BYTES_MOST: u64 = 4 << 30;

#[derive(clap::Args)]
pub struct Arguments {
    /// The files of all shards, from `ferry evaluate --shard I/N --out FILE`
    #[arg(required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    output: Output,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let read = |path: &PathBuf| {
        let name = path.display().to_string();
        let bytes = read_at_most(path, BYTES_MOST).with_context(|| name.clone())?;
        let part = Part::read(&bytes).with_context(|| name.clone())?;
        anyhow::Ok((name, part))
    };
    let merged = merge(arguments.files.iter().map(read).collect::<Result<_, _>>()?)?;
    arguments.output.prepare()?;
    arguments.output.write(&Report::of(&merged.adapter, merged.seed, &merged.done()), merged.manner)
}
