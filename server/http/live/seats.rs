//! Which browser of a session is the operator. Pure: the time is an argument.

use std::time::Duration;

use tokio::time::Instant;

/// Maximum number of browsers per session.
const VIEWERS: usize = 128;
/// An operator who does nothing for this long after a request for control loses the seat.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);
/// An operator who keeps control is not asked again for this long.
const KEEP_FOR: Duration = Duration::from_secs(60);

/// The operator's seat is a lease: it passes on when its holder leaves, releases control, or does not answer a request. The
/// holder may keep it, which ends a request.
#[derive(Clone, Copy, Debug)]
pub struct Seats {
    /// Connection of the operator.
    pub operator: Option<u64>,
    /// Incremented when another connection becomes the operator; commands with an older epoch are refused.
    pub epoch: u64,
    /// Connection that last requested control.
    pub asking: Option<u64>,
    /// Number of browsers.
    pub viewers: usize,
    next: u64,
    /// Time of the operator's last command, or of the start of the lease.
    commanded: Instant,
    asked: Instant,
    /// When the operator kept control, if a request came since the start of the lease.
    kept: Option<Instant>,
}

/// The operator has kept control, and is asked again only after this time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptFor(pub Duration);

impl Seats {
    pub fn new(now: Instant) -> Self {
        Self { operator: None, epoch: 0, asking: None, viewers: 0, next: 0, commanded: now, asked: now, kept: None }
    }

    fn seat(&mut self, operator: Option<u64>, now: Instant) {
        self.operator = operator;
        self.epoch += 1;
        self.commanded = now;
        self.kept = None;
    }

    /// Adds a connection, if there is room; it becomes the operator if the seat is free.
    pub fn join(&mut self, now: Instant) -> Option<u64> {
        if self.viewers == VIEWERS {
            return None;
        }
        self.viewers += 1;
        self.next += 1;
        if self.operator.is_none() {
            self.seat(Some(self.next), now);
        }
        Some(self.next)
    }

    /// Removes a connection.
    pub fn leave(&mut self, connection: u64, now: Instant) {
        self.viewers -= 1;
        self.release(connection, now);
    }

    /// A connection releases control or withdraws its request; a pending request then takes over.
    pub fn release(&mut self, connection: u64, now: Instant) {
        if self.asking == Some(connection) {
            self.asking = None;
        }
        if self.operator == Some(connection) {
            let next = self.asking.take();
            self.seat(next, now);
        }
    }

    /// Takes the operator's seat if it is free, else requests it from its holder.
    ///
    /// # Errors
    /// The holder has just kept it.
    pub fn take(&mut self, connection: u64, now: Instant) -> Result<(), KeptFor> {
        match self.operator {
            Some(operator) if operator == connection => {}
            Some(_) if self.asking == Some(connection) => {}
            Some(_) => {
                let since = self.kept.map(|kept| now.saturating_duration_since(kept));
                if let Some(left) = since.and_then(|since| KEEP_FOR.checked_sub(since)) {
                    return Err(KeptFor(left));
                }
                // A new request keeps the start of the wait. Otherwise two browsers that request by turns would wait
                // forever.
                if self.asking.replace(connection).is_none() {
                    self.asked = now;
                }
            }
            None => self.seat(Some(connection), now),
        }
        Ok(())
    }

    /// The operator keeps control, which ends a request.
    pub fn keep(&mut self, now: Instant) {
        if self.asking.take().is_some() {
            self.kept = Some(now);
        }
    }

    /// Time until the operator loses the seat if it does nothing; `None` without a request.
    pub fn answers_within(&self, now: Instant) -> Option<Duration> {
        let waits = now.saturating_duration_since(self.asked.max(self.commanded));
        self.asking.map(|_| ANSWER_WITHIN.saturating_sub(waits))
    }

    /// Notes a command of the operator.
    pub fn command(&mut self, now: Instant) {
        self.commanded = now;
    }

