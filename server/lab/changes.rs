//! The changes of a list, for all that wait for one.

use tokio::sync::watch;

/// Of one list. Its owner notes each change; a receiver that is slow sees only that there were some.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    own: watch::Sender<u64>,
    /// The list that has this one in it.
    whole: Option<watch::Sender<u64>>,
}

impl Changes {
    /// Those of a part of another list.
    pub fn part_of(whole: &Self) -> Self {
        Self { own: watch::Sender::default(), whole: Some(whole.own.clone()) }
    }

    pub fn note(&self) {
        for changes in std::iter::once(&self.own).chain(&self.whole) {
            changes.send_modify(|number| *number += 1);
        }
    }

    /// The number of changes so far.
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.own.subscribe()
    }
}
