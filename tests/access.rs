//! Access: every Host with every Origin, every credential and every kind of request, over plain sockets.

use std::net::SocketAddr;

use ferry::http::Token;
use serde_json::json;

use crate::support::{Laboratory, exchange, gpu};

/// A request, and the status of its answer when it is admitted.
const REQUESTS: [(&str, &str, u16); 7] = [
    ("GET /api/sessions", "", 200),
    ("GET /healthz", "", 200),
    ("GET /", "", 200),
    ("POST /api/kinematics/forward", "{\"joints_rad\":[]}", 200),
    ("DELETE /api/sessions/missing", "", 404),
    ("PUT /api/sessions", "", 405),
    ("GET /api/sessions/main/live", "websocket", 101),
];

/// Whether a browser might send the request without its user's intent, or the request opens a WebSocket.
fn changes(request: &str) -> bool {
    !request.starts_with("GET ") || request.ends_with("/live")
}

struct Case<'a> {
    hosts: Vec<String>,
    hosts_are_ours: bool,
    origins: Vec<String>,
    origins_are_ours: bool,
    credential: (&'a str, String),
}

impl Case<'_> {
    fn request(&self, line: &str, body: &str) -> String {
        let mut text = format!("{line} HTTP/1.1\r\n");
        self.hosts.iter().for_each(|host| text += &format!("Host: {host}\r\n"));
        self.origins.iter().for_each(|origin| text += &format!("Origin: {origin}\r\n"));
        text += &self.credential.1;
        if body == "websocket" {
            text += "Connection: upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
                     Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
        } else {
            text += &format!("Connection: close\r\nContent-Length: {}\r\n\r\n{body}", body.len());
        }
        text
    }

    /// The expected status, derived in another order than the server checks.
    fn expected(&self, line: &str, status: u16, has_token: bool) -> Vec<u16> {
        if !self.hosts_are_ours {
            return vec![421];
        }
        if !self.origins.is_empty() && !self.origins_are_ours {
            return vec![403];
        }
        match (has_token, self.credential.0) {
            (false, _) | (true, "token") => vec![status],
            // Ten per minute; further ones get 429.
            (true, "wrong token") => vec![401, 429],
            (true, "cookie") if changes(line) && self.origins.is_empty() => vec![403],
            (true, "cookie") => vec![status],
            (true, _) if line.ends_with("/healthz") => vec![status],
            (true, _) => vec![401],
        }
    }
}

fn cookie_of(address: SocketAddr, token: &str) -> String {
    let body = json!({ "token": token }).to_string();
    let request = format!(
        "POST /login HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n\
         Content-Length: {}\r\n\r\n{body}",
        body.len()
    );
    let (status, answer) = exchange(address, request.as_bytes());
    assert_eq!(status, 204, "{answer}");
    let set = answer.lines().find_map(|line| line.strip_prefix("set-cookie: ")).expect("a cookie");
    for part in ["HttpOnly", "SameSite=Strict", "Path=/"] {
        assert!(set.contains(part), "{set}");
    }
    assert!(!answer.contains(token));
    set.split(';').next().unwrap().to_owned()
}

