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
//! The published sums lose digits in line with edges and take 24 to 48 logarithms and arctangents. The
//! module `edges` needs only three to five and keeps the digits.

use super::{
    VACUUM_PERMEABILITY_T_M_A, dipole,
    edges::{LANES, Lanes, View},
};
use crate::geometry::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Beyond this many half-diagonals the magnet is a dipole to about 1e-6 of its field. The closed form is an
/// eightfold difference and is no more accurate there.
const DIPOLE_DISTANCE: f64 = 1e3;

/// Range of half sides without overflow, m.
const LEAST_HALF_M: f64 = 1e-9;
const MOST_HALF_M: f64 = 1e6;

#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CuboidError {
    /// A side is zero, negative, NaN, or out of range.
    #[error("{field} must be {LEAST_HALF_M} to {MOST_HALF_M} m, not {value}")]
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

/// A uniformly magnetised cuboid with its centre at the origin and its sides along the axes.
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
            if !(LEAST_HALF_M..=MOST_HALF_M).contains(&value) {
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

    /// Whether a point (m, from the centre) lies inside; a face belongs to the outside.
    pub fn contains(&self, point_m: &Vector3<f64>) -> bool {
        (0..3).all(|axis| point_m[axis].abs() < self.half_size_m[axis])
    }

    /// Magnetic moment, A·m²: polarisation times volume over μ0.
    pub fn moment_a_m2(&self) -> Vector3<f64> {
        let volume_m3 = 8.0 * self.half_size_m.product();
        self.polarization_t * (volume_m3 / VACUUM_PERMEABILITY_T_M_A)
    }

    /// The magnetic flux density B, T, at a point given from the centre, m.
    ///
    /// Inside the magnet B is μ0·H plus the polarisation; a face belongs to the outside. The result is finite
    /// for every finite point, also on faces, edges and corners, and NaN for a NaN point.
    pub fn field_t(&self, point_m: &Vector3<f64>) -> Vector3<f64> {
        Scaled::new(self).fields([point_m; LANES])[0]
    }

    /// [`Self::field_t`] at each of many points, the same to the last bit, at half the cost.
    pub fn fields_t(&self, points_m: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let scaled = Scaled::new(self);
        let mut fields = Vec::with_capacity(points_m.len());
        let (groups, rest) = points_m.as_chunks::<LANES>();
        for group in groups {
            fields.extend(scaled.fields(group.each_ref()));
        }
        fields.extend(rest.iter().map(|point_m| self.field_t(point_m)));
        fields
    }

    /// The gradient of B, T/m, at a point given from the centre, m: entry (i, j) is ∂B_i/∂x_j.
    ///
    /// Symmetric and traceless, also inside the magnet, because curl and divergence are zero.
    pub fn gradient_t_m(&self, point_m: &Vector3<f64>) -> Matrix3<f64> {
        let scaled = Scaled::new(self);
        if scaled.is_near(point_m) {
            scaled.gradient(&scaled.look([point_m; LANES]))
        } else {
            dipole::gradient_t_m(&self.moment_a_m2(), point_m)
        }
    }

    /// [`Self::field_t`] and [`Self::gradient_t_m`] together, at less than the cost of both.
    pub fn field_and_gradient(&self, point_m: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let scaled = Scaled::new(self);
        if scaled.is_near(point_m) {
            let look = scaled.look([point_m; LANES]);
            (scaled.field(&look)[0], scaled.gradient(&look))
        } else {
            let moment = self.moment_a_m2();
            (dipole::field_t(&moment, point_m), dipole::gradient_t_m(&moment, point_m))
        }
    }
}

/// A cuboid with lengths in units of its half-diagonal.
struct Scaled<'a> {
    cuboid: &'a Cuboid,
    half: Vector3<f64>,
    /// Half-diagonals per metre.
    unit_per_m: f64,
}

/// Points mirrored to non-negative coordinates.
struct Look {
    view: View,
    /// ±1 along each axis: multiplying by it undoes the mirroring.
    mirror: [Lanes; 3],
}

