//! Tests of sessions in which something fails.

use std::sync::Arc;
use std::time::Duration;

use super::access::Access;
use super::{Server, Settings};
use crate::faults::{self, Fault};
use crate::session::{CommandError, SessionHandle};
use ferry_camera::Gpu;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::session::{Command, Opening, SPEED_MAX};
use ferry_core::trial::{Catalog, Input, InputLog, Nowhere, Sink};
use ferry_recording::{Archive, Options, Recorder, Retention};

fn start(name: &str, controller: ControllerName, sink: Box<dyn Sink>) -> SessionHandle {
    let gpu = Gpu::open(Default::default()).unwrap();
    let scenario = Scenario { controller, ..Scenario::idle("posts", 1) };
    SessionHandle::start(name, scenario, Opening::Fresh, Catalog::default(), gpu, sink).unwrap()
}

async fn reason_of_end(session: &SessionHandle) -> String {
    let mut views = session.watch();
    let ended = views.wait_for(|view| view.ended.is_some());
    let view = tokio::time::timeout(Duration::from_secs(20), ended).await.expect("the session ends").unwrap();
    view.ended.clone().unwrap().to_string()
}

async fn wait_for_a_second(session: &SessionHandle) {
    let mut views = session.watch();
    let from = views.borrow().moment.tick;
    let later = views.wait_for(|view| view.moment.tick >= from + 125);
    tokio::time::timeout(Duration::from_secs(20), later).await.expect("the session continues").unwrap();
}

