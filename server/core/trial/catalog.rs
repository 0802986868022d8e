//! The maps and policies that can be chosen by name.

use std::sync::Arc;

use super::{Arena, TrialError};
use crate::map::{self, Map};
use crate::policy::{Policies, Shipped};
use crate::scenario::Parameters;

/// The maps and policies of a server.
#[derive(Clone, Debug)]
pub struct Catalog {
    pub maps: Arc<map::Library>,
    pub policies: Arc<dyn Policies>,
}

impl Default for Catalog {
    fn default() -> Self {
        Self { maps: Arc::default(), policies: Arc::new(Shipped) }
    }
}

impl Catalog {
    /// A map by name, with all policies.
    ///
    /// # Errors
    /// [`TrialError::Map`].
    pub fn arena(&self, map: &str) -> Result<Arc<Arena>, TrialError> {
        Ok(self.arena_of(self.maps.find(map)?))
    }

    /// A map with all policies.
    pub fn arena_of(&self, map: Map) -> Arc<Arena> {
        Arena::with_policies(map, self.policies.clone())
    }

    /// The parameters with the hash of an added policy, so that they never mean another one.
    ///
    /// # Errors
    /// [`TrialError::Policy`], if there is no such policy.
    pub fn resolve(&self, parameters: &mut Parameters) -> Result<(), TrialError> {
        parameters.rl_policy = self.policies.resolve(&parameters.rl_policy)?;
        Ok(())
    }
}
