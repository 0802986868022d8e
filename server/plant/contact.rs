//! The bead against the walls: it slides along them, bounces a little, and never passes.

use super::bead::shrunk;
use super::{BEAD_RADIUS_M, Bead};
use crate::geometry::{Point2, Vector2};
use crate::map::Map;

/// Restitution of bead on wall.
const RESTITUTION: f64 = 0.3;
/// Friction of bead on wall.
const WALL_FRICTION: f64 = 0.1;
/// Most walls that one hop settles in turn before it looks for the corner between the last two.
const PASSES: usize = 4;
/// Rounding allowed when a contact is checked.
const SLOP_M: f64 = 1e-9;
/// What a search for room does not skip on account of rounding.
const SKIP_MM: f64 = 1e-3;
/// A bead this near to a wall leans on it.
const TOUCH_M: f64 = 1e-7;
/// Slower than this into the wall that it touches, the bead leans and does not bounce: what the strongest
/// pull adds in a millisecond.
const LEAN_M_S: f64 = 0.02;

/// Takes the push of a bead into the wall that it leans on, so that only what is left of it works
/// against the table's friction. Returns by how much the wall's own friction slows the bead.
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

/// Moves the bead for `dt_s`, in hops short enough that its centre cannot cross a wall unseen.
pub(super) fn advance(bead: &mut Bead, map: &Map, dt_s: f64) {
    let travel_m = bead.velocity_m_s.norm() * dt_s;
    let hops = (travel_m / (0.5 * BEAD_RADIUS_M)).ceil().max(1.0);
    for _ in 0..hops as usize {
        hop(bead, map, dt_s / hops);
    }
}

/// A wall where the bead met it: its nearest point, and the normal from it to the bead.
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
        // The hop is shorter than the radius, so `to` is still on the wall's free side, and the
        // normal points from the wall to the bead.
        let Some(normal) = (to - wall_m).try_normalize(1e-12) else { break };
        let met = Contact { wall_m, normal };
        bounce(bead, normal);
        to = wall_m + normal * BEAD_RADIUS_M;
        // In a corner each wall pushes the bead into the other, by less each time but never by nothing.
        // Nearer than its radius to where it fitted there is no wall that it could have passed.
        if let Some(corner_m) = last.and_then(|other| corner(other, met))
            && (corner_m - bead.position_m).norm() < BEAD_RADIUS_M
            && map.nearest_wall_point_within(corner_m, BEAD_RADIUS_M - SLOP_M).is_none()
        {
            to = corner_m;
        }
        last = Some(met);
    }
    // A wedge too narrow to resolve: stay where it was valid.
    bead.velocity_m_s = Vector2::zeros();
}

/// The impulse of a wall on a bead that moves into it.
fn bounce(bead: &mut Bead, normal: Vector2<f64>) {
    let approach_m_s = bead.velocity_m_s.dot(&normal);
    if approach_m_s < 0.0 {
        let impulse_m_s = -(1.0 + RESTITUTION) * approach_m_s;
        let tangential = shrunk(bead.velocity_m_s - normal * approach_m_s, WALL_FRICTION * impulse_m_s);
        bead.velocity_m_s = tangential - normal * RESTITUTION * approach_m_s;
    }
}

/// Where the bead touches both walls, if they are not parallel.
fn corner(a: Contact, b: Contact) -> Option<Point2<f64>> {
    let normals = nalgebra::Matrix2::from_rows(&[a.normal.transpose(), b.normal.transpose()]);
    let reach = |c: Contact| c.normal.dot(&c.wall_m.coords) + BEAD_RADIUS_M;
    normals.try_inverse().map(|inverse| Point2::from(inverse * Vector2::new(reach(a), reach(b))))
}

/// The nearest point to `wanted` at which the bead fits, to a millimetre, searched outward on circles;
/// `None` only if it fits nowhere.
pub fn nearest_fit(map: &Map, wanted: Point2<f64>) -> Option<Point2<f64>> {
    // Where so much room is lacking, it fits nowhere nearer than that: a large map that is all wall but for a far
    // corner would be searched for a minute.
    let lacking_m = |p: Point2<f64>| BEAD_RADIUS_M - map.clearance_m(p);
    let here_m = lacking_m(wanted);
    if here_m <= 0.0 {
        return Some(wanted);
    }
    let nearest_mm = ((here_m * 1e3 - SKIP_MM) as u32).max(1);
    let farthest_mm = (map.workspace().size_m().norm() * 1e3).ceil() as u32;
    (nearest_mm..=farthest_mm).find_map(|radius_mm| {
        // A millimetre apart on the circle too.
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

    /// The search without what it skips.
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
    fn the_nearest_room_is_found_as_if_nothing_were_skipped() {
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
    fn room_in_the_far_corner_of_a_large_map_takes_no_minute_to_find() {
        let svg = r#"<svg viewBox="0 0 4000 4000"><path d="M0 0H4000V4000H20V3980H0Z"/></svg>"#;
        let map = Map::from_svg("far", svg).unwrap();
        let begun = std::time::Instant::now();
        let found = nearest_fit(&map, Point2::new(3.99, -0.01)).unwrap();
        assert!(found.x < 0.02 && found.y < -3.98, "{found}");
        // It took a minute and more, and takes milliseconds.
        assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    }
}
