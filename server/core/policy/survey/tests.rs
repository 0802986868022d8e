use candle_core::{Device, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::route::CheapestRoutes;
use super::*;
use crate::geometry::Rect;
use crate::perception::ObstacleMap;
use crate::policy::{Architecture, Fusion, Manifest, Policy};

const COLUMNS: usize = 7;
const ROWS: usize = 5;

fn random_costs(seed: u64) -> Vec<f32> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..COLUMNS * ROWS).map(|_| rng.random_range(0.1..3.0)).collect()
}

/// Costs to the goal by relaxing every edge until nothing changes.
fn relaxed(costs: &[f32], goal: usize) -> Vec<f64> {
    let mut found = vec![f64::INFINITY; costs.len()];
    found[goal] = 0.0;
    for _ in 0..costs.len() {
        for cell in (0..costs.len()).filter(|&cell| cell != goal) {
            let lattice = Survey::unknown(COLUMNS, ROWS, 0, 0);
            let beside = Action::ALL.into_iter().filter_map(|action| lattice.beside(cell, action));
            let least = beside.map(|next| found[next] + f64::from(costs[next])).fold(f64::INFINITY, f64::min);
            found[cell] = found[cell].min(least);
        }
    }
    found
}

#[test]
fn routes_are_the_cheapest() {
    for seed in 0..20 {
        let goals = [seed as usize % 35, 34 - seed as usize];
        let costs = [random_costs(seed), random_costs(100 + seed)];
        let tensor = Tensor::from_vec(costs.concat(), (2, 35), &Device::Cpu).unwrap();
        let found = CheapestRoutes { columns: COLUMNS, goals: goals.to_vec() }.forward(&tensor).unwrap();
        for (found, (costs, goal)) in found.to_vec2::<f32>().unwrap().iter().zip(costs.iter().zip(goals)) {
            for (found, expected) in found.iter().zip(relaxed(costs, goal)) {
                assert!((f64::from(*found) - expected).abs() < 1e-4, "{found} {expected}");
            }
        }
    }
}

#[test]
fn the_gradient_of_a_route_is_the_change_of_its_cost() {
    let (costs, goal, from) = (random_costs(7), 3, 31);
    let variable = Var::from_vec(costs.clone(), (1, 35), &Device::Cpu).unwrap();
    let found = CheapestRoutes { columns: COLUMNS, goals: vec![goal] }.forward(&variable).unwrap();
    let gradients = found.flatten_all().unwrap().get(from).unwrap().backward().unwrap();
    let gradient: Vec<f32> = gradients.get(&variable).unwrap().flatten_all().unwrap().to_vec1().unwrap();
    let before = relaxed(&costs, goal)[from];
    let mut entered = 0;
    for cell in 0..costs.len() {
        let mut changed = costs.clone();
        changed[cell] += 1e-3;
        let slope = (relaxed(&changed, goal)[from] - before) / 1e-3;
        assert!((f64::from(gradient[cell]) - slope).abs() < 1e-2, "cell {cell}: {} {slope}", gradient[cell]);
        entered += usize::from(gradient[cell] != 0.0);
    }
    assert!(entered >= 4, "the goal is four rows away");
}

#[test]
fn costs_that_are_not_positive_numbers_are_refused() {
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let costs = Tensor::new(&[[1.0, bad]], &Device::Cpu).unwrap();
        let error = CheapestRoutes { columns: 2, goals: vec![0] }.forward(&costs).unwrap_err();
        assert!(error.to_string().contains("a cost is"), "{error}");
    }
}

#[test]
fn content_and_visits_of_a_cell_are_kept_apart() {
    let mut survey = Survey::unknown(3, 2, 0, 5);
    survey.set_visits(4, 2);
    survey.set_known(4, Area::Blocked);
    assert_eq!((survey.known(4), survey.visits(4)), (Area::Blocked, 2));
    survey.set_visits(4, 1000);
    survey.set_known(4, Area::Free);
    assert_eq!((survey.known(4), survey.visits(4)), (Area::Free, 63));
    survey.clear_visits();
    assert_eq!((survey.known(4), survey.visits(4), survey.known(0)), (Area::Free, 0, Area::Unknown));
    assert_eq!(survey.beside(2, Action::PlusX), None);
    assert_eq!(survey.beside(2, Action::PlusY), Some(5));
}

