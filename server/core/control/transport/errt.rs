//! ERRT: the execution-extended rapidly exploring random tree of Bruce & Veloso 2002, "Real-time randomized path
//! planning for robot navigation" (IROS), on the obstacles that the camera has observed so far.
//!
//! From the publication: a tree grows from the start by edges of a fixed length, each from the node nearest to a target
//! toward that target. The target is the goal, a waypoint of an earlier path, or a random point, with probabilities
//! from [`PlannerParameters`]. The corners of a found path replace random slots of the waypoint cache. The nearest node
//! minimises distance + β · cost from the root ([`Tree::nearest`]). β adapts between 0 and its upper limit.
//!
//! Not from the publication: obstacles are rectangles with a clearance, which is smaller near an end that is close to a
//! wall ([`super::planning::Clearance`]). A flood fill decides beforehand whether a path exists and which clearance it can keep. The
//! straight line from start to goal is tried first. The cache starts with empty slots, not with random states. Samples
//! are drawn where the clearance is kept. β also falls while a search takes long. Found paths are shortened. Each has a
//! parameter or a reason where it is defined. A search that takes too many attempts ends with the shortest path over
//! the map's cells.
//!
//! Unobserved places count as free: a path may lead through them. When they are observed, the path is either confirmed
//! or planned again. So the tool explores unobserved places when the goal is behind them. A goal that is walled off
//! even with all unobserved places free stays walled off.

mod cache;
mod planner;
#[cfg(test)]
mod tests;
mod tree;

pub use planner::{Planner, PlannerParameters, Progress};
pub use tree::Tree;

use serde::{Deserialize, Serialize};

use super::planning::{Followed, LEAST_CLEARANCE_M, Latest, OFF_PATH_M, Obstacles, Path};
use super::{Transport, TransportInput, Trouble};
use crate::control::{Refusal, TargetStep};
use crate::geometry::Point2;
use crate::perception::{CellState, ObstacleMap};
use crate::scenario::Parameters;

/// Maximum number of edges of a tree that are shown. More could not be distinguished.
pub const MOST_EDGES: usize = 4000;
/// Spacing at which a path is checked for unobserved places.
const SAMPLE_M: f64 = 0.005;

/// The requested path, and the results so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Task {
    from: Point2<f64>,
    goal: Point2<f64>,
    /// Number of paths found so far, and the best one with its expected length.
    #[serde(rename = "ways")]
    paths: u32,
    best: Option<(Path, f64)>,
}

impl Task {
    /// Keeps a path if it is expected to be shorter than the best one so far.
    fn compare(&mut self, path: Path, input: &TransportInput<'_>) {
        self.paths += 1;
        let cost_m = expected_m(&path, input.known, input.parameters.errt_unseen_weight);
        if self.best.as_ref().is_none_or(|(_, best_m)| cost_m < *best_m) {
            self.best = Some((path, cost_m));
        }
    }
}

/// The transport and its memory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errt {
    planner: Planner,
    /// `None` if no path is being searched.
    task: Option<Task>,
    followed: Option<Followed>,
    /// Paths planned since the trial began.
    plans: u32,
    #[serde(skip)]
    latest: Latest,
}

impl Errt {
    pub fn new(seed: u64) -> Self {
        Self { planner: Planner::new(seed), task: None, followed: None, plans: 0, latest: Latest::default() }
    }

    pub(super) fn reseed(&mut self, seed: u64) {
        self.planner.reseed(seed);
    }

    pub fn planner(&self) -> &Planner {
        &self.planner
    }

    /// Edges of the tree, at most [`MOST_EDGES`].
    pub fn shown_edges(&self) -> impl Iterator<Item = [Point2<f64>; 2]> {
        self.planner.tree().into_iter().flat_map(Tree::edges).take(MOST_EDGES)
    }

    /// The path that is followed.
    pub fn path(&self) -> Option<&Path> {
        self.followed.as_ref().map(Followed::path)
    }

    /// Paths planned since the trial began.
    pub fn plans(&self) -> u32 {
        self.plans
    }

