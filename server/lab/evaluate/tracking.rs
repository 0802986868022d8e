//! The tracking benchmark: the bead follows a point that moves along a square or a circle.
//!
//! It has the shapes and the measure of a neighbouring system, which drives a 7 mm capsule with four electromagnets on a
//! UR5: Yan et al. 2026, arXiv 2601.15545. That is another actuator: it changes its field without moving, while here a
//! permanent magnet drags the bead behind it.

use std::f64::consts::TAU;
use std::sync::Arc;

use serde::Serialize;

use crate::evaluate::EvaluateError;
use ferry_camera::{Camera, Gpu};
use ferry_core::control::CONTROL_PERIOD_S;
use ferry_core::geometry::{Point2, Point3, Vector2};
use ferry_core::magnetics::dipole;
use ferry_core::map::{Map, MapError};
use ferry_core::plant::{Plant, Positioner};
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::{ControllerName, Parameters, Scenario};
use ferry_core::trial::{Arena, Input, Source, Trial};

/// Root mean square errors of arXiv 2601.15545, square and circle.
pub const PUBLISHED_RMSE_M: [f64; 2] = [0.00118, 0.0015];
/// Middle of the path, in `base`.
const CENTER_M: Point2<f64> = Point2::new(0.0, -0.375);
/// Sides of the square, and diameter of the circle.
pub const SIZES_M: std::ops::RangeInclusive<f64> = 0.06..=0.2;
pub const SPEEDS_M_S: std::ops::RangeInclusive<f64> = 0.002..=0.04;
pub const WIDTHS_M: std::ops::RangeInclusive<f64> = 0.016..=0.04;
/// Radius of the room in the middle that holds the goal: a trial needs one, and the tool must not come near it.
const ROOM_MM: f64 = 8.0;
/// The first lap is not scored.
const LAPS: f64 = 3.0;
/// The tool may be this much faster than the point, to catch up.
const CATCH_UP: f64 = 1.5;
/// Share of the tracked error that is added to the target, with feedback.
const FEEDBACK: f64 = 0.6;
/// The farthest offset at which the pull is looked for.
const FARTHEST_M: f64 = 0.05;

/// The path of the point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    Square,
    Circle,
}

impl std::str::FromStr for Shape {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "square" => Ok(Self::Square),
            "circle" => Ok(Self::Circle),
            _ => Err(format!("{text:?}: must be square or circle")),
        }
    }
}

/// How the tool's target is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// At the point.
    Point,
    /// Ahead of it, by as much as the bead trails the tool at this speed.
    FeedForward,
    /// The same, corrected by the error that the tracker reports.
    FeedForwardAndFeedback,
}

impl Aim {
    pub const ALL: [Self; 3] = [Self::Point, Self::FeedForward, Self::FeedForwardAndFeedback];

    pub fn label(self) -> &'static str {
        match self {
            Self::Point => "none",
            Self::FeedForward => "feed-forward",
            Self::FeedForwardAndFeedback => "feed-forward and feedback",
        }
    }
}

/// A run of the benchmark.
#[derive(Clone, Debug)]
pub struct Course {
    pub shape: Shape,
    /// Side of the square, or diameter of the circle.
    pub size_m: f64,
    pub speed_m_s: f64,
    /// Width of a channel along the path; without one the table is open.
    pub channel_m: Option<f64>,
    pub aim: Aim,
    pub parameters: Parameters,
    pub seed: u64,
}

/// How well the bead followed.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Followed {
    /// Root mean square of the distance from the point.
    pub rmse_m: f64,
    /// The same of the distance from the path, wherever on it the bead should be.
    pub across_rmse_m: f64,
    pub most_m: f64,
    /// Time that was scored.
    pub scored_s: f64,
    /// Share of the control steps at which the arm held or flew to the bead.
    pub not_carried_share: f64,
}

impl Course {
    fn length_m(&self) -> f64 {
        match self.shape {
            Shape::Square => 4.0 * self.size_m,
            Shape::Circle => 0.5 * TAU * self.size_m,
        }
    }

