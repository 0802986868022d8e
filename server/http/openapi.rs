//! The OpenAPI description, generated from the routes.

mod messages;

use serde_json::Value;
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{
    ApiKey, ApiKeyValue, HttpAuthScheme, HttpBuilder, SecurityRequirement, SecurityScheme,
};
use utoipa::openapi::{OpenApi, PathItem, RefOr};
use utoipa::{IntoResponses, OpenApi as _};

use super::problem::Problem;
use super::refusals::{ForeignHost, ForeignOrigin, Malformed, TooLarge, TooMany, TooSlow, Unauthorized, Unavailable};
use crate::protocol::{ClientMessage, ProgramAnswer, ProgramMessage, ServerMessage};

/// The parts of the description that routes do not generate.
#[derive(utoipa::OpenApi)]
#[openapi(
    info(
        title = "Ferry",
        description = "A browser laboratory for a magnetic robot. Lengths are in metres in the arm's `base` frame, \
                        angles in radians; rotations are given by rows. Refusals are problem details (RFC 9457)."
    ),
    components(schemas(Problem, ClientMessage, ServerMessage, ProgramMessage, ProgramAnswer))
)]
struct Base;

/// The description to which the routes are added.
pub fn base() -> OpenApi {
    Base::openapi()
}

/// Sets the registered format names of unsigned integers, which the derive misspells, and their ranges.
fn bound(part: &mut Value) {
    match part {
        Value::Object(fields) => {
            let known = match fields.get("format").and_then(Value::as_str) {
                Some("u-int8") => Some(("uint8", u64::from(u8::MAX))),
                Some("u-int16") => Some(("uint16", u64::from(u16::MAX))),
                Some("u-int32") => Some(("uint32", u64::from(u32::MAX))),
                Some("u-int64") => Some(("uint64", u64::MAX)),
                _ => None,
            };
            if let Some((format, most)) = known {
                fields.insert("format".to_owned(), format.into());
                fields.entry("maximum").or_insert(most.into());
            }
            fields.values_mut().for_each(bound);
        }
        Value::Array(items) => items.iter_mut().for_each(bound),
        _ => {}
    }
}

/// The routes' description with everything that they share, as JSON.
pub fn text(routes: OpenApi) -> String {
    let mut document =
        serde_json::to_value(complete(routes)).expect("a description is made of maps with text for keys");
    bound(&mut document);
    // Rustdoc links have no meaning here.
    document.to_string().replace("[`", "`").replace("`]", "`")
}

