//! The full system, one control step at a time.

use std::sync::{Arc, Mutex};

use ferry_camera::{Camera, Gpu};
use ferry_core::geometry::Point2;
use ferry_core::perception::OBSERVATION_SIZE_PX;
use ferry_core::scenario::{ControllerName, LEAST_DISTANCE_M, Parameters, Scenario};
use ferry_core::trial::{Arena, Input, LoggedMap, Phase, Question, Seen, Source, StopReason, Trial, TrialState};
use ferry_files::open;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};
use rayon::prelude::*;

use crate::{Array, Reduced, array, bad, failed, locked, open_gpu, packed, threads, unpacked};

/// Draws of a start or a goal for a given one.
const DRAWS: u64 = 100;

/// One trial that waits for an answer. Copies share the camera.
#[derive(Clone)]
struct Lane {
    trial: Trial,
    camera: Arc<Mutex<Camera>>,
    seen: Seen,
    question: Option<Question>,
}

/// Start, goal, changed parameters and number of disturbances of a trial; as in the other trials where they are not
/// given.
type Wish = (Option<[f64; 2]>, Option<[f64; 2]>, Vec<String>, Option<u32>);

/// What a pickle has.
type Kept = (String, LoggedMap, Parameters, u32, usize, Vec<(Scenario, TrialState)>);

/// Trials side by side on one map.
#[pyclass(module = "ferry._ferry")]
pub struct Mazes {
    arena: Arc<Arena>,
    map: String,
    parameters: Parameters,
    disturbances: u32,
    count: usize,
    /// Empty until the first start. Their cameras have threads, so that a process with an environment that never began can
    /// be forked, as Gymnasium does.
    lanes: Vec<Lane>,
}

impl Drop for Mazes {
    fn drop(&mut self) {
        if threads::are_lost() {
            std::mem::forget(std::mem::take(&mut self.lanes));
        }
    }
}

#[pymethods]
impl Mazes {
    #[classattr]
    const MOST: usize = 256;

    /// `changes`: parameters as `NAME=VALUE`.
    #[new]
    fn new(py: Python<'_>, map: String, lanes: usize, changes: Vec<String>, disturbances: u32) -> PyResult<Self> {
        py.detach(|| {
            let parameters = Parameters::default().with(&changes).map_err(bad)?;
            let arena = open::arena(&map).map_err(bad)?;
            let mazes = Self { arena, map, parameters, disturbances, count: lanes, lanes: Vec::new() };
            mazes.trial(0, &Wish::default())?;
            Ok(mazes)
        })
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        let Self { arena, map, parameters, disturbances, count, lanes } = self;
        let (arena, map, parameters, lanes) = (arena.clone(), map.clone(), parameters.clone(), lanes.clone());
        Self { arena, map, parameters, disturbances: *disturbances, count: *count, lanes }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let this = slf.borrow();
        let drawing = LoggedMap::from(&this.arena.map);
        let lanes: Vec<_> = this.lanes.iter().map(|Lane { trial, .. }| (trial.scenario(), trial.state())).collect();
        packed(slf, &(&this.map, drawing, &this.parameters, this.disturbances, this.count, lanes))
    }

    #[classmethod]
    fn from_pickle(_class: &Bound<'_, PyType>, py: Python<'_>, kept: &Bound<'_, PyBytes>) -> PyResult<Self> {
        let (map, drawing, parameters, disturbances, count, states): Kept = unpacked(kept)?;
        py.detach(|| {
            let arena = drawing.arena().map_err(bad)?;
            let mut mazes = Self { arena, map, parameters, disturbances, count, lanes: Vec::new() };
            if !states.is_empty() {
                mazes.check_length("state", states.len())?;
                let gpu = open_gpu()?;
                let go_on = |(scenario, state)| {
                    let mut trial = Trial::new(scenario, mazes.arena.clone()).map_err(bad)?;
                    trial.resume(state).map_err(bad)?;
                    mazes.lane(trial, &gpu)
                };
                mazes.lanes = states.into_iter().map(go_on).collect::<PyResult<_>>()?;
            }
            Ok(mazes)
        })
    }

    /// Begins a trial in each lane that has a seed; the first time, in all lanes. If a trial is impossible, no lane changes.
    fn start(&mut self, py: Python<'_>, seeds: Vec<Option<u64>>, wishes: Vec<Wish>) -> PyResult<()> {
        self.check_length("seed", seeds.len())?;
        self.check_length("options", wishes.len())?;
        threads::claim()?;
        py.detach(|| {
            let is_first = self.lanes.is_empty();
            let begin = |(index, (seed, wish)): (usize, (Option<u64>, Wish))| {
                let seed = seed.or(is_first.then_some(index as u64))?;
                Some(self.trial(seed, &wish))
            };
            let trials = seeds.into_iter().zip(wishes).enumerate().map(begin);
            let trials = trials.map(Option::transpose).collect::<PyResult<Vec<_>>>()?;
            if is_first {
                let gpu = open_gpu()?;
                let lanes = trials.into_iter().flatten().map(|trial| self.lane(trial, &gpu));
                self.lanes = lanes.collect::<PyResult<_>>()?;
                return Ok(());
            }
            for (lane, trial) in self.lanes.iter_mut().zip(trials) {
                let Some(trial) = trial else { continue };
                (lane.seen, lane.question) = look(&trial, &mut locked(&lane.camera))?;
                lane.trial = trial;
            }
            Ok(())
        })
    }

