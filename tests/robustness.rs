//! Evaluations over varied parameters.

use serde_json::Value;

use crate::support;

const QUERY: [&str; 9] =
    ["evaluate", "--map", "open", "--controller", "errt,attractor", "--episodes", "2", "--seed", "5"];

fn report(more: &[&str]) -> Value {
    let output = support::ferry(&[&QUERY[..], &["--json"], more].concat()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The rows without what depends on the clock, and without their varied parameters.
fn rows(report: &Value) -> Vec<Value> {
    let mut rows = report["rows"].as_array().unwrap().clone();
    for row in &mut rows {
        let row = row.as_object_mut().unwrap();
        for name in ["decision_ms_p50", "decision_ms_p99", "varied"] {
            assert!(row.remove(name).is_some());
        }
    }
    rows
}

#[test]
fn each_value_has_the_rows_of_an_evaluation_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let [csv, html] = ["a.csv", "a.html"].map(|name| folder.path().join(name).display().to_string());
    let varied = report(&["--vary", "friction=0.2:0.4:2", "--csv", &csv, "--html", &html]);
    let alone = [&["--set", "friction=0.2"][..], &["--set", "friction=0.4"]].map(report);
    assert_eq!(rows(&varied), alone.iter().flat_map(rows).collect::<Vec<_>>());
    let values: Vec<f64> =
        varied["rows"].as_array().unwrap().iter().map(|row| row["varied"][0]["value"].as_f64().unwrap()).collect();
    assert_eq!(values, [0.2, 0.2, 0.4, 0.4]);
    // Only rows with the same value are compared.
    let compared: Vec<f64> = varied["comparisons"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["varied"][0]["value"].as_f64().unwrap())
        .collect();
    assert_eq!(compared, [0.2, 0.4]);
    let csv = std::fs::read_to_string(csv).unwrap();
    assert!(csv.lines().nth(1).unwrap().starts_with("errt,open,0,friction,0.2,,,2,"), "{csv}");
    let html = std::fs::read_to_string(html).unwrap();
    assert!(html.contains("Friction μ (friction)") && html.contains("delivered, % (Wilson, 95 %)"));
}

#[test]
fn two_parameters_have_a_heat_map() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("a.html").display().to_string();
    let two = ["--vary", "friction=0.2:0.4:2", "--vary", "tracker_noise_m=0:0.004:3", "--html", &html];
    let report = report(&two);
    assert_eq!(report["rows"].as_array().unwrap().len(), 2 * 2 * 3);
    let html = std::fs::read_to_string(html).unwrap();
    assert!(html.contains("errt: delivered, %") && html.contains("attractor: delivered, %"));
}

#[test]
fn a_value_outside_its_range_is_refused_before_anything_runs() {
    for (vary, words) in [
        ("friction=0.5:1.5:3", "friction is 1.5, it must be 0 to 1"),
        ("friction", "must be NAME=FROM:TO:COUNT"),
        ("rl_shield=0:1:2", "rl_shield is not a number"),
    ] {
        let output = support::ferry(&[&QUERY[..], &["--vary", vary]].concat()).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && error.contains(words), "{error}");
    }
}
