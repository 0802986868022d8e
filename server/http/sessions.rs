//! The sessions of a server: opened by name, parked without viewers, closed when others need their place. A visitor's own
//! end when nothing has steered them for a while.

mod names;
mod place;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock};
use std::time::Duration;

use axum::http::StatusCode;
use tokio::sync::watch;

use self::names::NAME_LENGTH;
pub use self::names::is_name;
use super::live::Hub;
use super::problem::Problem;
use super::saved_sessions::{SAVE_EVERY, SavedSessions};
use crate::session::{CommandError, SessionHandle};
use ferry_camera::Gpu;
use ferry_core::scenario::Scenario;
use ferry_core::session::{Command, Opening};
use ferry_core::trial::{Catalog, Nowhere, Sink, TrialError};
use ferry_recording::{Archive, Options, Recorder};
use ferry_ur::{Robot, Twin};

/// The session that exists from the start.
pub const MAIN: &str = "main";
/// The session of the demonstration.
pub const DEMO: &str = "demo";
/// Prefix of names given by the server.
const NUMBERED: &str = "session-";
/// A session that takes longer to start hangs.
const BEGIN_WITHIN: Duration = Duration::from_secs(30);
/// A hanging session must not keep the others from closing.
const PAUSE_WITHIN: Duration = Duration::from_millis(300);
/// Maximum time to wait for a session to end.
const END_WITHIN: Duration = Duration::from_secs(5);

pub struct SessionSettings {
    /// Maximum number of sessions; each has a thread, a camera and a recording.
    pub most: usize,
    /// A session without viewers is parked after this time.
    pub park_after: Duration,
    /// A visitor's own session without an operator ends after this time.
    pub end_after: Duration,
    /// Scenario of new sessions.
    pub opening: Scenario,
}

/// All sessions, by id.
pub struct Sessions {
    gpu: Arc<Gpu>,
    archive: Arc<Archive>,
    catalog: Catalog,
    settings: SessionSettings,
    saved: SavedSessions,
    /// The robot whose arm is that of [`MAIN`].
    robot: Arc<Robot>,
    /// The robot outside of Ferry that the arm of [`MAIN`] mirrors.
    twin: Option<Arc<Twin>>,
    hubs: RwLock<BTreeMap<String, Arc<Hub>>>,
    /// The names that are being opened. A lock is held meanwhile, so that two requests for one name get the same session, and
    /// a slow one keeps no other from its own.
    opening: Mutex<BTreeMap<String, Arc<tokio::sync::Mutex<()>>>>,
    /// Names of the sessions that have a place and begin, and whose own they are.
    placed: Mutex<Vec<(String, Option<Arc<str>>)>>,
    /// Number of sessions created so far, for their names.
    made: AtomicU64,
}

impl Sessions {
    pub fn new(
        gpu: Arc<Gpu>,
        archive: Arc<Archive>,
        catalog: Catalog,
        settings: SessionSettings,
        saved: SavedSessions,
        twin: Option<Arc<Twin>>,
    ) -> Result<Self, TrialError> {
        let sessions = Self {
            gpu,
            archive,
            catalog,
            settings,
            saved,
            robot: Arc::default(),
            twin,
            hubs: RwLock::default(),
            opening: Mutex::default(),
            placed: Mutex::default(),
            made: AtomicU64::new(0),
        };
        let main = sessions.start(MAIN, sessions.settings.opening.clone(), false, None)?;
        sessions.insert(&main);
        Ok(sessions)
    }

    /// The robot of the session `main`.
    pub fn robot(&self) -> &Arc<Robot> {
        &self.robot
    }

    /// The robot that the arm of a session mirrors.
    pub fn twin_of(&self, id: &str) -> Option<&Arc<Twin>> {
        self.twin.as_ref().filter(|_| id == MAIN)
    }

    /// The shortest time after which a session is parked or ends.
    pub fn shortest_wait(&self) -> Duration {
        self.settings.park_after.min(self.settings.end_after)
    }

    pub fn all(&self) -> Vec<Arc<Hub>> {
        self.hubs.read().unwrap_or_else(PoisonError::into_inner).values().cloned().collect()
    }

    pub fn find(&self, id: &str) -> Option<Arc<Hub>> {
        self.hubs.read().unwrap_or_else(PoisonError::into_inner).get(id).cloned()
    }

