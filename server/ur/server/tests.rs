use std::net::Ipv4Addr;

use tokio::io::{AsyncReadExt, AsyncWriteExt};

use super::*;

/// A robot server at a loopback address of its own, and the means to stop it.
async fn started(last: u8) -> (IpAddr, watch::Sender<bool>, tokio::task::JoinHandle<()>) {
    let address = IpAddr::from(Ipv4Addr::new(127, 0, 28, last));
    let (stop, stopping) = watch::channel(false);
    let ports = Ports::open(address).await.unwrap();
    (address, stop, tokio::spawn(serve(ports, Arc::default(), stopping)))
}

async fn connect(address: IpAddr, port: u16) -> TcpStream {
    TcpStream::connect((address, port)).await.unwrap()
}

/// The next bytes, as many as there are.
async fn read(socket: &mut TcpStream) -> Vec<u8> {
    let mut bytes = vec![0; 4096];
    let count = tokio::time::timeout(Duration::from_secs(10), socket.read(&mut bytes)).await.unwrap().unwrap();
    bytes.truncate(count);
    bytes
}

#[tokio::test]
async fn the_dashboard_answers_each_line_and_ends_with_quit() {
    let (address, stop, served) = started(1).await;
    let mut socket = connect(address, 29_999).await;
    let mut said = read(&mut socket).await;
    for line in ["robotmode\nPolyscopeVersion\n", "wings\n", "quit\n"] {
        socket.write_all(line.as_bytes()).await.unwrap();
    }
    socket.read_to_end(&mut said).await.unwrap();
    let said = String::from_utf8(said).unwrap();
    let lines: Vec<_> = said.lines().collect();
    assert_eq!(lines[0], "Connected: Universal Robots Dashboard Server");
    assert_eq!(lines[1], "Robotmode: DISCONNECTED", "no session is reported");
    assert!(lines[2].starts_with("URSoftware 3.15."), "{said}");
    assert_eq!(&lines[3..], ["could not understand: 'wings'", "Disconnected"]);
    // A line without an end is not collected for ever.
    let mut endless = connect(address, 29_999).await;
    let sent = endless.write_all(&vec![b'x'; 100_000]).await;
    let mut rest = Vec::new();
    assert!(sent.is_err() || endless.read_to_end(&mut rest).await.is_err() || rest.len() < 200, "{}", rest.len());
    stop.send(true).unwrap();
    served.await.unwrap();
}

