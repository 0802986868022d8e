//! `web/src/net/forms.gen.ts`: the fields of background jobs, from which the page makes its forms.

use serde_json::{Value, json};

use super::{RecoveryQuery, keep};
use ferry_core::scenario::RlPolicy;
use ferry_core::scenario::descriptor::{Bound, FormField, Kind, Number};
use ferry_lab::evaluate::EvaluationQuery;
use ferry_lab::learn::{Recipe, RecipeName, Settings};
use ferry_lab::recovery;

pub(super) fn property(name: &str, value: impl Into<Value>) -> String {
    format!("{name}: {}", value.into())
}

/// A whole number is written without a point.
fn plain(value: f64) -> Value {
    if value.fract() == 0.0 { json!(value as i64) } else { json!(value) }
}

/// One field of a form, with a range in the shown unit.
pub(super) fn field(field: &FormField, range: fn(&Number) -> [f64; 2]) -> String {
    let FormField { name, label, help, kind } = *field;
    let mut properties = vec![property("name", name), property("label", label)];
    let kind = match kind {
        Kind::Number(number) => {
            let [least, most] = range(&number);
            properties.extend([
                property("unit", number.unit.shown),
                property("scale", plain(number.unit.scale)),
                property("min", plain(least)),
                property("max", plain(most)),
                property("step", plain(number.step)),
                property("isWhole", number.whole),
            ]);
            properties.extend(number.bound.map(|bound| match bound {
                Bound::AtMost(other) => format!("bound: {{ kind: 'atMost', other: '{other}' }}"),
                Bound::Quarter(other) => format!("bound: {{ kind: 'quarter', other: '{other}' }}"),
                Bound::Remainder(other) => format!("bound: {{ kind: 'remainder', other: '{other}' }}"),
            }));
            "number"
        }
        Kind::Flag => "flag",
        Kind::Choice(options) => {
            properties.push(property("options", json!(options)));
            "choice"
        }
        Kind::Policy => {
            properties.push(property("options", json!(RlPolicy::OPTIONS)));
            "policy"
        }
    };
    format!("{{ kind: '{kind}', {}, help: {} }}", properties.join(", "), json!(help))
}

/// Fields by their names.
fn fields(name: &str, about: &str, fields: &[FormField]) -> String {
    let lines: String = fields
        .iter()
        .map(|one| {
            format!("  {}: {},\n", one.name, field(one, |number| number.range.map(|end| end * number.unit.scale)))
        })
        .collect();
    format!("/** {about} */\nexport const {name} = {{\n{lines}}} as const;\n")
}

fn recipes() -> String {
    let lines = RecipeName::ALL.map(|(name, label, help)| {
        let settings = json!(Settings::from(&Recipe::named(name)));
        let name = json!(name);
        format!("  {{ {}, label: '{label}', help: '{help}', settings: {settings} }},\n", property("name", name))
    });
    format!(
        "/** The recipes of trainings, with their settings. */\nexport const RECIPES = [\n{}] as const;\n",
        lines.concat()
    )
}

#[test]
fn the_forms_of_jobs_are_generated_from_their_tables() {
    let RecoveryQuery { grid, repeats, within_s, seed, .. } = RecoveryQuery::default();
    let defaults = json!({ "grid": grid, "repeats": repeats, "within_s": within_s, "seed": seed });
    let text = [
        "// Generated from server/lab; `FERRY_GENERATE=1 cargo test --release protocol` renews it.\n".to_owned(),
        fields("TRAINING_SETTINGS", "What a client may change of a recipe.", Settings::ALL),
        recipes(),
        fields("EVALUATION_FIELDS", "The numbers of an evaluation.", &EvaluationQuery::FIELDS),
        fields("RECOVERY_FIELDS", "The numbers of a recovery map.", &recovery::RecoveryQuery::FIELDS),
        format!(
            "/** Those that a recovery map has without others. */\nexport const RECOVERY_DEFAULTS = {defaults} as const;\n"
        ),
    ];
    keep("web/src/net/forms.gen.ts", &text.join("\n"));
}
