//! Training's environment (specification §7): the tool steps from cell to cell of a [`Terrain`]. Bead, arm and camera
//! are not simulated; their effects are in the terrain's tables.

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::goals::GoalSet;
use super::recipe::{EPISODE_STEPS, Recipe};
use super::terrain::{GOAL_JITTER_M, Terrain, UNREACHABLE};
use ferry_core::geometry::{Point2, Vector2};
use ferry_core::trial::GOAL_RADIUS_M;

/// Draws of a goal. From a cell that no goal can be reached from, all are in vain.
const DRAWS: u32 = 100_000;

/// A place anywhere in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Goal {
    pub cell: u16,
    /// Offset from the cell's centre; −127 to 127 spans the cell.
    pub offset: [i8; 2],
}

impl Goal {
    /// A random place in a cell.
    pub fn in_cell(cell: u16, rng: &mut impl Rng) -> Self {
        let mut draw = || rng.random_range(-127..=127);
        Self { cell, offset: [draw(), draw()] }
    }

    /// A random place that can be reached from a cell; `None` if many draws find none.
    pub fn anywhere(terrain: &Terrain, goals: GoalSet, from: u16, rng: &mut impl Rng) -> Option<Self> {
        for _ in 0..DRAWS {
            let cell = rng.random_range(0..terrain.cells()) as u16;
            if terrain.distance(from, cell) != UNREACHABLE && goals.has(terrain, cell) {
                return Some(Self::in_cell(cell, rng));
            }
        }
        None
    }

    /// Position on the table.
    pub fn place_m(self, terrain: &Terrain) -> Point2<f64> {
        let [x, y] = self.offset.map(|offset| f64::from(offset) / 127.0 * GOAL_JITTER_M);
        terrain.center_m(self.cell) + Vector2::new(x, y)
    }

    /// Whether the goal is within 2 cm of the centre of `cell`.
    pub fn is_reached_from(self, terrain: &Terrain, cell: u16) -> bool {
        (terrain.center_m(cell) - self.place_m(terrain)).norm() <= GOAL_RADIUS_M
    }
}

/// The result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    pub reward: f32,
    /// Whether the episode ends for the learner.
    pub terminal: bool,
}

impl Recipe {
    /// The result of a step from one cell to another, or to the end of the episode, for a goal.
    pub fn outcome(&self, terrain: &Terrain, from: u16, to: Option<u16>, goal: Goal) -> Outcome {
        let Some(to) = to else { return Outcome { reward: -1.0, terminal: true } };
        let progress = match [from, to].map(|cell| terrain.distance(cell, goal.cell)) {
            // From some cells no path leads back. Such a step counts as a loss of one step, not of an infinite number.
            [UNREACHABLE, UNREACHABLE] => 0.0,
            [_, UNREACHABLE] => -1.0,
            [before, after] => f64::from(before) - f64::from(after),
        };
        let shaped = self.progress_reward * progress - self.step_penalty;
        let terminal = goal.is_reached_from(terrain, to);
        Outcome { reward: (shaped + f64::from(u8::from(terminal))) as f32, terminal }
    }
}

/// How an episode ends, or would end if it began at a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = EpisodeEnding)]
#[ts(rename = "EpisodeEnding", rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Within 2 cm of the goal.
    Reached,
    /// The obstacle test is positive, a wall is too close, or there are no joint angles.
    Collided,
    /// Not within the recipe's number of steps.
    TimedOut,
}

/// One episode in progress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Episode {
    /// Index of the terrain.
    pub terrain: u8,
    /// Cell of the tool.
    pub cell: u16,
    pub goal: Goal,
    /// Steps so far.
    pub steps: u32,
    /// Sum of the rewards so far, without discount.
    pub total: f32,
}

impl Episode {
    /// A random start, and a random goal that is not reached yet. Each terrain must have one ([`GoalSet::has_episode`]).
    pub fn start(terrains: &[Terrain], goals: GoalSet, rng: &mut impl Rng) -> Self {
        let index = rng.random_range(0..terrains.len());
        let terrain = &terrains[index];
        loop {
            let cell = rng.random_range(0..terrain.cells()) as u16;
            let Some(goal) = Goal::anywhere(terrain, goals, cell, rng) else { continue };
            if !goal.is_reached_from(terrain, cell) {
                return Self { terrain: index as u8, cell, goal, steps: 0, total: 0.0 };
            }
        }
    }

    /// Content of the observation's second channel.
    pub fn places(&self, terrains: &[Terrain]) -> [f32; 4] {
        let terrain = &terrains[usize::from(self.terrain)];
        terrain.places(self.goal.place_m(terrain), self.cell)
    }

