use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::learn::environment::Episode;
use crate::learn::goals::GoalSet;
use crate::learn::terrain::tests::two_rooms;

/// A recipe whose returns are exact in binary.
fn recipe(n_step: usize) -> Recipe {
    Recipe {
        n_step,
        discount: 0.5,
        progress_reward: 0.25,
        goals: 1,
        uniform_goals: 0.0,
        future_goals: 0.0,
        lanes: 1,
        ..Recipe::default()
    }
}

fn middle_of(cell: u16) -> Goal {
    Goal { cell, offset: [0, 0] }
}

/// A goal a quarter of a centimetre below the cell's centre. From below it is reached one cell earlier, without a tie
/// at 2 cm.
fn below(cell: u16) -> Goal {
    Goal { cell, offset: [0, -64] }
}

/// A replay of one lane that visited the cells in order, and finally hit a wall if `ending` is a collision.
fn walked(terrain: &Terrain, cells: &[u16], goal: Goal, ending: Option<Ending>) -> Replay {
    let mut replay = Replay::new(100, 1, 0.5);
    let crashed = ending == Some(Ending::Collided);
    let last = cells.len() - if crashed { 1 } else { 2 };
    for (index, &cell) in cells[..=last].iter().enumerate() {
        let next = cells.get(index + 1).copied();
        let action = (0..4).find(|&action| terrain.step(cell, action) == next).expect("neighbouring cells");
        let ending = ending.filter(|_| index == last);
        replay.push(Transition { terrain: 0, cell, action: action as u8, next, goal, ending });
    }
    replay
}

/// Reward, discount and bootstrap cell of the first step's return for a goal.
fn return_of(recipe: &Recipe, replay: &Replay, goal: Goal, is_own: bool) -> (f32, f32, u16) {
    let terrains = [two_rooms()];
    let mut learner = Learner::new(recipe, &terrains, Memory::new(&recipe.architecture, 1)).unwrap();
    let path: Vec<Transition> = replay.following(0, recipe.n_step).copied().collect();
    let (reward, discount) = learner.step_return(&terrains[0], &path, goal, is_own);
    let sample = learner.sample(replay, 0);
    if is_own {
        // The sample of an update has the same values.
        assert_eq!((sample.goals[0].reward, sample.goals[0].discount), (reward, discount));
        assert_eq!(sample.goals[0].places, terrains[0].places(goal.place_m(&terrains[0]), replay.get(0).cell));
        assert_eq!(sample.goals[0].places_beyond, terrains[0].places(goal.place_m(&terrains[0]), sample.beyond.1));
    }
    (reward, discount, sample.beyond.1)
}

// In `two_rooms`, cells 0, 5, 10, 15, 20 go up the left wall, and 20 to 25 along the top to the right.

#[test]
fn a_return_within_an_episode_has_n_discounted_rewards_and_then_bootstraps() {
    let (terrain, goal) = (two_rooms(), middle_of(25));
    let replay = walked(&terrain, &[0, 5, 10, 15, 20, 21], goal, None);
    assert_eq!(return_of(&recipe(1), &replay, goal, true), (0.25, 0.5, 5));
    assert_eq!(return_of(&recipe(2), &replay, goal, true), (0.25 + 0.125, 0.25, 10));
    assert_eq!(return_of(&recipe(3), &replay, goal, true), (0.25 + 0.125 + 0.0625, 0.125, 15));
    let penalty = Recipe { step_penalty: 0.5, ..recipe(3) };
    assert_eq!(return_of(&penalty, &replay, goal, true), (-0.25 - 0.125 - 0.0625, 0.125, 15));
}

#[test]
fn a_wall_ends_the_return_for_every_goal() {
    let (terrain, goal) = (two_rooms(), middle_of(25));
    let replay = walked(&terrain, &[1, 0], goal, Some(Ending::Collided));
    for is_own in [true, false] {
        // One step away from the goal, then the wall.
        let (reward, discount, _) = return_of(&recipe(3), &replay, goal, is_own);
        assert_eq!((reward, discount), (-0.25 - 0.5, 0.0), "own {is_own}");
    }
    let (reward, discount, _) = return_of(&recipe(1), &replay, goal, true);
    assert_eq!((reward, discount), (-0.25, 0.5), "the wall is not within one step");
}

#[test]
fn a_goal_ends_only_its_own_return() {
    let (terrain, own) = (two_rooms(), below(20));
    // Cell 10 is within 2 cm of cell 20; the last cell is never left.
    let replay = walked(&terrain, &[0, 5, 10], own, Some(Ending::Reached));
    assert_eq!(return_of(&recipe(3), &replay, own, true), (0.25 + 0.5 * 1.25, 0.0, 10));
    let far = middle_of(25);
    let (reward, discount, beyond) = return_of(&recipe(3), &replay, far, false);
    assert_eq!((reward, discount, beyond), (0.25 + 0.125, 0.25, 10), "the episode ended for its own goal only");
}

