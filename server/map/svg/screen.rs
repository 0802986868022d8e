//! Filters the input of usvg: only elements that can become walls, numbers in range, and a limited amount of both.
//!
//! usvg does not keep line numbers, so each element gets an id by which its line is found again.

use std::collections::HashMap;
use std::ops::Range;

use usvg::roxmltree::{Document, Node};

use super::super::{MapError, Place};
use super::attributes::{self, hidden, is_svg, short};

/// Nesting depth of elements with each `<use>` resolved. usvg is recursive.
const MAX_DEPTH: usize = 64;
/// Number of elements with each `<use>` resolved. A maze of single lines that fills the largest file has 20,000.
const MAX_ELEMENTS: usize = 20_000;
/// Numbers in `d` and `points` with each `<use>` resolved: four per vertex of [`super::sketch::MAX_VERTICES`].
const MAX_NUMBERS: usize = 200_000;
/// Size of style sheets, and number of steps for matching their selectors.
const MAX_STYLE_BYTES: usize = 16 << 10;
const MAX_STYLE_STEPS: usize = 1_000_000_000;

const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];
const OTHERS: [&str; 12] =
    ["svg", "g", "a", "defs", "symbol", "use", "switch", "title", "desc", "metadata", "style", "view"];
/// Paints do not matter for walls and are expensive in usvg: each is replaced by a plain colour.
const PAINTS: [&str; 3] = ["linearGradient", "radialGradient", "pattern"];

pub(super) struct Screened {
    /// The drawing for usvg.
    pub text: String,
    /// The elements by their ids in `text`.
    pub places: HashMap<String, Place>,
    pub root: Place,
    /// Ids in `text` of the shapes that should be visible.
    pub shown: Vec<String>,
}

pub(super) fn screen(xml: &Document<'_>, view_box: &str) -> Result<Screened, MapError> {
    let mut screen = Screen::of(xml);
    screen.check()?;
    screen.descend(xml.root_element(), 1)?;
    Ok(screen.rewrite(view_box))
}

struct Screen<'a, 'input> {
    xml: &'a Document<'input>,
    /// Line of each node, by node id.
    lines: Vec<u32>,
    /// Count of the numbers in each node's coordinates, by node id.
    numbers: Vec<usize>,
    /// Whether each node is not drawn at its own position, by node id.
    hidden: Vec<bool>,
    by_id: HashMap<&'a str, Node<'a, 'input>>,
    seen_elements: usize,
    seen_numbers: usize,
}

impl<'a, 'input> Screen<'a, 'input> {
    fn of(xml: &'a Document<'input>) -> Self {
        let (mut lines, mut numbers, mut hides) = (Vec::new(), Vec::new(), Vec::new());
        let (mut line, mut at) = (1, 0);
        let mut by_id = HashMap::new();
        for node in xml.descendants() {
            let start = node.range().start.max(at);
            line += xml.input_text()[at..start].matches('\n').count() as u32;
            at = start;
            lines.push(line);
            numbers.push(0);
            hides.push(hidden(node) || node.parent().is_some_and(|parent| hides[parent.id().get_usize()]));
            if let Some(id) = attributes::id(node) {
                by_id.entry(id.value()).or_insert(node);
            }
        }
        Self { xml, lines, numbers, hidden: hides, by_id, seen_elements: 0, seen_numbers: 0 }
    }

    fn place(&self, node: Node<'_, '_>) -> Place {
        Place {
            element: short(node.tag_name().name()),
            id: attributes::id(node).map(|id| short(id.value())).filter(|id| !id.is_empty()),
            line: self.lines[node.id().get_usize()],
        }
    }

    fn refused(&self, node: Node<'_, '_>, reason: impl Into<String>) -> MapError {
        MapError::Element { place: self.place(node), reason: reason.into() }
    }

    /// SVG elements, except those inside paints.
    fn elements(&self) -> impl Iterator<Item = Node<'a, 'input>> + use<'a, 'input> {
        let is_paint = |node: Node<'_, '_>| PAINTS.contains(&node.tag_name().name());
        let mut paint_ends = 0;
        self.xml.descendants().filter(move |&node| {
            let wanted = is_svg(node) && node.range().start >= paint_ends;
            if wanted && is_paint(node) {
                paint_ends = node.range().end;
            }
            wanted
        })
    }

