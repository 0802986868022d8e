//! Maps and checks for the tests of planning transports.

use std::collections::VecDeque;

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query;
use parry2d_f64::shape::{Cuboid, Segment};
use proptest::prelude::*;

use super::{Clearance, End, Obstacles};
use crate::geometry::{Point2, Rect};
use crate::image::GrayImage;
use crate::map::Map;
use crate::perception::{Calibration, DarkPixels, OBSTACLE_LEVEL, ObstacleMap};

pub(in crate::control::transport) const CLEARANCE_M: f64 = 0.012;
pub(in crate::control::transport) const LEAST_M: f64 = 0.006;
/// Upper bound of the errors of GJK and of the half-millimetre pieces near an end.
pub(in crate::control::transport) const TOLERANCE_M: f64 = 1e-6 + 0.000125;

/// Lets a map observe its whole workspace at once, in `per_cell` pixels per cell.
pub(in crate::control::transport) fn look(map: &mut ObstacleMap, per_cell: f64, is_wall: impl Fn(Point2<f64>) -> bool) {
    let workspace = *map.workspace();
    let m_per_px = map.cell_m().min() / per_cell;
    let size_px = (workspace.size_m().max() / m_per_px).round() as usize + 2;
    let center_m = workspace.center_m();
    let calibration = Calibration { center_m, m_per_px, size_px, foot_m: center_m };
    let point = |i: usize| calibration.table_from_image((i % size_px) as f64 + 0.5, (i / size_px) as f64 + 0.5);
    let pixels = (0..size_px * size_px).map(|i| if is_wall(point(i)) { 20 } else { 230 }).collect();
    let dark = DarkPixels::of(&GrayImage { width_px: size_px, height_px: size_px, pixels }, OBSTACLE_LEVEL);
    map.update(&dark, &calibration, 1.0);
}

pub(in crate::control::transport) fn seen(
    workspace: Rect,
    per_cell: f64,
    is_wall: impl Fn(Point2<f64>) -> bool,
) -> ObstacleMap {
    let mut map = ObstacleMap::new(workspace);
    look(&mut map, per_cell, is_wall);
    map
}

pub(in crate::control::transport) fn shipped(name: &str) -> (Map, Obstacles) {
    let map = Map::shipped(name).unwrap();
    let obstacles = Obstacles::of(&seen(*map.workspace(), 5.0, |p| !map.is_free(p)), CLEARANCE_M);
    (map, obstacles)
}

pub(in crate::control::transport) const SMALL: Rect =
    Rect { x_min_m: -0.08, x_max_m: 0.04, y_min_m: -0.5, y_max_m: -0.42 };

prop_compose! {
    /// A small workspace with walls that consist of whole cells.
    pub(in crate::control::transport) fn small_maps()(
        walls in prop::collection::vec((0u32..60, 0u32..40, 1u32..25, 1u32..10, any::<bool>()), 0..9),
    ) -> ObstacleMap {
        let is_wall = |p: Point2<f64>| {
            let [column, row] = [p.x - SMALL.x_min_m, p.y - SMALL.y_min_m].map(|m| (m / 0.002) as u32);
            walls.iter().any(|&(left, low, long, thick, is_upright)| {
                let (wide, high) = if is_upright { (thick, long) } else { (long, thick) };
                (left..left + wide).contains(&column) && (low..low + high).contains(&row)
            })
        };
        seen(SMALL, 1.0, is_wall)
    }
}

prop_compose! {
    /// A point on a lattice of 1 mm.
    pub(in crate::control::transport) fn places()(column in 0u32..=120, row in 0u32..=80) -> Point2<f64> {
        lattice_point(column, row)
    }
}

pub(in crate::control::transport) fn lattice_point(column: u32, row: u32) -> Point2<f64> {
    Point2::new(SMALL.x_min_m + 0.001 * f64::from(column), SMALL.y_min_m + 0.001 * f64::from(row))
}

pub(in crate::control::transport) fn no_ends(asked_m: f64) -> Clearance {
    Clearance { asked_m, ends: [End { point: Point2::origin(), distance_m: 1.0 }; 2] }
}

/// Distance from a straight line to the nearest rectangle and to the border, by parry2d.
pub(in crate::control::transport) fn brute_distance_m(
    obstacles: &Obstacles,
    from: Point2<f64>,
    to: Point2<f64>,
) -> f64 {
    let w = obstacles.workspace();
    let border_m = |p: Point2<f64>| (p.x - w.x_min_m).min(w.x_max_m - p.x).min(p.y - w.y_min_m).min(w.y_max_m - p.y);
    let segment = Segment::new(Vector::new(from.x, from.y), Vector::new(to.x, to.y));
    let to_rectangle_m = |rect: &Rect| {
        let (center, half) = (rect.center_m(), rect.size_m() / 2.0);
        let pose = Pose::translation(center.x, center.y);
        query::distance(&Pose::IDENTITY, &segment, &pose, &Cuboid::new(Vector::new(half.x, half.y))).unwrap().distance
    };
    obstacles.rectangles().iter().map(to_rectangle_m).fold(border_m(from).min(border_m(to)), f64::min)
}

/// Asserts with parry2d, every .2 mm, that an edge keeps its required clearance.
pub(in crate::control::transport) fn assert_kept(
    obstacles: &Obstacles,
    from: Point2<f64>,
    to: Point2<f64>,
    clearance: &Clearance,
) {
    let kept_m = brute_distance_m(obstacles, from, to);
    if kept_m >= clearance.asked_m - TOLERANCE_M {
        return;
    }
    let count = ((to - from).norm() / 2e-4).ceil() as usize + 1;
    for i in 0..=count {
        let p = from + (to - from) * (i as f64 / count as f64);
        let ends_m = clearance.ends.map(|end| end.distance_m + 0.25 * ((p - end.point).norm() - 0.006).max(0.0));
        let required_m = clearance.asked_m.min(ends_m[0]).min(ends_m[1]);
        let distance_m = brute_distance_m(obstacles, p, p);
        assert!(distance_m > 0.0 && distance_m >= required_m - TOLERANCE_M, "{p}: {distance_m} of {required_m}");
    }
}

/// Whether clear steps between neighbours on the lattice lead from one of its points to another.
pub(in crate::control::transport) fn lattice_leads(obstacles: &Obstacles, clearance: &Clearance) -> bool {
    let [start, goal] = clearance.ends.map(|end| {
        let at = (end.point - lattice_point(0, 0)) / 0.001;
        (at.x.round() as u32, at.y.round() as u32)
    });
    let mut seen = vec![false; 121 * 81];
    let mut open = VecDeque::from([start]);
    while let Some((column, row)) = open.pop_front() {
        if (column, row) == goal {
            return true;
        }
        for row_to in row.saturating_sub(1)..=(row + 1).min(80) {
            for column_to in column.saturating_sub(1)..=(column + 1).min(120) {
                let seen = &mut seen[(row_to * 121 + column_to) as usize];
                let (from, to) = (lattice_point(column, row), lattice_point(column_to, row_to));
                if !*seen && obstacles.is_clear(from, to, clearance) {
                    *seen = true;
                    open.push_back((column_to, row_to));
                }
            }
        }
    }
    false
}
