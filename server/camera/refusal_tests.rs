//! Bad input is refused with an error that names the field, and the camera stays usable.

use super::test_support::{WORKSPACE, block, gpu, posts, static_scene, subject};
use super::*;
use ferry_core::image::CameraMount;

#[test]
fn refuses_bad_requests_and_names_the_field() {
    let gpu = gpu();
    let walls = posts();
    let open = |view_px| Camera::new(gpu.clone(), &static_scene(&walls), view_px);
    for view_px in [0, 1_000_000] {
        let error = open(view_px).unwrap_err();
        assert!(matches!(error, CameraError::Size { .. }), "{error}");
    }

    let mut camera = open(VIEW_PX).unwrap();
    let state = subject([0.0, -0.37, 0.1], [0.0, -0.37, 0.0025]);
    for (width_px, height_px) in [(0, 100), (100, 0), (100, 1_000_000)] {
        let error = camera.scene(&state, width_px, height_px).unwrap_err();
        assert!(matches!(error, CameraError::Size { .. }), "{error}");
    }
    let lost = Subject { bead_m: [f64::NAN; 3], ..state.clone() };
    let error = camera.capture(&lost).unwrap_err();
    assert!(matches!(error, CameraError::Subject { what: "bead_m" }), "{error}");
    let good = state.mount;
    let mounts = [
        [f64::NAN, f64::INFINITY, 0.0, -0.3, 1e9]
            .map(|height_m| ("height_m", CameraMount { height_m, ..good }))
            .as_slice(),
        &[f64::NAN, 0.0, -0.2, 1e-9, 3.15, 1e9]
            .map(|field_of_view_rad| ("field_of_view_rad", CameraMount { field_of_view_rad, ..good })),
        &[f64::NAN, f64::INFINITY, -1e9].map(|x_m| ("offset_m[0]", CameraMount { offset_m: [x_m, 0.0], ..good })),
        &[f64::NAN, 1.6, -7.0].map(|y_rad| ("tilt_rad[1]", CameraMount { tilt_rad: [0.0, y_rad], ..good })),
    ]
    .concat();
    for (field, mount) in mounts {
        let error = camera.capture(&Subject { mount, ..state.clone() }).map(|_| ()).unwrap_err();
        assert!(matches!(error, CameraError::Parameter { name, .. } if name == field), "{field}: {error}");
    }
    let low = CameraMount { height_m: 0.004, ..good };
    let error = camera.capture(&Subject { mount: low, ..state.clone() }).map(|_| ()).unwrap_err();
    assert!(matches!(error, CameraError::BelowWalls { .. }), "{error}");
    for mount in [
        CameraMount { tilt_rad: [1.3, 0.0], ..good },
        CameraMount { field_of_view_rad: 3.1, ..good },
        CameraMount { tilt_rad: [-0.7, 0.7], field_of_view_rad: 1.2, ..good },
    ] {
        let error = camera.capture(&Subject { mount, ..state.clone() }).map(|_| ()).unwrap_err();
        assert!(matches!(error, CameraError::Horizon { .. }), "{mount:?}: {error}");
    }
    assert!(camera.capture(&state).is_ok(), "the camera is unusable after a refusal");
}

#[test]
fn refuses_bad_static_scenes_and_draws_empty_walls() {
    let gpu = gpu();
    let open = |static_scene: &StaticScene| Camera::new(gpu.clone(), static_scene, VIEW_PX);
    let bad = [block(f64::NAN, 0.0, 0.1, 0.1)];
    assert!(matches!(open(&static_scene(&bad)), Err(CameraError::StaticScene { .. })));
    let empty = Rect { x_max_m: -0.3, ..WORKSPACE };
    let flat = StaticScene { workspace: &empty, ..static_scene(&[]) };
    assert!(matches!(open(&flat), Err(CameraError::StaticScene { .. })));
    let no_height = StaticScene { wall_height_m: 0.0, ..static_scene(&[]) };
    assert!(matches!(open(&no_height), Err(CameraError::StaticScene { .. })));
    // Walls without area are not an error.
    let hollow = [Polygon { exterior: vec![], holes: vec![] }, block(0.0, 0.0, 0.0, 0.0)];
    let state = subject([0.0, -0.37, 0.1], [0.0, -0.37, 0.0025]);
    assert!(open(&static_scene(&hollow)).unwrap().capture(&state).is_ok());
}
