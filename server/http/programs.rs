//! The programs of a server, by name, and their connections.

use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroU32;
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::{CloseFrame, Message, WebSocket};
use axum::http::StatusCode;
use governor::clock::{Clock, DefaultClock};
use governor::{Quota, RateLimiter};
use tokio::sync::{mpsc, oneshot, watch};
use tokio::time::Instant;

use super::live::receive;
use super::problem::Problem;
use super::sessions::is_name;
use crate::control::transport::program::Answer;
use crate::protocol::{ErrorMessage, ProgramAnswer, ProgramMessage};
use crate::scenario::ControllerName;
use crate::session::programs::{Asked, Leg, Program};

/// Largest message of a program.
pub const MESSAGE_BYTES_MOST: usize = 16 << 10;
/// Programs whose names are kept; those that have disconnected make room for others.
const PROGRAMS_MOST: usize = 32;
/// Further messages are read later.
const MESSAGES_PER_S: NonZeroU32 = NonZeroU32::new(500).unwrap();
const MESSAGES_BURST: NonZeroU32 = NonZeroU32::new(1000).unwrap();
/// Interval of pings, and the silence after which a program is disconnected.
const PING_EVERY: Duration = Duration::from_secs(5);
const SILENCE: Duration = Duration::from_secs(15);
/// Close code 1001 of RFC 6455: the server is going away.
const GOING_AWAY: u16 = 1001;

#[derive(Default)]
pub struct Programs {
    all: RwLock<BTreeMap<String, Arc<Program>>>,
}

impl Programs {
    pub fn all(&self) -> Vec<Arc<Program>> {
        self.all.read().unwrap_or_else(PoisonError::into_inner).values().cloned().collect()
    }

    pub fn find(&self, name: &str) -> Option<Arc<Program>> {
        self.all.read().unwrap_or_else(PoisonError::into_inner).get(name).cloned()
    }

    /// Connects a program; it is disconnected when the link is dropped.
    pub fn connect(&self, name: &str) -> Result<Link, Problem> {
        let is_taken = ControllerName::ALL.iter().any(|own| own.as_str() == name);
        if !is_name(name) || is_taken {
            let detail = format!(
                "{name:?} cannot be the name of a program: use 1 to 32 of a to z, 0 to 9 and -; rl, errt, attractor, replanner, \
                 you and program are Ferry's own"
            );
            return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "bad_name", detail).field("name"));
        }
        let mut all = self.all.write().unwrap_or_else(PoisonError::into_inner);
        if !all.contains_key(name) && all.len() >= PROGRAMS_MOST {
            all.retain(|_, program| program.standing().is_connected);
        }
        if !all.contains_key(name) && all.len() >= PROGRAMS_MOST {
            let detail = format!("{PROGRAMS_MOST} programs are connected already");
            return Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_programs", detail));
        }
        let program = all.entry(name.to_owned()).or_insert_with(|| Arc::new(Program::new(name))).clone();
        let Some(asked) = program.connect() else {
            let detail = format!("a program with the name {name:?} is connected already; use another name");
            return Err(Problem::new(StatusCode::CONFLICT, "taken", detail).field("name"));
        };
        Ok(Link { program, asked })
    }
}

/// The connection of a program.
pub struct Link {
    program: Arc<Program>,
    asked: mpsc::Receiver<Asked>,
}

impl Drop for Link {
    fn drop(&mut self) {
        self.program.disconnect();
    }
}

/// Questions that are not answered yet, oldest first.
type Open = BTreeMap<u64, oneshot::Sender<Answer>>;

/// Asks and takes answers until the program disconnects or the server stops.
pub async fn serve(
    mut link: Link,
    mut socket: WebSocket,
    mut stopping: watch::Receiver<bool>,
) -> Result<(), axum::Error> {
    let name = link.program.name.clone();
    let messages = RateLimiter::direct(Quota::per_second(MESSAGES_PER_S).allow_burst(MESSAGES_BURST));
    let mut ping = tokio::time::interval(PING_EVERY);
    let (mut received, mut read_after) = (Instant::now(), Instant::now());
    let (mut open, mut next) = (Open::new(), 0);
    let mut legs: HashMap<String, Leg> = HashMap::new();
    send(&mut socket, &ProgramMessage::hello(&name)).await?;
    loop {
        tokio::select! {
            asked = link.asked.recv() => {
                let Some(asked) = asked else { return Ok(()) };
                if legs.get(&asked.trial) != Some(&asked.leg) {
                    send(&mut socket, &ProgramMessage::start(&asked.trial, &asked.leg)).await?;
                    legs.insert(asked.trial.clone(), asked.leg.clone());
                }
                next += 1;
                send(&mut socket, &ProgramMessage::observe(next, &asked)).await?;
                socket.send(Message::Binary(Bytes::from(asked.percept.gray.pixels))).await?;
                open.insert(next, asked.answer);
            }
            message = receive(&mut socket, read_after) => {
                let Some(Ok(message)) = message else { return Ok(()) };
                received = Instant::now();
                if let Err(until) = messages.check() {
                    read_after = received + until.wait_time_from(DefaultClock::default().now());
                }
                let refused = match message {
                    Message::Text(text) => take(&text, &name, &mut open).err(),
                    Message::Binary(_) => Some(malformed("binary messages are not understood")),
                    Message::Ping(_) | Message::Pong(_) => None,
                    Message::Close(_) => return Ok(()),
                };
                if let Some(error) = refused {
                    send(&mut socket, &ProgramMessage::Error(error)).await?;
                }
            }
            _ = ping.tick() => {
                if received.elapsed() > SILENCE {
                    return Ok(());
                }
                socket.send(Message::Ping(Bytes::new())).await?;
            }
            () = async { drop(stopping.wait_for(|&stop| stop).await) } => {
                let reason = "the server stops".into();
                return socket.send(Message::Close(Some(CloseFrame { code: GOING_AWAY, reason }))).await;
            }
        }
    }
}

