//! The sessions of a server: opened by name, parked without viewers, closed when others need their place.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Duration;

use axum::http::StatusCode;
use tokio::sync::watch;

use super::live::Hub;
use super::problem::Problem;
use super::saved_sessions::{SAVE_EVERY, SavedSessions};
use crate::camera::Gpu;
use crate::map::Library;
use crate::recording::{Archive, Options, Recorder};
use crate::scenario::Scenario;
use crate::session::{Command, CommandError, Opening, Session};
use crate::trial::{Nowhere, Sink, TrialError};

/// The session that exists from the start.
pub const MAIN: &str = "main";
/// The session of the demonstration.
pub const DEMO: &str = "demo";
/// Longest name of a session.
const NAME_LENGTH: usize = 32;
/// Prefix of names given by the server.
const NUMBERED: &str = "session-";
/// A session that takes longer to start hangs.
const BEGIN_WITHIN: Duration = Duration::from_secs(30);
/// Maximum time to wait for a session to end.
const END_WITHIN: Duration = Duration::from_secs(5);

pub struct SessionSettings {
    /// Maximum number of sessions; each has a thread, a camera and a recording.
    pub most: usize,
    /// A session without viewers is parked after this time.
    pub park_after: Duration,
    /// Scenario of new sessions.
    pub opening: Scenario,
}

/// All sessions, by id.
pub struct Sessions {
    gpu: Arc<Gpu>,
    archive: Arc<Archive>,
    known_maps: Arc<Library>,
    /// Changes whenever the list of maps changes.
    maps: watch::Receiver<u64>,
    settings: SessionSettings,
    saved: SavedSessions,
    hubs: RwLock<BTreeMap<String, Arc<Hub>>>,
    /// Held while a session opens, so that two requests for one name get the same session.
    opening: tokio::sync::Mutex<()>,
    /// Number of sessions created so far, for their names.
    made: AtomicU64,
}

/// Whether a text is a valid session name: it becomes part of addresses and of recordings' names.
fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=NAME_LENGTH).contains(&name.len()) && name.chars().all(fits) && !name.starts_with('-')
}

impl Sessions {
    pub fn new(
        gpu: Arc<Gpu>,
        archive: Arc<Archive>,
        known_maps: Arc<Library>,
        maps: watch::Receiver<u64>,
        settings: SessionSettings,
        saved: SavedSessions,
    ) -> Result<Self, TrialError> {
        let sessions = Self {
            gpu,
            archive,
            known_maps,
            maps,
            settings,
            saved,
            hubs: RwLock::default(),
            opening: tokio::sync::Mutex::default(),
            made: AtomicU64::new(0),
        };
        let main = sessions.start(MAIN, sessions.settings.opening.clone(), false)?;
        sessions.insert(&main);
        Ok(sessions)
    }

    pub fn park_after(&self) -> Duration {
        self.settings.park_after
    }

    pub fn all(&self) -> Vec<Arc<Hub>> {
        self.hubs.read().unwrap_or_else(PoisonError::into_inner).values().cloned().collect()
    }

    pub fn find(&self, id: &str) -> Option<Arc<Hub>> {
        self.hubs.read().unwrap_or_else(PoisonError::into_inner).get(id).cloned()
    }

    /// The session of a name; a new one if it does not exist or has ended.
    pub async fn open(self: &Arc<Self>, name: &str) -> Result<Arc<Hub>, Problem> {
        // Requests for a live session do not wait for a session that is starting.
        match self.find(name).filter(|hub| !hub.has_ended()) {
            Some(hub) => {
                hub.touch();
                Ok(hub)
            }
            None => {
                let (sessions, name) = (self.clone(), name.to_owned());
                to_its_end(async move { sessions.begin(&name).await }).await
            }
        }
    }

    async fn begin(self: &Arc<Self>, name: &str) -> Result<Arc<Hub>, Problem> {
        if !is_name(name) || name.starts_with(NUMBERED) && self.find(name).is_none() {
            let detail = format!(
                "{name:?} is not a valid session name: use 1 to {NAME_LENGTH} of a to z, 0 to 9 and -; it must not begin with \
                 - or {NUMBERED}"
            );
            return Err(Problem::new(StatusCode::NOT_FOUND, "bad_name", detail).field("name"));
        }
        let _one_at_a_time = self.opening.lock().await;
        match self.find(name) {
            Some(hub) if !hub.has_ended() => {
                hub.touch();
                Ok(hub)
            }
            found => {
                let after_fault = found.is_some();
                if let Some(ended) = found {
                    self.end(ended).await;
                }
                self.make(name.to_owned(), self.settings.opening.clone(), after_fault).await
            }
        }
    }

