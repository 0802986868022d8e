//! Transforms, as attributes and in CSS.

use std::fmt::Write;

use cssparser::{Parser, Token};
use svgtypes::TransformListParser;

use super::lengths::{MAX_NUMBER, has_bare_dot, size};
use super::{Origin, Wrong};
use crate::map::svg::short;

/// A transform as an attribute.
pub(super) fn transform(value: &str, origin: Origin) -> Result<String, Wrong> {
    let refused = |why: &str| Wrong::Refused(format!("transform={:?} {why}", short(value)));
    if value.eq_ignore_ascii_case("none") {
        return Ok(String::new());
    }
    let text = match origin {
        Origin::Attribute => value.to_owned(),
        Origin::Css => css_transform(value)
            .ok_or_else(|| refused("is not understood; write it as an attribute, such as transform=\"rotate(90)\""))?,
    };
    if has_bare_dot(value) {
        return Err(refused("ends a number with a dot, which browsers do not read"));
    }
    for token in TransformListParser::from(text.as_str()) {
        token.map_err(|error| refused(&format!("is broken: {error}")))?;
    }
    let numbers = text.split(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)));
    let mut numbers = numbers.filter_map(|part| part.parse::<f64>().ok());
    if let Some(number) = numbers.find(|number| number.abs() > MAX_NUMBER) {
        return Err(refused(&format!("has the number {number:e}, the limit is ±{MAX_NUMBER:e}")));
    }
    Ok(text)
}

/// A list of transforms as one, if its numbers are not too large.
pub(super) fn matrix(list: &str) -> Option<String> {
    let svgtypes::Transform { a, b, c, d, e, f } = list.parse().ok()?;
    let is_small = [a, b, c, d, e, f].iter().all(|number| number.abs() <= MAX_NUMBER * MAX_NUMBER);
    is_small.then(|| format!("matrix({a} {b} {c} {d} {e} {f})"))
}

/// The functions of CSS that have the same effect as those of the attribute.
fn css_transform(value: &str) -> Option<String> {
    let (mut input, mut text) = (Parser::new(value), String::new());
    while !input.is_exhausted() {
        let name = input.expect_function().ok()?.to_ascii_lowercase();
        let arguments = input.parse_nested_block(|input| {
            input.parse_comma_separated(|input| -> Result<(f32, String), cssparser::ParseError<()>> {
                match input.next()? {
                    Token::Number { value, .. } => Ok((*value, String::new())),
                    Token::Dimension { value, unit, .. } => Ok((*value, unit.to_ascii_lowercase())),
                    _ => Err(cssparser::ParseError::unexpected_token()),
                }
            })
        });
        let arguments = arguments.ok()?;
        let length = |i: usize| -> Option<f64> {
            let (number, unit) = arguments.get(i)?;
            size(&format!("{number}{unit}"), Origin::Css).ok()?.parse().ok()
        };
        let number =
            |i: usize| arguments.get(i).filter(|(_, unit)| unit.is_empty()).map(|(number, _)| f64::from(*number));
        let degrees = |i: usize| {
            let (angle, unit) = arguments.get(i)?;
            let degrees = match unit.as_str() {
                "deg" => 1.0,
                "grad" => 0.9,
                "rad" => 180.0 / std::f64::consts::PI,
                "turn" => 360.0,
                "" if *angle == 0.0 => 1.0,
                _ => return None,
            };
            Some(f64::from(*angle) * degrees)
        };
        let count = arguments.len();
        let written = match (name.as_str(), count) {
            ("translate", 1) => format!("translate({} 0)", length(0)?),
            ("translate", 2) => format!("translate({} {})", length(0)?, length(1)?),
            ("translatex", 1) => format!("translate({} 0)", length(0)?),
            ("translatey", 1) => format!("translate(0 {})", length(0)?),
            ("scale", 1) => format!("scale({})", number(0)?),
            ("scale", 2) => format!("scale({} {})", number(0)?, number(1)?),
            ("scalex", 1) => format!("scale({} 1)", number(0)?),
            ("scaley", 1) => format!("scale(1 {})", number(0)?),
            ("rotate" | "rotatez", 1) => format!("rotate({})", degrees(0)?),
            ("skewx" | "skew", 1) => format!("skewX({})", degrees(0)?),
            ("skewy", 1) => format!("skewY({})", degrees(0)?),
            ("skew", 2) => {
                let tan = |i: usize| Some(degrees(i)?.to_radians().tan());
                format!("matrix(1 {} {} 1 0 0)", tan(1)?, tan(0)?)
            }
            ("matrix", 6) => {
                let numbers: Option<Vec<String>> = (0..6).map(|i| Some(number(i)?.to_string())).collect();
                format!("matrix({})", numbers?.join(" "))
            }
            _ => return None,
        };
        let _ = write!(text, "{}{written}", if text.is_empty() { "" } else { " " });
    }
    (!text.is_empty()).then_some(text)
}
