//! Whole sessions without a thread or a clock: the test says what time it is.

use std::ops::ControlFlow;
use std::time::Duration;

use super::{
    Command, CommandError, Ended, Message, Opening, PROGRAM_ANSWER_WITHIN, Recalled, Saved, Session, Surroundings,
    View, Void,
};
use crate::control::switching::Mode;
use crate::control::transport::program::Answer;
use crate::geometry::Point2;
use crate::image::EmptyFloor;
use crate::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted, When};
use crate::trial::{
    Arena, Catalog, ControlQuery, Event, Input, InputLog, Nowhere, Phase, Source, StopReason, TickRecord, Trial,
    TrialError,
};

const TICK: Duration = Duration::from_millis(8);

struct Bench {
    session: Session<EmptyFloor>,
    now: Duration,
    events: Vec<Event>,
    /// Questions and missing answers, oldest first.
    others: Vec<Message>,
}

impl Bench {
    fn new(scenario: Scenario, opening: Opening) -> Self {
        let surroundings = Surroundings {
            catalog: Catalog::default(),
            make_camera: Box::new(|_: &Arena| Ok(EmptyFloor::default())),
            sink: Box::new(Nowhere::default()),
        };
        let (session, _) = Session::start(scenario, opening, surroundings, Duration::ZERO).unwrap();
        let mut bench = Self { session, now: Duration::ZERO, events: Vec::new(), others: Vec::new() };
        bench.listen();
        bench
    }

    fn listen(&mut self) {
        for message in self.session.take_messages() {
            match message {
                Message::Event(event) => self.events.push(event),
                other => self.others.push(other),
            }
        }
    }

    fn send(&mut self, command: Command) -> Result<View, CommandError> {
        let done = self.session.apply(command, self.now);
        self.listen();
        done.map(|()| self.session.view())
    }

    fn input(&mut self, input: Input) {
        self.send(Command::Input(input)).unwrap();
    }

    /// One tick of real time.
    fn pass(&mut self) -> bool {
        self.now += TICK;
        let has_ticked = self.session.advance(self.now).unwrap();
        self.listen();
        has_ticked
    }

    fn run_until(&mut self, what: &str, mut reached: impl FnMut(&View) -> bool) -> View {
        for _ in 0..20_000 {
            let view = self.session.view();
            if reached(&view) {
                return view;
            }
            self.pass();
        }
        panic!("{what} does not come: {:?}", self.session.view().moment);
    }

    fn run_until_asked(&mut self) -> View {
        while self.pass() {}
        assert!(self.session.asks(), "the session has stopped");
        self.session.view()
    }

    fn said(&self, part: &str) -> bool {
        self.events.iter().any(|event| event.text().contains(part))
    }
}

fn open_floor(controller: ControllerName) -> Bench {
    let start_m = Some(Point2::new(0.0, -0.35));
    Bench::new(Scenario { controller, start_m, ..Scenario::idle("open", 1) }, Opening::Fresh)
}

fn goal(x_m: f64) -> Input {
    Input::SetGoal { x_m, y_m: -0.35 }
}

