//! Attractor dynamics (paper, §IV-B): a linear system that flows to the goal, deflected around obstacles by the
//! modulation of Khansari-Zadeh & Billard (2012), "A dynamical system approach to realtime obstacle avoidance", §3.2.
//!
//! The literal law is the paper's. It gets stuck behind a flat face: the goal's pull is normal to the face, the
//! modulation cancels it, and the middle of the face attracts. The improved law keeps a clearance, uses a star-shaped
//! basis (Huber, Billard & Slotine 2019) and follows the contour on one side until the goal is no longer behind the
//! obstacle.

mod flow;
mod modulation;

use serde::{Deserialize, Serialize};

use super::progress::{Progress, Standstill};
use super::{Transport, TransportInput, Trouble};
use crate::control::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::{Point2, Vector2};
use crate::perception::{CellState, ObstacleMap, ObstacleMask, Patch};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{AttractorLaw, Parameters};

pub use flow::Flow;
pub use modulation::Superellipse;
use modulation::{Basis, modulate};

/// Width and height of the largest sensed part of an obstacle (paper, Example 1).
const SENSED_M: f64 = 0.02;
/// Obstacles beyond this Γ do not start contour following.
const CONTOUR_GAMMA: f64 = 2.0;
/// Contour following starts if the modulation leaves less than this share of the speed.
const CONTOUR_SHARE: f64 = 0.5;
/// Fastest wall that is believed.
const MOST_WALL_M_S: f64 = 0.03;
/// Γ at which a contour is followed.
const CONTOUR_TRACK_GAMMA: f64 = 1.15;

/// Side on which a contour is followed, along the tangent (−n_y, n_x).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Side {
    Left,
    Right,
}

impl Side {
    fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// The transport and its memory.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Attractor {
    contour: Option<Side>,
    /// Superellipses of the last control step.
    sensed: Vec<Superellipse>,
    progress: Progress,
    trouble: Option<Trouble>,
    /// Velocity of the nearest wall, where walls move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    wall_m_s: Option<Vector2<f64>>,
}

impl Attractor {
    /// The superellipses of the last control step.
    pub fn sensed(&self) -> &[Superellipse] {
        &self.sensed
    }

    /// Velocity of the tool at `point`, capped at the transport speed.
    fn velocity(&mut self, point: Point2<f64>, goal: Point2<f64>, parameters: &Parameters) -> Vector2<f64> {
        // ṗ = (K − I)(P_g − p) with A = B = I (specification §5), slowed to a speed that the bead can follow.
        let limit_m_s = parameters.transport_speed_m_s;
        let nominal = ((goal - point) * (parameters.attractor_gain - 1.0)).cap_magnitude(limit_m_s);
        let rho = parameters.attractor_reactivity;
        match parameters.attractor_law {
            // Inside an obstacle the modulation is undefined: move out first (specification §5).
            AttractorLaw::Literal => match deepest(&self.sensed, point) {
                Some(obstacle) => obstacle.normal(point) * limit_m_s,
                None => modulate(&self.sensed, point, nominal, rho, Basis::Normal).cap_magnitude(limit_m_s),
            },
            AttractorLaw::Improved => self.improved(point, nominal, rho),
        }
    }

    /// Around moving obstacles, the law holds in the frame of the nearest one (Huber et al. 2019, on moving obstacles).
    fn improved(&mut self, point: Point2<f64>, nominal: Vector2<f64>, rho: f64) -> Vector2<f64> {
        let Some(wall_m_s) = self.wall_m_s else { return self.around_rest(point, nominal, rho) };
        let limit_m_s = nominal.norm();
        (self.around_rest(point, nominal - wall_m_s, rho) + wall_m_s).cap_magnitude(limit_m_s)
    }

