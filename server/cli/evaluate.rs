//! `ferry evaluate`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::evaluate::{Episode, Experiment, Row, run as run_experiment, summarize};
use crate::map::Map;
use crate::policy::Policy;
use crate::scenario::{ControllerName, Parameters};

/// Arguments of `ferry evaluate`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A map's name, or the path of an SVG
    #[arg(long, default_value = "posts")]
    map: String,
    /// Controllers, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "attractor")]
    controller: Vec<ControllerName>,
    /// Trials a controller
    #[arg(long, default_value_t = 30)]
    episodes: u32,
    /// Scripted disturbances a trial
    #[arg(long, default_value_t = 0)]
    disturbances: u32,
    /// Seed of the trials
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// A parameter that is not to have its default, as in attractor_law=literal; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// A policy's file, in place of the shipped ones
    #[arg(long)]
    policy: Option<PathBuf>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Table {
    rows: Vec<Row>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let map = Map::open(&arguments.map)?;
    let gpu = super::open_gpu()?;
    let parameters = parameters_with(&Parameters::default(), &arguments.set)?;
    let policy = arguments.policy.as_deref().map(Policy::open).transpose()?;
    let mut rows = Vec::new();
    for &controller in &arguments.controller {
        let experiment = Experiment {
            map: arguments.map.clone(),
            controller,
            episodes: arguments.episodes,
            disturbances: arguments.disturbances,
            seed: arguments.seed,
            parameters: parameters.clone(),
            policy: policy.clone(),
        };
        let bar = ProgressBar::new(u64::from(arguments.episodes))
            .with_style(ProgressStyle::with_template("{msg} {bar:30} {pos}/{len} {eta} left")?)
            .with_message(controller.as_str());
        let episodes = run_experiment(&experiment, &gpu, &|_| bar.inc(1))?;
        bar.finish_and_clear();
        report_failures(&episodes);
        rows.push(summarize(&experiment, map.name(), &episodes));
    }
    if arguments.json {
        println!("{}", serde_json::to_string(&Table { rows })?);
    } else {
        print_table(&rows, arguments.seed, gpu.adapter_name());
    }
    Ok(ExitCode::SUCCESS)
}

/// Parameters with some values of their own.
pub fn parameters_with(parameters: &Parameters, changes: &[String]) -> anyhow::Result<Parameters> {
    let parameters = super::with_changes(parameters, changes)?;
    parameters.check().context("--set")?;
    Ok(parameters)
}

/// Each failure with what it takes to look at it again.
fn report_failures(episodes: &[Episode]) {
    for episode in episodes.iter().filter(|e| !e.delivered) {
        let place =
            |p: Option<crate::geometry::Point2<f64>>| p.map_or("?".into(), |p| format!("{:.3},{:.3}", p.x, p.y));
        eprintln!(
            "trial {}: {}{} (from {} to {}, seed {}, {} steps, {} disturbances)",
            episode.index,
            episode.outcome,
            [&episode.trouble, &episode.refusal]
                .into_iter()
                .flatten()
                .map(|why| format!("; {why}"))
                .collect::<String>(),
            place(episode.scenario.start_m),
            place(episode.scenario.goal_m),
            episode.scenario.seed,
            episode.steps,
            episode.disturbances,
        );
    }
}

fn print_table(rows: &[Row], seed: u64, adapter: &str) {
    println!("seed {seed}, rendered by {adapter}");
    println!(
        "{:<10} {:<17} {:>5} {:>9} {:>15} {:>9} {:>15} {:>9} {:>7} {:>7} {:>6} {:>8} {:>15}",
        "controller",
        "map",
        "dist.",
        "reached",
        "95 % Wilson",
        "delivered",
        "95 % Wilson",
        "error mm",
        "max x",
        "max y",
        "steps",
        "switches",
        "ms/step p50 p99"
    );
    for row in rows {
        println!(
            "{:<10} {:<17} {:>5} {:>9} {:>15} {:>9} {:>15} {:>9.1} {:>7.1} {:>7.1} {:>6.1} {:>8.2} {:>15}",
            row.controller,
            row.map,
            row.disturbances,
            format!("{}/{}", row.successes, row.episodes),
            format!("{:.3} to {:.3}", row.successes_wilson95[0], row.successes_wilson95[1]),
            format!("{}/{}", row.delivered, row.episodes),
            format!("{:.3} to {:.3}", row.wilson95[0], row.wilson95[1]),
            row.tracking_error_mean_m * 1e3,
            row.tracking_error_max_x_m * 1e3,
            row.tracking_error_max_y_m * 1e3,
            row.steps_mean,
            row.switches_mean,
            format!("{:.1} {:.1}", row.decision_ms_p50, row.decision_ms_p99),
        );
    }
}
