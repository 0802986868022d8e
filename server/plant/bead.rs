//! The bead on the table: Coulomb stick-slip with a load that the magnet changes, rolling as an option,
//! viscous drag, lift-off, and the hand.

use serde::{Deserialize, Serialize};

use super::{BEAD_RADIUS_M, Plant, PlantState, contact};
use crate::geometry::{Isometry3, Point2, Point3, Vector2};
use crate::magnetics::dipole;
use crate::map::Map;

/// Stiffness of the hand's spring: 1 mN a millimetre, so that a fifth of the bead's weight shows as
/// one millimetre.
pub const HAND_STIFFNESS_N_M: f64 = 1.0;
/// The hand moves the bead no faster than this (specification §2).
pub const HAND_SPEED_LIMIT_M_S: f64 = 1.0;

/// No kick makes the bead faster than this.
const KICKED_M_S: f64 = 4.1;
/// Moment of inertia of a sphere in units of m·r².
const SPHERE_INERTIA: f64 = 0.4;

/// How the bead moves over the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BeadMotion {
    /// The field holds its moment, and with it the sphere: it slides (specification §2).
    #[default]
    Sliding,
    /// The sphere is free to turn: it rolls where friction suffices, against a rolling resistance.
    Rolling,
}

/// State of the bead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bead {
    /// Centre, in the table's plane.
    pub position_m: Point2<f64>,
    /// Its velocity.
    pub velocity_m_s: Vector2<f64>,
    /// The velocity at which its rotation alone would roll it; zero while it only slides.
    pub roll_m_s: Vector2<f64>,
    /// Whether it has jumped to the magnet.
    pub lifted_off: bool,
}

impl Bead {
    /// A bead at rest.
    pub fn at(position_m: Point2<f64>) -> Self {
        Self { position_m, velocity_m_s: Vector2::zeros(), roll_m_s: Vector2::zeros(), lifted_off: false }
    }

    /// Height of the centre.
    pub fn height_m(&self, tool_m: Point3<f64>) -> f64 {
        if self.lifted_off { tool_m.z - BEAD_RADIUS_M } else { BEAD_RADIUS_M }
    }

    /// Kinetic energy, that of the rotation included.
    pub fn kinetic_energy_j(&self) -> f64 {
        0.5 * dipole::mass_kg() * (self.velocity_m_s.norm_squared() + SPHERE_INERTIA * self.roll_m_s.norm_squared())
    }

    /// Kicks it. Kicks that come together do not add up to more than the strongest one.
    pub fn kick(&mut self, impulse_n_s: Vector2<f64>) {
        let most_m_s = self.velocity_m_s.norm().max(KICKED_M_S);
        self.velocity_m_s = (self.velocity_m_s + impulse_n_s / dipole::mass_kg()).cap_magnitude(most_m_s);
    }

    fn jump_to(&mut self, tool_m: Point2<f64>) {
        *self = Self { lifted_off: true, ..Self::at(tool_m) };
    }
}

impl Plant {
    /// Force of the hand's spring on the bead.
    pub fn hand_force_n(state: &PlantState) -> f64 {
        let stretch = |hand: super::Hand| (hand.target_m - state.bead.position_m).norm();
        state.hand.map_or(0.0, |hand| HAND_STIFFNESS_N_M * stretch(hand))
    }

