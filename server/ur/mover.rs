//! Makes joint targets, one per servo period, from commands.

use super::arm::{Spatial, tool};
use super::command::{Command, Target};
use ferry_core::geometry::{Isometry3, Translation3, UnitQuaternion, Vector3};
use ferry_core::plant::TOOL_LENGTH_M;
use ferry_core::robot::inverse::{self, InverseError};
use ferry_core::robot::{Joints, ur5::SERVO_PERIOD_S};

/// A joint or the tool that has less to go has arrived.
const ARRIVED: f64 = 1e-9;
/// Attempts to slow a move down to the tool's speed limit.
const SLOWER_MOST: usize = 8;
/// Deceleration of joints whose command has ended, rad/s².
const REST_RAD_S2: f64 = 10.0;

/// A path from rest to rest, by the share that has been covered.
#[derive(Clone, Copy, Debug)]
enum Path {
    Joints { from: Joints, to: Joints },
    Line { from: Isometry3<f64>, to: Isometry3<f64> },
}

#[derive(Clone, Copy, Debug)]
enum Motion {
    /// Length, place and speeds in the unit of the path: rad of the leading joint, m of the tool, or rad of its turn.
    Move {
        path: Path,
        length: f64,
        at: f64,
        now: f64,
        speed: f64,
        acceleration: f64,
    },
    SpeedL {
        velocity: Spatial,
        now: Spatial,
        acceleration: f64,
        left_s: Option<f64>,
    },
    SpeedJ {
        velocity: Joints,
        now: Joints,
        acceleration: f64,
        left_s: Option<f64>,
    },
    Servo {
        to: Joints,
        lookahead_s: f64,
    },
    Stop {
        deceleration: f64,
        is_tool: bool,
    },
}

/// The command that is being carried out.
#[derive(Clone, Debug, Default)]
pub struct Mover {
    motion: Option<Motion>,
    /// The speed of the joints in the last period, rad/s.
    speed_rad_s: Joints,
}

impl Mover {
    /// Begins a command; the one before ends. A move begins from rest.
    ///
    /// # Errors
    /// The target is out of reach.
    pub fn begin(&mut self, command: &Command, here_rad: &Joints) -> Result<(), InverseError> {
        let left = |time_s: f64| (time_s > 0.0).then_some(time_s);
        self.motion = Some(match *command {
            Command::MoveJ { to, speed, acceleration } => {
                let to = match to {
                    Target::Joints(joints) => joints,
                    Target::Pose(pose) => joints_at(&isometry(&pose), here_rad)?,
                };
                let length = (0..6).map(|i| (to[i] - here_rad[i]).abs()).fold(0.0, f64::max);
                let path = Path::Joints { from: *here_rad, to };
                Motion::Move { path, length, at: 0.0, now: 0.0, speed, acceleration }
            }
            Command::MoveL { to, speed, acceleration } => {
                let to = match to {
                    Target::Joints(joints) => tool(&joints),
                    Target::Pose(pose) => isometry(&pose),
                };
                joints_at(&to, here_rad)?;
                let from = tool(here_rad);
                let travel_m = (to.translation.vector - from.translation.vector).norm();
                let turn_rad = from.rotation.angle_to(&to.rotation);
                let path = Path::Line { from, to };
                // A turn on the spot has a length, too.
                let length = if travel_m > 1e-6 { travel_m } else { turn_rad };
                Motion::Move { path, length, at: 0.0, now: 0.0, speed, acceleration }
            }
            Command::SpeedL { velocity, acceleration, time_s } => {
                let now = if let Some(Motion::SpeedL { now, .. }) = self.motion { now } else { [0.0; 6] };
                Motion::SpeedL { velocity, now, acceleration, left_s: left(time_s) }
            }
            Command::SpeedJ { velocity, acceleration, time_s } => {
                Motion::SpeedJ { velocity, now: self.speed_rad_s, acceleration, left_s: left(time_s) }
            }
            Command::ServoJ { to, lookahead_s } => Motion::Servo { to, lookahead_s },
            Command::StopL { deceleration } => Motion::Stop { deceleration, is_tool: true },
            Command::StopJ { deceleration } => Motion::Stop { deceleration, is_tool: false },
        });
        Ok(())
    }

    /// Comes to rest.
    pub fn rest(&mut self) {
        self.motion = self.is_moving().then_some(Motion::Stop { deceleration: REST_RAD_S2, is_tool: false });
    }