    /// Checks each element separately, as written.
    fn check(&mut self) -> Result<(), MapError> {
        let (mut style_bytes, mut count, mut depth) = (0, 0, 0);
        for node in self.elements() {
            let tag = node.tag_name().name();
            let reason = match tag {
                _ if SHAPES.contains(&tag) || OTHERS.contains(&tag) || PAINTS.contains(&tag) => None,
                "text" | "tspan" | "textPath" | "flowRoot" => Some("text cannot be a wall; convert it to paths"),
                "image" | "foreignObject" => Some("an image cannot be a wall; trace it to paths"),
                "mask" | "clipPath" | "filter" => {
                    Some("masks, clips and filters are not applied; draw the shape itself")
                }
                "marker" => Some("markers are not drawn; draw the shape itself"),
                "animate" | "animateTransform" | "animateMotion" | "set" => {
                    Some("animations are not supported; walls are static")
                }
                _ => Some("unsupported element; draw with paths, rects, circles, ellipses, lines and polygons"),
            };
            if let Some(reason) = reason {
                return Err(self.refused(node, reason));
            }
            count += 1;
            if count > MAX_ELEMENTS {
                return Err(self.refused(node, format!("the drawing has more than {MAX_ELEMENTS} elements")));
            }
            if tag == "style" {
                style_bytes += node.range().len();
                if style_bytes > MAX_STYLE_BYTES {
                    return Err(self.refused(node, format!("style sheets have more than {MAX_STYLE_BYTES} bytes")));
                }
            }
            self.numbers[node.id().get_usize()] =
                attributes::check(node).map_err(|reason| self.refused(node, reason))?;
            depth = depth.max(node.ancestors().take(MAX_DEPTH + 2).count());
        }
        // A selector with several parts is tried on every combination of ancestors.
        let steps = (style_bytes * count).saturating_mul(1 << depth.min(40));
        if steps > MAX_STYLE_STEPS {
            let style = self.elements().find(|node| node.tag_name().name() == "style").expect("a style element exists");
            let reason = "the style sheet is too long for this number of nested elements; use attributes";
            return Err(self.refused(style, reason));
        }
        Ok(())
    }

    /// Checks the drawing with each `<use>` resolved, as usvg will process it.
    fn descend(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<(), MapError> {
        self.seen_elements += 1;
        self.seen_numbers += self.numbers[node.id().get_usize()];
        if depth > MAX_DEPTH {
            return Err(
                self.refused(node, format!("it is nested more than {MAX_DEPTH} elements deep, or refers to itself"))
            );
        }
        if self.seen_elements > MAX_ELEMENTS {
            let reason = format!("up to here the drawing has more than {MAX_ELEMENTS} elements, each <use> resolved");
            return Err(self.refused(node, reason));
        }
        if self.seen_numbers > MAX_NUMBERS {
            let reason = format!("up to here the drawing has more than {MAX_NUMBERS} coordinates, each <use> resolved");
            return Err(self.refused(node, reason));
        }
        for child in node.children().filter(Node::is_element) {
            self.descend(child, depth + 1)?;
        }
        if is_svg(node) && node.tag_name().name() == "use" {
            let href = attributes::href(node).unwrap_or_default();
            let target = href.trim().strip_prefix('#').and_then(|id| self.by_id.get(id).copied());
            let Some(target) = target else {
                let href = short(href);
                return Err(self.refused(node, format!("href={href:?} is not an element of this drawing")));
            };
            self.descend(target, depth + 1)?;
        }
        Ok(())
    }

    /// Gives each element its own id, replaces each paint by a plain colour, and removes the root's size.
    fn rewrite(&self, view_box: &str) -> Screened {
        let (text, root) = (self.xml.input_text(), self.xml.root_element());
        let mut edits: Vec<(Range<usize>, String)> = Vec::new();
        let (mut places, mut shown) = (HashMap::new(), Vec::new());
        let mut fresh_ids = (1..).map(|n| format!("ferry-{n}")).filter(|id| !self.by_id.contains_key(id.as_str()));
        for node in self.elements() {
            let name = node.tag_name().name();
            let own = attributes::id(node);
            let tag_start = node.range().start + 1;
            let ends_name = |c: char| c.is_whitespace() || c == '/' || c == '>';
            let tag_end = tag_start + text[tag_start..].find(ends_name).unwrap_or_default();
            if PAINTS.contains(&name) {
                let tag = text[tag_start..tag_end].replace(name, "linearGradient");
                let id = own.map_or("", |own| &text[own.range()]);
                edits.push((
                    node.range(),
                    format!("<{tag} {id}><{stop}/></{tag}>", stop = tag.replace("linearGradient", "stop")),
                ));
                continue;
            }
            for attribute in node.attributes() {
                let new = match attribute.name() {
                    "viewBox" if node == root => view_box,
                    "width" | "height" if node == root => "",
                    "id" if own.is_none_or(|own| own.range() != attribute.range()) => "",
                    _ => continue,
                };
                edits.push((attribute.range(), new.to_owned()));
            }
            let id = match own {
                Some(own) if !own.value().is_empty() && self.by_id.get(own.value()) == Some(&node) => {
                    own.value().to_owned()
                }
                // Replaces ids too: two elements could have the same one.
                own => {
                    let id = fresh_ids.next().expect("the range is infinite");
                    edits.push(match own {
                        Some(own) => (own.range(), format!("id={id:?}")),
                        None => (tag_end..tag_end, format!(" id={id:?}")),
                    });
                    id
                }
            };
            if SHAPES.contains(&name) && !self.hidden[node.id().get_usize()] {
                shown.push(id.clone());
            }
            places.insert(id, self.place(node));
        }
        edits.sort_by_key(|(range, _)| range.start);
        let (mut rewritten, mut at) = (String::with_capacity(text.len()), 0);
        for (range, new) in edits {
            rewritten += &text[at..range.start];
            rewritten += &new;
            at = range.end;
        }
        Screened { text: rewritten + &text[at..], places, root: self.place(root), shown }
    }
}
