//! Value maps: the values of a session's policy over the map.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use super::sessions::view;
use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange, Unavailable};
use crate::protocol::{ValueMap, ValueQuery};
use ferry_camera::Gpu;
use ferry_core::control::transport::Carrier;
use ferry_core::geometry::Point2;
use ferry_core::perception::Area;
use ferry_core::policy::{Judgement, Lattice, Policy, PolicyError, Survey};
use ferry_core::trial::{Arena, Sight};
use ferry_lab::jobs::{Lane, gentle_pool};
use ferry_lab::learn::{Atlas, AtlasError};

/// Requests for value maps run one at a time.
const PAINTER_WAITS: Duration = Duration::from_secs(60);
/// Number of kept atlases; one has a few megabytes, thirty with early fusion.
const KEPT: usize = 4;

/// The newest atlases, the newest one last.
pub struct Atlases {
    folder: PathBuf,
    kept: Mutex<Vec<(String, Arc<Atlas>)>>,
}

impl Atlases {
    /// An empty cache; images are kept in a folder.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder, kept: Mutex::default() }
    }

    /// The atlas of a map for a policy. Blocks, the first time for seconds; other requests wait instead of taking the
    /// same images again.
    fn of(&self, arena: &Arena, policy: &Arc<Policy>, gpu: &Arc<Gpu>) -> Result<Arc<Atlas>, NoValues> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same =
            |(svg, atlas): &(String, Arc<Atlas>)| svg == arena.map.svg() && atlas.policy().hash() == policy.hash();
        let known = match kept.iter().position(is_same) {
            Some(index) => kept.remove(index),
            None => {
                // Live sessions continue meanwhile.
                let pool = gentle_pool(Lane::Short, "values")?;
                let atlas = pool.install(|| Atlas::of(arena, policy.clone(), gpu, &self.folder))?;
                (arena.map.svg().to_owned(), Arc::new(atlas))
            }
        };
        let atlas = known.1.clone();
        kept.push(known);
        if kept.len() > KEPT {
            kept.remove(0);
        }
        Ok(atlas)
    }
}

#[derive(Debug, thiserror::Error)]
enum NoValues {
    #[error(transparent)]
    Atlas(#[from] AtlasError),
    #[error(transparent)]
    Policy(#[from] PolicyError),
    #[error("the threads of the value map could not start: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl From<NoValues> for Problem {
    fn from(error: NoValues) -> Self {
        match error {
            NoValues::Atlas(error @ AtlasError::NoRoom { .. }) => {
                Self::new(StatusCode::UNPROCESSABLE_ENTITY, "no_room", error.to_string()).field("map")
            }
            error => Self::internal(error),
        }
    }
}

/// The value map of the session's policy on the session's map.
#[utoipa::path(post, path = "/api/sessions/{id}/values", tag = "sessions", params(SessionPath), request_body = ValueQuery,
    responses((status = 200, body = ValueMap), NotFound, OutOfRange, Unavailable))]
pub async fn values(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
    WholeBody(body): WholeBody,
) -> Result<Json<ValueMap>, Problem> {
    let ValueQuery { goal_m: [x_m, y_m], .. } = parse(&body)?;
    let view = view(&server, &id)?;
    let arena = view.scenery.arena.clone();
    let goal_m = Point2::new(x_m, y_m);
    if !arena.map.workspace().contains(goal_m) {
        let message = format!("goal_m is ({x_m}, {y_m}), which is outside the workspace");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", message).field("goal_m"));
    }
    let policy = arena.policy(&view.scenery.parameters.rl_policy).map_err(Problem::internal)?;
    // One at a time, so that other long computations get permits.
    let judged = server.work_at(&server.painter, PAINTER_WAITS, move |server| {
        if policy.has_memory() {
            let judged = remembered(&policy, &view.sight.1, goal_m)?;
            return Ok::<_, NoValues>(ValueMap::of(&policy, policy.manifest().step_m, judged));
        }
        let atlas = server.atlases.of(&arena, &policy, &server.gpu)?;
        let judged = atlas.judge(goal_m)?;
        Ok(ValueMap::of(&policy, atlas.spacing_m(), judged))
    });
    Ok(Json(judged.await??))
}

/// The values of a policy with a memory, at all cells that are not known to be blocked. On the session's own goal, its
/// visits count.
fn remembered(
    policy: &Policy,
    sight: &Sight,
    goal_m: Point2<f64>,
) -> Result<Vec<(Point2<f64>, Judgement)>, PolicyError> {
    let (known, manifest) = (&sight.known, policy.manifest());
    let mut survey = Survey::over(known, manifest.step_m, manifest.clearance_m, [sight.tool_m, goal_m]);
    if let Carrier::Rl(rl) = &sight.carrier
        && let Some(own) = rl.survey().filter(|own| own.goal == survey.goal && own.shape() == survey.shape())
    {
        for cell in 0..survey.count() {
            survey.set_visits(cell, own.visits(cell).into());
        }
    }
    let cells: Vec<usize> = (0..survey.count()).filter(|&cell| survey.known(cell) != Area::Blocked).collect();
    let judged = policy.plan(&survey)?.judge(&cells)?;
    let lattice = Lattice { workspace: *known.workspace(), step_m: manifest.step_m };
    let centers_m = cells.into_iter().map(|cell| lattice.center_m(survey.place(cell)));
    Ok(centers_m.zip(judged).collect())
}
