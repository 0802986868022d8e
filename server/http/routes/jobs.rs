//! `/api/jobs`: the jobs of all kinds in the background.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use crate::http::Server;
use crate::http::lists;
use crate::http::live::Comparison;
use crate::http::path::{JobPath, OwnerQuery, Path};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, TooMany, Unavailable};
use crate::http::sessions::is_name;
use crate::protocol::{JobPace, JobSummary, Jobs};
use ferry_lab::evaluate::Evaluation;
use ferry_lab::jobs::QueueError;
use ferry_lab::learn::Training;
use ferry_lab::recovery::RecoveryJob;

/// A job of any kind.
enum Found {
    Evaluation(Arc<Evaluation>),
    Recovery(Arc<RecoveryJob>),
    Training(Arc<Training>),
    Comparison(Arc<Comparison>),
}

impl Found {
    fn find(server: &Server, id: &str) -> Result<Self, Problem> {
        let comparison = || server.comparisons.all().into_iter().find(|one| one.id == id).map(Self::Comparison);
        let found = server.evaluations.find(id).map(Self::Evaluation);
        let found = found.or_else(|| server.recoveries.find(id).map(Self::Recovery));
        let found = found.or_else(|| server.trainings.find(id).map(Self::Training)).or_else(comparison);
        found.ok_or_else(|| Problem::not_found("job", id))
    }

    fn pause(&self, server: &Server) -> Result<bool, QueueError> {
        match self {
            Self::Evaluation(job) => server.evaluations.pause(job),
            Self::Recovery(job) => server.recoveries.pause(job),
            Self::Training(job) => Ok(job.pause()),
            Self::Comparison(_) => Ok(false),
        }
    }

    fn resume(&self, server: &Server) -> Result<bool, QueueError> {
        match self {
            Self::Evaluation(job) => server.evaluations.resume(job),
            Self::Recovery(job) => server.recoveries.resume(job),
            Self::Training(job) => server.trainings.resume(job),
            Self::Comparison(_) => Ok(false),
        }
    }

    fn cancel(&self) -> bool {
        match self {
            Self::Evaluation(job) => job.life.cancel(),
            Self::Recovery(job) => job.life.cancel(),
            Self::Training(job) => job.cancel(),
            Self::Comparison(job) => job.life.cancel(),
        }
    }

    fn summary(&self, server: &Server) -> JobSummary {
        match self {
            Self::Evaluation(job) => JobSummary::of_evaluation(job, &server.jobs.paces),
            Self::Recovery(job) => JobSummary::from(&**job),
            Self::Training(job) => JobSummary::from(&**job),
            Self::Comparison(job) => JobSummary::from(&**job),
        }
    }
}

/// The jobs of all kinds, in their order: running, waiting, paused, and those that ended in the last ten minutes.
#[utoipa::path(get, path = "/api/jobs", tag = "jobs", operation_id = "jobs", responses((status = 200, body = Jobs)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<Jobs> {
    Json(Jobs { jobs: lists::jobs(&server), paces: JobPace::all(&server.jobs.paces) })
}

/// Cancels a job; what an evaluation or a recovery map has found is kept, what a training has learned is not.
#[utoipa::path(delete, path = "/api/jobs/{id}", tag = "jobs", params(JobPath), operation_id = "cancel_job",
    responses((status = 202, body = JobSummary), NotFound, Conflict, Unavailable))]
pub async fn cancel(
    State(server): State<Arc<Server>>,
    Path(JobPath { id }): Path<JobPath>,
) -> Result<(StatusCode, Json<JobSummary>), Problem> {
    change(&server, id, |_, job| Ok(job.cancel()), |id| Problem::already_ended("job", id)).await
}

/// Pauses a job, so that the next one of its lane may run. A trial that runs begins again when the job goes on; a training
/// pauses at the end of its present hundred updates. A comparison cannot be paused.
#[utoipa::path(post, path = "/api/jobs/{id}/pause", tag = "jobs", params(JobPath), operation_id = "pause_job",
    responses((status = 202, body = JobSummary), NotFound, Conflict, TooMany, Unavailable))]
pub async fn pause(
    State(server): State<Arc<Server>>,
    Path(JobPath { id }): Path<JobPath>,
) -> Result<(StatusCode, Json<JobSummary>), Problem> {
    let refuse = |id: &str| {
        let detail = format!("job {id:?} neither waits nor runs, or cannot be paused");
        Problem::new(StatusCode::CONFLICT, "not_running", detail)
    };
    change(&server, id, |server, job| job.pause(server), refuse).await
}

/// Lets a paused job, or a training that failed, wait in its lane again.
#[utoipa::path(post, path = "/api/jobs/{id}/resume", tag = "jobs", params(JobPath), operation_id = "resume_job",
    responses((status = 202, body = JobSummary), NotFound, Conflict, TooMany, Unavailable))]
pub async fn resume(
    State(server): State<Arc<Server>>,
    Path(JobPath { id }): Path<JobPath>,
) -> Result<(StatusCode, Json<JobSummary>), Problem> {
    let refuse = |id: &str| Problem::new(StatusCode::CONFLICT, "not_paused", format!("job {id:?} is not paused"));
    change(&server, id, |server, job| job.resume(server), refuse).await
}

/// Changes a job; `refuse` is the answer if it does not allow this. A training writes files.
async fn change(
    server: &Arc<Server>,
    id: String,
    change: impl FnOnce(&Server, &Found) -> Result<bool, QueueError> + Send + 'static,
    refuse: impl FnOnce(&str) -> Problem,
) -> Result<(StatusCode, Json<JobSummary>), Problem> {
    let job = Found::find(server, &id)?;
    let changed = server.work(move |server| Ok::<_, QueueError>(change(server, &job)?.then(|| job.summary(server))));
    let summary = changed.await??.ok_or_else(|| refuse(&id))?;
    Ok((StatusCode::ACCEPTED, Json(summary)))
}

impl OwnerQuery {
    /// The session that starts a job, if one does.
    pub fn owner(self) -> Result<Option<String>, Problem> {
        match self.session {
            Some(name) if !is_name(&name) => {
                let detail = format!("session is {name:?}, which is not the name of a session");
                Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", detail).field("session"))
            }
            session => Ok(session),
        }
    }
}
