//! What a part contains, and its title: a small file beside the part, read for the list.

use std::path::Path;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::{Opening, RecordingError, Sample};
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{EventKind, Phase};
use ferry_files::{read_at_most, replace};

/// Longest title.
const MAX_TITLE_CHARS: usize = 80;
/// Largest file: titles and names of maps are short.
const MAX_BYTES: u64 = 8 << 10;
/// Further maps of a part are not listed.
const MAX_MAPS: usize = 32;
const WRITE_EVERY: Duration = Duration::from_secs(1);

/// What a part contains so far.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Content {
    /// Maps on which time passed, in order of appearance.
    pub maps: Vec<String>,
    /// Controllers that had a goal, in order of appearance.
    pub controllers: Vec<ControllerName>,
    /// Number of deliveries.
    pub delivered: u32,
    /// Number of goals that were given up, by a limit or a lift-off.
    pub not_delivered: u32,
    /// Number of recorded ticks.
    pub ticks: u64,
}

impl Content {
    /// Simulated time; the time in which a session is paused does not count.
    pub fn duration_s(&self) -> f64 {
        self.ticks as f64 * SERVO_PERIOD_S
    }
}

/// The content of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct About {
    pub title: Option<String>,
    pub content: Option<Content>,
}

impl About {
    /// A missing or damaged file says nothing.
    pub fn read(path: &Path) -> Self {
        // Opening a pipe would wait for its writer.
        let is_file = std::fs::metadata(path).is_ok_and(|data| data.is_file());
        let bytes = is_file.then(|| read_at_most(path, MAX_BYTES).ok()).flatten();
        let about: Option<Self> = bytes.and_then(|bytes| serde_json::from_slice(&bytes).ok());
        let is_sound = |about: &Self| about.title.as_ref().is_none_or(|text| title(text).ok().flatten().is_some());
        about.filter(is_sound).unwrap_or_default()
    }

    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        replace(path, &serde_json::to_vec(self).map_err(std::io::Error::other)?)
    }
}

/// A title without the spaces at its ends; `None` if nothing is left.
pub(super) fn title(text: &str) -> Result<Option<String>, RecordingError> {
    let text = text.trim();
    let chars = text.chars().count();
    if chars > MAX_TITLE_CHARS {
        return Err(RecordingError::LongTitle { chars, max: MAX_TITLE_CHARS });
    }
    if let Some(found) = text.chars().find(|found| found.is_control()) {
        return Err(RecordingError::ControlInTitle { found });
    }
    Ok((!text.is_empty()).then(|| text.to_owned()))
}

/// How the task with the current goal ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Outcome {
    #[default]
    Open,
    Delivered,
    /// It may still be delivered. `counted`: in this part.
    NotDelivered {
        counted: bool,
    },
}

/// Collects what a part contains.
#[derive(Default)]
pub(super) struct Notes {
    content: Content,
    map: String,
    outcome: Outcome,
    /// Since the last write.
    changed: bool,
    written: Option<Instant>,
}

impl Notes {
    /// Time until the file should be written again.
    pub fn wait(&self) -> Duration {
        match self.written {
            _ if !self.changed => Duration::MAX,
            Some(written) => WRITE_EVERY.saturating_sub(written.elapsed()),
            None => Duration::ZERO,
        }
    }

    /// The content to write; `None` if it is written.
    pub fn take(&mut self) -> Option<&Content> {
        let changed = std::mem::replace(&mut self.changed, false);
        changed.then(|| {
            self.written = Some(Instant::now());
            &self.content
        })
    }

    pub fn begin(&mut self, opening: &Opening) {
        self.changed = true;
        opening.arena.map.name().clone_into(&mut self.map);
        self.outcome = match opening.logged.state.as_ref().map(|state| state.world.phase) {
            Some(Phase::Delivered) => Outcome::Delivered,
            Some(Phase::Stopped(_) | Phase::LiftedOff) => Outcome::NotDelivered { counted: false },
            _ => Outcome::Open,
        };
    }

    pub fn tick(&mut self, sample: Option<&Sample>) {
        self.changed = true;
        self.content.ticks += 1;
        let maps = &mut self.content.maps;
        if maps.len() < MAX_MAPS && !maps.contains(&self.map) {
            maps.push(self.map.clone());
        }
        let Some(Sample { moment, events, .. }) = sample else { return };
        if moment.goal_m.is_some() && !self.content.controllers.contains(&moment.controller) {
            self.content.controllers.push(moment.controller);
        }
        for event in events {
            self.event(event.kind(), moment.goal_m.is_some());
        }
    }

