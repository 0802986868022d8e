//! Bad input is refused by name, and leaves the camera usable.

use super::test_support::{WORKSPACE, block, gpu, posts, stage, subject};
use super::*;

#[test]
fn absurd_requests_are_refused_by_name() {
    let gpu = gpu();
    let walls = posts();
    let good = CameraParameters::default();
    let open = |parameters| Camera::new(gpu.clone(), &stage(&walls), &parameters);
    for height_m in [f64::NAN, f64::INFINITY, 0.0, -0.3, 1e9] {
        let error = open(CameraParameters { height_m, ..good }).unwrap_err();
        let CameraError::Parameter { name, .. } = error else { panic!("{error}") };
        assert_eq!(name, "height_m");
    }
    for table_span_m in [f64::NAN, 0.0, -0.2, 1e9] {
        let error = open(CameraParameters { table_span_m, ..good }).unwrap_err();
        let CameraError::Parameter { name, .. } = error else { panic!("{error}") };
        assert_eq!(name, "table_span_m");
    }
    let low = CameraParameters { height_m: 0.004, ..good };
    assert!(matches!(open(low), Err(CameraError::BelowWalls { .. })));
    for size_px in [0, 1_000_000] {
        let error = open(CameraParameters { size_px, ..good }).unwrap_err();
        assert!(matches!(error, CameraError::Size { .. }), "{error}");
    }

    let mut camera = open(good).unwrap();
    let state = subject([0.0, -0.37, 0.1], [0.0, -0.37, 0.0025]);
    for (width_px, height_px) in [(0, 100), (100, 0), (100, 1_000_000)] {
        let error = camera.scene(&state, width_px, height_px).unwrap_err();
        assert!(matches!(error, CameraError::Size { .. }), "{error}");
    }
    let lost = Subject { bead_m: [f64::NAN; 3], ..state };
    let error = camera.capture(&lost).unwrap_err();
    assert!(matches!(error, CameraError::Subject { what: "bead_m" }), "{error}");
    assert!(camera.capture(&state).is_ok(), "a refusal left the camera unusable");
}

#[test]
fn odd_stages_are_refused_or_drawn() {
    let gpu = gpu();
    let parameters = CameraParameters::default();
    let open = |stage: &Stage| Camera::new(gpu.clone(), stage, &parameters);
    let bad = [block(f64::NAN, 0.0, 0.1, 0.1)];
    assert!(matches!(open(&stage(&bad)), Err(CameraError::Stage { .. })));
    let empty = Rect { x_max_m: -0.3, ..WORKSPACE };
    let flat = Stage { workspace: &empty, ..stage(&[]) };
    assert!(matches!(open(&flat), Err(CameraError::Stage { .. })));
    let no_height = Stage { wall_height_m: 0.0, ..stage(&[]) };
    assert!(matches!(open(&no_height), Err(CameraError::Stage { .. })));
    // Nothing to draw is nothing wrong.
    let hollow = [Polygon { exterior: vec![], holes: vec![] }, block(0.0, 0.0, 0.0, 0.0)];
    let state = subject([0.0, -0.37, 0.1], [0.0, -0.37, 0.0025]);
    assert!(open(&stage(&hollow)).unwrap().capture(&state).is_ok());
}
