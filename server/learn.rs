//! Training of the policy: an environment over a sweep of images, and Rainbow-IQN.

mod adam;
mod atlas;
mod curve;
mod environment;
mod examine;
mod goals;
mod learner;
mod loss;
mod recipe;
mod replay;
pub mod sweep;
mod terrain;
mod training;

pub use atlas::{Atlas, AtlasError};
pub use curve::{Curve, FigureError};
pub use environment::Ending;
pub use examine::Marks;
pub use goals::GoalSet;
pub use recipe::{Recipe, RecipeError};
pub use terrain::{Terrain, TerrainError};
pub use training::{Point, Spread, State, TrainingError, WINDOW};
