//! What fuzzing begins from: files as Ferry itself writes or ships them.

use std::path::Path;
use std::sync::LazyLock;

use bytes::BytesMut;
use ferry::protocol::ClientMessage;
use ferry_core::geometry::Point2;
use ferry_core::map::Map;
use ferry_core::plant::PositionerKind;
use ferry_core::policy::Policy;
use ferry_core::scenario::{ControllerName, Disturbance, Parameters, Scenario, Scripted, Shipped, When};
use ferry_core::trial::{Arena, Beginning, Entry, Input, LogWriter, LoggedBeginning, LoggedTick, Source, Trial};
use ferry_files::open;
use ferry_ur::controller::Controller;
use ferry_ur::peer::Peer;
use ferry_ur::{Arm, rtde};
use tokio_util::codec::Encoder;

use super::targets::{Spots, Target, written};

/// A small map in the arm's reach, so that states are short.
const SMALL_MAP: &str = r#"<svg viewBox="-60 300 120 100"><rect x="-10" y="340" width="20" height="60"/></svg>"#;

impl Target {
    pub fn seeds(self) -> &'static [Vec<u8>] {
        static SEEDS: LazyLock<[Vec<Vec<u8>>; 11]> = LazyLock::new(|| Target::ALL.map(Target::make_seeds));
        &SEEDS[self as usize]
    }

    fn make_seeds(self) -> Vec<Vec<u8>> {
        match self {
            Self::Message => messages().iter().map(|message| written(message).into_bytes()).collect(),
            Self::Map => maps().into_iter().map(String::into_bytes).collect(),
            Self::Drawing => (0..8_u32).map(|number| (0..60).map(|i| (i * 7 + number * 31) as u8).collect()).collect(),
            Self::Case => cases(),
            Self::Log => ControllerName::ALL.map(|name| log(&trial(name))).into(),
            Self::Entries => ControllerName::ALL.map(|name| payload(&trial(name))).into(),
            Self::Policy => headers(),
            Self::Rtde => conversations(),
            Self::Reports => [false, true].map(reported).into(),
            Self::Script => programs(),
            Self::Dashboard => vec![
                b"PolyscopeVersion\nrobotmode\nprogramState\nstop\nunlock protective stop\nquit\n".to_vec(),
                b"safetymode\nrunning\nplay\npopup hello\nclose popup\nget robot model\n".to_vec(),
            ],
        }
    }
}

fn messages() -> Vec<ClientMessage> {
    let (x_m, y_m) = (0.1, -0.35);
    let load = |script: Vec<Scripted>| ClientMessage::LoadScenario {
        map: "posts".to_owned(),
        controller: Some(ControllerName::Errt),
        positioner: Some(PositionerKind::PlanarStage),
        seed: Some(7),
        start_m: Some([-0.1, -0.3]),
        goal_m: Some([x_m, y_m]),
        parameters: Some(Parameters::default()),
        disturbances: 2,
        script,
    };
    vec![
        ClientMessage::SetGoal { x_m, y_m },
        ClientMessage::ClearGoal {},
        ClientMessage::Drag { x_m, y_m, lift: true },
        ClientMessage::Release {},
        ClientMessage::SelectController { controller: ControllerName::Rl, program: None },
        ClientMessage::SelectController { controller: ControllerName::Program, program: Some("mine".to_owned()) },
        ClientMessage::Configure { parameters: Parameters::default() },
        ClientMessage::Steer { x_m, y_m, approach: false },
        ClientMessage::Run {},
        ClientMessage::Pause {},
        ClientMessage::Step { ticks: 31 },
        ClientMessage::SetSpeed { factor: 2.0 },
        ClientMessage::Reset { seed: Some(3) },
        load(script()),
        ClientMessage::Disturb { disturbance: Disturbance::Displace { x_m, y_m } },
        ClientMessage::Rewind { tick: 31 },
        ClientMessage::Compare { tick: 31, controllers: ControllerName::ALL.into() },
        ClientMessage::TakeControl {},
        ClientMessage::KeepControl {},
        ClientMessage::ReleaseControl {},
    ]
}

