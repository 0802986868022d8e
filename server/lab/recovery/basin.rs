//! How large the part of a recovery map is from which the bead is delivered, with intervals.
//!
//! The map is a stratified sample of all places. Its cells are treated like a simple random sample: the intervals are a
//! little too wide. Coarse cells count more than fine ones, so the number of trials is replaced by Kish's effective size
//! (Kish 1965, *Survey Sampling*, §8.2).

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

use super::{Findings, Outcome};
use crate::evaluate::{LEVEL, PairedCounts, corrected_level, wilson};
use ferry_core::schema::Numbers2;

/// The part of a map from which a controller delivers in time.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Basin {
    pub controller: String,
    /// Trials that have ended.
    pub trials: u32,
    pub delivered: u32,
    /// Share of the map's area, or of all pushes, drags or losses.
    pub share: f64,
    /// Its Wilson 95 % interval.
    #[schema(value_type = Numbers2)]
    pub share95: [f64; 2],
    /// Area of the basin; only for places.
    pub area_m2: Option<f64>,
    #[schema(value_type = Option<Numbers2>)]
    pub area95_m2: Option<[f64; 2]>,
}

/// The basin of one controller minus that of another, at the same cells with the same noise.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct BasinDifference {
    pub controller: String,
    pub against: String,
    /// Trials delivered by both, by the first only, by the second only, and by neither.
    pub both: u32,
    pub first_only: u32,
    pub second_only: u32,
    pub neither: u32,
    pub share_difference: f64,
    /// Its 95 % interval (Newcombe 1998, method 10).
    #[schema(value_type = Numbers2)]
    pub share_difference95: [f64; 2],
    /// The interval at the level that is corrected for the number of differences (Bonferroni).
    #[schema(value_type = Numbers2)]
    pub share_difference_corrected: [f64; 2],
    /// Difference of the areas; only for places.
    pub area_difference_m2: Option<f64>,
}

/// Sums of weights, scaled to the effective number of trials.
#[derive(Clone, Copy, Debug, Default)]
struct Weights {
    sum: f64,
    squares: f64,
}

impl Weights {
    fn add(&mut self, weight: f64) {
        self.sum += weight;
        self.squares += weight * weight;
    }

    /// From a sum of weights to a number of trials.
    fn scale(self) -> f64 {
        self.sum / self.squares
    }
}

impl Basin {
    /// The basin of each controller; those without trials are left out.
    pub fn all(findings: &Findings, names: &[&str]) -> Vec<Self> {
        let area_m2 = findings.room_m2;
        let basin = |(index, name): (usize, &&str)| {
            let (mut weights, mut delivered_weight) = (Weights::default(), 0.0);
            let (mut trials, mut delivered) = (0, 0);
            for cell in &findings.cells {
                let weight = cell.spot.weight();
                for tried in cell.ended(index) {
                    weights.add(weight);
                    trials += 1;
                    if tried.outcome == Outcome::Delivered {
                        delivered_weight += weight;
                        delivered += 1;
                    }
                }
            }
            let scale = weights.scale();
            let share95 = wilson(delivered_weight * scale, weights.sum * scale, LEVEL);
            let share = delivered_weight / weights.sum;
            (trials > 0).then(|| Self {
                controller: (*name).to_owned(),
                trials,
                delivered,
                share,
                share95,
                area_m2: area_m2.map(|area_m2| area_m2 * share),
                area95_m2: area_m2.map(|area_m2| share95.map(|share| area_m2 * share)),
            })
        };
        names.iter().enumerate().filter_map(basin).collect()
    }
}

impl BasinDifference {
    /// Every pair of controllers, over the trials that have ended for both.
    pub fn all(findings: &Findings, names: &[&str]) -> Vec<Self> {
        let pairs = names.len() * names.len().saturating_sub(1) / 2;
        let level = corrected_level(pairs);
        let firsts = 0..names.len();
        let pairs = firsts.flat_map(|first| (first + 1..names.len()).map(move |second| (first, second)));
        pairs.filter_map(|(first, second)| Self::of(findings, names, [first, second], level)).collect()
    }

