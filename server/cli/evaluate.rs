//! `ferry evaluate`.

mod output;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use anyhow::{Context, ensure};

use super::progress::progress;
use ferry_camera::Gpu;
use ferry_core::scenario::{ControllerName, Parameters};
use ferry_core::trial::{Nowhere, Sink};
use ferry_files::open;
use ferry_files::replace;
use ferry_lab::evaluate::{
    Cell, Contender, DISTURBANCES, EPISODES, Episode, EvaluateError, Experiment, Manner, Part, Plan, Report, Shard,
    Trials, Variation, Watch, run, run_one, run_trials, unrecorded,
};
use ferry_recording::Recorder;

pub use output::Output;
pub(super) use output::{interval, table};

#[derive(clap::Args)]
pub struct Arguments {
    /// Maps by name, or paths of SVGs, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "posts")]
    map: Vec<String>,
    /// Controllers, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "attractor")]
    controller: Vec<ControllerName>,
    /// Scripted disturbances per trial; several numbers, separated by commas, give several rows
    #[arg(long, value_delimiter = ',', default_value = "0", value_parser = super::within(DISTURBANCES))]
    disturbances: Vec<u32>,
    /// Trials per row
    #[arg(long, default_value_t = 30, value_parser = super::within(EPISODES))]
    episodes: u32,
    /// Seed of the trials: all controllers get the same starts, goals and pushes
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Run only this trial of each row, numbered as in the list of failures
    #[arg(long, value_name = "INDEX")]
    episode: Option<u32>,
    /// Set a parameter, for example attractor_law=literal; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Give a parameter several values, for example friction=0.1:0.4:4 for four from 0.1 to 0.4. Twice: two
    /// parameters in all combinations
    #[arg(long, value_name = "NAME=FROM:TO:COUNT")]
    vary: Vec<Variation>,
    /// Disturb with a hand that draws the bead through free space at 0.2 m/s, instead of lifting it
    #[arg(long)]
    by_hand: bool,
    /// Start with the tool at least 15 cm from the bead, instead of above it
    #[arg(long)]
    tool_apart: bool,
    /// A policy's file, instead of the shipped ones
    #[arg(long)]
    policy: Option<PathBuf>,
    /// Record every trial to this folder: .rrd for Rerun, .ferry for `ferry replay`
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Run only every N-th trial, beginning with the I-th, and write them to --out for `ferry merge`. What is interrupted leaves
    /// nothing, so that of a long evaluation in shards only one shard must run again
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with_all = ["episode", "record"])]
    shard: Option<Shard>,
    /// File of the shard
    #[arg(long, value_name = "FILE", requires = "shard")]
    out: Option<PathBuf>,
    #[command(flatten)]
    output: Output,
}

pub fn run_command(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let experiments = experiments(arguments)?;
    if let Some((shard, path)) = arguments.shard.zip(arguments.out.as_deref()) {
        return run_shard(&experiments, shard, path);
    }
    arguments.output.formats.prepare()?;
    let gpu = super::open_gpu()?;
    let episodes = evaluate(arguments, &experiments, &gpu)?;
    let done: Vec<(&Cell, &[Episode])> =
        experiments.iter().map(|one| &one.cell).zip(episodes.iter().map(Vec::as_slice)).collect();
    let manner = Manner { by_hand: arguments.by_hand, tool_apart: arguments.tool_apart };
    arguments.output.write(&Report::of(gpu.adapter_name(), arguments.seed, &done), manner)
}

/// Runs the trials of a shard and writes them. The file appears when it is complete.
fn run_shard(experiments: &[Experiment], shard: Shard, path: &Path) -> anyhow::Result<ExitCode> {
    let gpu = super::open_gpu()?;
    let trials = shard.trials(experiments);
    let bar = progress(trials.len() as u64, "trials")?;
    let watch = Watch { stop: &AtomicBool::new(false), progress: &|_, _| bar.inc(1), recorders: &unrecorded };
    let episodes = run_trials(experiments, trials, &gpu, &watch)?;
    bar.finish_and_clear();
    let part = Part::of(experiments, shard, gpu.adapter_name(), episodes)?;
    replace(path, &serde_json::to_vec(&part)?).with_context(|| path.display().to_string())?;
    Ok(ExitCode::SUCCESS)
}

fn experiments(arguments: &Arguments) -> anyhow::Result<Vec<Experiment>> {
    let episodes = arguments.episodes;
    if let Some(index) = arguments.episode.filter(|&index| index >= episodes) {
        return Err(EvaluateError::Episode { index, episodes }.into());
    }
    let plan = Plan {
        maps: arguments.map.clone(),
        contenders: arguments.controller.iter().map(|&name| Contender::Own(name)).collect(),
        disturbances: arguments.disturbances.clone(),
        episodes,
        seed: arguments.seed,
        parameters: Parameters::default().with(&arguments.set).context("--set")?,
        vary: arguments.vary.clone(),
        manner: Manner { by_hand: arguments.by_hand, tool_apart: arguments.tool_apart },
        policy: arguments.policy.as_deref().map(open::policy).transpose()?,
    };
    Ok(plan.experiments()?)
}

/// What each trial gave, for a baseline.
pub(super) fn trials(arguments: &Arguments, gpu: &Arc<Gpu>) -> anyhow::Result<Vec<Trials>> {
    let has_other = arguments.shard.is_some() || arguments.episode.is_some() || arguments.record.is_some();
    ensure!(!has_other, "a baseline is made without --shard, --episode and --record");
    let experiments = experiments(arguments)?;
    let episodes = evaluate(arguments, &experiments, gpu)?;
    let row = |(experiment, episodes): (&Experiment, &Vec<Episode>)| {
        Trials::of(experiment.cell.to_string(), episodes.iter().map(|episode| episode.delivered))
    };
    Ok(experiments.iter().zip(&episodes).map(row).collect())
}

/// Runs the experiments on all cores, and shows the progress.
fn evaluate(arguments: &Arguments, experiments: &[Experiment], gpu: &Arc<Gpu>) -> anyhow::Result<Vec<Vec<Episode>>> {
    let trials = match arguments.episode {
        Some(_) => experiments.len() as u64,
        None => experiments.len() as u64 * u64::from(arguments.episodes),
    };
    let bar = progress(trials, "trials")?;
    let failed = std::sync::atomic::AtomicU32::new(0);
    let watch = Watch {
        stop: &AtomicBool::new(false),
        progress: &|_, episode| {
            if !episode.delivered {
                let count = failed.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
                bar.set_message(format!("{count} failed, "));
            }
            bar.inc(1);
        },
        recorders: &|experiment, index| recorder(arguments, experiment, index),
    };
    let episodes = match arguments.episode {
        Some(index) => experiments
            .iter()
            .enumerate()
            .map(|(number, experiment)| {
                let episode = run_one(experiment, index, gpu, &watch)?;
                (watch.progress)(number, &episode);
                Ok(vec![episode])
            })
            .collect::<Result<_, EvaluateError>>()?,
        None => run(experiments, gpu, &watch)?,
    };
    bar.finish_and_clear();
    Ok(episodes)
}

fn recorder(arguments: &Arguments, experiment: &Experiment, index: u32) -> Result<Box<dyn Sink>, EvaluateError> {
    let Some(folder) = &arguments.record else { return Ok(Box::new(Nowhere::default())) };
    let name = experiment.trial_name(index);
    let recorder = Recorder::to_folder(folder, &name).map_err(|error| EvaluateError::Recording(error.to_string()))?;
    Ok(Box::new(recorder))
}
