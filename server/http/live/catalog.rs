//! The lists of the server and the points of a training, for all browsers of all sessions. A list is read and encoded once
//! after it has changed.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Weak};
use std::time::Duration;

use axum::extract::ws::{Message, Utf8Bytes};
use futures_util::FutureExt;
use futures_util::future::select_all;
use tokio::sync::watch;

use super::Connection;
use super::frames::json;
use crate::http::Server;
use crate::http::lists;
use crate::protocol::{
    CatalogMessage, JobPace, Policies, Refusal, ServerMessage, TrainingPoint, TrainingPointsMessage,
};
use ferry_core::facts::RefusalCode;
use ferry_lab::learn::{Point, Training};

/// Shortest time between two messages about the same list.
const EVERY: Duration = Duration::from_millis(250);
/// Interval at which the date is looked at: each day has challenges of its own, and jobs that have ended leave their list.
const DATE_EVERY: Duration = Duration::from_secs(60);

/// In the order in which they are sent: the policy of a training comes before the message that it is done.
#[derive(Clone, Copy)]
enum List {
    Maps,
    Policies,
    Trainings,
    Evaluations,
    Recoveries,
    Programs,
    Challenges,
    Jobs,
    Paces,
}

const ALL: [List; 9] = [
    List::Maps,
    List::Policies,
    List::Trainings,
    List::Evaluations,
    List::Recoveries,
    List::Programs,
    List::Challenges,
    List::Jobs,
    List::Paces,
];

/// The newest message about each list of [`ALL`]; empty before the first one.
pub type Lists = [Utf8Bytes; ALL.len()];

impl List {
    /// Of its owner.
    fn changes(self, server: &Server) -> watch::Receiver<u64> {
        let changes = match self {
            Self::Maps => &server.maps.changes,
            Self::Policies => server.policies.changes(),
            Self::Trainings => server.trainings.changes(),
            Self::Evaluations => server.evaluations.changes(),
            Self::Recoveries => server.recoveries.changes(),
            Self::Programs => &server.programs.changes,
            Self::Challenges => server.contests.changes(),
            Self::Jobs | Self::Paces => &server.jobs.changes,
        };
        changes.watch()
    }

    fn read(self, server: &Server) -> Utf8Bytes {
        json(&ServerMessage::Catalog(match self {
            Self::Maps => CatalogMessage::Maps(server.maps.all.names()),
            Self::Policies => CatalogMessage::Policies(Policies::of(&server.policies).policies),
            Self::Trainings => CatalogMessage::Trainings(lists::trainings(server)),
            Self::Evaluations => CatalogMessage::Evaluations(lists::evaluations(server)),
            Self::Recoveries => CatalogMessage::Recoveries(lists::recoveries(server)),
            Self::Programs => CatalogMessage::Programs(lists::programs(server)),
            Self::Challenges => CatalogMessage::Challenges(lists::challenges(server)),
            Self::Jobs => CatalogMessage::Jobs(lists::jobs(server)),
            Self::Paces => CatalogMessage::Paces(JobPace::all(&server.jobs.paces)),
        }))
    }
}

/// Reads each list once, and again after each change, until the server is gone.
pub async fn keep(server: Weak<Server>) {
    let Some(mut changes) = server.upgrade().map(|server| ALL.map(|list| list.changes(&server))) else { return };
    changes.iter_mut().for_each(watch::Receiver::mark_changed);
    let mut date = lists::today();
    loop {
        let Some(now) = server.upgrade() else { return };
        let reading = tokio::task::spawn_blocking(move || {
            let mut lists = now.lists.borrow().clone();
            // The last one first: what a later list refers to is in an earlier one.
            for ((list, changes), newest) in ALL.into_iter().zip(&mut changes).zip(&mut lists).rev() {
                if changes.has_changed().is_ok_and(|changed| changed) {
                    changes.mark_unchanged();
                    // A panic, which is logged, leaves the last one.
                    if let Ok(read) = catch_unwind(AssertUnwindSafe(|| list.read(&now))) {
                        *newest = read;
                    }
                }
            }
            now.lists.send_if_modified(|before| std::mem::replace(before, lists.clone()) != lists);
            changes
        });
        let Ok(read) = reading.await else { return };
        changes = read;
        tokio::time::sleep(EVERY).await;
        // Copies: the change is still to be seen then.
        let each = changes.clone().map(|mut list| async move { list.changed().await }.boxed());
        match tokio::time::timeout(DATE_EVERY, select_all(each)).await {
            Ok((Ok(()), ..)) => {}
            Ok((Err(_), ..)) => return,
            Err(_) => {
                changes[List::Jobs as usize].mark_changed();
                if std::mem::replace(&mut date, lists::today()) != date {
                    changes[List::Challenges as usize].mark_changed();
                }
            }
        }
    }
}

/// What a browser gets of them.
pub struct Feed {
    lists: watch::Receiver<Lists>,
    sent: Lists,
    trainings: watch::Receiver<u64>,
    watched: Option<Watched>,
}

/// The training that a browser watches, and its points that were sent; `None` before the first message.
struct Watched {
    training: Arc<Training>,
    sent: Option<Vec<Point>>,
}

impl Watched {
    /// The points that are new or other ones.
    fn news(&mut self) -> Option<TrainingPointsMessage> {
        let now = self.training.points();
        let first = first_to_send(self.sent.as_deref(), &now)?;
        let points = now[first..].iter().map(TrainingPoint::from).collect();
        self.sent = Some(now);
        Some(TrainingPointsMessage { training: self.training.id.clone(), first, points })
    }
}

