//! Paint, colours and references.

use cssparser::{Parser, Token};
use cssparser_color::Color;
use percent_encoding::percent_decode_str;

use super::Wrong;
use crate::map::svg::short;

/// What a shape is painted with.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    None,
    /// A colour that can be seen, or not.
    Colour {
        is_seen: bool,
    },
    /// That of the property `color`.
    Current,
    /// A gradient or pattern, and what counts without one of this id.
    Server {
        id: String,
        fallback: Option<Box<Self>>,
    },
}

/// The id in `url(#id)`; `None` for `none`.
pub(super) fn reference(value: &str) -> Result<Option<String>, Wrong> {
    let mut input = Parser::new(value);
    let parsed = match input.next() {
        Ok(Token::Ident(word)) if word.eq_ignore_ascii_case("none") => None,
        Ok(Token::UnquotedUrl(_) | Token::Function(_)) => {
            let url = Parser::new(value).expect_url().map_err(|_| Wrong::Invalid)?;
            Some(fragment(&url)?)
        }
        _ => return Err(Wrong::Invalid),
    };
    Ok(parsed)
}

fn fragment(url: &str) -> Result<String, Wrong> {
    let id = decoded_fragment(url.trim());
    id.ok_or_else(|| Wrong::Refused(format!("it refers to another file, {:?}; copy its content here", short(url))))
}

/// The id in `#id`, where `%20` is a space.
pub fn decoded_fragment(url: &str) -> Option<String> {
    Some(percent_decode_str(url.strip_prefix('#')?).decode_utf8().ok()?.into_owned())
}

pub(super) fn paint(value: &str) -> Result<Paint, Wrong> {
    let mut input = Parser::new(value);
    if let Ok(url) = input.try_parse(Parser::expect_url) {
        let id = fragment(&url)?;
        let from = input.position();
        while input.next().is_ok() {}
        let rest = input.slice_from(from).trim();
        let fallback = (!rest.is_empty()).then(|| plain_paint(rest)).transpose()?.map(Box::new);
        return Ok(Paint::Server { id, fallback });
    }
    plain_paint(value)
}

/// None, or a colour.
fn plain_paint(value: &str) -> Result<Paint, Wrong> {
    let mut input = Parser::new(value);
    if input.try_parse(|input| input.expect_ident_matching("none")).is_ok() {
        return input.expect_exhausted().map(|()| Paint::None).map_err(|_| Wrong::Invalid);
    }
    let colour = input.try_parse(Color::parse);
    match (colour, input.is_exhausted()) {
        (Ok(Color::CurrentColor), true) => Ok(Paint::Current),
        (Ok(colour), true) => Ok(Paint::Colour { is_seen: alpha(&colour) > 0.0 }),
        _ if value.contains('(') || value.to_ascii_lowercase().starts_with("context-") => {
            Err(Wrong::Refused(format!("{:?} is a colour that Ferry does not know; write #000 or none", short(value))))
        }
        _ if is_system_colour(value) => Ok(Paint::Colour { is_seen: true }),
        _ => Err(Wrong::Invalid),
    }
}

fn alpha(colour: &Color) -> f32 {
    let alpha = match colour {
        Color::CurrentColor => Some(1.0),
        Color::Rgba(colour) => Some(colour.alpha),
        Color::Hsl(colour) => colour.alpha,
        Color::Hwb(colour) => colour.alpha,
        Color::Lab(colour) => colour.alpha,
        Color::Lch(colour) => colour.alpha,
        Color::Oklab(colour) => colour.alpha,
        Color::Oklch(colour) => colour.alpha,
        Color::ColorFunction(colour) => colour.alpha,
    };
    alpha.unwrap_or(0.0)
}

/// The names of CSS Color 4, and those of CSS 2 that drawing programs wrote.
fn is_system_colour(value: &str) -> bool {
    const NAMES: [&str; 23] = [
        "accentcolor",
        "accentcolortext",
        "activetext",
        "buttonborder",
        "buttonface",
        "buttontext",
        "canvas",
        "canvastext",
        "field",
        "fieldtext",
        "graytext",
        "highlight",
        "highlighttext",
        "linktext",
        "mark",
        "marktext",
        "selecteditem",
        "selecteditemtext",
        "visitedtext",
        "window",
        "windowframe",
        "windowtext",
        "menutext",
    ];
    NAMES.contains(&value.to_ascii_lowercase().as_str())
}
