//! The changes of a list, for all that wait for one.

use tokio::sync::watch;

/// Of one list. Its owner notes each change; a receiver that is slow sees only that there were some.
#[derive(Clone, Debug, Default)]
pub struct Changes(watch::Sender<u64>);

impl Changes {
    pub fn note(&self) {
        self.0.send_modify(|number| *number += 1);
    }

    /// The number of changes so far.
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.0.subscribe()
    }
}
