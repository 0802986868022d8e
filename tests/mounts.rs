//! The realistic camera mount: magnet and gripper are in the picture, and hide a part of the table.

use std::ops::ControlFlow;

use ferry_camera::Camera;
use ferry_core::control::Refusal;
use ferry_core::geometry::{Point2, Vector2};
use ferry_core::map::FreeSpace;
use ferry_core::perception::{CellState, ObstacleMap, Percept, wall_spread};
use ferry_core::scenario::{CLEARANCE_M, ControllerName, Parameters, Scenario};
use ferry_core::trial::{Arena, Nowhere, Source, Trial};
use ferry_lab::evaluate::{Venue, episode};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::support::gpu;

fn realistic() -> Parameters {
    Parameters::default().with(&["preset=realistic".to_owned()]).unwrap()
}

fn idle(map: &str, parameters: &Parameters, start_m: Point2<f64>) -> Trial {
    let scenario = Scenario { parameters: parameters.clone(), start_m: Some(start_m), ..Scenario::idle(map, 1) };
    Trial::new(scenario, Arena::shipped(map).unwrap()).unwrap()
}

/// Free places of a map, at random.
fn places(map: &str, count: usize) -> Vec<Point2<f64>> {
    let arena = Arena::shipped(map).unwrap();
    let space = FreeSpace::new(&arena.map, CLEARANCE_M);
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    (0..count).map(|_| space.sample(&arena.map, None, &mut rng).unwrap()).collect()
}

#[test]
fn the_obstacle_patch_and_every_step_are_visible_and_the_magnet_is_in_the_picture() {
    for map in ["colon", "posts"] {
        let mut camera = Camera::of(&gpu(), Arena::shipped(map).unwrap().static_scene()).unwrap();
        for place in places(map, 40) {
            let trial = idle(map, &realistic(), place);
            let tool_m = trial.tool_m().xy();
            let percept = Percept::of(&camera.capture(&trial.subject()).unwrap(), tool_m);
            // Twice the default step.
            for step in [[0.0, 0.0], [0.02, 0.0], [-0.02, 0.0], [0.0, 0.02], [0.0, -0.02]].map(Vector2::from) {
                let at = tool_m + step;
                assert!(percept.calibration.sees(at) && !percept.is_hidden(at), "{map}: {at} from {tool_m}");
            }
            let hidden = (0..100 * 100).filter(|i| {
                let offset = Vector2::new(0.002 * f64::from(i % 100) - 0.1, 0.002 * f64::from(i / 100) - 0.1);
                percept.is_hidden(tool_m + offset)
            });
            let share = hidden.count() as f64 / 1e4;
            assert!((0.05..0.4).contains(&share), "{map}: the magnet hides {share} of the picture at {tool_m}");
        }
    }
}

#[test]
fn what_the_magnet_hides_is_neither_free_nor_wall() {
    for map in ["colon", "posts"] {
        let arena = Arena::shipped(map).unwrap();
        let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
        let parameters = realistic();
        let spread = wall_spread(parameters.camera_height_m, ferry_core::map::WALL_HEIGHT_M);
        // The magnet hides what is to the left; there it must be in the workspace.
        for place in places(map, 40).into_iter().filter(|place| place.x > -0.12) {
            let trial = idle(map, &parameters, place);
            let tool_m = trial.tool_m().xy();
            let percept = Percept::of(&camera.capture(&trial.subject()).unwrap(), tool_m);
            let mut known = ObstacleMap::new(*arena.map.workspace());
            let hidden = percept.hidden();
            let dark = percept.dark(parameters.obstacle_level);
            known.update_around(&dark, hidden.as_ref(), &percept.calibration, spread);
            let (mut unknown, mut wrong) = (0, Vec::new());
            for i in 0..100 * 100 {
                let offset = Vector2::new(0.002 * f64::from(i % 100) - 0.1, 0.002 * f64::from(i / 100) - 0.1);
                let at = tool_m + offset;
                if !arena.map.workspace().contains(at) {
                    continue;
                }
                match known.state(at) {
                    CellState::Unknown => unknown += 1,
                    CellState::Obstacle if arena.map.clearance_m(at) > 0.004 => wrong.push(at),
                    CellState::Free if arena.map.clearance_m(at) < -0.004 => wrong.push(at),
                    CellState::Free | CellState::Obstacle => {}
                }
            }
            assert!(unknown > 300, "{map}: {unknown} unknown at {tool_m}");
            assert!(wrong.is_empty(), "{map}: {wrong:?} from {tool_m}");
        }
    }
}

