//! Which jobs run before and beside which, and how long they take.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Jobs with an estimate below this are short.
const SHORT_S: f64 = 60.0;
/// Weight of the newest measurement in a pace.
const NEWEST: f64 = 0.3;

/// A line of jobs with a thread of its own. A short job runs beside a long one, and gets most of the processors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lane {
    /// Less than a minute.
    Short,
    Long,
}

impl Lane {
    pub const ALL: [Self; 2] = [Self::Short, Self::Long];

    /// That of a job that takes so long.
    pub fn of(estimate_s: f64) -> Self {
        if estimate_s < SHORT_S { Self::Short } else { Self::Long }
    }

    pub fn as_str(self) -> &'static str {
        match self {
            Self::Short => "short",
            Self::Long => "long",
        }
    }

    /// 0 to 99; on Linux it becomes a niceness of 10 or 15. The scheduler gives a thread of niceness 10 three times the time
    /// of one of niceness 15, and one of a live session nine times that. With the lowest priority a training would make no
    /// progress while anything else runs.
    pub(super) fn priority(self) -> u8 {
        match self {
            Self::Short => 22,
            Self::Long => 10,
        }
    }
}

/// The facts of a job that do not change.
#[derive(Clone, Debug)]
pub struct Ticket {
    /// The session that started it; `None`: a program did.
    pub owner: Option<String>,
    pub lane: Lane,
    /// For the whole job, on this machine.
    pub estimate_s: f64,
}

#[derive(Clone, Copy, Debug)]
struct Pace {
    each_s: f64,
    is_measured: bool,
}

/// Seconds for one unit of each kind of work, by its name: first a guess, then the average of what this machine needed, in
/// which newer measurements count more.
#[derive(Debug, Default)]
pub struct Paces(Mutex<BTreeMap<String, Pace>>);

impl Paces {
    /// Adds a kind of work. The guess is used until it is measured.
    pub fn guess(&self, work: &str, each_s: f64) {
        self.lock().entry(work.to_owned()).or_insert(Pace { each_s, is_measured: false });
    }

    /// 0 for a kind that was not added.
    pub fn each_s(&self, work: &str) -> f64 {
        self.lock().get(work).map_or(0.0, |pace| pace.each_s)
    }

    /// So many units of work took so long.
    pub fn measure(&self, work: &str, units: f64, spent_s: f64) {
        let mut paces = self.lock();
        let Some(pace) = paces.get_mut(work).filter(|_| units > 0.0 && spent_s > 0.0) else { return };
        let weight = if pace.is_measured { NEWEST } else { 1.0 };
        *pace = Pace { each_s: pace.each_s + weight * (spent_s / units - pace.each_s), is_measured: true };
    }

    /// All kinds, by name.
    pub fn all(&self) -> Vec<(String, f64)> {
        self.lock().iter().map(|(work, pace)| (work.clone(), pace.each_s)).collect()
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Pace>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_is_a_guess_then_the_average_of_what_was_measured() {
        let paces = Paces::default();
        paces.guess("trial", 4.0);
        paces.guess("trial", 7.0);
        assert_eq!(paces.each_s("trial"), 4.0);
        paces.measure("trial", 10.0, 10.0);
        assert_eq!(paces.each_s("trial"), 1.0, "the guess does not count any more");
        paces.measure("trial", 1.0, 2.0);
        assert!((paces.each_s("trial") - 1.3).abs() < 1e-12);
        paces.measure("trial", 0.0, 2.0);
        paces.measure("other", 1.0, 2.0);
        assert_eq!(paces.all().len(), 1);
        assert_eq!([59.9, 60.0].map(Lane::of), [Lane::Short, Lane::Long]);
    }
}