fn script() -> Vec<Scripted> {
    let (x_m, y_m) = (0.05, -0.35);
    vec![
        Scripted { at: When::Tick(1), disturbance: Disturbance::Impulse { x_n_s: 1e-4, y_n_s: 0.0 } },
        Scripted { at: When::Step(1), disturbance: Disturbance::Drift { x_n: 1e-3, y_n: 0.0, for_s: 0.5 } },
        Scripted { at: When::PassesXM(x_m), disturbance: Disturbance::Dropout { for_s: 0.1 } },
        Scripted { at: When::Near { x_m, y_m, within_m: 0.5 }, disturbance: Disturbance::Displace { x_m, y_m } },
    ]
}

fn maps() -> Vec<String> {
    let shapes = "<g id='a' transform='rotate(9 50 50)'><path d='M10 10L40 10C40 40 10 40 10 30Z'/></g>\
         <use href='#a' x='20' transform='scale(.5)'/><circle cx='80' cy='20' r='9' fill='none' stroke='red'/>\
         <ellipse cx='80' cy='60' rx='9' ry='5' style='fill:red'/><style>.b{fill:none;stroke:red}</style>\
         <polyline class='b' points='5 90 50 70 95 90' stroke-width='2' stroke-linejoin='round'/>\
         <linearGradient id='p'><stop/></linearGradient><rect x='40' y='45' width='9' height='9' rx='2' fill='url(#p)'/>\
         <path d='m50 5h9v9q-9 0-9-9t3 3s1 2 3 4a3 2 10 1 0 5 5z' fill-rule='evenodd'/>";
    let own = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>{shapes}</svg>");
    let shipped = Map::shipped_names().into_iter().map(|name| Map::shipped(&name).unwrap().svg().to_owned());
    shipped.chain([SMALL_MAP.to_owned(), own.replace("100%", "100")]).collect()
}

fn cases() -> Vec<Vec<u8>> {
    let kept = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases")).unwrap();
    let mut paths: Vec<_> = kept.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let kept = paths.iter().map(|path| std::fs::read(path).unwrap());
    let shipped = Shipped::names().into_iter().map(|name| {
        let mut case = open::case(&name).unwrap();
        case.scenario.script.extend(script());
        case.inputs = inputs().into_iter().enumerate().map(|(tick, input)| timed(tick as u64, input)).collect();
        serde_json::to_vec(&case).unwrap()
    });
    kept.chain(shipped).collect()
}

fn timed(tick: u64, input: Input) -> ferry_core::trial::Timed {
    ferry_core::trial::Timed { tick, input }
}

fn inputs() -> Vec<Input> {
    vec![
        Input::SetGoal { x_m: 0.04, y_m: -0.33 },
        Input::Drag { x_m: 0.02, y_m: -0.32, lift: false },
        Input::Place { x_m: 0.03, y_m: -0.32 },
        Input::Release,
        Input::Configure(Box::new(Parameters { friction: 0.3, ..Parameters::default() })),
        Input::Disturb(Disturbance::Displace { x_m: -0.03, y_m: -0.33 }),
        Input::Steer { x_m: 0.02, y_m: -0.32, approach: true },
        Input::Go { x_m: 0.02, y_m: -0.32 },
        Input::Hold { reason: "it thinks".to_owned() },
    ]
}

/// Entries of a trial that begins, receives several inputs, and then continues from its state.
fn trial(controller: ControllerName) -> Vec<Entry> {
    let arena = Arena::of(Map::from_svg("small", SMALL_MAP).unwrap());
    let scenario = Scenario {
        controller,
        start_m: Some(Point2::new(-0.03, -0.33)),
        goal_m: Some(Point2::new(0.04, -0.34)),
        disturbances: 1,
        script: script(),
        ..Scenario::idle("small", 5)
    };
    let mut trial = Trial::new(scenario, arena).unwrap();
    let mut entries = vec![Entry::Begin(Box::new(LoggedBeginning::of(&trial, Beginning::SetUp)))];
    let mut inputs = inputs().into_iter();
    // The first control steps are at ticks 0 and 31. The ticks between are left out, so that most entries are states.
    for tick in 0..33 {
        if tick == 30 {
            entries.push(Entry::Begin(Box::new(LoggedBeginning::of(&trial, Beginning::Resumed))));
        }
        if tick % 4 == 0
            && let Some(input) = inputs.next()
        {
            // Only You is steered, and only a program answers.
            let other = match input {
                Input::Steer { .. } => controller != ControllerName::You,
                Input::Go { .. } | Input::Hold { .. } => controller != ControllerName::Program,
                _ => false,
            };
            let refused = trial.apply(input).is_err();
            assert_eq!(refused, other);
        }
        let record = trial.tick(Source::Camera(&mut Spots)).unwrap();
        if !(2..30).contains(&tick) {
            entries.push(Entry::Tick(LoggedTick::from(&record)));
        }
    }
    entries
}

