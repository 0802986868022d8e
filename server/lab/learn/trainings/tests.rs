use std::path::Path;
use std::time::{Duration, Instant};

use super::*;
use crate::learn::recipe::RecipeName;
use crate::learn::settings::Settings;
use ferry_camera::{AdapterChoice, Gpu};
use ferry_core::policy;
use ferry_core::scenario::RlPolicy;

/// What a server has.
struct Laboratory {
    queue: Arc<Queue>,
    policies: Arc<Library>,
    trainings: Trainings,
}

impl Laboratory {
    fn in_folder(folder: &Path) -> Self {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        let queue = Arc::new(Queue::start(&gpu).unwrap());
        let policies = Arc::new(Library::in_folder(folder.join("policies")));
        let sweeps = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("target/test-output/sweeps");
        let trainings =
            Trainings::in_folder(folder.join("trainings"), sweeps, queue.clone(), Arc::default(), policies.clone());
        Self { queue, policies, trainings }
    }

    fn bytes(&self, training: &Training) -> Vec<u8> {
        let asked: RlPolicy = training.status().policy.expect("it is done").parse().unwrap();
        self.policies.bytes(&asked).unwrap()
    }
}

/// Three points of the curve on the small map.
fn query(name: &str) -> TrainingQuery {
    TrainingQuery {
        map: "u-turn".into(),
        name: name.into(),
        seed: 7,
        recipe: RecipeName::Quick,
        settings: Settings { updates: Some(300), ..Settings::default() },
        start_from: None,
        goal_m: None,
    }
}

fn wait(training: &Training, until: impl Fn(&Status) -> bool) -> Status {
    let begun = Instant::now();
    loop {
        let status = training.status();
        if until(&status) {
            return status;
        }
        assert!(begun.elapsed() < Duration::from_secs(300), "{:?}", status.stage);
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            std::fs::copy(path, target).unwrap();
        }
    }
}

#[test]
#[ignore = "long"]
fn a_training_that_is_interrupted_ends_in_the_same_policy() {
    let (one, two, three) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let whole = Laboratory::in_folder(one.path());
    let training = whole.trainings.submit(None, query("mine")).unwrap();
    wait(&training, |status| status.frames.len() == 2);
    // What a server finds that was killed now.
    copy(one.path(), two.path());
    let status = wait(&training, |status| status.stage.is_final());
    assert_eq!(status.stage, TrainingStage::Done);
    assert_eq!((status.points.len(), status.frames.len(), status.examined.unwrap().episodes), (3, 3, 1000));
    let expected = whole.bytes(&training);

    let killed = Laboratory::in_folder(two.path());
    let again = killed.trainings.find("training-1").unwrap();
    assert_eq!(wait(&again, |status| status.stage.is_final()).stage, TrainingStage::Done);
    assert_eq!(killed.bytes(&again), expected);
    assert_eq!(again.status().frames, status.frames);

    // Paused after its first point, with a new server before it goes on.
    let before = Laboratory::in_folder(three.path());
    let paused = before.trainings.submit(None, query("mine")).unwrap();
    wait(&paused, |status| !status.frames.is_empty());
    assert!(paused.pause());
    let status = wait(&paused, |status| status.stage == TrainingStage::Paused);
    assert!(status.points.len() < 3, "{}", status.points.len());
    drop(before);
    let after = Laboratory::in_folder(three.path());
    let again = after.trainings.find("training-1").unwrap();
    assert_eq!((again.status().stage, again.status().points), (TrainingStage::Paused, status.points));
    assert!(after.trainings.resume(&again).unwrap());
    assert_eq!(wait(&again, |status| status.stage.is_final()).stage, TrainingStage::Done);
    assert_eq!(after.bytes(&again), expected);
}