    fn of(findings: &Findings, names: &[&str], [first, second]: [usize; 2], level: f64) -> Option<Self> {
        let mut weights = Weights::default();
        // Both, first only, second only, neither.
        let (mut counts, mut sums) = ([0; 4], [0.0; 4]);
        for cell in &findings.cells {
            let weight = cell.spot.weight();
            for (one, other) in cell.tries[first].iter().zip(&cell.tries[second]) {
                let Some((one, other)) = one.zip(*other) else { continue };
                let failed = |outcome| usize::from(outcome != Outcome::Delivered);
                let class = failed(other.outcome) + 2 * failed(one.outcome);
                weights.add(weight);
                counts[class] += 1;
                sums[class] += weight;
            }
        }
        let scale = weights.scale();
        let [both, first_only, second_only, neither] = counts;
        let scaled = sums.map(|sum| sum * scale);
        let paired = PairedCounts { both: scaled[0], first: scaled[1], second: scaled[2], neither: scaled[3] };
        let (share_difference, share_difference95) = paired.difference(LEVEL);
        (weights.sum > 0.0).then(|| Self {
            controller: names[first].to_owned(),
            against: names[second].to_owned(),
            both,
            first_only,
            second_only,
            neither,
            share_difference,
            share_difference95,
            share_difference_corrected: paired.difference(level).1,
            area_difference_m2: findings.room_m2.map(|area_m2| area_m2 * share_difference),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recovery::findings::Cell;
    use crate::recovery::{Spot, Tried};
    use ferry_core::geometry::Point2;
    use ferry_core::trial::Phase;

    fn cell(size_m: f64, delivered: [[bool; 2]; 2]) -> Cell {
        let mut cell = Cell::new(Spot::Place { at_m: Point2::origin(), size_m }, 0, 2, 2);
        for (tries, delivered) in cell.tries.iter_mut().zip(delivered) {
            *tries = delivered
                .map(|delivered| {
                    let outcome = if delivered { Outcome::Delivered } else { Outcome::Lost };
                    let phase = Phase::Delivered;
                    Some(Tried {
                        outcome,
                        time_s: 1.0,
                        steps: 1,
                        phase,
                        tick: 1,
                        deliveries: 1,
                        world_hash: 0,
                        controller_hash: 0,
                    })
                })
                .to_vec();
        }
        cell
    }

    #[test]
    fn coarse_cells_count_by_their_area() {
        let findings = Findings {
            cells: vec![cell(0.03, [[true, true], [true, false]]), cell(0.01, [[false, false], [true, true]])],
            room_m2: Some(2e-3),
            ..Findings::default()
        };
        let [first, second] = &Basin::all(&findings, &["a", "b"])[..] else { panic!("two basins") };
        assert!((first.share - 0.9).abs() < 1e-12 && (second.share - 0.55).abs() < 1e-12);
        assert!((first.area_m2.unwrap() - 1.8e-3).abs() < 1e-12);
        // Kish: (18 + 2)² ÷ (2 · 81 + 2 · 1) = 2.439 trials; statsmodels proportion_confint(2.195, 2.439, method="wilson").
        let [low, high] = first.share95;
        assert!((low - 0.316_360).abs() < 1e-6 && (high - 0.994_319).abs() < 1e-6, "{low} {high}");
        let [difference] = &BasinDifference::all(&findings, &["a", "b"])[..] else { panic!("one pair") };
        assert_eq!((difference.both, difference.first_only, difference.second_only, difference.neither), (1, 1, 2, 0));
        assert!((difference.share_difference - 0.35).abs() < 1e-12);
        assert!((difference.area_difference_m2.unwrap() - 7e-4).abs() < 1e-12);
    }

    #[test]
    fn without_trials_there_is_no_basin() {
        let empty = Cell::new(Spot::Push { direction_rad: 0.0, force_n: 0.01 }, 0, 2, 2);
        let findings = Findings { cells: vec![empty], ..Findings::default() };
        assert_eq!(Basin::all(&findings, &["a", "b"]), []);
        assert_eq!(BasinDifference::all(&findings, &["a", "b"]), []);
    }
}
