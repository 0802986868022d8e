//! Training's fast environment.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ferry_core::trial::{Arena, LoggedMap};
use ferry_files::open;
use ferry_lab::learn::sweep::{STEP_M, Sweep};
use ferry_lab::learn::{Ending, Lane, Lanes, Recipe, Terrain};
use numpy::{PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};

use crate::{Array, Reduced, array, bad, failed, open_gpu, packed, unpacked};

/// Side of an image.
const SIDE_PX: usize = 84;

/// Episodes side by side on one map.
#[pyclass(module = "ferry._ferry")]
pub struct Lattice {
    arena: Arc<Arena>,
    recipe: Recipe,
    /// The folder that keeps the camera's images of maps.
    sweeps: PathBuf,
    lanes: Lanes,
}

/// What a pickle has. The number of cells is that of the terrain, which is made again.
type Kept = (LoggedMap, Recipe, PathBuf, usize, Vec<Lane>);

/// Start and goal of an episode; random where they are not given.
type Wish = (Option<[f64; 2]>, Option<[f64; 2]>);

#[pymethods]
impl Lattice {
    #[classattr]
    const MOST: usize = Lanes::MOST;

    /// `sweeps`: the folder that keeps the camera's images of the map.
    #[new]
    #[pyo3(signature = (map, lanes, *, progress_reward, step_penalty, clearance_m, sweeps))]
    fn new(
        py: Python<'_>,
        map: &str,
        lanes: usize,
        progress_reward: f64,
        step_penalty: f64,
        clearance_m: f64,
        sweeps: PathBuf,
    ) -> PyResult<Self> {
        py.detach(|| {
            let recipe = Recipe { progress_reward, step_penalty, clearance_m, ..Recipe::default() };
            recipe.check().map_err(bad)?;
            Self::on(open::arena(map).map_err(bad)?, recipe, sweeps, lanes)
        })
    }

    /// A copy that shares the images.
    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        let Self { arena, recipe, sweeps, lanes } = self;
        Self { arena: arena.clone(), recipe: recipe.clone(), sweeps: sweeps.clone(), lanes: lanes.clone() }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let this = slf.borrow();
        let map = LoggedMap::from(&this.arena.map);
        let lanes = this.lanes.states();
        packed(slf, &(map, &this.recipe, &this.sweeps, this.lanes.cells(), lanes))
    }

    #[classmethod]
    fn from_pickle(_class: &Bound<'_, PyType>, py: Python<'_>, kept: &Bound<'_, PyBytes>) -> PyResult<Self> {
        let (map, recipe, sweeps, cells, states): Kept = unpacked(kept)?;
        py.detach(|| {
            let mut lattice = Self::on(map.arena().map_err(bad)?, recipe, sweeps, states.len())?;
            let found = lattice.lanes.cells();
            if found != cells {
                let text = format!("the map had {cells} cells where this was pickled, and has {found} here");
                return Err(failed(text + ": the graphics adapters see different images"));
            }
            lattice.lanes.restore(states).map_err(bad)?;
            Ok(lattice)
        })
    }

    /// Number of cells of the map.
    fn cells(&self) -> usize {
        self.lanes.cells()
    }

    /// Begins an episode in each lane of `mask`, with its seed or else from its own random numbers. If an episode is
    /// impossible, no lane changes.
    #[pyo3(signature = (mask, seeds=None, wishes=None))]
    fn start(
        &mut self,
        mask: PyReadonlyArray1<'_, bool>,
        seeds: Option<Vec<Option<u64>>>,
        wishes: Option<Vec<Wish>>,
    ) -> PyResult<()> {
        self.check_length("mask", mask.len())?;
        let seeds = seeds.unwrap_or_else(|| vec![None; self.lanes.len()]);
        self.check_length("seed", seeds.len())?;
        let mask = mask.as_array();
        let starting = (0..seeds.len()).filter(|&lane| mask[lane]);
        let Some(wishes) = wishes else {
            for lane in starting {
                self.lanes.start(lane, seeds[lane], None, None).map_err(bad)?;
            }
            return Ok(());
        };
        self.check_length("options", wishes.len())?;
        let mut lanes = self.lanes.clone();
        for lane in starting {
            let (start_m, goal_m) = wishes[lane];
            lanes.start(lane, seeds[lane], start_m.map(Into::into), goal_m.map(Into::into)).map_err(bad)?;
        }
        self.lanes = lanes;
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
    fn on(arena: Arc<Arena>, recipe: Recipe, sweeps: PathBuf, lanes: usize) -> PyResult<Self> {
        let sweep = sweep(&arena, &sweeps)?;
        let workspace = arena.map.workspace();
        let terrain = Terrain::new(arena.map.name(), workspace, &sweep, recipe.clearance_m).map_err(bad)?;
        let lanes = Lanes::new(terrain, recipe.clone(), lanes, 0).map_err(bad)?;
        Ok(Self { arena, recipe, sweeps, lanes })
    }

    fn check_length(&self, field: &str, found: usize) -> PyResult<()> {
        let lanes = self.lanes.len();
        if found == lanes { Ok(()) } else { Err(bad(format!("{field} has {found} entries, it must have {lanes}"))) }
    }
}

/// The images of a map. Without a camera there are no threads, so that processes can be forked.
fn sweep(arena: &Arena, folder: &Path) -> PyResult<Sweep> {
    if let Some(kept) = Sweep::kept(arena, folder, STEP_M, &[]) {
        return Ok(kept);
    }
    Sweep::open(arena, &open_gpu()?, folder, STEP_M, &[], &|| ControlFlow::Continue(())).map_err(failed)
}
