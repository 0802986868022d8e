//! What the documents state is what the code, the reports and the program say.

use std::path::Path;

use ferry_core::map::{Map, MazeFamily};
use ferry_core::plant::BEAD_RADIUS_M;
use ferry_core::scenario::ControllerName;
use ferry_lab::evaluate::{Cell, PaperRow};
use serde_json::Value;

use crate::support::ferry;

const WORDS: [&str; 13] =
    ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];

fn text(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A document without its line breaks.
fn flowing(path: &str) -> String {
    text(path).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn states(path: &str, sentence: &str) {
    assert!(flowing(path).to_lowercase().contains(&sentence.to_lowercase()), "{path} does not state {sentence:?}");
}

/// The text between two others.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let rest = text.split_once(before).unwrap_or_else(|| panic!("{before:?} is missing")).1;
    rest.split_once(after).unwrap_or_else(|| panic!("{after:?} is missing")).0
}

/// A whole number with a comma between thousands.
fn thousands(count: u64) -> String {
    if count < 1000 { count.to_string() } else { format!("{},{:03}", count / 1000, count % 1000) }
}

/// Rows of committed reports as "delivered of trials", by controller, map and number of disturbances.
fn delivered(path: &str, controller: &str, map: &str, disturbances: u64) -> (u64, u64) {
    let report: Value = serde_json::from_str(&text(path)).unwrap();
    let is_asked = |row: &&Value| {
        (&row["controller"], &row["map"], &row["disturbances"])
            == (&controller.into(), &map.into(), &disturbances.into())
    };
    let rows = report["rows"].as_array().unwrap();
    let row = rows.iter().find(is_asked).unwrap_or_else(|| panic!("{path} has no row of {controller}"));
    (row["delivered"].as_u64().unwrap(), row["episodes"].as_u64().unwrap())
}

#[test]
fn the_readme_counts_what_the_code_has() {
    let lessons = text("web/src/features/lessons/lessons.ts");
    let lessons = between(&lessons, "GROUPS: readonly Group[] = [", "\n];");
    let groups = lessons.split("lessons: [").skip(1);
    let lessons: usize = groups.map(|group| group.split_once(']').unwrap().0.split(',').count()).sum();
    states("README.md", &format!("{} lessons ask for a prediction", WORDS[lessons]));
    // The controllers that the page compares, each named.
    let controllers = ["a trained Rainbow-IQN policy (RL)", "the path planner ERRT", "or attractor dynamics"];
    let compared = text("server/cli/recovery.rs");
    assert_eq!(between(&compared, "default_value = \"rl,", "\")").split(',').count() + 1, controllers.len());
    states("README.md", &format!("Choose one of {} controllers at any time: {}", WORDS[3], controllers.join(", ")));
    let timeline = text("server/core/session/timeline.rs");
    let moments: usize = between(&timeline, "const MOST: usize = ", ";").parse().unwrap();
    states("README.md", &format!("go back up to {} minutes", WORDS[moments / (4 * 60)]));
    states("README.md", &format!("a {:.0} mm magnetic bead", 2e3 * BEAD_RADIUS_M));
    let rust = text("Cargo.toml");
    states("README.md", &format!("Rust {} or newer", between(&rust, "rust-version = \"", "\"")));
    let node = text("web/package.json");
    states("README.md", &format!("Node.js {} or newer", between(&node, "\"node\": \">=", "\"")));
}

#[test]
fn the_readme_states_the_results_of_the_committed_reports() {
    let folder = "tests/results/reports/85b05d82";
    let of = |file: &str, controller: &str, disturbances| {
        delivered(&format!("{folder}/{file}.json"), controller, "colon", disturbances)
    };
    let claim = of("claims", "rl", 0);
    assert_eq!(claim, of("claims", "rl", 3), "one sentence is about both");
    let paper = |disturbances| {
        let (map, varied) = ("colon".to_owned(), Vec::new());
        let cell = Cell { controller: ControllerName::Rl, map, disturbances, program: None, varied };
        PaperRow::of(&cell).unwrap()
    };
    let (calm, rough) = (paper(0), paper(3));
    let [won, trials] = [claim.0, claim.1].map(thousands);
    let theirs = format!("(paper: {} and {} of {})", calm.successes, rough.successes, calm.episodes);
    states(
        "README.md",
        &format!("its goal in {won} of {trials} trials, both without and with three disturbances {theirs}"),
    );
    let (won, trials) = of("bare", "rl", 0);
    states("README.md", &format!("without shield and visit penalty, delivers {won} of {trials}"));
    for (controller, name) in [("errt", "ERRT"), ("attractor", "Attractor dynamics")] {
        let [(calm, trials), (rough, _)] = [0, 3].map(|disturbances| of("controllers", controller, disturbances));
        let all = if controller == "errt" { format!(" of {trials}") } else { String::new() };
        states("README.md", &format!("{name} delivers {calm} and {rough}{all}"));
    }
    let families: Vec<&str> = ["rooms", "spirals", "serpentines"].into();
    let (mut won, mut trials, mut mazes) = (0, 0, 0);
    for family in &families {
        let report: Value =
            serde_json::from_str(&text(&format!("tests/results/mazes/21a9061a/{family}, RL, explorer, 200.json")))
                .unwrap();
        for row in report.as_array().unwrap() {
            won += row["delivered"].as_u64().unwrap();
            trials += row["episodes"].as_u64().unwrap();
            mazes += 1;
        }
    }
    let (families, won, trials) = (WORDS[families.len()], thousands(won), thousands(trials));
    let steps = text("tests/results/mazes.py");
    let steps = between(&steps, "\nSTEPS = ", "\n");
    states(
        "README.md",
        &format!(
            "On {mazes} mazes of {families} families that it never saw it delivered {won} of {trials}, with up to {steps} steps each"
        ),
    );
}

#[test]
fn the_readme_names_every_command_and_only_those() {
    let help = ferry(&["--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let commands = between(&help, "Commands:\n", "\n\n").lines().map(|line| line.split_whitespace().next().unwrap());
    let commands: Vec<&str> = commands.filter(|&command| command != "help").collect();
    assert!(commands.len() > 10, "{commands:?}");
    let readme = text("README.md");
    let table = between(&readme, "## Commands", "`ferry COMMAND --help`");
    let named: Vec<&str> = table.split("`ferry ").skip(1).map(|rest| rest.split([' ', '`']).next().unwrap()).collect();
    for command in &commands {
        assert!(named.contains(command), "README.md lacks `ferry {command}`");
    }
    for command in named {
        assert!(commands.contains(&command), "README.md has `ferry {command}`");
    }
}

#[test]
fn the_documents_list_the_maps_and_families() {
    let maps = flowing("docs/maps.md");
    let listed = between(&maps, "Shipped maps: ", " Every option");
    let mut listed: Vec<&str> = listed.split('`').skip(1).step_by(2).collect();
    listed.sort_unstable();
    assert_eq!(listed, Map::shipped_names());
    let maps = text("docs/maps.md");
    let rows = between(&maps, "| family | what it is | used for |", "\n\n").lines().skip(2);
    let families: Vec<&str> = rows.map(|row| row.split('`').nth(1).unwrap()).collect();
    assert_eq!(families, MazeFamily::ALL.map(MazeFamily::as_str));
}

#[test]
fn the_documents_show_what_ferry_map_prints() {
    let document = text("docs/maps.md");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two-rooms.svg");
    std::fs::write(&path, between(&document, "```svg\n", "```")).unwrap();
    let printed = ferry(&["map"]).arg(&path).output().unwrap();
    let shown = between(&document, "`ferry map two-rooms.svg` answers:\n\n```\n", "```");
    assert_eq!(String::from_utf8(printed.stdout).unwrap(), shown);
}

#[test]
fn the_documents_name_every_option() {
    for (command, document, is_elsewhere) in [
        ("evaluate", "docs/experiments.md", &[][..]),
        ("recovery", "docs/recovery.md", &[]),
        ("train", "docs/training.md", &[]),
        ("serve", "docs/operations.md", &["--robot-server-model"]),
    ] {
        let help = String::from_utf8(ferry(&[command, "--help"]).output().unwrap().stdout).unwrap();
        let options = help.lines().filter_map(|line| line.trim_start().split(' ').find(|word| word.starts_with("--")));
        let options: Vec<&str> = options.filter(|&option| option != "--help").collect();
        assert!(options.len() > 5, "{help}");
        let text = text(document);
        for option in options {
            let is_named = text.contains(&format!("`{option}`")) || text.contains(&format!("`{option} "));
            assert!(is_named || is_elsewhere.contains(&option), "{document} lacks {option} of `ferry {command}`");
        }
    }
}

#[test]
fn both_licence_texts_are_complete() {
    let mit = text("LICENSE-MIT");
    assert!(
        mit.starts_with("MIT License\n\nCopyright (c) ") && mit.ends_with("OTHER DEALINGS IN THE\nSOFTWARE.\n"),
        "{mit}"
    );
    let apache = text("LICENSE-APACHE");
    // As https://www.apache.org/licenses/LICENSE-2.0.txt has it.
    assert_eq!((apache.len(), apache.lines().count()), (11_358, 202));
    assert!(apache.contains("Version 2.0, January 2004") && apache.contains("END OF TERMS AND CONDITIONS"));
    states("README.md", "License: [MIT](LICENSE-MIT) or [Apache-2.0](LICENSE-APACHE), at your choice.");
    assert!(text("Makefile").contains("cp LICENSE-MIT LICENSE-APACHE $(DIST)"));
}
