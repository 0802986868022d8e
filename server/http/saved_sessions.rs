//! Sessions on disk, so that they go on when the server was restarted or when their place was needed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::live::Hub;
use crate::scenario::ControllerName;
use crate::session::{Opening, Saved, View};
use crate::trial::LogError;

pub const SAVE_EVERY: Duration = Duration::from_secs(1);
/// A hanging session must not keep the others from being saved.
const SAVE_WITHIN: Duration = Duration::from_millis(500);

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
    /// What each file contains, by session.
    written: Mutex<BTreeMap<String, Mark>>,
}

impl SavedSessions {
    /// The folder is created at the first write.
    pub fn in_folder(folder: PathBuf, start_over: bool) -> Self {
        Self { folder, start_over, written: Mutex::default() }
    }

    fn path(&self, id: &str) -> PathBuf {
        self.folder.join(format!("{id}.ferry"))
    }

    /// What a session begins with. After a fault, it does not go on from a state that may cause the fault again.
    pub fn opening(&self, id: &str, after_fault: bool) -> Opening {
        let path = self.path(id);
        if !path.exists() {
            return Opening::Fresh;
        }
        match Saved::open(&path) {
            Ok(saved) if self.start_over || after_fault => Opening::Beside(saved),
            Ok(saved) => Opening::Saved(saved),
            Err(error) => Opening::Unreadable(error),
        }
    }

    /// A session that was just opened needs no saving yet.
    pub fn opened(&self, id: &str, view: &View) {
        self.written().insert(id.to_owned(), Mark::of(view));
    }

    /// Saves the sessions in which something has happened since they were opened or saved.
    pub async fn save(&self, hubs: impl IntoIterator<Item = Arc<Hub>>) {
        futures_util::future::join_all(hubs.into_iter().map(|hub| self.save_one(hub))).await;
    }

    async fn save_one(&self, hub: Arc<Hub>) {
        let mark = {
            let views = hub.session.watch();
            let view = views.borrow();
            if view.ended.is_some() {
                return;
            }
            Mark::of(&view)
        };
        // Sessions without a mark have names that do not come again.
        if self.written().get(&hub.id).is_none_or(|&before| before == mark) {
            return;
        }
        let Ok(Ok(saved)) = tokio::time::timeout(SAVE_WITHIN, hub.session.saved()).await else { return };
        let (folder, path) = (self.folder.clone(), self.path(&hub.id));
        match tokio::task::spawn_blocking(move || write(&folder, &path, &saved)).await {
            Ok(Ok(())) => drop(self.written().insert(hub.id.clone(), mark)),
            Ok(Err(error)) => tracing::warn!(%error, session = hub.id, "session not saved"),
            Err(error) => tracing::error!(%error, session = hub.id, "session not saved"),
        }
    }

    fn written(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Mark>> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Replaces the file as a whole.
fn write(folder: &Path, path: &Path, saved: &Saved) -> Result<(), LogError> {
    let part = path.with_extension("part");
    std::fs::create_dir_all(folder)?;
    std::fs::write(&part, saved.to_bytes()?)?;
    Ok(std::fs::rename(&part, path)?)
}
