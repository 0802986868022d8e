//! The description of a parameter: names, unit, range, step, group.

use std::f64::consts::PI;

use super::RlPolicy;
use crate::scenario::ControllerName;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name on the wire, in links and in `--set`.
    pub name: &'static str,
    /// Name on the page.
    pub label: &'static str,
    /// What it does, in one or two short sentences.
    pub help: &'static str,
    /// Group of the page's form.
    pub group: Group,
    /// Allowed values.
    pub kind: Kind,
}

/// A field of a form of the page: a parameter, or a setting of a background job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormField {
    /// Name on the wire.
    pub name: &'static str,
    pub label: &'static str,
    pub help: &'static str,
    pub kind: Kind,
}

/// A number out of its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {} to {}", .range[0], .range[1])]
pub struct Outside {
    pub field: &'static str,
    pub value: f64,
    /// Smallest and largest allowed value.
    pub range: [f64; 2],
}

impl FormField {
    /// Checks the values of fields, in their order; `None` is not checked.
    ///
    /// # Errors
    /// The first one that is out of range.
    pub fn check(fields: &[Self], values: &[Option<f64>]) -> Result<(), Outside> {
        for (field, value) in fields.iter().zip(values) {
            let (Kind::Number(Number { range, .. }), Some(value)) = (field.kind, *value) else { continue };
            if !(range[0]..=range[1]).contains(&value) {
                return Err(Outside { field: field.name, value, range });
            }
        }
        Ok(())
    }
}

/// The value of a field as a number, if it is one.
pub trait Numeric {
    fn number(&self) -> Option<f64> {
        None
    }
}

impl Numeric for f64 {
    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}

impl Numeric for u8 {
    fn number(&self) -> Option<f64> {
        Some((*self).into())
    }
}

impl Numeric for u32 {
    fn number(&self) -> Option<f64> {
        Some((*self).into())
    }
}

impl Numeric for bool {}

impl Parameter {
    /// It as a field of the page's form.
    pub fn form_field(&self) -> FormField {
        let Self { name, label, help, kind, .. } = *self;
        FormField { name, label, help, kind }
    }
}

/// Allowed values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number in a range.
    Number(Number),
    /// True or false.
    Flag,
    /// One of these; each with its label on the page.
    Choice(&'static [(&'static str, &'static str)]),
    /// One of [`RlPolicy::OPTIONS`], or an added policy.
    Policy,
}

/// The values of a parameter that is a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    pub unit: Unit,
    /// Smallest and largest value, in the unit on the wire.
    pub range: [f64; 2],
    /// Step of the page's slider, in the shown unit.
    pub step: f64,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
    /// How another parameter limits it further.
    pub bound: Option<Bound>,
}

/// A limit from above by another parameter, which is named here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// At most the value of the other one.
    AtMost(&'static str),
    /// At most a quarter of the value of the other one.
    Quarter(&'static str),
    /// Both together at most 1.
    Remainder(&'static str),
}

impl Bound {
    /// Name of the other parameter.
    pub fn other(self) -> &'static str {
        match self {
            Self::AtMost(other) | Self::Quarter(other) | Self::Remainder(other) => other,
        }
    }

    /// The limit, given the other parameter's value.
    pub fn most(self, other: f64) -> f64 {
        match self {
            Self::AtMost(_) => other,
            Self::Quarter(_) => 0.25 * other,
            Self::Remainder(_) => 1.0 - other,
        }
    }
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::AtMost(other) => write!(f, "at most {other}"),
            Self::Quarter(other) => write!(f, "at most a quarter of {other}"),
            Self::Remainder(other) => write!(f, "at most 1 together with {other}"),
        }
    }
}

/// A unit on the wire and on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// On the wire; empty for a plain number.
    pub wire: &'static str,
    /// On the page.
    pub shown: &'static str,
    /// Shown value = value on the wire × scale.
    pub scale: f64,
}

impl Unit {
    const fn new(wire: &'static str, shown: &'static str, scale: f64) -> Self {
        Self { wire, shown, scale }
    }
}

