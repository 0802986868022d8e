use super::*;
use crate::control::transport::planning::test_space::seen;
use crate::geometry::Rect;
use crate::perception::{ObstacleMap, test_frame};
use crate::policy::{Architecture, Manifest, TensorSpec};
use crate::scenario::Parameters;

const WORKSPACE: Rect = Rect { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 };
/// Middle of a cell.
const HERE: Point2<f64> = Point2::new(0.005, -0.385);

/// A policy with these action values everywhere: all weights are zero except the last bias.
fn wanting(values: [f32; 4]) -> Policy {
    let architecture = Architecture { noisy: false, dueling: false, ..Architecture::default() };
    let (version, observation) = (Manifest::VERSION, [2, 84, 84]);
    let manifest = Manifest {
        version,
        maps: vec!["none".to_owned()],
        step_m: 0.01,
        observation,
        architecture,
        clearance_m: 0.008,
        seed: 0,
        revision: "none".to_owned(),
        updates: 0,
    };
    let weight = |spec: TensorSpec| {
        let zeros = vec![0.0; spec.shape.iter().product()];
        let numbers = if spec.name == "advantage.out.bias" { values.to_vec() } else { zeros };
        (spec, numbers)
    };
    let weights: Vec<_> = architecture.tensors().into_iter().map(weight).collect();
    Policy::from_bytes(&Policy::to_bytes(&manifest, &weights).unwrap()).unwrap()
}
/// One control step with the tool at a place.
/// One control step with the tool somewhere.
fn step(
    rl: &mut Rl,
    policy: &Policy,
    tool_m: Point2<f64>,
    parameters: &Parameters,
    wall: impl Fn(Point2<f64>) -> bool,
) -> Point2<f64> {
    let percept = Percept::of(&test_frame(tool_m, wall), tool_m);
    let known = ObstacleMap::new(WORKSPACE);
    let goal_m = Point2::new(0.1, -0.4);
    let policy = Some(policy);
    let input = TransportInput { percept: &percept, known: &known, tool_m, goal_m, parameters, policy };
    rl.next_step(&input).unwrap().target_m
}

fn near(a: Point2<f64>, b: Point2<f64>) -> bool {
    (a - b).norm() < 1e-9
}

#[test]
fn the_best_action_is_taken_one_step_along_its_axis() {
    let parameters = Parameters::default();
    for action in Action::ALL {
        let mut values = [0.0; 4];
        values[action.index()] = 0.5;
        let mut rl = Rl::default();
        let target_m = step(&mut rl, &wanting(values), HERE, &parameters, |_| false);
        assert!(near(target_m, HERE + action.direction() * 0.01), "{action:?} {target_m}");
        let Decision { judgement, action: taken, .. } = rl.decision().unwrap();
        assert_eq!((judgement.ranking()[0], *taken), (action, action));
        assert_eq!(judgement.values(), values);
    }
}

#[test]
fn off_the_lattice_the_tool_first_goes_to_a_cell_clear_of_walls() {
    let (policy, parameters) = (wanting([0.0, 0.0, 1.0, 0.0]), Parameters::default());
    let aside = HERE + Vector2::new(0.0045, 0.0);
    let mut rl = Rl::default();
    assert!(near(step(&mut rl, &policy, aside, &parameters, |_| false), HERE), "the nearest");
    assert_eq!(rl.decision(), None, "no image is judged between two cells");
    // The nearest cell is 6 mm from a wall; the one to its left has room.
    let mut rl = Rl::default();
    let wall = |p: Point2<f64>| p.x > HERE.x + 0.006;
    let first = step(&mut rl, &policy, HERE - Vector2::new(0.002, 0.0), &parameters, wall);
    assert!(near(first, HERE - Vector2::new(0.01, 0.0)), "{first}");
}

#[test]
fn a_slow_tool_takes_several_control_steps_for_one_action() {
    let policy = wanting([1.0, 0.0, 0.0, 0.0]);
    let parameters = Parameters { transport_speed_m_s: 0.02, ..Parameters::default() };
    let mut rl = Rl::default();
    let first = step(&mut rl, &policy, HERE, &parameters, |_| false);
    assert!(near(first, HERE + Vector2::new(0.005, 0.0)));
    // Half way, the policy is not queried, although it prefers another action now.
    let second = step(&mut rl, &wanting([0.0, 1.0, 0.0, 0.0]), first, &parameters, |_| false);
    assert!(near(second, HERE + Vector2::new(0.01, 0.0)));
    let third = step(&mut rl, &wanting([0.0, 1.0, 0.0, 0.0]), second, &parameters, |_| false);
    assert!(near(third, HERE + Vector2::new(0.005, 0.0)), "back again: {third}");
}

