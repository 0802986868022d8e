//! The physics: bead, contact and arm.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use ferry_core::control::switching::{self, Mode};
use ferry_core::geometry::{Point2, Point3, Vector2};
use ferry_core::map::Map;
use ferry_core::plant::{LazyLumen, Plant, PlantState, Positioner, PositionerKind, Surroundings, ToolOrientation};
use ferry_core::scenario::{Parameters, Scenario};
use ferry_core::trial::{Arena, Decision, Motion, Source, Trial};

/// Height of the tool, and of the paper's plane.
const HEIGHT_M: f64 = 0.1;
/// Control steps of 10 mm each along the colon, from end to end and back.
const LINE_M: [[f64; 2]; 7] =
    [[0.19, -0.28], [0.21, -0.34], [0.20, -0.47], [0.0, -0.48], [-0.19, -0.48], [-0.24, -0.40], [-0.24, -0.28]];

/// Tool points every .32 mm (40 mm/s at 125 Hz) along the colon, there and back.
fn tool_path() -> Vec<Point3<f64>> {
    let mut path = Vec::new();
    for pair in LINE_M.windows(2) {
        let [from, to] = [Point2::from(pair[0]), Point2::from(pair[1])];
        let steps = ((to - from).norm() / 3.2e-4).ceil() as usize;
        path.extend((0..steps).map(|k| {
            let p = from + (to - from) * (k as f64 / steps as f64);
            Point3::new(p.x, p.y, HEIGHT_M)
        }));
    }
    let back: Vec<_> = path.iter().rev().copied().collect();
    path.extend(back);
    path
}

pub fn benches(c: &mut Criterion) {
    let map = Map::shipped("colon").unwrap();
    let lumen = LazyLumen::default();
    let around = Surroundings::of(&map, &lumen);
    let plant = Plant::new(Parameters::default().plant());
    let path = tool_path();
    let start = path[0].xy();
    let mut group = c.benchmark_group("plant");

    // A millisecond of the bead behind a moving magnet, between the colon's walls.
    group.throughput(Throughput::Elements(ferry_core::plant::SUBSTEPS as u64));
    let mut state = PlantState::at_rest(Positioner::PlanarStage(path[0]), start);
    let mut at = 0;
    group.bench_function("eight 1 kHz steps, colon, no arm", |b| {
        b.iter(|| {
            let [here, next] = [path[at], path[(at + 1) % path.len()]].map(Positioner::PlanarStage);
            at = (at + 1) % path.len();
            plant.step(&mut state, &around, 0, &here, &next);
            black_box(&state);
        });
    });

    // The same while a push from side to side keeps the bead on the walls and in their folds.
    let mut state = PlantState::at_rest(Positioner::PlanarStage(path[0]), start);
    let (mut at, mut touched, mut ticks) = (0, 0, 0);
    group.bench_function("eight 1 kHz steps, colon, along its walls", |b| {
        b.iter(|| {
            let [here, next] = [path[at], path[(at + 1) % path.len()]].map(Positioner::PlanarStage);
            at = (at + 1) % path.len();
            let side = if at / 400 % 2 == 0 { 4e-3 } else { -4e-3 };
            state.drift_n = Vector2::new(side, side);
            plant.step(&mut state, &around, 0, &here, &next);
            ticks += 1;
            touched += usize::from(map.nearest_wall_point_within(state.bead.position_m, 0.0026).is_some());
            black_box(&state);
        });
    });
    // None when only another benchmark is run.
    assert!(10 * touched >= ticks, "the bead must lean on walls: {touched} of {ticks} ticks");

    // The first again, between walls that contract by 6 mm.
    let moving = Plant::new(Parameters { peristalsis_amplitude_m: 6e-3, ..Parameters::default() }.plant());
    let mut state = PlantState::at_rest(Positioner::PlanarStage(path[0]), start);
    let (mut at, mut tick) = (0, 0);
    group.bench_function("eight 1 kHz steps, colon, between moving walls", |b| {
        b.iter(|| {
            let [here, next] = [path[at], path[(at + 1) % path.len()]].map(Positioner::PlanarStage);
            at = (at + 1) % path.len();
            moving.step(&mut state, &around, tick, &here, &next);
            tick += 1;
            black_box(&state);
        });
    });

    // The same with the arm: inverse kinematics, servo and forward kinematics at 125 Hz besides.
    let mut arm = Positioner::home(PositionerKind::Arm, path[0]);
    let arms: Vec<Positioner> = path
        .iter()
        .map(|&tool_m| {
            arm = Positioner::at(tool_m, ToolOrientation::Vertical, &arm).unwrap();
            arm
        })
        .collect();
    let mut state = PlantState::at_rest(arms[0], start);
    let (mut at, mut reference) = (0, arms[0]);
    group.bench_function("eight 1 kHz steps, colon, arm with inverse kinematics", |b| {
        b.iter(|| {
            at = (at + 1) % path.len();
            let next = Positioner::at(path[at], ToolOrientation::Vertical, &reference).unwrap();
            plant.step(&mut state, &around, 0, &reference, &next);
            reference = next;
            black_box(&state);
        });
    });

    // All of a tick but the camera: tracker, scoring, hashes and the record besides.
    let arena = Arena::shipped("colon").unwrap();
    let scenario =
        Scenario { start_m: Some(start), goal_m: Some(path[path.len() / 2].xy()), ..Scenario::idle("colon", 1) };
    let mut trial = Trial::new(scenario, arena).unwrap();
    let switching = switching::Decision { mode: Mode::Transport, switched: false, error_m: 0.0, threshold_m: 0.1 };
    let hold = Decision { switching, motion: Motion::Hold, refusal: None };
    group.bench_function("one 8 ms tick of a trial, decided beforehand", |b| {
        b.iter(|| black_box(trial.tick(Source::Logged(Some(hold.clone()))).unwrap()));
    });
    group.finish();
}
