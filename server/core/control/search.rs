//! What the arm does while the tracker is lost: it holds. When the camera shows that the bead is not where it was, the
//! arm looks for it along a widening spiral, and holds over it.
//!
//! Own design; the paper's tracker never fails.

use serde::{Deserialize, Serialize};

use super::{CONTROL_PERIOD_S, TargetStep};
use crate::geometry::{Point2, Vector2};
use crate::perception::{BeadView, Calibration};

/// The bead may be missing from the picture for this many control steps before the search begins: 1 s.
const MISSING_STEPS: u32 = 4;
/// Distance between the turns of the spiral, as a share of the picture's width. Neighbouring pictures overlap.
const PITCH: f64 = 0.7;
/// Distance between the spiral's waypoints, as a share of the picture's width.
const SPACING: f64 = 0.35;
/// A waypoint counts as visited within this distance.
const VISITED_M: f64 = 0.01;
/// After this many waypoints the spiral begins again: it then covers 2 m.
const WAYPOINTS: u32 = 1500;

/// Memory of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// Where the bead was seen last, by the tracker or by the camera.
    last_m: Option<Point2<f64>>,
    /// Control steps since the bead was seen.
    missing_steps: u32,
    /// The present waypoint of the spiral.
    waypoint: u32,
    /// The bead was not where it was: the arm goes over it before it holds.
    is_fetching: bool,
}

/// What the arm does at a control step without the tracker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Look {
    /// The bead is in the picture, or may be.
    Hold,
    /// Toward a place from which it may be seen.
    Go(TargetStep),
}

/// What a control step without the tracker uses.
#[derive(Clone, Copy, Debug)]
pub struct SearchInput<'a> {
    /// The bead in the present picture.
    pub view: BeadView,
    pub calibration: &'a Calibration,
    pub tool_m: Point2<f64>,
    /// Where the tracker saw the bead last.
    pub tracked_m: Point2<f64>,
    /// Beyond this distance from the tool, a bead in the picture is lost.
    pub threshold_m: f64,
    /// Within this distance from the tool, a lost bead is fetched.
    pub fetch_radius_m: f64,
    pub speed_m_s: f64,
}

impl Search {
    /// The next step. `is_reached` says whether the tool may go to a place; other waypoints are left out.
    pub fn next_step(&mut self, input: &SearchInput<'_>, is_reached: impl Fn(Point2<f64>) -> bool) -> Look {
        let last_m = *self.last_m.get_or_insert(input.tracked_m);
        let go = |to: Point2<f64>| {
            let offset = (to - input.tool_m).cap_magnitude(input.speed_m_s * CONTROL_PERIOD_S);
            Look::Go(TargetStep { target_m: input.tool_m + offset, speed_m_s: input.speed_m_s })
        };
        match input.view {
            BeadView::At(bead_m) => {
                let distance_m = (bead_m - input.tool_m).norm();
                let is_lost = self.is_fetching || self.has_begun() || distance_m > input.threshold_m;
                let is_fetching = is_lost && distance_m > input.fetch_radius_m;
                *self = Self { last_m: Some(bead_m), is_fetching, ..Self::default() };
                return if is_fetching && is_reached(bead_m) { go(bead_m) } else { Look::Hold };
            }
            // It may be where it was.
            BeadView::Missing { is_last_visible: false } if input.calibration.sees(last_m) => return Look::Hold,
            BeadView::Missing { .. } => {}
        }
        self.missing_steps = self.missing_steps.saturating_add(1);
        if self.missing_steps <= MISSING_STEPS {
            return Look::Hold;
        }
        let width_m = input.calibration.size_px as f64 * input.calibration.m_per_px;
        let is_useful = |place: Point2<f64>| (place - input.tool_m).norm() > VISITED_M && is_reached(place);
        for _ in 0..WAYPOINTS {
            let place = last_m + spiral(self.waypoint, width_m);
            if is_useful(place) {
                return go(place);
            }
            self.waypoint = (self.waypoint + 1) % WAYPOINTS;
        }
        Look::Hold
    }

