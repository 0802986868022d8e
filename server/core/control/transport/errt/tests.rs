use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::planner::{Planner, PlannerParameters, Progress};
use super::tree::Tree;
use super::{Errt, Transport, TransportInput};
use crate::control::transport::planning::test_space::*;
use crate::control::transport::planning::{Clearance, Obstacles, Path};
use crate::geometry::{Point2, Rect};
use crate::map::{FreeSpace, Map, Maze, MazeFamily};
use crate::perception::{Percept, test_frame};
use crate::scenario::Parameters;

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

proptest! {
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
fn a_path_through_a_long_channel_with_a_narrow_strip_is_found_in_one_control_step() {
    let map = Maze::generate(MazeFamily::Spirals, 13).unwrap().map;
    let known = seen(*map.workspace(), 5.0, |p| !map.is_free(p));
    let (tool_m, goal_m) = (Point2::new(0.257, -0.4445), Point2::new(0.21, -0.325));
    let percept = Percept::of(&test_frame(tool_m, |_| false), tool_m);
    let parameters = &Parameters::default();
    let input = TransportInput { percept: &percept, known: &known, tool_m, goal_m, parameters, policy: None };
    let mut exhausted = 0;
    for seed in 0..10 {
        let mut errt = Errt::new(seed);
        errt.next_step(&input).unwrap();
        let path = errt.path().unwrap();
        let obstacles = Obstacles::of(&known, CLEARANCE_M);
        path.points.windows(2).for_each(|edge| assert_kept(&obstacles, edge[0], edge[1], &path.clearance));
        exhausted += u32::from(*errt.planner().progress() == Progress::Exhausted);
    }
    assert!(exhausted > 0, "the tree finds each path, so this shows nothing");
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
