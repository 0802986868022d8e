//! Groups, clips, viewports and `use`.

use std::fmt::Write;

use svgtypes::{AspectRatio, NumberListParser};
use usvg::roxmltree::{Node, NodeId};

use super::numbers::check_numbers;
use super::{MAX_DEPTH, SHAPES, Scope, Writer, href, is_svg, is_wanted};
use crate::map::MapError;
use crate::map::svg::style::{self, Inherited, Origin, Style, Wrong};
use crate::map::svg::{own, short};

/// A `clipPath` in the new text.
pub(super) struct WrittenClip {
    pub id: String,
    /// In units of the box of what it clips.
    pub has_box: bool,
}

impl<'a, 'input> Writer<'a, 'input> {
    /// Begins a group.
    pub(super) fn open(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        shift: &str,
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        let clip = style.clip.as_deref().map(|id| self.clip(id, scope)).transpose()?.flatten();
        if clip.as_ref().is_some_and(|clip| clip.has_box) {
            return Err(self.refused(node, "a clip in units of its box is not applied to a group; clip the shapes"));
        }
        let id = self.fresh(node);
        let _ = write!(self.text, "<g id=\"{id}\"");
        if !(style.transform.is_empty() && shift.is_empty()) {
            let _ = write!(self.text, " transform=\"{} {shift}\"", style.transform);
        }
        if let Some(WrittenClip { id, .. }) = clip {
            let _ = write!(self.text, " clip-path=\"url(#{id})\"");
        }
        self.text += ">";
        Ok(())
    }

    /// A new id of an element.
    pub(super) fn fresh(&mut self, node: Node<'a, 'input>) -> String {
        let id = format!("e{}", self.places.len());
        self.places.insert(id.clone(), self.place(node));
        id
    }

    /// The `clipPath` of an id.
    pub(super) fn clip_path(&self, id: &str) -> Option<Node<'a, 'input>> {
        self.by_id.get(id).copied().filter(|node| is_svg(*node) && node.tag_name().name() == "clipPath")
    }

    /// Does something with the tree of a copy, or with the drawing's.
    fn below<T>(&mut self, top: Option<NodeId>, work: impl FnOnce(&mut Self) -> T) -> T {
        if self.top == top {
            return work(self);
        }
        // They know elements by their place in the tree.
        let outer = (std::mem::replace(&mut self.top, top), std::mem::take(&mut self.caches));
        let done = work(self);
        (self.top, self.caches) = outer;
        done
    }

    /// What an element inherits where it stands, also in a part that is not displayed.
    fn inherited_at(&mut self, node: Node<'a, 'input>) -> Result<Inherited, MapError> {
        if let Some(known) = self.above.get(&node.id()) {
            return Ok(known.clone());
        }
        let mut above: Vec<_> = node.ancestors().skip(1).filter(|one| is_svg(*one)).collect();
        if above.len() > MAX_DEPTH {
            return Err(self.refused(node, format!("it is nested more than {MAX_DEPTH} elements deep")));
        }
        above.reverse();
        let mut inherited = Inherited::default();
        for one in above {
            inherited = self.style(one, &inherited)?.inherited;
        }
        self.above.insert(node.id(), inherited.clone());
        Ok(inherited)
    }

    /// Writes a `clipPath`; `None` without one.
    pub(super) fn clip(&mut self, id: &str, scope: &Scope<'a, 'input>) -> Result<Option<WrittenClip>, MapError> {
        let Some(node) = self.clip_path(id) else { return Ok(None) };
        self.below(None, |writer| writer.write_clip(node, scope).map(Some))
    }

    fn write_clip(&mut self, node: Node<'a, 'input>, scope: &Scope<'a, 'input>) -> Result<WrittenClip, MapError> {
        let inherited = self.inherited_at(node)?;
        let style = self.style(node, &inherited)?;
        if !style.is_displayed {
            return Err(self.refused(node, "it is not displayed, and used as a clip; leave it out"));
        }
        let units = own(node, "clipPathUnits").unwrap_or("userSpaceOnUse").trim();
        if !["userSpaceOnUse", "objectBoundingBox"].contains(&units) {
            return Err(self.refused(node, format!("clipPathUnits={:?} is not understood", short(units))));
        }
        let trouble = style.trouble().map(|why| (node, why));
        let scope = Scope { trouble, depth: scope.depth + 1, clips: true, before: String::new() };
        self.count(node, &scope)?;
        if style.clip.as_deref().is_some_and(|id| self.clip_path(id).is_some()) {
            return Err(self.refused(node, "a clip of a clip is not applied; draw the shape itself"));
        }
        let id = self.fresh(node);
        let _ = write!(self.text, "<clipPath id=\"{id}\" clipPathUnits=\"{units}\"");
        if !style.transform.is_empty() {
            let _ = write!(self.text, " transform=\"{}\"", style.transform);
        }
        self.text += ">";
        let before = self.text.len();
        self.children(node, &style.inherited, &scope)?;
        if self.text.len() == before {
            return Err(self.refused(node, "it lets nothing be seen; leave the shapes out that it cuts off"));
        }
        self.text += "</clipPath>";
        Ok(WrittenClip { id, has_box: units == "objectBoundingBox" })
    }

