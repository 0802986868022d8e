//! Where attractor dynamics lead from each place of the workspace.

use rayon::prelude::*;

use super::Attractor;
use crate::geometry::{Point2, Vector2};
use crate::perception::ObstacleMap;
use crate::scenario::Parameters;

/// Velocities on a grid in the middle of the workspace.
pub struct Flow {
    pub columns: usize,
    pub rows: usize,
    /// The place with the smallest x and y.
    pub origin_m: Point2<f64>,
    /// Distance between two places.
    pub spacing_m: f64,
    /// Row by row from the smallest y; `None` over a known obstacle. Empty without a goal.
    pub velocity_m_s: Vec<Option<Vector2<f64>>>,
}

impl Flow {
    /// Calculates the flow toward a goal, around the obstacle map.
    pub fn of(known: &ObstacleMap, goal_m: Option<Point2<f64>>, parameters: &Parameters, spacing_m: f64) -> Self {
        let area = known.workspace();
        let size = area.size_m();
        let [columns, rows] = [size.x, size.y].map(|side_m| (side_m / spacing_m).floor() as usize + 1);
        // The remaining space is divided equally between both sides.
        let margin = (size - Vector2::new((columns - 1) as f64, (rows - 1) as f64) * spacing_m) * 0.5;
        let origin_m = Point2::new(area.x_min_m, area.y_min_m) + margin;
        let velocity = |index: usize| {
            let place = origin_m + Vector2::new((index % columns) as f64, (index / columns) as f64) * spacing_m;
            Attractor::flow_at(place, goal_m?, known, parameters)
        };
        let places = if goal_m.is_some() { 0..columns * rows } else { 0..0 };
        Self { columns, rows, origin_m, spacing_m, velocity_m_s: places.into_par_iter().map(velocity).collect() }
    }
}
