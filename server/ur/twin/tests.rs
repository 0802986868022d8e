use super::*;
use crate::{arm::pose, model::Model};
use ferry_core::geometry::{Point2, Point3};
use ferry_core::image::EmptyFloor;
use ferry_core::plant::{Positioner, ToolOrientation};
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::trial::{Arena, Source};
use proptest::prelude::*;

const TICK: Duration = Duration::from_millis(8);

/// A trial whose arm is at a place, a twin, and a clock.
struct Bench {
    trial: Trial,
    camera: EmptyFloor,
    twin: Twin,
    /// The arm that the robot takes its own for.
    arm: Model,
    report: Report,
    now: Instant,
    press: u32,
}

impl Bench {
    fn new(allows_motion: bool) -> Self {
        let start_m = Some(Point2::new(0.0, -0.35));
        let scenario = Scenario { controller: ControllerName::Errt, start_m, ..Scenario::idle("open", 1) };
        let trial = Trial::new(scenario, Arena::shipped("open").unwrap()).unwrap();
        let joints_rad = trial.state().world.reference.joints_rad().unwrap();
        let report = Report { joints_rad, robot_mode: RUNNING, safety_mode: NORMAL, ..Report::default() };
        let twin = Twin::new([127, 0, 0, 1].into(), allows_motion);
        twin.connected(Ok(()));
        let camera = EmptyFloor::default();
        Self { trial, camera, twin, arm: Model::default(), report, now: Instant::now(), press: 1 }
    }

    /// The robot reports, and the session makes a tick.
    fn tick(&mut self) -> Answer {
        self.now += TICK;
        let joints_rad = self.report.joints_rad;
        self.report.tool = pose(&self.arm.tool(&joints_rad));
        (self.report.flange, self.report.flange_joints_rad) = (pose(&self.arm.flange(&joints_rad)), joints_rad);
        self.twin.hear(self.report, self.now);
        self.silent_tick()
    }

    fn silent_tick(&mut self) -> Answer {
        if let Some(input) = self.twin.next(&self.trial, self.now) {
            self.trial.apply(input).unwrap();
        }
        self.trial.tick(Source::Camera(&mut self.camera)).unwrap();
        self.twin.follow(&self.trial);
        *self.twin.answers().borrow()
    }

    fn hold(&mut self) -> Result<(), DriveError> {
        self.twin.hold(Some(self.press), self.now)
    }

    fn release(&mut self) {
        self.twin.hold(None, self.now).unwrap();
        self.press += 1;
    }

    /// Until the robot follows.
    fn begin(&mut self) {
        self.press();
        self.tick();
        assert!(self.twin.standing().is_driven);
    }

    /// Until the robot has begun the program, which it has not yet reported.
    fn press(&mut self) {
        self.tick();
        self.hold().unwrap();
        self.tick();
        assert_eq!((self.tick().programs, self.twin.standing().is_driven), (1, false));
        (self.report.period, self.report.runtime_state) = (1, PLAYING);
    }

    /// One more period of the robot's program, with the button held.
    fn go_on(&mut self) -> Answer {
        self.report.period += 1;
        self.hold().unwrap();
        self.tick()
    }

    fn stopped(&self) -> String {
        let standing = self.twin.standing();
        assert!(!standing.is_driven && !standing.is_held, "{standing:?}");
        standing.stopped.map(|stopped| stopped.text).unwrap_or_default()
    }
}

#[test]
fn a_twin_that_only_reads_never_answers() {
    let mut bench = Bench::new(false);
    bench.trial.apply(Input::SetGoal { x_m: 0.1, y_m: -0.35 }).unwrap();
    for _ in 0..100 {
        bench.report.joints_rad[0] += 1e-3;
        assert_eq!(bench.tick(), Answer::default());
        assert_eq!(bench.trial.state().world.plant.positioner.joints_rad(), Some(bench.report.joints_rad));
    }
    assert_eq!(bench.hold(), Err(DriveError::NotEnabled));
    assert_eq!(bench.tick(), Answer::default());
    assert_eq!(bench.trial.state().world.counters.steps, 0);
}

