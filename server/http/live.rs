//! The WebSocket: sends the newest state, receives commands.

mod comparison;
mod hand;
mod hub;
mod seats;

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::State;
use axum::extract::ws::{CloseFrame, Message, WebSocket, WebSocketUpgrade};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use futures_util::stream::FuturesUnordered;
use futures_util::{SinkExt, StreamExt};
use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::{oneshot, watch};
use tokio::time::Instant;

use self::hand::Hand;
use self::hub::json;
pub use self::hub::{CameraWatch, Encoded, Hub};
use self::seats::Seats;
use super::Server;
use super::path::{Path, SessionPath};
use super::problem::Problem;
use super::refusals::{Malformed, NotFound, NotUpgraded, Unavailable};
use crate::protocol::{ClientMessage, ErrorMessage, EventMessage, MAX_MESSAGE_BYTES, ServerMessage};
use crate::scenario::ControllerName;
use crate::session::{Command, CommandError};
use crate::trial::Case;

/// Maximum size of pending messages for a browser; a set of the newest messages is smaller.
const WRITE_LIMIT: usize = 4 << 20;
/// Message rate of one browser; further messages are read later, so that nothing is lost.
const MESSAGES_PER_S: NonZeroU32 = NonZeroU32::new(500).unwrap();
const MESSAGES_BURST: NonZeroU32 = NonZeroU32::new(1000).unwrap();
/// Close code 1001 of RFC 6455: the server is going away.
const GOING_AWAY: u16 = 1001;
/// Interval of checks for silent connections.
const BEAT: Duration = Duration::from_secs(1);
/// Interval of pings, and the silence after which a browser is disconnected.
const PING_EVERY: Duration = Duration::from_secs(15);
const SILENCE: Duration = Duration::from_secs(45);

/// The WebSocket of a session.
///
/// Text frames are `ClientMessage` from the browser and `ServerMessage` from the server, JSON both. Binary frames carry
/// pictures: one byte 1 (the camera's, a JPEG file) or 2 (the observation, 2 × 84 × 84 bytes), three bytes of zero, the
/// tick as u32 little-endian, then the payload.
#[utoipa::path(get, path = "/api/sessions/{id}/live", tag = "sessions", params(SessionPath),
    responses((status = 101, description = "The connection is a WebSocket from here on."), Malformed, NotFound, NotUpgraded, Unavailable))]
pub async fn live(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    upgrade: Result<WebSocketUpgrade, axum::extract::ws::rejection::WebSocketUpgradeRejection>,
) -> Response {
    let Some(hub) = server.sessions.find(&id) else { return Problem::not_found("session", &id).into_response() };
    let upgrade = match upgrade {
        Ok(upgrade) => upgrade.max_message_size(MAX_MESSAGE_BYTES).max_frame_size(MAX_MESSAGE_BYTES),
        Err(rejection) => {
            return Problem::new(rejection.status(), "websocket", rejection.body_text()).into_response();
        }
    };
    let Some(seat) = Seat::take(&hub) else {
        let detail = format!("session {id:?} has {} browsers already", hub.viewers());
        return Problem::new(StatusCode::SERVICE_UNAVAILABLE, "too_many_viewers", detail).into_response();
    };
    upgrade.max_write_buffer_size(WRITE_LIMIT).on_upgrade(move |socket| {
        let sockets = server.sockets.clone();
        sockets.track_future(async move {
            let stopping = server.stopping.clone();
            Connection::new(seat, hub, server, socket).serve(stopping).await;
        })
    })
}

/// A place among a session's browsers. Dropping it frees the place, also if the upgrade fails.
struct Seat {
    own: u64,
    hub: Arc<Hub>,
}

impl Seat {
    fn take(hub: &Arc<Hub>) -> Option<Self> {
        Some(Self { own: hub.reseat(Seats::join)?, hub: hub.clone() })
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        self.hub.reseat(|seats, now| seats.leave(self.own, now));
    }
}

struct Connection {
    seat: Seat,
    hub: Arc<Hub>,
    server: Arc<Server>,
    socket: WebSocket,
    hand: Arc<Hand>,
    /// Times of its last message and of our last ping.
    received: Instant,
    pinged: Instant,
    messages: DefaultDirectRateLimiter,
    /// When a browser sends too much, nothing is read before this time.
    read_after: Instant,
    /// Answers of `step` commands. The connection does not wait for them: it goes on sending states, and reads `pause`.
    stepping: FuturesUnordered<oneshot::Receiver<Result<(), CommandError>>>,
}

/// Versions of the newest messages that this browser has received.
#[derive(Default)]
struct Sent {
    scene_version: u64,
    past_version: u64,
    sight_version: u64,
    seen_version: u64,
}

impl Connection {
    fn new(seat: Seat, hub: Arc<Hub>, server: Arc<Server>, socket: WebSocket) -> Self {
        let now = Instant::now();
        let messages = RateLimiter::direct(Quota::per_second(MESSAGES_PER_S).allow_burst(MESSAGES_BURST));
        let hand = Hand::new(seat.own, hub.clone());
        let stepping = FuturesUnordered::new();
        Self { seat, hub, server, socket, hand, received: now, pinged: now, messages, read_after: now, stepping }
    }

