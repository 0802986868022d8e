//! How the tool follows a planned path.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::obstacles::Obstacles;
use super::path::Path;
use crate::control::{CONTROL_PERIOD_S, TargetStep};
use crate::geometry::Point2;
use crate::perception::ObstacleMap;

/// A tool farther from its path than this has left it: the bead was fetched somewhere else.
pub const OFF_PATH_M: f64 = 0.01;
/// A path may lose this much clearance before another is planned: one cell of the map, when more of a wall is observed.
const TOLERANCE_M: f64 = 0.002;

/// The obstacles of the last map version. Not part of the controller state, because the map determines it. A clone is
/// empty: snapshots are many, and this is half a megabyte.
#[derive(Debug, Default)]
pub struct Latest(Option<Arc<Obstacles>>);

impl Clone for Latest {
    fn clone(&self) -> Self {
        Self(None)
    }
}

impl PartialEq for Latest {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Latest {
    /// The obstacles of a map, rebuilt when it has changed.
    pub fn of(&mut self, known: &ObstacleMap, clearance_m: f64) -> Arc<Obstacles> {
        let fits = |made: &&Arc<Obstacles>| made.version() == known.version() && made.most_clearance_m() == clearance_m;
        match self.0.as_ref().filter(fits) {
            Some(made) => made.clone(),
            None => self.0.insert(Arc::new(Obstacles::of(known, clearance_m))).clone(),
        }
    }
}

/// A path and the tool's position along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    #[serde(rename = "way")]
    path: Path,
    along_m: f64,
    /// Allowed distance of the tool; larger at first if the tool starts over a wall.
    off_m: f64,
}

impl Followed {
    /// A path from its beginning, for a tool that may be over a wall.
    pub fn new(path: Path, tool_m: Point2<f64>) -> Self {
        let off_m = OFF_PATH_M.max((path.points[0] - tool_m).norm());
        Self { path, along_m: 0.0, off_m }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Moves along to the tool. `false` for a path that leads to another goal, that the tool has left, or that a new
    /// obstacle crosses.
    pub fn goes_on(&mut self, obstacles: &Obstacles, tool_m: Point2<f64>, goal_m: Point2<f64>) -> bool {
        let (place_m, is_off_m) = self.path.nearest(tool_m, self.along_m);
        if place_m > self.along_m {
            self.off_m = OFF_PATH_M;
        }
        self.along_m = place_m;
        self.path.goal() == goal_m
            && is_off_m <= self.off_m
            && self.path.is_clear_from(self.along_m, obstacles, TOLERANCE_M)
    }

    /// The tool's next step along the path. If it is off the path, its distance to the path counts too.
    pub fn next_step(&self, tool_m: Point2<f64>, limit_m_s: f64) -> TargetStep {
        let reach_m = limit_m_s * CONTROL_PERIOD_S;
        let off_m = (self.path.at(self.along_m) - tool_m).norm();
        let ahead_m = self.path.at(self.along_m + (reach_m - off_m).max(0.0));
        let target_m = tool_m + (ahead_m - tool_m).cap_magnitude(reach_m);
        let speed_m_s = (target_m - tool_m).norm() / CONTROL_PERIOD_S;
        TargetStep { target_m, speed_m_s: speed_m_s.min(limit_m_s) }
    }
}
