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

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
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
        reason: &'static str,
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
    #[error("map: the walls leave no free space in the workspace")]
    NoFreeSpace,
}
