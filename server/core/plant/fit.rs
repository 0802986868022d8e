//! Where the bead fits.

use super::BEAD_RADIUS_M;
use crate::geometry::{Point2, Rect, Vector2};

/// Margin for rounding in [`nearest_fit`]: radii closer than this are not skipped.
const SKIP_MM: f64 = 1e-3;

/// The nearest point to `wanted` at which the bead fits, to a millimetre. Searches outward on circles;
/// `None` if it fits nowhere. No place may fit that is nearer than the clearance is smaller than the bead's radius.
pub(super) fn nearest_fit(
    workspace: &Rect,
    wanted: Point2<f64>,
    clearance_m: impl Fn(Point2<f64>) -> f64,
) -> Option<Point2<f64>> {
    // If the clearance at `wanted` is too small by some distance, the bead fits nowhere within that distance.
    // Without this skip, a large map that is solid except for a far corner takes a minute to search.
    let lacking_m = |p: Point2<f64>| BEAD_RADIUS_M - clearance_m(p);
    let here_m = lacking_m(wanted);
    if here_m <= 0.0 {
        return Some(wanted);
    }
    let nearest_mm = ((here_m * 1e3 - SKIP_MM) as u32).max(1);
    let farthest_mm = (workspace.size_m().norm() * 1e3).ceil() as u32;
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
    use crate::map::Map;

    fn fit(map: &Map, wanted: Point2<f64>) -> Option<Point2<f64>> {
        nearest_fit(map.workspace(), wanted, |point| map.clearance_m(point))
    }

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
                let found = fit(&map, wanted);
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
        let found = fit(&map, Point2::new(3.99, -0.01)).unwrap();
        assert!(found.x < 0.02 && found.y < -3.98, "{found}");
        // It takes milliseconds; without skipping it took more than a minute.
        assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    }
}
