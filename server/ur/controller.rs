//! The controller's memory: who is connected, registers, the program that runs, and the protective stop.

mod facts;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::command::Command;
use super::control_script::{ControlScript, Next};
use super::drive_script::DriveScript;
use super::inputs::Input;
use super::model::Model;
use super::mover::Mover;
use super::news::{Item, News};
use super::refusals::{Refusals, Refused};
use super::registers::Registers;
use super::script::{self, Line, ScriptError};
pub use facts::Stop;
use ferry_core::control::limits::Limits;
use ferry_core::facts::Told;
use ferry_core::robot::{Joints, ur5::SERVO_PERIOD_S};

/// Values of `safety_mode`.
const NORMAL: i32 = 1;
const PROTECTIVE_STOP: i32 = 3;

/// Tells the clients of a controller apart.
pub type ClientId = u64;

/// A connection.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = RobotClient)]
#[ts(rename = "RobotClient")]
pub struct Connected {
    #[serde(skip)]
    pub id: ClientId,
    /// Address and port.
    pub from: String,
    /// `dashboard`, `URScript` or `RTDE`.
    pub speech: String,
}

/// Who is connected to the robot server, what moves the arm, and what was refused.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = RobotStanding)]
#[ts(rename = "RobotStanding")]
pub struct Standing {
    pub clients: Vec<Connected>,
    /// The program that runs.
    pub program: Option<String>,
    /// URScript's name of the motion, while there is one.
    pub command: Option<String>,
    /// Why the arm is in a protective stop.
    pub stop: Option<Told<Stop>>,
    /// Newest last, at most 20.
    pub refused: Vec<Refused>,
}

/// Why a program does not begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    #[error(transparent)]
    Script(#[from] ScriptError),
    #[error("the session has a planar stage and no arm")]
    NoArm,
    #[error("the arm is in a protective stop: {0}")]
    Stopped(Stop),
}

#[derive(Clone, Debug)]
enum Program {
    Control(ControlScript),
    Drive(DriveScript),
    Lines { lines: VecDeque<Line>, wait_ticks: u64 },
}

impl Program {
    /// The functions in it that change nothing, each once, except those that never do.
    fn without_effect(&self) -> Vec<&'static str> {
        let Self::Lines { lines, .. } = self else { return Vec::new() };
        let mut names = Vec::new();
        for line in lines {
            match line {
                Line::Nothing(name) if !["set_tcp", "sync", "textmsg"].contains(name) && !names.contains(name) => {
                    names.push(*name);
                }
                _ => {}
            }
        }
        names
    }
}

#[derive(Clone, Debug)]
struct Running {
    name: String,
    program: Program,
    /// The session has given it the arm.
    has_arm: bool,
    /// The session has been asked.
    has_asked: bool,
}

#[derive(Clone, Debug, Default)]
pub struct Controller {
    model: Model,
    clients: Vec<Connected>,
    clients_made: ClientId,
    inputs: Registers,
    outputs: Registers,
    /// Who may write an input.
    claims: Vec<(Input, ClientId)>,
    running: Option<Running>,
    mover: Mover,
    command: Option<&'static str>,
    stop: Option<Stop>,
    refusals: Refusals,
    news: News,
    /// The last tick that was asked for, and how long no client has written.
    tick: u64,
    silent_ticks: u64,
}

impl Controller {
    pub fn connect(&mut self, from: String, speech: &str) -> ClientId {
        self.clients_made += 1;
        self.clients.push(Connected { id: self.clients_made, from, speech: speech.to_owned() });
        self.clients_made
    }

    /// A client that leaves takes its inputs along: a program that it commands ends.
    pub fn disconnect(&mut self, id: ClientId) {
        self.clients.retain(|client| client.id != id);
        let had = self.claims.len();
        self.claims.retain(|(_, owner)| *owner != id);
        let commands = |running: &Running| matches!(running.program, Program::Control(_));
        if self.claims.len() < had && self.running.as_ref().is_some_and(commands) {
            self.end("its client has disconnected");
        }
    }

    pub fn model(&self) -> &Model {
        &self.model
    }

    pub fn set_model(&mut self, model: Model) {
        self.model = model;
    }

