//! The ports of a CB3 controller: dashboard and RTDE. So far they report; they command nothing.

#[cfg(test)]
mod tests;

use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use futures_util::{SinkExt, StreamExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Semaphore, watch};
use tokio_util::codec::{Framed, LinesCodec};

use crate::ur::{Reports, dashboard, rtde};

/// Clients of both ports together.
const CLIENTS_MOST: usize = 16;
/// A client that takes nothing for this long is disconnected.
const TAKE_WITHIN: Duration = Duration::from_secs(5);
/// While the session is paused, its state is sent this often.
const PAUSED_EVERY: Duration = Duration::from_millis(16);

/// The ports of a controller, open.
pub struct Ports {
    dashboard: TcpListener,
    rtde: TcpListener,
}

/// A port could not be opened.
#[derive(Debug, thiserror::Error)]
#[error("robot server: port {port} of {address}: {error}")]
pub struct PortError {
    pub address: IpAddr,
    pub port: u16,
    pub error: io::Error,
}

/// The ports on which the controller of a real robot listens; there is no choice, because its clients have none.
pub const PORTS: [u16; 2] = [29_999, 30_004];

impl Ports {
    /// # Errors
    /// [`PortError`].
    pub async fn open(address: IpAddr) -> Result<Self, PortError> {
        let [dashboard, rtde] = PORTS;
        Ok(Self { dashboard: open(address, dashboard).await?, rtde: open(address, rtde).await? })
    }
}

async fn open(address: IpAddr, port: u16) -> Result<TcpListener, PortError> {
    TcpListener::bind(SocketAddr::new(address, port)).await.map_err(|error| PortError { address, port, error })
}

/// Answers clients until `stopping` becomes true.
pub async fn serve(ports: Ports, reports: Arc<Reports>, mut stopping: watch::Receiver<bool>) {
    let places = Arc::new(Semaphore::new(CLIENTS_MOST));
    let mut clients = tokio::task::JoinSet::new();
    loop {
        let (accepted, is_dashboard) = tokio::select! {
            accepted = ports.dashboard.accept() => (accepted, true),
            accepted = ports.rtde.accept() => (accepted, false),
            // An error means that the server is gone.
            _ = stopping.wait_for(|&stop| stop) => return,
        };
        while clients.try_join_next().is_some() {}
        let (socket, from) = match accepted {
            Ok(accepted) => accepted,
            Err(error) => {
                // Too many open files, for example; the next attempt may succeed.
                tracing::warn!(%error, "robot server: a client was not accepted");
                tokio::time::sleep(Duration::from_millis(100)).await;
                continue;
            }
        };
        let Ok(place) = places.clone().try_acquire_owned() else {
            tracing::warn!(%from, "robot server: {CLIENTS_MOST} clients are connected already");
            continue;
        };
        let reports = reports.clone();
        clients.spawn(async move {
            let _place = place;
            let ended = if is_dashboard { talk(socket, &reports).await } else { exchange(socket, &reports).await };
            match ended {
                Ok(()) => tracing::debug!(%from, "robot server: a client has left"),
                Err(error) => tracing::info!(%from, %error, "robot server: a client was disconnected"),
            }
        });
    }
}

/// The dashboard.
async fn talk(socket: TcpStream, reports: &Reports) -> io::Result<()> {
    let arm = reports.watch();
    let mut lines = Framed::new(socket, LinesCodec::new_with_max_length(dashboard::LINE_BYTES_MOST));
    in_time(lines.send(dashboard::GREETING)).await?;
    while let Some(line) = lines.next().await {
        let line = line.map_err(io::Error::other)?;
        let answer = dashboard::answer(&line, &arm.borrow());
        in_time(lines.send(answer)).await?;
        if dashboard::ends(&line) {
            break;
        }
    }
    Ok(())
}

/// RTDE. A client that reads slowly gets fewer frames, each with the newest state.
async fn exchange(socket: TcpStream, reports: &Reports) -> io::Result<()> {
    socket.set_nodelay(true)?;
    let mut arm = reports.watch();
    let mut frames = Framed::new(socket, rtde::framing());
    let mut client = rtde::Client::default();
    let mut sent_tick = None;
    loop {
        tokio::select! {
            received = frames.next() => {
                let Some(received) = received.transpose()? else { return Ok(()) };
                let answer = client.answer(&received).map_err(io::Error::other)?;
                if let Some(answer) = answer {
                    in_time(frames.send(Bytes::from(answer))).await?;
                }
            }
            // An error means that the reports have ended.
            changed = tokio::time::timeout(PAUSED_EVERY, arm.changed()), if client.every_ticks().is_some() => {
                let Some(every) = client.every_ticks() else { continue };
                let now = *arm.borrow_and_update();
                let is_due = changed.is_err() || sent_tick.is_none_or(|sent| now.tick.abs_diff(sent) >= every);
                let Some(data) = client.data(&now).filter(|_| is_due) else { continue };
                sent_tick = Some(now.tick);
                in_time(frames.send(Bytes::from(data))).await?;
                if changed.is_ok_and(|changed| changed.is_err()) {
                    return Ok(());
                }
            }
        }
    }
}

async fn in_time<E: Into<Box<dyn std::error::Error + Send + Sync>>>(
    sending: impl Future<Output = Result<(), E>>,
) -> io::Result<()> {
    let sent = tokio::time::timeout(TAKE_WITHIN, sending).await;
    sent.map_err(|_| io::Error::other(format!("it took nothing for {} s", TAKE_WITHIN.as_secs())))?
        .map_err(io::Error::other)
}