/// Takes an answer. After a message that cannot be used, the arm holds in the step that was asked first.
fn take(text: &str, name: &str, open: &mut Open) -> Result<(), ErrorMessage> {
    // Those whose session has gone on are over.
    open.retain(|_, answer| !answer.is_closed());
    let answer = match ProgramAnswer::parse(text) {
        Ok(answer) => answer,
        Err(error) => {
            if let Some((_, oldest)) = open.pop_first() {
                let mut reason = format!("{name} sent a message that cannot be used: {}", error.message);
                reason.truncate(reason.floor_char_boundary(crate::trial::REASON_BYTES_MOST));
                // The session may have gone on.
                let _ = oldest.send(Answer::Hold { reason });
            }
            return Err(error);
        }
    };
    let request = answer.request();
    let over = || ErrorMessage {
        code: "over".to_owned(),
        message: format!(
            "request is {request}, which is not open: it was never asked, is answered, or its time is over"
        ),
        field: Some("request".to_owned()),
    };
    let asked = open.remove(&request).ok_or_else(over)?;
    asked.send(answer.answer(name)).map_err(|_| over())
}

fn malformed(message: &str) -> ErrorMessage {
    ErrorMessage { code: "malformed".to_owned(), message: message.to_owned(), field: None }
}

async fn send(socket: &mut WebSocket, message: &ProgramMessage) -> Result<(), axum::Error> {
    let text = serde_json::to_string(message).map_err(axum::Error::new)?;
    socket.send(Message::text(text)).await
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn answers_find_their_questions() {
        let mut open = Open::new();
        let mut ask = |request: u64| {
            let (answer, answered) = oneshot::channel();
            open.insert(request, answer);
            answered
        };
        let (mut first, mut second, mut third) = (ask(1), ask(2), ask(3));
        take(r#"{"type":"act","request":2,"target_m":[0.1,-0.3]}"#, "mine", &mut open).unwrap();
        assert_eq!(second.try_recv(), Ok(Answer::Go { target_m: crate::geometry::Point2::new(0.1, -0.3) }));
        take(r#"{"type":"hold","request":1,"reason":"no idea"}"#, "mine", &mut open).unwrap();
        assert_eq!(first.try_recv(), Ok(Answer::Hold { reason: "mine: no idea".to_owned() }));
        for request in [2, 9] {
            let text = format!(r#"{{"type":"act","request":{request},"target_m":[0.1,-0.3]}}"#);
            let error = take(&text, "mine", &mut open).unwrap_err();
            assert_eq!((error.code.as_str(), error.field.as_deref()), ("over", Some("request")));
        }
        let error = take(r#"{"type":"act","request":3,"target_m":[0.1]}"#, "mine", &mut open).unwrap_err();
        assert_eq!(error.field.as_deref(), Some("target_m"), "{error:?}");
        let Ok(Answer::Hold { reason }) = third.try_recv() else { panic!("the arm holds") };
        assert!(reason.starts_with("mine sent a message that cannot be used: target_m: invalid length 1"), "{reason}");
        assert!(take(r#"{"type":"act","request":3,"target_m":[NaN,0]}"#, "mine", &mut open).is_err());
    }

    #[test]
    fn a_hundred_thousand_damaged_messages_do_no_harm() {
        let whole = [
            r#"{"type":"act","request":1,"target_m":[0.1,-0.3]}"#,
            r#"{"type":"hold","request":1,"reason":"it thinks"}"#,
            r#"{"type":"act","request":18446744073709551615,"target_m":[1e308,-1e308]}"#,
            "[[[[[[[[",
            "",
        ];
        let parts =
            ["{", "}", "[", "]", "\"", ":", ",", "NaN", "null", "-", "1e999", "é", "\u{0}", "type", "act", "\\ud800"];
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let (mut taken, mut refused) = (0, 0);
        for _ in 0..100_000 {
            let mut text = whole[rng.random_range(0..whole.len())].to_owned();
            for _ in 0..rng.random_range(0..4) {
                let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
                let at = places[rng.random_range(0..places.len())];
                if rng.random() {
                    text.insert_str(at, parts[rng.random_range(0..parts.len())]);
                } else {
                    text.truncate(at);
                }
            }
            let (answer, mut answered) = oneshot::channel();
            let mut open = Open::from([(1, answer)]);
            match take(&text, "mine", &mut open) {
                Ok(()) => taken += 1,
                Err(error) => {
                    assert!(!error.message.is_empty());
                    refused += 1;
                }
            }
            // Either it is answered, or the session's own time ends it.
            if let Ok(Answer::Hold { reason }) = answered.try_recv() {
                assert!(reason.starts_with("mine"), "{reason}");
            }
        }
        assert!(taken > 10_000 && refused > 10_000, "{taken} {refused}");
    }
}
