//! Unions, intersections and differences of outlines.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::core::solver::{Precision, Solver};
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};

use super::Ring;

/// Edges are cut where they meet, again and again, until no new point appears; points nearer than a radius are one. The
/// square of the radius begins at one unit of the grid (2⁻⁶⁰ of the drawing) and grows by this power of two in each
/// round. With the library's own power of one, strokes that nearly coincide take seconds. A radius that begins larger
/// leaves thousands of slivers.
const PRECISION: Precision = Precision { start: 0, progression: 3 };

/// The shapes that `rule` leaves of two sets of rings, both filled by the non-zero rule.
pub(super) fn overlay(subject: &[Ring], clip: &[Ring], rule: OverlayRule) -> Vec<Vec<Ring>> {
    let solver = Solver::with_precision(PRECISION);
    FloatOverlay::<_, i64>::from_subj_and_clip_custom(subject, clip, OverlayOptions::default(), solver)
        .overlay(rule, FillRule::NonZero)
}

/// Rings that do not cross, of one shape's rings, which may.
pub(super) fn simple(rings: &[Ring], rule: FillRule) -> Vec<Ring> {
    let solver = Solver::with_precision(PRECISION);
    let mut overlay = FloatOverlay::<_, i64>::from_subj_custom(rings, OverlayOptions::default(), solver);
    overlay.overlay(OverlayRule::Subject, rule).into_iter().flatten().collect()
}
