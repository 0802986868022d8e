//! Colours, and the map's own units: millimetres with y down.

use re_sdk_types::components::Color;

use ferry_core::geometry::Point2;

pub(super) const WALL: [u8; 3] = [190, 90, 80];
pub(super) const TOOL: [u8; 3] = [60, 130, 220];
pub(super) const BEAD: [u8; 3] = [250, 190, 60];
pub(super) const GOAL: [u8; 3] = [80, 200, 120];
pub(super) const ARM: [u8; 3] = [120, 160, 210];
pub(super) const TREE: [u8; 3] = [130, 130, 140];

pub(super) fn color([red, green, blue]: [u8; 3]) -> Color {
    Color::from_rgb(red, green, blue)
}

/// Metres on the table to the map's own units.
pub(super) fn plan_mm(place: Point2<f64>) -> [f32; 2] {
    [(place.x * 1e3) as f32, (-place.y * 1e3) as f32]
}
