//! Valid and invalid map files.

use super::*;

fn square_post() -> Map {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">
        <rect x="-20" y="280" width="40" height="40"/></svg>"#;
    Map::from_svg("square", svg).unwrap()
}

#[test]
fn millimetres_become_metres_and_y_points_up() {
    let map = square_post();
    let w = map.workspace();
    assert_eq!([w.x_min_m, w.x_max_m, w.y_min_m, w.y_max_m], [-0.1, 0.1, -0.4, -0.2]);
    assert_eq!(map.walls().len(), 1);
    for [x, y] in &map.walls()[0].exterior {
        assert!((x.abs() - 0.02).abs() < 1e-6 && ((y + 0.3).abs() - 0.02).abs() < 1e-6);
    }
}

#[test]
fn clearance_is_signed_and_counts_the_border() {
    let map = square_post();
    let clearance = |x, y| map.clearance_m(Point2::new(x, y));
    assert!((clearance(0.05, -0.3) - 0.03).abs() < 1e-6);
    assert!((clearance(0.0, -0.3) + 0.02).abs() < 1e-6);
    assert!((clearance(0.095, -0.3) - 0.005).abs() < 1e-6);
    assert!(clearance(0.2, -0.3) < 0.0);
}

#[test]
fn a_line_is_blocked_by_a_post_and_by_too_narrow_a_gap() {
    let map = square_post();
    let (left, right) = (Point2::new(-0.08, -0.3), Point2::new(0.08, -0.3));
    assert!(!map.line_is_clear(left, right, 0.0));
    let (low_left, low_right) = (Point2::new(-0.06, -0.36), Point2::new(0.06, -0.36));
    assert!(map.line_is_clear(low_left, low_right, 0.03));
    assert!(!map.line_is_clear(low_left, low_right, 0.045));
}

#[test]
fn every_shipped_map_loads_with_the_papers_coordinates_free() {
    // Specification §3: on a colon map these have at least 1 cm of clearance.
    for name in ["colon", "colon-folds"] {
        let map = Map::shipped(name).unwrap();
        for (x, y) in
            [(-0.24, -0.27), (0.19, -0.28), (0.21, -0.34), (0.20, -0.47), (-0.19, -0.48), (-0.24, -0.28), (0.21, -0.40)]
        {
            let clearance_m = map.clearance_m(Point2::new(x, y));
            assert!(clearance_m >= 0.01, "({x}, {y}) has {clearance_m} m on {name}");
        }
    }
    for name in Map::shipped_names() {
        Map::shipped(&name).unwrap();
    }
}

#[test]
fn the_planar_stage_has_the_papers_coordinates_free() {
    // Paper, Examples 1 and 2.
    let stage = Map::shipped("attractor-example").unwrap();
    assert!(stage.is_for_stage() && !Map::shipped("posts").unwrap().is_for_stage());
    for (x, y) in [(-0.78, 0.73), (0.77, 0.19), (0.72, 0.76), (-0.77, 0.12), (-0.21, 0.55), (0.42, 0.55)] {
        assert!(stage.clearance_m(Point2::new(x, y)) >= 0.03, "({x}, {y})");
    }
}

#[test]
fn refuses_an_unknown_positioner() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" data-positioner="crane" viewBox="-100 200 200 200"/>"#;
    let message = Map::from_svg("crane", svg).unwrap_err().to_string();
    assert!(message.contains("data-positioner \"crane\""), "{message}");
}

#[test]
fn an_unknown_name_lists_the_known_ones() {
    let message = Map::shipped("nowhere").unwrap_err().to_string();
    assert!(message.contains("nowhere") && message.contains("colon"), "{message}");
}

#[test]
fn a_kept_drawing_is_opened_where_its_reader_made_the_same_walls() {
    let kept = |body: &str, reader| {
        let svg = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 200 200">{body}</svg>"#);
        let read = Map::from_svg("kept", &svg).unwrap().as_read_by(reader);
        read.map(drop).map_err(|error| error.to_string())
    };
    let plain = r#"<rect x="-20" y="280" width="40" height="40"/>"#;
    let styled = r#"<rect id="a" y="280" width="40" height="40" style="x: -20px"/>"#;
    let doubled = r#"<path id="b" d="M0 300v0h30v30" fill="none" stroke="red" stroke-linecap="round"/>"#;
    let hair = r#"<path id="c" d="M-60 290.5q0 0 20 0t0 0s60 0 1.5 0"/>"#;
    let both = [doubled, hair].concat();
    for (body, since, place) in [
        (plain, 1, ""),
        (styled, 2, "<rect> id=\"a\" at line 1"),
        (doubled, 3, "<path> id=\"b\""),
        (hair, 4, "<path> id=\"c\""),
        (&both, 4, "<path> id="),
    ] {
        for reader in 1..=READER {
            match kept(body, reader) {
                Ok(()) => assert!(reader >= since, "{body}: {reader}"),
                Err(said) => assert!(reader < since && said.contains(place), "{body}: {reader}: {said}"),
            }
        }
        assert!(kept(body, READER + 1).unwrap_err().contains(&format!("its reader is {}", READER + 1)));
    }
    let no_caps = doubled.replace("round", "butt");
    assert_eq!(kept(&no_caps, 2), Ok(()));
}
