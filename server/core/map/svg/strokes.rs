//! Outlines of strokes by tiny-skia, which is corrected where browsers draw otherwise.

use kurbo::{CubicBez, ParamCurve, ParamCurveExtrema};
use usvg::tiny_skia_path::{Path, PathBuilder, PathSegment, Point};

/// tiny-skia draws a shorter line as a point, at resolution 1.
const DOT: f32 = 1.0 / 4096.0;
/// A curve is a line if its points are as near to it, relative to its length.
const STRAIGHT: f64 = 1e-5;

/// How a stroke is drawn.
pub(super) struct Drawn {
    /// Filled by the non-zero rule.
    pub outlines: Vec<Path>,
    /// How tiny-skia draws it otherwise.
    pub newer: Option<&'static str>,
}

/// The outline of a stroke with chords that suit `resolution`, in the path's own units.
pub(super) fn outline(path: &Path, stroke: &usvg::Stroke, resolution: f32) -> Drawn {
    let mut line = Line { left: PathBuilder::new(), at: Point::zero(), turns: Vec::new(), has_dots: false };
    let has_caps = stroke.linecap() != usvg::LineCap::Butt;
    let segments: Vec<PathSegment> = path.segments().collect();
    for part in segments.chunk_by(|_, next| !matches!(next, PathSegment::MoveTo(_))) {
        line.add(part, if has_caps { DOT / resolution } else { -1.0 });
    }
    let newer = match (line.has_dots, line.turns.is_empty()) {
        (true, _) => Some("a point that is given twice at the beginning of a stroke was drawn with caps"),
        (_, false) => Some("a straight curve that turns back was drawn too short"),
        _ => None,
    };
    let corrected = line.left.finish().filter(|_| newer.is_some());
    let outline = corrected.as_ref().unwrap_or(path).stroke(&stroke.to_tiny_skia(), resolution);
    let circle = |turn: &Point| PathBuilder::from_circle(turn.x, turn.y, 0.5 * stroke.width().get());
    Drawn { outlines: outline.into_iter().chain(line.turns.iter().filter_map(circle)).collect(), newer }
}

/// A line without what tiny-skia draws otherwise.
struct Line {
    left: PathBuilder,
    at: Point,
    /// Where straight curves turn back. Browsers draw a round join there.
    turns: Vec<Point>,
    has_dots: bool,
}

impl Line {
    /// Adds a part. Lines of length 0 at its beginning are left out, unless it has nothing else: tiny-skia takes one for a
    /// direction and gives it caps.
    fn add(&mut self, part: &[PathSegment], dot: f32) {
        let PathSegment::MoveTo(start) = part[0] else { unreachable!("a part starts with MoveTo") };
        let is_dot = |p: Point| (p.x - start.x).abs().max((p.y - start.y).abs()) <= dot;
        let is_at_start = |segment: &PathSegment| match *segment {
            PathSegment::MoveTo(_) | PathSegment::Close => true,
            PathSegment::LineTo(p) => is_dot(p),
            PathSegment::QuadTo(a, p) => is_dot(a) && is_dot(p),
            PathSegment::CubicTo(a, b, p) => is_dot(a) && is_dot(b) && is_dot(p),
        };
        let first_dots = part[1..].iter().take_while(|one| matches!(one, PathSegment::LineTo(p) if is_dot(*p))).count();
        let dots = if part.iter().all(is_at_start) { 0 } else { first_dots };
        self.has_dots |= dots > 0;
        for segment in part[..1].iter().chain(&part[1 + dots..]) {
            match *segment {
                PathSegment::MoveTo(p) => self.left.move_to(p.x, p.y),
                PathSegment::LineTo(p) => self.left.line_to(p.x, p.y),
                PathSegment::QuadTo(a, p) => self.left.quad_to(a.x, a.y, p.x, p.y),
                PathSegment::CubicTo(a, b, p) => {
                    let turns = turns([self.at, a, b, p]);
                    match turns.is_empty() {
                        true => self.left.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
                        false => turns.iter().chain([&p]).for_each(|p| self.left.line_to(p.x, p.y)),
                    }
                    self.turns.extend(turns);
                }
                PathSegment::Close => self.left.close(),
            }
            self.at = self.left.last_point().unwrap_or(start);
        }
    }
}

/// Where a cubic curve turns back, if it lies on a line.
fn turns(points: [Point; 4]) -> Vec<Point> {
    let [start, a, b, end] = points.map(|p| kurbo::Point::new(f64::from(p.x), f64::from(p.y)));
    let curve = CubicBez::new(start, a, b, end);
    let far =
        [a, b, end].map(|p| p - start).into_iter().max_by(|p, q| p.hypot2().total_cmp(&q.hypot2())).unwrap_or_default();
    let length = far.hypot();
    if length == 0.0 || [a, b, end].iter().any(|&p| far.cross(p - start).abs() > STRAIGHT * length * length) {
        return Vec::new();
    }
    // Its places on the line.
    let on_line = |p: kurbo::Point| kurbo::Point::new(far.dot(p - start) / length, 0.0);
    let places = CubicBez::new(on_line(start), on_line(a), on_line(b), on_line(end));
    let point = |t: f64| {
        let p = curve.eval(t);
        Point::from_xy(p.x as f32, p.y as f32)
    };
    places.extrema().into_iter().map(point).filter(|p| *p != points[0] && *p != points[3]).collect()
}
