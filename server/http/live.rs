//! The WebSocket: newest state out, commands in.

use std::sync::Arc;

use axum::extract::ws::Utf8Bytes;
use axum::extract::ws::{CloseFrame, Message, WebSocket, WebSocketUpgrade};
use axum::extract::{Path, State};
use axum::response::{IntoResponse, Response};
use futures_util::SinkExt;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::watch;

use super::Server;
use super::hub::{Encoded, Hub, json};
use super::problem::Problem;
use crate::protocol::{ClientMessage, ErrorMessage, EventMessage, ServerMessage};
use crate::scenario::ControllerName;
use crate::session::Command;
use crate::trial::Input;

/// Largest message from a browser.
const MESSAGE_LIMIT: usize = 64 * 1024;
/// Code 1001 of RFC 6455: the server goes away.
const GOING_AWAY: u16 = 1001;

pub async fn live(
    State(server): State<Arc<Server>>,
    Path(id): Path<String>,
    upgrade: Result<WebSocketUpgrade, axum::extract::ws::rejection::WebSocketUpgradeRejection>,
) -> Response {
    let Some(hub) = server.find(&id) else { return Problem::not_found("session", &id).into_response() };
    match upgrade {
        Err(rejection) => Problem::new(rejection.status(), "websocket", rejection.body_text()).into_response(),
        Ok(upgrade) => upgrade.max_message_size(MESSAGE_LIMIT).on_upgrade(move |socket| async move {
            let mut connection = Connection { own: hub.join(), hub: hub.clone(), socket, dragging: false };
            let mut stopping = server.stopping.clone();
            // The browser may be gone at any await; the reason is of no use to anybody.
            let _ = connection.run(&mut stopping).await;
            connection.leave().await;
        }),
    }
}

struct Connection {
    own: u64,
    hub: Arc<Hub>,
    socket: WebSocket,
    /// Whether this browser's hand holds the bead.
    dragging: bool,
}

/// What of the newest messages this browser has.
#[derive(Default)]
struct Sent {
    scene_version: u64,
    sight_version: u64,
    seen_version: u64,
}

impl Connection {
    async fn run(&mut self, stopping: &mut watch::Receiver<bool>) -> Result<(), axum::Error> {
        let mut encoded = self.hub.encoded();
        let mut seats = self.hub.seats();
        let mut events = self.hub.session.events();
        let mut comparison = self.hub.comparison();
        let mut closing = self.hub.closing();
        let mut sent = Sent::default();
        let now = *seats.borrow_and_update();
        self.say(&ServerMessage::Hello(self.hub.hello(self.own, &now))).await?;
        let first = encoded.borrow_and_update().clone();
        self.send_newest(&first, &mut sent).await?;
        self.tell_the_past(&mut comparison).await?;
        loop {
            tokio::select! {
                changed = encoded.changed() => {
                    if changed.is_err() {
                        return self.close("the session has ended").await;
                    }
                    let newest = encoded.borrow_and_update().clone();
                    self.send_newest(&newest, &mut sent).await?;
                }
                event = events.recv() => match event {
                    Ok(event) => self.say(&ServerMessage::Event(EventMessage::from(&event))).await?,
                    // Too slow for each of them; the newest follow.
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
                    self.say(&ServerMessage::Hello(self.hub.hello(self.own, &now))).await?;
                }
                message = self.socket.recv() => match message {
                    Some(Ok(Message::Text(text))) => self.hear(&text).await?,
                    Some(Ok(Message::Binary(_))) => {
                        let message = "binary messages are not understood".to_owned();
                        self.say(&ServerMessage::Error(ErrorMessage { code: "malformed".into(), message, field: None })).await?;
                    }
                    Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                    Some(Ok(Message::Close(_)) | Err(_)) | None => return Ok(()),
                },
                () = async { drop(stopping.wait_for(|&stop| stop).await) } => return self.close("the server stops").await,
                () = async { drop(closing.wait_for(|&closed| closed).await) } => return self.close("the session was deleted").await,
            }
        }
    }

    async fn send_newest(&mut self, newest: &Encoded, sent: &mut Sent) -> Result<(), axum::Error> {
        if sent.scene_version != newest.scene_version {
            sent.scene_version = newest.scene_version;
            self.socket.feed(Message::Text(newest.scene.clone())).await?;
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

    /// What happened before this browser came.
    async fn tell_the_past(&mut self, comparison: &mut watch::Receiver<Utf8Bytes>) -> Result<(), axum::Error> {
        let journal = self.hub.session.watch().borrow().journal.clone();
        for event in journal.iter() {
            self.socket.feed(Message::Text(json(&ServerMessage::Event(EventMessage::from(event))))).await?;
        }
        let compared = comparison.borrow_and_update().clone();
        if !compared.is_empty() {
            self.socket.feed(Message::Text(compared)).await?;
        }
        self.socket.flush().await
    }

    async fn hear(&mut self, text: &str) -> Result<(), axum::Error> {
        let message = match ClientMessage::parse(text) {
            Ok(message) => message,
            Err(error) => return self.say(&ServerMessage::Error(error)).await,
        };
        match message {
            ClientMessage::TakeControl {} => self.hub.take(self.own),
            ClientMessage::ReleaseControl {} => {
                self.let_go().await;
                self.hub.release(self.own);
            }
            message => {
                if self.hub.seats().borrow().operator != Some(self.own) {
                    let error = ErrorMessage {
                        code: "not_operator".into(),
                        message: "another browser has control; take control first".into(),
                        field: None,
                    };
                    return self.say(&ServerMessage::Error(error)).await;
                }
                let dragging = match message {
                    ClientMessage::Drag { .. } => true,
                    ClientMessage::Release {} => false,
                    _ => self.dragging,
                };
                let done = match message {
                    ClientMessage::Fork { tick, controllers } => {
                        let mut asked = ControllerName::ALL.to_vec();
                        asked.retain(|name| controllers.is_empty() || controllers.contains(name));
                        self.hub.fork(tick, asked).await
                    }
                    message => match message.command() {
                        Some(command) => self.hub.session.send(command).await,
                        None => Ok(()),
                    },
                };
                match done {
                    Ok(()) => self.dragging = dragging,
                    Err(error) => return self.say(&ServerMessage::Error(ErrorMessage::from(&error))).await,
                }
            }
        }
        Ok(())
    }

    async fn say(&mut self, message: &ServerMessage) -> Result<(), axum::Error> {
        self.socket.send(Message::Text(json(message))).await
    }

    async fn close(&mut self, reason: &'static str) -> Result<(), axum::Error> {
        self.socket.send(Message::Close(Some(CloseFrame { code: GOING_AWAY, reason: reason.into() }))).await
    }

    /// A hand that is gone lets go.
    async fn let_go(&mut self) {
        if std::mem::take(&mut self.dragging) {
            // The session may have ended, and with it the hand.
            let _ = self.hub.session.send(Command::Input(Input::Release)).await;
        }
    }

    async fn leave(mut self) {
        self.let_go().await;
        self.hub.release(self.own);
        // The last browser of a deleted session joins its thread, which blocks.
        tokio::task::spawn_blocking(move || drop(self.hub));
    }
}
