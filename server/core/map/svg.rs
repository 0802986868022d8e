//! From SVG to polygons: `plain` computes styles as a browser does and refuses what it does not understand; usvg makes paths
//! of shapes and transforms; kurbo flattens curves; `union` unites overlapping outlines.
//!
//! A drawing is untrusted input, so each step has a bound on its work that does not depend on a clock: `plain` before usvg,
//! `sketch` after it, `contacts` before each union.

mod contacts;
mod css;
mod encoding;
mod fit;
#[cfg(test)]
mod fuzz_tests;
mod hairs;
mod plain;
mod sketch;
mod strokes;
mod style;
#[cfg(test)]
mod tests;
mod union;

use std::collections::HashSet;

use i_overlay::core::overlay_rule::OverlayRule;
use usvg::roxmltree;
use usvg::tiny_skia_path::Transform;

use super::{MAX_SVG_BYTES, MapError, Newer, Repair, RepairKind};
use crate::geometry::{Polygon, Rect};
pub use encoding::{check_format, decoded};
pub use fit::fit;

type Ring = Vec<[f64; 2]>;

/// roxmltree compares each attribute of a tag with all others, and each namespace with all others.
const MAX_ATTRIBUTES: usize = 1000;
const MAX_NAMESPACES: usize = 100;
/// Each costs the camera time that grows with their number; so many cost half a second.
const MAX_ENCLOSED: usize = 10_000;
/// Each is sought in the whole text.
const MAX_ENTITIES: usize = 100;

/// The content of a drawing.
pub(super) struct Drawing {
    pub workspace: Rect,
    pub walls: Vec<Polygon>,
    pub free: Vec<Polygon>,
    pub repairs: Vec<Repair>,
    /// What older readers read otherwise: the first element of each version.
    pub newer: Vec<Newer>,
    /// Whether the map is for the planar stage instead of the arm.
    pub for_stage: bool,
}

pub(super) fn read(text: &str) -> Result<Drawing, MapError> {
    let xml = parse(text)?;
    let root = xml.root_element();
    if root.tag_name().name() != "svg" {
        return Err(MapError::Svg(format!("its root is <{}>, it must be <svg>", short(root.tag_name().name()))));
    }
    let view_box = ViewBox::of(&xml)?;
    let for_stage = match own(root, "data-positioner") {
        None | Some("arm") => false,
        Some("planar-stage") => true,
        Some(value) => return Err(MapError::Positioner { value: short(value) }),
    };
    let plain = plain::plain(&xml, &view_box.attribute())?;
    let tree = usvg::Tree::from_str(&plain.text, &usvg::Options::default()).map_err(unreadable)?;
    let mut sketch = sketch::sketch(&tree, &view_box, &plain)?;
    if let Some(kind) = view_box.disagreement(root) {
        sketch.repairs.insert(0, Repair { place: plain.root.clone(), kind });
    }
    sketch.repairs.sort_by_key(|repair| repair.place.line);

    let border = vec![view_box.ring_m()];
    let walls = union::overlay(&border, &sketch.rings, OverlayRule::Intersect);
    let free = union::overlay(&border, &sketch.rings, OverlayRule::Difference);
    if free.is_empty() {
        return Err(MapError::NoFreeSpace { cause: sketch.covers(&view_box) });
    }
    let walls = polygons(walls);
    if let Some(wall) = walls.iter().find(|wall| wall.holes.len() > MAX_ENCLOSED) {
        let count = wall.holes.len();
        let reason = format!("a wall encloses {count} separate places, the limit is {MAX_ENCLOSED}; draw fewer lines");
        return Err(MapError::Element { place: plain.root, reason });
    }
    Ok(Drawing {
        workspace: view_box.rect_m(),
        walls,
        free: polygons(free),
        repairs: sketch.repairs,
        newer: plain.newer.iter().cloned().chain(sketch.newer).collect(),
        for_stage,
    })
}

/// Accepts a DOCTYPE, because drawing programs write one, and entities that cannot multiply.
fn parse(text: &str) -> Result<roxmltree::Document<'_>, MapError> {
    if text.len() > MAX_SVG_BYTES {
        return Err(MapError::TooLarge { bytes: text.len() });
    }
    if !text.contains("svg") {
        return Err(MapError::NotSvg);
    }
    let refused = |reason: String| Err(MapError::Svg(reason));
    if !entities_are_short(text) {
        return refused("it declares entities that contain others or are long; save it as plain SVG".into());
    }
    if namespaces(text) > MAX_NAMESPACES {
        return refused(format!("it declares more than {MAX_NAMESPACES} namespaces"));
    }
    if let Some(at) = tag_with_many_attributes(text) {
        let line = 1 + text[..at].matches('\n').count();
        return refused(format!("the tag at line {line} has more than {MAX_ATTRIBUTES} attributes"));
    }
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    roxmltree::Document::parse_with_options(text, options).map_err(unreadable)
}

