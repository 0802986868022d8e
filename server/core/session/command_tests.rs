//! Random commands in random order: the arm stays within its limits, and refused commands change nothing.

use std::time::Duration;

use super::{Command, Kept, Opening, PROGRAM_ANSWER_WITHIN, Session, Surroundings};
use crate::control::limits::{LIFT_SPEED_M_S, MIN_MANIPULABILITY_M3};
use crate::geometry::Point2;
use crate::image::{CameraError, CameraFrame, ImageSource, Picture, Subject};
use crate::plant::{PositionerKind, TOOL_LENGTH_M, ToolOrientation};
use crate::robot::ur5::{JOINT_SPEED_LIMIT_RAD_S, SERVO_PERIOD_S};
use crate::robot::{Joints, jacobian};
use crate::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted, When};
use crate::trial::{Arena, Case, Catalog, Input, Nowhere, Timed};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SIDE_PX: u32 = 480;
/// Tolerance for rounding.
const SLACK: f64 = 1e-9;

/// Number of commands, set by `FERRY_COMMANDS`.
fn commands() -> u64 {
    std::env::var("FERRY_COMMANDS").map_or(6_000, |count| count.parse().expect("FERRY_COMMANDS is a count"))
}

fn seed() -> u64 {
    std::env::var("FERRY_SEED").map_or(1, |seed| seed.parse().expect("FERRY_SEED is a seed"))
}

/// A camera whose walls depend on the position, so that every controller meets refusals.
struct MadeUp(Vec<Picture>);

impl MadeUp {
    fn new() -> Self {
        let picture = |dark: &dyn Fn(u32, u32) -> bool| {
            let level = |index: u32| if dark(index % SIDE_PX, index / SIDE_PX) { 40 } else { 230 };
            let rgba = (0..SIDE_PX * SIDE_PX).flat_map(|index| [level(index), level(index), level(index), 255]);
            Picture { width_px: SIDE_PX, height_px: SIDE_PX, rgba: rgba.collect() }
        };
        Self(vec![
            picture(&|_, _| false),
            picture(&|column, _| column < 150),
            picture(&|column, row| column > 300 && row < 200),
            picture(&|_, row| row > 420),
            picture(&|column, row| column.abs_diff(240) < 60 && row.abs_diff(120) < 60),
        ])
    }
}

impl ImageSource for MadeUp {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        let [x_m, y_m, _] = subject.tool_m;
        let cell = (x_m * 20.0).floor() as i64 * 31 + (y_m * 20.0).floor() as i64;
        let picture = self.0[cell.rem_euclid(self.0.len() as i64) as usize].clone();
        Ok(CameraFrame { picture, tick: subject.tick, pinhole: subject.mount.over(Point2::new(x_m, y_m), 0.0) })
    }
}

/// Mostly points near the table, sometimes impossible ones.
fn number(rng: &mut impl Rng, least: f64, most: f64) -> f64 {
    const ODD: [f64; 12] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        1e-320,
        1e300,
        -1e300,
        1.0,
        -1.0,
        f64::MAX,
        f64::EPSILON,
    ];
    match rng.random_range(0..20) {
        0 => ODD[rng.random_range(0..ODD.len())],
        1 => rng.random_range(-3.0..3.0) * (most - least) + least,
        _ => rng.random_range(least..=most),
    }
}

fn place(rng: &mut impl Rng) -> (f64, f64) {
    (number(rng, -0.32, 0.30), number(rng, -0.56, -0.19))
}

fn parameters(rng: &mut impl Rng, present: &Parameters) -> Parameters {
    let mut p = if rng.random_bool(0.2) { Parameters::default() } else { present.clone() };
    match rng.random_range(0..12) {
        0 => p.tool_height_m = number(rng, 0.09, 0.2),
        1 => p.friction = number(rng, 0.0, 1.0),
        2 => p.threshold_m = number(rng, 0.02, 0.2),
        3 => p.approach_speed_m_s = number(rng, 0.02, 0.25),
        4 => p.transport_speed_m_s = number(rng, 0.01, 0.079),
        5 => p.tracker_noise_m = number(rng, 0.0, 0.01),
        6 => p.tracker_latency_ticks = rng.random_range(0..60),
        7 => p.camera_height_m = number(rng, 0.1, 1.0),
        8 => p.camera_tilt_x_rad = number(rng, -0.4, 0.4),
        9 => p.obstacle_level = rng.random_range(40..=210),
        10 => p.tool_orientation = [ToolOrientation::Vertical, ToolOrientation::Paper][rng.random_range(0..2)],
        _ => p.camera_offset_x_m = number(rng, -0.15, 0.15),
    }
    p
}

