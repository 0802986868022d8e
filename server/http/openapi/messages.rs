//! The browser's messages as they are on the wire: `{"type": "step", "ticks": 1}`. The derive follows serde, which
//! sees `{"step": {"ticks": 1}}` (`protocol::parse` moves the type).

use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{AdditionalProperties, ObjectBuilder, Schema, Type};

/// Moves each variant's name into its object, as the field `type`.
pub fn tag_inside(message: &mut RefOr<Schema>) {
    let RefOr::T(Schema::OneOf(variants)) = message else { return };
    for variant in &mut variants.items {
        let RefOr::T(Schema::Object(outer)) = variant else { continue };
        let Some((name, RefOr::T(Schema::Object(mut inner)))) = outer.properties.pop_first() else { continue };
        let tag = ObjectBuilder::new().schema_type(Type::String).enum_values(Some([name]));
        inner.properties.insert("type".to_owned(), tag.into());
        inner.required.insert(0, "type".to_owned());
        // Every variant is one of named fields, and serde's `deny_unknown_fields` is about them.
        inner.additional_properties = Some(Box::new(AdditionalProperties::FreeForm(false)));
        inner.description = outer.description.take().or(inner.description);
        *variant = Schema::Object(inner).into();
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use utoipa::PartialSchema;

    use super::*;
    use crate::protocol::ClientMessage;

    fn variants() -> Vec<Value> {
        let mut schema = ClientMessage::schema();
        tag_inside(&mut schema);
        serde_json::to_value(schema).unwrap()["oneOf"].as_array().unwrap().clone()
    }

    #[test]
    fn described_messages_are_those_that_are_parsed() {
        // The error for an unknown type lists all known types.
        let refusal = ClientMessage::parse(r#"{"type":"fly"}"#).unwrap_err().message;
        let mut known: Vec<&str> = refusal.split('`').skip(1).step_by(2).filter(|name| *name != "fly").collect();
        let variants = variants();
        let mut described: Vec<&str> =
            variants.iter().map(|variant| variant["properties"]["type"]["enum"][0].as_str().unwrap()).collect();
        known.sort_unstable();
        described.sort_unstable();
        assert_eq!(described, known);
        assert!(known.contains(&"set_goal"), "{known:?}");
    }

    #[test]
    fn what_the_description_requires_is_what_parsing_requires() {
        for variant in variants() {
            assert_eq!(variant["additionalProperties"], false, "{variant}");
            let required: Vec<&str> =
                variant["required"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
            let example = |field: &str| match field {
                "type" => variant["properties"]["type"]["enum"][0].clone(),
                "controller" => json!("errt"),
                "map" | "case" | "recovery" => json!("posts"),
                "challenge" => json!("easy-1"),
                "parameters" => json!({}),
                "disturbance" => json!({"dropout": {"for_s": 1.0}}),
                _ => json!(1),
            };
            let message: serde_json::Map<_, _> =
                required.iter().map(|&field| (field.to_owned(), example(field))).collect();
            ClientMessage::parse(&json!(message).to_string()).unwrap();
            for field in required {
                let mut less = message.clone();
                less.remove(field);
                assert!(ClientMessage::parse(&json!(less).to_string()).is_err(), "{field} of {message:?}");
            }
        }
    }
}
