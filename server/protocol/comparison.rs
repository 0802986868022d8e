//! Moments and comparisons: why the arm acted as it did, and what other controllers would have done.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::OverlayMessage;
use ferry_core::control::facts::{RefusalFact, TroubleFact};
use ferry_core::control::switching::Reason;
use ferry_core::facts::Told;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::{Numbers2, Numbers4};
use ferry_core::session::{BranchPoint, Progress};
use ferry_core::trial::PhaseFact;
use ferry_core::trial::{Moment, Motion, TickRecord};
use ferry_lab::program::Program;

/// Ticks between two samples of a branch: 25 Hz of simulated time.
pub const TICKS_A_SAMPLE: u64 = 5;

/// Answer of `GET /api/sessions/{id}/moments/{tick}`: the repeated control step at or before a tick.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct MomentMessage {
    /// Tick of the control step.
    #[ts(type = "number")]
    pub tick: u64,
    /// The tick in seconds.
    pub sim_time_s: f64,
    /// Active sub-controller after the step, 1 or 2.
    pub mode: u8,
    /// Whether the step switched the sub-controller.
    pub switched: bool,
    /// Why it is active.
    pub reason: Told<Reason>,
    /// e: distance from tool to tracked bead in the plane.
    pub error_m: f64,
    /// The limit for e: T, or the fetch radius during a fetch.
    pub threshold_m: f64,
    /// Sub-controller 2 in use.
    pub controller: ControllerName,
    /// What the trial does, as in the state.
    pub phase: Told<PhaseFact>,
    /// Tool point.
    #[schema(value_type = Numbers2)]
    pub tool_m: [f64; 2],
    /// True position of the bead.
    #[schema(value_type = Numbers2)]
    pub bead_m: [f64; 2],
    /// Position of the bead from the tracker.
    #[schema(value_type = Numbers2)]
    pub bead_tracked_m: [f64; 2],
    /// Goal, if set.
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<[f64; 2]>,
    /// Next tool target, if any.
    #[schema(value_type = Option<Numbers2>)]
    pub target_m: Option<[f64; 2]>,
    /// Why the arm holds, if a step was refused.
    pub refusal: Option<Told<RefusalFact>>,
    /// What keeps the controller from the goal, if anything.
    pub trouble: Option<Told<TroubleFact>>,
    /// The controller's observation and layers.
    pub overlay: Box<OverlayMessage>,
}

impl MomentMessage {
    /// From a moment and the control step that started there; `None` if none did.
    pub fn of(point: &BranchPoint, before: &Moment, record: &TickRecord) -> Option<Self> {
        let (decision, sight) = (record.decision.as_ref()?, record.sight.as_ref()?);
        let overlay =
            OverlayMessage::of(before.tick, sight, decision.motion, point.arena(), &point.parameters().rl_policy);
        Some(Self {
            tick: before.tick,
            sim_time_s: before.sim_time_s(),
            mode: decision.switching.mode.index(),
            switched: decision.switching.switched,
            reason: decision.switching.reason(),
            error_m: decision.switching.error_m,
            threshold_m: decision.switching.threshold_m,
            controller: point.controller(),
            phase: Told::of(&record.moment.phase),
            tool_m: before.tool_m.xy().coords.into(),
            bead_m: before.bead_m.xy().coords.into(),
            bead_tracked_m: before.tracked_m.coords.into(),
            goal_m: before.goal_m.map(|goal| goal.coords.into()),
            target_m: match decision.motion {
                Motion::Segment(step) => Some(step.target_m.coords.into()),
                Motion::Hold | Motion::Track | Motion::Joints(_) => None,
            },
            refusal: decision.refusal.as_ref().map(Told::of),
            trouble: record.moment.trouble.as_ref().map(Told::of),
            overlay: Box::new(overlay),
        })
    }
}

