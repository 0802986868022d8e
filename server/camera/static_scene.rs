//! Walls and floor as triangles for the controllers' view.

use earcut::Earcut;

use super::mesh::{Color, Mesh};
use super::{CameraError, StaticScene};
use ferry_core::geometry::{Point3, Polygon, Rect, Vector3};

const MAX_WALL_M: f64 = 1.0;

/// Colours of the controllers' view. Their Rec. 601 gray meets the brightness contract under any shading: floor and
/// bead are at least 200, walls at most 50.
pub(super) mod controllers {
    use super::Color;

    /// Gray 240.
    pub const FLOOR: Color = [238, 241, 240, 255];
    /// Floor in the shadow of a wall or of the bead: gray 212.
    pub const SHADOW: Color = [208, 213, 216, 255];
    /// Gray 43; also the background.
    pub const WALL_TOP: Color = [62, 34, 40, 255];
    /// Sides that face the light: gray 33.
    pub const WALL_SIDE_LIT: Color = [48, 26, 32, 255];
    /// Sides that face away from the light: gray 18.
    pub const WALL_SIDE_DARK: Color = [28, 13, 18, 255];
    /// Gray 226; 206 at its darkest, with [`BEAD_SHADE`].
    pub const BEAD: Color = [255, 232, 120, 255];
    /// Gray 165, between wall and floor: what the magnet hides is neither.
    pub const MAGNET: Color = [160, 167, 168, 255];
    /// Smallest factor on the bead's colour.
    pub const BEAD_SHADE: f64 = 0.91;
}

/// Shadow offset in x and y per metre of height in the controllers' view: light comes from the upper left.
pub(super) const SHADOW_PER_HEIGHT: [f64; 2] = [0.55, -0.65];
/// Height above the floor at which flat shapes are drawn, so that they do not flicker. It shifts a wall's foot in
/// the image by at most a fiftieth of a pixel.
pub(super) const SHADOW_LIFT_M: f64 = 2e-5;

/// Width of the wall outside the workspace; beyond it the background is equally dark.
const OUTSIDE_M: f64 = 2.0;

/// Refuses geometry that cannot be drawn.
pub(super) fn check(static_scene: &StaticScene) -> Result<(), CameraError> {
    let refuse = |what: String| Err(CameraError::StaticScene { what });
    let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = *static_scene.workspace;
    let finite = [x_min_m, x_max_m, y_min_m, y_max_m].iter().all(|side| side.is_finite());
    if !finite || x_min_m >= x_max_m || y_min_m >= y_max_m {
        return refuse(format!("workspace x {x_min_m} to {x_max_m} m, y {y_min_m} to {y_max_m} m"));
    }
    if !(static_scene.wall_height_m > 0.0 && static_scene.wall_height_m <= MAX_WALL_M) {
        let height_m = static_scene.wall_height_m;
        return refuse(format!("wall height {height_m} m: it must be above 0 and at most 1 m"));
    }
    for (number, wall) in static_scene.walls.iter().enumerate() {
        let odd = |point: &&[f64; 2]| !point.iter().all(|coordinate| coordinate.is_finite());
        if let Some(point) = wall.rings().flatten().find(odd) {
            return refuse(format!("wall {number} has a corner that is not finite: {point:?}"));
        }
    }
    Ok(())
}

/// The mesh of the controllers' view: floor, shadows and walls. Everything outside the workspace is wall.
pub(super) fn controllers_mesh(static_scene: &StaticScene) -> Mesh {
    let mut mesh = Mesh::default();
    floor(&mut mesh, static_scene.workspace, controllers::FLOOR);
    let outside = border(static_scene.workspace, OUTSIDE_M);
    let walls = || static_scene.walls.iter().chain([&outside]);
    for wall in walls() {
        shadow(&mut mesh, wall, static_scene.wall_height_m);
    }
    for wall in walls() {
        let height_m = static_scene.wall_height_m;
        prism(&mut mesh, wall, height_m, controllers::WALL_TOP, side_color);
    }
    mesh
}