fn disturbance(rng: &mut impl Rng) -> Disturbance {
    match rng.random_range(0..4) {
        0 => {
            let (x_m, y_m) = place(rng);
            Disturbance::Displace { x_m, y_m }
        }
        1 => Disturbance::Impulse { x_n_s: number(rng, -2e-3, 2e-3), y_n_s: number(rng, -2e-3, 2e-3) },
        2 => Disturbance::Drift {
            x_n: number(rng, -0.01, 0.01),
            y_n: number(rng, -0.01, 0.01),
            for_s: number(rng, 0.0, 5.0),
        },
        _ => Disturbance::Dropout { for_s: number(rng, 0.0, 5.0) },
    }
}

fn load(rng: &mut impl Rng, present: &Parameters) -> Command {
    let maps = ["open", "posts", "colon", "nowhere", "../colon", ""];
    let some_place = |rng: &mut ChaCha8Rng| rng.random_bool(0.5).then(|| place(rng)).map(|(x, y)| Point2::new(x, y));
    let mut own = ChaCha8Rng::seed_from_u64(rng.next_u64());
    let rng = &mut own;
    let map = maps[rng.random_range(0..maps.len())];
    let some_controller = rng.random_bool(0.5).then(|| controller(rng));
    let positioner = [None, Some(PositionerKind::Arm), Some(PositionerKind::PlanarStage)][rng.random_range(0..3)];
    let idle = Scenario::idle(map, rng.random_range(0..100));
    let (start_m, goal_m) = (some_place(rng), some_place(rng));
    let some_parameters = rng.random_bool(0.5).then(|| parameters(rng, present));
    let kept = Kept { controller: some_controller.is_none(), seed: false, parameters: some_parameters.is_none() };
    let scenario = Scenario {
        controller: some_controller.unwrap_or(idle.controller),
        positioner,
        start_m,
        goal_m,
        parameters: some_parameters.unwrap_or_default(),
        disturbances: rng.random_range(0..4),
        script: (0..rng.random_range(0..3))
            .map(|_| Scripted { at: When::Tick(rng.random_range(0..500)), disturbance: disturbance(rng) })
            .collect(),
        ..idle
    };
    if rng.random_bool(0.2) {
        return Command::Play(format!("easy-{}", rng.random_range(0..9)).parse().unwrap());
    }
    if rng.random_bool(0.7) {
        return Command::Load { scenario: Box::new(scenario), kept };
    }
    let inputs = (0..rng.random_range(0..40)).map(|_| timed(rng)).collect();
    Command::Open(Box::new(Case { about: String::new(), scenario, map: None, inputs, expect: None }))
}

/// An input of a test case. Parameters stay, because [`Watch`] knows only those before and after a command.
fn timed(rng: &mut impl Rng) -> Timed {
    let (x_m, y_m) = place(rng);
    let input = match rng.random_range(0..4) {
        0 => Input::SetGoal { x_m, y_m },
        1 => Input::Place { x_m, y_m },
        2 => Input::Release,
        _ => Input::Drag { x_m, y_m, lift: rng.random_bool(0.3) },
    };
    Timed { tick: rng.random_range(0..200), input }
}

fn controller(rng: &mut impl Rng) -> ControllerName {
    ControllerName::ALL[rng.random_range(0..ControllerName::ALL.len())]
}

fn command(rng: &mut impl Rng, present: &Parameters, newest: u64) -> Command {
    Command::Input(match rng.random_range(0..1000) {
        0..250 => {
            let (x_m, y_m) = place(rng);
            Input::Drag { x_m, y_m, lift: rng.random_bool(0.3) }
        }
        250..600 => {
            let (x_m, y_m) = place(rng);
            Input::SetGoal { x_m, y_m }
        }
        600..680 => Input::Release,
        680..700 => Input::ClearGoal,
        700..720 => Input::SelectController(controller(rng)),
        720..800 => Input::Configure(Box::new(parameters(rng, present))),
        800..880 => Input::Disturb(disturbance(rng)),
        880..886 => {
            let (x_m, y_m) = place(rng);
            Input::Place { x_m, y_m }
        }
        886..888 => {
            let (x_m, y_m) = place(rng);
            Input::Go { x_m, y_m }
        }
        888..890 => Input::Hold { reason: "x".repeat(rng.random_range(0..300)) },
        890..900 => {
            let (x_m, y_m) = place(rng);
            Input::Steer { x_m, y_m, approach: rng.random_bool(0.3) }
        }
        900..930 => return Command::Run,
        930..932 => return Command::Pause,
        932..950 => return Command::Step([0, 1, 2, 40, u32::MAX][rng.random_range(0..5)]),
        950..990 => return Command::SetSpeed(number(rng, 0.1, 70.0)),
        990..996 => return Command::Rewind(rng.random_range(0..newest + 10)),
        996 if rng.random_bool(0.1) => return Command::Return(rng.random_range(0..40)),
        996 => return Command::Rewind(newest),
        997..999 => return Command::Reset(rng.random_bool(0.5).then(|| rng.random_range(0..100))),
        // Loading a map takes as long as thousands of commands.
        _ if rng.random_bool(0.1) => return load(rng, present),
        _ => return Command::Rewind(u64::MAX),
    })
}

