//! The ports of a CB3 controller: dashboard, URScript and RTDE.

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

use crate::ur::controller::ClientId;
use crate::ur::script::{self, Reader};
use crate::ur::{Robot, dashboard, rtde};

/// Clients of all ports together.
const CLIENTS_MOST: usize = 16;
/// A client that takes nothing for this long is disconnected.
const TAKE_WITHIN: Duration = Duration::from_secs(5);
/// While the session is paused, its state is sent this often.
const PAUSED_EVERY: Duration = Duration::from_millis(16);

/// What is spoken at a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Speech {
    Dashboard,
    Script,
    Rtde,
}

impl Speech {
    fn name(self) -> &'static str {
        match self {
            Self::Dashboard => "dashboard",
            Self::Script => "URScript",
            Self::Rtde => "RTDE",
        }
    }
}

/// The ports of a controller, open.
pub struct Ports {
    all: Vec<(Speech, TcpListener)>,
}

/// A port could not be opened.
#[derive(Debug, thiserror::Error)]
#[error("robot server: port {port} of {address}: {error}")]
pub struct PortError {
    pub address: IpAddr,
    pub port: u16,
    pub error: io::Error,
}

/// The ports on which the controller of a real robot listens; there is no choice, because its clients have none. The
/// three for URScript differ only in what they report on a real robot: here they report nothing.
const PORTS: [(Speech, u16); 5] = [
    (Speech::Dashboard, 29_999),
    (Speech::Script, 30_001),
    (Speech::Script, 30_002),
    (Speech::Script, 30_003),
    (Speech::Rtde, 30_004),
];

impl Ports {
    /// # Errors
    /// [`PortError`].
    pub async fn open(address: IpAddr) -> Result<Self, PortError> {
        let mut all = Vec::new();
        for (speech, port) in PORTS {
            all.push((speech, open(address, port).await?));
        }
        Ok(Self { all })
    }

    /// The next client.
    async fn accept(&self) -> (Speech, io::Result<(TcpStream, SocketAddr)>) {
        let waiting = self.all.iter().map(|(speech, port)| Box::pin(async { (*speech, port.accept().await) }));
        futures_util::future::select_all(waiting).await.0
    }
}

async fn open(address: IpAddr, port: u16) -> Result<TcpListener, PortError> {
    TcpListener::bind(SocketAddr::new(address, port)).await.map_err(|error| PortError { address, port, error })
}

/// Answers clients until `stopping` becomes true.
pub async fn serve(ports: Ports, robot: Arc<Robot>, mut stopping: watch::Receiver<bool>) {
    let places = Arc::new(Semaphore::new(CLIENTS_MOST));
    let mut clients = tokio::task::JoinSet::new();
    loop {
        let (speech, accepted) = tokio::select! {
            accepted = ports.accept() => accepted,
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
        let client = Client::new(&robot, &from, speech);
        clients.spawn(async move {
            let _place = place;
            let ended = match speech {
                Speech::Dashboard => client.talk(socket).await,
                Speech::Script => client.take_programs(socket).await,
                Speech::Rtde => client.exchange(socket).await,
            };
            match ended {
                Ok(()) => tracing::debug!(%from, "robot server: a client has left"),
                Err(error) => tracing::info!(%from, %error, "robot server: a client was disconnected"),
            }
        });
    }
}

/// A connected client. Dropping it takes it off the robot's list.
struct Client {
    robot: Arc<Robot>,
    id: ClientId,
}

impl Drop for Client {
    fn drop(&mut self) {
        self.robot.controller().disconnect(self.id);
    }
}

impl Client {
    fn new(robot: &Arc<Robot>, from: &SocketAddr, speech: Speech) -> Self {
        let id = robot.controller().connect(from.to_string(), speech.name());
        Self { robot: robot.clone(), id }
    }

    async fn talk(&self, socket: TcpStream) -> io::Result<()> {
        let arm = self.robot.watch();
        let mut lines = Framed::new(socket, LinesCodec::new_with_max_length(dashboard::LINE_BYTES_MOST));
        in_time(lines.send(dashboard::GREETING)).await?;
        while let Some(line) = lines.next().await {
            let line = line.map_err(io::Error::other)?;
            let answer = dashboard::answer(&line, &arm.borrow(), &mut self.robot.controller());
            in_time(lines.send(answer)).await?;
            if dashboard::ends(&line) {
                break;
            }
        }
        Ok(())
    }

    /// A refused program is noted for the page; the client learns nothing, as with a real robot, whose answer is a log.
    async fn take_programs(&self, socket: TcpStream) -> io::Result<()> {
        let mut lines = Framed::new(socket, LinesCodec::new_with_max_length(script::LINE_BYTES_MOST));
        let mut reader = Reader::default();
        while let Some(line) = lines.next().await {
            let line = line.map_err(io::Error::other)?;
            let program = reader.take(line.trim_end_matches('\r')).map_err(io::Error::other)?;
            if let Some(Err(error)) = program.map(|text| self.robot.load(&text)) {
                tracing::info!(%error, "robot server: a program was refused");
            }
        }
        Ok(())
    }

    /// A client that reads slowly gets fewer frames, each with the newest state.
    async fn exchange(&self, socket: TcpStream) -> io::Result<()> {
        socket.set_nodelay(true)?;
        let mut arm = self.robot.watch();
        let mut frames = Framed::new(socket, rtde::framing());
        let mut client = rtde::Client::new(self.id);
        let mut sent_tick = None;
        loop {
            tokio::select! {
                received = frames.next() => {
                    let Some(received) = received.transpose()? else { return Ok(()) };
                    let answer = client.answer(&received, &mut self.robot.controller()).map_err(io::Error::other)?;
                    if let Some(answer) = answer {
                        in_time(frames.send(Bytes::from(answer))).await?;
                    }
                }
                // An error means that the reports have ended.
                changed = tokio::time::timeout(PAUSED_EVERY, arm.changed()), if client.every_ticks().is_some() => {
                    let Some(every) = client.every_ticks() else { continue };
                    let now = *arm.borrow_and_update();
                    let is_due = changed.is_err() || sent_tick.is_none_or(|sent| now.tick.abs_diff(sent) >= every);
                    let data = client.data(&now, &self.robot.controller()).filter(|_| is_due);
                    let Some(data) = data else { continue };
                    sent_tick = Some(now.tick);
                    in_time(frames.send(Bytes::from(data))).await?;
                    if changed.is_ok_and(|changed| changed.is_err()) {
                        return Ok(());
                    }
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
