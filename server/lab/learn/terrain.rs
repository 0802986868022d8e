//! A map for training: a graph of the cells where the tool may be, with the image above each.

use std::collections::VecDeque;

use ferry_core::geometry::{Point2, Rect};
use ferry_core::perception::Observation;
use ferry_core::plant::{Peristalsis, WallMotion};
use ferry_core::policy::Action;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::Parameters;
use ferry_core::trial::{Arena, GOAL_RADIUS_M};

use super::sweep::{IMAGE_BYTES, STEP_M, Sweep, center};

/// The most terrains of a training.
pub const MOST_TERRAINS: usize = 256;
/// Moments of a contraction.
const WALL_MOMENTS: usize = 8;
/// Distance without a path.
pub const UNREACHABLE: u16 = u16::MAX;

/// Cells where an episode can continue, numbered from 0, and the result of each action.
pub struct Terrain {
    name: String,
    workspace: Rect,
    centers_m: Vec<Point2<f64>>,
    next: Vec<[Option<u16>; 4]>,
    /// `[cells][cells]`: steps from the row's cell to the column's.
    distance: Vec<u16>,
    /// `[cells][84 · 84]`.
    images: Vec<u8>,
}

/// Too few cells for learning, or no path between distant cells.
#[derive(Debug, thiserror::Error)]
#[error(
    "map: {map:?} has {cells} cells that keep {clearance_m} m from the walls; training needs 2 to {}, and a \
     path between two that are more than {GOAL_RADIUS_M} m apart",
    UNREACHABLE
)]
pub struct TerrainError {
    pub map: String,
    pub cells: usize,
    /// Required distance from walls.
    pub clearance_m: f64,
}

impl Terrain {
    /// The cells of a sweep whose image is free of obstacles and keeps `clearance_m` (0 as in the paper), and the steps
    /// between them that the limits admit.
    ///
    /// # Errors
    /// [`TerrainError`].
    pub fn new(name: &str, workspace: &Rect, sweep: &Sweep, clearance_m: f64) -> Result<Self, TerrainError> {
        let cells = sweep.columns * sweep.rows;
        let free = sweep.free(clearance_m);
        let refusal = || TerrainError { map: name.to_owned(), cells: free.len(), clearance_m };
        if !(2..usize::from(UNREACHABLE)).contains(&free.len()) {
            return Err(refusal());
        }
        let mut index = vec![None; cells];
        for (i, &cell) in free.iter().enumerate() {
            index[cell] = Some(i as u16);
        }
        let step = |cell: usize, action: usize| {
            if sweep.steps[cell] & (1 << action) == 0 {
                return None;
            }
            let (dx, dy) = Action::ALL[action].offset();
            let column = (cell % sweep.columns).checked_add_signed(dx).filter(|&c| c < sweep.columns)?;
            let row = (cell / sweep.columns).checked_add_signed(dy).filter(|&r| r < sweep.rows)?;
            index[row * sweep.columns + column]
        };
        let next: Vec<[Option<u16>; 4]> =
            free.iter().map(|&cell| std::array::from_fn(|action| step(cell, action))).collect();
        let at = |&cell: &usize| center(workspace, sweep.spacing_m, cell % sweep.columns, cell / sweep.columns);
        let terrain = Self {
            name: name.to_owned(),
            workspace: *workspace,
            centers_m: free.iter().map(at).collect(),
            distance: distances(&next),
            next,
            images: free.iter().flat_map(|&cell| sweep.image(cell)).copied().collect(),
        };
        if terrain.has_path(|_| true) { Ok(terrain) } else { Err(refusal()) }
    }

