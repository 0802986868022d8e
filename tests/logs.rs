//! Recorded sessions replay, whatever an operator does; later changes to a log are detected.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use ferry::session::SessionHandle;
use ferry_core::plant::{BeadMotion, PositionerKind};
use ferry_core::robot::Joints;
use ferry_core::scenario::{ControllerName, Disturbance, Parameters, Scenario};
use ferry_core::session::{Command, Kept, Opening};
use ferry_core::trial::{Catalog, Input, InputLog, LogError, RecordingFact, Replayed, replay};
use ferry_recording::{Archive, Options, Recorder, Retention};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::support::gpu;

/// Number of sessions that a test records; `FERRY_SESSIONS` changes it.
fn sessions() -> u64 {
    std::env::var("FERRY_SESSIONS").map_or(30, |count| count.parse().expect("FERRY_SESSIONS is a count"))
}

fn place(rng: &mut impl Rng) -> (f64, f64) {
    (rng.random_range(-0.32..0.30), rng.random_range(-0.56..-0.19))
}

/// With the tool over the table.
fn joints(rng: &mut impl Rng) -> Joints {
    [-1.6, -1.6, -1.6, -1.6, 1.6, 0.0].map(|angle_rad| angle_rad + rng.random_range(-0.3..0.3))
}

/// A random input of an operator; many are refused.
fn action(rng: &mut impl Rng, tick: u64) -> Command {
    let (x_m, y_m) = place(rng);
    Command::Input(match rng.random_range(0..21) {
        0 | 1 => Input::SetGoal { x_m, y_m },
        2 | 3 => Input::Drag { x_m, y_m, lift: rng.random() },
        4 => Input::Release,
        5 => Input::ClearGoal,
        6 => Input::Place { x_m, y_m },
        7 => Input::SelectController(ControllerName::ALL[rng.random_range(0..ControllerName::ALL.len())]),
        8 => Input::Disturb(Disturbance::Displace { x_m, y_m }),
        9 => Input::Disturb(Disturbance::Impulse { x_n_s: x_m * 1e-2, y_n_s: y_m * 1e-2 }),
        10 => Input::Configure(Box::new(Parameters {
            bead_motion: if rng.random() { BeadMotion::Rolling } else { BeadMotion::Sliding },
            ..Parameters::default()
        })),
        // A robot that is mirrored, and one that is commanded.
        18 | 19 => Input::Mirror { joints_rad: joints(rng), is_driven: rng.random() },
        20 => Input::Servo { joints_rad: joints(rng) },
        16 => Input::Go { x_m, y_m },
        17 => Input::Hold { reason: "it thinks".to_owned() },
        15 => Input::Steer { x_m, y_m, approach: rng.random() },
        11 => return Command::Rewind(rng.random_range(0..=tick)),
        12 => return Command::Reset(rng.random::<bool>().then_some(x_m.to_bits() >> 12)),
        13 => {
            let map = ["posts", "open", "colon"][rng.random_range(0..3)];
            let scenario = Scenario {
                positioner: rng.random::<bool>().then_some(PositionerKind::PlanarStage),
                disturbances: 2,
                ..Scenario::idle(map, 3)
            };
            let kept = Kept { controller: true, parameters: true, seed: false };
            return Command::Load { scenario: Box::new(scenario), kept };
        }
        // In a running session inputs arrive between any two ticks.
        _ => return Command::Run,
    })
}

/// Time limit for an answer of a session.
fn clocked() -> tokio::runtime::Runtime {
    tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap()
}

/// Records a session with random inputs.
fn play(archive: &Arc<Archive>, seed: u64, options: Options) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let name = format!("random-{seed}");
    let recorder = Recorder::in_archive(archive, &name, options).unwrap();
    let scenario = Scenario { controller: ControllerName::ALL[seed as usize % 3], ..Scenario::idle("posts", seed) };
    let session =
        SessionHandle::start(&name, scenario, Opening::Fresh, Catalog::default(), gpu(), Box::new(recorder)).unwrap();
    let runtime = clocked();
    let obey = |command| runtime.block_on(session.send(command));
    obey(Command::SetSpeed(8.0)).unwrap();
    for _ in 0..25 {
        let tick = session.watch().borrow().moment.tick;
        // Refusals are expected.
        let runs = match action(&mut rng, tick) {
            Command::Run => obey(Command::Run).is_ok(),
            command => {
                let _ = obey(command);
                false
            }
        };
        if runs {
            std::thread::sleep(Duration::from_millis(30));
            let _ = obey(Command::Input(Input::SetGoal { x_m: 0.1, y_m: -0.33 }));
            let _ = obey(Command::Input(Input::Drag { x_m: 0.0, y_m: -0.4, lift: true }));
            std::thread::sleep(Duration::from_millis(30));
            obey(Command::Pause).unwrap();
        } else {
            obey(Command::Step(rng.random_range(1..40))).unwrap();
        }
    }
    let ended = session.watch().borrow().ended.clone();
    assert_eq!(ended, None, "seed {seed}");
}

