//! Recovery maps, as `ferry recovery --json` writes them.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::protocol::numbers::Numbers2;
use crate::recovery;

describe! {
    recovery::Kind as RecoveryKind;
    recovery::Outcome as RecoveryOutcome;
    recovery::CellRow as RecoveryCell;
    recovery::Basin as Basin;
    recovery::BasinDifference as BasinDifference;
}

/// How the trials of a recovery map are disturbed.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::recovery::Kind", rename_all = "snake_case")]
#[ts(rename_all = "snake_case")]
pub enum RecoveryKind {
    /// The bead is lifted to each cell of a grid.
    Place,
    /// The bead is pushed in each direction, with each of several forces.
    Push,
    /// A hand pulls the bead in each direction, over each of several distances.
    Drag,
    /// The tracker is blind at each of several times, for each of several durations.
    Blind,
}

/// How a trial of a recovery map ended.
#[derive(Serialize, Deserialize, TS, ToSchema)]
#[serde(remote = "crate::recovery::Outcome", rename_all = "snake_case")]
#[ts(rename_all = "snake_case")]
pub enum RecoveryOutcome {
    Delivered,
    /// Delivered, but after more than `within_s`.
    Late,
    Lost,
}

/// The trials of one controller in one cell.
#[derive(Serialize, TS, ToSchema)]
#[serde(remote = "crate::recovery::CellRow")]
pub struct RecoveryCell {
    /// Number of the cell.
    pub cell: u32,
    /// Centre and size of a square of places.
    pub x_m: Option<f64>,
    pub y_m: Option<f64>,
    pub size_m: Option<f64>,
    /// Direction of a push or drag, counter-clockwise from x.
    pub direction_rad: Option<f64>,
    /// Force of a push in newtons, length of a drag in metres, duration of a loss in seconds.
    pub strength: Option<f64>,
    /// When the tracker becomes blind, after the moment.
    pub at_s: Option<f64>,
    /// Name of the controller, or of the program.
    pub controller: String,
    pub delivered: u32,
    /// Delivered, but after more than `within_s`.
    pub late: u32,
    pub lost: u32,
    /// Trials that have ended.
    pub repeats: u32,
    /// Wilson 95 % interval of `delivered / repeats`.
    #[schema(value_type = Numbers2)]
    pub delivered_wilson95: [f64; 2],
    /// Median time to the delivery, with late ones.
    pub time_s_median: Option<f64>,
    /// How most of the lost trials ended.
    pub why: Option<String>,
}

/// The part of a recovery map from which a controller delivers in time.
#[derive(Serialize, TS, ToSchema)]
#[serde(remote = "crate::recovery::Basin")]
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
#[derive(Serialize, TS, ToSchema)]
#[serde(remote = "crate::recovery::BasinDifference")]
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
