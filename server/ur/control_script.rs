//! The program that `ur_rtde` sends to the robot: a loop that reads a command from registers, carries it out, and answers
//! in registers. It is not interpreted: it is recognised, and this is what it does. The numbers of the commands are those of
//! `ur_rtde` 1.6 (<https://gitlab.com/sdurobotics/ur_rtde>, MIT).

use super::arm::{pose, tool};
use super::command::{Command, Target};
use super::mover::{self, Mover};
use super::registers::Registers;
use ferry_core::control::limits::Limits;
use ferry_core::geometry::Isometry3;
use ferry_core::plant::TOOL_LENGTH_M;
use ferry_core::robot::{Joints, forward, ur5::SERVO_PERIOD_S};

/// In the script's first output register.
const READY: i32 = 1;
const DONE: i32 = 2;
/// A move that runs beside the loop, in the third output register.
const RUNS_BESIDE: i32 = 1 << 15;
const BESIDE_SHIFT: u32 = 24;
const BESIDE_NUMBERS: i32 = 128;

/// Commands that are repeated in each period, until the register says something else.
const REALTIME: [i32; 16] = [6, 9, 10, 11, 24, 25, 26, 27, 38, 58, 66, 67, 68, 69, 70, 71];

/// What the loop goes on with.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    Goes,
    /// The program ends, as asked.
    Ends,
    /// The program ends, because it cannot carry a command out.
    Refused {
        what: String,
        why: String,
    },
    ProtectiveStop,
}

/// The loop's state.
#[derive(Clone, Debug, Default)]
pub struct ControlScript {
    /// Its registers begin here.
    offset: usize,
    /// The command in the register has been carried out.
    is_executed: bool,
    /// The loop waits for the arm to rest.
    waits: bool,
    /// A move runs beside the loop.
    runs_beside: bool,
    beside_number: i32,
    /// Periods without a message until the program ends.
    watchdog_ticks: Option<u64>,
    /// The motion that was begun last.
    begun: Option<&'static str>,
}

impl ControlScript {
    /// Its state, if a program's text is this program.
    pub fn recognise(text: &str) -> Option<Self> {
        let is_it = text.starts_with("def rtde_control():") && text.contains("RTDE Control Script");
        // The client writes the number behind the comment, in the next line.
        let (_, behind) = text.split_once("# int register offset")?;
        let number: String = behind.trim_start().chars().take_while(char::is_ascii_digit).collect();
        let offset = number.parse().ok().filter(|offset| [0, 24].contains(offset))?;
        is_it.then(|| Self { offset, ..Self::default() })
    }