#[test]
fn a_survey_has_the_cells_of_the_workspace() {
    let workspace = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
    let ends_m = [Point2::new(-0.295, -0.535), Point2::new(0.5, -0.21)];
    let survey = Survey::over(&ObstacleMap::new(workspace), 0.01, 0.008, ends_m);
    assert_eq!(survey.shape(), (58, 33));
    assert_eq!((survey.tool, survey.goal), (0, 58 * 33 - 1));
    // The border of the workspace is a wall; all else is unseen.
    assert_eq!(survey.known(0), Area::Blocked);
    assert_eq!(survey.known(58 + 1), Area::Unknown);
    let picture = survey.picture();
    // The tool's cell is in the middle; up is +y.
    assert_eq!((picture.pixels[42 * 84 + 42], picture.pixels[41 * 84 + 43]), (0, 128));
    assert_eq!(picture.pixels[43 * 84 + 42], 0, "outside");
}

/// A policy with random weights.
fn policy(parts: SurveyParts) -> Policy {
    let architecture = Architecture { fusion: Fusion::Survey, survey: parts, ..Architecture::default() };
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let weights: Vec<_> = architecture.tensors().into_iter().map(|spec| (spec.clone(), spec.draw(&mut rng))).collect();
    let manifest = Manifest {
        version: Manifest::VERSION,
        maps: vec!["none".to_owned()],
        step_m: 0.01,
        observation: Manifest::observation(&architecture),
        architecture,
        clearance_m: 0.008,
        seed: 5,
        revision: "none".to_owned(),
        updates: 0,
    };
    Policy::from_bytes(&Policy::to_bytes(&manifest, &weights).unwrap()).unwrap()
}

/// A room with a wall in its middle, partly seen.
fn room() -> Survey {
    let mut survey = Survey::unknown(12, 9, 14, 93);
    for cell in 0..60 {
        survey.set_known(cell, if cell % 12 == 6 { Area::Blocked } else { Area::Free });
    }
    survey.set_visits(15, 2);
    survey
}

#[test]
fn the_values_of_many_cells_are_those_of_each() {
    let (policy, survey) = (policy(SurveyParts::ALL), room());
    let cells = [0, 14, 50, 107];
    let together = policy.plan(&survey).unwrap().judge(&cells).unwrap();
    for (cell, together) in cells.into_iter().zip(together) {
        let alone = policy.judge_survey(&Survey { tool: cell, ..survey.clone() }).unwrap();
        for (a, b) in together.values().into_iter().zip(alone.values()) {
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
    }
}

#[test]
fn a_policy_sees_what_it_should_and_no_more() {
    let values = |policy: &Policy, survey: &Survey| policy.judge_survey(survey).unwrap().values();
    let survey = room();
    let mut walked = survey.clone();
    walked.set_visits(13, 3);
    let mut blocked = survey.clone();
    blocked.set_known(16, Area::Blocked);
    let all = policy(SurveyParts::ALL);
    assert_ne!(values(&all, &survey), values(&all, &walked));
    assert_ne!(values(&all, &survey), values(&all, &blocked));
    let without = policy(SurveyParts { visits: false, ..SurveyParts::ALL });
    assert_eq!(values(&without, &survey), values(&without, &walked));
    assert_ne!(values(&without, &survey), values(&without, &blocked));
    // Far away, only the plan and the coarse scale could tell.
    let one_scale = policy(SurveyParts { coarse: false, ..SurveyParts::ALL });
    assert_ne!(values(&one_scale, &survey), values(&one_scale, &blocked));
}

#[test]
fn an_image_is_no_survey() {
    let policy = policy(SurveyParts::ALL);
    assert!(policy.has_memory());
    let error = policy.judge(&crate::perception::Observation { bytes: vec![0; 2 * 84 * 84] }).unwrap_err();
    assert!(error.to_string().contains("the network sees a survey, not an image"), "{error}");
    let image = Policy::shipped("colon").unwrap();
    assert!(!image.has_memory());
    let error = image.judge_survey(&room()).unwrap_err();
    assert!(error.to_string().contains("the network sees an image, not a survey"), "{error}");
}

#[test]
fn a_goal_is_walled_off_where_no_route_avoids_blocked_cells() {
    let mut survey = Survey::unknown(COLUMNS, ROWS, 0, COLUMNS * ROWS - 1);
    assert!(!survey.is_walled_off());
    let column = |row: usize| row * COLUMNS + 3;
    (0..ROWS).for_each(|row| survey.set_known(column(row), Area::Blocked));
    assert!(survey.is_walled_off());
    survey.goal = column(2);
    assert!(!survey.is_walled_off(), "a goal near a wall is reached from beside its cell");
    survey.goal = COLUMNS - 1;
    survey.set_known(column(4), Area::Unknown);
    assert!(!survey.is_walled_off());
}
