//! How long the arm's kinematics take, over poses so many and so mixed that no branch is foreseen.

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::Criterion;
use ferry_core::robot::{Joints, forward, inverse, jacobian};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Times inverse kinematics of all branches and of the nearest, forward kinematics and the Jacobian.
pub fn benches(c: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let joints: Vec<Joints> = (0..1000).map(|_| std::array::from_fn(|_| rng.random_range(-PI..PI))).collect();
    let cases: Vec<_> = joints.iter().map(|joints| (forward::flange(joints), joints)).collect();
    let mut cases = cases.iter().cycle();
    let mut next = || black_box(cases.next().expect("there are a thousand"));

    c.bench_function("kinematics/inverse, all branches", |b| {
        b.iter(|| {
            let (flange, seed) = next();
            inverse::solutions(flange, seed)
        });
    });
    c.bench_function("kinematics/inverse, nearest branch", |b| {
        b.iter(|| {
            let (flange, seed) = next();
            inverse::nearest(flange, seed)
        });
    });
    c.bench_function("kinematics/forward", |b| b.iter(|| forward::flange(next().1)));
    c.bench_function("kinematics/jacobian", |b| b.iter(|| jacobian::geometric(next().1)));
}
