//! An attempt as an episode: what the camera showed and what the hand did, at each control step.

use crate::boards::Kept;
use ferry_core::challenge::{AttemptError, Challenge};
use ferry_core::control::Refusal;
use ferry_core::geometry::{Point2, Vector2};
use ferry_core::image::ImageSource;
use ferry_core::trial::{Decision, Motion, Sight, TickRecord, Trial, TrialError};

/// What is there before a step is decided.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Ticks since the start.
    pub tick: u64,
    /// The network's observation, `[2][84][84]`.
    pub observation: Vec<u8>,
    pub tool_m: Point2<f64>,
    pub goal_m: Point2<f64>,
    /// True position of the bead, which no controller gets.
    pub bead_m: Point2<f64>,
}

/// A control step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub view: View,
    /// From the tool to the place to which the hand points; zero before the first input.
    pub hand_m: Vector2<f64>,
    /// 1 or 2.
    pub sub_controller: u8,
    /// Whether the hand decides about this step: sub-controller 1 flies by itself unless the hand steers it, too.
    pub steers: bool,
}

#[derive(Clone, Debug)]
pub struct Episode {
    pub challenge: Challenge,
    pub kept: Kept,
    pub steps: Vec<Step>,
    /// At the delivery.
    pub last: View,
}

impl Episode {
    /// Runs an attempt again, which must agree with its score.
    ///
    /// # Errors
    /// [`AttemptError`].
    pub fn of(challenge: &Challenge, kept: &Kept, camera: &mut dyn ImageSource) -> Result<Self, AttemptError> {
        let goal_m = challenge.scenario.goal_m.expect("a challenge has a goal");
        let view = |sight: &Sight, tick: u64, bead_m: Point2<f64>| View {
            tick,
            observation: sight.observation().bytes,
            tool_m: sight.tool_m,
            goal_m,
            bead_m,
        };
        let mut bead_m = Trial::new(challenge.scenario.clone(), challenge.arena.clone())?.moment().bead_m.xy();
        let mut steps = Vec::new();
        let (_, trial) = challenge.judge_watched(&kept.attempt, camera, &mut |record: &TickRecord| {
            if let (Some(sight), Some(decision)) = (&record.sight, &record.decision) {
                // Steering changes by inputs only, and these come before the tick.
                let hand_m = record.moment.steering.map(|steering| steering.target_m - sight.tool_m);
                steps.push(Step {
                    view: view(sight, record.tick - 1, bead_m),
                    hand_m: hand_m.unwrap_or_default(),
                    sub_controller: decision.switching.mode.index(),
                    steers: hand_m.is_some() && is_by_hand(decision),
                });
            }
            bead_m = record.moment.bead_m.xy();
        })?;
        let sight = trial.observe(camera).map_err(TrialError::from)?;
        let last = view(&sight, trial.state().world.tick, bead_m);
        Ok(Self { challenge: challenge.clone(), kept: kept.clone(), steps, last })
    }
}

/// Whether a decision follows the hand, or refuses to. If not, the arm flies to the bead, looks for it, or has stopped.
fn is_by_hand(decision: &Decision) -> bool {
    match (decision.motion, &decision.refusal) {
        (_, Some(Refusal::TrackerLost { .. })) | (Motion::Track | Motion::Joints(_), _) | (Motion::Hold, None) => false,
        (Motion::Segment(_), _) | (Motion::Hold, Some(_)) => true,
    }
}