async fn run(session: &SessionHandle) {
    session.send(Command::Input(Input::SetGoal { x_m: 0.1, y_m: -0.5 })).await.unwrap();
    session.send(Command::Run).await.unwrap();
    wait_for_a_second(session).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fault_ends_only_its_session_with_a_message() {
    let other = start("unharmed", ControllerName::Attractor, Box::new(Nowhere::default()));
    run(&other).await;
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let recorder = Recorder::in_archive(&archive, "broken", Options::LIVE).unwrap();
    let session = start("breaks", ControllerName::Rl, Box::new(recorder));
    run(&session).await;
    faults::arm("breaks", Fault::Panic);
    let reason = reason_of_end(&session).await;
    assert_eq!(reason, "injected panic");
    let refused = session.send(Command::Run).await;
    assert!(matches!(refused, Err(CommandError::Ended)), "{refused:?}");
    let tick = session.watch().borrow().moment.tick;
    assert!(session.watch().borrow().moment.bead_m.x.is_finite());
    session.close();
    // The recording is complete up to the fault.
    let files = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path());
    let log = files.into_iter().find(|path| path.extension().is_some_and(|ending| ending == "ferry")).unwrap();
    let log = InputLog::read(&std::fs::read(log).unwrap()).unwrap();
    assert!(log.entries.len() as u64 >= tick.min(125), "{} entries at tick {tick}", log.entries.len());
    wait_for_a_second(&other).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_graphics_device_is_replaced_and_the_session_continues() {
    let gpu = Gpu::open(Default::default()).unwrap();
    let scenario = Scenario::idle("posts", 1);
    let session = SessionHandle::start(
        "lost device",
        scenario,
        Opening::Fresh,
        Catalog::default(),
        gpu.clone(),
        Box::new(Nowhere::default()),
    );
    let session = session.unwrap();
    run(&session).await;
    gpu.destroy();
    wait_for_a_second(&session).await;
    wait_for_a_second(&session).await;
    assert_eq!(session.watch().borrow().ended, None);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_session_ends_during_a_long_step_command() {
    let session = Arc::new(start("steps", ControllerName::Attractor, Box::new(Nowhere::default())));
    let stepping = session.clone();
    let answer = tokio::spawn(async move { stepping.send(Command::Step(12_500)).await });
    tokio::time::sleep(Duration::from_millis(100)).await;
    assert!(!answer.is_finished(), "100 simulated seconds took less than 100 ms");
    let began = std::time::Instant::now();
    tokio::task::spawn_blocking(move || session.close()).await.unwrap();
    assert!(began.elapsed() < Duration::from_millis(500), "it took {:?}", began.elapsed());
    assert!(matches!(answer.await.unwrap(), Err(CommandError::Ended)));
}

/// During a long step, requests are answered and states are published; later commands wait, and a pause ends it.
#[tokio::test(flavor = "multi_thread")]
async fn a_long_step_is_interruptible_and_keeps_the_order_of_commands() {
    let session = start("slices", ControllerName::Attractor, Box::new(Nowhere::default()));
    let tick = || session.watch().borrow().moment.tick;
    let long = session.begin(Command::Step(12_500)).unwrap();
    let goal = session.begin(Command::Input(Input::SetGoal { x_m: 0.1, y_m: -0.5 })).unwrap();
    let mut ticks = Vec::new();
    while ticks.len() < 3 {
        let began = std::time::Instant::now();
        session.saved().await.unwrap();
        assert!(began.elapsed() < Duration::from_secs(1), "it took {:?}", began.elapsed());
        let now = tick();
        if ticks.last() != Some(&now) {
            ticks.push(now);
        }
        assert_eq!(session.watch().borrow().moment.goal_m, None, "the goal waits for the end of the step");
        tokio::time::sleep(Duration::from_millis(5)).await;
    }
    session.send(Command::Pause).await.unwrap();
    long.await.unwrap().unwrap();
    goal.await.unwrap().unwrap();
    let stopped = tick();
    assert!(ticks[2] <= stopped && stopped < 12_500, "{ticks:?}, then {stopped}");
    assert!(session.watch().borrow().moment.goal_m.is_some());
    session.send(Command::Step(7)).await.unwrap();
    assert_eq!(tick(), stopped + 7);
}

fn server(data: &std::path::Path) -> Arc<Server> {
    let gpu = Gpu::open(Default::default()).unwrap();
    let access = Access::new(([127, 0, 0, 1], 8080).into(), None, &[]).unwrap();
    let (_, stopping) = tokio::sync::watch::channel(false);
    Server::new(gpu, Settings::in_folder(data.to_owned()), access, stopping).unwrap()
}

/// Requests whose clients disconnect must not start more computations at the same time than the limit.
#[tokio::test(flavor = "multi_thread")]
async fn work_keeps_its_permit_until_it_ends() {
    let folder = tempfile::tempdir().unwrap();
    let server = server(folder.path());
    for _ in 0..super::WORKERS {
        let work = server.work(|_| std::thread::sleep(Duration::from_secs(2)));
        assert!(tokio::time::timeout(Duration::from_millis(50), work).await.is_err());
    }
    let began = std::time::Instant::now();
    server.work(|_| ()).await.unwrap();
    assert!(began.elapsed() > Duration::from_secs(1), "it waited only {:?}", began.elapsed());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_session_starts_once_even_if_the_first_clients_disconnect() {
    let folder = tempfile::tempdir().unwrap();
    let server = server(folder.path());
    for _ in 0..5 {
        let opening = server.sessions.open("anna");
        let _ = tokio::time::timeout(Duration::from_millis(5), opening).await;
    }
    let anna = server.sessions.open("anna").await.unwrap();
    assert!(Arc::ptr_eq(&anna, &server.sessions.open("anna").await.unwrap()));
    assert_eq!(server.sessions.all().len(), 2, "main and anna");
    let recorded = server.recordings.list().unwrap();
    assert_eq!(recorded.iter().filter(|one| one.session.as_deref() == Some("anna")).count(), 1);
}

#[tokio::test(flavor = "multi_thread")]
async fn the_last_of_many_comparisons_completes() {
    let folder = tempfile::tempdir().unwrap();
    let server = server(folder.path());
    let hub = server.sessions.open("anna").await.unwrap();
    hub.session.send(Command::Input(Input::SetGoal { x_m: 0.1, y_m: -0.5 })).await.unwrap();
    let mut comparison = hub.comparison();
    for _ in 0..200 {
        server.comparisons.start(&hub, 0, &[ControllerName::Attractor]).await.unwrap();
    }
    let done = comparison.wait_for(|text| text.contains("\"running\":false"));
    tokio::time::timeout(Duration::from_secs(60), done).await.expect("the last comparison ends").unwrap();
}

/// When the processors are busy, a session reports its delay, skips the lost time, and still executes commands.
#[tokio::test(flavor = "multi_thread")]
async fn a_session_on_busy_processors_reports_its_delay_and_executes_commands() {
    use std::sync::atomic::{AtomicBool, Ordering};
    let session = start("busy", ControllerName::Rl, Box::new(Nowhere::default()));
    run(&session).await;
    let done = Arc::new(AtomicBool::new(false));
    let load: Vec<_> = (0..4 * std::thread::available_parallelism().unwrap().get())
        .map(|_| {
            let done = done.clone();
            std::thread::spawn(move || {
                while !done.load(Ordering::Relaxed) {
                    std::hint::spin_loop();
                }
            })
        })
        .collect();
    session.send(Command::SetSpeed(SPEED_MAX)).await.unwrap();
    let mut slowest = Duration::ZERO;
    for _ in 0..20 {
        let sent_at = std::time::Instant::now();
        session.send(Command::Input(Input::SetGoal { x_m: 0.1, y_m: -0.5 })).await.unwrap();
        slowest = slowest.max(sent_at.elapsed());
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    let view = session.watch().borrow().clone();
    done.store(true, Ordering::Relaxed);
    load.into_iter().for_each(|thread| thread.join().unwrap());
    assert!(view.missed_deadlines > 0 && view.speed_achieved < SPEED_MAX, "{}", view.missed_deadlines);
    assert!(view.lateness > Duration::ZERO);
    assert!(slowest < Duration::from_secs(2), "a command took {slowest:?}");
    assert_eq!(view.ended, None);
}
