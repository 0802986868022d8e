//! An episode on the lattice of a maze. What the camera would have seen around the tool is known, the rest is not.

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use super::lattice::{MazeLattice, UNREACHABLE};
use super::recipe::SurveyRecipe;
use crate::learn::environment::Ending;
use crate::learn::sweep::STEP_M;
use ferry_core::geometry::{Point2, Vector2};
use ferry_core::perception::Area;
use ferry_core::policy::{Action, Survey};
use ferry_core::trial::GOAL_RADIUS_M;

/// Cells to each side of the tool that an image shows with their clearance; one fewer in some episodes.
const SEEN: [i64; 2] = [8, 9];
/// What a wall may appear closer than it is.
const MARGINS_M: [f64; 3] = [0.0, 0.001, 0.002];
/// Draws of a start and a goal before a maze is given up.
const DRAWS: usize = 200;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Episode {
    /// Index of the maze.
    pub maze: usize,
    pub survey: Survey,
    goal_m: Point2<f64>,
    /// Clearance of the cells that appear free.
    clearance_m: f64,
    seen: i64,
    pub steps: u32,
    /// Steps from the start on the shortest path.
    pub least_steps: u16,
    /// Steps of the shortest true path from each cell.
    #[serde(skip)]
    to_goal: Vec<u16>,
}

/// The result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    pub reward: f32,
    pub ending: Option<Ending>,
}

impl Episode {
    /// A start and a goal on one of the mazes, which may keep what an earlier episode has observed there.
    pub fn start(mazes: &[MazeLattice], earlier: Option<&Self>, recipe: &SurveyRecipe, rng: &mut impl Rng) -> Self {
        let keeps = earlier.filter(|_| rng.random::<f64>() < recipe.keep_survey);
        if let Some(earlier) = keeps
            && let Some(episode) = Self::on(mazes, earlier.maze, Some(earlier), recipe, rng)
        {
            return episode;
        }
        loop {
            let maze = rng.random_range(0..mazes.len());
            if let Some(episode) = Self::on(mazes, maze, None, recipe, rng) {
                return episode;
            }
        }
    }

    /// An episode on one maze; `None` if many draws find no start and goal that are connected.
    pub fn on(
        mazes: &[MazeLattice],
        index: usize,
        earlier: Option<&Self>,
        recipe: &SurveyRecipe,
        rng: &mut impl Rng,
    ) -> Option<Self> {
        let maze = &mazes[index];
        let drawn_m = recipe.clearance_m + MARGINS_M[rng.random_range(0..MARGINS_M.len())];
        let clearance_m = earlier.map_or(drawn_m, |earlier| earlier.clearance_m);
        let seen = SEEN[rng.random_range(0..SEEN.len())];
        for _ in 0..DRAWS {
            let [start, goal] = std::array::from_fn(|_| rng.random_range(0..maze.count()));
            let offset = Vector2::new(rng.random_range(-0.5..0.5), rng.random_range(-0.5..0.5));
            if [start, goal].iter().any(|&cell| maze.clearance_m(cell) < clearance_m) {
                continue;
            }
            let goal_m = maze.center_m(goal) + offset * STEP_M;
            let to_goal = maze.steps_to(goal, |cell| maze.clearance_m(cell) >= clearance_m);
            if to_goal[start] == UNREACHABLE || (maze.center_m(start) - goal_m).norm() <= GOAL_RADIUS_M {
                continue;
            }
            let (columns, rows) = maze.shape();
            let survey = match earlier {
                Some(earlier) => {
                    let mut survey = earlier.survey.clone();
                    survey.clear_visits();
                    (survey.tool, survey.goal) = (start, goal);
                    survey
                }
                None => Survey::unknown(columns, rows, start, goal),
            };
            let least_steps = to_goal[start];
            let mut episode = Self { maze: index, survey, goal_m, clearance_m, seen, steps: 0, least_steps, to_goal };
            episode.look(maze);
            if !recipe.memory {
                episode.forget(maze);
            }
            return Some(episode);
        }
        None
    }

    /// Notes what an image from the tool's place shows.
    fn look(&mut self, maze: &MazeLattice) {
        let [column, row] = self.survey.place(self.survey.tool);
        let (columns, rows) = maze.shape();
        let span = |middle: i64, count: usize| (middle - self.seen).max(0)..=(middle + self.seen).min(count as i64 - 1);
        for (row, column) in span(row, rows).flat_map(|row| span(column, columns).map(move |column| (row, column))) {
            let cell = row as usize * columns + column as usize;
            let is_free = maze.clearance_m(cell) >= self.clearance_m;
            self.survey.set_known(cell, if is_free { Area::Free } else { Area::Blocked });
        }
    }

    /// Keeps only what the present image shows, for the ablation without memory.
    fn forget(&mut self, maze: &MazeLattice) {
        for cell in 0..self.survey.count() {
            self.survey.set_known(cell, Area::Unknown);
        }
        self.look(maze);
    }

    /// Whether an action leads to a cell that is not known to be blocked.
    pub fn is_open(survey: &Survey, action: Action) -> bool {
        survey.beside(survey.tool, action).is_some_and(|cell| survey.known(cell) != Area::Blocked)
    }

    /// The actions' values after the penalty for visits and the shield, as in the live transport; the best action.
    pub fn best(survey: &Survey, values: [f32; 4], recipe: &SurveyRecipe) -> Action {
        let visits = |action: Action| survey.beside(survey.tool, action).map_or(0, |cell| survey.visits(cell));
        let worth = |action: Action| values[action.index()] - recipe.visit_penalty as f32 * f32::from(visits(action));
        let open = || Action::ALL.into_iter().filter(|&action| Self::is_open(survey, action));
        let best = |actions: &mut dyn Iterator<Item = Action>| actions.max_by(|&a, &b| worth(a).total_cmp(&worth(b)));
        best(&mut open()).or_else(|| best(&mut Action::ALL.into_iter())).expect("there are four actions")
    }

    pub fn step(&mut self, maze: &MazeLattice, action: Action, recipe: &SurveyRecipe) -> Outcome {
        if self.to_goal.is_empty() {
            // After a checkpoint.
            self.to_goal = maze.steps_to(self.survey.goal, |cell| maze.clearance_m(cell) >= self.clearance_m);
        }
        let here = self.survey.tool;
        let visits = u32::from(self.survey.visits(here)) + 1;
        self.survey.set_visits(here, visits);
        self.steps += 1;
        let next = self.survey.beside(here, action).filter(|&next| maze.clearance_m(next) >= self.clearance_m);
        let Some(next) = next else { return Outcome { reward: -1.0, ending: Some(Ending::Collided) } };
        let gained = f64::from(self.to_goal[here]) - f64::from(self.to_goal[next]);
        self.survey.tool = next;
        if recipe.memory {
            self.look(maze);
        } else {
            self.forget(maze);
        }
        let reached = (maze.center_m(next) - self.goal_m).norm() <= GOAL_RADIUS_M;
        let reward = recipe.progress_reward * gained + f64::from(u8::from(reached));
        let ending = match reached {
            true => Some(Ending::Reached),
            false => (self.steps >= recipe.step_limit).then_some(Ending::TimedOut),
        };
        Outcome { reward: reward as f32, ending }
    }

    /// Whether an action ends within the goal's radius.
    pub fn reaches(&self, maze: &MazeLattice, action: Action) -> bool {
        let next = self.survey.beside(self.survey.tool, action);
        next.is_some_and(|next| (maze.center_m(next) - self.goal_m).norm() <= GOAL_RADIUS_M)
    }
}
