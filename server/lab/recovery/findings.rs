//! What a recovery map has found so far.

use super::{Outcome, Spot, Tried};
use crate::evaluate::wilson95;

/// A disturbance with its trials.
#[derive(Clone, Debug)]
pub struct Cell {
    pub spot: Spot,
    /// Its number, which decides its noise. It does not depend on which other cells there are.
    pub(super) number: u64,
    /// For each controller of the query, one entry per repeat that has ended.
    pub tries: Vec<Vec<Option<Tried>>>,
}

/// How the trials of one controller in one cell ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    pub delivered: u32,
    pub late: u32,
    pub lost: u32,
}

impl Tally {
    pub fn repeats(self) -> u32 {
        self.delivered + self.late + self.lost
    }

    pub fn wilson95(self) -> [f64; 2] {
        wilson95(self.delivered, self.repeats())
    }

    /// What happened most often; of two, the better one.
    pub fn usual(self) -> Outcome {
        let Self { delivered, late, lost } = self;
        match delivered.max(late).max(lost) {
            most if most == delivered => Outcome::Delivered,
            most if most == late => Outcome::Late,
            _ => Outcome::Lost,
        }
    }
}

impl Cell {
    pub(super) fn new(spot: Spot, number: u64, controllers: usize, repeats: u32) -> Self {
        Self { spot, number, tries: vec![vec![None; repeats as usize]; controllers] }
    }

    /// The trials of a controller that have ended.
    pub fn ended(&self, controller: usize) -> impl Iterator<Item = &Tried> {
        self.tries[controller].iter().flatten()
    }

    pub fn tally(&self, controller: usize) -> Tally {
        let mut tally = Tally::default();
        for tried in self.ended(controller) {
            *match tried.outcome {
                Outcome::Delivered => &mut tally.delivered,
                Outcome::Late => &mut tally.late,
                Outcome::Lost => &mut tally.lost,
            } += 1;
        }
        tally
    }

    /// Median time to the delivery, with late ones; `None` without a delivery.
    pub fn median_s(&self, controller: usize) -> Option<f64> {
        let came = self.ended(controller).filter(|tried| tried.outcome != Outcome::Lost);
        let mut times_s: Vec<f64> = came.map(|tried| tried.time_s).collect();
        times_s.sort_by(f64::total_cmp);
        let middle = times_s.len() / 2;
        match times_s.len() {
            0 => None,
            count if count % 2 == 1 => Some(times_s[middle]),
            _ => Some((times_s[middle - 1] + times_s[middle]) / 2.0),
        }
    }

    /// How most of the lost trials of a controller ended.
    pub fn why(&self, controller: usize) -> Option<String> {
        let ends: Vec<String> = self
            .ended(controller)
            .filter(|tried| tried.outcome == Outcome::Lost)
            .map(|t| t.phase.to_string())
            .collect();
        ends.iter().max_by_key(|end| ends.iter().filter(|other| other == end).count()).cloned()
    }
}

/// What a recovery map has found so far.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    pub cells: Vec<Cell>,
    /// Number of trials that have ended.
    pub done: usize,
    /// Number of trials that are planned; it grows where cells are divided.
    pub planned: usize,
    /// Area in which the bead has room; only for maps of places.
    pub room_m2: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::trial::Phase;

    #[test]
    fn a_cell_counts_what_has_ended() {
        let mut cell = Cell::new(Spot::Push { direction_rad: 0.0, force_n: 0.01 }, 0, 2, 5);
        assert_eq!((cell.tally(0), cell.median_s(0), cell.why(0)), (Tally::default(), None, None));
        let tried = |outcome, time_s, phase| {
            Some(Tried { outcome, time_s, steps: 1, phase, tick: 1, world_hash: 0, controller_hash: 0, deliveries: 1 })
        };
        cell.tries[1] = vec![
            tried(Outcome::Delivered, 3.0, Phase::Delivered),
            None,
            tried(Outcome::Late, 70.0, Phase::Delivered),
            tried(Outcome::Lost, 9.0, Phase::LiftedOff),
            tried(Outcome::Delivered, 5.0, Phase::Delivered),
        ];
        let tally = cell.tally(1);
        assert_eq!(tally, Tally { delivered: 2, late: 1, lost: 1 });
        assert_eq!((tally.usual(), tally.repeats()), (Outcome::Delivered, 4));
        assert_eq!(cell.median_s(1), Some(5.0));
        cell.tries[1][4] = None;
        assert_eq!(cell.median_s(1), Some(36.5));
        assert_eq!(cell.why(1).as_deref(), Some("lifted off"));
    }
}
