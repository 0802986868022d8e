//! The command line: output and errors.

use std::process::Output;

use ferry::trial::{InputLog, replay};

use crate::support::ferry;

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
    let message = failure(ferry(&["evaluate", "--episodes", "0"]).output().unwrap());
    assert!(message.contains("episodes is 0"), "{message}");
}
