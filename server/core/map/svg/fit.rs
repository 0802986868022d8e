//! Moves and shrinks a drawing into the arm's reach.

use super::{MapError, ViewBox, parse};

/// The workspace of the shipped maps, in millimetres, y down.
const ROOM: ViewBox = ViewBox { x: -300.0, y: 210.0, width: 580.0, height: 330.0 };

/// The drawing in the middle of the shipped maps' workspace, and no larger than it.
///
/// # Errors
/// It is not a readable SVG, or its viewBox is not valid.
pub fn fit(text: &str) -> Result<String, MapError> {
    let xml = parse(text)?;
    let from = ViewBox::of(&xml)?;
    let scale = (ROOM.width / from.width).min(ROOM.height / from.height).min(1.0);
    let (width, height) = (from.width * scale, from.height * scale);
    let to =
        ViewBox { x: ROOM.x + (ROOM.width - width) / 2.0, y: ROOM.y + (ROOM.height - height) / 2.0, width, height };

    let root = xml.root_element();
    let (Some(first), Some(last), Some(view_box)) = (
        root.first_child(),
        root.last_child(),
        root.attributes().find(|one| one.name() == "viewBox" && one.namespace().is_none()),
    ) else {
        // Without content there is nothing to move; without a viewBox the drawing was refused above.
        return Ok(text.to_owned());
    };
    let (attribute, content) = (view_box.range_value(), first.range().start..last.range().end);
    if text.contains(":root") {
        let reason = "a style sheet refers to :root, so that the drawing cannot be moved; use svg instead";
        return Err(MapError::Svg(reason.to_owned()));
    }
    Ok(format!(
        "{}{} {} {} {}{}<svg x=\"{}\" y=\"{}\" width=\"{width}\" height=\"{height}\" {}>{}</svg>{}",
        &text[..attribute.start],
        to.x,
        to.y,
        to.width,
        to.height,
        &text[attribute.end..content.start],
        to.x,
        to.y,
        from.attribute(),
        &text[content.clone()],
        &text[content.end..],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::map::Map;

    fn fitted(view_box: &str, body: &str) -> Map {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='{view_box}' id='a'>{body}</svg>");
        Map::from_svg("fitted", &fit(&svg).unwrap()).unwrap()
    }

    fn corners(map: &Map) -> [f64; 4] {
        let w = map.workspace();
        [w.x_min_m, w.x_max_m, w.y_min_m, w.y_max_m].map(|side| (side * 1e6).round() / 1e6)
    }

    #[test]
    fn a_small_drawing_is_only_moved() {
        let map = fitted("0 0 300 200", "\n <rect x='100' y='80' width='100' height='10'/>\n <!-- end -->\n");
        assert_eq!(corners(&map), [-0.16, 0.14, -0.475, -0.275]);
        let wall = Point2::new(-0.16 + 0.15, -0.275 - 0.085);
        assert!(map.clearance_m(wall) < 1e-9 && map.clearance_m(wall + nalgebra::Vector2::new(0.0, 0.02)) > 0.01);
    }

    #[test]
    fn a_large_drawing_is_shrunk_to_the_room() {
        let map = fitted("900 900 1160 1320", "<rect x='900' y='900' width='1160' height='400'/>");
        assert_eq!(corners(&map), [-0.155, 0.135, -0.54, -0.21]);
        assert!(map.clearance_m(Point2::new(0.0, -0.3)) < 1e-9, "the upper part is wall");
        assert!(map.clearance_m(Point2::new(0.0, -0.32)) > 0.005);
    }

    #[test]
    fn a_drawing_without_content_or_with_errors() {
        let empty = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 50 50'/>";
        assert_eq!(fit(empty).unwrap(), empty);
        assert!(matches!(fit("<svg"), Err(MapError::Svg(_))));
        assert!(matches!(fit("<svg viewBox='0 0 1'><g/></svg>"), Err(MapError::ViewBox { .. })));
    }
}
