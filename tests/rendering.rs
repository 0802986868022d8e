//! Compares the controllers' view with the map's geometry to the pixel: on every shipped map, with Vulkan and OpenGL, and
//! with several camera mounts.

use std::sync::Arc;

use ferry_camera::{AdapterChoice, Camera, Gpu};
use ferry_core::geometry::{Point2, Point3, Polygon, Rect, Vector2};
use ferry_core::image::{CameraFrame, CameraMount, StaticScene, Subject, VIEW_PX};
use ferry_core::map::{Map, WALL_HEIGHT_M};
use ferry_core::perception::Percept;
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::trial::Arena;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::gpu;

/// Heights at which a pixel's ray is tested against the walls.
const SLICES: u32 = 12;
/// Far outside, where the bead is not visible.
const NOWHERE: Point2<f64> = Point2::new(50.0, 50.0);

fn subject(tool: Point2<f64>, bead: Point2<f64>, mount: CameraMount) -> Subject {
    Subject {
        tick: 0,
        tool_m: [tool.x, tool.y, 0.1],
        turn_rad: 0.0,
        bead_m: [bead.x, bead.y, BEAD_RADIUS_M],
        goal_m: None,
        link_frames: None,
        block_size_m: [0.05, 0.025, 0.01],
        mount,
        moved_walls: None,
    }
}

/// The default mount, and mounts that are moved, tilted, wide and narrow.
fn mounts(rng: &mut ChaCha8Rng) -> [CameraMount; 6] {
    let good = CameraMount::default();
    let mut any = |most: f64| rng.random_range(-most..most);
    [
        good,
        good,
        CameraMount { offset_m: [any(0.15), any(0.15)], ..good },
        CameraMount { tilt_rad: [any(0.4), any(0.4)], ..good },
        CameraMount { offset_m: [any(0.1), any(0.1)], tilt_rad: [any(0.3), any(0.3)], field_of_view_rad: 1.0, ..good },
        CameraMount { height_m: 0.15, tilt_rad: [any(0.4), any(0.4)], field_of_view_rad: 0.3, ..good },
    ]
}

/// Whether a pixel's ray meets a wall or the outside of the workspace before it meets the floor.
fn meets_wall(map: &Map, frame: &CameraFrame, column: u32, row: u32) -> bool {
    let size = f64::from(frame.picture.width_px);
    let place = Vector2::new(2.0 * f64::from(column) + 1.0 - size, size - 2.0 * f64::from(row) - 1.0) / size;
    let on_table = frame.pinhole.table_from_image(place).unwrap();
    let [x_m, y_m, height_m] = frame.pinhole.position_m;
    let from_foot = on_table - Point2::new(x_m, y_m);
    (0..=SLICES).any(|slice| {
        let closer = 1.0 - WALL_HEIGHT_M * f64::from(slice) / f64::from(SLICES) / height_m;
        let point = Point2::new(x_m, y_m) + from_foot * closer;
        !map.workspace().contains(point) || !map.is_free(point)
    })
}

fn anywhere(w: &Rect, rng: &mut ChaCha8Rng) -> Point2<f64> {
    Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m))
}

fn dark_pixels_are_walls(gpu: &Arc<Gpu>, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for name in Map::shipped_names() {
        let arena = Arena::shipped(&name).unwrap();
        let mut camera = Camera::of(gpu, arena.static_scene()).unwrap();
        for mount in mounts(&mut rng) {
            let tool = anywhere(arena.map.workspace(), &mut rng);
            let frame = camera.capture(&subject(tool, NOWHERE, mount)).unwrap();
            let gray = frame.picture.to_gray();
            let size = VIEW_PX;
            let right = (0..size * size)
                .filter(|&at| (gray.pixels[at as usize] <= 50) == meets_wall(&arena.map, &frame, at % size, at / size))
                .count();
            let share = right as f64 / f64::from(size * size);
            assert!(share >= 0.995, "{share} of the pixels of {name} from {tool} with {mount:?}");
        }
    }
}

#[test]
fn dark_pixels_are_the_maps_walls_on_every_map() {
    dark_pixels_are_walls(&gpu(), 4);
}

#[test]
fn dark_pixels_are_the_maps_walls_through_opengl_too() {
    dark_pixels_are_walls(&Gpu::open(AdapterChoice::Gl).expect("OpenGL is needed"), 14);
}

#[test]
fn brightness_tells_wall_from_floor_wherever_the_bead_lies() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut seen = 0;
    for name in Map::shipped_names() {
        let arena = Arena::shipped(&name).unwrap();
        let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
        let points: Vec<_> = arena.space.points().collect();
        for _ in 0..20 {
            let bead = points[rng.random_range(0..points.len())];
            let mut beside = || rng.random_range(-0.09..0.09);
            let tool = Point2::new(bead.x + beside(), bead.y + beside());
            let mount = mounts(&mut rng)[rng.random_range(0..6)];
            let frame = camera.capture(&subject(tool, bead, mount)).unwrap();
            let gray = frame.picture.to_gray();
            let between = gray.pixels.iter().filter(|&&level| level > 50 && level < 200).count();
            assert_eq!(between, 0, "{name}: bead at {bead}, tool at {tool}");
            // The bead is on free floor, and so are the pixels around it.
            let percept = Percept::of(&frame, tool);
            if percept.calibration.sees(bead) {
                seen += 1;
                let (column, row) = percept.calibration.image_from_table(bead);
                let level = percept.gray.pixels[row as usize * percept.gray.width_px + column as usize];
                assert!(level >= 200, "{name}: {bead} with {mount:?}");
            }
        }
    }
    assert!(seen > 30, "{seen}");
}

