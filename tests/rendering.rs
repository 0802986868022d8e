//! The controllers' view is right to the pixel: against the map's own geometry, on every shipped map.

use ferry::camera::{Camera, CameraParameters, Stage, Subject};
use ferry::geometry::{Point2, Polygon, Rect};
use ferry::image::CameraFrame;
use ferry::map::{Map, WALL_HEIGHT_M};
use ferry::perception::Percept;
use ferry::plant::BEAD_RADIUS_M;
use ferry::trial::Arena;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::determinism::gpu;

/// Heights at which a pixel's ray is held against the walls.
const SLICES: u32 = 12;

fn subject(tool: Point2<f64>, bead: Point2<f64>) -> Subject {
    Subject {
        tick: 0,
        tool_m: [tool.x, tool.y, 0.1],
        bead_m: [bead.x, bead.y, BEAD_RADIUS_M],
        goal_m: None,
        link_frames: None,
        block_size_m: [0.05, 0.025, 0.01],
    }
}

/// Whether a pixel's ray meets a wall's prism, or what lies outside the workspace, before the floor.
fn meets_wall(map: &Map, frame: &CameraFrame, column: u32, row: u32) -> bool {
    let [x_m, y_m, height_m] = frame.camera_m;
    let pixel_m = frame.table_span_m / f64::from(frame.width_px);
    let half = 0.5 * f64::from(frame.width_px);
    let (right, up) = ((f64::from(column) + 0.5 - half) * pixel_m, (half - f64::from(row) - 0.5) * pixel_m);
    (0..=SLICES).any(|slice| {
        let closer = 1.0 - WALL_HEIGHT_M * f64::from(slice) / f64::from(SLICES) / height_m;
        let point = Point2::new(x_m + right * closer, y_m + up * closer);
        !map.workspace().contains(point) || !map.is_free(point)
    })
}

fn anywhere(w: &Rect, rng: &mut ChaCha8Rng) -> Point2<f64> {
    Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m))
}

#[test]
fn dark_pixels_are_the_maps_walls_on_every_map() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for name in Map::shipped_names() {
        let arena = Arena::open(&name).unwrap();
        let mut camera = arena.camera(&gpu()).unwrap();
        // Far outside, where it is seen nowhere.
        let bead = Point2::new(50.0, 50.0);
        for _ in 0..6 {
            let tool = anywhere(arena.map.workspace(), &mut rng);
            let frame = camera.capture(&subject(tool, bead)).unwrap();
            let gray = frame.to_gray();
            let size = frame.width_px;
            let right = (0..size * size)
                .filter(|&at| (gray.pixels[at as usize] <= 50) == meets_wall(&arena.map, &frame, at % size, at / size))
                .count();
            let share = right as f64 / f64::from(size * size);
            assert!(share >= 0.995, "{share} of the pixels of {name} from {tool}");
        }
    }
}

#[test]
fn brightness_tells_wall_from_floor_wherever_the_bead_lies() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for name in Map::shipped_names() {
        let arena = Arena::open(&name).unwrap();
        let mut camera = arena.camera(&gpu()).unwrap();
        let points: Vec<_> = arena.space.points().collect();
        for _ in 0..20 {
            let bead = points[rng.random_range(0..points.len())];
            let mut beside = || rng.random_range(-0.09..0.09);
            let tool = Point2::new(bead.x + beside(), bead.y + beside());
            let frame = camera.capture(&subject(tool, bead)).unwrap();
            let gray = frame.to_gray();
            let between = gray.pixels.iter().filter(|&&level| level > 50 && level < 200).count();
            assert_eq!(between, 0, "{name}: bead at {bead}, tool at {tool}");
            // The bead is on free floor, and so are the pixels around it.
            let percept = Percept::of(&frame);
            let (column, row) = percept.calibration.image_from_table(bead);
            assert!(gray.pixels[row as usize * gray.width_px + column as usize] >= 200, "{name}: {bead}");
        }
    }
}

#[test]
fn a_pixel_and_its_place_on_the_table_agree_to_half_a_pixel() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let workspace = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
    for _ in 0..40 {
        // Four walls around the camera's axis: of each, the foot of the face that it sees lies at z = 0.
        let tool = Point2::new(rng.random_range(-0.15..0.15), rng.random_range(-0.42..-0.33));
        let [left, right, low, high] = std::array::from_fn(|_| rng.random_range(0.01..0.09));
        let block = |x0: f64, y0: f64, x1: f64, y1: f64| Polygon {
            exterior: vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]],
            holes: vec![],
        };
        let walls = [
            block(tool.x - left - 0.005, tool.y - 0.002, tool.x - left, tool.y + 0.002),
            block(tool.x + right, tool.y - 0.002, tool.x + right + 0.005, tool.y + 0.002),
            block(tool.x - 0.002, tool.y - low - 0.005, tool.x + 0.002, tool.y - low),
            block(tool.x - 0.002, tool.y + high, tool.x + 0.002, tool.y + high + 0.005),
        ];
        let stage = Stage { workspace: &workspace, walls: &walls, wall_height_m: WALL_HEIGHT_M };
        let mut camera = Camera::new(gpu(), &stage, &CameraParameters::default()).unwrap();
        let percept = Percept::of(&camera.capture(&subject(tool, Point2::new(50.0, 50.0))).unwrap());
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
            // Half a pixel is what whole pixels can say; a fiftieth, what a shadow at the foot hides of it.
            assert!((seen_px - told_px).abs() <= 0.52, "{seen:?} {told:?}");
        }
        let back = calibration.table_from_image(told[1], told[2]);
        assert!((back - Point2::new(tool.x + right, tool.y - low)).norm() < 1e-12);
    }
}
