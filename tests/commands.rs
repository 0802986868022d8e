//! The command line: output and errors.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use ferry_core::trial::{InputLog, replay};

use crate::support::{Ferry, ferry};

fn failure(output: Output) -> String {
    assert!(!output.status.success());
    assert!(output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or_default().to_owned()
}

#[test]
fn evaluate_prints_one_object_and_delivers_on_posts() {
    let run = |disturbances: &str| {
        let arguments =
            ["evaluate", "--controller", "attractor", "--map", "posts", "--episodes", "12", "--seed", "1", "--json"];
        let output = ferry(&arguments).args(["--disturbances", disturbances]).output().unwrap();
        assert!(output.status.success());
        let table: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        table["rows"][0].clone()
    };
    let (calm, rough) = (run("0"), run("3"));
    assert!(calm["delivered"].as_u64() >= Some(11), "{calm}");
    assert!(rough["delivered"].as_u64() >= Some(10), "{rough}");
    assert!(rough["disturbances_struck"].as_u64() >= Some(30), "{rough}");
    assert!(rough["switches_mean"].as_f64() >= Some(5.0), "{rough}");
    assert!(calm["tracking_error_mean_m"].as_f64().is_some_and(|error| (0.005..0.03).contains(&error)), "{calm}");
}

#[test]
fn the_same_seed_gives_the_same_row_but_for_the_timings() {
    let row = || {
        let output = ferry(&["evaluate", "--episodes", "4", "--disturbances", "1", "--json"]).output().unwrap();
        let mut table: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let row = table["rows"][0].as_object_mut().unwrap();
        row.retain(|name, _| !name.starts_with("decision_ms"));
        row.clone()
    };
    assert_eq!(row(), row());
}

#[test]
fn every_controller_gets_the_same_trials_and_each_trial_is_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let [csv, html, record] = ["rows.csv", "report.html", "records"].map(|name| folder.path().join(name));
    let mut command = ferry(&["evaluate", "--map", "posts,open", "--controller", "errt,attractor", "--json"]);
    command.args(["--disturbances", "0,2", "--episodes", "3", "--seed", "4", "--record"]).arg(&record);
    let output = command.arg("--csv").arg(&csv).arg("--html").arg(&html).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 8);
    for row in rows {
        let ratio = row["path_ratio_mean"].as_f64().unwrap();
        assert!((0.97..2.0).contains(&ratio), "{row}");
    }
    let comparisons = report["comparisons"].as_array().unwrap();
    assert_eq!(comparisons.len(), 4);
    assert_eq!((&comparisons[0]["controller"], &comparisons[0]["against"]), (&"errt".into(), &"attractor".into()));

    // The logged displacements: the n-th one puts the bead at the same place for every controller.
    let places = |name: &str| -> Vec<[f64; 2]> {
        let bytes = std::fs::read(record.join(format!("{name}.ferry"))).unwrap();
        let log = InputLog::read(&bytes).unwrap();
        let (mut before, mut places) = (0, Vec::new());
        replay(&log, None, &mut |record| {
            let struck = record.moment.counters.disturbances;
            if std::mem::replace(&mut before, struck) < struck {
                let bead = record.moment.bead_m;
                places.push([(bead.x * 1e3).round(), (bead.y * 1e3).round()]);
            }
        })
        .unwrap();
        places
    };
    let alike = (0..3).filter(|index| {
        let [first, second] = ["errt", "attractor"].map(|name| places(&format!("posts-{name}-2-{index:04}")));
        assert_eq!((first.len(), second.len()), (2, 2));
        let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 5.0;
        first.iter().zip(&second).all(|(a, b)| near(a, b))
    });
    // A place too near to the bead of one controller is drawn again for that controller only.
    assert!(alike.count() >= 2);
    assert_eq!(std::fs::read_dir(&record).unwrap().count(), 2 * 8 * 3);

    let rows = std::fs::read_to_string(&csv).unwrap();
    assert_eq!(rows.lines().count(), 9);
    assert!(
        rows.starts_with("controller,map,disturbances,varied_1,value_1,varied_2,value_2,episodes,successes,"),
        "{rows}"
    );
    let page = std::fs::read_to_string(&html).unwrap();
    assert_eq!(page.matches("<figure>").count(), 8);
    for foreign in ["src=", "<link", "@import", "url("] {
        assert!(!page.contains(foreign), "it needs {foreign}");
    }

    // One trial again.
    let again =
        ferry(&["evaluate", "--map", "posts", "--controller", "errt", "--disturbances", "2", "--episodes", "3"])
            .args(["--seed", "4", "--episode", "1", "--record"])
            .arg(folder.path().join("again"))
            .output()
            .unwrap();
    assert!(again.status.success());
    let log = |of: &str| std::fs::read(folder.path().join(of).join("posts-errt-2-0001.ferry")).unwrap();
    let ticks = |bytes: &[u8]| InputLog::read(bytes).unwrap().entries;
    assert_eq!(ticks(&log("again")), ticks(&log("records")));
}

