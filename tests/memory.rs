//! Memory of a server that clients try to fill: with messages and bodies that never end.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::{Ferry, exchange, ferry, memory_mb};

const SOCKETS: usize = 200;
const UPLOADS: usize = 120;
const MEMORY_MB: u64 = 400;

fn ask(address: SocketAddr, method: &str, path: &str, body: &str) -> (u16, String) {
    let length = body.len();
    let head =
        format!("{method} {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n");
    exchange(address, (head + body).as_bytes())
}

/// The operations of the description that become a WebSocket, and those that take a body.
fn operations(address: SocketAddr) -> (Vec<String>, Vec<(String, String)>) {
    let (_, answer) = ask(address, "GET", "/api/openapi.json", "");
    let document: Value = serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap();
    let (mut sockets, mut uploads) = (Vec::new(), Vec::new());
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            if operation["responses"].get("101").is_some() {
                sockets.push(path.clone());
            }
            if operation.get("requestBody").is_some() {
                uploads.push((method.to_uppercase(), path.clone()));
            }
        }
    }
    (sockets, uploads)
}

/// Writes as much as the server takes, up to a size; the connection stays open.
fn fill(stream: &mut TcpStream, part: &[u8], bytes_most: usize) {
    stream.set_write_timeout(Some(Duration::from_millis(200))).unwrap();
    let mut sent = part.len();
    while sent <= bytes_most && stream.write_all(part).is_ok() {
        sent += part.len();
    }
}

/// A WebSocket whose first message goes on and on, up to its limit.
fn half_open_socket(address: SocketAddr, path: &str, limit: usize) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    let key = "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    write!(
        stream,
        "GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n{key}\r\n\r\n"
    )
    .unwrap();
    let mut status = [0; 12];
    stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
    stream.read_exact(&mut status).unwrap();
    // All places may be taken.
    assert!(
        ["HTTP/1.1 101", "HTTP/1.1 503", "HTTP/1.1 429"].map(str::as_bytes).contains(&&status[..]),
        "{path}: {status:?}"
    );
    // RFC 6455, section 5.2: text that is not final, then its continuations, masked by zero.
    let frame = |kind: u8| {
        let mut frame = vec![kind, 0x80 | 126, 0x01, 0x00, 0, 0, 0, 0];
        frame.resize(8 + 0x100, b' ');
        frame
    };
    if stream.write_all(&frame(0x01)).is_ok() {
        fill(&mut stream, &frame(0x00).repeat(3), limit / 0x100 * 0x108 - 2 * 0x108);
    }
    stream
}

/// A request whose body lacks its last bytes.
fn unfinished_upload(address: SocketAddr, method: &str, path: &str, limit: usize) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    write!(stream, "{method} {path} HTTP/1.1\r\nHost: {address}\r\nTransfer-Encoding: chunked\r\n\r\n").unwrap();
    let part = [b"10000\r\n".as_slice(), &[b'x'; 1 << 16], b"\r\n"].concat();
    fill(&mut stream, &part, limit);
    stream
}

/// The time until the page of a session is there.
fn page_of_another(address: SocketAddr) -> Duration {
    let asked = Instant::now();
    assert_eq!(ask(address, "GET", "/s/anna", "").0, 200);
    asked.elapsed()
}

#[test]
fn messages_and_bodies_that_never_end_fill_no_memory_and_others_are_served() {
    let data = tempfile::tempdir().unwrap();
    let ferry = Ferry::serve(&mut ferry(&[]), data.path());
    let address = ferry.address;
    for session in ["anna", "bea"] {
        assert_eq!(ask(address, "GET", &format!("/s/{session}"), "").0, 200);
    }
    let (sockets, uploads) = operations(address);
    let mut open = Vec::new();
    for number in 0..SOCKETS {
        let (round, route) = (number / sockets.len(), &sockets[number % sockets.len()]);
        let (path, limit) = match route.as_str() {
            "/api/sessions/{id}/live" => {
                let session = ["main", "anna", "bea"][round % 3];
                (format!("/api/sessions/{session}/live"), if round < 8 { 2 << 20 } else { 64 << 10 })
            }
            "/api/controllers/{name}" => (format!("/api/controllers/p{round}?protocol=1"), 16 << 10),
            other => panic!("another route upgrades: {other}; add it here"),
        };
        open.push(half_open_socket(address, &path, limit));
    }
    for number in 0..UPLOADS {
        let (method, path) = &uploads[number % uploads.len()];
        let limit = match path.as_str() {
            "/api/policies/{name}" => 16 << 20,
            path if path.contains("/kinematics/") || path.contains("/magnetics/") => 8 << 20,
            _ => 1 << 20,
        };
        let path = path.replace("{id}", "main").replace("{name}", "posts").replace("{file}", "a");
        open.push(unfinished_upload(address, method, &path, limit));
    }
    let took = (0..5).map(|_| page_of_another(address)).max().unwrap();
    let memory_mb = memory_mb(&ferry.child, "VmRSS").unwrap();
    println!("{memory_mb} MB, a page within {took:?}");
    assert!(memory_mb < MEMORY_MB, "the server has {memory_mb} MB");
    assert!(took < Duration::from_millis(200), "a page took {took:?}");
    // A small body is still read.
    let checked = ask(address, "POST", "/api/map-checks", "<svg/>");
    assert_eq!(checked.0, 422, "{}", checked.1);
    drop(open);
}

/// A grid: it has 22,201 cells.
fn grid(lines: u32) -> String {
    let lines = (0..lines).map(|line| {
        let at = 2.0 + f64::from(line) * 2.2;
        format!("<path d='M{at} 0V330M0 {at}H580'/>")
    });
    let style = "fill='none' stroke='#000' stroke-width='.4'";
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 580 330'><g {style}>{}</g></svg>",
        lines.collect::<String>()
    )
}

#[test]
fn a_drawing_that_costs_much_keeps_no_other_waiting() {
    let data = tempfile::tempdir().unwrap();
    let ferry = Ferry::serve(&mut ferry(&[]), data.path());
    let address = ferry.address;
    page_of_another(address);
    let (status, answer) = ask(address, "POST", "/api/maps", &grid(150));
    let (path, body) = match status {
        201 => {
            let map: Value = serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap();
            ("/api/sessions", json!({"map": map["name"]}).to_string())
        }
        422 => ("/api/map-checks", grid(150)),
        _ => panic!("{answer}"),
    };
    let open = || {
        let begun = Instant::now();
        let (status, answer) = ask(address, "POST", path, &body);
        let took = begun.elapsed();
        assert!([201, 422].contains(&status) && took < Duration::from_secs(2), "{status} after {took:?}: {answer}");
    };
    open();
    std::thread::scope(|scope| {
        for _ in 0..10 {
            scope.spawn(|| ask(address, "POST", path, &body));
        }
        let begun = Instant::now();
        assert_eq!(ask(address, "GET", "/s/bea", "").0, 200);
        let new = begun.elapsed();
        let longest = (0..20).map(|_| page_of_another(address)).max().unwrap();
        println!("a new session after {new:?}, a page within {longest:?}");
        assert!(new < Duration::from_secs(2), "a new session took {new:?}");
        assert!(longest < Duration::from_millis(200), "a page took {longest:?}");
    });
}
