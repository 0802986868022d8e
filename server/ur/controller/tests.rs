use super::*;
use ferry_core::geometry::{Point3, Rect};
use ferry_core::plant::{Positioner, PositionerKind, ToolOrientation};

const CONTROL_SCRIPT: &str = "def rtde_control():\n  global reg_offset_int = # int register offset\n0\n  textmsg(\"RTDE Control Script\")\nend\n";

fn limits() -> Limits {
    let workspace = Rect { x_min_m: -0.3, x_max_m: 0.3, y_min_m: -0.7, y_max_m: -0.15 };
    Limits { workspace, speed_m_s: 0.04, flight_speed_m_s: 0.25, tool_orientation: ToolOrientation::Vertical }
}

/// A controller with its arm.
struct Bench {
    robot: Controller,
    joints_rad: Joints,
    tick: u64,
    is_ours: bool,
}

impl Bench {
    fn new() -> Self {
        let place_m = Point3::new(0.0, -0.35, 0.1);
        let home = Positioner::home(PositionerKind::Arm, place_m);
        let there = Positioner::at(place_m, ToolOrientation::Vertical, &home).unwrap();
        Self { robot: Controller::default(), joints_rad: there.joints_rad().unwrap(), tick: 0, is_ours: true }
    }

    /// Returns how far the joints have turned.
    fn run(&mut self, ticks: usize) -> f64 {
        let before = self.joints_rad;
        for _ in 0..ticks {
            self.tick += 1;
            if let Some(next) = self.robot.next(self.tick, self.is_ours, Some(&self.joints_rad), &limits()) {
                self.joints_rad = next;
            }
        }
        self.joints_rad.iter().zip(before).map(|(now, before)| (now - before).abs()).fold(0.0, f64::max)
    }

    fn write(&mut self, number: i32, values: [f64; 8]) {
        self.robot.inputs.int[0] = number;
        self.robot.inputs.double[..8].copy_from_slice(&values);
        self.robot.silent_ticks = 0;
    }

    fn last_refusal(&self) -> String {
        self.robot.refusals.since(0).last().map(ToString::to_string).unwrap_or_default()
    }
}

const SLOWLY: [f64; 8] = [0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0];

#[test]
fn registers_command_the_arm_and_tell_when_it_has_arrived() {
    let mut bench = Bench::new();
    bench.robot.load(CONTROL_SCRIPT, true).unwrap();
    assert!(bench.robot.is_running() && bench.robot.wants_arm());
    bench.run(1);
    assert_eq!(bench.robot.outputs.int[0], 1, "ready");
    let to = [0.05, -0.35, 0.1, 2.2214, -2.2214, 0.0, 0.1, 0.5];
    bench.write(3, to);
    bench.run(20);
    assert_eq!(
        (bench.robot.outputs.int[0], bench.robot.standing().command.as_deref()),
        (1, Some("movel")),
        "on its way"
    );
    bench.run(100);
    assert_eq!((bench.robot.outputs.int[0], bench.robot.standing().command), (2, None), "done");
    assert!(bench.run(50) < 1e-12, "the command is not repeated");
    bench.write(0, to);
    bench.run(1);
    assert_eq!(bench.robot.outputs.int[0], 1, "ready again");
    bench.write(255, to);
    bench.run(1);
    assert!(!bench.robot.is_running());
}

#[test]
fn a_client_that_leaves_stops_what_it_has_commanded() {
    let mut bench = Bench::new();
    let id = bench.robot.connect("127.0.0.1:1".to_owned(), "RTDE");
    assert!(bench.robot.claim(Input::Int(0), id));
    bench.robot.load(CONTROL_SCRIPT, true).unwrap();
    bench.write(10, SLOWLY);
    assert!(bench.run(30) > 0.0);
    bench.robot.disconnect(id);
    assert!(!bench.robot.is_running() && bench.robot.standing().clients.is_empty());
    bench.run(10);
    assert_eq!(bench.run(10), 0.0, "at rest within .1 s");
}

#[test]
fn a_silent_client_with_a_watchdog_is_stopped() {
    let mut bench = Bench::new();
    bench.robot.load(CONTROL_SCRIPT, true).unwrap();
    bench.run(1);
    bench.write(35, [20.0; 8]);
    bench.run(2);
    bench.write(10, SLOWLY);
    bench.run(5);
    assert!(bench.robot.is_running());
    bench.run(5);
    assert_eq!((bench.robot.is_running(), bench.last_refusal().as_str()), (false, "watchdog: the client is silent"));
}

