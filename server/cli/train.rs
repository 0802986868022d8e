//! `ferry train`.

mod files;
mod generated;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::{Context, ensure};
use indicatif::ProgressBar;

use super::progress::progress;
use ferry_core::policy::{Architecture, Policy};
use ferry_files::open;
use ferry_files::replace;
use ferry_lab::learn::sweep::{STEP_M, Sweep, cells};
use ferry_lab::learn::{
    Cells, Curve, EXAMINATION_SEED, Ending, Frame, GoalSet, MOST_TERRAINS, Marks, Recipe, RecipeName, Run, Saving,
    State, Terrain, drive, revision, wall_waves_m,
};

const CHECKPOINT_PERIOD: Duration = Duration::from_secs(60);

#[derive(clap::Args)]
pub struct Arguments {
    /// Maps for training, separated by commas: names, or paths of SVGs; or generated, for a policy with a memory
    #[arg(long, value_delimiter = ',', default_value = "colon")]
    map: Vec<String>,
    /// Maps used only in the final examination
    #[arg(long, value_delimiter = ',')]
    unseen: Vec<String>,
    /// The policy's file; checkpoint and curve are written beside it. Without it: data/policies/MAP.safetensors
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite the files of another training
    #[arg(long, conflicts_with = "resume")]
    force: bool,
    /// Seed of the run, or of the first round
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Resume from the checkpoint beside the file
    #[arg(long)]
    resume: bool,
    /// Number of runs with consecutive seeds, for the paper's learning figure
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=100))]
    rounds: u64,
    /// Recipe from which the settings start: quick (one map in minutes), full (the shipped policies), paper (its reward,
    /// fusion and returns) or toy (a map of 60 cells in seconds)
    #[arg(long, default_value = "full", conflicts_with = "paper")]
    recipe: RecipeName,
    /// The same as --recipe paper
    #[arg(long)]
    paper: bool,
    /// Policy whose weights it starts from: the name of a shipped one, or the path of a file
    #[arg(long, value_name = "NAME|FILE")]
    start_from: Option<String>,
    /// Set a number of the recipe, for example n_step=3 or architecture.dueling=false
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Random starts and goals of the final examination; a map of at most 63 cells is examined over all its pairs
    #[arg(long, default_value_t = 2000, value_parser = super::within(1..=1_000_000))]
    episodes: u32,
    /// Folder for image sweeps
    #[arg(long, default_value = "data/sweeps")]
    sweeps: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    // Inside the pool, parallel work needs no thread switch. The global pool is used because it lasts: threads that end
    // together with the process would conflict with the graphics driver's cleanup.
    rayon::scope(|_| train(arguments))
}

fn train(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    if arguments.map == [generated::MAP] {
        return generated::train(arguments);
    }
    let mut recipe = Recipe::named(if arguments.paper { RecipeName::Paper } else { arguments.recipe });
    let start = arguments.start_from.as_deref().map(start_bytes).transpose().context("--start-from")?;
    if let Some(bytes) = &start {
        let noisy = recipe.architecture.noisy;
        recipe.architecture = Architecture { noisy, ..Policy::from_bytes(bytes)?.manifest().architecture };
    }
    let recipe: Recipe = super::with_changes(&recipe, &arguments.set)?;
    recipe.check().context("--set")?;
    ensure!(!arguments.map.is_empty(), "--map: at least one map is needed");
    let out = files::out(arguments);
    let rounds = files::rounds(arguments, &out)?;
    files::check(arguments, &out, &rounds)?;
    let terrains = open(&arguments.map, &recipe, &arguments.sweeps)?;
    let unseen = open(&arguments.unseen, &recipe, &arguments.sweeps)?;
    files::create_folder(&out)?;
    let mut curves = Vec::new();
    for (seed, out) in &rounds {
        let curve = round(arguments, &recipe, start.as_deref(), *seed, out, [&terrains, &unseen])?;
        curves.push(curve);
    }
    let figure = out.with_extension("curve.svg");
    std::fs::write(&figure, Curve::figure(&curves)?).with_context(|| format!("{}", figure.display()))?;
    println!("figure      {}", figure.display());
    Ok(ExitCode::SUCCESS)
}

