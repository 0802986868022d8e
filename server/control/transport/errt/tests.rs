use std::collections::VecDeque;

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query;
use parry2d_f64::shape::{Cuboid, Segment};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::clearance::{Clearance, End};
use super::obstacles::Obstacles;
use super::path::Path;
use super::planner::{Planner, PlannerParameters, Progress};
use super::tree::Tree;
use crate::geometry::{Point2, Rect};
use crate::image::GrayImage;
use crate::map::{FreeSpace, Map};
use crate::perception::{Calibration, DarkPixels, OBSTACLE_LEVEL, ObstacleMap};

const CLEARANCE_M: f64 = 0.012;
const LEAST_M: f64 = 0.006;
/// Upper bound of the errors of GJK and of the half-millimetre pieces near an end.
const TOLERANCE_M: f64 = 1e-6 + 0.000125;

/// Lets a map observe its whole workspace at once, in `per_cell` pixels per cell.
fn look(map: &mut ObstacleMap, per_cell: f64, is_wall: impl Fn(Point2<f64>) -> bool) {
    let workspace = *map.workspace();
    let m_per_px = map.cell_m().min() / per_cell;
    let size_px = (workspace.size_m().max() / m_per_px).round() as usize + 2;
    let center_m = workspace.center_m();
    let calibration = Calibration { center_m, m_per_px, size_px, foot_m: center_m };
    let point = |i: usize| calibration.table_from_image((i % size_px) as f64 + 0.5, (i / size_px) as f64 + 0.5);
    let pixels = (0..size_px * size_px).map(|i| if is_wall(point(i)) { 20 } else { 230 }).collect();
    let dark = DarkPixels::of(&GrayImage { width_px: size_px, height_px: size_px, pixels }, OBSTACLE_LEVEL);
    map.update(&dark, &calibration, 1.0);
}

fn seen(workspace: Rect, per_cell: f64, is_wall: impl Fn(Point2<f64>) -> bool) -> ObstacleMap {
    let mut map = ObstacleMap::new(workspace);
    look(&mut map, per_cell, is_wall);
    map
}

fn shipped(name: &str) -> (Map, Obstacles) {
    let map = Map::shipped(name).unwrap();
    let obstacles = Obstacles::of(&seen(*map.workspace(), 5.0, |p| !map.is_free(p)), CLEARANCE_M);
    (map, obstacles)
}

const SMALL: Rect = Rect { x_min_m: -0.08, x_max_m: 0.04, y_min_m: -0.5, y_max_m: -0.42 };

prop_compose! {
    /// A small workspace with walls that consist of whole cells.
    fn small_maps()(
        walls in prop::collection::vec((0u32..60, 0u32..40, 1u32..25, 1u32..10, any::<bool>()), 0..9),
    ) -> ObstacleMap {
        let is_wall = |p: Point2<f64>| {
            let [column, row] = [p.x - SMALL.x_min_m, p.y - SMALL.y_min_m].map(|m| (m / 0.002) as u32);
            walls.iter().any(|&(left, low, long, thick, is_upright)| {
                let (wide, high) = if is_upright { (thick, long) } else { (long, thick) };
                (left..left + wide).contains(&column) && (low..low + high).contains(&row)
            })
        };
        seen(SMALL, 1.0, is_wall)
    }
}

prop_compose! {
    /// A point on a lattice of 1 mm.
    fn places()(column in 0u32..=120, row in 0u32..=80) -> Point2<f64> {
        lattice_point(column, row)
    }
}

fn lattice_point(column: u32, row: u32) -> Point2<f64> {
    Point2::new(SMALL.x_min_m + 0.001 * f64::from(column), SMALL.y_min_m + 0.001 * f64::from(row))
}

fn no_ends(asked_m: f64) -> Clearance {
    Clearance { asked_m, ends: [End { point: Point2::origin(), distance_m: 1.0 }; 2] }
}

