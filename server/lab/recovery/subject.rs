//! What a recovery map is about: its query and its moment.

use serde::{Deserialize, Serialize};

use super::{Recovery, RecoveryQuery};
use ferry_core::geometry::Point2;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{LoggedMap, TrialError};

/// What a recovery map is about, without what its trials need.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subject {
    pub query: RecoveryQuery,
    /// Names of its controllers, in the order of the query.
    pub controllers: Vec<String>,
    pub map: LoggedMap,
    /// Hash of the policy's file; `None` without RL.
    pub policy_hash: Option<String>,
    /// The moment, and the hash of the world there.
    pub tick: u64,
    pub world_hash: u64,
    /// Bead, tool and goal at the moment.
    pub bead_m: Point2<f64>,
    pub tool_m: Point2<f64>,
    pub goal_m: Option<Point2<f64>>,
    /// Parameters at the moment, other than the default.
    pub changes: Vec<String>,
}

impl Recovery {
    /// # Errors
    /// The policy is not there any more.
    pub fn subject(&self) -> Result<Subject, TrialError> {
        let Self { query, start, .. } = self;
        let (arena, state) = (&start.origin.arena, &start.origin.state);
        let world = &state.world;
        let policy_hash = match query.controllers.contains(&ControllerName::Rl) {
            true => Some(format!("{:016x}", arena.policy(&world.parameters.rl_policy)?.hash())),
            false => None,
        };
        Ok(Subject {
            query: query.clone(),
            controllers: self.controllers().into_iter().map(str::to_owned).collect(),
            map: LoggedMap::from(&arena.map),
            policy_hash,
            tick: world.tick,
            world_hash: state.world_hash(),
            bead_m: world.plant.bead.position_m,
            tool_m: world.plant.positioner.tool_m().xy(),
            goal_m: world.goal_m,
            changes: world.parameters.changes(),
        })
    }
}
