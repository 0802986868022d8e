//! `ferry recovery`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;

use super::evaluate::{interval, progress_bar, table};
use crate::camera::Gpu;
use crate::evaluate::{EvaluateError, Trials};
use crate::jobs::Life;
use crate::recording::Recorder;
use crate::recovery::{Findings, Kind, Outcome, Recovery, RecoveryQuery, Report, Start};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ControllerName, Scenario};
use crate::trial::{Arena, Case, Nowhere, Origin, Sink, Timed};

#[derive(clap::Args)]
pub struct Arguments {
    /// A map's name, or the path of an SVG; start and goal are drawn from the seed
    #[arg(long, default_value = "posts")]
    map: String,
    /// Begin from this scenario: the name of a shipped one, or the path of a JSON file
    #[arg(long, conflicts_with = "map")]
    scenario: Option<String>,
    /// Moment of the scenario, in simulated seconds
    #[arg(long, default_value_t = 0.0, requires = "scenario")]
    at_s: f64,
    /// Controllers, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "rl,errt,attractor")]
    controller: Vec<ControllerName>,
    /// Disturbances: place, push, drag or blind
    #[arg(long, default_value = "place")]
    kind: Kind,
    /// Number of columns of the finest grid; of directions or times with the other kinds
    #[arg(long, default_value_t = 24)]
    grid: u32,
    /// Trials per cell and controller, each with its own noise
    #[arg(long, default_value_t = 3)]
    repeats: u32,
    /// Seed of the noise, and of start and goal
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// A later delivery is late
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    within_s: f64,
    /// Try each cell of the finest grid, also where all neighbours agree
    #[arg(long)]
    full: bool,
    /// Set a parameter, for example threshold_m=0.02; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Print only one JSON object
    #[arg(long)]
    json: bool,
    /// Write the cells to this CSV file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write maps and tables to this self-contained HTML file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Record every trial to this folder: .rrd for Rerun, .ferry for `ferry replay`, and .json as a test case
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    for path in [&arguments.csv, &arguments.html].into_iter().flatten() {
        std::fs::write(path, "").with_context(|| path.display().to_string())?;
    }
    let gpu = super::open_gpu()?;
    let (recovery, findings) = survey(arguments, &gpu, arguments.full)?;
    let report = Report::of(&recovery, gpu.adapter_name(), &findings);
    if let Some(folder) = &arguments.record {
        write_cases(folder, &recovery, &findings)?;
    }
    if let Some(path) = &arguments.csv {
        std::fs::write(path, report.to_csv()?).with_context(|| path.display().to_string())?;
    }
    if let Some(path) = &arguments.html {
        let map = &recovery.start.origin.arena.map;
        std::fs::write(path, report.to_html(map)).with_context(|| path.display().to_string())?;
    }
    if arguments.json {
        println!("{}", serde_json::to_string(&report)?);
    } else {
        print(&report);
    }
    Ok(ExitCode::SUCCESS)
}

/// What each trial gave, for a baseline. All cells are tried, so that there are always the same trials.
pub(super) fn trials(arguments: &Arguments, gpu: &Arc<Gpu>) -> anyhow::Result<Vec<Trials>> {
    anyhow::ensure!(arguments.record.is_none(), "a baseline is made without --record");
    let (recovery, findings) = survey(arguments, gpu, true)?;
    let row = |(index, name): (usize, &str)| {
        let ended = findings.cells.iter().flat_map(|cell| cell.ended(index));
        let name = format!("{name}, {}", recovery.query.kind.as_str());
        Trials::of(name, ended.map(|tried| tried.outcome == Outcome::Delivered))
    };
    Ok(recovery.controllers().into_iter().enumerate().map(row).collect())
}

