//! Policies.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::trainings::{Examination, TrainingPoint};
use ferry_core::policy::{Manifest, Policies as _, Policy};
use ferry_core::scenario::RlPolicy;
use ferry_lab::learn::{self, Added, Library, TrainingQuery};

/// How a policy was trained on this server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PolicyOrigin {
    pub query: TrainingQuery,
    /// The last examination.
    pub examined: Examination,
    /// Time spent on the training.
    pub elapsed_s: f64,
    /// At most 50 points.
    pub curve: Vec<TrainingPoint>,
}

/// A policy that can be selected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct PolicySummary {
    pub name: String,
    /// What the parameter `rl_policy` takes: the name of a shipped one, `NAME@HASH` of an added one.
    pub reference: String,
    pub is_shipped: bool,
    /// Maps used in training.
    pub maps: Vec<String>,
    #[ts(type = "number")]
    pub seed: u64,
    #[ts(type = "number")]
    pub updates: u64,
    /// Whether it remembers what the camera has seen; it cannot be trained further on one map.
    pub has_memory: bool,
    /// Missing for shipped and uploaded policies.
    pub origin: Option<PolicyOrigin>,
}

/// Answer of `GET /api/policies`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Policies {
    /// The shipped ones, then the added ones, oldest first.
    pub policies: Vec<PolicySummary>,
}

/// Body of `PATCH /api/policies/{name}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PolicyName {
    /// The new name.
    #[schema(pattern = "^[a-z0-9][a-z0-9_-]{0,39}$")]
    pub name: String,
}

impl PolicySummary {
    fn of(name: String, reference: &RlPolicy, policy: &Policy) -> Self {
        let Manifest { maps, seed, updates, .. } = policy.manifest().clone();
        Self {
            name,
            reference: reference.to_string(),
            is_shipped: !matches!(reference, RlPolicy::Added(_)),
            maps,
            seed,
            updates,
            has_memory: policy.has_memory(),
            origin: None,
        }
    }
}

impl From<&Added> for PolicySummary {
    fn from(added: &Added) -> Self {
        // What another version has written may not be readable.
        let origin = added.origin.as_deref().and_then(|text| serde_json::from_str::<learn::Origin>(text).ok());
        Self { origin: origin.map(Into::into), ..Self::of(added.name.clone(), &added.reference(), &added.policy) }
    }
}

impl From<learn::Origin> for PolicyOrigin {
    fn from(origin: learn::Origin) -> Self {
        let learn::Origin { query, examined, elapsed_s, curve } = origin;
        Self {
            query,
            examined: Examination::from(&examined),
            elapsed_s,
            curve: curve.iter().map(TrainingPoint::from).collect(),
        }
    }
}

impl Policies {
    /// All policies of a library.
    pub fn of(library: &Library) -> Self {
        let shipped = Policy::shipped_names().into_iter().filter_map(|name| {
            let reference: RlPolicy = name.parse().ok()?;
            let policy = library.find(&reference).ok()?;
            Some(PolicySummary::of(name, &reference, &policy))
        });
        let added = library.all();
        Self { policies: shipped.chain(added.iter().map(PolicySummary::from)).collect() }
    }
}
