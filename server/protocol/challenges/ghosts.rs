//! Runs on a challenge, to draw them.

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

use crate::boards::Entry;
use ferry_core::challenge::{Ghost, Mishap, SAMPLE_TICKS, Score, Trace};
use ferry_core::geometry::Point2;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;

/// Something that costs time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS, ToSchema)]
pub struct MishapMessage {
    #[ts(type = "number")]
    pub tick: u64,
    pub kind: Mishap,
}

/// Places every .2 s, beginning at tick 1; the last ones are those of the delivery.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct TraceMessage {
    #[schema(value_type = Vec<Numbers2>)]
    pub tool_m: Vec<[f64; 2]>,
    #[schema(value_type = Vec<Numbers2>)]
    pub bead_m: Vec<[f64; 2]>,
    pub mishaps: Vec<MishapMessage>,
}

/// A run on the challenge, by a controller or by the best person.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct GhostMessage {
    pub controller: ControllerName,
    /// Name of the person; `null` for a controller.
    pub player: Option<String>,
    /// `null` if it has not delivered in time.
    pub score: Option<Score>,
    /// Seconds with the penalties; `null` without a delivery.
    pub total_s: Option<f64>,
    pub trace: TraceMessage,
}

/// Answer of `GET /api/challenges/{name}/ghosts`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Ghosts {
    /// Seconds between two places of a trace.
    pub sample_s: f64,
    pub ghosts: Vec<GhostMessage>,
}

impl From<&Trace> for TraceMessage {
    fn from(trace: &Trace) -> Self {
        let pair = |point: Point2<f64>| -> [f64; 2] { point.coords.into() };
        Self {
            tool_m: trace.samples.iter().map(|sample| pair(sample.tool_m)).collect(),
            bead_m: trace.samples.iter().map(|sample| pair(sample.bead_m)).collect(),
            mishaps: trace.mishaps.iter().map(|&(tick, kind)| MishapMessage { tick, kind }).collect(),
        }
    }
}

impl From<&Ghost> for GhostMessage {
    fn from(ghost: &Ghost) -> Self {
        Self {
            controller: ghost.controller,
            player: None,
            score: ghost.score,
            total_s: ghost.score.map(|score| score.total_s()),
            trace: TraceMessage::from(&ghost.trace),
        }
    }
}

impl From<&Entry> for GhostMessage {
    fn from(entry: &Entry) -> Self {
        Self {
            controller: ControllerName::You,
            player: Some(entry.signature.player.clone()),
            score: Some(entry.score),
            total_s: Some(entry.score.total_s()),
            trace: TraceMessage::from(&*entry.trace),
        }
    }
}

impl Ghosts {
    /// `best`: of the board.
    pub fn of(ghosts: &[Ghost], best: Option<&Entry>) -> Self {
        let sample_s = SAMPLE_TICKS as f64 * SERVO_PERIOD_S;
        Self { sample_s, ghosts: ghosts.iter().map(GhostMessage::from).chain(best.map(GhostMessage::from)).collect() }
    }
}
