//! What holds for a whole drawing: lines, ids, style sheets, and what could change it from anywhere.

use std::collections::{HashMap, HashSet};

use selectors::context::SelectorCaches;
use usvg::roxmltree::{Document, Node, NodeType};

use super::{Writer, XHTML, is_svg};
use crate::map::MapError;
use crate::map::svg::css::Sheet;
use crate::map::svg::{own, short};

impl<'a, 'input> Writer<'a, 'input> {
    /// Reads style sheets and ids, and refuses what could change the drawing from anywhere in it.
    pub(super) fn of(xml: &'a Document<'input>) -> Result<Self, MapError> {
        let mut writer = Self {
            lines: Vec::new(),
            by_id: HashMap::new(),
            sheet: Sheet::default(),
            caches: SelectorCaches::default(),
            top: None,
            elements: 0,
            numbers: 0,
            read: 0,
            comparisons_each: 0,
            comparisons: 0,
            above: HashMap::new(),
            paints: HashMap::new(),
            text: String::new(),
            places: HashMap::new(),
            shown: Vec::new(),
            boxed: HashSet::new(),
            notes: Vec::new(),
            noted: HashSet::new(),
            newer: None,
        };
        let (mut line, mut at) = (1, 0);
        for node in xml.descendants() {
            let start = node.range().start.max(at);
            line += xml.input_text()[at..start].matches('\n').count() as u32;
            at = start;
            writer.lines.push(line);
            if let Some(id) = own(node, "id") {
                writer.by_id.entry(id).or_insert(node);
            }
        }
        let mut most_beside = 0;
        for node in xml.descendants() {
            if node.node_type() == NodeType::PI && node.pi().is_some_and(|pi| pi.target == "xml-stylesheet") {
                let reason = "an xml-stylesheet refers to another file; copy its content into a <style>";
                return Err(MapError::Svg(format!("line {}: {reason}", writer.lines[node.id().get_usize()])));
            }
            most_beside = most_beside.max(node.children().filter(Node::is_element).count());
            let is_html = node.tag_name().namespace() == Some(XHTML);
            let reason = match node.tag_name().name() {
                "style" | "link" if is_html => "a style sheet of HTML; use <style>",
                "script" if is_html || is_svg(node) => "scripts do not run; draw what they would draw",
                _ if !is_svg(node) => continue,
                _ if own(node, "onload").is_some_and(|script| !script.trim().is_empty()) => {
                    "scripts do not run, such as that of onload; draw what it would draw"
                }
                "link" => "it refers to another file; copy its content here",
                "animate" | "animateTransform" | "animateMotion" | "set" | "discard" => {
                    "animations are not supported; walls are static"
                }
                "style" => {
                    writer.sheet(node)?;
                    continue;
                }
                _ => continue,
            };
            return Err(writer.refused(node, reason));
        }
        writer.comparisons_each = writer.sheet.cost(most_beside);
        Ok(writer)
    }

    fn sheet(&mut self, node: Node<'a, 'input>) -> Result<(), MapError> {
        let kind = own(node, "type").unwrap_or_default().trim();
        if !(kind.is_empty() || kind.eq_ignore_ascii_case("text/css")) {
            return Ok(());
        }
        if let Some(media) = own(node, "media").map(str::trim)
            && !["", "all", "screen"].contains(&media)
        {
            return Err(self.refused(node, format!("media={:?} is not applied; leave it out", short(media))));
        }
        let text: String = node.children().filter(Node::is_text).filter_map(|child| child.text()).collect();
        self.sheet.add(&text).map_err(|why| self.refused(node, why))
    }
}
