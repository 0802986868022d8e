//! Two controllers at the same trials.

use serde::Serialize;

use super::statistics::{PairedCounts, mean95};
use super::{Cell, Episode};

/// Two controllers compared trial by trial, with the same starts, goals, seeds and disturbances.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// Controller that is compared.
    pub controller: String,
    /// Controller that it is compared with.
    pub against: String,
    pub episodes: u32,
    /// Trials delivered by both.
    pub both: u32,
    /// Trials delivered by the first only.
    pub first_only: u32,
    /// Trials delivered by the second only.
    pub second_only: u32,
    /// Trials delivered by neither.
    pub neither: u32,
    /// Share delivered by the first minus that by the second.
    pub delivered_difference: f64,
    /// Its 95 % interval (Newcombe 1998, method 10).
    pub delivered_difference95: [f64; 2],
    /// Control steps of the first minus those of the second, where both delivered.
    pub steps: Option<PairedMean>,
    /// The same for the mean distance of tool and bead during transport.
    pub tracking_error_mean_m: Option<PairedMean>,
    /// The same for path ÷ shortest path.
    pub path_ratio: Option<PairedMean>,
}

/// A mean difference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PairedMean {
    pub mean: f64,
    /// Its 95 % interval (Student's t).
    pub interval95: [f64; 2],
}

impl Comparison {
    /// Compares two rows with the same trials.
    fn of(first: (&Cell, &[Episode]), second: (&Cell, &[Episode])) -> Self {
        let pairs: Vec<(&Episode, &Episode)> = first.1.iter().zip(second.1).collect();
        let count = |wanted: [bool; 2]| {
            pairs.iter().filter(|(one, other)| [one.delivered, other.delivered] == wanted).count() as u32
        };
        let counts = PairedCounts {
            both: count([true, true]),
            first: count([true, false]),
            second: count([false, true]),
            neither: count([false, false]),
        };
        let (delivered_difference, delivered_difference95) = counts.difference95();
        let paired = |value: &dyn Fn(&Episode) -> Option<f64>| {
            let both = pairs.iter().filter(|(one, other)| one.delivered && other.delivered);
            let differences: Vec<f64> = both.filter_map(|(one, other)| Some(value(one)? - value(other)?)).collect();
            mean95(&differences).map(|(mean, interval95)| PairedMean { mean, interval95 })
        };
        Self {
            map: first.0.map.clone(),
            disturbances: first.0.disturbances,
            controller: first.0.controller.as_str().to_owned(),
            against: second.0.controller.as_str().to_owned(),
            episodes: pairs.len() as u32,
            both: counts.both,
            first_only: counts.first,
            second_only: counts.second,
            neither: counts.neither,
            delivered_difference,
            delivered_difference95,
            steps: paired(&|episode| Some(f64::from(episode.steps))),
            tracking_error_mean_m: paired(&|episode| Some(episode.tally.mean_m())),
            path_ratio: paired(&|episode| episode.path_ratio),
        }
    }

    /// Compares every pair of controllers with the same map and disturbances, in the order of the rows.
    pub fn all(rows: &[(&Cell, &[Episode])]) -> Vec<Self> {
        let mut made = Vec::new();
        for (place, &first) in rows.iter().enumerate() {
            let alike = |second: &&(&Cell, &[Episode])| {
                second.0.map == first.0.map
                    && second.0.disturbances == first.0.disturbances
                    && second.0.controller != first.0.controller
            };
            made.extend(rows[place + 1..].iter().filter(alike).map(|&second| Self::of(first, second)));
        }
        made
    }
}
