//! Where a run lost time, compared with another one.

use serde::{Deserialize, Serialize};

use super::{Challenge, Mishap, SAMPLE_TICKS, Sample, Trace};
use crate::geometry::Point2;
use crate::robot::ur5::SERVO_PERIOD_S;

/// Speed of a bead that wastes no time: the tool's.
const IDEAL_M_PER_S: f64 = 0.04;
/// Waste below this share of the time is no loss: also the controllers follow bends.
const NOISE: f64 = 0.5;
/// Time without waste weighs this much more than time with it, so that two losses with a good part between them stay two.
const GOOD_WEIGHT: f64 = 3.0;
/// Farther from the tool, the bead is being fetched.
const APART_M: f64 = 0.03;
/// Two samples within this distance show the bead at the same place.
const SAME_PLACE_M: f64 = 0.01;
/// A smaller loss is not worth a word.
const LEAST_S: f64 = 1.0;

/// The part of an attempt in which it lost the most time, compared with the fastest ghost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LossMessage))]
#[cfg_attr(feature = "schema", ts(rename = "LossMessage"))]
pub struct Loss {
    #[cfg_attr(feature = "schema", ts(type = "number"))]
    pub from_tick: u64,
    #[cfg_attr(feature = "schema", ts(type = "number"))]
    pub to_tick: u64,
    /// The bead at `from_tick`.
    #[cfg_attr(feature = "schema", ts(type = "[number, number]"))]
    #[cfg_attr(feature = "schema", schema(value_type = crate::schema::Numbers2))]
    pub place_m: Point2<f64>,
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

    /// The part in which `own` lost the most time against `other`, or against the tool's speed. `None` if it lost less
    /// than a second. A run whose bead was moved away has no part in common with another: then `other` must be `None`.
    pub fn loss(&self, own: &Trace, other: Option<&Trace>) -> Option<Loss> {
        let period_s = SAMPLE_TICKS as f64 * SERVO_PERIOD_S;
        let remaining_m = |trace: &Trace| -> Vec<f64> {
            trace.samples.iter().map(|sample| self.remaining_m(sample.bead_m)).collect()
        };
        let own_m = remaining_m(own);
        let is_excused = excused(own);
        // A bead that is moved away or back counts as one that rests.
        let wasted_s: Vec<f64> = own_m
            .windows(2)
            .zip(&is_excused)
            .map(|(pair, &is_excused)| match is_excused {
                true => 0.0,
                false => (period_s - (pair[0] - pair[1]) / IDEAL_M_PER_S).clamp(0.0, period_s),
            })
            .collect();
        let weighed_s = wasted_s.iter().zip(&is_excused).map(|(wasted_s, &is_excused)| {
            let beyond_s = wasted_s - NOISE * period_s;
            if is_excused { 0.0 } else { beyond_s.max(GOOD_WEIGHT * beyond_s.min(0.0)) }
        });
        let (first, last) = worst_range(&weighed_s.collect::<Vec<f64>>())?;
        let lost_s = match other.map(remaining_m) {
            Some(other_m) => {
                (last - first) as f64 * period_s - duration_s(&other_m, own_m[first], own_m[last], period_s)
            }
            None => wasted_s[first..last].iter().sum(),
        };
        if lost_s < LEAST_S {
            return None;
        }
        let tick = |sample: usize| 1 + sample as u64 * SAMPLE_TICKS;
        let (from_tick, to_tick) = (tick(first), tick(last));
        let places_m: Vec<Point2<f64>> = own.samples[first..=last].iter().map(|sample| sample.bead_m).collect();
        let count = |kind: Mishap| {
            own.mishaps
                .iter()
                .filter(|&&(tick, mishap)| mishap == kind && (from_tick..=to_tick).contains(&tick))
                .count() as u32
        };
        Some(Loss {
            from_tick,
            to_tick,
            place_m: longest_place_m(&places_m),
            lost_s,
            walls: count(Mishap::Wall),
            lost_beads: count(Mishap::LostBead),
            disturbances: count(Mishap::Disturbance),
        })
    }
}

/// For each sample, whether the bead is being fetched after it was moved away: the hand can do little then.
fn excused(trace: &Trace) -> Vec<bool> {
    let mut mishaps = trace.mishaps.iter().peekable();
    let mut is_excused = false;
    let judge = |(index, sample): (usize, &Sample)| {
        is_excused &= (sample.tool_m - sample.bead_m).norm() > APART_M;
        // Those before the next sample.
        let until_tick = 1 + (index as u64 + 1) * SAMPLE_TICKS;
        while let Some((_, mishap)) = mishaps.next_if(|(at, _)| *at < until_tick) {
            is_excused = match mishap {
                Mishap::Disturbance => true,
                Mishap::LostBead => false,
                Mishap::Wall => is_excused,
            };
        }
        is_excused
    };
    trace.samples.iter().enumerate().map(judge).collect()
}

