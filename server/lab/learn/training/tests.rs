use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::learn::examine::examine_by;
use crate::learn::terrain::tests::two_rooms;
use ferry_core::policy::Architecture;

/// A recipe whose runs take about a second.
fn shrunk(recipe: Recipe) -> Recipe {
    Recipe {
        images: 8,
        goals: recipe.goals.min(4),
        lanes: 8,
        warm_up: 64,
        capacity: 500,
        target_period: 30,
        updates: 2 * WINDOW,
        ..recipe
    }
}

fn on_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(task)
}

fn resuming_changes_nothing(recipe: &Recipe) {
    let terrains = [two_rooms()];
    let whole = on_threads(1, || {
        let mut state = State::new(recipe.clone(), 3, &terrains).unwrap();
        state.advance(&terrains, &|| true, &mut |_| true).unwrap();
        state
    });
    assert!(whole.is_done() && whole.curve.len() == 2 && whole.episodes > 0);
    assert_eq!(whole.replay.len(), (whole.steps as usize).min(496), "whole steps of eight lanes");

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.checkpoint");
    let resumed = on_threads(2, || {
        let mut state = State::new(recipe.clone(), 3, &terrains).unwrap();
        // Before the first update, and between two points of the curve.
        for steps in [3, 20] {
            let left = std::cell::Cell::new(steps);
            let goes_on = || left.replace(left.get() - 1) > 0;
            state.advance(&terrains, &goes_on, &mut |_| unreachable!("no point has ended")).unwrap();
            state.write(&path, 1.0).unwrap();
            state = State::read(&path, recipe, 3, &terrains).unwrap().0;
        }
        assert!(state.memory.updates > 0);
        state.advance(&terrains, &|| true, &mut |_| false).unwrap();
        assert_eq!((state.memory.updates, state.is_done()), (WINDOW, false));
        state.write(&path, 12.5).unwrap();
        let (mut read, spent_s) = State::read(&path, recipe, 3, &terrains).unwrap();
        assert!(read == state && spent_s == 12.5);
        read.advance(&terrains, &|| true, &mut |_| true).unwrap();
        read
    });
    // Numbers that print the same may differ, so the values are compared, not the texts.
    assert_eq!(resumed.curve, whole.curve);
    assert!(resumed == whole);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no partial file is left");
}

#[test]
fn a_resumed_run_on_other_threads_equals_the_uninterrupted_one_bit_by_bit() {
    resuming_changes_nothing(&shrunk(Recipe::default()));
}

#[test]
fn a_resumed_run_of_the_papers_recipe_equals_the_uninterrupted_one() {
    resuming_changes_nothing(&shrunk(Recipe::paper()));
}

#[test]
fn another_seed_gives_a_different_run() {
    let terrains = [two_rooms()];
    let first = |seed| State::new(shrunk(Recipe::default()), seed, &terrains).unwrap();
    assert!(first(1) == first(1));
    assert_ne!(first(1).memory.online, first(2).memory.online);
    assert_ne!(first(1).lanes, first(2).lanes);
}

