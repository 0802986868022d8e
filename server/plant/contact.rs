//! The bead against the walls: it slides along them, bounces a little, and never passes.

use super::{BEAD_RADIUS_M, Bead};
use crate::geometry::{Point2, Vector2};
use crate::map::Map;

/// Restitution of bead on wall.
const RESTITUTION: f64 = 0.3;
/// Friction of bead on wall.
const WALL_FRICTION: f64 = 0.1;
/// Corners need a pass for each of their two walls, and one more to see that both hold.
const PASSES: usize = 4;
/// Rounding allowed when a contact is checked.
const SLOP_M: f64 = 1e-9;

/// Moves the bead for `dt_s`, in hops short enough that its centre cannot cross a wall unseen.
pub(super) fn advance(bead: &mut Bead, map: &Map, dt_s: f64) {
    let travel_m = bead.velocity_m_s.norm() * dt_s;
    let hops = (travel_m / (0.5 * BEAD_RADIUS_M)).ceil().max(1.0);
    for _ in 0..hops as usize {
        hop(bead, map, dt_s / hops);
    }
}

fn hop(bead: &mut Bead, map: &Map, dt_s: f64) {
    if bead.velocity_m_s == Vector2::zeros() {
        return;
    }
    let from = bead.position_m;
    let mut to = from + bead.velocity_m_s * dt_s;
    for _ in 0..PASSES {
        let Some(wall) = map.nearest_wall_point_within(to, BEAD_RADIUS_M - SLOP_M) else {
            bead.position_m = to;
            return;
        };
        let gap: Vector2<f64> = to - wall;
        // The hop is shorter than the radius, so `to` is still on the wall's free side, and the
        // normal points from the wall to the bead.
        let Some(normal) = gap.try_normalize(1e-12) else { break };
        to = wall + normal * BEAD_RADIUS_M;
        let approach_m_s = bead.velocity_m_s.dot(&normal);
        if approach_m_s < 0.0 {
            let impulse_m_s = -(1.0 + RESTITUTION) * approach_m_s;
            let tangential = bead.velocity_m_s - normal * approach_m_s;
            let drop_m_s = (WALL_FRICTION * impulse_m_s).min(tangential.norm());
            let tangential = tangential - tangential.try_normalize(1e-12).unwrap_or_default() * drop_m_s;
            bead.velocity_m_s = tangential - normal * RESTITUTION * approach_m_s;
        }
    }
    // A wedge too narrow to resolve: stay where it was valid.
    bead.velocity_m_s = Vector2::zeros();
}

/// The nearest point to `wanted` at which the bead fits, to a millimetre, searched outward on circles;
/// `None` only if it fits nowhere.
pub fn nearest_fit(map: &Map, wanted: Point2<f64>) -> Option<Point2<f64>> {
    let fits = |p: &Point2<f64>| map.clearance_m(*p) >= BEAD_RADIUS_M;
    if fits(&wanted) {
        return Some(wanted);
    }
    let farthest_mm = (map.workspace().size_m().norm() * 1e3).ceil() as u32;
    (1..=farthest_mm).find_map(|radius_mm| {
        let count = 16 + 4 * radius_mm.min(60);
        (0..count)
            .map(|k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(count)).sin_cos();
                wanted + Vector2::new(cos, sin) * (f64::from(radius_mm) * 1e-3)
            })
            .find(fits)
    })
}
