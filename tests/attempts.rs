//! `ferry attempts export`: Minari itself reads what it writes.

use std::path::Path;
use std::process::{Command, Output};

use ferry::boards::{Boards, Signature};
use ferry_camera::Camera;
use ferry_core::challenge::{Attempt, Challenge, Run};
use ferry_core::geometry::Point2;
use ferry_core::trial::{Case, Input, Source, Timed, Trial};
use serde_json::{Value, json};

use crate::support::{ferry, gpu, tool};

/// Ticks between two places that the hand points to.
const BEAT: u64 = 20;
const AHEAD_M: f64 = 0.02;

/// The place on the shortest path to the goal that is a little ahead of the tool.
fn ahead(challenge: &Challenge, trial: &Trial) -> Point2<f64> {
    let goal = challenge.scenario.goal_m.unwrap();
    let path = challenge.arena.space.taut_path(trial.tool_m().xy(), goal).unwrap();
    let mut left_m = AHEAD_M;
    for pair in path.windows(2) {
        let leg = pair[1] - pair[0];
        if leg.norm() > left_m {
            return pair[0] + leg.normalize() * left_m;
        }
        left_m -= leg.norm();
    }
    goal
}

/// An attempt by a hand that knows the path.
fn attempt(challenge: &Challenge, camera: &mut Camera) -> (Attempt, Run) {
    let mut trial = Trial::new(challenge.scenario.clone(), challenge.arena.clone()).unwrap();
    let mut inputs = Vec::new();
    while trial.state().world.counters.deliveries == 0 {
        let tick = trial.state().world.tick;
        assert!(tick < 7500, "{} is not delivered", challenge.name);
        if tick.is_multiple_of(BEAT) {
            let place = ahead(challenge, &trial);
            let input = Input::Steer { x_m: place.x, y_m: place.y, approach: false };
            trial.apply(input.clone()).unwrap();
            inputs.push(Timed { tick, input });
        }
        trial.tick(Source::Camera(camera)).unwrap();
    }
    let run = challenge.run(&inputs, camera).unwrap();
    let log = Case { about: String::new(), scenario: challenge.scenario.clone(), map: None, inputs, expect: None };
    (Attempt { log, score: run.score, world_hash: run.world_hash.clone() }, run)
}

/// Puts an attempt at a challenge on its board, and returns it.
fn keep(data: &Path, name: &str, player: &str, class: Option<&str>, forge: &dyn Fn(&mut Attempt)) -> Attempt {
    let challenge = Challenge::of(name.parse().unwrap()).unwrap();
    let mut camera = Camera::of(&gpu(), challenge.arena.static_scene()).unwrap();
    let (mut attempt, run) = attempt(&challenge, &mut camera);
    forge(&mut attempt);
    let at = String::from("2026-11-26T12:00:00Z");
    let signature = Signature { player: player.into(), class: class.map(str::to_owned), at };
    let boards = Boards::in_folder(data.join("challenges"));
    assert!(boards.add(&challenge.name, signature, &attempt, run).unwrap());
    attempt
}

fn export(data: &Path, out: &Path, challenges: &[&str]) -> Output {
    ferry(&["attempts", "export"]).args(challenges).arg("--data").arg(data).arg("--out").arg(out).output().unwrap()
}

