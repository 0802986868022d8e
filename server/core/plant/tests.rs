//! The bead's physics, compared with independently computed numbers and with invariants.

mod moving_walls;
mod violence;

use proptest::prelude::*;

use super::*;
use crate::geometry::{UnitQuaternion, Vector2, Vector3};
use crate::map::Map;

const PARAMETERS: PlantParameters = PlantParameters {
    block_orientation: BlockOrientation::A,
    bead_motion: BeadMotion::Sliding,
    friction: 0.2,
    rolling_resistance: 0.01,
    drag_n_s_m: 0.01,
    flow_m_s: 0.0,
    peristalsis: REST,
};
const REST: Peristalsis = Peristalsis {
    contraction: Contraction::Travelling,
    amplitude_m: 0.0,
    wavelength_m: 0.12,
    period_s: 6.0,
    pause_s: 0.0,
    irregularity: 0.0,
};
const FAR_AWAY: Point3<f64> = Point3::new(0.0, -0.3, 5.0);

fn open() -> Map {
    Map::shipped("open").unwrap()
}

fn at_rest(position_m: Point2<f64>) -> PlantState {
    PlantState::at_rest(Positioner::PlanarStage(FAR_AWAY), position_m)
}

/// A map with its lumen.
struct Room {
    map: Map,
    lumen: LazyLumen,
}

impl Room {
    fn of(map: Map) -> Self {
        Self { map, lumen: LazyLumen::default() }
    }

    fn around(&self) -> Surroundings<'_> {
        Surroundings::of(&self.map, &self.lumen)
    }

    fn rigid(&self) -> Walls<'_> {
        self.around().walls(None, 0)
    }
}

/// One bead step of 1 ms below an upright tool, between rigid walls.
fn step(plant: &Plant, state: &mut PlantState, map: &Map, tool_m: Point3<f64>) {
    let lumen = LazyLumen::default();
    let walls = Surroundings::of(map, &lumen).walls(None, 0);
    plant.step_bead(state, &walls, &Positioner::PlanarStage(tool_m).base_from_tool(), 1e-3);
}

/// Moves the tool in a straight line over a bead and returns the bead's lag at the end.
fn trail_m(speed_m_s: f64) -> f64 {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(-0.28, -0.4));
    let mut tool = Point3::new(-0.28, -0.4, 0.1);
    while tool.x < 0.25 {
        tool.x += speed_m_s * 1e-3;
        step(&plant, &mut state, &map, tool);
    }
    tool.x - state.bead.position_m.x
}

#[test]
fn the_bead_trails_by_16_mm_at_40_mm_s_and_is_lost_beyond_79() {
    assert!((trail_m(0.040) - 0.016).abs() < 5e-4, "{}", trail_m(0.040));
    assert!(trail_m(0.078) < 0.06 && trail_m(0.1) > 0.1, "{} {}", trail_m(0.078), trail_m(0.1));
}

#[test]
fn the_pull_exceeds_friction_up_to_the_capture_radius_only() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let radius_m = crate::magnetics::force::capture_radius_m(BlockOrientation::A, 0.1, PARAMETERS.friction).unwrap();
    for (distance_m, moves) in [(radius_m - 1e-3, true), (radius_m + 1e-3, false)] {
        let mut state = at_rest(Point2::new(0.0, -0.4));
        for _ in 0..100 {
            step(&plant, &mut state, &map, Point3::new(distance_m, -0.4, 0.1));
        }
        assert_eq!(state.bead.position_m.x > 0.0, moves, "{distance_m}");
    }
}

#[test]
fn a_resting_bead_stays_at_rest_bit_for_bit() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(0.1, -0.4));
    let before = state.clone();
    for _ in 0..1000 {
        step(&plant, &mut state, &map, FAR_AWAY);
    }
    assert_eq!(state, before);
}

#[test]
fn a_low_magnet_lifts_the_bead_off_and_a_hand_takes_it_back() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(0.1, -0.4));
    let lift_off_m = crate::magnetics::force::lift_off_height_m(BlockOrientation::A) - 0.005;
    step(&plant, &mut state, &map, Point3::new(0.1, -0.4, lift_off_m + 1e-4));
    assert!(!state.bead.lifted_off);
    step(&plant, &mut state, &map, Point3::new(0.1, -0.4, lift_off_m - 1e-4));
    assert!(state.bead.lifted_off);
    state.bead.lifted_off = false;
    state.hand = Some(Hand { target_m: Point2::new(0.0, -0.4), lift: false });
    step(&plant, &mut state, &map, Point3::new(0.1, -0.4, lift_off_m - 1e-4));
    assert!(!state.bead.lifted_off);
}

