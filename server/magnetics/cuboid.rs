//! The field of a uniformly magnetised cuboid and its gradient, both in closed form.
//!
//! Write X = x ∓ a, Y = y ∓ b, Z = z ∓ c for the offset of the point from each of the eight corners, R
//! for its length and s = ±1 for the corner's sign, −1 if an odd number of its coordinates is the
//! lower one. Then 4π·B_i = Σ_j T_ij·J_j outside, with the symmetric tensor
//! - T_zz = Σ s·atan(XY/(ZR)), and T_xx, T_yy by permutation;
//! - T_xy = −Σ s·ln(R + Z), and T_xz, T_yz by permutation
//!
//! (Camacho and Sosa, Rev. Mex. Fís. E 59, 8 (2013); Engel-Herbert and Hesjedal, J. Appl. Phys. 97,
//! 074504 (2005)). Its derivatives are algebraic, and symmetric in all three indices.
//!
//! Two measures keep the digits that the plain sums lose in line with edges and beside faces. The point
//! is mirrored into x, y, z ≥ 0, so that R + X with X < 0 occurs only beside an edge, where it is
//! (Y² + Z²)/(R − X). And the eight logarithms of a sum are one logarithm of a ratio, in which what is
//! singular cancels before the logarithm is taken.

use super::{VACUUM_PERMEABILITY_T_M_A, dipole};
use crate::geometry::{Matrix3, Vector3};
use std::f64::consts::PI;

/// On an edge the field is infinite. Nearer to it than this part of the half-diagonal, some tens of
/// picometres and less than any real edge is sharp, it is taken at this distance.
const EDGE_RADIUS: f64 = 1e-9;

/// Beyond this many half-diagonals the magnet is a dipole to about 1e-6 of its field, and the closed
/// form, an eightfold difference, keeps no more digits than that.
const DIPOLE_DISTANCE: f64 = 1e3;

/// Signs of the corners; bit k of the index is set where the corner is the lower one along axis k.
const SIGNS: [f64; 8] = [1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0];

/// Why a cuboid cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CuboidError {
    /// A side is zero, negative, infinite or NaN.
    #[error("{field} must be positive and finite, not {value}")]
    HalfSize {
        /// `half_size_m.x`, `half_size_m.y` or `half_size_m.z`.
        field: &'static str,
        /// The offending value, m.
        value: f64,
    },
    /// A component of the polarisation is infinite or NaN.
    #[error("{field} must be finite, not {value}")]
    Polarization {
        /// `polarization_t.x`, `polarization_t.y` or `polarization_t.z`.
        field: &'static str,
        /// The offending value, T.
        value: f64,
    },
}

/// A uniformly magnetised cuboid, its centre in the origin and its sides along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Half of each side, m.
    pub half_size_m: Vector3<f64>,
    /// Polarisation J = μ0·M, T: for a hard magnet its remanence, in the direction of magnetisation.
    pub polarization_t: Vector3<f64>,
}

impl Cuboid {
    /// A cuboid with the given half sides (m) and polarisation (T).
    ///
    /// # Errors
    /// [`CuboidError`], naming the field and its value.
    pub fn new(half_size_m: Vector3<f64>, polarization_t: Vector3<f64>) -> Result<Self, CuboidError> {
        let names = ["half_size_m.x", "half_size_m.y", "half_size_m.z"];
        for (field, &value) in names.into_iter().zip(&half_size_m) {
            if !(value.is_finite() && value > 0.0) {
                return Err(CuboidError::HalfSize { field, value });
            }
        }
        let names = ["polarization_t.x", "polarization_t.y", "polarization_t.z"];
        for (field, &value) in names.into_iter().zip(&polarization_t) {
            if !value.is_finite() {
                return Err(CuboidError::Polarization { field, value });
            }
        }
        Ok(Self { half_size_m, polarization_t })
    }

