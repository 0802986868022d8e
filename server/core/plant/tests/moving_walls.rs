//! Walls that move: they push the bead, never pass it, never crush it, and do no more work than they report.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::violence::{anywhere, clutter, disturb};
use super::*;
use crate::geometry::Band;

/// The largest overlap of bead and wall that is accepted.
const OVERLAP_M: f64 = 2e-4;
/// The drawn edge of moved walls is as near to the true one: arcs are drawn as short lines.
const DRAWN_M: f64 = 2e-4;

fn motion(contraction: Contraction, amplitude_m: f64) -> Peristalsis {
    Peristalsis { contraction, amplitude_m, ..REST }
}

/// Every seed has contractions of its own, up to the strongest and fastest ones.
fn violent_motion(rng: &mut ChaCha8Rng) -> Peristalsis {
    let wavelength_m = rng.random_range(LEAST_WAVELENGTH_M..0.3);
    Peristalsis {
        contraction: if rng.random_bool(0.5) { Contraction::Travelling } else { Contraction::Segmental },
        amplitude_m: rng.random_range(0.3..1.0) * MOST_CLOSING_M.min(0.25 * wavelength_m),
        wavelength_m,
        period_s: rng.random_range(LEAST_PERIOD_S..3.0),
        pause_s: if rng.random_bool(0.5) { 0.0 } else { rng.random_range(0.0..1.0) },
        irregularity: if rng.random_bool(0.5) { 0.0 } else { rng.random_range(0.0..1.0) },
    }
}

/// What went wrong in a run, and how far the bead and a wall overlapped at most.
#[derive(Debug, Default)]
struct Damage {
    crossings: usize,
    overlaps: usize,
    most_overlap_m: f64,
    gains: usize,
    most_gain_j: f64,
    pushed: usize,
    caught: usize,
}

impl Damage {
    fn and(self, other: Self) -> Self {
        Self {
            crossings: self.crossings + other.crossings,
            overlaps: self.overlaps + other.overlaps,
            most_overlap_m: self.most_overlap_m.max(other.most_overlap_m),
            gains: self.gains + other.gains,
            most_gain_j: self.most_gain_j.max(other.most_gain_j),
            pushed: self.pushed + other.pushed,
            caught: self.caught + other.caught,
        }
    }
}

/// Whether walls have closed on the bead: it is at rest, and there is no room for it as near as walls push it in a
/// millisecond.
fn is_caught(walls: &Walls, bead: &Bead) -> bool {
    let fits = |place| walls.fits_between_drawn(place) && walls.clearance_m(place) >= BEAD_RADIUS_M;
    bead.velocity_m_s == Vector2::zeros() && !contact::around(bead.position_m).any(fits)
}

/// The strongest contractions, violent drags, fast magnets and strong kicks, on every map and in clutter: no wall is
/// crossed; none overlaps the bead beyond the tolerance, unless it has closed on the bead and holds it; and the bead's
/// energy grows by no more than the work of walls, magnet and hand.
fn expect_no_damage(ticks: usize) {
    const RUNS: usize = 200;
    let mut rooms: Vec<Room> = Map::shipped_names().iter().map(|name| Room::of(Map::shipped(name).unwrap())).collect();
    rooms.push(Room::of(clutter()));
    let run = |run: usize| violent_run(&rooms[run % rooms.len()], run as u64, ticks / RUNS);
    let damage = (0..RUNS).into_par_iter().map(run).reduce(Damage::default, Damage::and);
    println!("{damage:?}");
    assert_eq!((damage.crossings, damage.overlaps, damage.gains), (0, 0, 0), "{damage:?}");
    assert!(damage.pushed > ticks / 20 && damage.caught > ticks / 1000, "{damage:?}");
}

#[test]
fn violent_ticks_between_moving_walls() {
    expect_no_damage(200_000);
}

#[test]
#[ignore = "long"]
fn ten_million_violent_ticks_between_moving_walls() {
    expect_no_damage(10_000_000);
}