#[test]
fn the_shield_takes_the_next_best_action_and_without_it_the_step_enters_the_wall() {
    let policy = wanting([1.0, 0.0, 0.5, 0.2]);
    let wall = |p: Point2<f64>| p.x > HERE.x + 0.0115;
    let shielded = Parameters::default();
    let mut rl = Rl::default();
    let up = step(&mut rl, &policy, HERE, &shielded, wall);
    assert!(near(up, HERE + Vector2::new(0.0, 0.01)));
    assert_eq!(rl.decision().unwrap().judgement.ranking()[0], Action::PlusX, "the best action is still reported");
    let bare = Parameters { rl_shield: false, ..Parameters::default() };
    let right = step(&mut Rl::default(), &policy, HERE, &bare, wall);
    assert!(near(right, HERE + Vector2::new(0.01, 0.0)));
}

#[test]
fn a_penalty_for_visits_ends_going_to_and_fro() {
    // Two cells whose best actions lead to each other, and a second best action that leads away.
    let (right, left) = (wanting([1.0, 0.0, 0.95, 0.0]), wanting([0.0, 1.0, 0.95, 0.0]));
    let beside = HERE + Vector2::new(0.01, 0.0);
    let targets = |parameters: &Parameters| {
        let mut rl = Rl::default();
        let there = step(&mut rl, &right, HERE, parameters, |_| false);
        assert!(near(there, beside));
        let back = step(&mut rl, &left, beside, parameters, |_| false);
        rl.start_leg();
        (back, step(&mut rl, &left, beside, parameters, |_| false))
    };
    let (second, after_a_new_leg) = targets(&Parameters::default());
    assert!(near(second, beside + Vector2::new(0.0, 0.01)), "{second}");
    assert!(near(after_a_new_leg, HERE), "a new leg begins without visits");
    let paper = Parameters { rl_visit_penalty: 0.0, ..Parameters::default() };
    assert!(near(targets(&paper).0, HERE));
}

#[test]
fn after_a_refused_step_the_next_image_is_judged_from_the_same_cell() {
    let policy = wanting([1.0, 0.0, 0.5, 0.2]);
    let bare = Parameters { rl_shield: false, ..Parameters::default() };
    let wall = |p: Point2<f64>| p.x > HERE.x + 0.006;
    let mut rl = Rl::default();
    let entered = rl.clone();
    step(&mut rl, &policy, HERE - Vector2::new(0.01, 0.0), &bare, wall);
    let kept = rl.cell;
    step(&mut rl, &policy, HERE - Vector2::new(0.01, 0.0), &bare, |p| p.x > HERE.x - 0.006);
    assert_eq!(rl.cell, kept);
    assert_ne!(rl, entered);
    for _ in 0..10 {
        step(&mut rl, &policy, HERE - Vector2::new(0.01, 0.0), &bare, |p| p.x > HERE.x - 0.006);
    }
    assert_eq!(rl.trouble(), Some(Trouble::Refused));
}

#[test]
fn without_a_policy_the_arm_holds_and_reports_the_reason() {
    let percept = Percept::of(&test_frame(HERE, |_| false), HERE);
    let known = ObstacleMap::new(WORKSPACE);
    let parameters = Parameters::default();
    let input = TransportInput {
        percept: &percept,
        known: &known,
        tool_m: HERE,
        goal_m: HERE,
        parameters: &parameters,
        policy: None,
    };
    assert!(matches!(Rl::default().next_step(&input), Err(Refusal::Policy(_))));
}

#[test]
fn a_goal_behind_observed_walls_is_walled_off_at_once_for_a_policy_with_a_memory() {
    let (policy, parameters) = (Policy::shipped("explorer").unwrap(), Parameters::default());
    let goal_m = Point2::new(0.105, -0.385);
    let percept = Percept::of(&test_frame(HERE, |_| false), HERE);
    let trouble = |gap_m: f64| {
        let is_ring = |p: Point2<f64>| (0.04..0.06).contains(&(p - goal_m).norm()) && (p.y - goal_m.y).abs() >= gap_m;
        let known = seen(WORKSPACE, 1.0, is_ring);
        let input = TransportInput {
            percept: &percept,
            known: &known,
            tool_m: HERE,
            goal_m,
            parameters: &parameters,
            policy: Some(&policy),
        };
        let mut rl = Rl::default();
        rl.next_step(&input).unwrap();
        rl.trouble()
    };
    assert_eq!(trouble(0.0), Some(Trouble::WalledOff));
    assert_eq!(trouble(0.03), None);
}
