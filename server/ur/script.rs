//! URScript as far as it is carried out: lines of these functions with literal arguments.
//!
//! `movej`, `movel`, `servoj`, `speedj`, `speedl`, `stopj`, `stopl`, `sleep`, `sync`, `textmsg` and
//! `write_output_integer_register`; alone, or in a program between `def name():` and `end`. Names and defaults are those of
//! "The URScript Programming Language", version 3.15.

use winnow::ascii::{float, multispace0, space0};
use winnow::combinator::{alt, delimited, opt, preceded, separated};
use winnow::prelude::*;
use winnow::token::take_while;

use super::command::{Command, Target};
use super::registers::REGISTERS;

/// Longest program.
pub const PROGRAM_BYTES_MOST: usize = 256 << 10;
/// Longest line.
pub const LINE_BYTES_MOST: usize = 64 << 10;
/// Lines of a program that is carried out.
const LINES_MOST: usize = 10_000;

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
    /// Without an effect.
    Nothing,
}

/// Why a program is not carried out. Nothing of it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ScriptError {
    #[error("line {line}: \"{text}\" is not one of the functions with literal arguments that Ferry carries out")]
    Unknown { line: usize, text: String },
    #[error("line {line}: {name}: {why}")]
    Argument { line: usize, name: String, why: String },
    #[error("the program has more than {LINES_MOST} lines")]
    Long,
    #[error("the program has more than {PROGRAM_BYTES_MOST} bytes")]
    Large,
}

/// Puts lines together to programs.
#[derive(Debug, Default)]
pub struct Reader {
    /// A program that has begun.
    text: Option<String>,
}

impl Reader {
    /// Takes a line; returns a program, or a line alone, when it is complete.
    ///
    /// # Errors
    /// The program is too large.
    pub fn take(&mut self, line: &str) -> Result<Option<String>, ScriptError> {
        let is_begin = line.starts_with("def ") || line.starts_with("sec ");
        let Some(text) = &mut self.text else {
            if is_begin {
                self.text = Some(format!("{line}\n"));
                return Ok(None);
            }
            return Ok((!is_empty(line)).then(|| line.to_owned()));
        };
        if text.len() + line.len() > PROGRAM_BYTES_MOST {
            return Err(ScriptError::Large);
        }
        text.push_str(line);
        text.push('\n');
        // The end of the program begins its line; ends of blocks are indented.
        Ok(if line.trim_end() == "end" { self.text.take() } else { None })
    }
}

