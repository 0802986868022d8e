//! What a controller has refused: shown on the page, and told to clients.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use tokio::sync::watch;
use ts_rs::TS;
use utoipa::ToSchema;

/// What is kept.
const MOST: usize = 20;

/// What was refused, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[schema(as = RobotRefusal)]
#[ts(rename = "RobotRefusal")]
pub struct Refused {
    #[ts(type = "number")]
    pub tick: u64,
    pub what: String,
    pub why: String,
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.what, self.why)
    }
}

#[derive(Clone, Debug, Default)]
pub struct Refusals {
    newest: VecDeque<Refused>,
    /// How many there were so far.
    count: watch::Sender<u64>,
}

impl Refusals {
    pub fn push(&mut self, refused: Refused) {
        if self.newest.len() >= MOST {
            self.newest.pop_front();
        }
        self.newest.push_back(refused);
        self.count.send_modify(|count| *count += 1);
    }

    /// How many there were so far, and a signal at each.
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.count.subscribe()
    }

    /// Those behind the first `count`, oldest first, as far as they are kept.
    pub fn since(&self, count: u64) -> impl Iterator<Item = &Refused> {
        let newer = self.count.borrow().saturating_sub(count) as usize;
        self.newest.iter().skip(self.newest.len().saturating_sub(newer))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_handed_on_once() {
        let mut refusals = Refusals::default();
        let watched = refusals.watch();
        for (count, expected) in [(0, 0), (1, 1), (2, 2), (50, MOST)] {
            let seen = *watched.borrow();
            (0..count)
                .for_each(|_| refusals.push(Refused { tick: 1, what: "movej".to_owned(), why: "far".to_owned() }));
            assert_eq!(refusals.since(seen).count(), expected);
            assert_eq!(refusals.since(*watched.borrow()).count(), 0);
        }
        assert_eq!(refusals.since(0).next().unwrap().to_string(), "movej: far");
    }
}