/// Four walls around a place, so far from it to the left, right, below and above. A camera above it sees the feet
/// of the faces that look at it.
fn walls_around(at: Point2<f64>, [left, right, low, high]: [f64; 4]) -> [Polygon; 4] {
    let block = |x0: f64, y0: f64, x1: f64, y1: f64| Polygon {
        exterior: vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]],
        holes: vec![],
    };
    [
        block(at.x - left - 0.005, at.y - 0.002, at.x - left, at.y + 0.002),
        block(at.x + right, at.y - 0.002, at.x + right + 0.005, at.y + 0.002),
        block(at.x - 0.002, at.y - low - 0.005, at.x + 0.002, at.y - low),
        block(at.x - 0.002, at.y + high, at.x + 0.002, at.y + high + 0.005),
    ]
}

/// Tolerance: half a pixel is the resolution; a fiftieth is for the shadow at a wall's foot.
const HALF_A_PIXEL: f64 = 0.52;
const AROUND: Rect = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };

#[test]
fn a_pixel_and_its_place_on_the_table_agree_to_half_a_pixel() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for _ in 0..40 {
        let tool = Point2::new(rng.random_range(-0.15..0.15), rng.random_range(-0.42..-0.33));
        let [left, right, low, high] = std::array::from_fn(|_| rng.random_range(0.01..0.09));
        let walls = walls_around(tool, [left, right, low, high]);
        let static_scene = StaticScene { workspace: &AROUND, walls: &walls, wall_height_m: WALL_HEIGHT_M };
        let mut camera = Camera::new(gpu(), &static_scene, VIEW_PX).unwrap();
        let frame = camera.capture(&subject(tool, NOWHERE, CameraMount::default())).unwrap();
        let percept = Percept::of(&frame, tool);
        let size = percept.gray.width_px;
        let middle = size / 2;
        let dark = |column: usize, row: usize| percept.gray.pixels[row * size + column] <= 50;
        // The first dark pixel from the middle outward; its near border is the wall's foot.
        let seen = [
            (0..middle).rev().find(|&column| dark(column, middle)).unwrap() as f64 + 1.0,
            (middle..size).find(|&column| dark(column, middle)).unwrap() as f64,
            (middle..size).find(|&row| dark(middle, row)).unwrap() as f64,
            (0..middle).rev().find(|&row| dark(middle, row)).unwrap() as f64 + 1.0,
        ];
        let calibration = &percept.calibration;
        let column = |x_m: f64| calibration.image_from_table(Point2::new(x_m, tool.y)).0;
        let row = |y_m: f64| calibration.image_from_table(Point2::new(tool.x, y_m)).1;
        let told = [column(tool.x - left), column(tool.x + right), row(tool.y - low), row(tool.y + high)];
        for (seen_px, told_px) in seen.into_iter().zip(told) {
            assert!((seen_px - told_px).abs() <= HALF_A_PIXEL, "{seen:?} {told:?}");
        }
        let back = calibration.table_from_image(told[1], told[2]);
        assert!((back - Point2::new(tool.x + right, tool.y - low)).norm() < 1e-12);
    }
}

#[test]
fn a_leaning_camera_keeps_half_a_pixel_too() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..40 {
        let tool = Point2::new(rng.random_range(-0.15..0.15), rng.random_range(-0.42..-0.33));
        let away_m: [f64; 4] = std::array::from_fn(|_| rng.random_range(0.02..0.06));
        let walls = walls_around(tool, away_m);
        let static_scene = StaticScene { workspace: &AROUND, walls: &walls, wall_height_m: WALL_HEIGHT_M };
        let tilt_rad = [rng.random_range(-0.3..0.3), rng.random_range(-0.3..0.3)];
        let offset_m = [rng.random_range(-0.015..0.015), rng.random_range(-0.015..0.015)];
        let mount = CameraMount { offset_m, tilt_rad, field_of_view_rad: 1.2, ..CameraMount::default() };
        let frame =
            Camera::new(gpu(), &static_scene, VIEW_PX).unwrap().capture(&subject(tool, NOWHERE, mount)).unwrap();
        let gray = frame.picture.to_gray();
        let half_px = 0.5 * f64::from(VIEW_PX);
        let in_px = |p: Point2<f64>| {
            let place = frame.pinhole.image_from_point(Point3::new(p.x, p.y, 0.0)).unwrap();
            Vector2::new(half_px * (1.0 + place.x), half_px * (1.0 - place.y))
        };
        let is_dark = |p: Point2<f64>| {
            let at = in_px(p);
            gray.pixels[at.y as usize * gray.width_px + at.x as usize] <= 50
        };
        for (outward, away_m) in [-Vector2::x(), Vector2::x(), -Vector2::y(), Vector2::y()].into_iter().zip(away_m) {
            // Outward in steps much finer than a pixel, to the first dark one.
            let first_m = (0..8000).map(|i| 1e-5 * f64::from(i)).find(|&m| is_dark(tool + outward * m)).unwrap();
            let foot = tool + outward * away_m;
            let along = in_px(foot + Vector2::new(-outward.y, outward.x) * 1e-3) - in_px(foot);
            let normal = Vector2::new(-along.y, along.x).normalize();
            let miss_px = normal.dot(&(in_px(tool + outward * first_m) - in_px(foot))).abs();
            // Half a pixel on both sides, for an edge that is oblique in the image.
            let allowed_px = HALF_A_PIXEL * (normal.x.abs() + normal.y.abs()) + 0.02;
            assert!(miss_px <= allowed_px, "{miss_px} of {allowed_px} with {mount:?}");
        }
    }
}
