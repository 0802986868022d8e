//! The parameters in the API's description and in the page's types, from their table.

use std::borrow::Cow;

use serde_json::Value;
use ts_rs::{Config, TS};
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{AdditionalProperties, ObjectBuilder, Schema, Type};
use utoipa::{PartialSchema, ToSchema};

use super::{Kind, Parameter, Parameters};
use crate::plant::{BlockOrientation, ToolOrientation};

/// A parameter's name, label and help, and how another one limits it.
fn description(parameter: &Parameter) -> String {
    let Parameter { label, help, kind, .. } = parameter;
    match kind {
        Kind::Number(number) if let Some(bound) = number.bound => format!("{label}. {help} Also {bound}."),
        _ => format!("{label}. {help}"),
    }
}

/// A policy's name, and for an added one its hash.
const POLICY: &str = "^[a-z0-9][a-z0-9_-]{0,39}(@[0-9a-f]{16})?$";

fn property(parameter: &Parameter) -> ObjectBuilder {
    match parameter.kind {
        Kind::Number(number) => {
            let [least, most] = number.range;
            match number.whole {
                true => {
                    let object = ObjectBuilder::new().schema_type(Type::Integer);
                    object.minimum(Some(least as i64)).maximum(Some(most as i64))
                }
                false => ObjectBuilder::new().schema_type(Type::Number).minimum(Some(least)).maximum(Some(most)),
            }
        }
        Kind::Flag => ObjectBuilder::new().schema_type(Type::Boolean),
        Kind::Choice(options) => choice(options),
        Kind::Policy => ObjectBuilder::new().schema_type(Type::String).pattern(Some(POLICY)),
    }
}

fn choice(options: &[(&str, &str)]) -> ObjectBuilder {
    ObjectBuilder::new().schema_type(Type::String).enum_values(Some(options.iter().map(|(value, _)| *value)))
}

impl PartialSchema for Parameters {
    fn schema() -> RefOr<Schema> {
        let defaults = serde_json::to_value(Self::default()).unwrap_or(Value::Null);
        let object = Self::ALL.iter().fold(ObjectBuilder::new(), |object, parameter| {
            let property = property(parameter)
                .description(Some(description(parameter)))
                .default(defaults.get(parameter.name).cloned());
            object.property(parameter.name, property)
        });
        object
            .description(Some("Parameters that the operator can change. An omitted field has its default."))
            .additional_properties(Some(AdditionalProperties::<Schema>::FreeForm(false)))
            .into()
    }
}

impl ToSchema for Parameters {
    fn name() -> Cow<'static, str> {
        "Parameters".into()
    }
}

impl TS for Parameters {
    type WithoutGenerics = Self;
    type OptionInnerType = Self;

    fn name(_: &Config) -> String {
        "Parameters".to_owned()
    }

    fn inline(_: &Config) -> String {
        let fields = Self::ALL.iter().map(|parameter| {
            let kind = match parameter.kind {
                Kind::Number(_) => "number".to_owned(),
                Kind::Flag => "boolean".to_owned(),
                Kind::Choice(options) => union(options),
                Kind::Policy => "string".to_owned(),
            };
            format!("  /** {} */\n  {}: {kind};\n", parameter.help, parameter.name)
        });
        format!("{{\n{}}}", fields.collect::<String>())
    }

    fn decl(config: &Config) -> String {
        format!("type Parameters = {};", Self::inline(config))
    }
}

fn union(options: &[(&str, &str)]) -> String {
    options.iter().map(|(value, _)| format!("{value:?}")).collect::<Vec<_>>().join(" | ")
}

fn options_of(name: &str) -> &'static [(&'static str, &'static str)] {
    match Parameters::ALL.iter().find(|parameter| parameter.name == name).map(|parameter| parameter.kind) {
        Some(Kind::Choice(options)) => options,
        _ => &[],
    }
}

/// Choices that other messages use, too.
macro_rules! choices {
    ($($type:ty = $name:literal, as in $parameter:literal;)*) => {$(
        impl PartialSchema for $type {
            fn schema() -> RefOr<Schema> {
                choice(options_of($parameter)).into()
            }
        }

        impl ToSchema for $type {
            fn name() -> Cow<'static, str> {
                $name.into()
            }
        }

        impl TS for $type {
            type WithoutGenerics = Self;
            type OptionInnerType = Self;

            fn name(_: &Config) -> String {
                $name.to_owned()
            }

            fn inline(_: &Config) -> String {
                union(options_of($parameter))
            }

            fn decl(config: &Config) -> String {
                format!("type {} = {};", $name, Self::inline(config))
            }
        }
    )*};
}

choices! {
    BlockOrientation = "Orientation", as in "block_orientation";
    ToolOrientation = "ToolOrientation", as in "tool_orientation";
}
