//! The arm at a moment, as a controller reports it.

use tokio::sync::watch;

use crate::geometry::{Isometry3, Translation3, Vector3};
use crate::plant::TOOL_LENGTH_M;
use crate::robot::{Joints, forward, ur5::SERVO_PERIOD_S};
use crate::trial::Trial;

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
    /// What the bead pulls the magnet with, N.
    pub tool_force: Spatial,
}

/// Reports a session's arm, tick by tick.
#[derive(Debug)]
pub struct Reports {
    arm: watch::Sender<Arm>,
}

impl Default for Reports {
    fn default() -> Self {
        Self { arm: watch::Sender::new(Arm::default()) }
    }
}

impl Reports {
    /// The newest report, and a signal at each newer one.
    pub fn watch(&self) -> watch::Receiver<Arm> {
        self.arm.subscribe()
    }

    /// Notes the state of a trial: after each tick, and when it has changed otherwise. After a jump in time, speeds are 0
    /// until the next tick.
    pub fn note(&self, trial: &Trial) {
        self.arm.send_if_modified(|arm| {
            let world = &trial.state().world;
            let q_rad = world.plant.positioner.joints_rad().unwrap_or_default();
            let is_new = world.tick != arm.tick || q_rad != arm.actual_q_rad;
            if is_new {
                *arm = arm.after(trial);
            }
            is_new
        });
    }
}

impl Arm {
    fn after(&self, trial: &Trial) -> Self {
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
        let [actual, target] = [tool(&actual_q_rad), tool(&target_q_rad)];
        let speed = |now: &Isometry3<f64>, before: &Joints| if is_new { [0.0; 6] } else { speed(now, &tool(before)) };
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
            tool_force: [-load.lateral_n.x, -load.lateral_n.y, -load.vertical_n, 0.0, 0.0, 0.0],
        }
    }
}

/// `base_from_tool`, with the flange's axes.
fn tool(joints: &Joints) -> Isometry3<f64> {
    forward::flange(joints) * Translation3::new(0.0, 0.0, TOOL_LENGTH_M)
}

fn pose(base_from_tool: &Isometry3<f64>) -> Spatial {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::TargetStep;
    use crate::control::switching::{self, Mode};
    use crate::geometry::Point2;
    use crate::plant::PositionerKind;
    use crate::robot::jacobian;
    use crate::scenario::Scenario;
    use crate::trial::{Arena, Decision, Motion, Source};

    /// A tick with the tool on its way to a place.
    fn tick(trial: &mut Trial, x_m: f64) {
        let switching = switching::Decision { mode: Mode::Transport, switched: false, error_m: 0.0, threshold_m: 0.1 };
        let step = TargetStep { target_m: Point2::new(x_m, -0.35), speed_m_s: 0.04 };
        let decision = Decision { switching, motion: Motion::Segment(step), refusal: None };
        trial.tick(Source::Logged(Some(decision))).unwrap();
    }

    fn trial(positioner: PositionerKind) -> Trial {
        let start_m = Some(Point2::new(0.0, -0.35));
        let scenario = Scenario { start_m, positioner: Some(positioner), ..Scenario::idle("open", 1) };
        Trial::new(scenario, Arena::open("open").unwrap()).unwrap()
    }

    #[test]
    fn speeds_are_those_of_the_jacobian_and_the_bead_pulls_the_magnet_down() {
        let (mut trial, reports) = (trial(PositionerKind::Arm), Reports::default());
        reports.note(&trial);
        let watched = reports.watch();
        assert!(watched.borrow().has_joints && watched.borrow().tick == 0);
        for _ in 0..60 {
            tick(&mut trial, 0.1);
            reports.note(&trial);
            reports.note(&trial);
        }
        let arm = *watched.borrow();
        assert!((arm.time_s - 61.0 * SERVO_PERIOD_S).abs() < 1e-12);
        let twist = jacobian::geometric(&arm.actual_q_rad) * nalgebra::Vector6::from(arm.actual_qd_rad_s);
        let (flange_m_s, turn_rad_s) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
        let flange_from_tool_m = forward::flange(&arm.actual_q_rad).rotation * Vector3::new(0.0, 0.0, TOOL_LENGTH_M);
        let tool_m_s = flange_m_s + turn_rad_s.into_owned().cross(&flange_from_tool_m);
        assert!((arm.actual_tool_speed[0] - 0.04).abs() < 1e-3, "{arm:?}");
        for axis in 0..3 {
            assert!((arm.actual_tool_speed[axis] - tool_m_s[axis]).abs() < 1e-4, "{arm:?}");
            assert!((arm.actual_tool_speed[3 + axis] - turn_rad_s[axis]).abs() < 1e-4, "{arm:?}");
        }
        assert!((arm.actual_tool[0] - trial.tool_m().x).abs() < 1e-12);
        assert!((arm.actual_tool[2] - 0.1).abs() < 1e-3, "{arm:?}");
        // The paper's rotation vector of a flange that points down.
        assert!(
            (arm.actual_tool[3] + arm.actual_tool[4]).abs() < 1e-3 && (arm.actual_tool[3].abs() - 2.22).abs() < 0.01
        );
        assert!(arm.tool_force[2] < 0.0 && arm.tool_force[0] < 0.0, "the bead is behind: {arm:?}");
        // A reset is not a motion.
        reports.note(&self::trial(PositionerKind::Arm));
        assert_eq!((watched.borrow().tick, watched.borrow().actual_qd_rad_s), (0, [0.0; 6]));
    }

    #[test]
    fn a_planar_stage_has_no_joints() {
        let (mut trial, reports) = (trial(PositionerKind::PlanarStage), Reports::default());
        let watched = reports.watch();
        tick(&mut trial, 0.1);
        reports.note(&trial);
        assert_eq!(*watched.borrow(), Arm { tick: 1, time_s: SERVO_PERIOD_S, ..Arm::default() });
    }
}
