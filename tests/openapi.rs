//! The API's description as a client receives it, and errors that match it.

use serde_json::{Value, json};

use crate::support::{Answer, Laboratory};

fn problem(answer: &Answer) -> Value {
    assert_eq!(answer.header("content-type"), Some("application/problem+json"));
    let problem: Value = serde_json::from_slice(&answer.body).unwrap();
    assert_eq!(problem["status"], json!(answer.status));
    problem
}

#[tokio::test(flavor = "multi_thread")]
async fn the_description_is_served_and_holds_what_was_promised() {
    let lab = Laboratory::open().await;
    let answer = lab.fetch("GET", "/api/openapi.json", &[]).await;
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("application/json")));
    let document: Value = serde_json::from_slice(&answer.body).unwrap();
    assert_eq!(document["openapi"], "3.1.0");
    assert_eq!(document["info"]["version"], env!("CARGO_PKG_VERSION"));
    for (method, path, body) in [
        ("get", "/healthz", None),
        ("get", "/metrics", None),
        ("post", "/api/kinematics/forward", Some("ForwardRequest")),
        ("post", "/api/kinematics/inverse", Some("InverseRequest")),
        ("post", "/api/magnetics/field", Some("FieldRequest")),
        ("get", "/api/maps/{name}", None),
        ("delete", "/api/sessions/{id}", None),
        ("get", "/api/sessions/{id}/live", None),
        ("post", "/api/sessions/{id}/flow", Some("FlowQuery")),
        ("get", "/api/recordings/{file}", None),
        ("patch", "/api/recordings/{file}", Some("RecordingTitle")),
        ("delete", "/api/recordings/{file}", None),
        ("post", "/api/evaluations", Some("EvaluationQuery")),
    ] {
        let operation = &document["paths"][path][method];
        assert!(operation.is_object(), "{method} {path}");
        let schema = &operation["requestBody"]["content"]["application/json"]["schema"]["$ref"];
        assert_eq!(schema.as_str().map(|name| name.rsplit('/').next().unwrap()), body, "{method} {path}");
    }
    let schemas = document["components"]["schemas"].as_object().unwrap();
    let tags = |name: &str| schemas[name]["oneOf"].as_array().unwrap().len();
    assert!(tags("ClientMessage") > 10 && tags("ServerMessage") > 5);
    let point = &schemas["StateMessage"]["properties"]["tool_m"]["$ref"];
    assert_eq!(point, "#/components/schemas/Numbers3");
    assert_eq!((&schemas["Numbers3"]["minItems"], &schemas["Numbers3"]["maxItems"]), (&json!(3), &json!(3)));
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn paths_that_cannot_be_read_and_methods_that_are_not_served_are_problems_too() {
    let lab = Laboratory::open().await;
    for path in ["/api/sessions/main/moments/soon", "/api/sessions/main/moments/-1", "/api/sessions/%FF"] {
        let refused = lab.fetch("GET", path, &[]).await;
        assert_eq!(refused.status, 400, "{path}");
        assert_eq!(problem(&refused)["code"], "malformed", "{path}");
    }
    for (method, path, allowed) in [
        ("PATCH", "/api/maps", "GET,HEAD,POST"),
        ("PUT", "/api/sessions", "GET,HEAD,POST"),
        ("GET", "/api/magnetics/pull", "POST"),
    ] {
        let refused = lab.fetch(method, path, &[]).await;
        assert_eq!((refused.status, refused.header("allow")), (405, Some(allowed)), "{path}");
        let problem = problem(&refused);
        assert!(problem["detail"].as_str().unwrap().contains(method), "{problem}");
    }
    lab.close().await;
}

/// This seed's first free point on this map is farther from the base than the arm is long.
#[tokio::test(flavor = "multi_thread")]
async fn a_session_starts_where_the_arm_comes_to() {
    let lab = Laboratory::open().await;
    let asked = json!({"map": "attractor-example-arm", "seed": 51774, "controller": "rl"});
    let (status, made) = lab.ask("POST", "/api/sessions", &asked.to_string()).await;
    assert_eq!(status, 201, "{made}");
    let (_, state) = lab.ask("GET", &format!("/api/sessions/{}/state", made["id"].as_str().unwrap()), "").await;
    let apart_m = state["tool_m"][0].as_f64().unwrap() - state["bead_m"][0].as_f64().unwrap();
    assert!(apart_m.abs() < 1e-9, "{state}");
    lab.close().await;
}
