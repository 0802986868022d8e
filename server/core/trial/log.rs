//! The input log (`.ferry`): inputs, decisions and hashes of trials, enough to run them again.
//!
//! A file is `ferrylog`, the format's version (32 bits, little-endian), and frames. A frame is its payload's length (32
//! bits), a check of that length (32 bits), the payload, the payload's hash (64 bits), and a seal: the byte at which the
//! frame ends (64 bits) and a check of it (64 bits). A payload is deflated (RFC 1951) and contains CBOR items (RFC 8949),
//! each an [`Entry`] with its fields' names. Hashes are XXH3, each seeded with the previous one. This distinguishes a
//! truncated file from an edited one, and detects a missing frame. A seal does not depend on the frames before it: when a
//! part of the file is missing, the seals after the gap still tell where they should be.

#[cfg(test)]
mod tests;

use std::io::{BufRead, BufReader, Read, Write};

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use super::entry::{Entry, LoggedBeginning, LoggedMap};

/// Format version. Increase it when an older reader would misread a file.
const VERSION: u32 = 8;
const MAGIC: &[u8; 8] = b"ferrylog";
const FRAME_HEAD: usize = 8;
/// Bytes of a seal.
const SEAL: usize = 16;
/// Maximum unpacked size of frames: so much, and a multiple of their packed size. Logs of sessions unpack to four times
/// their size; a frame that would unpack to more than this multiple is not packed.
const UNPACKED_FREE: u64 = 4 << 20;
const UNPACKED_RATIO: u64 = 8;
/// The same for the memory of the entries.
const HELD_FREE: u64 = 32 << 20;
const HELD_RATIO: u64 = 32;

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
    #[error("log: it has {bytes} bytes, the limit is {max}")]
    TooLarge { bytes: u64, max: u64 },
    /// The unpacked content is too large.
    #[error(
        "log: the frame at byte {byte} and those before it need more than {most} bytes of memory, as no log of a session does"
    )]
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
        let mut plain = Vec::new();
        for mut entry in entries {
            if let Entry::Begin(beginning) = &mut entry {
                self.leave_out_known_map(beginning);
            }
            ciborium::into_writer(&entry, &mut plain).map_err(|error| LogError::Encode(error.to_string()))?;
        }
        let mut payload = packed(&plain, Compression::fast())?;
        if plain.len() as u64 > UNPACKED_RATIO * payload.len() as u64 {
            payload = packed(&plain, Compression::none())?;
        }
        self.write(&payload)
    }

    fn write(&mut self, payload: &[u8]) -> Result<(), LogError> {
        let length = (payload.len() as u32).to_le_bytes();
        let mut frame = Vec::with_capacity(FRAME_HEAD + payload.len() + size_of::<u64>() + SEAL);
        frame.extend(length);
        frame.extend(length_check(length, self.hash));
        self.hash = xxh3_64_with_seed(payload, self.hash);
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

    /// Reads a log to its end, or to its last complete frame if it is truncated.
    pub fn read(bytes: &[u8]) -> Result<Self, LogError> {
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
        let (mut unpacked, mut held) = (0, 0);
        loop {
            let byte = bytes.len() - rest.len();
            let frame = whole_frame(rest, hash, byte).map_err(|what| damaged(byte, &entries, what))?;
            let Some((payload, next_hash, after)) = frame else { break };
            let so_far = (bytes.len() - after.len()) as u64;
            let most = UNPACKED_FREE + UNPACKED_RATIO * so_far;
            let held_most = HELD_FREE + HELD_RATIO * so_far;
            let mut reader = BufReader::new(DeflateDecoder::new(payload).take(most.saturating_sub(unpacked)));
            let read = read_entries(&mut reader, &mut entries, |entry| {
                held += entry.bytes();
                held <= held_most
            });
            let reader = reader.into_inner();
            if reader.limit() == 0 {
                return Err(LogError::TooLong { byte, most });
            }
            if held > held_most {
                return Err(LogError::TooLong { byte, most: held_most });
            }
            read.map_err(|what| damaged(byte, &entries, &what))?;
            unpacked = most - reader.limit();
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

fn packed(plain: &[u8], how: Compression) -> std::io::Result<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), how);
    encoder.write_all(plain)?;
    encoder.finish()
}

/// Reads entries while they are unpacked, so that the first wrong one ends it, and the first that is too much.
fn read_entries(
    reader: &mut impl BufRead,
    entries: &mut Vec<Entry>,
    mut has_room: impl FnMut(&Entry) -> bool,
) -> Result<(), String> {
    while !reader.fill_buf().map_err(|error| error.to_string())?.is_empty() {
        let entry: Entry = ciborium::from_reader(&mut *reader).map_err(|error| error.to_string())?;
        if entries.is_empty() && !matches!(&entry, Entry::Begin(beginning) if beginning.map.is_some()) {
            return Err("it does not begin with a trial".to_owned());
        }
        if !has_room(&entry) {
            return Ok(());
        }
        entries.push(entry);
    }
    Ok(())
}