#[tokio::test]
async fn clients_are_limited_and_leave_their_places() {
    let (address, _stop, _served) = started(2).await;
    let mut clients = Vec::new();
    for _ in 0..CLIENTS_MOST {
        let mut client = connect(address, 29_999).await;
        assert!(!read(&mut client).await.is_empty());
        clients.push(client);
    }
    assert!(read(&mut connect(address, 29_999).await).await.is_empty(), "one too many");
    // The one that is silent longest leaves, when others have been heard of.
    for client in &mut clients[1..] {
        tokio::time::sleep(SILENT_AFTER / CLIENTS_MOST as u32).await;
        client.write_all(b"running\n").await.unwrap();
        assert!(!read(client).await.is_empty());
    }
    tokio::time::sleep(SILENT_AFTER / CLIENTS_MOST as u32).await;
    assert!(!read(&mut connect(address, 29_999).await).await.is_empty());
    assert!(read(&mut clients[0]).await.is_empty());
    clients.pop().unwrap().write_all(b"quit\n").await.unwrap();
    let begun = std::time::Instant::now();
    while read(&mut connect(address, 29_999).await).await.is_empty() {
        assert!(begun.elapsed() < Duration::from_secs(10));
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
}

#[tokio::test]
async fn rtde_sends_also_while_the_session_is_paused_and_survives_any_bytes() {
    let (address, stop, served) = started(3).await;
    let mut socket = connect(address, 30_004).await;
    socket.write_all(&[0, 5, b'V', 0, 2]).await.unwrap();
    assert_eq!(read(&mut socket).await, [0, 4, b'V', 1]);
    let outputs = [&[0, 0, b'O'][..], &125f64.to_be_bytes(), b"timestamp,robot_mode"].concat();
    let size = (outputs.len() as u16).to_be_bytes();
    socket.write_all(&[&size, &outputs[2..]].concat()).await.unwrap();
    assert_eq!(read(&mut socket).await, [&[0, 16, b'O', 1][..], b"DOUBLE,INT32"].concat());
    socket.write_all(&[0, 3, b'S']).await.unwrap();
    let mut sent = read(&mut socket).await;
    while sent.len() < 4 + 3 * 16 {
        sent.extend(read(&mut socket).await);
    }
    assert_eq!(sent[..4], [0, 4, b'S', 1]);
    for data in sent[4..].chunks_exact(16) {
        assert_eq!(data, [&[0, 16, b'U', 1][..], &[0; 12]].concat());
    }
    let mut broken = connect(address, 30_004).await;
    broken.write_all(&[0, 1, 7, 7, 7]).await.unwrap();
    assert!(read(&mut broken).await.is_empty(), "it is disconnected");
    stop.send(true).unwrap();
    served.await.unwrap();
}

#[tokio::test]
async fn a_port_in_use_is_named() {
    let (address, _stop, _served) = started(4).await;
    let error = Ports::open(address).await.err().unwrap();
    assert!(error.to_string().starts_with("robot server: port 29999 of 127.0.28.4: "), "{error}");
}

#[tokio::test]
async fn programs_at_the_script_ports_are_refused_without_an_arm_and_noted() {
    let address = IpAddr::from(Ipv4Addr::new(127, 0, 28, 5));
    let (stop, stopping) = watch::channel(false);
    let robot = Arc::new(Robot::default());
    let served = tokio::spawn(serve(Ports::open(address).await.unwrap(), robot.clone(), stopping));
    let soon = async |is_so: &dyn Fn() -> bool| {
        let waiting = async {
            while !is_so() {
                tokio::time::sleep(Duration::from_millis(5)).await;
            }
        };
        tokio::time::timeout(Duration::from_secs(10), waiting).await.unwrap();
    };
    for (count, port) in [30_001, 30_002, 30_003].into_iter().enumerate() {
        let mut socket = connect(address, port).await;
        socket.write_all(b"def a():\n  stopl(1)\nend\n").await.unwrap();
        soon(&|| robot.standing().refused.len() > count).await;
        let standing = robot.standing();
        assert!(standing.refused[count].why.contains("planar stage"), "{standing:?}");
        assert_eq!((standing.clients[0].speech.as_str(), standing.program), ("URScript", None));
        drop(socket);
        soon(&|| robot.standing().clients.is_empty()).await;
    }
    stop.send(true).unwrap();
    served.await.unwrap();
}

#[tokio::test]
async fn what_cannot_be_read_is_refused_to_all_clients_and_the_connection_goes_on() {
    let (address, _stop, _served) = started(6).await;
    let (mut script, mut rtde) = (connect(address, 30_002).await, connect(address, 30_004).await);
    rtde.write_all(&[0, 5, b'V', 0, 2]).await.unwrap();
    assert_eq!(read(&mut rtde).await, [0, 4, b'V', 1]);
    let long = [&b"def a():\r\n  # "[..], &vec![b'x'; 70_000], b"\r\nend\r\n"].concat();
    let no_end = b"def c():\r  stopl(1)\r".to_vec();
    for (sent, why) in [
        (long, "a program: the program has more than 262144 bytes, or a line of more than 65536"),
        // Latin-1, and old ends of lines. Without a session there is no arm.
        (b"def b():\r  # zur\xfcck\rend\r".to_vec(), "a program: the session has a planar stage and no arm"),
        (no_end, "a program: the program has no end: the connection ended after 2 lines of it"),
    ] {
        script.write_all(&sent).await.unwrap();
        if why.contains("has no end") {
            script.shutdown().await.unwrap();
        }
        let frame = read(&mut rtde).await;
        assert_eq!(frame[2..4], [b'M', why.len() as u8], "{why}");
        assert_eq!(frame[4..4 + why.len()], *why.as_bytes());
        let said = read(&mut script).await;
        if !why.contains("has no end") {
            assert_eq!(said[..5], [0, 0, 0, said.len() as u8, 20], "{said:?}");
            assert_eq!(said[15..], *why.as_bytes());
        }
    }
}

#[tokio::test]
async fn a_silent_client_leaves_its_inputs() {
    let (address, _stop, _served) = started(7).await;
    let mut first = connect(address, 30_004).await;
    let name = b"input_int_register_24";
    let claim = [&[0, 3 + name.len() as u8, b'I'][..], name].concat();
    first.write_all(&claim).await.unwrap();
    assert_eq!(read(&mut first).await, b"\x00\x09I\x01INT32");
    let mut second = connect(address, 30_004).await;
    second.write_all(&claim).await.unwrap();
    assert_eq!(read(&mut second).await, b"\x00\x0aI\x00IN_USE");
    assert!(read(&mut first).await.is_empty(), "it is disconnected");
    let mut third = connect(address, 30_004).await;
    third.write_all(&claim).await.unwrap();
    assert_eq!(read(&mut third).await, b"\x00\x09I\x01INT32");
}
