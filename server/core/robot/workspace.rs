//! The manipulability of the arm over a horizontal plane, for a fixed rotation of the flange.
//!
//! The sign of each factor of det J ([`jacobian::manipulability`]) changes only at a singularity. The three
//! signs (shoulder, wrist, elbow) identify the eight solution branches. A map uses the signs of its seed for
//! all cells, so all cells are on one branch and no motion between them passes through a singularity. The
//! result does not depend on the cell size or on the order of evaluation. A cell that only another branch
//! reaches counts as not reached.

use super::{Joints, inverse, jacobian};
use crate::geometry::{Isometry3, Point2, Rect, UnitQuaternion, Vector3};

/// Maximum number of cells of a map.
pub const MOST_CELLS: usize = 250_000;

/// A factor of det J with the wrong sign, but smaller than this, counts as zero.
const ROUNDING: f64 = 1e-9;

/// Manipulability over a plane, in square cells.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct ManipulabilityMap {
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Lower left corner of the lower left cell, `[x_m, y_m]`.
    #[cfg_attr(feature = "schema", schema(value_type = crate::schema::Numbers2))]
    pub origin_m: [f64; 2],
    /// Side of a cell.
    pub cell_m: f64,
    /// |det J| in m³ with the flange over each cell's centre: `rows × columns` values, row by row from the
    /// lower left. `None` if the branch does not reach the cell.
    pub manipulability_m3: Vec<Option<f64>>,
}

#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum WorkspaceError {
    /// An input is NaN or infinite.
    #[error("{input} holds {value}, which is not a finite number")]
    NonFinite {
        /// `area`, `cell`, `height`, `rotation` or `seed`.
        input: &'static str,
        value: f64,
    },
    /// The rectangle's sides are not positive.
    #[error("the area is {width_m} m by {height_m} m")]
    EmptyArea { width_m: f64, height_m: f64 },
    /// The cells have no size.
    #[error("a cell's side is {cell_m} m")]
    EmptyCell { cell_m: f64 },
    /// More than [`MOST_CELLS`].
    #[error("the grid has {cells:.0} cells, the limit is {MOST_CELLS}")]
    TooManyCells {
        /// Requested number of cells.
        cells: f64,
    },
}

/// The manipulability over `area` with the flange at `flange_z_m` above the table and turned by
/// `base_from_flange`, on the branch of `seed` (rad).
///
/// The cells start at the area's lower left corner and cover it; the last cell of a row or column may reach
/// beyond it. A seed in a singularity counts as just on its positive side.
///
/// # Errors
/// [`WorkspaceError`] if an argument is not finite, an extent not positive, or the cells too many.
pub fn manipulability_map(
    area: &Rect,
    cell_m: f64,
    flange_z_m: f64,
    base_from_flange: &UnitQuaternion<f64>,
    seed: &Joints,
) -> Result<ManipulabilityMap, WorkspaceError> {
    let corners_m = [area.x_min_m, area.x_max_m, area.y_min_m, area.y_max_m];
    check_finite("area", &corners_m)?;
    check_finite("cell", &[cell_m])?;
    check_finite("height", &[flange_z_m])?;
    check_finite("rotation", base_from_flange.coords.as_slice())?;
    check_finite("seed", seed)?;
    let size_m = area.size_m();
    if size_m.min() <= 0.0 {
        return Err(WorkspaceError::EmptyArea { width_m: size_m.x, height_m: size_m.y });
    }
    if cell_m <= 0.0 {
        return Err(WorkspaceError::EmptyCell { cell_m });
    }
    // The small reduction keeps rounding from adding a column to an area of whole cells.
    let [columns, rows] = [size_m.x, size_m.y].map(|side_m| (side_m / cell_m - 1e-6).ceil().max(1.0));
    let cells = columns * rows;
    if cells > MOST_CELLS as f64 {
        return Err(WorkspaceError::TooManyCells { cells });
    }

    let mut map = ManipulabilityMap {
        columns: columns as usize,
        rows: rows as usize,
        origin_m: [area.x_min_m, area.y_min_m],
        cell_m,
        manipulability_m3: Vec::with_capacity(cells as usize),
    };
    let signs = jacobian::factors(seed).map(f64::signum);
    for cell in 0..map.rows * map.columns {
        let center_m = map.center_m(cell);
        let position_m = Vector3::new(center_m.x, center_m.y, flange_z_m);
        let flange = Isometry3::from_parts(position_m.into(), *base_from_flange);
        map.manipulability_m3.push(on_branch(&flange, seed, &signs));
    }
    Ok(map)
}

