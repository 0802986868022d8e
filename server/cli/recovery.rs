//! `ferry recovery`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;

use super::evaluate::{interval, table};
use super::formats::{Formats, Formatted};
use super::progress::progress;
use ferry_camera::Gpu;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Nowhere, Sink};
use ferry_files::replace;
use ferry_lab::evaluate::{EvaluateError, Shard, Trials};
use ferry_lab::jobs::Life;
use ferry_lab::recovery::{
    Findings, Kind, Outcome, Recovery, RecoveryPart, RecoveryPlan, RecoveryQuery, Report, Subject,
};
use ferry_recording::Recorder;

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
    /// Record every trial to this folder: .rrd for Rerun, .ferry for `ferry replay`, and .json as a test case
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Run only every N-th trial of the finest grid, beginning with the I-th, and write them to --out for `ferry merge`. What is
    /// interrupted leaves nothing, so that of a long map in shards only one shard must run again
    #[arg(long, value_name = "I/N", requires = "out", conflicts_with = "record")]
    shard: Option<Shard>,
    /// File of the shard
    #[arg(long, value_name = "FILE", requires = "shard")]
    out: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    query(arguments, arguments.full).check(false)?;
    let gpu = super::open_gpu()?;
    let adapter = gpu.adapter_name();
    if let Some((shard, path)) = arguments.shard.zip(arguments.out.as_deref()) {
        let (recovery, findings) = survey(arguments, &gpu, true)?;
        let part = RecoveryPart::of(&recovery, shard, adapter, &findings)?;
        replace(path, &serde_json::to_vec(&part)?).with_context(|| path.display().to_string())?;
        return Ok(ExitCode::SUCCESS);
    }
    arguments.formats.prepare()?;
    let (recovery, findings) = survey(arguments, &gpu, arguments.full)?;
    if let Some(folder) = &arguments.record {
        write_cases(folder, &recovery, &findings)?;
    }
    let subject = recovery.subject()?;
    write(&arguments.formats, &Report::of(&subject, adapter, &findings), &subject)
}

/// Writes the files, and prints the report.
pub(super) fn write(formats: &Formats, report: &Report, subject: &Subject) -> anyhow::Result<ExitCode> {
    let formatted = Formatted {
        csv: &|| Ok(report.to_csv()?),
        html: &|| Ok(report.to_html(&subject.map.map()?)),
        print: &|| print(report),
    };
    formats.write(report, &formatted)
}

/// What each trial gave, for a baseline. All cells are tried, so that there are always the same trials.
pub(super) fn trials(arguments: &Arguments, gpu: &Arc<Gpu>) -> anyhow::Result<Vec<Trials>> {
    let has_other = arguments.record.is_some() || arguments.shard.is_some();
    anyhow::ensure!(!has_other, "a baseline is made without --record and --shard");
    let (recovery, findings) = survey(arguments, gpu, true)?;
    let row = |(index, name): (usize, &str)| {
        let ended = findings.cells.iter().flat_map(|cell| cell.ended(index));
        let name = format!("{name}, {}", recovery.query.kind.as_str());
        Trials::of(name, ended.map(|tried| tried.outcome == Outcome::Delivered))
    };
    Ok(recovery.controllers().into_iter().enumerate().map(row).collect())
}

fn query(arguments: &Arguments, is_full: bool) -> RecoveryQuery {
    RecoveryQuery {
        kind: arguments.kind,
        controllers: arguments.controller.clone(),
        grid: arguments.grid,
        repeats: arguments.repeats,
        seed: arguments.seed,
        within_s: arguments.within_s,
        is_full,
    }
}

/// Tries everything on all cores, and shows the progress.
fn survey(arguments: &Arguments, gpu: &Arc<Gpu>, is_full: bool) -> anyhow::Result<(Recovery, Findings)> {
    let plan = RecoveryPlan {
        map: arguments.map.clone(),
        scenario: arguments.scenario.clone(),
        at_s: arguments.at_s,
        query: query(arguments, is_full),
        changes: arguments.set.clone(),
        program: None,
    };
    let recovery = plan.recovery(gpu)?;
    let life = Life::new(Findings::default());
    let bar = progress(0, "trials")?;
    let recorders = |name: &str| -> Result<Box<dyn Sink>, EvaluateError> {
        let Some(folder) = &arguments.record else { return Ok(Box::new(Nowhere::default())) };
        let recorder =
            Recorder::to_folder(folder, name).map_err(|error| EvaluateError::Recording(error.to_string()))?;
        Ok(Box::new(recorder))
    };
    recovery.run(arguments.shard, gpu, &life, &recorders, &|findings| {
        bar.set_length(findings.planned as u64);
        bar.set_position(findings.done as u64);
    })?;
    bar.finish_and_clear();
    let findings = life.read(|_, findings| findings.clone());
    Ok((recovery, findings))
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