fn violent_run(room: &Room, seed: u64, ticks: usize) -> Damage {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bead_motion = if seed.is_multiple_of(2) { BeadMotion::Sliding } else { BeadMotion::Rolling };
    let peristalsis = violent_motion(&mut rng);
    let plant = Plant::new(PlantParameters { bead_motion, peristalsis, ..PARAMETERS });
    let around = Surroundings { seed, ..room.around() };
    let mut state = at_rest(room.rigid().nearest_fit(anywhere(&room.map, &mut rng)).unwrap());
    let mut damage = Damage::default();
    for tick in 0..ticks {
        if tick % 12 == 0 {
            disturb(&mut state, &room.map, &mut rng);
        }
        let base_from_tool = state.positioner.base_from_tool();
        let rested = state.walls;
        state.walls = WallMotion::next(rested, &peristalsis, seed);
        let mut walls = around.walls_between(rested.as_ref(), state.walls.as_ref(), tick as u64, state.bead.position_m);
        for substep in 1..=SUBSTEPS {
            walls.advance_to(substep as f64 / SUBSTEPS as f64);
            let before = state.bead;
            let hand_n = state
                .hand
                .map_or(Vector2::zeros(), |hand| motion::HAND_STIFFNESS_N_M * (hand.target_m - before.position_m));
            let force_n = hand_n + plant.load(&base_from_tool, before.position_m).lateral_n;
            let push_m_s = force_n * (1e-3 / dipole::mass_kg());
            let force_j = dipole::mass_kg() * push_m_s.dot(&(before.velocity_m_s + push_m_s * 0.5));
            let wall_j = plant.step_bead(&mut state, &walls, &base_from_tool, 1e-3);
            if state.bead.lifted_off {
                state.bead = Bead::at(before.position_m);
                continue;
            }
            let place = state.bead.position_m;
            damage.pushed += usize::from(wall_j > 0.0);
            let gain_j = state.bead.kinetic_energy_j() - before.kinetic_energy_j() - force_j - wall_j;
            damage.most_gain_j = damage.most_gain_j.max(gain_j);
            damage.gains += usize::from(gain_j > 1e-12 + 1e-9 * before.kinetic_energy_j());
            let travel_m = (place - before.position_m).norm();
            let drawn_m = room.map.clearance_m(place);
            damage.crossings += usize::from(
                drawn_m < BEAD_RADIUS_M - 1e-6
                    || drawn_m < travel_m && !room.map.line_is_clear(before.position_m, place, 0.0),
            );
            let overlap_m = BEAD_RADIUS_M - walls.clearance_m(place);
            if overlap_m > OVERLAP_M && is_caught(&walls, &state.bead) {
                damage.caught += 1;
                continue;
            }
            damage.most_overlap_m = damage.most_overlap_m.max(overlap_m);
            damage.overlaps += usize::from(overlap_m > OVERLAP_M);
        }
    }
    damage
}

/// Two straight walls, 12 mm apart.
fn corridor() -> Room {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">
        <rect x="-200" y="200" width="400" height="94"/><rect x="-200" y="306" width="400" height="94"/></svg>"#;
    Room::of(Map::from_svg("corridor", svg).unwrap())
}

#[test]
fn a_closed_segment_holds_the_bead_and_frees_it() {
    let room = corridor();
    // The corridor's walls close to 2 mm.
    let peristalsis = Peristalsis { wavelength_m: 1.0, ..motion(Contraction::Travelling, 0.03) };
    let plant = Plant::new(PlantParameters { peristalsis, ..PARAMETERS });
    let mut state = at_rest(Point2::new(0.0, -0.3));
    let still = state.positioner;
    let (mut held, mut free) = (0, 0);
    for tick in 0..4000 {
        // A push of a quarter of the bead's weight, which moves it wherever it is free.
        state.drift_n = Vector2::new(if tick / 1000 % 2 == 0 { 1.3e-3 } else { -1.3e-3 }, 0.0);
        let before = state.bead.position_m;
        plant.step(&mut state, &room.around(), tick, &still, &still);
        let walls = room.around().walls(state.walls.as_ref(), tick + 1);
        let overlap_m = BEAD_RADIUS_M - walls.clearance_m(state.bead.position_m);
        let is_held = is_caught(&walls, &state.bead);
        assert!(overlap_m < OVERLAP_M || is_held, "{tick}: {overlap_m} {:?}", state.bead);
        held += usize::from(is_held);
        free += usize::from((state.bead.position_m - before).norm() > 1e-5);
    }
    assert!(held > 100 && free > 100, "{held} {free}");
}

#[test]
fn a_wall_moves_a_resting_bead_out_of_its_path() {
    let room = Room::of(Map::shipped("colon").unwrap());
    let peristalsis = motion(Contraction::Travelling, 0.01);
    let plant = Plant::new(PlantParameters { peristalsis, ..PARAMETERS });
    // Beside a wall.
    let start = room.rigid().nearest_fit(Point2::new(0.06, -0.54)).unwrap();
    let mut state = at_rest(start);
    let still = state.positioner;
    let mut farthest_m: f64 = 0.0;
    for tick in 0..1500 {
        plant.step(&mut state, &room.around(), tick, &still, &still);
        farthest_m = farthest_m.max((state.bead.position_m - start).norm());
    }
    assert!((0.009..0.03).contains(&farthest_m), "{farthest_m}");
}

