//! The programs of a server, by name, and their connections.

use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::Message;
use axum::http::StatusCode;

use super::problem::Problem;
use super::sessions::is_name;
use super::socket::{Incoming, Limits, Socket};
use crate::protocol::{Conversation, Outgoing};
use ferry_core::scenario::ControllerName;
use ferry_lab::changes::Changes;
use ferry_lab::program::{Connection, Program};

pub const LIMITS: Limits = Limits { message_bytes: 16 << 10, ping_every: Duration::from_secs(5) };
/// Programs whose names are kept; those that have disconnected make room for others.
const PROGRAMS_MOST: usize = 32;
#[derive(Default)]
pub struct Programs {
    all: RwLock<BTreeMap<String, Arc<Program>>>,
    pub changes: Changes,
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
            let own = ControllerName::ALL.map(ControllerName::as_str).join(", ");
            let detail = format!(
                "{name:?} cannot be the name of a program: use 1 to 32 of a to z, 0 to 9 and -; {own} are Ferry's own"
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
        let program =
            all.entry(name.to_owned()).or_insert_with(|| Arc::new(Program::new(name, self.changes.clone()))).clone();
        let Some(connection) = program.connect() else {
            let detail = format!("a program with the name {name:?} is connected already; use another name");
            return Err(Problem::new(StatusCode::CONFLICT, "taken", detail).field("name"));
        };
        Ok(Link { program, connection })
    }
}

/// The connection of a program.
pub struct Link {
    program: Arc<Program>,
    connection: Connection,
}

impl Drop for Link {
    fn drop(&mut self) {
        self.program.disconnect();
    }
}

/// Asks and takes answers until the program disconnects or the server stops.
pub async fn serve(mut link: Link, mut socket: Socket) -> Result<(), axum::Error> {
    let mut conversation = Conversation::new(&link.program.name);
    send(&mut socket, conversation.hello()).await?;
    loop {
        tokio::select! {
            sent = link.connection.next() => {
                let Some(sent) = sent else { return Ok(()) };
                for message in conversation.tell(sent) {
                    send(&mut socket, message).await?;
                }
            }
            message = socket.next() => {
                let refused = match message? {
                    Some(Incoming::Text(text)) => conversation.take(&text).err(),
                    Some(Incoming::Binary) => Some(Conversation::malformed("binary messages are not understood")),
                    None => return Ok(()),
                };
                if let Some(error) = refused {
                    send(&mut socket, Outgoing::error(error)).await?;
                }
            }
        }
    }
}

async fn send(socket: &mut Socket, message: Outgoing) -> Result<(), axum::Error> {
    socket
        .send(match message {
            Outgoing::Text(text) => Message::text(text),
            Outgoing::Image(pixels) => Message::Binary(Bytes::from(pixels)),
        })
        .await
}
