//! The places of sessions: a limited number, and of these a limited number for each visitor.

use std::sync::{Arc, PoisonError};
use std::time::Duration;

use axum::http::StatusCode;

use super::{MAIN, Sessions};
use crate::http::problem::Problem;

/// Sessions that a visitor can have opened at a time.
const OWN_MOST: usize = 3;

/// A place among the sessions while one begins.
pub(super) struct Place {
    sessions: Arc<Sessions>,
    name: String,
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut placed = self.sessions.placed.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = placed.iter().position(|(name, _)| *name == self.name) {
            placed.swap_remove(own);
        }
    }
}

impl Sessions {
    /// Takes a place, if one is free.
    ///
    /// # Errors
    /// The visitor whose own it is has as many as it can have.
    fn free_place(self: &Arc<Self>, name: &str, owner: Option<&Arc<str>>) -> Result<Option<Place>, Problem> {
        let mut placed = self.placed.lock().unwrap_or_else(PoisonError::into_inner);
        let open = self.all();
        let beginning: Vec<_> = placed.iter().filter(|(name, _)| open.iter().all(|hub| hub.id != *name)).collect();
        if let Some(owner) = owner {
            let own = open.iter().filter(|hub| hub.owner() == Some(owner)).map(|hub| hub.id.as_str());
            let begun =
                beginning.iter().filter(|(_, other)| other.as_ref() == Some(owner)).map(|(name, _)| name.as_str());
            let own: Vec<_> = own.chain(begun).collect();
            if own.len() >= OWN_MOST {
                let detail = format!("you have {} sessions of your own already: {}", own.len(), own.join(", "));
                return Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_own_sessions", detail));
            }
        }
        let is_free = open.len() + beginning.len() < self.settings.most;
        Ok(is_free.then(|| {
            placed.push((name.to_owned(), owner.cloned()));
            Place { sessions: self.clone(), name: name.to_owned() }
        }))
    }

    /// Takes a place. If all are taken, closes the session that has been parked longest; its recordings stay.
    pub(super) async fn make_room(self: &Arc<Self>, name: &str, owner: Option<&Arc<str>>) -> Result<Place, Problem> {
        if let Some(place) = self.free_place(name, owner)? {
            return Ok(place);
        }
        let mut parked: Vec<_> = self.all().into_iter().filter(|hub| hub.id != MAIN && hub.is_parked()).collect();
        parked.sort_by_key(|hub| std::cmp::Reverse(hub.unwatched_for()));
        for hub in parked {
            let lock = self.lock_of(&hub.id);
            let Ok(_it_is_not_opening) = lock.try_lock() else { continue };
            // It goes on when it is opened again, so it must be on the disk. A browser may have come meanwhile.
            if self.saved.save([hub.clone()]).await.is_err()
                || !hub.is_parked()
                || !hub.close_if_unsteered(Duration::ZERO)
            {
                continue;
            }
            tracing::info!(session = hub.id, "parked session makes way for another");
            self.end(hub).await;
            if let Some(place) = self.free_place(name, owner)? {
                return Ok(place);
            }
        }
        let detail =
            format!("the server is full: all {} sessions are in use, and one has to end first", self.settings.most);
        Err(Problem::new(StatusCode::TOO_MANY_REQUESTS, "too_many_sessions", detail))
    }
}