/// Tries everything on all cores, with a progress bar.
fn survey(arguments: &Arguments, gpu: &Arc<Gpu>, is_full: bool) -> anyhow::Result<(Recovery, Findings)> {
    let case = case(arguments)?;
    let arena = case.arena()?;
    let tick = (arguments.at_s / SERVO_PERIOD_S) as u64;
    let moment = case.after(tick, &arena, &mut arena.camera(gpu)?)?;
    let told: Vec<Timed> = case.inputs.into_iter().filter(|timed| timed.tick <= tick).collect();
    let start = Start { origin: Origin::of(&moment), told: Some(told), program: None };
    let query = RecoveryQuery {
        kind: arguments.kind,
        controllers: arguments.controller.clone(),
        grid: arguments.grid,
        repeats: arguments.repeats,
        seed: arguments.seed,
        within_s: arguments.within_s,
        is_full,
    };
    let recovery = Recovery::new(query, start)?;
    let life = Life::new(Findings::default());
    let bar = progress_bar(0)?;
    let recorders = |name: &str| -> Result<Box<dyn Sink>, EvaluateError> {
        let Some(folder) = &arguments.record else { return Ok(Box::new(Nowhere::default())) };
        let recorder =
            Recorder::to_folder(folder, name).map_err(|error| EvaluateError::Recording(error.to_string()))?;
        Ok(Box::new(recorder))
    };
    recovery.run(gpu, &life, &recorders, &|findings| {
        bar.set_length(findings.planned as u64);
        bar.set_position(findings.done as u64);
    })?;
    bar.finish_and_clear();
    let findings = life.read(|_, findings| findings.clone());
    Ok((recovery, findings))
}

fn case(arguments: &Arguments) -> anyhow::Result<Case> {
    anyhow::ensure!(
        (0.0..=86_400.0).contains(&arguments.at_s),
        "--at-s is {}, it must be 0 to 86400 (one day)",
        arguments.at_s
    );
    let mut case = match &arguments.scenario {
        Some(name) => Case::open(name)?,
        None => {
            let Arena { map, space, .. } = &*Arena::open(&arguments.map)?;
            let first = arguments.controller.first().copied().unwrap_or(ControllerName::Attractor);
            let scenario = Scenario::random(map, &arguments.map, space, first, 0, arguments.seed, 0)?;
            Case { about: String::new(), scenario, map: None, inputs: Vec::new(), expect: None }
        }
    };
    case.scenario.parameters = case.scenario.parameters.with(&arguments.set).context("--set")?;
    Ok(case)
}

/// One file per trial, beside its log.
fn write_cases(folder: &std::path::Path, recovery: &Recovery, findings: &Findings) -> anyhow::Result<()> {
    for (name, case) in recovery.cases(findings) {
        let path = folder.join(name).with_extension("json");
        std::fs::write(&path, serde_json::to_string_pretty(&case)?).with_context(|| path.display().to_string())?;
    }
    Ok(())
}

fn print(report: &Report) {
    let Report { kind, map, seed, tick, within_s, repeats, adapter, .. } = report;
    let cells = report.cells.len() / report.controllers.len().max(1);
    println!("{} on {map} from tick {tick}, seed {seed}, rendered by {adapter}", kind.as_str());
    println!("{cells} cells, {repeats} trials each; in time: within {within_s} s");
    if !report.changes.is_empty() {
        println!("parameters other than the default: {}", report.changes.join(", "));
    }
    let mut basins = table(&["controller", "delivered", "share", "95 % Wilson", "area cm²", "95 %"], 1);
    for basin in &report.basins {
        let area = |area_m2: f64| format!("{:.0}", area_m2 * 1e4);
        basins.add_row(vec![
            basin.controller.clone(),
            format!("{}/{}", basin.delivered, basin.trials),
            format!("{:.3}", basin.share),
            interval(basin.share95),
            basin.area_m2.map_or("-".to_owned(), area),
            basin.area95_m2.map_or("-".to_owned(), |[low, high]| format!("{} to {}", area(low), area(high))),
        ]);
    }
    println!("{basins}");
    if report.differences.is_empty() {
        return;
    }
    println!("\npaired differences of the shares, first minus second, in percentage points, with 95 % intervals");
    let mut differences = table(&["first - second", "both, first, second, neither", "difference", "corrected"], 1);
    let points = |[low, high]: [f64; 2]| format!("{:+.1} to {:+.1}", low * 100.0, high * 100.0);
    for one in &report.differences {
        differences.add_row(vec![
            format!("{} - {}", one.controller, one.against),
            format!("{}, {}, {}, {}", one.both, one.first_only, one.second_only, one.neither),
            format!("{:+.1} ({})", one.share_difference * 100.0, points(one.share_difference95)),
            points(one.share_difference_corrected),
        ]);
    }
    println!("{differences}");
}
