//! A map prepared for trials.

use std::sync::Arc;

use crate::control::Refusal;
use crate::control::limits::Limits;
use crate::geometry::{Point2, Point3};
use crate::image::StaticScene;
use crate::map::{FreeSpace, Map, MapError, WALL_HEIGHT_M};
use crate::plant::{LazyLumen, Lumen, Positioner, PositionerKind, Surroundings, TOOL_LENGTH_M};
use crate::policy::{Policies, Policy, PolicyError, Shipped};
use crate::robot;
use crate::scenario::{CLEARANCE_M, ControllerName, Ground, Parameters, RandomTrialError, RlPolicy, Scenario};

/// A map prepared for trials; many trials share one.
#[derive(Clone, Debug)]
pub struct Arena {
    pub map: Map,
    /// Free space with a clearance of [`CLEARANCE_M`] from walls.
    pub space: FreeSpace,
    lumen: LazyLumen,
    /// A policy that replaces all others.
    pub policy: Option<Arc<Policy>>,
    /// The policies that can be selected.
    policies: Arc<dyn Policies>,
}

impl Arena {
    /// A shipped map by name.
    ///
    /// # Errors
    /// [`MapError::Unknown`].
    pub fn shipped(name: &str) -> Result<Arc<Self>, MapError> {
        Ok(Self::of(Map::shipped(name)?))
    }

    /// A map with the shipped policies.
    pub fn of(map: Map) -> Arc<Self> {
        Self::with_policies(map, Arc::new(Shipped))
    }

    /// A map with the policies of a library.
    pub fn with_policies(map: Map, policies: Arc<dyn Policies>) -> Arc<Self> {
        let space = FreeSpace::new(&map, CLEARANCE_M);
        Arc::new(Self { map, space, lumen: LazyLumen::default(), policy: None, policies })
    }

    /// The same arena with a policy that replaces all others.
    pub fn with_policy(self: Arc<Self>, policy: Policy) -> Arc<Self> {
        let mut arena = Arc::unwrap_or_clone(self);
        arena.policy = Some(Arc::new(policy));
        Arc::new(arena)
    }

    /// The policy in use: the arena's own, or else the requested one. `auto` takes a shipped one that was trained on the
    /// map's drawing, whatever its name, or else the explorer.
    ///
    /// # Errors
    /// [`PolicyError::Unknown`]: an added policy may be deleted.
    pub fn policy(&self, asked: &RlPolicy) -> Result<Arc<Policy>, PolicyError> {
        match (&self.policy, asked) {
            (Some(own), _) => Ok(own.clone()),
            (None, RlPolicy::Auto) => self.policies.find(&self.automatic()),
            (None, asked) => self.policies.find(asked),
        }
    }

    fn automatic(&self) -> RlPolicy {
        let knows = |asked: &RlPolicy| self.policies.find(asked).is_ok_and(|policy| self.is_drawn_as_trained(&policy));
        [RlPolicy::Colon, RlPolicy::General].into_iter().find(knows).unwrap_or(RlPolicy::Explorer)
    }

    /// The name of the policy in use; `own` for the arena's own.
    pub fn policy_name(&self, asked: &RlPolicy) -> String {
        match asked {
            _ if self.policy.is_some() => "own".to_owned(),
            RlPolicy::Auto => self.automatic().to_string(),
            RlPolicy::Added(added) => added.name.clone(),
            shipped => shipped.to_string(),
        }
    }

    /// Whether the policy in use was trained on this map's drawing. A policy that is not shipped names its maps only.
    pub fn is_trained_on(&self, asked: &RlPolicy) -> bool {
        let name_is = |name: &String| *name == self.map.name();
        let is_shipped = self.policy.is_none() && !matches!(asked, RlPolicy::Added(_));
        self.policy(asked).is_ok_and(|policy| match is_shipped {
            true => self.is_drawn_as_trained(&policy),
            false => policy.manifest().maps.iter().any(name_is),
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

    /// The lumen between the map's walls.
    pub fn lumen(&self) -> &Lumen {
        self.lumen.of(&self.map)
    }

    /// What is around the bead. `seed` is that of the contractions' strengths.
    pub fn surroundings(&self, seed: u64) -> Surroundings<'_> {
        Surroundings { map: &self.map, lumen: &self.lumen, seed }
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

    /// The tool above a place, and the positioner that holds it there.
    pub(super) fn above(
        &self,
        place: Point2<f64>,
        kind: PositionerKind,
        parameters: &Parameters,
    ) -> Result<(Point3<f64>, Positioner), Refusal> {
        let tool_m = Point3::new(place.x, place.y, parameters.tool_height_m);
        let positioner = self.limits(parameters).position(tool_m, &Positioner::home(kind, tool_m))?;
        Ok((tool_m, positioner))
    }

    /// The `index`-th random trial of a seed, between places that the tool reaches with the default parameters; `name` is that
    /// of the map, or its path.
    ///
    /// # Errors
    /// [`RandomTrialError`].
    pub fn random(
        &self,
        name: &str,
        controller: ControllerName,
        disturbances: u32,
        seed: u64,
        index: u64,
    ) -> Result<Scenario, RandomTrialError> {
        let (kind, parameters) = (PositionerKind::of(&self.map), Parameters::default());
        let is_reached = |place| self.above(place, kind, &parameters).is_ok();
        let ground = Ground { map: &self.map, name, space: &self.space, is_reached: &is_reached };
        ground.random(controller, disturbances, seed, index)
    }

    /// What a camera sees of this map.
    pub fn static_scene(&self) -> StaticScene<'_> {
        let map = &self.map;
        StaticScene { workspace: map.workspace(), walls: map.walls(), wall_height_m: WALL_HEIGHT_M }
    }
}
