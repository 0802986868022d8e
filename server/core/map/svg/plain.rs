//! Rewrites a drawing for usvg: only what is drawn, each shape with its own computed style, each `use` resolved, and every
//! value read here first. So usvg has nothing to drop. Amounts are limited, because usvg is recursive and has no limits.
//!
//! What is not drawn is not judged. What is drawn otherwise than in a browser is refused by element.

mod groups;
mod numbers;
mod paints;
mod reading;
mod shapes;

use std::collections::{HashMap, HashSet};
use std::fmt::Write;

use selectors::context::SelectorCaches;
use usvg::roxmltree::{Document, Node, NodeId};

use self::paints::PaintUnits;
use super::super::{MapError, Newer, Place, Repair, RepairKind};
use super::css::Sheet;
use super::style::{self, Inherited, Origin, PRESENTATION, SIZES, Style, Wrong};
use super::{own, short};

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
const XHTML: &str = "http://www.w3.org/1999/xhtml";

/// Nesting depth of elements with each `<use>` resolved. usvg is recursive.
const MAX_DEPTH: usize = 64;
/// Number of elements with each `<use>` resolved. A maze of single lines that fills the largest file has 20,000.
const MAX_ELEMENTS: usize = 20_000;
/// Bytes of attributes with each `<use>` resolved.
const MAX_READ: usize = 32 << 20;
/// Comparisons of a rule of a style sheet with an element: half a second of work.
const MAX_COMPARISONS: usize = 5_000_000;

/// Shapes, and the sizes that each has.
const SHAPES: [(&str, &[&str]); 7] = [
    ("path", &[]),
    ("rect", &["x", "y", "width", "height", "rx", "ry"]),
    ("circle", &["cx", "cy", "r"]),
    ("ellipse", &["cx", "cy", "rx", "ry"]),
    ("line", &["x1", "y1", "x2", "y2"]),
    ("polyline", &[]),
    ("polygon", &[]),
];
/// What is not drawn by itself.
const IDLE: [&str; 22] = [
    "defs",
    "symbol",
    "title",
    "desc",
    "metadata",
    "style",
    "view",
    "linearGradient",
    "radialGradient",
    "pattern",
    "clipPath",
    "mask",
    "marker",
    "filter",
    "cursor",
    "font",
    "font-face",
    "color-profile",
    "stop",
    "glyph",
    "hkern",
    "missing-glyph",
];

const LANGUAGE: &str = "systemLanguage: what is drawn depends on the reader's language; leave it out";

/// A drawing for usvg.
pub struct Plain {
    pub text: String,
    /// The elements by their ids in `text`.
    pub places: HashMap<String, Place>,
    pub root: Place,
    /// Ids in `text` of the shapes that should be visible.
    pub shown: Vec<String>,
    /// Ids of the shapes whose strokes have a paint that depends on a box, which a straight line has not.
    pub boxed: HashSet<String>,
    pub notes: Vec<Repair>,
    /// What the reader of version 1 read otherwise; the first element.
    pub newer: Option<Newer>,
}

pub fn plain(xml: &Document<'_>, view_box: &str) -> Result<Plain, MapError> {
    let mut writer = Writer::of(xml)?;
    let root = xml.root_element();
    let mut style = writer.style(root, &Inherited::default())?;
    let place = writer.place(root);
    if !style.transform.is_empty() {
        style.add_trouble("transform", "transform moves the workspace itself; put the content into a group");
    }
    if style.clip.as_deref().is_some_and(|id| writer.clip_path(id).is_some()) {
        style.add_trouble("clip-path", "clip-path on the drawing itself is not applied; put the content into a group");
    }
    let _ = write!(writer.text, "<svg xmlns=\"{SVG}\" {view_box}>");
    if style.is_displayed && style.is_opaque {
        let trouble = style.trouble().map(|why| (root, why));
        let scope = Scope { trouble, depth: 1, clips: false, before: String::new() };
        writer.children(root, &style.inherited, &scope)?;
    }
    writer.text += "</svg>";
    let Writer { text, places, shown, boxed, notes, newer, .. } = writer;
    Ok(Plain { text, places, root: place, shown, boxed, notes, newer })
}

/// What holds for an element because of those above it.
#[derive(Clone)]
struct Scope<'a, 'input> {
    /// Why nothing can be drawn here, and the element that is the cause.
    trouble: Option<(Node<'a, 'input>, String)>,
    depth: usize,
    /// Inside a `clipPath`, where paint does not matter.
    clips: bool,
    /// The transform of a `use` in a `clipPath`, where usvg reads no groups.
    before: String,
}

