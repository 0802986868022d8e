//! A browser's seat.

use std::sync::Arc;

use axum::http::StatusCode;

use super::hub::Hub;
use super::seats::{Guest, KeptFor, NoSeat};
use crate::http::access::Token;
use crate::http::problem::Problem;
use crate::protocol::Refusal;
use ferry_core::facts::RefusalCode;

/// A place among a session's browsers. Dropping it frees the place, also if the upgrade fails.
pub struct Seat {
    pub own: u64,
    /// Known to its browser only.
    pub key: String,
    hub: Arc<Hub>,
}

impl Seat {
    /// # Errors
    /// The session has as many browsers as it can have, or has ended.
    pub fn take(hub: &Arc<Hub>, guest: Guest) -> Result<Self, Problem> {
        let key = guest.key.clone();
        let own = hub.reseat(|seats, now| seats.join(guest, now)).map_err(|why| match why {
            NoSeat::Closed => Problem::not_found("session", &hub.id),
            NoSeat::Full => {
                let detail = format!("session {:?} has {} browsers already", hub.id, hub.viewers());
                Problem::new(StatusCode::SERVICE_UNAVAILABLE, "too_many_viewers", detail)
            }
        })?;
        Ok(Self { own, key, hub: hub.clone() })
    }
}

/// The key of a browser that connects again, otherwise a new one.
pub fn key(known: Option<String>) -> Result<String, Problem> {
    match known {
        Some(key) if key.parse::<Token>().is_ok() => Ok(key),
        Some(_) => {
            let detail = "seat must be left out, or be the `seat` of an earlier hello: 64 hexadecimal digits";
            Err(Problem::new(StatusCode::BAD_REQUEST, "malformed", detail).field("seat"))
        }
        None => Token::generate().map_err(Problem::internal),
    }
}

impl From<KeptFor> for Refusal {
    fn from(KeptFor(left): KeptFor) -> Self {
        let wait_s = left.as_secs() + 1;
        Self::new(RefusalCode::Kept, &format!("the operator keeps control; ask again in {wait_s} s"), None)
            .with("wait_s", wait_s)
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        self.hub.reseat(|seats, now| seats.leave(self.own, now));
    }
}
