//! Random trials: fair pairs of start and goal.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{ControllerName, Parameters, Scenario, Stream};
use crate::geometry::Point2;
use crate::map::{FreeSpace, Map};

/// Minimum distance of starts, goals and displaced beads from walls.
pub const CLEARANCE_M: f64 = 0.012;
/// Minimum length of the shortest path from start to goal.
pub const LEAST_DISTANCE_M: f64 = 0.15;
/// Minimum share of pairs whose straight line is blocked, on maps where that is possible.
const BLOCKED_SHARE: f64 = 0.6;
/// Half width of the straight line for the test whether it is blocked: the bead's radius.
const LINE_HALF_WIDTH_M: f64 = 0.0025;
/// Maximum number of draws per map.
const DRAWS: usize = 2000;

/// The map has no fair pair of start and goal.
#[derive(Debug, thiserror::Error)]
#[error(
    "map: {map:?} has no two free points in the tool's reach that are {LEAST_DISTANCE_M} m apart and keep {CLEARANCE_M} m \
     from the walls"
)]
pub struct RandomTrialError {
    /// Name of the map.
    pub map: String,
}

/// The default start of the bead: the first random free point that the positioner reaches.
pub fn start_point(
    map: &Map,
    space: &FreeSpace,
    seed: u64,
    is_reached: &dyn Fn(Point2<f64>) -> bool,
) -> Result<Point2<f64>, RandomTrialError> {
    let mut rng = Stream::Start.rng(seed);
    let mut drawn = (0..DRAWS).map_while(|_| space.sample(map, None, &mut rng));
    drawn.find(|&point| is_reached(point)).ok_or_else(|| RandomTrialError { map: map.name().to_owned() })
}

/// Where random trials begin and end.
pub struct Ground<'a> {
    pub map: &'a Map,
    /// Name or path of the map, as in scenarios.
    pub name: &'a str,
    pub space: &'a FreeSpace,
    /// Whether the tool reaches a place.
    pub is_reached: &'a dyn Fn(Point2<f64>) -> bool,
}

impl Ground<'_> {
    /// The `index`-th random trial of a seed. It is the same for every controller and independent of earlier draws.
    ///
    /// # Errors
    /// [`RandomTrialError`].
    pub fn random(
        &self,
        controller: ControllerName,
        disturbances: u32,
        seed: u64,
        index: u64,
    ) -> Result<Scenario, RandomTrialError> {
        let map = self.map;
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(index + 1);
        // Every prefix of the trials contains the minimum share of blocked pairs.
        let share_before = (index as f64 * BLOCKED_SHARE).ceil();
        let must_be_blocked = ((index + 1) as f64 * BLOCKED_SHARE).ceil() > share_before && !map.walls().is_empty();
        let refuse = || RandomTrialError { map: map.name().to_owned() };
        let mut fallback = None;
        for _ in 0..DRAWS {
            let Some((start, goal)) = self.draw_pair(&mut rng) else { continue };
            if !must_be_blocked || !map.line_is_clear(start, goal, LINE_HALF_WIDTH_M) {
                fallback = Some((start, goal));
                break;
            }
            fallback = fallback.or(Some((start, goal)));
        }
        let (start, goal) = fallback.ok_or_else(refuse)?;
        Ok(Scenario {
            map: self.name.to_owned(),
            controller,
            positioner: None,
            seed: trial_seed(seed, index),
            parameters: Parameters::default(),
            start_m: Some(start),
            goal_m: Some(goal),
            disturbances,
            script: Vec::new(),
        })
    }

    fn draw_pair(&self, rng: &mut impl Rng) -> Option<(Point2<f64>, Point2<f64>)> {
        let Self { map, space, .. } = self;
        let start = space.sample(map, None, rng)?;
        let goal = space.sample(map, space.component_at(start), rng)?;
        // The straight line is a lower bound and cheap to compute.
        let far = (goal - start).norm() >= LEAST_DISTANCE_M
            || space.geodesic_m(start, goal).is_some_and(|length_m| length_m >= LEAST_DISTANCE_M);
        (far && (self.is_reached)(start) && (self.is_reached)(goal)).then_some((start, goal))
    }
}

/// The seed of a single trial: 53 bits, so that JavaScript numbers represent it exactly.
fn trial_seed(seed: u64, index: u64) -> u64 {
    const BITS: u32 = 53;
    (seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (u64::BITS - BITS)).wrapping_add(index) & ((1 << BITS) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn redraws_a_start_out_of_reach() {
        let map = Map::shipped("posts").unwrap();
        let space = FreeSpace::new(&map, CLEARANCE_M);
        let any = start_point(&map, &space, 7, &|_| true).unwrap();
        let other = start_point(&map, &space, 7, &|point| point != any).unwrap();
        assert!(other != any && map.clearance_m(other) >= CLEARANCE_M);
        assert_eq!(start_point(&map, &space, 7, &|point| point == other).unwrap(), other);
        assert!(start_point(&map, &space, 7, &|_| false).is_err());
    }

    #[test]
    fn trials_are_fair_and_independent_of_each_other() {
        let map = Map::shipped("posts").unwrap();
        let space = FreeSpace::new(&map, CLEARANCE_M);
        let ground = Ground { map: &map, name: "posts", space: &space, is_reached: &|_| true };
        let make = |index| ground.random(ControllerName::Attractor, 0, 1, index).unwrap();
        let trials: Vec<Scenario> = (0..50).map(make).collect();
        let mut blocked = 0;
        for trial in &trials {
            let (start, goal) = (trial.start_m.unwrap(), trial.goal_m.unwrap());
            assert!(map.clearance_m(start) >= CLEARANCE_M && map.clearance_m(goal) >= CLEARANCE_M);
            assert!(space.geodesic_m(start, goal).unwrap() >= LEAST_DISTANCE_M * 0.99);
            blocked += usize::from(!map.line_is_clear(start, goal, LINE_HALF_WIDTH_M));
        }
        assert!(blocked >= 30, "{blocked} of 50 blocked");
        assert_eq!(trials[33], make(33));
        let left = Ground { is_reached: &|place| place.x < 0.0, ..ground };
        for trial in (0..20).map(|index| left.random(ControllerName::Attractor, 0, 1, index).unwrap()) {
            assert!(trial.start_m.unwrap().x < 0.0 && trial.goal_m.unwrap().x < 0.0);
        }
        let none = Ground { is_reached: &|_| false, ..left };
        assert!(none.random(ControllerName::Attractor, 0, 1, 0).unwrap_err().to_string().contains("reach"));
    }
}
