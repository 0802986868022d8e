//! Scripted disturbances (specification §2): what befalls the bead, or what is known of it, and when.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Largest kick: it sends the resting bead off at about 4 m/s.
const MOST_IMPULSE_N_S: f64 = 2e-3;
/// Largest push: about twice the bead's weight.
const MOST_DRIFT_N: f64 = 0.01;
/// Longest drift or dropout.
const MOST_SECONDS: f64 = 60.0;

/// One disturbance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Disturbance {
    /// The bead is lifted and put down here, or where it fits nearest.
    Displace {
        /// x.
        x_m: f64,
        /// y.
        y_m: f64,
    },
    /// A kick.
    Impulse {
        /// Along x.
        x_n_s: f64,
        /// Along y.
        y_n_s: f64,
    },
    /// A steady push.
    Drift {
        /// Along x.
        x_n: f64,
        /// Along y.
        y_n: f64,
        /// For so long.
        for_s: f64,
    },
    /// The optical tracker sees nothing.
    Dropout {
        /// For so long.
        for_s: f64,
    },
}

/// When a scripted disturbance strikes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// Before this tick.
    Tick(#[ts(type = "number")] u64),
    /// At this control step since the goal was placed.
    Step(u32),
}

/// A disturbance and its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Scripted {
    /// When.
    pub at: When,
    /// What.
    pub disturbance: Disturbance,
}

/// A disturbance that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {allowed}")]
pub struct DisturbanceError {
    /// The field at fault.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: String,
}

impl Disturbance {
    /// Checks every number but the place, which is the map's business.
    pub fn check(&self) -> Result<(), DisturbanceError> {
        let within = |field, value: f64, most: f64| {
            let good = (-most..=most).contains(&value);
            if good { Ok(()) } else { Err(DisturbanceError { field, value, allowed: format!("within ±{most}") }) }
        };
        let lasts = |value: f64| {
            let good = value > 0.0 && value <= MOST_SECONDS;
            let allowed = || format!("above 0 and at most {MOST_SECONDS}");
            if good { Ok(()) } else { Err(DisturbanceError { field: "for_s", value, allowed: allowed() }) }
        };
        match *self {
            Self::Displace { .. } => Ok(()),
            Self::Impulse { x_n_s, y_n_s } => {
                within("x_n_s", x_n_s, MOST_IMPULSE_N_S)?;
                within("y_n_s", y_n_s, MOST_IMPULSE_N_S)
            }
            Self::Drift { x_n, y_n, for_s } => {
                within("x_n", x_n, MOST_DRIFT_N)?;
                within("y_n", y_n, MOST_DRIFT_N)?;
                lasts(for_s)
            }
            Self::Dropout { for_s } => lasts(for_s),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_absurd_is_named() {
        let field = |disturbance: Disturbance| disturbance.check().unwrap_err().field;
        assert_eq!(field(Disturbance::Impulse { x_n_s: 0.0, y_n_s: 1.0 }), "y_n_s");
        assert_eq!(field(Disturbance::Drift { x_n: f64::NAN, y_n: 0.0, for_s: 1.0 }), "x_n");
        assert_eq!(field(Disturbance::Dropout { for_s: 0.0 }), "for_s");
        Disturbance::Dropout { for_s: 1.0 }.check().unwrap();
    }
}
