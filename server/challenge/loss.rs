//! Where a run lost time, compared with another one.

use serde::{Deserialize, Serialize};

use super::{Challenge, Mishap, SAMPLE_TICKS, Trace};
use crate::geometry::Point2;
use crate::robot::ur5::SERVO_PERIOD_S;

/// The path to the goal is compared in stretches of this length.
const STRETCH_M: f64 = 0.02;
/// Speed of the comparison if there is no other run: the tool's.
const IDEAL_M_PER_S: f64 = 0.04;
/// Less than this per stretch is no loss.
const NOISE_S: f64 = 0.3;
/// A smaller loss is not worth a word.
const LEAST_S: f64 = 1.0;

/// The part of a run in which it lost the most time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loss {
    pub from_tick: u64,
    pub to_tick: u64,
    /// The bead at `from_tick`.
    pub place_m: Point2<f64>,
    /// Duration for this part of the path beyond the other run's.
    pub lost_s: f64,
    pub walls: u32,
    pub lost_beads: u32,
    pub disturbances: u32,
}

impl Challenge {
    /// Length of the shortest path from a place to the goal.
    pub fn remaining_m(&self, from: Point2<f64>) -> f64 {
        let goal = self.scenario.goal_m.unwrap_or(from);
        self.arena.space.shortest_m(from, goal).unwrap_or_else(|| (goal - from).norm())
    }

    /// Indices of the samples at which the bead first was within 0, 1, 2… stretches less than the whole path.
    fn passes(&self, trace: &Trace) -> Vec<usize> {
        let mut passes = Vec::new();
        for (index, sample) in trace.samples.iter().enumerate() {
            let remaining_m = self.remaining_m(sample.bead_m);
            while remaining_m <= self.path_m - passes.len() as f64 * STRETCH_M + 1e-9 {
                passes.push(index);
                if passes.len() as f64 * STRETCH_M > self.path_m {
                    return passes;
                }
            }
        }
        passes
    }

    /// Where `own` lost the most time against `other`, or against the tool's speed. `None` if it lost less than a
    /// second.
    pub fn loss(&self, own: &Trace, other: Option<&Trace>) -> Option<Loss> {
        let period_s = SAMPLE_TICKS as f64 * SERVO_PERIOD_S;
        let mut passes = self.passes(own);
        let last = own.samples.len().checked_sub(1)?;
        if passes.len() as f64 * STRETCH_M <= self.path_m {
            // It got no further: the rest of the time was lost in this stretch.
            passes.push(last);
        }
        let others = other.map(|other| self.passes(other)).unwrap_or_default();
        let durations_s = |passes: &[usize], index: usize| {
            let pair = passes.get(index..index + 2)?;
            Some((pair[1] - pair[0]) as f64 * period_s)
        };
        let losses_s = (0..passes.len().saturating_sub(1)).map(|index| {
            let ideal_s = STRETCH_M / IDEAL_M_PER_S;
            durations_s(&passes, index).unwrap_or_default() - durations_s(&others, index).unwrap_or(ideal_s)
        });
        let losses_s: Vec<f64> = losses_s.collect();
        let (first, after) = worst_range(&losses_s)?;
        let lost_s: f64 = losses_s[first..after].iter().sum();
        if lost_s < LEAST_S {
            return None;
        }
        let tick = |pass: usize| 1 + passes[pass] as u64 * SAMPLE_TICKS;
        let (from_tick, to_tick) = (tick(first), tick(after));
        let count = |kind: Mishap| {
            own.mishaps
                .iter()
                .filter(|&&(tick, mishap)| mishap == kind && (from_tick..=to_tick).contains(&tick))
                .count() as u32
        };
        Some(Loss {
            from_tick,
            to_tick,
            place_m: own.samples[passes[first]].bead_m,
            lost_s,
            walls: count(Mishap::Wall),
            lost_beads: count(Mishap::LostBead),
            disturbances: count(Mishap::Disturbance),
        })
    }
}

/// The range with the greatest sum of what each loss has above the noise (Kadane's algorithm); `None` if all are noise.
fn worst_range(losses_s: &[f64]) -> Option<(usize, usize)> {
    let (mut best, mut best_sum) = (None, 0.0);
    let (mut first, mut sum) = (0, 0.0);
    for (index, loss_s) in losses_s.iter().enumerate() {
        sum += loss_s - NOISE_S;
        if sum <= 0.0 {
            (first, sum) = (index + 1, 0.0);
        } else if sum > best_sum {
            (best, best_sum) = (Some((first, index + 1)), sum);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::challenge::Sample;

    #[test]
    fn the_worst_range_joins_losses_across_small_gains() {
        assert_eq!(worst_range(&[0.1, 2.0, 0.2, 3.0, -4.0, 1.0]), Some((1, 4)));
        assert_eq!(worst_range(&[0.1, -1.0, 0.3]), None);
        assert_eq!(worst_range(&[]), None);
    }

    /// A bead that goes along the shortest path and rests `wait` samples after `at` samples.
    fn trace(challenge: &Challenge, at: usize, wait: usize) -> Trace {
        let (start, goal) = (challenge.scenario.start_m.unwrap(), challenge.scenario.goal_m.unwrap());
        let path = challenge.arena.space.taut_path(start, goal).unwrap();
        let mut samples = Vec::new();
        for pair in path.windows(2) {
            let steps = ((pair[1] - pair[0]).norm() / 0.008).ceil();
            for step in 0..steps as usize {
                let place = pair[0] + (pair[1] - pair[0]) * (step as f64 / steps);
                samples.push(Sample { tool_m: place, bead_m: place });
            }
        }
        samples.push(Sample { tool_m: goal, bead_m: goal });
        let rest = samples[at];
        samples.splice(at..at, vec![rest; wait]);
        Trace { samples, mishaps: vec![(1, Mishap::Wall), (at as u64 * SAMPLE_TICKS + 30, Mishap::LostBead)] }
    }

    #[test]
    fn a_rest_is_the_loss_and_what_happened_in_it_is_counted() {
        let challenge = Challenge::of("easy-2026-11-26".parse().unwrap()).unwrap();
        let (swift, slow) = (trace(&challenge, 20, 0), trace(&challenge, 20, 15));
        for other in [Some(&swift), None] {
            let loss = challenge.loss(&slow, other).unwrap();
            assert!((2.4..3.6).contains(&loss.lost_s), "{loss:?}");
            assert!(loss.from_tick < 21 * SAMPLE_TICKS && loss.to_tick > 35 * SAMPLE_TICKS, "{loss:?}");
            assert!((loss.place_m - slow.samples[20].bead_m).norm() < 0.025, "{loss:?}");
            assert_eq!((loss.walls, loss.lost_beads, loss.disturbances), (0, 1, 0));
        }
        assert_eq!(challenge.loss(&swift, Some(&slow)), None);
    }

    #[test]
    fn a_run_that_stops_loses_the_rest_of_its_time_there() {
        let challenge = Challenge::of("easy-2026-11-26".parse().unwrap()).unwrap();
        let mut stuck = trace(&challenge, 20, 0);
        stuck.samples.truncate(21);
        stuck.samples.extend([stuck.samples[20]; 50]);
        let loss = challenge.loss(&stuck, None).unwrap();
        assert!(loss.lost_s > 8.0 && loss.to_tick == 70 * SAMPLE_TICKS + 1, "{loss:?}");
    }
}
