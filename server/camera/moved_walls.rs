//! Walls that have moved: what they cover beyond their drawn place, as triangles that are made for each frame.

use super::diorama;
use super::mesh::Mesh;
use super::static_scene::{SHADOW_LIFT_M, SHADOW_PER_HEIGHT, controllers, side_color};
use ferry_core::geometry::{Band, Point3, Rect, Vector3};
use ferry_core::image::Pinhole;

/// A wall that moved less than this is drawn at rest.
const LEAST_M: f64 = 1e-5;
/// Moved walls are drawn this far beyond the image's border.
const BESIDE_M: f64 = 0.02;

fn at(point: [f64; 2]) -> Point3<f64> {
    Point3::new(point[0], point[1], 0.0)
}

/// Pieces of bands that have moved and that touch an area: both ends of the foot, and both of the edge.
fn pieces<'a>(bands: &'a [Band], area: &'a Rect) -> impl Iterator<Item = [Point3<f64>; 4]> + 'a {
    let piece = |band: &'a Band, first: usize| {
        let next = if first + 1 == band.foot_m.len() { 0 } else { first + 1 };
        [band.foot_m[first], band.foot_m[next], band.edge_m[first], band.edge_m[next]].map(at)
    };
    let all = bands.iter().flat_map(move |band| (0..band.foot_m.len()).map(move |first| piece(band, first)));
    all.filter(|[foot_a, foot_b, edge_a, edge_b]| {
        let has_moved = (foot_a - edge_a).norm().max((foot_b - edge_b).norm()) > LEAST_M;
        let is_near = |point: &Point3<f64>| area.contains(point.xy());
        has_moved && (is_near(edge_a) || is_near(edge_b) || is_near(foot_a))
    })
}

/// For the controllers' view: tops, visible sides and shadows that it may see. What is nearest comes first, so that little
/// is drawn twice.
pub(super) fn controllers_mesh(bands: &[Band], height_m: f64, pinhole: &Pinhole) -> Mesh {
    let mut mesh = Mesh::default();
    let [away_x, away_y] = SHADOW_PER_HEIGHT;
    let lift = Vector3::z() * SHADOW_LIFT_M;
    let away = Vector3::new(away_x, away_y, 0.0) * height_m;
    let up = Vector3::z() * height_m;
    let mut edges = Vec::new();
    for [foot_a, foot_b, edge_a, edge_b] in pieces(bands, &in_view(pinhole)) {
        mesh.quad([foot_a + up, foot_b + up, edge_b + up, edge_a + up], Vector3::z(), controllers::WALL_TOP);
        let along = edge_b - edge_a;
        // Free space is on the left.
        let normal = Vector3::new(-along.y, along.x, 0.0).try_normalize(0.0);
        edges.extend(normal.map(|normal| (edge_a, edge_b, normal)));
    }
    // A side that faces away from the eye is below its top.
    let eye = Point3::from(pinhole.position_m);
    for &(a, b, normal) in edges.iter().filter(|(a, _, normal)| normal.dot(&(eye - a)) > 0.0) {
        mesh.quad([a, b, b + up, a + up], normal, side_color(normal));
    }
    // The shadow of an edge that faces the light is below the wall, or part of another edge's.
    for &(a, b, _) in edges.iter().filter(|(.., normal)| normal.dot(&away) > 0.0) {
        mesh.quad([a + lift, b + lift, b + lift + away, a + lift + away], Vector3::z(), controllers::SHADOW);
    }
    mesh
}

/// The table that a camera may see, and a piece of wall more.
fn in_view(pinhole: &Pinhole) -> Rect {
    let corners = pinhole.table_corners_m().unwrap_or_default();
    let mut area =
        Rect { x_min_m: f64::INFINITY, x_max_m: f64::NEG_INFINITY, y_min_m: f64::INFINITY, y_max_m: f64::NEG_INFINITY };
    for corner in corners {
        area.x_min_m = area.x_min_m.min(corner.x - BESIDE_M);
        area.x_max_m = area.x_max_m.max(corner.x + BESIDE_M);
        area.y_min_m = area.y_min_m.min(corner.y - BESIDE_M);
        area.y_max_m = area.y_max_m.max(corner.y + BESIDE_M);
    }
    area
}

/// For people.
pub(super) fn people_mesh(bands: &[Band], height_m: f64, workspace: &Rect) -> Mesh {
    let mut mesh = Mesh::default();
    for [foot_a, foot_b, edge_a, edge_b] in pieces(bands, workspace) {
        let top = Vector3::z() * height_m;
        mesh.quad([foot_a + top, foot_b + top, edge_b + top, edge_a + top], Vector3::z(), diorama::TISSUE_TOP);
    }
    diorama::moved_edges(&mut mesh, workspace, bands, height_m);
    mesh
}