    /// The point at a time, and its direction.
    fn point(&self, time_s: f64) -> (Point2<f64>, Vector2<f64>) {
        let along_m = (time_s * self.speed_m_s).rem_euclid(self.length_m());
        let half_m = 0.5 * self.size_m;
        match self.shape {
            Shape::Circle => {
                let (sin, cos) = (along_m / half_m).sin_cos();
                (CENTER_M + Vector2::new(cos, sin) * half_m, Vector2::new(-sin, cos))
            }
            Shape::Square => {
                let side = (along_m / self.size_m) as usize % 4;
                let on_side_m = along_m - side as f64 * self.size_m - half_m;
                let along = [Vector2::y(), -Vector2::x(), -Vector2::y(), Vector2::x()][side];
                let out = [Vector2::x(), Vector2::y(), -Vector2::x(), -Vector2::y()][side];
                (CENTER_M + out * half_m + along * on_side_m, along)
            }
        }
    }

    /// Distance of a place from the path.
    fn across_m(&self, place: Point2<f64>) -> f64 {
        let offset = place - CENTER_M;
        let half_m = 0.5 * self.size_m;
        match self.shape {
            Shape::Circle => (offset.norm() - half_m).abs(),
            Shape::Square => {
                let (x_m, y_m) = (offset.x.abs(), offset.y.abs());
                let inside = x_m.max(y_m) <= half_m;
                let beyond = Vector2::new((x_m - half_m).max(0.0), (y_m - half_m).max(0.0)).norm();
                if inside { half_m - x_m.max(y_m) } else { beyond }
            }
        }
    }

    /// An open table, or a channel along the path, with a room for the goal in the middle.
    fn map(&self) -> Result<Map, MapError> {
        let Some(width_m) = self.channel_m else { return Map::shipped("open") };
        let (x_mm, y_mm) = (CENTER_M.x * 1e3, -CENTER_M.y * 1e3);
        let ring = |half_mm: f64| match self.shape {
            Shape::Square => {
                let (left, top, side) = (x_mm - half_mm, y_mm - half_mm, 2.0 * half_mm);
                format!("M{left} {top}h{side}v{side}h-{side}Z")
            }
            Shape::Circle => disc(x_mm, y_mm, half_mm),
        };
        let (outer, inner) = (ring(500.0 * (self.size_m + width_m)), ring(500.0 * (self.size_m - width_m)));
        let room = disc(x_mm, y_mm, ROOM_MM);
        let svg = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-300 210 580 330">
            <path fill-rule="evenodd" d="M-300 210H280V540H-300Z {outer} {inner} {room}"/></svg>"#
        );
        Map::from_svg("channel", &svg)
    }

    /// How far the bead trails the tool at this speed: where the pull equals friction and drag.
    fn lag_m(&self) -> f64 {
        let plant = Plant::new(self.parameters.plant());
        let tool = Positioner::PlanarStage(Point3::new(0.0, 0.0, self.parameters.tool_height_m)).base_from_tool();
        let is_dragged = |offset_m: f64| {
            let load = plant.load(&tool, Point2::new(-offset_m, 0.0));
            let normal_n = (dipole::weight_n() - load.vertical_n).max(0.0);
            load.lateral_n.x >= self.parameters.friction * normal_n + self.parameters.drag_n_s_m * self.speed_m_s
        };
        let steps = (FARTHEST_M / 1e-4) as u32;
        let offsets_m = (0..=steps).map(|step| f64::from(step) * 1e-4);
        offsets_m.into_iter().find(|&offset_m| is_dragged(offset_m)).unwrap_or(0.0)
    }

    /// Runs the trial. The target is chosen from the path and from what the tracker reports; the score uses the true bead.
    ///
    /// # Errors
    /// The trial could not be set up, or the camera failed.
    pub fn run(&self, gpu: &Arc<Gpu>) -> Result<Followed, EvaluateError> {
        let arena = Arena::of(self.map().map_err(ferry_core::trial::TrialError::from)?);
        let parameters = Parameters {
            transport_speed_m_s: (CATCH_UP * self.speed_m_s).clamp(0.01, 0.079),
            step_limit: 5000,
            ..self.parameters.clone()
        };
        let scenario = Scenario {
            controller: ControllerName::Program,
            start_m: Some(self.point(0.0).0),
            goal_m: Some(CENTER_M),
            parameters,
            ..Scenario::idle("open", self.seed)
        };
        let mut trial = Trial::new(scenario, arena.clone())?;
        let mut camera = Camera::of(gpu, arena.static_scene()).map_err(ferry_core::trial::TrialError::from)?;
        let lag_m = if self.aim == Aim::Point { 0.0 } else { self.lag_m() };
        let lap_s = self.length_m() / self.speed_m_s;
        let (mut squares, mut across_squares, mut most_m, mut scored): (f64, f64, f64, u32) = (0.0, 0.0, 0.0, 0);
        let (mut steps, mut not_carried) = (0, 0);
        for tick in 0..(LAPS * lap_s / SERVO_PERIOD_S) as u64 {
            let time_s = tick as f64 * SERVO_PERIOD_S;
            if trial.step_is_due() {
                let seen = trial.see(&mut camera).map_err(ferry_core::trial::TrialError::from)?;
                steps += 1;
                if let Some(question) = trial.question(&seen) {
                    let (next, along) = self.point(time_s + CONTROL_PERIOD_S);
                    let mut target_m = next + along * lag_m;
                    if self.aim == Aim::FeedForwardAndFeedback {
                        target_m += (self.point(time_s).0 - question.bead_m) * FEEDBACK;
                    }
                    trial
                        .apply(Input::Go { x_m: target_m.x, y_m: target_m.y })
                        .map_err(ferry_core::trial::TrialError::from)?;
                } else {
                    not_carried += 1;
                }
                trial.tick(Source::Seen(Box::new(seen)))?;
            } else {
                trial.tick(Source::Camera(&mut camera))?;
            }
            if time_s < lap_s {
                continue;
            }
            let bead_m = trial.state().world.plant.bead.position_m;
            let error_m = (bead_m - self.point(time_s + SERVO_PERIOD_S).0).norm();
            squares += error_m * error_m;
            across_squares += self.across_m(bead_m).powi(2);
            most_m = most_m.max(error_m);
            scored += 1;
        }
        let root = |squares: f64| (squares / f64::from(scored.max(1))).sqrt();
        Ok(Followed {
            rmse_m: root(squares),
            across_rmse_m: root(across_squares),
            most_m,
            scored_s: f64::from(scored) * SERVO_PERIOD_S,
            not_carried_share: f64::from(not_carried) / f64::from(steps.max(1)),
        })
    }
}

