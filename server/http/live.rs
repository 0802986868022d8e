//! The WebSocket: sends the newest state, receives commands.

mod catalog;
mod comparison;
mod course;
mod encoded;
mod frames;
mod hand;
mod hub;
mod outbox;
mod seat;
mod seats;

use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::extract::ws::Message;
use axum::http::HeaderMap;
use axum::response::Response;
use futures_util::future::BoxFuture;
use futures_util::stream::FuturesUnordered;
use futures_util::{FutureExt, StreamExt};
use serde::Deserialize;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::{oneshot, watch};
use tokio::time::Instant;
use utoipa::IntoParams;

use self::catalog::Feed;
pub use self::catalog::{Lists, keep as keep_lists};
pub use self::comparison::{Comparison, Comparisons};
pub use self::encoded::Encoded;
use self::frames::json;
use self::hand::Hand;
pub use self::hub::{CameraWatch, Hub};
use self::outbox::Outbox;
use self::seat::Seat;
use self::seats::{Guest, Seats};
use super::Server;
use super::path::{Path, Query, SessionPath};
use super::problem::Problem;
use super::refusals::{Malformed, NotFound, NotUpgraded, Unavailable};
use super::socket::{Incoming, Limits, Socket, Upgrade};
use crate::protocol::{ClientMessage, DoneMessage, Envelope, EventMessage, MAX_MESSAGE_BYTES, Refusal, ServerMessage};
use crate::session::CommandError;
use ferry_core::facts::RefusalCode;
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
///
/// The same head with 3 is a part of the course, where tool and bead were. It replaces all that the browser has from that
/// tick on. All numbers are little-endian: u32 ticks between two points, u32 tick of the first point; then for each of the
/// points f32 x of the tool, then all y, x and y of the bead, in metres; then one byte each for the active sub-controller (1
/// or 2), and one for sub-controller 2, counted in the order of `ControllerName`. It comes first whole, and then before a
/// state, if ticks were left out since the state before.
#[utoipa::path(get, path = "/api/sessions/{id}/live", tag = "sessions", params(SessionPath, LiveQuery),
    responses((status = 101, description = "The connection is a WebSocket from here on."), Malformed, NotFound, NotUpgraded, Unavailable))]
pub async fn live(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    Query(LiveQuery { seat }): Query<LiveQuery>,
    headers: HeaderMap,
    upgrade: Result<Upgrade, Problem>,
) -> Result<Response, Problem> {
    let hub = server.sessions.find(&id).ok_or_else(|| Problem::not_found("session", &id))?;
    let upgrade = upgrade?;
    let seat =
        Seat::take(&hub, Guest { key: seat::key(seat)?, visitor: server.visitors.of(&headers).map(|one| one.id) })?;
    let large = server.large_seats.clone().try_acquire_owned();
    let limits = if large.is_ok() { LIMITS } else { SMALL };
    let serving = server.clone();
    Ok(upgrade.serve(&server, limits, move |socket| async move {
        let served = Connection::new(seat, hub, serving, socket, limits.message_bytes).serve().await;
        drop(large);
        served
    }))
}

struct Connection {
    seat: Seat,
    hub: Arc<Hub>,
    server: Arc<Server>,
    socket: Socket,
    /// Largest message from the browser.
    message_bytes: usize,
    hand: Arc<Hand>,
    catalog: Feed,
    /// Answers of `step` commands, with the ids of their messages. The connection does not wait for them: it goes on sending
    /// states, and reads `pause`.
    stepping: FuturesUnordered<BoxFuture<'static, Stepped>>,
}

/// The id of a `step`, and how it ended.
type Stepped = (Option<u64>, Result<(), CommandError>);

/// How a message was taken.
enum Taken {
    Done,
    /// It is done when its ticks are.
    Step(oneshot::Receiver<Result<(), CommandError>>),
}

impl Connection {
    fn new(seat: Seat, hub: Arc<Hub>, server: Arc<Server>, socket: Socket, message_bytes: usize) -> Self {
        let hand = Hand::new(seat.own, hub.clone());
        let catalog = Feed::new(&server);
        Self { seat, hub, server, socket, message_bytes, hand, catalog, stepping: FuturesUnordered::new() }
    }