#[test]
fn a_sliding_sphere_ends_up_rolling_at_five_sevenths_of_its_speed() {
    let parameters = PlantParameters { bead_motion: BeadMotion::Rolling, drag_n_s_m: 0.0, ..PARAMETERS };
    let (plant, map) = (Plant::new(parameters.clone()), open());
    let mut state = at_rest(Point2::new(-0.25, -0.4));
    state.bead.velocity_m_s.x = 0.4;
    let mut steps = 0;
    while state.bead.velocity_m_s != state.bead.roll_m_s {
        let energy_j = state.bead.kinetic_energy_j();
        step(&plant, &mut state, &map, FAR_AWAY);
        assert!(state.bead.kinetic_energy_j() < energy_j);
        steps += 1;
    }
    // Sliding ends after 2·v/(7·μ·g); the rolling resistance, a twentieth of μ, adds a little.
    let expected_s = 2.0 * 0.4 / (7.0 * parameters.friction * dipole::GRAVITY_M_S2);
    assert!((f64::from(steps) * 1e-3 / expected_s - 1.0).abs() < 0.06, "{steps}");
    let speed = state.bead.velocity_m_s.x;
    assert!((speed / (0.4 * 5.0 / 7.0) - 1.0).abs() < 0.02, "{speed}");
    // Then it slows down with c·g·5/7 and stops for good.
    for _ in 0..200 {
        step(&plant, &mut state, &map, FAR_AWAY);
    }
    let slowed = parameters.rolling_resistance * dipole::GRAVITY_M_S2 / 1.4 * 0.2;
    assert!((speed - slowed - state.bead.velocity_m_s.x).abs() < 1e-6);
    for _ in 0..5000 {
        step(&plant, &mut state, &map, FAR_AWAY);
    }
    assert_eq!((state.bead.velocity_m_s, state.bead.roll_m_s), (Vector2::zeros(), Vector2::zeros()));
}

#[test]
fn only_a_push_above_the_friction_moves_the_bead() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let holds_n = PARAMETERS.friction * dipole::weight_n();
    for (push_n, moves) in [(0.99 * holds_n, false), (1.01 * holds_n, true)] {
        let mut state = at_rest(Point2::new(0.0, -0.4));
        state.drift_n.y = push_n;
        for _ in 0..100 {
            step(&plant, &mut state, &map, FAR_AWAY);
        }
        assert_eq!(state.bead.position_m.y != -0.4, moves, "{push_n}");
    }
}

#[test]
fn the_pull_passes_through_a_wall_but_the_bead_does_not() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">
        <rect x="0" y="200" width="4" height="200"/></svg>"#;
    let (plant, map) = (Plant::new(PARAMETERS), Map::from_svg("wall", svg).unwrap());
    let mut state = at_rest(Point2::new(-0.03, -0.3));
    for _ in 0..3000 {
        step(&plant, &mut state, &map, Point3::new(0.03, -0.3, 0.1));
    }
    let gap_m = -state.bead.position_m.x - BEAD_RADIUS_M;
    assert!((-1e-6..1e-4).contains(&gap_m), "{gap_m}");
    let before = state.clone();
    for _ in 0..100 {
        step(&plant, &mut state, &map, Point3::new(0.03, -0.3, 0.1));
    }
    assert_eq!(state, before, "a bead pressed against a wall rests");
    assert_eq!(state.bead.velocity_m_s, Vector2::zeros());
}

#[test]
fn a_bead_leaning_on_a_wall_is_held_by_table_friction() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">
        <rect x="0" y="200" width="4" height="200"/></svg>"#;
    let (plant, map) = (Plant::new(PARAMETERS), Map::from_svg("wall", svg).unwrap());
    let holds_n = PARAMETERS.friction * dipole::weight_n();
    // Pull into the wall and along it, in units of the table's friction; whether the bead slides along the wall.
    for (into, along, slides) in [(2.0, 0.9, false), (3.0, 0.8, false), (0.5, 0.9, false), (2.0, 1.3, true)] {
        let mut state = at_rest(Point2::new(-BEAD_RADIUS_M, -0.3));
        state.drift_n = Vector2::new(into, 0.0) * holds_n;
        for _ in 0..500 {
            step(&plant, &mut state, &map, FAR_AWAY);
        }
        let before = state.bead;
        state.drift_n.y = along * holds_n;
        for _ in 0..5000 {
            step(&plant, &mut state, &map, FAR_AWAY);
        }
        assert_eq!(state.bead != before, slides, "{into} {along}: {:?}", state.bead);
    }
}

