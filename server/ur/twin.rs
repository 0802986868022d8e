//! A robot outside of Ferry and its twin, the simulated arm: what the robot reports, and whether it follows Ferry's
//! controllers. Shared by the session, the page's connections and the robot's. Nothing here reads a clock.

mod doubt;
mod facts;
mod state;
#[cfg(test)]
mod tests;

use std::net::IpAddr;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use tokio::sync::watch;
use ts_rs::TS;
use utoipa::ToSchema;

use super::drive_script::OVER;
use super::news::{Item, News};
use super::peer::Report;
use doubt::{Apart, Doubt};
pub use facts::{ApartFact, DoubtFact, DriveFact, TwinTrouble};
use ferry_core::facts::Told;
use ferry_core::plant::PositionerKind;
use ferry_core::robot::Joints;
use ferry_core::trial::{Input, Trial};
use state::{Drive, State, check_modes};

/// A robot that reports nothing for this long no longer follows, nor does one whose program does not go on.
pub const SILENCE: Duration = Duration::from_millis(100);
/// The page repeats several times in this period that its button is held.
pub const HOLD: Duration = Duration::from_millis(250);
/// In which a robot must begin Ferry's program.
const START_WITHIN: Duration = Duration::from_secs(3);
/// Largest difference between a joint and where it should be.
const BEHIND_MOST_RAD: f64 = 0.2;
/// Values of `robot_mode`, `safety_mode` and `runtime_state`.
const RUNNING: i32 = 7;
const NORMAL: i32 = 1;
const REDUCED: i32 = 2;
const PLAYING: u32 = 2;

/// Why the robot does not follow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DriveError {
    #[error("motion is not enabled; start Ferry with --enable-motion")]
    NotEnabled,
    #[error("the robot is not connected")]
    NotConnected,
    #[error("robot_mode is {0}, it must be {RUNNING} (running)")]
    Mode(i32),
    #[error("safety_mode is {0}, it must be {NORMAL} (normal) or {REDUCED} (reduced)")]
    Safety(i32),
    #[error("another program runs on the robot; stop it first")]
    Busy,
    #[error("the arm is not where Ferry may move it: {0}")]
    Place(String),
    #[error("it is not a UR5: its flange is at {0}; the limits are 20 mm and 4°")]
    OtherArm(Box<Apart>),
    #[error("the map has a planar stage and no arm")]
    NoArm,
    #[error("the robot has not begun Ferry's program within {} s", START_WITHIN.as_secs())]
    NotBegun,
    #[error("Ferry's program could not be sent: {0}")]
    NotSent(String),
    #[error("nothing was heard from the robot for {} ms", SILENCE.as_millis())]
    Silent,
    #[error("the robot has ended Ferry's program")]
    Over,
    #[error("joint {joint} is {behind_rad:.3} rad from where it should be; the limit is {BEHIND_MOST_RAD} rad")]
    Behind { joint: usize, behind_rad: f64 },
    #[error("a limit would be violated: {0}")]
    Limit(String),
    #[error("the session refuses what the robot reports: {0}")]
    Refused(String),
    #[error("the session was paused, set back or changed")]
    Changed,
    #[error("the page's button is no longer held")]
    Released,
}

/// What is sent to the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    /// The period of the robot's program that it answers; 0 when the robot must not follow.
    pub period: i32,
    pub joints_rad: Joints,
    /// Counts how often the program must be sent.
    pub programs: u32,
}

/// A robot outside of Ferry (`ferry drive`), whose arm the simulated one mirrors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct TwinStanding {
    #[ts(type = "string")]
    #[schema(value_type = String)]
    pub address: IpAddr,
    /// Whether Ferry may move it (`--enable-motion`).
    pub allows_motion: bool,
    /// Why it is not connected; `null` if it is.
    pub trouble: Option<Told<TwinTrouble>>,
    /// What its dashboard says that it is; `null` if it does not say.
    pub model: Option<String>,
    /// Why places on the table may be others than Ferry's; `null` if there is no reason to think so.
    pub doubt: Option<Told<DoubtFact>>,
    /// As it reports it: 7 while it runs.
    pub robot_mode: i32,
    /// As it reports it: 1 normal, 2 reduced, 3 protective stop.
    pub safety_mode: i32,
    /// Whether the button is held and the robot begins to follow, or follows.
    pub is_held: bool,
    /// Whether it follows Ferry's controllers.
    pub is_driven: bool,
    /// Why it does not follow, or no longer.
    pub stopped: Option<Told<DriveFact>>,
}

#[derive(Debug)]
pub struct Twin {
    address: IpAddr,
    allows_motion: bool,
    state: Mutex<State>,
    answer: watch::Sender<Answer>,
}