impl<'a> Scaled<'a> {
    #[inline(always)]
    fn new(cuboid: &'a Cuboid) -> Self {
        let unit_per_m = 1.0 / cuboid.half_size_m.norm();
        Self { cuboid, half: cuboid.half_size_m * unit_per_m, unit_per_m }
    }

    /// Whether the closed form applies instead of the dipole; false for NaN.
    #[inline(always)]
    fn is_near(&self, point_m: &Vector3<f64>) -> bool {
        (point_m * self.unit_per_m).norm_squared() <= DIPOLE_DISTANCE * DIPOLE_DISTANCE
    }

    #[inline(always)]
    fn look(&self, points_m: [&Vector3<f64>; LANES]) -> Look {
        let points = [0, 1, 2].map(|k| Lanes::new(points_m.map(|point| point[k])) * self.unit_per_m);
        Look { view: View::new(&self.half, points.map(Lanes::abs)), mirror: points.map(|p| Lanes::ONE.copysign(p)) }
    }

    /// B in T, from the dipole where that applies.
    #[inline(always)]
    fn fields(&self, points_m: [&Vector3<f64>; LANES]) -> [Vector3<f64>; LANES] {
        let mut fields = self.field(&self.look(points_m));
        for (field, point_m) in fields.iter_mut().zip(points_m) {
            if !self.is_near(point_m) {
                *field = dipole::field_t(&self.cuboid.moment_a_m2(), point_m);
            }
        }
        fields
    }

    /// B in T by the closed form.
    #[inline(always)]
    fn field(&self, look: &Look) -> [Vector3<f64>; LANES] {
        let polarization = &self.cuboid.polarization_t;
        let [jx, jy, jz] = [0, 1, 2].map(|k| look.mirror[k] * polarization[k]);
        let tensor = look.view.tensor([polarization.x != 0.0, polarization.y != 0.0, polarization.z != 0.0]);
        let ([xx, yy, zz], [yz, zx, xy]) = (tensor.diagonal, tensor.mixed);
        let sums = [xx * jx + xy * jy + zx * jz, xy * jx + yy * jy + yz * jz, zx * jx + yz * jy + zz * jz];
        let is_inside = look.view.is_inside();
        let field = |sum: Lanes, j: Lanes, mirror: Lanes| ((sum * (0.25 / PI) + (is_inside & j)) * mirror).to_array();
        let [x, y, z] = [
            field(sums[0], jx, look.mirror[0]),
            field(sums[1], jy, look.mirror[1]),
            field(sums[2], jz, look.mirror[2]),
        ];
        std::array::from_fn(|lane| Vector3::new(x[lane], y[lane], z[lane]))
    }

    /// ∂B_i/∂x_j in T/m at the first point by the closed form.
    #[inline(always)]
    fn gradient(&self, look: &Look) -> Matrix3<f64> {
        let slopes = look.view.slopes();
        let first = |lanes: Lanes| lanes.to_array()[0];
        let xyz = first(slopes.xyz);
        let ([yyz, xzz, xxy], [yzz, xxz, xyy]) = (slopes.next.map(first), slopes.last.map(first));
        // The other entries follow because the potential is harmonic.
        let (xxx, yyy, zzz) = (-xyy - xzz, -xxy - yzz, -xxz - yyz);
        let mirror = Vector3::from(look.mirror.map(first));
        let [jx, jy, jz] = self.cuboid.polarization_t.component_mul(&mirror).into();
        let [bxx, bxy, bxz] =
            [xxx * jx + xxy * jy + xxz * jz, xxy * jx + xyy * jy + xyz * jz, xxz * jx + xyz * jy + xzz * jz];
        let [byy, byz] = [xyy * jx + yyy * jy + yyz * jz, xyz * jx + yyz * jy + yzz * jz];
        let bzz = xzz * jx + yzz * jy + zzz * jz;
        let gradient = Matrix3::new(bxx, bxy, bxz, bxy, byy, byz, bxz, byz, bzz);
        gradient.component_mul(&(mirror * mirror.transpose())) * (self.unit_per_m / (4.0 * PI))
    }
}
