//! Loaders against files that were damaged, or made to do damage: the answer is a value or an error, within a second.
//! `make fuzz` runs for longer and is guided by coverage.

mod drawing;
mod mutate;
mod seeds;
mod targets;

use std::time::Duration;

use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

use targets::Target;

/// The longest that one input may take.
const MOST: Duration = Duration::from_secs(1);

/// Changed files a target; `FUZZ_COUNT` makes them more.
fn count(default: usize) -> usize {
    std::env::var("FUZZ_COUNT").map_or(default, |count| count.parse().expect("FUZZ_COUNT is a count"))
}

/// Time of the processor that this thread has used: other tests do not count.
fn spent() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    Duration::from_nanos(text.split(' ').next().and_then(|ns| ns.parse().ok()).unwrap_or_default())
}

fn survives(target: Target, default: usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for seed in target.seeds() {
        assert!(target.reads(seed), "{}: a seed is refused: {}", target.name(), String::from_utf8_lossy(seed));
    }
    let (mut accepted, mut refused) = (0, 0);
    for number in 0..count(default) {
        let seed = target.seeds().choose(&mut rng).expect("a target has seeds");
        let bytes = mutate::mutated(target, seed, &mut rng);
        let path = std::env::temp_dir().join(format!("ferry-fuzz-{}-{}", target.name(), std::process::id()));
        // A process that dies, for example of its stack, writes no report.
        std::fs::write(&path, &bytes).unwrap();
        let before = spent();
        let is_read = target.reads(&bytes);
        let took = spent() - before;
        assert!(took < MOST, "{}: input {number}, kept in {path:?}, took {took:?}", target.name());
        *(if is_read { &mut accepted } else { &mut refused }) += 1;
        std::fs::remove_file(&path).unwrap();
    }
    // Changes that are never accepted, or always, try nothing. Most drawings that bytes choose are good.
    let may = |one: Target| target == one;
    assert!(
        (refused > 0 || may(Target::Drawing)) && (accepted > 0 || may(Target::Log)),
        "{accepted} accepted, {refused} refused"
    );
}

#[test]
fn messages() {
    survives(Target::Message, 20_000);
}

#[test]
fn maps() {
    survives(Target::Map, 400);
}

#[test]
fn walls_are_where_usvg_draws() {
    survives(Target::Drawing, 2000);
}

#[test]
fn cases() {
    survives(Target::Case, 100);
}

#[test]
fn logs() {
    survives(Target::Log, 200);
    survives(Target::Entries, 200);
}

#[test]
fn conversations_with_the_robot_server() {
    survives(Target::Rtde, 20_000);
}

#[test]
fn reports_of_a_robot() {
    survives(Target::Reports, 20_000);
}

#[test]
fn programs_for_the_robot_are_refused_or_carried_out_within_the_limits() {
    survives(Target::Script, 20_000);
}

#[test]
fn lines_for_the_dashboard_are_answered() {
    survives(Target::Dashboard, 20_000);
}

#[test]
fn policies() {
    survives(Target::Policy, 200);
}