#[test]
fn replay_refuses_unreadable_logs_and_accepts_truncated_ones() {
    let folder = tempfile::tempdir().unwrap();
    let recorded = ferry(&["evaluate", "--map", "open", "--episodes", "1", "--record"]).arg(folder.path()).output();
    assert!(recorded.unwrap().status.success());
    let whole = std::fs::read(folder.path().join("open-attractor-0-0000.ferry")).unwrap();
    let path = folder.path().join("changed.ferry");
    let replayed = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        ferry(&["replay"]).arg(&path).output().unwrap()
    };
    let torn = replayed(&whole[..whole.len() - 7]);
    let told = String::from_utf8_lossy(&torn.stdout).into_owned();
    assert!(
        torn.status.success() && told.contains("was cut off") && told.contains("every world hash is equal"),
        "{told}"
    );
    let mut edited = whole.clone();
    edited[whole.len() / 2] ^= 4;
    let mut newer = whole.clone();
    newer[8] += 1;
    let versions = format!("version {}, this Ferry reads version {}", InputLog::VERSION + 1, InputLog::VERSION);
    for (bytes, parts) in [
        (edited.as_slice(), &["changed.ferry", "damaged or edited after", "whole ticks"][..]),
        (&newer, &[versions.as_str()]),
        (b"<svg></svg>", &["not a Ferry input log", "<svg></s"]),
        (&whole[..9], &["ends before its first trial"]),
    ] {
        let refused = replayed(bytes);
        assert!(!refused.status.success());
        let error = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(parts.iter().all(|part| error.contains(part)), "{error}");
    }
}

#[test]
fn render_writes_a_picture_also_over_a_wall() {
    let folder = tempfile::tempdir().unwrap();
    for (view, size) in [("camera", (480, 480)), ("scene", (1280, 720))] {
        let path = folder.path().join(format!("{view}.png"));
        let status =
            ferry(&["render", "--map", "posts", "--at", "-0.1,-0.33", "--view", view, "--out"]).arg(&path).status();
        assert!(status.unwrap().success());
        let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
        let info = png::Decoder::new(file).read_info().unwrap();
        assert_eq!((info.info().width, info.info().height), size);
    }
}

#[test]
fn map_describes_a_drawing_and_names_what_it_refuses() {
    let output = ferry(&["map", "colon"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("580 × 330 mm"), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.svg");
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-300 210 580 330"><text id="t">no</text></svg>"#;
    std::fs::write(&path, svg).unwrap();
    let message = failure(ferry(&["map"]).arg(&path).output().unwrap());
    assert!(message.contains("<text> id=\"t\" at line 1"), "{message}");
}

#[test]
fn maps_writes_mazes_that_map_accepts() {
    let folder = tempfile::tempdir().unwrap();
    let generate = |family: &str| {
        ferry(&["maps", "generate", "--family", family, "--seed", "3", "--count", "2", "--out"])
            .arg(folder.path().join("mazes"))
            .output()
            .unwrap()
    };
    let output = generate("spirals");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for name in ["spirals-3", "spirals-4"] {
        let path = folder.path().join("mazes").join(name).with_extension("svg");
        assert!(String::from_utf8_lossy(&output.stdout).contains(&format!("{name}.svg  ")));
        let described = ferry(&["map"]).arg(&path).output().unwrap();
        let text = String::from_utf8_lossy(&described.stdout).into_owned();
        assert!(text.contains("in 1 connected part(s)") && text.contains("100 % of the free area"), "{text}");
    }
    let refused = generate("ruins");
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && message.contains("\"ruins\"; there are tubes, trees"), "{message}");
}

#[test]
fn errors_are_one_sentence_with_a_remedy() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let message = failure(ferry(&["serve", "--bind", &address]).output().unwrap());
    assert!(message.contains(&address) && message.contains("--bind"), "{message}");

    let nowhere = tempfile::tempdir().unwrap().path().join("data");
    let open = ferry(&["serve", "--bind", "0.0.0.0:0", "--data"]).arg(&nowhere).output().unwrap();
    let message = failure(open);
    assert!(message.contains("0.0.0.0") && message.contains("`ferry token`"), "{message}");
    assert!(!nowhere.exists(), "a server that did not start created its folder");

    // Hides all graphics drivers.
    let without_driver = ferry(&["evaluate", "--episodes", "1"])
        .env("FERRY_ADAPTER", "vulkan")
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent")
        .output()
        .unwrap();
    let message = failure(without_driver);
    assert!(message.contains("mesa-vulkan-drivers"), "{message}");

    let message = failure(ferry(&["evaluate", "--map", "nowhere"]).output().unwrap());
    assert!(message.contains("nowhere") && message.contains("posts"), "{message}");
    let message = failure(ferry(&["map", "nowhere.png"]).output().unwrap());
    assert!(message.contains("nowhere.png: No such file"), "{message}");
}