    /// The session of a name; a new one if it does not exist or has ended.
    pub async fn open(self: &Arc<Self>, name: &str) -> Result<Arc<Hub>, Problem> {
        self.open_for(name, None).await
    }

    /// The same; a new one is a visitor's own.
    pub async fn open_for(self: &Arc<Self>, name: &str, owner: Option<Arc<str>>) -> Result<Arc<Hub>, Problem> {
        // Requests for a live session do not wait for a session that is starting.
        match self.find(name).filter(|hub| !hub.has_ended()) {
            Some(hub) => {
                hub.touch();
                Ok(hub)
            }
            None => {
                let (sessions, name) = (self.clone(), name.to_owned());
                to_its_end(async move { sessions.begin(&name, owner).await }).await
            }
        }
    }

    async fn begin(self: &Arc<Self>, name: &str, owner: Option<Arc<str>>) -> Result<Arc<Hub>, Problem> {
        if !is_name(name) || name.starts_with(NUMBERED) && self.find(name).is_none() {
            let detail = format!(
                "{name:?} is not a valid session name: use 1 to {NAME_LENGTH} of a to z, 0 to 9 and -; it must not begin with \
                 - or {NUMBERED}"
            );
            return Err(Problem::new(StatusCode::NOT_FOUND, "bad_name", detail).field("name"));
        }
        let lock = self.lock_of(name);
        let _one_at_a_time = lock.lock().await;
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
                self.make(name.to_owned(), self.settings.opening.clone(), after_fault, owner).await
            }
        }
    }

    /// A session with a name given by the server.
    pub async fn create(self: &Arc<Self>, scenario: Scenario) -> Result<Arc<Hub>, Problem> {
        let sessions = self.clone();
        to_its_end(async move {
            let number = sessions.made.fetch_add(1, Ordering::Relaxed) + 1;
            sessions.make(format!("{NUMBERED}{number}"), scenario, false, None).await
        })
        .await
    }

    /// A new session of a visitor's own.
    pub async fn open_own(self: &Arc<Self>, owner: Arc<str>) -> Result<Arc<Hub>, Problem> {
        let is_taken = |name: &str| self.find(name).is_some() || self.saved.has(name);
        let name = names::free_name(is_taken).map_err(Problem::internal)?;
        self.open_for(&name, Some(owner)).await
    }

    /// Whether `name` is open as a visitor's own.
    pub fn is_own(&self, name: &str, visitor: &str) -> bool {
        self.find(name).is_some_and(|hub| !hub.has_ended() && hub.owner().is_some_and(|owner| **owner == *visitor))
    }

    /// The lock of a name. Free locks are dropped.
    fn lock_of(&self, name: &str) -> Arc<tokio::sync::Mutex<()>> {
        let mut opening = self.opening.lock().unwrap_or_else(PoisonError::into_inner);
        opening.retain(|_, lock| Arc::strong_count(lock) > 1);
        opening.entry(name.to_owned()).or_default().clone()
    }

    async fn make(
        self: &Arc<Self>,
        name: String,
        scenario: Scenario,
        after_fault: bool,
        owner: Option<Arc<str>>,
    ) -> Result<Arc<Hub>, Problem> {
        let place = self.make_room(&name, owner.as_ref()).await?;
        let (sessions, id) = (self.clone(), name.clone());
        // This creates a file, a camera and a thread. The place is taken until it has ended, however late.
        let mut starting =
            tokio::task::spawn_blocking(move || (sessions.start(&id, scenario, after_fault, owner), place));
        let Ok(started) = tokio::time::timeout(BEGIN_WITHIN, &mut starting).await else {
            tracing::error!(session = name, "session does not begin: it is left behind");
            let detail = format!("session {name:?} did not begin within {} s", BEGIN_WITHIN.as_secs());
            let sessions = self.clone();
            tokio::spawn(async move {
                if let Ok((Ok(late), _place)) = starting.await {
                    sessions.end(late).await;
                }
            });
            return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "not_begun", detail));
        };
        let (hub, _place) = started.map_err(Problem::internal)?;
        let hub = hub.map_err(not_opened)?;
        self.insert(&hub);
        Ok(hub)
    }

    fn insert(&self, hub: &Arc<Hub>) {
        self.hubs.write().unwrap_or_else(PoisonError::into_inner).insert(hub.id.clone(), hub.clone());
    }

    fn start(
        &self,
        id: &str,
        scenario: Scenario,
        after_fault: bool,
        owner: Option<Arc<str>>,
    ) -> Result<Arc<Hub>, TrialError> {
        let sink = self.sink(id);
        let is_saved = id != DEMO && !id.starts_with(NUMBERED);
        let opening = if is_saved { self.saved.opening(id, after_fault) } else { Opening::Fresh };
        let session = SessionHandle::start(id, scenario, opening, self.catalog.clone(), self.gpu.clone(), sink)?;
        if is_saved {
            self.saved.opened(id, &session);
        }
        if id == MAIN
            && let Err(error) = session.connect_robot(self.robot.clone())
        {
            tracing::warn!(%error, "the session has no robot");
        }
        if let Some(twin) = self.twin_of(id)
            && let Err(error) = session.connect_twin(twin.clone())
        {
            tracing::warn!(%error, "the session mirrors no robot");
        }
        tracing::info!(session = id, "session opened");
        Ok(Hub::start(id, session, self.gpu.clone(), owner, self.twin_of(id).cloned()))
    }

    fn sink(&self, id: &str) -> Box<dyn Sink> {
        if id == DEMO {
            // It runs for days: its recordings would take the place of all others.
            return Box::new(Nowhere { reason: "the demonstration is not recorded".into() });
        }
        match Recorder::in_archive(&self.archive, id, Options::LIVE) {
            Ok(recorder) => Box::new(recorder),
            Err(error) => {
                // The page shows this, and the session runs without a recording.
                tracing::warn!(%error, session = id, "session not recorded");
                Box::new(Nowhere { reason: error.to_string() })
            }
        }
    }

    /// Ends a session, if it is open, and deletes what was saved of it. Returns whether there was anything.
    pub async fn discard(&self, id: &str) -> bool {
        let found = self.find(id);
        let was_open = found.is_some();
        if let Some(hub) = found {
            self.end(hub).await;
        }
        is_name(id) && self.saved.forget(id).await || was_open
    }

    /// Ends a session and disconnects its browsers.
    pub async fn end(&self, hub: Arc<Hub>) {
        let id = hub.id.clone();
        self.saved.closed(&id);
        self.hubs.write().unwrap_or_else(PoisonError::into_inner).retain(|_, one| !Arc::ptr_eq(one, &hub));
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

    /// Ends the visitors' own sessions that have had no operator for long. What was done in one is saved.
    pub async fn end_unsteered(&self) {
        for hub in self.all().into_iter().filter(|hub| hub.owner().is_some()) {
            // What was saved last stays if it cannot be saved now.
            let after = self.settings.end_after;
            if hub.unsteered_for() >= after
                && self.saved.save([hub.clone()]).await.is_ok()
                && hub.close_if_unsteered(after)
            {
                tracing::info!(session = hub.id, "session ended: nothing steers it");
                self.end(hub).await;
            }
        }
    }

    /// Saves all sessions, again and again, until the server stops.
    pub async fn keep_saving(&self, mut stopping: watch::Receiver<bool>) {
        // An error means that the sender was dropped, which also stops the server.
        while tokio::time::timeout(SAVE_EVERY, stopping.wait_for(|&stop| stop)).await.is_err() {
            // Each error is logged, and the next turn tries again.
            let _ = self.saved.save(self.all()).await;
        }
    }

    /// Pauses, saves and removes all sessions. A session that hangs is not saved.
    pub async fn hold(&self) -> Vec<Arc<Hub>> {
        let hubs = std::mem::take(&mut *self.hubs.write().unwrap_or_else(PoisonError::into_inner));
        let hubs: Vec<_> = hubs.into_values().collect();
        hubs.iter().for_each(|hub| hub.session.interrupt());
        let pauses = hubs.iter().map(|hub| tokio::time::timeout(PAUSE_WITHIN, hub.session.send(Command::Pause)));
        let paused = futures_util::future::join_all(pauses).await;
        let answering = hubs.iter().zip(paused).filter(|(_, paused)| paused.is_ok());
        // Each error is logged.
        let _ = self.saved.save(answering.map(|(hub, _)| hub.clone())).await;
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
        error => Problem::from(&CommandError::Session(error.into())),
    }
}