    /// Magnetic moment, A·m²: polarisation times volume over μ0.
    pub fn moment_a_m2(&self) -> Vector3<f64> {
        let volume_m3 = 8.0 * self.half_size_m.product();
        self.polarization_t * (volume_m3 / VACUUM_PERMEABILITY_T_M_A)
    }

    /// The magnetic flux density B, T, at a point given from the centre, m.
    ///
    /// Inside the magnet B is μ0·H plus the polarisation; a face belongs to the outside. Finite for
    /// every finite point, on faces, edges and corners too; not a number if the point is not.
    pub fn field_t(&self, point_m: &Vector3<f64>) -> Vector3<f64> {
        match self.view(point_m) {
            Some(view) => view.field(),
            None => dipole::field_t(&self.moment_a_m2(), point_m),
        }
    }

    /// The gradient of B, T/m, at a point given from the centre, m: entry (i, j) is ∂B_i/∂x_j.
    ///
    /// Symmetric and traceless, inside the magnet too, because neither curl nor divergence is left.
    pub fn gradient_t_m(&self, point_m: &Vector3<f64>) -> Matrix3<f64> {
        match self.view(point_m) {
            Some(view) => view.gradient(),
            None => dipole::gradient_t_m(&self.moment_a_m2(), point_m),
        }
    }

    /// [`Self::field_t`] and [`Self::gradient_t_m`] together, at less than the cost of both.
    pub fn field_and_gradient(&self, point_m: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        match self.view(point_m) {
            Some(view) => (view.field(), view.gradient()),
            None => {
                let moment = self.moment_a_m2();
                let field = dipole::field_t(&moment, point_m);
                (field, dipole::gradient_t_m(&moment, point_m))
            }
        }
    }

    /// The corners as seen from a point, or `None` where the magnet is a dipole.
    #[inline]
    fn view(&self, point_m: &Vector3<f64>) -> Option<View> {
        let unit_per_m = 1.0 / self.half_size_m.norm();
        let point = point_m * unit_per_m;
        if point.norm_squared() > DIPOLE_DISTANCE * DIPOLE_DISTANCE {
            return None;
        }
        let half = self.half_size_m * unit_per_m;
        let mirror = point.map(|p| if p < 0.0 { -1.0 } else { 1.0 });
        let point = point.abs();
        let is_inside = point.x < half.x && point.y < half.y && point.z < half.z;
        let corners = std::array::from_fn(|i| {
            Corner::new(std::array::from_fn(|axis| {
                let is_lower = i >> axis & 1 == 1;
                point[axis] + if is_lower { half[axis] } else { -half[axis] }
            }))
        });
        Some(View {
            corners,
            mirror,
            polarization_t: self.polarization_t.component_mul(&mirror),
            is_inside,
            unit_per_m,
        })
    }
}

/// One corner as seen from the point, in half-diagonals.
struct Corner {
    /// X, Y, Z: the point from the corner.
    offset: [f64; 3],
    /// R, the distance.
    distance: f64,
    /// R + X, R + Y, R + Z, never zero.
    sum: [f64; 3],
}

impl Corner {
    #[inline]
    fn new(offset: [f64; 3]) -> Self {
        let square = offset.map(|x| x * x);
        let total = square[0] + square[1] + square[2];
        let distance = total.sqrt().max(EDGE_RADIUS);
        let sum = std::array::from_fn(|axis| {
            let x = offset[axis];
            if x >= 0.0 {
                distance + x
            } else {
                let beside = square[(axis + 1) % 3] + square[(axis + 2) % 3];
                beside.max(EDGE_RADIUS * EDGE_RADIUS) / (distance - x)
            }
        });
        Self { offset, distance, sum }
    }
}

/// All corners as seen from one point, mirrored into x, y, z ≥ 0.
struct View {
    corners: [Corner; 8],
    /// ±1 along each axis: what undoes the mirror.
    mirror: Vector3<f64>,
    /// Polarisation in the mirror, T.
    polarization_t: Vector3<f64>,
    is_inside: bool,
    /// Half-diagonals a metre.
    unit_per_m: f64,
}

