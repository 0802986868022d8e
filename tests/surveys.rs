//! What a policy with a memory sees live, compared with what it saw in training.

use std::sync::Arc;

use ferry_camera::Camera;
use ferry_core::control::transport::rl::Rl;
use ferry_core::control::transport::{Transport, TransportInput};
use ferry_core::geometry::Point2;
use ferry_core::map::{MazeFamily, WALL_HEIGHT_M};
use ferry_core::perception::{Area, ObstacleMap, Percept, wall_spread};
use ferry_core::policy::{Policy, Survey};
use ferry_core::scenario::{Parameters, Scenario};
use ferry_core::trial::{Arena, Trial};
use ferry_lab::learn::MazeLattice;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{ferry, gpu};

/// Training's distance between a cell and the nearest wall, and by how much perception may see walls nearer.
const CLEARANCE_M: f64 = 0.008;
const MARGIN_M: f64 = 0.0025;
/// Cells to each side of the tool that training takes as seen, at least and at most.
const SEEN: [i64; 2] = [8, 10];

/// What the camera shows with the tool above a place.
fn percept_above(arena: &Arc<Arena>, camera: &mut Camera, tool_m: Point2<f64>) -> Percept {
    let scenario = Scenario { start_m: Some(tool_m), ..Scenario::idle(arena.map.name(), 1) };
    let subject = Trial::new(scenario, arena.clone()).unwrap().subject();
    Percept::of(&camera.capture(&subject).unwrap(), tool_m)
}

/// An obstacle map after one image.
fn observed(percept: &Percept, arena: &Arena) -> ObstacleMap {
    let parameters = Parameters::default();
    let mut known = ObstacleMap::new(*arena.map.workspace());
    let spread = wall_spread(parameters.camera_height_m, WALL_HEIGHT_M);
    known.update(&percept.dark(parameters.obstacle_level), &percept.calibration, spread);
    known
}

#[test]
fn perception_gives_the_survey_that_training_has() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut compared, mut open) = (0, 0);
    for (family, seed) in [(MazeFamily::Tubes, 3), (MazeFamily::Stones, 4), (MazeFamily::Rooms, 5)] {
        let maze = ferry_core::map::Maze::generate(family, seed).unwrap();
        let lattice = MazeLattice::of(&maze.map);
        let arena = Arena::of(maze.map);
        let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
        for _ in 0..8 {
            let tool = loop {
                let cell = rng.random_range(0..lattice.count());
                if lattice.clearance_m(cell) > 0.012 {
                    break cell;
                }
            };
            let tool_m = lattice.center_m(tool);
            let known = observed(&percept_above(&arena, &mut camera, tool_m), &arena);
            let survey = Survey::over(&known, 0.01, CLEARANCE_M, [tool_m, tool_m]);
            assert_eq!((survey.shape(), survey.tool), (lattice.shape(), tool));
            for cell in 0..survey.count() {
                let [away, up] = [0, 1].map(|axis| (survey.place(cell)[axis] - survey.place(tool)[axis]).abs());
                let clearance_m = lattice.clearance_m(cell);
                match survey.known(cell) {
                    Area::Unknown => assert!(away.max(up) > SEEN[0], "a near cell is unseen: {away}, {up}"),
                    Area::Free => {
                        assert!(clearance_m > CLEARANCE_M - 0.0005, "free at {clearance_m} m from a wall");
                        assert!(away.max(up) <= SEEN[1], "a far cell is free: {away}, {up}");
                        open += 1;
                    }
                    Area::Blocked => {
                        assert!(clearance_m < CLEARANCE_M + MARGIN_M, "blocked at {clearance_m} m from a wall");
                    }
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 40_000 && open > 2000, "{open} open cells of {compared}");
}

/// The policy decides by the obstacle map, not by the image alone.
#[test]
fn the_explorer_decides_by_the_obstacle_map() {
    let arena = Arena::shipped("posts").unwrap();
    let policy = Policy::shipped("explorer").unwrap();
    let (tool_m, goal_m) = (Point2::new(-0.045, -0.375), Point2::new(0.205, -0.375));
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let percept = percept_above(&arena, &mut camera, tool_m);
    let parameters = Parameters::default();
    let judged = |known: &ObstacleMap| {
        let mut rl = Rl::default();
        let policy = Some(&*policy);
        let input = TransportInput { percept: &percept, known, tool_m, goal_m, parameters: &parameters, policy };
        rl.next_step(&input).unwrap();
        (rl.survey().unwrap().clone(), rl.decision().unwrap().judgement.values())
    };
    let empty = ObstacleMap::new(*arena.map.workspace());
    let (before, after) = (judged(&empty), judged(&observed(&percept, &arena)));
    assert_ne!(before.0, after.0);
    assert_ne!(before.1, after.1);
}

/// Where the obstacle map shows its next cells clear, the tool goes straight over them.
#[test]
fn a_shortcut_leads_over_observed_cells_only() {
    let arena = Arena::shipped("open").unwrap();
    let policy = Policy::shipped("explorer").unwrap();
    let (tool_m, goal_m) = (Point2::new(-0.045, -0.425), Point2::new(0.055, -0.325));
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let percept = percept_above(&arena, &mut camera, tool_m);
    let step_m = |known: &ObstacleMap, parameters: &Parameters| {
        let policy = Some(&*policy);
        let input = TransportInput { percept: &percept, known, tool_m, goal_m, parameters, policy };
        let step_m = Rl::default().next_step(&input).unwrap().target_m - tool_m;
        [step_m.x, step_m.y].map(|side_m| (1000.0 * side_m).round())
    };
    let standard = Parameters::default();
    let unobserved = ObstacleMap::new(*arena.map.workspace());
    let observed = observed(&percept, &arena);
    let along_an_axis = |step: [f64; 2]| step.contains(&0.0) && step.contains(&10.0);
    let oblique = step_m(&observed, &standard);
    assert!(oblique.iter().all(|&side| side > 1.0), "{oblique:?}");
    let by_axis = step_m(&observed, &Parameters { rl_shortcut: false, ..standard.clone() });
    assert!(along_an_axis(by_axis), "{by_axis:?}");
    let unseen = step_m(&unobserved, &standard);
    assert!(along_an_axis(unseen), "{unseen:?}");
}

/// In this trial the policy's route comes back to the cell that it begins in, while its memory stays the same.
#[test]
fn a_route_that_comes_back_does_not_hold_the_tool() {
    let folder = tempfile::tempdir().unwrap();
    let made = ferry(&["maps", "generate", "--family", "spirals", "--seed", "4", "--count", "1", "--out"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let done = ferry(&["evaluate", "--controller", "rl", "--episodes", "3", "--episode", "2", "--seed", "77"])
        .args(["--set", "step_limit=400", "--json", "--map"])
        .arg(folder.path().join("spirals-4.svg"))
        .output()
        .unwrap();
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(report["rows"][0]["delivered"], 1, "{report}");
}