    /// Gives the operator's seat to the requesting client if the operator has not reacted to the request.
    pub fn take_if_unanswered(&mut self, connection: u64, now: Instant) {
        if self.asking == Some(connection) && self.answers_within(now) == Some(Duration::ZERO) {
            self.asking = None;
            self.seat(Some(connection), now);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_browser_operates_and_a_request_is_next() {
        let now = Instant::now();
        let mut seats = Seats::new(now);
        let [one, two, three] = [(); 3].map(|()| seats.join(now).unwrap());
        assert_eq!((seats.operator, seats.epoch), (Some(one), 1));
        seats.take(two, now).unwrap();
        seats.take(three, now).unwrap();
        assert_eq!((seats.operator, seats.asking), (Some(one), Some(three)));
        seats.leave(one, now);
        assert_eq!((seats.operator, seats.asking, seats.epoch), (Some(three), None, 2));
        seats.release(three, now);
        assert_eq!((seats.operator, seats.epoch), (None, 3));
        seats.take(two, now).unwrap();
        assert_eq!((seats.operator, seats.epoch, seats.viewers), (Some(two), 4, 2));
        seats.take(two, now).unwrap();
        assert_eq!(seats.epoch, 4, "the browser has the seat already");
    }

    #[test]
    fn only_an_idle_operator_loses_the_seat() {
        let start = Instant::now();
        let later = |seconds| start + Duration::from_secs(seconds);
        let mut seats = Seats::new(start);
        let [one, two] = [(); 2].map(|()| seats.join(start).unwrap());
        seats.take_if_unanswered(two, later(1000));
        assert_eq!(seats.operator, Some(one), "no other browser requested the seat");
        seats.take(two, later(1000)).unwrap();
        seats.command(later(1020));
        seats.take_if_unanswered(two, later(1049));
        seats.take(two, later(1049)).unwrap();
        seats.take_if_unanswered(one, later(2000));
        assert_eq!(seats.operator, Some(one));
        seats.take_if_unanswered(two, later(1050));
        assert_eq!((seats.operator, seats.asking), (Some(two), None));
    }

    #[test]
    fn alternating_requests_do_not_keep_an_absent_operator() {
        let start = Instant::now();
        let later = |seconds| start + Duration::from_secs(seconds);
        let mut seats = Seats::new(start);
        let [_, two, three] = [(); 3].map(|()| seats.join(start).unwrap());
        seats.take(two, later(100)).unwrap();
        seats.take(three, later(120)).unwrap();
        seats.take_if_unanswered(three, later(129));
        assert_ne!(seats.operator, Some(three));
        seats.take_if_unanswered(three, later(130));
        assert_eq!(seats.operator, Some(three));
    }

    #[test]
    fn an_operator_who_keeps_control_is_not_asked_for_a_minute() {
        let start = Instant::now();
        let later = |seconds| start + Duration::from_secs(seconds);
        let mut seats = Seats::new(start);
        let [one, two] = [(); 2].map(|()| seats.join(start).unwrap());
        seats.keep(start);
        seats.take(two, later(100)).unwrap();
        assert_eq!(seats.answers_within(later(110)), Some(Duration::from_secs(20)));
        seats.keep(later(110));
        assert_eq!((seats.operator, seats.asking, seats.answers_within(later(111))), (Some(one), None, None));
        assert_eq!(seats.take(two, later(150)), Err(KeptFor(Duration::from_secs(20))));
        seats.take_if_unanswered(two, later(169));
        assert_eq!(seats.operator, Some(one));
        seats.take(two, later(171)).unwrap();
        assert_eq!(seats.asking, Some(two));
        // It belongs to the lease.
        seats.keep(later(172));
        seats.release(one, later(173));
        seats.take(one, later(174)).unwrap();
        seats.take(two, later(174)).unwrap();
        assert_eq!((seats.operator, seats.asking), (Some(one), Some(two)));
    }

    #[test]
    fn the_number_of_browsers_is_limited() {
        let now = Instant::now();
        let mut seats = Seats::new(now);
        let last = (0..VIEWERS).map(|_| seats.join(now).unwrap()).last().unwrap();
        assert_eq!(seats.join(now), None);
        seats.leave(last, now);
        assert!(seats.join(now).is_some_and(|next| next > last), "no number is given twice");
    }
}
