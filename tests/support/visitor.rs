//! A browser with its cookies, as far as a server can tell.

use futures_util::StreamExt;
use serde_json::{Value, json};
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::{ClientRequestBuilder, Message};

use super::laboratory::Answer;
use super::{Browser, Laboratory};

/// A browser that keeps its cookie.
#[derive(Clone, Default)]
pub struct Visitor {
    pub cookie: String,
}

impl Visitor {
    pub async fn ask(&mut self, lab: &Laboratory, method: &str, path: &str) -> Answer {
        let own = self.cookie.clone();
        let headers: &[_] = if own.is_empty() { &[] } else { &[("cookie", own.as_str())] };
        let answer = lab.fetch(method, path, headers).await;
        if let Some(set) = answer.header("set-cookie") {
            self.cookie = set.split(';').next().unwrap_or_default().to_owned();
        }
        answer
    }

    /// The name of the session that `/` shows.
    pub async fn home(&mut self, lab: &Laboratory) -> String {
        let answer = self.ask(lab, "GET", "/").await;
        match answer.status {
            200 => "main".to_owned(),
            303 => answer.header("location").unwrap().trim_start_matches("/s/").to_owned(),
            status => panic!("{status}: {}", String::from_utf8_lossy(&answer.body)),
        }
    }

    /// The name of a new session of its own, or the refusal.
    pub async fn open_own(&mut self, lab: &Laboratory) -> Result<String, Value> {
        let answer = self.ask(lab, "POST", "/api/own-sessions").await;
        let body: Value = serde_json::from_slice(&answer.body).unwrap();
        match answer.status {
            201 => {
                let name = body["id"].as_str().unwrap().to_owned();
                assert_eq!(answer.header("location"), Some(&*format!("/s/{name}")));
                Ok(name)
            }
            _ => Err(body),
        }
    }

    /// Opens the page of a session that exists.
    pub async fn sit(&self, lab: &Laboratory, session: &str) -> Page {
        self.sit_again(lab, session, None).await.expect("the session is open")
    }

    /// The same, from a page that was open before; `None` if the session is not open.
    pub async fn sit_again(&self, lab: &Laboratory, session: &str, seat: Option<&str>) -> Option<Page> {
        let query = seat.map_or(String::new(), |seat| format!("?seat={seat}"));
        let address = format!("ws://{}/api/sessions/{session}/live{query}", lab.address);
        let request = ClientRequestBuilder::new(address.parse().unwrap()).with_header("cookie", &self.cookie);
        let (socket, _) = connect_async(request).await.ok()?;
        let mut browser = Browser::of(socket);
        let hello = browser.until("hello", |m| m["type"] == "hello").await;
        Some(Page { browser, seat: hello["seat"].as_str().unwrap().to_owned(), hello, asked: 0 })
    }
}

/// An open page.
pub struct Page {
    pub browser: Browser,
    /// The first one.
    pub hello: Value,
    pub seat: String,
    asked: u64,
}

impl Page {
    pub fn operates(&self) -> bool {
        self.hello["role"] == "operator"
    }

    /// The answer to a command; `None` if the server has closed the connection.
    pub async fn command(&mut self, mut command: Value) -> Option<Value> {
        self.asked += 1;
        command["id"] = json!(self.asked);
        self.browser.socket.send_or_close(&command).await?;
        let is_answer = |m: &Value| (m["type"] == "done" || m["type"] == "refused") && m["id"] == self.asked;
        loop {
            match self.browser.socket.next().await?.ok()? {
                Message::Text(text) => {
                    let message: Value = serde_json::from_str(&text).unwrap();
                    if is_answer(&message) {
                        return Some(message);
                    }
                    if message["type"] == "hello" {
                        self.hello = message;
                    }
                }
                Message::Close(_) => return None,
                _ => {}
            }
        }
    }

    /// Whether a command of this page is carried out; `None` if the server has closed the connection.
    pub async fn can_act(&mut self) -> Option<bool> {
        Some(self.command(json!({"type": "pause"})).await?["type"] == "done")
    }
}

trait SendOrClose {
    async fn send_or_close(&mut self, command: &Value) -> Option<()>;
}

impl<S: futures_util::Sink<Message> + Unpin> SendOrClose for S {
    async fn send_or_close(&mut self, command: &Value) -> Option<()> {
        futures_util::SinkExt::send(self, Message::text(command.to_string())).await.ok()
    }
}
