//! The guarantees of the module, checked on a real adapter.

use super::test_support::{WALL_HEIGHT_M, WORKSPACE, block, gpu, posts, static_scene, subject};
use super::*;
use ferry_core::geometry::Point2;
use ferry_core::image::GrayImage;

/// The point where a pixel's ray meets the plane at height `z_m`.
fn ground(frame: &CameraFrame, column: u32, row: u32, z_m: f64) -> Point2<f64> {
    let [x_m, y_m, height_m] = frame.pinhole.position_m;
    let pixel_m = 0.2 / 480.0;
    let closer = (height_m - z_m) / height_m;
    let [right_m, up_m] = [f64::from(column) - 239.5, 239.5 - f64::from(row)].map(|px| px * pixel_m * closer);
    let (sin, cos) = frame.pinhole.turn_rad.sin_cos();
    Point2::new(x_m + right_m * cos - up_m * sin, y_m + right_m * sin + up_m * cos)
}

fn pixels(gray: &GrayImage) -> impl Iterator<Item = (u32, u32, u8)> {
    let width = gray.width_px;
    gray.pixels.iter().enumerate().map(move |(at, level)| ((at % width) as u32, (at / width) as u32, *level))
}

#[test]
fn a_post_covers_the_pixels_computed_from_geometry() {
    let (x0, y0, x1, y1) = (-0.02, -0.40, 0.03, -0.36);
    let walls = [block(x0, y0, x1, y1)];
    let mut camera = Camera::new(gpu(), &static_scene(&walls), VIEW_PX).unwrap();
    // A pinhole camera sees a prism as the hull of its foot and its top.
    let covered = |frame: &CameraFrame, column, row| {
        (0..=20).any(|step| {
            let at = ground(frame, column, row, WALL_HEIGHT_M * f64::from(step) / 20.0);
            (x0..=x1).contains(&at.x) && (y0..=y1).contains(&at.y)
        })
    };
    for (tool_m, turn_rad) in [([0.0, -0.37, 0.1], 0.0), ([0.06, -0.41, 0.1], 0.7), ([-0.0601, -0.3333, 0.1], -3.0)] {
        // The bead is out of sight.
        let subject = Subject { turn_rad, ..subject(tool_m, [0.2, -0.5, 0.0025]) };
        let frame = camera.capture(&subject).unwrap();
        assert_eq!(frame.pinhole.position_m, [tool_m[0], tool_m[1], 0.3]);
        let gray = frame.picture.to_gray();
        let inside = |column, row| WORKSPACE.contains(ground(&frame, column, row, 0.0));
        let (mut right, mut all) = (0, 0);
        for (column, row, level) in pixels(&gray).filter(|(c, r, _)| inside(*c, *r)) {
            all += 1;
            right += u32::from((level < 128) == covered(&frame, column, row));
        }
        let share = f64::from(right) / f64::from(all);
        assert!(share >= 0.9995, "{share} of the pixels at {tool_m:?}");
    }
}

#[test]
fn an_edge_lies_between_the_pixels_given_by_the_pinhole_model() {
    // The camera is above the edge of a wall: seen from straight above, the top edge and the bottom edge coincide.
    let pixel_m = 0.2 / 480.0;
    let walls = [block(0.0, -0.45, 0.05, -0.30)];
    let mut camera = Camera::new(gpu(), &static_scene(&walls), VIEW_PX).unwrap();
    for (shift_px, first_dark) in [(-0.25, 240), (0.25, 240), (0.75, 239), (-0.75, 241)] {
        let tool_m = [shift_px * pixel_m, -0.37, 0.1];
        let gray = camera.capture(&subject(tool_m, [0.2, -0.5, 0.0025])).unwrap().picture.to_gray();
        let row = &gray.pixels[240 * 480..241 * 480];
        assert_eq!(row.iter().position(|level| *level <= 50), Some(first_dark), "{shift_px}");
    }
    // +y is up: the wall ends at y = −.30, above the image centre.
    let gray = camera.capture(&subject([0.025, -0.37, 0.1], [0.2, -0.5, 0.0025])).unwrap().picture.to_gray();
    let level = |row: usize| gray.pixels[row * 480 + 240];
    // In pixels, .07 m · .3 / .295 above the image centre: the top is closer to the camera.
    let top_px = 240.0 - 0.07 * (0.3 / 0.295) / pixel_m;
    assert!(level(top_px.floor() as usize - 1) >= 200 && level(top_px.ceil() as usize + 1) <= 50);
}