/// Distance from a straight line to the nearest rectangle and to the border, by parry2d.
fn brute_distance_m(obstacles: &Obstacles, from: Point2<f64>, to: Point2<f64>) -> f64 {
    let w = obstacles.workspace();
    let border_m = |p: Point2<f64>| (p.x - w.x_min_m).min(w.x_max_m - p.x).min(p.y - w.y_min_m).min(w.y_max_m - p.y);
    let segment = Segment::new(Vector::new(from.x, from.y), Vector::new(to.x, to.y));
    let to_rectangle_m = |rect: &Rect| {
        let (center, half) = (rect.center_m(), rect.size_m() / 2.0);
        let pose = Pose::translation(center.x, center.y);
        query::distance(&Pose::IDENTITY, &segment, &pose, &Cuboid::new(Vector::new(half.x, half.y))).unwrap().distance
    };
    obstacles.rectangles().iter().map(to_rectangle_m).fold(border_m(from).min(border_m(to)), f64::min)
}

/// Asserts with parry2d, every .2 mm, that an edge keeps its required clearance.
fn assert_kept(obstacles: &Obstacles, from: Point2<f64>, to: Point2<f64>, clearance: &Clearance) {
    let kept_m = brute_distance_m(obstacles, from, to);
    if kept_m >= clearance.asked_m - TOLERANCE_M {
        return;
    }
    let count = ((to - from).norm() / 2e-4).ceil() as usize + 1;
    for i in 0..=count {
        let p = from + (to - from) * (i as f64 / count as f64);
        let ends_m = clearance.ends.map(|end| end.distance_m + 0.25 * ((p - end.point).norm() - 0.006).max(0.0));
        let required_m = clearance.asked_m.min(ends_m[0]).min(ends_m[1]);
        let distance_m = brute_distance_m(obstacles, p, p);
        assert!(distance_m > 0.0 && distance_m >= required_m - TOLERANCE_M, "{p}: {distance_m} of {required_m}");
    }
}

fn assert_all_kept(planner: &Planner, obstacles: &Obstacles, path: &Path) {
    path.points.windows(2).for_each(|edge| assert_kept(obstacles, edge[0], edge[1], &path.clearance));
    let tree = planner.tree().unwrap();
    tree.edges().for_each(|[from, to]| assert_kept(obstacles, from, to, &path.clearance));
}

fn found(planner: &Planner) -> Option<&Path> {
    match planner.progress() {
        Progress::Found(path) => Some(path),
        _ => None,
    }
}

/// Whether clear steps between neighbours on the lattice lead from one of its points to another.
fn lattice_leads(obstacles: &Obstacles, clearance: &Clearance) -> bool {
    let [start, goal] = clearance.ends.map(|end| {
        let at = (end.point - lattice_point(0, 0)) / 0.001;
        (at.x.round() as u32, at.y.round() as u32)
    });
    let mut seen = vec![false; 121 * 81];
    let mut open = VecDeque::from([start]);
    while let Some((column, row)) = open.pop_front() {
        if (column, row) == goal {
            return true;
        }
        for row_to in row.saturating_sub(1)..=(row + 1).min(80) {
            for column_to in column.saturating_sub(1)..=(column + 1).min(120) {
                let seen = &mut seen[(row_to * 121 + column_to) as usize];
                let (from, to) = (lattice_point(column, row), lattice_point(column_to, row_to));
                if !*seen && obstacles.is_clear(from, to, clearance) {
                    *seen = true;
                    open.push_back((column_to, row_to));
                }
            }
        }
    }
    false
}

