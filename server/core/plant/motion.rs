//! How the bead moves over the table: Coulomb stick-slip with a load that the magnet changes, rolling as an option,
//! viscous drag, lift-off, and the hand.

use super::bead::{SPHERE_INERTIA, shrunk};
use super::walls::Walls;
use super::{Bead, BeadMotion, Plant, PlantState, contact};
use crate::geometry::{Isometry3, Point2, Vector2};
use crate::magnetics::dipole;

/// Stiffness of the hand's spring: 1 mN per millimetre, so that a fifth of the bead's weight is one millimetre.
pub const HAND_STIFFNESS_N_M: f64 = 1.0;
/// The hand moves the bead no faster than this (specification §2).
pub const HAND_SPEED_LIMIT_M_S: f64 = 1.0;

impl Plant {
    /// Force of the hand's spring on the bead.
    pub fn hand_force_n(state: &PlantState) -> f64 {
        let stretch = |hand: super::Hand| (hand.target_m - state.bead.position_m).norm();
        state.hand.map_or(0.0, |hand| HAND_STIFFNESS_N_M * stretch(hand))
    }

    /// Moves the bead for a step. Returns the work of the walls on it, J.
    pub(super) fn step_bead(
        &self,
        state: &mut PlantState,
        walls: &Walls,
        base_from_tool: &Isometry3<f64>,
        dt_s: f64,
    ) -> f64 {
        let hand = state.hand;
        let bead = &mut state.bead;
        let tool_m = Point2::from(base_from_tool.translation.vector.xy());
        if bead.lifted_off {
            bead.jump_to(tool_m);
            return 0.0;
        }
        let load = self.load(base_from_tool, bead.position_m);
        if load.vertical_n >= dipole::weight_n() && hand.is_none() {
            bead.jump_to(tool_m);
            return 0.0;
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
        let lean = if is_lifted { contact::Lean::default() } else { contact::lean(bead, walls) };
        self.rub(bead, normal_n * dt_s / mass_kg);
        bead.velocity_m_s = shrunk(bead.velocity_m_s, lean.friction_m_s);
        if self.parameters.flow_m_s != 0.0 {
            // The drag is relative to the fluid.
            let flow_m_s = walls.flow(bead.position_m) * self.parameters.flow_m_s;
            bead.velocity_m_s += flow_m_s * (self.parameters.drag_n_s_m * dt_s / mass_kg);
        }
        bead.velocity_m_s /= 1.0 + damping_n_s_m * dt_s / mass_kg;
        let speed_m_s = bead.velocity_m_s.norm();
        if hand.is_some() && speed_m_s > HAND_SPEED_LIMIT_M_S {
            bead.velocity_m_s *= HAND_SPEED_LIMIT_M_S / speed_m_s;
        }
        if is_lifted {
            // Over walls, but not over the table's edge.
            let next_m = bead.position_m + bead.velocity_m_s * dt_s;
            bead.position_m = walls.workspace().nearest(next_m);
            if bead.position_m != next_m {
                bead.velocity_m_s = Vector2::zeros();
            }
            0.0
        } else {
            mass_kg * (lean.work_m2_s2 + contact::advance(bead, walls, dt_s))
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
        // With more rolling resistance than friction it never begins to roll.
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
        // Coulomb's friction is not large enough, so the bead slips.
        let slip = bead.velocity_m_s - bead.roll_m_s;
        let change = slip.try_normalize(0.0).unwrap_or_default() * friction_m_s;
        bead.velocity_m_s -= change;
        bead.roll_m_s = shrunk(bead.roll_m_s + change / SPHERE_INERTIA, resistance * load_m_s / SPHERE_INERTIA);
    }
}
