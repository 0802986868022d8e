//! The web server: routes, the WebSocket, access, and the page.

mod accept;
mod access;
mod assets;
mod base;
mod body;
#[cfg(test)]
mod fault_tests;
mod lists;
mod live;
mod metrics;
mod openapi;
mod path;
mod problem;
mod programs;
mod refusals;
mod routes;
mod saved_sessions;
mod sessions;
mod site;
mod socket;
mod visitors;

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::http::StatusCode;
use tokio::net::TcpListener;
use tokio::sync::{Semaphore, watch};
use tokio_util::task::TaskTracker;

use ferry_camera::Gpu;
use ferry_core::scenario::Scenario;
use ferry_core::trial::{Catalog, TrialError};
use ferry_lab::evaluate::Evaluations;
use ferry_lab::jobs::Queue;
use ferry_lab::learn::{Library, Trainings};
use ferry_lab::recovery::Recoveries;
use ferry_recording::{Archive, Retention};
use ferry_ur::{Robot, Twin};

pub use access::{Access, AccessError, Origin, OriginError, Token, TokenError};
pub use assets::{EmbeddedFile, Page};
pub use base::{BasePath, BasePathError};
use body::Bodies;
use metrics::Counters;
use problem::Problem;
use programs::Programs;
use routes::challenges::Contests;
use routes::maps::Maps;
use routes::values::Atlases;
use saved_sessions::SavedSessions;
use sessions::{SessionSettings, Sessions};
use visitors::Visitors;

/// Number of long computations that run at the same time; others wait.
const WORKERS: usize = 4;
/// Maximum number of camera streams, of all sessions together.
const CAMERA_STREAMS: usize = 16;
/// Maximum time that a computation waits for its start.
const WORK_WAITS: Duration = Duration::from_secs(10);
/// Interval at which sessions are parked and inactive clients forgotten.
const SWEEP_EVERY: Duration = Duration::from_secs(10);
/// When the server stops: time for browsers to disconnect, and then for sessions to close their files. On a busy machine a
/// file that is closed late is worth more than a server that ends early.
const DISCONNECT_WITHIN: Duration = Duration::from_millis(500);
const CLOSE_WITHIN: Duration = Duration::from_secs(9);

/// Why the server could not start or had to stop.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The address is in use or not available.
    #[error("cannot listen on {address}: {error}; choose another with --bind, as in --bind 127.0.0.1:0")]
    Bind {
        address: SocketAddr,
        /// The system's message.
        error: std::io::Error,
    },
    /// A session could not start.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// The server failed.
    #[error("server: {0}")]
    Io(#[from] std::io::Error),
}

/// Settings of a server.
pub struct Settings {
    /// Folder of recordings, saved sessions, uploaded maps, policies, trainings, sweeps and challenges.
    pub data: PathBuf,
    /// Limits beyond which old recordings are deleted.
    pub retention: Retention,
    /// Maximum number of sessions, at least 1.
    pub sessions: usize,
    /// Time after which a session without browsers is parked.
    pub park_after: Duration,
    /// Time after which a visitor's own session ends that has no operator.
    pub end_after: Duration,
    /// Whether `/` shows the session `main` even if another visitor operates it.
    pub shows_main: bool,
    /// Scenario of new sessions.
    pub opening: Scenario,
    /// Whether saved sessions begin with that scenario, too.
    pub start_over: bool,
    /// The robot outside of Ferry that the arm of the session `main` mirrors.
    pub twin: Option<Arc<Twin>>,
    /// What browsers load.
    pub page: Page,
    /// Path below which a proxy has the server.
    pub base: BasePath,
}

impl Settings {
    /// Default settings with this data folder, without a page.
    pub fn in_folder(data: PathBuf) -> Self {
        Self {
            data,
            retention: Retention::default(),
            sessions: 32,
            park_after: Duration::from_secs(600),
            end_after: Duration::from_secs(120),
            shows_main: false,
            opening: Scenario::idle("posts", 1),
            start_over: false,
            twin: None,
            page: Page::default(),
            base: BasePath::default(),
        }
    }
}

