//! Runs the trials of a recovery map on all threads of the current pool.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use super::attempt::Setting;
use super::findings::Cell;
use super::grid::Grid;
use super::{Findings, Kind, Outcome, RecoveryError, RecoveryQuery, Spot, Tried};
use crate::evaluate::{EvaluateError, Shard, Venue};
use crate::jobs::Life;
use crate::program::{Carrier, Program};
use ferry_camera::Gpu;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Beginning, Case, Expectation, Input, LoggedMap, Nowhere, Origin, Sink, Timed};

/// The moment of a recovery map.
#[derive(Clone, Debug)]
pub struct Start {
    pub origin: Origin,
    /// All inputs up to the moment, if they are known.
    pub told: Option<Vec<Timed>>,
    /// For the controller `program`.
    pub program: Option<Arc<Program>>,
}

impl Start {
    /// Whether nothing has happened since the scenario was set up.
    pub(super) fn is_fresh(&self) -> bool {
        self.origin.tick() == 0 && self.told.as_ref().is_some_and(Vec::is_empty)
    }
}

/// What is to be tried, from where.
pub struct Recovery {
    pub query: RecoveryQuery,
    pub start: Start,
    venue: Arc<Venue>,
}

/// Creates the sink of a trial from its name.
pub type Recorders<'a> = &'a (dyn Fn(&str) -> Result<Box<dyn Sink>, EvaluateError> + Sync);

/// A trial: its cell, controller and repeat, by index.
type Turn = (usize, usize, usize);

impl Recovery {
    /// # Errors
    /// [`RecoveryError`].
    pub fn new(query: RecoveryQuery, start: Start) -> Result<Self, RecoveryError> {
        query.check(start.program.is_some())?;
        let (tick, world) = (start.origin.tick(), &start.origin.state.world);
        match world.goal_m {
            None => return Err(RecoveryError::NoGoal { tick }),
            Some(_) if world.phase.has_failed() => return Err(RecoveryError::Ended { tick, phase: world.phase }),
            Some(_) => {}
        }
        let venue = Venue::of(start.origin.arena.clone());
        let recovery = Self { query, start, venue };
        recovery.query.check_trials(recovery.trials())?;
        Ok(recovery)
    }

    /// Number of trials over the whole finest grid.
    pub fn trials(&self) -> usize {
        let cells = match self.query.kind {
            Kind::Place => self.grid().fine().len(),
            _ => self.spots(1.0).len(),
        };
        cells * self.query.controllers.len() * self.query.repeats as usize
    }

    fn grid(&self) -> Grid {
        Grid::new(&self.venue.arena.map, self.query.grid)
    }

    fn spots(&self, until_s: f64) -> Vec<Spot> {
        match self.query.kind {
            Kind::Place => Vec::new(),
            Kind::Push => Spot::pushes(self.query.grid),
            Kind::Drag => Spot::drags(self.query.grid),
            Kind::Blind => Spot::losses(self.query.grid, until_s),
        }
    }

    /// The name of a controller, or of the program.
    pub fn controller(&self, index: usize) -> &str {
        match (self.query.controllers[index], &self.start.program) {
            (ControllerName::Program, Some(program)) => &program.name,
            (name, _) => name.as_str(),
        }
    }

    /// Their names, in the order of the query.
    pub fn controllers(&self) -> Vec<&str> {
        (0..self.query.controllers.len()).map(|index| self.controller(index)).collect()
    }

    /// Tries everything that `life` has not found yet, or what belongs to a shard; `progress` is called after each trial. A shard of a map of places
    /// needs the whole finest grid: which coarse cells are divided depends on all trials.
    ///
    /// # Errors
    /// [`EvaluateError`], also when `life` was cancelled.
    pub fn run(
        &self,
        shard: Option<Shard>,
        gpu: &Arc<Gpu>,
        life: &Life<Findings>,
        recorders: Recorders<'_>,
        progress: &(dyn Fn(&Findings) + Sync),
    ) -> Result<(), EvaluateError> {
        // The cells are planned again; a paused map goes on with what it has.
        let mut before = HashMap::new();
        life.update(|findings| {
            before.extend(std::mem::take(findings).cells.into_iter().map(|cell| (cell.number, cell.tries)));
        });
        let run = Run { recovery: self, shard, gpu, life, recorders, progress, before };
        match self.query.kind {
            Kind::Place => {
                life.update(|findings| findings.room_m2 = Some(self.venue.room_m2()));
                run.places()
            }
            Kind::Blind => {
                let undisturbed_s = run.undisturbed()?;
                let slowest_s = undisturbed_s.iter().flatten().fold(1.0, |slowest: f64, &time_s| slowest.max(time_s));
                run.all(&self.spots(slowest_s))
            }
            Kind::Push | Kind::Drag => run.all(&self.spots(0.0)),
        }
    }