proptest! {
    #[test]
    fn an_edge_is_clear_when_its_distance_to_every_rectangle_is_enough(
        map in small_maps(), from in places(), to in places(), asked_m in 0.0005..0.02f64,
    ) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        prop_assert_eq!(obstacles.rectangles(), map.rectangles());
        let distance_m = brute_distance_m(&obstacles, from, to);
        prop_assume!((distance_m - asked_m).abs() > 1e-6);
        prop_assert_eq!(obstacles.is_clear(from, to, &no_ends(asked_m)), distance_m > asked_m, "{}", distance_m);
    }

    #[test]
    fn paths_begin_at_the_place_itself_or_at_the_nearest_clear_cell(map in small_maps(), point in places()) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        // Not exactly the clearance of any cell, except for rounding.
        let least_m = 0.0057;
        let brute_m = brute_distance_m(&obstacles, point, point);
        prop_assume!(brute_m == 0.0 || brute_m > 1e-6);
        let end = obstacles.end_near(point, least_m);
        if brute_m > 0.0 {
            prop_assert!(end.is_some_and(|end| end.point == point && (end.distance_m - brute_m).abs() < 1e-8));
            prop_assert_eq!(obstacles.end_at(point), end);
        } else {
            let centers = (0..60 * 40).map(|i| lattice_point(2 * (i % 60) + 1, 2 * (i / 60) + 1));
            let clear = centers.filter(|&p| brute_distance_m(&obstacles, p, p) >= least_m);
            let nearest_m = clear.map(|p| (p - point).norm()).min_by(f64::total_cmp);
            prop_assert_eq!(obstacles.end_at(point), None);
            prop_assert_eq!(end.is_some(), nearest_m.is_some());
            if let Some((end, nearest_m)) = end.zip(nearest_m) {
                prop_assert!(((end.point - point).norm() - nearest_m).abs() < 1e-8 && end.distance_m > least_m - 1e-8);
            }
        }
    }

    #[test]
    fn cell_distances_are_exact_up_to_the_largest_clearance(map in small_maps(), column in 0u32..60, row in 0u32..40) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        let center = lattice_point(2 * column + 1, 2 * row + 1);
        let (known_m, brute_m) = (obstacles.grid().distance_m(center), brute_distance_m(&obstacles, center, center));
        prop_assert!((known_m - brute_m).abs() < 1e-9 || known_m.min(brute_m) > CLEARANCE_M * 4.0 / 3.0);
    }

    #[test]
    fn the_nearest_node_matches_an_exhaustive_search(
        // Few distinct places, so that many distances are equal.
        nodes in prop::collection::vec((0u8..12, 0u8..12, any::<prop::sample::Index>()), 0..150),
        targets in prop::collection::vec((0u8..12, 0u8..12), 1..20),
        beta in prop_oneof![Just(0.0), Just(0.5), 0.0..0.65],
    ) {
        let point = |(x, y): (u8, u8)| Point2::new(0.01 * f64::from(x), 0.01 * f64::from(y));
        let mut tree = Tree::new(point((5, 5)));
        for (x, y, parent) in nodes {
            let parent = parent.index(tree.node_count());
            tree.push(point((x, y)), parent);
        }
        let back: Tree = postcard::from_bytes(&postcard::to_stdvec(&tree).unwrap()).unwrap();
        prop_assert_eq!(&back, &tree);
        for target in targets.into_iter().map(point) {
            let sum = |node: usize| (tree.point(node) - target).norm() + beta * tree.cost_m(node);
            // `min_by` returns the first of equal elements.
            let brute = (0..tree.node_count()).min_by(|&a, &b| sum(a).total_cmp(&sum(b))).unwrap();
            prop_assert_eq!(tree.nearest(target, beta), brute);
            prop_assert_eq!(back.nearest(target, beta), brute);
        }
    }

    #[test]
    fn paths_keep_their_clearance_and_walled_off_goals_have_no_path(
        map in small_maps(), from in places(), goal in places(), seed: u64,
    ) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        let parameters = PlannerParameters::default();
        let mut planner = Planner::new(seed);
        planner.start(&parameters, &obstacles, from, goal);
        planner.advance(&obstacles, 3000);
        match planner.progress() {
            Progress::Found(path) => {
                let start = obstacles.end_near(from, LEAST_M).unwrap().point;
                prop_assert_eq!([path.points[0], *path.points.last().unwrap()], [start, goal]);
                prop_assert!(path.is_clear_from(0.0, &obstacles, 0.0));
                assert_all_kept(&planner, &obstacles, path);
            }
            Progress::WalledOff => {
                let ends = obstacles.end_near(from, LEAST_M).zip(obstacles.end_at(goal));
                let clearance = ends.map(|(start, goal)| Clearance { asked_m: LEAST_M, ends: [start, goal] });
                prop_assert!(!clearance.is_some_and(|clearance| lattice_leads(&obstacles, &clearance)));
            }
            _ => (),
        }
    }

    #[test]
    fn one_seed_gives_one_tree_for_any_portions_and_save_points(
        map in small_maps(), from in places(), goal in places(), seed: u64, portion in 1usize..40,
    ) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        let parameters = PlannerParameters { most_attempts: 300, ..PlannerParameters::default() };
        let mut whole = Planner::new(seed);
        let mut parts = Planner::new(seed);
        for goal in [goal, from + (goal - from) * 0.7] {
            whole.start(&parameters, &obstacles, from, goal);
            parts.start(&parameters, &obstacles, from, goal);
            whole.advance(&obstacles, 300);
            for _ in 0..300usize.div_ceil(portion) {
                parts = postcard::from_bytes(&postcard::to_stdvec(&parts).unwrap()).unwrap();
                parts.advance(&obstacles, portion);
            }
            prop_assert_ne!(whole.progress(), &Progress::Searching);
            prop_assert_eq!(&parts, &whole);
        }
    }
}

