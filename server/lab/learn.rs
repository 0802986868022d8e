//! Training of the policy: an environment over a sweep of images, and Rainbow-IQN.

mod adam;
mod atlas;
mod checkpoint;
mod curve;
mod environment;
mod error;
mod examine;
mod goals;
mod lanes;
mod learner;
mod library;
mod loss;
mod networks;
mod point;
mod recipe;
mod replay;
mod run;
mod settings;
mod survey;
pub mod sweep;
mod terrain;
mod training;
mod trainings;

pub use atlas::{Atlas, AtlasError};
pub use checkpoint::CheckpointError;
pub use curve::{Curve, FigureError};
pub use environment::Ending;
pub use error::TrainingError;
pub use examine::{EXAMINATION_SEED, Marks};
pub use goals::GoalSet;
pub use lanes::{Lane, Lanes, LanesError};
pub use library::{ADDED_POLICIES, Added, Library, LibraryError};
pub use point::{Point, Spread, WINDOW};
pub use recipe::{Recipe, RecipeError, RecipeName};
pub use run::{Run, Saving, drive};
pub use settings::{FusionName, Settings};
pub use survey::{MazeLattice, SurveyRecipe, SurveyRun, examine as examine_surveys, examine_teacher};
pub use terrain::{MOST_TERRAINS, Terrain, TerrainError, wall_waves_m};
pub use training::State;
pub use trainings::{
    Cells, Frame, Origin, QueryError, Status, SubmitTrainingError, Trail, Training, TrainingQuery, TrainingStage,
    Trainings,
};

/// Git revision of the working tree, marked if it has changes; outside a repository, the program's version.
pub fn revision() -> String {
    let git = std::process::Command::new("git").args(["describe", "--always", "--dirty", "--exclude=*"]).output();
    match git {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).trim().to_owned(),
        _ => concat!("version ", env!("CARGO_PKG_VERSION")).to_owned(),
    }
}
