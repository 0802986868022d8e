//! A browser's seat.

use std::sync::Arc;

use super::hub::Hub;
use super::seats::Seats;

/// A place among a session's browsers. Dropping it frees the place, also if the upgrade fails.
pub struct Seat {
    pub own: u64,
    /// Known to its browser only.
    pub key: String,
    hub: Arc<Hub>,
}

impl Seat {
    pub fn take(hub: &Arc<Hub>, key: String) -> Option<Self> {
        Some(Self { own: hub.reseat(Seats::join)?, key, hub: hub.clone() })
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        self.hub.reseat(|seats, now| seats.leave(self.own, now));
    }
}
