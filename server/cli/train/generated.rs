//! `ferry train --map generated`.

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, ensure};

use super::{Arguments, bar_of, describe, files, learn};
use ferry_core::map::MazeFamily;
use ferry_files::open;
use ferry_lab::learn::{
    Curve, EXAMINATION_SEED, Marks, MazeLattice, RecipeName, SurveyRecipe, SurveyRun, examine_surveys, examine_teacher,
    revision,
};

/// Instead of the names of maps.
pub const MAP: &str = "generated";
const TRAINED: [MazeFamily; 3] = [MazeFamily::Tubes, MazeFamily::Trees, MazeFamily::Stones];
const TESTED: [MazeFamily; 3] = [MazeFamily::Rooms, MazeFamily::Spirals, MazeFamily::Serpentines];
/// Mazes of each family in the final examination, with seeds from 1 on.
const EXAMINED: usize = 20;

pub fn train(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    ensure!(!arguments.paper, "--paper: the paper's settings are for its own policy, not for --map {MAP}");
    ensure!(arguments.recipe == RecipeName::Full, "--recipe: --map {MAP} has a recipe of its own");
    ensure!(arguments.start_from.is_none(), "--start-from: --map {MAP} starts from random weights");
    ensure!(arguments.rounds == 1, "--rounds: --map {MAP} trains one round; give --seed instead");
    let recipe: SurveyRecipe = crate::cli::with_changes(&SurveyRecipe::default(), &arguments.set)?;
    recipe.check().context("--set")?;
    let out = &files::out(arguments);
    files::check(arguments, out, &[(arguments.seed, out.clone())])?;
    let mazes = MazeLattice::generated(&TRAINED, 1, recipe.mazes)?;
    let tests: Vec<(&str, Vec<MazeLattice>)> = TESTED
        .into_iter()
        .map(|family| Ok((family.as_str(), MazeLattice::generated(&[family], 1, EXAMINED)?)))
        .collect::<anyhow::Result<_>>()?;
    let unseen = arguments.unseen.iter().map(|name| Ok((name.as_str(), vec![MazeLattice::of(&open::map(name)?)])));
    let unseen: Vec<(&str, Vec<MazeLattice>)> = unseen.collect::<anyhow::Result<_>>()?;
    files::create_folder(out)?;

    let (run, curve) = run(arguments, &recipe, out, &mazes)?;
    let maps = TRAINED.map(|family| format!("{} {} to {}", family.as_str(), 1, recipe.mazes.div_ceil(TRAINED.len())));
    std::fs::write(out, run.policy(maps.into(), &revision())?).with_context(|| format!("{}", out.display()))?;
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
    println!("curve       {}", out.with_extension("curve.csv").display());
    let figure = out.with_extension("curve.svg");
    std::fs::write(&figure, Curve::figure(&[curve])?).with_context(|| format!("{}", figure.display()))?;
    println!("figure      {}", figure.display());
    Ok(ExitCode::SUCCESS)
}

fn run(
    arguments: &Arguments,
    recipe: &SurveyRecipe,
    out: &Path,
    mazes: &[MazeLattice],
) -> anyhow::Result<(SurveyRun, Curve)> {
    let (mut run, curve) = match arguments.resume {
        true => {
            let (run, spent_s) = SurveyRun::read(&out.with_extension("checkpoint"), recipe, arguments.seed)?;
            (run, Curve::resumed(spent_s))
        }
        false => (SurveyRun::new(recipe.clone(), arguments.seed, mazes)?, Curve::default()),
    };
    let bar = bar_of(recipe.updates, run.memory.updates)?;
    let curve = learn(&mut run, mazes, out, curve, &mut |run| {
        bar.set_position(run.memory.updates);
        bar.set_message(message(run));
    })?;
    bar.finish_and_clear();
    Ok((run, curve))
}

fn message(run: &SurveyRun) -> String {
    let mut parts = Vec::new();
    if let Some(marks) = run.curve.iter().rev().find_map(|point| point.examined) {
        parts.push(format!("{:.1} % examined, ", 100.0 * marks.success()));
    }
    if let Some(loss) = run.curve.last().and_then(|point| point.loss.mean()) {
        parts.push(format!("loss {loss:.4}, "));
    }
    parts.concat()
}
