//! Obstacles near the tool, as the attractor senses them: the nearest part of each obstacle, at most 2 cm high and wide
//! (paper, Example 1).

use super::{CellState, ObstacleMap, Percept};
use crate::geometry::{Point2, Vector2};

/// Pixels per cell of the mask; 0.83 mm on the table with the default camera.
const CELL_PX: usize = 2;

/// [`ObstacleMask::exit_direction`] uses free cells up to this much farther than the nearest one.
const EXIT_SEARCH_M: f64 = 0.006;

/// The dark cells of a frame and their connected components.
#[derive(Clone, Debug)]
pub struct ObstacleMask {
    columns: usize,
    /// Component of each cell, 0 for free.
    label: Vec<u16>,
    components: u16,
    center_m: Point2<f64>,
    cell_m: f64,
}

/// A fitted rectangle, axis-aligned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    pub center_m: Point2<f64>,
    /// Half sides.
    pub half_size_m: Vector2<f64>,
    /// The observed point of this obstacle nearest to the query point.
    pub nearest_m: Point2<f64>,
}

impl ObstacleMask {
    /// The dark cells of a frame: a cell is dark if any of its pixels is.
    pub fn of(percept: &Percept) -> Self {
        let gray = &percept.gray;
        let columns = gray.width_px / CELL_PX;
        let rows = gray.height_px / CELL_PX;
        let dark: Vec<bool> = (0..columns * rows)
            .map(|cell| {
                let (row, column) = (cell / columns * CELL_PX, cell % columns * CELL_PX);
                (row..row + CELL_PX).any(|r| {
                    let start = r * gray.width_px + column;
                    gray.pixels[start..start + CELL_PX].iter().any(|&level| super::is_wall(level))
                })
            })
            .collect();
        let cell_m = percept.calibration.m_per_px * CELL_PX as f64;
        Self::of_cells(columns, &dark, percept.calibration.center_m, cell_m)
    }

    /// The obstacle map's dark cells within `half_m` of a place.
    pub fn around(known: &ObstacleMap, place: Point2<f64>, half_m: f64) -> Self {
        let cell_m = known.cell_m().x;
        let reach = (half_m / cell_m) as i32;
        let columns = 2 * reach as usize + 1;
        let offset = |i: usize| (i as i32 - reach) as f64 * cell_m;
        let is_dark = |cell: usize| {
            let at = place + Vector2::new(offset(cell % columns), -offset(cell / columns));
            known.state(at) == CellState::Obstacle
        };
        let dark: Vec<bool> = (0..columns * columns).map(is_dark).collect();
        Self::of_cells(columns, &dark, place, cell_m)
    }

    /// Rows of `columns` cells around a centre, top row first.
    fn of_cells(columns: usize, dark: &[bool], center_m: Point2<f64>, cell_m: f64) -> Self {
        let mut mask = Self { columns, label: vec![0; dark.len()], components: 0, center_m, cell_m };
        mask.flood(dark);
        mask
    }

    fn flood(&mut self, dark: &[bool]) {
        let rows = self.label.len() / self.columns;
        let mut stack = Vec::new();
        for seed in 0..dark.len() {
            if !dark[seed] || self.label[seed] != 0 {
                continue;
            }
            self.components += 1;
            self.label[seed] = self.components;
            stack.push(seed);
            while let Some(cell) = stack.pop() {
                let (row, column) = (cell / self.columns, cell % self.columns);
                for r in row.saturating_sub(1)..(row + 2).min(rows) {
                    for c in column.saturating_sub(1)..(column + 2).min(self.columns) {
                        let next = r * self.columns + c;
                        if dark[next] && self.label[next] == 0 {
                            self.label[next] = self.components;
                            stack.push(next);
                        }
                    }
                }
            }
        }
    }

    fn point(&self, cell: usize) -> Point2<f64> {
        let rows = self.label.len() / self.columns;
        let (row, column) = (cell / self.columns, cell % self.columns);
        let half = Vector2::new(self.columns as f64, rows as f64) / 2.0;
        let offset = Vector2::new(column as f64 + 0.5 - half.x, half.y - row as f64 - 0.5);
        self.center_m + offset * self.cell_m
    }

    /// For each obstacle in view, the rectangle around its part inside a window of `window_m` at its point nearest to
    /// `from`. Nearest obstacle first.
    pub fn patches(&self, from: Point2<f64>, window_m: f64) -> Vec<Patch> {
        let mut nearest = vec![(f64::INFINITY, 0usize); usize::from(self.components) + 1];
        for (cell, &label) in self.label.iter().enumerate().filter(|&(_, &label)| label != 0) {
            let distance_m = (self.point(cell) - from).norm();
            let best = &mut nearest[usize::from(label)];
            if distance_m < best.0 {
                *best = (distance_m, cell);
            }
        }
        let mut order: Vec<(f64, usize)> = nearest.into_iter().skip(1).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        order.into_iter().map(|(_, cell)| self.fit(cell, window_m)).collect()
    }

