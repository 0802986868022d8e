//! Two controllers at the same trials.

use ferry_core::schema::Numbers2;
use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

use super::statistics::{LEVEL, PairedCounts, corrected_level, mean};
use super::{Cell, Episode, Setting};

/// Two controllers compared trial by trial, with the same starts, goals, seeds and disturbances.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Comparison {
    pub map: String,
    /// Scripted disturbances per trial.
    pub disturbances: u32,
    /// What varied parameters are in both rows.
    pub varied: Vec<Setting>,
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
    #[schema(value_type = Numbers2)]
    pub delivered_difference95: [f64; 2],
    /// The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
    #[schema(value_type = Numbers2)]
    pub delivered_difference_corrected: [f64; 2],
    /// Control steps of the first minus those of the second, where both delivered.
    pub steps: Option<PairedMean>,
    /// The same for the mean distance of tool and bead during transport.
    pub tracking_error_mean_m: Option<PairedMean>,
    /// The same for path ÷ shortest path.
    pub path_ratio: Option<PairedMean>,
    /// Control steps over all trials. One that was not delivered counts with all steps that its legs may take.
    pub steps_of_all: Option<PairedMean>,
    /// Path ÷ shortest path over all trials. One that was not delivered counts with the path of all these steps.
    pub path_ratio_of_all: Option<PairedMean>,
}

/// A mean difference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct PairedMean {
    pub mean: f64,
    /// Its 95 % interval (Student's t).
    #[schema(value_type = Numbers2)]
    pub interval95: [f64; 2],
    /// The interval at the level that is corrected for the number of comparisons in the report (Bonferroni).
    #[schema(value_type = Numbers2)]
    pub interval_corrected: [f64; 2],
}

impl Comparison {
    /// Compares two rows with the same trials; `level` is that of the corrected intervals.
    fn of(first: (&Cell, &[Episode]), second: (&Cell, &[Episode]), level: f64) -> Self {
        let pairs: Vec<(&Episode, &Episode)> = first.1.iter().zip(second.1).collect();
        let count = |wanted: [bool; 2]| {
            pairs.iter().filter(|(one, other)| [one.delivered, other.delivered] == wanted).count() as u32
        };
        let [both, first_only, second_only, neither] =
            [[true, true], [true, false], [false, true], [false, false]].map(count);
        let counts = PairedCounts {
            both: both.into(),
            first: first_only.into(),
            second: second_only.into(),
            neither: neither.into(),
        };
        let (delivered_difference, delivered_difference95) = counts.difference(LEVEL);
        let over = |is_counted: &dyn Fn(&Episode) -> bool, value: &dyn Fn(&Episode) -> Option<f64>| {
            let counted = pairs.iter().filter(|(one, other)| is_counted(one) && is_counted(other));
            let differences: Vec<f64> = counted.filter_map(|(one, other)| Some(value(one)? - value(other)?)).collect();
            let (mean, interval95) = mean(&differences, LEVEL)?;
            let (_, interval_corrected) = super::statistics::mean(&differences, level)?;
            Some(PairedMean { mean, interval95, interval_corrected })
        };
        let paired = |value: &dyn Fn(&Episode) -> Option<f64>| over(&|episode| episode.delivered, value);
        let of_all = |value: &dyn Fn(&Episode) -> Option<f64>| over(&|_| true, value);
        Self {
            map: first.0.map.clone(),
            disturbances: first.0.disturbances,
            varied: first.0.varied.clone(),
            controller: first.0.controller().to_owned(),
            against: second.0.controller().to_owned(),
            episodes: pairs.len() as u32,
            both,
            first_only,
            second_only,
            neither,
            delivered_difference,
            delivered_difference95,
            delivered_difference_corrected: counts.difference(level).1,
            steps: paired(&|episode| Some(f64::from(episode.steps))),
            tracking_error_mean_m: paired(&|episode| Some(episode.tally.mean_m())),
            path_ratio: paired(&|episode| episode.path_ratio),
            steps_of_all: of_all(&|episode| Some(f64::from(episode.steps_or_limit()))),
            path_ratio_of_all: of_all(&|episode| episode.path_ratio_or_limit()),
        }
    }

    /// Compares every pair of controllers with the same map, disturbances and parameters, in the order of the rows.
    pub fn all(rows: &[(&Cell, &[Episode])]) -> Vec<Self> {
        let alike = |first: &(&Cell, &[Episode]), second: &(&Cell, &[Episode])| {
            second.0.map == first.0.map
                && second.0.disturbances == first.0.disturbances
                && second.0.varied == first.0.varied
                && second.0.controller() != first.0.controller()
        };
        let mut pairs = Vec::new();
        for (place, &first) in rows.iter().enumerate() {
            pairs
                .extend(rows[place + 1..].iter().filter(|second| alike(&first, second)).map(|&second| (first, second)));
        }
        let level = corrected_level(pairs.len());
        pairs.into_iter().map(|(first, second)| Self::of(first, second, level)).collect()
    }
}