    /// Forgets everything: the arm was stopped, or is somewhere else.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Whether a command is being carried out, or its end.
    pub fn is_busy(&self) -> bool {
        self.motion.is_some()
    }

    /// Whether the motion has no end of its own.
    pub fn goes_on(&self) -> bool {
        matches!(
            self.motion,
            Some(Motion::Servo { .. } | Motion::SpeedL { left_s: None, .. } | Motion::SpeedJ { left_s: None, .. })
        )
    }

    fn is_moving(&self) -> bool {
        self.speed_rad_s.iter().any(|speed| speed.abs() > ARRIVED)
    }

    /// The joints at the end of the next servo period; `None` at rest. Moves are slowed down to `tool_most_m_s`, and to
    /// `fraction` of their speed, as with a robot's speed slider.
    ///
    /// # Errors
    /// The way leads out of reach; the arm stays.
    pub fn next(
        &mut self,
        here_rad: &Joints,
        tool_most_m_s: f64,
        fraction: f64,
    ) -> Result<Option<Joints>, InverseError> {
        let Some(motion) = &mut self.motion else { return Ok(None) };
        let (next, is_over) = match motion.advance(here_rad, &self.speed_rad_s, tool_most_m_s, fraction) {
            Ok(advanced) => advanced,
            Err(error) => {
                self.clear();
                return Err(error);
            }
        };
        self.speed_rad_s = std::array::from_fn(|i| (next[i] - here_rad[i]) / SERVO_PERIOD_S);
        if is_over {
            self.motion = None;
            // A velocity whose time is over.
            self.rest();
        }
        Ok(Some(next))
    }
}

impl Motion {
    /// The joints at the end of the next period, and whether the motion is over then.
    fn advance(
        &mut self,
        here_rad: &Joints,
        speed_rad_s: &Joints,
        tool_most_m_s: f64,
        fraction: f64,
    ) -> Result<(Joints, bool), InverseError> {
        match self {
            Self::Move { path, length, at, now, speed, acceleration } => {
                let left = *length - *at;
                if left < ARRIVED {
                    return Ok((path.end(here_rad)?, true));
                }
                // The speed from which it can still come to rest at the end, period by period.
                let change = *acceleration * SERVO_PERIOD_S;
                let braking = (change * change / 4.0 + 2.0 * *acceleration * left).sqrt() - change / 2.0;
                let mut step = (*now + change).min(*speed * fraction).min(braking.max(change / 2.0)) * SERVO_PERIOD_S;
                step = step.min(left);
                let here_m = tool(here_rad).translation.vector;
                let most_m = tool_most_m_s * SERVO_PERIOD_S;
                let mut next = path.at((*at + step) / *length, here_rad)?;
                for _ in 0..SLOWER_MOST {
                    let travel_m = (tool(&next).translation.vector - here_m).norm();
                    if travel_m <= most_m {
                        break;
                    }
                    step *= 0.999 * most_m / travel_m;
                    next = path.at((*at + step) / *length, here_rad)?;
                }
                *at += step;
                *now = step / SERVO_PERIOD_S;
                Ok((next, *length - *at < ARRIVED))
            }
            Self::SpeedL { velocity, now, acceleration, left_s } => {
                let scaled = velocity.map(|v| v * fraction);
                *now = ramp(now, &scaled, *acceleration * SERVO_PERIOD_S);
                let (along, about) = (Vector3::from_row_slice(&now[..3]), Vector3::from_row_slice(&now[3..]));
                let here = tool(here_rad);
                let turned = UnitQuaternion::from_scaled_axis(about * SERVO_PERIOD_S) * here.rotation;
                let moved = Translation3::from(here.translation.vector + along * SERVO_PERIOD_S);
                let next = joints_at(&Isometry3::from_parts(moved, turned), here_rad)?;
                Ok((next, is_over(left_s)))
            }
            Self::SpeedJ { velocity, now, acceleration, left_s } => {
                let scaled = velocity.map(|v| v * fraction);
                *now = ramp(now, &scaled, *acceleration * SERVO_PERIOD_S);
                Ok((std::array::from_fn(|i| here_rad[i] + now[i] * SERVO_PERIOD_S), is_over(left_s)))
            }
            Self::Servo { to, lookahead_s } => {
                let share = (SERVO_PERIOD_S / *lookahead_s).min(1.0);
                let next = std::array::from_fn(|i| here_rad[i] + share * (to[i] - here_rad[i]));
                Ok((next, false))
            }
            Self::Stop { deceleration, is_tool } => {
                let next: Joints = std::array::from_fn(|i| here_rad[i] + speed_rad_s[i] * SERVO_PERIOD_S);
                let speed = if *is_tool {
                    let travel_m = tool(&next).translation.vector - tool(here_rad).translation.vector;
                    travel_m.norm() / SERVO_PERIOD_S
                } else {
                    speed_rad_s.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()))
                };
                let share = 1.0 - *deceleration * SERVO_PERIOD_S / speed;
                // Also a turn on the spot ends.
                if share.is_nan() || share <= 0.0 || speed < 1e-4 {
                    return Ok((*here_rad, true));
                }
                Ok((std::array::from_fn(|i| here_rad[i] + share * speed_rad_s[i] * SERVO_PERIOD_S), false))
            }
        }
    }
}

