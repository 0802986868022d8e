//! Unions, intersections and differences of outlines.
//!
//! With the library's own precision: a coarser one unites nearly equal strokes sooner, and leaves thousands of slivers of
//! others.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::overlay::FloatOverlay;

use super::Ring;

/// The shapes that `rule` leaves of two sets of rings, both filled by the non-zero rule.
pub(super) fn overlay(subject: &[Ring], clip: &[Ring], rule: OverlayRule) -> Vec<Vec<Ring>> {
    FloatOverlay::<_, i64>::from_subj_and_clip(subject, clip).overlay(rule, FillRule::NonZero)
}

/// Rings that do not cross, of one shape's rings, which may.
pub(super) fn simple(rings: &[Ring], rule: FillRule) -> Vec<Ring> {
    let shapes = FloatOverlay::<_, i64>::from_subj(rings).overlay(OverlayRule::Subject, rule);
    shapes.into_iter().flatten().collect()
}