struct Writer<'a, 'input> {
    /// Line of each node, by node id.
    lines: Vec<u32>,
    by_id: HashMap<&'a str, Node<'a, 'input>>,
    sheet: Sheet,
    caches: SelectorCaches,
    /// What the `use` refers to that is being copied.
    top: Option<NodeId>,
    elements: usize,
    numbers: usize,
    /// Bytes of attributes that were read, each `<use>` resolved.
    read: usize,
    /// Comparisons of rules with elements: for each, and so far.
    comparisons_each: usize,
    comparisons: usize,
    /// What a `clipPath` inherits.
    above: HashMap<NodeId, Inherited>,
    /// Gradients and patterns that were looked up, by id.
    paints: HashMap<String, Option<PaintUnits>>,
    text: String,
    places: HashMap<String, Place>,
    shown: Vec<String>,
    boxed: HashSet<String>,
    notes: Vec<Repair>,
    noted: HashSet<Repair>,
    newer: Option<Newer>,
}

/// A root without a namespace is taken for one of SVG.
fn is_svg(node: Node<'_, '_>) -> bool {
    let is_bare = || node.document().root_element().tag_name().namespace().is_none();
    node.is_element() && node.tag_name().namespace().map_or_else(is_bare, |namespace| namespace == SVG)
}

fn href<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    own(node, "href").or_else(|| node.attribute((XLINK, "href")))
}

impl<'a, 'input> Writer<'a, 'input> {
    fn place(&self, node: Node<'_, '_>) -> Place {
        Place {
            element: short(node.tag_name().name()),
            id: own(node, "id").map(short).filter(|id| !id.is_empty()),
            line: self.lines[node.id().get_usize()],
        }
    }

    fn refused(&self, node: Node<'_, '_>, reason: impl Into<String>) -> MapError {
        MapError::Element { place: self.place(node), reason: reason.into() }
    }

    fn note(&mut self, node: Node<'_, '_>, kind: RepairKind) {
        let note = Repair { place: self.place(node), kind };
        if self.noted.insert(note.clone()) {
            self.notes.push(note);
        }
    }

    fn is_newer(&mut self, node: Node<'_, '_>, what: &'static str) {
        if self.newer.is_none() {
            self.newer = Some(Newer { since: 2, place: self.place(node), what });
        }
    }

    /// The computed style of an element.
    fn style(&mut self, node: Node<'a, 'input>, parent: &Inherited) -> Result<Style, MapError> {
        let bytes = node.attributes().map(|one| one.value().len()).sum::<usize>();
        self.read += bytes;
        // Values are compared, too.
        self.comparisons = self.comparisons.saturating_add(self.comparisons_each.saturating_mul(1 + bytes / 64));
        if self.comparisons > MAX_COMPARISONS {
            let reason = "up to here the style sheets have too many rules for the elements; use attributes";
            return Err(self.refused(node, reason));
        }
        if self.read > MAX_READ {
            let reason = format!("up to here the attributes have more than {MAX_READ} bytes, each <use> resolved");
            return Err(self.refused(node, reason));
        }
        let mut style = Style::below(parent);
        for name in PRESENTATION {
            if let Some(value) = own(node, name) {
                self.declare(&mut style, node, name, value, Origin::Attribute, parent);
            }
        }
        let declarations =
            self.sheet.declarations(node, self.top, &mut self.caches).map_err(|why| self.refused(node, why))?;
        for one in &declarations {
            self.declare(&mut style, node, &one.name, &one.value, Origin::Css, parent);
        }
        style.finish();
        Ok(style)
    }

    fn declare(
        &mut self,
        style: &mut Style,
        node: Node<'a, 'input>,
        name: &str,
        value: &str,
        origin: Origin,
        parent: &Inherited,
    ) {
        if origin == Origin::Css && SIZES.contains(&name) {
            let tag = node.tag_name().name();
            let has_size = match tag {
                "path" => name == "d",
                "svg" | "symbol" | "use" => {
                    let is_one = ["x", "y", "width", "height"].contains(&name) && node.parent_element().is_some();
                    if is_one {
                        let why = format!("{name} in a style is not applied to it; use the attribute");
                        style.add_trouble(name, &why);
                    }
                    false
                }
                _ => SHAPES.iter().any(|(shape, sizes)| *shape == tag && sizes.contains(&name)),
            };
            if !has_size {
                return;
            }
        }
        let declared = style.declare(name, value, origin, parent);
        if declared == Err(Wrong::Invalid) {
            self.note(node, RepairKind::Invalid { name: name.to_owned(), value: short(value) });
        }
        if origin == Origin::Css && (name == "transform" || SIZES.contains(&name)) {
            self.is_newer(node, "properties of geometry in a style were ignored");
        }
        let has_length = name == "stroke-width" || name.ends_with("transform") || name.ends_with("transform-origin");
        if (has_length || SIZES.contains(&name))
            && value
                .split(|c: char| c == '(' || c == ')' || c == ',' || c.is_ascii_whitespace())
                .any(style::is_absolute)
        {
            self.absolute(node, name, value);
        }
    }