impl Twin {
    pub fn new(address: IpAddr, allows_motion: bool) -> Self {
        let state = State {
            trouble: Some(TwinTrouble::NotYet),
            model: None,
            heard: None,
            is_proven: false,
            doubt: None,
            held_until: None,
            press: None,
            spent: None,
            drive: Drive::Rests,
            stopped: None,
            is_new: false,
            news: News::default(),
        };
        Self { address, allows_motion, state: Mutex::new(state), answer: watch::Sender::default() }
    }

    pub fn address(&self) -> IpAddr {
        self.address
    }

    pub fn allows_motion(&self) -> bool {
        self.allows_motion
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is to be sent, and a signal at each newer answer.
    pub fn answers(&self) -> watch::Receiver<Answer> {
        self.answer.subscribe()
    }

    pub fn standing(&self) -> TwinStanding {
        let state = self.state();
        let report = state.heard.map(|(report, _)| report).unwrap_or_default();
        TwinStanding {
            address: self.address,
            allows_motion: self.allows_motion,
            trouble: state.trouble.clone().map(Told::from),
            model: state.model.clone(),
            doubt: state.doubt.as_ref().map(Told::of),
            robot_mode: report.robot_mode,
            safety_mode: report.safety_mode,
            is_held: state.drive != Drive::Rests,
            is_driven: matches!(state.drive, Drive::Follows { .. }),
            stopped: state.stopped.as_ref().map(Told::of),
        }
    }

    /// What has happened since the last call.
    pub fn take_news(&self) -> Vec<Item> {
        self.state().news.take()
    }

    /// The connection exists, or why it does not.
    pub fn connected(&self, outcome: Result<(), String>) {
        let mut state = self.state();
        let trouble = outcome.err().map(|detail| TwinTrouble::Failed { detail });
        match &trouble {
            _ if trouble == state.trouble => return,
            None => state.news.tell(format!("{} is connected", self.address)),
            Some(why) => state.news.refuse(format!("{} is not connected: {why}", self.address)),
        }
        state.is_new = trouble.is_none();
        (state.is_proven, state.doubt) = (false, None);
        state.trouble = trouble;
        if state.trouble.is_some() {
            self.stop(&mut state, DriveError::NotConnected);
        }
    }

    /// What the dashboard says that the robot is.
    pub fn found_model(&self, model: Option<String>) {
        self.state().model = model;
    }

    /// The robot has reported.
    pub fn hear(&self, report: Report, now: Instant) {
        let mut state = self.state();
        state.heard = Some((report, now));
        match state.drive {
            // Ferry's program of before may still stop the arm.
            Drive::Clears { since, is_checked: true } if report.answered == 0 && report.runtime_state != PLAYING => {
                state.drive = Drive::Begins { since, before: report.period };
                self.answer.send_modify(|answer| answer.programs += 1);
            }
            Drive::Begins { before, .. } if report.period > 0 && report.period != before => {
                if let Err(why) = state.compare(&report) {
                    return self.stop(&mut state, why);
                }
                let (sent_rad, period) = (report.joints_rad, report.period);
                state.drive = Drive::Follows { sent_rad, period, period_at: now };
                state.news.tell("the arm follows Ferry's controllers".to_owned());
            }
            Drive::Follows { sent_rad, period, .. } if report.period != period => {
                if report.period != OVER
                    && let Err(why) = state.compare(&report)
                {
                    return self.stop(&mut state, why);
                }
                state.drive = Drive::Follows { sent_rad, period: report.period, period_at: now };
            }
            Drive::Rests if !state.is_proven => {
                // What is set now counts.
                let doubt = Doubt::of_tool(&report);
                if doubt.is_none() {
                    state.doubt = None;
                }
                state.note(doubt);
            }
            _ => {}
        }
        self.review(&mut state, now);
    }

    /// The page's button is held, in a press that has this number, or is not. A press whose motion has ended moves nothing
    /// again.
    ///
    /// # Errors
    /// Why the robot cannot follow, once in each press.
    pub fn hold(&self, press: Option<u32>, now: Instant) -> Result<(), DriveError> {
        let mut state = self.state();
        self.review(&mut state, now);
        if press.is_none() || state.press.is_some_and(|held| Some(held) != press) {
            self.stop(&mut state, DriveError::Released);
        }
        (state.press, state.held_until) = (press, press.map(|_| now + HOLD));
        if press.is_none() || press == state.spent || state.drive != Drive::Rests {
            return Ok(());
        }
        if let Err(error) = self.check(&state, now) {
            state.spent = press;
            state.stopped = Some(error.clone());
            return Err(error);
        }
        state.stopped = None;
        state.drive = Drive::Clears { since: now, is_checked: false };
        let joints_rad = state.heard.map(|(report, _)| report.joints_rad).unwrap_or_default();
        self.answer.send_modify(|answer| (answer.period, answer.joints_rad) = (0, joints_rad));
        Ok(())
    }

    fn check(&self, state: &State, now: Instant) -> Result<(), DriveError> {
        if !self.allows_motion {
            return Err(DriveError::NotEnabled);
        }
        let Some((report, at)) = state.heard.filter(|_| state.trouble.is_none()) else {
            return Err(DriveError::NotConnected);
        };
        if now.saturating_duration_since(at) > SILENCE {
            return Err(DriveError::Silent);
        }
        check_modes(&report)?;
        // A period is that of Ferry's own program.
        if report.runtime_state == PLAYING && report.period <= 0 { Err(DriveError::Busy) } else { Ok(()) }
    }

    /// The robot no longer follows, because the session is no longer what it was.
    pub fn let_go(&self) {
        self.stop(&mut self.state(), DriveError::Changed);
    }

    /// The trial has refused what the robot reported.
    pub fn refuse(&self, why: String) {
        self.stop(&mut self.state(), DriveError::Refused(why));
    }

    /// The program could not be sent.
    pub fn not_sent(&self, why: String) {
        self.stop(&mut self.state(), DriveError::NotSent(why));
    }

    /// Whether the session must run, at real speed: once after each connection, and while the robot is to follow.
    pub fn wants_to_run(&self) -> bool {
        let mut state = self.state();
        std::mem::take(&mut state.is_new) || state.drive != Drive::Rests
    }

    fn stop(&self, state: &mut State, why: DriveError) {
        if state.drive == Drive::Rests {
            return;
        }
        (state.drive, state.spent) = (Drive::Rests, state.press);
        let is_released = why == DriveError::Released;
        state.news.push(Item { is_refused: !is_released, text: format!("the arm no longer follows: {why}") });
        state.stopped = (!is_released).then_some(why);
        self.answer.send_modify(|answer| answer.period = 0);
    }

    /// Stops if anything is no longer as it must be.
    fn review(&self, state: &mut State, now: Instant) {
        if state.held_until.is_some_and(|until| until < now) {
            self.stop(state, DriveError::Released);
            (state.held_until, state.press) = (None, None);
        }
        if let Err(why) = state.check_drive(now) {
            self.stop(state, why);
        }
    }

    /// Where the arm is at the next tick; the session asks before each. Until the robot has reported, the arm rests.
    pub fn next(&self, trial: &Trial, now: Instant) -> Option<Input> {
        let mut state = self.state();
        self.review(&mut state, now);
        let world = &trial.state().world;
        if world.reference.kind() != PositionerKind::Arm {
            self.stop(&mut state, DriveError::NoArm);
            return None;
        }
        let limits = trial.arena().limits(&world.parameters);
        if let (Drive::Clears { since, .. }, Some((report, _))) = (state.drive, state.heard) {
            match limits.joints(&report.joints_rad, &report.joints_rad) {
                Ok(()) => state.drive = Drive::Clears { since, is_checked: true },
                Err(error) => self.stop(&mut state, DriveError::Place(error.to_string())),
            }
        }
        let joints_rad = match state.heard {
            Some((report, _)) => report.joints_rad,
            None => world.plant.positioner.joints_rad()?,
        };
        Some(Input::Mirror { joints_rad, is_driven: matches!(state.drive, Drive::Follows { .. }) })
    }

    /// The session has made a tick: what its controllers want goes to the robot, within the limits.
    pub fn follow(&self, trial: &Trial) {
        let mut state = self.state();
        let world = &trial.state().world;
        let is_driven = world.plant.mirror.is_some_and(|mirror| mirror.is_driven);
        let (true, Drive::Follows { sent_rad, period, period_at }) = (is_driven, state.drive) else { return };
        let (Some(target_rad), Some((report, _))) = (world.reference.joints_rad(), state.heard) else { return };
        let limits = trial.arena().limits(&world.parameters);
        let behind = |joint: &usize| (target_rad[*joint] - report.joints_rad[*joint]).abs() > BEHIND_MOST_RAD;
        if let Some(joint) = (0..6).find(behind) {
            let behind_rad = (target_rad[joint] - report.joints_rad[joint]).abs();
            return self.stop(&mut state, DriveError::Behind { joint, behind_rad });
        }
        if let Err(error) = limits.joints(&sent_rad, &target_rad) {
            return self.stop(&mut state, DriveError::Limit(error.to_string()));
        }
        state.drive = Drive::Follows { sent_rad: target_rad, period, period_at };
        self.answer.send_modify(|answer| (answer.period, answer.joints_rad) = (period, target_rad));
    }
}