#[test]
fn plans_paths_across_all_shipped_maps() {
    for name in Map::shipped_names() {
        let (map, obstacles) = shipped(&name);
        let space = FreeSpace::new(&map, CLEARANCE_M);
        let mut rng = ChaCha8Rng::seed_from_u64(11);
        let mut attempts = Vec::new();
        for seed in 0..300 {
            let from = space.sample(&map, None, &mut rng).unwrap();
            let goal = space.sample(&map, space.component_at(from), &mut rng).unwrap();
            let mut planner = Planner::new(seed);
            planner.start(&PlannerParameters::default(), &obstacles, from, goal);
            planner.advance(&obstacles, usize::MAX);
            let path = found(&planner).unwrap_or_else(|| panic!("{name}: {from} to {goal}: {:?}", planner.progress()));
            assert!(path.is_clear_from(0.0, &obstacles, 0.0));
            // Walls of the obstacle map are at least as thick as the true walls.
            assert!(path.points.iter().all(|&p| map.clearance_m(p) > path.clearance.required_m(p) - 1e-3), "{name}");
            if seed < 10 {
                assert_all_kept(&planner, &obstacles, path);
            }
            attempts.push(planner.attempts());
        }
        attempts.sort_unstable();
        println!("{name}: attempts median {}, p99 {}, max {}", attempts[150], attempts[297], attempts[299]);
    }
}

#[test]
fn a_tool_over_a_wall_leaves_it_and_does_not_follow_it() {
    let (map, obstacles) = shipped("colon");
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let w = *map.workspace();
    let goal = Point2::new(-0.24, -0.27);
    let mut over = 0;
    for seed in 0..200 {
        let from = Point2::new(rng.random_range(w.x_min_m..w.x_max_m), rng.random_range(w.y_min_m..w.y_max_m));
        let depth_m = -map.clearance_m(from);
        if !(-0.01..0.02).contains(&depth_m) {
            continue;
        }
        over += 1;
        let mut planner = Planner::new(seed);
        planner.start(&PlannerParameters::default(), &obstacles, from, goal);
        planner.advance(&obstacles, usize::MAX);
        let path = found(&planner).unwrap_or_else(|| panic!("{from} {depth_m}: {:?}", planner.progress()));
        assert_all_kept(&planner, &obstacles, path);
    }
    assert!(over > 50, "{over}");
}

