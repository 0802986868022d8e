//! From SVG to polygons: usvg resolves shapes, groups, transforms and units; kurbo flattens curves;
//! i_overlay unites what overlaps.

use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::{simplify::SimplifyShape, single::SingleFloatOverlay};
use kurbo::BezPath;
use usvg::roxmltree;
use usvg::tiny_skia_path::{Path, PathSegment, Transform};

use super::{MAX_SVG_BYTES, MapError};
use crate::geometry::{Polygon, Rect};

type Ring = Vec<[f64; 2]>;

/// Chords stay this close to the curves they replace.
const FLATNESS_MM: f64 = 0.05;

/// What a drawing says.
pub(super) struct Drawing {
    pub workspace: Rect,
    pub walls: Vec<Polygon>,
    pub free: Vec<Polygon>,
}

pub(super) fn read(text: &str) -> Result<Drawing, MapError> {
    if text.len() > MAX_SVG_BYTES {
        return Err(MapError::TooLarge { bytes: text.len() });
    }
    let xml = roxmltree::Document::parse(text).map_err(|e| MapError::Svg(e.to_string()))?;
    refuse_what_is_no_wall(&xml)?;
    let view_box = ViewBox::of(&xml)?;
    let tree = usvg::Tree::from_xmltree(&xml, &usvg::Options::default()).map_err(|e| MapError::Svg(e.to_string()))?;
    let to_mm = view_box.user_from_pixels(tree.size());

    let mut rings = Vec::new();
    collect(tree.root(), to_mm, &mut rings);
    let border = view_box.ring_m();
    let walls = vec![border.clone()].overlay_as::<i64>(&rings, OverlayRule::Intersect, FillRule::NonZero);
    let free = vec![border].overlay_as::<i64>(&rings, OverlayRule::Difference, FillRule::NonZero);
    if free.is_empty() {
        return Err(MapError::NoFreeSpace);
    }
    Ok(Drawing { workspace: view_box.rect_m(), walls: polygons(walls), free: polygons(free) })
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

/// Text, pictures and effects would vanish silently or lie about the walls.
fn refuse_what_is_no_wall(xml: &roxmltree::Document<'_>) -> Result<(), MapError> {
    for node in xml.descendants().filter(roxmltree::Node::is_element) {
        let reason = match node.tag_name().name() {
            "text" | "tspan" | "textPath" => "text is no wall; convert it to paths",
            "image" | "feImage" | "foreignObject" => "a picture is no wall; trace it to paths",
            "mask" | "clipPath" | "filter" => "masks, clips and filters are not applied; draw the shape itself",
            "animate" | "animateTransform" | "animateMotion" | "set" => "walls stand still",
            _ => continue,
        };
        return Err(MapError::Element {
            element: node.tag_name().name().to_owned(),
            id: node.attribute("id").map(|id| format!(" id={id:?}")).unwrap_or_default(),
            line: xml.text_pos_at(node.range().start).row,
            reason,
        });
    }
    Ok(())
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
        let refuse = |reason| MapError::ViewBox { value: value.to_owned(), reason };
        if value.is_empty() {
            return Err(refuse("it is missing; it gives the workspace in millimetres, as in \"-300 210 580 330\""));
        }
        let numbers: Vec<f64> = value
            .split([' ', ',', '\t', '\n', '\r'])
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().unwrap_or(f64::NAN))
            .collect();
        let &[x, y, width, height] = numbers.as_slice() else {
            return Err(refuse("it needs four numbers"));
        };
        if numbers.iter().any(|n| !n.is_finite()) {
            return Err(refuse("every number must be finite"));
        }
        if !(20.0..=4000.0).contains(&width) || !(20.0..=4000.0).contains(&height) {
            return Err(refuse("width and height must be 20 to 4000 mm"));
        }
        if x.abs() > 4000.0 || y.abs() > 4000.0 {
            return Err(refuse("x and y must be within ±4000 mm"));
        }
        if root.attribute("preserveAspectRatio").is_some_and(|v| v.trim() != "xMidYMid meet") {
            return Err(refuse("preserveAspectRatio must be left out, since it would distort millimetres"));
        }
        Ok(Self { x, y, width, height })
    }

    /// Undoes the fit (`xMidYMid meet`) of the viewBox into the drawing's nominal size.
    fn user_from_pixels(&self, size: usvg::Size) -> Transform {
        let (width_px, height_px) = (f64::from(size.width()), f64::from(size.height()));
        let scale = (width_px / self.width).min(height_px / self.height);
        let left_px = 0.5 * (width_px - scale * self.width);
        let top_px = 0.5 * (height_px - scale * self.height);
        Transform::from_row(
            (1.0 / scale) as f32,
            0.0,
            0.0,
            (1.0 / scale) as f32,
            (self.x - left_px / scale) as f32,
            (self.y - top_px / scale) as f32,
        )
    }

    fn rect_m(&self) -> Rect {
        Rect {
            x_min_m: self.x / 1000.0,
            x_max_m: (self.x + self.width) / 1000.0,
            y_min_m: -(self.y + self.height) / 1000.0,
            y_max_m: -self.y / 1000.0,
        }
    }

    fn ring_m(&self) -> Ring {
        let r = self.rect_m();
        vec![[r.x_min_m, r.y_min_m], [r.x_max_m, r.y_min_m], [r.x_max_m, r.y_max_m], [r.x_min_m, r.y_max_m]]
    }
}

