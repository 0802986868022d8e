//! Runs an evaluation in the background.

use std::collections::HashSet;
use std::sync::{Arc, PoisonError};
use std::time::Instant;

use super::evaluation::work_of;
use super::{CellResult, EvaluateError, Evaluation, Progress, VariationError, Venue, Watch, run_trials, unrecorded};
use crate::jobs::{Life, Shelved, Stage, Ticket, Workshop};
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

    fn ticket(&self) -> &Ticket {
        &self.ticket
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
    /// Runs the cells that have no result yet; of the first one, the trials that had not ended before a pause.
    fn run_cells(&self, workshop: &Workshop) -> Result<(), EvaluateError> {
        let complete = self.life.read(|_, progress| progress.results.len());
        for (index, cell) in self.cells.iter().enumerate().skip(complete) {
            let map = self.map(cell).ok_or_else(|| MapError::Unknown { name: cell.map.clone() })?;
            let venue = Venue::of(Arena::with_policies(map.clone(), self.policies.clone()));
            let experiment = self.experiment(cell, &venue).map_err(VariationError::from)?;
            let before_s = self.life.read(|_, progress| progress.cells[index].elapsed_s);
            let began = Instant::now();
            let watch = Watch {
                stop: self.life.stop(),
                progress: &|_, episode| self.note(index, before_s + began.elapsed().as_secs_f64(), episode),
                recorders: &unrecorded,
            };
            let ended = || self.ended.lock().unwrap_or_else(PoisonError::into_inner);
            let has_ended: HashSet<u32> = ended().iter().map(|episode| episode.index).collect();
            let trials = (0..experiment.episodes).filter(|index| !has_ended.contains(index)).map(|index| (0, index));
            let (trials, one) = (trials.collect::<Vec<_>>(), std::slice::from_ref(&experiment));
            let units = trials.len() as f64;
            workshop.pool.install(|| run_trials(one, trials, &workshop.gpu, &watch))?;
            workshop.paces.measure(&work_of(cell.controller), units, began.elapsed().as_secs_f64());
            let mut episodes = std::mem::take(&mut *ended());
            episodes.sort_by_key(|episode| episode.index);
            let result = Arc::new(CellResult::of(cell, episodes));
            self.life.update(|progress| progress.results.push(result));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::{Cell, EvaluationQuery};
    use crate::jobs::{Job, Lane};
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
        let ticket = Ticket { owner: None, lane: Lane::Short, estimate_s: 1.0 };
        Evaluation::new("a test".into(), query, vec![cell], maps, Arc::new(Shipped), None, ticket)
    }

    #[test]
    fn an_error_only_ends_its_own_evaluation() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        let workshop = Workshop::new(Lane::Short, &gpu, Arc::default()).unwrap();
        let [bad, good] = ["nowhere", "open"].map(evaluation);
        bad.run(&workshop);
        let Stage::Failed(message) = bad.life.stage() else { panic!("there is no such map") };
        assert!(message.contains("nowhere"), "{message}");
        good.run(&workshop);
        let done = good.life.read(|stage, progress| (stage.clone(), progress.results.len()));
        assert_eq!(done, (Stage::Done, 1));
    }
}
