//! The program that Ferry sends to a robot that it drives, and what it does, for Ferry's own controller. The program has
//! never run on a real robot.
//!
//! In each period it reports the pose of the flange, as the robot's controller computes it, and from which joints. Ferry sends
//! no target before it has compared this with its own arm ([`super::twin`]): otherwise any arm would be taken for a UR5.
//!
//! It counts its periods of 8 ms and reports the number. Each target says which period it answers. If the newest target
//! answers a period that is more than [`LATE_PERIODS`] ago, the program stops the arm and ends: whether the client is
//! silent, the connection is cut or slow, or old messages are repeated. A message that was cut and put together wrongly
//! does not end with the number that it begins with, and counts as none. A target that is far away ends the program, too. It
//! also bounds the speed, so that targets that come in a burst do not jerk the arm.

use super::arm::pose;
use super::command::Command;
use super::control_script::Next;
use super::model::Model;
use super::mover::Mover;
use super::registers::Registers;
use ferry_core::robot::{Joints, ur5::SERVO_PERIOD_S};

/// The program, in URScript.
pub const TEXT: &str = include_str!("drive.script");
/// The integer register of the period that is answered, and the first of the six double registers of the target.
pub const REGISTER: usize = 24;
/// The integer register of the same number with the other sign.
pub const CHECK_REGISTER: usize = 25;
/// The first of the double registers with the flange's pose, and with the joints that it was computed from.
pub const FLANGE_REGISTER: usize = 24;
pub const JOINTS_REGISTER: usize = 30;
/// What the program reports when it is over.
pub const OVER: i32 = -1;
/// 0.096 s.
pub const LATE_PERIODS: i32 = 12;
/// Periods in which the first target must come: 1 s.
const FIRST_PERIODS: i32 = 125;
/// A joint's target that is farther away is a mistake.
const FAR_RAD: f64 = 0.3;
/// Largest speed of a joint, and of the tool. The tool's is a little below [`ferry_core::control::limits`]' default.
const JOINT_MOST_RAD_S: f64 = 1.5;
const TOOL_MOST_M_S: f64 = 0.24;
const LOOKAHEAD_S: f64 = 0.03;
/// With which the arm stops.
pub const DECELERATION_RAD_S2: f64 = 4.0;

/// The program's state.
#[derive(Clone, Debug, Default)]
pub struct DriveScript {
    period: i32,
    /// Where the joints were sent last; `None` before the first target.
    here_rad: Option<Joints>,
    /// Why it ends, while the arm stops.
    ends: Option<Next>,
}

impl DriveScript {
    /// Its state, if a program's text is this program.
    pub fn recognise(text: &str) -> Option<Self> {
        (text.trim_end() == TEXT.trim_end()).then(Self::default)
    }

    /// One period. `model` computes its forward kinematics; `arm_rad` is where the arm was sent last.
    pub fn cycle(
        &mut self,
        model: &Model,
        inputs: &Registers,
        outputs: &mut Registers,
        mover: &mut Mover,
        arm_rad: &Joints,
    ) -> (Next, Option<&'static str>) {
        if let Some(next) = &self.ends {
            if mover.is_busy() {
                return (Next::Goes, None);
            }
            outputs.int[REGISTER] = OVER;
            return (next.clone(), None);
        }
        outputs.set_six(FLANGE_REGISTER, pose(&model.flange(arm_rad)));
        outputs.set_six(JOINTS_REGISTER, *arm_rad);
        self.period += 1;
        outputs.int[REGISTER] = self.period;
        let answered = inputs.int[REGISTER];
        let is_whole = inputs.int[CHECK_REGISTER] == answered.wrapping_neg();
        let is_fresh = is_whole && (1..=self.period).contains(&answered) && self.period - answered <= LATE_PERIODS;
        let late = |why: &str| Next::Refused { what: "ferry_drive".to_owned(), why: why.to_owned() };
        match (is_fresh, self.here_rad) {
            (true, here_rad) => {
                let here_rad = here_rad.unwrap_or(*arm_rad);
                match toward(model, &here_rad, &inputs.six(REGISTER)) {
                    Some(next_rad) => {
                        self.here_rad = Some(next_rad);
                        let command = Command::ServoJ { to: next_rad, lookahead_s: LOOKAHEAD_S };
                        return self.motion(&command, mover, arm_rad);
                    }
                    None => self.ends = Some(late("a target is far away")),
                }
            }
            (false, None) if self.period <= FIRST_PERIODS => return (Next::Goes, None),
            (false, None) => self.ends = Some(late("no target has come for 1 s")),
            (false, Some(_)) if answered == 0 => self.ends = Some(Next::Ends),
            (false, Some(_)) => self.ends = Some(late("the targets are more than 0.1 s late")),
        }
        self.motion(&Command::StopJ { deceleration: DECELERATION_RAD_S2 }, mover, arm_rad)
    }

