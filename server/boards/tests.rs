use super::*;
use ferry_core::challenge::{Challenge, Sample};
use ferry_core::geometry::Point2;
use ferry_core::trial::{Case, Input, Timed};

fn signed(player: &str, class: Option<&str>) -> Signature {
    Signature { player: player.into(), class: class.map(str::to_owned), at: "2026-11-26T12:00:00Z".into() }
}

/// An attempt that was judged: the boards do not run it again.
fn judged(tick: u64) -> (Attempt, Run) {
    let scenario = Challenge::of("easy-a".parse().unwrap()).unwrap().scenario;
    let inputs = vec![Timed { tick, input: Input::Steer { x_m: 0.0, y_m: -0.3, approach: false } }];
    let log = Case { about: String::new(), scenario, map: None, inputs, expect: None };
    let score = Score { tick, walls: 0, lost_beads: 0 };
    let world_hash = String::from("0123456789abcdef");
    let sample = Sample { tool_m: Point2::new(0.0, -0.3), bead_m: Point2::new(0.0, -0.3) };
    let trace = Trace { samples: vec![sample], mishaps: Vec::new() };
    (Attempt { log, score, world_hash: world_hash.clone() }, Run { score, world_hash, trace })
}

fn players(boards: &Boards) -> Vec<String> {
    boards.of(&"easy-a".parse().unwrap()).into_iter().map(|entry| entry.signature.player).collect()
}

#[test]
fn a_board_keeps_the_best_of_each_person_and_survives_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let boards = Boards::in_folder(folder.path().to_owned());
    let add = |signature: Signature, tick| {
        let (attempt, run) = judged(tick);
        boards.add(&"easy-a".parse().unwrap(), signature, &attempt, run)
    };
    assert!(add(signed("Ada", None), 1000).unwrap());
    assert!(add(signed("Bo", None), 900).unwrap());
    assert!(!add(signed("Ada", None), 1100).unwrap());
    assert!(add(signed("Ada", None), 800).unwrap());
    assert!(add(signed("Ada", Some("7b")), 1200).unwrap());
    assert!(matches!(add(signed("Eve", None), 900), Err(BoardError::Again)));
    assert_eq!(players(&boards), ["Ada", "Bo", "Ada"]);
    let again = Boards::in_folder(folder.path().to_owned());
    assert_eq!(players(&again), ["Ada", "Bo", "Ada"]);
    assert_eq!(again.names(), ["easy-a".parse().unwrap()]);
    for boards in [&boards, &again] {
        let entries = boards.of(&"easy-a".parse().unwrap());
        let traces: Vec<usize> = entries.iter().map(|entry| entry.trace.samples.len()).collect();
        assert_eq!(traces, [1, 0, 0], "only the best one is drawn");
    }
    assert!(Boards::kept(&folder.path().join("easy-a")).iter().all(|kept| kept.trace.samples.len() == 1));
    assert_eq!(std::fs::read_dir(folder.path().join("easy-a")).unwrap().count(), 3);
}

#[test]
fn a_full_board_takes_better_attempts_only() {
    let folder = tempfile::tempdir().unwrap();
    let boards = Boards::in_folder(folder.path().to_owned());
    let add = |index: u64| {
        let (attempt, run) = judged(1000 + index);
        boards.add(&"easy-a".parse().unwrap(), signed(&format!("player {index}"), None), &attempt, run).unwrap()
    };
    assert!((1..=100).all(add));
    assert!(!add(101));
    assert!(add(0));
    let players = players(&boards);
    assert_eq!((players.len(), &*players[0], &*players[99]), (100, "player 0", "player 99"));
    assert_eq!(std::fs::read_dir(folder.path().join("easy-a")).unwrap().count(), 100);
}

#[test]
fn a_wrong_name_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let boards = Boards::in_folder(folder.path().join("challenges"));
    for (signature, wrong) in [
        (signed("", None), "player"),
        (signed(" Ada", None), "player"),
        (signed("Ada\n", None), "player"),
        (signed(&"a".repeat(25), None), "player"),
        (signed("A\u{200b}da", None), "player"),
        (signed("\u{202e}adA", None), "player"),
        (signed("Ada", Some("")), "class"),
        (signed("Ada", Some("7\u{2800}b")), "class"),
    ] {
        let (attempt, run) = judged(1000);
        let error = boards.add(&"easy-a".parse().unwrap(), signature, &attempt, run).unwrap_err();
        assert!(matches!(error, BoardError::Name { field, .. } if field == wrong), "{error}");
    }
    assert!(!folder.path().join("challenges").exists());
    for name in ["\u{1f469}\u{200d}\u{1f52c}", "\u{2764}\u{fe0f}", "می\u{200c}خواهم", "Zoë", "李"] {
        signed(name, None).check().unwrap();
    }
}

#[test]
fn an_unreadable_file_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("easy-a")).unwrap();
    std::fs::write(folder.path().join("easy-a/0.json"), "{").unwrap();
    let boards = Boards::in_folder(folder.path().to_owned());
    assert!(players(&boards).is_empty());
}
