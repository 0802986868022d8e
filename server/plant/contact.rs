//! Contact of the bead with walls: it slides along them, bounces a little, and never passes through.

use super::bead::shrunk;
use super::{BEAD_RADIUS_M, Bead};
use crate::geometry::{Point2, Vector2};
use crate::map::Map;

/// Coefficient of restitution between bead and wall.
const RESTITUTION: f64 = 0.3;
/// Coulomb friction coefficient between bead and wall.
const WALL_FRICTION: f64 = 0.1;
/// Maximum number of contacts resolved one after the other in one hop.
const PASSES: usize = 4;
/// Rounding tolerance of contact checks.
const SLOP_M: f64 = 1e-9;
/// Margin for rounding in [`nearest_fit`]: radii closer than this are not skipped.
const SKIP_MM: f64 = 1e-3;
/// A bead within this distance of a wall touches it.
const TOUCH_M: f64 = 1e-7;
/// A bead that touches a wall and moves into it slower than this leans on it instead of bouncing. The
/// strongest pull changes the speed by this much in a millisecond.
const LEAN_M_S: f64 = 0.02;

/// Removes the velocity of a leaning bead into its wall, so that only the remaining velocity works against
/// the table's friction. Returns by how much the wall's friction slows the bead, m/s.
pub(super) fn lean(bead: &mut Bead, map: &Map) -> f64 {
    let Some(wall) = map.nearest_wall_point_within(bead.position_m, BEAD_RADIUS_M + TOUCH_M) else { return 0.0 };
    let Some(normal) = (bead.position_m - wall).try_normalize(1e-12) else { return 0.0 };
    let push_m_s = -bead.velocity_m_s.dot(&normal);
    if !(0.0..=LEAN_M_S).contains(&push_m_s) {
        return 0.0;
    }
    bead.velocity_m_s += normal * push_m_s;
    WALL_FRICTION * push_m_s
}

/// Moves the bead for `dt_s`, in hops so short that its centre cannot cross a wall undetected.
pub(super) fn advance(bead: &mut Bead, map: &Map, dt_s: f64) {
    let travel_m = bead.velocity_m_s.norm() * dt_s;
    let hops = (travel_m / (0.5 * BEAD_RADIUS_M)).ceil().max(1.0);
    for _ in 0..hops as usize {
        hop(bead, map, dt_s / hops);
    }
}

/// A contact: the nearest point of the wall, and the normal from it to the bead.
#[derive(Clone, Copy)]
struct Contact {
    wall_m: Point2<f64>,
    normal: Vector2<f64>,
}

fn hop(bead: &mut Bead, map: &Map, dt_s: f64) {
    if bead.velocity_m_s == Vector2::zeros() {
        return;
    }
    let mut to = bead.position_m + bead.velocity_m_s * dt_s;
    let mut last: Option<Contact> = None;
    for _ in 0..PASSES {
        let Some(wall_m) = map.nearest_wall_point_within(to, BEAD_RADIUS_M - SLOP_M) else {
            bead.position_m = to;
            return;
        };
        // The hop is shorter than the radius, so `to` is still on the free side of the wall, and the
        // normal points from the wall to the bead.
        let Some(normal) = (to - wall_m).try_normalize(1e-12) else { break };
        let met = Contact { wall_m, normal };
        bounce(bead, normal);
        to = wall_m + normal * BEAD_RADIUS_M;
        // In a corner each wall pushes the bead into the other one, by less each time but never by zero, so
        // the bead is put where it touches both. Within a radius of its last valid position there is no wall
        // that it could have passed.
        if let Some(corner_m) = last.and_then(|other| corner(other, met))
            && (corner_m - bead.position_m).norm() < BEAD_RADIUS_M
            && map.nearest_wall_point_within(corner_m, BEAD_RADIUS_M - SLOP_M).is_none()
        {
            to = corner_m;
        }
        last = Some(met);
    }
    // The wedge is too narrow to resolve: stay at the last valid position.
    bead.velocity_m_s = Vector2::zeros();
}