/// Appends the outline of each filled or stroked path, consistently oriented, so that their union
/// is what the non-zero rule fills.
fn collect(group: &usvg::Group, to_mm: Transform, rings: &mut Vec<Ring>) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => collect(inner, to_mm, rings),
            usvg::Node::Path(path) if path.is_visible() => {
                let transform = to_mm.pre_concat(path.abs_transform());
                if let Some(fill) = path.fill() {
                    let rule = match fill.rule() {
                        usvg::FillRule::NonZero => FillRule::NonZero,
                        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
                    };
                    append(path.data(), transform, rule, rings);
                }
                if let Some(stroke) = path.stroke() {
                    // The outline is made in the path's own units; finer than the flatness asked.
                    if let Some(outline) = path.data().stroke(&stroke.to_tiny_skia(), 8.0) {
                        append(&outline, transform, FillRule::NonZero, rings);
                    }
                }
            }
            usvg::Node::Path(_) | usvg::Node::Image(_) | usvg::Node::Text(_) => {}
        }
    }
}

fn append(path: &Path, transform: Transform, rule: FillRule, rings: &mut Vec<Ring>) {
    let Some(path) = path.clone().transform(transform) else { return };
    let contours = flatten(&path);
    rings.extend(contours.simplify_shape_as::<i64>(rule).into_iter().flatten());
}

fn flatten(path: &Path) -> Vec<Ring> {
    let point = |p: usvg::tiny_skia_path::Point| kurbo::Point::new(f64::from(p.x), f64::from(p.y));
    let mut bezier = BezPath::new();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => bezier.move_to(point(p)),
            PathSegment::LineTo(p) => bezier.line_to(point(p)),
            PathSegment::QuadTo(a, p) => bezier.quad_to(point(a), point(p)),
            PathSegment::CubicTo(a, b, p) => bezier.curve_to(point(a), point(b), point(p)),
            PathSegment::Close => bezier.close_path(),
        }
    }
    let mut rings: Vec<Ring> = Vec::new();
    kurbo::flatten(bezier, FLATNESS_MM, |element| match element {
        kurbo::PathEl::MoveTo(p) => rings.push(vec![metres(p)]),
        kurbo::PathEl::LineTo(p) => rings.last_mut().expect("a path starts with MoveTo").push(metres(p)),
        _ => {}
    });
    rings.retain(|ring| ring.len() >= 3);
    rings
}

fn metres(p: kurbo::Point) -> [f64; 2] {
    [p.x / 1000.0, -p.y / 1000.0]
}

#[cfg(test)]
mod tests {
    use super::super::Map;

    fn wrap(body: &str) -> String {
        format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">{body}</svg>"#)
    }

    fn area_m2(map: &Map) -> f64 {
        let ring_area = |ring: &[[f64; 2]]| {
            (0..ring.len())
                .map(|i| {
                    let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                    0.5 * (a[0] * b[1] - b[0] * a[1])
                })
                .sum::<f64>()
        };
        map.walls().iter().flat_map(|p| p.rings()).map(ring_area).sum()
    }

    #[test]
    fn circles_strokes_groups_and_transforms_have_their_true_area() {
        let cases = [
            (r#"<circle cx="0" cy="300" r="30"/>"#, std::f64::consts::PI * 0.03 * 0.03),
            (r#"<path d="M-50 300H50" fill="none" stroke="red" stroke-width="10"/>"#, 0.1 * 0.01),
            (
                r#"<g transform="translate(0 300) rotate(45) scale(2)"><rect x="-10" y="-10" width="20" height="20"/></g>"#,
                0.04 * 0.04,
            ),
            (
                r#"<rect x="-20" y="290" width="20" height="20"/><rect x="-10" y="290" width="20" height="20"/>"#,
                0.03 * 0.02,
            ),
            (r#"<path fill-rule="evenodd" d="M-50 250H50V350H-50ZM-20 280H20V320H-20Z"/>"#, 0.1 * 0.1 - 0.04 * 0.04),
        ];
        for (body, expected) in cases {
            let area = area_m2(&Map::from_svg("case", &wrap(body)).unwrap());
            assert!((area / expected - 1.0).abs() < 5e-3, "{body}: {area} instead of {expected}");
        }
    }

    #[test]
    fn a_nominal_size_in_other_units_changes_nothing() {
        let body = r#"<rect x="-20" y="280" width="40" height="40"/>"#;
        let sized = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="20cm" height="30cm" viewBox="-100 200 200 200">{body}</svg>"#
        );
        let (plain, sized) = (Map::from_svg("a", &wrap(body)).unwrap(), Map::from_svg("b", &sized).unwrap());
        for (a, b) in plain.walls()[0].exterior.iter().zip(&sized.walls()[0].exterior) {
            assert!((a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn what_is_no_wall_is_refused_by_name() {
        for (body, part) in [
            (r#"<text id="label" x="0" y="300">hi</text>"#, "<text> id=\"label\" at line 1"),
            (r#"<image href="x.png"/>"#, "<image>"),
            (r#"<rect x="-100" y="200" width="200" height="200"/>"#, "no free space"),
        ] {
            let message = Map::from_svg("case", &wrap(body)).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
        for (text, part) in [
            ("<svg", "not a readable SVG"),
            (r#"<svg xmlns="http://www.w3.org/2000/svg"/>"#, "viewBox"),
            (r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 nan 5"/>"#, "finite"),
            (r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 5 5"/>"#, "20 to 4000"),
        ] {
            let message = Map::from_svg("case", text).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
    }
}
