//! Scripted disturbances: they move the bead or blind the tracker at a given time.

use serde::{Deserialize, Serialize};

/// Maximum number of disturbances in a script.
pub const SCRIPT_LIMIT: usize = 64;
/// Last control step of a goal at which a disturbance can be applied: a goal's steps at the largest `step_limit`.
pub const MOST_STEPS: u32 = 20_000;
/// Largest kick: a resting bead gets a speed of about 4 m/s.
pub const MOST_IMPULSE_N_S: f64 = 2e-3;
/// Largest push: about twice the bead's weight.
pub const MOST_DRIFT_N: f64 = 0.01;
/// Longest drift or dropout.
pub const MOST_SECONDS: f64 = 60.0;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Disturbance {
    /// The bead is lifted and put down here, or at the nearest place where it fits.
    Displace { x_m: f64, y_m: f64 },
    /// A kick: an impulse in newton seconds.
    Impulse { x_n_s: f64, y_n_s: f64 },
    /// A push: a steady force in newtons.
    Drift { x_n: f64, y_n: f64, for_s: f64 },
    /// The tracker reports nothing.
    Dropout { for_s: f64 },
}

/// When a scripted disturbance is applied. Those that wait for the bead are applied in the order of the script.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// Before this tick.
    Tick(#[cfg_attr(feature = "schema", ts(type = "number"))] u64),
    /// At this control step, 1 to 20,000, of the first goal that reaches it.
    Step(u32),
    /// When the bead's x passes this one, in either direction.
    #[serde(rename = "passes_x_m")]
    PassesXM(f64),
    /// When the bead comes within a distance of a place.
    Near {
        x_m: f64,
        y_m: f64,
        /// 1 mm to 1 m.
        within_m: f64,
    },
}

impl When {
    /// Whether it waits for the bead.
    pub fn waits_for_bead(&self) -> bool {
        matches!(self, Self::PassesXM(_) | Self::Near { .. })
    }
}

/// A disturbance with its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Scripted {
    pub at: When,
    pub disturbance: Disturbance,
}

/// A disturbance with an invalid number.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}, it must be {allowed}")]
pub struct DisturbanceError {
    pub field: &'static str,
    pub value: f64,
    pub allowed: String,
}

impl Scripted {
    /// Checks time and numbers.
    pub fn check(&self) -> Result<(), DisturbanceError> {
        let refuse = |field, value, allowed: String| Err(DisturbanceError { field, value, allowed });
        match self.at {
            When::Step(step) if !(1..=MOST_STEPS).contains(&step) => {
                return refuse("step", f64::from(step), format!("1 to {MOST_STEPS}"));
            }
            When::PassesXM(x_m) if !x_m.is_finite() => return refuse("passes_x_m", x_m, "finite".to_owned()),
            When::Near { x_m, y_m, within_m } => {
                for (field, value) in [("x_m", x_m), ("y_m", y_m)] {
                    if !value.is_finite() {
                        return refuse(field, value, "finite".to_owned());
                    }
                }
                if !(0.001..=1.0).contains(&within_m) {
                    return refuse("within_m", within_m, "0.001 to 1".to_owned());
                }
            }
            When::Tick(_) | When::Step(_) | When::PassesXM(_) => {}
        }
        self.disturbance.check()
    }
}

impl Disturbance {
    /// Checks every number except the place, which depends on the map.
    pub fn check(&self) -> Result<(), DisturbanceError> {
        let within = |field: [&'static str; 2], value: [f64; 2], most: f64| {
            // The error names the larger component. NaN fails both comparisons.
            let larger = usize::from(!value[0].is_nan() && (value[1].is_nan() || value[1].abs() > value[0].abs()));
            let allowed = || format!("finite, and both together at most {most}");
            let good = value[0].hypot(value[1]) <= most;
            let error = || DisturbanceError { field: field[larger], value: value[larger], allowed: allowed() };
            if good { Ok(()) } else { Err(error()) }
        };
        let lasts = |value: f64| {
            let good = value > 0.0 && value <= MOST_SECONDS;
            let allowed = || format!("above 0 and at most {MOST_SECONDS}");
            if good { Ok(()) } else { Err(DisturbanceError { field: "for_s", value, allowed: allowed() }) }
        };
        match *self {
            Self::Displace { .. } => Ok(()),
            Self::Impulse { x_n_s, y_n_s } => within(["x_n_s", "y_n_s"], [x_n_s, y_n_s], MOST_IMPULSE_N_S),
            Self::Drift { x_n, y_n, for_s } => {
                within(["x_n", "y_n"], [x_n, y_n], MOST_DRIFT_N)?;
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
        // The limit applies to the whole kick, not to each axis.
        assert_eq!(field(Disturbance::Impulse { x_n_s: 1.8e-3, y_n_s: 1.9e-3 }), "y_n_s");
        Disturbance::Dropout { for_s: 1.0 }.check().unwrap();
        let never = Scripted { at: When::Step(0), disturbance: Disturbance::Dropout { for_s: 1.0 } };
        assert_eq!(never.check().unwrap_err().field, "step");
        let at = |at| Scripted { at, ..never }.check().unwrap_err().field;
        assert_eq!(at(When::PassesXM(f64::NAN)), "passes_x_m");
        assert_eq!(at(When::Near { x_m: 0.0, y_m: f64::INFINITY, within_m: 0.01 }), "y_m");
        assert_eq!(at(When::Near { x_m: 0.0, y_m: 0.0, within_m: 0.0 }), "within_m");
    }
}
