//! The trained policies, and training from the command line.

use std::sync::atomic::AtomicBool;

use ferry_camera::Camera;
use ferry_core::map::Map;
use ferry_core::perception::{Observation, Percept};
use ferry_core::policy::Policy;
use ferry_core::scenario::{ControllerName, Parameters, RlPolicy, Scenario};
use ferry_core::trial::{Arena, Trial};
use ferry_files::open;
use ferry_lab::evaluate::{Cell, Experiment, Manner, Venue, Watch, run, unrecorded};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{ferry, gpu};

#[test]
fn every_shipped_policy_is_complete_and_has_a_manifest() {
    assert_eq!(Policy::shipped_names(), ["colon", "explorer", "general"]);
    for name in Policy::shipped_names() {
        let policy = Policy::shipped(&name).unwrap();
        let manifest = policy.manifest();
        assert_eq!((manifest.step_m, manifest.clearance_m), (0.01, 0.008), "{name}");
        assert!(manifest.updates > 0 && !manifest.revision.is_empty(), "{name}: {manifest:?}");
        assert_eq!(manifest.maps == ["colon"], name == "colon");
    }
    let error = Policy::shipped("rectum").unwrap_err().to_string();
    assert_eq!(error, "policy: there is no policy named \"rectum\"; there are colon, explorer, general");
}

#[test]
fn auto_takes_the_policy_of_the_drawing_not_of_the_name() {
    let drawn = |name: &str, like: &str| Arena::of(Map::from_svg(name, Map::shipped(like).unwrap().svg()).unwrap());
    let auto = |arena: std::sync::Arc<Arena>| arena.policy(&RlPolicy::Auto).unwrap().hash();
    let shipped = |name: &str| Policy::shipped(name).unwrap().hash();
    assert_eq!(auto(drawn("mine", "colon")), shipped("colon"));
    assert_eq!(auto(drawn("colon", "posts")), shipped("general"));
    assert_eq!(auto(drawn("colon", "colon-folds")), shipped("explorer"));
}

/// Expects deliveries through the colon with the policy, from camera images.
fn expect_deliveries(least: usize, episodes: u32, disturbances: u32) {
    let experiment = Experiment {
        cell: Cell {
            controller: ControllerName::Rl,
            map: "colon".to_owned(),
            disturbances,
            program: None,
            varied: Vec::new(),
        },
        venue: Venue::of(Arena::shipped("colon").unwrap()),
        map: "colon".to_owned(),
        episodes,
        seed: 7,
        parameters: Parameters::default(),
        manner: Manner::default(),
        program: None,
    };
    let watch = Watch { stop: &AtomicBool::new(false), progress: &|_, _| (), recorders: &unrecorded };
    let ended = run(&[experiment], &gpu(), &watch).unwrap().remove(0);
    let delivered = ended.iter().filter(|episode| episode.delivered).count();
    assert!(delivered >= least, "{delivered} of {episodes} with {disturbances} disturbances");
    let struck: u32 = ended.iter().map(|episode| episode.disturbances).sum();
    assert!(struck >= disturbances * episodes * 7 / 8, "{struck}");
}

#[test]
fn the_policy_carries_the_bead_through_the_colon_despite_disturbances() {
    expect_deliveries(7, 8, 3);
}

#[test]
#[ignore = "long"]
fn the_policy_carries_the_bead_through_the_colon_from_camera_images() {
    expect_deliveries(39, 40, 0);
    expect_deliveries(38, 40, 3);
}

/// Training's images have no bead.
#[test]
#[ignore = "long"]
fn the_bead_in_the_picture_changes_few_decisions() {
    const PLACES: usize = 300;
    for (map, name) in [("colon", "colon"), ("posts", "general")] {
        let (arena, policy) = (Arena::shipped(map).unwrap(), Policy::shipped(name).unwrap());
        let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
        let mut rng = ChaCha8Rng::seed_from_u64(8);
        let mut alike = 0;
        for _ in 0..PLACES {
            let mut place = || arena.space.sample(&arena.map, None, &mut rng).unwrap();
            let (tool_m, goal_m) = (place(), place());
            let scenario = Scenario { start_m: Some(tool_m), ..Scenario::idle(map, 1) };
            let mut subject = Trial::new(scenario, arena.clone()).unwrap().subject();
            // As far behind the tool as in transport, or out of the picture.
            let [x_m, y_m, z_m] = subject.bead_m;
            let angle_rad = rng.random_range(0.0..std::f64::consts::TAU);
            let trailing_m = [x_m + 0.014 * angle_rad.cos(), y_m + 0.014 * angle_rad.sin(), z_m];
            let actions = [trailing_m, [9.0, 9.0, z_m]].map(|bead_m| {
                subject.bead_m = bead_m;
                let percept = Percept::of(&camera.capture(&subject).unwrap(), tool_m);
                let seen = Observation::new(&percept.gray, Some(goal_m), tool_m, arena.map.workspace());
                policy.judge(&seen).unwrap().ranking()[0]
            });
            alike += usize::from(actions[0] == actions[1]);
        }
        println!("{map}: the bead changes {} of {PLACES} decisions", PLACES - alike);
        assert!(alike * 100 >= PLACES * 99, "{map}: {alike} of {PLACES}");
    }
}

