//! The WebSocket: sends the newest state, receives commands.

mod comparison;
mod hand;
mod hub;
mod seats;

use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::extract::ws::Message;
use axum::http::StatusCode;
use axum::response::Response;
use futures_util::StreamExt;
use futures_util::stream::FuturesUnordered;
use serde::Deserialize;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::{oneshot, watch};
use tokio::time::Instant;
use utoipa::IntoParams;

use self::hand::Hand;
use self::hub::json;
pub use self::hub::{CameraWatch, Encoded, Hub};
use self::seats::Seats;
use super::Server;
use super::access::Token;
use super::path::{Path, Query, SessionPath};
use super::problem::Problem;
use super::refusals::{Malformed, NotFound, NotUpgraded, Unavailable};
use super::socket::{Incoming, Limits, Socket, Upgrade};
use crate::protocol::{ClientMessage, ErrorMessage, EventMessage, MAX_MESSAGE_BYTES, ServerMessage};
use crate::session::CommandError;
use ferry_core::scenario::ControllerName;
use ferry_core::session::Command;
use ferry_core::trial::Case;

const LIMITS: Limits = Limits { message_bytes: MAX_MESSAGE_BYTES, ping_every: Duration::from_secs(15) };
/// Of a browser that joins when [`LARGE_SEATS`] are taken: room for everything but test cases.
const SMALL: Limits = Limits { message_bytes: 64 << 10, ..LIMITS };
/// Browsers that may send test cases.
pub const LARGE_SEATS: usize = 8;

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub struct LiveQuery {
    /// `seat` of the `hello` that this browser got when it connected before. The attempt at a challenge that it began
    /// stays its own.
    seat: Option<String>,
}

/// The WebSocket of a session.
///
/// Text frames are `ClientMessage` from the browser and `ServerMessage` from the server, JSON both. Binary frames carry
/// pictures: one byte 1 (the camera's, a JPEG file) or 2 (the observation, 2 × 84 × 84 bytes), three bytes of zero, the
/// tick as u32 little-endian, then the payload.
#[utoipa::path(get, path = "/api/sessions/{id}/live", tag = "sessions", params(SessionPath, LiveQuery),
    responses((status = 101, description = "The connection is a WebSocket from here on."), Malformed, NotFound, NotUpgraded, Unavailable))]
pub async fn live(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    Query(LiveQuery { seat }): Query<LiveQuery>,
    upgrade: Result<Upgrade, Problem>,
) -> Result<Response, Problem> {
    let hub = server.sessions.find(&id).ok_or_else(|| Problem::not_found("session", &id))?;
    let upgrade = upgrade?;
    let key = match seat {
        Some(key) if key.parse::<Token>().is_ok() => key,
        Some(_) => return Err(refused_seat()),
        None => Token::generate().map_err(Problem::internal)?,
    };
    let seat = Seat::take(&hub, key).ok_or_else(|| {
        let detail = format!("session {id:?} has {} browsers already", hub.viewers());
        Problem::new(StatusCode::SERVICE_UNAVAILABLE, "too_many_viewers", detail)
    })?;
    let large = server.large_seats.clone().try_acquire_owned();
    let limits = if large.is_ok() { LIMITS } else { SMALL };
    let serving = server.clone();
    Ok(upgrade.serve(&server, limits, move |socket| async move {
        let served = Connection::new(seat, hub, serving, socket, limits.message_bytes).serve().await;
        drop(large);
        served
    }))
}

fn refused_seat() -> Problem {
    let detail = "seat must be left out, or be the `seat` of an earlier hello: 64 hexadecimal digits";
    Problem::new(StatusCode::BAD_REQUEST, "malformed", detail).field("seat")
}

/// A place among a session's browsers. Dropping it frees the place, also if the upgrade fails.
struct Seat {
    own: u64,
    /// Known to its browser only.
    key: String,
    hub: Arc<Hub>,
}