/// An attribute without a prefix.
fn own<'a>(node: roxmltree::Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.attributes().find(|one| one.name() == name && one.namespace().is_none()).map(|one| one.value())
}

/// Whether the entities of a drawing are few, with short texts without markup, as those of Illustrator.
fn entities_are_short(text: &str) -> bool {
    let mut expanded = 0_usize;
    text.matches("<!ENTITY").count() <= MAX_ENTITIES
        && text.split("<!ENTITY").skip(1).all(|declaration| {
            let name = declaration.split_ascii_whitespace().next().unwrap_or_default();
            let quoted = declaration.find(['"', '\'']).and_then(|at| {
                let rest = &declaration[at..];
                rest[1..].split(&rest[..1]).next()
            });
            let value = quoted.unwrap_or(declaration);
            expanded += value.len() * text.matches(&format!("&{name};")).count();
            !value.contains(['&', '%', '<']) && !name.starts_with('%') && expanded <= MAX_SVG_BYTES
        })
}

/// The number of different declarations of namespaces.
fn namespaces(text: &str) -> usize {
    let declarations = text.split("xmlns:").skip(1).filter_map(|rest| {
        let quote = rest.find(['"', '\''])?;
        let end = quote + 1 + rest[quote + 1..].find(&rest[quote..=quote])?;
        Some(&rest[..end])
    });
    declarations.collect::<HashSet<&str>>().len()
}

/// The first tag that has too many attributes.
fn tag_with_many_attributes(text: &str) -> Option<usize> {
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|found| at + found) {
        let ends = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        if let Some((_, end)) = ends.into_iter().find(|(begin, _)| text[start..].starts_with(begin)) {
            at = start + text[start..].find(end)? + end.len();
            continue;
        }
        let (mut quote, mut attributes) = (None, 0);
        at = text.len();
        for (offset, byte) in text.as_bytes()[start..].iter().enumerate() {
            match (quote, byte) {
                (None, b'>') => {
                    at = start + offset + 1;
                    break;
                }
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => attributes += 1,
                (Some(open), _) if open == byte => quote = None,
                _ => {}
            }
        }
        if attributes > MAX_ATTRIBUTES {
            return Some(start);
        }
    }
    None
}

fn unreadable(error: impl std::fmt::Display) -> MapError {
    MapError::Svg(short(&error.to_string()))
}

/// A value shortened for an error message.
fn short(value: &str) -> String {
    const SHOWN: usize = 80;
    let mut short: String = value.chars().take(SHOWN).collect();
    if short.len() < value.len() {
        short.push('…');
    }
    short
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
        let value = own(root, "viewBox").unwrap_or_default();
        let refused = |reason: &str| MapError::ViewBox { value: short(value), reason: reason.to_owned() };
        if value.is_empty() {
            let size = |name| own(root, name).and_then(|value| style::size(value, style::Origin::Attribute).ok());
            let sizes = size("width")
                .zip(size("height"))
                .filter(|(width, height)| !width.ends_with('%') && !height.ends_with('%'));
            let proposed =
                sizes.map_or("-300 210 580 330".to_owned(), |(width, height)| format!("0 0 {width} {height}"));
            let spelled = if own(root, "viewbox").is_some() { ", with a capital B" } else { "" };
            let reason = format!(
                "it is missing; it defines the workspace in millimetres, for example viewBox=\"{proposed}\"{spelled}"
            );
            return Err(refused(&reason));
        }
        let numbers: Vec<f64> = value
            .split([' ', ',', '\t', '\n', '\r'])
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().ok().filter(|_| !style::has_bare_dot(part)).unwrap_or(f64::NAN))
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
        let is_harmless = |value: &str| {
            let ratio = value.trim().parse::<svgtypes::AspectRatio>();
            ratio.is_ok_and(|ratio| ratio.align != svgtypes::Align::None && !ratio.slice)
        };
        if !own(root, "preserveAspectRatio").is_none_or(is_harmless) {
            return Err(refused("preserveAspectRatio must be removed, because it may distort or cut the drawing"));
        }
        Ok(Self { x, y, width, height })
    }

    /// A size of the page in absolute units that is not that of the viewBox: the drawing may be in other units.
    fn disagreement(&self, root: roxmltree::Node<'_, '_>) -> Option<RepairKind> {
        let page_mm = |name| {
            let value = own(root, name).filter(|value| style::is_absolute(value))?;
            style::size(value, style::Origin::Attribute).ok()?.parse::<f64>().ok()
        };
        let is_other = |(name, own_mm): (&'static str, f64)| {
            let page_mm = page_mm(name).filter(|page_mm| (page_mm / own_mm - 1.0).abs() > 0.01)?;
            Some(RepairKind::Page { name, page_mm: page_mm.round() as u32, own_mm: own_mm.round() as u32 })
        };
        [("width", self.width), ("height", self.height)].into_iter().find_map(is_other)
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