fn is_empty(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

/// The name of a program, and its lines.
///
/// # Errors
/// [`ScriptError`] names the first line that is not understood.
pub fn parse(text: &str) -> Result<(String, Vec<Line>), ScriptError> {
    let mut lines = Vec::new();
    let mut name = None;
    for (number, line) in text.lines().enumerate() {
        let is_last = line.trim_end() == "end" && name.is_some();
        if is_empty(line) || is_last {
            continue;
        }
        if let (0, Some(head)) = (number, line.strip_prefix("def ")) {
            name = Some(head.trim_end().trim_end_matches("():").to_owned());
            continue;
        }
        if lines.len() >= LINES_MOST {
            return Err(ScriptError::Long);
        }
        let statement = line.trim();
        let number = number + 1;
        let Ok((function, arguments)) = call.parse(statement) else {
            let text = statement.chars().take(80).collect();
            return Err(ScriptError::Unknown { line: number, text });
        };
        let parsed = Arguments { arguments: &arguments }.line(function);
        let why = |why| ScriptError::Argument { line: number, name: function.to_owned(), why };
        match parsed {
            Ok(Some(line)) => lines.push(line),
            Ok(None) => {
                let text = statement.chars().take(80).collect();
                return Err(ScriptError::Unknown { line: number, text });
            }
            Err(error) => return Err(why(error)),
        }
    }
    Ok((name.unwrap_or_else(|| "a line".to_owned()), lines))
}

#[derive(Clone, Debug, PartialEq)]
enum Value<'a> {
    Number(f64),
    List(Vec<f64>),
    Pose(Vec<f64>),
    Text(&'a str),
}

type Argument<'a> = (Option<&'a str>, Value<'a>);

fn name<'a>(input: &mut &'a str) -> ModalResult<&'a str> {
    take_while(1.., |c: char| c.is_ascii_alphanumeric() || c == '_').parse_next(input)
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
            "sync" | "textmsg" => Ok(Some(Line::Nothing)),
            _ => Ok(None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one(text: &str) -> Line {
        let (_, lines) = parse(text).unwrap();
        assert_eq!(lines.len(), 1, "{text}");
        lines[0].clone()
    }

    fn refused(text: &str) -> String {
        parse(text).unwrap_err().to_string()
    }

    #[test]
    fn lines_with_literal_arguments_are_understood() {
        let pose = [0.1, -0.4, 0.1, 2.182, -2.182, 0.0];
        let to = Command::MoveL { to: Target::Pose(pose), speed: 0.04, acceleration: 1.2 };
        assert_eq!(one("movel(p[0.1,-0.4,0.1,2.182,-2.182,0], a=1.2, v=.04)"), Line::Motion(to));
        assert_eq!(one("  movel( p[ 0.1 , -0.4, 0.1, 2.182, -2.182, 0 ], 1.2, 0.04, 0, 0 )"), Line::Motion(to));
        let to = Command::MoveJ { to: Target::Joints([1.0; 6]), speed: 1.05, acceleration: 1.4 };
        assert_eq!(one("movej([1,1,1,1,1,1])"), Line::Motion(to));
        let speed = Command::SpeedL { velocity: [0.02, 0.0, 0.0, 0.0, 0.0, 0.0], acceleration: 0.5, time_s: 0.1 };
        assert_eq!(one("speedl([0.02,0,0,0,0,0], 0.5, 0.1)"), Line::Motion(speed));
        let servo = Command::ServoJ { to: [0.5; 6], lookahead_s: 0.05 };
        let line = "servoj([.5,.5,.5,.5,.5,.5], t=0.008, lookahead_time=0.05, gain=300)";
        assert_eq!(one(line), Line::Motion(servo));
        assert_eq!(one("stopl(1.5)"), Line::Motion(Command::StopL { deceleration: 1.5 }));
        assert_eq!(one("write_output_integer_register(0 +24, 2)"), Line::WriteInt { register: 24, value: 2 });
        let (name, lines) = parse("def mine():\n\t# a note\n\tsleep(0.5)\n\ttextmsg(\"hello\")\nend\n").unwrap();
        assert_eq!((name.as_str(), lines), ("mine", vec![Line::Sleep { time_s: 0.5 }, Line::Nothing]));
    }

    #[test]
    fn what_is_not_understood_is_named_and_nothing_is_carried_out() {
        assert!(refused("movel(get_target_tcp_pose())").starts_with("line 1: \"movel(get_target"));
        assert!(refused("def a():\n  stopl(1)\n  while True:\n  end\nend\n").starts_with("line 3: \"while True:\""));
        assert_eq!(refused("movel(p[0,0,0], v=1)"), "line 1: movel: pose must have six numbers");
        assert_eq!(refused("movej([0,0,0,0,0,0], r=0.1)"), "line 1: movej: a blend radius r is not carried out");
        assert_eq!(refused("movej([0,0,0,0,0,0], t=2)"), "line 1: movej: a duration t is not carried out; use v");
        assert_eq!(refused("stopl(-1)"), "line 1: stopl: a is -1, it must be above 0, at most 150");
        assert_eq!(refused("speedl(p[0,0,0,0,0,0], 1)"), "line 1: speedl: xd is a pose, it must be a list");
        assert_eq!(refused("stopl(1, b=2)"), "line 1: stopl: argument 2 is not known");
        assert!(refused("set_digital_out(0, True)").contains("set_digital_out"));
        assert!(refused("sleep(1e9)").contains("t is 1000000000"));
    }

    #[test]
    fn programs_are_put_together_from_lines() {
        let mut reader = Reader::default();
        assert_eq!(reader.take("stopl(1)"), Ok(Some("stopl(1)".to_owned())));
        for line in ["", "# nothing", "def a():", "  while True:", "  end"] {
            assert_eq!(reader.take(line), Ok(None), "{line}");
        }
        assert_eq!(reader.take("end"), Ok(Some("def a():\n  while True:\n  end\nend\n".to_owned())));
        reader.take("def b():").unwrap();
        let long = "x".repeat(60_000);
        assert!((0..6).any(|_| reader.take(&long) == Err(ScriptError::Large)));
    }

    proptest! {
        #[test]
        fn any_text_is_parsed_or_refused(text in "\\PC{0,200}", words in "(movej|servoj|stopl)\\([p\\[\\]0-9,.a-z= -]{0,60}\\)") {
            for text in [text, words] {
                if let Ok((_, lines)) = parse(&text) {
                    prop_assert!(lines.iter().all(|line| !matches!(line, Line::Motion(command) if command.check().is_err())));
                }
            }
        }
    }
}