    /// The noise of a trial: the same for all controllers.
    fn seed(&self, cell: &Cell, repeat: usize) -> u64 {
        let number = cell.number.wrapping_mul(u64::from(self.query.repeats)).wrapping_add(repeat as u64);
        self.query.seed.wrapping_add(number)
    }

    /// The inputs at the moment and after it: the controller, the noise, and a disturbance.
    fn inputs(&self, controller: ControllerName, seed: u64, spot: Option<Spot>) -> Vec<Timed> {
        let state = &self.start.origin.state;
        let (tick, plant) = (state.world.tick, &state.world.plant);
        let mut inputs = vec![Input::Reseed { seed }];
        if plant.hand.is_some() {
            inputs.push(Input::Release);
        }
        if controller != state.controller {
            inputs.push(Input::SelectController(controller));
        }
        let inputs = inputs.into_iter().map(|input| Timed { tick, input });
        inputs.chain(spot.into_iter().flat_map(|spot| spot.inputs(tick, plant.bead.position_m))).collect()
    }

    /// The inputs of a trial, from the moment on.
    pub fn inputs_of(&self, cell: &Cell, controller: usize, repeat: usize) -> Vec<Timed> {
        self.inputs(self.query.controllers[controller], self.seed(cell, repeat), Some(cell.spot))
    }

    pub(super) fn trial_name(&self, cell: &Cell, controller: usize, repeat: usize) -> String {
        format!("cell-{:05}-{}-{repeat:03}", cell.number, self.controller(controller))
    }

    /// All trials that have ended as test cases, by name.
    pub fn cases(&self, findings: &Findings) -> Vec<(String, Case)> {
        let mut cases = Vec::new();
        for cell in &findings.cells {
            for (controller, tries) in cell.tries.iter().enumerate() {
                for repeat in (0..tries.len()).filter(|&repeat| tries[repeat].is_some()) {
                    let case = self.case(cell, controller, repeat);
                    cases.extend(case.map(|case| (self.trial_name(cell, controller, repeat), case)));
                }
            }
        }
        cases
    }

    /// A trial as a test case, which expects a delivery in time. `None` if the inputs before the moment are not known.
    pub fn case(&self, cell: &Cell, controller: usize, repeat: usize) -> Option<Case> {
        let Origin { scenario, arena, state } = &self.start.origin;
        let about = format!(
            "{} under {} from tick {}.",
            self.query.kind.as_str(),
            self.controller(controller),
            state.world.tick
        );
        let inputs =
            self.start.told.iter().flatten().cloned().chain(self.inputs_of(cell, controller, repeat)).collect();
        let next = state.world.counters.deliveries + 1;
        // A bead that was delivered at the moment, and that a disturbance has left there, is not delivered again.
        let tried = cell.tries[controller][repeat].filter(|tried| tried.outcome == Outcome::Delivered);
        let deliveries = tried.map_or(next, |tried| tried.deliveries);
        let by_tick = state.world.tick + (self.query.within_s / ferry_core::robot::ur5::SERVO_PERIOD_S) as u64;
        self.start.told.as_ref().map(|_| Case {
            about,
            scenario: scenario.clone(),
            map: LoggedMap::unless_shipped(&arena.map),
            inputs,
            expect: Some(Expectation { deliveries, by_tick }),
        })
    }
}

/// A recovery map while it runs.
struct Run<'a> {
    recovery: &'a Recovery,
    shard: Option<Shard>,
    gpu: &'a Arc<Gpu>,
    life: &'a Life<Findings>,
    recorders: Recorders<'a>,
    progress: &'a (dyn Fn(&Findings) + Sync),
    /// The trials that had ended before a pause, by the number of their cell.
    before: HashMap<u64, Vec<Vec<Option<Tried>>>>,
}