    /// A session with a name given by the server.
    pub async fn create(self: &Arc<Self>, scenario: Scenario) -> Result<Arc<Hub>, Problem> {
        let sessions = self.clone();
        to_its_end(async move {
            let _one_at_a_time = sessions.opening.lock().await;
            let number = sessions.made.fetch_add(1, Ordering::Relaxed) + 1;
            sessions.make(format!("{NUMBERED}{number}"), scenario, false).await
        })
        .await
    }

    async fn make(self: &Arc<Self>, name: String, scenario: Scenario, after_fault: bool) -> Result<Arc<Hub>, Problem> {
        self.make_room().await?;
        let (sessions, id) = (self.clone(), name.clone());
        // This creates a file, a camera and a thread.
        let starting = tokio::task::spawn_blocking(move || sessions.start(&id, scenario, after_fault));
        let Ok(started) = tokio::time::timeout(BEGIN_WITHIN, starting).await else {
            tracing::error!(session = name, "session does not begin: it is left behind");
            let detail = format!("session {name:?} did not begin within {} s", BEGIN_WITHIN.as_secs());
            return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "not_begun", detail));
        };
        let hub = started.map_err(Problem::internal)?.map_err(not_opened)?;
        self.insert(&hub);
        Ok(hub)
    }

    fn insert(&self, hub: &Arc<Hub>) {
        self.hubs.write().unwrap_or_else(PoisonError::into_inner).insert(hub.id.clone(), hub.clone());
    }

    /// If all places are taken, closes the session that has been parked longest; its recordings stay.
    async fn make_room(&self) -> Result<(), Problem> {
        let all = self.all();
        if all.len() < self.settings.most {
            return Ok(());
        }
        let parked = all.into_iter().filter(|hub| hub.id != MAIN && hub.is_parked());
        match parked.max_by_key(|hub| hub.unwatched_for()) {
            Some(longest) => {
                tracing::info!(session = longest.id, "parked session makes way for another");
                self.saved.save([longest.clone()]).await;
                self.end(longest).await;
                Ok(())
            }
            None => {
                let detail = format!(
                    "there are {} sessions already, and all are in use: one has to end first",
                    self.settings.most
                );
                Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_sessions", detail))
            }
        }
    }

    fn start(&self, id: &str, scenario: Scenario, after_fault: bool) -> Result<Arc<Hub>, TrialError> {
        // If the recording cannot start, the page shows that and the session runs without it.
        let sink: Box<dyn Sink> = match Recorder::in_archive(&self.archive, id, Options::LIVE) {
            Ok(recorder) => Box::new(recorder),
            Err(error) => {
                tracing::warn!(%error, session = id, "session not recorded");
                Box::new(Nowhere { reason: error.to_string() })
            }
        };
        let is_saved = id != DEMO && !id.starts_with(NUMBERED);
        let opening = if is_saved { self.saved.opening(id, after_fault) } else { Opening::Fresh };
        let session = Session::start(id, scenario, opening, self.known_maps.clone(), self.gpu.clone(), sink)?;
        if is_saved {
            self.saved.opened(id, &session.watch().borrow());
        }
        tracing::info!(session = id, "session opened");
        Ok(Hub::start(id, session, self.maps.clone(), self.gpu.clone()))
    }

    /// Ends a session and disconnects its browsers.
    pub async fn end(&self, hub: Arc<Hub>) {
        let id = hub.id.clone();
        self.hubs.write().unwrap_or_else(PoisonError::into_inner).remove(&id);
        // Joining the session's thread and closing its file blocks.
        let closing = tokio::task::spawn_blocking(move || hub.shut());
        match tokio::time::timeout(END_WITHIN, closing).await {
            Ok(Ok(())) => {}
            Ok(Err(error)) => tracing::error!(%error, session = id, "session not closed"),
            Err(_) => tracing::error!(session = id, "session hangs: it is left behind"),
        }
    }

    /// Parks the sessions without viewers: they pause.
    pub async fn park(&self) {
        for hub in self.all() {
            if hub.unwatched_for() >= self.settings.park_after && !hub.is_parked() {
                hub.set_parked();
                // An ended session needs no parking; a hanging one must not block the others.
                let _ = tokio::time::timeout(END_WITHIN, hub.session.send(Command::Pause)).await;
                tracing::info!(session = hub.id, "session parked: no browser watches it");
            }
        }
    }

    /// Saves all sessions, again and again.
    pub async fn keep_saving(&self) {
        loop {
            tokio::time::sleep(SAVE_EVERY).await;
            self.saved.save(self.all()).await;
        }
    }

    /// Pauses, saves and removes all sessions.
    pub async fn hold(&self) -> Vec<Arc<Hub>> {
        let hubs = std::mem::take(&mut *self.hubs.write().unwrap_or_else(PoisonError::into_inner));
        let hubs: Vec<_> = hubs.into_values().collect();
        hubs.iter().for_each(|hub| hub.session.interrupt());
        let holding = futures_util::future::join_all(hubs.iter().map(|hub| hub.session.send(Command::Pause)));
        // A hanging session must not keep the others from closing.
        let _ = tokio::time::timeout(Duration::from_millis(300), holding).await;
        self.saved.save(hubs.iter().cloned()).await;
        hubs
    }
}

