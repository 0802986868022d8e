//! Rules of `ARCHITECTURE.md`: which crate and module may import which, file lengths, impure code, avoided phrases.

use std::path::{Path, PathBuf};

/// The crates that have floors, and these, lowest first. Between crates, their manifests keep the order.
const FLOORS: [(&str, &[&[&str]]); 3] = [
    (
        "core",
        &[
            &["schema", "names", "panics", "facts"],
            &["geometry"],
            &["image", "robot", "magnetics", "map"],
            &["plant"],
            &["scenario", "tracking", "perception"],
            &["policy"],
            &["control"],
            &["trial"],
            &["challenge"],
            &["session"],
        ],
    ),
    ("lab", &[&["changes"], &["program", "jobs"], &["learn", "evaluate"], &["recovery"]]),
    ("server", &[&["boards", "export", "faults"], &["session"], &["protocol"], &["http"], &["cli"]]),
];

/// The crates of Ferry that each crate is built on.
const BUILT_ON: [(&str, &[&str]); 7] = [
    ("core", &[]),
    ("camera", &["core"]),
    ("files", &["core"]),
    ("ur", &["core"]),
    ("recording", &["core", "files"]),
    ("lab", &["camera", "core", "files"]),
    ("server", &["camera", "core", "files", "lab", "recording", "ur"]),
];

/// What `ferry-core` must not depend on, so that it runs in a browser and in a test without anything around it.
const NOT_IN_CORE: [&str; 9] = ["tokio", "wgpu", "re_", "axum", "tracing", "tempfile", "rustix", "libc", "jiff"];

/// Crates that only these modules may use.
const CONFINED: [(&str, &[&str]); 4] = [
    ("candle_core", &["policy", "learn"]),
    ("tokio", &["changes", "program", "ur", "session", "http", "cli"]),
    (
        "utoipa",
        &[
            "schema",
            "facts",
            "control",
            "session",
            "geometry",
            "magnetics",
            "robot",
            "plant",
            "scenario",
            "trial",
            "challenge",
            "learn",
            "evaluate",
            "recovery",
            "ur",
            "protocol",
            "http",
        ],
    ),
    (
        "ts_rs",
        &[
            "facts",
            "control",
            "session",
            "geometry",
            "magnetics",
            "robot",
            "plant",
            "scenario",
            "trial",
            "challenge",
            "learn",
            "evaluate",
            "recovery",
            "ur",
            "protocol",
        ],
    ),
];

/// What the camera must not see of the crate below it.
const NOT_IN_CAMERA: [&str; 6] = ["perception", "policy", "control", "trial", "challenge", "session"];

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

/// A file of a crate below `server/`.
pub struct SourceFile {
    pub path: PathBuf,
    /// Name of the crate without `ferry-`.
    pub krate: &'static str,
    /// Path from the crate's folder, without its ending.
    pub inside: String,
    pub text: String,
}

impl SourceFile {
    /// The top module; for a crate without floors, the crate.
    fn module(&self) -> &str {
        match FLOORS.iter().any(|(krate, _)| *krate == self.krate) {
            true => self.inside.split('/').next().unwrap(),
            false => self.krate,
        }
    }

    /// Without the tests within the file.
    fn code(&self) -> &str {
        self.text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default()
    }
}

fn folder(krate: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("server");
    if krate == "server" { root } else { root.join(krate) }
}

pub fn sources() -> Vec<SourceFile> {
    let mut found = Vec::new();
    for (krate, _) in BUILT_ON {
        let root = folder(krate);
        let mut folders = vec![root.clone()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    // Another package.
                    folders.extend(Some(path).filter(|path| !path.join("Cargo.toml").exists()));
                } else if path.extension().is_some_and(|ending| ending == "rs") {
                    let inside = path.strip_prefix(&root).unwrap().with_extension("").to_str().unwrap().to_owned();
                    let text = std::fs::read_to_string(&path).unwrap();
                    found.push(SourceFile { path, krate, inside, text });
                }
            }
        }
    }
    found
}

/// The names in the table of dependencies of a crate's manifest.
fn dependencies(krate: &str) -> Vec<String> {
    let manifest = std::fs::read_to_string(folder(krate).join("Cargo.toml")).unwrap();
    let table = manifest.split("[dependencies]\n").nth(1).unwrap().split("\n[dev-dependencies]").next().unwrap();
    let names = table.lines().filter_map(|line| line.split([' ', '.', '=']).next());
    names.filter(|name| !name.is_empty() && !name.starts_with(['#', '['])).map(str::to_owned).collect()
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
fn a_crate_is_built_only_on_those_below() {
    for (krate, below) in BUILT_ON {
        let names = dependencies(krate);
        let own: Vec<&str> = names.iter().filter_map(|name| name.strip_prefix("ferry-")).collect();
        assert_eq!(own, below, "ferry-{krate}");
    }
    for name in dependencies("core") {
        assert!(!NOT_IN_CORE.iter().any(|banned| name.starts_with(banned)), "ferry-core depends on {name}");
    }
}

#[test]
fn a_module_imports_only_from_floors_below() {
    let mut seen = 0;
    for (krate, floors) in FLOORS {
        let floor_of = |module: &str| floors.iter().position(|floor| floor.contains(&module));
        for source in sources().iter().filter(|source| source.krate == krate) {
            let SourceFile { path, text, .. } = source;
            let module = source.module();
            if module == "lib" || module == "main" {
                continue;
            }
            let own = floor_of(module).unwrap_or_else(|| panic!("{krate}: {module} has no floor"));
            for imported in names_after(text, "crate::").into_iter().filter(|imported| imported != module) {
                assert!(!imported.is_empty(), "{path:?}: write one `use crate::module` a module");
                seen += 1;
                let other = floor_of(&imported).unwrap_or_else(|| panic!("{path:?} imports {imported:?}"));
                assert!(other < own, "{path:?}: {module} (floor {own}) imports {imported} (floor {other})");
            }
        }
    }
    assert!(seen > 100, "the walk found only {seen} imports");
}

#[test]
fn no_file_is_long() {
    for SourceFile { path, text, .. } in sources() {
        let lines = text.lines().count();
        assert!(lines <= LINES_MOST, "{path:?} has {lines} lines");
    }
}

#[test]
fn confined_crates_stay_in_their_modules() {
    for source in sources() {
        let SourceFile { path, krate, text, .. } = &source;
        for (name, homes) in CONFINED {
            let used = !names_after(text, &format!("{name}::")).is_empty();
            assert!(!used || homes.contains(&source.module()), "{path:?} uses {name}");
        }
        let seen = names_after(text, "ferry_core::");
        let banned = seen.iter().find(|name| *krate == "camera" && NOT_IN_CAMERA.contains(&name.as_str()));
        assert!(banned.is_none(), "{path:?} imports {banned:?}");
    }
}

#[test]
fn sockets_and_bodies_of_clients_are_read_in_one_place() {
    let (mut homes, mut handlers) = (0, 0);
    for source in sources().iter().filter(|source| source.module() == "http") {
        let path = &source.path;
        let code = source.code();
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
fn nothing_in_the_core_reads_a_clock_a_global_a_file_or_an_unseeded_generator() {
    for source in sources().iter().filter(|source| source.krate == "core") {
        // Tests may measure; modules of tests close their files.
        let is_test = source.inside.contains("test");
        for impure in IMPURE {
            assert!(is_test || !source.code().contains(impure), "{:?} uses {impure}", source.path);
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