#[test]
fn goal_drag_rewind_compare_and_return() {
    let mut bench = open_floor(ControllerName::Attractor);
    assert!(!bench.pass(), "it begins paused");
    bench.input(goal(0.1));
    bench.send(Command::Run).unwrap();
    bench.run_until("motion", |view| view.moment.tick == 250);
    // The hand pulls the bead away: sub-controller 1 fetches it.
    bench.input(Input::Drag { x_m: -0.15, y_m: -0.35, lift: true });
    bench.run_until("the pull", |view| view.moment.bead_m.x < -0.1);
    bench.input(Input::Release);
    let delivered = bench.run_until("the delivery", |view| view.moment.counters.deliveries == 1);
    assert!(delivered.moment.counters.switches >= 2, "{:?}", delivered.moment.counters);
    assert!(bench.said("delivered"), "{:?}", bench.events);
    let delivered_tick = delivered.moment.tick;
    bench.input(goal(-0.1));
    let last = bench.run_until("the way to another goal", |view| view.moment.tick == delivered_tick + 50);

    // Rewound to before the drag, other controllers run beside the session, and the same one repeats what happened.
    let rewound = bench.send(Command::Rewind(240)).unwrap();
    assert!(!rewound.running && rewound.moment.tick <= 240 && rewound.moment.counters.deliveries == 0);
    let point = bench.session.recall(rewound.moment.tick, Recalled::Present).unwrap();
    assert!(point.has_goal());
    let mut ends = Vec::new();
    for controller in [ControllerName::Attractor, ControllerName::Errt] {
        let mut camera = EmptyFloor::default();
        let mut advance = |trial: &mut crate::trial::Trial| trial.tick(Source::Camera(&mut camera));
        let mut watch = |progress: super::Progress<'_>| {
            if progress.done {
                ends.push((progress.delivered_tick, progress.record.tick, progress.record.moment.counters.switches));
            }
            ControlFlow::Continue(())
        };
        point.branch::<TrialError>(controller, &mut advance, &mut watch).unwrap();
    }
    // It ends there, without the goal that was set later.
    assert_eq!(ends[0], (Some(delivered_tick), delivered_tick, delivered.moment.counters.switches));
    assert!(ends[1].0.is_some());
    assert_eq!(bench.session.view().world_hash, rewound.world_hash, "a branch leaves the session as it is");

    // What the rewind has left behind is kept as soon as the session goes on, and the operator can return to it.
    bench.send(Command::Run).unwrap();
    bench.run_until("another second", |view| view.moment.tick > 375);
    let kept = bench.session.view().scenery.kept_runs.clone();
    assert_eq!(kept.iter().map(|run| (run.number, run.deliveries)).collect::<Vec<_>>(), [(1, 1)]);
    let returned = bench.send(Command::Return(1)).unwrap();
    assert_eq!((returned.world_hash, returned.running), (last.world_hash, false));
    assert!(matches!(bench.send(Command::Return(9)), Err(CommandError::NoRun { number: 9 })));

    // It is saved, and goes on elsewhere.
    let log = InputLog::read(&bench.session.saved().to_bytes().unwrap()).unwrap();
    let again = Bench::new(Scenario::idle("posts", 1), Opening::Saved(Saved::of(log)));
    assert_eq!(again.session.view().world_hash, last.world_hash);
    assert!(again.said("the session goes on"), "{:?}", again.events);
}

/// All ticks of a branch of the attractor from the session's present moment.
fn branch(bench: &Bench) -> Vec<TickRecord> {
    let point = bench.session.recall(bench.session.view().moment.tick, Recalled::Present).unwrap();
    let (mut camera, mut records) = (EmptyFloor::default(), Vec::new());
    let mut advance = |trial: &mut Trial| trial.tick(Source::Camera(&mut camera));
    let mut watch = |progress: super::Progress<'_>| {
        records.push(progress.record.clone());
        ControlFlow::Continue(())
    };
    point.branch::<TrialError>(ControllerName::Attractor, &mut advance, &mut watch).unwrap();
    records
}

#[test]
fn a_branch_has_all_its_steps_and_the_rest_of_the_script() {
    let limit = 10;
    let kick_at =
        |step| Scripted { at: When::Step(step), disturbance: Disturbance::Impulse { x_n_s: 1e-7, y_n_s: 0.0 } };
    let scenario = Scenario {
        start_m: Some(Point2::new(0.0, -0.35)),
        controller: ControllerName::Attractor,
        parameters: Parameters { step_limit: limit, ..Parameters::default() },
        script: vec![kick_at(3), kick_at(limit + 5)],
        ..Scenario::idle("open", 1)
    };
    let mut bench = Bench::new(scenario, Opening::Fresh);
    bench.input(goal(0.2));
    bench.send(Command::Run).unwrap();
    let late = bench.run_until("some steps", |view| view.moment.counters.leg_steps == 6).moment;
    let from_late = branch(&bench);
    let out_of_steps = Phase::Stopped(StopReason::LegSteps { limit });
    let mut before = (0, 0);
    let stopped = bench.run_until("the last step", |view| {
        let is_stopped = view.moment.phase == out_of_steps;
        if !is_stopped {
            before = (view.moment.tick, view.world_hash);
        }
        is_stopped
    });
    assert_eq!((stopped.moment.counters.steps, stopped.moment.counters.disturbances), (limit, 1));
    // The branch repeats the session, goes on where that stopped, and meets what is left of the script.
    assert!(from_late.iter().any(|record| (record.tick, record.world.total()) == before), "{before:?}");
    let end = &from_late.last().unwrap().moment;
    assert_eq!(
        (end.phase, end.counters.steps, end.counters.disturbances),
        (out_of_steps, late.counters.steps + limit, 2)
    );
    // It also goes on from where no step is left.
    let end = branch(&bench).last().unwrap().moment.clone();
    assert_eq!((end.phase, end.counters.disturbances), (Phase::Delivered, 2));
}

