//! The same scenario, seed and inputs give the same trial, tick by tick.

use std::sync::{Arc, OnceLock};

use ferry_camera::Camera;
use ferry_core::geometry::Point2;
use ferry_core::image::{CameraError, CameraFrame, ImageSource, Subject};
use ferry_core::plant::{BeadMotion, PositionerKind, ToolOrientation};
use ferry_core::policy::Shipped;
use ferry_core::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted, When};
use ferry_core::trial::{
    Arena, Beginning, Deciding, Entry, Input, InputLog, LogWriter, LoggedBeginning, LoggedTick, Motion, ReplayError,
    Replayed, Source, Trial, World, replay,
};
use proptest::prelude::*;

use crate::support::gpu;

fn posts() -> Arc<Arena> {
    static POSTS: OnceLock<Arc<Arena>> = OnceLock::new();
    POSTS.get_or_init(|| Arena::shipped("posts").unwrap()).clone()
}

fn camera() -> Camera {
    Camera::of(&gpu(), posts().static_scene()).unwrap()
}

fn scenario(seed: u64) -> Scenario {
    let arena = posts();
    let controller = ControllerName::ALL[seed as usize % ControllerName::ALL.len()];
    let random = arena.random("posts", controller, 2, seed, 0).unwrap();
    // Half of them without an arm, all with a script.
    let positioner = seed.is_multiple_of(2).then_some(PositionerKind::PlanarStage);
    let script = vec![
        Scripted { at: When::Step(3), disturbance: Disturbance::Impulse { x_n_s: 2e-4, y_n_s: 3e-4 } },
        Scripted { at: When::Tick(150), disturbance: Disturbance::Drift { x_n: 1e-3, y_n: -1e-3, for_s: 0.6 } },
        Scripted { at: When::Tick(220), disturbance: Disturbance::Dropout { for_s: 0.5 } },
    ];
    // A third of them between walls that move from the start.
    let parameters = if seed.is_multiple_of(3) { moving(0.01) } else { Parameters::default() };
    Scenario { positioner, script, parameters, ..random }
}

/// Walls that move, in a fluid that flows.
fn moving(peristalsis_amplitude_m: f64) -> Parameters {
    Parameters {
        peristalsis_amplitude_m,
        peristalsis_period_s: 2.0,
        peristalsis_irregularity: 0.5,
        flow_m_s: 0.02,
        obstacle_memory_s: 1.0,
        ..Parameters::default()
    }
}

/// Inputs of an operator, with their ticks.
#[derive(Clone, Debug)]
struct Script(Vec<(u64, Input)>);

impl Script {
    /// Applies the inputs that are due; refusals are part of the run.
    fn act(&self, trial: &mut Trial) {
        let tick = trial.state().world.tick;
        for (_, input) in self.0.iter().filter(|(at, _)| *at == tick) {
            let _ = trial.apply(input.clone());
        }
    }
}

fn place() -> impl Strategy<Value = (f64, f64)> {
    (-0.32..0.30f64, -0.56..-0.19f64)
}

fn input() -> impl Strategy<Value = Input> {
    prop_oneof![
        place().prop_map(|(x_m, y_m)| Input::SetGoal { x_m, y_m }),
        (place(), any::<bool>()).prop_map(|((x_m, y_m), lift)| Input::Drag { x_m, y_m, lift }),
        Just(Input::Release),
        Just(Input::ClearGoal),
        (0..ControllerName::ALL.len()).prop_map(|index| Input::SelectController(ControllerName::ALL[index])),
        place().prop_map(|(x_m, y_m)| Input::Place { x_m, y_m }),
        disturbance().prop_map(Input::Disturb),
        (place(), any::<bool>()).prop_map(|((x_m, y_m), approach)| Input::Steer { x_m, y_m, approach }),
        (0..3u64).prop_map(|seed| Input::Reseed { seed }),
        place().prop_map(|(x_m, y_m)| Input::Go { x_m, y_m }),
        Just(Input::Hold { reason: "it thinks".to_owned() }),
        (any::<bool>(), any::<bool>(), 0..3u8).prop_map(|(rolls, tilted, moves)| Input::Configure(Box::new(
            Parameters {
                bead_motion: if rolls { BeadMotion::Rolling } else { BeadMotion::Sliding },
                tool_orientation: if tilted { ToolOrientation::Paper } else { ToolOrientation::Vertical },
                ..moving(0.008 * f64::from(moves))
            }
        ))),
    ]
}

