use proptest::prelude::*;

use super::*;
use crate::geometry::Point2;
use crate::perception::test_world::{WORKSPACE, channel, posts, seen_from, simple, spread};
use crate::perception::{OBSTACLE_LEVEL, Quadtree};

/// Updates a map with an image of a world.
fn look(map: &mut ObstacleMap, center: Point2<f64>, is_wall: impl Fn(Point2<f64>) -> bool) -> Change {
    let percept = seen_from(center, is_wall);
    map.update(&DarkPixels::of(&percept.gray, OBSTACLE_LEVEL), &percept.calibration, spread())
}

fn tour() -> impl Iterator<Item = Point2<f64>> {
    // Steps that are not multiples of a cell or of a pixel.
    (0..24).map(|i| Point2::new(-0.25 + 0.02137 * f64::from(i), -0.375 + 0.08 * (0.7 * f64::from(i)).sin()))
}

fn all_cells(map: &ObstacleMap) -> impl Iterator<Item = CellRect> {
    let (columns, rows) = map.shape();
    (0..rows).flat_map(move |row| (0..columns).map(move |column| CellRect { column, row, columns: 1, rows: 1 }))
}

/// Whether any wall is within `margin_m` of a rectangle, tested every .2 mm.
fn wall_within(rect: &Rect, margin_m: f64) -> bool {
    let count = |from: f64, to: f64| ((to - from + 2.0 * margin_m) / 2e-4).floor() as usize;
    let (across, down) = (count(rect.x_min_m, rect.x_max_m), count(rect.y_min_m, rect.y_max_m));
    (0..=across).any(|i| {
        (0..=down).any(|j| {
            simple(Point2::new(rect.x_min_m - margin_m + 2e-4 * i as f64, rect.y_min_m - margin_m + 2e-4 * j as f64))
        })
    })
}

#[test]
fn cells_have_two_millimetres_and_a_bounded_number() {
    assert_eq!(shape(&WORKSPACE), (290, 165));
    let square = |side_m: f64| Rect { x_min_m: 0.0, x_max_m: side_m, y_min_m: 0.0, y_max_m: side_m };
    assert_eq!(shape(&square(1.0)), (500, 500));
    assert_eq!(shape(&square(4.0)), (512, 512));
    assert_eq!(shape(&square(0.0)), (1, 1));
    let long = Rect { x_max_m: 1e6, ..square(1e-3) };
    assert!(shape(&long).0 <= 4096 && shape(&Rect { y_max_m: f64::NAN, ..long }).1 == 1);
    let cell_m = ObstacleMap::new(WORKSPACE).cell_m();
    assert!((cell_m - Vector2::repeat(0.002)).norm() < 1e-12);
}

#[test]
fn a_new_map_is_unknown_and_the_outside_is_wall() {
    let map = ObstacleMap::new(WORKSPACE);
    let middle = Point2::new(0.0, -0.4);
    assert_eq!(map.disc(middle, 0.01), Area::Unknown);
    assert!(map.is_corridor_free(middle, Point2::new(0.1, -0.4), 0.01, Unknown::Free));
    assert!(!map.is_corridor_free(middle, Point2::new(0.1, -0.4), 0.01, Unknown::Blocked));
    assert_eq!(map.disc(Point2::new(0.275, -0.4), 0.01), Area::Blocked);
    assert_eq!(map.disc(Point2::new(0.3, -0.4), 0.0), Area::Blocked);
    assert_eq!(map.disc(Point2::new(f64::NAN, -0.4), 0.01), Area::Blocked);
    assert_eq!(map.disc(middle, f64::NAN), Area::Blocked);
    assert_eq!(map.state(middle), CellState::Unknown);
    assert_eq!(map.state(Point2::new(0.3, -0.4)), CellState::Obstacle);
    assert!((map.nearest_obstacle_m(Point2::new(0.2, -0.4)) - 0.08).abs() < 1e-12);
    assert_eq!(map.nearest_obstacle_m(Point2::new(0.2, 0.4)), 0.0);
    assert_eq!(map.runs(), [(CellState::Unknown, 290 * 165)]);
    assert!(map.rectangles().is_empty());
}