impl ManipulabilityMap {
    /// The centre of a cell, counted row by row from the lower left.
    pub fn center_m(&self, cell: usize) -> Point2<f64> {
        let [x_m, y_m] = self.origin_m;
        let (column, row) = (cell % self.columns, cell / self.columns);
        Point2::new(x_m + (column as f64 + 0.5) * self.cell_m, y_m + (row as f64 + 0.5) * self.cell_m)
    }

    /// Which cells are reached with at least this manipulability, in the map's order.
    pub fn at_least(&self, threshold_m3: f64) -> impl Iterator<Item = bool> {
        self.manipulability_m3.iter().map(move |value| value.is_some_and(|value| value >= threshold_m3))
    }

    /// The share of all cells, in [0, 1], that [`ManipulabilityMap::at_least`] names.
    pub fn share_at_least(&self, threshold_m3: f64) -> f64 {
        self.at_least(threshold_m3).filter(|&is_good| is_good).count() as f64 / self.manipulability_m3.len() as f64
    }
}

/// |det J| in m³ of the solution with these signs, if there is one.
fn on_branch(flange: &Isometry3<f64>, seed: &Joints, signs: &[f64; 3]) -> Option<f64> {
    let branches = inverse::solutions(flange, seed).ok()?;
    let is_ours =
        |joints: &&Joints| jacobian::factors(joints).iter().zip(signs).all(|(factor, sign)| factor * sign > -ROUNDING);
    branches.iter().find(is_ours).map(jacobian::manipulability)
}

