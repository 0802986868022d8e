//! All routes, one file per resource.

mod calculator;
mod camera_stream;
pub mod challenges;
pub mod controllers;
pub mod description;
pub mod evaluations;
mod flow;
mod health;
mod jobs;
mod lumen;
pub mod maps;
mod moments;
mod policies;
mod recordings;
pub mod recoveries;
mod sessions;
mod tracker;
pub mod trainings;
pub mod values;
mod viewer;

use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::get;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use super::{Server, access, assets, live, metrics, openapi, problem};

/// Largest request body.
const BODY_LIMIT: usize = 1 << 20;
/// Largest file of a policy that can be uploaded; those that are trained here have one megabyte.
const POLICY_BODY_LIMIT: usize = 16 << 20;
/// Largest request body for ten thousand poses.
const BATCH_BODY_LIMIT: usize = 8 << 20;

/// Every route with its description: `routes!` takes no handler without one.
pub fn described() -> OpenApiRouter<Arc<Server>> {
    let calculator = OpenApiRouter::new()
        .routes(routes!(calculator::forward))
        .routes(routes!(calculator::inverse))
        .routes(routes!(calculator::workspace))
        .routes(routes!(calculator::field))
        .routes(routes!(calculator::pull))
        .routes(routes!(calculator::reach))
        .routes(routes!(calculator::plane))
        .layer(DefaultBodyLimit::max(BATCH_BODY_LIMIT));
    let policies = OpenApiRouter::new()
        .routes(routes!(policies::file, policies::add, policies::rename, policies::delete))
        .layer(DefaultBodyLimit::max(POLICY_BODY_LIMIT));
    OpenApiRouter::with_openapi(openapi::base())
        .routes(routes!(health::health))
        .routes(routes!(metrics::metrics))
        .routes(routes!(description::openapi))
        .routes(routes!(access::login::form, access::login::login))
        .routes(routes!(access::login::logout))
        .routes(routes!(maps::list, maps::add))
        .routes(routes!(maps::file, maps::delete))
        .routes(routes!(maps::check))
        .routes(routes!(sessions::sessions, sessions::create_session))
        .routes(routes!(sessions::open_own))
        .routes(routes!(sessions::session, sessions::delete_session))
        .routes(routes!(sessions::state))
        .routes(routes!(sessions::camera))
        .routes(routes!(camera_stream::camera_stream))
        .routes(routes!(sessions::observation))
        .routes(routes!(tracker::tracker))
        .routes(routes!(flow::flow))
        .routes(routes!(lumen::lumen))
        .routes(routes!(values::values))
        .routes(routes!(moments::moment))
        .routes(routes!(moments::camera))
        .routes(routes!(moments::observation))
        .routes(routes!(moments::case))
        .routes(routes!(live::live))
        .routes(routes!(evaluations::list, evaluations::create))
        .routes(routes!(evaluations::report, evaluations::cancel))
        .routes(routes!(evaluations::file))
        .routes(routes!(recoveries::list, recoveries::create))
        .routes(routes!(recoveries::report, recoveries::cancel))
        .routes(routes!(recoveries::file))
        .routes(routes!(recoveries::tries))
        .routes(routes!(recoveries::case))
        .routes(routes!(trainings::list, trainings::create))
        .routes(routes!(trainings::report, trainings::delete))
        .routes(routes!(trainings::pause))
        .routes(routes!(trainings::resume))
        .routes(routes!(trainings::cells))
        .routes(routes!(trainings::frame))
        .routes(routes!(jobs::list))
        .routes(routes!(jobs::cancel))
        .routes(routes!(jobs::pause))
        .routes(routes!(jobs::resume))
        .routes(routes!(challenges::list))
        .routes(routes!(challenges::report))
        .routes(routes!(challenges::ghosts))
        .routes(routes!(challenges::add))
        .routes(routes!(challenges::attempt))
        .routes(routes!(policies::list))
        .routes(routes!(controllers::list))
        .routes(routes!(controllers::connect))
        .routes(routes!(recordings::recordings))
        .routes(routes!(recordings::recording, recordings::rename, recordings::delete))
        .routes(routes!(viewer::file))
        .layer(DefaultBodyLimit::max(BODY_LIMIT))
        .merge(calculator)
        .merge(policies)
}

/// Everything that is served: the routes and the pages.
pub fn served() -> Router<Arc<Server>> {
    Router::from(described())
        .route("/", get(assets::main_session))
        .route("/s/{name}", get(assets::named_session))
        .route("/s/{name}/{view}", get(assets::named_session))
        .route("/s/{name}/learn/{lesson}", get(assets::named_session))
        .route("/demo", get(assets::demo))
        .route("/board", get(assets::board))
        .method_not_allowed_fallback(problem::method_not_allowed)
        .fallback(assets::page)
}
