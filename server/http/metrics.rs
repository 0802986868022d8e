//! `/metrics` for Prometheus.

use std::sync::Arc;

use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::IntoResponse;
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::registry::Registry;

use super::problem::Problem;
use super::{CAMERA_STREAMS, Server};
use ferry_core::trial::RecordingFact;

type Labels = Vec<(&'static str, String)>;
type Floats = Gauge<f64, std::sync::atomic::AtomicU64>;

/// Counters since the server started, updated by all connections.
#[derive(Default)]
pub struct Counters {
    answers: Family<Labels, Counter>,
    refusals: Family<Labels, Counter>,
    logins: Family<Labels, Counter>,
    connections: Gauge,
    refused_connections: Counter,
}

impl Counters {
    pub fn answer(&self, status: StatusCode) {
        self.answers.get_or_create(&vec![("status", status.as_u16().to_string())]).inc();
    }

    /// A request was refused; the set of codes is small.
    pub fn refuse(&self, code: &str) {
        self.refusals.get_or_create(&vec![("code", code.to_owned())]).inc();
    }

    pub fn login(&self, succeeded: bool) {
        let outcome = if succeeded { "let in" } else { "refused" };
        self.logins.get_or_create(&vec![("outcome", outcome.to_owned())]).inc();
    }

    pub fn connect(&self, change: i64) {
        self.connections.inc_by(change);
    }

    /// A connection was refused because of the limit.
    pub fn refuse_connection(&self) {
        self.refused_connections.inc();
    }
}

/// Metrics for Prometheus.
#[utoipa::path(get, path = "/metrics", tag = "server", responses((status = 200, description = "Families of figures.",
    content_type = "application/openmetrics-text; version=1.0.0; charset=utf-8", body = String)))]
pub async fn metrics(State(server): State<Arc<Server>>) -> Result<impl IntoResponse, Problem> {
    let mut text = String::new();
    encode(&mut text, &registry(&server)).map_err(Problem::internal)?;
    Ok(([(header::CONTENT_TYPE, "application/openmetrics-text; version=1.0.0; charset=utf-8")], text))
}

/// Built for each request, because sessions come and go.
fn registry(server: &Server) -> Registry {
    let mut registry = Registry::with_prefix("ferry");
    let counters = &server.counters;
    registry.register("http_answers", "Answers by status", counters.answers.clone());
    registry.register("http_refusals", "Requests refused, by the problem's code", counters.refusals.clone());
    registry.register("logins", "Logins", counters.logins.clone());
    registry.register("connections", "Open connections", counters.connections.clone());
    registry.register(
        "connections_turned_away",
        "Connections refused because the limit was reached",
        counters.refused_connections.clone(),
    );

    let info = Family::<Labels, Gauge>::default();
    let adapter = server.gpu.adapter_name().to_owned();
    info.get_or_create(&vec![("version", env!("CARGO_PKG_VERSION").to_owned()), ("adapter", adapter)]).set(1);
    registry.register("info", "Version and graphics adapter", info);

    let hubs = server.sessions.all();
    let of_sessions = Gauge::<i64>::default();
    of_sessions.set(hubs.len() as i64);
    registry.register("sessions", "Sessions", of_sessions);
    let of_streams = Gauge::<i64>::default();
    of_streams.set(CAMERA_STREAMS.saturating_sub(server.camera_streams.available_permits()) as i64);
    registry.register("camera_streams", "Open camera streams", of_streams);
    let floats = [
        ("session_tick", "Ticks since the start of the trial"),
        ("session_speed", "Achieved simulated seconds per second"),
        ("session_lateness_seconds", "Delay of the latest tick in the last half second"),
        ("session_missed_deadlines", "How often the session skipped lost time since it began"),
        ("session_viewers", "Browsers"),
        ("session_parked", "Whether it is paused because no browser watches it"),
        ("session_ended", "Whether it has ended because of a fault"),
        ("session_recording", "Whether it is recorded"),
    ]
    .map(|(name, help)| {
        let family = Family::<Labels, Floats>::default();
        registry.register(name, help, family.clone());
        family
    });
    for hub in &hubs {
        let view = hub.session.watch().borrow().clone();
        let values = [
            view.moment.tick as f64,
            view.speed_achieved,
            view.lateness.as_secs_f64(),
            view.missed_deadlines as f64,
            hub.viewers() as f64,
            f64::from(u8::from(hub.is_parked())),
            f64::from(u8::from(view.ended.is_some())),
            f64::from(u8::from(matches!(view.recording, RecordingFact::On | RecordingFact::Slow { .. }))),
        ];
        let labels: Labels = vec![("session", hub.id.clone())];
        for (family, value) in floats.iter().zip(values) {
            family.get_or_create(&labels).set(value);
        }
    }
    registry
}