#[test]
fn a_bead_bounces_out_of_an_acute_corner() {
    // Two walls that meet at 60°, opening to the left.
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-200 200 400 200">
        <path d="M0 300 L-150 213.4 L-150 200 L200 200 L200 400 L-150 400 L-150 386.6 Z"/></svg>"#;
    let room = Room::of(Map::from_svg("corner", svg).unwrap());
    let mut bead = Bead { velocity_m_s: Vector2::new(0.5, 0.003), ..Bead::at(Point2::new(-0.02, -0.3)) };
    for _ in 0..100 {
        contact::advance(&mut bead, &room.rigid(), 1e-3);
        assert!(room.map.clearance_m(bead.position_m) >= BEAD_RADIUS_M - 1e-6);
    }
    assert!(bead.velocity_m_s.x < -0.01, "{bead:?}");
}

#[test]
fn the_friction_impulse_never_exceeds_coulomb_friction() {
    // This limits both the change of velocity and the change of rotation in one step.
    for resistance in [0.0, 0.01, 0.1, 0.15, 0.19] {
        let parameters = PlantParameters {
            bead_motion: BeadMotion::Rolling,
            rolling_resistance: resistance,
            drag_n_s_m: 0.0,
            ..PARAMETERS
        };
        let (plant, map) = (Plant::new(parameters), open());
        let most_m_s = PARAMETERS.friction * dipole::GRAVITY_M_S2 * 1e-3;
        for (v, roll) in [(0.3, 0.3), (0.3, 0.298), (0.3, 0.0), (0.0, 0.3), (0.1, -0.1), (0.002, 0.0)] {
            let mut state = at_rest(Point2::new(0.0, -0.37));
            (state.bead.velocity_m_s.x, state.bead.roll_m_s.x) = (v, roll);
            step(&plant, &mut state, &map, FAR_AWAY);
            let change_m_s = (state.bead.velocity_m_s.x - v).abs();
            assert!(change_m_s <= most_m_s * (1.0 + 1e-6), "{resistance} {v} {roll}: {change_m_s}");
        }
    }
}

#[test]
fn a_tilted_block_pulls_toward_its_tilt() {
    let plant = Plant::new(PARAMETERS);
    let tool = Point3::new(0.1, -0.4, 0.1);
    let home = Positioner::home(PositionerKind::Arm, tool);
    let pull = |orientation| {
        let arm = Positioner::at(tool, orientation, &home).unwrap();
        plant.load(&arm.base_from_tool(), tool.xy())
    };
    let (upright, tilted) = (pull(ToolOrientation::Vertical), pull(ToolOrientation::Paper));
    assert!(upright.lateral_n.norm() < 1e-12, "{upright:?}");
    // Computed by hand: the flange has the paper's rotation vector, the middle of the block is 175 mm below
    // it, and the bead is under the tool point, 180 mm below.
    let base_from_flange = UnitQuaternion::from_scaled_axis(Vector3::new(2.182, -2.182, 0.0));
    let down = base_from_flange * Vector3::z();
    let base_from_block = base_from_flange * crate::robot::tool_down().inverse();
    let bead_from_middle = Vector3::new(tool.x, tool.y, BEAD_RADIUS_M) - (tool.coords - down * 0.005);
    let block = force::block(BlockOrientation::A, dipole::BLOCK_REMANENCE_T);
    let in_block = base_from_block.inverse() * bead_from_middle;
    let expected = base_from_block * force::force_n(&block, &in_block, dipole::moment_a_m2());
    assert!((tilted.lateral_n - expected.xy()).norm() < 1e-12 && (tilted.vertical_n - expected.z).abs() < 1e-12);
    // The tilt is 3.2°, so the lateral pull is a fraction of the lift.
    assert!(tilted.lateral_n.norm() > 0.005 * tilted.vertical_n, "{tilted:?}");
}