/// Completes even if the client has disconnected.
async fn to_its_end<T: Send + 'static>(
    work: impl Future<Output = Result<T, Problem>> + Send + 'static,
) -> Result<T, Problem> {
    tokio::spawn(work).await.map_err(Problem::internal)?
}

/// An impossible scenario is the client's fault; a missing camera or thread is not.
fn not_opened(error: TrialError) -> Problem {
    match error {
        TrialError::Camera(_) | TrialError::Thread(_) => Problem::internal(error),
        error => Problem::from(&CommandError::Trial(error)),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;
    use crate::trial::Input;

    fn sessions(folder: &tempfile::TempDir, settings: SessionSettings) -> Arc<Sessions> {
        let archive = Archive::new(folder.path().join("recordings"), crate::recording::Retention::default());
        let saved = SavedSessions::in_folder(folder.path().join("sessions"), false);
        let gpu = Gpu::open(Default::default()).unwrap();
        let maps = watch::channel(0).1;
        Arc::new(Sessions::new(gpu, archive, Arc::default(), maps, settings, saved).unwrap())
    }

    fn settings(most: usize, park_after: Duration) -> SessionSettings {
        SessionSettings { most, park_after, opening: Scenario::idle("posts", 1) }
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn reopening_a_session_that_ended_by_a_fault_restarts_it() {
        let folder = tempfile::tempdir().unwrap();
        let sessions = sessions(&folder, settings(3, Duration::from_secs(3600)));
        let opened = sessions.open("anna").await.unwrap();
        assert!(Arc::ptr_eq(&opened, &sessions.open("anna").await.unwrap()));
        crate::faults::arm("session anna", "step");
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
        crate::faults::arm("session carl", "hang");
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
        first.saved.save(first.all()).await;
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
        assert_eq!(again.session.resumed_tick(), Some(50));
        let kept: Vec<_> = after.scenery.kept_runs.iter().map(|run| (run.seed, run.tick)).collect();
        assert_eq!(kept, [(1, 100)]);
        again.session.send(Command::Return(after.scenery.kept_runs[0].number)).await.unwrap();
        let returned = again.session.watch().borrow().clone();
        assert_eq!((returned.moment.tick, returned.moment.goal_m.is_some()), (100, true));
        assert_eq!(second.find(MAIN).unwrap().session.resumed_tick(), None, "nothing happened in main");
        second.hold().await;

        // A damaged file is no reason to fail, and the page says so.
        let file = folder.path().join("sessions/anna.ferry");
        let mut bytes = std::fs::read(&file).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        std::fs::write(&file, bytes).unwrap();
        let third = sessions(&folder, settings());
        let fresh = third.open("anna").await.unwrap();
        let view = fresh.session.watch().borrow().clone();
        assert_eq!((view.moment.tick, fresh.session.resumed_tick()), (0, None));
        assert!(view.journal[0].text.starts_with("the session started over: log: damaged"), "{:?}", view.journal);
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
}