fn complete(mut document: OpenApi) -> OpenApi {
    for (path, item) in &mut document.paths.paths {
        operations(item).for_each(|operation| complete_operation(path, operation));
    }
    let components = document.components.get_or_insert_default();
    for name in ["ClientMessage", "ProgramAnswer"] {
        if let Some(schema) = components.schemas.get_mut(name) {
            messages::tag_inside(schema);
        }
    }
    let token = HttpBuilder::new().scheme(HttpAuthScheme::Bearer).build();
    let cookie = ApiKey::Cookie(ApiKeyValue::new("ferry"));
    components.add_security_scheme("token", SecurityScheme::Http(token));
    components.add_security_scheme("cookie", SecurityScheme::ApiKey(cookie));
    // A server on loopback needs neither.
    let either = ["token", "cookie"].map(|name| SecurityRequirement::new(name, [""; 0]));
    document.security = Some([SecurityRequirement::default()].into_iter().chain(either).collect());
    document
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = &mut Operation> {
    let PathItem { get, put, post, delete, options, head, patch, trace, .. } = item;
    [get, put, post, delete, options, head, patch, trace].into_iter().flatten()
}

/// Describes a success by the summary if it has no text, and adds the answers of `access`, `Path` and `WholeBody`.
fn complete_operation(path: &str, operation: &mut Operation) {
    let mut shared =
        vec![Unauthorized::responses(), ForeignOrigin::responses(), ForeignHost::responses(), TooMany::responses()];
    if path.contains('{') || operation.request_body.is_some() {
        shared.push(Malformed::responses());
    }
    if operation.request_body.is_some() {
        shared.push(TooLarge::responses());
        shared.push(TooSlow::responses());
        shared.push(Unavailable::responses());
    }
    for (status, response) in shared.into_iter().flatten() {
        operation.responses.responses.entry(status).or_insert(response);
    }
    for response in operation.responses.responses.values_mut() {
        if let RefOr::T(response) = response
            && response.description.is_empty()
        {
            response.description = operation.summary.clone().unwrap_or_default();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::http::routes::description::DOCUMENT;

    fn described() -> Value {
        serde_json::from_str(&DOCUMENT).unwrap()
    }

    fn all_operations(document: &Value) -> Vec<(String, Value)> {
        let paths = document["paths"].as_object().unwrap();
        let named = paths.iter().flat_map(|(path, item)| {
            let operations = item.as_object().unwrap().iter();
            operations.map(move |(method, operation)| (format!("{method} {path}"), operation.clone()))
        });
        named.collect()
    }

    #[test]
    fn every_route_is_described() {
        // The router shows its paths only in its debug output: `paths: {RouteId(0): "/healthz", …}`.
        let told = format!("{:?}", crate::http::routes::served());
        let routes = told.split("RouteId(").filter_map(|part| part.split_once("): \""));
        let served: BTreeSet<&str> = routes.map(|(_, path)| path.split('"').next().unwrap()).collect();
        let document = described();
        let paths: BTreeSet<&str> = document["paths"].as_object().unwrap().keys().map(String::as_str).collect();
        assert!(served.len() > 25, "only {served:?} were found");
        // The fallback is the page.
        let named = ["/s/{name}", "/s/{name}/{view}", "/s/{name}/learn/{lesson}"];
        let fallbacks = BTreeSet::from(["/", "/demo", "/board", "/{*__private__axum_fallback}"]);
        let fallbacks = &fallbacks | &BTreeSet::from(named);
        assert_eq!(served.difference(&fallbacks).copied().collect::<BTreeSet<_>>(), paths);
    }

    #[test]
    fn operations_have_unique_names_and_describe_refusals() {
        let document = described();
        let operations = all_operations(&document);
        let names: BTreeSet<&str> =
            operations.iter().map(|(_, operation)| operation["operationId"].as_str().unwrap()).collect();
        assert_eq!(names.len(), operations.len());
        for (name, operation) in &operations {
            assert!(operation["summary"].as_str().is_some_and(|summary| !summary.is_empty()), "{name}");
            let parameters = operation["parameters"].as_array().into_iter().flatten().filter(|one| one["in"] == "path");
            let mut in_path: Vec<_> = parameters.map(|one| format!("{{{}}}", one["name"].as_str().unwrap())).collect();
            in_path.sort_by_key(|parameter| name.find(parameter.as_str()));
            let expected: Vec<_> = name.split('/').filter(|part| part.starts_with('{')).collect();
            assert_eq!(in_path, expected, "{name}");
            let responses = operation["responses"].as_object().unwrap();
            for status in ["401", "403", "421"] {
                assert!(responses.contains_key(status), "{name}");
            }
            for (status, response) in responses {
                assert_ne!(response["description"].as_str().unwrap_or_default(), "", "{name}: {status}");
                let problem = &response["content"]["application/problem+json"]["schema"]["$ref"];
                assert_eq!(status.as_str() >= "400", problem == "#/components/schemas/Problem", "{name}: {status}");
            }
        }
    }

    #[test]
    fn references_resolve_and_integers_are_bounded() {
        fn walk(part: &Value, document: &Value, seen: &mut [usize; 2]) {
            if let Some(target) = part["$ref"].as_str() {
                assert!(document.pointer(target.trim_start_matches('#')).is_some(), "{target}");
                seen[0] += 1;
            }
            if part["format"].as_str().is_some_and(|format| format.starts_with("uint")) {
                assert!(part["maximum"].is_u64() && part["minimum"].is_number(), "{part}");
                seen[1] += 1;
            }
            match part {
                Value::Object(fields) => fields.values().for_each(|field| walk(field, document, seen)),
                Value::Array(items) => items.iter().for_each(|item| walk(item, document, seen)),
                _ => {}
            }
        }
        let document = described();
        let mut seen = [0, 0];
        walk(&document, &document, &mut seen);
        assert!(seen[0] > 100 && seen[1] > 50, "{seen:?}");
        assert!(!DOCUMENT.contains("[`") && !DOCUMENT.contains("u-int"));
    }
}
