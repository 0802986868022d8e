//! The bead's physics, against numbers worked out elsewhere and against what must never happen.

use proptest::prelude::*;

use super::*;
use crate::geometry::Vector2;

const PARAMETERS: PlantParameters =
    PlantParameters { block_orientation: BlockOrientation::A, friction: 0.2, drag_n_s_m: 0.01 };
const FAR_AWAY: Point3<f64> = Point3::new(0.0, -0.3, 0.6);

fn open() -> Map {
    Map::shipped("open").unwrap()
}

fn at_rest(position_m: Point2<f64>) -> PlantState {
    PlantState { joints_rad: [0.0; 6], bead: Bead::at(position_m), hand: None }
}

/// Moves the tool in a straight line over a bead and returns by how much the bead trails at the end.
fn trail_m(speed_m_s: f64) -> f64 {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(-0.28, -0.4));
    let mut tool = Point3::new(-0.28, -0.4, 0.1);
    while tool.x < 0.25 {
        tool.x += speed_m_s * 1e-3;
        plant.step_bead(&mut state, &map, tool, 1e-3);
    }
    tool.x - state.bead.position_m.x
}

#[test]
fn the_bead_trails_by_16_mm_at_40_mm_s_and_is_lost_beyond_79() {
    // Specification §2.
    assert!((trail_m(0.040) - 0.016).abs() < 5e-4, "{}", trail_m(0.040));
    assert!(trail_m(0.078) < 0.06 && trail_m(0.1) > 0.1, "{} {}", trail_m(0.078), trail_m(0.1));
}

#[test]
fn the_pull_beats_friction_up_to_the_capture_radius_and_not_beyond() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let radius_m = crate::magnetics::force::capture_radius_m(BlockOrientation::A, 0.1, PARAMETERS.friction).unwrap();
    for (distance_m, moves) in [(radius_m - 1e-3, true), (radius_m + 1e-3, false)] {
        let mut state = at_rest(Point2::new(0.0, -0.4));
        for _ in 0..100 {
            plant.step_bead(&mut state, &map, Point3::new(distance_m, -0.4, 0.1), 1e-3);
        }
        assert_eq!(state.bead.position_m.x > 0.0, moves, "{distance_m}");
    }
}

#[test]
fn at_rest_stays_at_rest_to_the_bit() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(0.1, -0.4));
    let before = state.clone();
    for _ in 0..1000 {
        plant.step_bead(&mut state, &map, FAR_AWAY, 1e-3);
    }
    assert_eq!(state, before);
}

#[test]
fn a_low_magnet_lifts_the_bead_off_and_a_hand_gets_it_back() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let mut state = at_rest(Point2::new(0.1, -0.4));
    let lift_off_m = crate::magnetics::force::lift_off_height_m(BlockOrientation::A) - 0.005;
    plant.step_bead(&mut state, &map, Point3::new(0.1, -0.4, lift_off_m + 1e-4), 1e-3);
    assert!(!state.bead.lifted_off);
    plant.step_bead(&mut state, &map, Point3::new(0.1, -0.4, lift_off_m - 1e-4), 1e-3);
    assert!(state.bead.lifted_off);
    state.bead.lifted_off = false;
    state.hand = Some(Hand { target_m: Point2::new(0.0, -0.4), lift: false });
    plant.step_bead(&mut state, &map, Point3::new(0.1, -0.4, lift_off_m - 1e-4), 1e-3);
    assert!(!state.bead.lifted_off);
}

#[test]
fn a_straight_tool_path_stays_in_its_plane() {
    let (plant, map) = (Plant::new(PARAMETERS), open());
    let seed = crate::robot::Joints::from([-1.6, -1.6, -1.6, -1.6, 1.6, 0.0]);
    let mut tool = Point3::new(-0.25, -0.5, 0.1);
    let mut joints = Plant::joints_for(tool, &seed).unwrap();
    let mut state = PlantState { joints_rad: joints, ..at_rest(Point2::new(0.2, -0.25)) };
    while tool.x < 0.25 {
        // The fastest flight, across the whole workspace.
        tool += Vector3::new(0.25, 0.1, 0.0).normalize() * 0.25 * ur5::SERVO_PERIOD_S;
        let next = Plant::joints_for(tool, &joints).unwrap();
        plant.step(&mut state, &map, &joints, &next);
        joints = next;
        let height_m = Plant::tool_m(&state.joints_rad).z;
        assert!((height_m - 0.1).abs() < 1e-4, "{height_m}");
    }
    assert!((Plant::tool_m(&state.joints_rad) - tool).norm() < 1e-6);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// However violently a hand pulls, the bead stays on its side of every wall.
    #[test]
    fn no_hand_pulls_the_bead_through_a_wall(
        pulls in proptest::collection::vec((-0.35..0.33f64, -0.6..-0.15f64), 1..12),
    ) {
        let map = Map::shipped("colon").unwrap();
        let plant = Plant::new(PARAMETERS);
        let mut state = at_rest(Point2::new(0.0, -0.47));
        for (x, y) in pulls {
            state.hand = Some(Hand { target_m: Point2::new(x, y), lift: false });
            for _ in 0..400 {
                plant.step_bead(&mut state, &map, FAR_AWAY, 1e-3);
                let clearance_m = map.clearance_m(state.bead.position_m);
                prop_assert!(clearance_m >= BEAD_RADIUS_M - 1e-6, "{clearance_m}");
                prop_assert!(state.bead.velocity_m_s.norm() <= bead::HAND_SPEED_LIMIT_M_S + 1e-9);
            }
        }
    }

    /// A contact never adds energy.
    #[test]
    fn walls_give_the_bead_no_energy(x in -0.27..0.25f64, speed in 0.0..5.0f64, angle in 0.0..std::f64::consts::TAU) {
        let map = Map::shipped("posts").unwrap();
        let position_m = Point2::new(x, -0.52);
        let mut bead = Bead { velocity_m_s: Vector2::new(angle.cos(), angle.sin()) * speed, ..Bead::at(position_m) };
        let mut last = bead.velocity_m_s.norm();
        for _ in 0..2000 {
            contact::advance(&mut bead, &map, 1e-3);
            prop_assert!(bead.velocity_m_s.norm() <= last + 1e-12);
            prop_assert!(map.clearance_m(bead.position_m) >= BEAD_RADIUS_M - 1e-6);
            last = bead.velocity_m_s.norm();
        }
    }
}