    /// One control step of each lane of `mask`, straight toward its row of `targets_m`; a row with NaN holds.
    fn step(
        &mut self,
        py: Python<'_>,
        targets_m: PyReadonlyArray2<'_, f64>,
        mask: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<()> {
        threads::claim()?;
        self.check_begun()?;
        if targets_m.shape() != [self.lanes.len(), 2] {
            return Err(bad(format!(
                "target_m has the shape {:?}, it must be [{}, 2]",
                targets_m.shape(),
                self.lanes.len()
            )));
        }
        self.check_length("mask", mask.len())?;
        let mask = mask.as_array();
        let targets: Vec<Option<Point2<f64>>> = targets_m
            .as_array()
            .outer_iter()
            .zip(mask)
            .map(|(row, &steps)| steps.then(|| Point2::new(row[0], row[1])))
            .collect();
        py.detach(|| {
            let step =
                |(lane, target): (&mut Lane, Option<Point2<f64>>)| target.map_or(Ok(()), |target| lane.step(target));
            match self.lanes.as_mut_slice() {
                [only] => step((only, targets[0])),
                lanes => lanes.par_iter_mut().zip(targets).map(step).collect(),
            }
        })
    }

    /// `[lanes, 84, 84]`, gray.
    fn images<'py>(&self, py: Python<'py>) -> Array<'py, u8> {
        const SIDE: usize = OBSERVATION_SIZE_PX;
        let channel = |lane: &Lane| lane.trial.observation(&lane.seen).bytes[..SIDE * SIDE].to_vec();
        let pixels: Vec<u8> = py.detach(|| self.lanes.iter().flat_map(channel).collect());
        array(py, &[self.lanes.len(), SIDE, SIDE], pixels)
    }

    /// `[lanes, 4]`: goal x and y, tool x and y, each 0 to 1 over the workspace.
    fn vectors<'py>(&self, py: Python<'py>) -> Array<'py, f32> {
        let workspace = self.arena.map.workspace();
        let scaled = |lane: &Lane| {
            let goal_m = lane.trial.state().world.goal_m.unwrap_or(lane.seen.tool_m);
            [goal_m, lane.seen.tool_m].map(|place| ferry_core::perception::Observation::scaled(place, workspace))
        };
        let numbers = self.lanes.iter().flat_map(scaled).flatten().map(|level| f32::from(level) / 255.0);
        array(py, &[self.lanes.len(), 4], numbers.collect())
    }

    /// `[lanes, 6]`: x and y of the tool, of the tracked bead, and of the goal, in metres.
    fn places_m<'py>(&self, py: Python<'py>) -> Array<'py, f64> {
        let places = |lane: &Lane| {
            let world = &lane.trial.state().world;
            let goal_m = world.goal_m.unwrap_or(lane.seen.tool_m);
            [lane.seen.tool_m, world.tracker.estimate().position_m, goal_m].map(|place| [place.x, place.y])
        };
        array(py, &[self.lanes.len(), 6], self.lanes.iter().flat_map(places).flatten().collect())
    }

    /// Whether each lane asks for its next step; otherwise Ferry moves the arm.
    fn asks<'py>(&self, py: Python<'py>) -> Array<'py, bool> {
        array(py, &[self.lanes.len()], self.lanes.iter().map(|lane| lane.question.is_some()).collect())
    }

    /// The phase of each lane.
    fn phases(&self) -> Vec<String> {
        self.lanes.iter().map(|lane| lane.trial.state().world.phase.to_string()).collect()
    }

    /// `[lanes]`: 0 not ended, 1 delivered, 2 failed, 3 out of steps.
    fn endings<'py>(&self, py: Python<'py>) -> Array<'py, u8> {
        let ending = |lane: &Lane| match lane.trial.state().world.phase {
            Phase::Holding | Phase::Approaching | Phase::Transporting | Phase::Settling { .. } => 0,
            Phase::Delivered => 1,
            Phase::LiftedOff | Phase::Stopped(StopReason::Settle | StopReason::WalledOff) => 2,
            Phase::Stopped(StopReason::LegSteps { .. } | StopReason::GoalSteps { .. } | StopReason::TrackerLost) => 3,
        };
        array(py, &[self.lanes.len()], self.lanes.iter().map(ending).collect())
    }

    /// x and y of the workspace's lower left corner, where the cells begin.
    fn corner_m(&self) -> [f64; 2] {
        let workspace = self.arena.map.workspace();
        [workspace.x_min_m, workspace.y_min_m]
    }

    /// Why the arm of each lane holds, if it does.
    fn refusals(&self) -> Vec<Option<String>> {
        self.lanes.iter().map(|lane| lane.trial.state().world.refusal.as_ref().map(ToString::to_string)).collect()
    }

    /// Control steps of each lane so far.
    fn steps<'py>(&self, py: Python<'py>) -> Array<'py, i64> {
        let steps = self.lanes.iter().map(|lane| i64::from(lane.trial.state().world.counters.steps));
        array(py, &[self.lanes.len()], steps.collect())
    }

    /// Length of the shortest path of the tool to the goal in each lane, in metres; NaN without one.
    fn remaining_m<'py>(&self, py: Python<'py>) -> Array<'py, f64> {
        let remaining_m = |lane: &Lane| {
            let goal_m = lane.trial.state().world.goal_m?;
            self.arena.space.shortest_m(lane.seen.tool_m, goal_m)
        };
        let lengths = self.lanes.iter().map(|lane| remaining_m(lane).unwrap_or(f64::NAN));
        array(py, &[self.lanes.len()], lengths.collect())
    }

    /// `[height, width, 3]`: the table of a lane from above.
    fn picture<'py>(&self, py: Python<'py>, lane: usize, width_px: u32, height_px: u32) -> PyResult<Array<'py, u8>> {
        threads::claim()?;
        self.check_begun()?;
        let count = self.lanes.len();
        let lane = self.lanes.get(lane).ok_or_else(|| bad(format!("lane is {lane}, it must be 0 to {}", count - 1)))?;
        let Lane { trial, camera, .. } = lane;
        let picture = py.detach(|| locked(camera).plan(&trial.subject(), width_px, height_px)).map_err(failed)?;
        let colours = picture.rgba.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
        Ok(array(py, &[height_px as usize, width_px as usize, 3], colours))
    }
}

