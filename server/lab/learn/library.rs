//! The policies that users have trained or uploaded, in a folder.

use std::path::PathBuf;
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard};

use crate::changes::Changes;
use ferry_core::names::is_name;
use ferry_core::policy::{MAX_BYTES, Policies, Policy, PolicyError, Shipped};
use ferry_core::scenario::{AddedPolicy, RlPolicy};
use ferry_files::open;
use ferry_files::{read_at_most, replace};

/// Largest number of added policies; each has about a megabyte.
pub const ADDED_POLICIES: usize = 32;
/// Size limit of the file about a policy's training.
const ORIGIN_BYTES: u64 = 1 << 20;

/// Why a policy cannot be added, renamed or removed.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    #[error(transparent)]
    Policy(#[from] PolicyError),
    #[error(
        "{name:?} cannot be the name of a policy: use 1 to 40 of a to z, 0 to 9, - and _; it must not begin with - or _, and \
         not be auto or the name of a shipped policy"
    )]
    Name { name: String },
    #[error("there is a policy named {name:?} already")]
    Taken { name: String },
    #[error("there are {ADDED_POLICIES} added policies, the maximum; delete one first")]
    TooMany,
    #[error("there is no added policy named {name:?}")]
    Unknown { name: String },
    /// It could not be stored; nothing has changed.
    #[error("the policy could not be stored: {0}")]
    Io(#[from] std::io::Error),
}

/// An added policy.
#[derive(Clone, Debug)]
pub struct Added {
    pub name: String,
    pub policy: Arc<Policy>,
    /// How it was trained, as JSON.
    pub origin: Option<Arc<str>>,
}

impl Added {
    /// What the parameter `rl_policy` takes.
    pub fn reference(&self) -> RlPolicy {
        RlPolicy::Added(AddedPolicy { name: self.name.clone(), hash: Some(self.policy.hash()) })
    }
}

/// Policies by name, shared by all sessions, with a folder in which the added ones are kept.
#[derive(Debug, Default)]
pub struct Library {
    folder: PathBuf,
    /// Oldest first.
    added: RwLock<Vec<Added>>,
    changes: Changes,
}

/// Whether an added policy may have this name.
pub fn is_added(name: &str) -> bool {
    is_name(name) && RlPolicy::OPTIONS.iter().all(|(taken, _)| *taken != name)
}

impl Library {
    /// The policies kept in a folder. Files that are no policies are logged and left alone.
    pub fn in_folder(folder: PathBuf) -> Self {
        let mut files: Vec<_> = std::fs::read_dir(&folder)
            .into_iter()
            .flatten()
            .filter_map(|entry| entry.ok().map(|entry| entry.path()))
            .filter(|path| path.extension().is_some_and(|ending| ending == "safetensors"))
            .collect();
        files.sort_by_key(|path| (path.metadata().and_then(|data| data.modified()).ok(), path.clone()));
        let mut added = Vec::new();
        for path in files {
            let name = path.file_stem().and_then(|stem| stem.to_str()).filter(|name| is_added(name));
            match (name, open::policy(&path)) {
                (Some(name), Ok(policy)) => {
                    let origin = read_at_most(&path.with_extension("json"), ORIGIN_BYTES).ok();
                    let origin = origin.and_then(|bytes| String::from_utf8(bytes).ok()).map(Into::into);
                    added.push(Added { name: name.to_owned(), policy: Arc::new(policy), origin });
                }
                (_, opened) => tracing::warn!(path = %path.display(), error = ?opened.err(), "policy left out"),
            }
        }
        Self { folder, added: RwLock::new(added), changes: Changes::default() }
    }

    /// All added policies, oldest first.
    pub fn all(&self) -> Vec<Added> {
        self.read().clone()
    }

