//! A file of Rerun's, written with its own encoder. Rows wait in memory until they are flushed: rows of one entity that
//! are written together take less space and time.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use re_chunk::{Chunk, ChunkError, ChunkId, PendingRow, RowId};
use re_log_encoding::rrd::{FileFlushError, FileSink};
use re_log_types::{EntityPath, LogMsg, SetStoreInfo, StoreId, StoreInfo, StoreSource, TimeCell, TimePoint};
use re_sdk_types::archetypes::RecordingInfo;
use re_sdk_types::{AsComponents, SerializedComponentColumn};

use super::{RecordingError, trouble};

pub(super) use re_chunk::TimeColumn;

pub(super) const APPLICATION: &str = "ferry";
/// Time limit for Rerun's check of its file.
const CHECK_TIMEOUT: Duration = Duration::from_secs(1);
/// A chunk in the order of all its timelines may have any number of rows, another one this many: Rerun's own limit.
const MAX_UNSORTED_ROWS: u64 = 256;

/// What a file has of one recording, or of a layout.
pub(super) struct Store {
    id: StoreId,
    now: TimePoint,
    rows: BTreeMap<EntityPath, Vec<PendingRow>>,
}

impl Store {
    pub(super) fn new(id: StoreId) -> Self {
        Self { id, now: TimePoint::default(), rows: BTreeMap::new() }
    }

    /// The message that comes first.
    pub(super) fn introduction(&self) -> LogMsg {
        let source = StoreSource::Other("Ferry".to_owned());
        LogMsg::SetStoreInfo(SetStoreInfo { row_id: *RowId::new(), info: StoreInfo::new(self.id.clone(), source) })
    }

    /// Sets the time of the rows that follow, on one timeline.
    pub(super) fn set_time(&mut self, timeline: &'static str, time: TimeCell) {
        self.now.insert_cell(timeline, time);
    }

    /// Adds a row at the present time.
    pub(super) fn log(&mut self, entity: &str, what: &impl AsComponents) {
        self.push(entity.into(), self.now.clone(), what);
    }

    /// Adds what holds at all times.
    pub(super) fn log_static(&mut self, entity: impl Into<EntityPath>, what: &impl AsComponents) {
        self.push(entity.into(), TimePoint::default(), what);
    }

    fn push(&mut self, entity: EntityPath, time: TimePoint, what: &impl AsComponents) {
        self.rows.entry(entity).or_default().push(PendingRow::from_iter(time, what.as_serialized_batches()));
    }

    /// Takes the rows that wait.
    pub(super) fn messages(&mut self) -> Result<Vec<LogMsg>, ChunkError> {
        let rows = std::mem::take(&mut self.rows);
        let chunks =
            rows.into_iter().flat_map(|(entity, rows)| PendingRow::many_into_chunks(entity, MAX_UNSORTED_ROWS, rows));
        chunks.map(|chunk| self.message(&chunk?)).collect()
    }

    fn message(&self, chunk: &Chunk) -> Result<LogMsg, ChunkError> {
        Ok(LogMsg::ArrowMsg(self.id.clone(), chunk.to_arrow_msg()?))
    }
}

/// One open file.
pub(super) struct Stream {
    file: FileSink,
    store: Store,
}

impl Stream {
    /// Creates a file with the messages of a layout. `recording` is the same for all parts, `name` is this part's.
    pub(super) fn create(
        path: &Path,
        recording: &str,
        name: &str,
        layout: Vec<LogMsg>,
    ) -> Result<Self, RecordingError> {
        let file = FileSink::new(path).map_err(trouble)?;
        let mut store = Store::new(StoreId::recording(APPLICATION, recording));
        file.send(store.introduction());
        layout.into_iter().for_each(|message| file.send(message));
        // Without a name the viewer shows "unknown".
        store.log_static(EntityPath::properties(), &RecordingInfo::update_fields().with_name(name));
        Ok(Self { file, store })
    }

    pub(super) fn store(&mut self) -> &mut Store {
        &mut self.store
    }

    /// Writes many times at once, behind the rows that wait.
    pub(super) fn columns(
        &mut self,
        entity: &str,
        times: &[TimeColumn],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), RecordingError> {
        let times = times.iter().map(|column| (*column.timeline().name(), column.clone())).collect();
        let columns = columns.into_iter().map(|column| (column.descriptor, column.list_array)).collect();
        let chunk = Chunk::from_auto_row_ids(ChunkId::new(), entity.into(), times, columns).map_err(trouble)?;
        self.flush()?;
        self.file.send(self.store.message(&chunk).map_err(trouble)?);
        Ok(())
    }

    /// Passes the rows that wait to the file.
    pub(super) fn flush(&mut self) -> Result<(), RecordingError> {
        self.store.messages().map_err(trouble)?.into_iter().for_each(|message| self.file.send(message));
        Ok(())
    }

    /// Whether the file is still writable: its writer only logs errors.
    pub(super) fn check(&self) -> Result<(), RecordingError> {
        match self.file.flush_blocking(CHECK_TIMEOUT) {
            // A slow disk is detected elsewhere.
            Ok(()) | Err(FileFlushError::Timeout) => Ok(()),
            Err(error) => Err(trouble(error)),
        }
    }

    /// Waits until everything is written.
    pub(super) fn close(mut self) -> Result<(), RecordingError> {
        self.flush()?;
        self.file.flush_blocking(Duration::MAX).map_err(trouble)
    }
}
