//! Scripted disturbances: kicks, pushes, displacements, dropouts; and trials without an arm.

use ferry_camera::Camera;
use ferry_core::geometry::Point2;
use ferry_core::plant::PositionerKind;
use ferry_core::scenario::{Disturbance, Parameters, Scenario, Scripted, When};
use ferry_core::trial::{Arena, EventKind, Moment, Phase, Source, TickRecord, Trial, TrialError};

use crate::support::gpu;

const START: Point2<f64> = Point2::new(0.0, -0.4);

fn scripted(at: When, disturbance: Disturbance) -> Scenario {
    let script = vec![Scripted { at, disturbance }];
    Scenario { start_m: Some(START), script, ..Scenario::idle("open", 1) }
}

fn run(scenario: Scenario, ticks: usize) -> Vec<TickRecord> {
    let arena = Arena::shipped(&scenario.map).unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut trial = Trial::new(scenario, arena).unwrap();
    (0..ticks).map(|_| trial.tick(Source::Camera(&mut camera)).unwrap()).collect()
}

fn disturbed_at(records: &[TickRecord]) -> Vec<usize> {
    let is_one = |record: &&TickRecord| record.events.iter().any(|event| event.kind() == EventKind::Disturbance);
    records.iter().filter(is_one).map(|record| record.tick as usize).collect()
}

fn moved_m(moment: &Moment) -> f64 {
    (moment.bead_m.xy() - START).norm()
}

#[test]
fn a_kick_is_applied_at_its_tick() {
    let kick = Disturbance::Impulse { x_n_s: 3e-4, y_n_s: 0.0 };
    let records = run(scripted(When::Tick(50), kick), 60);
    assert_eq!(disturbed_at(&records), [51], "the tick that begins at 50 ends at 51");
    assert!(moved_m(&records[49].moment) < 1e-3 && moved_m(&records[59].moment) > 0.01);
}

#[test]
fn a_push_lasts_for_its_duration() {
    let push = Disturbance::Drift { x_n: 0.0, y_n: -1.5e-3, for_s: 0.4 };
    let records = run(scripted(When::Tick(10), push), 200);
    let y = |at: usize| records[at].moment.bead_m.y;
    assert!(y(60) < y(20) - 1e-3, "the push moves the bead");
    assert!(y(199) > y(60), "the magnet pulls the bead back");
}

#[test]
fn a_dropout_stops_the_tracker_for_its_duration() {
    let records = run(scripted(When::Tick(10), Disturbance::Dropout { for_s: 0.8 }), 150);
    let tracked = |at: usize| records[at].moment.tracked_m;
    assert!((13..110).all(|at| tracked(at) == tracked(12)), "no samples for a hundred ticks");
    assert!((114..149).all(|at| tracked(at) != tracked(12)));
}

#[test]
fn a_displacement_is_applied_at_its_step() {
    let away = Disturbance::Displace { x_m: 0.2, y_m: -0.3 };
    let scenario = Scenario { goal_m: Some(Point2::new(-0.25, -0.4)), ..scripted(When::Step(5), away) };
    let records = run(scenario, 400);
    let at = disturbed_at(&records);
    assert_eq!(at.len(), 1);
    assert_eq!(records[at[0] - 1].moment.counters.goal_steps, 5);
    let modes: Vec<u8> = records.iter().map(|record| record.moment.switching.mode.index()).collect();
    let fetched = modes[at[0]..].windows(2).any(|pair| pair == [1, 2]);
    assert!(fetched, "sub-controller 1 fetches the bead and hands over");
}

#[test]
fn the_longer_dropout_and_the_last_push_count() {
    let at = |tick, disturbance| Scripted { at: When::Tick(tick), disturbance };
    let push = |y_n, for_s| Disturbance::Drift { x_n: 0.0, y_n, for_s };
    let script = vec![
        at(10, Disturbance::Dropout { for_s: 0.8 }),
        at(20, Disturbance::Dropout { for_s: 0.1 }),
        at(10, push(-2e-3, 60.0)),
        at(60, push(2e-3, 0.1)),
    ];
    let records = run(Scenario { start_m: Some(START), script, ..Scenario::idle("open", 1) }, 400);
    let tracked = |at: usize| records[at].moment.tracked_m;
    assert!((13..110).all(|at| tracked(at) == tracked(12)));
    assert!(moved_m(&records[399].moment) < 0.02, "the push has ended: {}", moved_m(&records[399].moment));
}

