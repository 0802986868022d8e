//! The maps available by name: shipped maps and added maps.

use std::collections::BTreeMap;
use std::sync::{PoisonError, RwLock};

use super::{Map, MapError};

/// Largest number of added maps.
pub const ADDED_MAPS: usize = 32;
/// Prefix of the names of added maps, followed by a number.
const ADDED: &str = "map-";

/// Maps by name, shared by all sessions. A session keeps the map that it has loaded.
#[derive(Debug, Default)]
pub struct Library {
    added: RwLock<Added>,
}

#[derive(Debug, Default)]
struct Added {
    maps: BTreeMap<u32, Map>,
    /// The largest number used so far: names are never reused.
    last: u32,
}

impl Library {
    /// The map with this name.
    ///
    /// # Errors
    /// If there is no such map.
    pub fn find(&self, name: &str) -> Result<Map, MapError> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        match number(name).and_then(|number| added.maps.get(&number)) {
            Some(map) => Ok(map.clone()),
            None => Map::shipped(name),
        }
    }

    /// All names: the shipped ones, sorted, then the added ones, oldest first.
    pub fn names(&self) -> Vec<String> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        Map::shipped_names().into_iter().chain(added.maps.values().map(|map| map.name().to_owned())).collect()
    }

    /// Adds a drawing under a new name.
    ///
    /// # Errors
    /// If it is not a valid map (see [`Map::from_svg`]), or if there are already [`ADDED_MAPS`].
    pub fn add(&self, svg: &str) -> Result<Map, MapError> {
        // Parsed before the lock is taken; the name is set last.
        let mut map = Map::from_svg("", svg)?;
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        let number = added.last.checked_add(1).filter(|_| added.maps.len() < ADDED_MAPS);
        let number = number.ok_or(MapError::TooMany { max: ADDED_MAPS })?;
        map.name = format!("{ADDED}{number}");
        added.maps.insert(number, map.clone());
        added.last = number;
        Ok(map)
    }

    /// Restores an added map under its old name.
    ///
    /// # Errors
    /// Those of [`Self::add`], and if the name is not that of an added map.
    pub fn restore(&self, name: &str, svg: &str) -> Result<(), MapError> {
        let number = number(name).ok_or_else(|| MapError::Unknown { name: name.to_owned() })?;
        let map = Map::from_svg(name, svg)?;
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        if added.maps.len() >= ADDED_MAPS {
            return Err(MapError::TooMany { max: ADDED_MAPS });
        }
        added.maps.insert(number, map);
        added.last = added.last.max(number);
        Ok(())
    }

    /// Removes an added map, if it exists. Sessions that have loaded it keep it.
    pub fn remove(&self, name: &str) -> Option<Map> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        number(name).and_then(|number| added.maps.remove(&number))
    }
}

/// Whether the name has the form of an added map's name.
pub fn is_added(name: &str) -> bool {
    number(name).is_some()
}

/// The number in an added map's name; `None` if it is not in canonical form.
fn number(name: &str) -> Option<u32> {
    let number = name.strip_prefix(ADDED)?.parse().ok()?;
    (format!("{ADDED}{number}") == name).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adds_finds_and_removes_maps_under_generated_names() {
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
        assert_eq!(library.add(&drawing).unwrap().name(), "map-9", "a link to map-8 must not open another map");
    }

    #[test]
    fn refuses_more_than_the_maximum_of_added_maps() {
        let library = Library::default();
        let drawing = Map::shipped("open").unwrap().svg().to_owned();
        for _ in 0..ADDED_MAPS {
            library.add(&drawing).unwrap();
        }
        assert!(matches!(library.add(&drawing), Err(MapError::TooMany { max: ADDED_MAPS })));
        assert!(matches!(library.add("<svg/>"), Err(error) if !matches!(error, MapError::TooMany { .. })));
    }
}
