//! The block's field around it, and its pull on the bead.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use ferry_core::geometry::Vector3;
use ferry_core::magnetics::cuboid::Cuboid;
use ferry_core::magnetics::dipole::{self, BLOCK_REMANENCE_T};
use ferry_core::magnetics::force::{self, Orientation};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const POINTS: usize = 1000;
/// Points lie no farther from the block's middle along each axis.
const FAR_M: f64 = 0.15;

pub fn benches(c: &mut Criterion) {
    let along_z = force::block(Orientation::A, BLOCK_REMANENCE_T);
    let askew = Cuboid { polarization_t: Vector3::new(0.3, -0.4, 1.0), ..along_z };
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let points: Vec<Vector3<f64>> = (0..POINTS)
        .map(|_| Vector3::from(std::array::from_fn::<f64, 3, _>(|_| rng.random_range(-FAR_M..FAR_M))))
        .collect();
    let mut group = c.benchmark_group("magnetics");

    // An element is a point.
    group.throughput(Throughput::Elements(POINTS as u64));
    for (name, block) in [("along an axis", &along_z), ("askew", &askew)] {
        group.bench_function(format!("field of a block magnetised {name}, 1000 points at once"), |b| {
            b.iter(|| black_box(block.fields_t(black_box(&points))));
        });
        group.bench_function(format!("field of a block magnetised {name}, 1000 points singly"), |b| {
            b.iter(|| points.iter().map(|point| block.field_t(black_box(point))).sum::<Vector3<f64>>());
        });
        group.bench_function(format!("force on the bead, block magnetised {name}, 1000 points"), |b| {
            let moment_a_m2 = dipole::moment_a_m2();
            let force_n = |point| force::force_n(block, black_box(point), moment_a_m2);
            b.iter(|| points.iter().map(force_n).sum::<Vector3<f64>>());
        });
    }
    group.finish();
}
