//! The state of the bead.

use serde::{Deserialize, Serialize};

use super::BEAD_RADIUS_M;
use crate::geometry::{Point2, Point3, Vector2};
use crate::magnetics::dipole;

/// Maximum speed of the bead after a kick.
const KICKED_M_S: f64 = 4.1;
/// Moment of inertia of a sphere in units of m·r².
pub(super) const SPHERE_INERTIA: f64 = 0.4;

/// How the bead moves over the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BeadMotion {
    /// The field holds the sphere's moment and so its orientation: the bead slides.
    #[default]
    Sliding,
    /// The sphere can rotate: it rolls if friction is large enough, against a rolling resistance.
    Rolling,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bead {
    /// Centre, in the table's plane.
    pub position_m: Point2<f64>,
    pub velocity_m_s: Vector2<f64>,
    /// The velocity that corresponds to its rotation (pure rolling); zero while it only slides.
    pub roll_m_s: Vector2<f64>,
    /// Whether it has jumped to the magnet and hangs there.
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

    /// Kinetic energy, including rotation.
    pub fn kinetic_energy_j(&self) -> f64 {
        0.5 * dipole::mass_kg() * (self.velocity_m_s.norm_squared() + SPHERE_INERTIA * self.roll_m_s.norm_squared())
    }

    /// Applies a kick. Simultaneous kicks do not add up to more than the strongest one.
    pub fn kick(&mut self, impulse_n_s: Vector2<f64>) {
        let most_m_s = self.velocity_m_s.norm().max(KICKED_M_S);
        self.velocity_m_s = (self.velocity_m_s + impulse_n_s / dipole::mass_kg()).cap_magnitude(most_m_s);
    }

    pub(super) fn jump_to(&mut self, tool_m: Point2<f64>) {
        *self = Self { lifted_off: true, ..Self::at(tool_m) };
    }
}

/// `velocity` made slower by `by_m_s`, at most to rest.
pub(super) fn shrunk(velocity: Vector2<f64>, by_m_s: f64) -> Vector2<f64> {
    let speed_m_s = velocity.norm();
    if speed_m_s > by_m_s { velocity * (1.0 - by_m_s / speed_m_s) } else { Vector2::zeros() }
}
