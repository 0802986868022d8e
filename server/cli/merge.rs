//! `ferry merge`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;

use super::evaluate::Output;
use ferry_files::read_at_most;
use ferry_lab::evaluate::{Part, PartError, Report, merge};
use ferry_lab::recovery::{self, RecoveryPart, merge_recovery};

/// Largest file of a shard.
const BYTES_MOST: u64 = 4 << 30;

#[derive(clap::Args)]
pub struct Arguments {
    /// The files of all shards, from `--shard I/N --out FILE` of `ferry evaluate` or `ferry recovery`
    #[arg(required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    output: Output,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let read = |path: &PathBuf| {
        let bytes = read_at_most(path, BYTES_MOST).with_context(|| path.display().to_string())?;
        anyhow::Ok((path.display().to_string(), bytes))
    };
    let files: Vec<(String, Vec<u8>)> = arguments.files.iter().map(read).collect::<Result<_, _>>()?;
    if files.iter().any(|(_, bytes)| RecoveryPart::is_named_in(bytes)) {
        let merged = merge_recovery(parts(files, RecoveryPart::read)?)?;
        arguments.output.formats.prepare()?;
        let report = recovery::Report::of(&merged.subject, &merged.adapter, &merged.findings);
        return super::recovery::write(&arguments.output.formats, &report, &merged.subject);
    }
    let merged = merge(parts(files, Part::read)?)?;
    arguments.output.formats.prepare()?;
    arguments.output.write(&Report::of(&merged.adapter, merged.seed, &merged.done()), merged.manner)
}

/// What the files have, each with its name.
fn parts<P>(
    files: Vec<(String, Vec<u8>)>,
    read: impl Fn(&[u8]) -> Result<P, PartError>,
) -> anyhow::Result<Vec<(String, P)>> {
    let part = |(name, bytes): (String, Vec<u8>)| {
        let part = read(&bytes).with_context(|| name.clone())?;
        Ok((name, part))
    };
    files.into_iter().map(part).collect()
}
