//! What a drawing holds, for people who draw maps.

use std::cmp::Reverse;

use super::{FreeSpace, Map};
use crate::geometry::Point2;

/// From the middle of a cell it is at most this far to the middle of a passage.
const REFINED_M: f64 = 0.006;
/// Steps of the search for that.
const REFINEMENTS: usize = 24;
/// A bay that is less than this wider than its mouth counts as an uneven wall, not as a room.
const PROMINENCE_M: f64 = 0.02;

/// The narrowest place of the widest way between two rooms.
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
    /// Where one room meets another, the narrowest first; empty if there is one room only.
    pub passages: Vec<Narrow>,
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
        let mut passages: Vec<Narrow> =
            passages(&space, &cells).into_iter().map(|found| centred(map, found.at, clearance)).collect();
        passages.sort_by(|a, b| a.width_m.total_cmp(&b.width_m));
        Self {
            size_m: [size.x, size.y],
            walls: map.walls().len(),
            regions: space.components(),
            free_m2: space.area_m2(),
            passages,
            widest_m,
            repairs: map.repairs().iter().map(ToString::to_string).collect(),
        }
    }
}

/// The middle of a passage near the middle of a cell: where both walls are equally far, away from the nearer one.
fn centred(map: &Map, near: Point2<f64>, clearance: impl Fn(Point2<f64>) -> f64) -> Narrow {
    let away = near - map.nearest_wall_point(near);
    let step = away / away.norm() * (REFINED_M / REFINEMENTS as f64);
    let places = (0..=REFINEMENTS).map(|i| near + step * i as f64);
    let widths = places.map(|at| Narrow { width_m: 2.0 * clearance(at), at });
    widths.max_by(|a, b| a.width_m.total_cmp(&b.width_m)).unwrap_or(Narrow { width_m: 0.0, at: near })
}

/// Fills the space from the widest cells to the narrowest. Where two rooms meet there is a passage.
fn passages(space: &FreeSpace, clearance_m: &[Option<f64>]) -> Vec<Narrow> {
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
    let mut passages = Vec::new();
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
                passages.push(Narrow { width_m: 2.0 * of(cell), at: space.center(cell) });
            }
            link[other] = Some(widest);
        }
    }
    // Later cells are narrower.
    passages.reverse();
    passages
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
        assert_eq!((room.walls, room.regions, room.passages), (0, 1, vec![]));
        assert!((room.size_m[0] - 0.4).abs() < 1e-12 && (room.size_m[1] - 0.2).abs() < 1e-12);
        assert!((room.widest_m - 0.2).abs() < 0.01, "{}", room.widest_m);
    }

    #[test]
    fn the_narrowest_place_is_the_door_between_two_rooms() {
        let rooms = summary(r#"<rect x="-10" y="200" width="20" height="140"/>"#);
        let [door] = rooms.passages[..] else { panic!("{:?}", rooms.passages) };
        assert!((door.width_m - 0.06).abs() < 0.001, "{door:?}");
        assert!(door.at.x.abs() < 0.015 && (door.at.y + 0.37).abs() < 0.01, "{door:?}");
        assert_eq!(rooms.regions, 1);
        assert_eq!(summary(r#"<rect x="-10" y="200" width="20" height="180"/>"#).regions, 1, "20 mm");
        let parts = summary(r#"<rect x="-10" y="200" width="20" height="196"/>"#);
        assert_eq!((parts.regions, parts.passages), (2, vec![]), "the bead cannot pass 4 mm");
    }

    #[test]
    fn of_two_doors_the_narrower_one_comes_first() {
        let shapes = r#"<rect x="-80" y="200" width="20" height="140"/><rect x="60" y="200" width="20" height="160"/>"#;
        let doors = summary(shapes).passages;
        let is_near = |door: &Narrow, width_m: f64, x_m: f64| {
            (door.width_m - width_m).abs() < 0.001 && (door.at.x - x_m).abs() < 0.015
        };
        assert_eq!(doors.len(), 2);
        assert!(is_near(&doors[0], 0.04, 0.07) && is_near(&doors[1], 0.06, -0.07), "{doors:?}");
    }
}
