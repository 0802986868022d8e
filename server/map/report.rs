//! What is said about a drawing: why it was refused, or what was repaired.

use super::{MAX_SVG_BYTES, Map};

/// Where an element stands in its file. Displays as `<path> id="fold" at line 7`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// Tag name.
    pub element: String,
    /// Its `id`, if it has one.
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

/// A part of a drawing that is no wall as it stands, and what was made of it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Repair {
    /// The element.
    pub place: Place,
    /// What was done.
    pub kind: RepairKind,
}

impl std::fmt::Display for Repair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.kind)
    }
}

/// What was done to make a wall of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum RepairKind {
    /// Two of a filled outline's edges cross.
    #[error("its outline crosses itself; the fill rule decides what is wall")]
    Crosses,
    /// Two edges of a filled outline that are no neighbours share a point, and none cross.
    #[error("its outline touches itself; the fill rule decides what is wall")]
    Touches,
    /// A filled outline ends elsewhere than it began.
    #[error("its outline is open; closed with a straight line")]
    Open,
    /// A shape that asks to be seen leaves no mark.
    #[error("it draws nothing, having neither area nor stroke; left out")]
    Nothing,
}

/// Why a map was refused.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// No map of that name is shipped.
    #[error("map: there is no map named {name:?}; there are {known}", known = Map::shipped_names().join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// The file could not be read.
    #[error("map: {path}: {error}")]
    Io {
        /// The path asked for.
        path: String,
        /// What the system said.
        error: std::io::Error,
    },
    /// The file is larger than [`MAX_SVG_BYTES`].
    #[error("map: the file has {bytes} bytes, the limit is {MAX_SVG_BYTES}")]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// No room for another.
    #[error("map: {most} maps were added already, take one out first")]
    TooMany {
        /// How many there may be.
        most: usize,
    },
    /// Not well-formed, or not SVG.
    #[error("map: not a readable SVG: {0}")]
    Svg(String),
    /// The root has no usable `viewBox`, which gives the workspace.
    #[error("map: viewBox {value:?}: {reason}")]
    ViewBox {
        /// The attribute as written.
        value: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The root asks for an unknown positioner.
    #[error("map: data-positioner {value:?}: it must be \"arm\" or \"planar-stage\"")]
    Positioner {
        /// The attribute as written.
        value: String,
    },
    /// An element that cannot become a wall, or costs too much to make one of.
    #[error("map: {place}: {reason}")]
    Element {
        /// The element.
        place: Place,
        /// Why, and what to do instead.
        reason: String,
    },
    /// The walls leave no space for the bead.
    #[error("map: the walls leave no free space in the workspace")]
    NoFreeSpace,
}
