//! Pacing of simulated time by the wall clock: when the next tick is due, and the achieved speed.

use std::time::Duration;

use crate::robot::ur5::SERVO_PERIOD_S;

/// Minimum speed, simulated seconds per second.
pub const SPEED_MIN: f64 = 0.125;
/// Maximum requested speed; the achieved speed may be lower.
pub const SPEED_MAX: f64 = 64.0;
/// A session that falls behind further than this skips the lost time.
const CATCH_UP: Duration = Duration::from_millis(100);
/// Span over which the achieved speed is measured.
const WINDOW: Duration = Duration::from_millis(500);

/// Schedule of ticks.
#[derive(Debug)]
pub struct Pace {
    factor: f64,
    due: Duration,
    window_start: Duration,
    window_ticks: u32,
    achieved: f64,
    /// Latest tick of this window and of the previous one.
    latest: Duration,
    lateness: Duration,
    missed: u64,
}

impl Pace {
    /// A schedule that starts now.
    pub fn new(factor: f64, now: Duration) -> Self {
        Self {
            factor,
            due: now,
            window_start: now,
            window_ticks: 0,
            achieved: 0.0,
            latest: Duration::ZERO,
            lateness: Duration::ZERO,
            missed: 0,
        }
    }

    /// The requested speed.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// The speed achieved over the last half second.
    pub fn achieved(&self) -> f64 {
        self.achieved
    }

    /// Delay of the latest tick of the last half second.
    pub fn lateness(&self) -> Duration {
        self.lateness
    }

    /// How often lost time was skipped.
    pub fn missed(&self) -> u64 {
        self.missed
    }

    /// Changes the speed.
    pub fn set_factor(&mut self, factor: f64, now: Duration) {
        *self = Self { achieved: self.achieved, missed: self.missed, ..Self::new(factor, now) };
    }

    /// Restarts the schedule after a pause.
    pub fn restart(&mut self, now: Duration) {
        *self = Self { missed: self.missed, ..Self::new(self.factor, now) };
    }

    /// Time left until the next tick; zero when it is due.
    pub fn wait(&self, now: Duration) -> Duration {
        self.due.saturating_sub(now)
    }

    /// Notes a finished tick.
    pub fn ticked(&mut self, now: Duration) {
        self.latest = self.latest.max(now.saturating_sub(self.due));
        self.due += Duration::from_secs_f64(SERVO_PERIOD_S / self.factor);
        if now.saturating_sub(self.due) > CATCH_UP {
            self.due = now;
            self.missed += 1;
        }
        self.window_ticks += 1;
        let span = now.saturating_sub(self.window_start);
        if span >= WINDOW {
            self.achieved = f64::from(self.window_ticks) * SERVO_PERIOD_S / span.as_secs_f64();
            self.lateness = std::mem::take(&mut self.latest);
            self.window_start = now;
            self.window_ticks = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_come_at_the_requested_rate_and_lost_time_is_skipped() {
        let start = Duration::from_secs(7);
        let mut pace = Pace::new(2.0, start);
        for _ in 0..10 {
            pace.ticked(start);
        }
        assert_eq!(pace.wait(start), Duration::from_millis(40));
        let late = start + Duration::from_secs(5);
        assert_eq!(pace.missed(), 0);
        pace.ticked(late);
        assert_eq!(pace.missed(), 1);
        assert_eq!(pace.lateness(), Duration::from_millis(5000 - 40));
        assert_eq!(pace.wait(late), Duration::ZERO);
        pace.ticked(late);
        assert_eq!(pace.wait(late), Duration::from_millis(4));
    }

    #[test]
    fn the_achieved_speed_is_simulated_time_over_wall_time() {
        let start = Duration::from_secs(7);
        let mut pace = Pace::new(1.0, start);
        for tick in 1..=63 {
            pace.ticked(start + Duration::from_millis(16) * tick);
        }
        assert!((pace.achieved() - 0.5).abs() < 0.01, "{}", pace.achieved());
    }
}
