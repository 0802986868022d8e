//! `cargo bench`: how fast the plant is. `ARCHITECTURE.md` holds the figures of one run.

mod camera;
mod errt;
mod kinematics;
mod magnetics;
mod perception;
mod plant;
mod policy;
mod recording;

use criterion::{criterion_group, criterion_main};

criterion_group!(
    speed,
    kinematics::benches,
    magnetics::benches,
    plant::benches,
    camera::benches,
    perception::benches,
    errt::benches,
    policy::benches,
    recording::benches
);
criterion_main!(speed);
