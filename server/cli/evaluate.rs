//! `ferry evaluate`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use anyhow::Context;
use comfy_table::{CellAlignment, Table, TableStyle};
use indicatif::{ProgressBar, ProgressStyle};

use crate::camera::Gpu;
use crate::evaluate::{
    Cell, Comparison, Episode, EvaluateError, Experiment, Failure, Manner, PairedMean, Report, Row, Venue, Watch, run,
    run_one,
};
use crate::policy::Policy;
use crate::recording::Recorder;
use crate::scenario::{ControllerName, Parameters};
use crate::trial::{Arena, Nowhere, Sink};

#[derive(clap::Args)]
pub struct Arguments {
    /// Maps by name, or paths of SVGs, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "posts")]
    map: Vec<String>,
    /// Controllers, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "attractor")]
    controller: Vec<ControllerName>,
    /// Scripted disturbances per trial; several numbers, separated by commas, give several rows
    #[arg(long, value_delimiter = ',', default_value = "0")]
    disturbances: Vec<u32>,
    /// Trials per row
    #[arg(long, default_value_t = 30)]
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
    /// Print only one JSON object
    #[arg(long)]
    json: bool,
    /// Write the rows to this CSV file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write rows, differences, failures and figures to this self-contained HTML file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Address of the page for the links in the report
    #[arg(long, value_name = "ADDRESS", default_value = "http://127.0.0.1:8080")]
    page: String,
}

pub fn run_command(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let experiments = experiments(arguments)?;
    check_distinct(&experiments)?;
    // Before anything runs, so that an error is reported early.
    for path in [&arguments.csv, &arguments.html].into_iter().flatten() {
        std::fs::write(path, "").with_context(|| path.display().to_string())?;
    }
    let gpu = super::open_gpu()?;
    let episodes = evaluate(arguments, &experiments, &gpu)?;
    let done: Vec<(&Cell, &[Episode])> =
        experiments.iter().map(|one| &one.cell).zip(episodes.iter().map(Vec::as_slice)).collect();
    let report = Report::of(gpu.adapter_name(), arguments.seed, &done);
    if let Some(path) = &arguments.csv {
        std::fs::write(path, report.to_csv()?).with_context(|| path.display().to_string())?;
    }
    if let Some(path) = &arguments.html {
        std::fs::write(path, report.to_html(&arguments.page)).with_context(|| path.display().to_string())?;
    }
    if arguments.json {
        println!("{}", serde_json::to_string(&report)?);
        return Ok(ExitCode::SUCCESS);
    }
    println!("seed {}, rendered by {}", report.seed, report.adapter);
    if let Some(changes) = report.rows.first().map(|row| row.changes.join(", ")).filter(|changes| !changes.is_empty()) {
        println!("parameters other than the default: {changes}");
    }
    if arguments.by_hand {
        println!("disturbed by a hand that draws the bead through free space");
    }
    if arguments.tool_apart {
        println!("at the start the tool is at least 15 cm from the bead");
    }
    println!("{}", rows_table(&report.rows));
    for row in report.rows.iter().filter(|row| row.beyond_steps > 0) {
        let Row { controller, map, disturbances, beyond_steps, episodes, .. } = row;
        println!(
            "{controller} on {map}, {disturbances} disturbances: {beyond_steps} of {episodes} goals are farther than \
             step_limit allows"
        );
    }
    if !report.comparisons.is_empty() {
        println!(
            "\npaired differences, first minus second, with 95 % intervals; steps, error and path where both delivered, \
             and steps over all trials with the interval corrected for {} comparisons",
            report.comparisons.len()
        );
        println!("{}", comparisons_table(&report.comparisons));
    }
    print_failures(&report.failures, &arguments.page);
    Ok(ExitCode::SUCCESS)
}

/// One experiment per row, with the controllers of a map next to each other.
fn experiments(arguments: &Arguments) -> anyhow::Result<Vec<Experiment>> {
    let parameters = Parameters::default().with(&arguments.set).context("--set")?;
    let policy = arguments.policy.as_deref().map(Policy::open).transpose()?;
    let mut controllers = arguments.controller.iter();
    if let Some(name) = controllers.find(|name| !ControllerName::AUTOMATIC.contains(name)) {
        anyhow::bail!("--controller {}: this command asks no person and no program", name.as_str());
    }
    let mut experiments = Vec::new();
    for map in &arguments.map {
        let arena = Arena::open(map)?;
        let arena = match &policy {
            Some(policy) => arena.with_policy(policy.clone()),
            None => arena,
        };
        let venue = Venue::of(arena);
        let name = venue.arena.map.name().to_owned();
        for &disturbances in &arguments.disturbances {
            experiments.extend(arguments.controller.iter().map(|&controller| Experiment {
                cell: Cell { controller, map: name.clone(), disturbances },
                venue: venue.clone(),
                map: map.clone(),
                episodes: arguments.episodes,
                seed: arguments.seed,
                parameters: parameters.clone(),
                manner: Manner { by_hand: arguments.by_hand, tool_apart: arguments.tool_apart },
            }));
        }
    }
    Ok(experiments)
}

