//! Parameters in the path and in the query, refused with problem details.

use axum::extract::{FromRequestParts, Path as AxumPath, Query as AxumQuery};
use axum::http::request::Parts;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use utoipa::IntoParams;

use super::problem::Problem;
use ferry_core::scenario::ControllerName;

/// The parameters, by name.
pub struct Path<T>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for Path<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let AxumPath(parameters) = AxumPath::from_request_parts(parts, state)
            .await
            .map_err(|refused| Problem::new(refused.status(), "malformed", refused.body_text()))?;
        Ok(Self(parameters))
    }
}

/// The parameters after `?`.
pub struct Query<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let AxumQuery(parameters) = AxumQuery::from_request_parts(parts, state)
            .await
            .map_err(|refused| Problem::new(refused.status(), "malformed", refused.body_text()))?;
        Ok(Self(parameters))
    }
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct MapPath {
    /// Name of a map.
    #[param(example = "colon")]
    pub name: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct SessionPath {
    /// Name of a session; `main` always exists.
    #[param(example = "main")]
    pub id: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct ProgramPath {
    /// Name of a program.
    #[param(example = "mine")]
    pub name: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct MomentPath {
    /// Name of a session; `main` always exists.
    #[param(example = "main")]
    pub id: String,
    /// A tick; it selects the control step at or before it.
    #[param(example = 0)]
    pub tick: u64,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct JobPath {
    /// Name of an evaluation, a recovery map, a training or a comparison.
    #[param(example = "evaluation-1")]
    pub id: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct OwnerQuery {
    /// Name of the session that starts the job, for the list of jobs.
    #[param(example = "main", pattern = "^[a-z0-9][a-z0-9-]{0,31}$")]
    pub session: Option<String>,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct EvaluationPath {
    /// Name of an evaluation.
    #[param(example = "evaluation-1")]
    pub id: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct ReportPath {
    /// Name of an evaluation.
    #[param(example = "evaluation-1")]
    pub id: String,
    /// `report.html`, `report.csv` or `report.json`.
    #[param(example = "report.html")]
    pub file: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct RecoveryPath {
    /// Name of a recovery map.
    #[param(example = "recovery-1")]
    pub id: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct RecoveryFilePath {
    /// Name of a recovery map.
    #[param(example = "recovery-1")]
    pub id: String,
    /// `map.html` or `map.csv`.
    #[param(example = "map.html")]
    pub file: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct CellPath {
    /// Name of a recovery map.
    #[param(example = "recovery-1")]
    pub id: String,
    /// Number of a cell.
    #[param(example = 0)]
    pub cell: u32,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct TryPath {
    /// Name of a recovery map.
    #[param(example = "recovery-1")]
    pub id: String,
    /// Number of a cell.
    #[param(example = 0)]
    pub cell: u32,
    #[param(example = "errt")]
    pub controller: ControllerName,
    /// Number of the trial, from 0.
    #[param(example = 0)]
    pub repeat: u32,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct TrainingPath {
    /// Name of a training.
    #[param(example = "training-1")]
    pub id: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct FramePath {
    /// Name of a training.
    #[param(example = "training-1")]
    pub id: String,
    /// Number of a value map, from 0.
    #[param(example = 0)]
    pub index: usize,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct PolicyPath {
    /// Name of a policy; to download, with `.safetensors` after it.
    #[param(example = "my-policy")]
    pub file: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct ChallengePath {
    /// Name of a challenge: `easy`, `medium` or `hard`, then `-`, then 1 to 24 of a to z, 0 to 9 and -.
    #[param(example = "easy-2026-11-26")]
    pub name: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct RecordingPath {
    /// Id of a recording; to download, with `.rrd` or `.ferry` after it.
    pub file: String,
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
pub struct ViewerPath {
    /// `re_viewer.js` or `re_viewer_bg.wasm`.
    #[param(example = "re_viewer.js")]
    pub file: String,
}
