//! The search, and the state that one search leaves to the next.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::cache::Cache;
use super::tree::Tree;
use crate::control::transport::planning::{Clearance, LEAST_CLEARANCE_M, Obstacles, Path};
use crate::geometry::{Point2, Rect};
use crate::scenario::Stream;

/// Share of a step that is tried from the root if a whole step is not clear: a start beside a wall may have no room for
/// more.
const FIRST_STEP: f64 = 0.25;

/// How often a sample that is too close to a wall is redrawn.
const DRAWS: usize = 100;

/// Parameters of the search. The defaults are those of the publication where it gives any.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannerParameters {
    /// Share of extensions toward the goal.
    pub goal_probability: f64,
    /// Share of extensions toward a waypoint, or toward a random point while the cache is empty. The remaining
    /// extensions go toward a random point.
    pub waypoint_probability: f64,
    /// Size of the cache; 0 disables it.
    pub waypoints: usize,
    /// Upper limit of β, the weight of the cost from the root; 0 gives the plain nearest neighbour.
    pub beta_most: f64,
    /// β grows by this if a path is shorter than the last one to the same goal; otherwise it falls by this.
    pub beta_step: f64,
    /// Not from the publication: β also falls by a step after this many attempts of one search. In a winding channel
    /// the right node's cost is many times its distance, and with a large β only nodes near the root would grow.
    pub beta_patience: usize,
    /// Longest edge of the tree.
    pub step_m: f64,
    /// Not from the publication: random points are drawn where the clearance is kept, not in the whole workspace.
    pub sample_where_clear: bool,
    /// Not from the publication: most random shortcuts tried on a found path, after those from corner to corner.
    /// `None` leaves the path as it was found.
    pub shortcuts: Option<usize>,
    /// Not from the publication: distance that a path keeps from walls where there is room.
    pub clearance_m: f64,
    /// Not from the publication: distance that a path keeps in the narrowest places.
    pub least_clearance_m: f64,
    /// The search stops after this many attempts to add an edge.
    pub most_attempts: usize,
}

impl Default for PlannerParameters {
    fn default() -> Self {
        Self {
            goal_probability: 0.1,
            waypoint_probability: 0.6,
            waypoints: 200,
            beta_most: 0.65,
            beta_step: 0.05,
            beta_patience: 50,
            step_m: 0.03,
            sample_where_clear: true,
            shortcuts: Some(200),
            clearance_m: 0.012,
            least_clearance_m: LEAST_CLEARANCE_M,
            most_attempts: 2000,
        }
    }
}

impl PlannerParameters {
    /// Checks parameters from a file, so that a search cannot use more memory or time than it has.
    fn checked<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found = Self::deserialize(deserializer)?;
        let ranges = [
            ("goal_probability", found.goal_probability, 1.0),
            ("waypoint_probability", found.waypoint_probability, 1.0),
            ("waypoints", found.waypoints as f64, 1000.0),
            ("beta_most", found.beta_most, 1.0),
            ("beta_step", found.beta_step, 1.0),
            ("step_m", found.step_m, 0.1),
            ("shortcuts", found.shortcuts.unwrap_or(0) as f64, 1000.0),
            ("clearance_m", found.clearance_m, 0.03),
            ("least_clearance_m", found.least_clearance_m, 0.03),
            ("most_attempts", found.most_attempts as f64, 20_000.0),
        ];
        match ranges.into_iter().find(|&(_, value, max)| !(0.0..=max).contains(&value)) {
            Some((field, value, max)) => Err(D::Error::custom(format!("{field} is {value}, it must be 0 to {max}"))),
            None => Ok(found),
        }
    }

    /// The plain rapidly exploring random tree (LaValle 1998) with a share of extensions toward the goal.
    pub fn plain() -> Self {
        Self { waypoints: 0, beta_most: 0.0, sample_where_clear: false, shortcuts: None, ..Self::default() }
    }
}

