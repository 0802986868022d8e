//! What a recording costs: the same ten simulated seconds of a disturbed carry, with and without.

use std::sync::Arc;

use criterion::{BatchSize, Criterion};
use ferry::camera::{AdapterChoice, Camera, Gpu};
use ferry::recording::{Archive, Options, Recorder, Retention};
use ferry::scenario::{ControllerName, Scenario};
use ferry::trial::{Arena, Beginning, Nowhere, Sink, Source, Trial};

const TICKS: u64 = 1250;

fn run(arena: &Arc<Arena>, camera: &mut Camera, sink: &mut dyn Sink) {
    let mut scenario = Scenario::random(&arena.map, "colon", &arena.space, ControllerName::Errt, 3, 5, 0).unwrap();
    scenario.seed = 5;
    let mut trial = Trial::new(scenario, arena.clone()).unwrap();
    sink.begin(&trial, Beginning::SetUp);
    for _ in 0..TICKS {
        sink.record(&trial.tick(Source::Eye(camera)).unwrap());
    }
}

pub fn benches(c: &mut Criterion) {
    let arena = Arena::open("colon").unwrap();
    let gpu = Gpu::open(AdapterChoice::Auto).expect("a graphics adapter");
    let mut camera = arena.camera(&gpu).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let mut group = c.benchmark_group("ten seconds of a trial");
    group.sample_size(30);
    group.bench_function("not recorded", |b| b.iter(|| run(&arena, &mut camera, &mut Nowhere)));
    group.bench_function("recorded", |b| {
        b.iter_batched_ref(
            || Recorder::in_archive(&archive, "bench", Options::LIVE).unwrap(),
            |recorder| run(&arena, &mut camera, recorder),
            BatchSize::PerIteration,
        );
    });
    group.finish();
}
