//! The command line: what it prints, and how it fails.

use std::process::{Command, Output};

fn ferry(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ferry"));
    command.args(arguments);
    command
}

fn failure(output: Output) -> String {
    assert!(!output.status.success());
    assert!(output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or_default().to_owned()
}

#[test]
fn evaluate_prints_one_object_and_delivers_on_posts() {
    let run = |disturbances: &str| {
        let arguments =
            ["evaluate", "--controller", "attractor", "--map", "posts", "--episodes", "30", "--seed", "1", "--json"];
        let output = ferry(&arguments).args(["--disturbances", disturbances]).output().unwrap();
        assert!(output.status.success());
        let table: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        table["rows"][0].clone()
    };
    let (calm, rough) = (run("0"), run("3"));
    assert!(calm["delivered"].as_u64() >= Some(29), "{calm}");
    assert!(rough["delivered"].as_u64() >= Some(28), "{rough}");
    assert!(rough["disturbances_struck"].as_u64() >= Some(80), "{rough}");
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
fn failures_are_one_sentence_with_the_remedy() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let message = failure(ferry(&["serve", "--bind", &address]).output().unwrap());
    assert!(message.contains(&address) && message.contains("--bind"), "{message}");

    let message = failure(ferry(&["serve", "--bind", "0.0.0.0:0"]).output().unwrap());
    assert!(message.contains("127.0.0.1"), "{message}");

    // No driver is left to find.
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
