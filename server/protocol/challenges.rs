//! Challenges.

mod ghosts;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::boards::{Entry, Signature};
use ferry_core::challenge::{
    Attempt, Challenge, ChallengeName, Difficulty, Ghost, LOST_BEAD_S, Loss, Score, TIME_LIMIT_S, WALL_S,
};
use ferry_core::facts::Told;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;
use ferry_core::session::{Ended, Played, Standing, VoidFact};

pub use ghosts::{GhostMessage, Ghosts, MishapMessage, TraceMessage};

/// How long a challenge is offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Period {
    Day,
    Week,
}

/// A line of a board.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct BoardEntry {
    pub player: String,
    pub class: Option<String>,
    /// UTC, RFC 3339.
    pub at: String,
    pub score: Score,
    /// Seconds until the delivery, with the penalties.
    pub total_s: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ChallengeSummary {
    pub name: String,
    pub difficulty: Difficulty,
    /// `null` for one that is not offered today.
    pub period: Option<Period>,
    /// People on its board.
    pub entries: usize,
    pub best: Option<BoardEntry>,
}

/// Answer of `GET /api/challenges`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Challenges {
    /// Those of the day, those of the week, then the others that have a board.
    pub challenges: Vec<ChallengeSummary>,
}

/// Answer of `GET /api/challenges/{name}`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct ChallengeReport {
    pub name: String,
    pub difficulty: Difficulty,
    pub map: String,
    /// Start of the bead.
    #[schema(value_type = Numbers2)]
    pub start_m: [f64; 2],
    #[schema(value_type = Numbers2)]
    pub goal_m: [f64; 2],
    /// Shortest path of the bead.
    pub path_m: f64,
    /// How often the bead is moved away.
    pub disturbances: u32,
    /// An attempt that has not delivered by then has no score.
    pub time_limit_s: f64,
    /// Penalty for each time that a wall stops the tool.
    pub wall_s: f64,
    /// Penalty for each bead that is lost without a disturbance.
    pub lost_bead_s: f64,
    /// Best first.
    pub board: Vec<BoardEntry>,
}

/// Answer of `GET /api/sessions/{id}/attempt`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct AttemptReport {
    pub challenge: String,
    /// Shortest path that the bead still has.
    pub remaining_m: f64,
    pub loss: Option<Loss>,
    /// Whom the loss is compared with; `null` for the tool's speed: no controller delivered, or the bead is moved away.
    pub compared_with: Option<ControllerName>,
    /// What `POST /api/challenges/{name}/attempts` takes; `null` without a delivery.
    pub attempt: Option<Attempt>,
}

/// Body of `POST /api/challenges/{name}/attempts`.
#[derive(Clone, Debug, PartialEq, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct AttemptQuery {
    /// The session in which it was played, and still is.
    #[schema(example = "main")]
    pub session: String,
    /// `seat` of the `hello` of the browser that began it.
    pub seat: String,
    /// No control characters, and none that hide or turn letters.
    #[schema(min_length = 1, max_length = 24)]
    pub player: String,
    /// Name of a class.
    #[serde(default)]
    #[ts(optional)]
    #[schema(min_length = 1, max_length = 24)]
    pub class: Option<String>,
    pub attempt: Attempt,
}

/// Answer of `POST /api/challenges/{name}/attempts`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct AttemptAnswer {
    pub total_s: f64,
    /// Whether it is the person's best and therefore on the board.
    pub is_kept: bool,
    /// Place on the board, from 1, of the person's best; `null` if it is not on it.
    pub place: Option<usize>,
    /// People on the board.
    pub entries: usize,
}

/// The attempt that is being played, as `state.attempt`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct AttemptStanding {
    pub walls: u32,
    pub lost_beads: u32,
    /// Seconds with the penalties so far.
    pub total_s: f64,
    pub is_delivered: bool,
    /// Not delivered within the time limit.
    pub is_time_up: bool,
    /// Why it does not count.
    pub void: Option<Told<VoidFact>>,
}

impl From<&Entry> for BoardEntry {
    fn from(entry: &Entry) -> Self {
        let Signature { player, class, at } = entry.signature.clone();
        Self { player, class, at, score: entry.score, total_s: entry.score.total_s() }
    }
}

impl From<&Standing> for AttemptStanding {
    fn from(standing: &Standing) -> Self {
        Self {
            walls: standing.score.walls,
            lost_beads: standing.score.lost_beads,
            total_s: standing.score.total_s(),
            is_delivered: standing.is_delivered,
            is_time_up: standing.is_time_up,
            void: standing.void.as_ref().map(Told::of),
        }
    }
}

impl ChallengeSummary {
    /// `board`: best first.
    pub fn of(name: &ChallengeName, period: Option<Period>, board: &[Entry]) -> Self {
        Self {
            name: name.to_string(),
            difficulty: name.difficulty,
            period,
            entries: board.len(),
            best: board.first().map(BoardEntry::from),
        }
    }
}

impl ChallengeReport {
    /// `board`: best first.
    pub fn of(challenge: &Challenge, board: &[Entry]) -> Self {
        let scenario = &challenge.scenario;
        Self {
            name: challenge.name.to_string(),
            difficulty: challenge.name.difficulty,
            map: scenario.map.clone(),
            start_m: scenario.start_m.map_or([0.0; 2], |place| place.coords.into()),
            goal_m: scenario.goal_m.map_or([0.0; 2], |place| place.coords.into()),
            path_m: challenge.path_m,
            disturbances: scenario.disturbances,
            time_limit_s: TIME_LIMIT_S,
            wall_s: WALL_S,
            lost_bead_s: LOST_BEAD_S,
            board: board.iter().map(BoardEntry::from).collect(),
        }
    }
}

impl AttemptReport {
    /// Compares the attempt with the fastest of the ghosts; where the bead is moved away, with the tool's speed. Blocks for
    /// some milliseconds.
    pub fn of(played: &Played, ghosts: &[Ghost]) -> Self {
        let Played { challenge, trace, ended, .. } = played;
        let delivered = ghosts.iter().filter_map(|ghost| Some((ghost.score?.total_s(), ghost)));
        let is_undisturbed = challenge.scenario.disturbances == 0;
        let fastest =
            delivered.filter(|_| is_undisturbed).min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, ghost)| ghost);
        let bead = trace.samples.last().map(|sample| sample.bead_m).or(challenge.scenario.start_m);
        Self {
            challenge: challenge.name.to_string(),
            remaining_m: bead.map_or(challenge.path_m, |bead| challenge.remaining_m(bead)),
            loss: challenge.loss(trace, fastest.map(|ghost| &ghost.trace)),
            compared_with: fastest.map(|ghost| ghost.controller),
            attempt: match ended {
                Some(Ended::Delivered(attempt)) => Some(Attempt::clone(attempt)),
                Some(Ended::TimeUp) | None => None,
            },
        }
    }
}