#[test]
fn a_cancelled_training_leaves_nothing_and_frees_its_name() {
    let folder = tempfile::tempdir().unwrap();
    // A folder that no training made.
    let foreign = folder.path().join(format!("trainings/training-{}", u64::MAX));
    std::fs::create_dir_all(&foreign).unwrap();
    let laboratory = Laboratory::in_folder(folder.path());
    std::fs::remove_dir(&foreign).unwrap();
    let first = laboratory.trainings.submit(None, query("mine")).unwrap();
    assert_eq!(first.id, "training-1");
    let second = laboratory.trainings.submit(None, query("yours")).unwrap();
    let error = laboratory.trainings.submit(None, query("mine")).unwrap_err();
    assert!(matches!(error, SubmitTrainingError::Query(QueryError::Taken { .. })), "{error}");
    assert!(second.cancel() && !second.cancel());
    assert_eq!(second.status().stage, TrainingStage::Cancelled);
    wait(&first, |status| !status.points.is_empty());
    assert!(first.cancel());
    // A weaker wish does not revoke it.
    assert!(!first.pause());
    wait(&first, |status| status.stage == TrainingStage::Cancelled);
    assert_eq!(std::fs::read_dir(folder.path().join("trainings")).unwrap().count(), 0);
    assert!(laboratory.policies.all().is_empty());
    let third = laboratory.trainings.submit(None, query("mine")).unwrap();
    assert_eq!(third.id, "training-3");
    laboratory.queue.close();
    assert!(matches!(
        laboratory.trainings.submit(None, query("other")),
        Err(SubmitTrainingError::Queue(QueueError::Closing))
    ));
    assert_eq!(laboratory.trainings.all().len(), 3, "the refused one is not kept");
}

#[test]
#[ignore = "long"]
fn a_training_that_cannot_be_saved_fails_and_goes_on_later() {
    let folder = tempfile::tempdir().unwrap();
    let laboratory = Laboratory::in_folder(folder.path());
    let training = laboratory.trainings.submit(None, query("mine")).unwrap();
    let frames = folder.path().join("trainings/training-1/frames");
    wait(&training, |status| !status.frames.is_empty());
    // A folder in place of the file, instead of a full disk.
    std::fs::remove_file(&frames).unwrap();
    std::fs::create_dir(&frames).unwrap();
    let status = wait(&training, |status| status.stage.is_final());
    assert!(matches!(&status.stage, TrainingStage::Failed(reason) if reason.contains("frames")), "{:?}", status.stage);
    std::fs::remove_dir(&frames).unwrap();
    assert!(laboratory.trainings.resume(&training).unwrap());
    let status = wait(&training, |status| status.stage == TrainingStage::Done);
    assert_eq!((status.points.len(), status.frames.len()), (3, 3));
}

#[test]
fn refuses_what_cannot_be_trained_and_names_the_field() {
    let folder = tempfile::tempdir().unwrap();
    let laboratory = Laboratory::in_folder(folder.path());
    let far = Some(ferry_core::geometry::Point2::new(5.0, 5.0));
    for (query, field) in [
        (TrainingQuery { map: "nowhere".into(), ..query("mine") }, "map"),
        (TrainingQuery { map: "attractor-example".into(), ..query("mine") }, "map"),
        (query("colon"), "name"),
        (query("Not a name"), "name"),
        (TrainingQuery { start_from: Some("explorer".into()), ..query("mine") }, "start_from"),
        (TrainingQuery { start_from: Some("nothing".into()), ..query("mine") }, "start_from"),
        (TrainingQuery { start_from: Some("../x".into()), ..query("mine") }, "start_from"),
        (TrainingQuery { goal_m: far, ..query("mine") }, "goal_m"),
    ] {
        match laboratory.trainings.submit(None, query) {
            Err(SubmitTrainingError::Query(error)) => assert_eq!(error.field(), field, "{error}"),
            other => panic!("{field}: {other:?}"),
        }
    }
    assert!(!folder.path().join("trainings").exists(), "nothing is half stored");
}

#[test]
#[ignore = "long"]
fn fine_tuning_begins_with_the_policys_weights() {
    let folder = tempfile::tempdir().unwrap();
    let laboratory = Laboratory::in_folder(folder.path());
    let settings = Settings { updates: Some(100), learning_rate: Some(1e-5), ..Settings::default() };
    let query = TrainingQuery { start_from: Some("colon".into()), settings, ..query("mine") };
    let training = laboratory.trainings.submit(None, query).unwrap();
    let status = wait(&training, |status| status.stage.is_final());
    assert_eq!(status.stage, TrainingStage::Done);
    let tuned = policy::weights(&laboratory.bytes(&training)).unwrap();
    let colon = policy::weights(&Policy::shipped_bytes("colon").unwrap()).unwrap();
    let off = |name: &String| tuned[name].iter().zip(&colon[name]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    let most = colon.keys().map(off).fold(0.0, f32::max);
    assert!(most > 0.0 && most < 0.01, "{most}");
}
