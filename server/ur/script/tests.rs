use super::*;
use proptest::prelude::*;

fn one(text: &str) -> Line {
    let (_, lines) = parse(text).unwrap();
    assert_eq!(lines.len(), 1, "{text}");
    lines[0].clone()
}

fn refused(text: &str) -> String {
    parse(text).unwrap_err().to_string()
}

#[test]
fn lines_with_literal_arguments_are_understood() {
    let pose = [0.1, -0.4, 0.1, 2.182, -2.182, 0.0];
    let to = Command::MoveL { to: Target::Pose(pose), speed: 0.04, acceleration: 1.2 };
    assert_eq!(one("movel(p[0.1,-0.4,0.1,2.182,-2.182,0], a=1.2, v=.04)"), Line::Motion(to));
    assert_eq!(one("  movel( p[ 0.1 , -0.4, 0.1, 2.182, -2.182, 0 ], 1.2, 0.04, 0, 0 )"), Line::Motion(to));
    let to = Command::MoveJ { to: Target::Joints([1.0; 6]), speed: 1.05, acceleration: 1.4 };
    assert_eq!(one("movej([1,1,1,1,1,1])"), Line::Motion(to));
    let speed = Command::SpeedL { velocity: [0.02, 0.0, 0.0, 0.0, 0.0, 0.0], acceleration: 0.5, time_s: 0.1 };
    assert_eq!(one("speedl([0.02,0,0,0,0,0], 0.5, 0.1)"), Line::Motion(speed));
    let servo = Command::ServoJ { to: [0.5; 6], lookahead_s: 0.05 };
    let line = "servoj([.5,.5,.5,.5,.5,.5], t=0.008, lookahead_time=0.05, gain=300)";
    assert_eq!(one(line), Line::Motion(servo));
    assert_eq!(one("stopl(1.5)"), Line::Motion(Command::StopL { deceleration: 1.5 }));
    assert_eq!(one("write_output_integer_register(0 +24, 2)"), Line::WriteInt { register: 24, value: 2 });
    let (name, lines) = parse("def mine():\n\t# a note\n\tsleep(0.5)\n\ttextmsg(\"hello\")\nend\n").unwrap();
    assert_eq!((name.as_str(), lines), ("mine", vec![Line::Sleep { time_s: 0.5 }, Line::Nothing("textmsg")]));
}

#[test]
fn what_is_not_understood_is_named_and_nothing_is_carried_out() {
    assert!(refused("movel(get_target_tcp_pose())").starts_with("line 1: \"movel(get_target"));
    assert!(refused("def a():\n  stopl(1)\n  while True:\n  end\nend\n").starts_with("line 3: \"while True:\""));
    assert_eq!(refused("movel(p[0,0,0], v=1)"), "line 1: movel: pose must have six numbers");
    assert_eq!(refused("movej([0,0,0,0,0,0], r=0.1)"), "line 1: movej: a blend radius r is not carried out");
    assert_eq!(refused("movej([0,0,0,0,0,0], t=2)"), "line 1: movej: a duration t is not carried out; use v");
    assert_eq!(refused("stopl(-1)"), "line 1: stopl: a is -1, it must be above 0, at most 150");
    assert_eq!(refused("speedl(p[0,0,0,0,0,0], 1)"), "line 1: speedl: xd is a pose, it must be a list");
    assert_eq!(refused("stopl(1, b=2)"), "line 1: stopl: argument 2 is not known");
    assert!(refused("get_inverse_kin(p[0,0,0,0,0,0])").contains("get_inverse_kin"));
    assert!(refused("set_tcp(p[0,0,0.1,0,0,0])").contains("Ferry's tool is p[0.0, 0.0, 0.18, 0.0"));
    assert!(refused("popup('wait', blocking=True)").contains("blocking is True"));
    assert_eq!(refused("def a():\nend\nstopl(1)"), "line 3: a statement stands behind the program's end");
    assert_eq!(refused("movej([0,\n0"), "line 1: a bracket is not closed");
    let long = "a".repeat(60_000);
    assert!(refused(&format!("def {long}():\nend")).starts_with("line 1: the program's name has 60000 characters"));
    assert!(refused("sleep(1e9)").contains("t is 1000000000"));
}

#[test]
fn comments_separators_and_harmless_functions_are_read_as_usual() {
    let text = "\u{feff}  sec usual( ) : # the head\n  set_tcp(p[0, 0, .18, 0, 0, 0]); set_payload(0.5, [0, 0, 0])\n\
                \tmovej([0, 0, 0, # three\n 0, 0, 0]) # six\n popup('a # b; c', \"title\", False); textmsg(\"#\", 2);\n\
                \n set_digital_out(1, True)\n  halt\n  end # of it\n";
    let (name, lines) = parse(text).unwrap();
    let move_ = Command::MoveJ { to: Target::Joints([0.0; 6]), speed: 1.05, acceleration: 1.4 };
    let nothing = ["popup", "textmsg", "set_digital_out"].map(Line::Nothing);
    let expected = [Line::Nothing("set_tcp"), Line::Nothing("set_payload"), Line::Motion(move_)];
    assert_eq!((name.as_str(), lines), ("usual", [&expected[..], &nothing, &[Line::Halt]].concat()));
}

proptest! {
    #[test]
    fn any_text_is_parsed_or_refused(text in "\\PC{0,200}", words in "(movej|servoj|stopl)\\([p\\[\\]0-9,.a-z= -]{0,60}\\)") {
        for text in [text, words] {
            if let Ok((_, lines)) = parse(&text) {
                prop_assert!(lines.iter().all(|line| !matches!(line, Line::Motion(command) if command.check().is_err())));
            }
        }
    }
}
