//! The static scene for people: the maze as tissue in a tray, on the table that also carries the robot.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::mesh::{Color, Mesh};
use super::static_scene::{SHADOW_LIFT_M, border, flat, floor};
use super::{BEAD_RADIUS_M, StaticScene};
use ferry_core::geometry::{Band, Point3, Polygon, Rect, Vector3};

/// Colours before lighting.
mod colors {
    use super::Color;

    /// The bottom of a channel.
    pub const FLOOR: Color = [250, 222, 208, 255];
    pub const TISSUE: Walls = Walls {
        ground: FLOOR,
        floor: [238, 178, 164, 255],
        foot: [216, 132, 122, 255],
        side: [196, 84, 84, 255],
        lip: [255, 192, 180, 255],
        edge: [192, 70, 74, 255],
        top: [228, 136, 124, 255],
    };
    /// The side of the tray that faces the tissue.
    pub const TRAY_INSIDE: Walls = Walls {
        ground: FLOOR,
        floor: [238, 206, 194, 255],
        foot: [206, 190, 188, 255],
        side: [186, 192, 200, 255],
        lip: [236, 239, 243, 255],
        edge: [214, 219, 226, 255],
        top: [214, 219, 226, 255],
    };
    /// The side of the tray that faces the table.
    pub const TRAY_OUTSIDE: Walls =
        Walls { ground: TABLE_TOP, floor: [146, 157, 172, 255], foot: [124, 134, 148, 255], ..TRAY_INSIDE };
    pub const TABLE_TOP: Color = [168, 180, 196, 255];
    pub const TABLE_SIDE: Color = [124, 134, 148, 255];

    /// Colours of a wall and of the floor beside it, from the floor up.
    pub struct Walls {
        /// The floor away from the wall.
        pub ground: Color,
        /// The floor where the fillet begins.
        pub floor: Color,
        pub foot: Color,
        pub side: Color,
        pub lip: Color,
        /// Directly behind the lip: the cut through the gut's wall.
        pub edge: Color,
        pub top: Color,
    }
}

/// Width of the tray's border.
const BORDER_M: f64 = 0.008;
/// Margin of the table around everything it carries.
const TABLE_MARGIN_M: f64 = 0.020;
/// Radius of the table's corners.
const TABLE_CORNER_M: f64 = 0.015;
/// Half the side of the table area for the robot's foot.
const FOOT_M: f64 = 0.09;
/// Width of the lip along a wall's upper edge.
const LIP_M: f64 = 0.0022;
/// Distance from a wall within which the floor darkens.
const BLUSH_M: f64 = 0.014;
/// Width of the band behind the lip.
const BAND_M: f64 = 0.011;
/// Shorter wall edges are skipped in everything that is drawn along edges.
const SHORTEST_EDGE_M: f64 = 1e-4;
/// Smallest spacing of the [`GroundPlan`] grid, and its largest number of cells along a side.
const MIN_CELL_M: f64 = 0.001;
const MAX_CELLS: f64 = 2000.0;
/// Cosine of the turn from which a wall corner counts as sharp.
const SHARP_COSINE: f64 = 0.7;
pub(super) const TABLE_THICKNESS_M: f64 = 0.020;
/// The table's top is this much lower than the floor; at the same height the two would flicker.
const TABLE_GAP_M: f64 = 0.001;

pub(super) const TISSUE_TOP: Color = colors::TISSUE.top;

/// The edges of walls that move, wherever they are now.
pub(super) fn moved_edges(mesh: &mut Mesh, workspace: &Rect, bands: &[Band], height_m: f64) {
    for mut ring in Band::outlines(bands) {
        // Walls are on the left of the rings that are drawn.
        ring.reverse();
        for edge in smooth_edges(&ring).into_iter().filter(|[start, end]| !on_edge(workspace, start.at_m, end.at_m)) {
            strips(mesh, edge, [profile(&colors::TISSUE, height_m, LIP_M); 2]);
        }
    }
}

