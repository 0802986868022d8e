//! The robot that a session's thread moves and clients command.

use std::sync::{Mutex, MutexGuard, PoisonError};

use tokio::sync::watch;

use super::Arm;
use super::controller::{Controller, LoadError, Standing};
use super::model::Model;
use ferry_core::robot::Joints;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Input, InputError, Trial};

#[derive(Debug)]
pub struct Robot {
    arm: watch::Sender<Arm>,
    controller: Mutex<Controller>,
}

impl Default for Robot {
    fn default() -> Self {
        Self { arm: watch::Sender::new(Arm::default()), controller: Mutex::default() }
    }
}

impl Robot {
    /// The newest report, and a signal at each newer one.
    pub fn watch(&self) -> watch::Receiver<Arm> {
        self.arm.subscribe()
    }

    pub fn controller(&self) -> MutexGuard<'_, Controller> {
        self.controller.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn standing(&self) -> Standing {
        self.controller().standing()
    }

    /// The arm that its controller takes its own for; a UR5 at first.
    pub fn set_model(&self, model: Model) {
        self.controller().set_model(model);
    }

    /// Begins a program; the one before ends. The session must then give it the arm.
    ///
    /// # Errors
    /// [`LoadError`]; nothing has changed, except that the refusal is noted.
    pub fn load(&self, text: &str) -> Result<(), LoadError> {
        let has_joints = self.arm.borrow().has_joints;
        self.controller().load(text, has_joints)
    }

    /// Notes the state of a trial: after each tick, and when it has changed otherwise. After a jump in time, speeds are 0
    /// until the next tick.
    pub fn note(&self, trial: &Trial) {
        self.arm.send_if_modified(|arm| {
            let world = &trial.state().world;
            let q_rad = world.plant.positioner.joints_rad().unwrap_or_default();
            let is_new = world.tick != arm.tick || q_rad != arm.actual_q_rad;
            if is_new {
                *arm = arm.after(trial, self.controller().model());
            }
            is_new
        });
    }

    /// What its program wants in the next tick.
    pub fn next(&self, trial: &Trial) -> Option<Input> {
        let state = trial.state();
        let is_ours = state.controller == ControllerName::Robot;
        let limits = trial.arena().limits(&state.world.parameters);
        let here_rad: Option<Joints> = state.world.reference.joints_rad();
        let joints_rad = self.controller().next(state.world.tick, is_ours, here_rad.as_ref(), &limits)?;
        Some(Input::Servo { joints_rad })
    }

    /// The trial has refused what the program wants: a limit would be violated.
    pub fn stop(&self, error: &InputError) {
        self.controller().violate(&error.to_string());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::control::TargetStep;
    use ferry_core::control::switching::{self, Mode};
    use ferry_core::geometry::{Point2, Vector3};
    use ferry_core::plant::{PositionerKind, TOOL_LENGTH_M};
    use ferry_core::robot::{forward, jacobian, ur5::SERVO_PERIOD_S};
    use ferry_core::scenario::Scenario;
    use ferry_core::trial::{Arena, Decision, Motion, Source};

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
        Trial::new(scenario, Arena::shipped("open").unwrap()).unwrap()
    }

    #[test]
    fn speeds_are_those_of_the_jacobian_and_the_bead_pulls_the_magnet_down() {
        let (mut trial, robot) = (trial(PositionerKind::Arm), Robot::default());
        robot.note(&trial);
        let watched = robot.watch();
        assert!(watched.borrow().has_joints && watched.borrow().tick == 0);
        for _ in 0..60 {
            tick(&mut trial, 0.1);
            robot.note(&trial);
            robot.note(&trial);
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
        robot.note(&self::trial(PositionerKind::Arm));
        assert_eq!((watched.borrow().tick, watched.borrow().actual_qd_rad_s), (0, [0.0; 6]));
    }

    #[test]
    fn a_planar_stage_has_no_joints() {
        let (mut trial, robot) = (trial(PositionerKind::PlanarStage), Robot::default());
        let watched = robot.watch();
        tick(&mut trial, 0.1);
        robot.note(&trial);
        assert_eq!(*watched.borrow(), Arm { tick: 1, time_s: SERVO_PERIOD_S, ..Arm::default() });
    }
}
