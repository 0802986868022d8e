//! Rules of `ARCHITECTURE.md`: which module may import which, file lengths, impure code, avoided phrases.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const FLOORS: [&[&str]; 15] = [
    &["schema", "names", "panics", "faults"],
    &["geometry"],
    &["image", "robot", "magnetics", "map"],
    &["plant"],
    &["scenario", "tracking", "perception"],
    &["policy"],
    &["control"],
    &["trial", "files"],
    &["challenge", "program", "ur", "camera", "open"],
    &["jobs", "export"],
    &["learn", "evaluate", "session", "boards"],
    &["recovery"],
    &["recording", "protocol"],
    &["http", "robot_client", "robot_server"],
    &["cli", "main", "lib"],
];

/// Crates that only these modules may use.
const CONFINED: [(&str, &[&str]); 9] = [
    ("wgpu", &["camera"]),
    ("candle_core", &["policy", "learn"]),
    ("tokio", &["program", "ur", "session", "http", "robot_client", "robot_server", "cli", "main"]),
    ("re_chunk", &["recording"]),
    ("re_log_encoding", &["recording"]),
    ("re_log_types", &["recording"]),
    ("re_sdk_types", &["recording"]),
    ("utoipa", &["schema", "geometry", "plant", "scenario", "trial", "evaluate", "recovery", "protocol", "http"]),
    ("ts_rs", &["geometry", "plant", "scenario", "trial", "evaluate", "recovery", "protocol"]),
];

/// Code that only one file may have: what a client sends is limited there.
const IN_ONE_FILE: [(&str, &str); 4] = [
    ("WebSocketUpgrade", "http/socket.rs"),
    ("into_limited_body", "http/body.rs"),
    ("into_data_stream", "http/body.rs"),
    ("http_body_util", "http/body.rs"),
];
/// What a handler must not ask for, because it would read the body itself.
const READS_BODY: [&str; 8] = ["Bytes", "String", "Json", "Form", "RawForm", "Multipart", "Body", "Request"];

/// Maximum number of lines of a file.
const LINES_MOST: usize = 400;

/// Code that would make a trial depend on more than its scenario, seed and inputs.
const IMPURE: [&str; 9] = [
    "Instant::now",
    "SystemTime",
    "thread_rng",
    "rand::rng()",
    "env::var",
    "static mut",
    "std::fs",
    "std::net",
    "std::thread",
];

pub fn sources() -> Vec<(PathBuf, String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("server");
    let mut folders = vec![root.clone()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path == root.join("assets") {
                // Another package.
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let inside = path.strip_prefix(&root).unwrap();
                let inside = inside.strip_prefix("core").unwrap_or(inside);
                let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
                let module = first.trim_end_matches(".rs").to_owned();
                let text = std::fs::read_to_string(&path).unwrap();
                found.push((path, module, text));
            }
        }
    }
    found
}

fn floor_of() -> BTreeMap<&'static str, usize> {
    FLOORS.iter().enumerate().flat_map(|(floor, modules)| modules.iter().map(move |&module| (module, floor))).collect()
}

