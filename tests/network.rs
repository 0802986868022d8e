//! Limits of network input: sizes, times, counts.

use std::io::Write;
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use futures_util::{SinkExt, StreamExt};
use serde_json::json;
use tokio_tungstenite::tungstenite::Message;

use ferry::protocol::MAX_MESSAGE_BYTES;

use crate::support::{Laboratory, exchange, gpu, read_answer};

/// Number of connections that send nothing.
const IDLE: usize = 2000;
/// Time limit for a request, plus a margin: later the connection must be closed.
const HEAD_WITHIN: Duration = Duration::from_secs(10);
const CLOSED_WITHIN: Duration = Duration::from_secs(20);

fn head(address: SocketAddr, line: &str, headers: &str) -> String {
    format!("{line} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{headers}\r\n")
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_too_large_is_refused_and_the_server_goes_on() {
    let lab = Laboratory::open().await;
    let address = lab.address;
    let asked = tokio::task::spawn_blocking(move || {
        let long = "x".repeat(512 << 10);
        let many: String = (0..80).map(|i| format!("X-{i}: 1\r\n")).collect();
        let status = |request: String| exchange(address, request.as_bytes()).0;
        // When the server closes before it has read everything, the answer may be lost: 0.
        assert!(matches!(status(head(address, "GET /healthz", &format!("X-Long: {long}\r\n"))), 431 | 0));
        assert_eq!(status(head(address, "GET /healthz", &many)), 431);
        // Smaller than the buffer into which it is read.
        assert_eq!(status(head(address, "GET /healthz", &format!("X-Long: {}\r\n", &long[..100_000]))), 431);
        assert_eq!(status(head(address, "GET /healthz", &format!("X-Long: {}\r\n", &long[..60_000]))), 200);
        assert!(matches!(status(head(address, &format!("GET /{long}"), "")), 414 | 431 | 0));
        let claimed = "Content-Length: 1048577\r\n";
        let body = "y".repeat((1 << 20) + 1);
        assert_eq!(status(head(address, "POST /api/maps", claimed) + &body), 413);
        // An endless body is refused at the size limit.
        let mut stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        stream.write_all(head(address, "POST /api/maps", "Transfer-Encoding: chunked\r\n").as_bytes()).unwrap();
        let chunk = format!("10000\r\n{}\r\n", "z".repeat(1 << 16));
        let sent = (0..1000).take_while(|_| stream.write_all(chunk.as_bytes()).is_ok()).count();
        assert!(sent < 1000, "64 MB were taken in");
        assert!(matches!(read_answer(&mut stream).0, 413 | 0));
    });
    asked.await.unwrap();

    let mut browser = lab.browser().await;
    browser.until("hello", |m| m["type"] == "hello").await;
    let padding = "p".repeat(MAX_MESSAGE_BYTES);
    // The server may close the socket before it has read everything.
    let _ = browser.socket.send(Message::text(format!("{{\"type\":\"run\",\"{padding}\":1}}"))).await;
    let closed = async { while let Some(Ok(_)) = browser.socket.next().await {} };
    tokio::time::timeout(Duration::from_secs(10), closed).await.expect("its socket is closed");
    let mut next = lab.browser().await;
    let hello = next.until("hello", |m| m["type"] == "hello").await;
    assert_eq!(hello["role"], "operator", "the seat is free again");
    let state = next.state("the state", |_| true).await;
    assert_eq!(state["running"], false);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_refusal_is_a_page_for_who_asked_for_a_page() {
    let lab = Laboratory::open_with(gpu(), None, |settings| settings.sessions = 1).await;
    let address = lab.address;
    let asked = tokio::task::spawn_blocking(move || {
        let accepts = "Accept: text/html,application/xhtml+xml;q=0.9,*/*;q=0.8\r\n";
        let cases = [("/s/%3Cscript%3Ealert(1)%3C%2Fscript%3E", 404), ("/s/anna", 429), ("/nowhere", 404)];
        for (path, refused) in cases {
            let (status, page) = exchange(address, head(address, &format!("GET {path}"), accepts).as_bytes());
            assert_eq!(status, refused, "{path}");
            let lower = page.to_lowercase();
            assert!(lower.contains("content-type: text/html") && lower.contains("content-security-policy"), "{page}");
            assert!(
                page.contains("<h1>Ferry</h1>") && !page.contains("{{") && !page.contains("<script>alert"),
                "{page}"
            );
            let (status, problem) = exchange(address, head(address, &format!("GET {path}"), "").as_bytes());
            assert_eq!(status, refused, "{path}");
            assert!(problem.contains("application/problem+json"), "{problem}");
        }
        let wrong = exchange(address, head(address, "GET /s/%3Cscript%3E", accepts).as_bytes()).1;
        assert!(wrong.contains("&lt;script&gt;") && wrong.contains("1 to 32 of a to z"), "{wrong}");
        let full = exchange(address, head(address, "GET /s/anna", accepts).as_bytes()).1;
        assert!(full.contains("the server is full"), "{full}");
        // The API answers every client in its own format.
        let (status, problem) = exchange(address, head(address, "GET /api/nowhere", accepts).as_bytes());
        assert!(status == 404 && problem.contains("application/problem+json"), "{problem}");
    });
    asked.await.unwrap();
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn slow_and_idle_connections_are_closed_and_others_are_served() {
    let lab = Laboratory::open().await;
    let address = lab.address;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "run"})).await;

    let idle = tokio::task::spawn_blocking(move || {
        (0..IDLE).map(|_| TcpStream::connect(address).expect("there is room")).collect::<Vec<_>>()
    });
    let idle = idle.await.unwrap();
    let began = Instant::now();
    // A head and a body with one byte per second.
    let drip = move |text: String, rest: &'static str| {
        let mut stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        stream.write_all(text.as_bytes()).unwrap();
        let began = Instant::now();
        for byte in rest.bytes().cycle() {
            std::thread::sleep(Duration::from_secs(1));
            if stream.write_all(&[byte]).is_err() || began.elapsed() > HEAD_WITHIN + Duration::from_secs(2) {
                break;
            }
        }
        (read_answer(&mut stream).0, began.elapsed())
    };
    let slow_head = tokio::task::spawn_blocking(move || drip("GET /healthz HTTP/1.1\r\nX: ".into(), "a"));
    let slow_body =
        tokio::task::spawn_blocking(move || drip(head(address, "POST /api/maps", "Content-Length: 1000\r\n"), "b"));

    // Other clients are served meanwhile.
    let mut slowest = Duration::ZERO;
    while began.elapsed() < Duration::from_secs(5) {
        let asked = Instant::now();
        assert_eq!(lab.ask("GET", "/api/sessions/main/state", "").await.0, 200);
        slowest = slowest.max(asked.elapsed());
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    assert!(slowest < Duration::from_secs(2), "an answer took {slowest:?}");
    let tick = browser.state("a state", |_| true).await["tick"].as_u64();
    browser.state("time goes on", |m| m["tick"].as_u64() > tick.map(|tick| tick + 100)).await;

    let (status, took) = slow_head.await.unwrap();
    assert!(matches!(status, 408 | 0) && took < CLOSED_WITHIN, "head: {status} after {took:?}");
    let (status, took) = slow_body.await.unwrap();
    assert!(matches!(status, 408 | 0) && took < CLOSED_WITHIN, "body: {status} after {took:?}");
    let closed = tokio::task::spawn_blocking(move || {
        let is_closed = |stream: &TcpStream| {
            stream.set_read_timeout(Some(CLOSED_WITHIN)).unwrap();
            // The answer is 408 or missing.
            let mut told = Vec::new();
            match std::io::Read::read_to_end(&mut &*stream, &mut told) {
                Ok(_) => true,
                Err(error) => error.kind() == std::io::ErrorKind::ConnectionReset,
            }
        };
        idle.iter().filter(|stream| is_closed(stream)).count()
    });
    assert_eq!(closed.await.unwrap(), IDLE);
    assert!(began.elapsed() < HEAD_WITHIN + CLOSED_WITHIN, "{:?}", began.elapsed());
    let open = async {
        loop {
            let metrics = lab.ask("GET", "/metrics", "").await.1;
            let text = metrics.as_str().unwrap().to_owned();
            let line = text.lines().find(|line| line.starts_with("ferry_connections ")).unwrap().to_owned();
            if line.rsplit(' ').next().unwrap().parse::<u32>().unwrap() < 10 {
                break;
            }
            tokio::time::sleep(Duration::from_millis(200)).await;
        }
    };
    tokio::time::timeout(CLOSED_WITHIN, open).await.expect("the connections close");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_flood_of_messages_is_delayed_and_others_are_served() {
    let lab = Laboratory::open().await;
    let mut flooding = lab.browser().await;
    let mut watching = lab.browser().await;
    flooding.send(json!({"type": "run"})).await;
    watching.state("running", |m| m["running"] == true).await;
    let flood = tokio::spawn(async move {
        for _ in 0..20_000 {
            let message = Message::text("{\"type\":\"set_speed\",\"factor\":1}");
            let sent = tokio::time::timeout(Duration::from_secs(1), flooding.socket.feed(message)).await;
            if !matches!(sent, Ok(Ok(()))) {
                break;
            }
        }
        flooding
    });
    let tick = watching.state("a state", |_| true).await["tick"].as_u64().unwrap();
    let began = Instant::now();
    watching.state("time goes on", |m| m["tick"].as_u64() > Some(tick + 250)).await;
    assert!(began.elapsed() < Duration::from_secs(6), "{:?}", began.elapsed());
    drop(flood.await.unwrap());
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn below_a_path_addresses_work_with_it_and_without() {
    let lab = Laboratory::open_with(gpu(), None, |settings| settings.base = "/ferry".parse().unwrap()).await;
    let address = lab.address;
    let asked = tokio::task::spawn_blocking(move || {
        let ask = |line: &str, headers: &str| exchange(address, head(address, line, headers).as_bytes());
        for page in ["/ferry", "/ferry/", "/ferry/s/anna", "/", "/s/anna", "/ferry/viewer/"] {
            let (status, text) = ask(&format!("GET {page}"), "");
            assert_eq!(status, 200, "{page}: {text}");
            assert!(text.contains("=\"/ferry/assets/") && !text.contains("=\"/assets/"), "{page}: {text}");
        }
        let (status, text) = ask("POST /ferry/api/sessions", "Content-Length: 2\r\n\r\n{}");
        assert_eq!(status, 201, "{text}");
        assert!(text.to_lowercase().contains("\nlocation: /ferry/api/sessions/"), "{text}");
        for none in ["/ferryman/", "/api/ferry/"] {
            assert_eq!(ask(&format!("GET {none}"), "").0, 404, "{none}");
        }
    });
    asked.await.unwrap();
    let (mut socket, _) =
        tokio_tungstenite::connect_async(format!("ws://{address}/ferry/api/sessions/main/live")).await.unwrap();
    assert!(socket.next().await.unwrap().unwrap().is_text());
    lab.close().await;
}