    fn event(&mut self, kind: EventKind, has_goal: bool) {
        match (kind, self.outcome) {
            (EventKind::Goal, _) => self.outcome = Outcome::Open,
            (EventKind::Delivered, outcome) => {
                self.content.delivered += 1;
                self.content.not_delivered -= u32::from(outcome == Outcome::NotDelivered { counted: true });
                self.outcome = Outcome::Delivered;
            }
            (EventKind::Stopped | EventKind::LiftOff, Outcome::Open) if has_goal => {
                self.content.not_delivered += 1;
                self.outcome = Outcome::NotDelivered { counted: true };
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcomes(kinds: &[EventKind]) -> (u32, u32) {
        let mut notes = Notes::default();
        for &kind in kinds {
            notes.event(kind, true);
        }
        (notes.content.delivered, notes.content.not_delivered)
    }

    #[test]
    fn a_goal_counts_as_delivered_or_not_delivered() {
        use EventKind::{Delivered, Goal, LiftOff, Reached, Stopped, Switch};
        assert_eq!(outcomes(&[Goal, Switch, Reached, Delivered, Goal, Stopped]), (1, 1));
        assert_eq!(outcomes(&[Goal, Stopped, Stopped, LiftOff]), (0, 1), "one goal");
        assert_eq!(outcomes(&[Goal, Stopped, Delivered]), (1, 0), "late, but delivered");
        assert_eq!(outcomes(&[Goal, Delivered, LiftOff]), (1, 0), "lifted off afterwards");
        assert_eq!(outcomes(&[Goal, Delivered, Delivered]), (2, 0), "moved away and delivered again");
        let mut notes = Notes::default();
        notes.event(LiftOff, false);
        assert_eq!(notes.content.not_delivered, 0, "without a goal");
        notes.outcome = Outcome::NotDelivered { counted: false };
        notes.event(Delivered, true);
        assert_eq!((notes.content.delivered, notes.content.not_delivered), (1, 0), "given up in the part before");
    }

    #[test]
    fn the_file_is_due_when_something_has_changed() {
        let mut notes = Notes::default();
        assert_eq!((notes.wait(), notes.take().is_some()), (Duration::MAX, false));
        notes.tick(None);
        assert_eq!(notes.wait(), Duration::ZERO);
        assert_eq!(notes.take().map(Content::duration_s), Some(SERVO_PERIOD_S));
        notes.tick(None);
        assert!(notes.wait() > Duration::ZERO && notes.wait() <= WRITE_EVERY);
    }

    #[test]
    fn a_title_is_short_and_has_no_control_characters() {
        assert_eq!(title("  Ünsal’s run ").unwrap().as_deref(), Some("Ünsal’s run"));
        assert_eq!(title(" \t\n").unwrap(), None);
        assert!(title(&"ä".repeat(MAX_TITLE_CHARS)).unwrap().is_some());
        let long = title(&"a".repeat(MAX_TITLE_CHARS + 1)).unwrap_err().to_string();
        assert!(long.contains("81 characters") && long.contains("80"), "{long}");
        for bad in ["a\nb", "a\0b", "a\u{9b}b"] {
            assert!(title(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn a_damaged_file_says_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.about.json");
        let about = About {
            title: Some("mine".to_owned()),
            content: Some(Content { maps: vec!["colon".to_owned()], ticks: 125, ..Content::default() }),
        };
        assert_eq!(About::read(&path), About::default());
        about.write(&path).unwrap();
        assert_eq!(About::read(&path), about);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
        let whole = std::fs::read_to_string(&path).unwrap();
        for damaged in [
            whole[..whole.len() - 1].to_owned(),
            whole.replace("mine", "mi\\u0000ne"),
            whole.replace("mine", &"m".repeat(81)),
            whole.replace("125", "-1"),
            whole.replace("mine", &"m".repeat(9000)),
            "[".repeat(8000),
            "\u{feff}{}".to_owned(),
        ] {
            std::fs::write(&path, &damaged).unwrap();
            assert_eq!(About::read(&path), About::default(), "{damaged:.60}");
        }
        std::fs::write(&path, "{\"title\":\"of a later version\",\"more\":[1]}").unwrap();
        assert_eq!(About::read(&path).title.as_deref(), Some("of a later version"));
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        assert_eq!(About::read(&path), About::default());
    }
}