    /// Takes a step. Returns the new cell, and the ending if the episode ends.
    pub fn step(&mut self, terrains: &[Terrain], action: usize, recipe: &Recipe) -> (Option<u16>, Option<Ending>) {
        let terrain = &terrains[usize::from(self.terrain)];
        let to = terrain.step(self.cell, action);
        let outcome = recipe.outcome(terrain, self.cell, to, self.goal);
        self.total += outcome.reward;
        self.steps += 1;
        let ending = match to {
            None => Some(Ending::Collided),
            Some(_) if outcome.terminal => Some(Ending::Reached),
            Some(_) if self.steps >= EPISODE_STEPS => Some(Ending::TimedOut),
            Some(_) => None,
        };
        if let Some(to) = to {
            self.cell = to;
        }
        (to, ending)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::learn::terrain::tests::{corridor, two_rooms};

    #[test]
    fn rewards_match_the_specification() {
        let terrain = two_rooms();
        let goal = Goal { cell: 0, offset: [0, 0] };
        let paper = Recipe { progress_reward: 0.0, ..Recipe::default() };
        // Cells 0 to 2 are the lower row of the left room, 1 cm apart.
        assert_eq!(paper.outcome(&terrain, 2, None, goal), Outcome { reward: -1.0, terminal: true });
        let there = (0..26).find(|&cell| terrain.step(2, 2) == Some(cell));
        assert_eq!(paper.outcome(&terrain, 2, there, goal), Outcome { reward: 0.0, terminal: false });
        assert_eq!(paper.outcome(&terrain, 3, Some(2), goal), Outcome { reward: 1.0, terminal: true }, "2 cm away");
        let off = Goal { cell: 0, offset: [-1, 0] };
        assert!(!paper.outcome(&terrain, 3, Some(2), off).terminal, "slightly more than 2 cm away");
        let shaped = Recipe { step_penalty: 0.02, ..Recipe::default() };
        let away = shaped.outcome(&terrain, 2, there, goal);
        assert!((away.reward + 0.12).abs() < 1e-6 && !away.terminal, "{away:?}");
    }

    #[test]
    fn a_step_without_a_path_back_loses_one_step() {
        // Six cells; no step leads from the fourth back to the third.
        let terrain = corridor(&[1, 3, 3, 1, 3, 2]).unwrap();
        let goal = Goal { cell: 0, offset: [-127, 0] };
        assert_eq!((terrain.distance(2, 0), terrain.distance(3, 0)), (2, UNREACHABLE));
        let rewards =
            [(3, 4), (2, 3), (4, 3)].map(|(from, to)| Recipe::default().outcome(&terrain, from, Some(to), goal));
        assert_eq!(rewards.map(|outcome| outcome.reward), [0.0, -0.1, 0.0]);
        assert!(rewards.iter().all(|outcome| !outcome.terminal));
    }

    #[test]
    fn an_episode_ends_by_goal_collision_or_timeout() {
        let terrains = [two_rooms()];
        let recipe = Recipe::default();
        let goal = Goal { cell: 25, offset: [0, 0] };
        let mut episode = Episode { terrain: 0, cell: 0, goal, steps: 0, total: 0.0 };
        assert_eq!(episode.step(&terrains, 1, &recipe), (None, Some(Ending::Collided)));
        let mut episode = Episode { steps: 0, total: 0.0, ..episode };
        let back_and_forth = (0..150).map(|i| episode.step(&terrains, usize::from(i % 2 != 0), &recipe).1);
        let endings: Vec<_> = back_and_forth.collect();
        assert_eq!(endings[..149], [None; 149]);
        assert_eq!(endings[149], Some(Ending::TimedOut));
        // Even with no steps left, reaching the goal counts first.
        let mut episode = Episode { cell: 0, goal: Goal { cell: 2, offset: [0, 0] }, ..episode };
        assert!(matches!(episode.step(&terrains, 0, &recipe), (Some(1), Some(Ending::Reached))));
    }

    #[test]
    fn starts_are_not_at_their_goals() {
        let terrains = [two_rooms()];
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        for _ in 0..500 {
            let episode = Episode::start(&terrains, GoalSet::All, &mut rng);
            assert!(!episode.goal.is_reached_from(&terrains[0], episode.cell));
        }
    }

    #[test]
    fn goals_are_trained_or_held_out() {
        let terrains = [two_rooms()];
        let mut rng = ChaCha8Rng::seed_from_u64(4);
        let held_out = 0.5;
        let [trained, kept] = [GoalSet::Trained { held_out }, GoalSet::HeldOut { held_out }].map(|goals| {
            assert!(goals.has_episode(&terrains[0]));
            let drawn = (0..500).map(|_| Episode::start(&terrains, goals, &mut rng).goal.cell);
            drawn.collect::<std::collections::BTreeSet<u16>>()
        });
        assert!(
            trained.is_disjoint(&kept) && trained.len() + kept.len() == terrains[0].cells(),
            "{trained:?} {kept:?}"
        );
        assert!(!GoalSet::HeldOut { held_out: 0.0 }.has_episode(&terrains[0]));
    }
}