    pub fn standing(&self) -> Standing {
        Standing {
            clients: self.clients.clone(),
            program: self.running.as_ref().map(|running| running.name.clone()),
            command: self.command.filter(|_| self.mover.is_busy()).map(str::to_owned),
            stop: self.stop.clone().map(Told::from),
            refused: self.refusals.since(0).cloned().collect(),
        }
    }

    pub fn inputs(&self) -> &Registers {
        &self.inputs
    }

    pub fn outputs(&self) -> &Registers {
        &self.outputs
    }

    pub fn speed_fraction(&self) -> f64 {
        self.inputs.fraction()
    }

    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    pub fn program_name(&self) -> Option<&str> {
        self.running.as_ref().map(|running| running.name.as_str())
    }

    /// Whether the arm is in a protective stop.
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some()
    }

    pub fn safety_mode(&self) -> i32 {
        if self.is_stopped() { PROTECTIVE_STOP } else { NORMAL }
    }

    /// Claims an input for a client; false if another one has it.
    pub fn claim(&mut self, input: Input, id: ClientId) -> bool {
        match self.claims.iter().find(|(claimed, _)| *claimed == input) {
            Some((_, owner)) => *owner == id,
            None => {
                self.claims.push((input, id));
                true
            }
        }
    }

    /// Writes inputs from a payload that is long enough.
    pub fn write(&mut self, inputs: &[Input], payload: &mut &[u8]) {
        self.silent_ticks = 0;
        inputs.iter().for_each(|input| input.read(payload, &mut self.inputs));
    }

    /// Begins a program; the one before ends.
    ///
    /// # Errors
    /// [`LoadError`]; nothing has changed, except that the refusal is noted.
    pub fn load(&mut self, text: &str, has_joints: bool) -> Result<(), LoadError> {
        let understood = self.understand(text, has_joints);
        if let Err(error) = &understood {
            self.note("a program", &error.to_string());
        }
        let (name, program) = understood?;
        self.mover.rest();
        self.outputs.int = Registers::default().int;
        self.silent_ticks = 0;
        self.news.tell(match program.without_effect()[..] {
            [] => format!("the program {name} begins"),
            ref names => format!("the program {name} begins; without an effect here: {}", names.join(", ")),
        });
        self.running = Some(Running { name, program, has_arm: false, has_asked: false });
        Ok(())
    }

    fn understand(&self, text: &str, has_joints: bool) -> Result<(String, Program), LoadError> {
        if !has_joints {
            return Err(LoadError::NoArm);
        }
        if let Some(stop) = &self.stop {
            return Err(LoadError::Stopped(stop.clone()));
        }
        if let Some(script) = ControlScript::recognise(text) {
            return Ok(("rtde_control".to_owned(), Program::Control(script)));
        }
        if let Some(script) = DriveScript::recognise(text) {
            return Ok(("ferry_drive".to_owned(), Program::Drive(script)));
        }
        let (name, lines) = script::parse(text)?;
        Ok((name, Program::Lines { lines: lines.into(), wait_ticks: 0 }))
    }

    /// Ends the program; the arm comes to rest.
    pub fn end(&mut self, why: &str) {
        if let Some(running) = self.running.take() {
            self.news.tell(format!("the program {} ends: {why}", running.name));
        }
        self.mover.rest();
    }

    /// What has happened since the last call.
    pub fn take_news(&mut self) -> Vec<Item> {
        self.news.take()
    }

    /// Whether a program waits for the arm.
    pub fn wants_arm(&self) -> bool {
        self.running.as_ref().is_some_and(|running| !running.has_arm && !running.has_asked)
    }

    /// The session gives it the arm now.
    pub fn give_arm(&mut self) {
        if let Some(running) = &mut self.running {
            running.has_asked = true;
        }
    }

    /// Ends the program, because it cannot go on.
    pub fn refuse(&mut self, what: &str, why: &str) {
        self.note(what, why);
        self.end(why);
    }

    fn note(&mut self, what: &str, why: &str) {
        self.news.refuse(format!("{what}: {why}"));
        self.refusals.push(Refused { tick: self.tick, what: what.to_owned(), why: why.to_owned() });
    }

    pub fn refusals(&self) -> &Refusals {
        &self.refusals
    }

    /// A program that cannot be read does not begin.
    pub fn refuse_program(&mut self, error: &ScriptError) {
        self.note("a program", &error.to_string());
    }

    /// A limit is violated: the arm stands still at once.
    fn stop_at_once(&mut self, what: &str, why: Stop) {
        let text = why.to_string();
        self.note(what, &text);
        self.end(&text);
        self.mover.clear();
        self.stop = Some(why);
    }

    /// What the program wanted was refused.
    pub fn violate(&mut self, why: &str) {
        self.stop_at_once(self.command.unwrap_or("motion"), Stop::refused(why));
    }

    /// Leaves the protective stop; false if there was none.
    pub fn unlock(&mut self) -> bool {
        self.stop.take().is_some()
    }

    /// The joints for a tick, if a program moves the arm. `is_ours` is whether the session has given it the arm.
    pub fn next(&mut self, tick: u64, is_ours: bool, here_rad: Option<&Joints>, limits: &Limits) -> Option<Joints> {
        let has_jumped = tick != self.tick + 1 && tick != self.tick;
        self.tick = tick;
        self.silent_ticks += 1;
        if let Some(running) = &mut self.running {
            match (running.has_arm, is_ours) {
                (true, _) if has_jumped => self.end("the session was set back"),
                (true, false) => self.end("the operator has taken the arm"),
                (false, true) => running.has_arm = true,
                _ => {}
            }
        }
        let here_rad = here_rad.filter(|_| is_ours)?;
        if has_jumped {
            self.mover.clear();
        }
        self.go_on(here_rad, limits);
        match self.mover.next(here_rad, limits.tool_speed_m_s(), self.inputs.fraction()) {
            Ok(joints) => joints,
            Err(error) => {
                self.stop_at_once(self.command.unwrap_or("motion"), Stop::refused(error));
                None
            }
        }
    }

    /// One period of the program.
    fn go_on(&mut self, here_rad: &Joints, limits: &Limits) {
        let Some(running) = self.running.as_mut().filter(|running| running.has_arm) else { return };
        match &mut running.program {
            Program::Control(script) => {
                let Self { inputs, outputs, mover, silent_ticks, .. } = self;
                let next = script.cycle(inputs, outputs, mover, here_rad, limits, *silent_ticks);
                if let Some(name) = script.begun() {
                    self.command = Some(name);
                }
                self.carry_on(next);
            }
            Program::Drive(script) => {
                let Self { model, inputs, outputs, mover, .. } = self;
                let (next, begun) = script.cycle(model, inputs, outputs, mover, here_rad);
                self.command = begun.or(self.command);
                self.carry_on(next);
            }
            Program::Lines { wait_ticks, .. } if *wait_ticks > 0 => *wait_ticks -= 1,
            Program::Lines { lines, wait_ticks } => {
                // A velocity without a time, or a servo target, goes on while the next lines are read.
                if self.mover.is_busy() && !self.mover.goes_on() {
                    return;
                }
                match lines.pop_front() {
                    None => self.end("it is over"),
                    Some(Line::Nothing(_)) => {}
                    Some(Line::Halt) => self.end("it halts"),
                    Some(Line::Sleep { time_s }) => *wait_ticks = (time_s / SERVO_PERIOD_S).round() as u64,
                    Some(Line::WriteInt { register, value }) => self.outputs.int[register] = value,
                    Some(Line::Motion(command)) => self.begin(&command, here_rad),
                }
            }
        }
    }

    fn carry_on(&mut self, next: Next) {
        match next {
            Next::Goes => {}
            Next::Ends => self.end("as asked"),
            Next::Refused { what, why } => self.refuse(&what, &why),
            Next::ProtectiveStop => self.stop_at_once("protective_stop", Stop::Requested),
        }
    }

    fn begin(&mut self, command: &Command, here_rad: &Joints) {
        self.command = Some(command.name());
        if let Err(error) = self.mover.begin(command, here_rad) {
            self.refuse(command.name(), &error.to_string());
        }
    }
}