#[test]
fn the_networks_image_does_not_depend_on_the_mount_unless_it_is_not_corrected() {
    let arena = Arena::shipped("colon").unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut image = |parameters: &Parameters, place: Point2<f64>| {
        let trial = idle("colon", parameters, place);
        trial.observe(&mut camera).unwrap().observation().channel(0).pixels
    };
    let aside = Parameters { camera_offset_x_m: 0.03, ..Parameters::default() };
    let raw = Parameters { rl_corrects_image: false, ..aside.clone() };
    let differs = |one: &[u8], other: &[u8]| {
        let count = one.iter().zip(other).filter(|(a, b)| a.abs_diff(**b) > 60).count();
        count as f64 / one.len() as f64
    };
    // The strip that the moved camera does not see was never seen: it is shown as floor.
    let is_seen = |pixels: &[u8]| -> Vec<u8> { pixels.chunks(84).flat_map(|row| row[14..].to_vec()).collect() };
    for place in places("colon", 10) {
        let ideal = image(&Parameters::default(), place);
        let (corrected, own) = (image(&aside, place), image(&raw, place));
        let share = differs(&is_seen(&ideal), &is_seen(&corrected));
        assert!(share < 0.03, "{share} of the corrected image differs at {place}");
        assert!(differs(&ideal, &own) > share, "the camera's own image differs more at {place}");
    }
}

#[test]
fn a_camera_above_the_magnet_admits_no_step() {
    let parameters = Parameters { camera_sees_magnet: true, ..Parameters::default() };
    let scenario = Scenario {
        parameters,
        start_m: Some(Point2::new(-0.1, -0.45)),
        goal_m: Some(Point2::new(0.1, -0.45)),
        ..Scenario::idle("open", 1)
    };
    let arena = Arena::shipped("open").unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut trial = Trial::new(scenario, arena).unwrap();
    let start_m = trial.tool_m();
    let mut refusals = Vec::new();
    for _ in 0..100 {
        let record = trial.tick(Source::Camera(&mut camera)).unwrap();
        refusals.extend(record.decision.and_then(|decision| decision.refusal));
    }
    assert!(!refusals.is_empty() && refusals.iter().all(|one| matches!(one, Refusal::Hidden { .. })), "{refusals:?}");
    assert!((trial.tool_m() - start_m).norm() < 1e-6);
}

/// `FERRY_TRIALS` trials per map and controller instead of a few.
#[test]
#[ignore = "long"]
fn all_three_controllers_work_under_the_realistic_mount() {
    let trials: u64 = std::env::var("FERRY_TRIALS").map_or(6, |count| count.parse().unwrap());
    for map in ["posts", "colon"] {
        let venue = Venue::of(Arena::shipped(map).unwrap());
        for controller in ControllerName::AUTOMATIC {
            let delivered = |parameters: &Parameters| {
                let one = |index| {
                    let arena = &venue.arena;
                    let random = arena.random(map, controller, 0, 4, index).unwrap();
                    let scenario = Scenario { parameters: parameters.clone(), ..random };
                    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
                    let go_on = &mut |_: &_| ControlFlow::Continue(());
                    episode(scenario, &venue, &mut camera, &mut Nowhere::default(), go_on).unwrap().delivered
                };
                (0..trials).into_par_iter().filter(|&index| one(index)).count()
            };
            let (ideal, realistic) = (delivered(&Parameters::default()), delivered(&realistic()));
            println!("{map}, {}: {ideal} of {trials} ideal, {realistic} realistic", controller.as_str());
            // The attractor fails on half of the colon anyway.
            if !(map == "colon" && controller == ControllerName::Attractor) {
                assert!(realistic as f64 >= 0.8 * trials as f64, "{map}, {}: {realistic}", controller.as_str());
            }
        }
    }
}
