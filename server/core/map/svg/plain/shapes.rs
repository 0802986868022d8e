//! Shapes: what is painted of them, and their numbers.

use std::fmt::Write;

use usvg::roxmltree::Node;

use super::groups::WrittenClip;
use super::numbers::{check_path, check_points};
use super::paints::PaintUnits;
use super::{Scope, Writer};
use crate::map::svg::style::{Inherited, Paint, Style};
use crate::map::svg::{own, short};
use crate::map::{MapError, RepairKind};

/// Numbers in `d` and `points` with each `<use>` resolved: four per vertex of [`super::super::sketch::MAX_VERTICES`].
const MAX_NUMBERS: usize = 200_000;

impl<'a, 'input> Writer<'a, 'input> {
    pub(super) fn shape(
        &mut self,
        node: Node<'a, 'input>,
        sizes: &[&str],
        style: &Style,
        scope: &Scope<'a, 'input>,
    ) -> Result<(), MapError> {
        let Inherited { is_visible, fill, stroke, .. } = &style.inherited;
        if !is_visible {
            return Ok(());
        }
        self.find_paints(&style.inherited);
        let exists = |id: &str| self.paints.get(id).is_some_and(Option::is_some);
        let (is_filled, is_stroked) = match scope.clips {
            true => (true, false),
            false => (style.inherited.is_filled(&exists), style.inherited.is_stroked(&exists)),
        };
        let is_boxed =
            matches!(stroke, Paint::Server { id, .. } if self.paints.get(id) == Some(&Some(PaintUnits::Box)));
        let missing = [fill, stroke].into_iter().find_map(|paint| match paint {
            Paint::Server { id, fallback: None } if !exists(id) => Some(id.clone()),
            _ => None,
        });
        if let Some(id) = missing.filter(|_| !scope.clips) {
            self.note(node, RepairKind::NoPaint { id: short(&id) });
        }
        let tag = node.tag_name().name();
        let has_area = tag != "line";
        if matches!(tag, "path" | "line" | "polyline" | "polygon") && !scope.clips {
            let is_marker =
                |id: &String| self.by_id.get(id.as_str()).is_some_and(|one| one.tag_name().name() == "marker");
            if style.inherited.markers.iter().flatten().any(is_marker) {
                return Err(self.refused(node, "markers are not drawn; draw the shape itself"));
            }
        }
        if !(is_filled && has_area || is_stroked) {
            if style.inherited.is_transparent(has_area) {
                self.is_newer(node, "it was a wall though it cannot be seen");
            } else if !has_area {
                self.note(node, RepairKind::Nothing);
            }
            return Ok(());
        }
        if let Some((cause, why)) = scope.trouble.clone().or_else(|| style.trouble().map(|why| (node, why))) {
            return Err(self.refused(cause, why));
        }
        let mut attributes = String::new();
        for name in sizes {
            if let Some(size) = self.size(node, style, name)?.filter(|size| size != "auto") {
                let _ = write!(attributes, " {name}=\"{size}\"");
            }
        }
        let declared = style.sizes.iter().rev().find(|(name, _)| *name == "d").map(|(_, path)| path.clone());
        let outline = match tag {
            "path" => declared.or_else(|| own(node, "d").map(str::to_owned)).map(|d| ("d", d)),
            "polyline" | "polygon" => own(node, "points").map(|points| ("points", points.to_owned())),
            _ => None,
        };
        if let Some((name, value)) = outline {
            let checked = if name == "d" { check_path(&value) } else { check_points(&value) };
            let count = checked.map_err(|why| self.refused(node, why))?;
            self.numbers += count;
            if self.numbers > MAX_NUMBERS {
                let reason =
                    format!("up to here the drawing has more than {MAX_NUMBERS} coordinates, each <use> resolved");
                return Err(self.refused(node, reason));
            }
            let _ = write!(attributes, " {name}=\"{}\"", value.trim());
        }
        let Inherited { fill_rule, clip_rule, stroke_width, linecap, linejoin, miterlimit, dashes, .. } =
            &style.inherited;
        if is_stroked {
            if let Some(dashes) = dashes {
                let reason = format!("stroke-dasharray={dashes:?} is not drawn; draw each dash as a separate wall");
                return Err(self.refused(node, reason));
            }
            if style.has_vector_effect {
                return Err(self.refused(node, "vector-effect is not applied; give the stroke its width in mm"));
            }
            let _ = write!(
                attributes,
                " stroke=\"#000\" stroke-width=\"{stroke_width}\" stroke-linecap=\"{linecap}\" \
                 stroke-linejoin=\"{linejoin}\" stroke-miterlimit=\"{miterlimit}\""
            );
        }
        match (scope.clips, is_filled) {
            (true, _) => {
                let _ = write!(attributes, " clip-rule=\"{clip_rule}\"");
            }
            (false, true) => {
                let _ = write!(attributes, " fill-rule=\"{fill_rule}\"");
            }
            (false, false) => attributes += " fill=\"none\"",
        }
        if scope.clips && style.clip.as_deref().is_some_and(|id| self.clip_path(id).is_some()) {
            return Err(self.refused(node, "a clip of a clip is not applied; draw the shape itself"));
        }
        let clip = style.clip.as_deref().map(|id| self.clip(id, scope)).transpose()?.flatten();
        if let Some(WrittenClip { id, .. }) = clip {
            let _ = write!(attributes, " clip-path=\"url(#{id})\"");
        }
        if !(style.transform.is_empty() && scope.before.is_empty()) {
            let _ = write!(attributes, " transform=\"{} {}\"", scope.before, style.transform);
        }
        let id = self.fresh(node);
        let _ = write!(self.text, "<{tag} id=\"{id}\"{attributes}/>");
        if !scope.clips {
            if is_stroked && is_boxed {
                self.boxed.insert(id.clone());
            }
            self.shown.push(id);
        }
        Ok(())
    }
}
