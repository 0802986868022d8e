//! The input log (`.ferry`): inputs, decisions and hashes of trials, enough to run them again.
//!
//! A file is `ferrylog`, the format's version (32 bits, little-endian), and frames. A frame is its payload's length (32
//! bits), a check of that length (32 bits), the payload, the payload's hash (64 bits), and a seal: the byte at which the
//! frame ends (64 bits) and a check of it (64 bits). A payload is deflated (RFC 1951) and contains CBOR items (RFC 8949),
//! each an [`Entry`] with its fields' names. Hashes are XXH3, each seeded with the previous one. This distinguishes a
//! truncated file from an edited one, and detects a missing frame. A seal does not depend on the frames before it: when a
//! part of the file is missing, the seals after the gap still tell where they should be.

use std::io::{Read, Write};
use std::path::Path;

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use super::entry::{Entry, LoggedBeginning, LoggedMap};
use crate::files::{ReadError, read_at_most};

/// Format version. Increase it when an older reader would misread a file.
const VERSION: u32 = 8;
const MAGIC: &[u8; 8] = b"ferrylog";
const FRAME_HEAD: usize = 8;
/// Bytes of a seal.
const SEAL: usize = 16;
/// Maximum file size. A session starts a new file every ten minutes; at 64× speed it reaches a third of this.
const BYTES_MOST: u64 = 1 << 30;
/// Maximum unpacked size of all frames together, as protection against compressed bombs.
const UNPACKED_MOST: u64 = 2 << 30;