#[test]
fn a_setting_never_makes_walls_jump() {
    let room = Room::of(Map::shipped("colon").unwrap());
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut wanted = REST;
    let mut now = None;
    let zero = || vec![0.0; room.around().lumen().knots_m().count()];
    let wave = |motion: Option<WallMotion>, tick| motion.map_or_else(zero, |one| room.around().wave_m(&one, tick));
    let mut last = zero();
    let mut most_m: f64 = 0.0;
    for tick in 0..20_000 {
        if tick % 700 == 0 {
            wanted = if rng.random_bool(0.3) { REST } else { violent_motion(&mut rng) };
        }
        now = WallMotion::next(now, &wanted, 1);
        assert!(now.is_none_or(|motion| motion.is_sound()));
        let next = wave(now, tick);
        most_m = next.iter().zip(&last).map(|(a, b)| (a - b).abs()).fold(most_m, f64::max);
        last = next;
    }
    // π · amplitude / period, and the change of the amplitude: about a millimetre per tick.
    let fastest_m = (0.5 * TAU * MOST_CLOSING_M / LEAST_PERIOD_S + 0.005) * ur5::SERVO_PERIOD_S;
    assert!(most_m > 1e-4 && most_m <= fastest_m * 1.01, "{most_m} {fastest_m}");
    now = (0..2000).fold(now, |now, _| WallMotion::next(now, &REST, 1));
    assert_eq!(now, None);
}

/// The nearest wall is where the walls are drawn, on every map.
#[test]
fn the_nearest_wall_is_on_the_drawn_edge() {
    let peristalsis = motion(Contraction::Travelling, 0.012);
    for name in Map::shipped_names() {
        let room = Room::of(Map::shipped(&name).unwrap());
        let around = room.around();
        let motion = WallMotion::in_full(&peristalsis, 0).unwrap();
        let bands = around.bands(Some(&motion), 431, Point2::new(9.0, 9.0)).unwrap();
        let outlines = Band::outlines(&bands);
        let walls = around.walls(Some(&motion), 431);
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let w = room.map.workspace();
        let mut compared = 0;
        for _ in 0..20_000 {
            let point = Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m));
            let clearance_m = walls.clearance_m(point);
            if room.map.clearance_m(point) < BEAD_RADIUS_M || clearance_m.abs() >= BEAD_RADIUS_M {
                continue;
            }
            // The exact distance is known outside of the discs; inside, only that the drawing covers the point.
            let turns: i32 = outlines.iter().map(|ring| turns(ring, point)).sum();
            let drawn_m = outlines.iter().flat_map(|ring| segments(ring)).map(|[a, b]| distance_m(point, a, b));
            let drawn_m = drawn_m.fold(f64::INFINITY, f64::min);
            compared += usize::from(clearance_m > 0.0);
            let is_near = drawn_m < DRAWN_M;
            assert!(is_near || (turns > 0) == (clearance_m > 0.0), "{name} {point}: {turns} {clearance_m}");
            let differs = clearance_m > 0.0 && (drawn_m - clearance_m).abs() > DRAWN_M;
            assert!(!differs, "{name} {point}: {drawn_m} {clearance_m}");
        }
        assert!(compared > 200, "{name}: {compared}");
    }
}

/// How often a closed outline runs around a point.
fn turns(ring: &[[f64; 2]], point: Point2<f64>) -> i32 {
    let angle_rad = |[a, b]: [Point2<f64>; 2]| {
        let (a, b) = (a - point, b - point);
        a.perp(&b).atan2(a.dot(&b))
    };
    (segments(ring).map(angle_rad).sum::<f64>() / TAU).round() as i32
}

fn segments(ring: &[[f64; 2]]) -> impl Iterator<Item = [Point2<f64>; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [Point2::from(*a), Point2::from(*b)])
}

fn distance_m(point: Point2<f64>, a: Point2<f64>, b: Point2<f64>) -> f64 {
    let span = b - a;
    let share = if span.norm_squared() > 0.0 { (point - a).dot(&span) / span.norm_squared() } else { 0.0 };
    (point - (a + span * share.clamp(0.0, 1.0))).norm()
}

#[test]
fn closed_walls_leave_two_millimetres_open() {
    let room = corridor();
    let lumen = room.around().lumen();
    let wave_m = vec![MOST_CLOSING_M; lumen.knots_m().count()];
    for x_m in [-0.15, -0.05, 0.0, 0.1] {
        let nearest = lumen.nearest_within(Point2::new(x_m, -0.3), BEAD_RADIUS_M, &wave_m).unwrap();
        assert!((nearest.distance_m - 1e-3).abs() < 1e-4, "{x_m}: {nearest:?}");
    }
}

