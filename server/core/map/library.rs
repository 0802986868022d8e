//! The maps available by name: shipped maps and added maps.

use std::collections::BTreeSet;
use std::sync::{PoisonError, RwLock};

use super::{Map, MapError};
use crate::names::is_name;

/// Largest number of added maps.
pub const ADDED_MAPS: usize = 32;
/// Name of an added map that has no other name, followed by a number.
const NUMBERED: &str = "map-";

/// Maps by name, shared by all sessions. A session keeps the map that it has loaded.
#[derive(Debug, Default)]
pub struct Library {
    added: RwLock<Added>,
}

#[derive(Debug, Default)]
struct Added {
    /// Oldest first.
    maps: Vec<Map>,
    /// All names so far, those of removed maps included: an experiment link must never open another drawing.
    used: BTreeSet<String>,
}

impl Added {
    /// A new name, with a number after the largest one so far.
    fn numbered(&self) -> String {
        let last = self.used.iter().filter_map(|name| number(name)).max().unwrap_or(0);
        let mut number = u64::from(last) + 1;
        loop {
            let name = format!("{NUMBERED}{number}");
            if !self.used.contains(&name) {
                return name;
            }
            number += 1;
        }
    }

    fn insert(&mut self, map: Map) {
        self.used.insert(map.name().to_owned());
        self.maps.push(map);
    }
}

impl Library {
    /// The map with this name.
    ///
    /// # Errors
    /// If there is no such map.
    pub fn find(&self, name: &str) -> Result<Map, MapError> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        match added.maps.iter().find(|map| map.name() == name) {
            Some(map) => Ok(map.clone()),
            None => Map::shipped(name),
        }
    }

    /// All names: the shipped ones, sorted, then the added ones, oldest first.
    pub fn names(&self) -> Vec<String> {
        let added = self.added.read().unwrap_or_else(PoisonError::into_inner);
        Map::shipped_names().into_iter().chain(added.maps.iter().map(|map| map.name().to_owned())).collect()
    }

    /// Adds a drawing. It gets the wished name if that is valid ([`is_added`]), not a numbered one, and was never used,
    /// otherwise a number.
    ///
    /// # Errors
    /// If it is not a valid map (see [`Map::from_svg`]), or if there are already [`ADDED_MAPS`].
    pub fn add(&self, wished: Option<&str>, mut map: Map) -> Result<Map, MapError> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        if added.maps.len() >= ADDED_MAPS {
            return Err(MapError::TooMany { max: ADDED_MAPS });
        }
        let free = wished.filter(|name| is_added(name) && number(name).is_none() && !added.used.contains(*name));
        map.name = free.map_or_else(|| added.numbered(), str::to_owned);
        added.insert(map.clone());
        Ok(map)
    }

    /// Restores an added map under its old name, as this reader has read it.
    ///
    /// # Errors
    /// Those of [`Self::add`], and if the name is not that of an added map.
    pub fn restore(&self, name: &str, svg: &str, reader: u32) -> Result<(), MapError> {
        if !is_added(name) {
            return Err(MapError::Unknown { name: name.to_owned() });
        }
        let map = Map::from_svg(name, svg)?.as_read_by(reader)?;
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        if added.maps.len() >= ADDED_MAPS {
            return Err(MapError::TooMany { max: ADDED_MAPS });
        }
        added.insert(map);
        Ok(())
    }

    /// Marks a name as used: a map of this name was removed, or exists elsewhere. No drawing gets it any more.
    pub fn reserve(&self, name: &str) {
        self.added.write().unwrap_or_else(PoisonError::into_inner).used.insert(name.to_owned());
    }

    /// Removes an added map, if it exists. Sessions that have loaded it keep it.
    pub fn remove(&self, name: &str) -> Option<Map> {
        let mut added = self.added.write().unwrap_or_else(PoisonError::into_inner);
        let index = added.maps.iter().position(|map| map.name() == name)?;
        Some(added.maps.remove(index))
    }
}

/// The number in the name of an added map that has no other name.
fn number(name: &str) -> Option<u32> {
    name.strip_prefix(NUMBERED)?.parse().ok()
}

/// Whether an added map may have this name: that of a file ([`is_name`]), but not of a shipped map.
pub fn is_added(name: &str) -> bool {
    is_name(name) && !Map::shipped_names().iter().any(|shipped| shipped == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing() -> String {
        Map::shipped("posts").unwrap().svg().to_owned()
    }

    fn map(drawing: &str) -> Map {
        Map::from_svg("", drawing).unwrap()
    }

    #[test]
    fn adds_finds_and_removes_maps_under_generated_names() {
        let library = Library::default();
        let drawing = drawing();
        let first = library.add(None, map(&drawing)).unwrap();
        assert_eq!((first.name(), library.find("map-1").unwrap().name()), ("map-1", "map-1"));
        assert_eq!(first.walls(), Map::shipped("posts").unwrap().walls());
        library.restore("map-7", &drawing, 1).unwrap();
        assert_eq!(library.add(None, map(&drawing)).unwrap().name(), "map-8");
        assert!(library.names().ends_with(&["map-1".into(), "map-7".into(), "map-8".into()]));
        assert!(library.remove("map-7").is_some() && library.remove("map-7").is_none());
        assert!(library.remove("posts").is_none() && library.find("posts").is_ok());
        for name in ["map-7", "map-07", "map-", "map-+1", "../map-1", "map-1.svg"] {
            assert!(matches!(library.find(name), Err(MapError::Unknown { .. })), "{name}");
        }
        assert!(library.restore("../x", &drawing, 1).is_err());
        assert!(library.remove("map-8").is_some());
        assert_eq!(
            library.add(None, map(&drawing)).unwrap().name(),
            "map-9",
            "a link to map-8 must not open another map"
        );
    }

    #[test]
    fn a_map_gets_the_wished_name_if_it_is_valid_and_new() {
        let library = Library::default();
        let drawing = drawing();
        assert_eq!(library.add(Some("two-rooms"), map(&drawing)).unwrap().name(), "two-rooms");
        assert_eq!(library.find("two-rooms").unwrap().name(), "two-rooms");
        let refused = ["two-rooms", "colon", "Two rooms", "", "-a", "../x", "a.svg", "map-4294967295", &"x".repeat(41)];
        for (wished, number) in refused.into_iter().zip(1..) {
            assert_eq!(library.add(Some(wished), map(&drawing)).unwrap().name(), format!("map-{number}"), "{wished:?}");
        }
        library.remove("two-rooms").unwrap();
        assert_eq!(
            library.add(Some("two-rooms"), map(&drawing)).unwrap().name(),
            "map-10",
            "a deleted name is not reused"
        );
        library.reserve("old");
        assert_eq!(library.add(Some("old"), map(&drawing)).unwrap().name(), "map-11");
    }

    #[test]
    fn refuses_more_than_the_maximum_of_added_maps() {
        let library = Library::default();
        let drawing = Map::shipped("open").unwrap().svg().to_owned();
        for _ in 0..ADDED_MAPS {
            library.add(None, map(&drawing)).unwrap();
        }
        assert!(matches!(library.add(None, map(&drawing)), Err(MapError::TooMany { max: ADDED_MAPS })));
    }
}
