//! Reports about a drawing: why it was refused, or what was repaired.

use super::{MAX_SVG_BYTES, Map};

/// Position of an element in its file. Displays as `<path> id="fold" at line 7`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// Tag name.
    pub element: String,
    pub id: Option<String>,
    /// Line of the file, from 1.
    pub line: u32,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "<{}>", self.element)?;
        if let Some(id) = &self.id {
            write!(f, " id={id:?}")?;
        }
        write!(f, " at line {}", self.line)
    }
}

/// A change that turned an element into a wall, or left it out.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Repair {
    pub place: Place,
    pub kind: RepairKind,
}

impl std::fmt::Display for Repair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.kind)
    }
}

/// An element that an older reader read otherwise.
#[derive(Clone, Debug)]
pub struct Newer {
    /// The first version of the reader that reads it as today.
    pub since: u32,
    pub place: Place,
    /// How it was read before.
    pub what: &'static str,
}

/// What was changed, or may not be what was meant.
#[derive(Clone, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum RepairKind {
    /// Two edges of a filled outline cross.
    #[error("its outline crosses itself; the fill rule decides what is wall")]
    Crosses,
    /// Two edges of a filled outline that are not neighbours share a point; no edges cross.
    #[error("its outline touches itself; the fill rule decides what is wall")]
    Touches,
    /// A filled outline does not end at its start.
    #[error("its outline is open; closed with a straight line")]
    Open,
    /// A visible shape has no area and no stroke.
    #[error("it draws nothing, having neither area nor stroke; left out")]
    Nothing,
    /// Nothing of a wall is in the workspace.
    #[error("it lies wholly outside the workspace; left out")]
    Outside,
    /// A wall is hardly wider than nothing.
    #[error("it is thinner than 0.1 mm")]
    Hairline,
    /// An absolute length.
    #[error("{name}={value:?} is taken as millimetres of the table, whatever the drawing's scale")]
    Absolute { name: String, value: String },
    /// A value that browsers ignore, too.
    #[error("{name}={value:?} is no value; ignored, as in browsers")]
    Invalid { name: String, value: String },
    /// A gradient or pattern that does not exist.
    #[error("there is no gradient or pattern \"{id}\" to paint it with")]
    NoPaint { id: String },
    /// The page has another size than the workspace.
    #[error(
        "{name} of the page is {page_mm} mm, but {own_mm} in viewBox, which counts: one unit is 1 mm; scale the drawing \
         if it was drawn in other units"
    )]
    Page { name: &'static str, page_mm: u32, own_mm: u32 },
}

/// Why a map was refused.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// No shipped map has this name.
    #[error("map: there is no map named {name:?}; there are {known}", known = Map::shipped_names().join(", "))]
    Unknown { name: String },
    /// The file could not be read.
    #[error("map: {path}: {error}")]
    Io { path: String, error: std::io::Error },
    /// The file is larger than [`MAX_SVG_BYTES`].
    #[error("map: the file has {bytes} bytes, the limit is {MAX_SVG_BYTES}")]
    TooLarge { bytes: usize },
    /// The library is full.
    #[error("map: {max} maps are already added, remove one first")]
    TooMany { max: usize },
    /// A file of another kind.
    #[error("map: this is not an SVG")]
    NotSvg,
    /// Not well-formed, or not SVG.
    #[error("map: this is not a readable SVG: {0}")]
    Svg(String),
    /// The root has no usable `viewBox`, which defines the workspace.
    #[error("map: viewBox {value:?}: {reason}")]
    ViewBox {
        /// The attribute as written.
        value: String,
        reason: String,
    },
    /// The root names an unknown positioner.
    #[error("map: data-positioner {value:?}: it must be \"arm\" or \"planar-stage\"")]
    Positioner {
        /// The attribute as written.
        value: String,
    },
    /// An element that cannot become a wall, or costs too much.
    #[error("map: {place}: {reason}")]
    Element {
        place: Place,
        /// The reason and a remedy.
        reason: String,
    },
    /// The walls leave no space for the bead.
    #[error(
        "map: the walls leave no free space in the workspace{}",
        .cause.as_ref().map(|cause| format!(": {cause} covers all of it; remove it if it is a background")).unwrap_or_default()
    )]
    NoFreeSpace {
        /// The element that covers it alone.
        cause: Option<Place>,
    },
    /// An older reader has read the drawing otherwise.
    #[error(
        "map: {place}: this drawing was kept by an older Ferry, which read it otherwise: {what}; open the drawing anew"
    )]
    Older { place: Place, what: &'static str },
    /// A reader of another Ferry.
    #[error("map: its reader is {found}, this Ferry has 1 to {}; a newer Ferry has kept it", super::READER)]
    Reader { found: u32 },
}
