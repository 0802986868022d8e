//! ERRT: the execution-extended rapidly exploring random tree of Bruce & Veloso 2002, "Real-time randomized path
//! planning for robot navigation" (IROS), around what the camera has seen so far.
//!
//! From the publication: a tree grows from the start by edges of a fixed length, each from the node nearest to a target
//! toward it. The target is the goal with one probability, a waypoint of an earlier way with another, and anywhere
//! else ([`PlannerParameters`]); the corners of a way that was found take random slots of the waypoint cache; nearest
//! is least distance + β · cost from the root ([`Tree::nearest`]), and β adapts between 0 and its most.
//!
//! Ours, each with a parameter or a reason where it is made: obstacles are rectangles with a clearance, which near an
//! end that has less is what that end has and grows from there ([`Clearance`]); a flood fill decides beforehand whether
//! there is a way and how much clearance it leaves; the straight line from start to goal is tried first; empty slots of
//! the cache stand for random states; samples come from where the clearance is kept; β also falls while a search takes
//! long; ways are cut short.
//!
//! What was never seen counts as free: a way leads through it, and seeing it either confirms the way or has it
//! planned anew. So the unknown is explored where the goal is hidden behind it, and what is walled off for all that is
//! unknown is walled off for good.

mod cache;
mod clearance;
mod obstacles;
mod path;
mod planner;
mod reach;
mod segment;
#[cfg(test)]
mod tests;
mod tree;

pub use clearance::{Clearance, End};
pub use obstacles::Obstacles;
pub use path::Path;
pub use planner::{Planner, PlannerParameters, Progress};
pub use tree::Tree;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Transport, TransportInput, Trouble};
use crate::control::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::Point2;
use crate::perception::{CellState, ObstacleMap};
use crate::scenario::Parameters;

/// Edges of a tree that are shown at most; more could not be told apart.
pub const MOST_EDGES: usize = 4000;
/// A tool farther from its way than this is not on it any more: the bead was fetched somewhere else.
const OFF_PATH_M: f64 = 0.01;
/// A way may lose so much of its clearance before another is planned: a cell of the map, as more of a wall is seen.
const TOLERANCE_M: f64 = 0.002;
/// Spacing at which a way is asked whether it was seen.
const SAMPLE_M: f64 = 0.005;

/// What was made of the map last; not part of the memory, since the map says it all. A copy has none: snapshots are
/// many, and this is half a megabyte.
#[derive(Debug, Default)]
struct Made(Option<Arc<Obstacles>>);

impl Clone for Made {
    fn clone(&self) -> Self {
        Self(None)
    }
}

impl PartialEq for Made {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A way that is wanted, and what was found of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Task {
    from: Point2<f64>,
    goal: Point2<f64>,
    /// Ways found so far, and the best with its expected length.
    #[serde(rename = "ways")]
    paths: u32,
    best: Option<(Path, f64)>,
}

/// A way and how far along it the tool is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Followed {
    #[serde(rename = "way")]
    path: Path,
    along_m: f64,
    /// How far off the tool may be: at first as far as the place where it gets off a wall.
    off_m: f64,
}

/// The transport and its memory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errt {
    planner: Planner,
    /// What is searched for, if anything is.
    task: Option<Task>,
    followed: Option<Followed>,
    /// Ways planned since the trial began.
    plans: u32,
    #[serde(skip)]
    made: Made,
}

impl Errt {
    /// A transport that remembers nothing.
    pub fn new(seed: u64) -> Self {
        Self { planner: Planner::new(seed), task: None, followed: None, plans: 0, made: Made::default() }
    }

    /// The planner.
    pub fn planner(&self) -> &Planner {
        &self.planner
    }

    /// Edges of the tree, no more than can be shown.
    pub fn shown_edges(&self) -> impl Iterator<Item = [Point2<f64>; 2]> {
        self.planner.tree().into_iter().flat_map(Tree::edges).take(MOST_EDGES)
    }

    /// The way that is followed.
    pub fn path(&self) -> Option<&Path> {
        self.followed.as_ref().map(|followed| &followed.path)
    }

    /// Ways planned since the trial began.
    pub fn plans(&self) -> u32 {
        self.plans
    }

