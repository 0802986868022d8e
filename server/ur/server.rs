//! The ports of a CB3 controller: dashboard, URScript and RTDE.

mod lines;
#[cfg(test)]
mod tests;

use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use bytes::Bytes;
use futures_util::{SinkExt, StreamExt};
use tokio::io::AsyncWriteExt;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::AbortHandle;
use tokio_util::codec::{Framed, FramedRead, LinesCodec};

use crate::controller::ClientId;
use crate::script::{Reader, ScriptError};
use crate::{Robot, dashboard, rtde};
use lines::{Lines, Taken};

/// Clients of all ports together.
const CLIENTS_MOST: usize = 16;
/// A client that takes nothing for this long is disconnected.
const TAKE_WITHIN: Duration = Duration::from_secs(5);
/// The kernel's buffer for what a client does not take.
const SEND_BUFFER_BYTES: usize = 16 << 10;
/// A client whose system does not answer for this long is disconnected.
const GONE_AFTER: Duration = Duration::from_secs(20);
/// A client that has asked for no reports and writes nothing for this long is disconnected: it may have claimed inputs.
/// At the other ports, one that is silent for this long leaves when its place is needed.
const SILENT_AFTER: Duration = Duration::from_secs(if cfg!(test) { 2 } else { 30 });
/// While the session is paused, its state is sent this often.
const PAUSED_EVERY: Duration = Duration::from_millis(16);

/// What is spoken at a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Speech {
    Dashboard,
    Script {
        /// Whether refusals are sent: not at the port whose packets have all one length.
        tells: bool,
    },
    Rtde,
}