#[test]
fn the_operator_and_a_jump_in_time_end_a_program() {
    for is_jump in [false, true] {
        let mut bench = Bench::new();
        bench.robot.load(CONTROL_SCRIPT, true).unwrap();
        bench.write(10, SLOWLY);
        assert!(bench.run(30) > 0.0);
        bench.robot.take_news();
        if is_jump {
            bench.tick = 0;
        } else {
            bench.is_ours = false;
        }
        let turned = bench.run(5);
        assert!(!bench.robot.is_running() && turned == 0.0, "{turned}");
        let [Item { is_refused: false, text: said }] = &bench.robot.take_news()[..] else { panic!() };
        assert!(said.contains(if is_jump { "set back" } else { "operator" }), "{said}");
    }
}

#[test]
fn a_violated_limit_stops_the_arm_until_it_is_unlocked() {
    let mut bench = Bench::new();
    bench.robot.load(CONTROL_SCRIPT, true).unwrap();
    bench.write(10, SLOWLY);
    bench.run(30);
    bench.robot.violate("too low");
    assert!(bench.robot.is_stopped() && !bench.robot.is_running() && bench.robot.safety_mode() == PROTECTIVE_STOP);
    assert_eq!((bench.run(10), bench.last_refusal().as_str()), (0.0, "speedl: too low"));
    let refused = bench.robot.load(CONTROL_SCRIPT, true);
    assert_eq!(refused, Err(LoadError::Stopped(Stop::refused("too low"))));
    assert!(bench.robot.unlock() && !bench.robot.unlock());
    assert_eq!(bench.robot.load(CONTROL_SCRIPT, true), Ok(()));
}

#[test]
fn lines_are_carried_out_one_after_the_other() {
    let mut bench = Bench::new();
    let program = "def mine():\n  movel(p[0.02,-0.35,0.1,2.2214,-2.2214,0], a=0.5, v=0.1)\n  sleep(0.4)\n  \
                   write_output_integer_register(3, 7)\nend\n";
    bench.robot.load(program, true).unwrap();
    bench.run(55);
    assert_eq!(bench.robot.outputs.int[3], 0, "it sleeps");
    bench.run(60);
    assert_eq!((bench.robot.outputs.int[3], bench.robot.is_running()), (7, false));
    let here = Positioner::Arm(bench.joints_rad).tool_m();
    assert!((here - Point3::new(0.02, -0.35, 0.1)).norm() < 1e-6, "{here}");
    // Nothing of a program that is not understood is carried out.
    assert!(bench.robot.load("def a():\n  speedl([0.1,0,0,0,0,0])\n  while True:\nend\n", true).is_err());
    assert_eq!(bench.run(10), 0.0);
    assert!(bench.last_refusal().contains("while True"), "{}", bench.last_refusal());
    assert_eq!(bench.robot.load("stopl(1)", false), Err(LoadError::NoArm));
}

#[test]
fn a_program_that_halts_ends_and_tells_what_has_no_effect() {
    let mut bench = Bench::new();
    bench.robot.load("def a():\n set_gravity([0,0,9.82]); popup('hi')\n halt\n stopl(1)\nend\n", true).unwrap();
    bench.run(6);
    let said: Vec<_> = bench.robot.take_news().into_iter().map(|item| item.text).collect();
    assert_eq!(
        said,
        ["the program a begins; without an effect here: set_gravity, popup", "the program a ends: it halts"]
    );
}

#[test]
fn commands_that_are_not_carried_out_end_the_program_and_are_named() {
    for (number, values, expected) in [
        (6, [0.0; 8], "command 6: Ferry does not carry it out"),
        (1, [f64::NAN; 8], "movej: target is NaN"),
        (3, [9.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1, 0.5], "movel: the pose is"),
        (35, [0.0; 8], "rtde_set_watchdog: the frequency is 0"),
    ] {
        let mut bench = Bench::new();
        bench.robot.load(CONTROL_SCRIPT, true).unwrap();
        bench.run(1);
        bench.write(number, values);
        assert_eq!(bench.run(5), 0.0, "{expected}");
        assert!(!bench.robot.is_running() && bench.last_refusal().starts_with(expected), "{}", bench.last_refusal());
    }
}
