//! Training's episodes side by side, for programs with a learner of their own. Each lane has its own random numbers.

use std::sync::Arc;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::environment::{Ending, Episode, Goal};
use super::goals::GoalSet;
use super::recipe::{Recipe, RecipeError};
use super::terrain::{GOAL_JITTER_M, Terrain, UNREACHABLE};
use ferry_core::geometry::Point2;

/// Far below the size of a cell.
const ROUNDING_M: f64 = 1e-9;
/// Draws of a start or a goal for a given one.
const DRAWS: u32 = 10_000;

/// An episode, and what later ones are drawn from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lane {
    episode: Episode,
    rng: ChaCha8Rng,
}

/// Lanes on one map. Copies share the terrain.
#[derive(Clone, Debug)]
pub struct Lanes {
    terrain: Arc<[Terrain; 1]>,
    recipe: Recipe,
    lanes: Vec<Lane>,
}

#[derive(Debug, thiserror::Error)]
pub enum LanesError {
    #[error("lanes is {0}, it must be 1 to {most}", most = Lanes::MOST)]
    Count(usize),
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    #[error("action[{lane}] is {action}, it must be 0 to 3")]
    Action { lane: usize, action: i64 },
    #[error(
        "{field} ({:.3}, {:.3}) m is in no cell where the tool may be; the nearest one is at ({:.3}, {:.3}) m",
        place_m.x, place_m.y, nearest_m.x, nearest_m.y
    )]
    Place { field: &'static str, place_m: Point2<f64>, nearest_m: Point2<f64> },
    #[error("start_m and goal_m: no path leads from one to the other, or it is within 2 cm")]
    NoPath,
    #[error("the state of lane {lane} belongs to another map")]
    State { lane: usize },
}

impl Lanes {
    /// Largest number of lanes.
    pub const MOST: usize = 4096;

