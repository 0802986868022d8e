//! The attempt at a challenge in a session.

use std::sync::Arc;

use crate::challenge::{Attempt, Challenge, Referee, Score, TICKS_MOST, Trace};

/// Why an attempt does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Void {
    #[error("it was paused")]
    Paused,
    #[error("another speed was chosen")]
    Speed,
    #[error("it was rewound")]
    Rewound,
    #[error("something else than the magnet was moved or set")]
    OtherInput,
}

/// How an attempt ended.
#[derive(Clone, Debug)]
pub enum Ended {
    Delivered(Arc<Attempt>),
    /// Not delivered within the time limit.
    TimeUp,
}

/// A challenge that is being played.
#[derive(Clone, Debug)]
pub(super) struct Playing {
    pub(super) challenge: Arc<Challenge>,
    pub(super) referee: Referee,
    pub(super) ended: Option<Ended>,
    pub(super) void: Option<Void>,
}

/// The moving part of an attempt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// The final score, or that of a delivery now.
    pub score: Score,
    pub is_delivered: bool,
    pub is_time_up: bool,
    pub void: Option<Void>,
}

/// Everything about an attempt.
#[derive(Clone, Debug)]
pub struct Played {
    pub challenge: Arc<Challenge>,
    pub trace: Trace,
    /// `None` while it runs.
    pub ended: Option<Ended>,
    pub void: Option<Void>,
}

impl Playing {
    pub(super) fn standing(&self, tick: u64) -> Standing {
        let score = match &self.ended {
            Some(Ended::Delivered(attempt)) => attempt.score,
            Some(Ended::TimeUp) => self.referee.so_far(TICKS_MOST),
            None => self.referee.so_far(tick),
        };
        let is_delivered = matches!(self.ended, Some(Ended::Delivered(_)));
        let is_time_up = matches!(self.ended, Some(Ended::TimeUp));
        Standing { score, is_delivered, is_time_up, void: self.void }
    }
}
