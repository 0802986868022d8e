//! The web server: routes, the WebSocket, access, and the page.

mod accept;
mod access;
mod assets;
mod body;
#[cfg(test)]
mod fault_tests;
mod live;
mod metrics;
mod openapi;
mod path;
mod problem;
mod refusals;
mod routes;
mod sessions;

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::http::StatusCode;
use tokio::net::TcpListener;
use tokio::sync::{Semaphore, watch};
use tokio_util::task::TaskTracker;

use crate::camera::Gpu;
use crate::evaluate::Queue;
use crate::recording::{Archive, Retention};
use crate::trial::TrialError;

pub use access::{Access, AccessError, Origin, OriginError, Token, TokenError};
use metrics::Counters;
use problem::Problem;
use routes::maps::Maps;
use routes::values::Atlases;
use sessions::Sessions;

/// Answers that take long to work out, at once; more wait.
const WORKERS: usize = 4;
/// For so long at most.
const WORK_WAITS: Duration = Duration::from_secs(10);
/// Parked sessions and clients of long ago are looked for so often.
const SWEEP_EVERY: Duration = Duration::from_secs(10);
/// When the server stops, browsers have so long to take the last word, and sessions to close their files.
const LAST_WORDS: Duration = Duration::from_millis(500);
const LAST_WRITES: Duration = Duration::from_millis(1000);

/// Why the server could not start or go on.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The address is taken or not ours.
    #[error("cannot listen on {address}: {error}; choose another with --bind, as in --bind 127.0.0.1:0")]
    Bind {
        /// The address asked for.
        address: SocketAddr,
        /// What the system said.
        error: std::io::Error,
    },
    /// A session could not start.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// The server itself.
    #[error("server: {0}")]
    Io(#[from] std::io::Error),
}

/// What a server is set up with.
pub struct Settings {
    /// Folder of recordings, uploaded maps and sweeps.
    pub data: PathBuf,
    /// What is kept of old recordings.
    pub retention: Retention,
    /// Sessions at once, 1 or more.
    pub sessions: usize,
    /// A session that nobody has looked at for so long is parked.
    pub park_after: Duration,
}

impl Settings {
    /// The defaults, in a folder.
    pub fn in_folder(data: PathBuf) -> Self {
        Self { data, retention: Retention::default(), sessions: 8, park_after: Duration::from_secs(600) }
    }
}

/// What every request sees.
pub struct Server {
    gpu: Arc<Gpu>,
    access: Access,
    counters: Arc<Counters>,
    /// The sessions' recordings.
    recordings: Arc<Archive>,
    maps: Maps,
    /// Maps as policies see them.
    atlases: Atlases,
    /// Evaluations in the background.
    evaluations: Queue,
    sessions: Arc<Sessions>,
    /// Places for what takes long to work out.
    workers: Arc<Semaphore>,
    /// The place of who looks at a whole map.
    painter: Arc<Semaphore>,
    /// WebSockets that are open.
    sockets: TaskTracker,
    /// Turns true when the server is to stop; every WebSocket watches it.
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
        let Settings { data, retention, sessions, park_after } = settings;
        let recordings = Archive::new(data.join("recordings"), retention);
        let maps = Maps::in_folder(data.join("maps"));
        let sessions =
            Sessions::new(gpu.clone(), recordings.clone(), maps.all.clone(), maps.changes(), sessions, park_after)?;
        Ok(Arc::new(Self {
            evaluations: Queue::start(gpu.clone())?,
            gpu,
            access,
            counters: Arc::default(),
            recordings,
            maps,
            atlases: Atlases::in_folder(data.join("sweeps")),
            sessions: Arc::new(sessions),
            workers: Arc::new(Semaphore::new(WORKERS)),
            painter: Arc::new(Semaphore::new(1)),
            sockets: TaskTracker::new(),
            stopping,
        }))
    }

    /// Works something out that takes long or blocks, beside a few others; who comes when many wait is sent away.
    async fn work<T: Send + 'static>(
        self: &Arc<Self>,
        work: impl FnOnce(&Arc<Self>) -> T + Send + 'static,
    ) -> Result<T, Problem> {
        self.work_at(&self.workers, WORK_WAITS, work).await
    }

    /// The same at a place of others.
    async fn work_at<T: Send + 'static>(
        self: &Arc<Self>,
        places: &Arc<Semaphore>,
        most_wait: Duration,
        work: impl FnOnce(&Arc<Self>) -> T + Send + 'static,
    ) -> Result<T, Problem> {
        let Ok(place) = tokio::time::timeout(most_wait, places.clone().acquire_owned()).await else {
            let detail = "many wait for an answer already; come again soon";
            return Err(Problem::new(StatusCode::SERVICE_UNAVAILABLE, "busy", detail).retry_after(1));
        };
        let place = place.map_err(Problem::internal)?;
        let server = self.clone();
        let working = tokio::task::spawn_blocking(move || {
            // Its own: who asked may have gone, and the work goes on.
            let _place = place;
            work(&server)
        });
        working.await.map_err(Problem::internal)
    }

    /// Parks and forgets, again and again.
    async fn sweep(&self) {
        loop {
            tokio::time::sleep(SWEEP_EVERY.min(self.sessions.park_after())).await;
            self.sessions.park().await;
            self.access.forget();
        }
    }
}

/// All that is served, for those who may ask.
pub fn router(server: Arc<Server>) -> Router {
    let guard = axum::middleware::from_fn_with_state(server.clone(), access::guard);
    routes::served().layer(guard).with_state(server)
}

/// Opens the listener, or says what to do instead.
pub async fn listen(address: SocketAddr) -> Result<TcpListener, ServeError> {
    TcpListener::bind(address).await.map_err(|error| ServeError::Bind { address, error })
}

/// Serves until `stopping` turns true; then holds every session, sends the browsers away, closes the recordings, and
/// breaks off what is evaluated, all within two seconds.
pub async fn serve(listener: TcpListener, server: Arc<Server>) -> Result<(), ServeError> {
    accept::raise_file_limit();
    let sweeper = server.clone();
    let sweeping = tokio::spawn(async move { sweeper.sweep().await });
    let connections = accept::serve(listener, router(server.clone()), server.counters.clone(), server.stopping.clone());
    let holder = server.clone();
    let holding = async move {
        // An error means that nobody can ask to stop any more, which is as good as asking.
        drop(holder.stopping.clone().wait_for(|&stop| stop).await);
        holder.evaluations.stop();
        let hubs = holder.sessions.hold().await;
        holder.sockets.close();
        if tokio::time::timeout(LAST_WORDS, holder.sockets.wait()).await.is_err() {
            tracing::warn!("some browsers did not take the last word");
        }
        hubs
    };
    let ((), hubs) = tokio::join!(connections, holding);
    sweeping.abort();
    // Joining threads and closing files blocks; each session has files of its own.
    let mut closing: tokio::task::JoinSet<()> = tokio::task::JoinSet::new();
    for hub in hubs {
        closing.spawn_blocking(move || hub.shut());
    }
    let evaluations = server.clone();
    closing.spawn_blocking(move || evaluations.evaluations.close());
    if tokio::time::timeout(LAST_WRITES, closing.join_all()).await.is_err() {
        tracing::error!("a session or an evaluation did not end in time");
    }
    Ok(())
}
