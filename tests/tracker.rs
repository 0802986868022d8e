//! Trials whose tracker is lost, or poor.

use std::ops::ControlFlow;

use ferry_camera::Camera;
use ferry_core::control::Refusal;
use ferry_core::control::switching::Mode;
use ferry_core::geometry::Point2;
use ferry_core::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted, When};
use ferry_core::trial::{Arena, Event, Happening, Moment, Nowhere, Phase, Source, StopReason, TickRecord, Trial};
use ferry_lab::evaluate::{Venue, episode};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::support::gpu;

/// Seconds of simulated time per control step.
const STEP_S: f64 = 0.25;

fn dropout(step: u32, for_s: f64) -> Scripted {
    Scripted { at: When::Step(step), disturbance: Disturbance::Dropout { for_s } }
}

struct Loss {
    delivered: bool,
    duration_s: f64,
    /// Switches to sub-controller 1 while the bead was within the threshold.
    false_losses: u32,
    held_steps: u32,
}

fn carry(scenario: Scenario, venue: &Venue) -> Loss {
    let mut camera = Camera::of(&gpu(), venue.arena.static_scene()).unwrap();
    let threshold_m = scenario.parameters.threshold_m;
    let (mut false_losses, mut last) = (0, None::<Moment>);
    let ended = episode(scenario, venue, &mut camera, &mut Nowhere::default(), &mut |record| {
        let now = &record.moment;
        let switched = record.decision.as_ref().is_some_and(|decision| decision.switching.switched);
        if switched && now.switching.mode == Mode::Approach && now.tracking_error_m().norm() <= threshold_m {
            false_losses += 1;
        }
        last = Some(now.clone());
        ControlFlow::Continue(())
    });
    let last = last.unwrap();
    Loss {
        delivered: ended.unwrap().delivered,
        duration_s: last.sim_time_s(),
        false_losses,
        held_steps: last.counters.held_steps,
    }
}

/// Undisturbed trials on a map, each without a loss and with losses of these durations at a random step of the transport.
fn losses(
    map: &str,
    controller: ControllerName,
    parameters: &Parameters,
    for_s: [f64; 3],
    trials: u64,
) -> Vec<(Loss, [Loss; 3])> {
    let venue = Venue::of(Arena::shipped(map).unwrap());
    (0..trials)
        .into_par_iter()
        .map(|index| {
            let arena = &venue.arena;
            let random = arena.random(map, controller, 0, 2026, index).unwrap();
            let plain = Scenario { parameters: parameters.clone(), ..random };
            // No path is shorter than the straight line, so the transport has at least this many steps.
            let least = ((plain.goal_m.unwrap() - plain.start_m.unwrap()).norm() / 0.01) as u32;
            let step = ChaCha8Rng::seed_from_u64(index).random_range(2..least.max(4) - 1);
            let blind = |for_s| Scenario { script: vec![dropout(step, for_s)], ..plain.clone() };
            let blind = for_s.map(|for_s| carry(blind(for_s), &venue));
            (carry(plain, &venue), blind)
        })
        .collect()
}

/// `FERRY_LOSSES` trials per map, controller and duration instead of a few.
fn lose(name: &str, parameters: &Parameters) {
    let trials = std::env::var("FERRY_LOSSES").map_or(4, |count| count.parse().unwrap());
    let durations_s = [3.0, 5.0, 10.0];
    for map in ["colon", "posts"] {
        for controller in ControllerName::AUTOMATIC {
            let all = losses(map, controller, parameters, durations_s, trials);
            for (number, for_s) in durations_s.into_iter().enumerate() {
                let pairs: Vec<[&Loss; 2]> = all.iter().map(|(plain, blind)| [plain, &blind[number]]).collect();
                let name = format!("{name}, {map}, {}, {for_s} s", controller.as_str());
                let false_losses: u32 = pairs.iter().map(|[_, blind]| blind.false_losses).sum();
                let count = |wanted: fn(&[&Loss; 2]) -> bool| pairs.iter().filter(|pair| wanted(pair)).count();
                let both = count(|[plain, blind]| plain.delivered && blind.delivered);
                let (before, after) = (count(|[plain, _]| plain.delivered), count(|[_, blind]| blind.delivered));
                let mut longer_s: Vec<f64> = pairs
                    .iter()
                    .filter(|[plain, blind]| plain.delivered && blind.delivered)
                    .map(|[plain, blind]| blind.duration_s - plain.duration_s)
                    .collect();
                longer_s.sort_by(f64::total_cmp);
                let median_s = longer_s.get(longer_s.len() / 2).copied().unwrap_or_default();
                let held: u32 = pairs.iter().map(|[_, blind]| blind.held_steps).sum();
                println!(
                    "{name}: delivered {before} without and {after} with a loss, {both} both; \
                     median {median_s:+.2} s; false losses {false_losses}; held {held} steps"
                );
                assert_eq!(false_losses, 0, "{name}");
                assert!(held > 0, "{name}");
                assert!(median_s <= for_s + STEP_S, "{name}: {median_s} s");
                if controller != ControllerName::Attractor {
                    assert!(after as f64 >= 0.98 * before as f64, "{name}: {after} of {before}");
                }
            }
        }
    }
}

