//! `/api/maps`: shipped maps and uploaded ones, which are kept in the data folder.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind, Write};
use std::path::{Path as FilePath, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::http::Server;
use crate::http::body::{WholeBody, attachment};
use crate::http::path::{MapPath, Path, Query};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::protocol::{MapCheck, MapFacts, MapReport};
use ferry_core::map::{Library, MAX_SVG_BYTES, Map, MapError, READER, Summary, decoded, first_reader, is_added};
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::trial::Arena;
use ferry_files::replace;
use ferry_lab::changes::Changes;

/// A drawing of a map.
fn example() -> serde_json::Value {
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-300 210 580 330\">\
                       <rect x=\"-20\" y=\"300\" width=\"40\" height=\"30\"/></svg>";
    drawing.into()
}

/// File with the names of removed maps, one per line.
const REMOVED: &str = "removed-names";

/// File with the readers of maps, one per line, such as `two-rooms 2`. A map without a line was read by the first one.
const READERS: &str = "readers";

/// The folder of uploaded maps.
pub struct Maps {
    pub all: Arc<Library>,
    folder: PathBuf,
    /// Map of the opening scenario. It is not deleted, because each new session needs it.
    needed: String,
    /// Held while a map is added or removed, so that library and folder agree.
    changing: Mutex<()>,
    pub changes: Changes,
}

/// The names of removed maps.
fn removed_names(path: &FilePath) -> BTreeSet<String> {
    match std::fs::read(path) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).lines().map(str::to_owned).collect(),
        Err(error) if error.kind() == ErrorKind::NotFound => BTreeSet::new(),
        Err(error) => {
            tracing::warn!(path = %path.display(), %error, "names of removed maps are unknown: they may be given again");
            BTreeSet::new()
        }
    }
}

/// The readers of maps.
fn readers(path: &FilePath) -> BTreeMap<String, u32> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let one =
        |line: &str| line.split_once(' ').and_then(|(name, reader)| Some((name.to_owned(), reader.parse().ok()?)));
    text.lines().filter_map(one).collect()
}

impl Maps {
    /// The library with the maps of the folder. A file that is not a valid map is left out with a warning; its name is
    /// reserved, so that no other drawing replaces it.
    pub fn in_folder(folder: PathBuf, needed: String) -> Self {
        let library = Arc::new(Library::default());
        // Without the folder there are no uploaded maps.
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let mut paths: Vec<_> =
            entries.map(|entry| (entry.metadata().and_then(|data| data.modified()).ok(), entry.path())).collect();
        // The oldest first.
        paths.sort();
        let removed = removed_names(&folder.join(REMOVED));
        removed.iter().for_each(|name| library.reserve(name));
        let readers = readers(&folder.join(READERS));
        for (_, path) in paths {
            let small = std::fs::metadata(&path).is_ok_and(|data| data.is_file() && data.len() <= MAX_SVG_BYTES as u64);
            let Some(name) = path.file_name().and_then(|name| name.to_str()?.strip_suffix(".svg")) else { continue };
            if removed.contains(name) {
                // The server ended while it removed the map.
                let _ = std::fs::remove_file(&path);
                continue;
            }
            library.reserve(name);
            let text = small.then(|| std::fs::read_to_string(&path).ok()).flatten();
            let reader = readers.get(name).copied().unwrap_or_else(first_reader);
            let restored = text.map(|text| library.restore(name, &text, reader));
            if !matches!(restored, Some(Ok(()))) {
                tracing::warn!(path = %path.display(), ?restored, "uploaded map left out");
            }
        }
        Self { all: library, folder, needed, changing: Mutex::default(), changes: Changes::default() }
    }

    fn add(&self, Wish { name: wished, fit }: Wish, svg: String) -> Result<MapReport, Problem> {
        let svg = if fit { ferry_core::map::fit(&svg)? } else { svg };
        let map = Map::from_svg("", &svg)?;
        let map = {
            let _one_at_a_time = self.changing();
            let map = self.all.add(wished.as_deref(), map)?;
            // First the reader: a drawing without one would be an old one.
            let kept = std::fs::create_dir_all(&self.folder)
                .and_then(|()| self.append(READERS, &format!("{} {READER}", map.name())))
                .and_then(|()| replace(&self.path(map.name()), svg.as_bytes()));
            kept.map_err(|error| {
                self.all.remove(map.name());
                let detail = format!("the map could not be stored: {error}");
                Problem::new(StatusCode::INSUFFICIENT_STORAGE, "not_kept", detail)
            })?;
            map
        };
        self.changes.note();
        let (name, summary) = (map.name().to_owned(), Summary::of(&map, BEAD_RADIUS_M));
        Ok(MapReport { name, facts: MapFacts::new(&summary, Arena::of(map).reached_share()) })
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.svg"))
    }

