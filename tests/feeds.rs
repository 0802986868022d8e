//! What programs without a WebSocket read: the camera as motion JPEG, and the tracker.

use std::time::Duration;

use ferry::http::Token;
use ferry_core::image::Picture;
use serde_json::{Value, json};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

use crate::support::{Laboratory, gpu};

const WITHIN: Duration = Duration::from_secs(30);

/// An image of a stream.
struct Image {
    tick: u64,
    jpeg: Vec<u8>,
}

impl Image {
    fn decoded(&self) -> Picture {
        let mut decoder = zune_jpeg::JpegDecoder::new(std::io::Cursor::new(&self.jpeg));
        let rgb = decoder.decode().unwrap();
        let (width, height) = decoder.dimensions().unwrap();
        let rgba = rgb.chunks(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect();
        Picture { width_px: width as u32, height_px: height as u32, rgba }
    }
}

/// A camera stream that is read image by image.
struct Stream {
    socket: TcpStream,
    bytes: Vec<u8>,
}

impl Stream {
    async fn open(lab: &Laboratory, session: &str) -> Self {
        let mut socket = TcpStream::connect(lab.address).await.unwrap();
        let request = format!("GET /api/sessions/{session}/camera.mjpeg HTTP/1.0\r\nhost: {}\r\n\r\n", lab.address);
        socket.write_all(request.as_bytes()).await.unwrap();
        let mut stream = Self { socket, bytes: Vec::new() };
        let head = stream.head().await.unwrap();
        assert!(head.starts_with("HTTP/1.0 200"), "{head}");
        assert!(head.contains("content-type: multipart/x-mixed-replace; boundary=ferry"), "{head}");
        stream
    }

    /// Text up to the next empty line; `None` when the server has closed.
    async fn head(&mut self) -> Option<String> {
        loop {
            if let Some(end) = self.bytes.windows(4).position(|four| four == b"\r\n\r\n") {
                let head = self.bytes.drain(..end + 4).collect();
                return Some(String::from_utf8(head).unwrap());
            }
            self.read().await?;
        }
    }

    async fn read(&mut self) -> Option<()> {
        let reading = self.socket.read_buf(&mut self.bytes);
        let count = tokio::time::timeout(WITHIN, reading).await.expect("it goes on or ends").unwrap();
        (count > 0).then_some(())
    }

    /// The next image; `None` after the last one.
    async fn image(&mut self) -> Option<Image> {
        let Some(head) = self.head().await else {
            assert_eq!(String::from_utf8_lossy(&self.bytes), "--ferry--\r\n");
            return None;
        };
        let field = |name: &str| {
            let line =
                head.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_else(|| panic!("{name}: {head}"));
            line.trim_start_matches(": ").to_owned()
        };
        assert!(head.starts_with("--ferry\r\n"), "{head}");
        assert_eq!(field("Content-Type"), "image/jpeg");
        let length: usize = field("Content-Length").parse().unwrap();
        while self.bytes.len() < length + 2 {
            self.read().await.expect("the image is whole");
        }
        let jpeg = self.bytes.drain(..length).collect();
        assert_eq!(self.bytes.drain(..2).collect::<Vec<_>>(), b"\r\n");
        Some(Image { tick: field("X-Ferry-Tick").parse().unwrap(), jpeg })
    }

