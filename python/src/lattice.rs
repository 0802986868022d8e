//! Training's fast environment.

use std::ops::ControlFlow;
use std::path::PathBuf;

use ferry::learn::sweep::{STEP_M, Sweep};
use ferry::learn::{Ending, Lanes, Recipe, Terrain};
use ferry::trial::Arena;
use numpy::{PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::{Array, array, bad, failed, open_gpu};

/// Side of an image.
const SIDE_PX: usize = 84;

/// Episodes side by side on one map.
#[pyclass]
pub struct Lattice {
    lanes: Lanes,
}

#[pymethods]
impl Lattice {
    /// `settings`: fields of a recipe as JSON. `sweeps`: the folder that keeps the camera's images of the map.
    #[new]
    fn new(py: Python<'_>, map: &str, lanes: usize, settings: &str, sweeps: PathBuf, seed: u64) -> PyResult<Self> {
        py.detach(|| {
            let recipe: Recipe = serde_json::from_str(settings).map_err(bad)?;
            recipe.check().map_err(bad)?;
            let arena = Arena::open(map).map_err(bad)?;
            // Without a camera there are no threads, so that processes can be forked.
            let sweep = match Sweep::kept(&arena, &sweeps, STEP_M, &[]) {
                Some(kept) => kept,
                None => Sweep::open(&arena, &open_gpu()?, &sweeps, STEP_M, &[], &|| ControlFlow::Continue(()))
                    .map_err(failed)?,
            };
            let workspace = arena.map.workspace();
            let terrain = Terrain::new(arena.map.name(), workspace, &sweep, recipe.clearance_m).map_err(bad)?;
            Ok(Self { lanes: Lanes::new(terrain, recipe, lanes, seed).map_err(bad)? })
        })
    }

    /// Number of cells of the map.
    fn cells(&self) -> usize {
        self.lanes.cells()
    }

    /// Begins an episode in each lane of `mask`; `seeds` has a seed or `None` for each lane.
    fn start(&mut self, mask: PyReadonlyArray1<'_, bool>, seeds: Option<Vec<Option<u64>>>) -> PyResult<()> {
        self.check_length("mask", mask.len())?;
        let seeds = seeds.unwrap_or_else(|| vec![None; self.lanes.len()]);
        self.check_length("seed", seeds.len())?;
        for (lane, (&starts, seed)) in mask.as_array().iter().zip(seeds).enumerate() {
            if starts {
                self.lanes.start(lane, seed);
            }
        }
        Ok(())
    }

    /// Takes a step in each lane of `mask`. Returns the rewards, and the endings: 0 none, 1 reached, 2 collided, 3 timed out.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArray1<'_, i64>,
        mask: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<(Array<'py, f32>, Array<'py, u8>)> {
        self.check_length("action", actions.len())?;
        self.check_length("mask", mask.len())?;
        let (actions, mask) = (actions.as_array(), mask.as_array());
        // First all are checked, so that a refused step changes no lane.
        if let Some((lane, action)) =
            actions.iter().enumerate().find(|(lane, action)| mask[*lane] && !(0..4).contains(*action))
        {
            return Err(bad(format!("action[{lane}] is {action}, it must be 0 to 3")));
        }
        let lanes = self.lanes.len();
        let (mut rewards, mut endings) = (vec![0.0; lanes], vec![0; lanes]);
        for lane in (0..lanes).filter(|&lane| mask[lane]) {
            let (reward, ending) = self.lanes.step(lane, actions[lane]).map_err(bad)?;
            rewards[lane] = reward;
            endings[lane] = match ending {
                None => 0,
                Some(Ending::Reached) => 1,
                Some(Ending::Collided) => 2,
                Some(Ending::TimedOut) => 3,
            };
        }
        Ok((array(py, &[lanes], rewards), array(py, &[lanes], endings)))
    }

    /// `[lanes, 84, 84]`, gray.
    fn images<'py>(&self, py: Python<'py>) -> Array<'py, u8> {
        let mut pixels = Vec::with_capacity(self.lanes.len() * SIDE_PX * SIDE_PX);
        for lane in 0..self.lanes.len() {
            pixels.extend_from_slice(self.lanes.image(lane));
        }
        array(py, &[self.lanes.len(), SIDE_PX, SIDE_PX], pixels)
    }

    /// `[lanes, 4]`: goal x and y, tool x and y, each 0 to 1 over the workspace.
    fn vectors<'py>(&self, py: Python<'py>) -> Array<'py, f32> {
        let numbers = (0..self.lanes.len()).flat_map(|lane| self.lanes.places(lane)).collect();
        array(py, &[self.lanes.len(), 4], numbers)
    }

    /// `[lanes]`: steps of the shortest path to the goal, −1 without one.
    fn distances<'py>(&self, py: Python<'py>) -> Array<'py, i64> {
        let steps = |lane| match self.lanes.distance(lane) {
            u16::MAX => -1,
            steps => i64::from(steps),
        };
        array(py, &[self.lanes.len()], (0..self.lanes.len()).map(steps).collect())
    }

    /// `[lanes, 4]`: x and y of the tool, then of the goal, in metres.
    fn places_m<'py>(&self, py: Python<'py>) -> Array<'py, f64> {
        let places = |lane| self.lanes.places_m(lane).into_iter().flat_map(|place| [place.x, place.y]);
        array(py, &[self.lanes.len(), 4], (0..self.lanes.len()).flat_map(places).collect())
    }
}

impl Lattice {
    fn check_length(&self, field: &str, found: usize) -> PyResult<()> {
        let lanes = self.lanes.len();
        if found == lanes { Ok(()) } else { Err(bad(format!("{field} has {found} entries, it must have {lanes}"))) }
    }
}
