//! URScript as far as it is carried out: calls of these functions with literal arguments.
//!
//! `movej`, `movel`, `servoj`, `speedj`, `speedl`, `stopj`, `stopl`, `sleep`, `write_output_integer_register`, `set_tcp` with
//! Ferry's tool, `halt`, and functions without an effect; alone, or in a program between `def name():` or
//! `sec name():` and `end`. Names and defaults are those of "The URScript Programming Language", version 3.15.

mod reader;
#[cfg(test)]
mod tests;

pub use reader::Reader;

use winnow::ascii::{float, multispace0, space0, space1};
use winnow::combinator::{alt, delimited, opt, preceded, separated};
use winnow::prelude::*;
use winnow::token::take_while;

use super::command::{Command, Target};
use super::registers::REGISTERS;
use ferry_core::plant::TOOL_LENGTH_M;
use reader::Statements;

/// Longest program.
pub const PROGRAM_BYTES_MOST: usize = 256 << 10;
/// Longest line.
pub const LINE_BYTES_MOST: usize = 64 << 10;
/// Statements of a program that is carried out.
const STATEMENTS_MOST: usize = 10_000;
/// Longest name of a program.
const NAME_MOST: usize = 80;
/// How far the tool of `set_tcp` may be from Ferry's: m and rad.
const TOOL_DIFFERENCE_MOST: f64 = 1e-3;

/// Functions that change nothing here: Ferry has no other payload, gravity, signals, or people at a teach pendant.
const WITHOUT_EFFECT: [&str; 24] = [
    "popup",
    "set_analog_out",
    "set_analog_outputdomain",
    "set_configurable_digital_out",
    "set_digital_out",
    "set_gravity",
    "set_input_actions_to_default",
    "set_payload",
    "set_payload_cog",
    "set_payload_mass",
    "set_runstate_configurable_digital_output_to_value",
    "set_runstate_standard_analog_output_to_value",
    "set_runstate_standard_digital_output_to_value",
    "set_runstate_tool_digital_output_to_value",
    "set_safety_mode_transition_hardness",
    "set_standard_analog_input_domain",
    "set_standard_analog_out",
    "set_standard_digital_out",
    "set_target_payload",
    "set_tool_analog_input_domain",
    "set_tool_digital_out",
    "set_tool_voltage",
    "sync",
    "textmsg",
];

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    Motion(Command),
    Sleep {
        time_s: f64,
    },
    WriteInt {
        register: usize,
        value: i32,
    },
    /// By its name, without an effect.
    Nothing(&'static str),
    Halt,
}

/// Why a program is not carried out. Nothing of it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScriptError {
    #[error("line {line}: \"{text}\" is not one of the functions with literal arguments that Ferry carries out")]
    Unknown { line: usize, text: String },
    #[error("line {line}: {name}: {why}")]
    Argument { line: usize, name: String, why: String },
    #[error("line {line}: a bracket is not closed")]
    Bracket { line: usize },
    #[error("line {line}: the program's name has {characters} characters, the limit is {NAME_MOST}")]
    Name { line: usize, characters: usize },
    #[error("line {line}: a statement stands behind the program's end")]
    Behind { line: usize },
    #[error("the program has no end: the connection ended after {lines} lines of it")]
    Unfinished { lines: usize },
    #[error("the program has more than {STATEMENTS_MOST} statements")]
    Long,
    #[error("the program has more than {PROGRAM_BYTES_MOST} bytes, or a line of more than {LINE_BYTES_MOST}")]
    Large,
}