/// Applies the impulse of a wall to a bead that moves into it.
fn bounce(bead: &mut Bead, normal: Vector2<f64>) {
    let approach_m_s = bead.velocity_m_s.dot(&normal);
    if approach_m_s < 0.0 {
        let impulse_m_s = -(1.0 + RESTITUTION) * approach_m_s;
        let tangential = shrunk(bead.velocity_m_s - normal * approach_m_s, WALL_FRICTION * impulse_m_s);
        bead.velocity_m_s = tangential - normal * RESTITUTION * approach_m_s;
    }
}

/// The position at which the bead touches both walls; `None` if they are parallel.
fn corner(a: Contact, b: Contact) -> Option<Point2<f64>> {
    let normals = nalgebra::Matrix2::from_rows(&[a.normal.transpose(), b.normal.transpose()]);
    let reach = |c: Contact| c.normal.dot(&c.wall_m.coords) + BEAD_RADIUS_M;
    normals.try_inverse().map(|inverse| Point2::from(inverse * Vector2::new(reach(a), reach(b))))
}

/// The nearest point to `wanted` at which the bead fits, to a millimetre. Searches outward on circles;
/// `None` if it fits nowhere.
pub fn nearest_fit(map: &Map, wanted: Point2<f64>) -> Option<Point2<f64>> {
    // If the clearance at `wanted` is too small by some distance, the bead fits nowhere within that distance.
    // Without this skip, a large map that is solid except for a far corner takes a minute to search.
    let lacking_m = |p: Point2<f64>| BEAD_RADIUS_M - map.clearance_m(p);
    let here_m = lacking_m(wanted);
    if here_m <= 0.0 {
        return Some(wanted);
    }
    let nearest_mm = ((here_m * 1e3 - SKIP_MM) as u32).max(1);
    let farthest_mm = (map.workspace().size_m().norm() * 1e3).ceil() as u32;
    (nearest_mm..=farthest_mm).find_map(|radius_mm| {
        // Points on the circle are a millimetre apart, too.
        let count = (std::f64::consts::TAU * f64::from(radius_mm)).ceil().max(16.0) as u32;
        let mut k = 0;
        while k < count {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(count)).sin_cos();
            let place = wanted + Vector2::new(cos, sin) * (f64::from(radius_mm) * 1e-3);
            let lacking_m = lacking_m(place);
            if lacking_m <= 0.0 {
                return Some(place);
            }
            k += ((lacking_m * 1e3 - SKIP_MM) as u32).max(1);
        }
        None
    })
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// The search without skipping.
    fn plainly(map: &Map, wanted: Point2<f64>) -> Option<Point2<f64>> {
        let fits = |p: &Point2<f64>| map.clearance_m(*p) >= BEAD_RADIUS_M;
        let on_circle = |radius_mm: u32| {
            let count = (std::f64::consts::TAU * f64::from(radius_mm)).ceil().max(16.0) as u32;
            (0..count).map(move |k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(count)).sin_cos();
                wanted + Vector2::new(cos, sin) * (f64::from(radius_mm) * 1e-3)
            })
        };
        std::iter::once(wanted).chain((1..600).flat_map(on_circle)).find(fits)
    }

    #[test]
    fn skipping_does_not_change_the_nearest_fit() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut moved = 0;
        for name in ["colon", "posts"] {
            let map = Map::shipped(name).unwrap();
            for _ in 0..500 {
                let wanted = Point2::new(rng.random_range(-0.35..0.35), rng.random_range(-0.6..-0.15));
                let found = nearest_fit(&map, wanted);
                assert_eq!(found, plainly(&map, wanted), "{name} {wanted}");
                moved += usize::from(found != Some(wanted));
            }
        }
        assert!(moved > 300, "{moved}");
    }

    #[test]
    fn finds_a_fit_in_the_far_corner_of_a_large_map_quickly() {
        let svg = r#"<svg viewBox="0 0 4000 4000"><path d="M0 0H4000V4000H20V3980H0Z"/></svg>"#;
        let map = Map::from_svg("far", svg).unwrap();
        let begun = std::time::Instant::now();
        let found = nearest_fit(&map, Point2::new(3.99, -0.01)).unwrap();
        assert!(found.x < 0.02 && found.y < -3.98, "{found}");
        // It takes milliseconds; without skipping it took more than a minute.
        assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    }
}