/// The input logs of a folder, in order.
pub fn logs(folder: &Path) -> Vec<Vec<u8>> {
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "ferry"));
    paths.sort();
    paths.iter().map(|path| std::fs::read(path).unwrap()).collect()
}

fn replayed(bytes: &[u8]) -> Replayed {
    let log = InputLog::read(bytes).unwrap();
    assert_eq!(log.torn_bytes, 0);
    replay(&log, None, &mut |_| {}).unwrap()
}

#[test]
fn whatever_an_operator_does_is_reproduced_and_an_edited_byte_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    (0..sessions()).into_par_iter().for_each(|seed| play(&archive, seed, Options::LIVE));
    let logs = logs(folder.path());
    assert_eq!(logs.len() as u64, sessions());
    let all: Vec<Replayed> = logs.par_iter().map(|bytes| replayed(bytes)).collect();
    let sum = |of: fn(&Replayed) -> u64| all.iter().map(of).sum::<u64>();
    // Resets, loads, rewinds, and a minimum number of ticks.
    assert!(sum(|one| u64::from(one.trials)) > 2 * sessions(), "{all:?}");
    assert!(sum(|one| u64::from(one.resumed)) > sessions() / 2, "{all:?}");
    assert!(sum(|one| one.ticks) > 300 * sessions(), "{all:?}");

    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for bytes in &logs {
        let mut edited = bytes.clone();
        let at = rng.random_range(0..edited.len());
        edited[at] ^= 1 << rng.random_range(0..8);
        let error = InputLog::read(&edited).expect_err("an edited log");
        let named = matches!(error, LogError::Damaged { .. } | LogError::Foreign(_) | LogError::Version { .. });
        assert!(named, "byte {at}: {error}");
    }
}

#[test]
fn parts_have_no_gap_and_each_replays_alone() {
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let options = Options { part: Duration::from_millis(250), ..Options::LIVE };
    let recorder = Recorder::in_archive(&archive, "main", options).unwrap();
    let session = SessionHandle::start(
        "main",
        Scenario::idle("posts", 1),
        Opening::Fresh,
        Catalog::default(),
        gpu(),
        Box::new(recorder),
    )
    .unwrap();
    let runtime = clocked();
    let obey = |command| runtime.block_on(session.send(command)).unwrap();
    obey(Command::Input(Input::SetGoal { x_m: 0.12, y_m: -0.33 }));
    for _ in 0..30 {
        obey(Command::Step(20));
        std::thread::sleep(Duration::from_millis(30));
    }
    assert_eq!(session.watch().borrow().recording, RecordingFact::On);
    drop(session);
    let logs = logs(folder.path());
    assert!(logs.len() > 2, "{} parts", logs.len());
    let mut ticks = Vec::new();
    for (index, bytes) in logs.iter().enumerate() {
        let log = InputLog::read(bytes).unwrap();
        let found = replay(&log, None, &mut |record| ticks.push(record.tick)).unwrap();
        assert_eq!((found.trials, found.resumed), if index == 0 { (1, 0) } else { (0, 1) });
    }
    assert_eq!(ticks, (1..=600).collect::<Vec<_>>());
    assert_eq!(archive.list().unwrap().iter().filter(|listed| listed.live).count(), 0);
}

fn bytes_in(folder: &Path) -> u64 {
    // A file may be deleted meanwhile.
    std::fs::read_dir(folder).unwrap().flatten().filter_map(|file| file.metadata().ok()).map(|data| data.len()).sum()
}

