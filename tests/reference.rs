//! The arm and the magnets against implementations that are not ours.
//!
//! The cases in `reference/*.json` were made once by the scripts beside them, which say with which
//! packages. Derivatives are checked with dual numbers, of formulas that are written down here anew.
//! `--nocapture` shows the greatest errors.

use std::f64::consts::{PI, TAU};
use std::time::Instant;

use ferry::geometry::{Isometry3, Matrix6, UnitQuaternion, Vector3};
use ferry::magnetics::cuboid::Cuboid;
use ferry::magnetics::dipole::{self, BLOCK_REMANENCE_T};
use ferry::magnetics::force::{self, Orientation};
use ferry::robot::{Joints, forward, inverse, jacobian};
use nalgebra::{Quaternion, SVector, Translation3};
use num_dual::DualNumCopy;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;

#[derive(Deserialize)]
struct InverseCase {
    kind: String,
    /// x, y, z in m; a unit quaternion w, x, y, z.
    pose: [f64; 7],
    /// Solutions of ur-analytic-ik.
    package: Vec<Joints>,
    /// Every solution, found numerically; only near a singularity.
    newton: Option<Vec<Joints>>,
}

impl InverseCase {
    /// Our solutions. Where wrist 3 is free the package answers with θ6 = 0 and π, so we do too.
    fn ours(&self) -> Vec<Joints> {
        let [x, y, z, qw, qx, qy, qz] = self.pose;
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(qw, qx, qy, qz));
        let flange = Isometry3::from_parts(Translation3::new(x, y, z), turn);
        let seeds = [0.0, PI].map(|theta6| [0.0, 0.0, 0.0, 0.0, 0.0, theta6]);
        seeds.iter().flat_map(|seed| inverse::solutions(&flange, seed).unwrap().to_vec()).collect()
    }

    /// How well `joints` are determined by the pose, rad: 1e-9 away from singularities.
    ///
    /// Next to one, rounding the pose by ε turns the joints by ε/σ, with σ the Jacobian's least singular
    /// value; 1e-14 is some tens of roundings. Solutions closer than 1e-6 rad are one in the
    /// reference, and where they coincide a rounding turns them by its root only: that is the most.
    fn tolerance_rad(&self, joints: &Joints) -> f64 {
        match self.kind.as_str() {
            "wrist" | "elbow" | "shoulder" => {
                let least = jacobian::geometric(joints).singular_values().min();
                (1e-14 / least).clamp(1e-9, 1e-6)
            }
            _ => 1e-9,
        }
    }

    /// Each of `some` is one of `all`; returns the greatest difference, rad.
    fn assert_within(&self, some: &[Joints], all: &[Joints]) -> f64 {
        let errors = some.iter().map(|joints| {
            let nearest = all.iter().map(|other| apart(joints, other)).fold(f64::INFINITY, f64::min);
            assert!(nearest <= self.tolerance_rad(joints), "{} {:?}: {joints:?} off {nearest}", self.kind, self.pose);
            nearest
        });
        errors.fold(0.0, f64::max)
    }
}

fn inverse_cases() -> Vec<InverseCase> {
    serde_json::from_str(include_str!("reference/inverse.json")).unwrap()
}

/// The greatest difference of two joints, modulo whole turns.
fn apart(a: &Joints, b: &Joints) -> f64 {
    (0..6).map(|i| a[i] - b[i]).map(|d| (d - TAU * (d / TAU).round()).abs()).fold(0.0, f64::max)
}

#[test]
fn inverse_kinematics_find_what_the_package_finds() {
    let (mut regular, mut singular) = (0.0_f64, 0.0_f64);
    for case in inverse_cases() {
        let ours = case.ours();
        let mut error = case.assert_within(&case.package, &ours);
        // With the tool down and θ1 near 0 the package's θ234 loses its digits and it drops solutions.
        if case.kind != "first joint" {
            error = error.max(case.assert_within(&ours, &case.package));
        }
        match case.kind.as_str() {
            "random" | "paper" => regular = regular.max(error),
            _ => singular = singular.max(error),
        }
    }
    println!("inverse kinematics and ur-analytic-ik: {regular:.1e} rad, near singularities {singular:.1e} rad");
}

