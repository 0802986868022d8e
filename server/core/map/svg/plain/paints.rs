//! Gradients and patterns: whether they paint anything. What they look like does not matter.

use usvg::roxmltree::Node;

use super::{Writer, href, is_svg};
use crate::map::svg::own;
use crate::map::svg::style::{Inherited, Origin, Paint, decoded_fragment, size};

const GRADIENTS: [&str; 2] = ["linearGradient", "radialGradient"];
/// References to others are followed this far.
const MAX_REFERENCES: usize = 16;

/// What a paint is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PaintUnits {
    /// The box of the shape: without width or height nothing is painted.
    Box,
    Drawing,
}

impl<'a, 'input> Writer<'a, 'input> {
    /// Whether a style paints anything, so that text with it can be seen.
    pub(super) fn is_painted(&mut self, inherited: &Inherited) -> bool {
        self.find_paints(inherited);
        let exists = |id: &str| self.paints.get(id).is_some_and(Option::is_some);
        inherited.is_filled(&exists) || inherited.is_stroked(&exists)
    }

    /// Looks the gradients and patterns of a style up.
    pub(super) fn find_paints(&mut self, inherited: &Inherited) {
        for paint in [&inherited.fill, &inherited.stroke] {
            let Paint::Server { id, .. } = paint else { continue };
            if self.paints.contains_key(id) {
                continue;
            }
            let found = self.by_id.get(id.as_str()).copied().filter(|node| is_svg(*node));
            let units = found.and_then(|node| self.units(node));
            self.paints.insert(id.clone(), units);
        }
    }

    /// What a gradient or pattern is measured in; `None` if it paints nothing.
    fn units(&self, node: Node<'a, 'input>) -> Option<PaintUnits> {
        // It takes over from others what it does not have.
        let mut chain = vec![node];
        while let Some(id) = chain.last().and_then(|one| decoded_fragment(href(*one)?.trim())) {
            match self.by_id.get(id.as_str()) {
                Some(next) if chain.len() < MAX_REFERENCES && is_svg(*next) => chain.push(*next),
                _ => break,
            }
        }
        let tag = node.tag_name().name();
        let is_gradient = GRADIENTS.contains(&tag);
        if !is_gradient && tag != "pattern" {
            return None;
        }
        let is_kin = |one: &Node<'_, '_>| match is_gradient {
            true => GRADIENTS.contains(&one.tag_name().name()),
            false => one.tag_name().name() == "pattern",
        };
        let kin: Vec<_> = chain.into_iter().take_while(is_kin).collect();
        let first = |name: &str| kin.iter().find_map(|one| own(*one, name));
        let children = |node: &Node<'a, 'input>| node.children().filter(|child| is_svg(*child)).collect::<Vec<_>>();
        let paints = if is_gradient {
            kin.iter().any(|one| children(one).iter().any(|child| child.tag_name().name() == "stop"))
        } else {
            let is_positive = |name| {
                let side = first(name).and_then(|value| size(value, Origin::Attribute).ok());
                side.and_then(|side| side.trim_end_matches('%').parse::<f64>().ok()).is_some_and(|side| side > 0.0)
            };
            is_positive("width") && is_positive("height") && kin.iter().any(|one| !children(one).is_empty())
        };
        let units = first(if is_gradient { "gradientUnits" } else { "patternUnits" });
        let units = if units == Some("userSpaceOnUse") { PaintUnits::Drawing } else { PaintUnits::Box };
        paints.then_some(units)
    }
}