impl View {
    /// B in T.
    #[inline]
    fn field(&self) -> Vector3<f64> {
        let [jx, jy, jz] = self.polarization_t.into();
        // T_yz, T_xz, T_xy, each only where the polarisation has a use for it.
        let used = [jy != 0.0 || jz != 0.0, jx != 0.0 || jz != 0.0, jx != 0.0 || jy != 0.0];
        let [yz, xz, xy] = std::array::from_fn(|axis| if used[axis] { self.minus_logarithms(axis) } else { 0.0 });
        let [xx, yy, zz] =
            std::array::from_fn(|axis| if self.polarization_t[axis] == 0.0 { 0.0 } else { self.arctangents(axis) });
        let mut field =
            Vector3::new(xx * jx + xy * jy + xz * jz, xy * jx + yy * jy + yz * jz, xz * jx + yz * jy + zz * jz)
                / (4.0 * PI);
        if self.is_inside {
            field += self.polarization_t;
        }
        field.component_mul(&self.mirror)
    }

    /// −Σ s·ln(R + X) for the X of `axis`.
    #[inline]
    fn minus_logarithms(&self, axis: usize) -> f64 {
        let (mut above, mut below) = (1.0, 1.0);
        for (corner, sign) in self.corners.iter().zip(SIGNS) {
            if sign > 0.0 {
                below *= corner.sum[axis];
            } else {
                above *= corner.sum[axis];
            }
        }
        (above / below).ln()
    }

    /// Σ s·atan(YZ/(XR)) for the X of `axis`; a face counts as seen from outside.
    #[inline]
    fn arctangents(&self, axis: usize) -> f64 {
        let mut sum = 0.0;
        for (corner, sign) in self.corners.iter().zip(SIGNS) {
            let x = corner.offset[axis];
            let area = corner.offset[(axis + 1) % 3] * corner.offset[(axis + 2) % 3];
            let angle = area.atan2(x.abs() * corner.distance);
            sum += if x < 0.0 { -sign * angle } else { sign * angle };
        }
        sum
    }

    /// ∂B_i/∂x_j in T/m.
    #[inline]
    fn gradient(&self) -> Matrix3<f64> {
        let (mut xyz, mut xxy, mut xyy, mut xxz, mut xzz, mut yyz, mut yzz) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        // −∂ ln(R + Z)/∂x = −X/(R(R + Z)) and its permutations.
        for (corner, sign) in self.corners.iter().zip(SIGNS) {
            let [x, y, z] = corner.offset;
            let per_distance = -sign / corner.distance;
            let [qx, qy, qz] = corner.sum.map(|sum| per_distance / sum);
            xyz += per_distance;
            xxy += x * qz;
            xyy += y * qz;
            xxz += x * qy;
            xzz += z * qy;
            yyz += y * qx;
            yzz += z * qx;
        }
        // The rest follows because the potential is harmonic.
        let (xxx, yyy, zzz) = (-xyy - xzz, -xxy - yzz, -xxz - yyz);
        let [jx, jy, jz] = self.polarization_t.into();
        let [bxx, bxy, bxz] =
            [xxx * jx + xxy * jy + xxz * jz, xxy * jx + xyy * jy + xyz * jz, xxz * jx + xyz * jy + xzz * jz];
        let [byy, byz] = [xyy * jx + yyy * jy + yyz * jz, xyz * jx + yyz * jy + yzz * jz];
        let bzz = xzz * jx + yzz * jy + zzz * jz;
        let gradient = Matrix3::new(bxx, bxy, bxz, bxy, byy, byz, bxz, byz, bzz);
        let mirrors = self.mirror * self.mirror.transpose();
        gradient.component_mul(&mirrors) * (self.unit_per_m / (4.0 * PI))
    }
}
