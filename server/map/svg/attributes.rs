//! Checks of attributes before usvg reads them.

use usvg::roxmltree::{Attribute, Node};

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
const XML: &str = "http://www.w3.org/XML/1998/namespace";

/// Larger numbers are mistakes, and make usvg divide an arc into billions of pieces.
const MAX_NUMBER: f64 = 1e6;
/// Every class of an element is compared with every class of a style sheet.
const MAX_CLASS_BYTES: usize = 100;
/// For values other than coordinates: children inherit them and parse them again.
const MAX_VALUE_BYTES: usize = 10_000;

const SIZES: [&str; 13] = ["x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "x1", "y1", "x2", "y2"];
const STROKES: [&str; 3] = ["stroke-width", "stroke-miterlimit", "stroke-dashoffset"];
const UNITS: [&str; 8] = ["", "px", "mm", "cm", "in", "pt", "pc", "%"];

/// Whether usvg processes an element.
pub(super) fn is_svg(node: Node<'_, '_>) -> bool {
    node.is_element() && matches!(node.tag_name().namespace(), None | Some(SVG))
}

/// The attributes that usvg reads.
fn known<'a, 'input>(node: Node<'a, 'input>) -> impl Iterator<Item = Attribute<'a, 'input>> {
    node.attributes().filter(|a| matches!(a.namespace(), None | Some(SVG | XLINK | XML)))
}

pub(super) fn id<'a, 'input>(node: Node<'a, 'input>) -> Option<Attribute<'a, 'input>> {
    known(node).find(|a| a.name() == "id")
}

pub(super) fn href<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    let hrefs = || known(node).filter(|a| a.name() == "href");
    hrefs().find(|a| a.namespace().is_none()).or_else(|| hrefs().next()).map(|a| a.value())
}

/// Whether an element and its children are not drawn at their own position.
pub(super) fn hidden(node: Node<'_, '_>) -> bool {
    let declared = declarations(node.attribute("style").unwrap_or_default()).any(|d| d == ("display", "none"));
    let tag = node.tag_name().name();
    declared || node.attribute("display") == Some("none") || ["defs", "symbol", "switch"].contains(&tag)
}

/// A value shortened for an error message.
pub(super) fn short(value: &str) -> String {
    const SHOWN: usize = 80;
    let mut short: String = value.chars().take(SHOWN).collect();
    if short.len() < value.len() {
        short.push('…');
    }
    short
}

/// Refuses values that usvg would silently ignore or could not handle. Returns the number of coordinates.
pub(super) fn check(node: Node<'_, '_>) -> Result<usize, String> {
    let mut coordinates = 0;
    for attribute in known(node) {
        let (name, value) = (attribute.name(), attribute.value());
        let wrong = |what: &str| Err(format!("{name}={:?} {what}", short(value)));
        match name {
            "class" if value.len() > MAX_CLASS_BYTES => return wrong("has too many classes"),
            _ if value.len() > MAX_VALUE_BYTES && !matches!(name, "d" | "points") => return wrong("is too long"),
            "style" => {
                for (property, value) in declarations(value) {
                    check_property(property, value)?;
                }
            }
            "d" | "points" | "transform" | "viewBox" => {
                let numbers = numbers(value);
                if let Some(number) = numbers.iter().find(|n| n.is_nan() || n.abs() > MAX_NUMBER) {
                    return Err(format!("{name} has the number {number:e}, the limit is ±{MAX_NUMBER:e}"));
                }
                if matches!(name, "d" | "points") {
                    coordinates += numbers.len();
                }
                if name == "d" {
                    check_path(value)?;
                }
            }
            // The root's size is ignored: its viewBox is in millimetres.
            "width" | "height" if node.parent_element().is_none() => {}
            _ => check_property(name, value)?,
        }
    }
    if node.tag_name().name() == "style" {
        for text in node.children().filter_map(|child| child.text()) {
            for (property, value) in declarations(text) {
                check_property(property, value)?;
            }
        }
    }
    Ok(coordinates)
}