#[test]
fn obstacles_match_walls_to_a_cell_and_a_pixel_from_everywhere() {
    let mut map = ObstacleMap::new(WORKSPACE);
    tour().for_each(|center| drop(look(&mut map, center, simple)));
    let (mut walls, mut free) = (0, 0);
    let pixel_m = 0.2 / 480.0;
    for cell in all_cells(&map) {
        let rect = map.rect(&cell);
        match map.cell_state(cell.column, cell.row) {
            CellState::Obstacle => {
                walls += 1;
                assert!(wall_within(&rect, pixel_m), "{rect:?} has no wall");
            }
            CellState::Free => {
                free += 1;
                // A wall that extends into the cell by less than a pixel can be missed.
                assert!(!wall_within(&rect, -pixel_m), "{rect:?} contains a wall");
            }
            CellState::Unknown => (),
        }
    }
    assert!(walls > 2000 && free > 40_000, "{walls} {free}");
}

#[test]
fn a_static_world_is_never_cleared_and_soon_unchanged() {
    for world in [simple, posts] {
        let mut map = ObstacleMap::new(WORKSPACE);
        for center in tour() {
            let change = look(&mut map, center, world);
            assert_eq!(change.cleared, [], "from {center}");
        }
        let version = map.version();
        assert!(version > 3);
        for center in tour() {
            assert_eq!(look(&mut map, center, world), Change::default());
        }
        assert_eq!(map.version(), version);
    }
}

#[test]
fn reports_cleared_and_new_obstacles() {
    let center = Point2::new(-0.05, -0.35);
    let post = |p: Point2<f64>| (p - Point2::new(-0.02, -0.33)).norm() < 0.008;
    let area_m2 = |rects: &[Rect]| rects.iter().map(|rect| rect.size_m().product()).sum::<f64>();
    let mut map = ObstacleMap::new(WORKSPACE);
    let change = look(&mut map, center, |_| false);
    assert!(change.seen_more && change.appeared.is_empty() && map.version() == 0);
    assert_eq!(map.disc(Point2::new(-0.02, -0.33), 0.01), Area::Free);
    let change = look(&mut map, center, post);
    assert!((2e-4..3e-4).contains(&area_m2(&change.appeared)) && !change.seen_more && map.version() == 1);
    // All obstacles are new, so the two partitions are equal.
    assert_eq!(map.rectangles().len(), change.appeared.len());
    assert_eq!(map.disc(Point2::new(-0.02, -0.35), 0.015), Area::Blocked);
    assert_eq!(look(&mut map, center, post), Change::default());
    let change = look(&mut map, center, |_| false);
    assert!((2e-4..3e-4).contains(&area_m2(&change.cleared)) && map.version() == 2);
    assert!(map.rectangles().is_empty());
}

#[test]
fn blocks_of_a_quadtree_contain_all_obstacles_of_the_pixels() {
    let center = Point2::new(0.02, -0.35);
    let percept = seen_from(center, channel);
    let dark = DarkPixels::of(&percept.gray, OBSTACLE_LEVEL);
    let (mut fine, mut coarse) = (ObstacleMap::new(WORKSPACE), ObstacleMap::new(WORKSPACE));
    fine.update(&dark, &percept.calibration, 1.0);
    coarse.update(&Quadtree::of_dark(&dark, 6).dark_pixels(), &percept.calibration, 1.0);
    for cell in all_cells(&fine) {
        let holds = |map: &ObstacleMap| map.cells.obstacle.get(cell.column, cell.row);
        assert!(holds(&coarse) || !holds(&fine));
    }
    assert_eq!(fine.cells.seen, coarse.cells.seen);
}

#[test]
fn cells_finer_than_pixels_are_updated_too() {
    let center_m = Point2::new(0.0, -0.4);
    let calibration = Calibration { center_m, m_per_px: 0.01, size_px: 64, foot_m: center_m };
    let gray = crate::image::GrayImage { width_px: 64, height_px: 64, pixels: vec![0; 64 * 64] };
    let mut map = ObstacleMap::new(WORKSPACE);
    map.update(&DarkPixels::of(&gray, 50), &calibration, 1.0);
    assert_eq!(map.rectangles(), [WORKSPACE]);
    // Invalid geometry has no effect.
    for (m_per_px, spread) in [(0.0, 1.0), (f64::NAN, 1.0), (1e-300, 1.0), (0.01, f64::INFINITY), (0.01, f64::NAN)] {
        let absurd = Calibration { m_per_px, ..calibration };
        assert_eq!(map.update(&DarkPixels::of(&gray, 50), &absurd, spread), Change::default(), "{m_per_px} {spread}");
    }
}

