//! The course of a trial reaches each browser without gaps: one that comes late, one that misses states, and after a rewind.

use futures_util::StreamExt;
use serde_json::{Value, json};
use tokio_tungstenite::tungstenite::Message;

use crate::support::{Browser, Laboratory};

const COURSE: u8 = 3;

/// A part of the course or a state.
enum Seen {
    /// Tick from which it holds, and the ticks of its points.
    Part {
        from: u32,
        ticks: Vec<u32>,
    },
    State(Value),
}

async fn next(browser: &mut Browser) -> Seen {
    loop {
        match browser.socket.next().await.expect("the server closed").unwrap() {
            Message::Text(text) => {
                let message: Value = serde_json::from_str(&text).unwrap();
                if message["type"] == "state" {
                    return Seen::State(message);
                }
            }
            Message::Binary(bytes) if bytes[0] == COURSE => {
                let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
                let (from, step, first) = (number(4), number(8), number(12));
                assert_eq!((bytes.len() - 16) % 18, 0);
                let count = (bytes.len() as u32 - 16) / 18;
                let ticks = (0..count).map(|index| first + step * index).collect();
                return Seen::Part { from, ticks };
            }
            _ => {}
        }
    }
}

/// The next part of the course; states may come before it.
async fn next_part(browser: &mut Browser) -> (u32, Vec<u32>) {
    loop {
        if let Seen::Part { from, ticks } = next(browser).await {
            return (from, ticks);
        }
    }
}

/// What a page knows of the course when a state of this tick comes.
async fn known_at(browser: &mut Browser, mut known: Vec<u32>, tick: u32) -> Vec<u32> {
    loop {
        match next(browser).await {
            Seen::Part { from, ticks } => {
                known.retain(|&tick| tick < from);
                known.extend(ticks);
            }
            Seen::State(state) => {
                let now = state["tick"].as_u64().unwrap() as u32;
                if known.last().is_none_or(|&last| last < now) {
                    known.push(now);
                }
                if now == tick {
                    return known;
                }
            }
        }
    }
}

fn assert_no_gap(known: &[u32]) {
    let widest = known.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap();
    assert!(known[0] <= 5 && widest <= 5, "{known:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn each_browser_has_the_course_without_gaps() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 500})).await;
    let known = known_at(&mut browser, Vec::new(), 500).await;
    assert_no_gap(&known);

    let mut late = lab.browser().await;
    let Seen::Part { from: 0, ticks } = next(&mut late).await else { panic!("the course comes before the state") };
    assert_eq!(ticks, (1..=100).map(|step| 5 * step).collect::<Vec<_>>());

    // A rewind leaves it; another input cuts it.
    browser.send(json!({"type": "rewind", "tick": 250})).await;
    let rewound = known_at(&mut browser, known, 250).await;
    assert_eq!(rewound.last(), Some(&500));
    browser.send(json!({"type": "set_goal", "x_m": -0.2, "y_m": -0.37})).await;
    assert_eq!(next_part(&mut browser).await, (251, Vec::new()), "the rest is forgotten");
    let known = rewound.into_iter().filter(|&tick| tick <= 250).collect();
    browser.send(json!({"type": "step", "ticks": 125})).await;
    assert_no_gap(&known_at(&mut browser, known, 375).await);

    // A kept run comes back with its course.
    browser.send(json!({"type": "return_to", "run": 1})).await;
    let (from, ticks) = next_part(&mut browser).await;
    assert_eq!((from, ticks.len(), ticks.last()), (0, 100, Some(&500)), "the course of the run");
    lab.close().await;
}
