//! Small drawings made of any bytes, and whether Ferry's walls lie where usvg draws.

use ferry_core::map::Map;
use usvg::tiny_skia_path::{PathSegment, Point};

const NUMBERS: [&str; 12] = ["0", "5", "10", "-10", "33.3", "100", "-200", "7e1", "250", "1.5", "-.5", "400"];
/// Shapes; those with an id have an area whatever their numbers, or none.
const SHAPES: [&str; 8] = [
    "<path d='M? ?L? ?A? ? ? 1 0 ? ?C? ? ? ? ? ?Z'",
    "<path d='m? ?h?v?q? ? ? ?t? ?s? ? ? ?'",
    "<rect id='s' x='?' y='?' width='?' height='?' rx='?'",
    "<circle id='s' cx='?' cy='?' r='?'",
    "<ellipse id='s' cx='?' cy='?' rx='?' ry='?'",
    "<line x1='?' y1='?' x2='?' y2='?'",
    "<polygon points='? ? ? ? ? ? ? ?'",
    "<use href='#u' x='?' y='?'",
];
const PAINTS: [&str; 10] = [
    "",
    " stroke='red'",
    " fill='none' stroke='red' stroke-width='33.3'",
    " class='a'",
    " style='fill: none; stroke: blue; stroke-width: 12px'",
    " fill-rule='evenodd' stroke='#123' stroke-linecap='square'",
    " stroke='red' stroke-linejoin='bevel' stroke-width='20'",
    " display='none'",
    " visibility='hidden'",
    " stroke='currentColor' stroke-dasharray='none'",
];
const TRANSFORMS: [&str; 7] = [
    "",
    " transform='translate(? ?)'",
    " transform='rotate(?)'",
    " transform='rotate(? ? ?)'",
    " transform='scale(1.5 -.5)'",
    " transform='skewX(20) scale(.5)'",
    " transform='matrix(.5 .2 -.3 .8 ? ?)'",
];
const GROUPS: [&str; 5] =
    ["<g", "<g fill='none'", "<a", "<g style='stroke: red; stroke-width: 4px'", "<g class='b' stroke-linejoin='round'"];
const SHEETS: [&str; 4] = [
    "",
    "<style>.a { stroke: red; stroke-width: 8px } .b { fill: none }</style>",
    "<style>g > .a { fill: none } rect { stroke: red }</style>",
    "<style>* { stroke-linecap: round } #s { stroke: black !important }</style>",
];
/// Ferry's chords, and usvg's numbers with seven digits.
const TOLERANCE_MM: f64 = 0.5;
const BORDER_MM: f64 = 2000.0;

struct Bytes<'a>(std::slice::Iter<'a, u8>);

impl Bytes<'_> {
    fn pick<'t>(&mut self, of: &[&'t str]) -> &'t str {
        of[self.0.next().map_or(0, |&byte| usize::from(byte)) % of.len()]
    }

    fn filled(&mut self, template: &str) -> String {
        template
            .split_inclusive('?')
            .map(|piece| match piece.strip_suffix('?') {
                Some(piece) => piece.to_owned() + self.pick(&NUMBERS),
                None => piece.to_owned(),
            })
            .collect()
    }
}

pub fn text(bytes: &[u8]) -> String {
    let mut from = Bytes(bytes.iter());
    let sheet = from.pick(&SHEETS);
    let side = 2.0 * BORDER_MM;
    let mut text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='{} {} {side} {side}'>{sheet}\
         <defs><g id='u'><rect id='s' width='40' height='25'/></g></defs>",
        -BORDER_MM, -BORDER_MM
    );
    let mut open = Vec::new();
    for _ in 0..6 {
        if from.0.len() == 0 {
            break;
        }
        match from.pick(&["shape", "shape", "group", "end"]) {
            "group" if open.len() < 3 => {
                let group = from.pick(&GROUPS);
                let transform = from.pick(&TRANSFORMS);
                text += &(group.to_owned() + &from.filled(transform) + ">");
                open.push(if group == "<a" { "</a>" } else { "</g>" });
            }
            "end" => text += open.pop().unwrap_or_default(),
            _ => {
                let parts = [from.pick(&SHAPES), from.pick(&PAINTS), from.pick(&TRANSFORMS)].concat();
                text += &(from.filled(&parts) + "/>");
            }
        }
    }
    while let Some(end) = open.pop() {
        text += end;
    }
    text + "</svg>"
}

/// Left, top, right, bottom.
type Bounds = [f64; 4];
const EVERYTHING: Bounds = [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];
const NOTHING: Bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