fn matrix(address: SocketAddr, token: Option<&str>) -> usize {
    let other = Token::generate().unwrap();
    let known = token.unwrap_or(&other);
    let port = address.port();
    let hosts: [(&[&str], bool); 10] = [
        (&["127.0.0.1:PORT"], true),
        (&["LOCALHOST:PORT"], true),
        (&[], false),
        (&[""], false),
        (&["localhost"], true),
        (&["127.0.0.1:1"], true),
        (&["example.org:PORT"], false),
        (&["127.0.0.1:PORT.example.org"], false),
        (&["user@127.0.0.1:PORT"], false),
        (&["127.0.0.1:PORT", "example.org"], false),
    ];
    let origins: [(&[&str], bool); 8] = [
        (&[], true),
        (&["http://127.0.0.1:PORT"], true),
        (&[""], false),
        (&["null"], false),
        (&["https://127.0.0.1:PORT"], false),
        (&["http://example.org"], false),
        (&["http://127.0.0.1:PORT.example.org"], false),
        (&["http://127.0.0.1:PORT", "http://example.org"], false),
    ];
    let cookie = token.map_or_else(|| "ferry=none".to_owned(), |token| cookie_of(address, token));
    let credentials = [
        ("none", String::new()),
        ("token", format!("Authorization: Bearer {known}\r\n")),
        ("wrong token", format!("Authorization: Bearer {}\r\n", Token::generate().unwrap())),
        ("cookie", format!("Cookie: other=1; {cookie}\r\n")),
        ("forged cookie", format!("Cookie: {}f\r\n", &cookie[..cookie.len() - 1])),
    ];
    let mut asked = 0;
    for (hosts, hosts_are_ours) in hosts {
        for (origins, origins_are_ours) in origins {
            for credential in &credentials {
                let fill = |texts: &[&str]| texts.iter().map(|text| text.replace("PORT", &port.to_string())).collect();
                let (hosts, origins) = (fill(hosts), fill(origins));
                let case = Case { hosts, hosts_are_ours, origins, origins_are_ours, credential: credential.clone() };
                for (line, body, status) in REQUESTS {
                    let request = case.request(line, body);
                    let (found, answer) = exchange(address, request.as_bytes());
                    let expected = case.expected(line, status, token.is_some());
                    assert!(expected.contains(&found), "{found}, not {expected:?}\n{request}\n{answer}");
                    if found != 101 {
                        let lower = answer.to_lowercase();
                        for header in ["content-security-policy: default-src 'self'", "x-content-type-options: nosniff"]
                        {
                            assert!(lower.contains(header), "{header}: {answer}");
                        }
                        assert!(lower.contains("frame-ancestors 'none'"), "{answer}");
                    }
                    asked += 1;
                }
            }
        }
    }
    asked
}