#[test]
fn the_largest_size_of_an_archive_holds_while_a_session_is_recorded() {
    const MAX_BYTES: u64 = 4 << 20;
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention { max_bytes: MAX_BYTES, max_parts: 200 });
    let options = Options { image_every: Duration::ZERO, ..Options::LIVE };
    let recorder = Recorder::in_archive(&archive, "main", options).unwrap();
    let scenario = Scenario::idle("posts", 1);
    let session =
        SessionHandle::start("main", scenario, Opening::Fresh, Catalog::default(), gpu(), Box::new(recorder)).unwrap();
    let runtime = clocked();
    let (mut most, mut parts) = (0, std::collections::BTreeSet::new());
    while parts.len() < 8 {
        runtime.block_on(session.send(Command::Step(50))).unwrap();
        std::thread::sleep(Duration::from_millis(50));
        most = most.max(bytes_in(folder.path()));
        parts.extend(archive.list().unwrap().into_iter().map(|listed| listed.id));
        assert_eq!(session.watch().borrow().recording, RecordingFact::On);
    }
    drop(session);
    // What is written between two checks.
    let more = MAX_BYTES / 10;
    assert!((MAX_BYTES / 2..MAX_BYTES + more).contains(&most), "{most} bytes");
    assert!(bytes_in(folder.path()) < MAX_BYTES + more);
}

#[test]
fn without_room_a_recording_does_not_begin_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let options = Options { min_free_bytes: u64::MAX, ..Options::LIVE };
    let error = Recorder::in_archive(&archive, "main", options).err().expect("no disk has so much").to_string();
    assert!(error.contains("MB left, the minimum is 17592186044415"), "{error}");
    assert!(archive.list().unwrap().is_empty());
}

/// Also with gaps, on a busy machine.
fn is_on(told: &RecordingFact) -> bool {
    matches!(told, RecordingFact::On | RecordingFact::Slow { .. })
}

/// Until a state that was published says so.
fn wait_for(session: &SessionHandle, what: impl Fn(&RecordingFact) -> bool) {
    let began = std::time::Instant::now();
    while !what(&session.watch().borrow().recording) {
        assert!(began.elapsed() < Duration::from_secs(30), "{:?}", session.watch().borrow().recording);
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_recording_whose_folder_is_gone_says_so_and_goes_on_when_it_is_back() {
    for (is_file, runs) in [(false, true), (true, true), (false, false)] {
        let data = tempfile::tempdir().unwrap();
        let folder = data.path().join("recordings");
        let archive = Archive::new(folder.clone(), Retention::default());
        let recorder = Recorder::in_archive(&archive, "main", Options::LIVE).unwrap();
        let scenario = Scenario::idle("open", 1);
        let session =
            SessionHandle::start("main", scenario, Opening::Fresh, Catalog::default(), gpu(), Box::new(recorder))
                .unwrap();
        let runtime = clocked();
        let obey = |command| runtime.block_on(session.send(command)).unwrap();
        obey(if runs { Command::Run } else { Command::Step(100) });
        wait_for(&session, is_on);
        let away = data.path().join("away");
        std::fs::rename(&folder, &away).unwrap();
        if is_file {
            std::fs::write(&folder, "not a folder").unwrap();
        }
        wait_for(&session, |told| matches!(told, RecordingFact::Interrupted { .. }));
        let told = session.watch().borrow().recording.to_string();
        assert!(told.contains("was removed; waiting for its folder"), "{told}");
        std::thread::sleep(Duration::from_millis(1500));
        wait_for(&session, |told| matches!(told, RecordingFact::Interrupted { .. }));
        if is_file {
            std::fs::remove_file(&folder).unwrap();
        }
        std::fs::create_dir(&folder).unwrap();
        if !runs {
            // The next part begins with a tick.
            std::thread::sleep(Duration::from_millis(1500));
            obey(Command::Step(100));
        }
        wait_for(&session, is_on);
        obey(Command::Step(200));
        let last = session.watch().borrow().moment.tick;
        drop(session);
        let parts = logs(&folder);
        assert_eq!(parts.len(), 1);
        let mut ticks = Vec::new();
        let found = replay(&InputLog::read(&parts[0]).unwrap(), None, &mut |record| ticks.push(record.tick)).unwrap();
        assert!(found.resumed >= 1 && ticks.len() >= 100, "{found:?}");
        assert_eq!(ticks.last(), Some(&last), "nothing is missing after the interruption");
        assert!(InputLog::read(&logs(&away)[0]).is_ok(), "what was recorded before can still be read");
    }
}
