//! The walls' outline with the coordinate along the lumen, from which the page draws walls that move.

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_core::plant;
use ferry_core::schema::Numbers2;
use ferry_core::trial::{Arena, Moment};

/// The lumen of a session's map. What the walls cover beyond their drawn place is a disc around each point of it, of the
/// radius `min(wave, limit_m, room)` at vertices and linear between them. The wave is `StateMessage.wave_m`, interpolated
/// between knots at `along_m / knot_m`; `room` is the distance from the bead's surface, at least 0: walls stop at the bead.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Lumen {
    /// Name of the map.
    pub map: String,
    /// Spacing of the knots along the lumen.
    pub knot_m: f64,
    /// Closed outlines of the free space, which is on their left.
    pub rings: Vec<WallRing>,
}

/// A closed outline: one entry per vertex in each list.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct WallRing {
    /// Where the wall is at rest.
    #[schema(value_type = Vec<Numbers2>)]
    pub place_m: Vec<[f64; 2]>,
    /// Coordinate along the lumen.
    pub along_m: Vec<f64>,
    /// The most that it closes in.
    pub limit_m: Vec<f64>,
}

impl Lumen {
    pub fn of(map: &str, lumen: &plant::Lumen) -> Self {
        let rings = lumen.rings().map(|ring| WallRing {
            place_m: ring.iter().map(|vertex| <[f64; 2]>::from(vertex.place_m).map(short_m)).collect(),
            along_m: ring.iter().map(|vertex| short_m(vertex.along_m)).collect(),
            limit_m: ring.iter().map(|vertex| short_m(vertex.limit_m)).collect(),
        });
        Self { map: map.to_owned(), knot_m: lumen.knot_m(), rings: rings.collect() }
    }
}

/// How far walls close in at the knots; `None` at rest.
pub(super) fn wave_m(arena: &Arena, moment: &Moment) -> Option<Vec<f64>> {
    let motion = moment.walls.as_ref()?;
    Some(arena.surroundings(0).wave_m(motion, moment.tick).into_iter().map(short_m).collect())
}

/// To hundredths of a millimetre, so that messages stay short.
fn short_m(value_m: f64) -> f64 {
    (value_m * 1e5).round() / 1e5
}
