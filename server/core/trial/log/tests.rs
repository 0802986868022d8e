use super::*;
use crate::map::Map;
use crate::scenario::Scenario;
use crate::trial::{Input, LoggedTick};

fn tick(tick: u64) -> Entry {
    Entry::Tick(LoggedTick {
        tick,
        inputs: vec![Input::SetGoal { x_m: 0.1, y_m: -0.3 + tick as f64 * 1e-3 }],
        decision: None,
        world_hash: 7 + tick,
        fields: vec![1, 2, 3],
        controller_hash: 9,
    })
}

fn beginning() -> Entry {
    let map = Some(LoggedMap::from(&Map::shipped("open").unwrap()));
    Entry::Begin(Box::new(LoggedBeginning { scenario: Scenario::idle("open", 3), map, policy_hash: None, state: None }))
}

fn written() -> (Vec<u8>, Vec<usize>, Vec<Entry>) {
    let (mut bytes, mut ends, mut entries) = (Vec::new(), Vec::new(), Vec::new());
    let mut writer = LogWriter::new(&mut bytes).unwrap();
    for frame in [vec![beginning(), tick(1)], vec![tick(2), tick(3)], vec![beginning(), tick(1)]] {
        entries.extend(frame.clone());
        writer.append(frame).unwrap();
        ends.push(writer.out.len());
    }
    // The second time the map is already known.
    if let Entry::Begin(beginning) = &mut entries[4] {
        beginning.map = None;
    }
    (bytes, ends, entries)
}

#[test]
fn a_truncated_log_reads_to_its_last_complete_frame() {
    let (bytes, ends, entries) = written();
    assert_eq!(InputLog::read(&bytes).unwrap(), InputLog { entries: entries.clone(), torn_bytes: 0 });
    for cut in 0..bytes.len() {
        let whole = ends.iter().filter(|&&end| end <= cut).count();
        match InputLog::read(&bytes[..cut]) {
            Ok(log) => {
                assert_eq!(log.entries, entries[..2 * whole], "cut at {cut}");
                assert_eq!(log.torn_bytes, cut - ends[whole - 1]);
            }
            Err(LogError::Empty) => assert_eq!(whole, 0, "cut at {cut}"),
            Err(error) => panic!("cut at {cut}: {error}"),
        }
    }
}

#[test]
#[ignore = "long"]
fn a_log_that_was_cut_in_its_middle_and_glued_is_told_from_one_that_ends_early() {
    let (bytes, ends, _) = written();
    let (mut misread, mut read) = (Vec::new(), 0);
    for from in 12..bytes.len() {
        // Every frame's end, its seal, its payload, and the next frame's head are met.
        for to in from + 1..=bytes.len() - SEAL {
            let glued = [&bytes[..from], &bytes[to..]].concat();
            if !matches!(InputLog::read(&glued), Err(LogError::Damaged { .. })) {
                misread.push((from, to));
            }
            read += 1;
        }
    }
    assert!(misread.is_empty() && read > 10_000, "{misread:?} of {read}; frames end at {ends:?}");
}

#[test]
fn rejects_any_edited_bit_with_its_offset() {
    let (bytes, ends, _) = written();
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut edited = bytes.clone();
            edited[at] ^= 1 << bit;
            let error = InputLog::read(&edited).expect_err("an edited log");
            match error {
                LogError::Foreign(_) => assert!(at < 8),
                LogError::Version { .. } => assert!((8..12).contains(&at)),
                LogError::Damaged { byte, ticks, .. } => {
                    let before = ends.iter().filter(|&&end| end <= at).count();
                    let begin = if before == 0 { 12 } else { ends[before - 1] };
                    assert_eq!((byte, ticks), (begin, [0, 1, 3][before]));
                }
                error => panic!("byte {at}: {error}"),
            }
        }
    }
}

fn without_parameters(value: ciborium::Value) -> ciborium::Value {
    use ciborium::Value::{Array, Map};
    match value {
        Map(fields) => Map(fields
            .into_iter()
            .map(|(name, value)| match name.as_text() {
                Some("configure") => (name, Map(Vec::new())),
                _ => (name, without_parameters(value)),
            })
            .collect()),
        Array(values) => Array(values.into_iter().map(without_parameters).collect()),
        other => other,
    }
}

#[test]
fn rejects_a_small_file_that_unpacks_to_a_huge_one() {
    // As a session never writes it.
    let forged = |plain: &[u8]| {
        let mut writer = LogWriter::new(Vec::new()).unwrap();
        writer.append(vec![beginning()]).unwrap();
        let begins_at = writer.out.len();
        writer.write(&packed(plain, Compression::best()).unwrap()).unwrap();
        let bytes = writer.out.len() as u64;
        match InputLog::read(&writer.out).unwrap_err() {
            LogError::TooLong { byte, most } if byte == begins_at => (most, bytes),
            error => panic!("{error}"),
        }
    };
    let mut ticks = Vec::new();
    for _ in 0..300_000 {
        ciborium::into_writer(&tick(2), &mut ticks).unwrap();
    }
    let (most, bytes) = forged(&ticks);
    assert_eq!(most, UNPACKED_FREE + UNPACKED_RATIO * bytes);
    let configured = Entry::Tick(LoggedTick {
        inputs: vec![Input::Configure(Box::default()); 90_000],
        ..serde_json::from_value(serde_json::json!({"tick": 1, "world_hash": 1, "fields": [], "mind_hash": 1})).unwrap()
    });
    let mut small = Vec::new();
    // All parameters have defaults.
    let entry = ciborium::Value::serialized(&configured).unwrap();
    ciborium::into_writer(&without_parameters(entry), &mut small).unwrap();
    let (most, bytes) = forged(&small);
    assert_eq!(most, HELD_FREE + HELD_RATIO * bytes);
}

#[test]
fn rejects_a_missing_or_foreign_frame() {
    let (bytes, ends, _) = written();
    let without = [&bytes[..ends[0]], &bytes[ends[1]..]].concat();
    assert!(matches!(InputLog::read(&without), Err(LogError::Damaged { ticks: 1, .. })));
    let mut newer = bytes.clone();
    newer[8] += 1;
    let error = InputLog::read(&newer).unwrap_err().to_string();
    assert!(error.contains(&format!("version {}, this Ferry reads version {VERSION}", VERSION + 1)), "{error}");
    let error = InputLog::read(b"RRF2 and so on").unwrap_err().to_string();
    assert!(error.contains("RRF2"), "{error}");
}