#[test]
fn a_map_survives_serialisation_and_a_forged_one_is_rejected() {
    let mut map = ObstacleMap::new(WORKSPACE);
    tour().take(3).for_each(|center| drop(look(&mut map, center, simple)));
    let bytes = stored(&map);
    assert!(bytes.len() < 14_000, "{}", bytes.len());
    assert_eq!(read(&bytes).unwrap(), map);
    let mut forged = map.clone();
    forged.workspace.x_max_m = 0.5;
    assert!(read(&stored(&forged)).is_err());
    let mut forged = map.clone();
    Arc::make_mut(&mut forged.cells).seen = BitGrid::zero(290, 164);
    assert!(read(&stored(&forged)).is_err());
}

/// As in a stored state.
fn stored(map: &ObstacleMap) -> Vec<u8> {
    let mut bytes = Vec::new();
    ciborium::into_writer(map, &mut bytes).unwrap();
    bytes
}

fn read(bytes: &[u8]) -> Result<ObstacleMap, ciborium::de::Error<std::io::Error>> {
    ciborium::from_reader(bytes)
}

/// A map of about 60 × 40 cells with random content.
fn random_map(obstacles: &[(usize, usize)], unseen: &[(usize, usize)]) -> ObstacleMap {
    let workspace = Rect { x_min_m: -0.071, x_max_m: 0.05, y_min_m: -0.03, y_max_m: 0.05 };
    let mut map = ObstacleMap::new(workspace);
    let cells = Arc::make_mut(&mut map.cells);
    let (columns, rows) = (cells.seen.columns, cells.seen.rows);
    for row in 0..rows {
        for column in 0..columns {
            let is_obstacle = obstacles.contains(&(column, row));
            if is_obstacle {
                cells.obstacle.flip(column, row);
            }
            if is_obstacle || !unseen.contains(&(column, row)) {
                cells.seen.flip(column, row);
            }
        }
    }
    map
}

fn distance_m(point: Point2<f64>, rect: &Rect) -> f64 {
    let dx = (rect.x_min_m - point.x).max(point.x - rect.x_max_m).max(0.0);
    let dy = (rect.y_min_m - point.y).max(point.y - rect.y_max_m).max(0.0);
    dx.hypot(dy)
}

/// Distance from a line segment to a rectangle. It is convex along the segment, so a ternary search finds it.
fn line_distance_m(from: Point2<f64>, to: Point2<f64>, rect: &Rect) -> f64 {
    let at = |share: f64| distance_m(from + (to - from) * share, rect);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..120 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) <= at(b) { high = b } else { low = a }
    }
    at(0.5 * (low + high)).min(at(0.0)).min(at(1.0))
}

prop_compose! {
    fn maps()(
        obstacles in prop::collection::vec((0..61usize, 0..40usize), 0..12),
        unseen in prop::collection::vec((0..61usize, 0..40usize), 0..12),
    ) -> ObstacleMap {
        random_map(&obstacles, &unseen)
    }
}

fn places() -> impl Strategy<Value = Point2<f64>> {
    (-0.08..0.06, -0.04..0.06).prop_map(|(x, y)| Point2::new(x, y))
}

