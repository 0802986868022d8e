//! The outlines of the elements that usvg has resolved, in metres, in order.

use std::cell::Cell;
use std::collections::HashSet;

use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use kurbo::{BezPath, PathEl};
use usvg::tiny_skia_path::{Path, PathSegment, PathStroker, Point, Transform};

use super::super::{MapError, Newer, Place, Repair, RepairKind};
use super::Ring;
use super::ViewBox;
use super::contacts::Budget;
use super::hairs::without_hairs;
use super::plain::Plain;
use super::strokes;
use super::union::{overlay, simple};
use crate::geometry::Rect;

/// Largest distance between a curve and the chords that replace it.
const FLATNESS_MM: f64 = 0.05;

/// Vertices of all outlines, with curves as chords. This is one per 18 mm square of the largest workspace, where a bead
/// needs 24 mm to pass. Loading such a drawing takes a fifth of a second.
pub(super) const MAX_VERTICES: usize = 50_000;

/// Total length of all outlines, in diagonals of the viewBox; each edge counts as at most one. Corridors that a bead
/// can pass have at most a third of it. Tens of thousands of edges nearly as long as the drawing would cost the union a
/// gigabyte, and each query for the nearest wall would visit most of them.
const MAX_DIAGONALS: f64 = 1000.0;

/// Thinner strokes are told of.
const HAIRLINE_MM: f32 = 0.1;
/// A clip may cut off as much, because of rounding: 0.1 mm².
const CUT_MOST_M2: f64 = 1e-7;

/// Larger coordinates would reduce the precision of the others.
const MAX_EXTENT_MM: f64 = 1e5;

/// The outlines of a drawing.
pub(super) struct Sketch<'a> {
    /// Outlines in order. Walls are their union by the non-zero rule.
    pub rings: Vec<Ring>,
    /// The element of each ring.
    places: Vec<&'a Place>,
    pub repairs: Vec<Repair>,
    pub newer: Vec<Newer>,
}

impl Sketch<'_> {
    /// The first element that covers the whole workspace.
    pub fn covers(&self, view_box: &ViewBox) -> Option<Place> {
        let border = [view_box.ring_m()];
        let leaves_nothing = |ring| overlay(&border, std::slice::from_ref(ring), OverlayRule::Difference).is_empty();
        let ring = self.rings.iter().position(leaves_nothing)?;
        Some(self.places[ring].clone())
    }
}

pub(super) fn sketch<'a>(tree: &'a usvg::Tree, view_box: &ViewBox, plain: &'a Plain) -> Result<Sketch<'a>, MapError> {
    let mut pen = Pen {
        plain,
        to_mm: view_box.user_from_pixels(),
        workspace: view_box.rect_m(),
        border_m: view_box.ring_m(),
        budget: Budget::new(),
        vertices: 0,
        diagonal_mm: view_box.diagonal_mm(),
        diagonals: 0.0,
        rings: Vec::new(),
        places: Vec::new(),
        drawn: HashSet::new(),
        repairs: plain.notes.clone(),
        reported: HashSet::new(),
        newer: Vec::new(),
    };
    pen.group(tree.root(), "")?;
    for id in &plain.shown {
        if !pen.drawn.contains(id.as_str()) {
            pen.repair(&plain.places[id], RepairKind::Nothing);
        }
    }
    // Outlines of different elements meet in the union of all.
    pen.budget.spend(&pen.rings).map_err(|ring| tangled(pen.places[ring]))?;
    Ok(Sketch { rings: pen.rings, places: pen.places, repairs: pen.repairs, newer: pen.newer })
}

struct Pen<'a> {
    plain: &'a Plain,
    to_mm: Transform,
    workspace: Rect,
    border_m: Ring,
    budget: Budget,
    vertices: usize,
    diagonal_mm: f64,
    /// Total length of the outlines so far, measured as for [`MAX_DIAGONALS`].
    diagonals: f64,
    rings: Vec<Ring>,
    /// The element of each ring.
    places: Vec<&'a Place>,
    /// Ids of the shapes that usvg has drawn or found to be unpainted.
    drawn: HashSet<&'a str>,
    repairs: Vec<Repair>,
    /// Repairs that were already reported: copies by `<use>` are reported once.
    reported: HashSet<Repair>,
    /// One per version.
    newer: Vec<Newer>,
}

impl<'a> Pen<'a> {
    /// `id` is that of the nearest element with an id: copies by `<use>` have lost theirs.
    fn group(&mut self, group: &'a usvg::Group, id: &'a str) -> Result<(), MapError> {
        let id = if group.id().is_empty() { id } else { group.id() };
        let before = self.rings.len();
        for node in group.children() {
            match node {
                usvg::Node::Group(inner) => self.group(inner, id)?,
                usvg::Node::Path(path) => {
                    let id = if path.id().is_empty() { id } else { path.id() };
                    self.drawn.insert(id);
                    if path.is_visible() {
                        self.path(path, self.place(id))?;
                    }
                }
                usvg::Node::Image(_) | usvg::Node::Text(_) => {}
            }
        }
        let mut clip = group.clip_path();
        while let Some(one) = clip {
            if self.is_cut(one, group, before, id)? {
                let reason = "its clip or viewport cuts off a part of it; draw only the visible part";
                return Err(refused(self.place(id), reason));
            }
            clip = one.clip_path();
        }
        Ok(())
    }

