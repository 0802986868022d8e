//! Challenges: a trial that a person steers, drawn from a name, and the judgement of attempts at it.

mod attempt;
mod ghosts;
mod loss;
mod score;

use std::str::FromStr;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::map::MapError;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{ControllerName, Parameters, RandomTrialError, Scenario};
use crate::trial::Arena;

pub use attempt::{Attempt, AttemptError, INPUTS_MOST, Run};
pub use ghosts::Ghost;
pub use loss::Loss;
pub use score::{LOST_BEAD_S, Mishap, Referee, SAMPLE_TICKS, Sample, Score, Trace, WALL_S};

/// An attempt that has not delivered by then has no score.
pub const TIME_LIMIT_S: f64 = 60.0;
pub const TICKS_MOST: u64 = (TIME_LIMIT_S / SERVO_PERIOD_S) as u64;
/// Control steps of a leg: an attempt ends by its time, not by its steps.
const STEP_LIMIT: u32 = 1000;
/// Draws of start and goal until their distance fits.
const DRAWS: u64 = 500;
/// Characters of the part of a name from which everything random follows.
const SEED_MOST: usize = 24;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = DifficultyName))]
#[cfg_attr(feature = "schema", ts(rename = "DifficultyName", rename_all = "snake_case"))]
#[serde(rename_all = "snake_case")]
pub enum Difficulty {
    /// Posts, nothing disturbs.
    Easy,
    /// The colon.
    Medium,
    /// The colon with folds; the bead is moved away twice.
    Hard,
}

impl Difficulty {
    pub const ALL: [Self; 3] = [Self::Easy, Self::Medium, Self::Hard];

    pub fn as_str(self) -> &'static str {
        match self {
            Self::Easy => "easy",
            Self::Medium => "medium",
            Self::Hard => "hard",
        }
    }

    fn map(self) -> &'static str {
        match self {
            Self::Easy => "posts",
            Self::Medium => "colon",
            Self::Hard => "colon-folds",
        }
    }

    fn disturbances(self) -> u32 {
        match self {
            Self::Easy | Self::Medium => 0,
            Self::Hard => 2,
        }
    }

    /// Shortest path of the bead from start to goal. At .04 m/s the longest takes 20 s without a mistake.
    fn path_m(self) -> std::ops::RangeInclusive<f64> {
        match self {
            Self::Easy => 0.25..=0.45,
            Self::Medium => 0.4..=0.8,
            Self::Hard => 0.3..=0.6,
        }
    }
}

/// Name of a challenge, `DIFFICULTY-SEED`, such as `easy-2026-11-26`, `hard-2026-w48` or `medium-anything`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ChallengeName {
    pub difficulty: Difficulty,
    /// 1 to 24 of a to z, 0 to 9 and -.
    pub seed: String,
}

/// A text that is not the name of a challenge.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is not a challenge: it must be easy, medium or hard, then -, then 1 to {SEED_MOST} of a to z, 0 to 9 and -"
)]
pub struct NotAChallenge {
    text: String,
}

impl FromStr for ChallengeName {
    type Err = NotAChallenge;

    fn from_str(text: &str) -> Result<Self, NotAChallenge> {
        let refused = || NotAChallenge { text: text.chars().take(64).collect() };
        let (difficulty, seed) = text.split_once('-').ok_or_else(refused)?;
        let known = Difficulty::ALL.into_iter().find(|known| known.as_str() == difficulty);
        let is_allowed = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        let is_seed = (1..=SEED_MOST).contains(&seed.len()) && seed.bytes().all(is_allowed);
        let difficulty = known.filter(|_| is_seed).ok_or_else(refused)?;
        Ok(Self { difficulty, seed: seed.to_owned() })
    }
}

impl TryFrom<String> for ChallengeName {
    type Error = NotAChallenge;

    fn try_from(text: String) -> Result<Self, NotAChallenge> {
        text.parse()
    }
}

impl From<ChallengeName> for String {
    fn from(name: ChallengeName) -> Self {
        name.to_string()
    }
}

impl std::fmt::Display for ChallengeName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}-{}", self.difficulty.as_str(), self.seed)
    }
}

/// The trial of a challenge.
#[derive(Clone, Debug)]
pub struct Challenge {
    pub name: ChallengeName,
    pub scenario: Scenario,
    pub arena: Arc<Arena>,
    /// Shortest path of the bead from start to goal.
    pub path_m: f64,
}

/// Why a challenge could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum ChallengeError {
    #[error(transparent)]
    Map(#[from] MapError),
    #[error(transparent)]
    Random(#[from] RandomTrialError),
    #[error("challenge {name}: no start and goal with a path of {} to {} m in {DRAWS} draws", .allowed.start(), .allowed.end())]
    NoPair { name: String, allowed: std::ops::RangeInclusive<f64> },
}

impl Challenge {
    /// Draws the challenge of a name: the same one each time.
    ///
    /// # Errors
    /// [`ChallengeError`].
    pub fn of(name: ChallengeName) -> Result<Self, ChallengeError> {
        let (difficulty, seed) = (name.difficulty, xxh3_64(name.to_string().as_bytes()));
        let arena = Arena::shipped(difficulty.map())?;
        for index in 0..DRAWS {
            let drawn = arena.random(difficulty.map(), ControllerName::You, difficulty.disturbances(), seed, index)?;
            let path_m = drawn.start_m.zip(drawn.goal_m).and_then(|(start, goal)| arena.space.shortest_m(start, goal));
            if let Some(path_m) = path_m.filter(|path_m| difficulty.path_m().contains(path_m)) {
                let parameters = Parameters { step_limit: STEP_LIMIT, ..drawn.parameters };
                return Ok(Self { name, scenario: Scenario { parameters, ..drawn }, arena, path_m });
            }
        }
        Err(ChallengeError::NoPair { name: name.to_string(), allowed: difficulty.path_m() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_trial_and_another_name_another() {
        let challenge = |name: &str| Challenge::of(name.parse().unwrap()).unwrap();
        for difficulty in Difficulty::ALL {
            let name = format!("{}-2026-11-26", difficulty.as_str());
            let (first, again, other) = (challenge(&name), challenge(&name), challenge(&format!("{name}b")));
            assert_eq!(first.scenario, again.scenario);
            assert_ne!(first.scenario, other.scenario);
            assert_eq!(first.name.to_string(), name);
            assert!(difficulty.path_m().contains(&first.path_m), "{}", first.path_m);
            assert_eq!(first.scenario.disturbances, difficulty.disturbances());
        }
    }

    #[test]
    fn a_wrong_name_is_refused() {
        for text in ["", "easy", "easy-", "Easy-1", "expert-1", "easy-A", "easy-1/2", "easy-1234567890123456789012345"]
        {
            assert!(text.parse::<ChallengeName>().is_err(), "{text}");
        }
    }
}
