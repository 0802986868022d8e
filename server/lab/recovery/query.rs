//! What a recovery map tries, checked before anything runs.

use std::str::FromStr;

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::scenario::ControllerName;
use ferry_core::scenario::descriptor::{FormField, Outside, PLAIN, S, number, whole};
use ferry_core::trial::Phase;

/// Largest number of trials of one recovery map.
const TRIALS_MOST: usize = 100_000;

/// How the trials of a recovery map are disturbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = RecoveryKind)]
#[ts(rename = "RecoveryKind", rename_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The bead is lifted to each cell of a grid.
    Place,
    /// The bead is pushed in each direction, with each of several forces.
    Push,
    /// A hand pulls the bead in each direction, over each of several distances.
    Drag,
    /// The tracker is blind at each of several times, for each of several durations.
    Blind,
}

/// No kind has this name.
#[derive(Debug, thiserror::Error)]
#[error("kind is {0:?}, it must be place, push, drag or blind")]
pub struct UnknownKind(String);

impl FromStr for Kind {
    type Err = UnknownKind;

    fn from_str(name: &str) -> Result<Self, UnknownKind> {
        Self::ALL.into_iter().find(|kind| kind.as_str() == name).ok_or_else(|| UnknownKind(name.to_owned()))
    }
}

impl Kind {
    pub const ALL: [Self; 4] = [Self::Place, Self::Push, Self::Drag, Self::Blind];