proptest! {
    #[test]
    fn a_corridor_has_the_state_of_the_cells_within_its_clearance(
        map in maps(), from in places(), to in places(), on_axis in 0..4u8, clearance_m in 0.0..0.02f64,
    ) {
        let to = match on_axis {
            0 => Point2::new(from.x, to.y),
            1 => Point2::new(to.x, from.y),
            2 => from,
            _ => to,
        };
        let mut expected = Area::Free;
        for cell in all_cells(&map) {
            let state = map.cell_state(cell.column, cell.row);
            if state == CellState::Free {
                continue;
            }
            let distance_m = line_distance_m(from, to, &map.rect(&cell));
            prop_assume!((distance_m - clearance_m).abs() > 1e-9);
            if distance_m < clearance_m || distance_m == 0.0 {
                match state {
                    CellState::Obstacle => expected = Area::Blocked,
                    CellState::Unknown if expected == Area::Free => expected = Area::Unknown,
                    _ => (),
                }
            }
        }
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = *map.workspace();
        let keeps_in = |p: Point2<f64>| {
            [p.x - x_min_m, x_max_m - p.x, p.y - y_min_m, y_max_m - p.y].iter().all(|&rest| rest >= clearance_m)
        };
        if !keeps_in(from) || !keeps_in(to) {
            expected = Area::Blocked;
        }
        prop_assert_eq!(map.corridor(from, to, clearance_m), expected);
        prop_assert_eq!(map.corridor(to, from, clearance_m), expected);
        prop_assert_eq!(map.disc(from, clearance_m), map.corridor(from, from, clearance_m));
        prop_assert_eq!(map.is_corridor_free(from, to, clearance_m, Unknown::Blocked), expected == Area::Free);
        prop_assert_eq!(map.is_corridor_free(from, to, clearance_m, Unknown::Free), expected != Area::Blocked);
    }

    #[test]
    fn the_nearest_obstacle_is_the_nearest_cell_or_the_border(map in maps(), at in places()) {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = *map.workspace();
        let border_m = [at.x - x_min_m, x_max_m - at.x, at.y - y_min_m, y_max_m - at.y];
        let cells = all_cells(&map).filter(|cell| map.cells.obstacle.get(cell.column, cell.row));
        let distances_m = cells.map(|cell| distance_m(at, &map.rect(&cell))).chain(border_m);
        let expected = distances_m.fold(f64::INFINITY, f64::min).max(0.0);
        prop_assert!((map.nearest_obstacle_m(at) - expected).abs() < 1e-12);
    }

    #[test]
    fn rectangles_and_runs_agree_with_the_cells(map in maps()) {
        let rectangles = map.rectangles();
        let runs = map.runs();
        let mut states = runs.iter().flat_map(|&(state, count)| std::iter::repeat_n(state, count as usize));
        for cell in all_cells(&map) {
            let middle = map.rect(&cell).center_m();
            let state = map.state(middle);
            prop_assert_eq!(Some(state), states.next());
            let held = rectangles.iter().filter(|rect| rect.contains(middle)).count();
            prop_assert_eq!(held, usize::from(state == CellState::Obstacle));
        }
        prop_assert_eq!(states.next(), None);
        prop_assert_eq!(map.partition().formula(), rectangles.len());
    }
}

#[test]
fn what_came_to_a_free_place_and_left_the_view_is_forgotten() {
    // A wall on the left, and a door that opens and closes.
    let world = |is_closed: bool| move |p: Point2<f64>| p.x < -0.05 || is_closed && (p.x - 0.03).abs() < 0.006;
    let (here, away) = (Point2::new(0.0, -0.37), Point2::new(0.2, -0.37));
    let (wall, door) = (Point2::new(-0.06, -0.37), Point2::new(0.03, -0.37));
    let mut map = ObstacleMap::new(WORKSPACE);
    let step = |map: &mut ObstacleMap, tick: u64, center, is_closed: bool| {
        map.forget(tick, 100);
        look(map, center, world(is_closed));
    };
    step(&mut map, 0, here, false);
    step(&mut map, 31, here, true);
    assert_eq!([map.state(wall), map.state(door)], [CellState::Obstacle; 2]);
    let mut forgotten_at = None;
    for tick in (62..500).step_by(31) {
        step(&mut map, tick, away, true);
        if map.state(door) == CellState::Unknown {
            forgotten_at = forgotten_at.or(Some(tick));
        }
    }
    assert!(forgotten_at.is_some_and(|tick| (131..=231).contains(&tick)), "{forgotten_at:?}");
    assert_eq!(map.state(wall), CellState::Obstacle, "what has always been a wall stays");
    assert_eq!(map.state(door), CellState::Unknown);
    assert_eq!(read(&stored(&map)).unwrap(), map);
}