    /// The first image at or after a tick.
    async fn image_from(&mut self, tick: u64) -> Image {
        loop {
            let image = self.image().await.expect("the stream goes on");
            if image.tick >= tick {
                return image;
            }
        }
    }
}

/// Mean difference of two pictures, in levels.
fn apart(one: &Picture, other: &Picture) -> f64 {
    assert_eq!((one.width_px, one.height_px), (other.width_px, other.height_px));
    let levels = one.rgba.iter().zip(&other.rgba).map(|(a, b)| f64::from(a.abs_diff(*b)));
    levels.sum::<f64>() / one.rgba.len() as f64
}

#[tokio::test(flavor = "multi_thread")]
async fn the_stream_shows_what_the_controllers_camera_sees() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "load_scenario", "map": "posts", "start_m": [-0.25, -0.38]})).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    let mut stream = Stream::open(&lab, "main").await;
    let first = stream.image_from(0).await;
    let mut last = first.decoded();
    assert_eq!((first.tick, last.width_px, last.height_px), (0, 480, 480));
    for ticks in [125, 250, 375] {
        browser.send(json!({"type": "step", "ticks": 125})).await;
        browser.state("a second", |m| m["tick"] == ticks).await;
        // The last control step began at most 32 ticks before.
        let image = stream.image_from(ticks - 32).await;
        let shown = image.decoded();
        let original = Picture::from_png(&lab.bytes("/api/sessions/main/camera.png").await).unwrap();
        let then = lab.bytes(&format!("/api/sessions/main/moments/{}/camera.png", image.tick - 1)).await;
        assert_eq!(Picture::from_png(&then).unwrap(), original, "tick {}", image.tick);
        let (loss, change) = (apart(&shown, &original), apart(&shown, &last));
        assert!(loss < 1.0 && change > 2.0 * loss, "{loss} {change}");
        last = shown;
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stream_ends_after_the_images_asked_for_with_its_session_and_with_the_server() {
    let lab = Laboratory::open().await;
    let one = lab.fetch("GET", "/api/sessions/main/camera.mjpeg?frames=1", &[]).await;
    assert_eq!((one.status, one.header("cache-control")), (200, Some("no-store")));
    assert!(one.body.starts_with(b"--ferry\r\n") && one.body.ends_with(b"\r\n--ferry--\r\n"));
    assert_eq!(lab.bytes("/api/sessions/main/camera.mjpeg?frames=1").await, one.body, "in chunks, too");
    assert_eq!(lab.fetch("HEAD", "/api/sessions/main/camera.mjpeg", &[]).await.body, b"");

    let (_, made) = lab.ask("POST", "/api/sessions", "").await;
    let id = made["id"].as_str().unwrap();
    let mut stream = Stream::open(&lab, id).await;
    assert_eq!(stream.image().await.unwrap().tick, 0);
    assert_eq!(lab.ask("DELETE", &format!("/api/sessions/{id}"), "").await.0, 204);
    let ended = tokio::time::timeout(Duration::from_secs(2), stream.image()).await;
    assert!(ended.expect("it ends with its session").is_none());

    let mut read = Stream::open(&lab, "main").await;
    let _unread = Stream::open(&lab, "main").await;
    assert_eq!(read.image().await.unwrap().tick, 0);
    lab.close().await;
    assert!(read.image().await.is_none());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_paused_session_sends_its_last_image_again_so_that_clients_do_not_give_up() {
    let lab = Laboratory::open().await;
    let began = tokio::time::Instant::now();
    let mut stream = Stream::open(&lab, "main").await;
    let first = stream.image().await.unwrap();
    let again = stream.image().await.unwrap();
    assert!(began.elapsed() > Duration::from_secs(3));
    assert!(again.tick == first.tick && again.jpeg == first.jpeg);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_open_stream_keeps_its_session_from_being_parked() {
    let park_after = Duration::from_millis(300);
    let lab = Laboratory::open_with(gpu(), None, |settings| settings.park_after = park_after).await;
    lab.ask("GET", "/s/anna", "").await;
    let is_parked = async || lab.ask("GET", "/api/sessions", "").await.1["sessions"][0]["parked"] == true;
    let mut stream = Stream::open(&lab, "anna").await;
    stream.image().await.unwrap();
    // The list is not a request for the session.
    tokio::time::sleep(4 * park_after).await;
    assert!(!is_parked().await);
    drop(stream);
    let parked = async {
        while !is_parked().await {
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    tokio::time::timeout(WITHIN, parked).await.expect("it is parked");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_number_of_streams_is_limited_and_counted() {
    let lab = Laboratory::open().await;
    let mut streams = Vec::new();
    for _ in 0..16 {
        streams.push(Stream::open(&lab, "main").await);
    }
    let path = "/api/sessions/main/camera.mjpeg?frames=1";
    let (status, problem) = lab.ask("GET", path, "").await;
    assert_eq!((status, &problem["code"]), (429, &json!("too_many_streams")));
    assert!(problem["detail"].as_str().unwrap().starts_with("16 camera streams"), "{problem}");
    let counted =
        async || lab.ask("GET", "/metrics", "").await.1.as_str().unwrap().contains("ferry_camera_streams 16\n");
    assert!(counted().await);
    streams.pop();
    let freed = async {
        while counted().await {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    };
    tokio::time::timeout(WITHIN, freed).await.expect("a client that leaves gives its place back");
    assert_eq!(lab.fetch("GET", path, &[]).await.status, 200);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_requests_and_requests_without_the_token_are_refused() {
    let token = Token::generate().unwrap();
    let lab = Laboratory::open_with(gpu(), Some(&token), |_| ()).await;
    let bearer = format!("Bearer {token}");
    let headers = [("authorization", bearer.as_str())];
    for frames in ["0", "100001", "-3", "many", ""] {
        let path = format!("/api/sessions/main/camera.mjpeg?frames={frames}");
        let (status, problem) = lab.ask_with("GET", &path, "", &headers).await;
        assert_eq!((status, &problem["field"], &problem["code"]), (422, &json!("frames"), &json!("out_of_range")));
        assert!(problem["detail"].as_str().unwrap().contains(&format!("frames is {frames:?}")), "{problem}");
    }
    let (status, problem) = lab.ask_with("GET", "/api/sessions/main/camera.mjpeg?speed=2", "", &headers).await;
    assert!(status == 400 && problem["detail"].as_str().unwrap().contains("speed"), "{problem}");
    for path in ["camera.mjpeg?frames=1", "tracker"] {
        let (status, problem) = lab.ask_with("GET", &format!("/api/sessions/missing/{path}"), "", &headers).await;
        assert_eq!((status, &problem["code"]), (404, &json!("not_found")), "{path}");
        assert_eq!(lab.fetch("GET", &format!("/api/sessions/main/{path}"), &[]).await.status, 401, "{path}");
        assert_eq!(lab.fetch("GET", &format!("/api/sessions/main/{path}"), &headers).await.status, 200, "{path}");
    }
    lab.close().await;
}

async fn tracker_and_state(lab: &Laboratory) -> (Value, Value) {
    let (status, tracker) = lab.ask("GET", "/api/sessions/main/tracker", "").await;
    assert_eq!(status, 200, "{tracker}");
    let state = lab.ask("GET", "/api/sessions/main/state", "").await.1;
    (tracker, state)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[tokio::test(flavor = "multi_thread")]
async fn the_tracker_tells_its_estimate_and_not_the_truth() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let mut parameters = lab.default_parameters().await;
    parameters["tracker_bias_x_m"] = json!(0.015);
    parameters["tracker_latency_ticks"] = json!(3);
    browser.send(json!({"type": "configure", "parameters": parameters})).await;
    browser.send(json!({"type": "step", "ticks": 20})).await;
    browser.state("twenty ticks", |m| m["tick"] == 20).await;
    let (tracker, state) = tracker_and_state(&lab).await;
    assert_eq!((&tracker["tick"], &tracker["sim_time_s"]), (&json!(20), &state["sim_time_s"]));
    assert_eq!((&tracker["x_m"], &tracker["y_m"]), (&state["bead_tracked_m"][0], &state["bead_tracked_m"][1]));
    let off_m = number(&tracker["x_m"]) - number(&state["bead_m"][0]);
    assert!((off_m - 0.015).abs() < 0.006 && off_m != 0.015, "bias and noise: {off_m}");
    assert!(number(&tracker["x_m_s"]) != 0.0 && number(&tracker["y_m_s"]) != 0.0, "{tracker}");
    assert!((number(&tracker["age_s"]) - 0.024).abs() < 1e-9, "{tracker}");
    assert_eq!((&tracker["is_lost"], &tracker["goal"]), (&json!(false), &Value::Null));

    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "disturb", "disturbance": {"dropout": {"for_s": 60.0}}})).await;
    browser.send(json!({"type": "step", "ticks": 100})).await;
    browser.state("a hundred ticks more", |m| m["tick"] == 120).await;
    let (silent, state) = tracker_and_state(&lab).await;
    assert_eq!(silent["goal"], json!({"x_m": 0.12, "y_m": -0.33}));
    assert_eq!((&silent["is_lost"], &silent["x_m"]), (&json!(true), &state["bead_tracked_m"][0]));
    assert!(number(&silent["age_s"]) > 0.7, "{silent}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_running_session_tells_an_estimate_of_its_last_quarter_second() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "run"})).await;
    let mut last = 0;
    while last < 125 {
        let before = lab.ask("GET", "/api/sessions/main/state", "").await.1["tick"].as_u64().unwrap();
        let tick = lab.ask("GET", "/api/sessions/main/tracker", "").await.1["tick"].as_u64().unwrap();
        assert!(tick + 32 >= before && tick >= last, "{last}, {before}, {tick}");
        last = tick;
        // A client may send 500 requests per second.
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    lab.close().await;
}
