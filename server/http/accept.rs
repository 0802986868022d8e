//! Accepts connections: limits their number and their idle time, and closes them when the server stops.

use std::collections::HashMap;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::extract::{ConnectInfo, Request};
use axum::http::StatusCode;
use axum::response::IntoResponse;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Semaphore, watch};
use tower::ServiceExt;

use super::access::Client;
use super::metrics::Counters;

/// Maximum number of connections, including idle ones.
pub const CONNECTION_CAP: usize = 4096;
/// Maximum number of connections of one client: half of all, so that no client can refuse all others, and a proxy, which
/// connects for all its users, still has room.
pub const CONNECTIONS_PER_CLIENT: usize = CONNECTION_CAP / 2;
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
    let clients = Clients::default();
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
        let (Ok(permit), Some(place)) = (permits.clone().try_acquire_owned(), clients.admit(Client::at(address.ip())))
        else {
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
            let _places = (permit, place);
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

/// Connections per client.
#[derive(Clone, Default)]
struct Clients(Arc<Mutex<HashMap<Client, usize>>>);

impl Clients {
    /// A place for one more connection of a client; `None` if it has too many.
    fn admit(&self, client: Client) -> Option<ClientPlace> {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let count = open.entry(client.clone()).or_default();
        if *count >= CONNECTIONS_PER_CLIENT {
            return None;
        }
        *count += 1;
        Some(ClientPlace { client, clients: self.clone() })
    }
}

/// Given back when it is dropped.
struct ClientPlace {
    client: Client,
    clients: Clients,
}

impl Drop for ClientPlace {
    fn drop(&mut self) {
        let mut open = self.clients.0.lock().unwrap_or_else(PoisonError::into_inner);
        let left = open.get(&self.client).map_or(0, |count| count - 1);
        match left {
            0 => open.remove(&self.client),
            left => open.insert(self.client.clone(), left),
        };
    }
}

async fn answer(
    app: Router,
    request: hyper::Request<Incoming>,
    address: SocketAddr,
) -> Result<axum::response::Response, std::convert::Infallible> {
    if head_bytes(&request) > HEAD_BYTES {
        // Hyper's buffer may hold more than its limit.
        return Ok(StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE.into_response());
    }
    let mut request: Request = request.map(Body::new);
    request.extensions_mut().insert(ConnectInfo(address));
    Ok(app.oneshot(request).await.into_response())
}

/// Size of the request line with all headers, nearly as they were sent.
fn head_bytes<B>(request: &hyper::Request<B>) -> usize {
    let line = request.method().as_str().len() + request.uri().to_string().len();
    request.headers().iter().map(|(name, value)| name.as_str().len() + value.len() + 4).sum::<usize>() + line
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_client_with_too_many_connections_leaves_room_for_others() {
        let clients = Clients::default();
        let [greedy, other] = [1, 2].map(|last| Client::at(std::net::Ipv4Addr::new(127, 0, 0, last).into()));
        let mut places: Vec<_> = (0..CONNECTIONS_PER_CLIENT).map(|_| clients.admit(greedy.clone()).unwrap()).collect();
        assert!(clients.admit(greedy.clone()).is_none() && clients.admit(other.clone()).is_some());
        places.pop();
        assert!(clients.admit(greedy).is_some());
        drop(places);
        assert!(clients.0.lock().unwrap().is_empty());
    }
}