/// State shared by all requests.
pub struct Server {
    /// Of every address.
    base: BasePath,
    page: Page,
    gpu: Arc<Gpu>,
    access: Access,
    visitors: Visitors,
    /// Whether `/` shows the session `main` even if another visitor operates it.
    shows_main: bool,
    counters: Arc<Counters>,
    /// Recordings of the sessions.
    recordings: Arc<Archive>,
    maps: Maps,
    /// Maps and policies.
    catalog: Catalog,
    /// Those of the catalogue, with their files.
    policies: Arc<Library>,
    /// Images of maps, for value maps.
    atlases: Atlases,
    /// Evaluations, recovery maps and trainings, in the background.
    jobs: Arc<Queue>,
    contests: Contests,
    /// Programs outside of Ferry that decide control steps.
    programs: Programs,
    comparisons: Arc<live::Comparisons>,
    evaluations: Evaluations,
    recoveries: Recoveries,
    trainings: Trainings,
    /// The newest message about each of these lists.
    lists: watch::Sender<live::Lists>,
    sessions: Arc<Sessions>,
    /// Permits for long computations.
    workers: Arc<Semaphore>,
    /// Permit for taking the images of a whole map.
    painter: Arc<Semaphore>,
    /// Permit for running attempts at challenges.
    judge: Arc<Semaphore>,
    /// Permit for the controllers' runs on challenges.
    ghosts: Arc<Semaphore>,
    /// Permits for camera streams.
    camera_streams: Arc<Semaphore>,
    bodies: Bodies,
    /// Permits for browsers that may send large messages.
    large_seats: Arc<Semaphore>,
    /// Open WebSockets.
    sockets: TaskTracker,
    /// Becomes true when the server stops; every WebSocket and camera stream watches it.
    stopping: watch::Receiver<bool>,
}

impl Server {
    /// A server with the session `main`.
    pub fn new(
        gpu: Arc<Gpu>,
        settings: Settings,
        access: Access,
        stopping: watch::Receiver<bool>,
    ) -> Result<Arc<Self>, ServeError> {
        let Settings {
            data,
            retention,
            sessions,
            park_after,
            end_after,
            shows_main,
            opening,
            start_over,
            twin,
            page,
            base,
        } = settings;
        let recordings = Archive::new(data.join("recordings"), retention);
        let maps = Maps::in_folder(data.join("maps"), opening.map.clone());
        let settings = SessionSettings { most: sessions, park_after, end_after, opening };
        let visitors = Visitors::in_file(&data.join("visitors.key"))?;
        let saved = SavedSessions::in_folder(data.join("sessions"), start_over);
        let policies = Arc::new(Library::in_folder(data.join("policies")));
        let catalog = Catalog { maps: maps.all.clone(), policies: policies.clone() };
        let sessions = Sessions::new(gpu.clone(), recordings.clone(), catalog.clone(), settings, saved, twin)?;
        let (jobs, sweeps) = (Arc::new(Queue::start(&gpu)?), data.join("sweeps"));
        let server = Arc::new(Self {
            contests: Contests::in_folder(data.join("challenges")),
            programs: Programs::default(),
            comparisons: Arc::new(live::Comparisons::new(gpu.clone(), jobs.clone())),
            evaluations: Evaluations::new(jobs.clone()),
            recoveries: Recoveries::new(jobs.clone()),
            trainings: Trainings::in_folder(
                data.join("trainings"),
                sweeps.clone(),
                jobs.clone(),
                maps.all.clone(),
                policies.clone(),
            ),
            policies,
            jobs,
            page: page.below(&base),
            base,
            gpu,
            access,
            visitors,
            shows_main,
            counters: Arc::default(),
            recordings,
            maps,
            lists: watch::Sender::default(),
            catalog,
            atlases: Atlases::in_folder(sweeps),
            sessions: Arc::new(sessions),
            workers: Arc::new(Semaphore::new(WORKERS)),
            painter: Arc::new(Semaphore::new(1)),
            judge: Arc::new(Semaphore::new(1)),
            ghosts: Arc::new(Semaphore::new(1)),
            camera_streams: Arc::new(Semaphore::new(CAMERA_STREAMS)),
            bodies: Bodies::default(),
            large_seats: Arc::new(Semaphore::new(live::LARGE_SEATS)),
            sockets: TaskTracker::new(),
            stopping,
        });
        tokio::spawn(live::keep_lists(Arc::downgrade(&server)));
        Ok(server)
    }