fn check_property(name: &str, value: &str) -> Result<(), String> {
    let wrong = |what: &str| Err(format!("{name}={:?} {what}", short(value)));
    let has_length = SIZES.contains(&name) || STROKES.contains(&name);
    if has_length && !is_length(value.trim_end_matches("!important").trim()) {
        return wrong("is not a number within ±1e6, plain or with px, mm, cm, in, pt, pc or %");
    }
    if name.contains("stroke-dasharray") && !value.trim().starts_with("none") {
        return wrong("is not drawn; draw each dash as a separate wall");
    }
    if name.contains("vector-effect") && !value.trim().starts_with("none") {
        return wrong("is not applied; give the stroke its width in mm");
    }
    Ok(())
}

fn is_length(value: &str) -> bool {
    let unit_at = value.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%').len();
    let (number, unit) = value.split_at(unit_at);
    let in_range = number.parse().is_ok_and(|n: f64| n.abs() <= MAX_NUMBER);
    matches!(value, "auto" | "inherit") || in_range && UNITS.contains(&unit)
}

/// usvg draws a path only up to its first error, which would give half a wall.
fn check_path(value: &str) -> Result<(), String> {
    let unexpected =
        value.chars().find(|c| !c.is_ascii_whitespace() && !"MmLlHhVvCcSsQqTtAaZz0123456789+-.,eE".contains(*c));
    if value.trim() == "none" {
        Ok(())
    } else if let Some(unexpected) = unexpected {
        Err(format!("d has a {unexpected:?}, which is not allowed in a path"))
    } else {
        kurbo::BezPath::from_svg(value).map(drop).map_err(|error| format!("d={:?} is broken: {error}", short(value)))
    }
}

/// The `name: value` pairs of a style, or of all rules of a style sheet.
fn declarations(style: &str) -> impl Iterator<Item = (&str, &str)> {
    style
        .split([';', '{', '}'])
        .filter_map(|pair| pair.split_once(':'))
        .map(|(name, value)| (name.trim(), value.trim()))
}

/// The numbers of an SVG list: `10-5.5.3e2` is 10, −5.5, 30.
fn numbers(value: &str) -> Vec<f64> {
    let (mut numbers, mut number, mut has_point, mut has_exponent) = (Vec::new(), String::new(), false, false);
    let mut last = ' ';
    for c in value.chars().chain([' ']) {
        let goes_on = match c {
            '0'..='9' => true,
            '.' => !has_point && !has_exponent,
            'e' | 'E' => !has_exponent && (last.is_ascii_digit() || last == '.'),
            '+' | '-' => matches!(last, 'e' | 'E') && has_exponent,
            _ => false,
        };
        if !goes_on {
            if number.contains(|c: char| c.is_ascii_digit()) {
                numbers.push(number.parse().unwrap_or(f64::NAN));
            }
            number.clear();
            (has_point, has_exponent) = (false, false);
        }
        if goes_on || matches!(c, '+' | '-' | '.') {
            number.push(c);
            has_point |= c == '.';
            has_exponent |= matches!(c, 'e' | 'E');
        }
        last = c;
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_numbers_as_svg_writes_them() {
        assert_eq!(numbers("M10-5.5.3e2,-1e-2+7 .5."), [10.0, -5.5, 30.0, -0.01, 7.0, 0.5]);
        assert_eq!(numbers("matrix(1 0 0 -1 5 1e400)")[5], f64::INFINITY);
        assert!(numbers("translate( )").is_empty());
    }

    #[test]
    fn accepts_lengths_with_known_units_only() {
        for good in ["10", "-1.5e2mm", "50%", ".5in", "auto"] {
            assert!(is_length(good), "{good}");
        }
        for bad in ["", "ten", "1em", "1e7", "nan", "inf", "1 mm", "%"] {
            assert!(!is_length(bad), "{bad}");
        }
    }
}
