//! An evaluation in shards gives the report of the whole one.

use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::support::{self, refused_at_once};

const QUERY: [&str; 11] = [
    "evaluate",
    "--map",
    "posts",
    "--controller",
    "errt,attractor",
    "--disturbances",
    "0,1",
    "--episodes",
    "3",
    "--seed",
    "5",
];

fn ferry(arguments: &[&str]) -> Output {
    support::ferry(arguments).output().unwrap()
}

fn shard(folder: &Path, name: &str, part: &str, more: &[&str]) -> String {
    let file = folder.join(name).display().to_string();
    let output = ferry(&[&QUERY[..], &["--shard", part, "--out", &file], more].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    file
}

/// A report without what depends on the clock.
fn untimed(output: &[u8]) -> Value {
    let mut report: Value = serde_json::from_slice(output).unwrap();
    for row in report["rows"].as_array_mut().unwrap() {
        let row = row.as_object_mut().unwrap();
        assert!(row.remove("decision_ms_p50").is_some() && row.remove("decision_ms_p99").is_some());
    }
    report
}

fn refusal(files: &[&str]) -> String {
    let output = ferry(&[&["merge"], files].concat());
    assert!(!output.status.success());
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn merged_shards_are_the_whole_evaluation() {
    let folder = tempfile::tempdir().unwrap();
    let whole = ferry(&[&QUERY[..], &["--json"]].concat());
    let parts: Vec<String> =
        (1..=4).map(|number| shard(folder.path(), &format!("{number}.json"), &format!("{number}/4"), &[])).collect();
    let [one, two, three, four] = parts.iter().map(String::as_str).collect::<Vec<_>>().try_into().unwrap();
    let (csv, html) = (folder.path().join("a.csv"), folder.path().join("a.html"));
    let merged = ferry(&[
        "merge",
        three,
        one,
        four,
        two,
        "--json",
        "--csv",
        csv.to_str().unwrap(),
        "--html",
        html.to_str().unwrap(),
    ]);
    assert_eq!(untimed(&merged.stdout), untimed(&whole.stdout));
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 5);
    assert!(std::fs::read_to_string(html).unwrap().contains("<svg"));

    assert!(refusal(&[one, two, four]).contains("a shard is missing: 3/4"));
    assert!(refusal(&[one]).contains("shards are missing: 2/4, 3/4, 4/4"));
    assert!(refusal(&[one, two, one, three, four]).contains("1.json: shard 1/4 is in"));
    let seed = shard(folder.path(), "seed.json", "2/4", &["--set", "step_limit=99"]);
    let text = refusal(&[one, &seed, three, four]);
    assert!(text.contains("seed.json: subjects[0].parameters.step_limit is 99, but 150 in"), "{text}");
    let count = shard(folder.path(), "count.json", "2/5", &[]);
    assert!(refusal(&[one, &count]).contains("count.json: shard.count is 5, but 4 in"));

    let changed = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut part: Value = serde_json::from_slice(&std::fs::read(two).unwrap()).unwrap();
        change(&mut part);
        let path = folder.path().join(name);
        std::fs::write(&path, part.to_string()).unwrap();
        path.display().to_string()
    };
    let build = changed("build.json", &|part| part["machine"]["build"] = "0".into());
    assert!(refusal(&[one, &build, three, four]).contains("build.json: machine.build is \"0\", but"));
    let short = changed("short.json", &|part| drop(part["episodes"].as_array_mut().unwrap().pop()));
    assert!(refusal(&[one, &short, three, four]).contains("short.json: it does not have the trials of shard 2/4"));
    // A file may claim anything.
    let many = changed("many.json", &|part| part["subjects"][0]["episodes"] = u32::MAX.into());
    assert!(refused_at_once(&["merge", &many]).contains("many.json: it does not have the trials of shard 2/4"));
    let none = changed("none.json", &|part| part["shard"]["count"] = 0.into());
    assert!(refused_at_once(&["merge", &none]).contains("\"2/0\" is not a shard"));
    let all = changed("all.json", &|part| part["shard"]["count"] = u32::MAX.into());
    assert!(refused_at_once(&["merge", &all]).contains("is not a shard"));
    let far = changed("far.json", &|part| part["episodes"][0][1]["decision_s"][0] = 1.7e308.into());
    assert!(refused_at_once(&["merge", &far]).contains("decision_s[0] is 1.7e308"));
    let later = changed("later.json", &|part| part["ferry_part"] = 2.into());
    assert!(refusal(&[one, &later]).contains("ferry_part is 2, this Ferry reads 1"));
    let torn = folder.path().join("torn.json");
    std::fs::write(&torn, &std::fs::read(two).unwrap()[..500]).unwrap();
    assert!(refusal(&[one, torn.to_str().unwrap()]).contains("torn.json"));
}

