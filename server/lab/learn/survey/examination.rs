//! Examination on the lattice: the success of a network that acts as the live transport does, and of the teacher.

use candle_core::Result;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::episode::Episode;
use super::lattice::MazeLattice;
use super::learner::values;
use super::recipe::SurveyRecipe;
use super::teacher::Advice;
use crate::learn::environment::Ending;
use crate::learn::examine::Marks;
use ferry_core::policy::{ACTING_FRACTIONS, Network, Survey};

/// Random stream of examinations; training uses other streams of its seed.
const STREAM: u64 = 1 << 40;
/// Episodes that are stepped together.
const TOGETHER: usize = 128;
/// Mazes of a small examination during training.
const EXAMINED: usize = 100;
/// Below the value of any action.
const NO_PATH: f32 = -1e6;

/// Values of the actions for surveys.
type Judge<'a> = dyn FnMut(&[&Survey]) -> Result<Vec<[f32; 4]>> + 'a;

/// The mazes of the small examinations.
pub fn examined_mazes(mazes: &[MazeLattice]) -> &[MazeLattice] {
    &mazes[..mazes.len().min(EXAMINED)]
}

/// `each` episodes on each maze, with random starts and goals.
///
/// # Errors
/// Those of candle.
pub fn examine(
    network: &Network,
    recipe: &SurveyRecipe,
    mazes: &[MazeLattice],
    each: u32,
    seed: u64,
) -> Result<Vec<Marks>> {
    examine_by(&mut |surveys| values(network, surveys, ACTING_FRACTIONS, None), recipe, mazes, each, seed)
}

/// The same episodes by the teacher.
pub fn examine_teacher(recipe: &SurveyRecipe, mazes: &[MazeLattice], each: u32, seed: u64) -> Vec<Marks> {
    let judge =
        |survey: &&Survey| Advice::on(survey).after.map(|steps| steps.map_or(NO_PATH, |steps| -f32::from(steps)));
    let marks = examine_by(&mut |surveys| Ok(surveys.iter().map(judge).collect()), recipe, mazes, each, seed);
    marks.expect("the teacher has no network that could fail")
}

fn examine_by(
    judge: &mut Judge<'_>,
    recipe: &SurveyRecipe,
    mazes: &[MazeLattice],
    each: u32,
    seed: u64,
) -> Result<Vec<Marks>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(STREAM);
    let mut marks = vec![Marks::default(); mazes.len()];
    let indices = (0..mazes.len()).flat_map(|index| (0..each).map(move |_| index));
    let mut left: Vec<Episode> =
        indices.filter_map(|index| Episode::on(mazes, index, None, recipe, &mut rng)).collect();
    while !left.is_empty() {
        let mut running: Vec<Episode> = left.drain(..left.len().min(TOGETHER)).collect();
        while !running.is_empty() {
            let surveys: Vec<_> = running.iter().map(|episode| &episode.survey).collect();
            let values = judge(&surveys)?;
            let mut still = Vec::with_capacity(running.len());
            for (mut episode, values) in running.into_iter().zip(values) {
                let action = Episode::best(&episode.survey, values, recipe);
                let ending = episode.step(&mazes[episode.maze], action, recipe).ending;
                let Some(ending) = ending else {
                    still.push(episode);
                    continue;
                };
                let marks = &mut marks[episode.maze];
                marks.episodes += 1;
                match ending {
                    Ending::Collided => marks.collided += 1,
                    Ending::TimedOut => marks.timed_out += 1,
                    Ending::Reached => {
                        marks.reached += 1;
                        marks.steps += episode.steps;
                        marks.least_steps += u32::from(episode.least_steps);
                    }
                }
            }
            running = still;
        }
    }
    Ok(marks)
}