/// The name of a program, and what it does.
///
/// # Errors
/// [`ScriptError`] names the first statement that is not understood.
pub fn parse(text: &str) -> Result<(String, Vec<Line>), ScriptError> {
    let statements = Statements::of(text)?;
    let unknown = |&(line, ref statement): &(usize, String)| {
        let text = statement.chars().take(80).collect();
        ScriptError::Unknown { line, text }
    };
    let mut behind = None;
    let (name, body) = match statements.split_first() {
        Some(((line, statement), rest)) if head.parse(statement).is_ok() => {
            let name = head.parse(statement).unwrap_or_default();
            let characters = name.chars().count();
            if characters > NAME_MOST {
                return Err(ScriptError::Name { line: *line, characters });
            }
            let end = rest.iter().position(|(_, statement)| statement == "end").unwrap_or(rest.len());
            behind = rest.get(end + 1);
            (name, &rest[..end])
        }
        _ => ("a line", &statements[..]),
    };
    if body.len() > STATEMENTS_MOST {
        return Err(ScriptError::Long);
    }
    let line = |statement: &(usize, String)| {
        if statement.1 == "halt" {
            return Ok(Line::Halt);
        }
        let (function, arguments) = call.parse(&statement.1).map_err(|_| unknown(statement))?;
        let understood = Arguments { arguments: &arguments }.line(function);
        let understood =
            understood.map_err(|why| ScriptError::Argument { line: statement.0, name: function.to_owned(), why })?;
        understood.ok_or_else(|| unknown(statement))
    };
    let lines = body.iter().map(line).collect::<Result<_, _>>()?;
    match behind {
        Some((line, _)) => Err(ScriptError::Behind { line: *line }),
        None => Ok((name.to_owned(), lines)),
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Value<'a> {
    Number(f64),
    List(Vec<f64>),
    Pose(Vec<f64>),
    Text(&'a str),
    Truth(bool),
}

type Argument<'a> = (Option<&'a str>, Value<'a>);

fn name<'a>(input: &mut &'a str) -> ModalResult<&'a str> {
    take_while(1.., |c: char| c.is_ascii_alphanumeric() || c == '_').parse_next(input)
}

/// The name of a program, from its first statement.
fn head<'a>(input: &mut &'a str) -> ModalResult<&'a str> {
    let empty = ((space0, '(', space0), (')', space0, ':'));
    delimited((alt(("def", "sec")), space1), name, empty).parse_next(input)
}

fn comma(input: &mut &str) -> ModalResult<()> {
    (multispace0, ',', multispace0).void().parse_next(input)
}

/// Sums are allowed, because `ur_rtde` writes `0 +24`.
fn number(input: &mut &str) -> ModalResult<f64> {
    let parts: Vec<f64> = separated(1.., float::<_, f64, _>, (space0, '+', space0)).parse_next(input)?;
    Ok(parts.iter().sum())
}

fn list(input: &mut &str) -> ModalResult<Vec<f64>> {
    delimited(('[', multispace0), separated(0.., number, comma), (multispace0, ']')).parse_next(input)
}

fn value<'a>(input: &mut &'a str) -> ModalResult<Value<'a>> {
    alt((
        preceded('p', list).map(Value::Pose),
        list.map(Value::List),
        delimited('"', take_while(0.., |c: char| c != '"'), '"').map(Value::Text),
        delimited('\'', take_while(0.., |c: char| c != '\''), '\'').map(Value::Text),
        "True".value(Value::Truth(true)),
        "False".value(Value::Truth(false)),
        number.map(Value::Number),
    ))
    .parse_next(input)
}

fn argument<'a>(input: &mut &'a str) -> ModalResult<Argument<'a>> {
    (opt((name, space0, '=', space0).map(|(name, ..)| name)), value).parse_next(input)
}

fn call<'a>(input: &mut &'a str) -> ModalResult<(&'a str, Vec<Argument<'a>>)> {
    let arguments = delimited(('(', multispace0), separated(0.., argument, comma), (multispace0, ')'));
    (name, preceded(space0, arguments)).parse_next(input)
}

/// The arguments of a call, each by its place or its name.
struct Arguments<'a> {
    arguments: &'a [Argument<'a>],
}