/// Two cells with the same name would count as the same trials.
fn check_distinct(experiments: &[Experiment]) -> anyhow::Result<()> {
    for (index, one) in experiments.iter().enumerate() {
        let Cell { controller, map, disturbances } = &one.cell;
        let is_twice = experiments[..index].iter().any(|other| other.cell == one.cell);
        anyhow::ensure!(
            !is_twice,
            "{} on {map} with {disturbances} disturbances is requested twice; maps with the same file name count as one",
            controller.as_str()
        );
    }
    Ok(())
}

/// Runs the experiments on all cores, with a progress bar.
fn evaluate(arguments: &Arguments, experiments: &[Experiment], gpu: &Arc<Gpu>) -> anyhow::Result<Vec<Vec<Episode>>> {
    let trials = match arguments.episode {
        Some(_) => experiments.len() as u64,
        None => experiments.len() as u64 * u64::from(arguments.episodes),
    };
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} trials, {msg}{elapsed}, {eta} left")?;
    let bar = ProgressBar::new(trials).with_style(style);
    bar.enable_steady_tick(std::time::Duration::from_millis(500));
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
    let Cell { controller, map, disturbances } = &experiment.cell;
    let name = format!("{map}-{}-{disturbances}-{index:04}", controller.as_str());
    let recorder = Recorder::to_folder(folder, &name).map_err(|error| EvaluateError::Recording(error.to_string()))?;
    Ok(Box::new(recorder))
}

/// A table of text, the first `left` columns as words, the others as numbers.
fn table(head: &[&str], left: usize) -> Table {
    let mut table = Table::new();
    table.load_style(TableStyle::new()).set_header(head.to_vec());
    for column in table.column_iter_mut().skip(left) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn interval([low, high]: [f64; 2]) -> String {
    format!("{low:.3} to {high:.3}")
}

fn rows_table(rows: &[Row]) -> Table {
    let head = [
        "controller",
        "map",
        "dist.",
        "reached",
        "95 % Wilson",
        "delivered",
        "95 % Wilson",
        "error mm",
        "in x, y",
        "max x, y",
        "path/shortest",
        "steps",
        "switches",
        "trained here",
        "ms/step p50 p99",
    ];
    let mut table = table(&head, 2);
    for row in rows {
        let pair = |x_m: f64, y_m: f64| format!("{:.1} {:.1}", x_m * 1e3, y_m * 1e3);
        table.add_row(vec![
            row.controller.clone(),
            row.map.clone(),
            row.disturbances.to_string(),
            format!("{}/{}", row.successes, row.episodes),
            interval(row.successes_wilson95),
            format!("{}/{}", row.delivered, row.episodes),
            interval(row.wilson95),
            format!("{:.1}", row.tracking_error_mean_m * 1e3),
            pair(row.tracking_error_mean_x_m, row.tracking_error_mean_y_m),
            pair(row.tracking_error_max_x_m, row.tracking_error_max_y_m),
            row.path_ratio_mean.map_or("-".to_owned(), |ratio| format!("{ratio:.3}")),
            format!("{:.1}", row.steps_mean),
            format!("{:.2}", row.switches_mean),
            row.trained_on_map.map_or("-", |trained| if trained { "yes" } else { "no" }).to_owned(),
            format!("{:.1} {:.1}", row.decision_ms_p50, row.decision_ms_p99),
        ]);
    }
    table
}

fn comparisons_table(comparisons: &[Comparison]) -> Table {
    let head = [
        "first - second",
        "map",
        "dist.",
        "both, first, second, neither",
        "delivered, points",
        "steps",
        "error mm",
        "path/shortest",
        "steps of all",
    ];
    let mut table = table(&head, 2);
    let signed = |mean: f64, [low, high]: [f64; 2], scale: f64, digits: usize| {
        let [mean, low, high] = [mean, low, high].map(|value| value * scale);
        format!("{mean:+.digits$} ({low:+.digits$} to {high:+.digits$})")
    };
    let paired = |mean: Option<PairedMean>, scale: f64, digits: usize| {
        mean.map_or("-".to_owned(), |mean| signed(mean.mean, mean.interval95, scale, digits))
    };
    for one in comparisons {
        table.add_row(vec![
            format!("{} - {}", one.controller, one.against),
            one.map.clone(),
            one.disturbances.to_string(),
            format!("{}, {}, {}, {}", one.both, one.first_only, one.second_only, one.neither),
            signed(one.delivered_difference, one.delivered_difference95, 100.0, 1),
            paired(one.steps, 1.0, 1),
            paired(one.tracking_error_mean_m, 1e3, 1),
            paired(one.path_ratio, 1.0, 3),
            one.steps_of_all.map_or("-".to_owned(), |all| signed(all.mean, all.interval_corrected, 1.0, 1)),
        ]);
    }
    table
}

/// Prints each failure with its reason and a link to replay it.
fn print_failures(failures: &[Failure], page: &str) {
    for failure in failures {
        println!(
            "\n{} on {}, {} disturbances, trial {}: {} ({} steps)",
            failure.controller,
            failure.map,
            failure.disturbances,
            failure.index,
            failure.reason(),
            failure.steps,
        );
        if let Some(link) = &failure.link {
            println!("  {page}/{link}");
        }
    }
}