    /// A size of an element: as declared, or its attribute.
    pub(super) fn size(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        name: &str,
    ) -> Result<Option<String>, MapError> {
        if let Some((_, size)) = style.sizes.iter().rev().find(|(one, _)| *one == name) {
            return Ok(Some(size.clone()));
        }
        let Some(value) = own(node, name) else { return Ok(None) };
        if style::is_absolute(value) {
            self.absolute(node, name, value);
        }
        if value.trim().eq_ignore_ascii_case("auto") {
            return Err(self.refused(node, format!("{name}={value:?} is no number; leave it out")));
        }
        let size = style::size(value, Origin::Attribute);
        size.map(Some).map_err(|wrong| match wrong {
            Wrong::Refused(why) => self.refused(node, format!("{name}={:?} {why}", short(value))),
            Wrong::Invalid => self.refused(node, format!("{name}={:?} is not a number", short(value))),
        })
    }

    /// Writes a nested viewport, with some sizes of the `use` that refers to it.
    pub(super) fn viewport(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        of_use: &[(&str, String)],
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        let mut attributes = String::new();
        for name in ["x", "y", "width", "height"] {
            let given = of_use.iter().find(|(one, _)| *one == name).map(|(_, size)| size.clone());
            let size = given.map_or_else(|| self.size(node, style, name), |size| Ok(Some(size)))?;
            let is_side = matches!(name, "width" | "height");
            let size = match size.filter(|size| size != "auto") {
                Some(size) => size,
                None if is_side => "100%".to_owned(),
                None => continue,
            };
            if is_side && size.trim_end_matches('%').parse::<f64>().is_ok_and(|size| size <= 0.0) {
                return Err(self.refused(node, format!("{name}={size:?} is not positive")));
            }
            let _ = write!(attributes, " {name}=\"{size}\"");
        }
        if let Some(value) = own(node, "viewBox") {
            let numbers: Result<Vec<f64>, _> = NumberListParser::from(value.trim()).collect();
            let numbers = numbers.unwrap_or_default();
            let [x, y, width, height] = numbers[..] else {
                return Err(self.refused(node, format!("viewBox={:?} is not four numbers", short(value))));
            };
            if style::has_bare_dot(value) {
                return Err(self.refused(node, format!("viewBox={:?} ends a number with a dot", short(value))));
            }
            check_numbers("viewBox", &numbers).map_err(|why| self.refused(node, why))?;
            if width <= 0.0 || height <= 0.0 {
                return Err(self.refused(node, format!("viewBox={:?} has no area", short(value))));
            }
            let _ = write!(attributes, " viewBox=\"{x} {y} {width} {height}\"");
        }
        if let Some(value) = own(node, "preserveAspectRatio") {
            let is_plain = |c: char| c.is_ascii_alphabetic() || c == ' ';
            if value.trim().parse::<AspectRatio>().is_err() || !value.trim().chars().all(is_plain) {
                return Err(self.refused(node, format!("preserveAspectRatio={:?} is not understood", short(value))));
            }
            let _ = write!(attributes, " preserveAspectRatio=\"{}\"", value.trim());
        }
        if style.is_overflow_visible {
            attributes += " overflow=\"visible\"";
        }
        let id = self.fresh(node);
        let _ = write!(self.text, "<svg id=\"{id}\"{attributes}>");
        self.children(node, &style.inherited, scope)?;
        self.text += "</svg>";
        Ok(())
    }

    pub(super) fn use_of(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        let value = href(node).unwrap_or_default().trim();
        let target = style::decoded_fragment(value).and_then(|id| self.by_id.get(id.as_str()).copied());
        let target = target.filter(|one| is_svg(*one));
        let Some(target) = target else {
            return self.judge(node, style, &format!("href={:?} is not an element of this drawing", short(value)));
        };
        let mut sizes = Vec::new();
        for name in ["width", "height"] {
            if let Some(size) = self.size(node, style, name)?.filter(|size| size != "auto") {
                sizes.push((name, size));
            }
        }
        let mut shift = Vec::new();
        for name in ["x", "y"] {
            let size = self.size(node, style, name)?.unwrap_or_else(|| "0".to_owned());
            if size.ends_with('%') && size != "0%" {
                return self.judge(node, style, &format!("{name}={size:?} is not applied to a use; give it in units"));
            }
            shift.push(size.trim_end_matches('%').replace("auto", "0"));
        }
        let shift = format!("translate({})", shift.join(" "));
        let tag = target.tag_name().name();
        if scope.clips {
            // Of a clip only shapes are drawn.
            if !SHAPES.iter().any(|(shape, _)| *shape == tag) {
                return Ok(());
            }
            if style.clip.as_deref().is_some_and(|id| self.clip_path(id).is_some()) {
                return Err(self.refused(node, "a clip of a clip is not applied; draw the shape itself"));
            }
            let scope = Scope { before: format!("{} {shift}", style.transform), ..scope.clone() };
            return self.below(Some(target.id()), |writer| writer.element(target, &style.inherited, &scope));
        }
        self.open(node, style, &shift, scope)?;
        self.below(Some(target.id()), |writer| writer.copy(target, style, &sizes, scope))?;
        self.text += "</g>";
        Ok(())
    }

    /// Writes what a `use` with this style refers to.
    fn copy(
        &mut self,
        target: Node<'a, 'input>,
        style: &Style,
        sizes: &[(&str, String)],
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        if matches!(target.tag_name().name(), "svg" | "symbol") {
            let scope = Scope { depth: scope.depth + 1, ..scope.clone() };
            self.count(target, &scope)?;
            let inner = self.style(target, &style.inherited)?;
            let trouble = scope.trouble.clone().or_else(|| inner.trouble().map(|why| (target, why)));
            if inner.is_displayed && inner.is_opaque && is_wanted(target) {
                self.open(target, &inner, "", &scope)?;
                self.viewport(target, &inner, sizes, &Scope { trouble, ..scope })?;
                self.text += "</g>";
            }
        } else {
            self.element(target, &style.inherited, scope)?;
        }
        Ok(())
    }
}