    pub fn as_str(self) -> &'static str {
        match self {
            Self::Place => "place",
            Self::Push => "push",
            Self::Drag => "drag",
            Self::Blind => "blind",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecoveryQuery {
    pub kind: Kind,
    /// Sub-controllers 2.
    pub controllers: Vec<ControllerName>,
    /// Number of columns of the finest grid: of places, directions, or times. 4 to 96.
    pub grid: u32,
    /// Trials per cell and controller, each with its own noise. 1 to 100.
    pub repeats: u32,
    /// Seed of the noise.
    pub seed: u64,
    /// A later delivery is late. 1 to 600 simulated seconds.
    pub within_s: f64,
    /// Whether each cell of the finest grid is tried, also where all neighbours agree.
    pub is_full: bool,
}

/// Why a recovery map is refused.
#[derive(Debug, thiserror::Error)]
pub enum RecoveryError {
    #[error("controllers is empty, it must name at least one")]
    NoController,
    #[error("controllers[{index}] is {:?}, which is in the list already", .name.as_str())]
    Twice { index: usize, name: ControllerName },
    #[error("controllers[{index}] is {:?}: a recovery map asks no person and no robot client", .name.as_str())]
    Person { index: usize, name: ControllerName },
    #[error("controllers[{index}] is \"program\", but no program is selected in the session and connected")]
    Program { index: usize },
    #[error(transparent)]
    Range(#[from] Outside),
    #[error("grid, repeats and controllers make {trials} trials, the limit is {TRIALS_MOST}")]
    TooManyTrials { trials: usize },
    #[error("grid is {grid}: no cell has room for the bead at its centre, use more columns")]
    NoCell { grid: u32 },
    #[error("tick {tick}: no goal is set, so there is nothing to deliver")]
    NoGoal { tick: u64 },
    /// The operator must place the goal again.
    #[error("tick {tick}: the trial has ended: {phase}; place the goal again")]
    Ended { tick: u64, phase: Phase },
}

impl RecoveryError {
    pub fn field(&self) -> String {
        match self {
            Self::NoController => "controllers".to_owned(),
            Self::Twice { index, .. } | Self::Person { index, .. } | Self::Program { index } => {
                format!("controllers[{index}]")
            }
            Self::Range(outside) => outside.field.to_owned(),
            Self::TooManyTrials { .. } | Self::NoCell { .. } => "grid".to_owned(),
            Self::NoGoal { .. } | Self::Ended { .. } => "tick".to_owned(),
        }
    }
}

impl RecoveryQuery {
    /// Its numbers with a range: the range check and the page's form come from here.
    pub const FIELDS: [FormField; 3] = [
        FormField {
            name: "grid",
            label: "Columns",
            help: "Of the finest grid: places, directions or times.",
            kind: whole(PLAIN, [4.0, 96.0], 1.0),
        },
        FormField {
            name: "repeats",
            label: "Repeats",
            help: "Trials per cell and controller, each with its own noise.",
            kind: whole(PLAIN, [1.0, 100.0], 1.0),
        },
        FormField {
            name: "within_s",
            label: "In time",
            help: "A later delivery is late; simulated time.",
            kind: number(S, [1.0, 600.0], 1.0),
        },
    ];

    /// # Errors
    /// [`RecoveryError`] names the first field that is wrong.
    pub fn check(&self, has_program: bool) -> Result<(), RecoveryError> {
        if self.controllers.is_empty() {
            return Err(RecoveryError::NoController);
        }
        for (index, &name) in self.controllers.iter().enumerate() {
            match name {
                _ if self.controllers[..index].contains(&name) => return Err(RecoveryError::Twice { index, name }),
                ControllerName::You | ControllerName::Robot => return Err(RecoveryError::Person { index, name }),
                ControllerName::Program if !has_program => return Err(RecoveryError::Program { index }),
                _ => {}
            }
        }
        let numbers = [self.grid.into(), self.repeats.into(), self.within_s];
        Ok(FormField::check(&Self::FIELDS, &numbers.map(Some))?)
    }

    pub(super) fn check_trials(&self, trials: usize) -> Result<(), RecoveryError> {
        match trials {
            0 => Err(RecoveryError::NoCell { grid: self.grid }),
            1..=TRIALS_MOST => Ok(()),
            _ => Err(RecoveryError::TooManyTrials { trials }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_is_named_with_its_value() {
        let query = RecoveryQuery {
            kind: Kind::Place,
            controllers: vec![ControllerName::Rl, ControllerName::Errt],
            grid: 24,
            repeats: 3,
            seed: 1,
            within_s: 60.0,
            is_full: false,
        };
        assert!(query.check(false).is_ok());
        let with = |names: &[ControllerName]| RecoveryQuery { controllers: names.to_vec(), ..query.clone() };
        for (bad, field, text) in [
            (with(&[]), "controllers", "controllers is empty"),
            (with(&[ControllerName::Rl, ControllerName::Rl]), "controllers[1]", "\"rl\""),
            (with(&[ControllerName::You]), "controllers[0]", "\"you\""),
            (with(&[ControllerName::Program]), "controllers[0]", "\"program\""),
            (RecoveryQuery { grid: 3, ..query.clone() }, "grid", "grid is 3, it must be 4 to 96"),
            (RecoveryQuery { grid: 97, ..query.clone() }, "grid", "grid is 97"),
            (RecoveryQuery { repeats: 0, ..query.clone() }, "repeats", "repeats is 0, it must be 1 to 100"),
            (RecoveryQuery { within_s: f64::NAN, ..query.clone() }, "within_s", "within_s is NaN"),
            (RecoveryQuery { within_s: 0.5, ..query.clone() }, "within_s", "within_s is 0.5, it must be 1 to 600"),
        ] {
            let error = bad.check(false).unwrap_err();
            assert_eq!(error.field(), field);
            assert!(error.to_string().contains(text), "{error}");
        }
        assert!(with(&[ControllerName::Program]).check(true).is_ok());
        assert!(query.check_trials(100_000).is_ok());
        assert!(query.check_trials(0).unwrap_err().to_string().contains("grid is 24"));
        assert!(query.check_trials(100_001).unwrap_err().to_string().contains("100001 trials"));
        assert_eq!("drag".parse::<Kind>().unwrap(), Kind::Drag);
        assert!("shove".parse::<Kind>().unwrap_err().to_string().contains("\"shove\""));
    }
}