#[tokio::test(flavor = "multi_thread")]
async fn every_host_origin_and_credential_gets_the_expected_status() {
    let token = Token::generate().unwrap();
    for token in [None, Some(token.as_str())] {
        let lab = Laboratory::open_with(gpu(), token, |_| ()).await;
        let address = lab.address;
        let token = token.map(str::to_owned);
        let asked = tokio::task::spawn_blocking(move || matrix(address, token.as_deref())).await.unwrap();
        assert_eq!(asked, 10 * 8 * 5 * 7);
        lab.close().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn host_and_site_checks_cannot_be_bypassed() {
    let lab = Laboratory::open().await;
    let address = lab.address;
    let ask = move |line: &str, headers: &str| {
        let request = format!("{line} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{headers}\r\n");
        exchange(address, request.as_bytes()).0
    };
    let asked = tokio::task::spawn_blocking(move || {
        assert_eq!(ask(&format!("GET http://{address}/healthz"), ""), 200);
        assert_eq!(ask("GET http://example.org/healthz", ""), 421);
        for site in ["cross-site", "same-site"] {
            let from = format!("Sec-Fetch-Site: {site}\r\n");
            assert_eq!(ask("GET /api/sessions", &from), 403, "an image, or a script");
            assert_eq!(ask("GET /s/made-elsewhere", &format!("{from}Sec-Fetch-Mode: no-cors\r\n")), 403);
            let to = |dest| format!("{from}Sec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: {dest}\r\n");
            assert_eq!(ask("GET /", &to("document")), 200, "a link");
            assert_eq!(ask("GET /s/made-elsewhere", &to("document")), 403, "a link that would open a session");
            assert_eq!(ask("GET /s/made-elsewhere", &to("iframe")), 403, "a frame");
            assert_eq!(ask("POST /api/sessions", &format!("{from}Sec-Fetch-Mode: navigate\r\n")), 403, "a form");
        }
        assert_eq!(ask("GET /api/sessions", "Sec-Fetch-Site: same-origin\r\n"), 200);
    });
    asked.await.unwrap();
    let (_, listed) = lab.ask("GET", "/api/sessions", "").await;
    assert_eq!(listed["sessions"].as_array().unwrap().len(), 1, "{listed}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_logout_ends_copies_of_the_cookie_and_no_other_login() {
    let token = Token::generate().unwrap();
    let lab = Laboratory::open_with(gpu(), Some(&token), |_| ()).await;
    let address = lab.address;
    let asked = tokio::task::spawn_blocking(move || {
        let [one, other] = [(); 2].map(|()| cookie_of(address, &token));
        let ask = |line: &str, cookie: &str| {
            let request = format!(
                "{line} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n\
                 Cookie: {cookie}\r\nContent-Length: 0\r\n\r\n"
            );
            exchange(address, request.as_bytes()).0
        };
        assert_eq!(ask("GET /api/sessions", &one), 200);
        assert_eq!(ask("POST /logout", &one), 204);
        assert_eq!(ask("GET /api/sessions", &one), 401);
        assert_eq!(ask("GET /api/sessions", &other), 200);
    });
    asked.await.unwrap();
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn only_wrong_tokens_are_rate_limited() {
    let token = Token::generate().unwrap();
    let lab = Laboratory::open_with(gpu(), Some(&token), |_| ()).await;
    let address = lab.address;
    let asked = tokio::task::spawn_blocking(move || {
        let ask = |token: &str| {
            let request = format!(
                "GET /api/maps HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nAuthorization: Bearer {token}\r\n\r\n"
            );
            exchange(address, request.as_bytes())
        };
        let statuses: Vec<u16> = (0..20).map(|_| ask(&Token::generate().unwrap()).0).collect();
        assert_eq!((statuses[0], statuses[19]), (401, 429), "{statuses:?}");
        assert!(ask("short").1.to_lowercase().contains("retry-after: "));
        assert_eq!(ask(&token).0, 200);
        let page = exchange(
            address,
            format!("GET /s/anna HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n").as_bytes(),
        );
        assert!(page.0 == 401 && page.1.contains("<title>Log in"), "{}", page.1);
        token
    });
    let token = asked.await.unwrap();
    let bearer = format!("Bearer {token}");
    let (_, listed) = lab.ask_with("GET", "/api/sessions", "", &[("authorization", &bearer)]).await;
    assert_eq!(listed["sessions"].as_array().unwrap().len(), 1, "no session without access: {listed}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn no_path_leads_outside_the_served_files() {
    let lab = Laboratory::open().await;
    std::fs::write(lab.data.path().join("secret.rrd"), "secret").unwrap();
    let address = lab.address;
    let before = tree(lab.data.path());
    let asked = tokio::task::spawn_blocking(move || {
        let ways = ["..", "%2e%2e", "..%2f..", "%2e%2e%2f", "..%5c..", "....//", "%00", "..%c0%af..", "..;"];
        for root in
            ["", "api/maps", "api/recordings", "api/sessions", "api/evaluations", "rerun", "assets", "viewer", "s"]
        {
            for way in ways {
                for end in ["secret.rrd", "Cargo.toml", "etc/passwd", "index.html"] {
                    let path = format!("/{root}/{way}/{end}");
                    for path in [path.clone(), path.replace("/..", "%2f..")] {
                        let request = format!("GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
                        let (status, answer) = exchange(address, request.as_bytes());
                        assert!((400..500).contains(&status), "{path}: {answer}");
                        assert!(!answer.contains("[package]") && !answer.contains("root:"), "{path}: {answer}");
                    }
                }
            }
        }
    });
    asked.await.unwrap();
    assert_eq!(tree(lab.data.path()), before, "no file was created");
    lab.close().await;
}

fn tree(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let mut found: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}