    /// The file of a policy.
    ///
    /// # Errors
    /// There is no such policy, or its file could not be read.
    pub fn bytes(&self, asked: &RlPolicy) -> Result<Vec<u8>, PolicyError> {
        let RlPolicy::Added(_) = asked else { return Policy::shipped_bytes(&asked.to_string()) };
        let hash = self.find(asked)?.hash();
        let name = self.read().iter().find(|one| one.policy.hash() == hash).map(|one| one.name.clone());
        let path = self.path(&name.unwrap_or_default());
        let unreadable = |error| PolicyError::Io { path: path.display().to_string(), error };
        read_at_most(&path, MAX_BYTES).map_err(|error| unreadable(std::io::Error::other(error)))
    }

    /// Whether a policy can be added under this name.
    ///
    /// # Errors
    /// [`LibraryError::Name`], [`LibraryError::Taken`], [`LibraryError::TooMany`].
    pub fn check(&self, name: &str) -> Result<(), LibraryError> {
        Self::check_name(&self.read(), name)?;
        if self.read().len() >= ADDED_POLICIES { Err(LibraryError::TooMany) } else { Ok(()) }
    }

    fn check_name(added: &[Added], name: &str) -> Result<(), LibraryError> {
        match name {
            _ if !is_added(name) => Err(LibraryError::Name { name: name.to_owned() }),
            _ if added.iter().any(|one| one.name == name) => Err(LibraryError::Taken { name: name.to_owned() }),
            _ => Ok(()),
        }
    }

    /// Adds a policy's file; `origin` says how it was trained, as JSON.
    ///
    /// # Errors
    /// [`LibraryError`].
    pub fn add(&self, name: &str, bytes: &[u8], origin: Option<String>) -> Result<Added, LibraryError> {
        let policy = Arc::new(Policy::from_bytes(bytes)?);
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        Self::check_name(&added, name)?;
        if added.len() >= ADDED_POLICIES {
            return Err(LibraryError::TooMany);
        }
        std::fs::create_dir_all(&self.folder)?;
        let path = self.path(name);
        // The policy comes last: what exists without it is not read.
        if let Some(origin) = &origin {
            replace(&path.with_extension("json"), origin.as_bytes())?;
        }
        if let Err(error) = replace(&path, bytes) {
            let _ = std::fs::remove_file(path.with_extension("json"));
            return Err(error.into());
        }
        let one = Added { name: name.to_owned(), policy, origin: origin.map(Into::into) };
        added.push(one.clone());
        drop(added);
        self.changes.note();
        Ok(one)
    }

    /// Gives an added policy another name.
    ///
    /// # Errors
    /// [`LibraryError`].
    pub fn rename(&self, name: &str, new: &str) -> Result<Added, LibraryError> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        let index = Self::position(&added, name)?;
        if name != new {
            Self::check_name(&added, new)?;
            let (from, to) = (self.path(name), self.path(new));
            if added[index].origin.is_some() {
                std::fs::rename(from.with_extension("json"), to.with_extension("json"))?;
            }
            std::fs::rename(from, to)?;
            new.clone_into(&mut added[index].name);
        }
        let renamed = added[index].clone();
        drop(added);
        self.changes.note();
        Ok(renamed)
    }

    /// Removes an added policy. Decisions that need it hold the arm from then on.
    ///
    /// # Errors
    /// [`LibraryError::Unknown`], [`LibraryError::Io`].
    pub fn remove(&self, name: &str) -> Result<(), LibraryError> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        let index = Self::position(&added, name)?;
        // It may be gone already.
        match std::fs::remove_file(self.path(name)) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(error.into()),
            _ => {}
        }
        let _ = std::fs::remove_file(self.path(name).with_extension("json"));
        added.remove(index);
        drop(added);
        self.changes.note();
        Ok(())
    }

    fn position(added: &[Added], name: &str) -> Result<usize, LibraryError> {
        let found = added.iter().position(|one| one.name == name);
        found.ok_or_else(|| LibraryError::Unknown { name: name.to_owned() })
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.safetensors"))
    }

    fn read(&self) -> RwLockReadGuard<'_, Vec<Added>> {
        self.added.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// Those of the list.
    pub fn changes(&self) -> &Changes {
        &self.changes
    }
}