impl Run<'_> {
    /// All cells of a grid of places, or coarse ones, which are divided where a neighbour differs.
    fn places(&self) -> Result<(), EvaluateError> {
        let grid = self.recovery.grid();
        if self.recovery.query.is_full || self.shard.is_some() {
            let fine = grid.fine();
            return self.add(fine.iter().map(|&place| (grid.spot(place), place.center as u64)).collect());
        }
        let mut places = grid.coarse();
        let mut new = places.clone();
        while !new.is_empty() {
            self.add(new.iter().map(|&place| (grid.spot(place), place.center as u64)).collect())?;
            let usual =
                self.life.read(|_, findings| findings.cells.iter().map(|cell| self.usual(cell)).collect::<Vec<_>>());
            new = Vec::new();
            for index in grid.unlike(&places, &usual) {
                let (center, around) = grid.refine(places[index]);
                places[index] = center;
                self.life.update(|findings| findings.cells[index].spot = grid.spot(center));
                new.extend(around);
            }
            places.extend(&new);
        }
        Ok(())
    }

    fn usual(&self, cell: &Cell) -> Vec<Outcome> {
        (0..self.recovery.query.controllers.len()).map(|controller| cell.tally(controller).usual()).collect()
    }

    fn all(&self, spots: &[Spot]) -> Result<(), EvaluateError> {
        self.add(spots.iter().zip(0..).map(|(&spot, number)| (spot, number)).collect())
    }

    /// Adds cells and tries them: first all once, spread over the map, so that it is soon seen as a whole.
    fn add(&self, new: Vec<(Spot, u64)>) -> Result<(), EvaluateError> {
        let query = &self.recovery.query;
        let (controllers, repeats) = (query.controllers.len(), query.repeats);
        let mut first = 0;
        let count = new.len();
        self.life.update(|findings| {
            first = findings.cells.len();
            findings.cells.extend(new.into_iter().map(|(spot, number)| {
                let mut cell = Cell::new(spot, number, controllers, repeats);
                if let Some(tries) = self.before.get(&number) {
                    cell.tries.clone_from(tries);
                }
                cell
            }));
        });
        let mut spread: Vec<usize> = (0..count).collect();
        spread.sort_by_key(|&index| (index as u32).reverse_bits());
        let turns = (0..repeats as usize).flat_map(|repeat| {
            let cells = spread.iter().map(move |index| first + index);
            cells.flat_map(move |cell| (0..controllers).map(move |controller| (cell, controller, repeat)))
        });
        let turns: Vec<Turn> = match self.shard {
            Some(shard) => shard.among(turns).collect(),
            None => turns.collect(),
        };
        let mut left = turns.clone();
        self.life.update(|findings| {
            left.retain(|&(cell, controller, repeat)| findings.cells[cell].tries[controller][repeat].is_none());
            findings.planned += turns.len();
            findings.done += turns.len() - left.len();
        });
        // In this order, on any number of threads.
        left.into_iter().par_bridge().try_for_each(|turn| self.turn(turn))
    }

    fn turn(&self, (index, controller, repeat): Turn) -> Result<(), EvaluateError> {
        let cell = self.life.read(|_, findings| findings.cells[index].clone());
        let recovery = self.recovery;
        let name = recovery.trial_name(&cell, controller, repeat);
        let inputs = recovery.inputs_of(&cell, controller, repeat);
        let tried = self.one(&name, controller, &inputs, Some(cell.spot))?;
        self.life.update(|findings| {
            findings.cells[index].tries[controller][repeat] = Some(tried);
            findings.done += 1;
            (self.progress)(findings);
        });
        Ok(())
    }

    /// Times to the delivery without a disturbance.
    fn undisturbed(&self) -> Result<Vec<Option<f64>>, EvaluateError> {
        let query = &self.recovery.query;
        let controllers = query.controllers.par_iter().enumerate();
        let times = controllers.map(|(index, &controller)| {
            let inputs = self.recovery.inputs(controller, query.seed, None);
            let name = format!("undisturbed-{}", self.recovery.controller(index));
            let tried = self.one(&name, index, &inputs, None)?;
            Ok((tried.outcome != Outcome::Lost).then_some(tried.time_s))
        });
        times.collect()
    }

    fn one(&self, name: &str, controller: usize, inputs: &[Timed], spot: Option<Spot>) -> Result<Tried, EvaluateError> {
        let recovery = self.recovery;
        if self.life.stop().load(std::sync::atomic::Ordering::Relaxed) {
            return Err(EvaluateError::Stopped);
        }
        let mut camera = recovery.venue.camera(self.gpu)?;
        let mut sink = (self.recorders)(name)?;
        let is_program = recovery.query.controllers[controller] == ControllerName::Program;
        let program = recovery.start.program.as_deref().filter(|_| is_program);
        let carrier = program.map(|program| Carrier { program, trial: name });
        let start = &recovery.start;
        let beginning = if start.is_fresh() { Beginning::SetUp } else { Beginning::Resumed };
        let setting = Setting { origin: &start.origin, beginning, within_s: recovery.query.within_s };
        let over_ticks = spot.map_or(0, Spot::lasts_ticks);
        let tried = setting.attempt(inputs, over_ticks, carrier, &mut camera, &mut *sink, self.life.stop());
        if let Some(carrier) = carrier {
            carrier.end();
        }
        let tried = tried?;
        recovery.venue.keep(camera);
        sink.finish().map_err(EvaluateError::NotRecorded)?;
        Ok(tried)
    }
}

/// Records nothing.
pub fn unrecorded(_: &str) -> Result<Box<dyn Sink>, EvaluateError> {
    Ok(Box::new(Nowhere::default()))
}