    /// Continues the search, or restarts it if the goal has changed, until enough paths are found for comparison or no
    /// attempts are left. Then the shortest path is followed. Through unobserved places many paths appear open, and a
    /// tool that switches between them makes no progress.
    fn plan(&mut self, obstacles: &Obstacles, input: &TransportInput<'_>) -> Result<(), Refusal> {
        let parameters = planner_parameters(input.parameters);
        // Waypoints follow the known path; the comparison needs different ones.
        let other = PlannerParameters { waypoint_probability: 0.0, ..parameters };
        let is_same = |task: &Task| task.goal == input.goal_m && (task.from - input.tool_m).norm() <= OFF_PATH_M;
        let goes_on = *self.planner.progress() == Progress::Searching && self.task.as_ref().is_some_and(is_same);
        let mut task = match self.task.take().filter(|_| goes_on) {
            Some(task) => task,
            None => {
                self.planner.start(&parameters, obstacles, input.tool_m, input.goal_m);
                Task { from: input.tool_m, goal: input.goal_m, paths: 0, best: None }
            }
        };
        let mut left = input.parameters.errt_nodes_per_step as usize;
        loop {
            let before = self.planner.attempts();
            match self.planner.advance(obstacles, left) {
                Progress::WalledOff => return Err(Refusal::WalledOff),
                // In a long narrow channel a random search takes too many attempts, so the map's cells decide.
                Progress::Exhausted if task.paths == 0 => {
                    let limits_m = [parameters.clearance_m, parameters.least_clearance_m];
                    let shortest = obstacles.shortest_path(task.from, task.goal, limits_m);
                    task.compare(shortest.ok_or(Refusal::WalledOff)?, input);
                    break;
                }
                Progress::Found(path) => {
                    // No path is shorter than the straight line.
                    let is_straight = path.points.len() == 2;
                    task.compare(path.clone(), input);
                    if is_straight || task.paths >= input.parameters.errt_ways {
                        break;
                    }
                }
                Progress::Idle | Progress::Searching | Progress::Exhausted => {}
            }
            left -= (self.planner.attempts() - before).min(left);
            if left == 0 {
                break;
            }
            if *self.planner.progress() != Progress::Searching {
                self.planner.start(if task.paths > 0 { &other } else { &parameters }, obstacles, task.from, task.goal);
            }
        }
        match task.best.take() {
            Some((path, _)) => {
                self.plans += 1;
                self.planner.remember(&path);
                self.followed = Some(Followed::new(path, input.tool_m));
                Ok(())
            }
            None => {
                self.task = Some(task);
                Err(Refusal::Searching { attempts: self.planner.attempts() as u64 })
            }
        }
    }
}

/// Length of a path, with the parts through unobserved places multiplied by `unseen_weight`: there the real path is
/// rarely straight.
fn expected_m(path: &Path, known: &ObstacleMap, unseen_weight: f64) -> f64 {
    let length_m = path.length_m();
    let count = (length_m / SAMPLE_M).ceil().max(1.0);
    let place = |i: usize| path.at(length_m * (i as f64 + 0.5) / count);
    let unseen = (0..count as usize).filter(|&i| known.state(place(i)) == CellState::Unknown).count();
    length_m * (1.0 + (unseen_weight - 1.0) * unseen as f64 / count)
}

fn planner_parameters(parameters: &Parameters) -> PlannerParameters {
    PlannerParameters {
        goal_probability: parameters.errt_goal_probability,
        waypoint_probability: parameters.errt_waypoint_probability,
        waypoints: parameters.errt_waypoints as usize,
        beta_most: parameters.errt_beta_most,
        step_m: parameters.errt_step_m,
        clearance_m: parameters.errt_clearance_m,
        least_clearance_m: parameters.errt_clearance_m.min(LEAST_CLEARANCE_M),
        shortcuts: PlannerParameters::default().shortcuts.filter(|_| parameters.errt_shortcut),
        ..PlannerParameters::default()
    }
}

impl Transport for Errt {
    fn start_leg(&mut self) {
        self.followed = None;
    }

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let obstacles = self.latest.of(input.known, input.parameters.errt_clearance_m);
        if !self.followed.as_mut().is_some_and(|path| path.goes_on(&obstacles, input.tool_m, input.goal_m)) {
            self.followed = None;
            self.plan(&obstacles, input)?;
        }
        let Some(followed) = &self.followed else { return Err(Refusal::Searching { attempts: 0 }) };
        Ok(followed.next_step(input.tool_m, input.parameters.transport_speed_m_s))
    }

    fn trouble(&self) -> Option<Trouble> {
        match self.planner.progress() {
            _ if self.followed.is_some() => None,
            Progress::WalledOff | Progress::Exhausted => Some(Trouble::WalledOff),
            Progress::Searching => Some(Trouble::Searching),
            Progress::Idle | Progress::Found(_) => None,
        }
    }
}
