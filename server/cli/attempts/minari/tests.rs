use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int64Type, UInt8Type};
use arrow_ipc::reader::FileReader;

use super::super::episode::Step;
use super::*;
use crate::boards::{Kept, Signature};
use ferry_core::challenge::{Attempt, Challenge, Score, Trace};
use ferry_core::geometry::{Point2, Vector2};
use ferry_core::trial::Case;

const PIXELS: usize = 2 * 84 * 84;

fn view(tick: u64) -> View {
    View {
        tick,
        observation: vec![tick as u8; PIXELS],
        tool_m: Point2::new(0.25, -0.5),
        goal_m: Point2::new(0.125, -0.25),
        bead_m: Point2::new(0.1, tick as f64),
    }
}

fn episode(ticks: &[u64]) -> Episode {
    let challenge = Challenge::of("easy-a".parse().unwrap()).unwrap();
    let log =
        Case { about: String::new(), scenario: challenge.scenario.clone(), map: None, inputs: vec![], expect: None };
    let score = Score { tick: 100, walls: 1, lost_beads: 2 };
    let signature = Signature { player: "Ada".into(), class: None, at: "2026-11-26T12:00:00Z".into() };
    let kept = Kept { signature, attempt: Attempt { log, score, world_hash: "00".into() }, trace: Trace::default() };
    let step = |&tick: &u64| Step {
        view: view(tick),
        hand_m: Vector2::new(0.5, -0.125),
        sub_controller: if tick == 0 { 1 } else { 2 },
        steers: tick > 0,
    };
    Episode { challenge, kept, steps: ticks.iter().map(step).collect(), last: view(100) }
}

fn read(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("metadata.json")).unwrap()).unwrap()
}

#[test]
fn an_episode_has_a_row_per_step_and_one_for_the_delivery() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("new/sets");
    let mut data_set = DataSet::create(&root).unwrap();
    data_set.add(&episode(&[0, 32, 63])).unwrap();
    data_set.add(&episode(&[0])).unwrap();
    let data = root.join("ferry/attempts-v0/data");
    assert!(!data.join("metadata.json").exists(), "it is not complete yet");
    data_set.finish().unwrap();
    assert_eq!((data_set.episodes(), data_set.steps()), (2, 4));

    let mut batches = FileReader::try_new(File::open(data.join("0/part-0.arrow")).unwrap(), None).unwrap();
    let rows = batches.next().unwrap().unwrap();
    assert!(batches.next().is_none(), "Minari takes each batch for an episode");
    let names: Vec<&str> = rows.schema_ref().fields().iter().map(|field| field.name().as_str()).collect();
    assert_eq!(names, ["observations", "actions", "rewards", "terminations", "truncations", "infos"]);
    let column = |name: &str| rows.column_by_name(name).unwrap().clone();
    assert_eq!(rows.num_rows(), 4);
    assert_eq!(column("rewards").as_primitive::<Float64Type>().values(), &[0.0, 0.0, 1.0, 0.0]);
    assert_eq!(column("terminations").as_boolean(), &BooleanArray::from(vec![false, false, true, false]));
    assert_eq!(column("truncations").as_boolean().true_count(), 0);
    let actions = column("actions");
    let actions = actions.as_fixed_size_list().values().as_primitive::<Float32Type>();
    assert_eq!(actions.values(), &[0.5, -0.125, 0.5, -0.125, 0.5, -0.125, 0.0, 0.0]);

    let observations = column("observations");
    let pixels = observations.as_struct().column_by_name("observation").unwrap().as_fixed_size_list().clone();
    assert_eq!(pixels.value_length() as usize, PIXELS);
    let firsts = (0..4).map(|row| pixels.value(row).as_primitive::<UInt8Type>().value(PIXELS - 1));
    assert_eq!(firsts.collect::<Vec<_>>(), [0, 32, 63, 100]);
    let tools = observations.as_struct().column_by_name("tool_m").unwrap().as_fixed_size_list().clone();
    assert_eq!(tools.value(3).as_primitive::<Float32Type>().values(), &[0.25, -0.5]);

    let infos = column("infos");
    let info = |name: &str| infos.as_struct().column_by_name(name).unwrap().clone();
    assert_eq!(info("tick").as_primitive::<Int64Type>().values(), &[0, 32, 63, 100]);
    assert_eq!(info("sub_controller").as_primitive::<Int64Type>().values(), &[1, 2, 2, 2]);
    assert_eq!(info("steers").as_boolean(), &BooleanArray::from(vec![false, true, true, false]));
    assert_eq!(info("bead_m").as_fixed_size_list().value(1).as_primitive::<Float64Type>().values(), &[0.1, 32.0]);
}

#[test]
fn the_metadata_counts_and_describes() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("sets");
    let mut data_set = DataSet::create(&root).unwrap();
    data_set.add(&episode(&[0, 32])).unwrap();
    data_set.finish().unwrap();
    let data = root.join(DATA_SET).join("data");
    let about = read(&data);
    assert_eq!((&about["dataset_id"], &about["algorithm_name"]), (&json!("ferry/attempts-v0"), &json!("human")));
    assert_eq!((&about["total_episodes"], &about["total_steps"]), (&json!(1), &json!(2)));
    let space: Value = serde_json::from_str(about["observation_space"].as_str().unwrap()).unwrap();
    assert_eq!(space["subspaces"]["observation"]["shape"], json!([2, 84, 84]));
    assert_eq!(space["subspaces"]["observation"]["high"][1][83][83], json!(255));
    let episode = read(&data.join("0"));
    assert_eq!((&episode["id"], &episode["total_steps"], &episode["player"]), (&json!(0), &json!(2), &json!("Ada")));
    assert_eq!((&episode["challenge"], &episode["class"]), (&json!("easy-a"), &Value::Null));
    assert_eq!(episode["score_s"].as_f64().map(|score_s| (score_s * 1e3).round()), Some(11_800.0));
}

#[test]
fn an_existing_folder_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(DataSet::create(folder.path()), Err(WriteError::Io(_))));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn places_and_distances_on_the_maps_of_challenges_are_within_the_spaces() {
    for difficulty in ferry_core::challenge::Difficulty::ALL {
        let challenge = Challenge::of(format!("{}-a", difficulty.as_str()).parse().unwrap()).unwrap();
        let workspace = challenge.arena.map.workspace();
        let size_m = workspace.size_m();
        let corners_m = [workspace.x_min_m, workspace.x_max_m, workspace.y_min_m, workspace.y_max_m];
        assert!(corners_m.into_iter().chain([size_m.x, size_m.y]).all(|value_m| value_m.abs() < 0.9 * MOST_M));
    }
}