impl Path {
    fn at(&self, share: f64, here_rad: &Joints) -> Result<Joints, InverseError> {
        match self {
            Self::Joints { from, to } => Ok(std::array::from_fn(|i| from[i] + share * (to[i] - from[i]))),
            Self::Line { from, to } => {
                let place = from.translation.vector.lerp(&to.translation.vector, share);
                let turn = (to.rotation * from.rotation.inverse()).scaled_axis() * share;
                let rotation = UnitQuaternion::from_scaled_axis(turn) * from.rotation;
                joints_at(&Isometry3::from_parts(Translation3::from(place), rotation), here_rad)
            }
        }
    }

    fn end(&self, here_rad: &Joints) -> Result<Joints, InverseError> {
        match self {
            Self::Joints { to, .. } => Ok(*to),
            Self::Line { to, .. } => joints_at(to, here_rad),
        }
    }
}

/// Changes by at most `most` toward `wanted`, along a straight line.
fn ramp(now: &[f64; 6], wanted: &[f64; 6], most: f64) -> [f64; 6] {
    let change: [f64; 6] = std::array::from_fn(|i| wanted[i] - now[i]);
    let size = change.iter().map(|c| c * c).sum::<f64>().sqrt();
    let share = if size > most { most / size } else { 1.0 };
    std::array::from_fn(|i| now[i] + share * change[i])
}

fn is_over(left_s: &mut Option<f64>) -> bool {
    let Some(left_s) = left_s else { return false };
    *left_s -= SERVO_PERIOD_S;
    *left_s < SERVO_PERIOD_S / 2.0
}

pub(super) fn isometry(pose: &Spatial) -> Isometry3<f64> {
    let [x, y, z, rx, ry, rz] = *pose;
    Isometry3::new(Vector3::new(x, y, z), Vector3::new(rx, ry, rz))
}

/// The joints with the tool at a pose, on the branch nearest to `seed_rad`.
///
/// # Errors
/// Those of [`inverse::nearest`].
pub fn joints_at(base_from_tool: &Isometry3<f64>, seed_rad: &Joints) -> Result<Joints, InverseError> {
    inverse::nearest(&(base_from_tool * Translation3::new(0.0, 0.0, -TOOL_LENGTH_M)), seed_rad)
}

/// The same for a pose of six numbers.
///
/// # Errors
/// Those of [`inverse::nearest`].
pub fn joints_at_pose(pose: &Spatial, seed_rad: &Joints) -> Result<Joints, InverseError> {
    joints_at(&isometry(pose), seed_rad)
}

#[cfg(test)]
mod tests {
    use super::super::arm::pose;
    use super::*;

    const HOME: Joints = [-1.6, -1.6, -1.6, -1.6, 1.6, 0.0];
    const TOOL_MOST_M_S: f64 = 0.25;

    fn start() -> Joints {
        joints_at_pose(&[0.0, -0.4, 0.1, 2.2214, -2.2214, 0.0], &HOME).unwrap()
    }

    /// The joints after each period, until the mover rests.
    fn carried_out(mover: &mut Mover, from: Joints) -> Vec<Joints> {
        let mut all = vec![from];
        while let Some(next) = mover.next(all.last().unwrap(), TOOL_MOST_M_S, 1.0).unwrap() {
            all.push(next);
            assert!(all.len() < 5000, "it does not come to rest");
        }
        all
    }

    fn speeds_m_s(all: &[Joints]) -> Vec<f64> {
        let place = |q: &Joints| tool(q).translation.vector;
        all.windows(2).map(|pair| (place(&pair[1]) - place(&pair[0])).norm() / SERVO_PERIOD_S).collect()
    }