fn disturbance() -> impl Strategy<Value = Disturbance> {
    prop_oneof![
        place().prop_map(|(x_m, y_m)| Disturbance::Displace { x_m, y_m }),
        (-2e-3..2e-3f64, -2e-3..2e-3f64).prop_map(|(x_n_s, y_n_s)| Disturbance::Impulse { x_n_s, y_n_s }),
        (-0.01..0.01f64, -0.01..0.01f64).prop_map(|(x_n, y_n)| Disturbance::Drift { x_n, y_n, for_s: 0.5 }),
        (0.1..2.0f64).prop_map(|for_s| Disturbance::Dropout { for_s }),
    ]
}

fn script(ticks: u64) -> impl Strategy<Value = Script> {
    proptest::collection::vec((0..ticks, input()), 0..8).prop_map(Script)
}

fn run(trial: &mut Trial, script: &Script, ticks: u64, camera: &mut dyn ImageSource) -> Vec<LoggedTick> {
    (0..ticks)
        .map(|_| {
            script.act(trial);
            LoggedTick::from(&trial.tick(Source::Camera(camera)).unwrap())
        })
        .collect()
}

/// Stores the frames that a camera takes.
struct Tape {
    camera: Camera,
    frames: Vec<CameraFrame>,
}

impl ImageSource for Tape {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        let frame = self.camera.capture(subject)?;
        self.frames.push(frame.clone());
        Ok(frame)
    }
}

/// Returns stored frames in order.
struct Playback(std::vec::IntoIter<CameraFrame>);