#[test]
fn a_straight_tool_path_stays_in_its_plane() {
    let (plant, room) = (Plant::new(PARAMETERS), Room::of(open()));
    let mut tool = Point3::new(-0.25, -0.5, 0.1);
    let at = |tool, seed: &Positioner| Positioner::at(tool, ToolOrientation::Vertical, seed).unwrap();
    let mut reference = at(tool, &Positioner::home(PositionerKind::Arm, tool));
    let mut state = PlantState::at_rest(reference, Point2::new(0.2, -0.25));
    while tool.x < 0.25 {
        // The fastest motion, across the whole workspace.
        tool += Vector3::new(0.25, 0.1, 0.0).normalize() * 0.25 * ur5::SERVO_PERIOD_S;
        let next = at(tool, &reference);
        plant.step(&mut state, &room.around(), 0, &reference, &next);
        reference = next;
        let height_m = state.positioner.tool_m().z;
        assert!((height_m - 0.1).abs() < 1e-4, "{height_m}");
    }
    assert!((state.positioner.tool_m() - tool).norm() < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// A contact does no positive work, at any speed and rotation of the bead.
    #[test]
    fn walls_add_no_energy(
        x in -0.27..0.25f64, y in -0.53..-0.22f64, speed in 0.0..40.0f64, angle in 0.0..std::f64::consts::TAU,
    ) {
        let room = Room::of(Map::shipped("colon-folds").unwrap());
        let position_m = room.rigid().nearest_fit(Point2::new(x, y)).unwrap();
        let mut bead = Bead { velocity_m_s: Vector2::new(angle.cos(), angle.sin()) * speed, ..Bead::at(position_m) };
        let mut last_j = bead.kinetic_energy_j();
        for _ in 0..2000 {
            contact::advance(&mut bead, &room.rigid(), 1e-3);
            prop_assert!(bead.kinetic_energy_j() <= last_j * (1.0 + 1e-12));
            prop_assert!(room.map.clearance_m(bead.position_m) >= BEAD_RADIUS_M - 1e-6);
            last_j = bead.kinetic_energy_j();
        }
    }

    /// A pull below the friction limit leaves the bead where it is, bit for bit, sliding or rolling.
    #[test]
    fn a_resting_bead_stays_at_rest_below_any_weak_magnet(
        x in -0.27..0.25f64, y in -0.53..-0.22f64, dx in -0.2..0.2f64, dy in -0.2..0.2f64, height in 0.095..0.2f64,
        rolls in any::<bool>(),
    ) {
        let bead_motion = if rolls { BeadMotion::Rolling } else { BeadMotion::Sliding };
        let parameters = PlantParameters { bead_motion, ..PARAMETERS };
        let (plant, map) = (Plant::new(parameters.clone()), Map::shipped("posts").unwrap());
        let bead_m = Room::of(map.clone()).rigid().nearest_fit(Point2::new(x, y)).unwrap();
        let tool_m = Point3::new(bead_m.x + dx, bead_m.y + dy, height);
        let load = plant.load(&Positioner::PlanarStage(tool_m).base_from_tool(), bead_m);
        let holds_n = parameters.breakaway() * (dipole::weight_n() - load.vertical_n);
        prop_assume!(load.lateral_n.norm() < 0.999 * holds_n);
        let mut state = at_rest(bead_m);
        let before = state.clone();
        for _ in 0..200 {
            step(&plant, &mut state, &map, tool_m);
        }
        prop_assert_eq!(state, before);
    }

    /// Friction only removes energy: sliding, slipping or rolling.
    #[test]
    fn friction_adds_no_energy(
        v in prop::array::uniform2(-1.0..1.0f64), roll in prop::array::uniform2(-1.0..1.0f64),
        friction in 0.0..1.0f64, rolling_resistance in 0.0..0.2f64, rolls in any::<bool>(),
    ) {
        let bead_motion = if rolls { BeadMotion::Rolling } else { BeadMotion::Sliding };
        let parameters = PlantParameters { bead_motion, friction, rolling_resistance, drag_n_s_m: 0.0, ..PARAMETERS };
        let (plant, map) = (Plant::new(parameters), open());
        let mut state = at_rest(Point2::new(0.0, -0.37));
        state.bead.velocity_m_s = v.into();
        state.bead.roll_m_s = roll.into();
        let mut last_j = state.bead.kinetic_energy_j();
        for _ in 0..100 {
            step(&plant, &mut state, &map, FAR_AWAY);
            // The distant magnet's pull is about 1e-9 N.
            prop_assert!(state.bead.kinetic_energy_j() <= last_j + 1e-11);
            last_j = state.bead.kinetic_energy_j();
        }
    }
}
