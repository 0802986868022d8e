//! Ways across the colon, all of it known. Criterion shows means; the quantiles over many plans are printed.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::Criterion;
use ferry::control::transport::errt::{Planner, PlannerParameters, Progress};
use ferry::control::transport::planning::Obstacles;
use ferry::geometry::Point2;
use ferry::image::GrayImage;
use ferry::map::{FreeSpace, Map};
use ferry::perception::{Calibration, DarkPixels, OBSTACLE_LEVEL, ObstacleMap};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Start and goal of the paper's Example 3, from the caecum back to its start.
const ENDS_M: [[f64; 2]; 2] = [[0.19, -0.28], [-0.24, -0.27]];
const PLANS: u64 = 1000;
/// Plans before the timed one, in benchmarks of a planner that has a tree already.
const BEFORE: u64 = 10;
/// Without disturbances: distance that the tool moves between two plans.
const STEP_M: f64 = 0.03;
/// With disturbances: maximum distance that bead and tool are moved between two plans.
const DISTURBANCE_M: f64 = 0.05;

/// The map as if the camera had been everywhere.
fn all_seen(map: &Map) -> ObstacleMap {
    let mut seen = ObstacleMap::new(*map.workspace());
    let center_m = map.workspace().center_m();
    let size_px = 1600;
    let calibration = Calibration { center_m, m_per_px: 0.2 / 480.0, size_px, foot_m: center_m };
    let middle = |i: usize| ((i % size_px) as f64 + 0.5, (i / size_px) as f64 + 0.5);
    let is_free = |i| map.is_free(calibration.table_from_image(middle(i).0, middle(i).1));
    let pixels = (0..size_px * size_px).map(|i| if is_free(i) { 230 } else { 20 }).collect();
    let gray = GrayImage { width_px: size_px, height_px: size_px, pixels };
    seen.update(&DarkPixels::of(&gray, OBSTACLE_LEVEL), &calibration, 1.0);
    seen
}

/// Starts near the first, as after disturbances.
fn starts(map: &Map) -> Vec<Point2<f64>> {
    let space = FreeSpace::new(map, 0.012);
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut draw = || space.sample(map, None, &mut rng).expect("there is free space");
    let start = Point2::from(ENDS_M[0]);
    let near = std::iter::from_fn(|| Some(draw())).filter(|p: &Point2<f64>| (p - start).norm() < DISTURBANCE_M);
    near.take((BEFORE + PLANS) as usize).collect()
}

fn plan(planner: &mut Planner, parameters: &PlannerParameters, obstacles: &Obstacles, from: Point2<f64>) -> Duration {
    let start = Instant::now();
    planner.start(parameters, obstacles, from, Point2::from(ENDS_M[1]));
    planner.advance(obstacles, usize::MAX);
    let took = start.elapsed();
    assert!(matches!(black_box(planner.progress()), Progress::Found(_)));
    took
}

/// Prints quantiles over many plans, and lets criterion time the same. A plan is the same whenever it is made: the
/// smallest of three times is the time on an idle machine.
fn time(c: &mut Criterion, name: &str, plan: impl Fn(u64) -> Duration) {
    let least = |seed| (0..3).map(|_| plan(seed)).min();
    let mut times: Vec<Duration> = (0..PLANS).filter_map(least).collect();
    times.sort_unstable();
    let quantile = |share: f64| times[(share * (times.len() - 1) as f64) as usize];
    println!("errt/{name}: median {:?}, p99 {:?}, most {:?}", quantile(0.5), quantile(0.99), quantile(1.0));
    let mut seeds = (0..PLANS).cycle();
    c.bench_function(&format!("errt/{name}"), |b| {
        b.iter_custom(|count| seeds.by_ref().take(count as usize).map(&plan).sum());
    });
}

/// Times a plan from scratch, after disturbances and on the way, with everything and without parts of it; and what a
/// map that changed costs.
pub fn benches(c: &mut Criterion) {
    let map = Map::shipped("colon").unwrap();
    let seen = all_seen(&map);
    let full = PlannerParameters::default();
    let obstacles = Obstacles::of(&seen, full.clearance_m);
    let starts = starts(&map);
    c.bench_function("errt/obstacles of a map that changed", |b| {
        b.iter(|| Obstacles::of(black_box(&seen), full.clearance_m));
    });
    let variants = [
        ("full", full),
        ("β = 0", PlannerParameters { beta_most: 0.0, ..full }),
        ("without cache", PlannerParameters { waypoints: 0, ..full }),
        ("plain tree", PlannerParameters::plain()),
    ];
    for (name, parameters) in &variants {
        time(c, &format!("colon from scratch, {name}"), |seed| {
            plan(&mut Planner::new(seed), parameters, &obstacles, Point2::from(ENDS_M[0]))
        });
    }
    for (name, parameters) in &variants {
        time(c, &format!("colon after {BEFORE} disturbances, {name}"), |seed| {
            let mut planner = Planner::new(seed);
            let starts = &starts[seed as usize..][..=BEFORE as usize];
            let times = starts.iter().map(|&from| plan(&mut planner, parameters, &obstacles, from));
            times.last().expect("there are plans")
        });
    }
    for (name, parameters) in &variants {
        time(c, &format!("colon for the {BEFORE}th time on the way, {name}"), |seed| {
            let mut planner = Planner::new(seed);
            let mut from = Point2::from(ENDS_M[0]);
            let times = (0..=BEFORE).map(|_| {
                let took = plan(&mut planner, parameters, &obstacles, from);
                if let Progress::Found(way) = planner.progress() {
                    from += (way.points[1] - from).cap_magnitude(STEP_M);
                }
                took
            });
            times.last().expect("there are plans")
        });
    }
}
