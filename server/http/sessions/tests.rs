use std::time::Instant;

use super::*;
use crate::faults::{self, Fault};
use ferry_core::trial::{Entry, Input, InputLog, LogWriter};

fn sessions(folder: &tempfile::TempDir, settings: SessionSettings) -> Arc<Sessions> {
    let archive = Archive::new(folder.path().join("recordings"), ferry_recording::Retention::default());
    let saved = SavedSessions::in_folder(folder.path().join("sessions"), false);
    let gpu = Gpu::open(Default::default()).unwrap();
    Arc::new(Sessions::new(gpu, archive, Catalog::default(), settings, saved, None).unwrap())
}

fn settings(most: usize, park_after: Duration) -> SessionSettings {
    SessionSettings { most, park_after, end_after: Duration::from_secs(120), opening: Scenario::idle("posts", 1) }
}

#[tokio::test(flavor = "multi_thread")]
async fn reopening_a_session_that_ended_by_a_fault_restarts_it() {
    let folder = tempfile::tempdir().unwrap();
    let sessions = sessions(&folder, settings(3, Duration::from_secs(3600)));
    let opened = sessions.open("anna").await.unwrap();
    assert!(Arc::ptr_eq(&opened, &sessions.open("anna").await.unwrap()));
    faults::arm("anna", Fault::Panic);
    opened.session.send(Command::Run).await.unwrap();
    let mut views = opened.session.watch();
    let ended = views.wait_for(|view| view.ended.is_some());
    tokio::time::timeout(Duration::from_secs(20), ended).await.unwrap().unwrap();
    let again = sessions.open("anna").await.unwrap();
    assert!(!Arc::ptr_eq(&opened, &again) && again.session.watch().borrow().ended.is_none());
    assert!(*opened.closing().borrow(), "browsers of the old session are disconnected");
    assert_eq!(sessions.all().len(), 2);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_hanging_session_does_not_block_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let sessions = sessions(&folder, settings(4, Duration::ZERO));
    let hung = sessions.open("carl").await.unwrap();
    faults::arm("carl", Fault::Hang);
    hung.session.send(Command::Run).await.unwrap();
    let mut views = hung.session.watch();
    // Its next step never returns.
    while tokio::time::timeout(Duration::from_secs(2), views.changed()).await.is_ok() {}
    let other = sessions.open("dora").await.unwrap();
    other.session.send(Command::Run).await.unwrap();
    let began = Instant::now();
    sessions.park().await;
    assert!(!other.session.watch().borrow().running, "the other is parked");
    other.session.send(Command::Run).await.unwrap();
    sessions.end(hung.clone()).await;
    assert!(began.elapsed() < 2 * END_WITHIN + Duration::from_secs(2), "it took {:?}", began.elapsed());
    let again = sessions.open("carl").await.unwrap();
    again.session.send(Command::Step(1)).await.unwrap();
    let tick = other.session.watch().borrow().moment.tick;
    assert!(other.session.watch().borrow().running && tick > 125, "the other is at tick {tick}");
    assert!(!Arc::ptr_eq(&again, &hung) && *hung.closing().borrow());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_session_goes_on_from_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    let settings = || settings(4, Duration::from_secs(3600));
    let first = sessions(&folder, settings());
    let anna = first.open("anna").await.unwrap();
    first.saved.save(first.all()).await.unwrap();
    assert!(!folder.path().join("sessions").exists(), "nothing has happened yet");
    let goal = Input::SetGoal { x_m: 0.1, y_m: -0.3 };
    anna.session.send(Command::Input(goal)).await.unwrap();
    anna.session.send(Command::Step(100)).await.unwrap();
    anna.session.send(Command::Reset(Some(9))).await.unwrap();
    anna.session.send(Command::Step(50)).await.unwrap();
    let view = anna.session.watch().borrow().clone();
    first.hold().await;

    let second = sessions(&folder, settings());
    let again = second.open("anna").await.unwrap();
    let after = again.session.watch().borrow().clone();
    assert_eq!((after.world_hash, after.moment.tick, after.running), (view.world_hash, 50, false));
    assert_eq!(after.scenery.scenario.seed, 9);
    assert_eq!(again.session.resumed().tick, Some(50));
    let kept: Vec<_> = after.scenery.kept_runs.iter().map(|run| (run.seed, run.tick)).collect();
    assert_eq!(kept, [(1, 100)]);
    let report = |session: &SessionHandle| session.watch().borrow().journal.last().unwrap().text();
    assert_eq!(report(&again.session), "the session goes on from its last saved state");
    again.session.send(Command::Return(after.scenery.kept_runs[0].number)).await.unwrap();
    let returned = again.session.watch().borrow().clone();
    assert_eq!((returned.moment.tick, returned.moment.goal_m.is_some()), (100, true));
    assert_eq!(second.find(MAIN).unwrap().session.resumed().tick, None, "nothing happened in main");
    second.hold().await;

    // Of a trial that cannot be restored, only that trial is left out, and the file is kept.
    let file = folder.path().join("sessions/anna.ferry");
    let mut entries = InputLog::read(&std::fs::read(&file).unwrap()).unwrap().entries;
    let Some(Entry::Begin(kept)) = entries.first_mut() else { panic!("no kept run") };
    kept.scenario.parameters.threshold_m = -1.0;
    let mut bytes = Vec::new();
    LogWriter::new(&mut bytes).unwrap().append(entries).unwrap();
    std::fs::write(&file, &bytes).unwrap();
    let third = sessions(&folder, settings());
    let partly = third.open("anna").await.unwrap();
    assert_eq!(partly.session.resumed().tick, Some(100));
    let text = report(&partly.session);
    assert!(
        text.contains("goes on") && text.contains("a saved trial could not be read: parameters: threshold_m is -1"),
        "{text}"
    );
    assert!(partly.session.watch().borrow().scenery.kept_runs.is_empty());
    let aside = folder.path().join("sessions/anna.ferry-unreadable");
    assert_eq!(std::fs::read(&aside).unwrap(), bytes);
    third.hold().await;

    // A damaged file is no reason to fail either.
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&file, &bytes).unwrap();
    let fourth = sessions(&folder, settings());
    let fresh = fourth.open("anna").await.unwrap();
    assert_eq!((fresh.session.watch().borrow().moment.tick, fresh.session.resumed().tick), (0, None));
    let text = report(&fresh.session);
    assert!(text.starts_with("the session started over; a saved trial could not be read: log: damaged"), "{text}");
    assert_eq!(std::fs::read(&aside).unwrap(), bytes);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_a_rewind_left_behind_survives_a_restart_and_a_deleted_session_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let settings = || settings(4, Duration::from_secs(3600));
    let first = sessions(&folder, settings());
    let anna = first.open("anna").await.unwrap();
    let obey = async |hub: &Hub, command| hub.session.send(command).await.unwrap();
    obey(&anna, Command::Step(200)).await;
    obey(&anna, Command::Rewind(100)).await;
    let tick = anna.session.watch().borrow().moment.tick;
    first.hold().await;

    let second = sessions(&folder, settings());
    let again = second.open("anna").await.unwrap();
    let view = again.session.watch().borrow().clone();
    assert_eq!(view.moment.tick, tick);
    assert_eq!(view.scenery.kept_runs.iter().map(|run| run.tick).collect::<Vec<_>>(), [200]);
    second.saved.save([again.clone()]).await.unwrap();
    assert!(second.discard("anna").await);
    let fresh = second.open("anna").await.unwrap();
    assert_eq!((fresh.session.watch().borrow().moment.tick, fresh.session.resumed().tick), (0, None));

    // Also of a session that is not open; names that are not names are no paths.
    obey(&fresh, Command::Step(10)).await;
    second.hold().await;
    let third = sessions(&folder, settings());
    assert!(third.discard("anna").await && !third.discard("anna").await && !third.discard("../sessions/anna").await);
    assert_eq!(third.open("anna").await.unwrap().session.resumed().tick, None);
}

#[test]
fn session_names_are_valid_in_addresses_and_file_names() {
    for good in ["anna", "group-7", "2026", &"x".repeat(32)] {
        assert!(is_name(good), "{good}");
    }
    for bad in ["", "-a", "Anna", "a/b", "..", "a.b", "a b", "ä", "a\0", "a%2f", &"x".repeat(33)] {
        assert!(!is_name(bad), "{bad}");
    }
}
