use crate::challenge::{Attempt, AttemptError, Challenge, Difficulty, INPUTS_MOST};
use crate::geometry::Point2;
use crate::image::EmptyFloor;
use crate::map::Map;
use crate::scenario::{ControllerName, Disturbance, Parameters, Scripted, When};
use crate::trial::{Case, Expectation, Input, LoggedMap, Source, Timed, Trial};

/// Ticks between two places that the hand points to.
const BEAT: u64 = 20;
const AHEAD_M: f64 = 0.02;

fn challenge(name: &str) -> (Challenge, EmptyFloor) {
    (Challenge::of(name.parse().unwrap()).unwrap(), EmptyFloor::default())
}

/// The place on the shortest path to the goal that is a little ahead of the tool.
fn ahead(challenge: &Challenge, trial: &Trial) -> Point2<f64> {
    let goal = challenge.scenario.goal_m.unwrap();
    let path = challenge.arena.space.taut_path(trial.tool_m().xy(), goal).unwrap();
    let mut left_m = AHEAD_M;
    for pair in path.windows(2) {
        let leg = pair[1] - pair[0];
        if leg.norm() > left_m {
            return pair[0] + leg.normalize() * left_m;
        }
        left_m -= leg.norm();
    }
    goal
}

/// An attempt by a hand that knows the path.
fn attempt(challenge: &Challenge, camera: &mut EmptyFloor) -> Attempt {
    let mut trial = Trial::new(challenge.scenario.clone(), challenge.arena.clone()).unwrap();
    let mut inputs = Vec::new();
    while trial.state().world.counters.deliveries == 0 {
        let tick = trial.state().world.tick;
        assert!(tick < 7500, "{} is not delivered", challenge.name);
        if tick.is_multiple_of(BEAT) {
            let place = ahead(challenge, &trial);
            let input = Input::Steer { x_m: place.x, y_m: place.y, approach: false };
            trial.apply(input.clone()).unwrap();
            inputs.push(Timed { tick, input });
        }
        trial.tick(Source::Camera(camera)).unwrap();
    }
    let run = challenge.run(&inputs, camera).unwrap();
    let log = Case { about: String::new(), scenario: challenge.scenario.clone(), map: None, inputs, expect: None };
    Attempt { log, score: run.score, world_hash: run.world_hash }
}

#[test]
fn an_attempt_has_the_same_score_when_it_runs_again_after_a_journey_as_json() {
    for difficulty in Difficulty::ALL {
        let (challenge, mut camera) = challenge(&format!("{}-2026-11-26", difficulty.as_str()));
        let first = attempt(&challenge, &mut camera);
        let sent: Attempt = serde_json::from_str(&serde_json::to_string(&first).unwrap()).unwrap();
        let run = challenge.judge(&sent, &mut camera).unwrap();
        assert_eq!((run.score, &run.world_hash), (first.score, &first.world_hash));
        assert!((5.0..60.0).contains(&run.score.total_s()), "{}: {}", challenge.name, run.score.total_s());
        assert_eq!(run.trace.samples.len() as u64, run.score.tick.div_ceil(25) + u64::from(run.score.tick % 25 != 1));
    }
}

