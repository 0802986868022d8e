//! The optical tracker: the controllers' measurement of the bead's position (paper, §II).

use std::collections::VecDeque;

use rand::{Rng, RngExt};
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use crate::geometry::{Point2, Vector2};
use crate::robot::ur5::SERVO_PERIOD_S;

/// Time constant of the velocity filter.
const VELOCITY_FILTER_S: f64 = 0.1;

/// Quality of the tracker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerParameters {
    /// Standard deviation of each coordinate.
    pub noise_m: f64,
    /// Age of a sample when it arrives.
    pub latency_ticks: u32,
    /// Share of samples that are lost.
    pub dropout: f64,
}

/// The tracker's last output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Position, as measured.
    pub position_m: Point2<f64>,
    /// Velocity, differentiated and low-pass filtered.
    pub velocity_m_s: Vector2<f64>,
    /// Ticks since the position was measured.
    pub age_ticks: u32,
}

/// State of the tracker: samples in transit, and the last estimate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tracker {
    under_way: VecDeque<Option<Point2<f64>>>,
    estimate: Estimate,
}

impl Tracker {
    /// A tracker whose last sample is a bead at rest.
    pub fn at(position_m: Point2<f64>) -> Self {
        let estimate = Estimate { position_m, velocity_m_s: Vector2::zeros(), age_ticks: 0 };
        Self { under_way: VecDeque::new(), estimate }
    }

    pub fn estimate(&self) -> Estimate {
        self.estimate
    }

    /// Takes one sample per tick. The number of random draws does not depend on the parameters, so that changing the
    /// noise does not change anything else in the trial.
    pub fn sample(&mut self, truth_m: Point2<f64>, parameters: &TrackerParameters, rng: &mut impl Rng) {
        let noise = Vector2::new(rng.sample(StandardNormal), rng.sample(StandardNormal)) * parameters.noise_m;
        let lost = rng.random::<f64>() < parameters.dropout;
        self.under_way.push_back((!lost).then_some(truth_m + noise));
        let mut arrived = None;
        while self.under_way.len() > parameters.latency_ticks as usize {
            arrived = self.under_way.pop_front().flatten();
        }
        let last = self.estimate;
        let Some(position_m) = arrived else {
            self.estimate.age_ticks = last.age_ticks + 1;
            return;
        };
        let elapsed_s =
            f64::from((last.age_ticks + 1).saturating_sub(parameters.latency_ticks).max(1)) * SERVO_PERIOD_S;
        let share = 1.0 - (-elapsed_s / VELOCITY_FILTER_S).exp();
        let measured = (position_m - last.position_m) / elapsed_s;
        self.estimate = Estimate {
            position_m,
            velocity_m_s: last.velocity_m_s + (measured - last.velocity_m_s) * share,
            age_ticks: parameters.latency_ticks,
        };
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    const PARAMETERS: TrackerParameters = TrackerParameters { noise_m: 1e-3, latency_ticks: 2, dropout: 0.0 };

    #[test]
    fn noise_has_the_stated_deviation_and_no_bias() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let truth = Point2::new(0.1, -0.3);
        let mut tracker = Tracker::at(truth);
        let errors: Vec<f64> = (0..4000)
            .map(|_| {
                tracker.sample(truth, &PARAMETERS, &mut rng);
                tracker.estimate().position_m.x - truth.x
            })
            .collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let deviation = (errors.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / errors.len() as f64).sqrt();
        assert!(mean.abs() < 1e-4 && (deviation - 1e-3).abs() < 1e-4, "{mean} {deviation}");
    }

    #[test]
    fn a_sample_arrives_after_its_latency_and_velocity_converges() {
        let parameters = TrackerParameters { noise_m: 0.0, ..PARAMETERS };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut tracker = Tracker::at(Point2::origin());
        for tick in 1..=200 {
            let truth = Point2::new(0.04 * SERVO_PERIOD_S * f64::from(tick), 0.0);
            tracker.sample(truth, &parameters, &mut rng);
        }
        let estimate = tracker.estimate();
        assert!((estimate.position_m.x - 0.04 * SERVO_PERIOD_S * 198.0).abs() < 1e-12);
        assert!((estimate.velocity_m_s.x - 0.04).abs() < 1e-4);
    }

    #[test]
    fn lost_samples_age_the_estimate_without_moving_it() {
        let parameters = TrackerParameters { dropout: 1.0, ..PARAMETERS };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut tracker = Tracker::at(Point2::origin());
        for _ in 0..10 {
            tracker.sample(Point2::new(1.0, 1.0), &parameters, &mut rng);
        }
        assert_eq!(tracker.estimate().position_m, Point2::origin());
        assert_eq!(tracker.estimate().age_ticks, 10);
    }
}