/// Colour of a wall's side in the controllers' view, for its outward normal.
pub(super) fn side_color(normal: Vector3<f64>) -> Color {
    let [away_x, away_y] = SHADOW_PER_HEIGHT;
    if normal.x * away_x + normal.y * away_y < 0.0 { controllers::WALL_SIDE_LIT } else { controllers::WALL_SIDE_DARK }
}

/// A frame of width `width_m` around a rectangle.
pub(super) fn border(inner: &Rect, width_m: f64) -> Polygon {
    let (west, east) = (inner.x_min_m, inner.x_max_m);
    let (south, north) = (inner.y_min_m, inner.y_max_m);
    let w = width_m;
    Polygon {
        exterior: vec![[west - w, south - w], [east + w, south - w], [east + w, north + w], [west - w, north + w]],
        holes: vec![vec![[west, south], [west, north], [east, north], [east, south]]],
    }
}

/// The workspace at z = 0.
pub(super) fn floor(mesh: &mut Mesh, workspace: &Rect, color: Color) {
    let corners = [
        Point3::new(workspace.x_min_m, workspace.y_min_m, 0.0),
        Point3::new(workspace.x_max_m, workspace.y_min_m, 0.0),
        Point3::new(workspace.x_max_m, workspace.y_max_m, 0.0),
        Point3::new(workspace.x_min_m, workspace.y_max_m, 0.0),
    ];
    mesh.quad(corners, Vector3::z(), color);
}

/// Top and sides of a wall. `side` returns the colour of a side for its outward normal.
fn prism(mesh: &mut Mesh, wall: &Polygon, height_m: f64, top: Color, side: impl Fn(Vector3<f64>) -> Color) {
    flat(mesh, wall, Vector3::z() * height_m, top);
    for (start, end) in edges(wall) {
        let along = end - start;
        // A wall is on the left of its rings, so outward is to the right.
        let normal = Vector3::new(along.y, -along.x, 0.0);
        if let Some(normal) = normal.try_normalize(0.0) {
            let up = Vector3::z() * height_m;
            mesh.quad([start, end, end + up, start + up], normal, side(normal));
        }
    }
}

/// The shadow of a wall on the floor: its top, moved away from the light, and the area between it and the wall.
/// The areas overlap, which is harmless because all have the same flat colour.
fn shadow(mesh: &mut Mesh, wall: &Polygon, height_m: f64) {
    let [away_x, away_y] = SHADOW_PER_HEIGHT;
    let lift = Vector3::z() * SHADOW_LIFT_M;
    let moved = lift + Vector3::new(away_x, away_y, 0.0) * height_m;
    flat(mesh, wall, moved, controllers::SHADOW);
    for (start, end) in edges(wall) {
        let corners = [start + lift, end + lift, end + moved, start + moved];
        mesh.quad(corners, Vector3::z(), controllers::SHADOW);
    }
}

/// The polygon, facing up, moved by `offset` from z = 0.
pub(super) fn flat(mesh: &mut Mesh, wall: &Polygon, offset: Vector3<f64>, color: Color) {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut holes: Vec<u32> = Vec::new();
    for ring in wall.rings() {
        if !points.is_empty() {
            holes.push(points.len() as u32);
        }
        points.extend_from_slice(ring);
    }
    let mut triangles: Vec<u32> = Vec::new();
    Earcut::new().earcut_slice(&points, &holes, &mut triangles);
    let first = mesh.vertices.len() as u32;
    for [x, y] in points {
        mesh.vertex(Point3::new(x, y, 0.0) + offset, Vector3::z(), color);
    }
    mesh.indices.extend(triangles.iter().map(|at| first + at));
}

/// All edges of all rings at z = 0, with the wall on their left.
fn edges(wall: &Polygon) -> impl Iterator<Item = (Point3<f64>, Point3<f64>)> {
    wall.rings().flat_map(|ring| {
        let next = ring.iter().cycle().skip(1);
        let on_table = |[x, y]: [f64; 2]| Point3::new(x, y, 0.0);
        ring.iter().zip(next).map(move |(start, end)| (on_table(*start), on_table(*end)))
    })
}