/// A number without unit.
pub const PLAIN: Unit = Unit::new("", "", 1.0);
/// A share, shown in percent.
pub const PERCENT: Unit = Unit::new("", "%", 100.0);
/// A length, shown in centimetres.
pub const CM: Unit = Unit::new("m", "cm", 100.0);
/// A length, shown in millimetres.
pub const MM: Unit = Unit::new("m", "mm", 1000.0);
/// A speed, shown in millimetres per second.
pub const MM_S: Unit = Unit::new("m/s", "mm/s", 1000.0);
/// An angle, shown in degrees.
pub const DEGREES: Unit = Unit::new("rad", "°", 180.0 / PI);
/// Viscous drag.
pub const MN_S_M: Unit = Unit::new("N·s/m", "mN·s/m", 1000.0);
/// A time.
pub const S: Unit = Unit::new("s", "s", 1.0);
/// Gray levels, 0 to 255.
pub const LEVELS: Unit = Unit::new("levels", "levels", 1.0);
/// Pixels of the camera image.
pub const PX: Unit = Unit::new("px", "px", 1.0);
/// Ticks of 8 ms.
pub const TICKS: Unit = Unit::new("ticks", "ticks", 1.0);

/// A number; the range in the unit on the wire, the step in the shown one.
pub const fn number(unit: Unit, range: [f64; 2], step: f64) -> Kind {
    Kind::Number(Number { unit, range, step, whole: false, bound: None })
}

/// The same, limited further by another parameter.
pub const fn bounded(unit: Unit, range: [f64; 2], step: f64, bound: Bound) -> Kind {
    Kind::Number(Number { unit, range, step, whole: false, bound: Some(bound) })
}

/// A whole number.
pub const fn whole(unit: Unit, range: [f64; 2], step: f64) -> Kind {
    Kind::Number(Number { unit, range, step, whole: true, bound: None })
}

impl Number {
    /// The range in the shown unit, rounded inward to whole steps.
    pub fn shown_range(&self) -> [f64; 2] {
        let [least, most] = self.range.map(|value| value * self.unit.scale / self.step);
        // Without the tolerance, 1.05 / 0.05 would be a little more than 21 steps.
        [(least - 1e-9).ceil(), (most + 1e-9).floor()].map(|steps| rounded(steps * self.step))
    }
}

/// Rounded to 12 digits, which removes errors of binary fractions.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// `0.09 to 0.2 m`.
pub(super) fn range_text([least, most]: [f64; 2], unit: Unit) -> String {
    let space = if unit.wire.is_empty() { "" } else { " " };
    format!("{least} to {most}{space}{}", unit.wire)
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => {
                f.write_str(&range_text(number.range, number.unit))?;
                number.bound.map_or(Ok(()), |bound| write!(f, ", {bound}"))
            }
            Self::Flag => f.write_str("true or false"),
            Self::Choice(options) => {
                let values: Vec<_> = options.iter().map(|(value, _)| *value).collect();
                f.write_str(&values.join(", "))
            }
            Self::Policy => {
                let values = RlPolicy::OPTIONS.map(|(value, _)| value);
                write!(f, "{}, or NAME or NAME@HASH of an added policy", values.join(", "))
            }
        }
    }
}

/// A group of the page's form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Group {
    Rl,
    Errt,
    Attractor,
    Switching,
    Speeds,
    Camera,
    MagnetAndBead,
    Walls,
    Tracker,
}

impl Group {
    /// All groups, in the order of the form.
    pub const ALL: [Self; 9] = [
        Self::Rl,
        Self::Errt,
        Self::Attractor,
        Self::Switching,
        Self::Speeds,
        Self::Camera,
        Self::MagnetAndBead,
        Self::Walls,
        Self::Tracker,
    ];

    /// Its heading.
    pub fn title(self) -> &'static str {
        match self {
            Self::Rl => "RL",
            Self::Errt => "ERRT",
            Self::Attractor => "Attractor dynamics",
            Self::Switching => "Switching",
            Self::Speeds => "Speeds and steps",
            Self::Camera => "Camera",
            Self::MagnetAndBead => "Magnet and bead",
            Self::Walls => "Walls and fluid",
            Self::Tracker => "Tracker",
        }
    }

    /// The controller that uses it, if only one does.
    pub fn controller(self) -> Option<ControllerName> {
        match self {
            Self::Rl => Some(ControllerName::Rl),
            Self::Errt => Some(ControllerName::Errt),
            Self::Attractor => Some(ControllerName::Attractor),
            _ => None,
        }
    }

    /// Whether the page shows the group open at first.
    pub fn is_open(self) -> bool {
        matches!(self, Self::Rl | Self::Switching)
    }
}
