//! What a drawing holds, for people who draw maps.

use std::cmp::Reverse;

use super::{FreeSpace, Map};
use crate::geometry::Point2;

/// A bay that is less than this wider than its mouth counts as an uneven wall, not as a room.
const PROMINENCE_M: f64 = 0.02;

/// The narrowest place between two rooms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrow {
    /// Distance between the walls, m.
    pub width_m: f64,
    pub at: Point2<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Width and height of the workspace, m.
    pub size_m: [f64; 2],
    pub walls: usize,
    /// Number of connected parts.
    pub regions: usize,
    /// Area of these parts, m².
    pub free_m2: f64,
    /// `None` if there is one room only.
    pub narrowest: Option<Narrow>,
    /// Diameter of the largest circle between the walls, m.
    pub widest_m: f64,
    pub repairs: Vec<String>,
}

impl Summary {
    /// `clearance_m` is the distance to the walls within which nothing is free.
    pub fn of(map: &Map, clearance_m: f64) -> Self {
        let size = map.workspace().size_m();
        let space = FreeSpace::new(map, clearance_m);
        let clearance = |at: Point2<f64>| (map.nearest_wall_point(at) - at).norm();
        let cells: Vec<Option<f64>> = space.cells().map(|at| at.map(clearance)).collect();
        let widest_m = cells.iter().flatten().fold(0.0, |most: f64, &one| most.max(one)) * 2.0;
        Self {
            size_m: [size.x, size.y],
            walls: map.walls().len(),
            regions: space.components(),
            free_m2: space.area_m2(),
            narrowest: narrowest(&space, &cells),
            widest_m,
            repairs: map.repairs().iter().map(ToString::to_string).collect(),
        }
    }
}

/// Fills the space from the widest cells to the narrowest. Where two rooms meet there is a passage.
fn narrowest(space: &FreeSpace, clearance_m: &[Option<f64>]) -> Option<Narrow> {
    let of = |cell: usize| clearance_m[cell].unwrap_or(0.0);
    let mut order: Vec<usize> = (0..clearance_m.len()).filter(|&cell| clearance_m[cell].is_some()).collect();
    order.sort_by(|&a, &b| of(b).total_cmp(&of(a)));
    // The room of each filled cell, as a link to another cell; the widest cell of a room links to itself.
    let mut link: Vec<Option<usize>> = vec![None; clearance_m.len()];
    fn room(link: &mut [Option<usize>], mut cell: usize) -> usize {
        while let Some(next) = link[cell].filter(|&next| next != cell) {
            link[cell] = link[next];
            cell = next;
        }
        cell
    }
    let mut last = None;
    for cell in order {
        link[cell] = Some(cell);
        let mut rooms: Vec<usize> = Vec::new();
        for (neighbour, _) in space.neighbours(cell) {
            if link[neighbour].is_some() {
                rooms.push(room(&mut link, neighbour));
            }
        }
        rooms.sort_by_key(|&one| (Reverse((of(one) * 1e9) as u64), one));
        rooms.dedup();
        let Some((&widest, others)) = rooms.split_first() else { continue };
        link[cell] = Some(widest);
        for &other in others {
            if 2.0 * (of(other) - of(cell)) >= PROMINENCE_M {
                // Later cells are narrower.
                last = Some(Narrow { width_m: 2.0 * of(cell), at: space.center(cell) });
            }
            link[other] = Some(widest);
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEAD_M: f64 = 0.0025;

    fn summary(shapes: &str) -> Summary {
        let svg = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">{shapes}</svg>"#);
        Summary::of(&Map::from_svg("drawn", &svg).unwrap(), BEAD_M)
    }

    #[test]
    fn one_room_has_no_narrow_place() {
        let room = summary("");
        assert_eq!((room.walls, room.regions, room.narrowest), (0, 1, None));
        assert!((room.size_m[0] - 0.4).abs() < 1e-12 && (room.size_m[1] - 0.2).abs() < 1e-12);
        assert!((room.widest_m - 0.2).abs() < 0.01, "{}", room.widest_m);
    }

    #[test]
    fn the_narrowest_place_is_the_door_between_two_rooms() {
        let rooms = summary(r#"<rect x="-10" y="200" width="20" height="140"/>"#);
        let door = rooms.narrowest.unwrap();
        assert!((door.width_m - 0.06).abs() < 0.006, "{door:?}");
        assert!(door.at.x.abs() < 0.015 && (door.at.y + 0.37).abs() < 0.01, "{door:?}");
        assert_eq!(rooms.regions, 1);
        assert_eq!(summary(r#"<rect x="-10" y="200" width="20" height="180"/>"#).regions, 1, "20 mm");
        let parts = summary(r#"<rect x="-10" y="200" width="20" height="196"/>"#);
        assert_eq!((parts.regions, parts.narrowest), (2, None), "the bead cannot pass 4 mm");
    }

    #[test]
    fn of_two_doors_the_narrower_one_counts() {
        let shapes = r#"<rect x="-80" y="200" width="20" height="140"/><rect x="60" y="200" width="20" height="160"/>"#;
        let door = summary(shapes).narrowest.unwrap();
        assert!((door.width_m - 0.04).abs() < 0.006 && (door.at.x - 0.07).abs() < 0.015, "{door:?}");
    }
}
