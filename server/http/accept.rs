//! Connections: their number, their time limits, and how they end.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::extract::{ConnectInfo, Request};
use axum::response::IntoResponse;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Semaphore, watch};
use tower::ServiceExt;

use super::metrics::Counters;

/// Maximum number of connections, including idle ones.
pub const CONNECTION_CAP: usize = 4096;
/// Time for the next request of a connection; then it is closed.
const HEAD_WITHIN: Duration = Duration::from_secs(10);
/// Maximum size of the request line with all headers.
const HEAD_BYTES: usize = 64 << 10;
const HEADERS: usize = 64;
/// Send buffer in the kernel for a browser that does not read. Newer messages replace older ones before they reach it.
const SEND_BUFFER_BYTES: usize = 256 << 10;
/// A peer that receives nothing for this long counts as disconnected.
const SILENCE: Duration = Duration::from_secs(60);
/// Time for running requests when the server stops.
const LAST_ANSWERS: Duration = Duration::from_millis(500);
/// Pause when the system cannot accept another connection.
const NO_ROOM: Duration = Duration::from_millis(50);

/// Serves connections until `stopping` becomes true; then running answers may finish.
pub async fn serve(listener: TcpListener, app: Router, counters: Arc<Counters>, mut stopping: watch::Receiver<bool>) {
    let places = Arc::new(Semaphore::new(CONNECTION_CAP));
    let mut connections = tokio::task::JoinSet::new();
    loop {
        let (stream, address) = tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok(accepted) => accepted,
                Err(error) => {
                    tracing::warn!(%error, "no connection accepted");
                    tokio::time::sleep(NO_ROOM).await;
                    continue;
                }
            },
            // An error means that the sender was dropped, which also means stop.
            () = async { drop(stopping.wait_for(|&stop| stop).await) } => break,
            // Removes finished connections.
            Some(_) = connections.join_next() => continue,
        };
        let Ok(place) = places.clone().try_acquire_owned() else {
            counters.turn_away();
            continue;
        };
        if let Err(error) = prepare(&stream) {
            tracing::debug!(%error, "socket options");
        }
        let app = app.clone();
        let service = service_fn(move |request| answer(app.clone(), request, address));
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(HEAD_WITHIN)
            .max_headers(HEADERS)
            .max_buf_size(HEAD_BYTES)
            .serve_connection(TokioIo::new(stream), service)
            .with_upgrades();
        let (counted, mut stopping) = (counters.clone(), stopping.clone());
        connections.spawn(async move {
            let _place = place;
            counted.connect(1);
            let mut connection = std::pin::pin!(connection);
            let ended = tokio::select! {
                ended = connection.as_mut() => ended,
                () = async { drop(stopping.wait_for(|&stop| stop).await) } => {
                    connection.as_mut().graceful_shutdown();
                    connection.await
                }
            };
            // The peer may disconnect at any time or send invalid HTTP; it has been answered if possible.
            if let Err(error) = ended {
                tracing::debug!(%error, %address, "connection");
            }
            counted.connect(-1);
        });
    }
    drop(listener);
    let ending = async { while connections.join_next().await.is_some() {} };
    if tokio::time::timeout(LAST_ANSWERS, ending).await.is_err() {
        connections.shutdown().await;
    }
}

async fn answer(
    app: Router,
    request: hyper::Request<Incoming>,
    address: SocketAddr,
) -> Result<axum::response::Response, std::convert::Infallible> {
    let mut request: Request = request.map(Body::new);
    request.extensions_mut().insert(ConnectInfo(address));
    Ok(app.oneshot(request).await.into_response())
}

fn prepare(stream: &TcpStream) -> std::io::Result<()> {
    let socket = socket2::SockRef::from(stream);
    // State messages are small and must not wait for each other.
    socket.set_tcp_nodelay(true)?;
    socket.set_send_buffer_size(SEND_BUFFER_BYTES)?;
    socket.set_keepalive(true)?;
    #[cfg(target_os = "linux")]
    socket.set_tcp_user_timeout(Some(SILENCE))?;
    Ok(())
}

/// Raises the limit of open files to the system's maximum: each connection is an open file.
pub fn raise_file_limit() {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        let limit = getrlimit(Resource::Nofile);
        if let Err(error) = setrlimit(Resource::Nofile, Rlimit { current: limit.maximum, ..limit }) {
            tracing::debug!(%error, "limit of open files not raised");
        }
    }
}
