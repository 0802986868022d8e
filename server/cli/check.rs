//! `ferry check`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use clap::Parser;

use super::evaluate::table;
use super::{Command, evaluate, recovery};
use ferry_files::{read_at_most, replace};
use ferry_lab::evaluate::{Baseline, Change, ERROR_RATE, Trials};

/// Largest file of a baseline.
const BYTES_MOST: u64 = 64 << 20;

#[derive(clap::Args)]
pub struct Arguments {
    /// File of the stored trials
    #[arg(long, value_name = "FILE")]
    baseline: PathBuf,
    /// Run the command after `--` and store its trials
    #[arg(long, requires = "command")]
    write: bool,
    /// With --write: `evaluate` or `recovery` with its options
    #[arg(last = true, value_name = "COMMAND", requires = "write")]
    command: Vec<String>,
}

/// Only for parsing: the command of a baseline.
#[derive(clap::Parser)]
#[command(name = "ferry", no_binary_name = true)]
struct Stored {
    #[command(subcommand)]
    command: Command,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let path = &arguments.baseline;
    let gpu = super::open_gpu()?;
    if arguments.write {
        let rows = trials(&arguments.command, &gpu)?;
        let baseline = Baseline::new(gpu.adapter_name(), arguments.command.clone(), rows);
        replace(path, &serde_json::to_vec_pretty(&baseline)?).with_context(|| path.display().to_string())?;
        println!("stored: {}", path.display());
        return Ok(ExitCode::SUCCESS);
    }
    let bytes = read_at_most(path, BYTES_MOST).with_context(|| path.display().to_string())?;
    let baseline = Baseline::read(&bytes).with_context(|| path.display().to_string())?;
    println!("ferry {}", baseline.command.join(" "));
    if baseline.adapter != gpu.adapter_name() {
        println!("stored with {}, now {}: images differ a little", baseline.adapter, gpu.adapter_name());
    }
    let changes = baseline.compare(&trials(&baseline.command, &gpu)?)?;
    println!("{}", changes_table(&changes));
    let worse: Vec<&str> = changes.iter().filter(|change| change.is_worse).map(|change| change.row.as_str()).collect();
    if worse.is_empty() {
        println!("no row is worse (exact sign test, error rate {ERROR_RATE} for all rows together)");
        return Ok(ExitCode::SUCCESS);
    }
    println!("worse: {} (exact sign test, error rate {ERROR_RATE} for all rows together)", worse.join(", "));
    Ok(ExitCode::FAILURE)
}

/// Runs a command and returns what each of its trials gave.
fn trials(command: &[String], gpu: &std::sync::Arc<ferry_camera::Gpu>) -> anyhow::Result<Vec<Trials>> {
    match Stored::try_parse_from(command).context("the command of the baseline")?.command {
        Command::Evaluate(arguments) => evaluate::trials(&arguments, gpu),
        Command::Recovery(arguments) => recovery::trials(&arguments, gpu),
        _ => anyhow::bail!("the command of a baseline must be evaluate or recovery"),
    }
}

fn changes_table(changes: &[Change]) -> comfy_table::Table {
    let mut table = table(&["row", "trials", "before", "now", "lost", "gained", "p"], 1);
    for change in changes {
        table.add_row(vec![
            change.row.clone(),
            change.trials.to_string(),
            change.before.to_string(),
            change.now.to_string(),
            change.lost.to_string(),
            change.gained.to_string(),
            format!("{:.4}", change.p_value),
        ]);
    }
    table
}