/// The edges of walls at rest.
pub(super) fn edges_mesh(static_scene: &StaticScene) -> Mesh {
    let mut mesh = Mesh::default();
    let height_m = static_scene.wall_height_m;
    let ground_plan = GroundPlan::of(static_scene);
    for wall in static_scene.walls {
        // The tray covers walls that touch it.
        let free = |[start, end]: &[Corner; 2]| !on_edge(static_scene.workspace, start.at_m, end.at_m);
        for edge in wall.rings().flat_map(smooth_edges).filter(free) {
            let [start_m, end_m] = edge.map(|corner| ground_plan.inside_m(corner.at_m, -corner.outward, BAND_M));
            // From the end of a fold to its root, the band must not widen so fast that it leaves the fold.
            let bands_m = [start_m.min(1.5 * end_m), end_m.min(1.5 * start_m)];
            strips(&mut mesh, edge, bands_m.map(|band_m| profile(&colors::TISSUE, height_m, band_m)));
        }
    }
    mesh
}

/// Floor and walls without their edges in a tray, on a table that also carries the robot.
pub(super) fn mesh(static_scene: &StaticScene) -> Mesh {
    let mut mesh = Mesh::default();
    floor(&mut mesh, static_scene.workspace, colors::FLOOR);
    let height_m = static_scene.wall_height_m;
    for wall in static_scene.walls {
        flat(&mut mesh, wall, Vector3::z() * height_m, colors::TISSUE.top);
    }
    let tray = border(static_scene.workspace, BORDER_M);
    flat(&mut mesh, &tray, Vector3::z() * height_m, colors::TRAY_INSIDE.top);
    for (ring, colors) in tray.rings().zip([colors::TRAY_OUTSIDE, colors::TRAY_INSIDE]) {
        for edge in smooth_edges(ring) {
            strips(&mut mesh, edge, [profile(&colors, height_m, LIP_M); 2]);
        }
    }

    let slab = Polygon { exterior: rounded_corners(&table(static_scene.workspace)), holes: vec![] };
    flat(&mut mesh, &slab, Vector3::z() * -TABLE_GAP_M, colors::TABLE_TOP);
    let side = |depth_m, eighths, color| Rib { aside_m: 0.0, up_m: -TABLE_GAP_M - depth_m, eighths, color };
    // Lit as if the upper edge were rounded.
    let sides = [
        side(TABLE_THICKNESS_M, 0, colors::TABLE_SIDE),
        side(0.003, 0, colors::TABLE_SIDE),
        side(0.0, 2, colors::TABLE_TOP),
    ];
    for edge in smooth_edges(&slab.exterior) {
        strips(&mut mesh, edge, [sides; 2]);
    }
    mesh
}

/// The table under workspace and robot.
pub(super) fn table(workspace: &Rect) -> Rect {
    // The robot's foot is at the origin.
    let carried = grown(workspace, BORDER_M);
    let around = Rect {
        x_min_m: carried.x_min_m.min(-FOOT_M),
        x_max_m: carried.x_max_m.max(FOOT_M),
        y_min_m: carried.y_min_m.min(-FOOT_M),
        y_max_m: carried.y_max_m.max(FOOT_M),
    };
    grown(&around, TABLE_MARGIN_M)
}

fn grown(area: &Rect, margin_m: f64) -> Rect {
    Rect {
        x_min_m: area.x_min_m - margin_m,
        x_max_m: area.x_max_m + margin_m,
        y_min_m: area.y_min_m - margin_m,
        y_max_m: area.y_max_m + margin_m,
    }
}

/// A rectangle with rounded corners, counter-clockwise.
fn rounded_corners(area: &Rect) -> Vec<[f64; 2]> {
    let inner = grown(area, -TABLE_CORNER_M);
    let corners = [
        [inner.x_max_m, inner.y_max_m],
        [inner.x_min_m, inner.y_max_m],
        [inner.x_min_m, inner.y_min_m],
        [inner.x_max_m, inner.y_min_m],
    ];
    let steps = 8;
    let arc = |(quarter, [x_m, y_m]): (usize, [f64; 2])| {
        (0..=steps).map(move |step| {
            let (sin, cos) = (FRAC_PI_2 * (quarter as f64 + f64::from(step) / f64::from(steps))).sin_cos();
            [x_m + TABLE_CORNER_M * cos, y_m + TABLE_CORNER_M * sin]
        })
    };
    corners.into_iter().enumerate().flat_map(arc).collect()
}

