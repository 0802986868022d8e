//! Recovery maps.

use serde::{Deserialize, Serialize};
use ts_rs::TS;
use utoipa::ToSchema;

use super::jobs::JobStage;
use ferry_core::scenario::ControllerName;
use ferry_core::schema::Numbers2;
use ferry_lab::recovery::{self, Basin, BasinDifference, CellRow, Findings, Kind, Outcome, RecoveryJob, Tried};

/// Body of `POST /api/recoveries`. The moment is one of a session, or the start of a scenario or of a random trial.
#[derive(Clone, Debug, PartialEq, Deserialize, TS, ToSchema)]
#[serde(deny_unknown_fields, default)]
#[ts(optional_fields)]
pub struct RecoveryQuery {
    /// Name of a session. Without it, and without a scenario and a map, it is `main`.
    pub session: Option<String>,
    /// A tick of the session; omitted: now.
    #[ts(optional, type = "number")]
    pub tick: Option<u64>,
    /// Name of a shipped scenario.
    pub scenario: Option<String>,
    /// Name of a map, shipped or added; start and goal are drawn from the seed.
    pub map: Option<String>,
    pub kind: Kind,
    /// Sub-controllers 2; `program` is the program that is selected in the session.
    #[schema(value_type = std::collections::BTreeSet<ControllerName>, min_items = 1)]
    pub controllers: Vec<ControllerName>,
    /// Number of columns of the finest grid: of places, directions or times.
    #[schema(minimum = 4, maximum = 96)]
    pub grid: u32,
    /// Trials per cell and controller, each with its own noise.
    #[schema(minimum = 1, maximum = 100)]
    pub repeats: u32,
    /// Seed of the noise.
    #[ts(type = "number")]
    pub seed: u64,
    /// A later delivery is late; simulated seconds.
    #[schema(minimum = 1, maximum = 600)]
    pub within_s: f64,
    /// Whether each cell of the finest grid is tried, also where all neighbours agree.
    pub full: bool,
}

impl Default for RecoveryQuery {
    fn default() -> Self {
        Self {
            session: None,
            tick: None,
            scenario: None,
            map: None,
            kind: Kind::Place,
            controllers: ControllerName::OFFERED.to_vec(),
            grid: 24,
            repeats: 3,
            seed: 1,
            within_s: 60.0,
            full: false,
        }
    }
}

impl From<RecoveryQuery> for recovery::RecoveryQuery {
    fn from(value: RecoveryQuery) -> Self {
        let RecoveryQuery { kind, controllers, grid, repeats, seed, within_s, full, .. } = value;
        Self { kind, controllers, grid, repeats, seed, within_s, is_full: full }
    }
}

/// A recovery map without its cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS, ToSchema)]
pub struct RecoverySummary {
    pub id: String,
    pub stage: JobStage,
    /// Why it failed, if it did.
    pub message: Option<String>,
    /// Number of trials that have ended.
    pub done: u32,
    /// Number of trials that are planned; it grows where cells are divided.
    pub planned: u32,
    /// The session of its moment, if it has one, and the number of the trial there, as in the scene.
    pub session: Option<String>,
    #[ts(type = "number | null")]
    pub trial: Option<u64>,
    pub map: String,
    pub kind: Kind,
    /// Sub-controllers 2.
    pub controllers: Vec<ControllerName>,
    /// Their names, or that of the program.
    pub names: Vec<String>,
    pub grid: u32,
    pub repeats: u32,
    #[ts(type = "number")]
    pub seed: u64,
    pub within_s: f64,
    /// Tick of the moment.
    #[ts(type = "number")]
    pub tick: u64,
    /// True position of the bead at the moment.
    #[schema(value_type = Numbers2)]
    pub bead_m: [f64; 2],
    #[schema(value_type = Option<Numbers2>)]
    pub goal_m: Option<[f64; 2]>,
}