#[test]
fn passes_narrow_gaps_with_less_clearance_and_reports_closed_ones() {
    let workspace = Rect { x_min_m: 0.0, x_max_m: 0.3, y_min_m: -0.5, y_max_m: -0.4 };
    let (from, goal) = (Point2::new(0.05, -0.45), Point2::new(0.25, -0.46));
    let plan = |gap_m: f64| {
        let is_wall = |p: Point2<f64>| (p.x - 0.15).abs() < 0.01 && (p.y + 0.44).abs() > gap_m / 2.0;
        let obstacles = Obstacles::of(&seen(workspace, 1.0, is_wall), CLEARANCE_M);
        let mut planner = Planner::new(1);
        planner.start(&PlannerParameters::default(), &obstacles, from, goal);
        planner.advance(&obstacles, usize::MAX).clone()
    };
    let asked_m = |gap_m: f64| match plan(gap_m) {
        Progress::Found(path) => path.clearance.asked_m,
        other => panic!("{gap_m}: {other:?}"),
    };
    assert_eq!(asked_m(0.036), 0.012);
    assert!((0.006..0.012).contains(&asked_m(0.024)));
    assert_eq!(asked_m(0.016), 0.006);
    assert_eq!(plan(0.006), Progress::WalledOff);
    assert_eq!(plan(-1.0), Progress::WalledOff);
}

#[test]
fn goals_in_a_wall_outside_or_not_finite_are_walled_off() {
    let (map, obstacles) = shipped("posts");
    let from = Point2::new(-0.24, -0.25);
    for goal in [Point2::new(-0.2, -0.305), Point2::new(0.3, -0.3), Point2::new(f64::NAN, -0.3)] {
        assert!(!goal.x.is_finite() || map.clearance_m(goal) < 0.0);
        for (from, goal) in [(from, goal), (Point2::new(f64::NAN, f64::INFINITY), goal)] {
            let mut planner = Planner::new(1);
            planner.start(&PlannerParameters::default(), &obstacles, from, goal);
            assert_eq!(planner.advance(&obstacles, 10), &Progress::WalledOff);
        }
    }
}

#[test]
fn a_search_restarts_when_the_map_changes() {
    let wall = |p: Point2<f64>, x_m: f64| (p.x - x_m).abs() < 0.004 && p.y < -0.445;
    let workspace = Rect { x_min_m: 0.0, x_max_m: 0.3, y_min_m: -0.5, y_max_m: -0.4 };
    let (from, goal) = (Point2::new(0.05, -0.48), Point2::new(0.25, -0.48));
    let mut map = seen(workspace, 1.0, |p| wall(p, 0.15));
    let before = Obstacles::of(&map, CLEARANCE_M);
    let mut planner = Planner::new(1);
    planner.start(&PlannerParameters::default(), &before, from, goal);
    assert_eq!(planner.advance(&before, 20), &Progress::Searching);
    // A second wall is observed.
    look(&mut map, 1.0, |p| wall(p, 0.15) || wall(p, 0.09));
    let after = Obstacles::of(&map, CLEARANCE_M);
    assert_ne!(before.version(), after.version());
    planner.advance(&after, usize::MAX);
    let path = found(&planner).unwrap();
    assert_all_kept(&planner, &after, path);
    assert!(
        path.is_clear_from(0.0, &before, 0.0)
            && !path.is_clear_from(0.0, &after, -0.002)
            && path.is_clear_from(0.0, &after, 0.002)
    );
}

#[test]
fn paths_found_before_are_found_again_sooner() {
    let (_, obstacles) = shipped("colon-folds");
    let (from, goal) = (Point2::new(-0.25, -0.385), Point2::new(0.2, -0.3));
    let attempts = |waypoints: usize| {
        let parameters = PlannerParameters { waypoints, ..PlannerParameters::default() };
        let mut planner = Planner::new(4);
        let plan = |_| {
            planner.start(&parameters, &obstacles, from, goal);
            planner.advance(&obstacles, usize::MAX);
            found(&planner).map(|_| planner.attempts()).expect("there is a path")
        };
        (0..40).map(plan).skip(10).sum::<usize>()
    };
    let (with, without) = (attempts(200), attempts(0));
    assert!(5 * with < 4 * without, "{with} {without}");
}