/// The first point that is not the one that was sent; `None` if all are.
fn first_to_send(sent: Option<&[Point]>, now: &[Point]) -> Option<usize> {
    let before = sent.unwrap_or_default();
    let first = before.iter().zip(now).take_while(|(before, now)| before == now).count();
    (sent.is_none() || first < now.len() || first < before.len()).then_some(first)
}

impl Feed {
    pub fn new(server: &Server) -> Self {
        let mut lists = server.lists.subscribe();
        lists.mark_changed();
        Self { lists, sent: Lists::default(), trainings: server.trainings.changes().watch(), watched: None }
    }

    /// Waits until there may be news. Dropping the future loses none.
    pub async fn changed(&mut self) {
        tokio::select! {
            Ok(()) = self.lists.changed() => self.lists.mark_changed(),
            Ok(()) = self.trainings.changed(), if self.watched.is_some() => {}
            else => std::future::pending().await,
        }
    }

    /// Watches the training of this id in place of another one.
    pub fn watch(&mut self, server: &Server, id: Option<String>) -> Result<(), Refusal> {
        let found = id.map(|id| {
            let detail = format!("training is {id:?}, there is no such training");
            let refusal = Refusal::new(RefusalCode::NoTraining, &detail, Some("training"));
            server.trainings.find(&id).ok_or_else(|| refusal.with("training", id))
        });
        self.watched = found.transpose()?.map(|training| Watched { training, sent: None });
        Ok(())
    }

    /// The messages that the browser does not have.
    fn news(&mut self, server: &Server) -> Vec<Utf8Bytes> {
        let mut news = Vec::new();
        if self.lists.has_changed().is_ok_and(|changed| changed) {
            for (newest, sent) in self.lists.borrow_and_update().iter().zip(&mut self.sent) {
                if newest != sent {
                    sent.clone_from(newest);
                    news.push(newest.clone());
                }
            }
        }
        self.watched.take_if(|watched| server.trainings.find(&watched.training.id).is_none());
        let points = self.watched.as_mut().and_then(Watched::news);
        news.extend(points.map(|points| json(&ServerMessage::TrainingPoints(points))));
        news
    }
}

impl Connection {
    pub(super) async fn send_catalog(&mut self) -> Result<(), axum::Error> {
        for message in self.catalog.news(&self.server) {
            self.socket.send(Message::Text(message)).await?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::Settings;
    use crate::http::access::Access;
    use ferry_camera::Gpu;
    use serde_json::Value;

    fn server(folder: &tempfile::TempDir) -> Arc<Server> {
        let access = Access::new("127.0.0.1:80".parse().unwrap(), None, &[]).unwrap();
        let settings = Settings::in_folder(folder.path().to_owned());
        Server::new(Gpu::open(Default::default()).unwrap(), settings, access, watch::channel(false).1).unwrap()
    }

    /// The messages to a browser that comes now and then, with the items of each.
    async fn next(feed: &mut Feed, server: &Server) -> Vec<(String, Vec<Value>)> {
        tokio::time::timeout(Duration::from_secs(20), feed.changed()).await.expect("there are news");
        let read = |text: Utf8Bytes| {
            let message: Value = serde_json::from_str(&text).unwrap();
            (message["list"].as_str().unwrap().to_owned(), message["items"].as_array().unwrap().clone())
        };
        feed.news(server).into_iter().map(read).collect()
    }

    #[test]
    fn each_point_is_sent_once_and_again_only_if_it_is_another_one() {
        let points = |updates: &[u64]| -> Vec<Point> {
            updates.iter().map(|&update| Point { update, ..Point::default() }).collect()
        };
        let three = points(&[100, 200, 300]);
        assert_eq!(first_to_send(None, &[]), Some(0), "that there are none yet");
        assert_eq!(first_to_send(None, &three), Some(0));
        assert_eq!(first_to_send(Some(&three), &three), None);
        assert_eq!(first_to_send(Some(&three[..2]), &three), Some(2));
        // The training failed, and goes on from an earlier point.
        assert_eq!(first_to_send(Some(&three), &three[..2]), Some(2));
        assert_eq!(first_to_send(Some(&three), &points(&[100, 250])), Some(1));
    }

    #[tokio::test(flavor = "multi_thread")]
    async fn a_slow_browser_gets_the_newest_list_once_and_a_quick_one_at_most_four_a_second() {
        let folder = tempfile::tempdir().unwrap();
        let server = server(&folder);
        let (mut slow, mut quick) = (Feed::new(&server), Feed::new(&server));
        for feed in [&mut slow, &mut quick] {
            // The first lists may be read only now.
            let all = next(feed, &server).await;
            let all = if all.is_empty() { next(feed, &server).await } else { all };
            assert_eq!(all.len(), ALL.len());
            assert!(feed.news(&server).is_empty());
        }
        let begun = tokio::time::Instant::now();
        let mut messages = 0;
        for number in 0..30 {
            drop(server.programs.connect(&format!("p{number:02}")).expect("it connects"));
            tokio::time::sleep(Duration::from_millis(20)).await;
            messages += quick.news(&server).len();
        }
        while next(&mut quick, &server).await.last().is_none_or(|(_, items)| items.len() < 30) {
            messages += 1;
        }
        let most = 2 + begun.elapsed().as_millis() / EVERY.as_millis();
        assert!((2..=most).contains(&(messages as u128 + 1)), "{messages} of {most}");
        let [(list, items)] = &next(&mut slow, &server).await[..] else { panic!("one message") };
        assert_eq!((list.as_str(), items.len()), ("programs", 30));
        assert!(slow.news(&server).is_empty());
        // What changes nothing is not sent.
        server.programs.changes.note();
        tokio::time::sleep(2 * EVERY).await;
        assert!(!slow.lists.has_changed().unwrap() && quick.news(&server).is_empty());
    }
}