fn disc(x_mm: f64, y_mm: f64, radius_mm: f64) -> String {
    let (left, twice) = (x_mm - radius_mm, 2.0 * radius_mm);
    format!("M{left} {y_mm}a{radius_mm} {radius_mm} 0 1 0 {twice} 0a{radius_mm} {radius_mm} 0 1 0 -{twice} 0Z")
}

#[cfg(test)]
mod tests {
    use super::Aim::{FeedForward, Point};
    use super::*;

    fn course(shape: Shape, aim: Aim) -> Course {
        let parameters = Parameters { tracker_noise_m: 0.0, ..Parameters::default() };
        Course { shape, size_m: 0.08, speed_m_s: 0.02, channel_m: None, aim, parameters, seed: 1 }
    }

    #[test]
    fn the_point_goes_round_at_its_speed_on_the_path() {
        for shape in [Shape::Square, Shape::Circle] {
            let course = course(shape, Point);
            let lap_s = course.length_m() / course.speed_m_s;
            let step_s = 0.01;
            let mut length_m = 0.0;
            for step in 0..(lap_s / step_s) as u32 {
                let time_s = f64::from(step) * step_s;
                let (here, along) = course.point(time_s);
                let (next, _) = course.point(time_s + step_s);
                assert!(course.across_m(here) < 1e-12, "{shape:?} {time_s}");
                assert!((along.norm() - 1.0).abs() < 1e-12);
                length_m += (next - here).norm();
            }
            assert!((length_m / course.length_m() - 1.0).abs() < 0.01, "{shape:?} {length_m}");
            assert!((course.point(lap_s).0 - course.point(0.0).0).norm() < 1e-9);
        }
        assert!((course(Shape::Square, Point).across_m(CENTER_M) - 0.04).abs() < 1e-12);
        assert!(
            (course(Shape::Square, Point).across_m(CENTER_M + Vector2::new(0.05, 0.05)) - 0.01 * 2f64.sqrt()).abs()
                < 1e-12
        );
    }

    #[test]
    fn feed_forward_removes_most_of_the_lag_also_in_a_channel() {
        let gpu = Gpu::open(Default::default()).unwrap();
        let run = |aim, channel_m| Course { channel_m, ..course(Shape::Circle, aim) }.run(&gpu).unwrap();
        let (plain, ahead) = (run(Point, None), run(FeedForward, None));
        assert!(plain.rmse_m > 0.008 && ahead.rmse_m < 0.25 * plain.rmse_m, "{plain:?} {ahead:?}");
        assert!(ahead.not_carried_share < 0.01, "{ahead:?}");
        let channel = run(FeedForward, Some(0.024));
        assert!(channel.rmse_m < 0.3 * plain.rmse_m, "{channel:?}");
    }
}