/// Everything that a refused command must leave unchanged.
fn fingerprint(session: &Session<MadeUp>) -> (u64, u64, bool, f64, Option<(u64, u64)>, u64) {
    let view = session.view();
    let state = session.trial.state();
    let (world, controller_state) = (state.world_hash(), state.controller_hash());
    (world, controller_state, view.running, view.speed_target, Some(view.rewind_ticks), view.scenery.version)
}

/// The positions and limits of the last check.
struct Watch {
    trial: u64,
    tick: u64,
    reference_m: [f64; 3],
    joints_rad: Option<Joints>,
    speed_m_s: f64,
}

impl Watch {
    fn of(session: &Session<MadeUp>) -> Self {
        let world = &session.trial.state().world;
        let p = &world.parameters;
        Self {
            trial: session.scenery.trial,
            tick: world.tick,
            reference_m: world.reference_m.coords.into(),
            joints_rad: world.plant.positioner.joints_rad(),
            speed_m_s: p.approach_speed_m_s.max(p.transport_speed_m_s),
        }
    }

    /// Panics at the first violation.
    fn check(&self, session: &Session<MadeUp>) {
        let now = Self::of(session);
        let world = &session.trial.state().world;
        let map = &session.trial.arena().map;
        let reference = world.reference_m;
        assert!(map.workspace().contains(reference.xy()), "the reference is out, at {reference}");
        let tool = world.plant.positioner.tool_m();
        assert!(tool.coords.iter().all(|value| value.is_finite()), "the tool is at {tool}");
        assert!(tool.z > 0.05 && tool.z < 0.25 && TOOL_LENGTH_M > 0.0, "the tool is at {tool}");
        if let Some(joints) = world.reference.joints_rad() {
            let manipulability_m3 = jacobian::manipulability(&joints);
            assert!(manipulability_m3 >= MIN_MANIPULABILITY_M3, "singular: {manipulability_m3} at {joints:?}");
        }
        let bead = world.plant.bead.position_m;
        assert!(bead.x.is_finite() && bead.y.is_finite() && map.workspace().contains(bead), "the bead is at {bead}");
        // A rewind or a new trial moves the arm to another state.
        if now.trial != self.trial || now.tick <= self.tick {
            return;
        }
        let passed_s = (now.tick - self.tick) as f64 * SERVO_PERIOD_S;
        let [dx, dy, dz] = std::array::from_fn(|i| now.reference_m[i] - self.reference_m[i]);
        let speed_m_s = self.speed_m_s.max(now.speed_m_s);
        assert!(dx.hypot(dy) <= speed_m_s * passed_s + SLACK, "{} m/s in the plane", dx.hypot(dy) / passed_s);
        assert!(dz.abs() <= LIFT_SPEED_M_S * passed_s + SLACK, "{} m/s up", dz / passed_s);
        if let (Some(before), Some(after)) = (self.joints_rad, now.joints_rad) {
            let turned = before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(turned <= JOINT_SPEED_LIMIT_RAD_S * passed_s + SLACK, "{} rad/s", turned / passed_s);
        }
    }
}

#[test]
fn random_commands_keep_the_limits_and_refused_ones_change_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(seed());
    let surroundings = Surroundings {
        catalog: Catalog::default(),
        make_camera: Box::new(|_: &Arena| Ok(MadeUp::new())),
        sink: Box::new(Nowhere::default()),
    };
    let mut now = Duration::ZERO;
    let (mut session, _) = Session::start(Scenario::idle("posts", 1), Opening::Fresh, surroundings, now).unwrap();
    let (mut refused, mut accepted, mut ticks) = (0u64, 0u64, 0u64);
    let mut known = None;
    for _ in 0..commands() {
        let world = &session.trial.state().world;
        let command = command(&mut rng, &world.parameters, world.tick);
        let before = known.take().unwrap_or_else(|| fingerprint(&session));
        let watch = Watch::of(&session);
        let told = format!("{command:?}");
        match session.apply(command, now) {
            Ok(()) => accepted += 1,
            Err(error) => {
                refused += 1;
                let after = fingerprint(&session);
                assert!(after == before, "{told} was refused ({error}) and changed {before:?} to {after:?}");
                known = Some(after);
            }
        }
        while session.is_stepping() {
            // A program that is selected and missing has no answer.
            now += PROGRAM_ANSWER_WITHIN;
            session.advance(now).unwrap();
        }
        let fault = session.take_fault();
        assert!(fault.is_none(), "{told} broke it: {fault:?}");
        watch.check(&session);
        if session.is_running() && rng.random_bool(0.5) {
            let watch = Watch::of(&session);
            now += Duration::from_secs(1);
            ticks += u64::from(session.advance(now).unwrap());
            watch.check(&session);
            known = None;
        }
        session.take_messages();
    }
    println!("{accepted} accepted, {refused} refused, {ticks} ticks beside those of steps");
    assert!(accepted > commands() / 4 && refused > commands() / 10 && ticks > commands() / 10);
}
