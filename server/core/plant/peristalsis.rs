//! Contractions of the gut's walls: a function of the time, of the coordinate along the lumen, and of a seed.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::lumen::MOST_CLOSING_M;
use crate::robot::ur5::SERVO_PERIOD_S;

/// Shortest wave, and shortest contraction.
pub const LEAST_WAVELENGTH_M: f64 = 0.05;
pub const LEAST_PERIOD_S: f64 = 1.0;

/// How fast the amplitude follows its setting, so that walls never jump: 5 mm/s.
const CHANGE_M_S: f64 = 0.005;

/// How contractions are arranged along the lumen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Contraction {
    /// Waves that travel along the lumen (peristalsis).
    #[default]
    Travelling,
    /// Rings that contract in place, every second one in turn (segmentation).
    Segmental,
}

/// The contractions that are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peristalsis {
    pub contraction: Contraction,
    /// How far walls close in; 0 is rest.
    pub amplitude_m: f64,
    /// From one wave to the next along the lumen, or length of a segment.
    pub wavelength_m: f64,
    /// Duration of a contraction at one place.
    pub period_s: f64,
    /// Rest between two contractions.
    pub pause_s: f64,
    /// 0: all contractions are equally strong. 1: any strength from none to full.
    pub irregularity: f64,
}

/// The contractions in effect. At rest there are none ([`Option`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallMotion {
    /// As set when the walls were last at rest.
    pattern: Peristalsis,
    /// It follows its setting.
    amplitude_m: f64,
    seed: u64,
}

impl WallMotion {
    /// A motion that has reached its amplitude.
    pub fn in_full(wanted: &Peristalsis, seed: u64) -> Option<Self> {
        (wanted.amplitude_m > 0.0).then_some(Self { pattern: *wanted, amplitude_m: wanted.amplitude_m, seed })
    }

    /// Whether it is a motion that [`Self::next`] can reach; one from a file may not be.
    pub fn is_sound(&self) -> bool {
        let Peristalsis { amplitude_m, wavelength_m, period_s, pause_s, irregularity, .. } = self.pattern;
        let amplitudes = 0.0..=MOST_CLOSING_M;
        amplitudes.contains(&amplitude_m)
            && amplitudes.contains(&self.amplitude_m)
            && wavelength_m >= LEAST_WAVELENGTH_M
            && period_s >= LEAST_PERIOD_S
            && pause_s >= 0.0
            && (0.0..=1.0).contains(&irregularity)
    }

    /// The motion a tick later, if `wanted` is set. Another pattern begins when the walls are at rest.
    pub fn next(now: Option<Self>, wanted: &Peristalsis, seed: u64) -> Option<Self> {
        let mut motion = match now {
            Some(motion) => motion,
            None if wanted.amplitude_m > 0.0 => Self { pattern: *wanted, amplitude_m: 0.0, seed },
            None => return None,
        };
        let is_same = Peristalsis { amplitude_m: motion.pattern.amplitude_m, ..*wanted } == motion.pattern;
        let target_m = if is_same { wanted.amplitude_m } else { 0.0 };
        let most_m = CHANGE_M_S * SERVO_PERIOD_S;
        motion.amplitude_m += (target_m - motion.amplitude_m).clamp(-most_m, most_m);
        if motion.amplitude_m > 0.0 {
            return Some(motion);
        }
        (wanted.amplitude_m > 0.0).then_some(Self { pattern: *wanted, amplitude_m: 0.0, seed })
    }

    /// How far walls close in at each of the places along the lumen, given in ascending order.
    pub fn wave_m(&self, knots_m: impl Iterator<Item = f64>, time_s: f64) -> Vec<f64> {
        let pattern = &self.pattern;
        let cycle_s = pattern.period_s + pattern.pause_s;
        let mut strength = Strength { motion: self, of: None };
        let bump = |share: f64| 0.5 * (1.0 - (std::f64::consts::TAU * share).cos());
        let closing_m = |along_m: f64| match pattern.contraction {
            Contraction::Travelling => {
                let local_s = time_s - along_m * pattern.period_s / pattern.wavelength_m;
                let number = (local_s / cycle_s).floor();
                let share = (local_s - number * cycle_s) / pattern.period_s;
                if share >= 1.0 { 0.0 } else { strength.of(number as i64, 0) * bump(share) }
            }
            Contraction::Segmental => {
                let number = (time_s / cycle_s).floor();
                let share = (time_s - number * cycle_s) / pattern.period_s;
                let segment = (along_m / pattern.wavelength_m).floor();
                let is_active = (number as i64 + segment as i64) % 2 == 0;
                if share >= 1.0 || !is_active {
                    return 0.0;
                }
                let across = bump(along_m / pattern.wavelength_m - segment);
                strength.of(number as i64, segment as i64) * bump(share) * across
            }
        };
        knots_m.map(closing_m).map(|share| share * self.amplitude_m).collect()
    }

    /// Strength of a contraction, 0 to 1: each has its own stream of the seed.
    fn strength(&self, number: i64, segment: i64) -> f64 {
        if self.pattern.irregularity == 0.0 {
            return 1.0;
        }
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream((number as u64) << 16 ^ segment as u64);
        1.0 - self.pattern.irregularity * rng.random::<f64>()
    }
}

/// Keeps the strength of the last contraction: neighbouring places are mostly in the same one.
struct Strength<'a> {
    motion: &'a WallMotion,
    of: Option<(i64, i64, f64)>,
}

impl Strength<'_> {
    fn of(&mut self, number: i64, segment: i64) -> f64 {
        match self.of {
            Some((n, s, strength)) if (n, s) == (number, segment) => strength,
            _ => {
                let strength = self.motion.strength(number, segment);
                self.of = Some((number, segment, strength));
                strength
            }
        }
    }
}
