//! Layout of a recording in Rerun's viewer.

use re_sdk::blueprint::components::{PanelState, PlayState};
use re_sdk::blueprint::{
    BarChartView, Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Spatial2DView, Spatial3DView,
    StateTimelineView, Tabs, TextLogView, TimePanel, TimeSeriesView, Vertical,
};

/// Scene, plan view and camera above; errors, modes and the controller's evaluation below; the log at the side.
pub(super) fn blueprint() -> Blueprint {
    let scene = Spatial3DView::new("Scene").with_origin("world");
    let plan = Spatial2DView::new("Workspace, mm (y down)")
        .with_origin("workspace")
        .with_contents(["+ $origin/**", "- $origin/planner/**"]);
    let planner = Spatial2DView::new("Planner, mm (y down)").with_origin("workspace");
    let camera = Spatial2DView::new("Camera").with_origin("camera");
    let observation = Spatial2DView::new("Observation").with_origin("observation");
    let errors = TimeSeriesView::new("Tracking error, mm").with_origin("tracking_error_mm");
    let mode = StateTimelineView::new("Trial, mode and phase").with_contents(["+ /trial", "+ /mode", "+ /phase"]);
    let quantiles = BarChartView::new("Quantiles: +x, -x, +y, -y").with_origin("quantiles");
    let values = TimeSeriesView::new("Values of the actions").with_origin("action_values");
    let forces = TimeSeriesView::new("Lift ratio, force of the hand").with_origin("forces");
    let joints = TimeSeriesView::new("Joints, rad").with_origin("joints_rad");
    let log = TextLogView::new("Log").with_origin("log");
    let above = Horizontal::new([
        Tabs::new([plan.into(), planner.into()]).into(),
        scene.into(),
        ContainerLike::from(Vertical::new([camera.into(), observation.into()]).with_row_shares([3.0, 1.0])),
    ])
    .with_column_shares([4.0, 4.0, 2.0]);
    let below = Horizontal::new([
        ContainerLike::from(Vertical::new([errors.into(), mode.into()]).with_row_shares([3.0, 2.0])),
        Tabs::new([quantiles.into(), values.into(), forces.into(), joints.into()]).into(),
        log.into(),
    ])
    .with_column_shares([4.0, 3.0, 3.0]);
    let root = Vertical::new([above.into(), below.into()]).with_row_shares([3.0, 2.0]);
    // Paused, it opens at the beginning.
    let time = TimePanel::new()
        .with_state(PanelState::Collapsed)
        .with_timeline("recording_time")
        .with_play_state(PlayState::Paused);
    Blueprint::new(ContainerLike::from(root))
        .with_auto_views(false)
        .with_auto_layout(false)
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(time)
}