impl Arguments<'_> {
    fn find(&self, place: usize, name: &str) -> Option<&Value<'_>> {
        let named = self.arguments.iter().find(|(given, _)| *given == Some(name));
        let placed = || self.arguments.get(place).filter(|(given, _)| given.is_none());
        named.or_else(placed).map(|(_, value)| value)
    }

    fn number(&self, place: usize, name: &str, default: f64) -> Result<f64, String> {
        match self.find(place, name) {
            None => Ok(default),
            Some(Value::Number(number)) => Ok(*number),
            Some(_) => Err(format!("{name} must be a number")),
        }
    }

    fn six(&self, name: &str) -> Result<Target, String> {
        let six = |values: &[f64]| <[f64; 6]>::try_from(values).map_err(|_| format!("{name} must have six numbers"));
        match self.find(0, name) {
            Some(Value::List(values)) => Ok(Target::Joints(six(values)?)),
            Some(Value::Pose(values)) => Ok(Target::Pose(six(values)?)),
            _ => Err(format!("{name} is missing; it must be a list of six numbers, or a pose")),
        }
    }

    fn list(&self, name: &str) -> Result<[f64; 6], String> {
        match self.six(name)? {
            Target::Joints(values) => Ok(values),
            Target::Pose(_) => Err(format!("{name} is a pose, it must be a list")),
        }
    }

    /// Without names that the function does not have, a blend radius, or a duration, which Ferry does not carry out.
    fn only(&self, names: &[&str]) -> Result<(), String> {
        for (place, (given, value)) in self.arguments.iter().enumerate() {
            let known = given.or_else(|| names.get(place).copied());
            let Some(known) = known.filter(|known| names.contains(known)) else {
                return Err(format!("argument {} is not known", place + 1));
            };
            if known == "r" && *value != Value::Number(0.0) {
                return Err("a blend radius r is not carried out".to_owned());
            }
        }
        Ok(())
    }

    /// `None` for an unknown function.
    fn line(&self, function: &str) -> Result<Option<Line>, String> {
        let motion = |command: Command| match command.check() {
            Ok(()) => Ok(Some(Line::Motion(command))),
            Err(error) => Err(error.to_string()),
        };
        match function {
            "movej" | "movel" => {
                self.only(&["to", "a", "v", "t", "r", "q", "pose"])?;
                if self.number(3, "t", 0.0)? != 0.0 {
                    return Err("a duration t is not carried out; use v".to_owned());
                }
                let is_q = self.arguments.iter().any(|(given, _)| *given == Some("q"));
                let to = self.six(if is_q { "q" } else { "pose" })?;
                if function == "movej" {
                    let [acceleration, speed] = [self.number(1, "a", 1.4)?, self.number(2, "v", 1.05)?];
                    return motion(Command::MoveJ { to, speed, acceleration });
                }
                let [acceleration, speed] = [self.number(1, "a", 1.2)?, self.number(2, "v", 0.25)?];
                motion(Command::MoveL { to, speed, acceleration })
            }
            "speedl" | "speedj" => {
                let (velocity_name, default) = if function == "speedl" { ("xd", 1.2) } else { ("qd", 1.4) };
                self.only(&[velocity_name, "a", "t"])?;
                let velocity = self.list(velocity_name)?;
                let [acceleration, time_s] = [self.number(1, "a", default)?, self.number(2, "t", 0.0)?];
                motion(match function {
                    "speedl" => Command::SpeedL { velocity, acceleration, time_s },
                    _ => Command::SpeedJ { velocity, acceleration, time_s },
                })
            }
            "servoj" => {
                self.only(&["q", "a", "v", "t", "lookahead_time", "gain"])?;
                motion(Command::ServoJ { to: self.list("q")?, lookahead_s: self.number(4, "lookahead_time", 0.1)? })
            }
            "stopl" | "stopj" => {
                self.only(&["a"])?;
                let deceleration = self.number(0, "a", 2.0)?;
                motion(if function == "stopl" {
                    Command::StopL { deceleration }
                } else {
                    Command::StopJ { deceleration }
                })
            }
            "sleep" => {
                let time_s = self.number(0, "t", f64::NAN)?;
                if !(0.0..=3600.0).contains(&time_s) {
                    return Err(format!("t is {time_s}, it must be 0 to 3600"));
                }
                Ok(Some(Line::Sleep { time_s }))
            }
            "write_output_integer_register" => {
                let [register, value] = [self.number(0, "port_number", -1.0)?, self.number(1, "signal_value", 0.0)?];
                if !(0.0..REGISTERS as f64).contains(&register) || value.abs() > f64::from(i32::MAX) {
                    return Err(format!("register {register} cannot be set to {value}"));
                }
                Ok(Some(Line::WriteInt { register: register as usize, value: value as i32 }))
            }
            "set_tcp" => {
                let Target::Pose(pose) = self.six("pose")? else {
                    return Err("pose is a list, it must be a pose".to_owned());
                };
                let tool = [0.0, 0.0, TOOL_LENGTH_M, 0.0, 0.0, 0.0];
                match pose.iter().zip(tool).all(|(one, own)| (one - own).abs() <= TOOL_DIFFERENCE_MOST) {
                    true => Ok(Some(Line::Nothing("set_tcp"))),
                    false => Err(format!(
                        "pose is p{pose:?}, Ferry's tool is p{tool:?}; leave it out, and command that tool"
                    )),
                }
            }
            "popup" if self.find(4, "blocking") == Some(&Value::Truth(true)) => {
                Err("blocking is True, and nothing closes it here".to_owned())
            }
            "halt" if self.arguments.is_empty() => Ok(Some(Line::Halt)),
            _ => Ok(WITHOUT_EFFECT.iter().find(|name| **name == function).map(|name| Line::Nothing(name))),
        }
    }
}
