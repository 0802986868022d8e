//! What planning transports share: the known obstacles, the clearance that a path keeps, and how a path is followed.

mod clearance;
mod follow;
mod obstacles;
mod path;
mod reach;
mod segment;
mod shortest;
#[cfg(test)]
pub(super) mod test_space;
#[cfg(test)]
mod tests;

pub use clearance::{Clearance, End, LEAST_CLEARANCE_M};
pub use follow::{Followed, Latest, OFF_PATH_M};
pub use obstacles::Obstacles;
pub use path::Path;