#[test]
fn a_hindsight_goal_ends_the_return_midway() {
    let (terrain, own) = (two_rooms(), middle_of(25));
    let replay = walked(&terrain, &[0, 5, 10, 15, 20], own, None);
    let (reward, discount, _) = return_of(&recipe(3), &replay, below(15), false);
    assert_eq!((reward, discount), (1.25, 0.0), "reached by the first step");
    let (reward, discount, _) = return_of(&recipe(3), &replay, below(20), false);
    assert_eq!((reward, discount), (0.25 + 0.5 * 1.25, 0.0), "reached by the second");
}

#[test]
fn a_timeout_bootstraps_or_fails_depending_on_the_recipe() {
    let (terrain, own) = (two_rooms(), middle_of(25));
    let replay = walked(&terrain, &[0, 5, 10], own, Some(Ending::TimedOut));
    let rewards = 0.25 + 0.125;
    assert_eq!(return_of(&recipe(3), &replay, own, true), (rewards, 0.25, 10), "two steps: γ² and not γ³");
    let fails = Recipe { timeout_fails: true, ..recipe(3) };
    let (reward, discount, _) = return_of(&fails, &replay, own, true);
    assert_eq!((reward, discount), (rewards - 0.5, 0.0), "the failure comes with the second step");
    let other = middle_of(24);
    assert_eq!(
        return_of(&fails, &replay, other, false),
        (rewards, 0.25, 10),
        "for another goal the episode did not time out"
    );
    // With discount 0 there must be no division by 0.
    let blind = Recipe { discount: 0.0, n_step: 1, ..fails };
    let replay = walked(&terrain, &[0, 5], own, Some(Ending::TimedOut));
    let (reward, discount, _) = return_of(&blind, &replay, own, true);
    assert_eq!((reward, discount), (0.25 - 1.0, 0.0));
}

#[test]
fn a_path_that_ends_at_the_newest_step_bootstraps_from_there() {
    let (terrain, own) = (two_rooms(), middle_of(25));
    let mut replay = Replay::new(4, 1, 0.5);
    let other = walked(&terrain, &[22, 21, 20, 15, 10, 5, 0], own, None);
    // The ring has room for four: 10 → 5 and 5 → 0 have overwritten the first, and 20 → 15 is the oldest.
    (0..6).for_each(|index| replay.push(*other.get(index)));
    let cells: Vec<u16> = (0..4).map(|index| replay.get(index).cell).collect();
    assert_eq!(cells, [10, 5, 20, 15]);
    let (reward, discount, beyond) = return_of(&recipe(3), &replay, own, true);
    assert_eq!((reward, discount, beyond), (-0.25 - 0.125, 0.25, 0), "two steps are left up to the newest");
}

#[test]
fn shaped_rewards_sum_to_the_difference_of_the_distances() {
    let terrains = [two_rooms()];
    let recipe = Recipe { n_step: 20, discount: 1.0, progress_reward: 0.1, goals: 1, ..Recipe::default() };
    let learner = Learner::new(&recipe, &terrains, Memory::new(&recipe.architecture, 1)).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut reached = 0;
    for _ in 0..200 {
        let mut episode = Episode::start(&terrains, GoalSet::All, &mut rng);
        let (first, goal) = (episode.cell, episode.goal);
        let mut path = Vec::new();
        while path.len() < 20 {
            let actions: Vec<usize> =
                (0..4).filter(|&action| terrains[0].step(episode.cell, action).is_some()).collect();
            let action = actions[rng.random_range(0..actions.len())];
            let cell = episode.cell;
            let (next, ending) = episode.step(&terrains, action, &recipe);
            path.push(Transition { terrain: 0, cell, action: action as u8, next, goal, ending });
            if ending.is_some() {
                break;
            }
        }
        let is_reached = path.last().unwrap().ending == Some(Ending::Reached);
        reached += u32::from(is_reached);
        let [before, after] = [first, episode.cell].map(|cell| f32::from(terrains[0].distance(cell, goal.cell)));
        let expected = 0.1 * (before - after) + f32::from(u8::from(is_reached));
        let (reward, discount) = learner.step_return(&terrains[0], &path, goal, true);
        assert!((reward - expected).abs() < 1e-5, "{reward} {expected}");
        assert!((episode.total - expected).abs() < 1e-5, "{} {expected}", episode.total);
        assert_eq!(discount, f32::from(u8::from(!is_reached)));
    }
    assert!((20..180).contains(&reached), "both endings occur: {reached}");
}
