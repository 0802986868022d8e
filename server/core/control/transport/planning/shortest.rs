//! The shortest path over the map's cells.

use pathfinding::directed::astar::astar;

use super::clearance::{Clearance, levels_m};
use super::obstacles::Obstacles;
use super::path::Path;
use crate::geometry::Point2;

/// Costs are whole micrometres.
const UM_PER_M: f64 = 1e6;

impl Obstacles {
    /// The shortest path from cell to neighbouring cell, along sides or diagonals, with the largest clearance between
    /// the two limits that leads to the goal; then without the corners that a straight line can skip. Unobserved places are free. `None` if no path keeps the smallest clearance, or the goal is in a wall.
    ///
    /// A tool over a wall begins where it leaves the wall.
    pub fn shortest_path(&self, from: Point2<f64>, goal: Point2<f64>, limits_m: [f64; 2]) -> Option<Path> {
        let ends = [self.end_near(from, limits_m[1])?, self.end_at(goal)?];
        let straight = Clearance { asked_m: limits_m[0], ends };
        let [start, goal] = ends.map(|end| end.point);
        if self.is_clear(start, goal, &straight) {
            return Some(Path { points: vec![start, goal], clearance: straight });
        }
        let promised_m = self.grid().clearance(ends, limits_m)?.asked_m;
        // The cells around the ends promise more than the lines from the ends to their centres may keep.
        let levels = levels_m(limits_m).filter(|&asked_m| asked_m <= promised_m);
        levels.map(|asked_m| Clearance { asked_m, ends }).find_map(|clearance| self.shortest_with(clearance))
    }

    fn shortest_with(&self, clearance: Clearance) -> Option<Path> {
        let grid = self.grid();
        let [start, goal] = clearance.ends.map(|end| end.point);
        let [first, last] = [start, goal].map(|point| grid.cell(point));
        // The ends are at their own places, not at the centres of their cells.
        let place = |cell: usize| match cell {
            _ if cell == first => start,
            _ if cell == last => goal,
            _ => grid.center(cell),
        };
        let is_end = |cell: usize| cell == first || cell == last;
        let length_um = |a: usize, b: usize| ((place(a) - place(b)).norm() * UM_PER_M) as u32;
        // A point between two centres is at most half their distance away from one of them.
        let has_room = |a: usize, b: usize| {
            let half_m = 0.5 * (place(a) - place(b)).norm();
            !is_end(a)
                && !is_end(b)
                && grid.cell_distance_m(a).min(grid.cell_distance_m(b)) - half_m >= clearance.asked_m
        };
        let is_step = |a: usize, b: usize| has_room(a, b) || self.is_clear(place(a), place(b), &clearance);
        let steps = |&cell: &usize| {
            let beside = grid.neighbours(cell).filter(move |&next| is_end(next) || grid.cell_distance_m(next) > 0.0);
            beside.filter(move |&next| is_step(cell, next)).map(move |next| (next, length_um(cell, next)))
        };
        let (cells, _) = astar(&first, steps, |&cell| length_um(cell, last), |&cell| cell == last)?;
        let mut path = Path { points: cells.into_iter().map(place).collect(), clearance };
        path.skip_corners(self);
        Some(path)
    }
}