    fn motion(&self, command: &Command, mover: &mut Mover, arm_rad: &Joints) -> (Next, Option<&'static str>) {
        let begun = command.check().map_err(|error| error.to_string());
        let begun = begun.and_then(|()| mover.begin(command, arm_rad).map_err(|error| error.to_string()));
        match begun {
            Ok(()) => (Next::Goes, Some(command.name())),
            Err(why) => (Next::Refused { what: command.name().to_owned(), why }, None),
        }
    }
}

/// One period's way from `here_rad` to a target; `None` if that is far away, or not a number.
fn toward(model: &Model, here_rad: &Joints, target_rad: &Joints) -> Option<Joints> {
    let part = |share: f64| -> Joints { std::array::from_fn(|i| here_rad[i] + share * (target_rad[i] - here_rad[i])) };
    let is_near = |i: usize| (target_rad[i] - here_rad[i]).abs() <= FAR_RAD;
    if !(0..6).all(is_near) {
        return None;
    }
    let largest_rad = (0..6).map(|i| (target_rad[i] - here_rad[i]).abs()).fold(1e-6, f64::max);
    let share = (JOINT_MOST_RAD_S * SERVO_PERIOD_S / largest_rad).min(1.0);
    let place_m = |joints: &Joints| model.tool(joints).translation.vector;
    let distance_m = (place_m(&part(share)) - place_m(here_rad)).norm();
    Some(part(share * (TOOL_MOST_M_S * SERVO_PERIOD_S / distance_m).min(1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE_RAD: Joints = [-1.6, -1.6, -1.6, -1.6, 1.6, 0.0];

    /// The numbers in the program are those of this file.
    #[test]
    fn the_text_is_what_is_carried_out() {
        assert!(DriveScript::recognise(TEXT).is_some());
        assert!(DriveScript::recognise(&TEXT.replace("0.24", "0.5")).is_none());
        for part in [
            format!("period - answered <= {LATE_PERIODS}:"),
            format!("period > {FIRST_PERIODS}:"),
            format!("largest > {FAR_RAD}:"),
            format!("read_input_integer_register({CHECK_REGISTER}) == 0 - answered"),
            format!("share = {JOINT_MOST_RAD_S} * {SERVO_PERIOD_S} / largest"),
            format!("distance > {TOOL_MOST_M_S} * {SERVO_PERIOD_S}:"),
            format!("servoj(here, 0, 0, {SERVO_PERIOD_S}, {LOOKAHEAD_S}, 300)"),
            format!("stopj({DECELERATION_RAD_S2})"),
            format!("write_output_integer_register({REGISTER}, {OVER})"),
            format!("tcp = p[0, 0, {}, 0, 0, 0]", ferry_core::plant::TOOL_LENGTH_M),
            format!("write_output_float_register({FLANGE_REGISTER} + i, flange[i])"),
            format!("write_output_float_register({JOINTS_REGISTER} + i, joints[i])"),
        ] {
            assert!(TEXT.contains(&part), "{part}");
        }
    }

    #[test]
    fn a_target_is_approached_slowly() {
        let target_rad: Joints = [-1.4, -1.4, -1.31, -1.4, 1.4, 0.2];
        let arm = Model::default();
        assert_eq!(toward(&arm, &HERE_RAD, &[-1.4, -1.4, -1.2, -1.4, 1.4, 0.2]), None);
        assert_eq!(toward(&arm, &HERE_RAD, &[-1.4, f64::NAN, -1.31, -1.4, 1.4, 0.2]), None);
        let mut here_rad = HERE_RAD;
        for _ in 0..3000 {
            let next_rad = toward(&arm, &here_rad, &target_rad).unwrap();
            let travel_m = (arm.tool(&next_rad).translation.vector - arm.tool(&here_rad).translation.vector).norm();
            // The arc is a little shorter or longer than its share.
            assert!(travel_m <= 1.01 * TOOL_MOST_M_S * SERVO_PERIOD_S, "{travel_m}");
            assert!((0..6).all(|i| (next_rad[i] - here_rad[i]).abs() <= 1.5001 * SERVO_PERIOD_S));
            here_rad = next_rad;
        }
        assert_eq!(here_rad, target_rad);
    }

    /// Runs the program. `answered` gives what the client has written in a period.
    fn run(periods: i32, answered: impl Fn(i32) -> i32) -> (Vec<Next>, Registers, Joints) {
        let (mut script, mut mover) = (DriveScript::default(), Mover::default());
        let (mut inputs, mut outputs) = (Registers::default(), Registers::default());
        let mut here_rad = HERE_RAD;
        inputs.set_six(REGISTER, [-1.31, -1.6, -1.6, -1.6, 1.6, 0.0]);
        let mut seen = Vec::new();
        for period in 1..=periods {
            inputs.int[REGISTER] = answered(period);
            inputs.int[CHECK_REGISTER] = -answered(period);
            let (next, _) = script.cycle(&Model::default(), &inputs, &mut outputs, &mut mover, &here_rad);
            if next != Next::Goes {
                seen.push(next);
                break;
            }
            here_rad = mover.next(&here_rad, 1.0, 1.0).unwrap().unwrap_or(here_rad);
        }
        (seen, outputs, here_rad)
    }

    #[test]
    fn it_follows_fresh_targets_and_stops_when_they_are_late_repeated_or_over() {
        let (seen, outputs, here_rad) = run(100, |period| period - 3);
        assert!(seen.is_empty() && outputs.int[REGISTER] == 100 && here_rad[0] > -1.32, "{here_rad:?}");
        let ends = |answered: fn(i32) -> i32| run(400, answered);
        for silent_from in [|period: i32| period.min(50), |period: i32| if period < 50 { period } else { period - 30 }]
        {
            let (seen, outputs, _) = ends(silent_from);
            assert!(matches!(&seen[..], [Next::Refused { why, .. }] if why.contains("late")), "{seen:?}");
            assert_eq!(outputs.int[REGISTER], OVER);
        }
        // It stops within 12 periods and the time that the stop takes.
        let (_, _, at_rest_rad) = ends(|period| period.min(50));
        let (_, _, at_silence_rad) = run(50, |period| period);
        let (_, _, later_rad) = run(62, |period| period);
        let speed_rad_s = (later_rad[0] - at_silence_rad[0]) / (12.0 * SERVO_PERIOD_S);
        let stopping_rad = speed_rad_s * speed_rad_s / (2.0 * DECELERATION_RAD_S2);
        assert!(speed_rad_s > 0.3 && at_rest_rad[0] - later_rad[0] < stopping_rad + 2.0 * speed_rad_s * SERVO_PERIOD_S);
        assert_eq!(ends(|period| if period < 50 { period } else { 0 }).0, [Next::Ends]);
        // Numbers from an earlier program are not fresh.
        let (seen, _, here_rad) = ends(|_| 1_000);
        assert!(matches!(&seen[..], [Next::Refused { why, .. }] if why.contains("no target")) && here_rad == HERE_RAD);
    }
}
