//! The optical tracker: the controllers' measurement of the bead's position (paper, §II).

mod occlusion;

use std::collections::VecDeque;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use serde::{Deserialize, Serialize};

use crate::geometry::{Point2, Vector2};
use crate::robot::ur5::SERVO_PERIOD_S;

pub use occlusion::is_hidden;

/// Time constant of the velocity filter.
const VELOCITY_FILTER_S: f64 = 0.1;
/// Time constant of the drift.
const DRIFT_S: f64 = 10.0;

/// Quality of the tracker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackerParameters {
    /// Standard deviation of each coordinate.
    pub noise_m: f64,
    /// Constant error.
    pub bias_m: Vector2<f64>,
    /// Standard deviation of an error of each coordinate that changes slowly, within about ten seconds
    /// (Ornstein–Uhlenbeck process). It begins at 0.
    pub drift_m: f64,
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
    /// Drift in units of its standard deviation.
    drift: Vector2<f64>,
    /// Ticks since a sample arrived. While the first samples are in transit, none is missing.
    silent_ticks: u32,
    rng: ChaCha8Rng,
}

impl Tracker {
    /// A tracker whose last sample is a bead at rest. All its random numbers come from `rng`.
    pub fn at(position_m: Point2<f64>, rng: ChaCha8Rng) -> Self {
        let estimate = Estimate { position_m, velocity_m_s: Vector2::zeros(), age_ticks: 0 };
        Self { under_way: VecDeque::new(), estimate, drift: Vector2::zeros(), silent_ticks: 0, rng }
    }

    /// All further random numbers come from `rng`.
    pub fn reseed(&mut self, rng: ChaCha8Rng) {
        self.rng = rng;
    }

    pub fn estimate(&self) -> Estimate {
        self.estimate
    }

    /// Whether no sample has arrived for longer than `timeout_s`.
    pub fn is_lost(&self, timeout_s: f64) -> bool {
        f64::from(self.silent_ticks) * SERVO_PERIOD_S > timeout_s
    }