fn failure(output: Output) -> String {
    assert!(!output.status.success() && output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What Minari finds in a folder of data sets.
fn load(out: &Path) -> Value {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_attempts.py");
    let read = Command::new(tool("python")).args(["-W", "ignore", script]).arg(out).output().unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    serde_json::from_slice(&read.stdout).unwrap()
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

#[test]
fn minari_loads_the_attempts_that_agree_with_their_score() {
    let folder = tempfile::tempdir().unwrap();
    let (data, out) = (folder.path().join("data"), folder.path().join("sets"));
    let ada = keep(&data, "easy-a", "Ada", Some("7b"), &|_| ());
    let bo = keep(&data, "hard-a", "Bo", None, &|_| ());
    // As after a change of a controller: the log gives something else now.
    keep(&data, "easy-b", "Eve", None, &|attempt| attempt.score.walls += 1);

    let exported = export(&data, &out, &[]);
    let (told, warned) = (String::from_utf8_lossy(&exported.stdout), String::from_utf8_lossy(&exported.stderr));
    assert!(exported.status.success(), "{warned}");
    assert!(warned.contains("the attempt of \"Eve\" at easy-b is left out: score.walls is 1"), "{warned}");
    assert!(told.contains("ferry/attempts-v0, 2 attempts") && told.contains("1 left out"), "{told}");

    let loaded = load(&out);
    assert_eq!((&loaded["total_episodes"], &loaded["algorithm"]), (&json!(2), &json!("human")));
    assert_eq!(loaded["listed"], json!(["ferry/attempts-v0"]));
    assert_eq!(loaded["steered"], 2);
    let total = loaded["total_steps"].as_u64().unwrap();
    assert_eq!(loaded["combined_steps"], 2 * total);
    let mut sum = 0;
    for (episode, (name, player, class, attempt)) in loaded["episodes"]
        .as_array()
        .unwrap()
        .iter()
        .zip([("easy-a", "Ada", json!("7b"), &ada), ("hard-a", "Bo", Value::Null, &bo)])
    {
        let about = &episode["about"];
        assert_eq!((&about["challenge"], &about["player"], &about["class"]), (&json!(name), &json!(player), &class));
        assert_eq!(
            (&about["seed"], &about["delivery_tick"]),
            (&json!(attempt.log.scenario.seed), &json!(attempt.score.tick))
        );
        assert!((about["score_s"].as_f64().unwrap() - attempt.score.total_s()).abs() < 1e-9);

        let steps = about["total_steps"].as_u64().unwrap();
        sum += steps;
        // Four per second, and one at the start.
        let expected = (attempt.score.tick as f64 * 0.008 * 4.0).ceil();
        assert!((steps as f64 - expected).abs() <= 1.0, "{steps} steps in {} ticks", attempt.score.tick);
        let column = |shape: &[u64], dtype: &str| json!({"shape": shape, "dtype": dtype});
        assert_eq!(
            episode["columns"],
            json!({
                "observations.goal_m": column(&[steps + 1, 2], "float32"),
                "observations.observation": column(&[steps + 1, 2, 84, 84], "uint8"),
                "observations.tool_m": column(&[steps + 1, 2], "float32"),
                "infos.tick": column(&[steps + 1], "int64"),
                "infos.sub_controller": column(&[steps + 1], "int64"),
                "infos.steers": column(&[steps + 1], "bool"),
                "infos.bead_m": column(&[steps + 1, 2], "float64"),
                "actions": column(&[steps, 2], "float32"),
                "rewards": column(&[steps], "float64"),
                "terminations": column(&[steps], "bool"),
                "truncations": column(&[steps], "bool"),
            })
        );
        assert_eq!((&episode["in_spaces"], &episode["truncated"]), (&json!(true), &json!(false)));
        let rewards = numbers(&episode["rewards"]);
        assert_eq!((rewards.last(), rewards.iter().sum::<f64>()), (Some(&1.0), 1.0));
        let ends: Vec<bool> = serde_json::from_value(episode["terminations"].clone()).unwrap();
        assert!(ends.iter().rev().skip(1).all(|end| !end) && ends.last() == Some(&true));
        // The tool has moved, and the camera with it.
        assert!(episode["images"].as_u64().unwrap() > steps / 3, "{} images", episode["images"]);
        assert_eq!(episode["goals"], 1);

        let goal = attempt.log.scenario.goal_m.unwrap();
        let last = |name: &str| numbers(episode[name].as_array().unwrap().last().unwrap());
        let away_m = |place: Vec<f64>| (place[0] - goal.x).hypot(place[1] - goal.y);
        assert!(away_m(last("goal_m")) < 1e-6);
        assert!(away_m(last("bead_m")) < 0.02);
        let ticks = numbers(&episode["tick"]);
        assert_eq!((ticks[0], ticks.last().copied()), (0.0, Some(attempt.score.tick as f64)));
        let first = &attempt.log.inputs[0].input;
        let (&Input::Steer { x_m, y_m, .. }, tool_m) = (first, numbers(&episode["tool_m"][0])) else { panic!() };
        let action = numbers(&episode["actions"][0]);
        assert!((tool_m[0] + action[0] - x_m).hypot(tool_m[1] + action[1] - y_m) < 1e-6);
        // Here the hand does not steer the fetch.
        let steers: Vec<bool> = serde_json::from_value(episode["steers"].clone()).unwrap();
        let modes = numbers(&episode["sub_controller"]);
        assert!(steers.iter().zip(&modes).all(|(steers, mode)| !steers || *mode == 2.0));
        assert!(steers.iter().filter(|steers| **steers).count() as u64 > steps / 2);
    }
    assert_eq!(sum, total);
}

#[test]
fn wrong_arguments_are_named_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (data, out) = (folder.path().join("data"), folder.path().join("sets"));
    std::fs::create_dir_all(data.join("challenges/easy-empty")).unwrap();
    for (challenges, parts) in [
        (&["easter-1"][..], &["[CHALLENGE]", "\"easter-1\" is not a challenge"][..]),
        (&["easy-c"], &["CHALLENGE: ", "has no attempts at easy-c"]),
        (&[], &["--data: there are no attempts in", "challenges"]),
    ] {
        let error = failure(export(&data, &out, challenges));
        assert!(parts.iter().all(|part| error.contains(part)), "{error}");
    }
    keep(&data, "easy-a", "Ada", None, &|attempt| attempt.world_hash = format!("{:016x}", 1));
    let error = failure(export(&data, &out, &[]));
    assert!(error.contains("nothing is exported"), "{error}");
    assert!(!out.exists());
    let error = failure(export(&data, &data, &["easy-a"]));
    assert!(error.contains("--out: ") && error.contains("exists already"), "{error}");
    assert!(data.join("challenges/easy-a").is_dir());
}
