//! `/metrics` in Prometheus' text format.

use std::fmt::Write;
use std::sync::Arc;

use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;

use super::Server;

pub async fn metrics(State(server): State<Arc<Server>>) -> impl IntoResponse {
    let hubs = server.sessions.read().expect("no holder panics");
    let mut text = String::new();
    let mut family = |name: &str, kind: &str, help: &str, rows: &mut dyn Iterator<Item = String>| {
        // Writing to a String does not fail.
        let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {kind}");
        rows.for_each(|row| {
            let _ = writeln!(text, "{name}{row}");
        });
    };
    let adapter = server.gpu.adapter_name().replace(['"', '\\', '\n'], " ");
    family(
        "ferry_info",
        "gauge",
        "Version and graphics adapter.",
        &mut std::iter::once(format!("{{version=\"{}\",adapter=\"{adapter}\"}} 1", env!("CARGO_PKG_VERSION"))),
    );
    family("ferry_sessions", "gauge", "Sessions.", &mut std::iter::once(format!(" {}", hubs.len())));
    let views: Vec<_> = hubs.iter().map(|(id, hub)| (id, hub.session.watch().borrow().clone())).collect();
    family(
        "ferry_session_tick",
        "gauge",
        "Ticks since the start of the trial.",
        &mut views.iter().map(|(id, view)| format!("{{session=\"{id}\"}} {}", view.moment.tick)),
    );
    family(
        "ferry_session_speed",
        "gauge",
        "Achieved simulated seconds a second.",
        &mut views.iter().map(|(id, view)| format!("{{session=\"{id}\"}} {}", view.speed_achieved)),
    );
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], text)
}