#[test]
fn counts_out_of_range_are_refused_before_graphics_start() {
    for (arguments, parts) in [
        (&["evaluate", "--episodes", "0"][..], &["--episodes", "0 is not in 1..=100000"][..]),
        (&["evaluate", "--episodes", "100001"], &["--episodes", "100001 is not in 1..=100000"]),
        (&["evaluate", "--disturbances", "4294967295"], &["--disturbances", "4294967295 is not in 0..=10"]),
        (&["evaluate", "--disturbances", "0,11"], &["--disturbances", "11 is not in 0..=10"]),
        (&["evaluate", "--episode", "30"], &["episode is 30, it must be 0 to 29"]),
        (&["train", "--episodes", "0"], &["--episodes", "0 is not in 1..=1000000"]),
        (&["train", "--rounds", "0"], &["--rounds", "0 is not in 1..=100"]),
        (&["train", "--seed", "18446744073709551615", "--rounds", "2"], &["--seed: 18446744073709551615"]),
        (&["recovery", "--grid", "3"], &["grid is 3, it must be 4 to 96"]),
        (&["recovery", "--repeats", "0"], &["repeats is 0, it must be 1 to 100"]),
        (&["recovery", "--within-s", "NaN"], &["within_s is NaN, it must be 1 to 600"]),
        (&["serve", "--keep", "0"], &["--keep", "0 is not in 1.."]),
        (&["serve", "--keep-mb", "0"], &["--keep-mb", "0 is not in 1.."]),
        (
            &["maps", "generate", "--family", "tubes", "--out", "x", "--count", "0"],
            &["--count", "0 is not in 1..=100000"],
        ),
    ] {
        // No graphics would start with it.
        let output = ferry(arguments).env("FERRY_ADAPTER", "nothing").output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            !output.status.success() && parts.iter().all(|part| message.contains(part)),
            "{arguments:?}: {message}"
        );
    }
}

#[test]
fn files_of_other_programs_are_named_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    // Photos are larger than a drawing may be.
    let photo = [&b"\x89PNG\r\n\x1a\n"[..], &[0; 3 << 20]].concat();
    for name in ["photo.png", "photo", "photo.svg"] {
        std::fs::write(path(name), &photo).unwrap();
        let message = failure(ferry(&["map"]).arg(path(name)).output().unwrap());
        assert!(message.contains("an image of pixels, not a drawing") && message.contains("as SVG"), "{message}");
    }
    std::fs::write(path("x.onnx"), b"\x08\x07\x12\x07pytorch\x1a\x052.0.0").unwrap();
    let message = failure(ferry(&["evaluate", "--policy"]).arg(path("x.onnx")).output().unwrap());
    assert!(message.contains("an ONNX model") && message.contains("safetensors"), "{message}");
}

#[test]
fn an_empty_variable_counts_as_unset_but_an_empty_token_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = ferry(&["serve", "--bind", "localhost:0", "--data"]);
    for name in ["FERRY_TOKEN", "FERRY_ADAPTER", "FERRY_LOG", "FERRY_LOG_FORMAT"] {
        command.env(name, "");
    }
    let server = Ferry::start(command.arg(folder.path()).stderr(Stdio::null()));
    assert!(server.address.ip().is_loopback());
    let message = failure(ferry(&["serve", "--bind", "127.0.0.1:0", "--token", ""]).output().unwrap());
    assert!(message.contains("--token"), "{message}");
    for wrong in ["localhost", "127.0.0.1", "localhost:http", "no such host:80"] {
        let output = ferry(&["serve", "--bind", wrong]).output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success(), "{wrong}");
        assert!(message.contains(wrong) && message.contains("localhost:8080"), "{message}");
    }
}