    /// Whether a path exists to one of these cells from another that has not reached it already; without one, no episode
    /// could begin.
    pub fn has_path(&self, is_goal: impl Fn(u16) -> bool) -> bool {
        let cells = 0..self.cells() as u16;
        let leads = |from: u16, to: u16| {
            self.distance(from, to) != UNREACHABLE && (self.center_m(from) - self.center_m(to)).norm() > GOAL_RADIUS_M
        };
        cells.clone().filter(|&to| is_goal(to)).any(|to| cells.clone().any(|from| leads(from, to)))
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    pub fn cells(&self) -> usize {
        self.next.len()
    }

    /// Centre of a cell.
    pub fn center_m(&self, cell: u16) -> Point2<f64> {
        self.centers_m[usize::from(cell)]
    }

    /// The cell after a step; `None` if the step ends the episode.
    pub fn step(&self, cell: u16, action: usize) -> Option<u16> {
        self.next[usize::from(cell)][action]
    }

    /// Length of the shortest path in steps; `u16::MAX` without a path.
    pub fn distance(&self, from: u16, to: u16) -> u16 {
        self.distance[usize::from(from) * self.cells() + usize::from(to)]
    }

    /// The image above a cell, `[84 · 84]`.
    pub fn image(&self, cell: u16) -> &[u8] {
        &self.images[usize::from(cell) * IMAGE_BYTES..(usize::from(cell) + 1) * IMAGE_BYTES]
    }

    /// The images above all cells.
    pub fn images(&self) -> Vec<&[u8]> {
        self.images.chunks_exact(IMAGE_BYTES).collect()
    }

    /// Content of the second channel for a goal and a tool above a cell.
    pub fn places(&self, goal_m: Point2<f64>, cell: u16) -> [f32; 4] {
        places(&self.workspace, goal_m, self.center_m(cell))
    }
}

impl std::fmt::Debug for Terrain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Terrain of {} with {} cells", self.name, self.cells())
    }
}

/// How far the walls of a map close in at the moments that are learned: at rest (empty), and if `amplitude_m` is above 0,
/// at eight moments of a wave of the default length.
pub fn wall_waves_m(arena: &Arena, amplitude_m: f64) -> Vec<Vec<f64>> {
    let peristalsis = Peristalsis { amplitude_m, ..Parameters::default().plant().peristalsis };
    let motion = WallMotion::in_full(&peristalsis, 0);
    let moment = |number: usize| {
        let tick = number as f64 / WALL_MOMENTS as f64 * peristalsis.period_s / SERVO_PERIOD_S;
        motion.map(|motion| arena.surroundings(0).wave_m(&motion, tick as u64))
    };
    std::iter::once(Vec::new()).chain((0..WALL_MOMENTS).filter_map(moment)).collect()
}

/// The images above cells, each given by its terrain's index and its number.
pub fn views<'a>(terrains: &'a [Terrain], cells: &[(u8, u16)]) -> Vec<&'a [u8]> {
    cells.iter().map(|&(terrain, cell)| terrains[usize::from(terrain)].image(cell)).collect()
}

/// Content of an observation's second channel for a goal and a tool: x and y of each, 0 to 1.
pub fn places(workspace: &Rect, goal_m: Point2<f64>, tool_m: Point2<f64>) -> [f32; 4] {
    let [goal, tool] = [goal_m, tool_m].map(|place| Observation::scaled(place, workspace));
    [goal[0], goal[1], tool[0], tool[1]].map(|level| f32::from(level) / 255.0)
}

/// Steps between all pairs, by a breadth-first search toward each cell, because steps are not always possible in both
/// directions.
fn distances(next: &[[Option<u16>; 4]]) -> Vec<u16> {
    let cells = next.len();
    let mut before = vec![Vec::new(); cells];
    for (cell, after_actions) in next.iter().enumerate() {
        for &to in after_actions.iter().flatten() {
            before[usize::from(to)].push(cell);
        }
    }
    let mut distance = vec![UNREACHABLE; cells * cells];
    let mut queue = VecDeque::new();
    for to in 0..cells {
        distance[to * cells + to] = 0;
        queue.push_back(to);
        while let Some(cell) = queue.pop_front() {
            let steps = distance[cell * cells + to] + 1;
            for &earlier in &before[cell] {
                if distance[earlier * cells + to] == UNREACHABLE {
                    distance[earlier * cells + to] = steps;
                    queue.push_back(earlier);
                }
            }
        }
    }
    distance
}