impl ImageSource for Playback {
    fn capture(&mut self, _: &Subject) -> Result<CameraFrame, CameraError> {
        Ok(self.0.next().expect("as many frames as control steps"))
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    /// Snapshot, restore and continue give the same result.
    #[test]
    fn a_restored_trial_equals_the_uninterrupted_one(seed in 0..1000u64, cut in 0..400u64, script in script(400)) {
        let mut camera = camera();
        let mut whole = Trial::new(scenario(seed), posts()).unwrap();
        run(&mut whole, &script, cut, &mut camera);
        let mut bytes = Vec::new();
        ciborium::into_writer(&whole.snapshot(), &mut bytes).unwrap();
        let expected = run(&mut whole, &script, 400 - cut, &mut camera);

        let mut resumed = Trial::new(scenario(seed), posts()).unwrap();
        resumed.restore(ciborium::from_reader(&*bytes).unwrap());
        let found = run(&mut resumed, &script, 400 - cut, &mut camera);
        prop_assert_eq!(expected, found);
    }

    /// A log replays without a camera to the same world, and from the frames to the same controller state.
    #[test]
    fn a_log_and_its_frames_reproduce_the_run(seed in 0..1000u64, script in script(400)) {
        let mut tape = Tape { camera: camera(), frames: Vec::new() };
        let mut trial = Trial::new(scenario(seed), posts()).unwrap();
        let recorded = run(&mut trial, &script, 400, &mut tape);
        let mut file = Vec::new();
        let mut writer = LogWriter::new(&mut file).unwrap();
        let first = Trial::new(scenario(seed), posts()).unwrap();
        writer.append(vec![Entry::Begin(Box::new(LoggedBeginning::of(&first, Beginning::SetUp)))]).unwrap();
        for ticks in recorded.chunks(31) {
            writer.append(ticks.iter().cloned().map(Entry::Tick).collect()).unwrap();
        }

        let log = InputLog::read(&file).unwrap();
        let all = Replayed { trials: 1, resumed: 0, ticks: 400 };
        let mut seen = Vec::new();
        prop_assert_eq!(replay(&log, None, &mut |record| seen.push(record.world.total())).unwrap(), all);
        prop_assert_eq!(seen, recorded.iter().map(|tick| tick.world_hash).collect::<Vec<_>>());
        let mut frames = Some(tape.frames);
        let mut make_camera = |_: &Arena| -> Result<Box<dyn ImageSource>, CameraError> {
            Ok(Box::new(Playback(frames.take().expect("one trial").into_iter())))
        };
        prop_assert_eq!(replay(&log, Some(Deciding { make_camera: &mut make_camera, policies: Arc::new(Shipped) }), &mut |_| {}).unwrap(), all);
    }
}

/// A log with one changed entry and valid frame hashes.
fn forged(change: impl Fn(&mut LoggedTick)) -> ReplayError {
    let mut trial = Trial::new(scenario(2), posts()).unwrap();
    let mut entries = vec![Entry::Begin(Box::new(LoggedBeginning::of(&trial, Beginning::SetUp)))];
    let nothing = Script(Vec::new());
    let mut ticks = run(&mut trial, &nothing, 100, &mut camera());
    // A control step.
    change(&mut ticks[63]);
    entries.extend(ticks.into_iter().map(Entry::Tick));
    replay(&InputLog { entries, torn_bytes: 0 }, None, &mut |_| {}).expect_err("a forged log")
}

#[test]
fn the_first_difference_is_reported_by_tick_and_field() {
    let told = |error: ReplayError| match error {
        ReplayError::Differs { trial: 1, tick, fields } => (tick, fields),
        error => panic!("{error}"),
    };
    let (tick, fields) = told(forged(|tick| tick.world_hash ^= 1));
    assert_eq!((tick, fields.as_slice()), (64, &["world"][..]));
    let (tick, fields) = told(forged(|tick| {
        tick.world_hash ^= 1;
        tick.fields[2 * World::FIELDS.iter().position(|&name| name == "bead").unwrap()] ^= 1;
    }));
    assert_eq!((tick, fields.as_slice()), (64, &["bead"][..]));
    let (tick, fields) = told(forged(|tick| tick.inputs.push(Input::SetGoal { x_m: 0.05, y_m: -0.4 })));
    assert_eq!(tick, 64);
    assert!(fields.contains(&"goal") && !fields.contains(&"parameters"), "{fields:?}");
    let (tick, fields) = told(forged(|tick| {
        tick.decision.as_mut().unwrap().motion = Motion::Hold;
    }));
    assert_eq!(tick, 64);
    assert!(fields.contains(&"motion"), "{fields:?}");
    let refused = forged(|tick| tick.inputs.push(Input::SetGoal { x_m: 9.0, y_m: 0.0 })).to_string();
    assert!(refused.contains("tick 64") && refused.contains("outside the workspace"), "{refused}");
}

/// Set for the child process of the test below.
const CHILD: &str = "FERRY_TEST_PRINTS_HASHES";

fn hashes() -> String {
    let drag = |at, x_m, y_m| (at, Input::Drag { x_m, y_m, lift: false });
    let script = Script(vec![drag(200, 0.0, -0.4), drag(220, 0.1, -0.4), (300, Input::Release)]);
    let mut trial = Trial::new(scenario(5), posts()).unwrap();
    let ticks = run(&mut trial, &script, 1000, &mut camera());
    ticks.iter().map(|tick| format!("{:016x}{:016x}\n", tick.world_hash, tick.controller_hash)).collect()
}

#[test]
fn two_processes_agree_at_every_tick() {
    if std::env::var_os(CHILD).is_some() {
        println!("HASHES\n{}END", hashes());
        return;
    }
    let child = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "determinism::two_processes_agree_at_every_tick", "--nocapture"])
        .env(CHILD, "1")
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&child.stdout);
    let theirs = printed.split_once("HASHES\n").and_then(|(_, rest)| rest.split_once("END")).map(|(hashes, _)| hashes);
    let ours = hashes();
    assert_eq!(ours.lines().count(), 1000);
    assert_eq!(theirs, Some(ours.as_str()));
}

#[test]
fn an_edited_input_changes_the_hash() {
    let camera = &mut camera();
    let mut honest = Trial::new(scenario(1), posts()).unwrap();
    let mut edited = Trial::new(scenario(1), posts()).unwrap();
    let goal = Point2::new(0.0, -0.4);
    honest.apply(Input::SetGoal { x_m: goal.x, y_m: goal.y }).unwrap();
    edited.apply(Input::SetGoal { x_m: goal.x + 1e-9, y_m: goal.y }).unwrap();
    let nothing = Script(Vec::new());
    assert_ne!(
        run(&mut honest, &nothing, 1, camera)[0].world_hash,
        run(&mut edited, &nothing, 1, camera)[0].world_hash
    );
}