#[test]
fn inverse_kinematics_find_every_solution_near_singularities() {
    let (mut regular, mut singular, mut count) = (0.0_f64, 0.0_f64, 0);
    for case in inverse_cases() {
        let Some(newton) = &case.newton else { continue };
        let ours = case.ours();
        let error = case.assert_within(newton, &ours).max(case.assert_within(&ours, newton));
        // θ1 = 0 with the tool down is no singularity of the arm, only one of the printed formula.
        match case.kind.as_str() {
            "first joint" => regular = regular.max(error),
            _ => singular = singular.max(error),
        }
        count += 1;
    }
    assert!(count >= 60);
    println!("inverse kinematics and Newton: {regular:.1e} rad at θ1 = 0, near singularities {singular:.1e} rad");
}

#[test]
fn a_million_poses_are_reached_by_every_branch() {
    let start = Instant::now();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let (mut worst, mut branches) = (0.0_f64, 0_u64);
    for _ in 0..1_000_000 {
        let joints: Joints = std::array::from_fn(|_| rng.random_range(-PI..PI));
        let flange = forward::flange(&joints);
        let rotation = flange.rotation.to_rotation_matrix();
        for branch in &inverse::solutions(&flange, &joints).unwrap() {
            let found = forward::flange(branch);
            let shift_m = (found.translation.vector - flange.translation.vector).amax();
            let turn = (found.rotation.to_rotation_matrix().matrix() - rotation.matrix()).amax();
            let miss = shift_m.max(turn);
            assert!(miss <= 1e-12, "{joints:?} {branch:?} misses by {miss}");
            worst = worst.max(miss);
            branches += 1;
        }
    }
    println!("{branches} branches of 10⁶ poses: {worst:.1e} in {:.1} s", start.elapsed().as_secs_f64());
}

/// Position and rotation matrix, by columns, of the flange; the UR5's table with exact twists.
fn flange<D: DualNumCopy<Primitive = f64>>(joints: SVector<D, 6>) -> SVector<D, 12> {
    // d, a in m; cosine and sine of the twist.
    let table = [
        (0.089159, 0.0, 0.0, 1.0),
        (0.0, -0.425, 1.0, 0.0),
        (0.0, -0.39225, 1.0, 0.0),
        (0.10915, 0.0, 0.0, 1.0),
        (0.09465, 0.0, 0.0, -1.0),
        (0.0823, 0.0, 1.0, 0.0),
    ];
    let number = |value: f64| D::from(value);
    let mut position = [number(0.0); 3];
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| axis.map(number));
    for (theta, (d, a, ca, sa)) in joints.iter().zip(table) {
        let (s, c) = theta.sin_cos();
        let combined =
            |x: D, y: D, z: D| -> [D; 3] { std::array::from_fn(|k| axes[0][k] * x + axes[1][k] * y + axes[2][k] * z) };
        let shift = combined(c * a, s * a, number(d));
        axes =
            [combined(c, s, number(0.0)), combined(-s * ca, c * ca, number(sa)), combined(s * sa, -c * sa, number(ca))];
        position = std::array::from_fn(|k| position[k] + shift[k]);
    }
    SVector::from_iterator(position.into_iter().chain(axes.into_iter().flatten()))
}

#[test]
fn jacobian_is_the_derivative_of_forward_kinematics() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut worst = 0.0_f64;
    for _ in 0..10_000 {
        let joints: Joints = std::array::from_fn(|_| rng.random_range(-TAU..TAU));
        let (value, slope) = num_dual::jacobian(flange, &SVector::from(joints));
        let mut expected = Matrix6::zeros();
        for joint in 0..6 {
            // Ṙ = [ω]×R, so that 2ω = Σ r × ṙ over the columns r of R.
            let column = |k: usize| value.fixed_rows::<3>(k).into_owned();
            let rate = |k: usize| slope.fixed_view::<3, 1>(k, joint).into_owned();
            let turn: Vector3<f64> = [3, 6, 9].map(|k| column(k).cross(&rate(k)) * 0.5).iter().sum();
            expected.fixed_view_mut::<3, 1>(0, joint).copy_from(&rate(0));
            expected.fixed_view_mut::<3, 1>(3, joint).copy_from(&turn);
        }
        let error = (jacobian::geometric(&joints) - expected).amax();
        assert!(error <= 1e-12, "{joints:?}: {error}");
        worst = worst.max(error);
    }
    println!("Jacobian and dual numbers: {worst:.1e}");
}

#[derive(Deserialize)]
struct FieldCase {
    kind: String,
    /// Whole sides, m.
    size: [f64; 3],
    /// T.
    polarization: [f64; 3],
    /// From the centre, m.
    point: [f64; 3],
    /// T, of magpylib.
    field: [f64; 3],
}

#[derive(Deserialize)]
struct ForceCase {
    size: [f64; 3],
    polarization: [f64; 3],
    point: [f64; 3],
    /// Of the aligned dipole, A·m².
    moment: f64,
    /// N, of magpylib.
    force: [f64; 3],
}