    /// The improved law around obstacles at rest.
    fn around_rest(&mut self, point: Point2<f64>, nominal: Vector2<f64>, rho: f64) -> Vector2<f64> {
        let speed = nominal.norm();
        let closest = self.sensed.iter().min_by(|a, b| a.gamma(point).total_cmp(&b.gamma(point))).copied();
        let Some(closest) = closest else { return nominal };
        let gamma = closest.gamma(point);
        let normal = closest.normal(point);
        let tangent = Vector2::new(-normal.y, normal.x);
        let free = modulate(&self.sensed, point, nominal, rho, Basis::Star);
        let behind = normal.dot(&nominal) < 0.0 && gamma < CONTOUR_GAMMA;
        if !behind {
            self.contour = None;
        } else if self.contour.is_none() && free.norm() < CONTOUR_SHARE * speed {
            let left = tangent.dot(&nominal) >= 0.0;
            self.contour = Some(if left { Side::Left } else { Side::Right });
        }
        let wanted = match self.contour {
            None => free,
            Some(side) => {
                let along = tangent * side.sign() + normal * (CONTOUR_TRACK_GAMMA - gamma).clamp(-0.5, 0.5);
                modulate(&self.sensed, point, along * speed, rho, Basis::Star)
            }
        };
        // Inside the clearance, move outward first: the wall itself may be only a bead's radius away.
        let outward = normal * (speed * (1.0 - gamma).clamp(0.0, 1.0));
        (wanted + outward).try_normalize(1e-9).map_or(wanted, |direction| direction * speed)
    }

    /// The flow at a place, without memory of a followed contour. Obstacles are sensed from that place.
    ///
    /// `None` over a known obstacle.
    pub fn flow_at(
        place: Point2<f64>,
        goal_m: Point2<f64>,
        known: &ObstacleMap,
        parameters: &Parameters,
    ) -> Option<Vector2<f64>> {
        if known.state(place) == CellState::Obstacle {
            return None;
        }
        let half_m = parameters.camera_height_m * (0.5 * parameters.camera_field_of_view_rad).tan();
        let mut fresh = Self::default();
        fresh.sense(&ObstacleMask::around(known, place, half_m), place, parameters);
        Some(fresh.velocity(place, goal_m, parameters))
    }

    /// Fits superellipses to nearby obstacles; returns the patches, nearest first.
    fn sense(&mut self, mask: &ObstacleMask, from: Point2<f64>, parameters: &Parameters) -> Vec<Patch> {
        let patches = mask.patches(from, SENSED_M);
        let safety = parameters.attractor_safety_factor;
        let around = |patch| Superellipse::around(patch, safety, clearance_m(parameters));
        self.sensed = patches.iter().map(around).collect();
        patches
    }

    /// Follows the flow at the servo rate for one control period.
    ///
    /// The literal law senses the image's obstacles again from each place. A step is about as long as the sensed part is
    /// wide: without this, the flow would bend into the wall behind the end of that part.
    fn flow(&mut self, input: &TransportInput<'_>, mask: &ObstacleMask) -> Point2<f64> {
        let ticks = (CONTROL_PERIOD_S / SERVO_PERIOD_S).round() as usize;
        let mut point = input.tool_m;
        for tick in 0..ticks {
            if input.parameters.attractor_law == AttractorLaw::Literal && tick > 0 {
                self.sense(mask, point, input.parameters);
            }
            point += self.velocity(point, input.goal_m, input.parameters) * SERVO_PERIOD_S;
        }
        // The straight segment must not be longer than the speed limit allows.
        let reach_m = input.parameters.transport_speed_m_s * CONTROL_PERIOD_S;
        input.tool_m + (point - input.tool_m).cap_magnitude(reach_m)
    }
}

/// Velocity of the nearest wall toward the tool: how much its distance has changed since the last control step. `None` if
/// it does not approach: the flow does not follow a wall that retreats.
fn approach_m_s(before: &[Superellipse], now: &[Superellipse], tool_m: Point2<f64>) -> Option<Vector2<f64>> {
    let nearest = |all: &[Superellipse]| {
        let ends = all.iter().map(|obstacle| obstacle.nearest_m(tool_m));
        ends.min_by(|a, b| (a - tool_m).norm().total_cmp(&(b - tool_m).norm()))
    };
    let (last_m, place_m) = (nearest(before)?, nearest(now)?);
    let away = tool_m - place_m;
    let normal = away.try_normalize(1e-6)?;
    let speed_m_s = ((tool_m - last_m).norm() - away.norm()) / CONTROL_PERIOD_S;
    let is_same_wall = (last_m - place_m).norm() < SENSED_M;
    (is_same_wall && speed_m_s > 0.0).then(|| normal * speed_m_s.min(MOST_WALL_M_S))
}

/// Extra distance between a patch's superellipse and the tool.
fn clearance_m(parameters: &Parameters) -> f64 {
    match parameters.attractor_law {
        AttractorLaw::Literal => 0.0,
        AttractorLaw::Improved => parameters.attractor_clearance_m,
    }
}

