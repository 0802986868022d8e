//! Everybody can act: sessions of one's own, and whose turn it is in a shared one.

mod random;

use std::collections::BTreeSet;
use std::time::Duration;

use futures_util::future::join_all;
use serde_json::json;

use crate::support::{Laboratory, Visitor, gpu};

/// A server that ends unsteered sessions early.
async fn laboratory(sessions: usize, end_after: Duration) -> Laboratory {
    Laboratory::open_with(gpu(), None, |settings| (settings.sessions, settings.end_after) = (sessions, end_after)).await
}

const NEVER: Duration = Duration::from_secs(3600);

async fn names(lab: &Laboratory) -> BTreeSet<String> {
    let (_, listed) = lab.ask("GET", "/api/sessions", "").await;
    listed["sessions"].as_array().unwrap().iter().map(|one| one["id"].as_str().unwrap().to_owned()).collect()
}

async fn until_gone(lab: &Laboratory, name: &str) {
    let gone = async {
        while names(lab).await.contains(name) {
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(20), gone).await.expect("the session ends");
}

#[tokio::test(flavor = "multi_thread")]
async fn the_first_address_shows_main_to_those_who_can_operate_it() {
    let lab = laboratory(4, NEVER).await;
    let [mut anna, mut bert] = [(); 2].map(|()| Visitor::default());
    assert_eq!((anna.home(&lab).await, bert.home(&lab).await), ("main".into(), "main".into()), "it is free");
    let in_main = anna.sit(&lab, "main").await;
    assert!(in_main.operates());
    assert!(!bert.sit(&lab, "main").await.operates());
    assert_eq!(bert.home(&lab).await, "main", "without a session of its own it watches");
    let own = bert.open_own(&lab).await.unwrap();
    assert!(bert.sit(&lab, &own).await.operates());
    assert_eq!(bert.home(&lab).await, own);
    assert_eq!(anna.home(&lab).await, "main", "it is hers");
    assert_eq!(Visitor::default().home(&lab).await, "main");
    drop(in_main);
    let free = async {
        while bert.home(&lab).await != "main" {
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(20), free).await.expect("main is free");
    lab.close().await;

    let lab = Laboratory::open_with(gpu(), None, |settings| settings.shows_main = true).await;
    let _in_main = Visitor::default().sit(&lab, "main").await;
    let mut carl = Visitor::default();
    carl.open_own(&lab).await.unwrap();
    assert_eq!(carl.home(&lab).await, "main", "a robot is attached");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_visitor_has_three_sessions_and_a_full_server_says_so() {
    let lab = laboratory(6, NEVER).await;
    let mut anna = Visitor::default();
    anna.home(&lab).await;
    let opened = join_all((0..8).map(|_| {
        let mut page = anna.clone();
        let lab = &lab;
        async move { page.open_own(lab).await }
    }));
    let (own, refused): (Vec<_>, Vec<_>) = opened.await.into_iter().partition(Result::is_ok);
    let own: Vec<_> = own.into_iter().map(Result::unwrap).collect();
    assert_eq!((own.len(), refused.len()), (3, 5), "{refused:?}");
    let refusal = anna.open_own(&lab).await.unwrap_err();
    assert_eq!(refusal["code"], "too_many_own_sessions");
    assert!(own.iter().all(|name| refusal["detail"].as_str().unwrap().contains(name)), "{refusal}");

    // The cookie of another visitor, and one that was changed.
    let [mut bert, mut carl] = [Visitor::default(), Visitor { cookie: anna.cookie.replace('=', "=A") }];
    bert.open_own(&lab).await.unwrap();
    carl.open_own(&lab).await.unwrap();
    let before = names(&lab).await;
    assert_eq!(before.len(), 6);
    let refusal = bert.open_own(&lab).await.unwrap_err();
    assert_eq!(refusal["code"], "too_many_sessions");
    assert!(refusal["detail"].as_str().unwrap().contains("the server is full"), "{refusal}");
    assert_eq!(names(&lab).await, before, "no session makes way");
    // Those of another visitor do not count.
    assert_eq!(lab.ask("DELETE", &format!("/api/sessions/{}", own[0]), "").await.0, 204);
    bert.open_own(&lab).await.unwrap();
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_nothing_steers_ends_and_goes_on_where_it_was() {
    let lab = laboratory(8, Duration::from_millis(1500)).await;
    let [mut anna, mut bert, mut carl] = [(); 3].map(|()| Visitor::default());
    let [steered, done, unused] =
        [anna.open_own(&lab).await, bert.open_own(&lab).await, carl.open_own(&lab).await].map(Result::unwrap);
    let mut steers = anna.sit(&lab, &steered).await;
    let mut steps = bert.sit(&lab, &done).await;
    assert_eq!(steps.command(json!({"type": "step", "ticks": 7})).await.unwrap()["type"], "done");
    // A viewer does not keep it.
    let watches = anna.sit(&lab, &done).await;
    drop(steps);
    until_gone(&lab, &unused).await;
    until_gone(&lab, &done).await;
    drop(watches);
    assert_eq!(steers.can_act().await, Some(true));
    assert!(names(&lab).await.is_superset(&["main".to_owned(), steered.clone()].into()));
    let saved = |name: &str| lab.data.path().join(format!("sessions/{name}.ferry")).exists();
    assert_eq!((saved(&done), saved(&unused)), (true, false), "nothing was done in the other");
    // It opens again as the visitor's own.
    assert_eq!(bert.ask(&lab, "GET", &format!("/s/{done}")).await.status, 200);
    let (_, state) = lab.ask("GET", &format!("/api/sessions/{done}/state"), "").await;
    assert_eq!(state["tick"], 7);
    until_gone(&lab, &done).await;
    // Named ones stay.
    assert_eq!(anna.ask(&lab, "GET", "/s/group-7").await.status, 200);
    tokio::time::sleep(Duration::from_secs(3)).await;
    assert!(names(&lab).await.contains("group-7"));
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_reload_keeps_control_though_another_asks_for_it() {
    let lab = laboratory(4, NEVER).await;
    let [mut anna, mut bert] = [(); 2].map(|()| Visitor::default());
    anna.home(&lab).await;
    bert.home(&lab).await;
    let page = anna.sit(&lab, "main").await;
    let mut asks = bert.sit(&lab, "main").await;
    asks.command(json!({"type": "take_control"})).await.unwrap();
    drop(page);
    let away =
        asks.browser.until("a wait", |m| m["type"] == "hello" && m["answer_within_s"].as_f64() < Some(6.0)).await;
    assert_eq!((&away["operator_present"], &away["asks"]), (&json!(true), &json!(true)));
    let page = anna.sit(&lab, "main").await;
    assert!(page.operates());
    assert_eq!((asks.can_act().await, page.hello["asked"].as_bool()), (Some(false), Some(true)));
    drop(page);
    asks.browser.until("its turn", |m| m["type"] == "hello" && m["role"] == "operator").await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn thirty_race_for_one_seat_and_each_has_it_once() {
    let lab = laboratory(4, NEVER).await;
    let lab_ref = &lab;
    let mut pages = join_all((0..30).map(|_| async move {
        let mut visitor = Visitor::default();
        visitor.home(lab_ref).await;
        visitor.sit(lab_ref, "main").await
    }))
    .await;
    let asked = join_all(pages.iter_mut().map(|page| page.command(json!({"type": "take_control"})))).await;
    assert!(asked.iter().all(|answer| answer.as_ref().unwrap()["type"] == "done"));
    let mut turns = BTreeSet::new();
    for _ in 0..30 {
        let can = join_all(pages.iter_mut().map(|page| page.can_act())).await;
        let operators: Vec<_> = (0..30).filter(|&one| can[one] == Some(true)).collect();
        let [operator] = operators[..] else { panic!("operators: {operators:?}") };
        assert!(turns.insert(operator), "{operator} has it again");
        pages[operator].command(json!({"type": "release_control"})).await.unwrap();
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn of_two_five_and_thirty_visitors_each_can_act_after_one_press() {
    for count in [2, 5, 30] {
        let lab = laboratory(count, NEVER).await;
        let lab_ref = &lab;
        let arrive = join_all((0..count).map(|_| async move {
            let mut visitor = Visitor::default();
            let session = visitor.home(lab_ref).await;
            let page = visitor.sit(lab_ref, &session).await;
            (visitor, page)
        }));
        let arrived = arrive.await;
        let act = join_all(arrived.into_iter().map(|(mut visitor, page)| async move {
            if page.operates() {
                return page;
            }
            // The press.
            let own = visitor.open_own(lab_ref).await.unwrap();
            visitor.sit(lab_ref, &own).await
        }));
        let mut pages = act.await;
        let can = join_all(pages.iter_mut().map(|page| page.can_act())).await;
        assert!(can.iter().all(|can| *can == Some(true)), "{can:?}");
        let sessions: BTreeSet<_> = pages.iter().map(|page| page.hello["session"].to_string()).collect();
        assert_eq!(sessions.len(), count);
        let refusal = Visitor::default().open_own(&lab).await.unwrap_err();
        assert_eq!(refusal["code"], "too_many_sessions");
        lab.close().await;
    }
}
