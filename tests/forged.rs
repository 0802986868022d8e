//! Logs with changed numbers, and with the hashes that belong to them.

use std::time::Duration;

use ciborium::Value;
use ferry::session::SessionHandle;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::session::{Command, Opening};
use ferry_core::trial::{Catalog, Entry, Input, InputLog};
use ferry_recording::{Archive, Options, Recorder, Retention};
use flate2::{Compression, write::DeflateEncoder};
use rayon::prelude::*;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use crate::logs::logs;
use crate::support::{ended_at_once, gpu};

/// A log with one frame.
fn log_of(entries: &[Value]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::fast());
    for entry in entries {
        ciborium::into_writer(entry, &mut encoder).unwrap();
    }
    let payload = encoder.finish().unwrap();
    let mut log = b"ferrylog".to_vec();
    log.extend(InputLog::VERSION.to_le_bytes());
    let seed = u64::from(InputLog::VERSION);
    let length = (payload.len() as u32).to_le_bytes();
    log.extend(length);
    log.extend((xxh3_64_with_seed(&length, seed) as u32).to_le_bytes());
    log.extend(&payload);
    log.extend(xxh3_64_with_seed(&payload, seed).to_le_bytes());
    let end = (log.len() as u64 + 16).to_le_bytes();
    log.extend(end);
    log.extend(xxh3_64_with_seed(&end, u64::from_le_bytes(*b"ferrylog")).to_le_bytes());
    log
}

/// The numbers of a value, with their fields; of a list those of the first, because the others are read alike.
fn numbers(value: &mut Value) -> Vec<(String, &mut Value)> {
    match value {
        Value::Integer(_) | Value::Float(_) => vec![(String::new(), value)],
        Value::Array(values) => values.iter_mut().take(1).flat_map(numbers).collect(),
        Value::Map(fields) => {
            let each = fields.iter_mut().map(|(name, value)| (name.as_text().unwrap_or_default(), numbers(value)));
            each.flat_map(|(name, found)| found.into_iter().map(move |(field, one)| (format!("{name} {field}"), one)))
                .collect()
        }
        _ => Vec::new(),
    }
}

/// The first two entries of a part: a state, with everything that it can contain, and a tick.
fn part() -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let archive = Archive::new(folder.path().to_owned(), Retention::default());
    let options = Options { part: Duration::from_millis(250), ..Options::LIVE };
    let recorder = Recorder::in_archive(&archive, "main", options).unwrap();
    let scenario = Scenario { controller: ControllerName::Errt, disturbances: 2, ..Scenario::idle("posts", 1) };
    let session =
        SessionHandle::start("main", scenario, Opening::Fresh, Catalog::default(), gpu(), Box::new(recorder)).unwrap();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
    let obey = |command| runtime.block_on(session.send(command)).unwrap();
    obey(Command::Input(Input::SetGoal { x_m: 0.12, y_m: -0.33 }));
    for _ in 0..10 {
        obey(Command::Step(20));
        std::thread::sleep(Duration::from_millis(30));
    }
    drop(session);
    let mut parts = logs(folder.path()).into_iter().filter_map(|bytes| Some(InputLog::read(&bytes).ok()?.entries));
    let entries = parts.find(|entries| matches!(&entries[0], Entry::Begin(begun) if begun.state.is_some()));
    let entries = entries.expect("a second part");
    entries[..2].iter().map(|entry| Value::serialized(entry).unwrap()).collect()
}

#[test]
fn a_log_with_a_forged_number_ends_at_once() {
    let part = part();
    let folder = tempfile::tempdir().unwrap();
    let replayed = |name: &str, entries: &[Value]| {
        let path = folder.path().join(format!("{name}.ferry"));
        std::fs::write(&path, log_of(entries)).unwrap();
        ended_at_once(&["replay", path.to_str().unwrap()])
    };
    let (status, said) = replayed("whole", &part);
    assert!(status.success(), "{said}");
    let values = [Value::from(u64::MAX), Value::from(i64::MIN), Value::from(1.7e308), Value::from(u32::MAX)];
    let count = part.clone().iter_mut().map(|entry| numbers(entry).len()).sum::<usize>();
    assert!(count > 100, "{count} numbers");
    let refused: usize = (0..count * values.len())
        .into_par_iter()
        .map(|case| {
            let mut forged = part.clone();
            let mut found: Vec<_> = forged.iter_mut().flat_map(numbers).collect();
            let (field, number) = &mut found[case / values.len()];
            **number = values[case % values.len()].clone();
            let what = format!("{field}: {number:?}");
            let (status, said) = replayed(&case.to_string(), &forged);
            assert!(status.code().is_some_and(|code| code < 2), "{what}: {status}: {said}");
            usize::from(!status.success())
        })
        .sum();
    // Few numbers can have any value.
    assert!(refused > count * values.len() * 9 / 10, "{refused} of {count} × {}", values.len());
}