    /// The robot of the session `main`.
    pub fn robot(&self) -> &Arc<Robot> {
        self.sessions.robot()
    }

    /// Runs a long or blocking computation. Returns 503 if it cannot start in time.
    async fn work<T: Send + 'static>(
        self: &Arc<Self>,
        work: impl FnOnce(&Arc<Self>) -> T + Send + 'static,
    ) -> Result<T, Problem> {
        self.work_at(&self.workers, WORK_WAITS, work).await
    }

    /// Like [`Self::work`], with other permits and another waiting time.
    async fn work_at<T: Send + 'static>(
        self: &Arc<Self>,
        permits: &Arc<Semaphore>,
        max_wait: Duration,
        work: impl FnOnce(&Arc<Self>) -> T + Send + 'static,
    ) -> Result<T, Problem> {
        let Ok(permit) = tokio::time::timeout(max_wait, permits.clone().acquire_owned()).await else {
            let detail = "too many requests are waiting; try again soon";
            return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "busy", detail).retry_after(1));
        };
        let permit = permit.map_err(Problem::internal)?;
        let server = self.clone();
        let working = tokio::task::spawn_blocking(move || {
            // The permit belongs to the work, which continues even if the client has disconnected.
            let _permit = permit;
            work(&server)
        });
        working.await.map_err(Problem::internal)
    }

    /// Parks sessions without browsers, ends those that nothing steers, and forgets inactive clients, periodically.
    async fn sweep(&self) {
        loop {
            tokio::time::sleep(SWEEP_EVERY.min(self.sessions.shortest_wait())).await;
            self.sessions.end_unsteered().await;
            self.sessions.park().await;
            self.access.forget();
        }
    }
}

/// All routes, behind the access check.
pub fn router(server: Arc<Server>) -> Router {
    let guard = axum::middleware::from_fn_with_state(server.clone(), access::guard);
    let base = server.base.clone();
    base.around(routes::served().layer(guard).with_state(server))
}

/// Opens the listener; the error suggests a remedy.
pub async fn listen(address: SocketAddr) -> Result<TcpListener, ServeError> {
    TcpListener::bind(address).await.map_err(|error| ServeError::Bind { address, error })
}

/// Serves until `stopping` becomes true. Then pauses every session, disconnects the browsers, closes the recordings and
/// interrupts the jobs in the background, all within two seconds if the machine is not busy.
pub async fn serve(listener: TcpListener, server: Arc<Server>) -> Result<(), ServeError> {
    accept::raise_file_limit();
    let sweeper = server.clone();
    let sweeping = tokio::spawn(async move { sweeper.sweep().await });
    let saver = server.sessions.clone();
    let stopping = server.stopping.clone();
    let saving = tokio::spawn(async move { saver.keep_saving(stopping).await });
    let connections = accept::serve(listener, router(server.clone()), server.counters.clone(), server.stopping.clone());
    let stopped = server.clone();
    let pausing = async move {
        // An error means that the sender was dropped, which also stops the server.
        drop(stopped.stopping.clone().wait_for(|&stop| stop).await);
        stopped.jobs.stop();
        // A file that is being written must not replace the last one.
        drop(saving.await);
        let hubs = stopped.sessions.hold().await;
        stopped.sockets.close();
        if tokio::time::timeout(DISCONNECT_WITHIN, stopped.sockets.wait()).await.is_err() {
            tracing::warn!("some browsers did not disconnect in time");
        }
        hubs
    };
    let ((), hubs) = tokio::join!(connections, pausing);
    sweeping.abort();
    // Joining threads and closing files blocks; sessions do this in parallel.
    let mut closing: tokio::task::JoinSet<()> = tokio::task::JoinSet::new();
    for hub in hubs {
        closing.spawn_blocking(move || hub.shut());
    }
    let jobs = server.jobs.clone();
    closing.spawn_blocking(move || jobs.close());
    if tokio::time::timeout(CLOSE_WITHIN, closing.join_all()).await.is_err() {
        tracing::error!("a session or a job did not close in time");
    }
    Ok(())
}