/// A comparison: one moment continued under several controllers, from the same state with the same disturbances.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct ComparisonMessage {
    /// Number of the trial, as in the scene.
    #[ts(type = "number")]
    pub trial: u64,
    /// Tick of the moment.
    #[ts(type = "number")]
    pub tick: u64,
    /// The tick in seconds.
    pub sim_time_s: f64,
    /// Tick at which branches end at the latest.
    #[ts(type = "number")]
    pub until_tick: u64,
    /// Sub-controller 2 at that moment; its branch repeats the session, and goes on where that ran out of steps.
    pub controller: ControllerName,
    /// Ticks between two samples.
    #[ts(type = "number")]
    pub ticks_a_sample: u64,
    /// Whether branches still run.
    pub running: bool,
    /// Why it failed, if it did.
    pub failed: Option<String>,
    /// One branch per controller, in the requested order; branches that have not started are omitted.
    pub branches: Vec<Branch>,
}

/// One controller's run in a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct Branch {
    pub controller: ControllerName,
    /// Name of the program, with the controller `program`.
    pub program: Option<String>,
    /// Tool x, y and bead x, y in metres, from the first sample after the moment.
    #[schema(value_type = Vec<Numbers4>)]
    pub samples: Vec<[f64; 4]>,
    /// Whether it has ended.
    pub done: bool,
    /// Last phase, as in the state; `null` before the first tick.
    pub phase: Option<Told<PhaseFact>>,
    /// Tick of the first delivery after the moment.
    #[ts(type = "number | null")]
    pub delivered_tick: Option<u64>,
    /// Mean distance of tool and bead during transport.
    pub tracking_error_mean_m: f64,
    /// Maximum difference in x during transport.
    pub tracking_error_max_x_m: f64,
    /// The same in y.
    pub tracking_error_max_y_m: f64,
    /// Control steps since the moment.
    pub steps: u32,
    /// Switches since the moment.
    pub switches: u32,
}

impl ComparisonMessage {
    /// A comparison without branches.
    pub fn begin(trial: u64, point: &BranchPoint) -> Self {
        Self {
            trial,
            tick: point.tick(),
            sim_time_s: point.tick() as f64 * SERVO_PERIOD_S,
            until_tick: point.until_tick(),
            controller: point.controller(),
            ticks_a_sample: TICKS_A_SAMPLE,
            running: true,
            failed: None,
            branches: Vec::new(),
        }
    }
}

impl Branch {
    /// A branch without ticks; the program carries only as the controller of that name.
    pub fn begin(controller: ControllerName, program: Option<&Program>) -> Self {
        let program = program.filter(|_| controller == ControllerName::Program);
        Self {
            controller,
            program: program.map(|program| program.name.clone()),
            samples: Vec::new(),
            done: false,
            phase: None,
            delivered_tick: None,
            tracking_error_mean_m: 0.0,
            tracking_error_max_x_m: 0.0,
            tracking_error_max_y_m: 0.0,
            steps: 0,
            switches: 0,
        }
    }

    /// Adds a tick.
    pub fn follow(&mut self, point: &BranchPoint, progress: &Progress<'_>) {
        let moment = &progress.record.moment;
        if (moment.tick - point.tick()).is_multiple_of(TICKS_A_SAMPLE) {
            let ([tool_x, tool_y], [bead_x, bead_y]) =
                (moment.tool_m.xy().coords.into(), moment.bead_m.xy().coords.into());
            self.samples.push([tool_x, tool_y, bead_x, bead_y]);
        }
        let before = point.counters();
        self.done = progress.done;
        self.delivered_tick = progress.delivered_tick;
        self.phase = Some(Told::of(&moment.phase));
        self.tracking_error_mean_m = progress.tally.mean_m();
        [self.tracking_error_max_x_m, self.tracking_error_max_y_m] = progress.tally.max_m();
        self.steps = moment.counters.steps - before.steps;
        self.switches = moment.counters.switches - before.switches;
    }
}
