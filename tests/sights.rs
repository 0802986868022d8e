//! Camera images and layers, as a browser receives them.

use ferry_camera::{AdapterChoice, Gpu};
use serde_json::{Value, json};

use crate::support::Laboratory;

#[tokio::test(flavor = "multi_thread")]
async fn a_session_goes_on_when_its_graphics_device_is_lost() {
    let device = Gpu::open(AdapterChoice::Auto).unwrap();
    let lab = Laboratory::open_on(device.clone()).await;
    let mut browser = lab.browser().await;
    let load =
        json!({"type": "load_scenario", "map": "posts", "seed": 3, "start_m": [-0.25, -0.38], "goal_m": [0.12, -0.33]});
    let mut hashes = Vec::new();
    for lose in [false, true] {
        browser.send(load.clone()).await;
        browser.send(json!({"type": "step", "ticks": 200})).await;
        browser.state("under way", |m| m["tick"] == 200).await;
        if lose {
            device.destroy();
        }
        browser.send(json!({"type": "step", "ticks": 400})).await;
        let then = browser.state("farther", |m| m["tick"] == 600 || m["ended"] != Value::Null).await;
        assert_eq!(then["ended"], Value::Null);
        hashes.push(then["world_hash"].clone());
    }
    assert_eq!(hashes[0], hashes[1], "the same moment on each device");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn plans_and_flow_are_told() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let load = json!({"type": "load_scenario", "map": "colon", "controller": "errt", "start_m": [-0.24, -0.27], "goal_m": [0.19, -0.28]});
    browser.send(load).await;
    browser.send(json!({"type": "step", "ticks": 40})).await;
    let overlay = browser.until("a plan", |m| m["type"] == "overlay" && m["tick"] == 33).await;
    let plan = &overlay["plan"];
    let way = plan["way"].as_array().unwrap();
    assert!(way.len() >= 2 && plan["plans"].as_u64() >= Some(1), "{plan}");
    assert_eq!(way.last().unwrap(), &json!([0.19, -0.28]));
    assert!(!plan["obstacles"].as_array().unwrap().is_empty());
    let (status, field) = lab.ask("POST", "/api/sessions/main/flow", r#"{"spacing_m": 0.02, "seen": 1}"#).await;
    assert_eq!(status, 200, "{field}");
    let velocities = field["velocity_m_s"].as_array().unwrap();
    assert_eq!(velocities.len() as u64, field["columns"].as_u64().unwrap() * field["rows"].as_u64().unwrap());
    let is_wall = velocities.iter().filter(|velocity| velocity.is_null()).count();
    assert!(is_wall > 5 && is_wall < velocities.len(), "{is_wall} of {}", velocities.len());
    for (body, status) in [(r#"{"spacing_m": 1e-6, "seen": 1}"#, 422), (r#"{"spacing_m": "x"}"#, 400)] {
        assert_eq!(lab.ask("POST", "/api/sessions/main/flow", body).await.0, status);
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_moved_camera_is_obeyed_shown_and_refused_when_absurd() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let parameters = lab.default_parameters().await;
    for (field, value) in [
        ("camera_field_of_view_rad", 0.0),
        ("camera_field_of_view_rad", 3.0),
        ("camera_height_m", 0.004),
        ("camera_tilt_x_rad", 1.5),
        ("camera_offset_y_m", -4.0),
    ] {
        let mut absurd = parameters.clone();
        absurd[field] = json!(value);
        browser.send(json!({"type": "configure", "parameters": absurd})).await;
        let error = browser.error().await;
        assert_eq!((&error["field"], &error["code"]), (&json!(field), &json!("parameter_out_of_range")), "{error}");
    }
    let mut moved = parameters.clone();
    moved["camera_offset_x_m"] = json!(0.05);
    moved["camera_tilt_x_rad"] = json!(-0.15);
    browser.send(json!({"type": "configure", "parameters": moved})).await;
    let scene = browser.until("the new field of view", |m| m["type"] == "scene" && m["parameters"] == moved).await;
    let right = |corner: usize| scene["camera_sees_m"][corner][0].as_f64().unwrap();
    assert!(right(0) < -0.06 && right(1) > 0.06 && right(1) < 0.11, "{}", scene["camera_sees_m"]);
    // The tool moves, so that the camera observes new places.
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 40})).await;
    let overlay = browser.until("blocks", |m| m["type"] == "overlay" && m["tick"] == 33).await;
    let blocks = |kind: &str| overlay["blocks"][kind].as_array().unwrap().len();
    assert!(blocks("rectangles") > 0 && blocks("rectangles") < blocks("dark") && blocks("free") > 0, "{overlay}");
    let seen = browser.until("the obstacle map", |m| m["type"] == "seen").await;
    let cells: u64 = seen["runs"].as_array().unwrap().iter().map(|run| run[1].as_u64().unwrap()).sum();
    assert_eq!(cells, seen["columns"].as_u64().unwrap() * seen["rows"].as_u64().unwrap());
    let free = seen["runs"].as_array().unwrap().iter().any(|run| run[0] == 1);
    assert!(free, "{seen}");
    lab.close().await;
}