    /// Unit direction away from an obstacle that is below or beside a place: toward the mean of the free cells around,
    /// up to slightly farther than the nearest one. `None` without free cells. The nearest cell alone would not do,
    /// because at an edge its direction is arbitrary.
    pub fn exit_direction(&self, from: Point2<f64>) -> Option<Vector2<f64>> {
        let free = |cell: &usize| self.label[*cell] == 0;
        let offsets = || (0..self.label.len()).filter(free).map(|cell| self.point(cell) - from);
        let nearest_m = offsets().map(|offset| offset.norm()).min_by(f64::total_cmp)?;
        let reach_m = nearest_m + EXIT_SEARCH_M;
        let sum: Vector2<f64> = offsets().filter(|offset| offset.norm() <= reach_m).sum();
        sum.try_normalize(0.0)
    }

    /// Bounding rectangle of one obstacle's cells inside the window around its nearest cell.
    fn fit(&self, nearest: usize, window_m: f64) -> Patch {
        let rows = self.label.len() / self.columns;
        let reach = ((window_m / self.cell_m - 1.0) / 2.0).floor().max(0.0) as usize;
        let (row, column) = (nearest / self.columns, nearest % self.columns);
        let (mut low, mut high) = ((column, row), (column, row));
        for r in row.saturating_sub(reach)..(row + reach + 1).min(rows) {
            for c in column.saturating_sub(reach)..(column + reach + 1).min(self.columns) {
                if self.label[r * self.columns + c] == self.label[nearest] {
                    low = (low.0.min(c), low.1.min(r));
                    high = (high.0.max(c), high.1.max(r));
                }
            }
        }
        let corner_a = self.point(low.1 * self.columns + low.0);
        let corner_b = self.point(high.1 * self.columns + high.0);
        let half_cell = Vector2::repeat(self.cell_m / 2.0);
        Patch {
            center_m: nalgebra::center(&corner_a, &corner_b),
            half_size_m: (corner_a - corner_b).abs() / 2.0 + half_cell,
            nearest_m: self.point(nearest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::frame;
    use super::*;

    #[test]
    fn a_patch_is_the_near_part_of_a_post_inside_its_window() {
        let center = Point2::new(0.0, -0.3);
        let post = |p: Point2<f64>| (p.x - 0.05).abs() < 0.02 && (p.y + 0.3).abs() < 0.02;
        let mask = ObstacleMask::of(&Percept::of(&frame(center, post), center));
        let patches = mask.patches(center, 0.02);
        assert_eq!(patches.len(), 1);
        let patch = patches[0];
        assert!((patch.nearest_m.x - 0.03).abs() < 1e-3);
        assert!(patch.half_size_m.x <= 0.01 && patch.half_size_m.y <= 0.01);
        assert!((patch.center_m.x - patch.half_size_m.x - 0.03).abs() < 1e-3);
    }

    #[test]
    fn posts_are_separate_and_the_nearest_is_first() {
        let center = Point2::new(0.0, -0.3);
        let (far, near) = (Point2::new(-0.07, -0.3), Point2::new(0.0, -0.25));
        let posts = |p: Point2<f64>| (p - far).norm() < 0.01 || (p - near).norm() < 0.01;
        let patches = ObstacleMask::of(&Percept::of(&frame(center, posts), center)).patches(center, 0.02);
        assert_eq!(patches.len(), 2);
        // A patch is only the near part: its centre is up to half a window before the post's centre.
        assert!((patches[0].center_m - near).norm() < 7e-3 && (patches[1].center_m - far).norm() < 7e-3);
    }

    #[test]
    fn the_exit_direction_points_to_the_nearest_edge_from_inside_and_outside() {
        let center = Point2::new(0.0, -0.3);
        for x in [0.003, -0.003, 0.0, 1e-4, -1e-4] {
            // Distance of the wall's edge to the right of the tool.
            let mask = ObstacleMask::of(&Percept::of(&frame(center, |p| p.x < x), center));
            let direction = mask.exit_direction(center).unwrap();
            assert!((direction - Vector2::x()).norm() < 0.05, "{x}: {direction}");
        }
    }

    #[test]
    fn an_empty_table_has_no_patches() {
        let center = Point2::new(0.0, -0.3);
        let percept = Percept::of(&frame(center, |_| false), center);
        assert!(ObstacleMask::of(&percept).patches(center, 0.02).is_empty());
    }
}
