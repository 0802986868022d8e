//! Random visitors: whatever they do, a session has at most one operator, and none ends that a visitor steers.

use std::collections::BTreeMap;
use std::time::Duration;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::json;

use crate::support::visitor::Page;
use crate::support::{Laboratory, Visitor, gpu};

/// Number of sequences; `FERRY_SEQUENCES` changes it.
fn sequences() -> u64 {
    std::env::var("FERRY_SEQUENCES").map_or(40, |count| count.parse().expect("FERRY_SEQUENCES is a count"))
}

const VISITORS: usize = 4;
const STEPS: usize = 14;

#[derive(Default)]
struct Place {
    visitor: Visitor,
    /// The session that it is in, its page, and whether it could act when that was tried last.
    page: Option<(String, Page, bool)>,
}

impl Place {
    async fn go(&mut self, lab: &Laboratory, session: String, seat: Option<String>) {
        self.page = self.visitor.sit_again(lab, &session, seat.as_deref()).await.map(|page| {
            let operates = page.operates();
            (session, page, operates)
        });
    }

    async fn command(&mut self, kind: &str) {
        if let Some((_, page, _)) = &mut self.page {
            page.command(json!({"type": kind})).await;
        }
    }
}

/// Every page tries to act.
async fn check(seed: u64, places: &mut [Place]) {
    let mut operators = BTreeMap::new();
    for (number, place) in places.iter_mut().enumerate() {
        let Some((session, page, steered)) = &mut place.page else { continue };
        match page.can_act().await {
            Some(true) => {
                *steered = true;
                let other = operators.insert(session.clone(), number);
                assert_eq!(other, None, "sequence {seed}: two operators in {session}");
            }
            Some(false) => *steered = false,
            None => {
                assert!(!*steered, "sequence {seed}: {session} has ended, and {number} steered it");
                place.page = None;
            }
        }
    }
}

async fn open(data: tempfile::TempDir) -> (Laboratory, tempfile::TempDir) {
    let folder = data.path().to_owned();
    let change = |settings: &mut ferry::http::Settings| {
        settings.data = folder;
        settings.sessions = 5;
        settings.end_after = Duration::from_millis(40);
    };
    (Laboratory::open_with(gpu(), None, change).await, data)
}

#[tokio::test(flavor = "multi_thread")]
async fn whatever_visitors_do_a_session_has_one_operator_and_no_steered_one_ends() {
    let (mut lab, mut data) = open(tempfile::tempdir().unwrap()).await;
    let mut done = BTreeMap::<&str, u32>::new();
    for seed in 0..sequences() {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut places: [Place; VISITORS] = Default::default();
        for _ in 0..STEPS {
            let who = rng.random_range(0..VISITORS);
            let place = &mut places[who];
            let what = match rng.random_range(0..100) {
                0..25 => {
                    let session = place.visitor.home(&lab).await;
                    place.go(&lab, session, None).await;
                    "home"
                }
                25..37 => match place.visitor.open_own(&lab).await {
                    Ok(own) => {
                        place.go(&lab, own, None).await;
                        "open"
                    }
                    Err(refusal) => {
                        let code = refusal["code"].as_str().unwrap();
                        assert!(code == "too_many_own_sessions" || code == "too_many_sessions", "{refusal}");
                        "refused"
                    }
                },
                37..57 => {
                    place.command("take_control").await;
                    "ask"
                }
                57..65 => {
                    place.command("keep_control").await;
                    "keep"
                }
                65..77 => {
                    place.command("release_control").await;
                    if let Some((_, _, steered)) = &mut place.page {
                        *steered = false;
                    }
                    "give"
                }
                77..83 => {
                    place.page = None;
                    "leave"
                }
                83..93 => {
                    if let Some((session, page, _)) = place.page.take() {
                        let seat = page.seat.clone();
                        drop(page);
                        place.visitor.ask(&lab, "GET", &format!("/s/{session}")).await;
                        place.go(&lab, session, Some(seat)).await;
                    }
                    "reload"
                }
                93..98 => {
                    tokio::time::sleep(Duration::from_millis(60)).await;
                    "wait"
                }
                _ => {
                    places.iter_mut().for_each(|place| place.page = None);
                    lab.close().await;
                    (lab, data) = open(data).await;
                    "restart"
                }
            };
            *done.entry(what).or_default() += 1;
            check(seed, &mut places).await;
        }
    }
    eprintln!("{done:?}");
    let all = ["home", "open", "refused", "ask", "keep", "give", "leave", "reload", "wait", "restart"];
    assert!(all.iter().all(|what| done.contains_key(what)), "{done:?}");
    lab.close().await;
}
