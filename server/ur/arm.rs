//! The arm at a moment, as a controller reports it.

use super::model::Model;
use ferry_core::geometry::{Isometry3, Translation3, Vector3};
use ferry_core::plant::TOOL_LENGTH_M;
use ferry_core::robot::{Joints, forward, ur5::SERVO_PERIOD_S};
use ferry_core::trial::Trial;

/// A pose, speed or force of the tool: three numbers along `base`'s axes, then three about them. A pose's rotation is a
/// rotation vector.
pub type Spatial = [f64; 6];

/// Joints and tool point, now and a tick before. The tool's frame is the flange's, moved to Ferry's tool point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Arm {
    /// Ticks of the trial.
    pub tick: u64,
    /// Simulated time since the first report, s. It goes on after a rewind or a reset, and rests while the session is
    /// paused.
    pub time_s: f64,
    /// False for a session with a planar stage, which has no joints.
    pub has_joints: bool,
    pub actual_q_rad: Joints,
    pub actual_qd_rad_s: Joints,
    pub target_q_rad: Joints,
    pub target_qd_rad_s: Joints,
    pub target_qdd_rad_s2: Joints,
    pub actual_tool: Spatial,
    pub actual_tool_speed: Spatial,
    pub target_tool: Spatial,
    pub target_tool_speed: Spatial,
    pub elbow_m: [f64; 3],
    pub elbow_m_s: [f64; 3],
    /// What the bead pulls the magnet with, N.
    pub tool_force: Spatial,
}

impl Arm {
    /// A tick later.
    pub(super) fn after(&self, trial: &Trial, model: &Model) -> Self {
        let world = &trial.state().world;
        let (tick, time_s) = (world.tick, self.time_s + SERVO_PERIOD_S);
        let (Some(actual_q_rad), Some(target_q_rad)) =
            (world.plant.positioner.joints_rad(), world.reference.joints_rad())
        else {
            return Self { tick, time_s, ..Self::default() };
        };
        let is_new = tick != self.tick + 1 || !self.has_joints;
        let rates = |now: &Joints, before: &Joints| {
            std::array::from_fn(|i| if is_new { 0.0 } else { (now[i] - before[i]) / SERVO_PERIOD_S })
        };
        let target_qd_rad_s = rates(&target_q_rad, &self.target_q_rad);
        let [actual, target] = [model.tool(&actual_q_rad), model.tool(&target_q_rad)];
        let speed =
            |now: &Isometry3<f64>, before: &Joints| if is_new { [0.0; 6] } else { speed(now, &model.tool(before)) };
        let [elbow_m, elbow_before_m] = [&actual_q_rad, &self.actual_q_rad].map(|joints| model.elbow_m(joints));
        let load = trial.load();
        Self {
            tick,
            time_s,
            has_joints: true,
            actual_q_rad,
            actual_qd_rad_s: rates(&actual_q_rad, &self.actual_q_rad),
            target_q_rad,
            target_qd_rad_s,
            target_qdd_rad_s2: rates(&target_qd_rad_s, &self.target_qd_rad_s),
            actual_tool: pose(&actual),
            actual_tool_speed: speed(&actual, &self.actual_q_rad),
            target_tool: pose(&target),
            target_tool_speed: speed(&target, &self.target_q_rad),
            elbow_m,
            elbow_m_s: std::array::from_fn(|i| {
                if is_new { 0.0 } else { (elbow_m[i] - elbow_before_m[i]) / SERVO_PERIOD_S }
            }),
            tool_force: [-load.lateral_n.x, -load.lateral_n.y, -load.vertical_n, 0.0, 0.0, 0.0],
        }
    }
}

/// `base_from_tool`, with the flange's axes.
pub(super) fn tool(joints: &Joints) -> Isometry3<f64> {
    forward::flange(joints) * Translation3::new(0.0, 0.0, TOOL_LENGTH_M)
}

pub(super) fn pose(base_from_tool: &Isometry3<f64>) -> Spatial {
    spatial(base_from_tool.translation.vector, base_from_tool.rotation.scaled_axis())
}

fn speed(now: &Isometry3<f64>, before: &Isometry3<f64>) -> Spatial {
    let travel_m = now.translation.vector - before.translation.vector;
    let turn_rad = (now.rotation * before.rotation.inverse()).scaled_axis();
    spatial(travel_m / SERVO_PERIOD_S, turn_rad / SERVO_PERIOD_S)
}

fn spatial(along: Vector3<f64>, about: Vector3<f64>) -> Spatial {
    [along.x, along.y, along.z, about.x, about.y, about.z]
}