/// The obstacle with the smallest Γ at a point inside it; `None` if the point is outside all.
fn deepest(obstacles: &[Superellipse], point: Point2<f64>) -> Option<&Superellipse> {
    let inside = obstacles.iter().map(|obstacle| (obstacle, obstacle.gamma(point))).filter(|(_, gamma)| *gamma < 1.0);
    inside.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(obstacle, _)| obstacle)
}

impl Transport for Attractor {
    fn start_leg(&mut self) {
        self.contour = None;
        self.progress = Progress::default();
        self.trouble = None;
        self.wall_m_s = None;
    }

    fn trouble(&self) -> Option<Trouble> {
        self.trouble
    }

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let parameters = input.parameters;
        let mask = ObstacleMask::of(input.percept);
        let before = std::mem::take(&mut self.sensed);
        let patches = self.sense(&mask, input.tool_m, parameters);
        let may_move = input.known.forgets() && parameters.attractor_law == AttractorLaw::Improved;
        self.wall_m_s = if may_move { approach_m_s(&before, &self.sensed, input.tool_m) } else { None };
        self.progress.note(input.tool_m);
        let is_inside = deepest(&self.sensed, input.tool_m).is_some();
        self.trouble = self.progress.standstill().map(|standstill| match standstill {
            Standstill::Still if is_inside => Trouble::InsideObstacle,
            Standstill::Still => Trouble::Saddle,
            Standstill::Around => Trouble::Circling,
        });
        let mut target_m = self.flow(input, &mask);
        if parameters.attractor_law == AttractorLaw::Improved {
            let reach_m = parameters.transport_speed_m_s * CONTROL_PERIOD_S;
            let blocked = input.percept.obstacle_on_step(input.tool_m, target_m).is_some();
            let beside =
                patches.first().is_some_and(|p| (p.nearest_m - input.tool_m).norm() < 0.5 * clearance_m(parameters));
            if let (true, Some(direction)) = (beside || input.percept.obstacle(), mask.exit_direction(input.tool_m)) {
                // After a fetch the tool may be over or close to a wall that the bead leans on. There a superellipse's
                // normal is meaningless: leave the wall first.
                target_m = input.tool_m + direction * reach_m;
            } else if let (true, Some(side)) = (blocked, self.contour) {
                self.contour = Some(side.opposite());
                target_m = self.flow(input, &mask);
            }
        }
        let speed_m_s = (target_m - input.tool_m).norm() / CONTROL_PERIOD_S;
        Ok(TargetStep { target_m, speed_m_s: speed_m_s.min(parameters.transport_speed_m_s) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flow_to(law: AttractorLaw, start: Point2<f64>, steps: usize) -> Point2<f64> {
        // A flat 2 cm block on the path, sensed completely.
        let patch = Patch {
            center_m: Point2::new(0.0, 0.0),
            half_size_m: Vector2::new(0.01, 0.01),
            nearest_m: Point2::new(-0.01, 0.0),
        };
        let parameters = Parameters { attractor_law: law, ..Parameters::default() };
        let clearance_m = if law == AttractorLaw::Improved { parameters.attractor_clearance_m } else { 0.0 };
        let mut attractor = Attractor {
            sensed: vec![Superellipse::around(&patch, parameters.attractor_safety_factor, clearance_m)],
            ..Attractor::default()
        };
        let mut point = start;
        for _ in 0..steps {
            point += attractor.velocity(point, Point2::new(0.1, 0.0), &parameters) * SERVO_PERIOD_S;
        }
        point
    }

    #[test]
    fn behind_a_face_the_literal_law_gets_stuck_and_the_improved_law_does_not() {
        let start = Point2::new(-0.1, 0.0);
        let stuck = flow_to(AttractorLaw::Literal, start, 4000);
        assert!(stuck.x < -0.01, "{stuck}");
        let free = flow_to(AttractorLaw::Improved, start, 4000);
        assert!((free - Point2::new(0.1, 0.0)).norm() < 0.005, "{free}");
    }

    #[test]
    fn flow_does_not_enter_obstacles() {
        for law in [AttractorLaw::Literal, AttractorLaw::Improved] {
            for k in 0..40 {
                let start = Point2::new(-0.1, -0.06 + 0.003 * f64::from(k));
                for steps in [300, 600, 900, 1200] {
                    let point = flow_to(law, start, steps);
                    assert!(point.x.abs() > 0.01 || point.y.abs() > 0.01, "{law:?} {start} {point}");
                }
            }
        }
    }
}
