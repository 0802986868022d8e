//! The web server: routes, the WebSocket, access, and the page.

mod accept;
mod access;
mod api;
mod assets;
mod body;
mod calculator;
mod evaluations;
#[cfg(test)]
mod fault_tests;
mod fork;
mod hand;
mod hub;
mod live;
mod maps;
mod messages;
mod metrics;
mod moments;
mod openapi;
mod path;
mod problem;
mod rates;
mod refusals;
mod seats;
mod sessions;
mod values;
mod viewer;

use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::http::StatusCode;
use axum::routing::get;
use tokio::net::TcpListener;
use tokio::sync::{Semaphore, watch};
use tokio_util::task::TaskTracker;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::camera::Gpu;
use crate::evaluate::Queue;
use crate::recording::{Archive, Retention};
use crate::trial::TrialError;

pub use access::{Access, AccessError, Origin, OriginError, Token, TokenError};
use maps::Maps;
use metrics::Counters;
use problem::Problem;
use sessions::Sessions;

/// Largest request body.
const BODY_LIMIT: usize = 1 << 20;
/// The same where ten thousand poses must fit.
const BATCH_BODY_LIMIT: usize = 8 << 20;
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
    atlases: values::Atlases,
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
            atlases: values::Atlases::in_folder(data.join("sweeps")),
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

/// Every route with its description: `routes!` takes no handler without one.
fn routes() -> OpenApiRouter<Arc<Server>> {
    let calculator = OpenApiRouter::new()
        .routes(routes!(calculator::forward))
        .routes(routes!(calculator::inverse))
        .routes(routes!(calculator::workspace))
        .routes(routes!(calculator::field))
        .routes(routes!(calculator::pull))
        .routes(routes!(calculator::reach))
        .routes(routes!(calculator::plane))
        .layer(DefaultBodyLimit::max(BATCH_BODY_LIMIT));
    OpenApiRouter::with_openapi(openapi::base())
        .routes(routes!(api::health))
        .routes(routes!(metrics::metrics))
        .routes(routes!(openapi::openapi))
        .routes(routes!(access::login::form, access::login::login))
        .routes(routes!(access::login::logout))
        .routes(routes!(maps::list, maps::add))
        .routes(routes!(maps::file, maps::delete))
        .routes(routes!(api::sessions, api::create_session))
        .routes(routes!(api::session, api::delete_session))
        .routes(routes!(api::state))
        .routes(routes!(api::camera))
        .routes(routes!(api::observation))
        .routes(routes!(api::flow))
        .routes(routes!(values::values))
        .routes(routes!(moments::moment))
        .routes(routes!(moments::camera))
        .routes(routes!(moments::observation))
        .routes(routes!(moments::case))
        .routes(routes!(live::live))
        .routes(routes!(evaluations::list, evaluations::create))
        .routes(routes!(evaluations::report, evaluations::cancel))
        .routes(routes!(evaluations::file))
        .routes(routes!(api::recordings))
        .routes(routes!(api::recording))
        .routes(routes!(viewer::file))
        .layer(DefaultBodyLimit::max(BODY_LIMIT))
        .merge(calculator)
}

/// All that is served: the routes, and the pages.
fn served() -> Router<Arc<Server>> {
    Router::from(routes())
        .route("/", get(assets::main_session))
        .route("/s/{name}", get(assets::named_session))
        .method_not_allowed_fallback(problem::method_not_allowed)
        .fallback(assets::page)
}

/// The same of a server, for those who may ask.
pub fn router(server: Arc<Server>) -> Router {
    let guard = axum::middleware::from_fn_with_state(server.clone(), access::guard);
    served().layer(guard).with_state(server)
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