/// The question that was asked last.
fn asked(bench: &Bench) -> (u64, &ControlQuery) {
    match bench.others.last() {
        Some(Message::Ask { number, query }) => (*number, query),
        other => panic!("no question was asked last: {other:?}"),
    }
}

#[test]
fn a_program_is_asked_and_its_silence_holds_the_arm() {
    let mut bench = open_floor(ControllerName::Attractor);
    bench.input(goal(0.1));
    bench.send(Command::Attach("mine".to_owned())).unwrap();
    bench.send(Command::Run).unwrap();
    assert!(!bench.pass() && bench.session.asks(), "the first control step waits for an answer");
    let (number, query) = asked(&bench);
    assert_eq!((query.question.tick, query.leg.map.as_str()), (0, "open"));
    let target_m = query.question.tool_m + crate::geometry::Vector2::new(0.01, 0.0);
    assert!(bench.session.awaits(number) && !bench.session.awaits(number + 1));
    bench.session.answer(number + 1, Answer::Hold { reason: "not asked".to_owned() });
    assert!(!bench.pass());
    bench.session.answer(number, Answer::Go { target_m });
    let moved = bench.run_until_asked();
    assert!(moved.moment.tool_m.x > 0.005, "{:?}", moved.moment);
    assert_eq!(moved.moment.refusal, None);

    // No answer: the arm holds after a tenth of a second, and a late answer is dropped.
    let before = bench.now;
    let (number, _) = asked(&bench);
    let held = bench.run_until("the hold", |view| view.moment.tick > moved.moment.tick);
    assert!(bench.now - before >= PROGRAM_ANSWER_WITHIN);
    let refusal = held.moment.refusal.unwrap().to_string();
    assert_eq!(refusal, "the program: mine gave no answer within 100 ms");
    assert!(matches!(bench.others.last(), Some(Message::Unanswered { number: missed }) if *missed == number));
    bench.session.answer(number, Answer::Go { target_m });
    assert!(!bench.session.asks());

    // A pause takes the question back; the session asks again when it goes on.
    bench.run_until_asked();
    let (number, _) = asked(&bench);
    bench.send(Command::Pause).unwrap();
    assert!(!bench.session.awaits(number));
    bench.send(Command::Run).unwrap();
    bench.pass();
    assert_eq!(asked(&bench).0, number + 1);
}

#[test]
fn a_robot_leads_the_arm_within_the_limits() {
    let mut bench = open_floor(ControllerName::Robot);
    bench.send(Command::Run).unwrap();
    let mut joints_rad = bench.session.trial().state().world.plant.positioner.joints_rad().unwrap();
    let first_rad = joints_rad[0];
    for _ in 0..50 {
        joints_rad[0] += 1e-3;
        bench.session.follow(Input::Servo { joints_rad }).unwrap();
        assert!(bench.pass());
    }
    let turned_rad = bench.session.trial().state().world.plant.positioner.joints_rad().unwrap()[0] - first_rad;
    assert!((turned_rad - 0.05).abs() < 5e-3, "{turned_rad}");
    let hash = bench.session.view().world_hash;
    joints_rad[0] += 1.0;
    let refused = bench.session.follow(Input::Servo { joints_rad });
    assert!(refused.is_err(), "a jump violates the limits");
    assert_eq!(bench.session.view().world_hash, hash);
}

