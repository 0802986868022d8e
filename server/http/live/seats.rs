//! Which browser of a session is the operator. Pure: the time is an argument.

#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use tokio::time::Instant;

/// Maximum number of browsers per session.
const VIEWERS: usize = 128;
/// An operator who does nothing for this long after a request for control loses the seat.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);
/// An operator who keeps control is not asked again for this long.
const KEEP_FOR: Duration = Duration::from_secs(60);
/// The seat of a visitor whose page is gone is kept this long: the page may be loading again.
const RETURN_WITHIN: Duration = Duration::from_secs(5);

/// A connection, and what it says about its browser.
#[derive(Clone, Debug)]
pub struct Guest {
    /// Of the page; the same when it connects again.
    pub key: String,
    /// From the cookie; `None` for a program.
    pub visitor: Option<Arc<str>>,
}

impl Guest {
    fn is(&self, other: &Self) -> bool {
        self.key == other.key || self.visitor.is_some() && self.visitor == other.visitor
    }
}

/// The operator's seat is a lease: it passes on when its holder leaves, releases control, or does not answer a request. The
/// holder may keep it, which ends all requests. Requests are answered in their order.
#[derive(Clone, Debug)]
pub struct Seats {
    /// Connection of the operator.
    pub operator: Option<u64>,
    /// Incremented when another connection becomes the operator; commands with an older epoch are refused.
    pub epoch: u64,
    /// Connections that request control; the first is next.
    pub asking: VecDeque<u64>,
    /// All connections.
    guests: Vec<(u64, Guest)>,
    next: u64,
    /// Whose seat it was, and when that connection was lost.
    away: Option<(Guest, Instant)>,
    /// Since when no connection is the operator.
    free: Option<Instant>,
    /// No connection can join any more.
    is_closed: bool,
    /// Time of the operator's last command, or of the start of the lease.
    commanded: Instant,
    /// When the first request became the first.
    asked: Instant,
    /// When the operator kept control, if a request came since the start of the lease.
    kept: Option<Instant>,
}

/// The operator has kept control, and is asked again only after this time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptFor(pub Duration);

/// Why a connection cannot join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSeat {
    /// There are as many browsers as a session may have.
    Full,
    /// The session is ending.
    Closed,
}

impl Seats {
    pub fn new(now: Instant) -> Self {
        Self {
            operator: None,
            epoch: 0,
            asking: VecDeque::new(),
            guests: Vec::new(),
            next: 0,
            away: None,
            free: Some(now),
            is_closed: false,
            commanded: now,
            asked: now,
            kept: None,
        }
    }

    /// Number of browsers.
    pub fn viewers(&self) -> usize {
        self.guests.len()
    }

    fn guest(&self, connection: u64) -> Option<&Guest> {
        self.guests.iter().find(|(own, _)| *own == connection).map(|(_, guest)| guest)
    }

    fn seat(&mut self, operator: Option<u64>, now: Instant) {
        self.asking.retain(|asks| Some(*asks) != operator);
        self.free = operator.is_none().then_some(now);
        self.operator = operator;
        self.epoch += 1;
        (self.commanded, self.asked) = (now, now);
        (self.kept, self.away) = (None, None);
    }

    fn pass_on(&mut self, now: Instant) {
        let next = self.asking.pop_front();
        self.seat(next, now);
    }

    fn ask(&mut self, connection: u64, now: Instant) {
        if self.asking.is_empty() {
            self.asked = now;
        }
        self.asking.push_back(connection);
    }

    /// Whether the seat is taken, or kept for a visitor whose page may be loading again.
    pub fn is_held(&self) -> bool {
        self.operator.is_some() || self.away.is_some()
    }

    /// Whether a visitor has the seat, or it is free.
    pub fn is_open_to(&self, visitor: Option<&Arc<str>>) -> bool {
        let away = self.away.as_ref().map(|(guest, _)| guest);
        let holder = self.operator.map_or(away, |operator| self.guest(operator));
        holder.is_none_or(|holder| visitor.is_some() && holder.visitor.as_ref() == visitor)
    }