    /// URScript's name of the motion that was begun last.
    pub fn begun(&self) -> Option<&'static str> {
        self.begun
    }

    /// One period of the loop. `silent_ticks` is how long no client has written.
    pub fn cycle(
        &mut self,
        inputs: &Registers,
        outputs: &mut Registers,
        mover: &mut Mover,
        here_rad: &Joints,
        limits: &Limits,
        silent_ticks: u64,
    ) -> Next {
        if self.watchdog_ticks.is_some_and(|most| silent_ticks > most) {
            return Next::Refused { what: "watchdog".to_owned(), why: "the client is silent".to_owned() };
        }
        if self.runs_beside && !mover.is_busy() {
            self.runs_beside = false;
            self.tell_beside(outputs);
        }
        if self.waits {
            self.waits = mover.is_busy();
            if !self.waits {
                outputs.int[self.offset] = DONE;
            }
            return Next::Goes;
        }
        let number = inputs.int[self.offset];
        match number {
            0 => {
                self.is_executed = false;
                outputs.int[self.offset] = READY;
            }
            _ if REALTIME.contains(&number) => {
                let next = self.carry_out(number, inputs, outputs, mover, here_rad, limits);
                outputs.int[self.offset] = READY;
                return next;
            }
            _ if !self.is_executed => {
                self.is_executed = true;
                let next = self.carry_out(number, inputs, outputs, mover, here_rad, limits);
                if !self.waits && next == Next::Goes {
                    outputs.int[self.offset] = DONE;
                }
                return next;
            }
            _ => {}
        }
        Next::Goes
    }

    fn carry_out(
        &mut self,
        number: i32,
        inputs: &Registers,
        outputs: &mut Registers,
        mover: &mut Mover,
        here_rad: &Joints,
        limits: &Limits,
    ) -> Next {
        let double = self.offset;
        let first = inputs.six(double);
        let [speed, acceleration] = [6, 7].map(|i| inputs.double[double + i]);
        let is_beside = inputs.int[self.offset + 1] == 1;
        let motion = match number {
            1 => Command::MoveJ { to: Target::Joints(first), speed, acceleration },
            2 => Command::MoveJ { to: Target::Pose(first), speed, acceleration },
            3 => Command::MoveL { to: Target::Pose(first), speed, acceleration },
            4 => Command::MoveL { to: Target::Joints(first), speed, acceleration },
            // The script repeats them until they are stopped.
            9 => Command::SpeedJ { velocity: first, acceleration: speed, time_s: 0.0 },
            10 => Command::SpeedL { velocity: first, acceleration: speed, time_s: 0.0 },
            11 => Command::ServoJ { to: first, lookahead_s: inputs.double[double + 9] },
            15 | 16 | 34 => Command::StopJ { deceleration: first[0] },
            33 => Command::StopL { deceleration: first[0] },
            _ => return self.answer(number, inputs, outputs, mover, here_rad, limits),
        };
        let begun = motion.check().map_err(|error| error.to_string());
        if let Err(why) = begun.and_then(|()| mover.begin(&motion, here_rad).map_err(|error| error.to_string())) {
            return Next::Refused { what: motion.name().to_owned(), why };
        }
        self.begun = Some(motion.name());
        let may_run_beside = matches!(number, 1..=4 | 33 | 34);
        if may_run_beside && is_beside {
            self.runs_beside = true;
            self.beside_number = (self.beside_number + 1) % BESIDE_NUMBERS;
            self.tell_beside(outputs);
        } else {
            self.waits = !REALTIME.contains(&number);
        }
        Next::Goes
    }

    fn tell_beside(&self, outputs: &mut Registers) {
        let running = if self.runs_beside { RUNS_BESIDE } else { 0 };
        outputs.int[self.offset + 2] = (self.beside_number << BESIDE_SHIFT) | running;
    }

    /// Commands that move nothing.
    fn answer(
        &mut self,
        number: i32,
        inputs: &Registers,
        outputs: &mut Registers,
        mover: &Mover,
        here_rad: &Joints,
        limits: &Limits,
    ) -> Next {
        let (int, double) = (self.offset, self.offset);
        let [first, second] = [double, double + 6].map(|from| inputs.six(from));
        let refuse = |what: &str, why: String| Next::Refused { what: what.to_owned(), why };
        let inverse = |seed: &Joints| mover::joints_at_pose(&first, seed);
        match number {
            // The payload changes nothing here.
            17 => {}
            26 => outputs.double[double] = SERVO_PERIOD_S,
            30 | 46 => match inverse(if number == 30 { &second } else { here_rad }) {
                Ok(joints) => outputs.set_six(double, joints),
                Err(error) => return refuse("get_inverse_kin", error.to_string()),
            },
            31 => return Next::ProtectiveStop,
            35 => {
                let least_hz = first[0];
                if !(0.01..=125.0).contains(&least_hz) {
                    return refuse(
                        "rtde_set_watchdog",
                        format!("the frequency is {least_hz}, it must be .01 to 125 Hz"),
                    );
                }
                self.watchdog_ticks = Some((1.0 / (least_hz * SERVO_PERIOD_S)).ceil() as u64);
            }
            36 => {
                let is_safe = inverse(here_rad).is_ok_and(|joints| limits.joints(&joints, &joints).is_ok());
                outputs.int[int + 1] = i32::from(is_safe);
            }
            37 => outputs.int[int + 1] = i32::from(limits.joints(&first, &first).is_ok()),
            39 => {
                let [from, to] = [first, second].map(|numbers| mover::isometry(&numbers));
                outputs.set_six(double, pose(&(from * to)));
            }
            40 => outputs.set_six(double, [0.0, 0.0, TOOL_LENGTH_M, 0.0, 0.0, 0.0]),
            43 => outputs.set_six(double, pose(&tool(here_rad))),
            44 => outputs.set_six(double, pose(&(forward::flange(&first) * mover::isometry(&second)))),
            47 => outputs.int[int + 1] = i32::from(!mover.is_busy()),
            58 => {
                let flange: Isometry3<f64> = forward::flange(here_rad);
                outputs.set_six(double, pose(&flange));
            }
            255 => return Next::Ends,
            _ => return refuse(&format!("command {number}"), "Ferry does not carry it out".to_owned()),
        }
        Next::Goes
    }
}
