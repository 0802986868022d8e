//! Mazes of straight walls: rooms with doors, and serpentines.

use kurbo::{Cap, Point};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::between;
use super::ink::{Ink, PAGE_MM};

const WALLS_MM: [f64; 2] = [10.0, 16.0];
/// Smallest side of a room, and how much wider than its doors it is at least.
const ROOM_MM: f64 = 90.0;
const BESIDE_DOOR_MM: f64 = 20.0;
/// Share of the walls that have a door although the rooms are connected without it.
const MORE_DOORS: f64 = 0.2;

/// Rooms in rows and columns; every room can be reached through doors.
pub fn rooms(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let [x, y, width, height] = PAGE_MM;
    let wall_mm = between(WALLS_MM[0], WALLS_MM[1], rng);
    let side_mm = (width_mm + BESIDE_DOOR_MM).max(ROOM_MM) + wall_mm;
    let [columns, rows] = [width, height].map(|total_mm| (total_mm / side_mm).floor().max(1.0));
    let (room_x, room_y) = (width / columns, height / rows);
    let (columns, rows) = (columns as usize, rows as usize);
    let mut walls = Vec::new();
    for room in 0..columns * rows {
        let right = (room % columns + 1 < columns).then_some((room, room + 1));
        let below = (room / columns + 1 < rows).then_some((room, room + columns));
        walls.extend([right, below].into_iter().flatten());
    }
    walls.shuffle(rng);
    let mut group: Vec<usize> = (0..columns * rows).collect();
    let mut ink = Ink::default();
    for (room, other) in walls {
        let (joined, kept) = (group[other], group[room]);
        let has_door = joined != kept || rng.random_bool(MORE_DOORS);
        group.iter_mut().filter(|number| **number == joined).for_each(|number| *number = kept);
        let corner = Point::new(x + room_x * (other % columns) as f64, y + room_y * (other / columns) as f64);
        let is_beside = other == room + 1;
        let length_mm = if is_beside { room_y } else { room_x };
        let along = |far_mm: f64| match is_beside {
            true => Point::new(corner.x, corner.y + far_mm),
            false => Point::new(corner.x + far_mm, corner.y),
        };
        let mut piece = |from_mm: f64, to_mm: f64| ink.wall(&[along(from_mm), along(to_mm)], wall_mm, Cap::Butt);
        // Corners are full.
        let [start_mm, end_mm] = [-0.5 * wall_mm, length_mm + 0.5 * wall_mm];
        if has_door {
            let door_mm = between(0.5 * wall_mm, length_mm - 0.5 * wall_mm - width_mm, rng);
            piece(start_mm, door_mm);
            piece(door_mm + width_mm, end_mm);
        } else {
            piece(start_mm, end_mm);
        }
    }
    ink
}

/// A channel that goes to and fro between walls from alternating sides.
pub fn serpentine(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let [x, y, width, height] = PAGE_MM;
    let wall_mm = between(WALLS_MM[0], WALLS_MM[1], rng);
    let is_upright = rng.random_bool(0.5);
    let (length_mm, total_mm) = if is_upright { (height, width) } else { (width, height) };
    let lanes = ((total_mm + wall_mm) / (width_mm + wall_mm)).floor();
    let lane_mm = (total_mm + wall_mm) / lanes - wall_mm;
    let place = |along_mm: f64, across_mm: f64| match is_upright {
        true => Point::new(x + across_mm, y + along_mm),
        false => Point::new(x + along_mm, y + across_mm),
    };
    let begins = rng.random_bool(0.5);
    let mut ink = Ink::default();
    for wall in 1..lanes as usize {
        let across_mm = wall as f64 * (lane_mm + wall_mm) - 0.5 * wall_mm;
        let [from_mm, to_mm] = match (wall % 2 == 0) == begins {
            true => [-wall_mm, length_mm - width_mm],
            false => [length_mm + wall_mm, width_mm],
        };
        ink.wall(&[place(from_mm, across_mm), place(to_mm, across_mm)], wall_mm, Cap::Butt);
    }
    ink
}
