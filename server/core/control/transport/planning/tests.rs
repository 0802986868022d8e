use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::path::MOST_MISSES;
use super::test_space::*;
use super::{Clearance, Obstacles, Path};
use crate::map::{FreeSpace, Map};

/// The smallest clearance and a cell.
const ROOMY_M: f64 = LEAST_M + 0.002;

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
        let point_m = brute_distance_m(&obstacles, from, from);
        prop_assume!((point_m - asked_m).abs() > 1e-6);
        prop_assert_eq!(obstacles.is_clear(from, from, &no_ends(asked_m)), point_m > asked_m, "{}", point_m);
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
    fn the_shortest_path_keeps_its_clearance_and_exists_where_steps_with_a_cell_more_lead(
        map in small_maps(), from in places(), goal in places(),
    ) {
        let obstacles = Obstacles::of(&map, CLEARANCE_M);
        let ends = obstacles.end_near(from, LEAST_M).zip(obstacles.end_at(goal));
        match obstacles.shortest_path(from, goal, [CLEARANCE_M, LEAST_M]) {
            Some(path) => {
                prop_assert_eq!([path.points[0], *path.points.last().unwrap()], [ends.unwrap().0.point, goal]);
                path.points.windows(2).for_each(|edge| assert_kept(&obstacles, edge[0], edge[1], &path.clearance));
            }
            None => {
                // Cells are coarser than the lattice, so a path between the two clearances may be missed.
                let roomy = ends.filter(|(start, goal)| start.distance_m.min(goal.distance_m) > ROOMY_M);
                let clearance = roomy.map(|(start, goal)| Clearance { asked_m: ROOMY_M, ends: [start, goal] });
                prop_assert!(!clearance.is_some_and(|clearance| lattice_leads(&obstacles, &clearance)));
            }
        }
    }
}

#[test]
fn the_shortest_path_is_as_short_as_a_taut_one() {
    for name in Map::shipped_names() {
        let (map, obstacles) = shipped(&name);
        let space = FreeSpace::new(&map, CLEARANCE_M);
        let mut rng = ChaCha8Rng::seed_from_u64(12);
        let mut ratios = Vec::new();
        for _ in 0..40 {
            let from = space.sample(&map, None, &mut rng).unwrap();
            let goal = space.sample(&map, space.component_at(from), &mut rng).unwrap();
            let path = obstacles.shortest_path(from, goal, [CLEARANCE_M, LEAST_M]).unwrap();
            let taut = space.taut_path(from, goal).unwrap();
            let taut_m: f64 = taut.windows(2).map(|edge| (edge[1] - edge[0]).norm()).sum();
            ratios.push(path.length_m() / taut_m);
        }
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        println!("{name}: {mean:.3}, most {:.3}", ratios.iter().copied().fold(0.0, f64::max));
        assert!(mean < 1.03, "{name}: {mean}");
    }
}

#[test]
fn shortening_ends_after_so_many_misses() {
    let (_, obstacles) = shipped("open");
    // A straight line has no shortcut, so each one misses.
    let points = vec![lattice_point(20, 20), lattice_point(30, 30)];
    let after = |count| {
        let mut path = Path { points: points.clone(), clearance: no_ends(LEAST_M) };
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        path.cut_short(count, &obstacles, &mut rng);
        assert_eq!(path.points, points);
        rng
    };
    assert_eq!(after(200), after(MOST_MISSES));
    assert_ne!(after(MOST_MISSES), after(MOST_MISSES - 1));
}