    /// Whether a clip cuts anything off the rings of a group.
    fn is_cut(
        &mut self,
        clip: &'a usvg::ClipPath,
        group: &usvg::Group,
        first: usize,
        id: &str,
    ) -> Result<bool, MapError> {
        let place = self.place(id);
        let transform = self.to_mm.pre_concat(group.abs_transform()).pre_concat(clip.transform());
        let mut window: Vec<Ring> = Vec::new();
        let mut parts: Vec<&usvg::Group> = vec![clip.root()];
        while let Some(part) = parts.pop() {
            for node in part.children() {
                match node {
                    usvg::Node::Group(inner) => parts.push(inner),
                    usvg::Node::Path(path) => {
                        let rule = path.fill().map_or(FillRule::NonZero, |fill| rule_of(fill.rule()));
                        let outline = self.flatten(path.data(), transform.pre_concat(path.abs_transform()), place)?;
                        window.extend(outline.simple_m(rule));
                    }
                    usvg::Node::Image(_) | usvg::Node::Text(_) => {}
                }
            }
        }
        let content = &self.rings[first..];
        self.budget.spend(&[content, &window].concat()).map_err(|_| tangled(place))?;
        let rest: Vec<Ring> = overlay(content, &window, OverlayRule::Difference).into_iter().flatten().collect();
        // What lies outside of the workspace is no wall anyway.
        let rest = overlay(&rest, std::slice::from_ref(&self.border_m), OverlayRule::Intersect);
        Ok(rest.iter().flatten().any(|ring| area_m2(ring).abs() > CUT_MOST_M2))
    }

    fn place(&self, id: &str) -> &'a Place {
        self.plain.places.get(id).unwrap_or(&self.plain.root)
    }

    fn repair(&mut self, place: &Place, kind: RepairKind) {
        let repair = Repair { place: place.clone(), kind };
        if self.reported.insert(repair.clone()) {
            self.repairs.push(repair);
        }
    }

    fn path(&mut self, path: &usvg::Path, place: &'a Place) -> Result<(), MapError> {
        let transform = self.to_mm.pre_concat(path.abs_transform());
        let rings_before = self.rings.len();
        if let Some(fill) = path.fill() {
            let rule = rule_of(fill.rule());
            let outline = self.flatten(path.data(), transform, place)?;
            let contacts = self.budget.spend(&outline.rings_mm).map_err(|_| tangled(place))?;
            let kinds = [
                (outline.is_open, RepairKind::Open),
                (contacts.cross, RepairKind::Crosses),
                (contacts.touch && !contacts.cross, RepairKind::Touches),
            ];
            let rings = outline.simple_m(rule);
            let left: Vec<Ring> = rings.iter().filter_map(without_hairs).collect();
            if left != rings {
                self.is_newer(4, place, "what is filled between a line and its way back was a wall");
            }
            if self.append(left, place) {
                for (_, kind) in kinds.into_iter().filter(|&(found, _)| found) {
                    self.repair(place, kind);
                }
            }
        }
        if let Some(stroke) = path.stroke() {
            // The outline is computed in the path's own units, and finer than the required flatness.
            let scale = PathStroker::compute_resolution_scale(&transform);
            check_reach(scale * stroke.width().get(), "its stroke is too wide", place)?;
            if scale * stroke.width().get() < HAIRLINE_MM && path.fill().is_none() {
                self.repair(place, RepairKind::Hairline);
            }
            placed(path.data(), transform, place)?;
            let is_flat = path.data().bounds().width() == 0.0 || path.data().bounds().height() == 0.0;
            if is_flat && self.plain.boxed.contains(path.id()) {
                let reason = "its gradient or pattern needs a box, which a straight line has not; use a colour";
                return Err(refused(place, reason));
            }
            let drawn = strokes::outline(path.data(), stroke, 8.0 * scale.max(1.0));
            if let Some(what) = drawn.newer {
                self.is_newer(3, place, what);
            }
            for outline in drawn.outlines {
                let outline = self.flatten(&outline, transform, place)?;
                self.budget.spend(&outline.rings_mm).map_err(|_| tangled(place))?;
                self.append(outline.simple_m(FillRule::NonZero), place);
            }
        }
        let drawn = &self.rings[rings_before..];
        let is_outside = |ring: &Ring| is_beside(ring, &self.workspace);
        if drawn.is_empty() {
            self.repair(place, RepairKind::Nothing);
        } else if drawn.iter().all(is_outside) {
            self.repair(place, RepairKind::Outside);
        }
        Ok(())
    }

    /// Returns whether there was anything to append.
    fn append(&mut self, rings: Vec<Ring>, place: &'a Place) -> bool {
        let before = self.rings.len();
        self.rings.extend(rings);
        self.places.resize(self.rings.len(), place);
        self.rings.len() > before
    }

    /// Readers before version `since` made other walls of an element.
    fn is_newer(&mut self, since: u32, place: &Place, what: &'static str) {
        if self.newer.iter().all(|newer| newer.since != since) {
            self.newer.push(Newer { since, place: place.clone(), what });
        }
    }

    fn flatten(&mut self, path: &Path, transform: Transform, place: &Place) -> Result<Flat, MapError> {
        let path = placed(path, transform, place)?;
        let mut flat = Flat { rings_mm: Vec::new(), is_open: false };
        let mut is_closed = true;
        let vertices = Cell::new(self.vertices);
        let bezier = bezier(&path);
        let affordable = bezier.into_iter().take_while(|_| vertices.get() <= MAX_VERTICES);
        kurbo::flatten(affordable, FLATNESS_MM, |element| {
            vertices.set(vertices.get() + usize::from(element != PathEl::ClosePath));
            match element {
                PathEl::MoveTo(p) => {
                    flat.is_open |= !is_closed && flat.last_is_open();
                    flat.rings_mm.push(vec![[p.x, p.y]]);
                    is_closed = false;
                }
                PathEl::LineTo(p) => flat.rings_mm.last_mut().expect("a path starts with MoveTo").push([p.x, p.y]),
                _ => is_closed = true,
            }
        });
        flat.is_open |= !is_closed && flat.last_is_open();
        flat.rings_mm.retain(|ring| ring.len() >= 3);
        self.vertices = vertices.get();
        if self.vertices > MAX_VERTICES {
            return Err(refused(place, format!("up to here the drawing has more than {MAX_VERTICES} vertices")));
        }
        let length = |[[ax, ay], [bx, by]]: [[f64; 2]; 2]| ((bx - ax).hypot(by - ay) / self.diagonal_mm).min(1.0);
        let edges =
            |ring: &Ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| length([a, b])).sum::<f64>();
        self.diagonals += flat.rings_mm.iter().map(edges).sum::<f64>();
        if self.diagonals > MAX_DIAGONALS {
            let reason =
                format!("up to here the outlines are longer than {MAX_DIAGONALS} times the viewBox's diagonal");
            return Err(refused(place, reason));
        }
        Ok(flat)
    }
}

