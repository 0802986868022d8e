//! A map prepared for trials.

use std::sync::Arc;

use crate::camera::{Camera, CameraError, Gpu, StaticScene, VIEW_PX};
use crate::control::limits::Limits;
use crate::map::{FreeSpace, Map, MapError, WALL_HEIGHT_M};
use crate::plant::{PositionerKind, TOOL_LENGTH_M};
use crate::policy::{Policy, PolicyError};
use crate::robot;
use crate::scenario::{CLEARANCE_M, Parameters, RlPolicy};

/// A map prepared for trials; many trials share one.
#[derive(Clone, Debug)]
pub struct Arena {
    pub map: Map,
    /// Free space with a clearance of [`CLEARANCE_M`] from walls.
    pub space: FreeSpace,
    /// A policy that replaces the shipped ones.
    pub policy: Option<Arc<Policy>>,
}

impl Arena {
    /// Opens a map by name or path.
    pub fn open(name_or_path: &str) -> Result<Arc<Self>, MapError> {
        Ok(Self::of(Map::open(name_or_path)?))
    }

    pub fn of(map: Map) -> Arc<Self> {
        let space = FreeSpace::new(&map, CLEARANCE_M);
        Arc::new(Self { map, space, policy: None })
    }

    /// The same arena with a policy that replaces the shipped ones.
    pub fn with_policy(self: Arc<Self>, policy: Policy) -> Arc<Self> {
        let mut arena = Arc::unwrap_or_clone(self);
        arena.policy = Some(Arc::new(policy));
        Arc::new(arena)
    }

    /// The policy in use: the arena's own, or else the requested shipped one. `auto` takes one that was trained on the
    /// map's drawing, whatever its name, or else the explorer.
    pub fn policy(&self, asked: RlPolicy) -> Result<Arc<Policy>, PolicyError> {
        match &self.policy {
            Some(own) => Ok(own.clone()),
            None => Policy::shipped(self.policy_name(asked)),
        }
    }

    /// The name of the policy in use; `own` for the arena's own.
    pub fn policy_name(&self, asked: RlPolicy) -> &'static str {
        match asked {
            _ if self.policy.is_some() => "own",
            RlPolicy::Auto => {
                let knows = |name: &&str| Policy::shipped(name).is_ok_and(|policy| self.is_drawn_as_trained(&policy));
                ["colon", "general"].into_iter().find(knows).unwrap_or("explorer")
            }
            RlPolicy::Colon => "colon",
            RlPolicy::General => "general",
            RlPolicy::Explorer => "explorer",
        }
    }

    /// Whether the policy in use was trained on this map's drawing. A policy of one's own names its maps only.
    pub fn is_trained_on(&self, asked: RlPolicy) -> bool {
        let name_is = |name: &String| *name == self.map.name();
        self.policy(asked).is_ok_and(|policy| match &self.policy {
            Some(own) => own.manifest().maps.iter().any(name_is),
            None => self.is_drawn_as_trained(&policy),
        })
    }

    fn is_drawn_as_trained(&self, policy: &Policy) -> bool {
        policy.manifest().maps.iter().any(|name| self.map.is_drawn_like_shipped(name))
    }

    /// Share of the area where trials are set up that the tool reaches.
    pub fn reached_share(&self) -> f64 {
        let flange_m = Parameters::default().tool_height_m + TOOL_LENGTH_M;
        let (PositionerKind::Arm, Some((min_m, max_m))) = (PositionerKind::of(&self.map), robot::reach(flange_m))
        else {
            return 1.0;
        };
        let cells: Vec<_> = self.space.cells().flatten().collect();
        let reached = cells.iter().filter(|cell| (min_m..=max_m).contains(&cell.coords.norm())).count();
        if cells.is_empty() { 1.0 } else { reached as f64 / cells.len() as f64 }
    }

    /// The final limiter for every step on this map.
    pub fn limits(&self, parameters: &Parameters) -> Limits {
        Limits {
            workspace: *self.map.workspace(),
            speed_m_s: parameters.transport_speed_m_s,
            flight_speed_m_s: parameters.approach_speed_m_s,
            tool_orientation: parameters.tool_orientation,
        }
    }

    /// A camera that looks at this map.
    pub fn camera(&self, gpu: &Arc<Gpu>) -> Result<Camera, CameraError> {
        let map = &self.map;
        let static_scene = StaticScene { workspace: map.workspace(), walls: map.walls(), wall_height_m: WALL_HEIGHT_M };
        Camera::new(gpu.clone(), &static_scene, VIEW_PX)
    }
}
