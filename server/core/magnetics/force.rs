//! The pull of the block on the bead, and how far it reaches.
//!
//! The bead is free to turn and so stays aligned with the field: its energy is −m|B|, and the force
//! on it is F = m∇|B|. The block has one of three orientations; in all of them the axis of its
//! magnetisation and the offsets below lie in the block's x or z.

use super::{
    cuboid::Cuboid,
    dipole::{self, BLOCK_REMANENCE_T, SPHERE_DIAMETER_M},
};
use crate::geometry::Vector3;
use serde::{Deserialize, Serialize};

/// Offset at which the search for the capture interval begins, m: so far away, no pull of this block exceeds a friction
/// of 0.001. An interval that ends here has no outer end.
pub const FARTHEST_M: f64 = 0.5;
/// Step of that search, m.
const SCAN_STEP_M: f64 = 1e-3;

/// How the block, 50 × 25 × 10 mm and magnetised across a face, hangs on the tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Orientation {
    /// Flat, 50 mm along x and 25 mm along y; magnetised along the vertical 10 mm side.
    #[default]
    A,
    /// On edge, 50 mm along y and 25 mm high; magnetised along the 10 mm side, which lies along x.
    B,
    /// Flat as A, but magnetised along the 50 mm side, which lies along x.
    C,
}

/// The block in an orientation, magnetised to `remanence_t` (T); its sides lie along the axes.
///
/// A remanence that is not a number gives fields that are not.
pub fn block(orientation: Orientation, remanence_t: f64) -> Cuboid {
    let (size_m, direction) = match orientation {
        Orientation::A => (Vector3::new(0.050, 0.025, 0.010), Vector3::z()),
        Orientation::B => (Vector3::new(0.010, 0.050, 0.025), Vector3::x()),
        Orientation::C => (Vector3::new(0.050, 0.025, 0.010), Vector3::x()),
    };
    Cuboid { half_size_m: size_m * 0.5, polarization_t: direction * remanence_t }
}

/// Half of the block's height, m: from its centre down to its lower face.
pub fn half_height_m(orientation: Orientation) -> f64 {
    block(orientation, BLOCK_REMANENCE_T).half_size_m.z
}

/// The force, N, on a sphere of moment `moment_a_m2` (A·m²) that is aligned with the field, with its
/// centre at `point_m` (m) from the block's centre: F = m∇|B| = m(∇B)ᵀB/|B|.
///
/// Exact for the point outside the block: a sphere in a harmonic field feels the force of its centre.
/// Zero where there is no field, because there is no direction to align with.
pub fn force_n(block: &Cuboid, point_m: &Vector3<f64>, moment_a_m2: f64) -> Vector3<f64> {
    let (field, gradient) = block.field_and_gradient(point_m);
    let strength_t = field.norm();
    if strength_t == 0.0 {
        return Vector3::zeros();
    }
    gradient.tr_mul(&field) * (moment_a_m2 / strength_t)
}

/// Height of the block's centre above the table, m, at which a bead lying right below it weighs
/// nothing; below this height it jumps to the block.
pub fn lift_off_height_m(orientation: Orientation) -> f64 {
    let block = block(orientation, BLOCK_REMANENCE_T);
    let weight_n = dipole::weight_n();
    let touching_m = half_height_m(orientation) + SPHERE_DIAMETER_M;
    bisect(touching_m, FARTHEST_M, |height_m| pull_n(&block, [0.0; 2], height_m).1 >= weight_n)
}

/// Horizontal distances `(inner_m, outer_m)`, m, between which a bead that lies on the table beside
/// the block is dragged towards it, with the block's lower face `lower_face_height_m` (m) above the table.
///
/// It is dragged where the lateral pull is at least `friction`·(W − Fz), friction being Coulomb's
/// coefficient. The offset is along the block's x turned by `direction_rad` toward its y. Within
/// `inner_m` the bead either rests, because the pull is nearly vertical, or lifts off. `None` where no
/// bead is dragged, the bead does not fit below the block, or an argument is not a number. Without
/// friction the outer distance is only the end of the search, 0.5 m.
pub fn capture_interval_m(
    orientation: Orientation,
    lower_face_height_m: f64,
    friction: f64,
    direction_rad: f64,
) -> Option<(f64, f64)> {
    // NaN fails the comparison too, and so is refused.
    if !(lower_face_height_m >= SPHERE_DIAMETER_M && friction >= 0.0) {
        return None;
    }
    let block = block(orientation, BLOCK_REMANENCE_T);
    let height_m = lower_face_height_m + block.half_size_m.z;
    let weight_n = dipole::weight_n();
    let (sin, cos) = direction_rad.sin_cos();
    let is_dragged = |offset_m: f64| {
        let (lateral_n, up_n) = pull_n(&block, [offset_m * cos, offset_m * sin], height_m);
        up_n < weight_n && lateral_n >= friction * (weight_n - up_n)
    };
    // From far away inwards: the first offset that drags, then the first that no longer does.
    let steps = (FARTHEST_M / SCAN_STEP_M).round() as u32;
    let mut offsets_m = (0..=steps).rev().map(|k| SCAN_STEP_M * f64::from(k));
    let found_m = offsets_m.find(|&offset_m| is_dragged(offset_m))?;
    let outer_m = if found_m < FARTHEST_M { bisect(found_m, found_m + SCAN_STEP_M, is_dragged) } else { FARTHEST_M };
    let inner_m = match offsets_m.find(|&offset_m| !is_dragged(offset_m)) {
        Some(lost_m) => bisect(lost_m, lost_m + SCAN_STEP_M, |offset_m| !is_dragged(offset_m)),
        None => 0.0,
    };
    Some((inner_m, outer_m))
}

