//! Jobs in the background.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use ferry_lab::evaluate::Evaluation;
use ferry_lab::jobs::{Lane, Paces, Stage, Ticket};
use ferry_lab::learn::{self, Training};
use ferry_lab::recovery::RecoveryJob;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobStage {
    /// Another job is running in its lane.
    Waiting,
    Running,
    /// Until it is resumed.
    Paused,
    /// Everything is complete.
    Done,
    Cancelled,
    /// It ended with an error.
    Failed,
}

impl JobStage {
    /// The stage, and why the job failed, if it did.
    pub fn of(stage: &Stage) -> (Self, Option<String>) {
        match stage {
            Stage::Waiting => (Self::Waiting, None),
            Stage::Running => (Self::Running, None),
            Stage::Paused => (Self::Paused, None),
            Stage::Done => (Self::Done, None),
            Stage::Cancelled => (Self::Cancelled, None),
            Stage::Failed(message) => (Self::Failed, Some(message.clone())),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobKind {
    Evaluation,
    Recovery,
    Training,
    Comparison,
}

/// A line of jobs, in which one runs and the others wait. Short jobs run beside long ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS, ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobLane {
    /// Less than a minute; a comparison runs at once.
    Short,
    Long,
}

/// A job in the background: waiting, running or paused, or ended in the last ten minutes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct JobSummary {
    /// That of the evaluation, recovery map or training, too.
    pub id: String,
    pub kind: JobKind,
    /// Name of a training's policy, otherwise the maps.
    pub name: String,
    /// The session that started it; `null`: a program did, by the API.
    pub owner: Option<String>,
    pub lane: JobLane,
    pub stage: JobStage,
    /// Why it failed, if it did.
    pub message: Option<String>,
    /// While it waits: the number of jobs before it in its lane.
    pub before: u32,
    /// While it waits: estimated time until these have ended.
    pub starts_in_s: Option<f64>,
    /// Share of its work that is done, 0 to 1.
    pub share: f64,
    /// Estimate of the whole job before its start.
    pub estimate_s: f64,
    /// Estimated time that it still runs; `null` after its end.
    pub left_s: Option<f64>,
    pub can_pause: bool,
    /// Whether there is something to show: a row, a trial, a value map or a branch.
    pub has_results: bool,
}

/// How long a unit of work takes on this machine: guessed, then measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct JobPace {
    /// A trial of an evaluation (`evaluation_rl`, for each controller) or of a recovery map (`recovery`), an update of a
    /// training (`training_quick`, for each recipe), a branch of a comparison (`comparison`).
    pub work: String,
    pub each_s: f64,
}

/// Answer of `GET /api/jobs`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Jobs {
    /// The lane of short jobs, then that of long ones; in each first the one that runs, then those that wait, then the others.
    pub jobs: Vec<JobSummary>,
    pub paces: Vec<JobPace>,
}

impl From<Lane> for JobLane {
    fn from(lane: Lane) -> Self {
        match lane {
            Lane::Short => Self::Short,
            Lane::Long => Self::Long,
        }
    }
}

impl JobPace {
    pub fn all(paces: &Paces) -> Vec<Self> {
        let rounded = |each_s: f64| (each_s * 1e4).round() / 1e4;
        paces.all().into_iter().map(|(work, each_s)| Self { work, each_s: rounded(each_s) }).collect()
    }
}

impl JobSummary {
    /// The job of a ticket, with `done` of `all` units of its work. The order in its lane is not known yet.
    pub fn new(
        (id, kind, name): (&str, JobKind, String),
        ticket: &Ticket,
        (stage, message): (JobStage, Option<String>),
        [done, all]: [f64; 2],
        left_s: f64,
    ) -> Self {
        let is_active = matches!(stage, JobStage::Waiting | JobStage::Running | JobStage::Paused);
        Self {
            id: id.to_owned(),
            kind,
            name,
            owner: ticket.owner.clone(),
            lane: ticket.lane.into(),
            stage,
            message,
            before: 0,
            starts_in_s: None,
            share: if all > 0.0 { (done / all * 1e3).floor().min(1e3) / 1e3 } else { 0.0 },
            estimate_s: ticket.estimate_s.round(),
            left_s: is_active.then(|| left_s.round()),
            can_pause: matches!(stage, JobStage::Waiting | JobStage::Running) && kind != JobKind::Comparison,
            has_results: done > 0.0,
        }
    }

    pub fn of_evaluation(evaluation: &Evaluation, paces: &Paces) -> Self {
        let stage = JobStage::of(&evaluation.life.stage());
        let name = evaluation.query.maps.join(", ");
        let what = (evaluation.id.as_str(), JobKind::Evaluation, name);
        Self::new(what, &evaluation.ticket, stage, evaluation.trials().map(f64::from), evaluation.left_s(paces))
    }
}

impl From<&RecoveryJob> for JobSummary {
    fn from(job: &RecoveryJob) -> Self {
        let name = job.recovery.start.origin.arena.map.name().to_owned();
        let (stage, units) =
            job.life.read(|stage, findings| (JobStage::of(stage), [findings.done as f64, findings.planned as f64]));
        Self::new((job.id.as_str(), JobKind::Recovery, name), &job.ticket, stage, units, job.left_s())
    }
}

impl From<&Training> for JobSummary {
    fn from(training: &Training) -> Self {
        let status = training.status();
        let stage = match &status.stage {
            learn::TrainingStage::Waiting => (JobStage::Waiting, None),
            stage if stage.is_running() => (JobStage::Running, None),
            learn::TrainingStage::Done => (JobStage::Done, None),
            learn::TrainingStage::Cancelled => (JobStage::Cancelled, None),
            learn::TrainingStage::Failed(message) => (JobStage::Failed, Some(message.clone())),
            _ => (JobStage::Paused, None),
        };
        let done = status.points.last().map_or(0, |point| point.update) as f64;
        let all = training.updates_total as f64;
        let left_s = status.left_s.unwrap_or(training.ticket.estimate_s * (1.0 - done / all).max(0.0));
        let what = (training.id.as_str(), JobKind::Training, training.query.name.clone());
        let summary = Self::new(what, &training.ticket, stage, [done, all], left_s);
        let can_pause = summary.can_pause && status.stage != learn::TrainingStage::Examination;
        Self { can_pause, has_results: !status.frames.is_empty(), ..summary }
    }
}
