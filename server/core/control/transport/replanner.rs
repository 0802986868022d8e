//! An optimistic replanner, the reference for planning with limited sight: the shortest path over the obstacles that
//! the camera has observed so far, with everything unobserved free, and a new one whenever an obstacle crosses it.
//!
//! The tool goes where D* Lite (Koenig & Likhachev 2002, AAAI, 476–483) would lead it over the same cells. That
//! algorithm saves time by repairing its last search. Here each search is new, which a few milliseconds allow.
//!
//! It is no controller of the paper, and has no parameters: the clearance is that of ERRT.

use serde::{Deserialize, Serialize};

use super::planning::{Followed, LEAST_CLEARANCE_M, Latest};
use super::{Transport, TransportInput, Trouble};
use crate::control::{Refusal, TargetStep};

/// The transport and its memory.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Replanner {
    followed: Option<Followed>,
    is_walled_off: bool,
    #[serde(skip)]
    latest: Latest,
}

impl Transport for Replanner {
    fn start_leg(&mut self) {
        self.followed = None;
    }

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let most_m = input.parameters.errt_clearance_m;
        let obstacles = self.latest.of(input.known, most_m);
        if !self.followed.as_mut().is_some_and(|path| path.goes_on(&obstacles, input.tool_m, input.goal_m)) {
            let limits_m = [most_m, most_m.min(LEAST_CLEARANCE_M)];
            let path = obstacles.shortest_path(input.tool_m, input.goal_m, limits_m);
            self.followed = path.map(|path| Followed::new(path, input.tool_m));
        }
        self.is_walled_off = self.followed.is_none();
        let Some(followed) = &self.followed else { return Err(Refusal::WalledOff) };
        Ok(followed.next_step(input.tool_m, input.parameters.transport_speed_m_s))
    }

    fn trouble(&self) -> Option<Trouble> {
        self.is_walled_off.then_some(Trouble::WalledOff)
    }
}