/// A path as straight lines.
struct Flat {
    rings_mm: Vec<Ring>,
    /// Whether a ring does not end at its start.
    is_open: bool,
}

impl Flat {
    /// Rings that do not cross, in metres, y up.
    fn simple_m(&self, rule: FillRule) -> Vec<Ring> {
        let metres = |ring: &Ring| ring.iter().map(|[x, y]| [x / 1000.0, -y / 1000.0]).collect();
        let contours: Vec<Ring> = self.rings_mm.iter().map(metres).collect();
        simple(&contours, rule)
    }

    fn last_is_open(&self) -> bool {
        let Some([first, _, .., last]) = self.rings_mm.last().map(Vec::as_slice) else { return false };
        (first[0] - last[0]).hypot(first[1] - last[1]) > FLATNESS_MM
    }
}

fn rule_of(rule: usvg::FillRule) -> FillRule {
    match rule {
        usvg::FillRule::NonZero => FillRule::NonZero,
        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
    }
}

/// Whether a ring lies at one side of a rectangle.
fn is_beside(ring: &Ring, of: &Rect) -> bool {
    let all = |is_there: &dyn Fn(f64, f64) -> bool| ring.iter().all(|&[x, y]| is_there(x, y));
    all(&|x, _| x <= of.x_min_m)
        || all(&|x, _| x >= of.x_max_m)
        || all(&|_, y| y <= of.y_min_m)
        || all(&|_, y| y >= of.y_max_m)
}

fn area_m2(ring: &Ring) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|([ax, ay], [bx, by])| 0.5 * (ax * by - bx * ay)).sum()
}

/// A path in millimetres, if its coordinates are within the limit.
fn placed(path: &Path, to_mm: Transform, place: &Place) -> Result<Path, MapError> {
    let path = path.clone().transform(to_mm);
    let reach_mm = path.as_ref().map_or(f32::INFINITY, |path| {
        path.points().iter().fold(0.0, |reach: f32, p| reach.max(p.x.abs()).max(p.y.abs()))
    });
    check_reach(reach_mm, "it reaches too far", place)?;
    Ok(path.expect("an infinite reach is refused above"))
}

fn check_reach(reach_mm: f32, what: &str, place: &Place) -> Result<(), MapError> {
    if f64::from(reach_mm) <= MAX_EXTENT_MM {
        return Ok(());
    }
    Err(refused(place, format!("{what}: {reach_mm:e} mm, the limit is {MAX_EXTENT_MM:e} mm")))
}

fn refused(place: &Place, reason: impl Into<String>) -> MapError {
    MapError::Element { place: place.clone(), reason: reason.into() }
}

fn tangled(place: &Place) -> MapError {
    refused(place, "here too many outlines cross or overlap; simplify the drawing")
}

fn bezier(path: &Path) -> BezPath {
    let point = |p: Point| kurbo::Point::new(f64::from(p.x), f64::from(p.y));
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
    bezier
}
