//! The magnets: a block on the tool, a bead on the table, and the pull between them.
//!
//! - [`cuboid`]: field and field gradient of a uniformly magnetised block, in closed form.
//! - [`dipole`]: the bead, which behaves as a point dipole at its centre.
//! - [`posed`]: a block at any pose, in `base`.
//! - [`force`]: the pull on the bead, and where it lifts or drags the bead.
//! - [`curves`]: the pull over offset and height, for plots.
//! - [`plane`]: field and pull over the table, for drawings.
//!
//! SI units throughout: tesla, newtons, metres, A·m². Points are given from the source's centre, in
//! axes parallel to its sides, unless they are given in `base`. This module has no arms, walls or time.

pub mod cuboid;
pub mod curves;
pub mod dipole;
mod edges;
pub mod force;
pub mod plane;
pub mod posed;

/// Magnetic constant μ0, T·m/A (CODATA 2022).
pub const VACUUM_PERMEABILITY_T_M_A: f64 = 1.256_637_061_27e-6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix3, Vector3};
    use cuboid::{Cuboid, CuboidError};
    use proptest::prelude::*;

    const HALF_M: [f64; 3] = [0.025, 0.0125, 0.005];

    fn magnet(polarization_t: [f64; 3]) -> Cuboid {
        Cuboid::new(HALF_M.into(), polarization_t.into()).unwrap()
    }

    /// Central differences of the field, T/m, in steps of 2·`step_m`.
    fn differences(magnet: &Cuboid, point_m: &Vector3<f64>, step_m: f64) -> Matrix3<f64> {
        let mut gradient = Matrix3::zeros();
        for axis in 0..3 {
            let mut step = Vector3::zeros();
            step[axis] = step_m;
            let rise = magnet.field_t(&(point_m + step)) - magnet.field_t(&(point_m - step));
            gradient.set_column(axis, &(rise / (2.0 * step_m)));
        }
        gradient
    }

    /// The published formula for J along z, also for B inside, T: without mirroring and without rearranged terms.
    fn plain_field_t(half_m: [f64; 3], jz_t: f64, p: &Vector3<f64>) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for corner in 0..8 {
            let [x, y, z] = std::array::from_fn(|k| p[k] + if corner >> k & 1 == 1 { half_m[k] } else { -half_m[k] });
            let r = (x * x + y * y + z * z).sqrt();
            let sign = if i32::count_ones(corner) % 2 == 1 { -1.0 } else { 1.0 };
            sum += Vector3::new((r - y).ln(), (r - x).ln(), (x * y).atan2(z * r)) * sign;
        }
        sum * (jz_t / (4.0 * std::f64::consts::PI))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn field_matches_the_published_formula(
            point in prop::array::uniform3(-0.1_f64..0.1),
        ) {
            // In line with an edge the published formula loses its digits.
            let from_face: [f64; 3] = std::array::from_fn(|k| point[k].abs() - HALF_M[k]);
            prop_assume!((0..3).all(|k| from_face[k].hypot(from_face[(k + 1) % 3]) > 1e-3));
            let point = Vector3::from(point);
            let error = magnet([0.0, 0.0, 1.19]).field_t(&point) - plain_field_t(HALF_M, 1.19, &point);
            prop_assert!(error.norm() < 1e-11);
        }

        #[test]
        fn rods_and_wafers_match_the_published_formula_inside_and_nearby(
            size in prop::array::uniform3(-3.0_f64..0.0),
            place in prop::array::uniform3(-1.5_f64..1.5),
        ) {
            let half_m = size.map(|exponent| 0.05 * 10_f64.powf(exponent));
            prop_assume!((0..3).all(|k| (place[k].abs() - 1.0).abs() > 1e-3));
            let point = Vector3::from(place).component_mul(&Vector3::from(half_m));
            let magnet = Cuboid::new(half_m.into(), Vector3::z()).unwrap();
            let error = magnet.field_t(&point) - plain_field_t(half_m, 1.0, &point);
            // In line with an edge the published formula loses its digits.
            prop_assert!(error.norm() < 1e-7, "{}", error.norm());
        }

        #[test]
        fn many_points_equal_single_points(
            j in prop::array::uniform3(-1.5..1.5),
            used in 0..8,
            places in prop::collection::vec((prop::array::uniform3(-3.0..3.0), 0..6), 0..8),
        ) {
            let magnet = magnet(std::array::from_fn(|k| if used >> k & 1 == 1 { j[k] } else { 0.0 }));
            // Around the magnet, on its planes, and where the dipole is used.
            let points: Vec<_> = places
                .into_iter()
                .map(|(place, kind): ([f64; 3], _)| {
                    let place = Vector3::from(place).component_mul(&Vector3::from(HALF_M));
                    match kind {
                        0 => Vector3::new(-HALF_M[0], place.y, place.z),
                        1 => Vector3::new(place.x, HALF_M[1], -HALF_M[2]),
                        2 => place * 1e4,
                        _ => place,
                    }
                })
                .collect();
            let expected: Vec<_> = points.iter().map(|point| magnet.field_t(point)).collect();
            prop_assert_eq!(magnet.fields_t(&points), expected);
        }

        #[test]
        fn permuted_axes_give_the_permuted_field(
            j in prop::array::uniform3(-1.5..1.5),
            p in prop::array::uniform3(-0.1..0.1),
        ) {
            // (x, y, z) → (z, x, y), the sides included.
            let turn = |v: [f64; 3]| Vector3::new(v[2], v[0], v[1]);
            let turned = Cuboid::new(turn(HALF_M), turn(j)).unwrap();
            let field: [f64; 3] = magnet(j).field_t(&p.into()).into();
            prop_assert!((turned.field_t(&turn(p)) - turn(field)).norm() < 1e-13);
            // The field is linear in the polarisation.
            let sum: Vector3<f64> = [[j[0], 0.0, 0.0], [0.0, j[1], 0.0], [0.0, 0.0, j[2]]]
                .map(|part| magnet(part).field_t(&p.into()))
                .iter()
                .sum();
            prop_assert!((sum - Vector3::from(field)).norm() < 1e-14);
        }

        #[test]
        fn gradient_is_symmetric_traceless_and_matches_differences(
            j in prop::array::uniform3(-1.5..1.5),
            p in prop::array::uniform3(-0.1..0.1),
        ) {
            let (magnet, point) = (magnet(j), Vector3::<f64>::from(p));
            // Differences need a smooth field over their step: avoid the planes of the surface.
            prop_assume!((0..3).all(|k| (p[k].abs() - HALF_M[k]).abs() > 1e-3));
            let gradient = magnet.gradient_t_m(&point);
            let size = gradient.norm() + 1e-3;
            prop_assert!((gradient - gradient.transpose()).norm() <= 1e-12 * size);
            prop_assert!(gradient.trace().abs() <= 1e-12 * size);
            prop_assert!((gradient - differences(&magnet, &point, 1e-6)).norm() < 1e-5 * size);
            prop_assert_eq!(magnet.field_and_gradient(&point), (magnet.field_t(&point), gradient));
        }

        #[test]
        fn a_far_magnet_is_a_dipole(direction in prop::array::uniform3(-1.0..1.0)) {
            let direction = Vector3::from(direction);
            prop_assume!(direction.norm() > 0.1);
            let magnet = magnet([0.3, -0.4, 1.0]);
            let moment = magnet.moment_a_m2();
            // Inside, at, and beyond the distance where the dipole takes over.
            for (distance_m, part) in [(3.0, 1e-3), (28.0, 1e-5), (29.0, 1e-12), (1e9, 1e-12)] {
                let point = direction.normalize() * distance_m;
                let expected = dipole::field_t(&moment, &point);
                let error = magnet.field_t(&point) - expected;
                prop_assert!(error.norm() < part * expected.norm());
                let expected = dipole::gradient_t_m(&moment, &point);
                let error = magnet.gradient_t_m(&point) - expected;
                prop_assert!(error.norm() < 3.0 * part * expected.norm());
            }
        }
    }

    #[test]
    fn every_special_point_is_finite_and_close_to_its_surroundings() {
        // Faces, edges, corners, their planes and their extensions, and the axes.
        let levels = |half: f64| [-3.0 * half, -half, -0.0, 0.0, 0.4 * half, half, 3.0 * half];
        let magnet = magnet([0.3, -0.4, 1.0]);
        for x in levels(HALF_M[0]) {
            for y in levels(HALF_M[1]) {
                for z in levels(HALF_M[2]) {
                    let point = Vector3::new(x, y, z);
                    let (field, gradient) = magnet.field_and_gradient(&point);
                    let is_finite = field.iter().chain(&gradient).all(|v| v.is_finite());
                    assert!(is_finite, "{point:?} {field:?} {gradient:?}");
                    // Outwards, because a face belongs to the outside.
                    let half = Vector3::from(HALF_M);
                    let ratio = point.abs().component_div(&half);
                    let is_on_edge = ratio.max() == 1.0 && ratio.iter().filter(|r| **r == 1.0).count() > 1;
                    if !is_on_edge {
                        let beside = magnet.field_t(&(point * (1.0 + 1e-9)));
                        assert!((field - beside).norm() < 1e-6, "{point:?} {field:?} {beside:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_nan_point_gives_nan_and_does_not_affect_other_points() {
        let magnet = magnet([0.0, 0.0, 1.19]);
        let point = Vector3::new(0.01, 0.02, 0.03);
        for value in [f64::NAN, f64::INFINITY] {
            for axis in 0..3 {
                let mut none = point;
                none[axis] = value;
                let fields = magnet.fields_t(&[none, point, point, none, none]);
                assert_eq!(fields[1..3], [magnet.field_t(&point); 2]);
                assert!([0, 3, 4].iter().all(|&k| fields[k].iter().all(|b| b.is_nan())), "{fields:?}");
                assert!(magnet.gradient_t_m(&none).iter().all(|slope| slope.is_nan()));
            }
        }
    }

    #[test]
    fn field_in_line_with_an_edge_is_accurate() {
        // In line with an edge R − Y cancels: the published formula has no correct digit at this point.
        let magnet = magnet([0.0, 0.0, 1.19]);
        let at = |aside_m: f64| Vector3::new(HALF_M[0] + aside_m, 0.06, HALF_M[2] + aside_m);
        let rise = magnet.field_t(&at(1e-6)) - magnet.field_t(&at(0.0));
        let expected = magnet.gradient_t_m(&at(0.0)) * Vector3::new(1e-6, 0.0, 1e-6);
        assert!((rise - expected).norm() < 1e-4 * expected.norm());
        let near = magnet.field_t(&at(1e-12)) - magnet.field_t(&at(0.0));
        assert!(near.norm() < 1e-10);
    }

    #[test]
    fn normal_flux_is_continuous_across_a_face() {
        let magnet = magnet([0.0, 0.0, 1.19]);
        let across = |z_m: f64| magnet.field_t(&Vector3::new(0.003, 0.002, z_m)).z;
        assert!((across(HALF_M[2] - 1e-9) - across(HALF_M[2] + 1e-9)).abs() < 1e-6);
        let along = |x_m: f64| magnet.field_t(&Vector3::new(x_m, 0.002, 0.001)).z;
        let jump_t = along(HALF_M[0] - 1e-9) - along(HALF_M[0] + 1e-9);
        assert!((jump_t - 1.19).abs() < 1e-6);
        // A face belongs to the outside.
        assert!((along(HALF_M[0]) - along(HALF_M[0] + 1e-9)).abs() < 1e-6);
    }

    #[test]
    fn block_has_its_moment() {
        assert!((magnet([0.0, 0.0, 1.19]).moment_a_m2().z - 11.84).abs() < 5e-3);
    }

    #[test]
    fn rejects_invalid_magnets_by_field_name() {
        let sides = Vector3::new(0.01, 0.0, 0.01);
        let expected = CuboidError::HalfSize { field: "half_size_m.y", value: 0.0 };
        assert_eq!(Cuboid::new(sides, Vector3::z()), Err(expected));
        for value in [-1.0, f64::INFINITY, f64::NAN] {
            assert!(Cuboid::new(Vector3::new(value, 1.0, 1.0), Vector3::z()).is_err());
        }
        let error = Cuboid::new(HALF_M.into(), Vector3::new(0.0, 0.0, f64::INFINITY)).unwrap_err();
        assert_eq!(error.to_string(), "polarization_t.z must be finite, not inf");
    }
}
