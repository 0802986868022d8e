//! Invariants under violent inputs: the bead never enters or crosses a wall, and equal runs are equal.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::*;

/// The bead stays on its side of every wall under violent drags, fast magnets and strong kicks, on every map and in
/// clutter. Each pull lasts a tenth of a second.
fn crossings(ticks: usize) -> usize {
    const RUNS: usize = 200;
    let mut maps = Map::shipped_names().iter().map(|name| Map::shipped(name).unwrap()).collect::<Vec<_>>();
    maps.push(clutter());
    let run = |run: usize| violent_run(&maps[run % maps.len()], run as u64, ticks / RUNS).0;
    (0..RUNS).into_par_iter().map(run).sum()
}

#[test]
fn violent_ticks_cross_no_wall() {
    assert_eq!(crossings(400_000), 0);
}

#[test]
#[ignore = "long"]
fn ten_million_violent_ticks_cross_no_wall() {
    assert_eq!(crossings(10_000_000), 0);
}

#[test]
fn a_violent_run_is_the_same_each_time() {
    let map = Map::shipped("colon").unwrap();
    let runs: Vec<_> = (0..4).into_par_iter().map(|_| violent_run(&map, 7, 20_000).1).collect();
    assert!(runs.windows(2).all(|pair| pair[0] == pair[1]));
    assert_ne!(runs[0], violent_run(&map, 8, 20_000).1);
}

/// Thin walls at random angles that cross each other and form notches and wedges.
pub(super) fn clutter() -> Map {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut body = String::new();
    for _ in 0..60 {
        let (x, y) = (rng.random_range(-180.0..180.0), rng.random_range(210.0..390.0));
        let (turn, length) = (rng.random_range(0.0..180.0), rng.random_range(5.0..60.0));
        body += &format!(r#"<rect x="{x}" y="{y}" width="{length}" height=".3" transform="rotate({turn} {x} {y})"/>"#);
    }
    let svg = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">{body}</svg>"#);
    Map::from_svg("clutter", &svg).unwrap()
}

pub(super) fn anywhere(map: &Map, rng: &mut ChaCha8Rng) -> Point2<f64> {
    let w = map.workspace();
    Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m))
}

/// Another pull, often a kick, and the magnet somewhere else.
pub(super) fn disturb(state: &mut PlantState, map: &Map, rng: &mut ChaCha8Rng) {
    let target_m = anywhere(map, rng);
    state.hand = rng.random_bool(0.7).then_some(Hand { target_m, lift: false });
    if rng.random_bool(0.2) {
        // As fast as after the strongest kick that a script may contain.
        state.bead.velocity_m_s =
            Vector2::new(rng.random_range(-4.0..4.0), rng.random_range(-4.0..4.0)).cap_magnitude(4.0);
    }
    let over = anywhere(map, rng);
    state.positioner = Positioner::PlanarStage(Point3::new(over.x, over.y, rng.random_range(0.096..0.2)));
}

/// Counts the steps after which the bead overlaps a wall or has passed through one, and hashes every tick.
fn violent_run(map: &Map, seed: u64, ticks: usize) -> (usize, u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bead_motion = if seed.is_multiple_of(2) { BeadMotion::Sliding } else { BeadMotion::Rolling };
    let plant = Plant::new(PlantParameters { bead_motion, ..PARAMETERS });
    let room = Room::of(map.clone());
    let walls = room.rigid();
    let mut state = at_rest(walls.nearest_fit(anywhere(map, &mut rng)).unwrap());
    let (mut crossings, mut hash) = (0, xxhash_rust::xxh3::Xxh3::new());
    for tick in 0..ticks {
        if tick % 12 == 0 {
            disturb(&mut state, map, &mut rng);
        }
        let base_from_tool = state.positioner.base_from_tool();
        for _ in 0..SUBSTEPS {
            let before = state.bead.position_m;
            plant.step_bead(&mut state, &walls, &base_from_tool, 1e-3);
            if state.bead.lifted_off {
                // It hangs on the magnet, perhaps over a wall; a hand takes it back to its last position.
                state.bead = Bead::at(before);
            }
            let place = state.bead.position_m;
            // The bead moves at most 4 mm per millisecond, so around a corner its chord does not touch the wall.
            let travel_m = (place - before).norm();
            let clearance_m = map.clearance_m(place);
            let passed = clearance_m < travel_m && !map.line_is_clear(before, place, 0.0);
            crossings += usize::from(clearance_m < BEAD_RADIUS_M - 1e-6 || passed);
        }
        for number in [state.bead.position_m.x, state.bead.position_m.y, state.bead.velocity_m_s.x] {
            hash.update(&number.to_bits().to_le_bytes());
        }
    }
    (crossings, hash.digest())
}
