//! The switching law: which sub-controller moves the arm (paper, equation 1; specification §4).

use serde::{Deserialize, Serialize};

use crate::facts::Told;
use crate::geometry::Point2;
use crate::scenario::{Parameters, SwitchingLaw};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// Sub-controller 1 fetches the bead.
    Approach,
    /// Sub-controller 2 carries the bead.
    Transport,
}

impl Mode {
    /// The paper's index SL.
    pub fn index(self) -> u8 {
        match self {
            Self::Approach => 1,
            Self::Transport => 2,
        }
    }
}

/// The law's decision and the values behind it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    pub mode: Mode,
    /// Whether the mode differs from the previous one.
    pub switched: bool,
    /// e: distance from the tool to the tracked bead in the plane.
    pub error_m: f64,
    /// The threshold for e.
    pub threshold_m: f64,
}

/// Why a sub-controller is active.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum Reason {
    #[error("bead lost: {:.0} mm away, more than T = {:.0} mm", error_m * 1e3, threshold_m * 1e3)]
    Lost { error_m: f64, threshold_m: f64 },
    #[error("fetching: {:.0} mm away, but a wall is between", error_m * 1e3)]
    WallBetween { error_m: f64 },
    #[error("fetching: {:.0} mm away, not yet within {:.0} mm", error_m * 1e3, threshold_m * 1e3)]
    Fetching { error_m: f64, threshold_m: f64 },
    #[error("bead fetched: {:.0} mm away, within {:.0} mm", error_m * 1e3, threshold_m * 1e3)]
    Fetched { error_m: f64, threshold_m: f64 },
    #[error("bead held: {:.0} mm away, within T = {:.0} mm", error_m * 1e3, threshold_m * 1e3)]
    Held { error_m: f64, threshold_m: f64 },
    #[error("lift-off: the bead hangs on the magnet; take it off by hand, or reset")]
    LiftedOff,
}

impl Decision {
    pub fn reason(&self) -> Told<Reason> {
        let Self { error_m, threshold_m, .. } = *self;
        let reason = match (self.mode, self.switched) {
            (Mode::Approach, true) => Reason::Lost { error_m, threshold_m },
            (Mode::Approach, false) if error_m <= threshold_m => Reason::WallBetween { error_m },
            (Mode::Approach, false) => Reason::Fetching { error_m, threshold_m },
            (Mode::Transport, true) => Reason::Fetched { error_m, threshold_m },
            (Mode::Transport, false) => Reason::Held { error_m, threshold_m },
        };
        reason.told()
    }
}

impl Reason {
    /// With its sentence.
    pub fn told(self) -> Told<Self> {
        Told { fact: self, text: self.to_string() }
    }
}

/// Decides the mode. SL = ½(3 + sgn(T − e)) with sgn(0) = +1.
///
/// With hysteresis, sub-controller 1 keeps the arm until e is within the fetch radius and no wall is seen between
/// tool and bead. The literal law ends the fetch at distance T, where the pull hardly exceeds friction, and switches
/// back and forth. With a wall between them, the tool would move along the wrong side of a fold.
pub fn decide(
    mode: Mode,
    tool_m: Point2<f64>,
    bead_m: Point2<f64>,
    parameters: &Parameters,
    wall_between: impl FnOnce() -> bool,
) -> Decision {
    let error_m = (tool_m - bead_m).norm();
    let fetching = mode == Mode::Approach && parameters.switching_law == SwitchingLaw::Hysteresis;
    let threshold_m = if fetching { parameters.fetch_radius_m } else { parameters.threshold_m };
    let is_near = error_m <= threshold_m && !(fetching && wall_between());
    let next = if is_near { Mode::Transport } else { Mode::Approach };
    Decision { mode: next, switched: next != mode, error_m, threshold_m }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(mode: Mode, error_m: f64, law: SwitchingLaw) -> Mode {
        let parameters = Parameters { switching_law: law, ..Parameters::default() };
        decide(mode, Point2::origin(), Point2::new(error_m, 0.0), &parameters, || false).mode
    }

    #[test]
    fn the_literal_law_has_one_threshold_and_includes_it() {
        for mode in [Mode::Approach, Mode::Transport] {
            assert_eq!(at(mode, 0.10, SwitchingLaw::Literal), Mode::Transport);
            assert_eq!(at(mode, 0.100001, SwitchingLaw::Literal), Mode::Approach);
        }
    }

    #[test]
    fn a_fetch_does_not_end_behind_a_wall_but_a_wall_does_not_end_a_transport() {
        let parameters = Parameters::default();
        let at = |mode| decide(mode, Point2::origin(), Point2::new(0.005, 0.0), &parameters, || true);
        assert_eq!(at(Mode::Approach).mode, Mode::Approach);
        assert_eq!(at(Mode::Approach).reason().text, "fetching: 5 mm away, but a wall is between");
        assert_eq!(at(Mode::Transport).mode, Mode::Transport);
    }

    #[test]
    fn with_hysteresis_a_fetch_ends_within_one_centimetre() {
        use SwitchingLaw::Hysteresis;
        assert_eq!(at(Mode::Approach, 0.05, Hysteresis), Mode::Approach);
        assert_eq!(at(Mode::Transport, 0.05, Hysteresis), Mode::Transport);
        assert_eq!(at(Mode::Approach, 0.01, Hysteresis), Mode::Transport);
        assert_eq!(at(Mode::Transport, 0.11, Hysteresis), Mode::Approach);
    }
}
