//! Maps: an SVG drawing becomes walls, and the space between them.
//!
//! A [`Map`] knows geometry only. Controllers never see it: they see camera images.

mod space;
mod svg;

use std::borrow::Cow;

use parry2d_f64::{math::Vector, query::PointQuery, shape::Polyline};
use serde::Serialize;

use crate::geometry::{Point2, Polygon, Rect, Vector2};

pub use space::FreeSpace;

/// Height of every wall's prism above the table.
pub const WALL_HEIGHT_M: f64 = 0.005;

/// Largest map file that is read.
pub const MAX_SVG_BYTES: usize = 1 << 20;

#[derive(rust_embed::RustEmbed)]
#[folder = "assets/maps/"]
#[include = "*.svg"]
struct Shipped;

/// Why a map was refused.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// No map of that name is shipped.
    #[error("map: there is no map named {name:?}; there are {known}", known = known_maps())]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// The file could not be read.
    #[error("map: {path}: {error}")]
    Io {
        /// The path asked for.
        path: String,
        /// What the system said.
        error: std::io::Error,
    },
    /// The file is larger than [`MAX_SVG_BYTES`].
    #[error("map: the file has {bytes} bytes, the limit is {MAX_SVG_BYTES}")]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// Not well-formed, or not SVG.
    #[error("map: not a readable SVG: {0}")]
    Svg(String),
    /// The root has no usable `viewBox`, which gives the workspace.
    #[error("map: viewBox {value:?}: {reason}")]
    ViewBox {
        /// The attribute as written.
        value: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The drawing uses something that cannot become a wall.
    #[error("map: <{element}>{id} at line {line}: {reason}")]
    Element {
        /// Tag name.
        element: String,
        /// ` id="…"`, or nothing.
        id: String,
        /// Line of the file.
        line: u32,
        /// Why, and what to do instead.
        reason: &'static str,
    },
    /// The walls leave no space for the bead.
    #[error("map: the walls leave no free space in the workspace")]
    NoFreeSpace,
}

fn known_maps() -> String {
    Map::shipped_names().join(", ")
}

/// Walls and free space of a workspace, in metres in `base`.
#[derive(Clone, Serialize)]
pub struct Map {
    name: String,
    workspace: Rect,
    walls: Vec<Polygon>,
    free: Vec<Polygon>,
    #[serde(skip)]
    boundary: Polyline,
    svg: String,
}

