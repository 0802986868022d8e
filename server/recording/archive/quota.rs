//! The limits of a folder of recordings. They hold at all times, with the recordings in progress.

use jiff::Zoned;

use super::{Archive, Listed, lock, name};
use crate::RecordingError;

/// A part in progress ends at this fraction of its session's share, so that deleting old parts makes enough room.
const PARTS_A_SHARE: u64 = 4;

/// Limits of the recordings of a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Retention {
    /// Largest number of parts.
    pub max_parts: usize,
    /// Largest total size.
    pub max_bytes: u64,
}

impl Default for Retention {
    fn default() -> Self {
        Self { max_parts: 200, max_bytes: 4 << 30 }
    }
}

impl Archive {
    /// Returns the name of a new part of a session's recording, and deletes the oldest finished ones to make room.
    ///
    /// # Errors
    /// The recordings in progress leave no room, or a file cannot be deleted.
    pub(in super::super) fn claim(&self, session: &str) -> Result<String, RecordingError> {
        std::fs::create_dir_all(&self.folder)
            .map_err(|error| RecordingError::Io { path: self.folder.clone(), error })?;
        let _changing = lock(&self.changing);
        self.make_room(1)?;
        let id = name(&Zoned::now(), session);
        lock(&self.live).insert(id.clone());
        Ok(id)
    }

    /// Marks a recording as finished.
    pub(in super::super) fn release(&self, id: &str) {
        lock(&self.live).remove(id);
    }

    /// Deletes the oldest finished recordings until the limits hold. To be called while a recording grows.
    ///
    /// # Errors
    /// The recordings in progress exceed the limits without them, or a file cannot be deleted.
    pub(in super::super) fn keep_quota(&self) -> Result<(), RecordingError> {
        let _changing = lock(&self.changing);
        self.make_room(0)
    }

    /// Size at which a part in progress should end.
    pub(in super::super) fn part_bytes(&self) -> u64 {
        let sessions = lock(&self.live).len().max(1) as u64;
        self.retention.max_bytes / (PARTS_A_SHARE * sessions)
    }

    /// Files with other names stay, and do not count. The caller holds `changing`.
    fn make_room(&self, more: usize) -> Result<(), RecordingError> {
        let Retention { max_parts, max_bytes } = self.retention;
        let listed = self.scan()?;
        let (live, finished): (Vec<_>, Vec<_>) =
            listed.iter().filter(|listed| listed.session.is_some()).partition(|listed| listed.live);
        // A claimed name may have no file yet.
        let in_progress = lock(&self.live).len();
        if in_progress + more > max_parts {
            return Err(RecordingError::Parts { in_progress, max: max_parts });
        }
        let mut count = more + in_progress + finished.len();
        let mut bytes: u64 = live.iter().chain(&finished).copied().map(Listed::all_bytes).sum();
        for old in finished.iter().rev() {
            if count <= max_parts && bytes <= max_bytes {
                break;
            }
            self.remove(&old.id)?;
            tracing::info!(id = old.id, "old recording deleted");
            count -= 1;
            bytes -= old.all_bytes();
        }
        match bytes <= max_bytes {
            true => Ok(()),
            false => Err(RecordingError::Quota { mb: bytes >> 20, max_mb: max_bytes >> 20 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::ABOUT;
    use super::super::tests::{ids, put};
    use super::*;

    const OLDS: [&str; 3] = ["20200101-000000-000-main", "20200101-000001-000-main", "20200101-000002-000-main"];

    fn archive(folder: &Path, max_parts: usize, max_bytes: u64) -> std::sync::Arc<Archive> {
        Archive::new(folder.to_owned(), Retention { max_parts, max_bytes })
    }

    /// Three recordings of 2000 bytes, and one with another name, which is never deleted.
    fn filled() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        OLDS.iter().for_each(|id| put(folder.path(), id, 1000));
        put(folder.path(), "mine", 100_000);
        folder
    }

    #[test]
    fn deletes_the_oldest_finished_ones_by_count() {
        let folder = filled();
        let archive = archive(folder.path(), 3, u64::MAX);
        lock(&archive.live).insert(OLDS[0].to_owned());
        // The new one is the fourth; the first is in progress.
        let new = archive.claim("main").unwrap();
        assert_eq!(ids(&archive), ["mine", OLDS[2], OLDS[0]]);
        assert!(!folder.path().join(format!("{}.ferry", OLDS[1])).exists());
        put(folder.path(), &new, 500);
        assert!(archive.list().unwrap()[1].live);
    }

    #[test]
    fn deletes_the_oldest_finished_ones_by_size_while_another_grows() {
        let folder = filled();
        let archive = archive(folder.path(), 100, 6000);
        let new = archive.claim("main").unwrap();
        assert_eq!(ids(&archive), ["mine", OLDS[2], OLDS[1], OLDS[0]], "6000 bytes are not too many");
        put(folder.path(), &new, 500);
        archive.keep_quota().unwrap();
        assert_eq!(ids(&archive), ["mine", &new, OLDS[2], OLDS[1]]);
        std::fs::write(archive.path(OLDS[2], ABOUT), vec![b' '; 1500]).unwrap();
        archive.keep_quota().unwrap();
        assert_eq!(ids(&archive), ["mine", &new, OLDS[2]], "6500 bytes");
        put(folder.path(), &new, 1300);
        archive.keep_quota().unwrap();
        assert_eq!(ids(&archive), ["mine", &new], "6100 bytes");
        assert!(!archive.path(OLDS[2], ABOUT).exists());
    }

    #[test]
    fn refuses_what_the_recordings_in_progress_leave_no_room_for() {
        let folder = filled();
        let archive = archive(folder.path(), 2, 4000);
        let first = archive.claim("main").unwrap();
        let second = archive.claim("main-2").unwrap();
        assert_eq!(ids(&archive), ["mine"]);
        let refused = archive.claim("main-3").unwrap_err().to_string();
        assert_eq!(refused, "recording: 2 recordings are in progress, and the limit is 2 (--keep)");
        put(folder.path(), &first, 3 << 20);
        let refused = archive.keep_quota().unwrap_err().to_string();
        assert_eq!(refused, "recording: the recordings in progress have 6 MB, and the limit is 0 MB (--keep-mb)");
        archive.release(&first);
        archive.keep_quota().unwrap();
        assert_eq!(ids(&archive), ["mine"]);
        archive.claim("main-3").unwrap();
        archive.release(&second);
    }

    #[test]
    fn the_room_is_shared_by_the_recordings_in_progress() {
        let folder = filled();
        let archive = archive(folder.path(), 100, 80_000);
        assert_eq!(archive.part_bytes(), 20_000);
        archive.claim("main").unwrap();
        assert_eq!(archive.part_bytes(), 20_000);
        archive.claim("main-2").unwrap();
        assert_eq!(archive.part_bytes(), 10_000);
    }
}