impl Policies for Library {
    fn find(&self, asked: &RlPolicy) -> Result<Arc<Policy>, PolicyError> {
        let RlPolicy::Added(asked) = asked else { return Shipped.find(asked) };
        let added = self.read();
        let is_asked = |one: &&Added| match asked.hash {
            Some(hash) => one.policy.hash() == hash,
            None => one.name == asked.name,
        };
        let found = added.iter().find(is_asked).map(|one| one.policy.clone());
        found.ok_or_else(|| {
            let known = Policy::shipped_names().into_iter().chain(added.iter().map(|one| one.reference().to_string()));
            PolicyError::Unknown { name: asked.to_string(), known: known.collect() }
        })
    }

    fn resolve(&self, asked: &RlPolicy) -> Result<RlPolicy, PolicyError> {
        let RlPolicy::Added(_) = asked else { return Ok(asked.clone()) };
        let hash = self.find(asked)?.hash();
        let added = self.read();
        Ok(added.iter().find(|one| one.policy.hash() == hash).map_or_else(|| asked.clone(), Added::reference))
    }

    fn added(&self) -> Vec<RlPolicy> {
        self.read().iter().map(Added::reference).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file() -> Vec<u8> {
        Policy::shipped_bytes("colon").unwrap()
    }

    fn reference(text: &str) -> RlPolicy {
        text.parse().unwrap()
    }

    #[test]
    fn an_added_policy_is_found_by_name_and_hash_and_kept() {
        let folder = tempfile::tempdir().unwrap();
        let library = Library::in_folder(folder.path().join("policies"));
        let added = library.add("mine", &file(), Some("{}".into())).unwrap();
        let full = library.resolve(&reference("mine")).unwrap();
        assert_eq!(full, added.reference());
        assert_eq!(library.bytes(&full).unwrap(), file());
        assert_eq!(library.rename("mine", "yours").unwrap().name, "yours");
        assert!(library.find(&reference("mine")).is_err(), "the name is free");
        assert_eq!(library.find(&full).unwrap().hash(), added.policy.hash(), "the hash is still the same");
        assert!(library.resolve(&full).unwrap().to_string().starts_with("yours@"));
        let again = Library::in_folder(folder.path().join("policies"));
        assert_eq!(again.all()[0].name, "yours");
        assert_eq!(again.all()[0].origin.as_deref(), Some("{}"));
        again.remove("yours").unwrap();
        assert!(again.find(&full).is_err());
        assert!(Library::in_folder(folder.path().join("policies")).added().is_empty());
        assert_eq!(std::fs::read_dir(folder.path().join("policies")).unwrap().count(), 0);
        // Also if its file is gone.
        library.add("mine", &file(), None).unwrap();
        std::fs::remove_dir_all(folder.path().join("policies")).unwrap();
        library.remove("mine").unwrap();
        assert!(library.find(&reference("mine")).is_err());
    }

    #[test]
    fn refuses_names_and_files_and_keeps_nothing_then() {
        let folder = tempfile::tempdir().unwrap();
        let library = Library::in_folder(folder.path().to_owned());
        library.add("mine", &file(), None).unwrap();
        assert!(matches!(library.add("mine", &file(), None), Err(LibraryError::Taken { .. })));
        for name in ["auto", "colon", "explorer", "", "-a", "../x", "A b"] {
            assert!(matches!(library.add(name, &file(), None), Err(LibraryError::Name { .. })), "{name}");
        }
        assert!(matches!(library.add("other", &file()[..1000], None), Err(LibraryError::Policy(_))));
        assert!(matches!(library.rename("mine", "general"), Err(LibraryError::Name { .. })));
        assert!(matches!(library.rename("other", "new"), Err(LibraryError::Unknown { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
