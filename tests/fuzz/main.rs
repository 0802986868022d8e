//! Coverage-guided fuzzing with LLVM's libFuzzer: `make fuzz`. `FUZZ_TARGET` names the target, `FUZZ_SEEDS` the folder
//! that its seeds are written to.

#![no_main]

#[path = "drawing.rs"]
mod drawing;
#[path = "mutate.rs"]
mod mutate;
#[path = "seeds.rs"]
mod seeds;
#[path = "targets.rs"]
mod targets;

use std::path::Path;
use std::sync::LazyLock;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use targets::Target;

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("FUZZ_TARGET").expect("FUZZ_TARGET names a target");
    let found = Target::ALL.into_iter().find(|target| target.name() == name);
    found.unwrap_or_else(|| panic!("FUZZ_TARGET {name:?}: there are {:?}", Target::ALL.map(Target::name)))
});

fuzz_target!(
    init: {
        if let Ok(folder) = std::env::var("FUZZ_SEEDS") {
            std::fs::create_dir_all(&folder).expect("FUZZ_SEEDS is a folder");
            for (number, seed) in TARGET.seeds().iter().enumerate() {
                std::fs::write(Path::new(&folder).join(format!("seed-{number}")), seed).expect("seeds can be written");
            }
        }
    },
    |bytes: &[u8]| {
        TARGET.reads(bytes);
    }
);

// Half of the changes keep the form, the others are libFuzzer's own, which learn from comparisons.
fuzz_mutator!(|bytes: &mut [u8], size: usize, most: usize, seed: u32| {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.into());
    if rng.random() {
        return fuzzer_mutate(bytes, size, most);
    }
    let changed = mutate::mutated(*TARGET, &bytes[..size], &mut rng);
    let size = changed.len().min(most);
    bytes[..size].copy_from_slice(&changed[..size]);
    size
});