/// Names that follow `needle` in code, comments left out.
fn names_after(text: &str, needle: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    code.match_indices(needle)
        .filter(|&(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$'))
        .map(|(at, _)| {
            let rest = &code[at + needle.len()..];
            rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        })
        .collect()
}

#[test]
fn a_module_imports_only_from_floors_below() {
    let floors = floor_of();
    let mut seen = 0;
    for (path, module, text) in sources() {
        let own = floors.get(module.as_str()).unwrap_or_else(|| panic!("{module} has no floor"));
        if module == "lib" || module == "main" {
            continue;
        }
        let imports = ["crate::", "ferry_core::"].map(|from| names_after(&text, from));
        for imported in imports.concat() {
            assert!(!imported.is_empty(), "{path:?}: write one `use crate::module` a module");
            if imported == module {
                continue;
            }
            seen += 1;
            let other = floors.get(imported.as_str()).unwrap_or_else(|| panic!("{path:?} imports {imported:?}"));
            assert!(other < own, "{path:?}: {module} (floor {own}) imports {imported} (floor {other})");
        }
    }
    assert!(seen > 100, "the walk found only {seen} imports");
}

#[test]
fn no_file_is_long() {
    for (path, _, text) in sources() {
        let lines = text.lines().count();
        assert!(lines <= LINES_MOST, "{path:?} has {lines} lines");
    }
}

#[test]
fn confined_crates_stay_in_their_modules() {
    for (path, module, text) in sources() {
        for (name, homes) in CONFINED {
            let used = !names_after(&text, &format!("{name}::")).is_empty();
            assert!(!used || homes.contains(&module.as_str()), "{path:?} uses {name}");
        }
    }
}

#[test]
fn sockets_and_bodies_of_clients_are_read_in_one_place() {
    let (mut homes, mut handlers) = (0, 0);
    for (path, _, text) in sources().into_iter().filter(|(_, module, _)| module == "http") {
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let code: Vec<&str> = code.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
        for (part, home) in IN_ONE_FILE {
            let has = code.iter().any(|line| line.contains(part));
            assert!(!has || path.ends_with(home), "{path:?} has `{part}`, which belongs to {home}");
            homes += usize::from(has);
        }
        let joined = code.join(" ");
        for handler in joined.split("pub async fn ").skip(1) {
            let (name, arguments) = handler.split_once('(').unwrap();
            let arguments = arguments.split(") ->").next().unwrap().replace("Path<String>", "");
            // The guard passes the request on.
            if !arguments.contains("State(") || name == "guard" {
                continue;
            }
            let mut words = arguments.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let read = words.find(|word| READS_BODY.contains(word));
            assert!(read.is_none(), "{path:?}: {name} takes {read:?}; take WholeBody");
            handlers += 1;
        }
    }
    assert!(homes == IN_ONE_FILE.len() && handlers > 40, "the walk found {homes} places and {handlers} handlers");
}

#[test]
fn nothing_below_session_reads_a_clock_a_global_a_file_or_an_unseeded_generator() {
    let floors = floor_of();
    for (path, module, text) in sources() {
        if floors[module.as_str()] > 7 || ["files", "faults"].contains(&module.as_str()) {
            continue;
        }
        // Tests may measure; modules of tests close their files.
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let is_test = path.file_name().unwrap().to_str().unwrap().contains("test");
        for impure in IMPURE {
            assert!(is_test || !code.contains(impure), "{path:?} uses {impure}");
        }
    }
}

/// Phrases that readers stumbled over; `docs/glossary.md` has the words to use. Written in two parts, so that this file
/// does not contain them.
const AVOIDED: [(&str, &str); 13] = [
    ("time", " stands"),
    ("who", "ever"),
    (" is", " none"),
    (" an", "ew "),
    ("while", " time "),
    ("some", "body"),
    ("no", "body"),
    ("lets", " go"),
    (" is", " told"),
    ("strang", "er"),
    ("what was", " seen"),
    ("what is", " known"),
    // An unfinished merge.
    ("<<<<", "<<< "),
];

#[test]
fn avoided_phrases_do_not_occur() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut waiting: Vec<PathBuf> =
        ["server", "tests", "web/src", "web/e2e", "web/login", "web/refused", "docs", "shaders"]
            .map(|folder| root.join(folder))
            .into();
    waiting.extend(
        ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "Makefile"].map(|file| root.join(file)),
    );
    let mut read = 0;
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            waiting.extend(std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        // Pictures and recorded logs are not text.
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        read += 1;
        if path.ends_with("docs/glossary.md") {
            continue;
        }
        let text = text.to_lowercase();
        for (first, second) in AVOIDED {
            let phrase = format!("{first}{second}");
            assert!(!text.contains(&phrase), "{path:?} contains {phrase:?}");
        }
    }
    assert!(read > 400, "only {read} files were read");
}