/// The state of a search.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Progress {
    /// Not started.
    #[default]
    Idle,
    /// In progress.
    Searching,
    /// A path was found.
    Found(Path),
    /// Given up after the largest number of attempts, although a path may exist.
    Exhausted,
    /// No path has the smallest clearance, even if all unobserved places are free.
    WalledOff,
}

/// Plans one path after another. All randomness comes from its seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Planner {
    rng: ChaCha8Rng,
    cache: Cache,
    beta: f64,
    /// Goal of the last path, and its length before shortening.
    last: Option<(Point2<f64>, f64)>,
    search: Option<Search>,
    progress: Progress,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Search {
    #[serde(deserialize_with = "PlannerParameters::checked")]
    parameters: PlannerParameters,
    /// Version of the obstacles that the tree avoids.
    version: u64,
    /// Position of the tool at the start.
    from: Point2<f64>,
    clearance: Clearance,
    tree: Tree,
    attempts: usize,
}

impl Planner {
    /// A planner without waypoints or tree.
    pub fn new(seed: u64) -> Self {
        Self {
            rng: Stream::Planner.rng(seed),
            cache: Cache::default(),
            beta: 0.0,
            last: None,
            search: None,
            progress: Progress::Idle,
        }
    }

    /// All further random numbers come from `seed`.
    pub fn reseed(&mut self, seed: u64) {
        self.rng = Stream::Planner.rng(seed);
    }

    /// Starts a search and drops the previous one. A path may be found, or found impossible, immediately.
    ///
    /// `obstacles` must have been made for clearances up to that of `parameters`.
    pub fn start(
        &mut self,
        parameters: &PlannerParameters,
        obstacles: &Obstacles,
        from: Point2<f64>,
        goal: Point2<f64>,
    ) {
        self.cache.resize(parameters.waypoints);
        self.search = None;
        self.progress = Progress::WalledOff;
        let start = obstacles.end_near(from, parameters.least_clearance_m);
        let Some((start, goal)) = start.zip(obstacles.end_at(goal)) else { return };
        let ends = [start, goal];
        let straight = Clearance { asked_m: parameters.clearance_m, ends };
        let is_straight = obstacles.is_clear(start.point, goal.point, &straight);
        let levels_m = [parameters.clearance_m, parameters.least_clearance_m];
        let reached = || obstacles.grid().clearance(ends, levels_m);
        let Some(clearance) = is_straight.then_some(straight).or_else(reached) else { return };
        let mut tree = Tree::new(start.point);
        self.progress = Progress::Searching;
        if is_straight {
            tree.push(goal.point, 0);
            self.progress = Progress::Found(Path { points: vec![start.point, goal.point], clearance });
        }
        let version = obstacles.version();
        self.search = Some(Search { parameters: *parameters, version, from, clearance, tree, attempts: 0 });
    }

    /// Makes at most `attempts` attempts to add an edge. The result does not depend on how attempts are divided into
    /// calls. If the obstacles have changed since the start, the search restarts.
    pub fn advance(&mut self, obstacles: &Obstacles, attempts: usize) -> &Progress {
        if let (Progress::Searching, Some(search)) = (&self.progress, &self.search)
            && search.version != obstacles.version()
        {
            let (parameters, from, goal) = (search.parameters, search.from, search.clearance.ends[1].point);
            self.start(&parameters, obstacles, from, goal);
        }
        for _ in 0..attempts {
            if self.progress != Progress::Searching {
                break;
            }
            self.attempt(obstacles);
        }
        &self.progress
    }

