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
/// Ticks between two samples of the ghost: .2 s.
const SAMPLE_TICKS: u64 = 25;

/// What counts: less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Score {
    /// Tick of the delivery.
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

/// Where tool and bead were, to draw a ghost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    pub tool_m: Point2<f64>,
    pub bead_m: Point2<f64>,
}

/// Counts while an attempt runs.
#[derive(Clone, Debug, Default)]
pub(super) struct Referee {
    walls: u32,
    approaches: u32,
    is_at_wall: bool,
    pub samples: Vec<Sample>,
}

impl Referee {
    /// The score at the tick of the first delivery; `None` before.
    pub(super) fn watch(&mut self, record: &TickRecord) -> Option<Score> {
        let moment = &record.moment;
        if let Some(decision) = &record.decision {
            let is_at_wall = matches!(decision.refusal, Some(Refusal::Obstacle { .. }));
            self.walls += u32::from(is_at_wall && !self.is_at_wall);
            self.is_at_wall = is_at_wall;
            let switching = decision.switching;
            self.approaches += u32::from(switching.switched && switching.mode == Mode::Approach);
        }
        let delivered = moment.counters.deliveries > 0;
        if record.tick % SAMPLE_TICKS == 1 || delivered {
            self.samples.push(Sample { tool_m: moment.tool_m.xy(), bead_m: moment.bead_m.xy() });
        }
        let lost_beads = self.approaches.saturating_sub(moment.counters.disturbances);
        delivered.then_some(Score { tick: record.tick, walls: self.walls, lost_beads })
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
