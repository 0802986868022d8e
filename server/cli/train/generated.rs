//! `ferry train --map generated`.

use std::process::ExitCode;
use std::time::Instant;

use anyhow::{Context, ensure};
use indicatif::{ProgressBar, ProgressStyle};

use super::{Arguments, CHECKPOINT_PERIOD, EXAMINATION_SEED, describe, revision};
use crate::learn::{
    Curve, Marks, MazeLattice, SurveyRecipe, SurveyRun, TrainingError, examine_surveys, examine_teacher,
};
use crate::map::{Map, MazeFamily};

/// Instead of the names of maps.
pub const MAP: &str = "generated";
const TRAINED: [MazeFamily; 3] = [MazeFamily::Tubes, MazeFamily::Trees, MazeFamily::Stones];
const TESTED: [MazeFamily; 3] = [MazeFamily::Rooms, MazeFamily::Spirals, MazeFamily::Serpentines];
/// Mazes of each family in the final examination, with seeds from 1 on.
const EXAMINED: usize = 20;

pub fn train(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    ensure!(!arguments.paper, "--paper: the paper's settings are for its own policy, not for --map {MAP}");
    ensure!(arguments.rounds == 1, "--rounds: --map {MAP} trains one round; give --seed instead");
    let recipe: SurveyRecipe = crate::cli::with_changes(&SurveyRecipe::default(), &arguments.set)?;
    recipe.check().context("--set")?;
    let mazes = MazeLattice::generated(&TRAINED, 1, recipe.mazes)?;
    let tests: Vec<(&str, Vec<MazeLattice>)> = TESTED
        .into_iter()
        .map(|family| Ok((family.as_str(), MazeLattice::generated(&[family], 1, EXAMINED)?)))
        .collect::<anyhow::Result<_>>()?;
    let unseen = arguments.unseen.iter().map(|name| Ok((name.as_str(), vec![MazeLattice::of(&Map::open(name)?)])));
    let unseen: Vec<(&str, Vec<MazeLattice>)> = unseen.collect::<anyhow::Result<_>>()?;
    if let Some(folder) = arguments.out.parent() {
        std::fs::create_dir_all(folder).with_context(|| format!("--out: {}", folder.display()))?;
    }

    let (run, curve) = learn(arguments, &recipe, &mazes)?;
    let maps = TRAINED.map(|family| format!("{} {} to {}", family.as_str(), 1, recipe.mazes.div_ceil(TRAINED.len())));
    let out = &arguments.out;
    std::fs::write(out, run.policy(maps.into(), &revision())?).with_context(|| format!("{}", out.display()))?;
    let data = out.with_extension("curve.csv");
    std::fs::write(&data, curve.csv()).with_context(|| format!("{}", data.display()))?;
    println!(
        "seed {}      {} updates, {} steps, {} episodes in {:.1} min",
        run.seed,
        run.memory.updates,
        run.steps,
        run.episodes,
        curve.spent_s() / 60.0
    );
    let network = run.network()?;
    for (name, mazes) in tests.iter().chain(&unseen) {
        let each = (arguments.episodes as usize / mazes.len()).max(1) as u32;
        let marks = examine_surveys(&network, &recipe, mazes, each, EXAMINATION_SEED)?;
        println!("unseen      {name}: {}", describe(&marks.into_iter().sum()));
        let taught = examine_teacher(&recipe, mazes, each, EXAMINATION_SEED);
        println!("  teacher   {name}: {}", describe(&taught.into_iter().sum::<Marks>()));
    }
    println!("policy      {}", out.display());
    println!("curve       {}", data.display());
    let figure = out.with_extension("curve.svg");
    std::fs::write(&figure, Curve::figure(&[curve])?).with_context(|| format!("{}", figure.display()))?;
    println!("figure      {}", figure.display());
    Ok(ExitCode::SUCCESS)
}

fn learn(arguments: &Arguments, recipe: &SurveyRecipe, mazes: &[MazeLattice]) -> anyhow::Result<(SurveyRun, Curve)> {
    let checkpoint = arguments.out.with_extension("checkpoint");
    let (mut run, mut curve) = match arguments.resume {
        true => {
            let (run, spent_s) = SurveyRun::read(&checkpoint, recipe, arguments.seed)?;
            (run, Curve::resumed(spent_s))
        }
        false => (SurveyRun::new(recipe.clone(), arguments.seed, mazes)?, Curve::default()),
    };
    let bar = ProgressBar::new(recipe.updates)
        .with_style(ProgressStyle::with_template("{bar:30} {pos}/{len} updates, {msg}, {eta} left")?);
    bar.set_position(run.memory.updates);
    bar.reset_eta();
    let begun = Instant::now();
    let mut kept = Instant::now();
    let mut failure: Option<TrainingError> = None;
    run.run(mazes, &mut |run| {
        curve.time(begun.elapsed().as_secs_f64());
        bar.set_position(run.memory.updates);
        bar.set_message(message(run));
        if kept.elapsed() >= CHECKPOINT_PERIOD || run.is_done() {
            failure = run.write(&checkpoint, curve.spent_s()).err();
            kept = Instant::now();
        }
        failure.is_none()
    })?;
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    bar.finish_and_clear();
    curve.points.clone_from(&run.curve);
    Ok((run, curve))
}

fn message(run: &SurveyRun) -> String {
    let mut parts = Vec::new();
    if let Some(marks) = run.curve.iter().rev().find_map(|point| point.examined) {
        parts.push(format!("{:.1} % examined", 100.0 * marks.success()));
    }
    if let Some(loss) = run.curve.last().and_then(|point| point.loss.mean()) {
        parts.push(format!("loss {loss:.4}"));
    }
    parts.join(", ")
}
