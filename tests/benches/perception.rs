//! From a camera frame to its percept.

use std::hint::black_box;

use criterion::Criterion;
use ferry_core::geometry::{Point2, Rect};
use ferry_core::image::{CameraFrame, CameraMount, Picture};
use ferry_core::perception::{
    DarkPixels, OBSTACLE_LEVEL, Observation, ObstacleMap, Percept, Quadtree, QuadtreeParameters, Unknown, wall_spread,
};

const WORKSPACE: Rect = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
const SIZE_PX: u32 = 480;
const SPAN_M: f64 = 0.2;
const HEIGHT_M: f64 = 0.3;

/// A channel between wavy walls, with slanted folds that reach into it, and round posts outside.
fn is_wall(p: Point2<f64>) -> bool {
    let middle_m = -0.40 + 0.03 * (18.0 * p.x).sin();
    let half_m = 0.035 + 0.004 * (70.0 * p.x + 1.0).sin();
    let from_middle_m = p.y - middle_m;
    let along_m = (p.x + 0.4 * from_middle_m).rem_euclid(0.07) - 0.035;
    let is_fold = along_m.abs() < 0.0025 && from_middle_m.abs() > 0.015;
    let outside = from_middle_m.abs() > half_m;
    let in_post = (p.x.rem_euclid(0.05) - 0.025).hypot(p.y.rem_euclid(0.05) - 0.025) > 0.02;
    !WORKSPACE.contains(p) || (outside && in_post) || (!outside && is_fold)
}

/// The colours of the controllers' view: dark walls, a bright floor, shadows at the walls' lower right.
fn frame(x_m: f64, y_m: f64) -> CameraFrame {
    let m_per_px = SPAN_M / f64::from(SIZE_PX);
    let pixel = |i: u32| {
        let (column, row) = (i % SIZE_PX, i / SIZE_PX);
        let half = f64::from(SIZE_PX) / 2.0;
        let p = Point2::new(
            x_m + (f64::from(column) + 0.5 - half) * m_per_px,
            y_m - (f64::from(row) + 0.5 - half) * m_per_px,
        );
        match (is_wall(p), is_wall(Point2::new(p.x - 0.003, p.y + 0.003))) {
            (true, _) => [62, 34, 40, 255],
            (false, true) => [208, 213, 216, 255],
            (false, false) => [238, 241, 240, 255],
        }
    };
    let rgba = (0..SIZE_PX * SIZE_PX).flat_map(pixel).collect();
    let picture = Picture { width_px: SIZE_PX, height_px: SIZE_PX, rgba };
    CameraFrame { picture, tick: 0, pinhole: CameraMount::default().over(Point2::new(x_m, y_m), 0.0) }
}

/// Times each step from the frame to the rectangles and to the network's observation.
pub fn benches(c: &mut Criterion) {
    let frames: Vec<CameraFrame> = (0..24).map(|i| frame(-0.23 + 0.02 * f64::from(i), -0.4)).collect();
    let look = |frame: &CameraFrame| Percept::of(frame, frame.pinhole.foot_m());
    let percepts: Vec<Percept> = frames.iter().map(look).collect();
    let spread = wall_spread(HEIGHT_M, 0.005);
    let mut group = c.benchmark_group("perception");
    let mut turn = (0..frames.len()).cycle();
    let mut next = || turn.next().expect("there are frames");

    group.bench_function("gray and obstacle test of a frame", |b| b.iter(|| look(black_box(&frames[next()]))));
    group.bench_function("observation of a gray image", |b| {
        b.iter(|| {
            let percept = &percepts[next()];
            let tool = percept.calibration.center_m;
            Observation::new(black_box(&percept.gray), Some(tool), tool, &WORKSPACE)
        });
    });
    group.bench_function("JPEG of a frame, quality 80", |b| b.iter(|| black_box(&frames[next()]).picture.to_jpeg(80)));

    let presets = [("6 px", QuadtreeParameters::default()), ("50 px", QuadtreeParameters::PAPER)];
    for (name, parameters) in presets {
        group.bench_function(format!("quadtree and fewest rectangles, {name}"), |b| {
            b.iter(|| Quadtree::of(black_box(&percepts[next()].gray), &parameters).partition());
        });
    }
    group.bench_function("dark pixels counted", |b| {
        b.iter(|| DarkPixels::of(black_box(&percepts[next()].gray), OBSTACLE_LEVEL));
    });

    let dark: Vec<_> = percepts.iter().map(|percept| DarkPixels::of(&percept.gray, OBSTACLE_LEVEL)).collect();
    let mut map = ObstacleMap::new(WORKSPACE);
    group.bench_function("obstacle map, update with what is new", |b| {
        b.iter(|| {
            let i = next();
            if i == 0 {
                map = ObstacleMap::new(WORKSPACE);
            }
            map.update(&dark[i], &percepts[i].calibration, spread)
        });
    });
    for i in 0..frames.len() {
        map.update(&dark[i], &percepts[i].calibration, spread);
    }
    group.bench_function("obstacle map, update with nothing new", |b| {
        b.iter(|| {
            let i = next();
            map.update(&dark[i], &percepts[i].calibration, spread)
        });
    });
    group.bench_function("obstacle map, fewest rectangles", |b| b.iter(|| black_box(&map).rectangles()));
    group.bench_function("obstacle map, serialised and hashed", |b| {
        b.iter(|| xxhash_rust::xxh3::xxh3_64(&postcard::to_stdvec(black_box(&map)).expect("plain data")));
    });
    let from = Point2::new(-0.2, -0.4);
    group.bench_function("obstacle map, way of 3 cm with 12 mm clearance", |b| {
        let to = Point2::new(-0.18, -0.378);
        b.iter(|| map.is_corridor_free(black_box(from), black_box(to), 0.012, Unknown::Free));
    });
    group.bench_function("obstacle map, nearest obstacle", |b| b.iter(|| map.nearest_obstacle_m(black_box(from))));
    group.finish();
}
