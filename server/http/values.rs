//! Value maps: what a session's policy thinks of every place.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use axum::Json;
use axum::extract::{Path, State};
use axum::http::StatusCode;

use super::Server;
use super::api::{parse, view};
use super::body::WholeBody;
use super::problem::Problem;
use crate::camera::Gpu;
use crate::geometry::Point2;
use crate::learn::{Atlas, AtlasError};
use crate::policy::Policy;
use crate::protocol::{ValueMap, ValueQuery};
use crate::trial::Arena;

/// Atlases that are kept; one has some twenty megabytes.
const KEPT: usize = 4;

/// The atlases made last, the newest at the end.
pub struct Atlases {
    folder: PathBuf,
    kept: Mutex<Vec<(String, Arc<Atlas>)>>,
}

impl Atlases {
    /// None yet; their images are kept in a folder.
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { folder, kept: Mutex::default() }
    }

    /// The atlas of a map by a policy. Blocks, for seconds the first time; others then wait, rather than look at the
    /// same map a second time.
    fn of(&self, arena: &Arena, policy: &Arc<Policy>, gpu: &Arc<Gpu>) -> Result<Arc<Atlas>, AtlasError> {
        let mut kept = self.kept.lock().expect("no holder panics");
        let is_same =
            |(svg, atlas): &(String, Arc<Atlas>)| svg == arena.map.svg() && atlas.policy().hash() == policy.hash();
        let known = match kept.iter().position(is_same) {
            Some(index) => kept.remove(index),
            None => {
                let atlas = Atlas::of(arena, policy.clone(), gpu, &self.folder)?;
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

/// `POST /api/sessions/{id}/values`: the value map of the session's policy on the session's map.
pub async fn values(
    State(server): State<Arc<Server>>,
    Path(id): Path<String>,
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
    let judged = tokio::task::spawn_blocking(move || {
        let atlas = server.atlases.of(&arena, &policy, &server.gpu)?;
        ValueMap::of(&atlas, goal_m)
    });
    match judged.await.map_err(Problem::internal)? {
        Ok(map) => Ok(Json(map)),
        Err(AtlasError::Terrain(error)) => {
            Err(Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "no_room", error.to_string()).field("map"))
        }
        Err(error) => Err(Problem::internal(error)),
    }
}