#[test]
fn forged_logs_are_refused_at_the_field_that_is_wrong() {
    let (challenge, mut camera) = challenge("easy-2026-11-26");
    let honest = attempt(&challenge, &mut camera);
    let (goal, last) = (challenge.scenario.goal_m.unwrap(), honest.log.inputs.last().unwrap().clone());
    let with = |input: Input| {
        let mut forged = honest.clone();
        forged.log.inputs.insert(0, Timed { tick: 0, input });
        forged
    };
    let edited = |edit: &dyn Fn(&mut Attempt)| {
        let mut forged = honest.clone();
        edit(&mut forged);
        forged
    };
    let steer = |x_m: f64| Input::Steer { x_m, y_m: goal.y, approach: false };
    let scripted = Scripted { at: When::Tick(1), disturbance: Disturbance::Displace { x_m: goal.x, y_m: goal.y } };
    let foreign = |one: &mut Attempt| one.log.scenario = Challenge::of("easy-1".parse().unwrap()).unwrap().scenario;
    let fast = Parameters { transport_speed_m_s: 0.079, ..challenge.scenario.parameters.clone() };
    let forged = [
        ("log.scenario.seed", edited(&foreign)),
        ("log.scenario.map", edited(&|one| one.log.scenario.map = "open".into())),
        ("log.scenario.controller", edited(&|one| one.log.scenario.controller = ControllerName::Errt)),
        ("log.scenario.positioner", edited(&|one| one.log.scenario.positioner = Some(Default::default()))),
        ("log.scenario.parameters", edited(&|one| one.log.scenario.parameters = fast.clone())),
        ("log.scenario.start_m", edited(&|one| one.log.scenario.start_m = Some(goal))),
        ("log.scenario.goal_m", edited(&|one| one.log.scenario.goal_m = one.log.scenario.start_m)),
        ("log.scenario.disturbances", edited(&|one| one.log.scenario.disturbances = 1)),
        ("log.scenario.script", edited(&|one| one.log.scenario.script = vec![scripted])),
        ("log.map", edited(&|one| one.log.map = Some(LoggedMap::from(&Map::shipped("open").unwrap())))),
        ("log.expect", edited(&|one| one.log.expect = Some(Expectation { deliveries: 1, by_tick: 10 }))),
        ("log.inputs", edited(&|one| one.log.inputs = vec![last.clone(); INPUTS_MOST + 1])),
        ("log.inputs[0]", with(Input::SetGoal { x_m: goal.x, y_m: goal.y })),
        ("log.inputs[0]", with(Input::Place { x_m: goal.x, y_m: goal.y })),
        ("log.inputs[0]", with(Input::Drag { x_m: goal.x, y_m: goal.y, lift: true })),
        ("log.inputs[0]", with(Input::Configure(Box::new(fast.clone())))),
        ("log.inputs[0]", with(Input::SelectController(ControllerName::Rl))),
        ("log.inputs[0]", with(Input::Disturb(Disturbance::Displace { x_m: goal.x, y_m: goal.y }))),
        ("log.inputs[0]", with(steer(f64::NAN))),
        ("log.inputs[1].tick", edited(&|one| (one.log.inputs[0].tick, one.log.inputs[1].tick) = (30, 10))),
        ("log.inputs[0].tick", edited(&|one| one.log.inputs = vec![Timed { tick: 7500, input: steer(0.0) }])),
        ("log", edited(&|one| one.log.inputs.truncate(3))),
        ("score.tick", edited(&|one| one.score.tick -= 1)),
        ("score.walls", edited(&|one| one.score.walls += 1)),
        ("score.lost_beads", edited(&|one| one.score.lost_beads += 1)),
        ("world_hash", edited(&|one| one.world_hash = format!("{:016x}", 1))),
    ];
    for (field, one) in &forged {
        let error = challenge.judge(one, &mut camera).unwrap_err();
        assert_eq!(error.field(), *field, "{error}");
        assert!(!matches!(error, AttemptError::Trial(_)), "{error}");
    }
    // What only a run can show.
    let count = honest.log.inputs.len();
    let late = edited(&|one| one.log.inputs.push(Timed { tick: one.score.tick + 5, input: steer(0.0) }));
    assert_eq!(challenge.judge(&late, &mut camera).unwrap_err().field(), format!("log.inputs[{count}].tick"));
    let moved = edited(&|one| one.log.inputs[1].input = steer(goal.x + 0.001));
    assert!(matches!(
        challenge.judge(&moved, &mut camera).unwrap_err(),
        AttemptError::OtherScore { .. } | AttemptError::OtherWorld { .. } | AttemptError::NotDelivered
    ));
}