fn check_finite(input: &'static str, values: &[f64]) -> Result<(), WorkspaceError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(WorkspaceError::NonFinite { input, value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{
        reach, tool_down,
        ur5::{A2_M, A3_M, D1_M, D4_M, D5_M, D6_M},
    };
    use std::f64::consts::FRAC_PI_2;

    /// Over the workspace, elbow up, tool down.
    const SEED: Joints = [-FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2, 0.0];
    const PAPERS_AREA: Rect = Rect { x_min_m: -0.30, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
    const AROUND: Rect = Rect { x_min_m: -1.0, x_max_m: 1.0, y_min_m: -1.0, y_max_m: 1.0 };

    fn map(area: &Rect, cell_m: f64, z_m: f64) -> ManipulabilityMap {
        manipulability_map(area, cell_m, z_m, &tool_down(), &SEED).unwrap()
    }

    /// |det J| in m³ with the tool straight down, `r_m` from the base axis; NaN where nothing reaches.
    fn expected(r_m: f64, z_m: f64) -> f64 {
        let along_m = (r_m * r_m - D4_M * D4_M).sqrt();
        let (kc, ks) = (along_m - D5_M, z_m + D6_M - D1_M);
        let c3 = (ks * ks + kc * kc - A2_M * A2_M - A3_M * A3_M) / (2.0 * A2_M * A3_M);
        A2_M * A3_M * (1.0 - c3 * c3).sqrt() * along_m
    }

    #[test]
    fn reached_cells_are_within_reach() {
        for z_m in [-0.3, 0.0, 0.28, 0.5, 0.7, 0.8235] {
            let map = map(&AROUND, 0.008, z_m);
            assert_eq!((map.columns, map.rows, map.manipulability_m3.len()), (250, 250, 62_500));
            let (r_min_m, r_max_m) = reach(z_m).unwrap();
            let mut folded = 0;
            for (cell, value) in map.manipulability_m3.iter().enumerate() {
                let r_m = map.center_m(cell).coords.norm();
                let expected_m3 = expected(r_m, z_m);
                assert_eq!(value.is_some(), !expected_m3.is_nan(), "{r_m} {z_m}");
                assert!(value.is_none_or(|value| (value - expected_m3).abs() < 1e-9), "{value:?} {r_m} {z_m}");
                let is_within = (r_min_m..=r_max_m).contains(&r_m);
                assert!(is_within || value.is_none());
                folded += usize::from(is_within && value.is_none());
            }
            // Near the shoulder's height this branch cannot fold that far, but other branches can.
            assert_eq!(folded > 0, z_m == 0.0, "{z_m}");
        }
        let high = map(&AROUND, 0.02, 0.9);
        assert!(high.manipulability_m3.iter().all(Option::is_none) && high.share_at_least(0.0) == 0.0);
    }

    #[test]
    fn manipulability_falls_to_zero_at_both_ends_of_the_reach() {
        let (r_min_m, r_max_m) = reach(0.28).unwrap();
        let at = |r_m: f64| {
            let flange = Isometry3::from_parts(Vector3::new(0.6 * r_m, -0.8 * r_m, 0.28).into(), tool_down());
            on_branch(&flange, &SEED, &jacobian::factors(&SEED).map(f64::signum)).unwrap()
        };
        for inside_m in [1e-3, 1e-6, 1e-9] {
            // In proportion to the root of the distance, at both ends.
            let root = f64::sqrt(inside_m);
            assert!((0.02 * root..0.5 * root).contains(&at(r_min_m + inside_m)), "{inside_m}");
            assert!((0.02 * root..0.5 * root).contains(&at(r_max_m - inside_m)), "{inside_m}");
        }
        assert!(at(0.4) > 0.03);
    }

    #[test]
    fn rotating_the_base_rotates_the_map() {
        let area = Rect { x_min_m: 0.05, x_max_m: 0.55, y_min_m: -0.7, y_max_m: -0.2 };
        let tilted = UnitQuaternion::from_euler_angles(0.3, 0.2, 0.1) * tool_down();
        let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), FRAC_PI_2);
        let turned_area = Rect { x_min_m: 0.2, x_max_m: 0.7, y_min_m: 0.05, y_max_m: 0.55 };
        let mut turned_seed = SEED;
        turned_seed[0] += FRAC_PI_2;
        let straight = manipulability_map(&area, 0.02, 0.2, &tilted, &SEED).unwrap();
        let turned = manipulability_map(&turned_area, 0.02, 0.2, &(quarter * tilted), &turned_seed).unwrap();
        let mut reached = 0;
        for (cell, value) in straight.manipulability_m3.iter().enumerate() {
            let (column, row) = (cell % straight.columns, cell / straight.columns);
            let other = turned.manipulability_m3[column * turned.columns + turned.columns - 1 - row];
            assert_eq!(value.is_some(), other.is_some());
            if let (Some(value), Some(other)) = (value, other) {
                assert!((value - other).abs() < 1e-12, "{value} {other}");
                reached += 1;
            }
        }
        assert!(reached > 300);
    }

    #[test]
    fn the_papers_working_area_is_free_of_singularities() {
        // Half a cell larger on every side, so that the outermost centres are on the border.
        let area = Rect { x_min_m: -0.3025, x_max_m: 0.2825, y_min_m: -0.5425, y_max_m: -0.2075 };
        let papers_rotation = UnitQuaternion::from_scaled_axis(Vector3::new(2.182, -2.182, 0.0));
        for (rotation, expected_m3) in [(tool_down(), 0.01951), (papers_rotation, 0.01893)] {
            let map = manipulability_map(&area, 0.005, 0.28, &rotation, &SEED).unwrap();
            assert_eq!((map.columns, map.rows), (117, 67));
            assert_eq!(map.share_at_least(2e-3), 1.0);
            let least_m3 = map.manipulability_m3.iter().flatten().copied().fold(f64::INFINITY, f64::min);
            assert!((least_m3 - expected_m3).abs() < 1e-5, "{least_m3}");
        }
        // With the tool down it depends on the distance alone, and is smallest nearest to the base.
        assert!((expected(0.21, 0.28) - 0.01951).abs() < 1e-5);
    }

    #[test]
    fn steps_from_cell_to_cell_keep_the_branch() {
        let tilted = UnitQuaternion::from_euler_angles(0.2, -0.3, 0.4) * tool_down();
        let map = manipulability_map(&PAPERS_AREA, 0.01, 0.25, &tilted, &SEED).unwrap();
        let mut joints = SEED;
        for row in 0..map.rows {
            for step in 0..map.columns {
                // There and back, so that every step is a cell long.
                let column = if row % 2 == 0 { step } else { map.columns - 1 - step };
                let cell = row * map.columns + column;
                let center_m = map.center_m(cell);
                let flange = Isometry3::from_parts(Vector3::new(center_m.x, center_m.y, 0.25).into(), tilted);
                joints = inverse::nearest(&flange, &joints).unwrap();
                let value = map.manipulability_m3[cell].unwrap();
                assert!((value - jacobian::manipulability(&joints)).abs() < 1e-12, "{center_m}");
            }
        }
    }

    #[test]
    fn the_seed_chooses_the_branch() {
        // With the wrist turned over the arm reaches less far, by up to 2·d5.
        let over = [-FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, 0.0];
        let long = map(&AROUND, 0.02, 0.28);
        let short = manipulability_map(&AROUND, 0.02, 0.28, &tool_down(), &over).unwrap();
        assert!(short.share_at_least(0.0) < 0.8 * long.share_at_least(0.0));
        assert!(short.at_least(0.0).zip(long.at_least(0.0)).all(|(short, long)| long || !short));
        // The other elbow has the same |det J|.
        let other = SEED.map(|angle| angle.abs());
        let down = manipulability_map(&AROUND, 0.02, 0.28, &tool_down(), &other).unwrap();
        for (up, down) in long.manipulability_m3.iter().zip(&down.manipulability_m3) {
            assert!((up.unwrap_or(-1.0) - down.unwrap_or(-1.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn share_is_the_fraction_of_cells() {
        let strip = Rect { x_min_m: 0.0, x_max_m: 1.0, y_min_m: -0.05, y_max_m: 0.05 };
        let map = map(&strip, 0.1, 0.28);
        assert_eq!((map.columns, map.rows), (10, 1));
        assert_eq!(map.center_m(0), Point2::new(0.05, 0.0));
        // The first cell lies inside the shoulder's cylinder, the last two beyond the arm.
        let reached: Vec<bool> = map.at_least(0.0).collect();
        assert_eq!(reached, [false, true, true, true, true, true, true, true, true, false]);
        assert_eq!(map.share_at_least(0.0), 0.8);
        assert_eq!(map.share_at_least(1.0), 0.0);
    }

    #[test]
    fn rejects_invalid_arguments_by_name() {
        let refusal =
            |area: Rect, cell_m, z_m| manipulability_map(&area, cell_m, z_m, &tool_down(), &SEED).unwrap_err();
        for cell_m in [0.0, -0.01] {
            assert_eq!(refusal(AROUND, cell_m, 0.28), WorkspaceError::EmptyCell { cell_m });
        }
        let named = |error| match error {
            WorkspaceError::NonFinite { input, .. } => input,
            other => panic!("{other}"),
        };
        assert_eq!(named(refusal(AROUND, f64::NAN, 0.28)), "cell");
        assert_eq!(named(refusal(AROUND, 0.01, f64::NAN)), "height");
        assert_eq!(named(refusal(Rect { x_max_m: f64::INFINITY, ..AROUND }, 0.01, 0.28)), "area");
        let mut seed = SEED;
        seed[3] = f64::NAN;
        assert_eq!(named(manipulability_map(&AROUND, 0.01, 0.28, &tool_down(), &seed).unwrap_err()), "seed");
        let turned_over = Rect { y_max_m: -2.0, ..AROUND };
        assert_eq!(refusal(turned_over, 0.01, 0.28), WorkspaceError::EmptyArea { width_m: 2.0, height_m: -1.0 });
        assert_eq!(refusal(AROUND, 0.003, 0.28), WorkspaceError::TooManyCells { cells: 667.0 * 667.0 });
        assert!(matches!(refusal(AROUND, 1e-300, 0.28), WorkspaceError::TooManyCells { .. }));
        assert_eq!(map(&AROUND, 0.004, 0.28).manipulability_m3.len(), MOST_CELLS);
    }
}