/// One run from its first step, or from its checkpoint, to its final examination.
fn round(
    arguments: &Arguments,
    recipe: &Recipe,
    start: Option<&[u8]>,
    seed: u64,
    out: &Path,
    [terrains, unseen]: [&[Terrain]; 2],
) -> anyhow::Result<Curve> {
    let (mut state, curve) = match arguments.resume {
        true => {
            let (state, spent_s) = State::read(&out.with_extension("checkpoint"), recipe, seed, terrains)?;
            (state, Curve::resumed(spent_s))
        }
        false => (State::begin(recipe.clone(), seed, terrains, start)?, Curve::default()),
    };
    let bar = bar_of(recipe.updates, state.memory.updates)?;
    let (begun, steps, updates) = (Instant::now(), state.steps, state.memory.updates);
    let curve = learn(&mut state, terrains, out, curve, &mut |state| {
        let rate = |now: u64, then: u64| (now - then) as f64 / begun.elapsed().as_secs_f64();
        bar.set_position(state.memory.updates);
        bar.set_message(message(state, rate(state.steps, steps), rate(state.memory.updates, updates)));
    })?;
    bar.finish_and_clear();
    std::fs::write(out, state.policy(&revision())?).with_context(|| format!("{}", out.display()))?;
    println!(
        "seed {seed}      {} updates, {} steps, {} episodes in {:.1} min",
        state.memory.updates,
        state.steps,
        state.episodes,
        curve.spent_s() / 60.0
    );
    for (name, group) in [("trained on", terrains), ("unseen    ", unseen)] {
        // All moments of a map together.
        for moments in group.chunk_by(|a, b| a.name() == b.name()) {
            let terrain = &moments[0];
            let examine = |goals| state.examine(moments, goals, arguments.episodes, EXAMINATION_SEED);
            println!("{name}  {}: {}", terrain.name(), describe(&examine(GoalSet::All)?));
            let held_out = recipe.held_out_goals;
            let goals = GoalSet::HeldOut { held_out };
            if held_out > 0.0 && goals.has_episode(terrain) {
                println!("{name}  {}, goals held out: {}", terrain.name(), describe(&examine(goals)?));
            }
        }
    }
    if let [terrain] = terrains {
        println!("values      {}", describe_values(&state, terrain, terrains)?);
    }
    println!("policy      {}", out.display());
    println!("curve       {}", out.with_extension("curve.csv").display());
    Ok(curve)
}

/// Advances a run to its end. The curve is written as it grows.
fn learn<R: Run>(
    run: &mut R,
    worlds: &[R::World],
    out: &Path,
    mut curve: Curve,
    watch: &mut dyn FnMut(&R),
) -> anyhow::Result<Curve> {
    let data = out.with_extension("curve.csv");
    let write = |curve: &Curve| replace(&data, curve.csv().as_bytes()).with_context(|| data.display().to_string());
    curve.points = run.points().to_vec();
    let mut written = write(&curve);
    if written.is_ok() {
        let saving = Saving { checkpoint: &out.with_extension("checkpoint"), period: CHECKPOINT_PERIOD };
        drive(run, worlds, saving, &mut curve, &|| true, &mut |run, curve| {
            watch(run);
            written = write(curve);
            written.is_ok()
        })?;
    }
    written.map(|()| curve)
}

/// A bar for the updates of a run.
fn bar_of(updates: u64, done: u64) -> anyhow::Result<ProgressBar> {
    let bar = progress(updates, "updates")?;
    bar.set_position(done);
    bar.reset_eta();
    Ok(bar)
}