#[test]
#[ignore = "long"]
fn merged_shards_are_the_whole_recovery_map() {
    const QUERY: [&str; 11] = [
        "recovery",
        "--map",
        "posts",
        "--controller",
        "errt,attractor",
        "--grid",
        "5",
        "--repeats",
        "2",
        "--seed",
        "3",
    ];
    let folder = tempfile::tempdir().unwrap();
    for kind in ["place", "blind"] {
        let query = [&QUERY[..], &["--kind", kind]].concat();
        let whole = ferry(&[&query[..], &["--full", "--json"]].concat());
        let files: Vec<String> = (1..=3)
            .map(|number| {
                let file = folder.path().join(format!("{kind}-{number}.json")).display().to_string();
                let output = ferry(&[&query[..], &["--shard", &format!("{number}/3"), "--out", &file]].concat());
                assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
                file
            })
            .collect();
        let [one, two, three] = files.iter().map(String::as_str).collect::<Vec<_>>().try_into().unwrap();
        let html = folder.path().join("a.html").display().to_string();
        let merged = ferry(&["merge", two, three, one, "--json", "--html", &html]);
        let [merged, whole]: [Value; 2] =
            [&merged, &whole].map(|output| serde_json::from_slice(&output.stdout).unwrap());
        assert!(merged["cells"].as_array().unwrap().len() > 10);
        assert_eq!(merged, whole);
        assert!(std::fs::read_to_string(html).unwrap().contains("<svg"));

        assert!(refusal(&[one, three]).contains("a shard is missing: 2/3"));
        let changed = |name: &str, change: &dyn Fn(&mut Value)| {
            let mut part: Value = serde_json::from_slice(&std::fs::read(two).unwrap()).unwrap();
            change(&mut part);
            let path = folder.path().join(name).display().to_string();
            std::fs::write(&path, part.to_string()).unwrap();
            path
        };
        let seed = changed("seed.json", &|part| part["subject"]["query"]["seed"] = 4.into());
        assert!(refusal(&[one, &seed, three]).contains("seed.json: subject.query.seed is 4, but 3 in"));
        let twice = changed("twice.json", &|part| part["trials"][1] = part["trials"][0].clone());
        assert!(refusal(&[one, &twice, three]).contains("twice.json: it does not have the trials of shard 2/3"));
        let many = changed("many.json", &|part| part["subject"]["query"]["repeats"] = u32::MAX.into());
        assert!(refused_at_once(&["merge", &many]).contains("many.json: repeats is 4294967295"));
        let later = changed("later.json", &|part| part["ferry_recovery_part"] = 2.into());
        assert!(refusal(&[one, &later, three]).contains("ferry_recovery_part is 2, this Ferry reads 1"));
    }
}

#[test]
fn a_shard_needs_a_number_and_a_file() {
    for (arguments, text) in [
        (&["--shard", "5/4", "--out", "x"][..], "\"5/4\" is not a shard: it must be I/N"),
        (&["--shard", "1/4"], "--out"),
        (&["--out", "x"], "--shard"),
    ] {
        let output = ferry(&[&QUERY[..], arguments].concat());
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && error.contains(text), "{error}");
    }
}
