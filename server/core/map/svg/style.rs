//! What an element's attributes and declarations say of it, as a browser computes it. What Ferry does not draw is a *trouble*,
//! which matters only if something is drawn with it.

mod declare;
mod lengths;
mod paint;
mod transform;

use std::collections::BTreeMap;

pub use lengths::{has_bare_dot, is_absolute, size};
pub use paint::{Paint, decoded_fragment};

/// Properties that are also attributes, besides those of [`SIZES`].
pub const PRESENTATION: [&str; 25] = [
    "clip-path",
    "clip-rule",
    "color",
    "display",
    "fill",
    "fill-opacity",
    "fill-rule",
    "filter",
    "marker-end",
    "marker-mid",
    "marker-start",
    "mask",
    "opacity",
    "overflow",
    "stroke",
    "stroke-dasharray",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-miterlimit",
    "stroke-opacity",
    "stroke-width",
    "transform",
    "transform-origin",
    "vector-effect",
    "visibility",
];
/// Properties of geometry.
pub const SIZES: [&str; 10] = ["x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "d"];
/// Properties that move or cut shapes if they have another value than this.
const UNSUPPORTED: [(&str, &[&str]); 19] = [
    ("translate", &["none"]),
    ("rotate", &["none"]),
    ("scale", &["none", "1"]),
    ("perspective", &["none"]),
    ("offset", &["none"]),
    ("offset-path", &["none"]),
    ("zoom", &["normal", "1", "100%"]),
    ("mask", &["none"]),
    ("mask-image", &["none"]),
    ("mask-border", &["none"]),
    ("mask-border-source", &["none"]),
    ("-webkit-mask", &["none"]),
    ("-webkit-mask-image", &["none"]),
    ("-webkit-mask-box-image", &["none"]),
    ("-webkit-mask-box-image-source", &["none"]),
    ("filter", &["none"]),
    ("content-visibility", &["visible", "auto"]),
    ("animation", &["none"]),
    ("animation-name", &["none"]),
];

/// Where a value is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    Attribute,
    Css,
}

/// What is wrong with a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// Browsers ignore it, too.
    Invalid,
    /// A browser may understand it.
    Refused(String),
}

/// A computed style. Lengths are written as usvg reads them.
#[derive(Clone, Debug)]
pub struct Style {
    pub inherited: Inherited,
    pub is_displayed: bool,
    pub is_opaque: bool,
    pub is_overflow_visible: bool,
    /// An attribute `transform`, empty without one.
    pub transform: String,
    origin: Option<(String, Origin)>,
    /// The id of a `clipPath`.
    pub clip: Option<String>,
    /// Sizes that are declared: they count before attributes.
    pub sizes: Vec<(&'static str, String)>,
    /// Why nothing can be drawn with it, by property.
    troubles: BTreeMap<String, String>,
    pub has_vector_effect: bool,
}

/// The part that children inherit.
#[derive(Clone, Debug)]
pub struct Inherited {
    pub is_visible: bool,
    is_color_seen: bool,
    pub fill: Paint,
    pub stroke: Paint,
    is_fill_opaque: bool,
    is_stroke_opaque: bool,
    pub fill_rule: String,
    pub clip_rule: String,
    pub stroke_width: String,
    pub linecap: String,
    pub linejoin: String,
    pub miterlimit: String,
    /// The dashes, if there are gaps between them.
    pub dashes: Option<String>,
    /// Ids of markers.
    pub markers: [Option<String>; 3],
}

impl Default for Inherited {
    fn default() -> Self {
        Self {
            is_visible: true,
            is_color_seen: true,
            fill: Paint::Colour { is_seen: true },
            stroke: Paint::None,
            is_fill_opaque: true,
            is_stroke_opaque: true,
            fill_rule: "nonzero".to_owned(),
            clip_rule: "nonzero".to_owned(),
            stroke_width: "1".to_owned(),
            linecap: "butt".to_owned(),
            linejoin: "miter".to_owned(),
            miterlimit: "4".to_owned(),
            dashes: None,
            markers: [const { None }; 3],
        }
    }
}

impl Inherited {
    /// Whether a shape's area or outline is painted. `exists` says whether a gradient or pattern paints.
    pub fn is_seen(&self, paint: &Paint, exists: &impl Fn(&str) -> bool) -> bool {
        match paint {
            Paint::None => false,
            Paint::Colour { is_seen } => *is_seen,
            Paint::Current => self.is_color_seen,
            Paint::Server { id, .. } if exists(id) => true,
            Paint::Server { fallback, .. } => fallback.as_ref().is_some_and(|paint| self.is_seen(paint, exists)),
        }
    }

    /// Whether a shape is painted, but with nothing that can be seen.
    pub fn is_transparent(&self, has_area: bool) -> bool {
        let is_clear = |paint: &Paint, is_opaque: bool| match paint {
            Paint::None | Paint::Server { .. } => false,
            Paint::Colour { is_seen } => !(is_opaque && *is_seen),
            Paint::Current => !(is_opaque && self.is_color_seen),
        };
        has_area && is_clear(&self.fill, self.is_fill_opaque) || is_clear(&self.stroke, self.is_stroke_opaque)
    }

    pub fn is_filled(&self, exists: &impl Fn(&str) -> bool) -> bool {
        self.is_fill_opaque && self.is_seen(&self.fill, exists)
    }

    pub fn is_stroked(&self, exists: &impl Fn(&str) -> bool) -> bool {
        self.is_stroke_opaque && self.is_seen(&self.stroke, exists)
    }
}

impl Style {
    /// Why nothing can be drawn with it.
    pub fn trouble(&self) -> Option<String> {
        self.troubles.values().next().cloned()
    }

    pub fn add_trouble(&mut self, name: &str, why: &str) {
        self.troubles.insert(name.to_owned(), why.to_owned());
    }

    /// That of a child on which nothing is written.
    pub fn below(parent: &Inherited) -> Self {
        Self {
            inherited: parent.clone(),
            is_displayed: true,
            is_opaque: true,
            is_overflow_visible: false,
            transform: String::new(),
            origin: None,
            clip: None,
            sizes: Vec::new(),
            troubles: BTreeMap::new(),
            has_vector_effect: false,
        }
    }
}