    async fn serve(mut self) -> Result<(), axum::Error> {
        let watching = tokio::spawn(self.hand.clone().watch());
        let ended = self.run().await;
        watching.abort();
        self.hand.release().await;
        ended
    }

    async fn run(&mut self) -> Result<(), axum::Error> {
        let mut seats = self.hub.seats();
        let mut comparison = self.hub.comparison();
        let mut closing = self.hub.closing();
        let mut out = Outbox::new(&self.hub);
        let mut goes_on = true;
        let hand = self.hand.clone();
        let now = seats.borrow_and_update().clone();
        self.greet(&now).await?;
        out.past_version = out.encoded.borrow().past_version;
        self.send_newest(&mut out).await?;
        self.send_history(&mut comparison).await?;
        self.send_catalog().await?;
        loop {
            tokio::select! {
                changed = out.encoded.changed(), if goes_on => {
                    // An ended session is still shown, with the reason.
                    goes_on = changed.is_ok();
                    self.send_newest(&mut out).await?;
                }
                event = out.events.recv() => match event {
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
                    let now = seats.borrow_and_update().clone();
                    if now.operator != Some(self.seat.own) {
                        self.hand.release().await;
                    }
                    self.greet(&now).await?;
                }
                () = self.catalog.changed() => self.send_catalog().await?,
                message = self.socket.next() => match message? {
                    Some(Incoming::Text(text)) => self.handle(&text, &mut out).await?,
                    Some(Incoming::Binary) => {
                        let refusal = Refusal::new(RefusalCode::Malformed, "binary messages are not understood", None);
                        self.refuse(None, refusal).await?;
                    }
                    None => return Ok(()),
                },
                Some((id, stepped)) = self.stepping.next() => self.answer(id, stepped.map_err(Refusal::from), &mut out).await?,
                () = hand.silenced.notified() => {
                    let message = format!("no message from the page that holds the bead for {} s: the bead was released and the session paused", hand::SILENCE.as_secs());
                    self.refuse(None, Refusal::new(RefusalCode::HandSilent, &message, None)).await?;
                }
                () = async { drop(closing.wait_for(|&closed| closed).await) } => return self.socket.close("the session was closed").await,
            }
        }
    }

    async fn greet(&mut self, seats: &Seats) -> Result<(), axum::Error> {
        let hello = self.hub.hello(self.seat.own, &self.seat.key, seats, self.message_bytes);
        self.send_message(&ServerMessage::Hello(hello)).await
    }