    fn attempt(&mut self, obstacles: &Obstacles) {
        let Some(search) = &mut self.search else { return };
        let parameters = search.parameters;
        search.attempts += 1;
        if search.attempts.is_multiple_of(parameters.beta_patience.max(1)) {
            self.beta = (self.beta - parameters.beta_step).max(0.0);
        }
        let target = search.target(&self.cache, obstacles, &mut self.rng);
        // A path's length is known only afterwards, and the parameters may have changed since.
        let beta = self.beta.min(parameters.beta_most);
        if let Some(last) = search.extend(target, beta, obstacles) {
            let points = search.tree.path(last);
            if parameters.waypoint_probability > 0.0 {
                self.cache.remember(&points, &mut self.rng);
            }
            let goal = search.clearance.ends[1].point;
            let length_m = search.tree.cost_m(last);
            if let Some((_, last_m)) = self.last.filter(|&(last_goal, _)| last_goal == goal) {
                let change = if length_m < last_m { parameters.beta_step } else { -parameters.beta_step };
                self.beta = (self.beta + change).clamp(0.0, parameters.beta_most);
            }
            self.last = Some((goal, length_m));
            let mut path = Path { points, clearance: search.clearance };
            if let Some(count) = parameters.shortcuts {
                path.skip_corners(obstacles);
                path.cut_short(count, obstacles, &mut self.rng);
            }
            self.progress = Progress::Found(path);
        } else if search.attempts >= parameters.most_attempts {
            self.progress = Progress::Exhausted;
        }
    }

    /// Stores the corners of a path as waypoints.
    pub fn remember(&mut self, path: &Path) {
        self.cache.remember(&path.points, &mut self.rng);
    }

    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// The tree of the last search; `None` if no path exists.
    pub fn tree(&self) -> Option<&Tree> {
        self.search.as_ref().map(|search| &search.tree)
    }

    /// Attempts of the last search so far.
    pub fn attempts(&self) -> usize {
        self.search.as_ref().map_or(0, |search| search.attempts)
    }

    /// Weight of the cost from the root when the nearest node is chosen.
    pub fn beta(&self) -> f64 {
        self.beta
    }
}

impl Search {
    /// The point toward which the tree is extended.
    fn target(&self, cache: &Cache, obstacles: &Obstacles, rng: &mut ChaCha8Rng) -> Point2<f64> {
        let p = &self.parameters;
        let share: f64 = rng.random();
        if share < p.goal_probability {
            return self.clearance.ends[1].point;
        }
        let is_for_cache = share < p.goal_probability + p.waypoint_probability;
        if let Some(waypoint) = is_for_cache.then(|| cache.draw(rng)).flatten() {
            return waypoint;
        }
        let mut sample = uniform(obstacles.workspace(), rng);
        if p.sample_where_clear {
            for _ in 1..DRAWS {
                if obstacles.grid().distance_m(sample) >= self.clearance.asked_m {
                    break;
                }
                sample = uniform(obstacles.workspace(), rng);
            }
        }
        sample
    }

    /// Adds an edge from the nearest node toward `target` if it is clear, and another one to the goal if that is near.
    /// Returns the goal's node once it is in the tree.
    fn extend(&mut self, target: Point2<f64>, beta: f64, obstacles: &Obstacles) -> Option<usize> {
        let nearest = self.tree.nearest(target, beta);
        let from = self.tree.point(nearest);
        let span = target - from;
        let step_m = self.parameters.step_m;
        let whole = if span.norm() > step_m { from + span.normalize() * step_m } else { target };
        let part = (nearest == 0).then(|| from + (whole - from) * FIRST_STEP);
        let is_clear = |&to: &Point2<f64>| to != from && obstacles.is_clear(from, to, &self.clearance);
        let to = std::iter::once(whole).chain(part).find(is_clear)?;
        let node = self.tree.push(to, nearest);
        let goal = self.clearance.ends[1].point;
        if to == goal {
            return Some(node);
        }
        let is_last = (goal - to).norm() <= step_m && obstacles.is_clear(to, goal, &self.clearance);
        is_last.then(|| self.tree.push(goal, node))
    }
}

fn uniform(workspace: &Rect, rng: &mut ChaCha8Rng) -> Point2<f64> {
    let size = workspace.size_m();
    Point2::new(workspace.x_min_m + size.x * rng.random::<f64>(), workspace.y_min_m + size.y * rng.random::<f64>())
}
