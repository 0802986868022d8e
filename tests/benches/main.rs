//! `cargo bench`: how fast the plant is. `ARCHITECTURE.md` holds the figures of one run.

mod kinematics;
mod magnetics;
mod plant;

use criterion::{criterion_group, criterion_main};

criterion_group!(speed, kinematics::benches, magnetics::benches, plant::benches);
criterion_main!(speed);
