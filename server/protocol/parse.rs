//! Parses messages. Errors name the invalid field.

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::{ClientMessage, ErrorMessage, ProgramAnswer};

impl ClientMessage {
    /// Parses a text frame.
    pub fn parse(text: &str) -> Result<Self, ErrorMessage> {
        Self::parse_with_envelope(text).1
    }

    /// What a text frame carries besides its message, and the message.
    pub fn parse_with_envelope(text: &str) -> (Envelope, Result<Self, ErrorMessage>) {
        let mut fields = match object(text) {
            Ok(fields) => fields,
            Err(error) => return (Envelope::default(), Err(error)),
        };
        let mut number = |name: &str| {
            let number = fields.remove(name).map(serde_json::from_value::<u64>).transpose();
            number.map_err(|error| malformed(format!("{name}: {error}"), Some(name.to_owned())))
        };
        let (id, epoch) = (number("id"), number("epoch"));
        let envelope = Envelope { id: id.clone().unwrap_or(None), epoch: epoch.clone().unwrap_or(None) };
        (envelope, id.and(epoch).and_then(|_| tagged(fields)))
    }
}

/// What any message may carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Envelope {
    /// The message is answered with `done` or `refused`.
    pub id: Option<u64>,
    /// The epoch of the lease that it was sent under (see [`super::Hello::epoch`]).
    pub epoch: Option<u64>,
}

impl ProgramAnswer {
    /// Parses a text frame.
    ///
    /// # Errors
    /// The message is malformed; the error names the field.
    pub fn parse(text: &str) -> Result<Self, ErrorMessage> {
        tagged(object(text)?)
    }
}

fn malformed(message: String, field: Option<String>) -> ErrorMessage {
    ErrorMessage { code: "malformed".into(), message, field }
}

/// The fields of a message.
fn object(text: &str) -> Result<Map<String, Value>, ErrorMessage> {
    match serde_json::from_str(text) {
        Ok(Value::Object(fields)) => Ok(fields),
        Ok(_) => Err(malformed("a message is a JSON object".into(), None)),
        Err(error) => Err(malformed(format!("not JSON: {error}"), None)),
    }
}

/// The message of a `type` with its fields.
fn tagged<T: DeserializeOwned>(mut fields: Map<String, Value>) -> Result<T, ErrorMessage> {
    let kind = match fields.remove("type") {
        Some(Value::String(kind)) => kind,
        other => {
            let found = other.map_or("missing".into(), |value| value.to_string());
            return Err(malformed(format!("type is {found}, it must be a string"), Some("type".into())));
        }
    };
    // With the tag outside, serde reports the path to the invalid field.
    let tagged = Value::Object(Map::from_iter([(kind.clone(), Value::Object(fields))]));
    serde_path_to_error::deserialize(tagged).map_err(|error| {
        let path = error.path().to_string();
        let message = error.inner().to_string();
        match path.strip_prefix(&format!("{kind}.")) {
            Some(field) => malformed(format!("{field}: {message}"), Some(field.to_owned())),
            None if path == kind || path == "." => {
                // Missing and unknown fields, and unknown types, are named by serde in backquotes.
                let field = message.split('`').nth(1).unwrap_or("type").to_owned();
                let field = if message.starts_with("unknown variant") { "type".to_owned() } else { field };
                malformed(message, Some(field))
            }
            None => malformed(message, Some(path)),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> (String, String) {
        let error = ClientMessage::parse(text).unwrap_err();
        assert_eq!(error.code, "malformed");
        (error.field.unwrap_or_default(), error.message)
    }

    #[test]
    fn messages_parse() {
        assert_eq!(
            ClientMessage::parse(r#"{"type":"set_goal","x_m":0.1,"y_m":-0.3}"#).unwrap(),
            ClientMessage::SetGoal { x_m: 0.1, y_m: -0.3 }
        );
        assert_eq!(ClientMessage::parse(r#"{"type":"run"}"#).unwrap(), ClientMessage::Run {});
        assert_eq!(ClientMessage::parse(r#"{"type":"reset"}"#).unwrap(), ClientMessage::Reset { seed: None });
        let enveloped = |text: &str| ClientMessage::parse_with_envelope(text);
        let sent = enveloped(r#"{"type":"run","epoch":7,"id":3}"#);
        assert_eq!(sent, (Envelope { id: Some(3), epoch: Some(7) }, Ok(ClientMessage::Run {})));
        assert_eq!(enveloped(r#"{"type":"run"}"#).0, Envelope::default());
        let (envelope, refused) = enveloped(r#"{"type":"fly","id":3}"#);
        assert_eq!((envelope.id, refused.unwrap_err().field.as_deref()), (Some(3), Some("type")));
        let (envelope, refused) = enveloped(r#"{"type":"run","id":-3}"#);
        assert_eq!((envelope.id, refused.unwrap_err().field.as_deref()), (None, Some("id")));
    }

    #[test]
    fn a_seed_may_be_text() {
        for (text, expected) in [
            (r#","seed":7"#, Some(7)),
            (r#","seed":"18446744073709551615""#, Some(u64::MAX)),
            (r#","seed":null"#, None),
            ("", None),
        ] {
            let message = ClientMessage::parse(&format!(r#"{{"type":"load_scenario","map":"posts"{text}}}"#)).unwrap();
            let ClientMessage::LoadScenario { seed, .. } = message else { panic!("{message:?}") };
            assert_eq!(seed, expected, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert_eq!(fault(r#"{"type":"set_goal","x_m":null,"y_m":0}"#).0, "x_m");
        assert_eq!(fault(r#"{"type":"set_goal","x_m":0.1}"#).0, "y_m");
        assert_eq!(fault(r#"{"type":"set_goal","x_m":0.1,"y_m":0,"z_m":1}"#).0, "z_m");
        assert_eq!(fault(r#"{"type":"select_controller","controller":"magic"}"#).0, "controller");
        assert_eq!(fault(r#"{"type":"step","ticks":-1}"#).0, "ticks");
        for seed in ["-1", "1.5", "\"-1\"", "\"1e3\"", "\"\"", "\"18446744073709551616\"", "[1]", "1e300"] {
            let (field, message) = fault(&format!(r#"{{"type":"load_scenario","map":"posts","seed":{seed}}}"#));
            assert_eq!(field, "seed");
            assert!(message.contains("a whole number from 0 to 2^64 - 1"), "{seed}: {message}");
        }
        let (field, message) = fault(r#"{"type":"fly"}"#);
        assert_eq!(field, "type");
        assert!(message.contains("fly") && message.contains("set_goal"), "{message}");
        assert_eq!(fault(r#"{"type":"run","epoch":-1}"#).0, "epoch");
        assert_eq!(fault(r#"{"x_m":1}"#).0, "type");
        assert_eq!(fault("[]").0, "");
        assert_eq!(fault("{").0, "");
        assert_eq!(fault(r#"{"type":"configure","parameters":{"friction":"much"}}"#).0, "parameters.friction");
    }
}
