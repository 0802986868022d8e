//! A block at any position and rotation.

use super::{cuboid::Cuboid, force};
use crate::geometry::{Isometry3, Point3, Vector3};

/// A block and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosedBlock {
    pub block: Cuboid,
    /// The pose in `base` of the frame at its centre, with axes along its sides.
    pub base_from_block: Isometry3<f64>,
}

impl PosedBlock {
    /// [`Cuboid::field_t`] with the point (m) and the field (T) in `base`.
    pub fn field_t(&self, point_base_m: &Point3<f64>) -> Vector3<f64> {
        self.base_from_block * self.block.field_t(&self.in_block_m(point_base_m))
    }

    /// [`Self::field_t`] at each of many points, the same to the last bit, at half the cost.
    pub fn fields_t(&self, points_base_m: &[Point3<f64>]) -> Vec<Vector3<f64>> {
        let points_m: Vec<_> = points_base_m.iter().map(|point| self.in_block_m(point)).collect();
        let mut fields = self.block.fields_t(&points_m);
        for field in &mut fields {
            *field = self.base_from_block * *field;
        }
        fields
    }

    /// [`force::force_n`] on a sphere of `moment_a_m2` (A·m²) that is aligned with the field, its centre
    /// (m) and the force (N) in `base`.
    pub fn force_n(&self, point_base_m: &Point3<f64>, moment_a_m2: f64) -> Vector3<f64> {
        self.base_from_block * force::force_n(&self.block, &self.in_block_m(point_base_m), moment_a_m2)
    }

    fn in_block_m(&self, point_base_m: &Point3<f64>) -> Vector3<f64> {
        self.base_from_block.inverse_transform_point(point_base_m).coords
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::UnitQuaternion;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    const HALF_M: [f64; 3] = [0.025, 0.0125, 0.005];
    const POLARIZATION_T: [f64; 3] = [0.3, -0.4, 1.0];
    const MOMENT_A_M2: f64 = 0.0677;

    fn block() -> Cuboid {
        Cuboid::new(HALF_M.into(), POLARIZATION_T.into()).unwrap()
    }

    /// Up to a quarter of a metre away, at any rotation.
    fn any_pose() -> impl Strategy<Value = Isometry3<f64>> {
        let numbers = || prop::array::uniform3(-1.0..1.0);
        (numbers(), numbers())
            .prop_map(|(shift, turn)| Isometry3::new(Vector3::from(shift) * 0.25, Vector3::from(turn) * 3.0))
    }

    proptest! {
        #[test]
        fn quarter_rotations_permute_the_sides(
            turns in prop::array::uniform3(0..4),
            center in prop::array::uniform3(-0.2..0.2),
            point in prop::array::uniform3(-0.1..0.1),
        ) {
            let [x, y, z] = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
            let turn = [x, y, z].into_iter().zip(turns).fold(UnitQuaternion::identity(), |turn, (axis, quarters)| {
                UnitQuaternion::from_axis_angle(&axis, f64::from(quarters) * FRAC_PI_2) * turn
            });
            let center = Vector3::from(center);
            let posed = PosedBlock { block: block(), base_from_block: Isometry3::from_parts(center.into(), turn) };
            let [half_m, polarization_t] = [HALF_M, POLARIZATION_T].map(|v| turn * Vector3::from(v));
            let turned = Cuboid::new(half_m.abs(), polarization_t).unwrap();
            let point: Vector3<f64> = Vector3::from(point);
            // Rounding must not put the point on another side of the surface.
            prop_assume!((0..3).all(|k| (point[k].abs() - turned.half_size_m[k]).abs() > 1e-6));
            let base = Point3::from(center + point);
            let expected = turned.field_t(&point);
            prop_assert!((posed.field_t(&base) - expected).norm() < 1e-9 * expected.norm());
            let expected = force::force_n(&turned, &point, MOMENT_A_M2);
            prop_assert!((posed.force_n(&base, MOMENT_A_M2) - expected).norm() < 1e-8 * expected.norm());
        }

        #[test]
        fn moving_magnet_and_point_together_changes_nothing(
            pose in any_pose(),
            motion in any_pose(),
            point in prop::array::uniform3(-0.3..0.3),
        ) {
            let (here, point) = (PosedBlock { block: block(), base_from_block: pose }, Point3::from(point));
            let from_center = pose.inverse_transform_point(&point).coords.abs() - Vector3::from(HALF_M);
            prop_assume!(from_center.iter().all(|distance| distance.abs() > 1e-6));
            let there = PosedBlock { base_from_block: motion * pose, ..here };
            let expected = motion * here.field_t(&point);
            prop_assert!((there.field_t(&(motion * point)) - expected).norm() < 1e-9 * expected.norm());
            let expected = motion * here.force_n(&point, MOMENT_A_M2);
            prop_assert!((there.force_n(&(motion * point), MOMENT_A_M2) - expected).norm() < 1e-8 * expected.norm());
        }

        #[test]
        fn many_points_equal_single_points(
            pose in any_pose(),
            points in prop::collection::vec(prop::array::uniform3(-0.3..0.3), 0..6),
        ) {
            let posed = PosedBlock { block: block(), base_from_block: pose };
            let points: Vec<_> = points.into_iter().map(Point3::from).collect();
            let expected: Vec<_> = points.iter().map(|point| posed.field_t(point)).collect();
            prop_assert_eq!(posed.fields_t(&points), expected);
        }
    }
}