    /// Adds a connection; it becomes the operator if the seat is free or was its own. If the seat is kept for a visitor who
    /// has just left, it is the next.
    ///
    /// # Errors
    /// [`NoSeat`].
    pub fn join(&mut self, guest: Guest, now: Instant) -> Result<u64, NoSeat> {
        if self.is_closed {
            return Err(NoSeat::Closed);
        }
        if self.guests.len() == VIEWERS {
            return Err(NoSeat::Full);
        }
        self.settle(now);
        self.next += 1;
        let own = self.next;
        let is_again = self.operator.and_then(|operator| self.guest(operator)).is_some_and(|old| old.key == guest.key);
        let is_kept = self.away.as_ref().is_some_and(|(away, _)| !away.is(&guest));
        self.guests.push((own, guest));
        if is_kept {
            self.ask(own, now);
        } else if self.operator.is_none() || is_again {
            // The lease goes on: a pending request keeps its time, and the next one waits as long as before.
            let (asked, kept) = (self.asked, self.kept);
            self.seat(Some(own), now);
            (self.asked, self.kept) = (asked, kept);
        }
        Ok(own)
    }

    /// Removes a connection. A visitor's seat is kept for a moment.
    pub fn leave(&mut self, connection: u64, now: Instant) {
        let guest = self.guest(connection).cloned();
        self.guests.retain(|(own, _)| *own != connection);
        match guest.filter(|guest| guest.visitor.is_some() && self.operator == Some(connection)) {
            Some(guest) => {
                (self.operator, self.free) = (None, Some(now));
                self.away = Some((guest, now));
            }
            None => self.release(connection, now),
        }
    }

    /// A connection releases control or withdraws its request; the next request then takes over.
    pub fn release(&mut self, connection: u64, now: Instant) {
        if self.asking.front() == Some(&connection) {
            self.asked = now;
        }
        self.asking.retain(|asks| *asks != connection);
        if self.operator == Some(connection) {
            self.pass_on(now);
        }
    }

    /// Takes the operator's seat if it is free, else requests it from its holder.
    ///
    /// # Errors
    /// The holder has just kept it.
    pub fn take(&mut self, connection: u64, now: Instant) -> Result<(), KeptFor> {
        self.settle(now);
        let away = self.away.as_ref().map(|(away, _)| away);
        let is_own = self.guest(connection).zip(away).is_none_or(|(guest, away)| guest.is(away));
        if self.operator == Some(connection) || self.asking.contains(&connection) {
            return Ok(());
        }
        if self.operator.is_none() && is_own {
            self.seat(Some(connection), now);
            return Ok(());
        }
        let since = self.kept.map(|kept| now.saturating_duration_since(kept));
        if let Some(left) = since.and_then(|since| KEEP_FOR.checked_sub(since)) {
            return Err(KeptFor(left));
        }
        self.ask(connection, now);
        Ok(())
    }

    /// The operator keeps control, which ends all requests.
    pub fn keep(&mut self, now: Instant) {
        if !self.asking.is_empty() {
            self.asking.clear();
            self.kept = Some(now);
        }
    }

    /// Time until control passes on if the operator does nothing; `None` without a request.
    pub fn answers_within(&self, now: Instant) -> Option<Duration> {
        let until = match &self.away {
            Some((_, since)) => *since + RETURN_WITHIN,
            None => self.asked.max(self.commanded) + ANSWER_WITHIN,
        };
        (!self.asking.is_empty()).then(|| until.saturating_duration_since(now))
    }

    /// Notes a command of the operator.
    pub fn command(&mut self, now: Instant) {
        self.commanded = now;
    }

    /// Passes the seat on if its holder has not answered the first request, or has not come back.
    pub fn settle(&mut self, now: Instant) {
        let is_gone =
            self.away.as_ref().is_some_and(|(_, since)| now.saturating_duration_since(*since) >= RETURN_WITHIN);
        if is_gone {
            let free = self.free;
            self.pass_on(now);
            self.free = self.operator.map_or(free, |_| None);
        } else if self.answers_within(now) == Some(Duration::ZERO) {
            self.pass_on(now);
        }
    }

    /// Time without an operator.
    pub fn unsteered_for(&self, now: Instant) -> Duration {
        self.free.map_or(Duration::ZERO, |since| now.saturating_duration_since(since))
    }

    /// Lets no connection join any more, if there has been no operator for this long. Returns whether that is so.
    pub fn close_if_unsteered(&mut self, least: Duration, now: Instant) -> bool {
        self.is_closed |= self.operator.is_none() && self.unsteered_for(now) >= least;
        self.is_closed
    }
}