#[cfg(unix)]
#[test]
fn signals_of_files_and_pipes_are_those_of_usual_commands() {
    use std::os::unix::process::ExitStatusExt;
    let folder = tempfile::tempdir().unwrap();
    let limited = |arguments: &[&str]| {
        let mut command = Command::new("sh");
        command.args(["-c", "ulimit -f 0; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_ferry")]).args(arguments);
        command
    };
    let mazes = limited(&["maps", "generate", "--family", "tubes", "--out"]).arg(folder.path().join("mazes")).output();
    let message = failure(mazes.unwrap());
    assert!(message.contains("tubes-1.svg") && message.contains("File too large"), "{message}");
    // From its first write on, which may be that of a graphics driver.
    let mut server = Ferry::serve(&mut limited(&[]), folder.path());
    assert_eq!(server.child.try_wait().unwrap(), None);

    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let unread =
        ferry(&["map", "open"]).stdout(writer).stderr(Stdio::piped()).spawn().unwrap().wait_with_output().unwrap();
    assert_eq!(
        (unread.status.signal(), unread.stderr.as_slice()),
        (Some(rustix::process::Signal::PIPE.as_raw()), &[][..])
    );
}

/// A room that is learned with few images.
const ROOM: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 250 120 100">
    <rect x="-10" y="250" width="20" height="30"/></svg>"#;

/// A training of the room, as quick as possible.
fn train(folder: &Path, more: &[&str]) -> Command {
    let mut command = ferry(&["train", "--map", "room.svg", "--episodes", "1"]);
    for setting in ["images=1", "goals=1", "fractions=1", "choosing_fractions=1", "lanes=1", "warm_up=1"] {
        command.args(["--set", setting]);
    }
    command.args(more).current_dir(folder);
    command
}

#[test]
fn a_training_overwrites_no_other_and_names_what_differs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("room.svg"), ROOM).unwrap();
    let policies = folder.path().join("data/policies");
    let first = train(folder.path(), &["--set", "updates=2"]).output().unwrap();
    assert!(first.status.success(), "{}", String::from_utf8_lossy(&first.stderr));
    let file = policies.join("room.safetensors");
    let bytes = std::fs::read(&file).unwrap();

    let again = ["--set", "updates=2", "--seed", "2"];
    let message = failure(train(folder.path(), &again).output().unwrap());
    for part in ["room.safetensors exists already", "--out", "--resume", "--force"] {
        assert!(message.contains(part), "{message}");
    }
    // What an interrupted training has left counts, too.
    std::fs::rename(&file, folder.path().join("kept")).unwrap();
    let message = failure(train(folder.path(), &again).output().unwrap());
    assert!(message.contains("room.checkpoint exists already"), "{message}");
    std::fs::rename(folder.path().join("kept"), &file).unwrap();
    assert!(std::fs::read(&file).unwrap() == bytes);

    let message = failure(train(folder.path(), &["--resume", "--set", "updates=3"]).output().unwrap());
    assert!(message.contains("another recipe: updates is 2 there and 3 now"), "{message}");

    let forced = train(folder.path(), &[&again[..], &["--force"]].concat()).output().unwrap();
    assert!(forced.status.success() && std::fs::read(&file).unwrap() != bytes);
}

#[test]
fn without_a_terminal_long_work_reports_in_lines_and_the_curve_grows() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("room.svg"), ROOM).unwrap();
    let mut evaluation = ferry(&["evaluate", "--map", "open", "--episodes", "100000"]);
    let mut training = train(folder.path(), &["--set", "updates=100000000"]);
    for (command, part) in [(&mut evaluation, "/100000 trials, "), (&mut training, "/100000000 updates, ")] {
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
        let line = lines.find(|line| line.as_ref().unwrap().contains(part));
        let curve = folder.path().join("data/policies/room.curve.csv");
        let begun = Instant::now();
        let points = || std::fs::read_to_string(&curve).map_or(0, |text| text.lines().count().saturating_sub(1));
        while part.contains("updates") && points() < 2 && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(50));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        let line = line.expect("it ended without a line").unwrap();
        assert!(line.ends_with(" left") && !line.contains('\r'), "{line}");
        assert!(part.contains("trials") || points() >= 2, "{} points", points());
    }
}

#[test]
fn an_interrupted_evaluation_leaves_an_earlier_report() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("rows.csv");
    std::fs::write(&csv, "earlier").unwrap();
    // The adapter is opened after the files.
    let mut command = ferry(&["evaluate", "--episodes", "1", "--csv"]);
    failure(command.arg(&csv).env("FERRY_ADAPTER", "nothing").output().unwrap());
    assert_eq!(std::fs::read_to_string(&csv).unwrap(), "earlier");
}
