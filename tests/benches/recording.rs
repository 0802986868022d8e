//! What a recording costs: the same twenty simulated seconds of a disturbed carry, as fast as they go, with and without
//! one, in turns, since what else the machine does changes from second to second.

use std::sync::Arc;
use std::time::Instant;

use criterion::Criterion;
use ferry_camera::{AdapterChoice, Camera, Gpu};
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Arena, Beginning, Nowhere, RecordingFact, Sink, Source, Trial};
use ferry_recording::{Archive, Options, Recorder, Retention};

const TICKS: u64 = 2500;
const TURNS: usize = 30;

fn run_s(arena: &Arc<Arena>, camera: &mut Camera, sink: &mut dyn Sink) -> f64 {
    let scenario = arena.random("colon", ControllerName::Errt, 3, 5, 0).unwrap();
    let mut trial = Trial::new(scenario, arena.clone()).unwrap();
    sink.begin(&trial, Beginning::SetUp);
    let begun = Instant::now();
    for _ in 0..TICKS {
        sink.record(&trial.tick(Source::Camera(camera)).unwrap());
    }
    begun.elapsed().as_secs_f64()
}

/// Criterion measures one thing after the other; what counts here is their ratio at the same time.
pub fn benches(_: &mut Criterion) {
    let arena = Arena::shipped("colon").unwrap();
    let gpu = Gpu::open(AdapterChoice::Auto).expect("a graphics adapter");
    let mut camera = Camera::of(&gpu, arena.static_scene()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let mut ratios: Vec<f64> = (0..TURNS)
        .map(|_| {
            let without_s = run_s(&arena, &mut camera, &mut Nowhere::default());
            let mut recorder = Recorder::in_archive(&archive, "bench", Options::LIVE).unwrap();
            let with_s = run_s(&arena, &mut camera, &mut recorder);
            assert_eq!(recorder.status(), RecordingFact::On);
            with_s / without_s
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    let [low, median, high] = [TURNS / 4, TURNS / 2, 3 * TURNS / 4].map(|place| ratios[place]);
    println!("recording/time with over time without: median {median:.3}, quartiles {low:.3} to {high:.3}");
}
