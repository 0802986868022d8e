//! From a camera frame to the policy's action, and training's updates.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::Criterion;
use ferry_camera::{AdapterChoice, Camera, Gpu};
use ferry_core::control::transport::rl::Rl;
use ferry_core::control::transport::{Transport, TransportInput};
use ferry_core::geometry::Point2;
use ferry_core::image::{CameraFrame, CameraMount, Subject};
use ferry_core::map::{FreeSpace, WALL_HEIGHT_M};
use ferry_core::perception::{ObstacleMap, Percept, wall_spread};
use ferry_core::policy::Policy;
use ferry_core::scenario::Parameters;
use ferry_core::trial::Arena;
use ferry_lab::learn::sweep::{STEP_M, Sweep};
use ferry_lab::learn::{Recipe, Run, State, Terrain};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

const FRAMES: usize = 300;
/// Updates that are timed together: one copy to the target network is among them.
const UPDATES: u64 = 100;

fn frames(arena: &Arena, gpu: &std::sync::Arc<Gpu>) -> Vec<(Point2<f64>, CameraFrame)> {
    let mut camera = Camera::of(gpu, arena.static_scene()).unwrap();
    let space = FreeSpace::new(&arena.map, 0.012);
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut look = || {
        let tool = space.sample(&arena.map, None, &mut rng).expect("there is free space");
        let subject = Subject {
            tick: 0,
            tool_m: [tool.x, tool.y, 0.1],
            turn_rad: 0.0,
            bead_m: [tool.x, tool.y, 0.0025],
            goal_m: None,
            link_frames: None,
            block_size_m: [0.05, 0.025, 0.01],
            mount: CameraMount::default(),
            moved_walls: None,
        };
        (tool, camera.capture(&subject).unwrap())
    };
    (0..FRAMES).map(|_| look()).collect()
}

/// Times the whole of a decision: the frame understood, the way onto the lattice, the network, the shield.
fn acting(c: &mut Criterion, arena: &Arena, frames: &[(Point2<f64>, CameraFrame)], name: &str) {
    let policy = Policy::shipped(name).unwrap();
    let parameters = Parameters::default();
    // All that the frames show: a policy with a memory gets it.
    let mut known = ObstacleMap::new(*arena.map.workspace());
    let spread = wall_spread(parameters.camera_height_m, WALL_HEIGHT_M);
    for (tool_m, frame) in frames {
        let percept = Percept::of(frame, *tool_m);
        known.update(&percept.dark(parameters.obstacle_level), &percept.calibration, spread);
    }
    let decide = |(tool_m, frame): &(Point2<f64>, CameraFrame)| {
        // Over the middle of a cell, where the network decides.
        let [x, y] = [tool_m.x, tool_m.y].map(|value: f64| ((value * 100.0 - 0.5).round() + 0.5) / 100.0);
        let start = Instant::now();
        let percept = Percept::of(frame, Point2::new(x, y));
        let goal_m = Point2::new(0.19, -0.28);
        let tool_m = Point2::new(x, y);
        let policy = Some(&*policy);
        let input =
            TransportInput { percept: &percept, known: &known, tool_m, goal_m, parameters: &parameters, policy };
        black_box(Rl::default().next_step(&input).unwrap());
        start.elapsed()
    };
    let mut times: Vec<Duration> = frames.iter().map(decide).collect();
    times.sort_unstable();
    let quantile = |share: f64| times[(share * (times.len() - 1) as f64) as usize];
    println!(
        "policy/{name}, frame to action: median {:?}, p99 {:?}, most {:?}",
        quantile(0.5),
        quantile(0.99),
        quantile(1.0)
    );
    let mut cycle = frames.iter().cycle();
    c.bench_function(&format!("policy/{name}, frame to action"), |b| {
        b.iter_custom(|count| cycle.by_ref().take(count as usize).map(decide).sum());
    });
}

pub fn benches(c: &mut Criterion) {
    let arena = Arena::shipped("colon").unwrap();
    let gpu = Gpu::open(AdapterChoice::Auto).unwrap();
    let frames = frames(&arena, &gpu);
    for name in ["colon", "explorer"] {
        acting(c, &arena, &frames, name);
    }
    let recipe = Recipe { updates: UPDATES, ..Recipe::default() };
    let sweep = Sweep::take(&arena, &gpu, STEP_M, &[], &|| std::ops::ControlFlow::Continue(())).unwrap();
    let terrains = [Terrain::new("colon", arena.map.workspace(), &sweep, recipe.clearance_m).unwrap()];
    let pool = rayon::ThreadPoolBuilder::new().build().unwrap();
    let train = || {
        let mut state = State::new(recipe.clone(), 1, &terrains).unwrap();
        let start = Instant::now();
        pool.install(|| state.advance(&terrains, &|| true, &mut |_| true)).unwrap();
        start.elapsed()
    };
    let took = train();
    println!("learn/updates: {:.1} updates/s, with filling the replay", UPDATES as f64 / took.as_secs_f64());
    let mut group = c.benchmark_group("learn");
    group.sample_size(10).bench_function(format!("{UPDATES} updates from nothing"), |b| b.iter(train));
    group.finish();
}
