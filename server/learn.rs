//! Training of the policy: an environment over a sweep of images, and Rainbow-IQN.

mod adam;
mod atlas;
mod checkpoint;
mod curve;
mod environment;
mod examine;
mod goals;
mod learner;
mod loss;
mod networks;
mod recipe;
mod replay;
mod survey;
pub mod sweep;
mod terrain;
mod training;

pub use atlas::{Atlas, AtlasError};
pub use checkpoint::CheckpointError;
pub use curve::{Curve, FigureError};
pub use environment::Ending;
pub use examine::Marks;
pub use goals::GoalSet;
pub use recipe::{Recipe, RecipeError};
pub use survey::{MazeLattice, SurveyRecipe, SurveyRun, examine as examine_surveys, examine_teacher};
pub use terrain::{Terrain, TerrainError};
pub use training::{Point, Spread, State, TrainingError, WINDOW};
