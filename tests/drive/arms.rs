//! Robots that are no UR5, or one that differs.

use std::time::Duration;

use futures_util::StreamExt;
use serde_json::{Value, json};

use super::{REST, apart, driver, hold_until, joints, present, press, release, robot_of, stopping, task};

/// Name, lengths d and a in m, and that of the tool that is set.
type Arm = (&'static str, [f64; 6], [f64; 6], f64);

/// Arms as Universal Robots publishes them (https://www.universal-robots.com/articles/ur/application-installation/
/// dh-parameters-for-calculations-of-kinematics-and-dynamics/).
#[rustfmt::skip]
const ARMS: [Arm; 5] = [
    ("UR3e", [0.15185, 0.0, 0.0, 0.13105, 0.08535, 0.0921], [0.0, -0.24355, -0.2132, 0.0, 0.0, 0.0], 0.18),
    ("UR5e", [0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996], [0.0, -0.425, -0.3922, 0.0, 0.0, 0.0], 0.18),
    ("UR10e", [0.1807, 0.0, 0.0, 0.17415, 0.11985, 0.11655], [0.0, -0.6127, -0.57155, 0.0, 0.0, 0.0], 0.18),
    ("UR5 without a tool", [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823], [0.0, -0.425, -0.39225, 0.0, 0.0, 0.0], 0.0),
    ("UR5 10 mm off", [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823], [0.0, -0.435, -0.39225, 0.0, 0.0, 0.0], 0.18),
];

#[tokio::test(flavor = "multi_thread")]
async fn ferry_moves_no_arm_but_its_own() {
    let try_one = async |(number, (name, d_m, a_m, tcp_m)): (usize, Arm)| {
        let data = tempfile::tempdir().unwrap();
        let address = format!("127.0.28.{}", 130 + number);
        let quarter_rad = std::f64::consts::FRAC_PI_2;
        let alpha_rad = [quarter_rad, 0.0, 0.0, quarter_rad, -quarter_rad, 0.0];
        let file = data.path().join("arm.json");
        let arm = json!({"name": name, "d_m": d_m, "a_m": a_m, "alpha_rad": alpha_rad, "tcp_m": tcp_m});
        std::fs::write(&file, arm.to_string()).unwrap();
        let model = ["--robot-server-model".as_ref(), file.as_os_str()];
        let (_robot, mut robot) = robot_of(&address, "open", REST, &data.path().join("robot"), &model).await;
        let (_server, mut page) = driver(&address, &["--enable-motion"], &data.path().join("twin")).await;
        task(&mut page, "open", 1, Some([0.2, -0.45]), [0.0, -0.3]).await;
        let known = |state: &Value| state["twin"]["model"] == name && state["twin"]["doubt"]["text"].is_string();
        let known = page.state("its name, and what is odd", known).await;
        let doubt = known["twin"]["doubt"]["text"].as_str().unwrap();
        assert!(doubt.contains("TCP") && doubt.matches("p[").count() == 2, "{name}: {doubt}");
        let before = joints(&present(&mut robot).await);
        if name.ends_with('e') {
            let refused = hold_until(&mut page, "it is refused", Duration::from_secs(30), |m| {
                m["twin"]["stopped"]["text"].as_str().is_some_and(|why| why.contains("not a UR5"))
            });
            let refused = refused.await;
            assert_eq!(refused["twin"]["stopped"]["text"].as_str().unwrap().matches("p[").count(), 2, "{name}");
            // Ferry's program gives up after a second.
            robot.state("it is over", |state| state["robot"]["program"].is_null()).await;
            assert_eq!(apart(&joints(&present(&mut robot).await), &before), 0.0, "{name}");
            return;
        }
        let has_moved = |m: &Value| m["type"] == "state" && apart(&joints(m), &before) > 0.01;
        loop {
            press(&mut page).await;
            let has_stopped = stopping();
            let holds = hold_until(&mut page, "it moves or stops", Duration::from_secs(60), has_stopped);
            tokio::select! { _ = robot.whenever("it moves", has_moved) => break, _ = holds => release(&mut page).await };
        }
        let doubt = present(&mut page).await["twin"]["doubt"].clone();
        let is_expected = if tcp_m == 0.0 { doubt.is_null() } else { doubt.to_string().contains("calibration") };
        assert!(is_expected, "{name}: {doubt}");
    };
    futures_util::stream::iter(ARMS.into_iter().enumerate()).for_each_concurrent(2, try_one).await;
}