    fn changing(&self) -> std::sync::MutexGuard<'_, ()> {
        self.changing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn remove(&self, name: &str) -> Result<(), Problem> {
        let _one_at_a_time = self.changing();
        let added = self.all.find(name).is_ok_and(|map| is_added(map.name()));
        if !added {
            return Err(Problem::not_found("uploaded map", name));
        }
        if name == self.needed {
            let detail = format!("new sessions begin with the map {name:?} (--scenario)");
            return Err(Problem::new(StatusCode::CONFLICT, "in_use", detail).field("name"));
        }
        // First the name, so that it is not given to another drawing after a crash. A full disk has room for it only
        // without the drawing.
        let noted = self.note_removed(name);
        match std::fs::remove_file(self.path(name)) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(Problem::internal(error)),
            _ => {}
        }
        if let Err(error) = noted.or_else(|_| self.note_removed(name)) {
            tracing::warn!(%error, name, "the name of a removed map could not be kept: it may be given again");
        }
        self.all.remove(name);
        self.changes.note();
        Ok(())
    }

    fn note_removed(&self, name: &str) -> std::io::Result<()> {
        self.append(REMOVED, name)
    }

    /// Appends a line to a file of the folder.
    fn append(&self, file: &str, line: &str) -> std::io::Result<()> {
        let mut file = std::fs::OpenOptions::new().create(true).append(true).open(self.folder.join(file))?;
        file.write_all(format!("{line}\n").as_bytes())
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
    let svg = decoded(&body)?;
    let adding = server.work(move |server| server.maps.add(wish, svg)).await?;
    let report = adding?;
    let location = format!("/api/maps/{}", report.name);
    Ok((StatusCode::CREATED, [(header::LOCATION, location)], Json(report)).into_response())
}

/// Tells what the drawing in the body would be as a map, without adding it.
#[utoipa::path(post, path = "/api/map-checks", tag = "maps", operation_id = "check_map",
    request_body(content = String, content_type = "image/svg+xml", description = "SVG in millimetres.", example = example),
    responses((status = 200, body = MapCheck), OutOfRange, Unavailable))]
pub async fn check(State(server): State<Arc<Server>>, WholeBody(body): WholeBody) -> Result<Json<MapCheck>, Problem> {
    let svg = decoded(&body)?;
    let checking = server.work(move |_| {
        let map = Map::from_svg("drawing", &svg)?;
        let (summary, arena) = (Summary::of(&map, BEAD_RADIUS_M), Arena::of(map.clone()));
        Ok::<_, Problem>(MapCheck::new(&map, &summary, arena.reached_share()))
    });
    Ok(Json(checking.await??))
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
    responses((status = 204, description = "The map is deleted."), NotFound, Conflict, Unavailable))]
pub async fn delete(
    State(server): State<Arc<Server>>,
    Path(MapPath { name }): Path<MapPath>,
) -> Result<StatusCode, Problem> {
    server.work(move |server| server.maps.remove(&name)).await??;
    Ok(StatusCode::NO_CONTENT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn maps(folder: &FilePath) -> Maps {
        Maps::in_folder(folder.to_owned(), "posts".into())
    }

    fn drawing(name: &str) -> String {
        ferry_core::map::Map::shipped(name).unwrap().svg().to_owned()
    }

    fn add(maps: &Maps, name: &str, svg: String) -> String {
        let wish = Wish { name: Some(name.to_owned()), fit: false };
        maps.add(wish, svg).unwrap_or_else(|problem| panic!("{problem:?}")).name
    }

    #[test]
    fn a_file_that_is_left_out_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("mine.svg"), "<svg").unwrap();
        let maps = maps(folder.path());
        assert!(maps.all.find("mine").is_err());
        assert_eq!(add(&maps, "mine", drawing("open")), "map-1");
        assert_eq!(std::fs::read_to_string(folder.path().join("mine.svg")).unwrap(), "<svg");
    }

    #[test]
    fn a_removed_map_stays_removed_and_its_name_is_not_given_again() {
        let folder = tempfile::tempdir().unwrap();
        let first = maps(folder.path());
        assert_eq!(add(&first, "mine", drawing("open")), "mine");
        first.remove("mine").unwrap();
        assert!(first.remove("mine").is_err());
        // The server ended between the note and the removal of the file.
        std::fs::write(folder.path().join("mine.svg"), drawing("open")).unwrap();
        let second = maps(folder.path());
        assert!(second.all.find("mine").is_err() && !folder.path().join("mine.svg").exists());
        assert_eq!(add(&second, "mine", drawing("colon")), "map-1");
    }

    #[test]
    fn a_map_is_removed_although_its_name_cannot_be_noted() {
        let folder = tempfile::tempdir().unwrap();
        let maps = maps(folder.path());
        assert_eq!(add(&maps, "mine", drawing("open")), "mine");
        std::fs::create_dir(folder.path().join(REMOVED)).unwrap();
        maps.remove("mine").unwrap();
        assert!(!folder.path().join("mine.svg").exists());
        assert_eq!(add(&maps, "mine", drawing("open")), "map-1");
    }

    #[test]
    fn the_map_of_the_opening_scenario_stays() {
        let folder = tempfile::tempdir().unwrap();
        let maps = Maps::in_folder(folder.path().to_owned(), "mine".into());
        assert_eq!(add(&maps, "mine", drawing("open")), "mine");
        assert!(maps.remove("mine").is_err() && maps.all.find("mine").is_ok());
    }
}