    fn absolute(&mut self, node: Node<'_, '_>, name: &str, value: &str) {
        self.note(node, RepairKind::Absolute { name: name.to_owned(), value: short(value) });
        self.is_newer(node, "a millimetre was 3.78 units");
    }

    fn children(
        &mut self,
        node: Node<'a, 'input>,
        parent: &Inherited,
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        node.children().filter(|child| is_svg(*child)).try_for_each(|child| self.element(child, parent, scope))
    }

    fn element(
        &mut self,
        node: Node<'a, 'input>,
        parent: &Inherited,
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        let tag = node.tag_name().name();
        self.count(node, scope)?;
        if IDLE.contains(&tag) || !is_wanted(node) {
            return Ok(());
        }
        let mut style = self.style(node, parent)?;
        if !style.is_displayed {
            return Ok(());
        }
        if own(node, "systemLanguage").is_some() {
            style.add_trouble("systemLanguage", LANGUAGE);
        }
        if !style.is_opaque && !scope.clips {
            self.is_newer(node, "it was a wall though it cannot be seen");
            return Ok(());
        }
        if let Some((_, sizes)) = SHAPES.into_iter().find(|(name, _)| *name == tag) {
            return self.shape(node, sizes, &style, scope);
        }
        let mut scope = Scope { depth: scope.depth + 1, ..scope.clone() };
        let has_language = |child: Node<'_, '_>| is_svg(child) && own(child, "systemLanguage").is_some();
        if tag == "switch" && node.children().any(has_language) {
            style.add_trouble("systemLanguage", LANGUAGE);
        }
        if let Some(why) = style.trouble() {
            scope.trouble.get_or_insert((node, why));
        }
        match tag {
            "g" | "a" | "switch" | "svg" | "use" if scope.clips && tag != "use" => Ok(()),
            "g" | "a" => {
                self.open(node, &style, "", &scope)?;
                self.children(node, &style.inherited, &scope)?;
                self.text += "</g>";
                Ok(())
            }
            "switch" => {
                self.open(node, &style, "", &scope)?;
                let chosen = node.children().find(|child| is_svg(*child) && is_wanted(*child));
                if let Some(chosen) = chosen {
                    self.element(chosen, &style.inherited, &scope)?;
                }
                self.text += "</g>";
                Ok(())
            }
            "svg" => {
                self.open(node, &style, "", &scope)?;
                self.viewport(node, &style, &[], &scope)?;
                self.text += "</g>";
                Ok(())
            }
            "use" => self.use_of(node, &style, &scope),
            "text" | "flowRoot" if !has_text(node) || !self.is_painted(&style.inherited) => Ok(()),
            "text" | "flowRoot" => self.judge(node, &style, "text cannot be a wall; convert it to paths"),
            "image" | "foreignObject" | "video" | "canvas" | "iframe" => {
                self.judge(node, &style, "an image cannot be a wall; trace it to paths")
            }
            _ => self.judge(
                node,
                &style,
                "unsupported element; draw with paths, rects, circles, ellipses, lines and polygons",
            ),
        }
    }

    fn count(&mut self, node: Node<'a, 'input>, scope: &Scope<'a, 'input>) -> Result<(), MapError> {
        self.elements += 1;
        if scope.depth > MAX_DEPTH {
            let reason = format!("it is nested more than {MAX_DEPTH} elements deep, or refers to itself");
            return Err(self.refused(node, reason));
        }
        if self.elements > MAX_ELEMENTS {
            let reason = format!("up to here the drawing has more than {MAX_ELEMENTS} elements, each <use> resolved");
            return Err(self.refused(node, reason));
        }
        Ok(())
    }

    /// Refuses an element that would be drawn.
    fn judge(&self, node: Node<'a, 'input>, style: &Style, reason: &str) -> Result<(), MapError> {
        if style.inherited.is_visible { Err(self.refused(node, reason)) } else { Ok(()) }
    }
}

/// Whether an element passes its condition. No browser knows extensions.
fn is_wanted(node: Node<'_, '_>) -> bool {
    own(node, "requiredExtensions").is_none()
}

fn has_text(node: Node<'_, '_>) -> bool {
    let is_text = |one: Node<'_, '_>| one.is_text() && one.text().is_some_and(|text| !text.trim().is_empty());
    node.descendants().any(is_text)
}