    #[test]
    fn a_straight_move_keeps_its_line_speed_and_acceleration() {
        let (mut mover, from) = (Mover::default(), start());
        let mut to = pose(&tool(&from));
        to[0] += 0.12;
        to[1] += 0.05;
        mover.begin(&Command::MoveL { to: Target::Pose(to), speed: 0.1, acceleration: 0.5 }, &from).unwrap();
        let all = carried_out(&mut mover, from);
        let end = pose(&tool(all.last().unwrap()));
        assert!((0..6).all(|i| (end[i] - to[i]).abs() < 1e-8), "{end:?} {to:?}");
        let speeds = speeds_m_s(&all);
        // .13 m at .1 m/s, and .2 s more to begin and to end.
        assert!((speeds.len() as f64 * SERVO_PERIOD_S - 1.5).abs() < 0.05, "{}", speeds.len());
        assert!(speeds.iter().all(|speed| *speed < 0.1 + 1e-6), "{speeds:?}");
        assert!(speeds.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 1.3 * 0.5 * SERVO_PERIOD_S), "{speeds:?}");
        for joints in &all {
            let now = tool(joints).translation.vector;
            let begun = tool(&from).translation.vector;
            let aside = (now - begun).cross(&Vector3::new(0.12, 0.05, 0.0).normalize()).norm();
            assert!(aside < 1e-9, "{aside}");
        }
    }

    #[test]
    fn a_joint_move_is_slowed_down_to_the_tools_limit_and_arrives() {
        let (mut mover, from) = (Mover::default(), start());
        let to = joints_at_pose(&[0.15, -0.4, 0.1, 2.2214, -2.2214, 0.0], &from).unwrap();
        mover.begin(&Command::MoveJ { to: Target::Joints(to), speed: 3.0, acceleration: 10.0 }, &from).unwrap();
        let all = carried_out(&mut mover, from);
        assert_eq!(all.last(), Some(&to));
        let fastest = speeds_m_s(&all).into_iter().fold(0.0, f64::max);
        assert!((0.2..=TOOL_MOST_M_S).contains(&fastest), "{fastest}");
    }

    #[test]
    fn a_velocity_is_reached_kept_and_left() {
        let (mut mover, mut here) = (Mover::default(), start());
        let velocity = [0.05, 0.0, 0.0, 0.0, 0.0, 0.0];
        mover.begin(&Command::SpeedL { velocity, acceleration: 0.5, time_s: 0.0 }, &here).unwrap();
        let mut all = vec![here];
        for _ in 0..50 {
            here = mover.next(&here, TOOL_MOST_M_S, 1.0).unwrap().unwrap();
            all.push(here);
        }
        let speeds = speeds_m_s(&all);
        assert!((speeds[0] - 0.004).abs() < 1e-6 && (speeds[49] - 0.05).abs() < 1e-6, "{speeds:?}");
        mover.begin(&Command::StopL { deceleration: 1.0 }, &here).unwrap();
        let slower = speeds_m_s(&carried_out(&mut mover, here));
        assert!((5..9).contains(&slower.len()) && slower.is_sorted_by(|a, b| a >= b), "{slower:?}");
        // A velocity for a time ends by itself.
        mover.begin(&Command::SpeedL { velocity, acceleration: 0.5, time_s: 0.4 }, &here).unwrap();
        let timed = carried_out(&mut mover, here);
        assert!((50..60).contains(&timed.len()), "{}", timed.len());
    }

    #[test]
    fn a_servo_target_is_approached_within_the_lookahead() {
        let (mut mover, mut here) = (Mover::default(), start());
        let mut to = here;
        to[0] += 0.02;
        mover.begin(&Command::ServoJ { to, lookahead_s: 0.1 }, &here).unwrap();
        for _ in 0..25 {
            here = mover.next(&here, TOOL_MOST_M_S, 1.0).unwrap().unwrap();
        }
        assert!((to[0] - here[0]) < 0.02 * 0.15, "after twice the lookahead: {}", to[0] - here[0]);
        assert!(mover.is_busy(), "it goes on following");
    }

    #[test]
    fn targets_out_of_reach_are_refused_and_nothing_moves() {
        let (mut mover, here) = (Mover::default(), start());
        let far = Target::Pose([2.0, 0.0, 0.1, 2.2214, -2.2214, 0.0]);
        assert!(mover.begin(&Command::MoveL { to: far, speed: 0.1, acceleration: 0.5 }, &here).is_err());
        assert!(mover.begin(&Command::MoveJ { to: far, speed: 0.1, acceleration: 0.5 }, &here).is_err());
        assert_eq!(mover.next(&here, TOOL_MOST_M_S, 1.0), Ok(None));
    }
}