/// Whether an edge lies on a side of the workspace.
fn on_edge(workspace: &Rect, start: Point3<f64>, end: Point3<f64>) -> bool {
    let on = |line_m: f64, a_m: f64, b_m: f64| (a_m - line_m).abs().max((b_m - line_m).abs()) < 1e-6;
    let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = *workspace;
    [x_min_m, x_max_m].iter().any(|x_m| on(*x_m, start.x, end.x))
        || [y_min_m, y_max_m].iter().any(|y_m| on(*y_m, start.y, end.y))
}

/// A point of a wall's cross section; it becomes a line along the wall.
#[derive(Clone, Copy)]
struct Rib {
    /// Outward from the wall's edge.
    aside_m: f64,
    up_m: f64,
    /// Elevation of the normal, in eighths of a turn.
    eighths: u8,
    color: Color,
}

/// The cross section of a wall: a fillet at its foot that fits the bead, a lip along the upper edge and a band behind
/// it. Where strips of different edges cross, the higher one is visible; it belongs to the nearer edge.
fn profile(colors: &colors::Walls, height_m: f64, band_m: f64) -> [Rib; 9] {
    let fillet_m = BEAD_RADIUS_M.min(0.5 * height_m);
    let lip_m = LIP_M.min(band_m);
    let rib = |aside_m, up_m, eighths, color| Rib { aside_m, up_m, eighths, color };
    [
        // A very small slope away from the wall.
        rib(BLUSH_M, SHADOW_LIFT_M, 2, colors.ground),
        rib(fillet_m, 8.0 * SHADOW_LIFT_M, 2, colors.floor),
        rib(0.3 * fillet_m, 0.3 * fillet_m, 1, colors.foot),
        rib(0.0, fillet_m, 0, colors.side),
        rib(0.0, height_m - 0.1 * LIP_M, 0, colors.side),
        rib(-0.2 * lip_m, height_m + 0.2 * LIP_M, 1, colors.lip),
        rib(-0.5 * lip_m, height_m + 0.25 * LIP_M, 2, colors.lip),
        rib(-lip_m, height_m + 0.1 * LIP_M, 2, colors.edge),
        rib(-band_m, height_m + SHADOW_LIFT_M, 2, colors.top),
    ]
}

/// Connects the ribs at both ends of an edge.
fn strips<const COUNT: usize>(mesh: &mut Mesh, corners: [Corner; 2], ribs: [[Rib; COUNT]; 2]) {
    let first = mesh.vertices.len() as u32;
    for (corner, ribs) in corners.iter().zip(ribs) {
        for Rib { aside_m, up_m, eighths, color } in ribs {
            let (sin, cos) = (f64::from(eighths) * FRAC_PI_4).sin_cos();
            let at_m = corner.at_m + corner.outward * aside_m + Vector3::z() * up_m;
            mesh.vertex(at_m, corner.normal * cos + Vector3::z() * sin, color);
        }
    }
    let count = COUNT as u32;
    for below in 0..count - 1 {
        mesh.indices.extend([0, count, count + 1, 0, count + 1, 1].map(|corner| first + below + corner));
    }
}

/// A grid of the cells that are inside walls. It makes the thickness of walls cheap to look up.
struct GroundPlan {
    workspace: Rect,
    cell_m: f64,
    columns: usize,
    /// Row by row, from the smallest y.
    in_wall: Vec<bool>,
}

