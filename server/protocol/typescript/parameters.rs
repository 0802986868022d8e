//! `web/src/net/parameters.gen.ts`, from which the page makes its form, and `docs/parameters.md`.

use serde_json::Value;
use ts_rs::Config;

use super::forms::{field, property};
use super::{declaration, keep};
use ferry_core::plant::{BlockOrientation, ToolOrientation};
use ferry_core::scenario::{Group, Kind, Number, Parameter, Parameters, Preset};

fn members(group: Group) -> impl Iterator<Item = &'static Parameter> {
    Parameters::ALL.iter().filter(move |parameter| parameter.group == group)
}

fn group(group: Group) -> String {
    let mut head = property("title", group.title());
    if let Some(controller) = group.controller() {
        head += &format!(", {}", property("controller", controller.as_str()));
    }
    let fields: String = members(group)
        .map(|parameter| format!("      {},\n", field(&parameter.form_field(), Number::shown_range)))
        .collect();
    format!("  {{\n    {head}, open: {},\n    fields: [\n{fields}    ],\n  }},\n", group.is_open())
}

#[test]
fn the_pages_form_is_generated_from_the_table() {
    let config = &Config::new();
    let types = [
        declaration::<BlockOrientation>(config),
        declaration::<ToolOrientation>(config),
        declaration::<Parameters>(config),
    ];
    let groups: String = Group::ALL.into_iter().map(group).collect();
    let presets: String = Preset::ALL.iter().map(preset).collect();
    let text = format!(
        "// Generated from server/core/scenario/parameters/table.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews \
         it.\n\n{}\n/** The form's fields. Ranges and steps are in the shown unit: shown value = stored value × scale. \
         */\nexport const GROUPS = [\n{groups}] as const;\n\n\
         /** Named sets of parameters. */\nexport const PRESETS: readonly {{ readonly kind: string; readonly label: string; readonly help: string; \
         readonly values: Partial<Parameters> }}[] = [\n{presets}];\n",
        types.join("\n"),
    );
    keep("web/src/net/parameters.gen.ts", &text);
}

fn preset(preset: &Preset) -> String {
    let values = Parameters::default().with(&preset.changes()).expect("presets are valid: a test checks them");
    let values = serde_json::to_value(values).expect("plain data serialises");
    let names = preset.changes().into_iter().map(|change| change.split('=').next().unwrap_or_default().to_owned());
    let settings: Vec<String> = names.map(|name| property(&name, values[&name].clone())).collect();
    let head = [("kind", preset.kind.label()), ("label", preset.label), ("help", preset.help)];
    let head = head.map(|(name, text)| property(name, text)).join(", ");
    format!("  {{ {head}, values: {{ {} }} }},\n", settings.join(", "))
}

fn row(parameter: &Parameter, defaults: &Value) -> String {
    let Parameter { name, label, help, kind, .. } = parameter;
    let default = &defaults[*name];
    let default = default.as_str().map_or_else(|| default.to_string(), str::to_owned);
    let label = match kind {
        Kind::Number(number) if !number.unit.shown.is_empty() => format!("{label}, {}", number.unit.shown),
        _ => (*label).to_owned(),
    };
    format!("| `{name}` | {label} | {kind} | {default} | {help} |\n")
}

#[test]
fn the_table_of_the_documentation_is_generated() {
    let defaults = serde_json::to_value(Parameters::default()).unwrap();
    let mut text = "# Parameters\n\n\
        <!-- Generated from server/core/scenario/parameters/table.rs; `FERRY_GENERATE=1 cargo test --release protocol` \
        renews it. -->\n\n\
        The same names are used in messages, in experiment links and in `ferry evaluate --set NAME=VALUE`. Ranges and \
        defaults are in the unit of the name; the page may show another one.\n"
        .to_owned();
    for group in Group::ALL {
        let used = group.controller().map(|_| "\nOnly this controller uses these.\n").unwrap_or_default();
        text += &format!(
            "\n## {}\n{used}\n| name | on the page | range | default | what it does |\n|---|---|---|---|---|\n",
            group.title()
        );
        text.extend(members(group).map(|parameter| row(parameter, &defaults)));
    }
    text += "\n## Presets\n\n`--set preset=NAME` sets several parameters; later changes replace its own.\n\n\
             | name | on the page | what it is | parameters |\n|---|---|---|---|\n";
    for preset in Preset::ALL {
        let changes = preset.changes();
        text += &format!(
            "| `{}` | {}: {} | {} | {} |\n",
            preset.name,
            preset.kind.label(),
            preset.label,
            preset.help,
            changes.join(", ")
        );
    }
    keep("docs/parameters.md", &text);
}
