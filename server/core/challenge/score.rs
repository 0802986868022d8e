//! The score of an attempt.

use serde::{Deserialize, Serialize};

use crate::control::Refusal;
use crate::control::switching::Mode;
use crate::geometry::Point2;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::trial::TickRecord;

/// Added for each time that a wall stopped the tool.
pub const WALL_S: f64 = 1.0;
/// Added for each bead that was lost, beyond those that a disturbance took away.
pub const LOST_BEAD_S: f64 = 5.0;
/// Ticks between two samples: .2 s.
pub const SAMPLE_TICKS: u64 = 25;

/// What counts in an attempt: less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = AttemptScore))]
#[cfg_attr(feature = "schema", ts(rename = "AttemptScore"))]
#[serde(deny_unknown_fields)]
pub struct Score {
    /// Tick of the delivery.
    #[cfg_attr(feature = "schema", ts(type = "number"))]
    pub tick: u64,
    /// How many times a wall stopped the tool.
    pub walls: u32,
    /// How many beads were lost without a disturbance.
    pub lost_beads: u32,
}

impl Score {
    /// Seconds until the delivery, with the penalties.
    pub fn total_s(&self) -> f64 {
        self.tick as f64 * SERVO_PERIOD_S + f64::from(self.walls) * WALL_S + f64::from(self.lost_beads) * LOST_BEAD_S
    }
}

/// Where tool and bead were.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    pub tool_m: Point2<f64>,
    pub bead_m: Point2<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = MishapKind))]
#[cfg_attr(feature = "schema", ts(rename = "MishapKind", rename_all = "snake_case"))]
#[serde(rename_all = "snake_case")]
pub enum Mishap {
    /// A wall stopped the tool.
    Wall,
    /// The bead was lost without a disturbance.
    LostBead,
    /// A disturbance took the bead away.
    Disturbance,
}

/// The course of a run, to draw it as a ghost and to explain its score.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Every [`SAMPLE_TICKS`] from tick 1, and at the delivery.
    pub samples: Vec<Sample>,
    /// With their ticks, in order.
    pub mishaps: Vec<(u64, Mishap)>,
}

/// Counts while an attempt runs.
#[derive(Clone, Debug, Default)]
pub struct Referee {
    walls: u32,
    lost_beads: u32,
    disturbances: u32,
    /// Disturbances after which no bead was lost yet.
    excuses: u32,
    is_at_wall: bool,
    trace: Trace,
}

impl Referee {
    /// The score at the tick of the first delivery; `None` before.
    pub fn watch(&mut self, record: &TickRecord) -> Option<Score> {
        let moment = &record.moment;
        let new = moment.counters.disturbances.saturating_sub(self.disturbances);
        self.disturbances = moment.counters.disturbances;
        self.excuses += new;
        self.trace.mishaps.extend((0..new).map(|_| (record.tick, Mishap::Disturbance)));
        if let Some(decision) = &record.decision {
            let is_at_wall = matches!(decision.refusal, Some(Refusal::Obstacle { .. }));
            if is_at_wall && !self.is_at_wall {
                self.walls += 1;
                self.trace.mishaps.push((record.tick, Mishap::Wall));
            }
            self.is_at_wall = is_at_wall;
            let switching = decision.switching;
            if switching.switched && switching.mode == Mode::Approach {
                if self.excuses > 0 {
                    self.excuses -= 1;
                } else {
                    self.lost_beads += 1;
                    self.trace.mishaps.push((record.tick, Mishap::LostBead));
                }
            }
        }
        let delivered = moment.counters.deliveries > 0;
        if record.tick % SAMPLE_TICKS == 1 || delivered {
            self.trace.samples.push(Sample { tool_m: moment.tool_m.xy(), bead_m: moment.bead_m.xy() });
        }
        delivered.then(|| self.so_far(record.tick))
    }

    /// The score if the delivery were now.
    pub fn so_far(&self, tick: u64) -> Score {
        Score { tick, walls: self.walls, lost_beads: self.lost_beads }
    }

    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    pub fn into_trace(self) -> Trace {
        self.trace
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn penalties_are_added_to_the_time() {
        let score = Score { tick: 1250, walls: 2, lost_beads: 1 };
        assert!((score.total_s() - 17.0).abs() < 1e-9);
    }
}
