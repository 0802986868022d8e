//! From SVG to polygons: usvg resolves shapes, groups, transforms and units; kurbo flattens curves; i_overlay unites
//! overlapping outlines.
//!
//! A drawing is untrusted input, so each step has a bound on its work that does not depend on a clock: `screen` before
//! usvg, `sketch` after it, `contacts` before each union.

mod attributes;
mod contacts;
mod fit;
#[cfg(test)]
mod fuzz_tests;
mod screen;
mod sketch;
#[cfg(test)]
mod tests;

use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use usvg::roxmltree;
use usvg::tiny_skia_path::Transform;

use super::{MAX_SVG_BYTES, MapError, Repair};
use crate::geometry::{Polygon, Rect};
pub use fit::fit;

type Ring = Vec<[f64; 2]>;

/// roxmltree compares each attribute of a tag with all others, and each namespace with all others.
const MAX_ATTRIBUTES: usize = 1000;
const MAX_NAMESPACES: usize = 100;

/// The content of a drawing.
pub(super) struct Drawing {
    pub workspace: Rect,
    pub walls: Vec<Polygon>,
    pub free: Vec<Polygon>,
    pub repairs: Vec<Repair>,
    /// Whether the map is for the planar stage instead of the arm.
    pub for_stage: bool,
}

pub(super) fn read(text: &str) -> Result<Drawing, MapError> {
    let xml = parse(text)?;
    let view_box = ViewBox::of(&xml)?;
    let for_stage = match xml.root_element().attribute("data-positioner") {
        None | Some("arm") => false,
        Some("planar-stage") => true,
        Some(value) => return Err(MapError::Positioner { value: attributes::short(value) }),
    };
    let screened = screen::screen(&xml, &view_box.attribute())?;
    let tree = usvg::Tree::from_str(&screened.text, &usvg::Options::default()).map_err(unreadable)?;
    let sketch = sketch::sketch(&tree, view_box.user_from_pixels(), view_box.diagonal_mm(), &screened)?;

    let border = vec![view_box.ring_m()];
    let walls = border.overlay_as::<i64>(&sketch.rings, OverlayRule::Intersect, FillRule::NonZero);
    let free = border.overlay_as::<i64>(&sketch.rings, OverlayRule::Difference, FillRule::NonZero);
    if free.is_empty() {
        return Err(MapError::NoFreeSpace);
    }
    Ok(Drawing {
        workspace: view_box.rect_m(),
        walls: polygons(walls),
        free: polygons(free),
        repairs: sketch.repairs,
        for_stage,
    })
}

/// Accepts a DOCTYPE, because drawing programs write one, but no entities, because they can multiply.
fn parse(text: &str) -> Result<roxmltree::Document<'_>, MapError> {
    if text.len() > MAX_SVG_BYTES {
        return Err(MapError::TooLarge { bytes: text.len() });
    }
    if !text.contains("svg") {
        return Err(MapError::NotSvg);
    }
    let refused = |reason: String| Err(MapError::Svg(reason));
    if text.contains("<!ENTITY") {
        return refused("it declares entities; replace them by their content".into());
    }
    if text.matches("xmlns:").count() > MAX_NAMESPACES {
        return refused(format!("it declares more than {MAX_NAMESPACES} namespaces"));
    }
    let mut line = 1;
    for tag in text.split('<') {
        if tag.matches('=').count() > MAX_ATTRIBUTES {
            return refused(format!("the tag at line {line} has more than {MAX_ATTRIBUTES} attributes"));
        }
        line += tag.matches('\n').count();
    }
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    roxmltree::Document::parse_with_options(text, options).map_err(unreadable)
}

fn unreadable(error: impl std::fmt::Display) -> MapError {
    MapError::Svg(attributes::short(&error.to_string()))
}

fn polygons(shapes: Vec<Vec<Ring>>) -> Vec<Polygon> {
    shapes
        .into_iter()
        .filter_map(|mut rings| {
            (!rings.is_empty()).then(|| {
                let exterior = rings.remove(0);
                Polygon { exterior, holes: rings }
            })
        })
        .collect()
}

/// The root's viewBox, in millimetres, y down.
struct ViewBox {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

impl ViewBox {
    fn of(xml: &roxmltree::Document<'_>) -> Result<Self, MapError> {
        let root = xml.root_element();
        let value = root.attribute("viewBox").unwrap_or_default();
        let refused = |reason| MapError::ViewBox { value: value.chars().take(80).collect(), reason };
        if value.is_empty() {
            return Err(refused(
                "it is missing; it defines the workspace in millimetres, for example \"-300 210 580 330\"",
            ));
        }
        let numbers: Vec<f64> = value
            .split([' ', ',', '\t', '\n', '\r'])
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().unwrap_or(f64::NAN))
            .collect();
        let &[x, y, width, height] = numbers.as_slice() else {
            return Err(refused("it needs four numbers"));
        };
        if numbers.iter().any(|n| !n.is_finite()) {
            return Err(refused("every number must be finite"));
        }
        if !(20.0..=4000.0).contains(&width) || !(20.0..=4000.0).contains(&height) {
            return Err(refused("width and height must be 20 to 4000 mm"));
        }
        if x.abs() > 4000.0 || y.abs() > 4000.0 {
            return Err(refused("x and y must be within ±4000 mm"));
        }
        if root.attribute("preserveAspectRatio").is_some_and(|v| v.trim() != "xMidYMid meet") {
            return Err(refused("preserveAspectRatio must be removed, because it would distort millimetres"));
        }
        Ok(Self { x, y, width, height })
    }

    fn attribute(&self) -> String {
        format!("viewBox=\"{} {} {} {}\"", self.x, self.y, self.width, self.height)
    }

    fn diagonal_mm(&self) -> f64 {
        self.width.hypot(self.height)
    }

    /// From usvg's units, which start at the viewBox's corner, to the drawing's.
    fn user_from_pixels(&self) -> Transform {
        Transform::from_translate(self.x as f32, self.y as f32)
    }

    fn rect_m(&self) -> Rect {
        Rect {
            x_min_m: self.x / 1000.0,
            x_max_m: (self.x + self.width) / 1000.0,
            y_min_m: 0.0 - (self.y + self.height) / 1000.0,
            y_max_m: 0.0 - self.y / 1000.0,
        }
    }

    fn ring_m(&self) -> Ring {
        let r = self.rect_m();
        vec![[r.x_min_m, r.y_min_m], [r.x_max_m, r.y_min_m], [r.x_max_m, r.y_max_m], [r.x_min_m, r.y_max_m]]
    }
}