#[test]
fn the_robot_follows_the_controllers_while_the_button_is_held() {
    let mut bench = Bench::new(true);
    bench.trial.apply(Input::SetGoal { x_m: 0.1, y_m: -0.35 }).unwrap();
    bench.begin();
    let from_m = bench.trial.tool_m();
    for _ in 0..200 {
        let answer = bench.go_on();
        assert_eq!(answer.period, bench.report.period);
        bench.report.joints_rad = answer.joints_rad;
    }
    let travel_m = (bench.trial.tool_m() - from_m).norm();
    assert!(travel_m > 0.03 && bench.trial.state().world.counters.steps > 4, "{travel_m}");
    bench.release();
    assert_eq!(bench.stopped(), "");
    // The robot's program stops the arm; the simulated one goes where the robot does.
    bench.report.joints_rad[0] += 0.01;
    assert_eq!(bench.tick().period, 0);
    assert_eq!(bench.trial.state().world.reference.joints_rad(), Some(bench.report.joints_rad));
    // Its program of before has ended; another begins.
    (bench.report.period, bench.report.runtime_state) = (OVER, 1);
    bench.tick();
    bench.hold().unwrap();
    bench.tick();
    assert_eq!(bench.tick().programs, 2);
}

#[test]
fn a_flight_from_another_height_is_within_the_limits() {
    let mut bench = Bench::new(true);
    let start = bench.trial.state().world.reference;
    let high = Positioner::at(Point3::new(0.0, -0.35, 0.14), ToolOrientation::Vertical, &start).unwrap();
    bench.report.joints_rad = high.joints_rad().unwrap();
    bench.begin();
    bench.trial.apply(Input::Place { x_m: 0.2, y_m: -0.45 }).unwrap();
    for _ in 0..150 {
        bench.report.joints_rad = bench.go_on().joints_rad;
    }
    assert_eq!(bench.twin.standing().stopped, None);
    assert!(bench.trial.tool_m().x > 0.1 && bench.trial.tool_m().z < 0.11, "{}", bench.trial.tool_m());
}

#[test]
fn whatever_is_wrong_stops_the_robot_until_the_button_is_pressed_again() {
    type Cause = fn(&mut Bench);
    let causes: [(&str, Cause); 10] = [
        ("nothing was heard", |bench| {
            bench.now += SILENCE + TICK;
            bench.silent_tick();
        }),
        ("nothing was heard", |bench| (0..14).for_each(|_| drop((bench.hold(), bench.tick())))),
        ("safety_mode is 3", |bench| bench.report.safety_mode = 3),
        ("robot_mode is 5", |bench| bench.report.robot_mode = 5),
        ("has ended Ferry's program", |bench| bench.report.period = OVER - 1),
        ("has ended Ferry's program", |bench| bench.report.runtime_state = 1),
        ("joint 2 is", |bench| bench.report.joints_rad[2] += 0.3),
        ("not connected", |bench| bench.twin.connected(Err("the cable is out".to_owned()))),
        ("could not be sent", |bench| bench.twin.not_sent("port 30002 is closed".to_owned())),
        ("was paused", |bench| bench.twin.let_go()),
    ];
    for (why, happens) in causes {
        let mut bench = Bench::new(true);
        bench.begin();
        assert!(bench.go_on().period > 0);
        happens(&mut bench);
        bench.report.period += 1;
        assert_eq!(bench.tick().period, 0, "{why}");
        assert!(bench.stopped().contains(why), "{why}: {}", bench.stopped());
        // Everything is well again, but the button was not released.
        let before = bench.twin.answers().borrow().programs;
        bench.twin.connected(Ok(()));
        bench.report =
            Report { joints_rad: bench.report.joints_rad, period: OVER, runtime_state: 1, ..Bench::new(true).report };
        bench.report.joints_rad = Bench::new(true).report.joints_rad;
        for _ in 0..5 {
            bench.hold().unwrap();
            assert_eq!((bench.tick().programs, bench.twin.standing().is_held), (before, false), "{why}");
        }
        bench.release();
        bench.hold().unwrap();
        bench.tick();
        assert_eq!(bench.tick().programs, before + 1, "{why}");
    }
}

