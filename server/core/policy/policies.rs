//! Policies by name.

use std::sync::Arc;

use super::{Policy, PolicyError};
use crate::scenario::RlPolicy;

/// The policies that trials can select.
pub trait Policies: std::fmt::Debug + Send + Sync {
    /// The policy of a reference other than `auto`; that of an added one is found by its hash, whatever its name is now.
    ///
    /// # Errors
    /// [`PolicyError::Unknown`].
    fn find(&self, asked: &RlPolicy) -> Result<Arc<Policy>, PolicyError>;

    /// A reference with the present name and the hash.
    ///
    /// # Errors
    /// [`PolicyError::Unknown`].
    fn resolve(&self, asked: &RlPolicy) -> Result<RlPolicy, PolicyError>;

    /// References of all that are not shipped, oldest first.
    fn added(&self) -> Vec<RlPolicy>;
}

/// The shipped ones only.
#[derive(Clone, Copy, Debug)]
pub struct Shipped;

impl Policies for Shipped {
    fn find(&self, asked: &RlPolicy) -> Result<Arc<Policy>, PolicyError> {
        Policy::shipped(&asked.to_string())
    }

    fn resolve(&self, asked: &RlPolicy) -> Result<RlPolicy, PolicyError> {
        match asked {
            RlPolicy::Added(_) => Err(PolicyError::Unknown { name: asked.to_string(), known: Policy::shipped_names() }),
            shipped => Ok(shipped.clone()),
        }
    }

    fn added(&self) -> Vec<RlPolicy> {
        Vec::new()
    }
}
