//! The maps that can be asked for by name: those that come with Ferry, and those that were added.

use std::collections::BTreeMap;
use std::sync::{PoisonError, RwLock};

use super::{Map, MapError};

/// Most maps that can be added.
pub const ADDED_MAPS: usize = 32;
/// How added maps are called, followed by a number.
const ADDED: &str = "map-";

/// Maps by name. Shared by all sessions and by whoever adds maps; a session that has loaded a map keeps it.
#[derive(Debug, Default)]
pub struct Library {
    added: RwLock<Added>,
}

#[derive(Debug, Default)]
struct Added {
    maps: BTreeMap<u32, Map>,
    /// The greatest number given up to now: a name that was a map's never becomes another's.
    last: u32,
}

impl Library {
    /// The map of a name.
    ///
    /// # Errors
    /// When there is none.
    pub fn find(&self, name: &str) -> Result<Map, MapError> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        match number(name).and_then(|number| added.maps.get(&number)) {
            Some(map) => Ok(map.clone()),
            None => Map::shipped(name),
        }
    }

    /// All names: the shipped ones, sorted, then the added ones, the oldest first.
    pub fn names(&self) -> Vec<String> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        Map::shipped_names().into_iter().chain(added.maps.values().map(|map| map.name().to_owned())).collect()
    }

    /// Adds a drawing under a name of its own.
    ///
    /// # Errors
    /// When it is no map (see [`Map::from_svg`]), or when there are [`ADDED_MAPS`] already.
    pub fn add(&self, svg: &str) -> Result<Map, MapError> {
        // Read before anyone has to wait for it; the name comes last.
        let mut map = Map::from_svg("", svg)?;
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        let number = added.last.checked_add(1).filter(|_| added.maps.len() < ADDED_MAPS);
        let number = number.ok_or(MapError::TooMany { most: ADDED_MAPS })?;
        map.name = format!("{ADDED}{number}");
        added.maps.insert(number, map.clone());
        added.last = number;
        Ok(map)
    }

    /// Puts a map back that was added before, under the name it had then.
    ///
    /// # Errors
    /// Those of [`Self::add`], and when the name is not that of an added map.
    pub fn restore(&self, name: &str, svg: &str) -> Result<(), MapError> {
        let number = number(name).ok_or_else(|| MapError::Unknown { name: name.to_owned() })?;
        let map = Map::from_svg(name, svg)?;
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        if added.maps.len() >= ADDED_MAPS {
            return Err(MapError::TooMany { most: ADDED_MAPS });
        }
        added.maps.insert(number, map);
        added.last = added.last.max(number);
        Ok(())
    }

    /// Takes an added map out, if it is there; sessions that have loaded it keep it.
    pub fn remove(&self, name: &str) -> Option<Map> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        number(name).and_then(|number| added.maps.remove(&number))
    }
}

/// Whether a name is one that an added map has or had.
pub fn is_added(name: &str) -> bool {
    number(name).is_some()
}

/// The number of an added map, written as we write it.
fn number(name: &str) -> Option<u32> {
    let number = name.strip_prefix(ADDED)?.parse().ok()?;
    (format!("{ADDED}{number}") == name).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_added_found_and_taken_out_under_names_of_our_own() {
        let library = Library::default();
        let drawing = Map::shipped("posts").unwrap().svg().to_owned();
        let first = library.add(&drawing).unwrap();
        assert_eq!((first.name(), library.find("map-1").unwrap().name()), ("map-1", "map-1"));
        assert_eq!(first.walls(), Map::shipped("posts").unwrap().walls());
        library.restore("map-7", &drawing).unwrap();
        assert_eq!(library.add(&drawing).unwrap().name(), "map-8");
        assert!(library.names().ends_with(&["map-1".into(), "map-7".into(), "map-8".into()]));
        assert!(library.remove("map-7").is_some() && library.remove("map-7").is_none());
        assert!(library.remove("posts").is_none() && library.find("posts").is_ok());
        for name in ["map-7", "map-07", "map-", "map-+1", "../map-1", "map-1.svg"] {
            assert!(matches!(library.find(name), Err(MapError::Unknown { .. })), "{name}");
        }
        assert!(library.restore("../x", &drawing).is_err());
        assert!(library.remove("map-8").is_some());
        assert_eq!(library.add(&drawing).unwrap().name(), "map-9", "a link to map-8 leads to no other map");
    }

    #[test]
    fn no_more_are_added_than_there_is_room_for() {
        let library = Library::default();
        let drawing = Map::shipped("open").unwrap().svg().to_owned();
        for _ in 0..ADDED_MAPS {
            library.add(&drawing).unwrap();
        }
        assert!(matches!(library.add(&drawing), Err(MapError::TooMany { most: ADDED_MAPS })));
        assert!(matches!(library.add("<svg/>"), Err(error) if !matches!(error, MapError::TooMany { .. })));
    }
}
