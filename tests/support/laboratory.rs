//! A server in this process.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use ferry::http::{self, Settings};
use ferry_camera::Gpu;
use serde_json::Value;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio::task::JoinHandle;

use super::{Browser, gpu};

/// A server in this process, and the folder it writes to.
pub struct Laboratory {
    pub address: SocketAddr,
    pub data: tempfile::TempDir,
    stop: watch::Sender<bool>,
    served: JoinHandle<()>,
}

impl Laboratory {
    pub async fn open() -> Self {
        Self::open_on(gpu()).await
    }

    /// The same with a separate graphics device.
    pub async fn open_on(gpu: Arc<Gpu>) -> Self {
        Self::open_with(gpu, None, |_| ()).await
    }

    /// The same with a token or other settings.
    pub async fn open_with(gpu: Arc<Gpu>, token: Option<&str>, change: impl FnOnce(&mut Settings)) -> Self {
        let data = tempfile::tempdir().unwrap();
        let (stop, stopping) = watch::channel(false);
        let listener = http::listen("127.0.0.1:0".parse().unwrap()).await.unwrap();
        let address = listener.local_addr().unwrap();
        let access = http::Access::new(address, token.map(|token| token.parse().unwrap()), &[]).unwrap();
        let mut settings = Settings::in_folder(data.path().to_owned());
        settings.page = http::Page::new(ferry_assets::FILES);
        change(&mut settings);
        let server = http::Server::new(gpu, settings, access, stopping).unwrap();
        let served = tokio::spawn(async move { http::serve(listener, server).await.unwrap() });
        Self { address, data, stop, served }
    }

    pub async fn browser(&self) -> Browser {
        Browser::at(self.address).await
    }

    /// The parameters' defaults, from a second browser's scene.
    pub async fn default_parameters(&self) -> Value {
        self.browser().await.until("scene", |m| m["type"] == "scene").await["defaults"].clone()
    }

    /// Status and body of a request.
    pub async fn ask(&self, method: &str, path: &str, body: &str) -> (u16, Value) {
        self.ask_with(method, path, body, &[]).await
    }

    /// The same with headers.
    pub async fn ask_with(&self, method: &str, path: &str, body: &str, headers: &[(&str, &str)]) -> (u16, Value) {
        let (status, text) = self.ask_text(method, path, body, headers).await;
        (status, serde_json::from_str(&text).unwrap_or(Value::String(text)))
    }

    /// Body of a file.
    pub async fn bytes(&self, path: &str) -> Vec<u8> {
        let address = format!("http://{}{path}", self.address);
        let read = move || ureq::get(address).call().unwrap().body_mut().read_to_vec().unwrap();
        tokio::task::spawn_blocking(read).await.unwrap()
    }

    pub async fn ask_text(&self, method: &str, path: &str, body: &str, headers: &[(&str, &str)]) -> (u16, String) {
        let mut request = ureq::http::Request::builder().method(method).uri(format!("http://{}{path}", self.address));
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        let request = request.body(body.to_owned()).unwrap();
        tokio::task::spawn_blocking(move || {
            let agent = ureq::Agent::config_builder().http_status_as_error(false).build().new_agent();
            let mut response = agent.run(request).unwrap();
            (response.status().as_u16(), response.body_mut().read_to_string().unwrap_or_default())
        })
        .await
        .unwrap()
    }

    /// Stops the server like SIGTERM, and waits.
    pub async fn close(self) -> tempfile::TempDir {
        self.stop.send(true).unwrap();
        tokio::time::timeout(Duration::from_secs(5), self.served).await.expect("closes in time").unwrap();
        self.data
    }
}

/// A plain answer.
pub struct Answer {
    pub status: u16,
    headers: BTreeMap<String, String>,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.get(name).map(String::as_str)
    }
}

impl Laboratory {
    /// Sends a request without an HTTP client, because a client would decompress the answer.
    pub async fn fetch(&self, method: &str, path: &str, headers: &[(&str, &str)]) -> Answer {
        let mut stream = TcpStream::connect(self.address).await.unwrap();
        let mut request = format!("{method} {path} HTTP/1.0\r\nhost: {}\r\n", self.address);
        for (name, value) in headers {
            request += &format!("{name}: {value}\r\n");
        }
        stream.write_all(format!("{request}\r\n").as_bytes()).await.unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).await.unwrap();
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n").expect("the head ends");
        let body = answer.split_off(end + 4);
        let head = String::from_utf8(answer).unwrap();
        let mut lines = head.trim_end().lines();
        let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
        let header =
            |line: &str| line.split_once(": ").map(|(name, value)| (name.to_owned(), value.to_owned())).unwrap();
        Answer { status, headers: lines.map(header).collect(), body }
    }
}
