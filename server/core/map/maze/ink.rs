//! Channels and walls of a maze, and their drawing. In millimetres, y down, as in the SVG.

use std::fmt::Write;

use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use kurbo::{BezPath, Cap, Join, PathEl, Point, Stroke, StrokeOpts};

/// The workspace of the shipped maps: x, y, width, height.
pub const PAGE_MM: [f64; 4] = [-300.0, 210.0, 580.0, 330.0];
const FLATNESS_MM: f64 = 0.2;

type Ring = Vec<[f64; 2]>;

/// What a maze consists of.
#[derive(Default)]
pub struct Ink {
    /// Cut out of the solid page. Without any, the page is floor.
    channels: Vec<Ring>,
    /// Walls that are drawn last.
    walls: Vec<Ring>,
}

impl Ink {
    /// Cuts a channel along a line, with round ends.
    pub fn channel(&mut self, line: &[Point], width_mm: f64) {
        self.channels.extend(outline(line, width_mm, Cap::Round));
    }

    /// Draws a wall along a line.
    pub fn wall(&mut self, line: &[Point], width_mm: f64, cap: Cap) {
        self.walls.extend(outline(line, width_mm, cap));
    }

    pub fn solid(&mut self, ring: Ring) {
        self.walls.push(ring);
    }

    /// The drawing: one path of all walls.
    pub fn to_svg(&self, title: &str) -> String {
        let [x, y, width, height] = PAGE_MM;
        let page = vec![vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]];
        let left: Vec<Ring> = match self.channels.is_empty() {
            true => Vec::new(),
            false => {
                let left = page.overlay_as::<i64>(&self.channels, OverlayRule::Difference, FillRule::NonZero);
                left.into_iter().flatten().collect()
            }
        };
        let walls = left.overlay_as::<i64>(&self.walls, OverlayRule::Union, FillRule::NonZero);
        let walls: Vec<Ring> = walls.into_iter().flatten().collect();
        let walls = page.overlay_as::<i64>(&walls, OverlayRule::Intersect, FillRule::NonZero);
        let mut path = String::new();
        for ring in walls.iter().flatten() {
            for (index, [x, y]) in ring.iter().enumerate() {
                let letter = if index == 0 { 'M' } else { 'L' };
                write!(path, "{letter}{x:.2} {y:.2}").expect("writing to a string does not fail");
            }
            path.push('Z');
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {width} {height}\">\n  <title>{title}</title>\n  \
             <path fill-rule=\"evenodd\" d=\"{path}\"/>\n</svg>\n"
        )
    }
}

fn outline(line: &[Point], width_mm: f64, cap: Cap) -> Vec<Ring> {
    let elements = line.iter().enumerate().map(|(index, &point)| match index {
        0 => PathEl::MoveTo(point),
        _ => PathEl::LineTo(point),
    });
    let style = Stroke::new(width_mm).with_caps(cap).with_join(Join::Round);
    let path = kurbo::stroke(elements, &style, &StrokeOpts::default(), FLATNESS_MM);
    rings(&path)
}

fn rings(path: &BezPath) -> Vec<Ring> {
    let mut rings = Vec::new();
    kurbo::flatten(path, FLATNESS_MM, |element| match element {
        PathEl::MoveTo(point) => rings.push(vec![[point.x, point.y]]),
        PathEl::LineTo(point) => rings.last_mut().into_iter().for_each(|ring: &mut Ring| ring.push([point.x, point.y])),
        _ => {}
    });
    rings
}