impl std::fmt::Debug for Map {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Map").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Map {
    /// Names of the maps that come with Ferry, sorted.
    pub fn shipped_names() -> Vec<String> {
        let mut names: Vec<String> = Shipped::iter()
            .filter_map(|file: Cow<'static, str>| file.strip_suffix(".svg").map(str::to_owned))
            .collect();
        names.sort();
        names
    }

    /// A map that comes with Ferry.
    pub fn shipped(name: &str) -> Result<Self, MapError> {
        let file = Shipped::get(&format!("{name}.svg")).ok_or_else(|| MapError::Unknown { name: name.to_owned() })?;
        let text = std::str::from_utf8(&file.data).map_err(|e| MapError::Svg(e.to_string()))?;
        Self::from_svg(name, text)
    }

    /// A shipped map by name, or a file when `name_or_path` ends in `.svg`.
    pub fn open(name_or_path: &str) -> Result<Self, MapError> {
        if !name_or_path.ends_with(".svg") {
            return Self::shipped(name_or_path);
        }
        let io = |error| MapError::Io { path: name_or_path.to_owned(), error };
        let path = std::path::Path::new(name_or_path);
        let bytes = std::fs::metadata(path).map_err(io)?.len() as usize;
        if bytes > MAX_SVG_BYTES {
            return Err(MapError::TooLarge { bytes });
        }
        let text = std::fs::read_to_string(path).map_err(io)?;
        let name = path.file_stem().map_or("map".into(), |stem| stem.to_string_lossy());
        Self::from_svg(&name, &text)
    }

    /// Reads an SVG (specification §3): user units are millimetres, `x_m = x/1000`, `y_m = −y/1000`,
    /// the `viewBox` is the workspace, filled shapes and strokes are walls.
    pub fn from_svg(name: &str, text: &str) -> Result<Self, MapError> {
        let drawing = svg::read(text)?;
        let boundary = boundary_of(&drawing.free);
        Ok(Self {
            name: name.to_owned(),
            workspace: drawing.workspace,
            walls: drawing.walls,
            free: drawing.free,
            boundary,
            svg: text.to_owned(),
        })
    }

    /// Name, for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The viewBox; its border is a wall.
    pub fn workspace(&self) -> &Rect {
        &self.workspace
    }

    /// Walls inside the workspace, disjoint.
    pub fn walls(&self) -> &[Polygon] {
        &self.walls
    }

    /// Free space: the workspace without its walls, disjoint.
    pub fn free(&self) -> &[Polygon] {
        &self.free
    }

    /// The file it was read from.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// Nearest point of any wall's outline, the workspace's border included.
    pub fn nearest_wall_point(&self, point: Point2<f64>) -> Point2<f64> {
        let nearest = self.boundary.project_local_point(Vector::new(point.x, point.y), false).point;
        Point2::new(nearest.x, nearest.y)
    }

    /// Whether a point lies in free space (even–odd rule over its outline).
    pub fn is_free(&self, point: Point2<f64>) -> bool {
        let mut inside = false;
        for segment in self.boundary.segments() {
            let (a, b) = (segment.a, segment.b);
            if (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x {
                inside = !inside;
            }
        }
        inside
    }

    /// Distance to the nearest wall: positive in free space, negative inside a wall.
    pub fn clearance_m(&self, point: Point2<f64>) -> f64 {
        let distance = (self.nearest_wall_point(point) - point).norm();
        if self.is_free(point) { distance } else { -distance }
    }

    /// Whether a disc of radius `clearance_m` passes along the straight line from `from` to `to`.
    pub fn line_is_clear(&self, from: Point2<f64>, to: Point2<f64>, clearance_m: f64) -> bool {
        let span: Vector2<f64> = to - from;
        let length_m = span.norm();
        let mut along_m = 0.0;
        // Sphere tracing: the clearance at a point is how far one may go without looking again.
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

fn boundary_of(free: &[Polygon]) -> Polyline {
    let mut vertices = Vec::new();
    let mut indices = Vec::new();
    for ring in free.iter().flat_map(Polygon::rings) {
        let first = vertices.len() as u32;
        let count = ring.len() as u32;
        vertices.extend(ring.iter().map(|&[x, y]| Vector::new(x, y)));
        indices.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
    }
    Polyline::new(vertices, Some(indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square_post() -> Map {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">
            <rect x="-20" y="280" width="40" height="40"/></svg>"#;
        Map::from_svg("square", svg).unwrap()
    }

    #[test]
    fn millimetres_become_metres_and_y_points_up() {
        let map = square_post();
        let w = map.workspace();
        assert_eq!([w.x_min_m, w.x_max_m, w.y_min_m, w.y_max_m], [-0.1, 0.1, -0.4, -0.2]);
        assert_eq!(map.walls().len(), 1);
        for [x, y] in &map.walls()[0].exterior {
            assert!((x.abs() - 0.02).abs() < 1e-6 && ((y + 0.3).abs() - 0.02).abs() < 1e-6);
        }
    }

    #[test]
    fn clearance_is_signed_and_counts_the_border() {
        let map = square_post();
        let clearance = |x, y| map.clearance_m(Point2::new(x, y));
        assert!((clearance(0.05, -0.3) - 0.03).abs() < 1e-6);
        assert!((clearance(0.0, -0.3) + 0.02).abs() < 1e-6);
        assert!((clearance(0.095, -0.3) - 0.005).abs() < 1e-6);
        assert!(clearance(0.2, -0.3) < 0.0);
    }

    #[test]
    fn a_line_is_blocked_by_a_post_and_by_too_narrow_a_gap() {
        let map = square_post();
        let (left, right) = (Point2::new(-0.08, -0.3), Point2::new(0.08, -0.3));
        assert!(!map.line_is_clear(left, right, 0.0));
        let (low_left, low_right) = (Point2::new(-0.06, -0.36), Point2::new(0.06, -0.36));
        assert!(map.line_is_clear(low_left, low_right, 0.03));
        assert!(!map.line_is_clear(low_left, low_right, 0.045));
    }

    #[test]
    fn every_shipped_map_loads_and_has_the_papers_coordinates_free() {
        // Specification §3: these are free with at least 1 cm of clearance on the colon.
        let colon = Map::shipped("colon").unwrap();
        for (x, y) in
            [(-0.24, -0.27), (0.19, -0.28), (0.21, -0.34), (0.20, -0.47), (-0.19, -0.48), (-0.24, -0.28), (0.21, -0.40)]
        {
            let clearance_m = colon.clearance_m(Point2::new(x, y));
            assert!(clearance_m >= 0.01, "({x}, {y}) has {clearance_m} m");
        }
        for name in Map::shipped_names() {
            Map::shipped(&name).unwrap();
        }
    }

    #[test]
    fn the_planar_stage_has_the_papers_coordinates_free() {
        // Paper, Examples 1 and 2; beyond the arm's reach, so not among the shipped maps yet.
        let svg = include_str!("../assets/planar/attractor-example.svg");
        let stage = Map::from_svg("attractor-example", svg).unwrap();
        for (x, y) in [(-0.78, 0.73), (0.77, 0.19), (0.72, 0.76), (-0.77, 0.12), (-0.21, 0.55), (0.42, 0.55)] {
            assert!(stage.clearance_m(Point2::new(x, y)) >= 0.03, "({x}, {y})");
        }
    }

    #[test]
    fn an_unknown_name_lists_the_known_ones() {
        let message = Map::shipped("nowhere").unwrap_err().to_string();
        assert!(message.contains("nowhere") && message.contains("colon"), "{message}");
    }
}
