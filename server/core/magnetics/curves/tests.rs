use super::*;
use std::f64::consts::FRAC_PI_2;

/// The default: lower face 100 mm above the table.
const PULL: PullQuery = PullQuery {
    orientation: Orientation::A,
    lower_face_height_m: 0.1,
    direction_rad: 0.0,
    friction: 0.2,
    farthest_m: 0.15,
    count: 16,
};

const REACH: ReachQuery = ReachQuery {
    orientation: Orientation::A,
    lowest_m: 0.08,
    highest_m: 0.12,
    direction_rad: 0.0,
    friction: 0.2,
    drag_n_s_m: 0.01,
    count: 5,
};

/// With the block's centre 100 mm above the table and a point every centimetre.
fn of_the_table(orientation: Orientation, direction_rad: f64) -> PullCurve {
    let lower_face_height_m = 0.1 - force::half_height_m(orientation);
    pull(&PullQuery { orientation, lower_face_height_m, direction_rad, ..PULL }).unwrap()
}

#[test]
fn pull_is_that_of_the_reference_table() {
    use Orientation::{A, B, C};
    // Offset in cm, Fz and lateral pull in weights.
    let printed = [
        (A, 0.0, [(0, 0.976, 0.0), (4, 0.651, 0.309), (10, 0.123, 0.177)]),
        (B, 0.0, [(2, 0.538, 0.022), (8, 0.256, 0.133), (15, 0.056, 0.064)]),
        (B, FRAC_PI_2, [(0, 0.549, 0.0), (6, 0.261, 0.151), (15, 0.028, 0.042)]),
        (C, 0.0, [(2, 0.471, 0.003), (6, 0.367, 0.099), (10, 0.180, 0.115)]),
    ];
    for (orientation, direction_rad, rows) in printed {
        let curve = of_the_table(orientation, direction_rad);
        for (row, lift, lateral) in rows {
            assert!((curve.offset_m[row] - 0.01 * row as f64).abs() < 1e-12);
            assert!((curve.lift_ratio[row] - lift).abs() < 0.5e-3, "{orientation:?} {row}: {curve:?}");
            assert!((curve.lateral_ratio[row] - lateral).abs() < 0.5e-3, "{orientation:?} {row}: {curve:?}");
            assert_eq!(curve.weight_ratio[row], 1.0 - curve.lift_ratio[row]);
        }
    }
}

#[test]
fn a_bead_follows_within_its_capture_interval() {
    let curve = pull(&PullQuery { count: 1501, ..PULL }).unwrap();
    let (inner_m, outer_m) = curve.capture_m.unwrap();
    assert!((outer_m - 0.09473).abs() < 0.5e-5, "{outer_m}");
    for (offset_m, drag_ratio) in curve.offset_m.iter().zip(&curve.drag_ratio) {
        let follows = drag_ratio.unwrap() >= 1.0;
        assert_eq!(follows, (inner_m..=outer_m).contains(offset_m), "{offset_m} {drag_ratio:?}");
    }
}

#[test]
fn lifted_beads_are_marked_and_friction_holds_them_not() {
    let curve = pull(&PullQuery { lower_face_height_m: 0.08, ..PULL }).unwrap();
    assert!(curve.is_lifted[0] && !curve.is_lifted[15]);
    for ((is_lifted, weight), drag) in curve.is_lifted.iter().zip(&curve.weight_ratio).zip(&curve.drag_ratio) {
        assert_eq!(*is_lifted, *weight <= 0.0);
        assert_eq!(*is_lifted, drag.is_none());
    }
    let slippery = pull(&PullQuery { friction: 0.0, ..PULL }).unwrap();
    assert!(slippery.drag_ratio.iter().all(Option::is_none));
}

#[test]
fn reach_is_that_of_the_specification() {
    let curve = reach(&REACH).unwrap();
    assert_eq!(curve.lower_face_height_m.len(), 5);
    let speed_m_s = curve.largest_speed_m_s[2].unwrap();
    assert!((speed_m_s - 0.079).abs() < 0.5e-3, "{speed_m_s}");
    for (k, height_m) in curve.lower_face_height_m.iter().enumerate() {
        let query = PullQuery { lower_face_height_m: *height_m, ..PULL };
        let beside = pull(&query).unwrap();
        assert_eq!(curve.capture_m[k], beside.capture_m);
        assert_eq!(curve.lift_ratio[k], beside.lift_ratio[0]);
        assert!(curve.greatest_lift_ratio[k] >= beside.lift_ratio[0]);
        assert_eq!(curve.lift_ratio[k] >= 1.0, *height_m <= curve.lift_off_m);
    }
    for (orientation, center_m) in [(Orientation::A, 0.0994), (Orientation::B, 0.0863), (Orientation::C, 0.0815)] {
        let curve = reach(&ReachQuery { orientation, ..REACH }).unwrap();
        let found_m = curve.lift_off_m + force::half_height_m(orientation);
        assert!((found_m - center_m).abs() < 0.5e-4, "{orientation:?} {found_m}");
    }
}

#[test]
fn a_block_too_high_drags_nothing() {
    let curve = reach(&ReachQuery { lowest_m: 0.3, highest_m: 0.4, ..REACH }).unwrap();
    assert!(curve.capture_m.iter().all(Option::is_none));
    assert!(curve.largest_speed_m_s.iter().all(Option::is_none));
}

#[test]
fn impossible_queries_are_refused_by_name() {
    for value in [f64::NAN, f64::INFINITY, -0.1] {
        let refused = [
            pull(&PullQuery { lower_face_height_m: value, ..PULL }).unwrap_err(),
            pull(&PullQuery { friction: value, ..PULL }).unwrap_err(),
            pull(&PullQuery { farthest_m: value, ..PULL }).unwrap_err(),
            reach(&ReachQuery { lowest_m: value, ..REACH }).unwrap_err(),
            reach(&ReachQuery { highest_m: value, ..REACH }).unwrap_err(),
            reach(&ReachQuery { friction: value, ..REACH }).unwrap_err(),
            reach(&ReachQuery { drag_n_s_m: value, ..REACH }).unwrap_err(),
        ];
        let names =
            ["lower_face_height_m", "friction", "farthest_m", "lowest_m", "highest_m", "friction", "drag_n_s_m"];
        for (error, name) in refused.iter().zip(names) {
            assert!(matches!(error, CurveError::Range { field, .. } if *field == name), "{error}");
        }
    }
    let error = pull(&PullQuery { direction_rad: f64::NAN, ..PULL }).unwrap_err();
    assert_eq!(error.to_string(), "direction_rad must be from -6.283185307179586 to 6.283185307179586, not NaN");
    for value in [0, 1, 2001, u32::MAX] {
        assert_eq!(pull(&PullQuery { count: value, ..PULL }), Err(CurveError::Count { value, most: POINTS_LIMIT }));
        assert_eq!(reach(&ReachQuery { count: value, ..REACH }), Err(CurveError::Count { value, most: POINTS_LIMIT }));
    }
}
