//! WebSockets. Every one is upgraded here, with its limits of size, rate and silence.

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::FromRequestParts;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, WebSocketUpgrade};
use axum::http::request::Parts;
use axum::response::Response;
use futures_util::SinkExt;
use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use tokio::sync::watch;
use tokio::time::{Instant, Interval};

use super::Server;
use super::problem::Problem;

/// Maximum size of pending messages for a peer; a set of the newest messages is smaller.
const WRITE_LIMIT: usize = 4 << 20;
/// Size of the buffer for what a peer sends; messages are read in parts.
const READ_BUFFER: usize = 4 << 10;
/// Message rate of one peer; further messages are read later, so that nothing is lost.
const MESSAGES_PER_S: NonZeroU32 = NonZeroU32::new(500).unwrap();
const MESSAGES_BURST: NonZeroU32 = NonZeroU32::new(1000).unwrap();
/// A peer that is silent for this number of pings is disconnected.
const PINGS: u32 = 3;
/// Close code 1001 of RFC 6455: the server is going away.
const GOING_AWAY: u16 = 1001;

/// Limits of a connection.
#[derive(Clone, Copy)]
pub struct Limits {
    /// Largest message of the peer.
    pub message_bytes: usize,
    /// Interval of pings.
    pub ping_every: Duration,
}

/// A request that asks for a WebSocket.
pub struct Upgrade(WebSocketUpgrade);

impl<S: Send + Sync> FromRequestParts<S> for Upgrade {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let upgrade = WebSocketUpgrade::from_request_parts(parts, state).await;
        let refused =
            |refused: WebSocketUpgradeRejection| Problem::new(refused.status(), "websocket", refused.body_text());
        upgrade.map(Self).map_err(refused)
    }
}

impl Upgrade {
    /// Serves the connection until the work ends. The peer may disconnect at any await, so an error of the work tells
    /// nothing.
    pub fn serve<W>(
        self,
        server: &Arc<Server>,
        limits: Limits,
        work: impl FnOnce(Socket) -> W + Send + 'static,
    ) -> Response
    where
        W: Future<Output = Result<(), axum::Error>> + Send,
    {
        let (sockets, stopping) = (server.sockets.clone(), server.stopping.clone());
        let upgrade = self.0.max_message_size(limits.message_bytes).max_frame_size(limits.message_bytes);
        upgrade.read_buffer_size(READ_BUFFER).max_write_buffer_size(WRITE_LIMIT).on_upgrade(move |socket| {
            sockets.track_future(async move {
                let _ = work(Socket::new(socket, limits, stopping)).await;
            })
        })
    }
}

/// An open WebSocket.
pub struct Socket {
    socket: WebSocket,
    stopping: watch::Receiver<bool>,
    messages: DefaultDirectRateLimiter,
    ping: Interval,
    /// When the peer counts as silent.
    silence: Duration,
    /// Time of its last message.
    received: Instant,
    /// When a peer sends too much, nothing is read before this time.
    read_after: Instant,
}

/// A message of a peer.
pub enum Incoming {
    Text(Utf8Bytes),
    Binary,
}

impl Socket {
    fn new(socket: WebSocket, limits: Limits, stopping: watch::Receiver<bool>) -> Self {
        let now = Instant::now();
        let messages = RateLimiter::direct(Quota::per_second(MESSAGES_PER_S).allow_burst(MESSAGES_BURST));
        let mut ping = tokio::time::interval_at(now + limits.ping_every, limits.ping_every);
        ping.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
        Self { socket, stopping, messages, ping, silence: limits.ping_every * PINGS, received: now, read_after: now }
    }

    /// The next message. `None` when the connection has ended: the peer has closed it or is silent, or the server stops.
    ///
    /// Dropping the future loses no message.
    pub async fn next(&mut self) -> Result<Option<Incoming>, axum::Error> {
        loop {
            let (silent_at, read_after) = (self.received + self.silence, self.read_after);
            let socket = &mut self.socket;
            let stopping = &mut self.stopping;
            let message = tokio::select! {
                message = async { tokio::time::sleep_until(read_after).await; socket.recv().await } => message.transpose()?,
                _ = self.ping.tick() => {
                    self.send(Message::Ping(Bytes::new())).await?;
                    continue;
                }
                () = tokio::time::sleep_until(silent_at) => {
                    self.close("no message from this peer").await?;
                    return Ok(None);
                }
                // An error means that the sender was dropped, which also stops the server.
                () = async { drop(stopping.wait_for(|&stop| stop).await) } => {
                    self.close("the server stops").await?;
                    return Ok(None);
                }
            };
            self.received = Instant::now();
            if let Err(until) = self.messages.check() {
                self.read_after = self.received + until.wait_time_from(DefaultClock::default().now());
            }
            match message {
                Some(Message::Text(text)) => return Ok(Some(Incoming::Text(text))),
                Some(Message::Binary(_)) => return Ok(Some(Incoming::Binary)),
                Some(Message::Ping(_) | Message::Pong(_)) => {}
                Some(Message::Close(_)) | None => return Ok(None),
            }
        }
    }

    /// Sends a message.
    ///
    /// # Errors
    /// The peer has disconnected or does not read.
    pub async fn send(&mut self, message: Message) -> Result<(), axum::Error> {
        within(self.silence, self.socket.send(message)).await
    }

    /// Sends a message with the next ones, or at [`Self::flush`].
    ///
    /// # Errors
    /// As [`Self::send`].
    pub async fn feed(&mut self, message: Message) -> Result<(), axum::Error> {
        within(self.silence, self.socket.feed(message)).await
    }

    /// # Errors
    /// As [`Self::send`].
    pub async fn flush(&mut self) -> Result<(), axum::Error> {
        within(self.silence, self.socket.flush()).await
    }

    /// Tells the peer why the connection ends.
    ///
    /// # Errors
    /// As [`Self::send`].
    pub async fn close(&mut self, reason: &'static str) -> Result<(), axum::Error> {
        self.send(Message::Close(Some(CloseFrame { code: GOING_AWAY, reason: reason.into() }))).await
    }
}

/// A peer that acknowledges data and reads nothing is silent, too.
async fn within(limit: Duration, sending: impl Future<Output = Result<(), axum::Error>>) -> Result<(), axum::Error> {
    tokio::time::timeout(limit, sending).await.map_err(axum::Error::new)?
}
