//! The HTTP routes that calculate arm and magnet, and their errors.

use serde_json::{Value, json};

use crate::support::Laboratory;

#[tokio::test(flavor = "multi_thread")]
async fn the_calculator_answers_for_arm_and_magnet() {
    let lab = Laboratory::open().await;
    let body = json!({"joints_rad": [[0, 0, 0, 0, 0, 0], [0.1, -1.2, 1.5, -1.8, -1.4, 0.6]]}).to_string();
    let (status, forward) = lab.ask("POST", "/api/kinematics/forward", &body).await;
    assert_eq!(status, 200, "{forward}");
    let at_zero = &forward["flange"][0]["position_m"];
    for (i, expected) in [-0.81725, -0.19145, -0.005491].into_iter().enumerate() {
        assert!((at_zero[i].as_f64().unwrap() - expected).abs() < 1e-9, "{at_zero}");
    }
    let far = json!({"position_m": [2, 0, 0], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]});
    let body = json!({"poses": [forward["flange"][1], far]}).to_string();
    let (status, inverse) = lab.ask("POST", "/api/kinematics/inverse", &body).await;
    assert_eq!(status, 200, "{inverse}");
    let near =
        |joints: &Value| (joints[0].as_f64().unwrap() - 0.1).abs() + (joints[5].as_f64().unwrap() - 0.6).abs() < 1e-9;
    assert!(inverse["solutions"][0].as_array().unwrap().iter().any(near), "{inverse}");
    assert_eq!(inverse["solutions"][1], json!([]));

    let magnet = json!({"size_m": [0.05, 0.025, 0.01], "polarization_t": [0, 0, 1.19], "position_m": [0, 0, 0.1]});
    let body = json!({"magnet": magnet, "points_m": [[0, 0, 0.0025], [0, 0, 0.1]], "moment_a_m2": 0.0677}).to_string();
    let (status, field) = lab.ask("POST", "/api/magnetics/field", &body).await;
    assert_eq!(status, 200, "{field}");
    // Specification §2: .976 of the bead's weight, 4.815 mN.
    let lift_n = field["force_n"][0][2].as_f64().unwrap();
    assert!((lift_n / 4.815e-3 - 0.976).abs() < 1e-3, "{field}");
    assert!(field["b_t"][1][2].as_f64() > Some(0.3), "B is defined inside: {field}");
    assert_eq!(field["is_inside"], json!([false, true]));
    assert!(field["convention"].as_str().unwrap().contains("inside the magnet B = mu0*H + J"));

    let area = json!({"x_min_m": -0.3, "x_max_m": 0.28, "y_min_m": -0.54, "y_max_m": -0.21});
    let body = json!({"area": area, "cell_m": 0.01, "tool_height_m": 0.1, "tool_orientation": "vertical"});
    let (status, map) = lab.ask("POST", "/api/kinematics/workspace", &body.to_string()).await;
    assert_eq!(status, 200, "{map}");
    let values = map["manipulability_m3"].as_array().unwrap();
    assert_eq!(json!(values.len()), json!(58 * 33));
    assert!(values.iter().all(|value| value.as_f64() > map["least_m3"].as_f64()), "free of singularities");

    let pull = json!({"orientation": "A", "lower_face_height_m": 0.095, "direction_rad": 0, "friction": 0.2,
        "farthest_m": 0.15, "count": 16});
    let (status, curve) = lab.ask("POST", "/api/magnetics/pull", &pull.to_string()).await;
    assert_eq!(status, 200, "{curve}");
    // Specification §2, 4 cm aside.
    assert!((curve["lift_ratio"][4].as_f64().unwrap() - 0.651).abs() < 1e-3, "{curve}");
    assert!((curve["lateral_ratio"][4].as_f64().unwrap() - 0.309).abs() < 1e-3, "{curve}");
    assert!((curve["capture_m"][1].as_f64().unwrap() - 0.1004).abs() < 1e-4, "{curve}");
    let reach = json!({"orientation": "A", "lowest_m": 0.09, "highest_m": 0.2, "direction_rad": 0, "friction": 0.2,
        "drag_n_s_m": 0.01, "count": 12});
    let (status, curve) = lab.ask("POST", "/api/magnetics/reach", &reach.to_string()).await;
    assert_eq!(status, 200, "{curve}");
    assert!((curve["largest_speed_m_s"][1].as_f64().unwrap() - 0.079).abs() < 5e-4, "{curve}");

    let plane = json!({"orientation": "A", "lower_face_height_m": 0.095, "reach_m": 0.08, "count": 5});
    let (status, plane) = lab.ask("POST", "/api/magnetics/plane", &plane.to_string()).await;
    assert_eq!(status, 200, "{plane}");
    // The same pull, 4 cm aside.
    assert!((plane["pull_n"][13][0].as_f64().unwrap() / 4.815e-3 + 0.309).abs() < 1e-3, "{plane}");

    let mut flat = pull.clone();
    flat["count"] = json!(1);
    let mut low = pull;
    low["lower_face_height_m"] = json!(0);
    let huge = json!({"size_m": [1, 1, 1], "polarization_t": [0, 0, 1e308], "position_m": [0, 0, 0]});
    for (path, body, field) in [
        ("magnetics/pull", flat, "count"),
        ("magnetics/pull", low, "lower_face_height_m"),
        (
            "kinematics/workspace",
            json!({"area": area, "cell_m": 1e-6, "tool_height_m": 0.1, "tool_orientation": "paper"}),
            "cell_m",
        ),
        ("magnetics/field", json!({"magnet": huge, "points_m": [[1, 0, 0]], "moment_a_m2": 1e9}), "points_m[0]"),
        (
            "kinematics/inverse",
            json!({"poses": [{"position_m": [0, 0, 0], "rotation": [[1, 0, 0], [0, 2, 0], [0, 0, 1]]}]}),
            "poses[0].rotation",
        ),
        ("kinematics/forward", json!({"joints_rad": [[0, 0, 0, 0, 0, null]]}), "joints_rad[0][5]"),
        (
            "magnetics/field",
            json!({"magnet": {"size_m": [0, 1, 1], "polarization_t": [0, 0, 1], "position_m": [0, 0, 0]}, "points_m": [], "moment_a_m2": 1}),
            "magnet",
        ),
    ] {
        let (status, problem) = lab.ask("POST", &format!("/api/{path}"), &body.to_string()).await;
        assert!((400..500).contains(&status) && problem["field"] == field, "{path}: {problem}");
    }
    // Ten thousand poses fit; a larger body is refused.
    let many = json!({"poses": vec![far; 10_000]}).to_string();
    assert_eq!(lab.ask("POST", "/api/kinematics/inverse", &many).await.0, 200);
    // One byte too many: the server has read the rest when it answers, so the client does not write to a closed socket.
    let (status, problem) = lab.ask("POST", "/api/kinematics/inverse", &" ".repeat((8 << 20) + 1)).await;
    assert_eq!((status, &problem["code"]), (413, &json!("too_large")), "{problem}");
    lab.close().await;
}
