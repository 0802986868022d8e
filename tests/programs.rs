//! A program outside of Ferry as sub-controller 2, without a connection.

use std::sync::Arc;

use ferry_camera::Camera;
use ferry_core::control::Refusal;
use ferry_core::geometry::Point2;
use ferry_core::image::ImageSource;
use ferry_core::policy::Shipped;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::trial::{
    Arena, Beginning, Deciding, Entry, Input, InputError, InputLog, LoggedBeginning, LoggedTick, Phase,
    REASON_BYTES_MOST, Seen, Source, Trial, replay,
};

use crate::support::gpu;

fn scenario(arena: &Arena) -> Scenario {
    arena.random("posts", ControllerName::Program, 1, 4, 0).unwrap()
}

/// A place on the shortest path to the goal, or beyond it in the same direction.
fn ahead(arena: &Arena, from: Point2<f64>, goal: Point2<f64>, by_m: f64) -> Input {
    let path = arena.space.taut_path(from, goal).unwrap();
    let next = from + (path[1] - from).normalize() * by_m;
    Input::Go { x_m: next.x, y_m: next.y }
}

/// Asks `program` before each control step, until the trial ends.
fn run(
    trial: &mut Trial,
    camera: &mut dyn ImageSource,
    program: &mut dyn FnMut(&Trial, &Seen) -> Option<Input>,
) -> Vec<LoggedTick> {
    let mut ticks = Vec::new();
    while !trial.state().world.phase.is_final() {
        let source = if trial.step_is_due() {
            let seen = trial.see(camera).unwrap();
            if trial.question(&seen).is_some()
                && let Some(answer) = program(trial, &seen)
            {
                trial.apply(answer).unwrap();
            }
            Source::Seen(Box::new(seen))
        } else {
            Source::Camera(camera)
        };
        ticks.push(LoggedTick::from(&trial.tick(source).unwrap()));
    }
    ticks
}

#[test]
fn a_program_delivers_and_its_log_replays_without_it() {
    let arena = Arena::shipped("posts").unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut trial = Trial::new(scenario(&arena), arena.clone()).unwrap();
    let begun = Entry::Begin(Box::new(LoggedBeginning::of(&trial, Beginning::SetUp)));
    let mut asked = 0;
    let ticks = run(&mut trial, &mut camera, &mut |trial, seen| {
        asked += 1;
        let question = trial.question(seen).unwrap();
        assert_eq!(question.tool_m, trial.tool_m().xy());
        assert_eq!(trial.observation(seen).places().len(), 4);
        // A rule that knows the map: along the shortest path, two steps ahead.
        Some(ahead(&arena, question.tool_m, question.goal_m, 0.02))
    });
    assert_eq!(trial.state().world.phase, Phase::Delivered);
    let counters = trial.state().world.counters;
    assert!(counters.disturbances == 1 && counters.switches >= 2, "sub-controller 1 fetches the bead: {counters:?}");
    assert!(asked > 20 && asked < counters.steps, "asked {asked} times in {} steps", counters.steps);

    let entries = std::iter::once(begun).chain(ticks.into_iter().map(Entry::Tick)).collect();
    let log = InputLog { entries, torn_bytes: 0 };
    replay(&log, None, &mut |_| {}).unwrap();
    let mut make_camera =
        |arena: &Arena| Ok(Box::new(Camera::of(&gpu(), arena.static_scene())?) as Box<dyn ImageSource>);
    let deciding = Deciding { make_camera: &mut make_camera, policies: Arc::new(Shipped) };
    replay(&log, Some(deciding), &mut |_| {}).unwrap();
}

#[test]
fn without_a_usable_answer_the_arm_holds() {
    let arena = Arena::shipped("posts").unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    let mut refusal_after = |answer: Option<Input>| {
        let mut trial = Trial::new(scenario(&arena), arena.clone()).unwrap();
        let seen = trial.see(&mut camera).unwrap();
        if let Some(answer) = answer {
            trial.apply(answer).unwrap();
        }
        let before = trial.tool_m();
        let record = trial.tick(Source::Seen(Box::new(seen))).unwrap();
        // The answer is for one step.
        let second = (1..=32).map(|_| trial.tick(Source::Camera(&mut camera)).unwrap()).last().unwrap();
        assert_eq!(second.moment.refusal, Some(Refusal::Program("it gave no answer".to_owned())));
        (record.moment.refusal, (trial.tool_m() - before).norm())
    };
    let held = |(refusal, moved_m): (Option<Refusal>, f64)| {
        assert!(moved_m < 1e-9);
        refusal.unwrap().to_string()
    };
    assert_eq!(held(refusal_after(None)), "the program: it gave no answer");
    let hold = Input::Hold { reason: "I see nothing".to_owned() };
    assert_eq!(held(refusal_after(Some(hold))), "the program: I see nothing");
    // A place far away is a direction.
    let Scenario { start_m, goal_m, .. } = scenario(&arena);
    let (refusal, moved_m) = refusal_after(Some(ahead(&arena, start_m.unwrap(), goal_m.unwrap(), 7.0)));
    assert!(refusal.is_none() && (0.008..0.0101).contains(&moved_m), "{refusal:?} {moved_m}");
}

#[test]
fn refused_answers_change_nothing() {
    let arena = Arena::shipped("posts").unwrap();
    let refused = |controller, answer: Input| {
        let mut trial = Trial::new(Scenario { controller, ..scenario(&arena) }, arena.clone()).unwrap();
        let before = (trial.state().world_hash(), trial.state().controller_hash());
        let error = trial.apply(answer).unwrap_err();
        assert_eq!((trial.state().world_hash(), trial.state().controller_hash()), before);
        assert!(trial.waiting_inputs().is_empty());
        (error.field(), error)
    };
    let go = |x_m| Input::Go { x_m, y_m: -0.3 };
    let (field, error) = refused(ControllerName::Program, go(f64::NAN));
    assert!(field == "target_m" && error.to_string() == "target_m is NaN, it must be finite", "{error}");
    let reason = "x".repeat(REASON_BYTES_MOST + 1);
    assert_eq!(
        refused(ControllerName::Program, Input::Hold { reason }),
        ("reason", InputError::LongReason { bytes: 201 })
    );
    let other = InputError::NotProgram(ControllerName::Errt);
    assert_eq!(refused(ControllerName::Errt, go(0.0)), ("type", other));
}
