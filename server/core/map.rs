//! Maps: converts an SVG drawing into walls and free space.
//!
//! A [`Map`] is geometry only. Controllers have no access to it; they only see camera images.

mod library;
mod maze;
mod outline;
mod report;
mod space;
mod summary;
mod svg;
#[cfg(test)]
mod tests;

use std::borrow::Cow;

use serde::Serialize;

use crate::geometry::{Point2, Polygon, Rect, Vector2};
use outline::Outline;
use report::Newer;

pub use library::{ADDED_MAPS, Library, is_added};
pub use maze::{Maze, MazeError, MazeFamily};
pub use report::{MapError, Place, Repair, RepairKind};
pub use space::FreeSpace;
pub use summary::{Narrow, Summary};
pub use svg::{check_format, decoded, fit};

/// Height of every wall above the table.
pub const WALL_HEIGHT_M: f64 = 0.005;

pub const MAX_SVG_BYTES: usize = 1 << 20;

/// Version of the reader of drawings. A kept drawing has that of the reader that made walls of it.
///
/// 2: reads CSS and invisible shapes as browsers do, and absolute lengths as millimetres of the table.
/// 3: draws a stroke whose first point is given twice as browsers do.
/// 4: leaves out what is filled between a line and its way back.
pub const READER: u32 = 4;
/// The reader of drawings with which none is noted.
pub const fn first_reader() -> u32 {
    1
}

#[derive(rust_embed::RustEmbed)]
#[folder = "../../assets/maps/"]
#[include = "*.svg"]
struct Shipped;

/// Walls and free space of a workspace, in metres in `base`.
#[derive(Clone, Serialize)]
pub struct Map {
    name: String,
    workspace: Rect,
    walls: Vec<Polygon>,
    free: Vec<Polygon>,
    #[serde(skip)]
    repairs: Vec<Repair>,
    #[serde(skip)]
    newer: Vec<Newer>,
    #[serde(skip)]
    outline: Outline,
    #[serde(skip)]
    for_stage: bool,
    svg: String,
}

impl std::fmt::Debug for Map {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Map").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Map {
    /// Names of the shipped maps, sorted.
    pub fn shipped_names() -> Vec<String> {
        let mut names: Vec<String> = Shipped::iter()
            .filter_map(|file: Cow<'static, str>| file.strip_suffix(".svg").map(str::to_owned))
            .collect();
        names.sort();
        names
    }

    pub fn shipped(name: &str) -> Result<Self, MapError> {
        let file = Shipped::get(&format!("{name}.svg")).ok_or_else(|| MapError::Unknown { name: name.to_owned() })?;
        let text = std::str::from_utf8(&file.data).map_err(|e| MapError::Svg(e.to_string()))?;
        Self::from_svg(name, text)
    }

    /// Reads an SVG (specification §3): user units are millimetres, `x_m = x/1000`, `y_m = −y/1000`, the `viewBox` is
    /// the workspace, filled shapes and strokes are walls. Elements that cannot become walls, or that would cost too
    /// much to load, are refused with an error that names them. Repairs are listed in [`Self::repairs`].
    pub fn from_svg(name: &str, text: &str) -> Result<Self, MapError> {
        let drawing = svg::read(text)?;
        Ok(Self {
            name: name.to_owned(),
            workspace: drawing.workspace,
            walls: drawing.walls,
            outline: Outline::of(&drawing.free),
            free: drawing.free,
            repairs: drawing.repairs,
            newer: drawing.newer,
            for_stage: drawing.for_stage,
            svg: text.to_owned(),
        })
    }

    /// This map, if an older reader has made the same walls of its drawing.
    ///
    /// # Errors
    /// [`MapError::Older`]: that reader no longer exists. [`MapError::Reader`]: it never existed here.
    pub fn as_read_by(self, reader: u32) -> Result<Self, MapError> {
        if !(first_reader()..=READER).contains(&reader) {
            return Err(MapError::Reader { found: reader });
        }
        match self.newer.iter().find(|newer| newer.since > reader) {
            Some(Newer { place, what, .. }) => Err(MapError::Older { place: place.clone(), what }),
            None => Ok(self),
        }
    }

    /// Display name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The viewBox. Its border is a wall.
    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Disjoint walls inside the workspace.
    pub fn walls(&self) -> &[Polygon] {
        &self.walls
    }

    /// Disjoint free space: the workspace without its walls.
    pub fn free(&self) -> &[Polygon] {
        &self.free
    }

    /// Elements that had to be changed or left out, in the drawing's order.
    pub fn repairs(&self) -> &[Repair] {
        &self.repairs
    }

    /// Whether the map is drawn for the planar stage instead of the arm: its root has
    /// `data-positioner="planar-stage"`.
    pub fn is_for_stage(&self) -> bool {
        self.for_stage
    }

    /// Whether the drawing is that of a shipped map, whatever the names.
    pub fn is_drawn_like_shipped(&self, name: &str) -> bool {
        Shipped::get(&format!("{name}.svg")).is_some_and(|file| *file.data == *self.svg.as_bytes())
    }

    /// The text of the SVG file.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// Nearest point of any wall's outline, including the workspace's border.
    pub fn nearest_wall_point(&self, point: Point2<f64>) -> Point2<f64> {
        self.outline.nearest(point)
    }

    /// [`Self::nearest_wall_point`] if it is within `radius_m`; several times faster if so.
    pub fn nearest_wall_point_within(&self, point: Point2<f64>, radius_m: f64) -> Option<Point2<f64>> {
        self.outline.nearest_within(point, radius_m)
    }

    /// Whether a point is in free space (even–odd rule over its outline).
    pub fn is_free(&self, point: Point2<f64>) -> bool {
        self.outline.contains(point)
    }

    /// Distance to the nearest wall: positive in free space, negative inside a wall.
    pub fn clearance_m(&self, point: Point2<f64>) -> f64 {
        let distance = (self.nearest_wall_point(point) - point).norm();
        if self.is_free(point) { distance } else { -distance }
    }

    /// Whether a disc of radius `clearance_m` can move along the straight line from `from` to `to`.
    pub fn line_is_clear(&self, from: Point2<f64>, to: Point2<f64>, clearance_m: f64) -> bool {
        let span: Vector2<f64> = to - from;
        let length_m = span.norm();
        let mut along_m = 0.0;
        // Sphere tracing: the clearance at a point is a safe step length.
        loop {
            let fraction = if length_m > 0.0 { along_m / length_m } else { 0.0 };
            let margin_m = self.clearance_m(from + span * fraction) - clearance_m;
            if margin_m < 0.0 {
                return false;
            }
            if along_m >= length_m {
                return true;
            }
            along_m = (along_m + margin_m.max(5e-4)).min(length_m);
        }
    }
}