#[derive(Deserialize)]
struct MagneticCases {
    fields: Vec<FieldCase>,
    forces: Vec<ForceCase>,
}

fn magnetic_cases() -> MagneticCases {
    serde_json::from_str(include_str!("reference/magnetics.json")).unwrap()
}

fn cuboid(size_m: [f64; 3], polarization_t: [f64; 3]) -> Cuboid {
    Cuboid::new(Vector3::from(size_m) * 0.5, polarization_t.into()).unwrap()
}

/// Length of the difference over the length of what is expected.
fn relative(found: Vector3<f64>, expected: Vector3<f64>) -> f64 {
    (found - expected).norm() / expected.norm()
}

#[test]
fn field_is_that_of_magpylib() {
    let cases = magnetic_cases().fields;
    assert_eq!(cases.len(), 300);
    let mut worst = 0.0_f64;
    for case in cases {
        let found = cuboid(case.size, case.polarization).field_t(&case.point.into());
        let error = relative(found, case.field.into());
        assert!(error <= 1e-9, "{} {:?}: {error}", case.kind, case.point);
        worst = worst.max(error);
    }
    println!("field and magpylib: {worst:.1e}");
}

#[test]
fn force_is_that_of_magpylib() {
    let cases = magnetic_cases().forces;
    assert_eq!(cases.len(), 60);
    let mut worst = 0.0_f64;
    for case in cases {
        let found = force::force_n(&cuboid(case.size, case.polarization), &case.point.into(), case.moment);
        let error = relative(found, case.force.into());
        assert!(error <= 1e-4, "{:?}: {error}", case.point);
        worst = worst.max(error);
    }
    println!("force and magpylib: {worst:.1e}");
}

/// |B| in T by the printed formula, which is for J along z, and its two cyclic permutations.
///
/// Far along +y the formula's R − Y has no digit left. Magnet and point are therefore mirrored, which
/// leaves |B| as it is, so that the point has no positive coordinate.
fn strength<D: DualNumCopy<Primitive = f64>>(magnet: &Cuboid, point: SVector<D, 3>) -> D {
    let mirror = [0, 1, 2].map(|k| if point[k] > D::from(0.0) { -1.0 } else { 1.0 });
    let mut field = [D::from(0.0); 3];
    for w in 0..3 {
        let (u, v) = ((w + 1) % 3, (w + 2) % 3);
        for corner in 0..8_u32 {
            let offset: [D; 3] = std::array::from_fn(|k| {
                let half = magnet.half_size_m[k];
                point[k] * mirror[k] + if corner >> k & 1 == 1 { half } else { -half }
            });
            let sign = if corner.count_ones() % 2 == 1 { -1.0 } else { 1.0 };
            let scale = sign * magnet.polarization_t[w] * mirror[w] / (4.0 * PI);
            let [x, y, z] = [u, v, w].map(|k| offset[k]);
            let r = (x * x + y * y + z * z).sqrt();
            field[u] += (r - y).ln() * scale;
            field[v] += (r - x).ln() * scale;
            field[w] += (x * y).atan2(z * r) * scale;
        }
    }
    (field[0] * field[0] + field[1] * field[1] + field[2] * field[2]).sqrt()
}

#[test]
fn force_is_the_exact_derivative_of_the_field_strength() {
    let stored = magnetic_cases().forces;
    let mut cases: Vec<_> = stored.iter().map(|c| (cuboid(c.size, c.polarization), c.point.into(), c.moment)).collect();
    // Our own block over the table, in each way that it hangs, and about it.
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for orientation in [Orientation::A, Orientation::B, Orientation::C] {
        for _ in 0..1000 {
            let aside_m: [f64; 2] = std::array::from_fn(|_| rng.random_range(-0.2..0.2));
            let point = Vector3::new(aside_m[0], aside_m[1], rng.random_range(-0.15..-0.03));
            cases.push((force::block(orientation, BLOCK_REMANENCE_T), point, dipole::moment_a_m2()));
        }
    }
    let mut worst = 0.0_f64;
    for (magnet, point, moment) in cases {
        let (_, slope_t_m) = num_dual::gradient(|p| strength(&magnet, p), &point);
        let error = relative(force::force_n(&magnet, &point, moment), slope_t_m * moment);
        assert!(error <= 1e-9, "{magnet:?} {point:?}: {error}");
        worst = worst.max(error);
    }
    println!("force and dual numbers: {worst:.1e}");
}
