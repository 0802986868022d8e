//! Declarations: which values a style has after each.

use cssparser::{Delimiter, ParseError, Parser};

use super::lengths::{MAX_NUMBER, dashes, is_opaque, size};
use super::paint::{Paint, paint, reference};
use super::transform::{matrix, transform};
use super::{Inherited, Origin, PRESENTATION, SIZES, Style, UNSUPPORTED, Wrong};
use crate::map::svg::short;

/// Properties that browsers know with the prefix `-webkit-`, too.
const PREFIXED: [&str; 7] =
    ["transform", "transform-origin", "clip-path", "filter", "opacity", "animation", "animation-name"];
/// Words of the property `display`.
const DISPLAYS: [&str; 27] = [
    "none",
    "inline",
    "block",
    "contents",
    "flow",
    "flow-root",
    "inline-block",
    "list-item",
    "flex",
    "inline-flex",
    "grid",
    "inline-grid",
    "table",
    "inline-table",
    "table-row",
    "table-cell",
    "table-column",
    "table-caption",
    "table-row-group",
    "table-header-group",
    "table-footer-group",
    "table-column-group",
    "ruby",
    "ruby-text",
    "math",
    "-webkit-box",
    "-webkit-inline-box",
];

impl Style {
    /// Carries a declaration out. `name` is in lower case.
    ///
    /// # Errors
    /// [`Wrong::Invalid`]: the value before counts. What is refused is kept as a trouble instead.
    pub fn declare(&mut self, name: &str, value: &str, origin: Origin, parent: &Inherited) -> Result<(), Wrong> {
        let name = name.strip_prefix("-webkit-").filter(|name| PREFIXED.contains(name)).unwrap_or(name);
        match self.try_declare(name, value.trim(), origin, parent) {
            Err(Wrong::Refused(why)) => {
                self.add_trouble(name, &why);
                Ok(())
            }
            Ok(()) => {
                self.troubles.remove(name);
                Ok(())
            }
            invalid => invalid,
        }
    }

