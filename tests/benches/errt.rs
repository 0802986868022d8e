//! Paths across the colon, all of it known. Criterion shows means; the quantiles over many plans are printed, and beside
//! them those of OMPL's RRTConnect (tests/benches/ompl.cpp) if that library is installed.

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use criterion::Criterion;
use ferry_core::control::transport::errt::{Planner, PlannerParameters, Progress};
use ferry_core::control::transport::planning::Obstacles;
use ferry_core::geometry::{Point2, Rect};
use ferry_core::image::GrayImage;
use ferry_core::map::{FreeSpace, Map};
use ferry_core::perception::{Calibration, DarkPixels, OBSTACLE_LEVEL, ObstacleMap};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Start and goal of the paper's Example 3, from the caecum back to its start.
const ENDS_M: [[f64; 2]; 2] = [[0.19, -0.28], [-0.24, -0.27]];
const PLANS: u64 = 1000;
/// Plans before the timed one, in benchmarks of a planner that has a tree already.
const BEFORE: u64 = 10;
/// Without disturbances: distance that the tool moves between two plans.
const STEP_M: f64 = 0.03;
/// Longest edges that OMPL is measured with: ERRT's, and OMPL's own choice, a fifth of the workspace's diagonal.
const OMPL_RANGES_M: [f64; 2] = [0.03, 0.14];
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
    // Each search is timed to its end, also one that ERRT would leave to the cells.
    let parameters = PlannerParameters { most_attempts: 20_000, ..*parameters };
    let start = Instant::now();
    planner.start(&parameters, obstacles, from, Point2::from(ENDS_M[1]));
    planner.advance(obstacles, usize::MAX);
    let took = start.elapsed();
    assert!(matches!(black_box(planner.progress()), Progress::Found(_)));
    took
}

fn quantiles(name: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let quantile = |share: f64| times[(share * (times.len() - 1) as f64) as usize];
    println!("errt/{name}: median {:?}, p99 {:?}, most {:?}", quantile(0.5), quantile(0.99), quantile(1.0));
}

/// Prints what OMPL's RRTConnect takes to plan the same path, and shorten it, with the clearance of ERRT's path as an
/// image of 1 mm pixels. Debian: `apt install g++ libompl-dev libboost-{filesystem,serialization,system}-dev`.
fn ompl(obstacles: &Obstacles, clearance_m: f64) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [image, program] = ["colon.pgm", "ompl"].map(|name| folder.join(name));
    let flags = Command::new("pkg-config").args(["--cflags", "--libs", "ompl"]).output();
    let Some(flags) = flags.ok().filter(|found| found.status.success()) else {
        println!("errt/OMPL: not installed");
        return;
    };
    let flags = String::from_utf8(flags.stdout).expect("flags are text");
    let mut compiler = Command::new("c++");
    compiler.args(["-O3", "-std=c++17", concat!(env!("CARGO_MANIFEST_DIR"), "/tests/benches/ompl.cpp"), "-o"]);
    assert!(compiler.arg(&program).args(flags.split_whitespace()).status().expect("a C++ compiler").success());

    let Rect { x_min_m, y_min_m, .. } = *obstacles.workspace();
    let [columns, rows] = <[f64; 2]>::from(obstacles.workspace().size_m()).map(|m| (m * 1e3).round() as usize + 1);
    let place = |pixel: usize| {
        Point2::new(x_min_m + (pixel % columns) as f64 * 1e-3, y_min_m + (pixel / columns) as f64 * 1e-3)
    };
    let pixels = (0..columns * rows).map(|pixel| u8::from(obstacles.distance_m(place(pixel)) >= clearance_m));
    let header = format!("P5 {columns} {rows} 1\n").into_bytes();
    std::fs::write(&image, header.into_iter().chain(pixels).collect::<Vec<u8>>()).expect("a folder for benchmarks");

    let ends = ENDS_M.as_flattened().chunks_exact(2).flat_map(|end| [end[0] - x_min_m, end[1] - y_min_m]);
    for range_m in OMPL_RANGES_M {
        let words = ends.clone().chain([PLANS as f64, range_m]).map(|number| number.to_string());
        let printed = Command::new(&program).arg(&image).args(words).output().expect("it was compiled");
        assert!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
        let printed = String::from_utf8(printed.stdout).expect("numbers are text");
        let (times, lengths_m): (Vec<_>, Vec<f64>) = printed
            .lines()
            .map(|line| {
                let (us, length_m) = line.split_once(' ').expect("two numbers");
                (Duration::from_secs_f64(us.parse::<f64>().unwrap() * 1e-6), length_m.parse::<f64>().unwrap())
            })
            .unzip();
        quantiles(&format!("OMPL's RRTConnect, edges up to {range_m} m"), times);
        println!("    mean length {:.3} m", lengths_m.iter().sum::<f64>() / lengths_m.len() as f64);
    }
}

/// Prints quantiles over many plans, and lets criterion time the same.
fn time(c: &mut Criterion, name: &str, plan: impl Fn(u64) -> Duration) {
    quantiles(name, (0..PLANS).map(&plan).collect());
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
    let mut lengths_m = Vec::new();
    let mut planner = Planner::new(0);
    for seed in 0..PLANS {
        planner = Planner::new(seed);
        plan(&mut planner, &full, &obstacles, Point2::from(ENDS_M[0]));
        if let Progress::Found(path) = planner.progress() {
            lengths_m.push(path.length_m());
        }
    }
    println!("errt: mean length {:.3} m", lengths_m.iter().sum::<f64>() / lengths_m.len() as f64);
    let Progress::Found(path) = planner.progress() else { panic!("no path across the colon") };
    ompl(&obstacles, path.clearance.asked_m);
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
