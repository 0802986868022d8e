//! Runs an evaluation in the background.

use std::sync::Arc;
use std::time::Instant;

use super::{CellResult, EvaluateError, Evaluation, Progress, VariationError, Venue, Watch, run, unrecorded};
use crate::jobs::{Life, Shelved, Stage, Workshop};
use ferry_core::map::MapError;
use ferry_core::trial::Arena;

impl Shelved for Evaluation {
    type Found = Progress;

    fn id(&self) -> &str {
        &self.id
    }

    fn life(&self) -> &Life<Progress> {
        &self.life
    }

    fn work(&self, workshop: &Workshop) -> Stage {
        EvaluateError::stage_after(self.run_cells(workshop))
    }
}

impl EvaluateError {
    /// The stage in which a job ends.
    pub fn stage_after(ran: Result<(), Self>) -> Stage {
        match ran {
            Ok(()) => Stage::Done,
            Err(Self::Stopped) => Stage::Cancelled,
            Err(error) => Stage::Failed(error.to_string()),
        }
    }
}

impl Evaluation {
    fn run_cells(&self, workshop: &Workshop) -> Result<(), EvaluateError> {
        for (index, cell) in self.cells.iter().enumerate() {
            let began = Instant::now();
            let map = self.map(cell).ok_or_else(|| MapError::Unknown { name: cell.map.clone() })?;
            let venue = Venue::of(Arena::with_policies(map.clone(), self.policies.clone()));
            let experiment = self.experiment(cell, &venue).map_err(VariationError::from)?;
            let watch = Watch {
                stop: self.life.stop(),
                progress: &|_, episode| self.note(index, began, episode),
                recorders: &unrecorded,
            };
            let one = std::slice::from_ref(&experiment);
            let episodes = workshop.pool.install(|| run(one, &workshop.gpu, &watch))?;
            let result = Arc::new(CellResult::of(cell, episodes.into_iter().flatten().collect()));
            self.life.update(|progress| progress.results.push(result));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::{Cell, EvaluationQuery};
    use crate::jobs::Job;
    use ferry_camera::{AdapterChoice, Gpu};
    use ferry_core::map::Map;
    use ferry_core::policy::Shipped;
    use ferry_core::scenario::{ControllerName, RlPolicy};

    fn evaluation(map: &str) -> Arc<Evaluation> {
        let cell = Cell {
            controller: ControllerName::Attractor,
            map: map.into(),
            disturbances: 0,
            program: None,
            varied: Vec::new(),
        };
        let query = EvaluationQuery {
            controllers: vec![cell.controller],
            maps: vec![cell.map.clone()],
            disturbances: vec![0],
            episodes: 2,
            seed: 1,
            rl_policy: RlPolicy::Auto,
            program: None,
            vary: Vec::new(),
        };
        let maps = Map::shipped(map).into_iter().collect();
        Evaluation::new("a test".into(), query, vec![cell], maps, Arc::new(Shipped), None)
    }

    #[test]
    fn an_error_only_ends_its_own_evaluation() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        let workshop = Workshop::new(&gpu).unwrap();
        let [bad, good] = ["nowhere", "open"].map(evaluation);
        bad.run(&workshop);
        let Stage::Failed(message) = bad.life.stage() else { panic!("there is no such map") };
        assert!(message.contains("nowhere"), "{message}");
        good.run(&workshop);
        let done = good.life.read(|stage, progress| (stage.clone(), progress.results.len()));
        assert_eq!(done, (Stage::Done, 1));
    }
}