#[test]
fn simultaneous_kicks_are_limited_to_the_maximum() {
    let kick = Scripted { at: When::Tick(5), disturbance: Disturbance::Impulse { x_n_s: 2e-3, y_n_s: 0.0 } };
    let records = run(Scenario { start_m: Some(START), script: vec![kick; 64], ..Scenario::idle("open", 1) }, 6);
    // 4.1 m/s for 8 ms.
    assert!(moved_m(&records[5].moment) < 0.033, "{}", moved_m(&records[5].moment));
    assert_eq!(records[5].moment.counters.disturbances, 64);
}

#[test]
fn invalid_scripts_are_refused_by_field() {
    let refusal = |disturbance| {
        let arena = Arena::shipped("open").unwrap();
        Trial::new(scripted(When::Tick(1), disturbance), arena).unwrap_err()
    };
    let far = refusal(Disturbance::Displace { x_m: 2.0, y_m: 0.0 });
    assert!(matches!(&far, TrialError::Script { index: 0, error } if error.field() == "displace"), "{far}");
    let hard = refusal(Disturbance::Impulse { x_n_s: 1.0, y_n_s: 0.0 });
    let expected = "script[0]: disturbance: x_n_s is 1, it must be finite, and both together at most 0.002";
    assert_eq!(hard.to_string(), expected);
    let many = vec![Scripted { at: When::Tick(1), disturbance: Disturbance::Dropout { for_s: 1.0 } }; 65];
    let long = Trial::new(Scenario { script: many, ..Scenario::idle("open", 1) }, Arena::shipped("open").unwrap());
    assert_eq!(long.unwrap_err().to_string(), "script has 65 disturbances, the limit is 64");
}

/// The paper's Examples 1 and 2, beyond the arm's reach, at the speed of its robot: 19 mm per step.
#[test]
fn the_planar_stage_delivers_the_papers_examples() {
    let parameters = Parameters { transport_speed_m_s: 0.076, ..Parameters::default() };
    let away = Scripted { at: When::Step(50), disturbance: Disturbance::Displace { x_m: 0.42, y_m: 0.55 } };
    let examples = [
        (Point2::new(-0.78, 0.73), Point2::new(0.77, 0.19), Vec::new()),
        (Point2::new(0.72, 0.76), Point2::new(-0.77, 0.12), vec![away]),
    ];
    for (start, goal, script) in examples {
        let disturbed = !script.is_empty();
        let scenario = Scenario {
            start_m: Some(start),
            goal_m: Some(goal),
            parameters: parameters.clone(),
            script,
            ..Scenario::idle("attractor-example", 1)
        };
        let records = run(scenario, 5000);
        let last = &records.last().unwrap().moment;
        assert_eq!(last.positioner.kind(), PositionerKind::PlanarStage);
        assert_eq!(last.phase, Phase::Delivered, "from {start}");
        assert_eq!(
            last.counters.switches,
            if disturbed { 2 } else { 0 },
            "the bead is lost and fetched once, or never"
        );
        assert!(records.iter().all(|record| (record.moment.tool_m.z - 0.1).abs() < 1e-12));
    }
}

#[test]
fn the_arm_is_refused_on_maps_beyond_its_reach() {
    let mut scenario = Scenario::idle("attractor-example", 1);
    scenario.start_m = Some(Point2::new(-0.78, 0.73));
    scenario.positioner = Some(PositionerKind::Arm);
    let arena = Arena::shipped("attractor-example").unwrap();
    let refusal = Trial::new(scenario.clone(), arena.clone()).unwrap_err().to_string();
    assert!(refusal.contains("start_m") && refusal.contains("1.068 m from the base"), "{refusal}");
    scenario.start_m = arena.space.points().find(|p| (0.3..0.7).contains(&p.coords.norm()));
    scenario.goal_m = None;
    let trial = Trial::new(scenario, arena).unwrap();
    assert_eq!(trial.moment().positioner.kind(), PositionerKind::Arm);
}
