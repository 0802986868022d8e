//! The bead on the table: Coulomb stick-slip with a load that the magnet changes, viscous drag,
//! lift-off, and the hand.

use serde::{Deserialize, Serialize};

use super::{BEAD_RADIUS_M, Plant, PlantState, contact};
use crate::geometry::{Point2, Point3, Vector2};
use crate::magnetics::dipole;
use crate::map::Map;

/// Stiffness of the hand's spring: 1 mN a millimetre, so that a fifth of the bead's weight shows as
/// one millimetre.
pub const HAND_STIFFNESS_N_M: f64 = 1.0;
/// The hand moves the bead no faster than this (specification §2).
pub const HAND_SPEED_LIMIT_M_S: f64 = 1.0;

/// State of the bead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bead {
    /// Centre, in the table's plane.
    pub position_m: Point2<f64>,
    /// Its velocity.
    pub velocity_m_s: Vector2<f64>,
    /// Whether it has jumped to the magnet.
    pub lifted_off: bool,
}

impl Bead {
    /// A bead at rest.
    pub fn at(position_m: Point2<f64>) -> Self {
        Self { position_m, velocity_m_s: Vector2::zeros(), lifted_off: false }
    }

    /// Height of the centre.
    pub fn height_m(&self, tool_m: Point3<f64>) -> f64 {
        if self.lifted_off { tool_m.z - BEAD_RADIUS_M } else { BEAD_RADIUS_M }
    }
}

impl Plant {
    /// Force of the hand's spring on the bead.
    pub fn hand_force_n(state: &PlantState) -> f64 {
        let stretch = |hand: super::Hand| (hand.target_m - state.bead.position_m).norm();
        state.hand.map_or(0.0, |hand| HAND_STIFFNESS_N_M * stretch(hand))
    }

    pub(super) fn step_bead(&self, state: &mut PlantState, map: &Map, tool_m: Point3<f64>, dt_s: f64) {
        let hand = state.hand;
        let bead = &mut state.bead;
        if bead.lifted_off {
            bead.position_m = tool_m.xy();
            bead.velocity_m_s = Vector2::zeros();
            return;
        }
        let load = self.load(tool_m, bead.position_m);
        if load.vertical_n >= dipole::weight_n() && hand.is_none() {
            bead.lifted_off = true;
            bead.position_m = tool_m.xy();
            bead.velocity_m_s = Vector2::zeros();
            return;
        }
        let mass_kg = dipole::mass_kg();
        let mut force_n = load.lateral_n;
        let mut damping_n_s_m = self.parameters.drag_n_s_m;
        let mut normal_n = (dipole::weight_n() - load.vertical_n).max(0.0);
        if let Some(hand) = hand {
            force_n += HAND_STIFFNESS_N_M * (hand.target_m - bead.position_m);
            damping_n_s_m += 2.0 * (HAND_STIFFNESS_N_M * mass_kg).sqrt();
            if hand.lift {
                normal_n = 0.0;
            }
        }
        // Drag is implicit and friction an impulse that can stop but never reverse the bead, so that
        // sticking is exact at any step length.
        let mut velocity = (bead.velocity_m_s + force_n * (dt_s / mass_kg)) / (1.0 + damping_n_s_m * dt_s / mass_kg);
        let speed = velocity.norm();
        let friction_m_s = self.parameters.friction * normal_n * dt_s / mass_kg;
        velocity *= if speed > friction_m_s { 1.0 - friction_m_s / speed } else { 0.0 };
        if hand.is_some() && velocity.norm() > HAND_SPEED_LIMIT_M_S {
            velocity *= HAND_SPEED_LIMIT_M_S / velocity.norm();
        }
        bead.velocity_m_s = velocity;
        if hand.is_some_and(|hand| hand.lift) {
            bead.position_m += velocity * dt_s;
        } else {
            contact::advance(bead, map, dt_s);
        }
    }
}
