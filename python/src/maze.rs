//! The full system, one control step at a time.

use std::sync::Arc;

use ferry::camera::Camera;
use ferry::geometry::Point2;
use ferry::perception::OBSERVATION_SIZE_PX;
use ferry::scenario::{ControllerName, Parameters, Scenario};
use ferry::trial::{Arena, Input, Phase, Question, Seen, Source, StopReason, Trial};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::{Array, array, bad, failed, open_gpu, threads};

/// One trial that waits for an answer.
struct Lane {
    trial: Trial,
    camera: Camera,
    seen: Seen,
    question: Option<Question>,
}

/// Trials side by side on one map.
#[pyclass]
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
    /// `changes`: parameters as `NAME=VALUE`.
    #[new]
    fn new(py: Python<'_>, map: String, lanes: usize, changes: Vec<String>, disturbances: u32) -> PyResult<Self> {
        py.detach(|| {
            if !(1..=256).contains(&lanes) {
                return Err(bad(format!("lanes is {lanes}, it must be 1 to 256")));
            }
            let parameters = Parameters::default().with(&changes).map_err(bad)?;
            let arena = Arena::open(&map).map_err(bad)?;
            let mazes = Self { arena, map, parameters, disturbances, count: lanes, lanes: Vec::new() };
            mazes.trial(0)?;
            Ok(mazes)
        })
    }

    /// Begins a trial in each lane that has a seed; the first time, in all lanes.
    fn start(&mut self, py: Python<'_>, seeds: Vec<Option<u64>>) -> PyResult<()> {
        self.check_length("seed", seeds.len())?;
        threads::claim()?;
        py.detach(|| {
            if self.lanes.is_empty() {
                let gpu = open_gpu()?;
                let begin = |(index, seed): (usize, &Option<u64>)| {
                    let trial = self.trial(seed.unwrap_or(index as u64))?;
                    let mut camera = self.arena.camera(&gpu).map_err(failed)?;
                    let (seen, question) = look(&trial, &mut camera)?;
                    Ok(Lane { trial, camera, seen, question })
                };
                self.lanes = seeds.iter().enumerate().map(begin).collect::<PyResult<_>>()?;
                return Ok(());
            }
            for (index, seed) in seeds.into_iter().enumerate() {
                let Some(seed) = seed else { continue };
                let trial = self.trial(seed)?;
                let lane = &mut self.lanes[index];
                (lane.seen, lane.question) = look(&trial, &mut lane.camera)?;
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
            [goal_m, lane.seen.tool_m].map(|place| ferry::perception::Observation::scaled(place, workspace))
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
    fn picture<'py>(
        &mut self,
        py: Python<'py>,
        lane: usize,
        width_px: u32,
        height_px: u32,
    ) -> PyResult<Array<'py, u8>> {
        threads::claim()?;
        self.check_begun()?;
        let count = self.lanes.len();
        let lane =
            self.lanes.get_mut(lane).ok_or_else(|| bad(format!("lane is {lane}, it must be 0 to {}", count - 1)))?;
        let Lane { trial, camera, .. } = lane;
        let picture = py.detach(|| camera.plan(&trial.subject(), width_px, height_px)).map_err(failed)?;
        let colours = picture.rgba.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
        Ok(array(py, &[height_px as usize, width_px as usize, 3], colours))
    }
}

impl Mazes {
    fn trial(&self, seed: u64) -> PyResult<Trial> {
        let Self { arena, map, disturbances, .. } = self;
        let random = arena.random(map, ControllerName::Program, *disturbances, seed, 0);
        let scenario = Scenario { parameters: self.parameters.clone(), ..random.map_err(bad)? };
        Trial::new(scenario, arena.clone()).map_err(bad)
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
        (*seen, *question) = look(trial, camera)?;
        Ok(())
    }
}