/// tiny-skia, and browsers, draw a stroke with a tiny hook otherwise when it is drawn larger.
const RESOLUTIONS: [f32; 4] = [2.0, 8.0, 32.0, 128.0];

fn join(one: &mut Bounds, [left, top, right, bottom]: Bounds) {
    *one = [one[0].min(left), one[1].min(top), one[2].max(right), one[3].max(bottom)];
}

/// The box of a path as it is drawn at a resolution; usvg's boxes of turned ones are near it.
fn tight(path: &usvg::Path, resolution: f32) -> Bounds {
    let mut all = NOTHING;
    let stroked = path.stroke().and_then(|stroke| path.data().stroke(&stroke.to_tiny_skia(), resolution));
    for data in [path.fill().map(|_| path.data().clone()), stroked].into_iter().flatten() {
        let bounds = data.transform(path.abs_transform()).and_then(|data| data.compute_tight_bounds());
        if let Some(bounds) = bounds.filter(|bounds| bounds.width() * bounds.height() > 0.0) {
            let sides = [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()];
            join(&mut all, sides.map(|side| f64::from(side) - BORDER_MM));
        }
    }
    all
}

/// Whether a line has no length, or a cubic curve is straight: tiny-skia draws some of these otherwise than browsers.
fn is_odd(path: &usvg::Path) -> bool {
    let mut at = Point::zero();
    path.data().segments().any(|segment| {
        let from = at;
        let beside = |p: Point, end: Point| (p.x - from.x) * (end.y - from.y) - (p.y - from.y) * (end.x - from.x);
        at = match segment {
            PathSegment::MoveTo(p) | PathSegment::LineTo(p) => p,
            PathSegment::QuadTo(_, p) | PathSegment::CubicTo(_, _, p) => p,
            PathSegment::Close => from,
        };
        match segment {
            PathSegment::LineTo(p) => p == from,
            PathSegment::CubicTo(a, b, p) => {
                let size =
                    [a, b, p].map(|q| (q.x - from.x).abs().max((q.y - from.y).abs())).into_iter().fold(0.0, f32::max);
                [(a, b), (a, p), (b, p)].iter().all(|&(p, q)| beside(p, q).abs() <= 1e-4 * size * size)
            }
            _ => false,
        }
    })
}

/// What usvg draws at most, and at least: a path without area draws nothing, and what the border cuts has another box.
fn drawn(group: &usvg::Group, most: &mut Bounds, least: &mut Bounds) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => drawn(inner, most, least),
            usvg::Node::Path(path) if path.is_visible() => {
                if path.stroke().is_some() && is_odd(path) {
                    join(most, EVERYTHING);
                    continue;
                }
                let all = RESOLUTIONS.map(|resolution| tight(path, resolution));
                let common = all
                    .into_iter()
                    .fold(EVERYTHING, |a, b| [a[0].max(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].min(b[3])]);
                all.iter().for_each(|bounds| join(most, bounds.map(|side| side.clamp(-BORDER_MM, BORDER_MM))));
                let is_whole = all.as_flattened().iter().all(|side| side.abs() <= BORDER_MM);
                if is_whole && (path.id() == "s" && path.fill().is_some() || path.stroke().is_some()) {
                    join(least, common);
                }
            }
            _ => {}
        }
    }
}

/// Whether the drawing is a map; its walls are where they should be.
pub fn agrees(bytes: &[u8]) -> bool {
    let text = text(bytes);
    let Ok(map) = Map::from_svg("fuzz", &text) else { return false };
    let tree = usvg::Tree::from_str(&text, &usvg::Options::default()).expect("Ferry has read it");
    let (mut most, mut least, mut found) = (NOTHING, NOTHING, NOTHING);
    drawn(tree.root(), &mut most, &mut least);
    for &[x_m, y_m] in map.walls().iter().flat_map(|wall| &wall.exterior) {
        let [x_mm, y_mm] = [1000.0 * x_m, -1000.0 * y_m];
        join(&mut found, [x_mm, y_mm, x_mm, y_mm]);
    }
    let within = |inner: &Bounds, outer: &Bounds| {
        inner[0] >= outer[0] - TOLERANCE_MM
            && inner[1] >= outer[1] - TOLERANCE_MM
            && inner[2] <= outer[2] + TOLERANCE_MM
            && inner[3] <= outer[3] + TOLERANCE_MM
    };
    assert!(within(&found, &most), "{text}\nwalls {found:?}, drawn at most {most:?}");
    assert!(within(&least, &found), "{text}\nwalls {found:?}, drawn at least {least:?}");
    true
}