#[test]
fn a_fluid_carries_a_bead_without_friction_along_the_colon() {
    let room = Room::of(Map::shipped("colon").unwrap());
    let run = |flow_m_s| {
        let plant = Plant::new(PlantParameters { flow_m_s, friction: 0.0, ..PARAMETERS });
        let mut state = at_rest(Point2::new(0.19, -0.28));
        let still = state.positioner;
        for tick in 0..3000 {
            plant.step(&mut state, &room.around(), tick, &still, &still);
        }
        state.bead.position_m
    };
    let rest = run(0.0);
    assert!((rest - Point2::new(0.19, -0.28)).norm() < 1e-3, "{rest}");
    // From one end to the other in 24 s at 50 mm/s, in one of the two directions.
    let ends = [run(0.05), run(-0.05)];
    let farthest_m = ends.map(|end| (end - rest).norm()).into_iter().fold(0.0, f64::max);
    assert!(farthest_m > 0.35, "{ends:?}");
}

/// What MuJoCo computed; see `tests/reference/make_moving_wall.py`.
#[derive(serde::Deserialize)]
struct Reference {
    times_s: Vec<f64>,
    cases: Vec<ReferenceCase>,
}

#[derive(serde::Deserialize)]
struct ReferenceCase {
    amplitude_m: f64,
    period_s: f64,
    /// The face on the other side.
    far_m: f64,
    start_m: [f64; 2],
    velocity_m_s: [f64; 2],
    /// x, y in m and their velocities in m/s at each time.
    seen: Vec<[f64; 4]>,
}

/// Between two long faces, one of which moves, the bead goes where MuJoCo's ball goes.
#[test]
fn a_moving_wall_throws_the_bead_as_in_mujoco() {
    let reference: Reference =
        serde_json::from_str(include_str!("../../../../tests/reference/moving_wall.json")).unwrap();
    let (mut most_m, mut most_m_s): (f64, f64) = (0.0, 0.0);
    for case in &reference.cases {
        let [place_m, speed_m_s] = against(case, &reference.times_s);
        println!("{place_m:.5} m, {speed_m_s:.5} m/s");
        (most_m, most_m_s) = (most_m.max(place_m), most_m_s.max(speed_m_s));
    }
    // The plant's steps last a millisecond, and the wall's speed is constant for eight.
    assert!(most_m < 2.5e-3 && most_m_s < 6e-3, "{most_m} {most_m_s}");
}

/// Two long faces along y: one at x = 0, which moves, and one at `far_m`, which does not.
fn faces(far_m: f64) -> Room {
    let far_mm = far_m * 1e3;
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-50 100 300 400"><rect x="-50" y="100" width="50" height="400"/>
        <rect x="{far_mm}" y="100" width="{}" height="400"/></svg>"#,
        250.0 - far_mm
    );
    let room = Room::of(Map::from_svg("faces", &svg).unwrap());
    let mut lumen = Lumen::of(&room.map);
    lumen.limit(|vertex| if vertex.place_m.x < 0.01 { vertex.limit_m } else { 0.0 });
    Room { lumen: LazyLumen::with(lumen), ..room }
}

/// The largest differences in place and velocity.
fn against(case: &ReferenceCase, times_s: &[f64]) -> [f64; 2] {
    let room = faces(case.far_m);
    let plant = Plant::new(PlantParameters { friction: 0.0, drag_n_s_m: 0.0, ..PARAMETERS });
    let base_from_tool = Positioner::PlanarStage(FAR_AWAY).base_from_tool();
    let mut state = at_rest(Point2::new(case.start_m[0], case.start_m[1] - 0.3));
    state.bead.velocity_m_s = case.velocity_m_s.into();
    let lumen = room.around().lumen();
    let closing_m = |time_s: f64| 0.5 * case.amplitude_m * (1.0 - (TAU * time_s / case.period_s).cos());
    let wave_m = |time_s: f64| vec![closing_m(time_s); lumen.knots_m().count()];
    let (mut most_m, mut most_m_s): (f64, f64) = (0.0, 0.0);
    for tick in 0..125_u32 {
        let time_s = f64::from(tick) * ur5::SERVO_PERIOD_S;
        let mut walls = room.around().walls_with(wave_m(time_s), wave_m(time_s + ur5::SERVO_PERIOD_S));
        for substep in 1..=SUBSTEPS {
            walls.advance_to(substep as f64 / SUBSTEPS as f64);
            plant.step_bead(&mut state, &walls, &base_from_tool, 1e-3);
            let now_s = time_s + substep as f64 * 1e-3;
            if let Some(at) = times_s.iter().position(|time_s| (time_s - now_s).abs() < 1e-6) {
                let [x_m, y_m, x_m_s, y_m_s] = case.seen[at];
                let place_m = Vector2::new(x_m, y_m - 0.3);
                most_m = most_m.max((state.bead.position_m.coords - place_m).norm());
                most_m_s = most_m_s.max((state.bead.velocity_m_s - Vector2::new(x_m_s, y_m_s)).norm());
            }
        }
    }
    [most_m, most_m_s]
}