    /// Takes one sample per tick; `truth_m` is `None` while the tracker does not see the bead. The number of random
    /// draws does not depend on the parameters, so that changing one does not change the noise.
    pub fn sample(&mut self, truth_m: Option<Point2<f64>>, parameters: &TrackerParameters) {
        let mut normal = || Vector2::new(self.rng.sample(StandardNormal), self.rng.sample(StandardNormal));
        let (noise, drift): (Vector2<f64>, Vector2<f64>) = (normal(), normal());
        let kept = (-SERVO_PERIOD_S / DRIFT_S).exp();
        self.drift = self.drift * kept + drift * (1.0 - kept * kept).sqrt();
        let error_m = noise * parameters.noise_m + self.drift * parameters.drift_m + parameters.bias_m;
        let lost = self.rng.random::<f64>() < parameters.dropout;
        self.under_way.push_back(truth_m.filter(|_| !lost).map(|truth_m| truth_m + error_m));
        let is_due = self.under_way.len() > parameters.latency_ticks as usize;
        let mut arrived = None;
        while self.under_way.len() > parameters.latency_ticks as usize {
            arrived = self.under_way.pop_front().flatten();
        }
        let last = self.estimate;
        let Some(position_m) = arrived else {
            self.estimate.age_ticks = last.age_ticks + 1;
            self.silent_ticks += u32::from(is_due);
            return;
        };
        let elapsed_s =
            f64::from((last.age_ticks + 1).saturating_sub(parameters.latency_ticks).max(1)) * SERVO_PERIOD_S;
        let share = 1.0 - (-elapsed_s / VELOCITY_FILTER_S).exp();
        let measured = (position_m - last.position_m) / elapsed_s;
        self.silent_ticks = 0;
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

    use super::*;

    const PARAMETERS: TrackerParameters = TrackerParameters {
        noise_m: 1e-3,
        bias_m: Vector2::new(0.0, 0.0),
        drift_m: 0.0,
        latency_ticks: 2,
        dropout: 0.0,
    };

    fn tracker(position_m: Point2<f64>) -> Tracker {
        Tracker::at(position_m, ChaCha8Rng::seed_from_u64(1))
    }

    fn deviation(values: &[f64]) -> (f64, f64) {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (mean, (values.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt())
    }

    fn errors(parameters: &TrackerParameters, samples: usize, every: usize) -> Vec<f64> {
        let truth = Point2::new(0.1, -0.3);
        let mut tracker = tracker(truth);
        let all = (0..samples).map(|_| {
            tracker.sample(Some(truth), parameters);
            tracker.estimate().position_m.x - truth.x
        });
        all.step_by(every).collect()
    }

    #[test]
    fn noise_has_the_stated_deviation_and_no_bias() {
        let (mean, deviation) = deviation(&errors(&PARAMETERS, 4000, 1));
        assert!(mean.abs() < 1e-4 && (deviation - 1e-3).abs() < 1e-4, "{mean} {deviation}");
    }

    #[test]
    fn bias_is_constant_and_drift_is_slow() {
        let bias = TrackerParameters { noise_m: 0.0, bias_m: Vector2::new(3e-3, 0.0), ..PARAMETERS };
        assert!(errors(&bias, 100, 1)[10..].iter().all(|error| (error - 3e-3).abs() < 1e-12));
        let drift = TrackerParameters { noise_m: 0.0, drift_m: 2e-3, ..PARAMETERS };
        let steps = errors(&drift, 500, 1);
        assert!(steps.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 5e-4), "it jumps");
        // Every 40 s, four time constants, so that the values are nearly independent.
        let (_, deviation) = deviation(&errors(&drift, 5_000_000, 5000)[1..]);
        assert!((deviation - 2e-3).abs() < 2e-4, "{deviation}");
    }

    #[test]
    fn a_sample_arrives_after_its_latency_and_velocity_converges() {
        let parameters = TrackerParameters { noise_m: 0.0, ..PARAMETERS };
        let mut tracker = tracker(Point2::origin());
        for tick in 1..=200 {
            let truth = Point2::new(0.04 * SERVO_PERIOD_S * f64::from(tick), 0.0);
            tracker.sample(Some(truth), &parameters);
        }
        let estimate = tracker.estimate();
        assert!((estimate.position_m.x - 0.04 * SERVO_PERIOD_S * 198.0).abs() < 1e-12);
        assert!((estimate.velocity_m_s.x - 0.04).abs() < 1e-4);
    }

    #[test]
    fn lost_samples_age_the_estimate_without_moving_it() {
        let parameters = TrackerParameters { dropout: 1.0, ..PARAMETERS };
        let mut tracker = tracker(Point2::origin());
        for _ in 0..10 {
            tracker.sample(Some(Point2::new(1.0, 1.0)), &parameters);
        }
        assert_eq!(tracker.estimate().position_m, Point2::origin());
        assert_eq!(tracker.estimate().age_ticks, 10);
    }

    #[test]
    fn it_is_lost_when_no_sample_arrives_and_latency_alone_is_no_loss() {
        let slow = TrackerParameters { latency_ticks: 50, ..PARAMETERS };
        let mut tracker = tracker(Point2::origin());
        for _ in 0..100 {
            tracker.sample(Some(Point2::origin()), &slow);
            assert!(!tracker.is_lost(0.05));
        }
        // 50 samples are still in transit.
        for _ in 0..50 {
            tracker.sample(None, &slow);
            assert!(!tracker.is_lost(0.05));
        }
        // More than 25 ticks are more than .2 s.
        for tick in 1..=26 {
            tracker.sample(None, &slow);
            assert_eq!(tracker.is_lost(0.2), tick > 25);
        }
        for _ in 0..51 {
            tracker.sample(Some(Point2::origin()), &slow);
        }
        assert!(!tracker.is_lost(0.0));
    }
}