impl Speech {
    fn name(self) -> &'static str {
        match self {
            Self::Dashboard => "dashboard",
            Self::Script { .. } => "URScript",
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

/// The ports on which the controller of a real robot listens; there is no choice, because its clients have none. A real
/// robot also reports its state at the three for URScript; Ferry sends only what it refuses.
const PORTS: [(Speech, u16); 5] = [
    (Speech::Dashboard, 29_999),
    (Speech::Script { tells: true }, 30_001),
    (Speech::Script { tells: true }, 30_002),
    (Speech::Script { tells: false }, 30_003),
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

/// When a client was heard last, or took something.
#[derive(Clone, Debug)]
struct Heard(Arc<Mutex<Instant>>);

impl Heard {
    fn now() -> Self {
        Self(Arc::new(Mutex::new(Instant::now())))
    }

    fn note(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
    }

    fn at(&self) -> Instant {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The places of clients.
#[derive(Default)]
struct Places(Vec<(Heard, AbortHandle)>);

impl Places {
    /// Whether another client may come. When all places are taken, the one that has been silent longest leaves.
    fn make_room(&mut self) -> bool {
        self.0.retain(|(_, client)| !client.is_finished());
        if self.0.len() < CLIENTS_MOST {
            return true;
        }
        let silent = self.0.iter().filter(|(heard, _)| heard.at().elapsed() > SILENT_AFTER);
        let Some((_, client)) = silent.min_by_key(|(heard, _)| heard.at()) else { return false };
        tracing::info!("robot server: a silent client leaves, because its place is needed");
        client.abort();
        true
    }
}

/// Answers clients until `stopping` becomes true.
pub async fn serve(ports: Ports, robot: Arc<Robot>, mut stopping: watch::Receiver<bool>) {
    let mut places = Places::default();
    let mut clients = tokio::task::JoinSet::new();
    loop {
        let (speech, accepted) = tokio::select! {
            accepted = ports.accept() => accepted,
            // An error means that the server is gone.
            _ = stopping.wait_for(|&stop| stop) => return,
        };
        while clients.try_join_next().is_some() {}
        let (socket, from) = match accepted.and_then(|(socket, from)| prepare(&socket).map(|()| (socket, from))) {
            Ok(accepted) => accepted,
            Err(error) => {
                // Too many open files, for example; the next attempt may succeed.
                tracing::warn!(%error, "robot server: a client was not accepted");
                tokio::time::sleep(Duration::from_millis(100)).await;
                continue;
            }
        };
        if !places.make_room() {
            tracing::warn!(%from, "robot server: {CLIENTS_MOST} clients are connected already");
            continue;
        }
        let client = Client::new(&robot, &from, speech);
        let heard = client.heard.clone();
        let handle = clients.spawn(async move {
            let ended = match speech {
                Speech::Dashboard => client.talk(socket).await,
                Speech::Script { tells } => client.take_programs(socket, tells).await,
                Speech::Rtde => client.exchange(socket).await,
            };
            match ended {
                Ok(()) => tracing::debug!(%from, "robot server: a client has left"),
                Err(error) => tracing::info!(%from, %error, "robot server: a client was disconnected"),
            }
        });
        places.0.push((heard, handle));
    }
}

/// A client whose system is gone is noticed, also by a robot that only listens.
fn prepare(stream: &TcpStream) -> io::Result<()> {
    let socket = socket2::SockRef::from(stream);
    socket.set_tcp_nodelay(true)?;
    socket.set_send_buffer_size(SEND_BUFFER_BYTES)?;
    let alive = socket2::TcpKeepalive::new().with_time(GONE_AFTER / 2).with_interval(GONE_AFTER / 4);
    socket.set_tcp_keepalive(&alive)?;
    #[cfg(target_os = "linux")]
    socket.set_tcp_user_timeout(Some(GONE_AFTER))?;
    Ok(())
}

/// A connected client. Dropping it takes it off the robot's list.
struct Client {
    robot: Arc<Robot>,
    id: ClientId,
    heard: Heard,
}

impl Drop for Client {
    fn drop(&mut self) {
        self.robot.controller().disconnect(self.id);
    }
}

impl Client {
    fn new(robot: &Arc<Robot>, from: &SocketAddr, speech: Speech) -> Self {
        let id = robot.controller().connect(from.to_string(), speech.name());
        Self { robot: robot.clone(), id, heard: Heard::now() }
    }

    /// What was refused since the last call.
    fn refused(&self, seen: &mut u64, watched: &mut watch::Receiver<u64>) -> Vec<String> {
        let robot = self.robot.controller();
        let refused = robot.refusals().since(*seen).map(ToString::to_string).collect();
        *seen = *watched.borrow_and_update();
        refused
    }

    async fn talk(&self, socket: TcpStream) -> io::Result<()> {
        let arm = self.robot.watch();
        let mut lines = Framed::new(socket, LinesCodec::new_with_max_length(dashboard::LINE_BYTES_MOST));
        in_time(lines.send(dashboard::GREETING)).await?;
        while let Some(line) = lines.next().await {
            let line = line.map_err(io::Error::other)?;
            self.heard.note();
            let answer = dashboard::answer(&line, &arm.borrow(), &mut self.robot.controller());
            in_time(lines.send(answer)).await?;
            if dashboard::ends(&line) {
                break;
            }
        }
        Ok(())
    }

    /// What is refused is noted for the page and told to all clients, as a message of a real robot.
    async fn take_programs(&self, socket: TcpStream, tells: bool) -> io::Result<()> {
        let (from, mut to) = socket.into_split();
        let mut lines = FramedRead::new(from, Lines::default());
        let mut reader = Reader::default();
        let mut refusals = self.robot.controller().refusals().watch();
        let mut seen = *refusals.borrow_and_update();
        loop {
            tokio::select! {
                line = lines.next() => {
                    self.heard.note();
                    let program = match line.transpose()? {
                        None => break,
                        Some(Taken::Line(line)) => reader.take(&line),
                        Some(Taken::TooLong) => {
                            reader.skip();
                            Err(ScriptError::Large)
                        }
                    };
                    match program {
                        Ok(None) => {}
                        // The refusal is noted.
                        Ok(Some(text)) => drop(self.robot.load(&text)),
                        Err(error) => self.robot.controller().refuse_program(&error),
                    }
                }
                // An error means that the robot is gone.
                Ok(()) = refusals.changed() => {
                    for text in self.refused(&mut seen, &mut refusals).iter().filter(|_| tells) {
                        let time_s = self.robot.watch().borrow().time_s;
                        in_time(to.write_all(&message(time_s, text))).await?;
                    }
                }
            }
        }
        if let Err(error) = reader.finish() {
            self.robot.controller().refuse_program(&error);
        }
        Ok(())
    }

    /// A client that reads slowly gets fewer frames, each with the newest state.
    async fn exchange(&self, socket: TcpStream) -> io::Result<()> {
        let mut arm = self.robot.watch();
        let mut refusals = self.robot.controller().refusals().watch();
        let mut seen = *refusals.borrow_and_update();
        let mut frames = Framed::new(socket, rtde::framing());
        let mut client = rtde::Client::new(self.id);
        let mut sent_tick = None;
        loop {
            tokio::select! {
                received = frames.next() => {
                    let Some(received) = received.transpose()? else { return Ok(()) };
                    self.heard.note();
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
                    self.heard.note();
                    if changed.is_ok_and(|changed| changed.is_err()) {
                        return Ok(());
                    }
                }
                Ok(()) = refusals.changed() => {
                    for text in self.refused(&mut seen, &mut refusals) {
                        in_time(frames.send(Bytes::from(client.message(&text)))).await?;
                    }
                }
                () = tokio::time::sleep_until((self.heard.at() + SILENT_AFTER).into()), if client.every_ticks().is_none() => {
                    let why = format!("it has asked for no reports, and was silent for {} s", SILENT_AFTER.as_secs());
                    return Err(io::Error::other(why));
                }
            }
        }
    }
}

/// A message of the primary interface: its size, the kind "robot message", a time, no source, the kind "text", and the
/// text. Universal Robots, "Client Interfaces V3.14 and V5.9".
fn message(time_s: f64, text: &str) -> Vec<u8> {
    let time_us = ((1e6 * time_s) as u64).to_be_bytes();
    let size = (4 + 1 + time_us.len() + 2 + text.len()) as u32;
    [&size.to_be_bytes()[..], &[20], &time_us, &[0, 0], text.as_bytes()].concat()
}

async fn in_time<E: Into<Box<dyn std::error::Error + Send + Sync>>>(
    sending: impl Future<Output = Result<(), E>>,
) -> io::Result<()> {
    let sent = tokio::time::timeout(TAKE_WITHIN, sending).await;
    sent.map_err(|_| io::Error::other(format!("it took nothing for {} s", TAKE_WITHIN.as_secs())))?
        .map_err(io::Error::other)
}
