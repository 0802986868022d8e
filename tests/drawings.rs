//! `tests/drawings`: what Ferry reads, notes and refuses. A test in the browser compares the walls.

use std::collections::BTreeMap;
use std::path::Path;

use ferry_core::map::{Map, MapError};
use ferry_files::open;

const FOLDER: &str = "tests/drawings";

fn read(name: &str) -> Result<Map, MapError> {
    open::map(&Path::new(FOLDER).join(format!("{name}.svg")).to_string_lossy())
}

/// What `docs/maps.md` says of each kind of drawing.
#[test]
fn the_table_in_the_documentation_is_true() {
    let text = std::fs::read_to_string("docs/maps.md").unwrap();
    let rows = text.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, _, examples, outcome @ ("read" | "noted" | "refused"), _] = cells[..] else { return None };
        Some((examples.split('`').skip(1).step_by(2), outcome))
    });
    let mut count = 0;
    for (examples, outcome) in rows {
        for name in examples {
            count += 1;
            let is = match read(name) {
                Ok(map) if map.repairs().is_empty() => "read",
                Ok(_) => "noted",
                Err(MapError::Io { error, .. }) => panic!("{name}: {error}"),
                Err(_) => "refused",
            };
            assert_eq!(is, outcome, "{name}");
        }
    }
    assert!(count > 70, "{count}");
}

#[test]
fn each_drawing_is_read_or_refused_for_its_reason() {
    let expected = std::fs::read(Path::new(FOLDER).join("index.json")).unwrap();
    let expected: BTreeMap<String, String> = serde_json::from_slice(&expected).unwrap();
    let names = std::fs::read_dir(FOLDER).unwrap().filter_map(|entry| {
        let name = entry.unwrap().file_name().into_string().unwrap();
        name.strip_suffix(".svg").map(str::to_owned)
    });
    let mut wrong = Vec::new();
    for name in names {
        let expected = expected.get(&name).map_or("same", String::as_str);
        let reason = expected.strip_prefix("refused: ");
        match (read(&name), reason) {
            (Ok(_), None) => {}
            (Err(error), Some(reason)) if error.to_string().contains(reason) => {}
            (Err(_), None) if expected == "any" => {}
            (found, _) => wrong.push(format!("{name}: {:?}, but {expected}", found.map_err(|error| error.to_string()))),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
