//! Rerun's viewer, of the same version as the recorder: two files, embedded as gzip. The page that starts it is ours
//! (`web/viewer`), because Rerun's own page loads fonts from other servers.

use std::io::Read;
use std::sync::LazyLock;

use axum::body::Bytes;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

use crate::http::path::{Path, ViewerPath};
use crate::http::problem::Problem;
use crate::http::refusals::NotFound;

const FILES: [(&str, &str, &[u8]); 2] = [
    ("re_viewer.js", "text/javascript", include_bytes!(concat!(env!("OUT_DIR"), "/rerun/re_viewer.js.gz"))),
    ("re_viewer_bg.wasm", "application/wasm", include_bytes!(concat!(env!("OUT_DIR"), "/rerun/re_viewer_bg.wasm.gz"))),
];

/// The unpacked file for clients without gzip: forty megabytes, unpacked once.
static PLAIN: [LazyLock<Bytes>; 2] = [LazyLock::new(|| unpack(FILES[0].2)), LazyLock::new(|| unpack(FILES[1].2))];

/// A file of Rerun's viewer.
#[utoipa::path(get, path = "/rerun/{file}", tag = "page", params(ViewerPath), operation_id = "viewer_file",
    responses((status = 200, description = "The file, compressed with gzip if the client accepts it.",
            content((String = "text/javascript"), ("application/wasm"))),
        (status = 304, description = "The file is the one that the browser has."), NotFound))]
pub async fn file(Path(ViewerPath { file: name }): Path<ViewerPath>, headers: HeaderMap) -> Result<Response, Problem> {
    let known = FILES.iter().position(|(known, ..)| *known == name);
    let index = known.ok_or_else(|| Problem::not_found("file of the viewer", &name))?;
    let (_, kind, packed) = FILES[index];
    let tag = tag(packed);
    // The address is the same for every version, so browsers revalidate each time.
    let head = [
        (header::CONTENT_TYPE, kind),
        (header::CACHE_CONTROL, "no-cache"),
        (header::ETAG, tag.as_str()),
        (header::VARY, "accept-encoding"),
    ];
    if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes()) {
        return Ok((StatusCode::NOT_MODIFIED, head).into_response());
    }
    if accepts_gzip(&headers) {
        return Ok((head, [(header::CONTENT_ENCODING, "gzip")], packed).into_response());
    }
    let plain = tokio::task::spawn_blocking(move || PLAIN[index].clone()).await.map_err(Problem::internal)?;
    Ok((head, plain).into_response())
}

/// Made from checksum and length at the end of the gzip stream. Weak, because both encodings share it.
fn tag(packed: &[u8]) -> String {
    let end = packed.last_chunk::<8>().expect("a gzip stream has at least eight bytes");
    format!("W/\"{:016x}\"", u64::from_le_bytes(*end))
}

fn unpack(packed: &[u8]) -> Bytes {
    let mut plain = Vec::new();
    flate2::read::GzDecoder::new(packed).read_to_end(&mut plain).expect("the build has packed it");
    plain.into()
}

/// Whether `accept-encoding` names gzip, or everything, and not with the weight 0.
fn accepts_gzip(headers: &HeaderMap) -> bool {
    let weight = |coding: &str| {
        let values = headers.get_all(header::ACCEPT_ENCODING).iter().filter_map(|value| value.to_str().ok());
        let found = values.flat_map(|value| value.split(',')).find_map(|one| {
            let (name, parameter) = one.split_once(';').unwrap_or((one, "q=1"));
            name.trim().eq_ignore_ascii_case(coding).then_some(parameter)
        });
        found.map(|q| q.trim().trim_start_matches(['q', 'Q', '=']).parse::<f32>().unwrap_or(0.0))
    };
    weight("gzip").or_else(|| weight("*")).is_some_and(|weight| weight > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gzip_is_sent_to_clients_that_accept_it() {
        let accepts = |value: &str| {
            let mut headers = HeaderMap::new();
            headers.insert(header::ACCEPT_ENCODING, value.parse().unwrap());
            accepts_gzip(&headers)
        };
        for yes in ["gzip", "br, GZIP;q=0.5", "gzip, deflate, br, zstd", "*", "gzip;q=1, *;q=0", "identity, *; q=0.1"] {
            assert!(accepts(yes), "{yes}");
        }
        for no in ["", "identity", "br", "gzip;q=0", "gzip;q=0, *", "*;q=0", "xgzip"] {
            assert!(!accepts(no), "{no}");
        }
        assert!(!accepts_gzip(&HeaderMap::new()));
    }
}
