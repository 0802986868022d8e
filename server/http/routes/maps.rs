//! `/api/maps`: shipped maps and uploaded ones, which are kept in the data folder.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use tokio::sync::watch;
use utoipa::{IntoParams, ToSchema};

use crate::http::Server;
use crate::http::body::{WholeBody, attachment};
use crate::http::path::{MapPath, Path, Query};
use crate::http::problem::Problem;
use crate::http::refusals::{NotFound, OutOfRange, TooMany, Unavailable};
use crate::map::{Library, MAX_SVG_BYTES, MapError, Summary};
use crate::protocol::MapReport;
use crate::scenario::CLEARANCE_M;
use crate::trial::Arena;

/// A drawing of a map.
fn example() -> serde_json::Value {
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-300 210 580 330\">\
                       <rect x=\"-20\" y=\"300\" width=\"40\" height=\"30\"/></svg>";
    drawing.into()
}

/// File with the names of removed maps, one per line.
const REMOVED: &str = "removed-names";

/// The folder of uploaded maps.
pub struct Maps {
    pub all: Arc<Library>,
    folder: PathBuf,
    version: watch::Sender<u64>,
}

impl Maps {
    /// The library with the maps of the folder. An invalid file is skipped with a warning.
    pub fn in_folder(folder: PathBuf) -> Self {
        let library = Arc::new(Library::default());
        // Without the folder there are no uploaded maps.
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let mut paths: Vec<_> =
            entries.map(|entry| (entry.metadata().and_then(|data| data.modified()).ok(), entry.path())).collect();
        // The oldest first.
        paths.sort();
        let removed = std::fs::read_to_string(folder.join(REMOVED)).unwrap_or_default();
        removed.lines().for_each(|name| library.retire(name));
        for (_, path) in paths {
            let small = std::fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MAX_SVG_BYTES as u64);
            let Some(name) = path.file_name().and_then(|name| name.to_str()?.strip_suffix(".svg")) else { continue };
            let text = small.then(|| std::fs::read_to_string(&path).ok()).flatten();
            let restored = text.map(|text| library.restore(name, &text));
            if !matches!(restored, Some(Ok(()))) {
                tracing::warn!(path = %path.display(), ?restored, "uploaded map left out");
            }
        }
        Self { all: library, folder, version: watch::Sender::new(0) }
    }

    /// Changes whenever the list of maps changes.
    pub fn changes(&self) -> watch::Receiver<u64> {
        self.version.subscribe()
    }

    fn changed(&self) {
        self.version.send_modify(|version| *version += 1);
    }

    fn add(&self, Wish { name: wished, fit }: Wish, svg: String) -> Result<MapReport, Problem> {
        let svg = if fit { crate::map::fit(&svg)? } else { svg };
        let map = self.all.add(wished.as_deref(), &svg)?;
        let name = map.name().to_owned();
        let kept = std::fs::create_dir_all(&self.folder)
            .and_then(|()| std::fs::write(self.folder.join(format!("{name}.svg")), &svg));
        kept.map_err(|error| {
            self.all.remove(&name);
            Problem::new(StatusCode::INSUFFICIENT_STORAGE, "not_kept", format!("the map could not be stored: {error}"))
        })?;
        self.changed();
        let summary = Summary::of(&map, CLEARANCE_M);
        Ok(MapReport::new(name, summary, Arena::of(map).reached_share()))
    }

    fn remove(&self, name: &str) -> Result<(), Problem> {
        let map = self.all.remove(name).ok_or_else(|| Problem::not_found("uploaded map", name))?;
        self.changed();
        // The name is kept, so that it is not given to another drawing after a restart.
        let noted = std::fs::OpenOptions::new()
            .create(true)
            .append(true)
            .open(self.folder.join(REMOVED))
            .and_then(|mut file| writeln!(file, "{}", map.name()));
        noted.map_err(Problem::internal)?;
        std::fs::remove_file(self.folder.join(format!("{}.svg", map.name()))).map_err(Problem::internal)
    }
}

impl From<MapError> for Problem {
    fn from(error: MapError) -> Self {
        let (status, code) = match &error {
            MapError::Unknown { .. } => (StatusCode::NOT_FOUND, "not_found"),
            MapError::TooMany { .. } => (StatusCode::TOO_MANY_REQUESTS, "too_many_maps"),
            MapError::TooLarge { .. } => (StatusCode::PAYLOAD_TOO_LARGE, "too_large"),
            _ => (StatusCode::UNPROCESSABLE_ENTITY, "map_refused"),
        };
        Self::new(status, code, error.to_string()).field("map")
    }
}

#[derive(Serialize, ToSchema)]
pub struct MapNames {
    maps: Vec<String>,
}

/// The shipped maps, then the uploaded ones.
#[utoipa::path(get, path = "/api/maps", tag = "maps", operation_id = "maps", responses((status = 200, body = MapNames)))]
pub async fn list(State(server): State<Arc<Server>>) -> Json<MapNames> {
    Json(MapNames { maps: server.maps.all.names() })
}

#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct Wish {
    /// Wished name. The map gets it if it is valid and new, otherwise `map-` and a number.
    #[param(example = "two-rooms")]
    name: Option<String>,
    /// Moves the drawing into the arm's reach and shrinks it if it is larger.
    #[serde(default)]
    fit: bool,
}

/// Adds the drawing in the body.
#[utoipa::path(post, path = "/api/maps", tag = "maps", operation_id = "add_map", params(Wish),
    request_body(content = String, content_type = "image/svg+xml", description = "SVG in millimetres.", example = example),
    responses((status = 201, body = MapReport), OutOfRange, TooMany, Unavailable))]
pub async fn add(
    State(server): State<Arc<Server>>,
    Query(wish): Query<Wish>,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let svg = String::from_utf8(body.into()).map_err(|error| {
        Problem::new(StatusCode::BAD_REQUEST, "malformed", format!("the drawing is not UTF-8: {error}")).field("map")
    })?;
    let adding = server.work(move |server| server.maps.add(wish, svg)).await?;
    let report = adding?;
    let location = format!("/api/maps/{}", report.name);
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], Json(report)).into_response())
}

/// A map's drawing as a file.
#[utoipa::path(get, path = "/api/maps/{name}", tag = "maps", operation_id = "map", params(MapPath),
    responses((status = 200, description = "SVG in millimetres.", content_type = "image/svg+xml", body = String), NotFound))]
pub async fn file(
    State(server): State<Arc<Server>>,
    Path(MapPath { name }): Path<MapPath>,
) -> Result<Response, Problem> {
    let map = server.maps.all.find(&name).map_err(|error| Problem::from(error).field("name"))?;
    Ok(attachment("image/svg+xml", &format!("{}.svg", map.name()), map.svg().to_owned()))
}

/// Deletes an uploaded map; sessions that have loaded it keep it.
#[utoipa::path(delete, path = "/api/maps/{name}", tag = "maps", operation_id = "delete_map", params(MapPath),
    responses((status = 204, description = "The map is deleted."), NotFound, Unavailable))]
pub async fn delete(
    State(server): State<Arc<Server>>,
    Path(MapPath { name }): Path<MapPath>,
) -> Result<StatusCode, Problem> {
    server.work(move |server| server.maps.remove(&name)).await??;
    Ok(StatusCode::NO_CONTENT)
}