#[test]
fn a_checkpoint_that_does_not_fit_is_refused_with_the_reason() {
    let terrains = [two_rooms()];
    let recipe = shrunk(Recipe::default());
    let state = State::new(recipe.clone(), 3, &terrains).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.checkpoint");
    let refusal = |recipe: &Recipe, seed, terrains: &[Terrain]| {
        let error = State::read(&path, recipe, seed, terrains).unwrap_err();
        let text = error.to_string();
        assert!(text.contains("run.checkpoint"), "{text}");
        text
    };
    assert!(
        matches!(State::read(&path, &recipe, 3, &terrains), Err(TrainingError::Checkpoint(CheckpointError::Io { .. }))),
        "no file exists yet"
    );

    state.write(&path, 0.0).unwrap();
    assert!(State::read(&path, &recipe, 3, &terrains).is_ok());
    assert!(refusal(&recipe, 4, &terrains).contains("its seed is 3, not 4"));
    let architecture = Architecture { dueling: false, ..recipe.architecture };
    let other = Recipe { n_step: 2, updates: 9_999, architecture, ..recipe.clone() };
    let text = refusal(&other, 3, &terrains);
    let updates = format!("updates is {} there and 9999 now", recipe.updates);
    let all =
        ["it has another recipe: ", "n_step is 1 there and 2 now", "architecture.dueling is true there and false now"];
    assert!(all.iter().chain([&updates.as_str()]).all(|part| text.contains(part)), "{text}");
    assert_eq!(text.matches(" there and ").count(), 3, "{text}");
    let two = [two_rooms(), two_rooms()];
    assert!(refusal(&recipe, 3, &two).contains(r#"its maps are [("rooms", 26)]"#));

    let whole = std::fs::read(&path).unwrap();
    for length in [0, 7, 8, 100, whole.len() / 2, whole.len() - 1] {
        std::fs::write(&path, &whole[..length]).unwrap();
        assert!(refusal(&recipe, 3, &terrains).contains("damaged"), "{length} bytes");
    }
    for at in [0, 8, 20, whole.len() / 2, whole.len() - 1] {
        let mut edited = whole.clone();
        edited[at] ^= 1;
        std::fs::write(&path, &edited).unwrap();
        assert!(refusal(&recipe, 3, &terrains).contains("damaged or edited"), "byte {at}");
    }

    // A file of another version is intact but refused.
    let bytes = postcard::to_stdvec(&(VERSION + 1, 0.0, &state)).unwrap();
    let hash = xxhash_rust::xxh3::xxh3_64(&bytes).to_le_bytes();
    std::fs::write(&path, [&hash[..], &bytes].concat()).unwrap();
    assert!(refusal(&recipe, 3, &terrains).contains(&format!("its version is {}, expected {VERSION}", VERSION + 1)));
}

#[test]
fn refuses_a_recipe_out_of_range() {
    let bad = Recipe { images: 0, ..Recipe::default() };
    let error = State::new(bad, 1, &[two_rooms()]).unwrap_err();
    assert!(error.to_string().contains("images is 0"), "{error}");
}

/// Episodes of an examination in this test.
const EPISODES: u32 = 300;

#[test]
#[ignore = "long"]
fn a_small_run_learns_the_path_between_two_rooms() {
    let terrains = [two_rooms()];
    // Frequent rewards: learning from distant ones needs thousands of updates.
    let recipe = Recipe {
        images: 6,
        goals: 16,
        warm_up: 200,
        capacity: 5000,
        target_period: 25,
        averaging: 0.98,
        discount: 0.5,
        progress_reward: 0.5,
        exploration: 0.3,
        fractions: 4,
        choosing_fractions: 4,
        learning_rate: 3e-3,
        updates: 600,
        ..shrunk(Recipe::default())
    };
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut act_randomly =
        |cells: &[(u8, u16)], _: &[[f32; 4]]| Ok(cells.iter().map(|_| rng.random_range(0..4)).collect::<Vec<u32>>());
    let random = examine_by(&recipe, &terrains, GoalSet::All, EPISODES, 9, &mut act_randomly).unwrap();
    for seed in [2, 3] {
        let mut state = State::new(recipe.clone(), seed, &terrains).unwrap();
        let untrained = state.examine(&terrains, GoalSet::All, EPISODES, 9).unwrap();
        state.advance(&terrains, &|| true, &mut |_| true).unwrap();
        let trained = state.examine(&terrains, GoalSet::All, EPISODES, 9).unwrap();
        let ended = trained.reached + trained.collided + trained.timed_out;
        assert!(trained.all_pairs && trained.episodes == ended && ended > 400, "{trained:?}");
        // Of six seeds the worst reached 77 %, these two 99 % and more; random steps reach 15 %. Other processors
        // round differently, and runs this short can differ because of it.
        assert!(trained.success() > 0.6 && random.success() < 0.25, "{trained:?} {random:?}");
        assert!(untrained.success() < 0.25, "{untrained:?}");
        assert!(trained.steps <= trained.least_steps, "{trained:?}: goals end 2 cm before their cells");
    }
}
