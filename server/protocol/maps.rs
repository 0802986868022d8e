//! Reports about drawings of maps.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::geometry::{Polygon, Rect};
use ferry_core::map::{Map, Narrow, Summary};
use ferry_core::plant::PositionerKind;

/// A passage between two rooms of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct NarrowPlace {
    /// Distance between the walls.
    pub width_m: f64,
    pub x_m: f64,
    pub y_m: f64,
}

/// What a drawing holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct MapFacts {
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

/// A map that was added.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct MapReport {
    /// Name of the new map.
    pub name: String,
    #[serde(flatten)]
    pub facts: MapFacts,
}

/// A drawing as a map, which is not added.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct MapCheck {
    #[serde(flatten)]
    pub facts: MapFacts,
    /// The passages between its rooms, the narrowest first, at most 30.
    pub passages: Vec<NarrowPlace>,
    pub workspace: Rect,
    /// What moves the magnet over this map.
    pub positioner: PositionerKind,
    /// Its walls, in metres, without the border.
    pub outlines: Vec<Polygon>,
}

/// Most passages of a check.
const MOST_PASSAGES: usize = 30;

impl From<&Narrow> for NarrowPlace {
    fn from(&Narrow { width_m, at }: &Narrow) -> Self {
        Self { width_m, x_m: at.x, y_m: at.y }
    }
}

impl MapFacts {
    pub fn new(summary: &Summary, reached_share: f64) -> Self {
        let &Summary { size_m: [width_m, height_m], walls, regions, free_m2, ref passages, widest_m, ref repairs } =
            summary;
        let (narrowest, repairs) = (passages.first().map(NarrowPlace::from), repairs.clone());
        Self { width_m, height_m, walls, regions, free_m2, widest_m, narrowest, reached_share, repairs }
    }
}

impl MapCheck {
    pub fn new(map: &Map, summary: &Summary, reached_share: f64) -> Self {
        Self {
            facts: MapFacts::new(summary, reached_share),
            passages: summary.passages.iter().take(MOST_PASSAGES).map(NarrowPlace::from).collect(),
            workspace: *map.workspace(),
            positioner: PositionerKind::of(map),
            outlines: map.walls().to_vec(),
        }
    }
}