    pub(super) fn step_bead(&self, state: &mut PlantState, map: &Map, base_from_tool: &Isometry3<f64>, dt_s: f64) {
        let hand = state.hand;
        let bead = &mut state.bead;
        let tool_m = Point2::from(base_from_tool.translation.vector.xy());
        if bead.lifted_off {
            bead.jump_to(tool_m);
            return;
        }
        let load = self.load(base_from_tool, bead.position_m);
        if load.vertical_n >= dipole::weight_n() && hand.is_none() {
            bead.jump_to(tool_m);
            return;
        }
        let mass_kg = dipole::mass_kg();
        let mut force_n = load.lateral_n + state.drift_n;
        let mut damping_n_s_m = self.parameters.drag_n_s_m;
        let mut normal_n = (dipole::weight_n() - load.vertical_n).max(0.0);
        if let Some(hand) = hand {
            force_n += HAND_STIFFNESS_N_M * (hand.target_m - bead.position_m);
            damping_n_s_m += 2.0 * (HAND_STIFFNESS_N_M * mass_kg).sqrt();
            if hand.lift {
                normal_n = 0.0;
            }
        }
        // Friction is an impulse that can stop but never reverse the bead, so that sticking is exact at
        // any step length. Drag is implicit, and last, so that it does not help the bead to stick.
        bead.velocity_m_s += force_n * (dt_s / mass_kg);
        let is_lifted = hand.is_some_and(|hand| hand.lift);
        let wall_friction_m_s = if is_lifted { 0.0 } else { contact::lean(bead, map) };
        self.rub(bead, normal_n * dt_s / mass_kg);
        bead.velocity_m_s = shrunk(bead.velocity_m_s, wall_friction_m_s);
        bead.velocity_m_s /= 1.0 + damping_n_s_m * dt_s / mass_kg;
        let speed_m_s = bead.velocity_m_s.norm();
        if hand.is_some() && speed_m_s > HAND_SPEED_LIMIT_M_S {
            bead.velocity_m_s *= HAND_SPEED_LIMIT_M_S / speed_m_s;
        }
        if is_lifted {
            // Over walls, but not over the table's edge.
            let next_m = bead.position_m + bead.velocity_m_s * dt_s;
            let w = map.workspace();
            bead.position_m = Point2::new(next_m.x.clamp(w.x_min_m, w.x_max_m), next_m.y.clamp(w.y_min_m, w.y_max_m));
            if bead.position_m != next_m {
                bead.velocity_m_s = Vector2::zeros();
            }
        } else {
            contact::advance(bead, map, dt_s);
        }
    }

    /// Friction and rolling resistance; `load_m_s` is the normal impulse over the mass.
    ///
    /// A sphere that slips gains 5/2 as much rolling velocity as it loses of its own (its inertia is
    /// 2/5·m·r²), until both are equal and it rolls; then 7/5 of its mass resists (Goldstein,
    /// *Classical Mechanics*, §5).
    fn rub(&self, bead: &mut Bead, load_m_s: f64) {
        let friction_m_s = self.parameters.friction * load_m_s;
        let resistance = self.parameters.rolling_resistance;
        // A resistance beyond the friction never lets it begin to roll.
        if self.parameters.bead_motion == BeadMotion::Sliding || resistance >= self.parameters.friction {
            bead.roll_m_s = Vector2::zeros();
            bead.velocity_m_s = shrunk(bead.velocity_m_s, friction_m_s);
            return;
        }
        let common = (bead.velocity_m_s + bead.roll_m_s * SPHERE_INERTIA) / (1.0 + SPHERE_INERTIA);
        let rolling = shrunk(common, resistance * load_m_s / (1.0 + SPHERE_INERTIA));
        if (bead.velocity_m_s - rolling).norm() <= friction_m_s {
            (bead.velocity_m_s, bead.roll_m_s) = (rolling, rolling);
            return;
        }
        // It would take more than Coulomb's friction: the bead slips.
        let slip = bead.velocity_m_s - bead.roll_m_s;
        let change = slip.try_normalize(0.0).unwrap_or_default() * friction_m_s;
        bead.velocity_m_s -= change;
        bead.roll_m_s = shrunk(bead.roll_m_s + change / SPHERE_INERTIA, resistance * load_m_s / SPHERE_INERTIA);
    }
}

/// `velocity` made slower by `by_m_s`, at most to rest.
pub(super) fn shrunk(velocity: Vector2<f64>, by_m_s: f64) -> Vector2<f64> {
    let speed_m_s = velocity.norm();
    if speed_m_s > by_m_s { velocity * (1.0 - by_m_s / speed_m_s) } else { Vector2::zeros() }
}