fn run_in(arguments: &[&str], folder: &std::path::Path) -> std::process::Output {
    ferry(arguments).current_dir(folder).output().unwrap()
}

/// A room small enough to be learned in seconds.
const ROOM: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 250 200 100">
    <rect x="-10" y="250" width="20" height="60"/></svg>"#;

#[test]
#[ignore = "long"]
fn training_writes_a_working_policy_and_can_be_resumed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("room.svg"), ROOM).unwrap();
    let train = |out: &str, more: &[&str]| {
        let arguments = ["train", "--map", "room.svg", "--episodes", "200", "--set", "warm_up=500", "--out", out];
        let said = run_in(&[&arguments, more].concat(), folder.path());
        assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
        String::from_utf8(said.stdout).unwrap()
    };
    let said = train("room.safetensors", &["--set", "updates=300", "--set", "images=16"]);
    // Each of the 200 examined episodes has one of three results; other tests check how well it learns.
    let examined = said.split("room: ").nth(1).unwrap().lines().next().unwrap();
    let counts = [" collided", " out of steps"].map(|end| {
        let before = examined.split(end).next().unwrap();
        before.rsplit(' ').next().unwrap().parse::<u32>().unwrap()
    });
    let reached: u32 = examined.split('/').next().unwrap().parse().unwrap();
    assert_eq!(reached + counts[0] + counts[1], 200, "{said}");
    let policy = open::policy(&folder.path().join("room.safetensors")).unwrap();
    assert_eq!((policy.manifest().updates, policy.manifest().seed), (300, 1));
    for ending in ["curve.csv", "curve.svg", "checkpoint"] {
        assert!(folder.path().join("room").with_extension(ending).exists(), "{ending}");
    }
    // Resuming a finished run makes no further update and gives the same result.
    let bytes = std::fs::read(folder.path().join("room.safetensors")).unwrap();
    train("room.safetensors", &["--resume", "--set", "updates=300", "--set", "images=16"]);
    assert_eq!(std::fs::read(folder.path().join("room.safetensors")).unwrap(), bytes);
    // A run of another recipe cannot be resumed.
    let refused = run_in(&["train", "--map", "room.svg", "--out", "room.safetensors", "--resume"], folder.path());
    let said = String::from_utf8(refused.stderr).unwrap();
    assert!(!refused.status.success() && said.contains("another recipe"), "{said}");
    // The policy acts in a trial on the map that it was trained on.
    let arguments = ["evaluate", "--map", "room.svg", "--controller", "rl", "--policy", "room.safetensors", "--json"];
    let live = run_in(&[&arguments[..], &["--episodes", "4"]].concat(), folder.path());
    let table: serde_json::Value = serde_json::from_slice(&live.stdout).unwrap();
    assert_eq!(table["rows"][0]["controller"], "rl");
    assert_eq!(table["rows"][0]["episodes"], 4);
}

#[test]
fn a_bad_recipe_or_policy_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("torn.safetensors"), b"torn").unwrap();
    let last = |arguments: &[&str]| {
        let said = run_in(arguments, folder.path());
        assert!(!said.status.success());
        String::from_utf8(said.stderr).unwrap().lines().last().unwrap_or_default().to_owned()
    };
    assert!(last(&["train", "--set", "discount=2"]).contains("discount is 2"));
    assert!(last(&["train", "--set", "architecture.duelling=false"]).contains("duelling"));
    assert!(last(&["train", "--set", "nothing"]).contains("NAME=VALUE"));
    assert!(last(&["train", "--map", "rectum"]).contains("rectum"));
    let torn = last(&["evaluate", "--controller", "rl", "--policy", "torn.safetensors"]);
    assert!(torn.contains("not a safetensors file"), "{torn}");
}