impl Seat {
    fn take(hub: &Arc<Hub>, key: String) -> Option<Self> {
        Some(Self { own: hub.reseat(Seats::join)?, key, hub: hub.clone() })
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
    socket: Socket,
    /// Largest message from the browser.
    message_bytes: usize,
    hand: Arc<Hand>,
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
    fn new(seat: Seat, hub: Arc<Hub>, server: Arc<Server>, socket: Socket, message_bytes: usize) -> Self {
        let hand = Hand::new(seat.own, hub.clone());
        Self { seat, hub, server, socket, message_bytes, hand, stepping: FuturesUnordered::new() }
    }

    async fn serve(mut self) -> Result<(), axum::Error> {
        let watching = tokio::spawn(self.hand.clone().watch());
        let ended = self.run().await;
        watching.abort();
        self.hand.release().await;
        ended
    }

    async fn run(&mut self) -> Result<(), axum::Error> {
        let mut encoded = self.hub.encoded();
        let mut seats = self.hub.seats();
        let mut events = self.hub.session.events();
        let mut comparison = self.hub.comparison();
        let mut closing = self.hub.closing();
        let mut sent = Sent::default();
        let mut goes_on = true;
        let hand = self.hand.clone();
        let now = *seats.borrow_and_update();
        self.greet(&now).await?;
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
                    Err(RecvError::Closed) => return self.socket.close("the session has ended").await,
                },
                changed = comparison.changed() => {
                    if changed.is_err() {
                        return self.socket.close("the session has ended").await;
                    }
                    let newest = comparison.borrow_and_update().clone();
                    self.socket.send(Message::Text(newest)).await?;
                }
                changed = seats.changed() => {
                    if changed.is_err() {
                        return self.socket.close("the session has ended").await;
                    }
                    let now = *seats.borrow_and_update();
                    if now.operator != Some(self.seat.own) {
                        self.hand.release().await;
                    }
                    self.greet(&now).await?;
                }
                message = self.socket.next() => match message? {
                    Some(Incoming::Text(text)) => self.handle(&text).await?,
                    Some(Incoming::Binary) => self.refuse("malformed", "binary messages are not understood", None).await?,
                    None => return Ok(()),
                },
                Some(Ok(Err(error))) = self.stepping.next() => {
                    self.send_message(&ServerMessage::Error(ErrorMessage::from(&error))).await?;
                }
                () = hand.silenced.notified() => {
                    let message = format!("no message from the page that holds the bead for {} s: the bead was released and the session paused", hand::SILENCE.as_secs());
                    self.refuse("hand_silent", &message, None).await?;
                }
                () = async { drop(closing.wait_for(|&closed| closed).await) } => return self.socket.close("the session was closed").await,
            }
        }
    }

    async fn greet(&mut self, seats: &Seats) -> Result<(), axum::Error> {
        let hello = self.hub.hello(self.seat.own, &self.seat.key, seats, self.message_bytes);
        self.send_message(&ServerMessage::Hello(hello)).await
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
                let case = Box::new(
                    Case::from_json(case.as_bytes())
                        .map_err(ferry_core::session::CommandError::from)
                        .map_err(CommandError::from)?,
                );
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
                self.hub.session.attach(program).await?;
            }
            ClientMessage::DriveRobot { press } => {
                let twin = self.server.sessions.twin_of(&self.hub.id).ok_or(CommandError::NoRobot)?;
                twin.hold(press, Instant::now().into_std())?;
                // The page's hand on the bead is another matter.
                return Ok(());
            }
            message => match message.command() {
                Some(command @ Command::Step(_)) => self.stepping.push(self.hub.session.begin(command)?),
                Some(command) => {
                    let begins_attempt = matches!(command, Command::Play(_));
                    self.hub.session.send(command).await?;
                    if begins_attempt {
                        self.hub.set_player(&self.seat.key);
                    }
                }
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
}
