//! Who gives control away no longer holds the button.

use std::time::{Duration, Instant};

use serde_json::json;

use super::{driver, press, robot, task};

/// Without a word of the page, the button is no longer held after 0.25 s.
const AT_ONCE: Duration = Duration::from_millis(120);

#[tokio::test(flavor = "multi_thread")]
async fn handing_over_releases_the_button_that_moves_the_robot() {
    const ADDRESS: &str = "127.0.28.129";
    let data = tempfile::tempdir().unwrap();
    let (_robot, _page_of_it) = robot(ADDRESS, "open", [-0.1, -0.35], &data.path().join("robot")).await;
    let (_server, mut page) = driver(ADDRESS, &["--enable-motion"], &data.path().join("twin")).await;
    let mut soonest = Duration::MAX;
    // A busy machine may be late.
    for turn in 0..8 {
        page.state("it is connected", |state| state["twin"]["trouble"].is_null()).await;
        let side = if turn % 2 == 0 { 0.22 } else { -0.22 };
        task(&mut page, "open", turn, Some([side, -0.4]), [0.0, -0.3]).await;
        press(&mut page).await;
        let number = page.press;
        page.send(json!({"type": "drive_robot", "press": number})).await;
        page.send(json!({"type": "release_control"})).await;
        let began = Instant::now();
        page.state("it rests", |state| state["twin"]["is_driven"] == false).await;
        soonest = soonest.min(began.elapsed());
        if soonest < AT_ONCE {
            return;
        }
        page.send(json!({"type": "take_control"})).await;
        page.press += 1;
    }
    panic!("it took {soonest:?}");
}