    fn try_declare(&mut self, name: &str, value: &str, origin: Origin, parent: &Inherited) -> Result<(), Wrong> {
        let refused = |what: &str| Err(Wrong::Refused(format!("{name}={:?} {what}", short(value))));
        let value = if ["fill", "stroke", "color"].contains(&name) { light(value) } else { value };
        let lower = value.to_ascii_lowercase();
        if name == "all" {
            return refused("is not applied; leave it out");
        }
        if name == "marker" && origin == Origin::Css {
            for one in ["marker-start", "marker-mid", "marker-end"] {
                self.try_declare(one, value, origin, parent)?;
            }
            return Ok(());
        }
        let matters = PRESENTATION.contains(&name)
            || origin == Origin::Css && (SIZES.contains(&name) || name == "transform-box")
            || UNSUPPORTED.iter().any(|(one, _)| *one == name);
        if !matters {
            return Ok(());
        }
        match lower.as_str() {
            "inherit" => return self.inherit(name, parent),
            "initial" | "unset" if self.reset(name) => return Ok(()),
            "initial" => return self.inherit(name, &Inherited::default()),
            "unset" => return self.inherit(name, parent),
            "revert" | "revert-layer" => return refused("is not applied; leave it out"),
            _ => {}
        }
        const COMPUTED: [&str; 9] = ["var(", "calc(", "env(", "min(", "max(", "clamp(", "attr(", "if(", "light-dark("];
        if COMPUTED.iter().any(|function| lower.contains(function)) {
            return refused("is computed; write the value itself");
        }
        let keyword = |known: &[&str]| known.contains(&lower.as_str()).then(|| lower.clone()).ok_or(Wrong::Invalid);
        let Self { inherited, .. } = self;
        match name {
            "display" if lower == "contents" => return refused("is not applied; use a group"),
            "display" => {
                if !lower.split_ascii_whitespace().all(|word| DISPLAYS.contains(&word)) || lower.is_empty() {
                    return Err(Wrong::Invalid);
                }
                self.is_displayed = lower != "none";
            }
            "visibility" => inherited.is_visible = keyword(&["visible", "hidden", "collapse"])? == "visible",
            "opacity" => self.is_opaque = is_opaque(&lower)?,
            "fill-opacity" => inherited.is_fill_opaque = is_opaque(&lower)?,
            "stroke-opacity" => inherited.is_stroke_opaque = is_opaque(&lower)?,
            "color" => match paint(value)? {
                Paint::Colour { is_seen } => inherited.is_color_seen = is_seen,
                Paint::Current => inherited.is_color_seen = parent.is_color_seen,
                Paint::None | Paint::Server { .. } => return Err(Wrong::Invalid),
            },
            "fill" => inherited.fill = paint(value)?,
            "stroke" => inherited.stroke = paint(value)?,
            "fill-rule" => inherited.fill_rule = keyword(&["nonzero", "evenodd"])?,
            "clip-rule" => inherited.clip_rule = keyword(&["nonzero", "evenodd"])?,
            "stroke-linecap" => inherited.linecap = keyword(&["butt", "round", "square"])?,
            "stroke-linejoin" if ["miter-clip", "arcs"].contains(&lower.as_str()) => {
                return refused("is not drawn; use miter, round or bevel");
            }
            "stroke-linejoin" => inherited.linejoin = keyword(&["miter", "round", "bevel"])?,
            "stroke-miterlimit" => {
                let limit: f64 = lower.parse().map_err(|_| Wrong::Invalid)?;
                if !(1.0..=MAX_NUMBER).contains(&limit) {
                    return refused("is not within 1 to 1e6");
                }
                inherited.miterlimit = lower;
            }
            "stroke-width" => {
                let width = size(value, Origin::Attribute).map_err(|wrong| match wrong {
                    // A word, or nothing.
                    Wrong::Refused(_) if !lower.contains(|c: char| c.is_ascii_digit()) => Wrong::Invalid,
                    Wrong::Refused(why) => Wrong::Refused(format!("{name}={:?} {why}", short(value))),
                    Wrong::Invalid => Wrong::Invalid,
                })?;
                if width == "auto" || width.starts_with('-') && width != "-0" {
                    return Err(Wrong::Invalid);
                }
                inherited.stroke_width = width;
            }
            "stroke-dasharray" => inherited.dashes = dashes(&lower)?.then(|| short(value)),
            "marker-start" | "marker-mid" | "marker-end" => {
                let end = usize::from(name != "marker-start") + usize::from(name == "marker-end");
                inherited.markers[end] = reference(value)?;
            }
            "vector-effect" => self.has_vector_effect = lower != "none",
            "overflow" => self.is_overflow_visible = lower == "visible" || lower == "auto",
            "clip-path" => match reference(value) {
                Ok(clip) => self.clip = clip,
                Err(_) => return refused("is not applied; draw the shape itself"),
            },
            "transform" => self.transform = transform(value, origin)?,
            "transform-origin" => self.origin = Some((lower, origin)),
            "transform-box" => {
                if lower != "view-box" {
                    return refused("is not applied; write the transform as an attribute, with its centre in numbers");
                }
            }
            "d" => {
                let path = lower.strip_prefix("path(").and_then(|_| value[5..].strip_suffix(')')).map(str::trim);
                let quoted = |quote: char| path?.strip_prefix(quote)?.strip_suffix(quote);
                match (lower.as_str(), quoted('"').or_else(|| quoted('\''))) {
                    ("none", _) => self.sizes.push(("d", "none".to_owned())),
                    (_, Some(path)) => self.sizes.push(("d", path.to_owned())),
                    _ => return refused("is not understood; use the attribute d"),
                }
            }
            _ if SIZES.contains(&name) => {
                let known = SIZES.iter().find(|one| **one == name).expect("it is one of them");
                match size(value, origin) {
                    Ok(size) => self.sizes.push((known, size)),
                    Err(Wrong::Refused(why)) => return refused(&why),
                    Err(Wrong::Invalid) => return Err(Wrong::Invalid),
                }
            }
            _ => {
                let is_idle = UNSUPPORTED.iter().any(|(one, idle)| *one == name && idle.contains(&lower.as_str()));
                // Browsers ignore words that they do not know, but not the words of these properties.
                if !is_idle {
                    return refused("is not applied; draw the shape itself");
                }
            }
        }
        Ok(())
    }