    /// Lanes with the seeds `seed`, `seed + 1` and so on. Of the recipe, the rewards, the clearance and the goals matter.
    ///
    /// # Errors
    /// [`LanesError::Count`], [`LanesError::Recipe`].
    pub fn new(terrain: Terrain, recipe: Recipe, lanes: usize, seed: u64) -> Result<Self, LanesError> {
        recipe.check()?;
        if recipe.wall_amplitude_m > 0.0 {
            let (value, allowed) = (recipe.wall_amplitude_m.to_string(), "0: the walls are at rest here".to_owned());
            return Err(RecipeError { field: "wall_amplitude_m", value, allowed }.into());
        }
        if !(1..=Self::MOST).contains(&lanes) {
            return Err(LanesError::Count(lanes));
        }
        let terrain = Arc::new([terrain]);
        let begin = |lane: usize| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_add(lane as u64));
            Lane { episode: Episode::start(terrain.as_slice(), GoalSet::All, &mut rng), rng }
        };
        let lanes = (0..lanes).map(begin).collect();
        Ok(Self { terrain, recipe, lanes })
    }

    pub fn len(&self) -> usize {
        self.lanes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.lanes.is_empty()
    }

    /// Number of cells of the map.
    pub fn cells(&self) -> usize {
        self.terrain[0].cells()
    }

    /// Begins an episode, first seeding the lane's random numbers if a seed is given. `start_m` and `goal_m` are random
    /// where they are not given; the start is the middle of its cell.
    ///
    /// # Errors
    /// [`LanesError::Place`], [`LanesError::NoPath`]; nothing has changed then.
    pub fn start(
        &mut self,
        lane: usize,
        seed: Option<u64>,
        start_m: Option<Point2<f64>>,
        goal_m: Option<Point2<f64>>,
    ) -> Result<(), LanesError> {
        let terrain = &self.terrain[0];
        let start = start_m.map(|place_m| self.cell("start_m", place_m)).transpose()?;
        let goal = goal_m.map(|place_m| self.goal(place_m)).transpose()?;
        let mut rng = seed.map_or_else(|| self.lanes[lane].rng.clone(), ChaCha8Rng::seed_from_u64);
        let draws = if start.is_some() && goal.is_some() { 1 } else { DRAWS };
        for _ in 0..draws {
            let drawn = Episode::start(self.terrain.as_slice(), GoalSet::All, &mut rng);
            let episode = Episode { cell: start.unwrap_or(drawn.cell), goal: goal.unwrap_or(drawn.goal), ..drawn };
            let leads = terrain.distance(episode.cell, episode.goal.cell) != UNREACHABLE;
            if leads && !episode.goal.is_reached_from(terrain, episode.cell) {
                self.lanes[lane] = Lane { episode, rng };
                return Ok(());
            }
        }
        Err(LanesError::NoPath)
    }

    /// The cell around a place.
    fn cell(&self, field: &'static str, place_m: Point2<f64>) -> Result<u16, LanesError> {
        let terrain = &self.terrain[0];
        let away_m = |&cell: &u16| (terrain.center_m(cell) - place_m).amax();
        let nearest = (0..terrain.cells() as u16).min_by(|a, b| away_m(a).total_cmp(&away_m(b))).unwrap_or_default();
        if away_m(&nearest) <= GOAL_JITTER_M + ROUNDING_M {
            return Ok(nearest);
        }
        Err(LanesError::Place { field, place_m, nearest_m: terrain.center_m(nearest) })
    }

    fn goal(&self, place_m: Point2<f64>) -> Result<Goal, LanesError> {
        let cell = self.cell("goal_m", place_m)?;
        let off_m = place_m - self.terrain[0].center_m(cell);
        let offset = [off_m.x, off_m.y].map(|off_m| (off_m / GOAL_JITTER_M * 127.0).round().clamp(-127.0, 127.0) as i8);
        Ok(Goal { cell, offset })
    }

    /// All that changes in the lanes; see [`Self::restore`].
    pub fn states(&self) -> &[Lane] {
        &self.lanes
    }

    /// Goes on from states of the same map.
    ///
    /// # Errors
    /// [`LanesError::Count`], [`LanesError::State`]; nothing has changed then.
    pub fn restore(&mut self, states: Vec<Lane>) -> Result<(), LanesError> {
        if states.len() != self.lanes.len() {
            return Err(LanesError::Count(states.len()));
        }
        let has = |cell: u16| usize::from(cell) < self.cells();
        let fits = |Episode { terrain, cell, goal, .. }: Episode| terrain == 0 && has(cell) && has(goal.cell);
        if let Some(lane) = states.iter().position(|state| !fits(state.episode)) {
            return Err(LanesError::State { lane });
        }
        self.lanes = states;
        Ok(())
    }

    /// Takes a step: the reward, and the ending if the episode ends.
    ///
    /// # Errors
    /// [`LanesError::Action`]; nothing has changed then.
    pub fn step(&mut self, lane: usize, action: i64) -> Result<(f32, Option<Ending>), LanesError> {
        let index = usize::try_from(action).ok().filter(|&index| index < 4);
        let index = index.ok_or(LanesError::Action { lane, action })?;
        let Lane { episode, .. } = &mut self.lanes[lane];
        let terrain = &self.terrain[0];
        let reward = self.recipe.outcome(terrain, episode.cell, terrain.step(episode.cell, index), episode.goal).reward;
        Ok((reward, episode.step(self.terrain.as_slice(), index, &self.recipe).1))
    }

    /// The image above a lane's tool, `[84 · 84]`.
    pub fn image(&self, lane: usize) -> &[u8] {
        self.terrain[0].image(self.lanes[lane].episode.cell)
    }

    /// Goal x and y, tool x and y, each 0 to 1 over the workspace.
    pub fn places(&self, lane: usize) -> [f32; 4] {
        self.lanes[lane].episode.places(self.terrain.as_slice())
    }

    /// Tool and goal on the table.
    pub fn places_m(&self, lane: usize) -> [Point2<f64>; 2] {
        let episode = &self.lanes[lane].episode;
        [self.terrain[0].center_m(episode.cell), episode.goal.place_m(&self.terrain[0])]
    }

    /// Steps of the shortest path to the goal, `u16::MAX` without one. No policy is given this.
    pub fn distance(&self, lane: usize) -> u16 {
        let episode = &self.lanes[lane].episode;
        self.terrain[0].distance(episode.cell, episode.goal.cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::terrain::tests::two_rooms;

    fn lanes(count: usize, seed: u64) -> Result<Lanes, LanesError> {
        Lanes::new(two_rooms(), Recipe::default(), count, seed)
    }

    /// Everything that shows in a lane.
    fn shown(lanes: &Lanes, lane: usize) -> ([f32; 4], u16) {
        (lanes.places(lane), lanes.distance(lane))
    }

    #[test]
    fn a_lane_depends_only_on_its_seed() {
        let (mut many, mut one) = (lanes(5, 3).unwrap(), lanes(1, 5).unwrap());
        for step in 0..2000 {
            assert_eq!(shown(&many, 2), shown(&one, 0));
            let action = step * 7 % 4;
            let (reward, ending) = many.step(2, action).unwrap();
            assert_eq!(one.step(0, action).unwrap(), (reward, ending));
            many.step(1, 3 - action).unwrap();
            if ending.is_some() {
                many.start(2, None, None, None).unwrap();
                one.start(0, None, None, None).unwrap();
            }
        }
        many.start(4, Some(5), None, None).unwrap();
        one.start(0, Some(5), None, None).unwrap();
        assert_eq!(shown(&many, 4), shown(&one, 0));
    }

    #[test]
    fn refusals_name_the_field_and_change_nothing() {
        assert_eq!(lanes(0, 1).unwrap_err().to_string(), "lanes is 0, it must be 1 to 4096");
        let moving = Recipe { wall_amplitude_m: 0.01, ..Recipe::default() };
        let refusal = Lanes::new(two_rooms(), moving, 1, 1).unwrap_err().to_string();
        assert_eq!(refusal, "wall_amplitude_m is 0.01, it must be 0: the walls are at rest here");
        let mut lanes = lanes(2, 1).unwrap();
        let before = shown(&lanes, 1);
        for action in [-1, 4, i64::MIN] {
            let error = lanes.step(1, action).unwrap_err().to_string();
            assert_eq!(error, format!("action[1] is {action}, it must be 0 to 3"));
        }
        assert_eq!(shown(&lanes, 1), before);
    }
    #[test]
    fn episodes_begin_at_given_places() {
        let mut lanes = lanes(1, 1).unwrap();
        let [start, goal] = [0, 25].map(|cell| lanes.terrain[0].center_m(cell));
        let off = goal + ferry_core::geometry::Vector2::new(0.002, -0.0049);
        for seed in 0..50 {
            lanes.start(0, Some(seed), Some(start), Some(off)).unwrap();
            let [tool_m, goal_m] = lanes.places_m(0);
            assert!(tool_m == start && (goal_m - off).norm() < 5e-5, "{goal_m}");
            lanes.start(0, Some(seed), Some(start), None).unwrap();
            let [tool_m, goal_m] = lanes.places_m(0);
            assert!(tool_m == start && (goal_m - start).norm() > 0.02 && lanes.distance(0) != UNREACHABLE);
            lanes.start(0, None, None, Some(goal)).unwrap();
            assert!(lanes.places_m(0)[1] == goal && lanes.distance(0) != UNREACHABLE);
        }
        let before = lanes.states().to_vec();
        let refusal = lanes.start(0, Some(1), Some(Point2::new(9.0, 9.0)), None).unwrap_err().to_string();
        assert!(refusal.starts_with("start_m (9.000, 9.000) m is in no cell where the tool may be"), "{refusal}");
        assert!(matches!(lanes.start(0, Some(1), Some(start), Some(start)), Err(LanesError::NoPath)));
        assert_eq!(lanes.states(), before);
    }

    #[test]
    fn restored_lanes_go_on_alike() {
        let mut first = lanes(3, 1).unwrap();
        let mut other = lanes(3, 9).unwrap();
        (0..7).for_each(|step| drop(first.step(1, step % 4)));
        let mut copy = first.clone();
        other.restore(first.states().to_vec()).unwrap();
        for step in 0..300 {
            let results = [&mut first, &mut copy, &mut other].map(|lanes| {
                let (reward, ending) = lanes.step(1, step * 7 % 4).unwrap();
                if ending.is_some() {
                    lanes.start(1, None, None, None).unwrap();
                }
                (reward, ending, shown(lanes, 1))
            });
            assert!(results[0] == results[1] && results[0] == results[2], "{results:?}");
        }
        let mut states = first.states().to_vec();
        states[2].episode.goal.cell = 26;
        assert!(matches!(other.restore(states), Err(LanesError::State { lane: 2 })));
        assert!(matches!(other.restore(Vec::new()), Err(LanesError::Count(0))));
    }
}