#[test]
#[ignore = "long"]
fn a_lost_tracker_costs_only_time() {
    lose("ideal mount", &Parameters::default());
}

#[test]
#[ignore = "long"]
fn a_lost_tracker_costs_only_time_under_the_realistic_mount_when_the_arm_hides_the_bead() {
    let changes = ["preset=realistic", "tracker_is_hidden_by_arm=true"].map(str::to_owned);
    lose("realistic mount, hidden by the arm", &Parameters::default().with(&changes).unwrap());
}

fn run(scenario: Scenario, is_over: impl Fn(&TickRecord) -> bool) -> Vec<TickRecord> {
    let arena = Arena::shipped(&scenario.map).unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut trial = Trial::new(scenario, arena).unwrap();
    let mut records = Vec::new();
    while records.last().is_none_or(|last| !is_over(last)) {
        assert!(records.len() < 20_000, "it does not end");
        records.push(trial.tick(Source::Camera(&mut camera)).unwrap());
    }
    records
}

fn texts(records: &[TickRecord]) -> Vec<String> {
    records.iter().flat_map(|record| &record.events).map(Event::text).collect()
}

#[test]
fn a_bead_that_was_moved_meanwhile_is_found_with_the_camera() {
    let displaced = Scripted { at: When::Tick(300), disturbance: Disturbance::Displace { x_m: 0.2, y_m: -0.28 } };
    let scenario = Scenario {
        start_m: Some(Point2::new(-0.1, -0.45)),
        goal_m: Some(Point2::new(-0.25, -0.45)),
        script: vec![dropout(5, 20.0), displaced],
        ..Scenario::idle("open", 1)
    };
    let records = run(scenario, |record| record.moment.phase.is_final());
    assert_eq!(records.last().unwrap().moment.phase, Phase::Delivered);
    let texts = texts(&records);
    let at =
        |part: &str| texts.iter().position(|text| text.contains(part)).unwrap_or_else(|| panic!("{part}: {texts:?}"));
    assert!(at("the arm holds: tracker lost") < at("the arm looks for it"));
    assert!(at("the arm looks for it") < at("the tracker reports the bead again"));
    // The arm was over the bead before the tracker reported it.
    let back =
        records.iter().position(|one| one.events.iter().any(|event| event.what == Happening::TrackerBack)).unwrap();
    let gap_m = records[back].moment.tracking_error_m().norm();
    assert!(gap_m < 0.1, "{gap_m} m");
    assert_eq!(records.last().unwrap().moment.counters.switches, 0, "no fetch of a place where nothing is");
}

#[test]
fn steps_without_the_tracker_have_their_own_limit() {
    let scenario = Scenario {
        start_m: Some(Point2::new(-0.1, -0.45)),
        goal_m: Some(Point2::new(-0.25, -0.45)),
        parameters: Parameters { step_limit: 20, ..Parameters::default() },
        script: vec![dropout(3, 60.0)],
        ..Scenario::idle("open", 1)
    };
    let records = run(scenario, |record| record.moment.phase.is_final());
    let last = &records.last().unwrap().moment;
    assert_eq!(last.phase, Phase::Stopped(StopReason::TrackerLost));
    assert!(last.counters.leg_steps <= 5, "{:?}", last.counters);
    let holds = |one: &TickRecord| {
        one.decision.as_ref().is_some_and(|made| made.refusal == Some(Refusal::TrackerLost { is_searching: false }))
    };
    assert!(records.iter().any(holds));
}

#[test]
fn the_step_limit_is_a_parameter() {
    let scenario = |step_limit| Scenario {
        start_m: Some(Point2::new(-0.25, -0.45)),
        goal_m: Some(Point2::new(0.2, -0.3)),
        parameters: Parameters { step_limit, ..Parameters::default() },
        ..Scenario::idle("open", 1)
    };
    let ended = |step_limit| {
        let records = run(scenario(step_limit), |record| record.moment.phase.is_final());
        let moment = records.last().unwrap().moment.clone();
        (moment.phase, moment.counters.leg_steps)
    };
    assert_eq!(ended(20), (Phase::Stopped(StopReason::LegSteps { limit: 20 }), 20));
    assert_eq!(ended(150).0, Phase::Delivered);
    let none = Scenario { parameters: Parameters { step_limit: 9, ..Parameters::default() }, ..scenario(20) };
    let error = Trial::new(none, Arena::shipped("open").unwrap()).unwrap_err().to_string();
    assert_eq!(error, "parameters: step_limit is 9, it must be 10 to 5000");
}