/// The place with the most others near it.
fn longest_place_m(places_m: &[Point2<f64>]) -> Point2<f64> {
    let near = |place_m: &&Point2<f64>| {
        std::cmp::Reverse(places_m.iter().filter(|other| (**other - **place_m).norm() <= SAME_PLACE_M).count())
    };
    // The first of several.
    places_m.iter().min_by_key(near).copied().unwrap_or_default()
}

/// Seconds that a run needs from one remaining length to a shorter one; 0 if it is not shorter.
fn duration_s(remaining_m: &[f64], from_m: f64, to_m: f64, period_s: f64) -> f64 {
    let pass = |length_m: f64| remaining_m.iter().position(|&left_m| left_m <= length_m + 1e-9);
    match (pass(from_m), pass(to_m)) {
        (Some(begin), Some(end)) => end.saturating_sub(begin) as f64 * period_s,
        _ => 0.0,
    }
}

/// The range with the greatest sum (Kadane's algorithm); `None` if no number is positive.
fn worst_range(losses_s: &[f64]) -> Option<(usize, usize)> {
    let (mut best, mut best_sum) = (None, 0.0);
    let (mut first, mut sum) = (0, 0.0);
    for (index, loss_s) in losses_s.iter().enumerate() {
        sum += loss_s;
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

    #[test]
    fn the_worst_range_joins_losses_across_small_gains() {
        assert_eq!(worst_range(&[-0.1, 2.0, -0.2, 3.0, -4.0, 1.0]), Some((1, 4)));
        assert_eq!(worst_range(&[-0.1, -1.0]), None);
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
        assert_eq!(loss.place_m, stuck.samples[20].bead_m);
        assert!(loss.lost_s > 8.0 && loss.to_tick == 70 * SAMPLE_TICKS + 1, "{loss:?}");
    }

    #[test]
    fn of_two_rests_the_longer_one_is_the_loss() {
        let challenge = Challenge::of("easy-2026-11-26".parse().unwrap()).unwrap();
        let mut slow = trace(&challenge, 30, 20);
        let first = slow.samples[10];
        slow.samples.splice(10..10, vec![first; 14]);
        let loss = challenge.loss(&slow, Some(&trace(&challenge, 20, 0))).unwrap();
        assert!((3.4..4.6).contains(&loss.lost_s) && loss.from_tick > 42 * SAMPLE_TICKS, "{loss:?}");
    }

    #[test]
    fn fetching_a_bead_that_was_moved_away_is_no_loss_and_waiting_after_it_is() {
        let challenge = Challenge::of("easy-2026-11-26".parse().unwrap()).unwrap();
        let swift = trace(&challenge, 20, 0);
        let (pulled_from, back) = (swift.samples[25], swift.samples[12]);
        let begin = |wait: usize| {
            let mut samples = swift.samples[..26].to_vec();
            // The bead lies where it was pulled to, for four seconds, and the tool comes.
            samples.extend([Sample { tool_m: pulled_from.tool_m, bead_m: back.bead_m }; 20]);
            samples.extend(trace(&challenge, 12, wait).samples[12..].iter());
            Trace { samples, mishaps: vec![(25 * SAMPLE_TICKS + 5, Mishap::Disturbance)] }
        };
        assert_eq!(challenge.loss(&begin(0), None), None);
        let loss = challenge.loss(&begin(10), None).unwrap();
        assert!((1.8..2.6).contains(&loss.lost_s) && loss.from_tick >= 45 * SAMPLE_TICKS, "{loss:?}");
    }

    #[test]
    fn a_rest_after_the_bead_was_moved_away_is_found_where_it_is() {
        let challenge = Challenge::of("easy-2026-11-26".parse().unwrap()).unwrap();
        let swift = trace(&challenge, 20, 0);
        // Near the goal, thrown back to the start, and then it rests on the second way.
        let mut thrown = swift.clone();
        thrown.samples.truncate(30);
        thrown.samples.extend(trace(&challenge, 12, 25).samples);
        let loss = challenge.loss(&thrown, Some(&swift)).unwrap();
        assert!((40 * SAMPLE_TICKS..44 * SAMPLE_TICKS).contains(&loss.from_tick), "{loss:?}");
        assert!((loss.place_m - swift.samples[12].bead_m).norm() < 0.02, "{loss:?}");
    }
}