    /// Where the bead was last, given where the tracker saw it last.
    pub fn last_m(&self, tracked_m: Point2<f64>) -> Point2<f64> {
        self.last_m.unwrap_or(tracked_m)
    }

    /// Whether the arm has begun to look for the bead.
    pub fn has_begun(&self) -> bool {
        self.missing_steps > MISSING_STEPS
    }
}

/// The waypoint of a number on an Archimedean spiral around the origin, for pictures of this width. Waypoints have
/// nearly equal distances: the length of the spiral grows with the square of the angle.
fn spiral(number: u32, width_m: f64) -> Vector2<f64> {
    let per_rad_m = PITCH * width_m / std::f64::consts::TAU;
    let angle_rad = (2.0 * f64::from(number) * SPACING * width_m / per_rad_m).sqrt();
    let (sin, cos) = angle_rad.sin_cos();
    Vector2::new(cos, sin) * (per_rad_m * angle_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CALIBRATION: Calibration = Calibration {
        center_m: Point2::new(0.0, 0.0),
        m_per_px: 0.2 / 480.0,
        size_px: 480,
        foot_m: Point2::new(0.0, 0.0),
    };

    /// Flies until a bead is in the picture; returns the control steps, or `None` after a thousand.
    fn steps_to(bead_m: Point2<f64>, is_reached: impl Fn(Point2<f64>) -> bool) -> Option<u32> {
        let (mut search, mut tool_m) = (Search::default(), Point2::new(0.02, 0.0));
        for step in 0..1000 {
            let calibration = Calibration { center_m: tool_m, foot_m: tool_m, ..CALIBRATION };
            let view = match calibration.sees(bead_m) {
                true => BeadView::At(bead_m),
                false => BeadView::Missing { is_last_visible: true },
            };
            let input = SearchInput {
                view,
                calibration: &calibration,
                tool_m,
                tracked_m: Point2::origin(),
                threshold_m: 0.1,
                fetch_radius_m: 0.01,
                speed_m_s: 0.25,
            };
            match search.next_step(&input, &is_reached) {
                Look::Go(step) => {
                    assert!((step.target_m - tool_m).norm() <= 0.25 * CONTROL_PERIOD_S + 1e-12);
                    tool_m = step.target_m;
                }
                Look::Hold if matches!(view, BeadView::At(_)) => return Some(step),
                Look::Hold => {}
            }
        }
        None
    }

    #[test]
    fn it_finds_a_bead_anywhere_and_sooner_when_it_is_near() {
        assert_eq!(steps_to(Point2::new(0.05, 0.05), |_| true), Some(0), "it was in the picture all along");
        let near = steps_to(Point2::new(0.15, 0.0), |_| true).unwrap();
        let far = steps_to(Point2::new(-0.3, 0.25), |_| true).unwrap();
        assert!((4..20).contains(&near) && near < far && far < 150, "{near} {far}");
        for degrees in (0..360).step_by(15) {
            let angle_rad = f64::from(degrees).to_radians();
            assert!(steps_to(Point2::new(angle_rad.cos(), angle_rad.sin()) * 0.45, |_| true).is_some(), "{degrees}°");
        }
    }

    #[test]
    fn places_out_of_reach_are_left_out() {
        let right = |place: Point2<f64>| place.x > -0.05;
        assert!(steps_to(Point2::new(0.3, 0.2), right).is_some());
        assert_eq!(steps_to(Point2::new(-0.4, 0.0), right), None);
        assert_eq!(steps_to(Point2::new(-0.4, 0.0), |_| false), None);
    }

    #[test]
    fn a_hidden_place_is_no_reason_to_search() {
        let mut search = Search::default();
        let input = SearchInput {
            view: BeadView::Missing { is_last_visible: false },
            calibration: &CALIBRATION,
            tool_m: Point2::origin(),
            tracked_m: Point2::new(0.01, 0.0),
            threshold_m: 0.1,
            fetch_radius_m: 0.01,
            speed_m_s: 0.25,
        };
        for _ in 0..50 {
            assert_eq!(search.next_step(&input, |_| true), Look::Hold);
        }
        assert!(!search.has_begun());
    }
}