impl Mazes {
    /// The trial of a seed. If only its start or its goal is given, a path of a random trial's length leads between them.
    fn trial(&self, seed: u64, (start_m, goal_m, changes, disturbances): &Wish) -> PyResult<Trial> {
        let Self { arena, map, .. } = self;
        let parameters = self.parameters.with(changes).map_err(bad)?;
        let disturbances = disturbances.unwrap_or(self.disturbances);
        let places = [start_m, goal_m].map(|place| place.map(Point2::from));
        let is_one_given = places[0].is_some() != places[1].is_some();
        for index in 0..DRAWS {
            let random = arena.random(map, ControllerName::Program, disturbances, seed, index).map_err(bad)?;
            let (start_m, goal_m) = (places[0].or(random.start_m), places[1].or(random.goal_m));
            let scenario = Scenario { parameters: parameters.clone(), start_m, goal_m, ..random };
            let trial = Trial::new(scenario, arena.clone()).map_err(bad)?;
            let length_m = || arena.space.shortest_m(start_m?, goal_m?);
            if !is_one_given || length_m().is_some_and(|length_m| length_m >= LEAST_DISTANCE_M) {
                return Ok(trial);
            }
        }
        let given = if places[0].is_some() { "start_m" } else { "goal_m" };
        let text =
            format!("{given}: of {DRAWS} random places for the other end, none has a path of {LEAST_DISTANCE_M} m");
        Err(bad(text + " or more"))
    }

    fn lane(&self, trial: Trial, gpu: &Arc<Gpu>) -> PyResult<Lane> {
        let mut camera = Camera::of(gpu, self.arena.static_scene()).map_err(failed)?;
        let (seen, question) = look(&trial, &mut camera)?;
        Ok(Lane { trial, camera: Arc::new(Mutex::new(camera)), seen, question })
    }

    fn check_begun(&self) -> PyResult<()> {
        if self.lanes.is_empty() { Err(failed("no trial has begun: call reset first")) } else { Ok(()) }
    }

    fn check_length(&self, field: &str, found: usize) -> PyResult<()> {
        let lanes = self.count;
        if found == lanes { Ok(()) } else { Err(bad(format!("{field} has {found} entries, it must have {lanes}"))) }
    }
}

fn look(trial: &Trial, camera: &mut Camera) -> PyResult<(Seen, Option<Question>)> {
    let seen = trial.see(camera).map_err(failed)?;
    let question = trial.question(&seen);
    Ok((seen, question))
}

impl Lane {
    /// Answers, and runs until the next control step or the end.
    fn step(&mut self, target_m: Point2<f64>) -> PyResult<()> {
        let Self { trial, camera, seen, question } = self;
        if question.is_some() {
            let answer = match (target_m.x, target_m.y) {
                (x_m, y_m) if x_m.is_nan() || y_m.is_nan() => Input::Hold { reason: "it holds".to_owned() },
                (x_m, y_m) => Input::Go { x_m, y_m },
            };
            trial.apply(answer).map_err(bad)?;
        }
        let mut source = Source::Seen(Box::new(seen.clone()));
        loop {
            trial.tick(source).map_err(failed)?;
            if trial.step_is_due() || trial.state().world.phase.is_final() {
                break;
            }
            source = Source::Logged(None);
        }
        (*seen, *question) = look(trial, &mut locked(camera))?;
        Ok(())
    }
}