/// The file of a policy by name or path.
fn start_bytes(name_or_path: &str) -> anyhow::Result<Vec<u8>> {
    match Policy::shipped_bytes(name_or_path) {
        Ok(bytes) => Ok(bytes),
        Err(unknown) => {
            std::fs::read(name_or_path).map_err(|error| anyhow::anyhow!("{name_or_path}: {error}; {unknown}"))
        }
    }
}

fn message(state: &State, steps_per_s: f64, updates_per_s: f64) -> String {
    let mut parts = Vec::new();
    let recent = state.curve.iter().rev().take(5);
    let (reached, ended): (u32, u32) =
        recent.fold((0, 0), |(reached, ended), point| (reached + point.reached, ended + point.reward.count()));
    parts.push(format!("success {:.0} % exploring", 100.0 * f64::from(reached) / f64::from(ended.max(1))));
    if let Some(marks) = state.curve.iter().rev().find_map(|point| point.examined) {
        parts.push(format!("{:.1} % examined", 100.0 * marks.success()));
    }
    if let Some(loss) = state.curve.last().and_then(|point| point.loss.mean()) {
        parts.push(format!("loss {loss:.4}"));
    }
    parts.push(format!("{steps_per_s:.0} steps/s, {updates_per_s:.1} updates/s, "));
    parts.join(", ")
}

fn describe(marks: &Marks) -> String {
    let [low, high] = ferry_lab::evaluate::wilson95(marks.reached, marks.episodes).map(|share| 100.0 * share);
    let range = if marks.all_pairs { "all pairs of cells".to_owned() } else { format!("{low:.2} % to {high:.2} %") };
    format!(
        "{}/{} reached ({range}), {} collided, {} out of steps, {:.1} steps, {:.1} on the shortest path",
        marks.reached,
        marks.episodes,
        marks.collided,
        marks.timed_out,
        f64::from(marks.steps) / f64::from(marks.reached.max(1)),
        f64::from(marks.least_steps) / f64::from(marks.reached.max(1)),
    )
}

/// What the page shows under a training's last value map.
fn describe_values(state: &State, terrain: &Terrain, terrains: &[Terrain]) -> anyhow::Result<String> {
    let cells = Cells::of(terrain, None);
    let frame = Frame::of(state, terrains, &cells)?;
    let reached = frame.endings.iter().filter(|&&ending| ending == Ending::Reached).count();
    let correlation = frame.rank_correlation.map_or("none".to_owned(), |value| format!("{value:.3}"));
    Ok(format!(
        "rank correlation with the distances to ({:.3}, {:.3}): {correlation}; {reached} of {} starts reach it",
        cells.goal_m.x,
        cells.goal_m.y,
        frame.endings.len()
    ))
}

fn open(names: &[String], recipe: &Recipe, sweeps: &Path) -> anyhow::Result<Vec<Terrain>> {
    let arenas = names.iter().map(|name| open::arena(name)).collect::<Result<Vec<_>, _>>()?;
    let waves_m: Vec<_> = arenas.iter().map(|arena| wall_waves_m(arena, recipe.wall_amplitude_m)).collect();
    let count = waves_m.iter().map(Vec::len).sum::<usize>();
    ensure!(count <= MOST_TERRAINS, "--map: {count} maps and moments, at most {MOST_TERRAINS}");
    let gpu = if names.is_empty() { None } else { Some(super::open_gpu()?) };
    let mut terrains = Vec::new();
    for ((arena, waves_m), gpu) in arenas.iter().zip(waves_m).zip(gpu.iter().cycle()) {
        let (columns, rows) = cells(arena, STEP_M);
        let bar = progress((columns * rows * waves_m.len()) as u64, "images")?;
        bar.set_message(format!("{}, ", arena.map.name()));
        for wave_m in waves_m {
            let sweep = Sweep::open(arena, gpu, sweeps, STEP_M, &wave_m, &|| {
                bar.inc(1);
                ControlFlow::Continue(())
            })?;
            terrains.push(Terrain::new(arena.map.name(), arena.map.workspace(), &sweep, recipe.clearance_m)?);
        }
        bar.finish_and_clear();
    }
    Ok(terrains)
}