    /// Takes a property over. Those that are not inherited by themselves are not taken over.
    fn inherit(&mut self, name: &str, from: &Inherited) -> Result<(), Wrong> {
        let Self { inherited, .. } = self;
        match name {
            "visibility" => inherited.is_visible = from.is_visible,
            "color" => inherited.is_color_seen = from.is_color_seen,
            "fill" => inherited.fill = from.fill.clone(),
            "stroke" => inherited.stroke = from.stroke.clone(),
            "fill-opacity" => inherited.is_fill_opaque = from.is_fill_opaque,
            "stroke-opacity" => inherited.is_stroke_opaque = from.is_stroke_opaque,
            "fill-rule" => inherited.fill_rule.clone_from(&from.fill_rule),
            "clip-rule" => inherited.clip_rule.clone_from(&from.clip_rule),
            "stroke-width" => inherited.stroke_width.clone_from(&from.stroke_width),
            "stroke-linecap" => inherited.linecap.clone_from(&from.linecap),
            "stroke-linejoin" => inherited.linejoin.clone_from(&from.linejoin),
            "stroke-miterlimit" => inherited.miterlimit.clone_from(&from.miterlimit),
            "stroke-dasharray" => inherited.dashes.clone_from(&from.dashes),
            "marker-start" | "marker-mid" | "marker-end" => {
                let end = usize::from(name != "marker-start") + usize::from(name == "marker-end");
                inherited.markers[end].clone_from(&from.markers[end]);
            }
            _ => return Err(Wrong::Refused(format!("{name} takes a value over; write the value itself"))),
        }
        Ok(())
    }

    /// Gives a property that is not inherited its value of the beginning; whether it is one.
    fn reset(&mut self, name: &str) -> bool {
        match name {
            "display" => self.is_displayed = true,
            "opacity" => self.is_opaque = true,
            "overflow" => self.is_overflow_visible = false,
            "transform" => self.transform.clear(),
            "transform-origin" => self.origin = None,
            "clip-path" => self.clip = None,
            "vector-effect" => self.has_vector_effect = false,
            "transform-box" => {}
            _ if UNSUPPORTED.iter().any(|(one, _)| *one == name) => {}
            _ => return false,
        }
        true
    }

    /// Makes one matrix of the transform and its origin, when all is declared.
    pub fn finish(&mut self) {
        if self.transform.is_empty() {
            self.troubles.remove("transform-box");
            return;
        }
        if let Some((origin, written)) = &self.origin {
            let number = |part: &str| size(part, *written).ok()?.parse::<f64>().ok();
            let parts: Vec<_> = origin.split_ascii_whitespace().map(number).collect();
            match parts.as_slice() {
                [Some(x), Some(y)] | [Some(x), Some(y), Some(_)] => {
                    self.transform = format!("translate({x} {y}) {} translate({} {})", self.transform, -x, -y);
                }
                _ => {
                    let why = format!("transform-origin={:?} is not applied; give it in px", short(origin));
                    self.add_trouble("transform-origin", &why);
                }
            }
        }
        match matrix(&self.transform) {
            Some(matrix) => self.transform = matrix,
            None => self.add_trouble("transform", "transform: together its numbers are too large"),
        }
    }
}

/// What a browser shows that prefers light colours.
fn light(value: &str) -> &str {
    let mut input = Parser::new(value);
    if input.expect_function_matching("light-dark").is_err() {
        return value;
    }
    let first = input.parse_nested_block(|input| -> Result<&str, ParseError<()>> {
        let first = input.parse_until_before(Delimiter::Comma, |input| {
            let from = input.position();
            while input.next().is_ok() {}
            Ok(input.slice_from(from))
        });
        while input.next().is_ok() {}
        first
    });
    first.map_or(value, str::trim)
}
