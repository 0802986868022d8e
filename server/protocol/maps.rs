//! Reports about uploaded maps.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use crate::map::{Narrow, Summary};

/// A passage between two rooms of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct NarrowPlace {
    /// Distance between the walls.
    pub width_m: f64,
    pub x_m: f64,
    pub y_m: f64,
}

/// What an uploaded drawing holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct MapReport {
    /// Name of the new map.
    pub name: String,
    pub width_m: f64,
    pub height_m: f64,
    pub walls: usize,
    /// Number of connected parts; the bead cannot pass between them.
    pub regions: usize,
    /// Area of these parts, m².
    pub free_m2: f64,
    /// Diameter of the largest circle between the walls.
    pub widest_m: f64,
    /// The narrowest passage; `null` if there is one room only.
    pub narrowest: Option<NarrowPlace>,
    /// Share of the free area that the tool reaches, from 0 to 1.
    pub reached_share: f64,
    /// Elements that had to be changed or left out, one sentence each.
    pub repairs: Vec<String>,
}

impl From<Narrow> for NarrowPlace {
    fn from(Narrow { width_m, at }: Narrow) -> Self {
        Self { width_m, x_m: at.x, y_m: at.y }
    }
}

impl MapReport {
    pub fn new(name: String, summary: Summary, reached_share: f64) -> Self {
        let Summary { size_m, walls, regions, free_m2, narrowest, widest_m, repairs } = summary;
        let [width_m, height_m] = size_m;
        let narrowest = narrowest.map(NarrowPlace::from);
        Self { name, width_m, height_m, walls, regions, free_m2, widest_m, narrowest, reached_share, repairs }
    }
}
