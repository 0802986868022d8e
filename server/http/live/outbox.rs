//! What one browser has received.

use tokio::sync::{broadcast, watch};

use super::course::Reach;
use super::encoded::Encoded;
use super::hub::Hub;
use ferry_core::trial::Event;

/// Where the messages to the browser come from, and the versions of the newest ones that it has received.
pub struct Outbox {
    pub encoded: watch::Receiver<Encoded>,
    pub events: broadcast::Receiver<Event>,
    pub scene_version: u64,
    pub past_version: u64,
    pub sight_version: u64,
    pub seen_version: u64,
    pub course: Reach,
}

impl Outbox {
    pub fn new(hub: &Hub) -> Self {
        Self {
            encoded: hub.encoded(),
            events: hub.session.events(),
            scene_version: 0,
            past_version: 0,
            sight_version: 0,
            seen_version: 0,
            course: Reach::default(),
        }
    }
}
