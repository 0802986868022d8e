//! Regression gates: `ferry check` and `ferry render --compare`.

use std::path::Path;
use std::process::Output;

use ferry_core::image::Picture;

use crate::support::ferry;

fn run(arguments: &[&str]) -> (bool, String) {
    let Output { status, stdout, stderr } = ferry(arguments).output().unwrap();
    (status.success(), String::from_utf8([stdout, stderr].concat()).unwrap())
}

fn text(path: &Path) -> String {
    path.display().to_string()
}

#[test]
#[ignore = "long"]
fn a_check_fails_when_a_controller_delivers_less_often() {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("baseline.json"));
    let command =
        ["evaluate", "--map", "posts", "--controller", "errt,attractor", "--episodes", "12", "--set", "step_limit=150"];
    let (stored, said) = run(&[&["check", "--baseline", &file, "--write", "--"], &command[..]].concat());
    assert!(stored, "{said}");
    let (same, said) = run(&["check", "--baseline", &file]);
    assert!(same && said.contains("no row is worse") && said.contains("errt on posts, 0 disturbances"), "{said}");

    // The same command with fewer steps stands for a worse controller.
    let baseline = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, baseline.replace("step_limit=150", "step_limit=10")).unwrap();
    let (same, said) = run(&["check", "--baseline", &file]);
    assert!(!same && said.contains("worse: errt on posts, 0 disturbances, attractor on posts"), "{said}");

    for (change, reason) in [
        (("\"--episodes\",\n    \"12\"", "\"--episodes\",\n    \"11\""), "has 11 trials, the baseline has 12"),
        (("\"errt,attractor\"", "\"attractor\""), "rows: the command gives"),
        (("\"evaluate\"", "\"token\""), "the command of the baseline"),
        (("\"ferry_baseline\": 1", "\"ferry_baseline\": 2"), "ferry_baseline is 2, this Ferry reads 1"),
    ] {
        let changed = baseline.replace(change.0, change.1);
        assert_ne!(changed, baseline);
        std::fs::write(&file, changed).unwrap();
        let (same, said) = run(&["check", "--baseline", &file]);
        assert!(!same && said.contains(reason), "{said}");
    }
    assert!(!run(&["check", "--baseline", &file, "--", "evaluate"]).0, "a command needs --write");
}

#[test]
fn a_check_repeats_a_recovery_map() {
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("map.json"));
    let command = ["recovery", "--map", "posts", "--grid", "4", "--repeats", "1", "--controller", "attractor"];
    let (stored, said) = run(&[&["check", "--baseline", &file, "--write", "--"], &command[..]].concat());
    assert!(stored, "{said}");
    let (same, said) = run(&["check", "--baseline", &file]);
    assert!(same && said.contains("attractor, place"), "{said}");
}

#[test]
fn a_frame_is_compared_with_a_golden_picture() {
    let folder = tempfile::tempdir().unwrap();
    let [golden, out, difference] =
        ["golden.png", "now.png", "now-difference.png"].map(|name| folder.path().join(name));
    let render = |at: &str, more: &[&str]| {
        let (out, at) = (text(&out), format!("--at={at}"));
        run(&[&["render", "--map", "posts", &at, "--out", &out], more].concat())
    };
    assert!(render("-0.1,-0.35", &[]).0);
    std::fs::rename(&out, &golden).unwrap();
    let compare = ["--compare", &text(&golden)];
    let (same, said) = render("-0.1,-0.35", &compare);
    assert!(same && said.contains("0.000 % of the pixels differ"), "{said}");
    assert!(!difference.exists());
    let (same, said) = render("-0.1,-0.34", &compare);
    assert!(!same && said.contains("now-difference.png"), "{said}");
    let picture = Picture::from_png(&std::fs::read(&difference).unwrap()).unwrap();
    assert!(picture.rgba.chunks(4).any(|pixel| pixel[..3] == [220, 0, 0]));
    assert!(render("-0.1,-0.34", &[&compare[..], &["--tolerance", "1"]].concat()).0);
    let (_, said) = render("-0.1,-0.34", &[&compare[..], &["--tolerance", "2"]].concat());
    assert!(said.contains("must be 0 to 1"), "{said}");
    std::fs::write(&golden, "no picture").unwrap();
    let (same, said) = render("-0.1,-0.35", &compare);
    assert!(!same && said.contains("not a PNG"), "{said}");
}
