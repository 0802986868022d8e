//! Superellipses and the modulation matrix M = E·D·E⁻¹.

use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use crate::geometry::{Point2, Vector2};
use crate::perception::Patch;

/// Exponent of the superellipse; above 2 it resembles a rectangle with round corners (paper, §IV-B).
const EXPONENT: f64 = 4.0;

/// An obstacle's boundary: Σ(|x̃_i|/a_i)^4 = 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Superellipse {
    pub center_m: Point2<f64>,
    /// Half sides of the fitted rectangle.
    pub half_size_m: Vector2<f64>,
    /// Half axes a, including margins.
    pub half_axes_m: Vector2<f64>,
}

/// The first column of E.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Basis {
    /// The boundary's normal: Khansari-Zadeh & Billard (2012).
    Normal,
    /// The direction from the centre: Huber, Billard & Slotine (2019), equation 7.
    Star,
}

impl Superellipse {
    /// Encloses a patch: half sides times 2^(1/4), so that the corners touch, times the safety factor, plus a
    /// clearance.
    pub fn around(patch: &Patch, safety_factor: f64, clearance_m: f64) -> Self {
        let enclosing = 2f64.powf(1.0 / EXPONENT) * safety_factor;
        Self {
            center_m: patch.center_m,
            half_size_m: patch.half_size_m,
            half_axes_m: patch.half_size_m * enclosing + Vector2::repeat(clearance_m),
        }
    }

    /// The point of the fitted rectangle that is nearest to a point.
    pub fn nearest_m(&self, point: Point2<f64>) -> Point2<f64> {
        let offset = point - self.center_m;
        self.center_m + offset.sup(&-self.half_size_m).inf(&self.half_size_m)
    }

    /// Γ: 1 on the boundary, more outside.
    pub fn gamma(&self, point: Point2<f64>) -> f64 {
        let scaled = (point - self.center_m).component_div(&self.half_axes_m).abs();
        scaled.x.powf(EXPONENT) + scaled.y.powf(EXPONENT)
    }

    /// Outward unit normal of the level set through `point`; any direction at the centre.
    pub fn normal(&self, point: Point2<f64>) -> Vector2<f64> {
        let offset = point - self.center_m;
        let gradient = offset.zip_map(&self.half_axes_m, |x, a| (x.abs() / a).powf(EXPONENT - 1.0) * x.signum() / a);
        gradient.try_normalize(0.0).unwrap_or_else(Vector2::x)
    }
}

/// Deflects `nominal` around all obstacles: the weighted product of their modulations, nearest last
/// (Khansari-Zadeh & Billard 2012, §4.3).
pub(super) fn modulate(
    obstacles: &[Superellipse],
    point: Point2<f64>,
    nominal: Vector2<f64>,
    rho: f64,
    basis: Basis,
) -> Vector2<f64> {
    let gammas: Vec<f64> = obstacles.iter().map(|o| o.gamma(point).max(1.0)).collect();
    let mut order: Vec<usize> = (0..obstacles.len()).collect();
    order.sort_by(|&a, &b| gammas[b].total_cmp(&gammas[a]));
    order.into_iter().fold(nominal, |velocity, k| {
        modulate_by(&obstacles[k], gammas[k], weight(&gammas, k), point, velocity, rho, basis)
    })
}

/// w_k = Π_{i≠k} (Γ_i−1)/((Γ_k−1)+(Γ_i−1)); if the point is on both boundaries, each gets half.
fn weight(gammas: &[f64], k: usize) -> f64 {
    let excess = |i: usize| gammas[i] - 1.0;
    (0..gammas.len())
        .filter(|&i| i != k)
        .map(|i| {
            let sum = excess(k) + excess(i);
            if sum > 0.0 { excess(i) / sum } else { 0.5 }
        })
        .product()
}

fn modulate_by(
    obstacle: &Superellipse,
    gamma: f64,
    weight: f64,
    point: Point2<f64>,
    velocity: Vector2<f64>,
    rho: f64,
    basis: Basis,
) -> Vector2<f64> {
    let normal = obstacle.normal(point);
    let tangent = Vector2::new(-normal.y, normal.x);
    let first = match basis {
        Basis::Normal => normal,
        Basis::Star => (point - obstacle.center_m).try_normalize(0.0).unwrap_or(normal),
    };
    let reach = weight / gamma.powf(1.0 / rho);
    // The tail effect is off: motion away from the obstacle is not slowed.
    let leaving = normal.dot(&velocity) >= 0.0;
    let lambda_normal = if leaving { 1.0 } else { 1.0 - reach };
    let eigenvalues = Matrix2::from_diagonal(&Vector2::new(lambda_normal, 1.0 + reach));
    let e = Matrix2::from_columns(&[first, tangent]);
    // Every boundary point of a convex shape is visible from the centre, so E is regular.
    e.try_inverse().map_or(velocity, |inverse| e * eigenvalues * inverse * velocity)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> Superellipse {
        Superellipse {
            center_m: Point2::origin(),
            half_size_m: Vector2::repeat(0.8),
            half_axes_m: Vector2::repeat(1.0),
        }
    }

    #[test]
    fn a_superellipse_encloses_its_rectangle() {
        let patch = Patch {
            center_m: Point2::new(0.3, -0.1),
            half_size_m: Vector2::new(0.01, 0.004),
            nearest_m: Point2::new(0.29, -0.1),
        };
        let around = Superellipse::around(&patch, 1.0, 0.0);
        for (sx, sy) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let corner = patch.center_m + patch.half_size_m.component_mul(&Vector2::new(sx, sy));
            assert!((around.gamma(corner) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn on_the_boundary_nothing_flows_inward_and_tangential_speed_doubles() {
        for basis in [Basis::Normal, Basis::Star] {
            for k in 0..64 {
                let angle = f64::from(k) * std::f64::consts::TAU / 64.0;
                let direction = Vector2::new(angle.cos(), angle.sin());
                let point = Point2::from(direction / unit().gamma(Point2::from(direction)).powf(0.25));
                let velocity = modulate(&[unit()], point, Vector2::new(0.3, 0.7), 1.0, basis);
                assert!(unit().normal(point).dot(&velocity) > -1e-9, "{basis:?} {point}");
            }
            let top = Point2::new(0.0, 1.0);
            let along = modulate(&[unit()], top, Vector2::x(), 1.0, basis);
            assert!((along - Vector2::x() * 2.0).norm() < 1e-12);
        }
    }

    #[test]
    fn far_away_the_flow_is_unchanged_and_weights_sum_to_one() {
        let velocity = Vector2::new(0.3, 0.7);
        let far = modulate(&[unit()], Point2::new(50.0, 0.0), velocity, 1.0, Basis::Normal);
        assert!((far - velocity).norm() < 1e-6);
        assert_eq!(weight(&[1.0, 3.0], 0), 1.0);
        assert_eq!(weight(&[1.0, 3.0], 1), 0.0);
        assert_eq!(weight(&[1.0, 1.0], 0), 0.5);
    }
}
