//! The field over the table around the block, to be drawn: |B| and the pull at the height of the bead's centre.

use serde::{Deserialize, Serialize};

use super::curves::{CurveError, in_range};
use super::dipole::{self, BLOCK_REMANENCE_T, SPHERE_DIAMETER_M};
use super::force::{self, FARTHEST_M, Orientation};
use crate::geometry::Vector3;
#[cfg(feature = "schema")]
use crate::schema::Numbers2;

/// Maximum number of points per row.
pub const ROW_LIMIT: u32 = 101;

/// Query of `plane`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct PlaneQuery {
    /// Orientation of the block.
    pub orientation: Orientation,
    /// Its lower face above the table, m: at least the bead's diameter.
    #[cfg_attr(feature = "schema", schema(minimum = 0.005, maximum = 0.5))]
    pub lower_face_height_m: f64,
    /// Half side of the square around the point below the block's middle, m, along the block's x and y.
    #[cfg_attr(feature = "schema", schema(minimum = 0.001, maximum = 0.5))]
    pub reach_m: f64,
    /// Number of points per row and column, evenly spaced, the first and last ones at the edges.
    #[cfg_attr(feature = "schema", schema(minimum = 2, maximum = 101))]
    pub count: u32,
}

/// The field in a square around the block: one entry per point, row by row from the minimum x and y.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(ts_rs::TS, utoipa::ToSchema))]
pub struct Plane {
    /// |B|, T.
    pub field_t: Vec<f64>,
    /// Pull on the bead in the table's plane, N.
    #[cfg_attr(feature = "schema", schema(value_type = Vec<Numbers2>))]
    pub pull_n: Vec<[f64; 2]>,
}

/// The field over the table.
///
/// # Errors
/// [`CurveError`], naming the field and its value.
pub fn plane(query: &PlaneQuery) -> Result<Plane, CurveError> {
    let PlaneQuery { orientation, lower_face_height_m, reach_m, count } = *query;
    in_range("lower_face_height_m", lower_face_height_m, (SPHERE_DIAMETER_M, FARTHEST_M))?;
    in_range("reach_m", reach_m, (1e-3, FARTHEST_M))?;
    if !(2..=ROW_LIMIT).contains(&count) {
        return Err(CurveError::Count { value: count, most: ROW_LIMIT });
    }
    let block = force::block(orientation, BLOCK_REMANENCE_T);
    let down_m = 0.5 * SPHERE_DIAMETER_M - (lower_face_height_m + block.half_size_m.z);
    let at_m = |index: u32| reach_m * (2.0 * f64::from(index) / f64::from(count - 1) - 1.0);
    let places = (0..count).flat_map(|row| (0..count).map(move |column| (column, row)));
    let points_m: Vec<_> = places.map(|(column, row)| Vector3::new(at_m(column), at_m(row), down_m)).collect();
    let pull_n = |point_m| {
        let force_n = force::force_n(&block, point_m, dipole::moment_a_m2());
        [force_n.x, force_n.y]
    };
    Ok(Plane {
        field_t: block.fields_t(&points_m).iter().map(Vector3::norm).collect(),
        pull_n: points_m.iter().map(pull_n).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUERY: PlaneQuery =
        PlaneQuery { orientation: Orientation::A, lower_face_height_m: 0.1, reach_m: 0.1, count: 21 };

    #[test]
    fn the_field_is_that_of_the_block_and_pulls_toward_it() {
        let plane_of = |orientation| plane(&PlaneQuery { orientation, ..QUERY }).unwrap();
        let Plane { field_t, pull_n } = plane_of(Orientation::A);
        assert_eq!((field_t.len(), pull_n.len()), (441, 441));
        let middle = 10 * 21 + 10;
        assert!(field_t.iter().all(|&value_t| value_t <= field_t[middle]), "strongest right below");
        // Far off, a block is a dipole of its moment; so near, a flat one falls some percent short: |B| = μ0 m / (2π
        // d³) on its axis.
        let moment_a_m2 = 1.0 / super::super::VACUUM_PERMEABILITY_T_M_A * BLOCK_REMANENCE_T * 0.05 * 0.025 * 0.01;
        let distance_m: f64 = 0.1 + 0.005 - 0.0025;
        let dipole_t =
            super::super::VACUUM_PERMEABILITY_T_M_A * moment_a_m2 / (2.0 * std::f64::consts::PI * distance_m.powi(3));
        assert!((field_t[middle] / dipole_t - 1.0).abs() < 0.15, "{} T, dipole {dipole_t} T", field_t[middle]);
        assert!(pull_n[middle].iter().all(|part| part.abs() < 1e-12));
        assert!(pull_n[middle + 4][0] < 0.0 && pull_n[middle - 4][0] > 0.0 && pull_n[middle + 4 * 21][1] < 0.0);
        // The same values as the curves: 4 cm along x.
        let (lateral_n, _) = force::pull_n(&force::block(Orientation::A, BLOCK_REMANENCE_T), [0.04, 0.0], 0.105);
        assert!((pull_n[middle + 4][0] + lateral_n).abs() < 1e-9);
        assert_ne!(plane_of(Orientation::C).field_t, field_t);
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        for (bad, part) in [
            (PlaneQuery { lower_face_height_m: 0.004, ..QUERY }, "lower_face_height_m must be from 0.005"),
            (PlaneQuery { reach_m: f64::NAN, ..QUERY }, "reach_m must be"),
            (PlaneQuery { count: 102, ..QUERY }, "count must be from 2 to 101, not 102"),
        ] {
            let error = plane(&bad).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