#[test]
fn a_page_that_says_nothing_has_released_the_button() {
    let mut bench = Bench::new(true);
    bench.begin();
    let mut ticks = 0;
    while bench.tick().period > 0 {
        bench.report.period += 1;
        ticks += 1;
        assert!(ticks < 40, "it goes on");
    }
    assert!((27..=31).contains(&ticks) && bench.stopped().is_empty(), "0.25 s: {ticks}");
    // It was held all the time, and only the network was slow: nothing moves again.
    (bench.report.period, bench.report.runtime_state) = (OVER, 1);
    for _ in 0..5 {
        bench.hold().unwrap();
        assert_eq!((bench.tick().programs, bench.twin.standing().is_held), (1, false));
    }
    // Another page presses.
    bench.press += 1;
    bench.hold().unwrap();
    assert!(bench.twin.standing().is_held);
}

#[test]
fn a_robot_that_cannot_follow_is_not_asked_to() {
    let refused = |change: fn(&mut Bench)| {
        let mut bench = Bench::new(true);
        bench.tick();
        change(&mut bench);
        bench.tick();
        let error = bench.hold().err().map(|error| error.to_string());
        assert_eq!(bench.tick(), Answer { joints_rad: bench.twin.answers().borrow().joints_rad, ..Answer::default() });
        error.unwrap_or_else(|| bench.stopped())
    };
    assert!(refused(|bench| bench.report.robot_mode = 3).contains("robot_mode is 3"));
    assert!(refused(|bench| bench.report.safety_mode = 4).contains("safety_mode is 4"));
    assert!(refused(|bench| bench.report.runtime_state = PLAYING).contains("another program"));
    assert!(refused(|bench| bench.report.joints_rad[4] += 0.2).contains("tilted 0.2000 rad"));
    assert!(refused(|bench| bench.report.joints_rad[1] -= 0.9).contains("not where Ferry may move it"));
    assert!(refused(|bench| bench.twin.connected(Err("no".to_owned()))).contains("not connected"));
    let mut bench = Bench::new(true);
    bench.tick();
    bench.now += SILENCE + TICK;
    assert_eq!(bench.hold(), Err(DriveError::Silent));
}

/// An arm whose table differs from the UR5's in one number.
fn arm(change: &str) -> Model {
    let text = r#"{"name": "an arm", "d_m": [0.089159, 0, 0, 0.10915, 0.09465, 0.0823],
        "a_m": [0, -0.425, -0.39225, 0, 0, 0], "alpha_rad": [1.5707963, 0, 0, 1.5707963, -1.5707963, 0], "tcp_m": 0.18}"#;
    let (from, to) = change.split_once(" → ").unwrap();
    assert!(text.contains(from));
    Model::read(&text.replace(from, to)).unwrap()
}

#[test]
fn another_arm_never_gets_a_target() {
    // The base of a UR5e, a longer forearm, a mount that is turned by 5°.
    for change in ["0.089159 → 0.1625", "-0.39225 → -0.42", "-1.5707963 → -1.6580628"] {
        let mut bench = Bench::new(true);
        bench.arm = arm(change);
        bench.press();
        bench.tick();
        let stopped = bench.stopped();
        assert!(stopped.contains("it is not a UR5") && stopped.matches("p[").count() == 2, "{change}: {stopped}");
        assert_eq!(bench.go_on().period, 0, "{change}");
    }
    // A program that tells nothing of the flange: its registers are 0.
    let mut bench = Bench::new(true);
    bench.press();
    let report = Report { flange: [0.0; 6], flange_joints_rad: [0.0; 6], ..bench.report };
    bench.twin.hear(report, bench.now + TICK);
    assert!(bench.stopped().contains("it is not a UR5"));
}