#[test]
fn an_attempt_that_ends_in_a_step_ends_the_step() {
    let mut bench = open_floor(ControllerName::Attractor);
    bench.send(Command::Play("easy-2026-11-26".parse().unwrap())).unwrap();
    bench.send(Command::Step(super::STEP_MAX)).unwrap();
    while bench.session.is_stepping() {
        bench.session.advance(bench.now).unwrap();
    }
    let played = bench.session.played().unwrap();
    assert!(matches!(played.ended, Some(Ended::TimeUp)), "{:?}", played.ended);
    assert_eq!(played.void, Some(Void::Paused));
    let tick = bench.session.view().moment.tick;
    assert_eq!(tick, crate::challenge::TICKS_MOST, "the session pauses at the end of the attempt");
    assert!(!bench.pass());
}

#[test]
fn the_pace_is_that_of_the_passed_time() {
    let mut bench = open_floor(ControllerName::Attractor);
    bench.send(Command::SetSpeed(2.0)).unwrap();
    bench.send(Command::Run).unwrap();
    assert_eq!(bench.session.wait(bench.now), Some(Duration::ZERO));
    let mut ticks = 0;
    for _ in 0..125 {
        bench.now += TICK;
        while bench.session.advance(bench.now).unwrap() {
            ticks += 1;
        }
    }
    assert!((250..=252).contains(&ticks), "{ticks} ticks in a second at twice the speed");
    let view = bench.send(Command::Pause).unwrap();
    assert_eq!((view.running, view.moment.tick), (false, ticks));
    assert_eq!(bench.session.wait(bench.now), None);
}

#[test]
fn the_course_covers_the_trial_and_follows_rewinds_and_kept_runs() {
    let mut bench = open_floor(ControllerName::Attractor);
    bench.input(goal(0.1));
    bench.send(Command::Run).unwrap();
    let carried = bench.run_until("some seconds", |view| view.moment.tick == 503).course;
    let (first_tick, points) = carried.points_from(0);
    assert_eq!((first_tick, carried.step_ticks(), points.len()), (5, 5, 100));
    assert_eq!((carried.newest_tick(), carried.points_from(498).0, carried.cuts()), (Some(500), 500, (0, 0)));
    assert!(points.iter().any(|point| point.mode == Mode::Transport && point.controller == ControllerName::Attractor));
    assert!(points.last().unwrap().tool_m[0] > points[0].tool_m[0] + 0.02);

    // A rewind leaves it; going on from there cuts it.
    let rewound = bench.send(Command::Rewind(250)).unwrap();
    assert_eq!(rewound.course.newest_tick(), Some(500));
    bench.send(Command::Run).unwrap();
    let again = bench.run_until("the same tick", |view| view.moment.tick == 260);
    assert_eq!((again.course.newest_tick(), again.course.cuts()), (Some(260), (1, rewound.moment.tick)));
    assert_eq!(again.course.points_from(0).1, &points[..52], "the same trial again");

    let returned = bench.send(Command::Return(1)).unwrap();
    assert_eq!(returned.course.points_from(0).1, points);
    let reset = bench.send(Command::Reset(None)).unwrap();
    assert_eq!(reset.course.newest_tick(), None);
}

#[test]
fn a_long_course_gets_coarser_and_keeps_its_start() {
    let mut bench = open_floor(ControllerName::Attractor);
    bench.send(Command::Run).unwrap();
    let mut moment = bench.run_until("the first tick", |view| view.moment.tick == 1).moment;
    let mut course = super::Course::default();
    for tick in 1..=100_000 {
        moment.tick = tick;
        course.follow(&moment);
    }
    let (first_tick, points) = course.points_from(0);
    let (step, last) = (course.step_ticks(), course.newest_tick().unwrap());
    assert!(points.len() <= 4096 && points.len() > 2000, "{}", points.len());
    assert!(first_tick <= step && last + step > 100_000 && last == first_tick + (points.len() as u64 - 1) * step);
    course.forget_after(50_000);
    assert_eq!(course.newest_tick(), Some(50_000 / step * step));
}
