//! Layout of a recording in Rerun's viewer.

use re_chunk::ChunkError;
use re_log_types::{BlueprintActivationCommand, LogMsg, StoreId, StoreKind, TimeCell};
use re_sdk_types::blueprint::archetypes::{
    ContainerBlueprint, PanelBlueprint, TimePanelBlueprint, ViewBlueprint, ViewContents, ViewportBlueprint,
};
use re_sdk_types::blueprint::components::{ContainerKind, PanelState, PlayState};
use re_sdk_types::datatypes::Uuid;

use super::stream::{APPLICATION, Store};

/// A view, or a container of others with their shares of its space.
enum Item {
    View { class: &'static str, name: &'static str, origin: &'static str, contents: &'static [&'static str] },
    Container { kind: ContainerKind, items: Vec<Item>, shares: &'static [f32] },
}

fn view(class: &'static str, name: &'static str, origin: &'static str) -> Item {
    Item::View { class, name, origin, contents: &["$origin/**"] }
}

fn container<const N: usize>(kind: ContainerKind, items: [Item; N], shares: &'static [f32]) -> Item {
    Item::Container { kind, items: Vec::from(items), shares }
}

/// Scene, plan view and camera above; errors, modes and the controller's evaluation below; the log at the side.
fn root() -> Item {
    let plan = Item::View {
        class: "2D",
        name: "Workspace, mm (y down)",
        origin: "workspace",
        contents: &["+ $origin/**", "- $origin/planner/**"],
    };
    let mode = Item::View {
        class: "StateTimeline",
        name: "Trial, mode and phase",
        origin: "/",
        contents: &["+ /trial", "+ /mode", "+ /phase"],
    };
    let planner = view("2D", "Planner, mm (y down)", "workspace");
    let images = [view("2D", "Camera", "camera"), view("2D", "Observation", "observation")];
    let above = [
        container(ContainerKind::Tabs, [plan, planner], &[]),
        view("3D", "Scene", "world"),
        container(ContainerKind::Vertical, images, &[3.0, 1.0]),
    ];
    let curves = [
        view("BarChart", "Quantiles: +x, -x, +y, -y", "quantiles"),
        view("TimeSeries", "Values of the actions", "action_values"),
        view("TimeSeries", "Lift ratio, force of the hand", "forces"),
        view("TimeSeries", "Joints, rad", "joints_rad"),
    ];
    let errors = view("TimeSeries", "Tracking error, mm", "tracking_error_mm");
    let below = [
        container(ContainerKind::Vertical, [errors, mode], &[3.0, 2.0]),
        container(ContainerKind::Tabs, curves, &[]),
        view("TextLog", "Log", "log"),
    ];
    let rows = [
        container(ContainerKind::Horizontal, above, &[4.0, 4.0, 2.0]),
        container(ContainerKind::Horizontal, below, &[4.0, 3.0, 3.0]),
    ];
    container(ContainerKind::Vertical, rows, &[3.0, 2.0])
}

/// Logs an item after those in it. Returns its number, from which its identity follows, and its entity.
fn log(store: &mut Store, item: &Item, count: &mut u128) -> (Uuid, String) {
    *count += 1;
    let id = Uuid { bytes: count.to_be_bytes() };
    let text = format!("00000000-0000-0000-0000-{:012x}", *count);
    match item {
        Item::View { class, name, origin, contents } => {
            let entity = format!("view/{text}");
            store.log(&format!("{entity}/ViewContents"), &ViewContents::new(contents.iter().copied()));
            store.log(&entity, &ViewBlueprint::new(*class).with_display_name(*name).with_space_origin(*origin));
            (id, entity)
        }
        Item::Container { kind, items, shares } => {
            let entity = format!("container/{text}");
            let contents: Vec<String> = items.iter().map(|item| log(store, item, count).1).collect();
            let shares = shares.iter().copied();
            let blueprint = ContainerBlueprint::new(*kind).with_contents(contents);
            let blueprint = match (kind, shares.len()) {
                (_, 0) => blueprint,
                (ContainerKind::Horizontal, _) => blueprint.with_col_shares(shares),
                _ => blueprint.with_row_shares(shares),
            };
            store.log(&entity, &blueprint);
            (id, entity)
        }
    }
}

/// The messages with the layout, in the order of the file.
pub(super) fn layout() -> Result<Vec<LogMsg>, ChunkError> {
    let blueprint_id = StoreId::random(StoreKind::Blueprint, APPLICATION);
    let mut store = Store::new(blueprint_id.clone());
    store.set_time("blueprint", TimeCell::from_sequence(0));
    let (id, _) = log(&mut store, &root(), &mut 0);
    let viewport = ViewportBlueprint::new().with_root_container(id).with_auto_layout(false).with_auto_views(false);
    store.log("viewport", &viewport);
    for panel in ["blueprint_panel", "selection_panel"] {
        store.log(panel, &PanelBlueprint::new().with_state(PanelState::Hidden));
    }
    // Paused, it opens at the beginning.
    let time = TimePanelBlueprint::new()
        .with_state(PanelState::Collapsed)
        .with_timeline("recording_time")
        .with_play_state(PlayState::Paused);
    store.log("time_panel", &time);
    let mut messages = vec![store.introduction()];
    messages.extend(store.messages()?);
    let activation = BlueprintActivationCommand { blueprint_id, make_active: true, make_default: true };
    messages.push(LogMsg::BlueprintActivationCommand(activation));
    Ok(messages)
}