    async fn serve(mut self, stopping: watch::Receiver<bool>) {
        // The browser may disconnect at any await; the reason does not matter.
        let watching = tokio::spawn(self.hand.clone().watch());
        let _ = self.run(stopping).await;
        watching.abort();
        self.hand.release().await;
    }

    async fn run(&mut self, mut stopping: watch::Receiver<bool>) -> Result<(), axum::Error> {
        let mut encoded = self.hub.encoded();
        let mut seats = self.hub.seats();
        let mut events = self.hub.session.events();
        let mut comparison = self.hub.comparison();
        let mut closing = self.hub.closing();
        let mut beat = tokio::time::interval(BEAT);
        let mut sent = Sent::default();
        let mut goes_on = true;
        let hand = self.hand.clone();
        let now = *seats.borrow_and_update();
        self.send_message(&ServerMessage::Hello(self.hub.hello(self.seat.own, &now))).await?;
        let first = encoded.borrow_and_update().clone();
        sent.past_version = first.past_version;
        self.send_newest(&first, &mut sent).await?;
        self.send_history(&mut comparison).await?;
        loop {
            tokio::select! {
                changed = encoded.changed(), if goes_on => {
                    // An ended session is still shown, with the reason.
                    goes_on = changed.is_ok();
                    let newest = encoded.borrow_and_update().clone();
                    self.send_newest(&newest, &mut sent).await?;
                }
                event = events.recv() => match event {
                    Ok(event) => self.send_message(&ServerMessage::Event(EventMessage::from(&event))).await?,
                    // The browser is too slow for every message; the newest ones follow.
                    Err(RecvError::Lagged(_)) => {}
                    Err(RecvError::Closed) => return self.close("the session has ended").await,
                },
                changed = comparison.changed() => {
                    if changed.is_err() {
                        return self.close("the session has ended").await;
                    }
                    let newest = comparison.borrow_and_update().clone();
                    self.socket.send(Message::Text(newest)).await?;
                }
                changed = seats.changed() => {
                    if changed.is_err() {
                        return self.close("the session has ended").await;
                    }
                    let now = *seats.borrow_and_update();
                    if now.operator != Some(self.seat.own) {
                        self.hand.release().await;
                    }
                    self.send_message(&ServerMessage::Hello(self.hub.hello(self.seat.own, &now))).await?;
                }
                message = receive(&mut self.socket, self.read_after) => {
                    let Some(Ok(message)) = message else { return Ok(()) };
                    if !self.receive(message).await? {
                        return Ok(());
                    }
                }
                Some(Ok(Err(error))) = self.stepping.next() => {
                    self.send_message(&ServerMessage::Error(ErrorMessage::from(&error))).await?;
                }
                () = hand.silenced.notified() => {
                    let message = format!("no message from the page that holds the bead for {} s: the bead was released and the session paused", hand::SILENCE.as_secs());
                    self.refuse("hand_silent", &message, None).await?;
                }
                _ = beat.tick() => {
                    if self.received.elapsed() > SILENCE {
                        return self.close("no message from this browser").await;
                    }
                    self.beat().await?;
                }
                () = async { drop(stopping.wait_for(|&stop| stop).await) } => return self.close("the server stops").await,
                () = async { drop(closing.wait_for(|&closed| closed).await) } => return self.close("the session was closed").await,
            }
        }
    }

    /// Returns whether the connection stays open.
    async fn receive(&mut self, message: Message) -> Result<bool, axum::Error> {
        self.received = Instant::now();
        if let Err(until) = self.messages.check() {
            self.read_after = self.received + until.wait_time_from(DefaultClock::default().now());
        }
        match message {
            Message::Text(text) => self.handle(&text).await?,
            Message::Binary(_) => {
                self.refuse("malformed", "binary messages are not understood", None).await?;
            }
            Message::Ping(_) | Message::Pong(_) => {}
            Message::Close(_) => return Ok(false),
        }
        Ok(true)
    }

    async fn beat(&mut self) -> Result<(), axum::Error> {
        if self.pinged.elapsed() > PING_EVERY {
            self.pinged = Instant::now();
            self.socket.send(Message::Ping(Bytes::new())).await?;
        }
        Ok(())
    }

    async fn send_newest(&mut self, newest: &Encoded, sent: &mut Sent) -> Result<(), axum::Error> {
        if sent.scene_version != newest.scene_version {
            sent.scene_version = newest.scene_version;
            self.socket.feed(Message::Text(newest.scene.clone())).await?;
            if sent.past_version != newest.past_version {
                sent.past_version = newest.past_version;
                self.send_events(true).await?;
            }
        }
        self.socket.feed(Message::Text(newest.state.clone())).await?;
        if sent.sight_version != newest.sight_version {
            sent.sight_version = newest.sight_version;
            self.socket.feed(Message::Text(newest.overlay.clone())).await?;
            if sent.seen_version != newest.seen_version {
                sent.seen_version = newest.seen_version;
                self.socket.feed(Message::Text(newest.seen.clone())).await?;
            }
            self.socket.feed(Message::Binary(newest.camera.clone())).await?;
            self.socket.feed(Message::Binary(newest.observation.clone())).await?;
        }
        self.socket.flush().await
    }