#[test]
fn every_pixel_meets_the_brightness_contract() {
    let walls = posts();
    let mut camera = Camera::new(gpu(), &static_scene(&walls), VIEW_PX).unwrap();
    let poses = [
        ([0.0, -0.37], [0.04, -0.40, 0.0025]),
        ([0.27, -0.22], [0.25, -0.25, 0.0025]),
        ([-0.30, -0.54], [-0.28, -0.52, 0.0025]),
        ([-0.24, -0.28], [-0.205, -0.28, 0.05]),
        ([0.225, -0.505], [0.225, -0.505, 0.0025]),
        ([-0.35, -0.60], [-0.29, -0.53, 0.0025]),
    ];
    for ([x_m, y_m], bead_m) in poses {
        let frame = camera.capture(&subject([x_m, y_m, 0.1], bead_m)).unwrap();
        let gray = frame.picture.to_gray();
        let mut bright = 0;
        for (column, row, level) in pixels(&gray) {
            assert!(level <= 50 || level >= 200, "gray {level} at {column}, {row}");
            bright += usize::from(level >= 200);
            let on_top = ground(&frame, column, row, WALL_HEIGHT_M);
            let on_floor = ground(&frame, column, row, 0.0);
            if !WORKSPACE.contains(on_top) && !WORKSPACE.contains(on_floor) {
                assert!(level <= 50, "gray {level} outside at {on_floor}");
            }
        }
        assert!(bright > 1000, "no floor in view from {x_m}, {y_m}");
        // The bead, at the pixel of its centre.
        let closer = 0.3 / (0.3 - bead_m[2]);
        let pixel = |offset_m: f64| (240.0 + offset_m * closer * 480.0 / 0.2) as usize;
        let (column, row) = (pixel(bead_m[0] - x_m), pixel(y_m - bead_m[1]));
        let at = 4 * (row * 480 + column);
        let [red, _, blue] = [0, 1, 2].map(|channel| i32::from(frame.picture.rgba[at + channel]));
        assert!(gray.pixels[at / 4] >= 200);
        assert!(red - blue > 20, "no bead at {column}, {row}");
    }
}

#[test]
fn controllers_do_not_see_goal_magnet_or_arm() {
    let walls = posts();
    let mut camera = Camera::new(gpu(), &static_scene(&walls), VIEW_PX).unwrap();
    let seen = subject([0.17, -0.30, 0.1], [0.15, -0.32, 0.0025]);
    let mut other = seen.clone();
    other.goal_m = None;
    other.block_size_m = [0.01; 3];
    other.link_frames = None;
    assert_eq!(camera.capture(&seen).unwrap(), camera.capture(&other).unwrap());
}

#[test]
fn the_same_state_gives_the_same_bytes() {
    let walls = posts();
    let gpu = gpu();
    let mut cameras = [0, 1].map(|_| Camera::new(gpu.clone(), &static_scene(&walls), VIEW_PX).unwrap());
    let state = subject([0.05, -0.35, 0.1], [0.04, -0.36, 0.0025]);
    let elsewhere = subject([-0.1, -0.45, 0.1], [0.04, -0.36, 0.0025]);
    let [first, second] = &mut cameras;
    let frame = first.capture(&state).unwrap();
    let scene = first.scene(&state, 321, 201).unwrap();
    assert_eq!((frame.tick, frame.picture.rgba.len()), (7, 480 * 480 * 4));
    assert_eq!(scene.rgba.len(), 321 * 201 * 4);
    first.capture(&elsewhere).unwrap();
    first.scene(&elsewhere, 100, 300).unwrap();
    for camera in [first, second] {
        assert!(camera.capture(&state).unwrap() == frame);
        assert!(camera.scene(&state, 321, 201).unwrap() == scene);
    }
}

#[test]
fn a_camera_continues_when_its_device_is_lost() {
    let walls = posts();
    let gpu = gpu();
    let mut camera = Camera::new(gpu.clone(), &static_scene(&walls), VIEW_PX).unwrap();
    let state = subject([0.05, -0.35, 0.1], [0.04, -0.36, 0.0025]);
    let (frame, scene) = (camera.capture(&state).unwrap(), camera.scene(&state, 320, 180).unwrap());
    gpu.destroy();
    assert!(camera.capture(&state).unwrap() == frame);
    assert!(camera.scene(&state, 320, 180).unwrap() == scene);
    // A new camera works too, although it receives the lost device.
    let mut next = Camera::new(gpu, &static_scene(&walls), VIEW_PX).unwrap();
    assert!(next.capture(&state).unwrap() == frame);
}

#[test]
fn the_scene_shows_arm_goal_and_bead() {
    let walls = posts();
    let camera = Camera::new(gpu(), &static_scene(&walls), VIEW_PX).unwrap();
    let mut camera = camera.with_quality(Quality::Fine);
    let seen = subject([-0.05, -0.33, 0.1], [0.07, -0.41, 0.0025]);
    let mut differences = Vec::new();
    let whole = camera.scene(&seen, 640, 360).unwrap();
    let hidden = [
        Subject { goal_m: None, ..seen.clone() },
        Subject { bead_m: [-0.2, -0.5, 0.0025], ..seen.clone() },
        Subject { link_frames: None, ..seen },
    ];
    for other in hidden {
        let frame = camera.scene(&other, 640, 360).unwrap();
        let pairs = whole.rgba.chunks(4).zip(frame.rgba.chunks(4));
        differences.push(pairs.filter(|(a, b)| a != b).count());
    }
    assert!(differences[0] > 60 && differences[1] > 30, "{differences:?}");
    assert!(differences[2] > 10_000, "{differences:?}");
}

#[test]
fn cameras_of_one_device_work_in_several_threads() {
    let gpu = gpu();
    let walls = posts();
    let state = subject([0.05, -0.35, 0.1], [0.04, -0.36, 0.0025]);
    let frames: Vec<CameraFrame> = std::thread::scope(|scope| {
        let threads = [0, 1, 2].map(|_| {
            scope.spawn(|| {
                let static_scene = static_scene(&walls);
                let mut camera = Camera::new(gpu.clone(), &static_scene, VIEW_PX).unwrap();
                (0..10).map(|_| camera.capture(&state).unwrap()).next_back()
            })
        });
        threads.map(|thread| thread.join().unwrap().unwrap()).into()
    });
    assert!(frames.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn a_camera_may_move_to_another_thread() {
    fn assert_send<T: Send>() {}
    assert_send::<Camera>();
    assert_send::<Box<dyn ImageSource + Send>>();
}