/// Answer of `GET /api/recoveries/{id}`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecoveryReport {
    #[serde(flatten)]
    pub summary: RecoverySummary,
    /// One per cell and controller with a trial that has ended.
    pub cells: Vec<CellRow>,
    pub basins: Vec<Basin>,
    pub differences: Vec<BasinDifference>,
}

/// Answer of `GET /api/recoveries`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct Recoveries {
    /// In the order of submission.
    pub recoveries: Vec<RecoverySummary>,
}

/// A trial of a recovery map.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecoveryTrial {
    pub controller: ControllerName,
    /// From 0.
    pub repeat: u32,
    pub outcome: Outcome,
    /// From the moment to the delivery, or to the end of the trial.
    pub time_s: f64,
    /// Control steps since the moment.
    pub steps: u32,
    /// Phase at the end.
    pub phase: String,
    /// The last tick, and hashes of the state after it.
    #[ts(type = "number")]
    pub tick: u64,
    pub world_hash: String,
    pub controller_hash: String,
}

/// Answer of `GET /api/recoveries/{id}/cells/{cell}`.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
pub struct RecoveryTrials {
    /// The trials of the cell that have ended.
    pub trials: Vec<RecoveryTrial>,
}

impl From<&RecoveryJob> for RecoverySummary {
    fn from(job: &RecoveryJob) -> Self {
        job.life.read(|stage, findings| Self::at(job, JobStage::of(stage), findings))
    }
}

impl RecoverySummary {
    fn at(job: &RecoveryJob, (stage, message): (JobStage, Option<String>), findings: &Findings) -> Self {
        let (query, origin) = (&job.recovery.query, &job.recovery.start.origin);
        let world = &origin.state.world;
        let (session, trial) = job.session.clone().unzip();
        Self {
            id: job.id.clone(),
            stage,
            message,
            done: findings.done as u32,
            planned: findings.planned as u32,
            session,
            trial,
            map: origin.arena.map.name().to_owned(),
            kind: query.kind,
            controllers: query.controllers.clone(),
            names: job.recovery.controllers().into_iter().map(str::to_owned).collect(),
            grid: query.grid,
            repeats: query.repeats,
            seed: query.seed,
            within_s: query.within_s,
            tick: world.tick,
            bead_m: world.plant.bead.position_m.coords.into(),
            goal_m: world.goal_m.map(|goal| goal.coords.into()),
        }
    }
}

impl From<&RecoveryJob> for RecoveryReport {
    fn from(job: &RecoveryJob) -> Self {
        let names = job.recovery.controllers();
        job.life.read(|stage, findings| Self {
            summary: RecoverySummary::at(job, JobStage::of(stage), findings),
            cells: CellRow::all(findings, &names),
            basins: Basin::all(findings, &names),
            differences: BasinDifference::all(findings, &names),
        })
    }
}

impl RecoveryTrials {
    /// The trials of a cell; `None` if there is no such cell.
    pub fn of(job: &RecoveryJob, cell: u32) -> Option<Self> {
        job.life.read(|_, findings| {
            let tries = &findings.cells.get(cell as usize)?.tries;
            let of_each = job.recovery.query.controllers.iter().zip(tries);
            let trials = of_each.flat_map(|(&controller, tries)| {
                let ended = tries.iter().zip(0..).filter_map(|(tried, repeat)| Some((tried.as_ref()?, repeat)));
                ended.map(move |(tried, repeat)| RecoveryTrial::of(controller, repeat, tried))
            });
            Some(Self { trials: trials.collect() })
        })
    }
}

impl RecoveryTrial {
    fn of(controller: ControllerName, repeat: u32, tried: &Tried) -> Self {
        Self {
            controller,
            repeat,
            outcome: tried.outcome,
            time_s: tried.time_s,
            steps: tried.steps,
            phase: tried.phase.to_string(),
            tick: tried.tick,
            world_hash: format!("{:016x}", tried.world_hash),
            controller_hash: format!("{:016x}", tried.controller_hash),
        }
    }
}
