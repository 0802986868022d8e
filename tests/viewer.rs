//! Rerun's viewer as the server sends it.

use std::io::Read;

use crate::support::{Answer, Laboratory, files};

fn unpacked(answer: &Answer) -> Vec<u8> {
    let mut plain = Vec::new();
    flate2::read::GzDecoder::new(&answer.body[..]).read_to_end(&mut plain).unwrap();
    plain
}

#[tokio::test(flavor = "multi_thread")]
async fn its_files_come_packed_or_plain_and_once() {
    let lab = Laboratory::open().await;
    for (name, kind, beginning) in [
        ("re_viewer.js", "text/javascript", &b"let wasm_bindgen"[..]),
        ("re_viewer_bg.wasm", "application/wasm", b"\0asm"),
    ] {
        let path = format!("/rerun/{name}");
        let packed = lab.fetch("GET", &path, &[("accept-encoding", "gzip, br")]).await;
        assert_eq!(packed.status, 200);
        assert_eq!((packed.header("content-encoding"), packed.header("content-type")), (Some("gzip"), Some(kind)));
        assert_eq!(
            (packed.header("vary"), packed.header("cache-control")),
            (Some("accept-encoding"), Some("no-cache"))
        );
        let whole = unpacked(&packed);
        assert!(whole.starts_with(beginning) && packed.body.len() * 2 < whole.len(), "{name}");

        let plain = lab.fetch("GET", &path, &[("accept-encoding", "identity")]).await;
        assert_eq!((plain.status, plain.header("content-encoding")), (200, None));
        assert!(plain.body == whole, "{name}: packed and plain differ");

        let tag = packed.header("etag").unwrap();
        assert_eq!(plain.header("etag"), Some(tag));
        let known = lab.fetch("GET", &path, &[("if-none-match", tag)]).await;
        assert_eq!((known.status, known.body.len()), (304, 0));
    }
    let missing = lab.fetch("GET", "/rerun/index.html", &[]).await;
    assert_eq!(missing.status, 404);
    assert_eq!(missing.header("content-type"), Some("application/problem+json"));
    assert_eq!(lab.fetch("DELETE", "/rerun/re_viewer.js", &[]).await.status, 405);
    lab.close().await;
}

/// The version is in a recording's head and among the strings of the viewer.
#[tokio::test(flavor = "multi_thread")]
async fn it_has_the_version_that_records() {
    let lab = Laboratory::open().await;
    let viewer = unpacked(&lab.fetch("GET", "/rerun/re_viewer_bg.wasm", &[("accept-encoding", "gzip")]).await);
    let data = lab.close().await;
    let recording = files(&data.path().join("recordings"), "rrd").remove(0);
    let head = std::fs::read(recording).unwrap();
    assert_eq!(&head[..4], b"RRF2");
    let version = format!("{}.{}.{}", head[4], head[5], head[6]);
    assert!(viewer.windows(version.len()).any(|found| found == version.as_bytes()), "no {version} in the viewer");
    let lock = include_str!("../Cargo.lock").replace("\r\n", "\n");
    for name in ["re_chunk", "re_log_encoding", "re_log_types", "re_sdk_types", "re_web_viewer_server"] {
        assert!(lock.contains(&format!("name = \"{name}\"\nversion = \"{version}\"\n")), "{name} is not {version}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn only_its_page_may_be_framed_and_compile() {
    let lab = Laboratory::open().await;
    let policy = async |path: &str| {
        let page = lab.fetch("GET", path, &[]).await;
        assert_eq!(page.status, 200, "{path}");
        page.header("content-security-policy").unwrap().to_owned()
    };
    let own = policy("/viewer/").await;
    assert!(own.contains("frame-ancestors 'self'") && own.contains("script-src 'self' 'wasm-unsafe-eval'"), "{own}");
    let sources = ["'self'", "'none'", "'wasm-unsafe-eval'", "blob:", "data:"];
    for directive in own.split(';') {
        let strange = directive.split_whitespace().skip(1).find(|source| !sources.contains(source));
        assert_eq!(strange, None, "{directive}");
    }
    for path in ["/", "/rerun/re_viewer.js", "/api/recordings"] {
        let other = policy(path).await;
        assert!(other.contains("frame-ancestors 'none'") && !other.contains("wasm"), "{path}: {other}");
    }
    lab.close().await;
}
