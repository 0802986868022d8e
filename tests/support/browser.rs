//! A WebSocket client.

use std::net::SocketAddr;
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use serde_json::Value;
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

/// One WebSocket.
pub struct Browser {
    pub socket: WebSocketStream<MaybeTlsStream<TcpStream>>,
}

impl Browser {
    /// Connects to the session `main` of a server.
    pub async fn at(address: SocketAddr) -> Self {
        Self::with(address, "").await
    }

    /// The same with parameters.
    pub async fn with(address: SocketAddr, query: &str) -> Self {
        let (socket, _) = connect_async(format!("ws://{address}/api/sessions/main/live{query}")).await.unwrap();
        Self::of(socket)
    }

    pub fn of(socket: WebSocketStream<MaybeTlsStream<TcpStream>>) -> Self {
        Self { socket }
    }

    pub async fn send(&mut self, message: Value) {
        self.send_text(&message.to_string()).await;
    }

    pub async fn send_text(&mut self, text: &str) {
        self.socket.send(Message::text(text)).await.unwrap();
    }

    /// Waits up to 30 s for a text message that fits.
    pub async fn until(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let found = self.whenever(what, fits);
        tokio::time::timeout(Duration::from_secs(30), found).await.unwrap_or_else(|_| panic!("waited in vain: {what}"))
    }

    /// Waits for a text message that fits, as long as it takes.
    pub async fn whenever(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        while let Some(message) = self.socket.next().await {
            if let Message::Text(text) = message.unwrap_or_else(|error| panic!("{error} before: {what}")) {
                let value: Value = serde_json::from_str(&text).unwrap();
                if fits(&value) {
                    return value;
                }
            }
        }
        panic!("the server closed before: {what}");
    }

    /// Awaits something else, and reads on meanwhile: the server disconnects a client that reads nothing.
    pub async fn during<T>(&mut self, other: impl Future<Output = T>) -> T {
        let mut other = std::pin::pin!(other);
        loop {
            tokio::select! {
                done = &mut other => return done,
                message = self.socket.next() => drop(message.expect("the server closed").unwrap()),
            }
        }
    }

    pub async fn state(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        self.until(what, |m| m["type"] == "state" && fits(m)).await
    }

    pub async fn error(&mut self) -> Value {
        self.until("an error", |m| m["type"] == "error").await
    }
}