#[derive(Debug, thiserror::Error)]
pub enum LogError {
    #[error("log: not a Ferry input log: it begins with {0:?}")]
    Foreign(String),
    /// Written by another version.
    #[error("log: version {found}, this Ferry reads version {VERSION}")]
    Version {
        /// The version found.
        found: u32,
    },
    /// The content does not match its hashes.
    #[error(
        "log: damaged or edited after {ticks} whole ticks: the frame at byte {byte} has changed since it was written ({what})"
    )]
    Damaged {
        /// Offset of the frame.
        byte: usize,
        /// Intact ticks before it.
        ticks: usize,
        /// How the frame differs.
        what: String,
    },
    /// It contains no complete frame.
    #[error("log: it ends before its first trial")]
    Empty,
    #[error("log: {0}")]
    Io(#[from] std::io::Error),
    /// The file is larger than a log can be.
    #[error("log: {0}")]
    Unread(#[from] ReadError),
    /// The unpacked content is too large.
    #[error("log: the frame at byte {byte} and those before it unpack to more than the limit of {most} bytes")]
    TooLong {
        /// Where the frame begins.
        byte: usize,
        most: u64,
    },
    /// A value could not be encoded as CBOR.
    #[error("log: {0}")]
    Encode(String),
}

/// Writes a log, frame by frame. After a crash all complete frames stay readable.
#[derive(Debug)]
pub struct LogWriter<W> {
    out: W,
    hash: u64,
    /// Bytes written so far.
    length: u64,
    /// The map of the previous beginning.
    map: Option<LoggedMap>,
}

impl<W: Write> LogWriter<W> {
    /// Writes the file header.
    pub fn new(mut out: W) -> Result<Self, LogError> {
        out.write_all(MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        Ok(Self { out, hash: u64::from(VERSION), length: (MAGIC.len() + size_of_val(&VERSION)) as u64, map: None })
    }

    /// Writes entries as one frame, with a single write.
    pub fn append(&mut self, entries: Vec<Entry>) -> Result<(), LogError> {
        let mut payload = DeflateEncoder::new(Vec::new(), Compression::fast());
        for mut entry in entries {
            if let Entry::Begin(beginning) = &mut entry {
                self.leave_out_known_map(beginning);
            }
            ciborium::into_writer(&entry, &mut payload).map_err(|error| LogError::Encode(error.to_string()))?;
        }
        let payload = payload.finish()?;
        let length = (payload.len() as u32).to_le_bytes();
        let mut frame = Vec::with_capacity(FRAME_HEAD + payload.len() + size_of::<u64>() + SEAL);
        frame.extend(length);
        frame.extend(length_check(length, self.hash));
        self.hash = xxh3_64_with_seed(&payload, self.hash);
        frame.extend(payload);
        frame.extend(self.hash.to_le_bytes());
        self.length += (frame.len() + SEAL) as u64;
        frame.extend(seal(self.length));
        self.out.write_all(&frame)?;
        Ok(self.out.flush()?)
    }

    fn leave_out_known_map(&mut self, beginning: &mut LoggedBeginning) {
        if beginning.map == self.map {
            beginning.map = None;
        } else {
            self.map.clone_from(&beginning.map);
        }
    }
}

fn length_check(length: [u8; 4], seed: u64) -> [u8; 4] {
    (xxh3_64_with_seed(&length, seed) as u32).to_le_bytes()
}

/// States that a frame ends at byte `end`.
fn seal(end: u64) -> [u8; SEAL] {
    let end = end.to_le_bytes();
    let mut seal = [0; SEAL];
    seal[..8].copy_from_slice(&end);
    seal[8..].copy_from_slice(&xxh3_64_with_seed(&end, u64::from_le_bytes(*MAGIC)).to_le_bytes());
    seal
}

/// Where a frame ended when it was written, from a seal at the beginning of `bytes`.
fn sealed_end(bytes: &[u8]) -> Option<u64> {
    let end = u64::from_le_bytes(*bytes.first_chunk()?);
    bytes.starts_with(&seal(end)).then_some(end)
}

#[derive(Clone, Debug, PartialEq)]
pub struct InputLog {
    /// The entries; the first one is a beginning.
    pub entries: Vec<Entry>,
    /// Size of an incomplete last frame.
    pub torn_bytes: usize,
}

impl InputLog {
    /// Version of the file format.
    pub const VERSION: u32 = VERSION;

    /// Reads a log from a file.
    ///
    /// # Errors
    /// Those of [`Self::read`]; a file over 1 GiB is rejected without reading it.
    pub fn open(path: &Path) -> Result<Self, LogError> {
        Self::read(&read_at_most(path, BYTES_MOST)?)
    }

    /// Reads a log to its end, or to its last complete frame if it is truncated.
    pub fn read(bytes: &[u8]) -> Result<Self, LogError> {
        Self::read_at_most(bytes, UNPACKED_MOST)
    }

    fn read_at_most(bytes: &[u8], most: u64) -> Result<Self, LogError> {
        let start = &bytes[..bytes.len().min(MAGIC.len())];
        if !MAGIC.starts_with(start) {
            return Err(LogError::Foreign(String::from_utf8_lossy(start).into_owned()));
        }
        let Some((version, mut rest)) = bytes.get(MAGIC.len()..).and_then(<[u8]>::split_first_chunk) else {
            return Err(LogError::Empty);
        };
        let found = u32::from_le_bytes(*version);
        if found != VERSION {
            return Err(LogError::Version { found });
        }
        let (mut entries, mut hash) = (Vec::new(), u64::from(VERSION));
        let mut left = most;
        loop {
            let byte = bytes.len() - rest.len();
            let frame = whole_frame(rest, hash, byte).map_err(|what| damaged(byte, &entries, what))?;
            let Some((payload, next_hash, after)) = frame else { break };
            let unpacked = unpack(payload, left).map_err(|error| damaged(byte, &entries, &error.to_string()))?;
            left = left.checked_sub(unpacked.len() as u64).ok_or(LogError::TooLong { byte, most })?;
            read_entries(&unpacked, &mut entries).map_err(|what| damaged(byte, &entries, &what))?;
            (hash, rest) = (next_hash, after);
        }
        // An incomplete frame at the end has no seal. One that has, ended elsewhere when it was written.
        if rest.windows(SEAL).any(|bytes| sealed_end(bytes).is_some()) {
            return Err(damaged(bytes.len() - rest.len(), &entries, "a part of the file is missing, but not its end"));
        }
        if entries.is_empty() {
            return Err(LogError::Empty);
        }
        Ok(Self { entries, torn_bytes: rest.len() })
    }
}

fn damaged(byte: usize, entries: &[Entry], what: &str) -> LogError {
    let ticks = entries.iter().filter(|entry| matches!(entry, Entry::Tick(_))).count();
    LogError::Damaged { byte, ticks, what: what.to_owned() }
}

/// The payload, its hash, and the remaining bytes; `None` if the frame is truncated.
type Frame<'a> = (&'a [u8], u64, &'a [u8]);

/// Reads the frame at byte `at` of the file.
fn whole_frame(bytes: &[u8], hash: u64, at: usize) -> Result<Option<Frame<'_>>, &'static str> {
    let Some((&head, rest)) = bytes.split_first_chunk::<FRAME_HEAD>() else { return Ok(None) };
    let [a, b, c, d, check @ ..] = head;
    let length = [a, b, c, d];
    if check != length_check(length, hash) {
        return Err("its length");
    }
    let Some((payload, rest)) = rest.split_at_checked(u32::from_le_bytes(length) as usize) else { return Ok(None) };
    let Some((&written, rest)) = rest.split_first_chunk() else { return Ok(None) };
    let Some((written_seal, rest)) = rest.split_at_checked(SEAL) else { return Ok(None) };
    let hash = xxh3_64_with_seed(payload, hash);
    if hash != u64::from_le_bytes(written) {
        return Err("its hash");
    }
    if sealed_end(written_seal) != Some((at + bytes.len() - rest.len()) as u64) {
        return Err("its seal");
    }
    Ok(Some((payload, hash, rest)))
}

/// Unpacks at most `most` + 1 bytes.
fn unpack(payload: &[u8], most: u64) -> std::io::Result<Vec<u8>> {
    let mut unpacked = Vec::new();
    DeflateDecoder::new(payload).take(most + 1).read_to_end(&mut unpacked)?;
    Ok(unpacked)
}

fn read_entries(mut rest: &[u8], entries: &mut Vec<Entry>) -> Result<(), String> {
    while !rest.is_empty() {
        let entry: Entry = ciborium::from_reader(&mut rest).map_err(|error| error.to_string())?;
        if entries.is_empty() && !matches!(&entry, Entry::Begin(beginning) if beginning.map.is_some()) {
            return Err("it does not begin with a trial".to_owned());
        }
        entries.push(entry);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
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
        Entry::Begin(Box::new(LoggedBeginning {
            scenario: Scenario::idle("open", 3),
            map,
            policy_hash: None,
            state: None,
        }))
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

    #[test]
    fn rejects_a_small_file_that_unpacks_to_a_huge_one() {
        let (bytes, ends, _) = written();
        let whole = unpack(&bytes[12 + FRAME_HEAD..ends[0] - SEAL - 8], 1 << 20).unwrap().len() as u64;
        let error = InputLog::read_at_most(&bytes, whole).unwrap_err();
        assert!(matches!(error, LogError::TooLong { byte, most } if (byte, most) == (ends[0], whole)), "{error}");
        // Unpacking stops one byte above the limit.
        let mut packed = DeflateEncoder::new(Vec::new(), Compression::best());
        packed.write_all(&[0; 1 << 20]).unwrap();
        let packed = packed.finish().unwrap();
        assert!(packed.len() < 2000 && unpack(&packed, 100).unwrap().len() == 101);
    }

    #[test]
    fn rejects_a_too_large_file_without_reading_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large.ferry");
        std::fs::File::create(&path).unwrap().set_len(BYTES_MOST + 1).unwrap();
        let error = InputLog::open(&path).unwrap_err();
        assert!(matches!(error, LogError::Unread(ReadError::TooLarge { .. })), "{error}");
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
}