#[test]
fn an_arm_that_becomes_another_is_stopped_and_a_doubtful_one_is_told_of() {
    let mut bench = Bench::new(true);
    bench.begin();
    assert_eq!(bench.twin.standing().doubt, None);
    assert!(bench.go_on().period > 0);
    bench.arm = arm("0.089159 → 0.1625");
    assert_eq!(bench.go_on().period, 0);
    assert!(bench.stopped().contains("it is not a UR5"), "{}", bench.stopped());

    // 10 mm: as much as a bad calibration.
    let mut bench = Bench::new(true);
    bench.arm = arm("0.089159 → 0.099159");
    bench.tick();
    let doubt = bench.twin.standing().doubt.unwrap().text;
    assert!(doubt.contains("either its TCP is not Ferry's") && doubt.contains("10.0 mm"), "{doubt}");
    bench.begin();
    assert!(bench.go_on().period > 0);
    let doubt = bench.twin.standing().doubt.unwrap().text;
    assert!(doubt.contains("calibration") && doubt.contains("10.0 mm"), "{doubt}");
    let told = bench.twin.take_news().iter().filter(|item| item.text.contains("10.0 mm")).count();
    assert_eq!(told, 2, "once each");

    // Another tool is set on the robot: the flange is a UR5's.
    let mut bench = Bench::new(true);
    bench.arm = arm("0.18 → 0");
    bench.tick();
    assert!(bench.twin.standing().doubt.unwrap().text.contains("180.0 mm"));
    bench.begin();
    assert!(bench.go_on().period > 0);
    assert_eq!(bench.twin.standing().doubt, None);
}

#[test]
fn a_program_that_does_not_begin_is_given_up() {
    let mut bench = Bench::new(true);
    bench.tick();
    let mut ticks = 0;
    while bench.hold().is_ok() && bench.twin.standing().stopped.is_none() {
        bench.tick();
        ticks += 1;
    }
    assert!((375..380).contains(&ticks) && bench.stopped().contains("has not begun"), "{ticks}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    /// Whatever a robot reports: a target answers its last period, and is within the limits of the one before.
    #[test]
    fn targets_are_within_the_limits(
        steps in prop::collection::vec((prop::array::uniform6(-0.02..0.02), 0..40_u32, -2..3, any::<bool>()), 1..150),
    ) {
        let mut bench = Bench::new(true);
        bench.trial.apply(Input::SetGoal { x_m: 0.15, y_m: -0.3 }).unwrap();
        bench.begin();
        let mut last: Option<Joints> = None;
        for (noise, event, later, is_held) in steps {
            bench.report.period = bench.report.period.saturating_add(later);
            match event {
                0 => bench.report.safety_mode = 3,
                1 => bench.report = Report { safety_mode: NORMAL, ..bench.report },
                2 => bench.twin.let_go(),
                3 => bench.now += SILENCE,
                4 => bench.release(),
                _ => {}
            }
            if is_held {
                let _ = bench.hold();
            }
            let answer = bench.tick();
            if answer.period == 0 {
                last = None;
                bench.report.runtime_state = if event % 2 == 0 { 1 } else { PLAYING };
                continue;
            }
            prop_assert_eq!(answer.period, bench.report.period);
            let limits = bench.trial.arena().limits(&bench.trial.state().world.parameters);
            if let Some(last) = last {
                prop_assert_eq!(limits.joints(&last, &answer.joints_rad), Ok(()));
            }
            last = Some(answer.joints_rad);
            bench.report.joints_rad = std::array::from_fn(|i| answer.joints_rad[i] + noise[i]);
        }
    }
}
