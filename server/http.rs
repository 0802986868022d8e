//! The web server: routes, the WebSocket, access, and the page.

mod access;
mod api;
mod assets;
mod body;
mod calculator;
mod evaluations;
mod fork;
mod hub;
mod live;
mod metrics;
mod moments;
mod problem;
mod values;
mod viewer;

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, RwLock};

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::{get, post};
use axum::serve::ListenerExt;
use tokio::net::TcpListener;
use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};

use crate::camera::Gpu;
use crate::evaluate::Queue;
use crate::recording::{Archive, Options, Recorder, Retention};
use crate::scenario::Scenario;
use crate::session::Session;
use crate::trial::{Nowhere, Sink, TrialError};

use hub::Hub;

/// Sessions at once; each has a thread, a camera and a recording.
pub const SESSION_CAP: usize = 8;
/// Largest request body.
const BODY_LIMIT: usize = 1 << 20;
/// The same where ten thousand poses must fit.
const BATCH_BODY_LIMIT: usize = 8 << 20;
/// The session that exists from the start.
pub const MAIN_SESSION: &str = "main";

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
    /// Others could reach it.
    #[error("--bind {address} lets other machines in, which Ferry does not allow yet; use 127.0.0.1 or [::1]")]
    NotLoopback {
        /// The address asked for.
        address: SocketAddr,
    },
    /// A session could not start.
    #[error(transparent)]
    Trial(#[from] TrialError),
    /// The server itself.
    #[error("server: {0}")]
    Io(#[from] std::io::Error),
}

/// What every request sees.
pub struct Server {
    gpu: Arc<Gpu>,
    /// The sessions' recordings.
    recordings: Arc<Archive>,
    /// Maps as policies see them.
    atlases: values::Atlases,
    /// Evaluations in the background.
    evaluations: Queue,
    /// Sessions by id. Written by `POST` and `DELETE`, read by all.
    sessions: RwLock<BTreeMap<String, Arc<Hub>>>,
    /// A place a session, [`SESSION_CAP`] in all.
    places: Arc<Semaphore>,
    /// Sessions made so far, for their ids.
    made: AtomicU64,
    /// Turns true when the server is to stop; every WebSocket watches it.
    stopping: watch::Receiver<bool>,
}

impl Server {
    /// A server with the session `main`.
    pub fn new(
        gpu: Arc<Gpu>,
        data: PathBuf,
        retention: Retention,
        stopping: watch::Receiver<bool>,
    ) -> Result<Arc<Self>, ServeError> {
        let server = Arc::new(Self {
            evaluations: Queue::start(gpu.clone())?,
            gpu,
            recordings: Archive::new(data.join("recordings"), retention),
            atlases: values::Atlases::in_folder(data.join("sweeps")),
            sessions: RwLock::default(),
            places: Arc::new(Semaphore::new(SESSION_CAP)),
            made: AtomicU64::new(0),
            stopping,
        });
        let place = server.places.clone().try_acquire_owned().expect("the first session finds a place");
        server.open(MAIN_SESSION, Scenario::idle("posts", 1), place)?;
        Ok(server)
    }

    /// Starts a session under an id that is free. Blocks: it makes a file, a camera and a thread.
    fn open(&self, id: &str, scenario: Scenario, place: OwnedSemaphorePermit) -> Result<Arc<Hub>, ServeError> {
        // A recording that cannot begin is shown, and the session runs without.
        let sink: Box<dyn Sink> = match Recorder::in_archive(&self.recordings, id, Options::LIVE) {
            Ok(recorder) => Box::new(recorder),
            Err(error) => {
                tracing::warn!(%error, "session not recorded");
                Box::new(Nowhere { reason: error.to_string() })
            }
        };
        let session = Session::start(id, scenario, self.gpu.clone(), sink)?;
        let hub = Hub::start(id, session, self.gpu.clone(), place);
        self.sessions.write().expect("no holder panics").insert(id.to_owned(), hub.clone());
        Ok(hub)
    }

    fn find(&self, id: &str) -> Option<Arc<Hub>> {
        self.sessions.read().expect("no holder panics").get(id).cloned()
    }
}

/// All routes.
pub fn router(server: Arc<Server>) -> Router {
    let calculator = Router::new()
        .route("/api/kinematics/forward", post(calculator::forward))
        .route("/api/kinematics/inverse", post(calculator::inverse))
        .route("/api/kinematics/workspace", post(calculator::workspace))
        .route("/api/magnetics/field", post(calculator::field))
        .route("/api/magnetics/pull", post(calculator::pull))
        .route("/api/magnetics/reach", post(calculator::reach))
        .layer(DefaultBodyLimit::max(BATCH_BODY_LIMIT));
    Router::new()
        .route("/healthz", get(|| async { "ok\n" }))
        .route("/metrics", get(metrics::metrics))
        .route("/api/maps", get(api::maps))
        .route("/api/maps/{name}", get(api::map))
        .route("/api/sessions", get(api::sessions).post(api::create_session))
        .route("/api/sessions/{id}", get(api::session).delete(api::delete_session))
        .route("/api/sessions/{id}/state", get(api::state))
        .route("/api/sessions/{id}/camera.png", get(api::camera))
        .route("/api/sessions/{id}/observation.png", get(api::observation))
        .route("/api/sessions/{id}/flow", post(api::flow))
        .route("/api/sessions/{id}/values", post(values::values))
        .route("/api/sessions/{id}/moments/{tick}", get(moments::moment))
        .route("/api/sessions/{id}/moments/{tick}/camera.png", get(moments::camera))
        .route("/api/sessions/{id}/moments/{tick}/observation.png", get(moments::observation))
        .route("/api/sessions/{id}/case.json", get(moments::case))
        .route("/api/sessions/{id}/live", get(live::live))
        .route("/api/evaluations", get(evaluations::list).post(evaluations::create))
        .route("/api/evaluations/{id}", get(evaluations::report).delete(evaluations::cancel))
        .route("/api/evaluations/{id}/{file}", get(evaluations::file))
        .route("/api/recordings", get(api::recordings))
        .route("/api/recordings/{file}", get(api::recording))
        .route("/rerun/{file}", get(viewer::file))
        .layer(DefaultBodyLimit::max(BODY_LIMIT))
        .merge(calculator)
        .fallback(assets::page)
        .layer(axum::middleware::from_fn(access::guard))
        .with_state(server)
}

/// Opens the listener, or says what to do instead.
pub async fn listen(address: SocketAddr) -> Result<TcpListener, ServeError> {
    if !address.ip().is_loopback() {
        return Err(ServeError::NotLoopback { address });
    }
    TcpListener::bind(address).await.map_err(|error| ServeError::Bind { address, error })
}

/// Serves until `stopping` turns true, then closes every session and recording, and breaks off what is evaluated.
pub async fn serve(listener: TcpListener, server: Arc<Server>) -> Result<(), ServeError> {
    let mut stopping = server.stopping.clone();
    let stopped_server = server.clone();
    let stopped = async move {
        // An error means that nobody can ask to stop any more, which is as good as asking.
        let _ = stopping.wait_for(|&stop| stop).await;
        stopped_server.evaluations.stop();
    };
    let listener = listener.tap_io(|stream| {
        // State messages are small and must not wait for each other.
        if let Err(error) = stream.set_nodelay(true) {
            tracing::debug!(%error, "no TCP_NODELAY");
        }
    });
    axum::serve(listener, router(server.clone())).with_graceful_shutdown(stopped).await?;
    let sessions = std::mem::take(&mut *server.sessions.write().expect("no holder panics"));
    sessions.values().for_each(|hub| hub.close());
    // Joining threads and closing files blocks.
    let closing = move || {
        drop(sessions);
        server.evaluations.close();
    };
    tokio::task::spawn_blocking(closing).await.map_err(|error| std::io::Error::other(error).into())
}