impl GroundPlan {
    fn of(static_scene: &StaticScene) -> Self {
        let workspace = *static_scene.workspace;
        let size_m = workspace.size_m();
        let cell_m = MIN_CELL_M.max(size_m.max() / MAX_CELLS);
        let [columns, rows] = [size_m.x, size_m.y].map(|side_m| (side_m / cell_m) as usize + 1);
        let mut in_wall = vec![false; columns * rows];
        // An edge that crosses a row toggles inside and outside for all cells whose centre is right of it.
        for ring in static_scene.walls.iter().flat_map(Polygon::rings) {
            for (&[x0, y0], &[x1, y1]) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let row_at = |y_m: f64| ((y_m - workspace.y_min_m) / cell_m).clamp(0.0, rows as f64) as usize;
                for row in row_at(y0.min(y1))..(row_at(y0.max(y1)) + 1).min(rows) {
                    let y_m = workspace.y_min_m + (row as f64 + 0.5) * cell_m;
                    if (y0 <= y_m) != (y1 <= y_m) {
                        let x_m = x0 + (x1 - x0) * (y_m - y0) / (y1 - y0);
                        let column = ((x_m - workspace.x_min_m) / cell_m + 0.5).max(0.0) as usize;
                        if column < columns {
                            in_wall[row * columns + column] ^= true;
                        }
                    }
                }
            }
        }
        for cells in in_wall.chunks_mut(columns) {
            let mut inside = false;
            for cell in cells {
                inside ^= *cell;
                *cell = inside;
            }
        }
        Self { workspace, cell_m, columns, in_wall }
    }

    /// Thickness of the wall from `start` along `inward`, at most `max_m`; half of it if the wall ends before.
    fn inside_m(&self, start: Point3<f64>, inward: Vector3<f64>, max_m: f64) -> f64 {
        let steps = (max_m / self.cell_m) as usize;
        // The first cell may lie across the edge.
        let ends = (2..=steps).find(|step| !self.is_wall(start + inward * (self.cell_m * *step as f64)));
        ends.map_or(max_m, |step| 0.5 * self.cell_m * step as f64)
    }

    /// False outside the workspace, where the tray is.
    fn is_wall(&self, at_m: Point3<f64>) -> bool {
        let cell = |along_m: f64| (along_m >= 0.0).then_some((along_m / self.cell_m) as usize);
        let column = cell(at_m.x - self.workspace.x_min_m).filter(|column| *column < self.columns);
        let row = cell(at_m.y - self.workspace.y_min_m);
        let Some((column, row)) = column.zip(row) else { return false };
        self.in_wall.get(row * self.columns + column).is_some_and(|in_wall| *in_wall)
    }
}

/// One end of an edge.
#[derive(Clone, Copy)]
struct Corner {
    /// On the table.
    at_m: Point3<f64>,
    /// The displacement of the corner when both of its edges move outward by 1 m.
    outward: Vector3<f64>,
    /// At a soft bend, the mean of both edges' normals; at a sharp corner, the normal of this edge.
    normal: Vector3<f64>,
}

/// Both ends of every edge of a ring.
fn smooth_edges(ring: &[[f64; 2]]) -> Vec<[Corner; 2]> {
    let mut points: Vec<Point3<f64>> = ring.iter().map(|[x, y]| Point3::new(*x, *y, 0.0)).collect();
    // Very short edges have no reliable direction.
    points.dedup_by(|next, kept| (*next - *kept).norm() < SHORTEST_EDGE_M);
    let count = points.len();
    let normals: Vec<Vector3<f64>> = (0..count)
        .map(|at| {
            let along = points[(at + 1) % count] - points[at];
            Vector3::new(along.y, -along.x, 0.0).try_normalize(0.0).unwrap_or_default()
        })
        .collect();
    let corner = |at: usize, edge: usize| {
        let (before, after) = (normals[(at + count - 1) % count], normals[at]);
        let (sum, cosine) = (before + after, before.dot(&after));
        // The limit prevents very long offsets at spikes.
        let outward = sum / (1.0 + cosine).max(0.5);
        let normal = if cosine > SHARP_COSINE { sum.normalize() } else { normals[edge] };
        Corner { at_m: points[at], outward, normal }
    };
    (0..count).map(|edge| [corner(edge, edge), corner((edge + 1) % count, edge)]).collect()
}
