//! Accepts connections: limits their number and their idle time, and closes them when the server stops.

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
/// A connection is closed if its next request does not arrive within this time.
const REQUEST_WITHIN: Duration = Duration::from_secs(10);
/// Maximum size of the request line with all headers.
const HEAD_BYTES: usize = 64 << 10;
const HEADERS: usize = 64;
/// Size of the kernel's send buffer, which fills up if a browser does not read. Until a message enters this buffer, a
/// newer one can replace it.
const SEND_BUFFER_BYTES: usize = 256 << 10;
/// A peer that does not acknowledge data for this long counts as disconnected.
const SILENCE: Duration = Duration::from_secs(60);
/// Time for running requests to finish when the server stops.
const FINISH_WITHIN: Duration = Duration::from_millis(500);
/// Pause after the system could not accept a connection.
const ACCEPT_PAUSE: Duration = Duration::from_millis(50);

/// Serves connections until `stopping` becomes true; then running requests may finish.
pub async fn serve(listener: TcpListener, app: Router, counters: Arc<Counters>, mut stopping: watch::Receiver<bool>) {
    let permits = Arc::new(Semaphore::new(CONNECTION_CAP));
    let mut connections = tokio::task::JoinSet::new();
    loop {
        let (stream, address) = tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok(accepted) => accepted,
                Err(error) => {
                    tracing::warn!(%error, "connection not accepted");
                    tokio::time::sleep(ACCEPT_PAUSE).await;
                    continue;
                }
            },
            // An error means that the sender was dropped, which also stops the server.
            () = async { drop(stopping.wait_for(|&stop| stop).await) } => break,
            // Removes finished connections.
            Some(_) = connections.join_next() => continue,
        };
        let Ok(permit) = permits.clone().try_acquire_owned() else {
            counters.refuse_connection();
            continue;
        };
        if let Err(error) = prepare(&stream) {
            tracing::debug!(%error, "socket options not set");
        }
        let app = app.clone();
        let service = service_fn(move |request| answer(app.clone(), request, address));
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(REQUEST_WITHIN)
            .max_headers(HEADERS)
            .max_buf_size(HEAD_BYTES)
            .serve_connection(TokioIo::new(stream), service)
            .with_upgrades();
        let (counted, mut stopping) = (counters.clone(), stopping.clone());
        connections.spawn(async move {
            let _permit = permit;
            counted.connect(1);
            let mut connection = std::pin::pin!(connection);
            let ended = tokio::select! {
                ended = connection.as_mut() => ended,
                () = async { drop(stopping.wait_for(|&stop| stop).await) } => {
                    connection.as_mut().graceful_shutdown();
                    connection.await
                }
            };
            // The peer may disconnect at any time or send invalid HTTP. Hyper has answered it if possible.
            if let Err(error) = ended {
                tracing::debug!(%error, %address, "connection ended with an error");
            }
            counted.connect(-1);
        });
    }
    drop(listener);
    let ending = async { while connections.join_next().await.is_some() {} };
    if tokio::time::timeout(FINISH_WITHIN, ending).await.is_err() {
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
    // State messages are small and must be sent without delay.
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
