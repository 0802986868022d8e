//! Sessions on disk, so that they go on when the server was restarted or when their place was needed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::live::Hub;
use crate::session::{SessionHandle, View};
use ferry_core::scenario::ControllerName;
use ferry_core::session::{Opening, Saved};
use ferry_core::trial::LogError;
use ferry_files::open;
use ferry_files::replace;

pub const SAVE_EVERY: Duration = Duration::from_secs(1);
/// A hanging session must not keep the others from being saved.
const SAVE_WITHIN: Duration = Duration::from_millis(500);
/// Most files; the oldest of sessions that are not open are deleted.
const MOST: usize = 256;
const ENDING: &str = "ferry";
/// Of a file: ten runs, each with a map of at most a few megabytes.
const BYTES_MOST: u64 = 64 << 20;

/// Differs whenever there is something new to save.
#[derive(Clone, Copy, PartialEq)]
struct Mark {
    tick: u64,
    world_hash: u64,
    scenery: u64,
    controller: ControllerName,
}

impl Mark {
    fn of(view: &View) -> Self {
        Self {
            tick: view.moment.tick,
            world_hash: view.world_hash,
            scenery: view.scenery.version,
            controller: view.moment.controller,
        }
    }
}

/// A folder with one file per session.
pub struct SavedSessions {
    folder: PathBuf,
    /// Whether sessions begin with the server's scenario although they were saved.
    start_over: bool,
    /// What each file contains, by open session.
    written: Mutex<BTreeMap<String, Mark>>,
    /// Held while files are written, so that an older state does not replace a newer one.
    writing: tokio::sync::Mutex<()>,
}

impl SavedSessions {
    /// The folder is created at the first write.
    pub fn in_folder(folder: PathBuf, start_over: bool) -> Self {
        Self { folder, start_over, written: Mutex::default(), writing: tokio::sync::Mutex::default() }
    }

    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}.{ENDING}"))
    }

    pub fn has(&self, id: &str) -> bool {
        self.path(id).exists()
    }

    /// What a session begins with. After a fault, it does not go on from a state that may cause the fault again.
    pub fn opening(&self, id: &str, after_fault: bool) -> Opening {
        let path = self.path(id);
        if !path.exists() {
            return Opening::Fresh;
        }
        match open::log_at_most(&path, BYTES_MOST).map(Saved::of) {
            Ok(saved) if self.start_over || after_fault => Opening::Beside(saved),
            Ok(saved) => Opening::Saved(saved),
            Err(error) => Opening::Unreadable(error),
        }
    }

    /// A session that was just opened needs no saving yet. What it could not read is set aside, not replaced.
    pub fn opened(&self, id: &str, session: &SessionHandle) {
        if session.resumed().has_left_out {
            let path = self.path(id);
            let aside = path.with_extension("ferry-unreadable");
            match std::fs::rename(&path, &aside) {
                Ok(()) => tracing::warn!(path = %aside.display(), "saved session set aside"),
                Err(error) => tracing::warn!(%error, path = %path.display(), "saved session not set aside"),
            }
        }
        self.written().insert(id.to_owned(), Mark::of(&session.watch().borrow()));
    }

    /// Only open sessions are saved.
    pub fn closed(&self, id: &str) {
        self.written().remove(id);
    }

    /// Deletes what was saved. Returns whether there was anything.
    pub async fn forget(&self, id: &str) -> bool {
        let _one_at_a_time = self.writing.lock().await;
        self.closed(id);
        std::fs::remove_file(self.path(id)).is_ok()
    }

    /// Saves the sessions in which something has happened since they were opened or saved.
    ///
    /// # Errors
    /// The last error of a file. A session that hangs is not an error: what was saved last stays.
    pub async fn save(&self, hubs: impl IntoIterator<Item = Arc<Hub>>) -> Result<(), LogError> {
        let _one_at_a_time = self.writing.lock().await;
        let saved = futures_util::future::join_all(hubs.into_iter().map(|hub| self.save_one(hub))).await;
        saved.into_iter().fold(Ok(()), Result::and)
    }

    async fn save_one(&self, hub: Arc<Hub>) -> Result<(), LogError> {
        let mark = {
            let views = hub.session.watch();
            let view = views.borrow();
            if view.ended.is_some() {
                return Ok(());
            }
            Mark::of(&view)
        };
        // Sessions without a mark are not saved.
        if self.written().get(&hub.id).is_none_or(|&before| before == mark) {
            return Ok(());
        }
        let Ok(Ok(saved)) = tokio::time::timeout(SAVE_WITHIN, hub.session.saved()).await else {
            tracing::warn!(session = hub.id, "session not saved: it does not answer");
            return Ok(());
        };
        let (folder, path) = (self.folder.clone(), self.path(&hub.id));
        let open: BTreeSet<String> = self.written().keys().cloned().collect();
        let writing = tokio::task::spawn_blocking(move || write(&folder, &path, &saved, &open));
        let written = writing.await.unwrap_or_else(|error| Err(std::io::Error::other(error).into()));
        match &written {
            Ok(()) => drop(self.written().insert(hub.id.clone(), mark)),
            Err(error) => tracing::warn!(%error, session = hub.id, "session not saved"),
        }
        written
    }

    fn written(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Mark>> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn write(folder: &Path, path: &Path, saved: &Saved, open: &BTreeSet<String>) -> Result<(), LogError> {
    std::fs::create_dir_all(folder)?;
    if !path.exists() {
        make_room(folder, open);
    }
    Ok(replace(path, &saved.to_bytes()?)?)
}

/// Deletes the oldest files of sessions that are not open, until there is room for another one.
fn make_room(folder: &Path, open: &BTreeSet<String>) {
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| entry.path().extension().is_some_and(|ending| ending == ENDING))
        .map(|entry| (entry.metadata().and_then(|data| data.modified()).ok(), entry.path()))
        .collect();
    files.sort();
    let surplus = (files.len() + 1).saturating_sub(MOST);
    let is_open = |path: &Path| path.file_stem().and_then(|name| name.to_str()).is_none_or(|name| open.contains(name));
    for (_, path) in files.into_iter().filter(|(_, path)| !is_open(path)).take(surplus) {
        tracing::info!(path = %path.display(), "oldest saved session deleted: there are too many");
        let _ = std::fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_files_make_room_except_those_of_open_sessions() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(format!("{name}.{ENDING}"));
        let names = (0..MOST).map(|number| format!("s{number}"));
        for (age, name) in std::iter::once("main".to_owned()).chain(names).enumerate() {
            let file = std::fs::File::create(path(&name)).unwrap();
            file.set_modified(std::time::UNIX_EPOCH + Duration::from_secs(age as u64)).unwrap();
        }
        std::fs::write(folder.path().join("other.txt"), "").unwrap();
        make_room(folder.path(), &["main", "s0"].map(str::to_owned).into());
        let exists = ["main", "s0", "s1", "s2", "s3"].map(|name| path(name).exists());
        assert_eq!(exists, [true, true, false, false, true]);
        assert!(folder.path().join("other.txt").exists());
    }
}