fn log(entries: &[Entry]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = LogWriter::new(&mut bytes).unwrap();
    entries.chunks(3).for_each(|some| writer.append(some.to_vec()).unwrap());
    bytes
}

fn payload(entries: &[Entry]) -> Vec<u8> {
    let mut bytes = Vec::new();
    entries.iter().for_each(|entry| ciborium::into_writer(entry, &mut bytes).unwrap());
    bytes
}

/// Versions, a recipe, start; with and without a recipe that is found.
fn conversations() -> Vec<Vec<u8>> {
    let frame = |kind: u8, payload: &[u8]| {
        let size = (3 + payload.len()) as u16;
        [&size.to_be_bytes()[..], &[kind], payload].concat()
    };
    let register = |number: i32, values: [f64; 8]| {
        let values = values.map(f64::to_be_bytes).concat();
        frame(b'U', &[&[1][..], &number.to_be_bytes(), &values].concat())
    };
    let names = ["timestamp,actual_q,actual_TCP_pose,robot_mode", "output_int_register_3,joint_mode,", "wings"];
    let doubles: Vec<_> = (0..8).map(|number| format!("input_double_register_{number}")).collect();
    let inputs = format!("input_int_register_0,{}", doubles.join(","));
    let conversation = |names: &str| {
        let outputs = [&125f64.to_be_bytes()[..], names.as_bytes()].concat();
        let frames = [
            frame(b'V', &[0, 2]),
            frame(b'v', &[]),
            frame(b'O', &outputs),
            frame(b'I', inputs.as_bytes()),
            frame(b'S', &[]),
            register(3, [0.02, -0.36, 0.1, 2.2214, -2.2214, 0.0, 0.1, 0.5]),
            register(0, [0.0; 8]),
            register(10, [0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.1]),
            register(15, [2.0; 8]),
            frame(b'P', &[]),
        ];
        frames.concat()
    };
    names.map(conversation).into()
}

/// What Ferry's own controller sends to `ferry drive`.
fn reported(writes: bool) -> Vec<u8> {
    let (mut peer, mut client, mut robot) = (Peer::new(writes), rtde::Client::default(), Controller::default());
    let (mut framing, mut sent) = (rtde::framing(), BytesMut::new());
    for &step in peer.steps() {
        let answer = client.answer(&peer.request(step), &mut robot).expect("it is understood").expect("it is answered");
        assert!(peer.accept(step, &answer).expect("it is as expected"));
        framing.encode(&answer[..], &mut sent).expect("an answer fits into a frame");
    }
    for _ in 0..3 {
        let data = client.data(&Arm::default(), &robot).expect("it has started");
        framing.encode(&data[..], &mut sent).expect("data fit into a frame");
    }
    [&[u8::from(writes)][..], &sent].concat()
}

fn programs() -> Vec<Vec<u8>> {
    let texts = [
        "movel(p[0.02,-0.36,0.1,2.2214,-2.2214,0], a=1.2, v=0.25)\nstopl(2)\n",
        "def mine():\n  movej([-1.6,-1.6,-1.6,-1.6,1.6,0])\n  sleep(0.1)\n  speedl([0.02,0,0,0,0,0], 0.5, 0.1)\nend\n",
        "servoj([-1.6,-1.6,-1.6,-1.6,1.6,0], t=0.008, lookahead_time=0.1, gain=300)\nspeedj([0.1,0,0,0,0,0])\nstopj(1)\n",
        "def a():\n  write_output_integer_register(0 +24, 1)\n  textmsg(\"hello\")\n  sync()\nend\n",
    ];
    texts.map(|text| text.as_bytes().to_vec()).into()
}

/// Headers of the shipped policies, with four bytes in place of the weights.
fn headers() -> Vec<Vec<u8>> {
    let header = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/policies/{name}.safetensors"));
        let bytes = std::fs::read(path).unwrap();
        let length = u64::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
        bytes[..8 + length].to_vec()
    };
    let names = Policy::shipped_names();
    names
        .iter()
        .flat_map(|name| [0.0_f32, 1e-3, 1e3].map(|w| [header(name), w.to_le_bytes().to_vec()].concat()))
        .collect()
}