    /// The events of the trial.
    async fn send_events(&mut self, again: bool) -> Result<(), axum::Error> {
        let journal = self.hub.session.watch().borrow().journal.clone();
        for event in journal.iter() {
            let message = EventMessage { again, ..EventMessage::from(event) };
            self.socket.feed(Message::Text(json(&ServerMessage::Event(message)))).await?;
        }
        Ok(())
    }

    /// What happened before this browser connected.
    async fn send_history(
        &mut self,
        comparison: &mut watch::Receiver<axum::extract::ws::Utf8Bytes>,
    ) -> Result<(), axum::Error> {
        self.send_events(false).await?;
        let compared = comparison.borrow_and_update().clone();
        if !compared.is_empty() {
            self.socket.feed(Message::Text(compared)).await?;
        }
        self.socket.flush().await
    }

    async fn handle(&mut self, text: &str) -> Result<(), axum::Error> {
        let (message, epoch) = match ClientMessage::parse_with_epoch(text) {
            Ok(parsed) => parsed,
            Err(error) => return self.send_message(&ServerMessage::Error(error)).await,
        };
        let own = self.seat.own;
        match message {
            ClientMessage::TakeControl {} => self.hub.reseat(|seats, now| seats.take(own, now)),
            ClientMessage::ReleaseControl {} => {
                self.hand.release().await;
                self.hub.reseat(|seats, now| seats.release(own, now));
            }
            message => {
                let seats = *self.hub.seats().borrow();
                if seats.operator != Some(own) {
                    let text = "another browser has control; take control first";
                    return self.refuse("not_operator", text, None).await;
                }
                if let Some(meant) = epoch.filter(|&epoch| epoch != seats.epoch) {
                    let text = format!("epoch is {meant}, but another browser took control; it is now {}", seats.epoch);
                    return self.refuse("stale_epoch", &text, Some("epoch")).await;
                }
                match self.obey(message).await {
                    Ok(()) => self.hub.reseat(Seats::command),
                    Err(error) => return self.send_message(&ServerMessage::Error(ErrorMessage::from(&error))).await,
                }
            }
        }
        Ok(())
    }

    async fn obey(&mut self, message: ClientMessage) -> Result<(), CommandError> {
        let holds = match message {
            ClientMessage::Drag { .. } => Some(true),
            ClientMessage::Release {} => Some(false),
            _ => None,
        };
        match message {
            ClientMessage::Compare { tick, controllers } => {
                self.hub.compare(tick, &controllers).await?;
            }
            ClientMessage::OpenCase { case } => {
                let case = Box::new(Case::from_json(case.as_bytes()).map_err(CommandError::from)?);
                self.hub.session.send(Command::Open(case)).await?;
            }
            ClientMessage::OpenTry { recovery, cell, controller, repeat } => {
                let command = self.server.recoveries.find(&recovery).and_then(|job| {
                    let (moment, about, inputs) = job.set_up(cell, controller, repeat)?;
                    Some(Command::TakeUp { moment: Box::new(moment), about, inputs })
                });
                let command = command.ok_or(CommandError::NoTry { recovery, cell, repeat })?;
                self.hub.session.send(command).await?;
            }
            ClientMessage::SelectController { controller: ControllerName::Program, program: Some(name) } => {
                let program = self.server.programs.find(&name).ok_or(CommandError::NoProgram { name })?;
                self.hub.session.send(Command::Attach(program)).await?;
            }
            ClientMessage::DriveRobot { press } => {
                let twin = self.server.sessions.twin_of(&self.hub.id).ok_or(CommandError::NoRobot)?;
                twin.hold(press, Instant::now().into_std())?;
                // The page's hand on the bead is another matter.
                return Ok(());
            }
            message => match message.command() {
                Some(command @ Command::Step(_)) => self.stepping.push(self.hub.session.begin(command)?),
                Some(command) => self.hub.session.send(command).await?,
                None => {}
            },
        }
        self.hand.commanded(holds);
        Ok(())
    }

    async fn refuse(&mut self, code: &str, message: &str, field: Option<&str>) -> Result<(), axum::Error> {
        let (code, message, field) = (code.to_owned(), message.to_owned(), field.map(str::to_owned));
        self.send_message(&ServerMessage::Error(ErrorMessage { code, message, field })).await
    }

    async fn send_message(&mut self, message: &ServerMessage) -> Result<(), axum::Error> {
        self.socket.send(Message::Text(json(message))).await
    }

    async fn close(&mut self, reason: &'static str) -> Result<(), axum::Error> {
        self.socket.send(Message::Close(Some(CloseFrame { code: GOING_AWAY, reason: reason.into() }))).await
    }
}

/// The next message, read not before a given time.
pub async fn receive(socket: &mut WebSocket, not_before: Instant) -> Option<Result<Message, axum::Error>> {
    tokio::time::sleep_until(not_before).await;
    socket.recv().await
}