    /// The obstacles of a map, made anew when it changed.
    fn obstacles(&mut self, known: &ObstacleMap, clearance_m: f64) -> Arc<Obstacles> {
        let fits = |made: &&Arc<Obstacles>| made.version() == known.version() && made.most_clearance_m() == clearance_m;
        match self.made.0.as_ref().filter(fits) {
            Some(made) => made.clone(),
            None => self.made.0.insert(Arc::new(Obstacles::of(known, clearance_m))).clone(),
        }
    }

    /// Drops a way that leads elsewhere, that the tool has left, or that a newly seen obstacle cuts.
    fn check_path(&mut self, obstacles: &Obstacles, tool_m: Point2<f64>, goal_m: Point2<f64>) {
        let is_good = |Followed { path, along_m, off_m }: &mut Followed| {
            let (place_m, is_off_m) = path.nearest(tool_m, *along_m);
            if place_m > *along_m {
                *off_m = OFF_PATH_M;
            }
            *along_m = place_m;
            path.goal() == goal_m && is_off_m <= *off_m && path.is_clear_from(*along_m, obstacles, TOLERANCE_M)
        };
        if !self.followed.as_mut().is_some_and(is_good) {
            self.followed = None;
        }
    }

    /// Searches on, or anew where it would search for something else, until there are as many ways as are to be
    /// compared or no attempts are left. Then the shortest is followed: through what was never seen many ways seem
    /// open, and whoever takes now this and now that one gets nowhere.
    fn plan(&mut self, obstacles: &Obstacles, input: &TransportInput<'_>) -> Result<(), Refusal> {
        let parameters = planner_parameters(input.parameters);
        // Waypoints lead along the way that is known; to be compared it needs others.
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
                // What is left is narrower than the least clearance, or the flood fill would have told where there is
                // room for a search that never takes so long.
                Progress::Exhausted if task.paths == 0 => return Err(Refusal::WalledOff),
                Progress::Found(path) => {
                    task.paths += 1;
                    let cost_m = expected_m(path, input.known, input.parameters.errt_unseen_weight);
                    // Nothing is shorter than the straight line.
                    let is_straight = path.points.len() == 2;
                    if task.best.as_ref().is_none_or(|(_, best_m)| cost_m < *best_m) {
                        task.best = Some((path.clone(), cost_m));
                    }
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
                let off_m = OFF_PATH_M.max((path.points[0] - input.tool_m).norm());
                self.followed = Some(Followed { path, along_m: 0.0, off_m });
                Ok(())
            }
            None => {
                self.task = Some(task);
                Err(Refusal::Searching { attempts: self.planner.attempts() as u64 })
            }
        }
    }
}

/// Length of a way, with what leads through the unseen counted so many times: where a way leads there straight, the
/// real one seldom does.
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
        least_clearance_m: parameters.errt_clearance_m.min(PlannerParameters::default().least_clearance_m),
        shortcuts: PlannerParameters::default().shortcuts.filter(|_| parameters.errt_shortcut),
        ..PlannerParameters::default()
    }
}

impl Transport for Errt {
    fn start_leg(&mut self) {
        self.followed = None;
    }

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let obstacles = self.obstacles(input.known, input.parameters.errt_clearance_m);
        self.check_path(&obstacles, input.tool_m, input.goal_m);
        if self.followed.is_none() {
            self.plan(&obstacles, input)?;
        }
        let reach_m = input.parameters.transport_speed_m_s * CONTROL_PERIOD_S;
        let Some(Followed { path, along_m, .. }) = &self.followed else {
            return Err(Refusal::Searching { attempts: 0 });
        };
        // Where the tool is off the way, the way to it counts too.
        let off_m = (path.at(*along_m) - input.tool_m).norm();
        let ahead_m = path.at(*along_m + (reach_m - off_m).max(0.0));
        let target_m = input.tool_m + (ahead_m - input.tool_m).cap_magnitude(reach_m);
        let speed_m_s = (target_m - input.tool_m).norm() / CONTROL_PERIOD_S;
        Ok(TargetStep { target_m, speed_m_s: speed_m_s.min(input.parameters.transport_speed_m_s) })
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
