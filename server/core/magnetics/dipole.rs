//! The bead, a sphere of NdFeB (N42), and the field of a point dipole.
//!
//! A uniformly magnetised sphere makes exactly the field of a dipole at its centre, and in a field whose
//! sources lie outside it the force on it is exactly that on the dipole.

use super::VACUUM_PERMEABILITY_T_M_A;
use crate::geometry::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Diameter of the bead, m.
pub const SPHERE_DIAMETER_M: f64 = 5e-3;
/// Remanence of the bead (N42: 1.28 to 1.33), T.
pub const SPHERE_REMANENCE_T: f64 = 1.30;
/// Density of sintered NdFeB, kg/m³.
pub const SPHERE_DENSITY_KG_M3: f64 = 7500.0;
/// Remanence of the block on the tool (N35: 1.17 to 1.21), T.
pub const BLOCK_REMANENCE_T: f64 = 1.19;
/// Acceleration of free fall, m/s².
pub const GRAVITY_M_S2: f64 = 9.81;

/// Volume of the bead, m³.
pub fn volume_m3() -> f64 {
    PI / 6.0 * SPHERE_DIAMETER_M.powi(3)
}

/// Mass of the bead, kg: 0.491 g.
pub fn mass_kg() -> f64 {
    SPHERE_DENSITY_KG_M3 * volume_m3()
}

/// Weight W of the bead, N: 4.815 mN.
pub fn weight_n() -> f64 {
    mass_kg() * GRAVITY_M_S2
}

/// Magnetic moment of the bead, A·m²: 0.0677, remanence times volume over μ0.
pub fn moment_a_m2() -> f64 {
    SPHERE_REMANENCE_T * volume_m3() / VACUUM_PERMEABILITY_T_M_A
}

/// The field of a point dipole, T, at `from_dipole_m` (m) from a dipole of `moment_a_m2` (A·m²).
///
/// B = μ0/4π · (3n(n·m) − m)/r³ with n the unit vector to the point (Jackson, *Classical
/// Electrodynamics*, eq. 5.56). NaN at the dipole itself.
pub fn field_t(moment_a_m2: &Vector3<f64>, from_dipole_m: &Vector3<f64>) -> Vector3<f64> {
    let r = from_dipole_m.norm();
    let n = from_dipole_m / r;
    let scale = VACUUM_PERMEABILITY_T_M_A / (4.0 * PI) / (r * r * r);
    (n * (3.0 * n.dot(moment_a_m2)) - moment_a_m2) * scale
}

/// The gradient of [`field_t`], T/m: entry (i, j) is ∂B_i/∂x_j.
///
/// ∂B_i/∂x_j = 3μ0/(4πr⁴) · ((n·m)(δ_ij − 5 n_i n_j) + m_i n_j + n_i m_j), symmetric and traceless.
pub fn gradient_t_m(moment_a_m2: &Vector3<f64>, from_dipole_m: &Vector3<f64>) -> Matrix3<f64> {
    let r = from_dipole_m.norm();
    let n = from_dipole_m / r;
    let scale = 3.0 * VACUUM_PERMEABILITY_T_M_A / (4.0 * PI) / (r * r * r * r);
    let along = n.dot(moment_a_m2);
    let mixed = moment_a_m2 * n.transpose();
    let axial = (Matrix3::identity() - n * n.transpose() * 5.0) * along;
    (axial + mixed + mixed.transpose()) * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bead_mass_and_moment_match_their_published_values() {
        assert!((mass_kg() - 0.491e-3).abs() < 0.5e-6);
        assert!((weight_n() - 4.815e-3).abs() < 0.5e-6 + 1e-9);
        assert!((moment_a_m2() - 0.0677).abs() < 0.5e-4);
    }

    #[test]
    fn field_on_the_axis_is_twice_that_at_the_equator() {
        let moment = Vector3::new(0.0, 0.0, 2.0);
        let axis = field_t(&moment, &Vector3::new(0.0, 0.0, 0.1));
        let beside = field_t(&moment, &Vector3::new(0.1, 0.0, 0.0));
        assert!((axis.z - 2.0e-7 * 2.0 / 1e-3).abs() < 1e-12);
        assert!((axis + beside * 2.0).norm() < 1e-15);
    }

    proptest! {
        #[test]
        fn gradient_matches_differences_of_the_field(
            moment in prop::array::uniform3(-2.0..2.0),
            point in prop::array::uniform3(0.05..0.2),
        ) {
            let (moment, point) = (Vector3::from(moment), Vector3::from(point));
            let gradient = gradient_t_m(&moment, &point);
            let step_m = 1e-6;
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = step_m;
                let rise = field_t(&moment, &(point + step)) - field_t(&moment, &(point - step));
                let error = rise / (2.0 * step_m) - gradient.column(axis);
                prop_assert!(error.norm() < 1e-7 * gradient.norm() + 1e-9);
            }
        }
    }
}
