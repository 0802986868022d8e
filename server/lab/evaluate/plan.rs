//! What is to be evaluated, for the command line and for Python.

use std::sync::Arc;

use super::variation::applied;
use super::{Cell, Experiment, Manner, Setting, Variation, VariationError, Venue};
use crate::program::Program;
use ferry_core::map::MapError;
use ferry_core::policy::Policy;
use ferry_core::scenario::{ControllerName, Parameters, SetError};
use ferry_files::open;

/// Who carries the bead.
#[derive(Clone)]
pub enum Contender {
    Own(ControllerName),
    Program(Arc<Program>),
}

impl Contender {
    /// The name of the controller, and the program.
    fn taken(&self) -> Result<(ControllerName, Option<Arc<Program>>), PlanError> {
        match self {
            Self::Own(name) if !ControllerName::AUTOMATIC.contains(name) => Err(PlanError::NotAutomatic(name.as_str())),
            Self::Own(name) => Ok((*name, None)),
            Self::Program(program) => Ok((ControllerName::Program, Some(program.clone()))),
        }
    }
}

/// Every contender on every map with every number of disturbances, at the same starts, goals and seeds.
pub struct Plan {
    /// Names of maps, or paths of SVGs.
    pub maps: Vec<String>,
    pub contenders: Vec<Contender>,
    /// Scripted disturbances per trial.
    pub disturbances: Vec<u32>,
    /// Trials per row.
    pub episodes: u32,
    pub seed: u64,
    pub parameters: Parameters,
    /// Parameters that take several values: each combination has its rows.
    pub vary: Vec<Variation>,
    pub manner: Manner,
    /// Instead of the shipped policies.
    pub policy: Option<Policy>,
}

/// Why a plan is refused.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    #[error("controller is {0:?}, which needs a person or a program")]
    NotAutomatic(&'static str),
    #[error("vary: {0}")]
    Vary(#[from] VariationError),
    #[error("vary: {0}")]
    Setting(#[from] SetError),
    #[error(
        "{controller} on {map} with {disturbances} disturbances is requested twice; maps with the same file name count \
         as one"
    )]
    Twice { controller: String, map: String, disturbances: u32 },
    #[error(transparent)]
    Map(#[from] MapError),
}

impl Plan {
    /// One experiment per row, with the contenders of a map next to each other.
    ///
    /// # Errors
    /// [`PlanError`].
    pub fn experiments(&self) -> Result<Vec<Experiment>, PlanError> {
        let combinations = Variation::combinations(&self.vary)?;
        let with = |settings: Vec<Setting>| Ok((applied(&self.parameters, &settings)?, settings));
        let combinations = combinations.into_iter().map(with).collect::<Result<Vec<_>, PlanError>>()?;
        let mut experiments: Vec<Experiment> = Vec::new();
        for map in &self.maps {
            let arena = open::arena(map)?;
            let arena = match &self.policy {
                Some(policy) => arena.with_policy(policy.clone()),
                None => arena,
            };
            let venue = Venue::of(arena);
            for &disturbances in &self.disturbances {
                for (parameters, varied) in &combinations {
                    for contender in &self.contenders {
                        let (controller, program) = contender.taken()?;
                        let cell = Cell {
                            controller,
                            map: venue.arena.map.name().to_owned(),
                            disturbances,
                            program: program.as_ref().map(|program| program.name.clone()),
                            varied: varied.clone(),
                        };
                        // Two cells with the same name would count as the same trials.
                        if experiments.iter().any(|other| other.cell == cell) {
                            let controller = cell.controller().to_owned();
                            return Err(PlanError::Twice { controller, map: cell.map, disturbances });
                        }
                        experiments.push(Experiment {
                            cell,
                            venue: venue.clone(),
                            map: map.clone(),
                            episodes: self.episodes,
                            seed: self.seed,
                            parameters: parameters.clone(),
                            manner: self.manner,
                            program,
                        });
                    }
                }
            }
        }
        Ok(experiments)
    }
}
