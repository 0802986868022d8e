//! Training's episodes side by side, for programs with a learner of their own. Each lane has its own random numbers.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::environment::{Ending, Episode};
use super::goals::GoalSet;
use super::recipe::{Recipe, RecipeError};
use super::terrain::Terrain;
use crate::geometry::Point2;

/// Largest number of lanes.
const LANES_MOST: usize = 4096;

#[derive(Clone, Debug)]
struct Lane {
    episode: Episode,
    rng: ChaCha8Rng,
}

/// Lanes on one map.
#[derive(Debug)]
pub struct Lanes {
    terrain: [Terrain; 1],
    recipe: Recipe,
    lanes: Vec<Lane>,
}

#[derive(Debug, thiserror::Error)]
pub enum LanesError {
    #[error("lanes is {0}, it must be 1 to {LANES_MOST}")]
    Count(usize),
    #[error(transparent)]
    Recipe(#[from] RecipeError),
    #[error("action[{lane}] is {action}, it must be 0 to 3")]
    Action { lane: usize, action: i64 },
}

impl Lanes {
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
        if !(1..=LANES_MOST).contains(&lanes) {
            return Err(LanesError::Count(lanes));
        }
        let terrain = [terrain];
        let begin = |lane: usize| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_add(lane as u64));
            Lane { episode: Episode::start(&terrain, GoalSet::All, &mut rng), rng }
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

    /// Begins an episode with a random start and goal, first seeding the lane's random numbers if a seed is given.
    pub fn start(&mut self, lane: usize, seed: Option<u64>) {
        let Lane { episode, rng } = &mut self.lanes[lane];
        if let Some(seed) = seed {
            *rng = ChaCha8Rng::seed_from_u64(seed);
        }
        *episode = Episode::start(&self.terrain, GoalSet::All, rng);
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
        Ok((reward, episode.step(&self.terrain, index, &self.recipe).1))
    }

    /// The image above a lane's tool, `[84 · 84]`.
    pub fn image(&self, lane: usize) -> &[u8] {
        self.terrain[0].image(self.lanes[lane].episode.cell)
    }

    /// Goal x and y, tool x and y, each 0 to 1 over the workspace.
    pub fn places(&self, lane: usize) -> [f32; 4] {
        self.lanes[lane].episode.places(&self.terrain)
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
                many.start(2, None);
                one.start(0, None);
            }
        }
        many.start(4, Some(5));
        one.start(0, Some(5));
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
}
