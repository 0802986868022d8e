//! Value maps: the values of a session's policy over the map.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use super::sessions::view;
use crate::camera::Gpu;
use crate::evaluate::gentle_pool;
use crate::geometry::Point2;
use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::path::{Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange, Unavailable};
use crate::learn::{Atlas, AtlasError};
use crate::policy::Policy;
use crate::protocol::{ValueMap, ValueQuery};
use crate::trial::Arena;

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
                let pool = gentle_pool("values")?;
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
    let ValueQuery { goal_m: [x_m, y_m] } = parse(&body)?;
    let view = view(&server, &id)?;
    let arena = view.scenery.arena.clone();
    let goal_m = Point2::new(x_m, y_m);
    if !arena.map.workspace().contains(goal_m) {
        let message = format!("goal_m is ({x_m}, {y_m}), which is outside the workspace");
        return Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "out_of_range", message).field("goal_m"));
    }
    let policy = arena.policy(view.scenery.parameters.rl_policy).map_err(Problem::internal)?;
    // One at a time, so that other long computations get permits.
    let judged = server.work_at(&server.painter, PAINTER_WAITS, move |server| {
        let atlas = server.atlases.of(&arena, &policy, &server.gpu)?;
        let judged = atlas.judge(goal_m)?;
        Ok::<_, NoValues>(ValueMap::of(&atlas, judged))
    });
    Ok(Json(judged.await??))
}