    async fn send_newest(&mut self, out: &mut Outbox) -> Result<(), axum::Error> {
        let newest = out.encoded.borrow_and_update().clone();
        if out.scene_version != newest.scene_version {
            out.scene_version = newest.scene_version;
            self.socket.feed(Message::Text(newest.scene)).await?;
            if out.past_version != newest.past_version {
                out.past_version = newest.past_version;
                self.send_events(true).await?;
            }
        }
        if let Some(part) = newest.course.next_for(&mut out.course) {
            self.socket.feed(Message::Binary(part)).await?;
        }
        self.socket.feed(Message::Text(newest.state)).await?;
        if out.sight_version != newest.sight_version {
            out.sight_version = newest.sight_version;
            self.socket.feed(Message::Text(newest.overlay)).await?;
            if out.seen_version != newest.seen_version {
                out.seen_version = newest.seen_version;
                self.socket.feed(Message::Text(newest.seen)).await?;
            }
            self.socket.feed(Message::Binary(newest.camera)).await?;
            self.socket.feed(Message::Binary(newest.observation)).await?;
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

    async fn handle(&mut self, text: &str, out: &mut Outbox) -> Result<(), axum::Error> {
        let (Envelope { id, epoch }, message) = ClientMessage::parse_with_envelope(text);
        let taken = match message {
            Ok(message) => self.take(message, epoch).await,
            Err(error) => Err(Refusal::new(RefusalCode::Malformed, &error.message, error.field.as_deref())),
        };
        // A command that waited for the end of a `step` is answered after it.
        while let Some(Some((id, stepped))) = self.stepping.next().now_or_never() {
            self.answer(id, stepped.map_err(Refusal::from), out).await?;
        }
        self.send_catalog().await?;
        match taken {
            Ok(Taken::Done) => self.answer(id, Ok(()), out).await,
            Ok(Taken::Step(stepped)) => {
                let ended = async move { (id, stepped.await.unwrap_or(Err(CommandError::Ended))) };
                self.stepping.push(Box::pin(ended));
                Ok(())
            }
            Err(refusal) => self.answer(id, Err(refusal), out).await,
        }
    }

    /// Answers a message, after all that shows its effect.
    async fn answer(
        &mut self,
        id: Option<u64>,
        taken: Result<(), Refusal>,
        out: &mut Outbox,
    ) -> Result<(), axum::Error> {
        let id = match (taken, id) {
            (Err(refusal), id) => return self.refuse(id, refusal).await,
            (Ok(()), None) => return Ok(()),
            (Ok(()), Some(id)) => id,
        };
        let view = self.hub.session.watch().borrow().clone();
        // A session that has ended is no longer encoded.
        if out.encoded.wait_for(|encoded| encoded.view >= view.number).await.is_ok() {
            self.send_newest(out).await?;
        }
        while let Ok(event) = out.events.try_recv() {
            self.send_message(&ServerMessage::Event(EventMessage::from(&event))).await?;
        }
        self.send_message(&ServerMessage::Done(DoneMessage { id, trial: view.scenery.trial })).await
    }

    async fn take(&mut self, message: ClientMessage, epoch: Option<u64>) -> Result<Taken, Refusal> {
        let own = self.seat.own;
        match message {
            ClientMessage::TakeControl {} => self.hub.reseat(|seats, now| seats.take(own, now))?,
            ClientMessage::WatchTraining { training } => self.catalog.watch(&self.server, training)?,
            ClientMessage::ReleaseControl {} => {
                self.hand.release().await;
                self.hub.reseat(|seats, now| seats.release(own, now));
            }
            message => {
                let seats = self.hub.seats().borrow().clone();
                if seats.operator != Some(own) {
                    let text = "another browser has control; take control first";
                    return Err(Refusal::new(RefusalCode::NotOperator, text, None));
                }
                if let Some(meant) = epoch.filter(|&epoch| epoch != seats.epoch) {
                    let text = format!("epoch is {meant}, but another browser took control; it is now {}", seats.epoch);
                    return Err(Refusal::new(RefusalCode::StaleEpoch, &text, Some("epoch")));
                }
                let taken = self.obey(message).await?;
                self.hub.reseat(Seats::command);
                return Ok(taken);
            }
        }
        Ok(Taken::Done)
    }

    async fn obey(&mut self, message: ClientMessage) -> Result<Taken, CommandError> {
        let holds = match message {
            ClientMessage::Drag { .. } => Some(true),
            ClientMessage::Release {} => Some(false),
            _ => None,
        };
        match message {
            ClientMessage::KeepControl {} => {
                self.hub.reseat(Seats::keep);
                return Ok(Taken::Done);
            }
            ClientMessage::Compare { tick, controllers } => {
                self.server.comparisons.start(&self.hub, tick, &controllers).await?;
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
                return Ok(Taken::Done);
            }
            message => match message.command() {
                Some(command @ Command::Step(_)) => {
                    let stepped = self.hub.session.begin(command)?;
                    self.hand.commanded(holds);
                    return Ok(Taken::Step(stepped));
                }
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
        Ok(Taken::Done)
    }

    async fn refuse(&mut self, id: Option<u64>, refusal: Refusal) -> Result<(), axum::Error> {
        self.send_message(&match id {
            Some(id) => ServerMessage::Refused(refusal.of(id)),
            None => ServerMessage::Error(refusal.into()),
        })
        .await
    }

    async fn send_message(&mut self, message: &ServerMessage) -> Result<(), axum::Error> {
        self.socket.send(Message::Text(json(message))).await
    }
}
