//! Random numbers of a trial: each consumer has its own stream of the trial's seed. What one of them draws, or how often,
//! changes nothing for the others.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// A consumer of random numbers. Consumers with a number draw again from the beginning of a stream each time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Random start of the bead.
    Start,
    /// Noise and losses of the tracker.
    Tracker,
    /// ERRT.
    Planner,
    /// Noise of the camera's image at this tick.
    Camera(u32),
    /// Step of the disturbance of this number.
    DisturbanceStep(u32),
    /// Place of the disturbance of this number.
    DisturbancePlace(u32),
    /// Where the tool starts, if not above the bead.
    ToolStart,
    /// Strength of the walls' contractions.
    Walls,
}

impl Stream {
    /// The consumer's generator for a seed.
    pub fn rng(self, seed: u64) -> ChaCha8Rng {
        let (consumer, number) = match self {
            Self::Start => (0, 0),
            Self::Tracker => (1, 0),
            Self::Planner => (2, 0),
            Self::Camera(tick) => (3, tick),
            Self::DisturbanceStep(number) => (4, number),
            Self::DisturbancePlace(number) => (5, number),
            Self::ToolStart => (6, 0),
            Self::Walls => (7, 0),
        };
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(consumer << 32 | u64::from(number));
        rng
    }
}

#[cfg(test)]
mod tests {
    use rand::Rng;

    use super::*;

    #[test]
    fn no_two_consumers_draw_the_same_numbers() {
        use Stream::{Camera, DisturbancePlace, DisturbanceStep, Planner, Start, ToolStart, Tracker, Walls};
        let all =
            [Start, Tracker, Planner, Camera(0), Camera(1), DisturbanceStep(0), DisturbancePlace(0), ToolStart, Walls];
        let first: std::collections::BTreeSet<u64> = all.iter().map(|stream| stream.rng(7).next_u64()).collect();
        assert_eq!(first.len(), all.len());
        assert_eq!(Tracker.rng(7).next_u64(), Tracker.rng(7).next_u64());
    }
}
