//! Who of a session's browsers is the operator. Pure: the time is told.

use std::time::Duration;

use tokio::time::Instant;

/// Browsers of one session.
const VIEWERS: usize = 128;
/// An operator who is asked to make way and does nothing for so long has left.
const ANSWER_WITHIN: Duration = Duration::from_secs(30);

/// Who sits where. The operator's seat is a lease: it passes on when its holder leaves, makes way, or does not answer.
#[derive(Clone, Copy, Debug)]
pub struct Seats {
    /// Connection that is the operator.
    pub operator: Option<u64>,
    /// Raised whenever another connection becomes the operator: a command that was meant under another is refused.
    pub epoch: u64,
    /// Connection that last asked an operator to make way.
    pub asking: Option<u64>,
    /// Browsers there are.
    pub viewers: usize,
    next: u64,
    /// The operator's last command, or since when there is one.
    commanded: Instant,
    asked: Instant,
}

impl Seats {
    pub fn new(now: Instant) -> Self {
        Self { operator: None, epoch: 0, asking: None, viewers: 0, next: 0, commanded: now, asked: now }
    }

    fn seat(&mut self, operator: Option<u64>, now: Instant) {
        self.operator = operator;
        self.epoch += 1;
        self.commanded = now;
    }

    /// A new connection, if there is room; it becomes the operator if nobody is.
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

    /// A connection ends.
    pub fn leave(&mut self, connection: u64, now: Instant) {
        self.viewers -= 1;
        self.release(connection, now);
    }

    /// A connection stops operating, or asking; who asks takes over from who operates.
    pub fn release(&mut self, connection: u64, now: Instant) {
        if self.asking == Some(connection) {
            self.asking = None;
        }
        if self.operator == Some(connection) {
            let next = self.asking.take();
            self.seat(next, now);
        }
    }

    /// Takes the operator's seat if it is free, asks its holder otherwise.
    pub fn take(&mut self, connection: u64, now: Instant) {
        match self.operator {
            Some(operator) if operator == connection => {}
            Some(_) if self.asking == Some(connection) => {}
            Some(_) => {
                // Who asks in another's place goes on waiting where that one was: else two by turns wait for ever.
                if self.asking.replace(connection).is_none() {
                    self.asked = now;
                }
            }
            None => self.seat(Some(connection), now),
        }
    }

    /// The operator gave a command.
    pub fn command(&mut self, now: Instant) {
        self.commanded = now;
    }

    /// Gives the operator's seat to the requesting client if the operator has not reacted to the request.
    pub fn take_if_unanswered(&mut self, connection: u64, now: Instant) {
        let waits = now.saturating_duration_since(self.asked.max(self.commanded));
        if self.asking == Some(connection) && waits >= ANSWER_WITHIN {
            self.asking = None;
            self.seat(Some(connection), now);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_operates_and_who_asks_follows() {
        let now = Instant::now();
        let mut seats = Seats::new(now);
        let [one, two, three] = [(); 3].map(|()| seats.join(now).unwrap());
        assert_eq!((seats.operator, seats.epoch), (Some(one), 1));
        seats.take(two, now);
        seats.take(three, now);
        assert_eq!((seats.operator, seats.asking), (Some(one), Some(three)));
        seats.leave(one, now);
        assert_eq!((seats.operator, seats.asking, seats.epoch), (Some(three), None, 2));
        seats.release(three, now);
        assert_eq!((seats.operator, seats.epoch), (None, 3));
        seats.take(two, now);
        assert_eq!((seats.operator, seats.epoch, seats.viewers), (Some(two), 4, 2));
        seats.take(two, now);
        assert_eq!(seats.epoch, 4, "it is its own already");
    }

    #[test]
    fn an_operator_who_does_not_answer_loses_the_seat_and_one_who_works_does_not() {
        let start = Instant::now();
        let later = |seconds| start + Duration::from_secs(seconds);
        let mut seats = Seats::new(start);
        let [one, two] = [(); 2].map(|()| seats.join(start).unwrap());
        seats.take_if_unanswered(two, later(1000));
        assert_eq!(seats.operator, Some(one), "nobody asked");
        seats.take(two, later(1000));
        seats.command(later(1020));
        seats.take_if_unanswered(two, later(1049));
        seats.take(two, later(1049));
        seats.take_if_unanswered(one, later(2000));
        assert_eq!(seats.operator, Some(one));
        seats.take_if_unanswered(two, later(1050));
        assert_eq!((seats.operator, seats.asking), (Some(two), None));
    }

    #[test]
    fn two_who_ask_by_turns_do_not_keep_an_absent_operator_seated() {
        let start = Instant::now();
        let later = |seconds| start + Duration::from_secs(seconds);
        let mut seats = Seats::new(start);
        let [_, two, three] = [(); 3].map(|()| seats.join(start).unwrap());
        seats.take(two, later(100));
        seats.take(three, later(120));
        seats.take_if_unanswered(three, later(129));
        assert_ne!(seats.operator, Some(three));
        seats.take_if_unanswered(three, later(130));
        assert_eq!(seats.operator, Some(three));
    }

    #[test]
    fn there_is_room_for_so_many_and_no_more() {
        let now = Instant::now();
        let mut seats = Seats::new(now);
        let last = (0..VIEWERS).map(|_| seats.join(now).unwrap()).last().unwrap();
        assert_eq!(seats.join(now), None);
        seats.leave(last, now);
        assert!(seats.join(now).is_some_and(|next| next > last), "no number is given twice");
    }
}
