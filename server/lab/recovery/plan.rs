//! What is to be tried, for the command line and for Python.

use std::sync::Arc;

use super::{Recovery, RecoveryError, RecoveryQuery, Start};
use crate::program::Program;
use ferry_camera::{Camera, Gpu};
use ferry_core::image::CameraError;
use ferry_core::map::MapError;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::{ControllerName, RandomTrialError, SetError, ShippedError};
use ferry_core::trial::{Case, Origin, Timed, TrialError};
use ferry_files::open;

/// Latest moment: one day.
const AT_MOST_S: f64 = 86_400.0;

/// A recovery map without a session.
pub struct RecoveryPlan {
    /// A map's name, or the path of an SVG; start and goal are drawn from the seed.
    pub map: String,
    /// Instead of the map: the name of a shipped scenario, or the path of a JSON file.
    pub scenario: Option<String>,
    /// Moment of the scenario, in simulated seconds.
    pub at_s: f64,
    pub query: RecoveryQuery,
    /// Parameters, each as `NAME=VALUE`.
    pub changes: Vec<String>,
    /// For the controller `program`.
    pub program: Option<Arc<Program>>,
}

/// Why a plan is refused.
#[derive(Debug, thiserror::Error)]
pub enum RecoveryPlanError {
    #[error("at_s is {0}, it must be 0 to {AT_MOST_S} (one day)")]
    At(f64),
    #[error("set: {0}")]
    Set(#[from] SetError),
    #[error(transparent)]
    Map(#[from] MapError),
    #[error(transparent)]
    Random(#[from] RandomTrialError),
    #[error(transparent)]
    Scenario(#[from] ShippedError),
    #[error(transparent)]
    Trial(#[from] TrialError),
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error(transparent)]
    Query(#[from] RecoveryError),
}

impl RecoveryPlan {
    /// # Errors
    /// [`RecoveryPlanError`].
    pub fn recovery(self, gpu: &Arc<Gpu>) -> Result<Recovery, RecoveryPlanError> {
        let case = self.case()?;
        let arena = open::arena_of(&case)?;
        let tick = (self.at_s / SERVO_PERIOD_S) as u64;
        let moment = case.after(tick, &arena, &mut Camera::of(gpu, arena.static_scene())?)?;
        let told: Vec<Timed> = case.inputs.into_iter().filter(|timed| timed.tick <= tick).collect();
        let start = Start { origin: Origin::of(&moment), told: Some(told), program: self.program };
        Ok(Recovery::new(self.query, start)?)
    }

    fn case(&self) -> Result<Case, RecoveryPlanError> {
        if !(0.0..=AT_MOST_S).contains(&self.at_s) {
            return Err(RecoveryPlanError::At(self.at_s));
        }
        let mut case = match &self.scenario {
            Some(name) => open::case(name)?,
            None => {
                let arena = open::arena(&self.map)?;
                let first = self.query.controllers.iter().find(|name| **name != ControllerName::Program);
                let first = first.copied().unwrap_or(ControllerName::Attractor);
                let scenario = arena.random(&self.map, first, 0, self.query.seed, 0)?;
                Case { about: String::new(), scenario, map: None, inputs: Vec::new(), expect: None }
            }
        };
        case.scenario.parameters = case.scenario.parameters.with(&self.changes)?;
        Ok(case)
    }
}