/// The outer end of [`capture_interval_m`] along x, m: how far the block drags a bead.
pub fn capture_radius_m(orientation: Orientation, lower_face_height_m: f64, friction: f64) -> Option<f64> {
    capture_interval_m(orientation, lower_face_height_m, friction, 0.0).map(|(_, outer_m)| outer_m)
}

/// Pull in the table's plane and upwards, N, on a bead on the table at `offset_m` from the block's middle,
/// with the block's centre `height_m` above the table.
pub(super) fn pull_n(block: &Cuboid, offset_m: [f64; 2], height_m: f64) -> (f64, f64) {
    let point_m = Vector3::new(offset_m[0], offset_m[1], 0.5 * SPHERE_DIAMETER_M - height_m);
    let force = force_n(block, &point_m, dipole::moment_a_m2());
    (force.xy().norm(), force.z)
}

/// Where `holds` turns false between `low`, where it is true, and `high`, where it is not.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Block centre above the table in the reference table, m.
    const HEIGHT_M: f64 = 0.100;

    /// Fz and the pull towards the block, in weights, at a horizontal offset from the block's centre.
    fn pull(orientation: Orientation, x_m: f64, y_m: f64) -> [f64; 2] {
        let block = block(orientation, BLOCK_REMANENCE_T);
        let point_m = Vector3::new(x_m, y_m, 0.5 * SPHERE_DIAMETER_M - HEIGHT_M);
        let force = force_n(&block, &point_m, dipole::moment_a_m2()) / dipole::weight_n();
        [force.z, -force.x - force.y]
    }

    #[test]
    fn pull_is_that_of_the_reference_table() {
        // offset in cm, then Fz and lateral pull for A, B along, B across, C along, in weights.
        let table = [
            (0.0, [[0.976, 0.0], [0.549, 0.0], [0.549, 0.0], [0.469, 0.0]]),
            (2.0, [[0.879, 0.202], [0.538, 0.022], [0.501, 0.095], [0.471, 0.003]]),
            (4.0, [[0.651, 0.309], [0.478, 0.079], [0.386, 0.147], [0.445, 0.048]]),
            (6.0, [[0.410, 0.307], [0.369, 0.124], [0.261, 0.151], [0.367, 0.099]]),
            (8.0, [[0.231, 0.246], [0.256, 0.133], [0.163, 0.127], [0.267, 0.121]]),
            (10.0, [[0.123, 0.177], [0.168, 0.118], [0.098, 0.097], [0.180, 0.115]]),
            (15.0, [[0.025, 0.067], [0.056, 0.064], [0.028, 0.042], [0.060, 0.065]]),
        ];
        let mut wrong = Vec::new();
        for (offset_cm, row) in table {
            let d_m = offset_cm * 0.01;
            let found = [
                pull(Orientation::A, d_m, 0.0),
                pull(Orientation::B, d_m, 0.0),
                pull(Orientation::B, 0.0, d_m),
                pull(Orientation::C, d_m, 0.0),
            ];
            for (column, (found, printed)) in found.iter().zip(row).enumerate() {
                for (f, p) in found.iter().zip(printed) {
                    if (f - p).abs() > 0.5e-3 {
                        wrong.push(format!("{offset_cm} cm, column {column}: {f:.5} for {p}"));
                    }
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn bead_lifts_off_where_it_should() {
        let expected = [(Orientation::A, 0.0994), (Orientation::B, 0.0863), (Orientation::C, 0.0815)];
        for (orientation, height_m) in expected {
            let found_m = lift_off_height_m(orientation);
            assert!((found_m - height_m).abs() < 0.5e-4, "{orientation:?} {found_m}");
        }
    }

    #[test]
    fn capture_reaches_as_far_as_it_should() {
        // Lower face, or centre, 100 mm above the table; computed independently from the field's
        // printed formula with differences of the fourth order.
        for (lower_face_height_m, expected_m) in [(0.100, 0.09473), (0.095, 0.10042)] {
            let found_m = capture_radius_m(Orientation::A, lower_face_height_m, 0.2).unwrap();
            assert!((found_m - expected_m).abs() < 0.5e-5, "{found_m}");
        }
    }

    #[test]
    fn capture_interval_has_a_hole_and_may_be_empty() {
        let (inner_m, outer_m) = capture_interval_m(Orientation::A, 0.100, 0.2, 0.0).unwrap();
        assert!(0.0 < inner_m && inner_m < outer_m, "{inner_m} {outer_m}");
        assert_eq!(capture_interval_m(Orientation::A, 0.300, 0.2, 0.0), None);
        assert_eq!(capture_interval_m(Orientation::A, 0.004, 0.2, 0.0), None);
        assert_eq!(capture_interval_m(Orientation::A, f64::NAN, 0.2, 0.0), None);
        assert_eq!(capture_interval_m(Orientation::A, 0.1, f64::NAN, 0.0), None);
        assert_eq!(capture_radius_m(Orientation::A, 0.1, 0.0), Some(FARTHEST_M));
    }

    #[test]
    fn force_is_the_gradient_of_the_field_strength() {
        let block = block(Orientation::C, BLOCK_REMANENCE_T);
        let point_m = Vector3::new(0.03, -0.02, -0.08);
        let moment = dipole::moment_a_m2();
        let force = force_n(&block, &point_m, moment);
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = 1e-5;
            let [after, before] = [step, -step].map(|s| block.field_t(&(point_m + s)).norm());
            let expected_n = moment * (after - before) / 2e-5;
            assert!((force[axis] - expected_n).abs() < 1e-9);
        }
    }
}