/// Largest offset of a goal from its cell's centre, along each axis.
pub const GOAL_JITTER_M: f64 = 0.5 * STEP_M;

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub const WORKSPACE: Rect = Rect { x_min_m: 0.0, x_max_m: 0.06, y_min_m: 0.0, y_max_m: 0.05 };

    /// Six by five cells with a wall in the middle that leaves the top row free. Each cell has a different image.
    pub fn two_rooms() -> Terrain {
        let (columns, rows) = (6, 5);
        let wall = |cell: usize| cell % columns == 3 && cell / columns < rows - 1;
        let free = |cell: usize, action: usize| {
            let (dx, dy) = Action::ALL[action].offset();
            let column = (cell % columns).checked_add_signed(dx).filter(|&c| c < columns);
            let row = (cell / columns).checked_add_signed(dy).filter(|&r| r < rows);
            column.zip(row).is_some_and(|(column, row)| !wall(row * columns + column))
        };
        let cells = 0..columns * rows;
        let steps = |cell| (0..4).filter(|&action| free(cell, action)).map(|action| 1 << action).sum();
        let sweep = Sweep {
            spacing_m: STEP_M,
            columns,
            rows,
            obstacle: cells.clone().map(wall).collect(),
            steps: cells.clone().map(steps).collect(),
            wall_distance: cells.clone().map(|cell| if wall(cell) { 0 } else { 255 }).collect(),
            images: cells.flat_map(|cell| vec![8 * cell as u8; IMAGE_BYTES]).collect(),
        };
        Terrain::new("rooms", &WORKSPACE, &sweep, 0.008).unwrap()
    }

    #[test]
    fn paths_go_around_the_wall() {
        let terrain = two_rooms();
        assert_eq!(terrain.cells(), 26);
        let at =
            |x: f64, y: f64| (0..26).find(|&cell| (terrain.center_m(cell) - Point2::new(x, y)).norm() < 1e-9).unwrap();
        let (left, right) = (at(0.025, 0.005), at(0.045, 0.005));
        assert_eq!(terrain.distance(left, right), 10);
        assert_eq!(terrain.step(left, 0), None, "into the wall");
        assert_eq!(terrain.step(left, 2), Some(at(0.025, 0.015)));
        assert_eq!(terrain.step(left, 3), None, "out of the workspace");
        assert_eq!(terrain.image(right)[0], 32);
        // The last value is 25.5 levels before rounding.
        assert_eq!(terrain.places(Point2::new(0.06, 0.0), left), [1.0, 0.0, 106.0 / 255.0, 25.0 / 255.0]);
    }

    /// One row of free cells, each with its possible steps.
    pub fn corridor(steps: &[u8]) -> Result<Terrain, TerrainError> {
        let columns = steps.len();
        let sweep = Sweep {
            spacing_m: STEP_M,
            columns,
            rows: 1,
            obstacle: vec![false; columns],
            steps: steps.to_vec(),
            wall_distance: vec![255; columns],
            images: vec![0; columns * IMAGE_BYTES],
        };
        Terrain::new("corridor", &WORKSPACE, &sweep, 0.008)
    }

    #[test]
    fn refuses_a_map_without_a_path() {
        assert!(corridor(&[1, 3, 3, 2]).is_ok());
        // Three cells are within 2 cm of each other; with four, the outer ones are not.
        for steps in [&[1, 3, 2][..], &[0; 4], &[1, 2, 1, 2]] {
            let error = corridor(steps).unwrap_err();
            assert!(error.to_string().contains("a path between two that are more than 0.02 m apart"), "{error}");
        }
    }

    #[test]
    fn refuses_a_map_that_is_too_narrow_and_names_it() {
        let sweep = Sweep {
            spacing_m: STEP_M,
            columns: 2,
            rows: 1,
            obstacle: vec![false; 2],
            steps: vec![0; 2],
            wall_distance: vec![50, 90],
            images: vec![0; 2 * IMAGE_BYTES],
        };
        let error = Terrain::new("slit", &WORKSPACE, &sweep, 0.008).unwrap_err();
        assert!(error.to_string().contains("\"slit\" has 1 cells"), "{error}");
    }
}
