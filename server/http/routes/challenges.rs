//! `/api/challenges`: trials that people steer, their ghosts, and their boards.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;

use super::sessions::find;
use jiff::Timestamp;

use crate::boards::{BoardError, Boards, Signature};
use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::lists;
use crate::http::path::{ChallengePath, Path, SessionPath};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, NotFound, OutOfRange, TooMany, Unavailable};
use crate::protocol::{AttemptAnswer, AttemptQuery, AttemptReport, ChallengeReport, Challenges, Ghosts};
use ferry_camera::{Camera, Gpu};
use ferry_core::challenge::{AttemptError, Challenge, ChallengeError, ChallengeName, Ghost};
use ferry_core::image::CameraError;
use ferry_core::scenario::ControllerName;
use ferry_core::session::Ended;
use ferry_core::trial::TrialError;
use ferry_lab::changes::Changes;
use ferry_lab::jobs::{Lane, gentle_pool};

/// Attempts wait for each other, and so do the controllers' runs. An attempt never waits for them.
const RUN_WAITS: Duration = Duration::from_secs(60);
/// Challenges whose ghosts are kept in memory.
const KEPT: usize = 32;

/// Boards, and the newest ghosts, the newest one last.
pub struct Contests {
    pub boards: Boards,
    ghosts: Mutex<Vec<(ChallengeName, Arc<Vec<Ghost>>)>>,
}

impl Contests {
    pub fn in_folder(folder: PathBuf) -> Self {
        Self { boards: Boards::in_folder(folder), ghosts: Mutex::default() }
    }

    /// Those of the boards. With the date, the list changes too.
    pub fn changes(&self) -> &Changes {
        &self.boards.changes
    }

    /// The controllers' runs on a challenge. Blocks for seconds the first time; live sessions continue meanwhile.
    fn ghosts_of(&self, challenge: &Challenge, gpu: &Arc<Gpu>) -> Result<Arc<Vec<Ghost>>, NoGhosts> {
        let mut kept = self.ghosts.lock().unwrap_or_else(PoisonError::into_inner);
        let known = match kept.iter().position(|(name, _)| *name == challenge.name) {
            Some(index) => kept.remove(index),
            None => {
                let pool = gentle_pool(Lane::Short, "ghosts")?;
                let run = |controller| {
                    let mut camera = Camera::of(gpu, challenge.arena.static_scene())?;
                    Ok::<_, NoGhosts>(challenge.ghost(controller, &mut camera)?)
                };
                let all =
                    pool.install(|| ControllerName::OFFERED.into_iter().map(run).collect::<Result<Vec<_>, _>>())?;
                (challenge.name.clone(), Arc::new(all))
            }
        };
        let ghosts = known.1.clone();
        kept.push(known);
        if kept.len() > KEPT {
            kept.remove(0);
        }
        Ok(ghosts)
    }
}

#[derive(Debug, thiserror::Error)]
enum NoGhosts {
    #[error(transparent)]
    Challenge(#[from] ChallengeError),
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error(transparent)]
    Trial(#[from] TrialError),
    #[error("the thread of the ghosts could not start: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl From<NoGhosts> for Problem {
    fn from(error: NoGhosts) -> Self {
        Self::internal(error)
    }
}

fn named(name: &str) -> Result<ChallengeName, Problem> {
    name.parse().map_err(|error: ferry_core::challenge::NotAChallenge| {
        Problem::new(StatusCode::NOT_FOUND, "not_found", error.to_string()).field("name")
    })
}

/// Those of the day and of the week, and those that were played before.
#[utoipa::path(get, path = "/api/challenges", tag = "challenges", operation_id = "challenges",
    responses((status = 200, body = Challenges), Unavailable))]
pub async fn list(State(server): State<Arc<Server>>) -> Result<Json<Challenges>, Problem> {
    Ok(Json(Challenges { challenges: server.work(|server| lists::challenges(server)).await? }))
}

/// A challenge with its board.
#[utoipa::path(get, path = "/api/challenges/{name}", tag = "challenges", params(ChallengePath),
    operation_id = "challenge", responses((status = 200, body = ChallengeReport), NotFound, Unavailable))]
pub async fn report(
    State(server): State<Arc<Server>>,
    Path(ChallengePath { name }): Path<ChallengePath>,
) -> Result<Json<ChallengeReport>, Problem> {
    let name = named(&name)?;
    let report = server.work(|server| {
        let board = server.contests.boards.of(&name);
        Challenge::of(name).map(|challenge| ChallengeReport::of(&challenge, &board))
    });
    Ok(Json(report.await?.map_err(NoGhosts::from)?))
}

/// The runs of the three controllers and of the best person. The first request takes some seconds.
#[utoipa::path(get, path = "/api/challenges/{name}/ghosts", tag = "challenges", params(ChallengePath),
    operation_id = "challenge_ghosts", responses((status = 200, body = Ghosts), NotFound, Unavailable))]
pub async fn ghosts(
    State(server): State<Arc<Server>>,
    Path(ChallengePath { name }): Path<ChallengePath>,
) -> Result<Json<Ghosts>, Problem> {
    let name = named(&name)?;
    let runs = server.work_at(&server.ghosts, RUN_WAITS, move |server| {
        let best = server.contests.boards.of(&name).into_iter().next();
        let challenge = Challenge::of(name)?;
        let ghosts = server.contests.ghosts_of(&challenge, &server.gpu)?;
        Ok::<_, NoGhosts>(Ghosts::of(&ghosts, best.as_ref()))
    });
    Ok(Json(runs.await??))
}

/// The attempt at the challenge that is being played, and where it lost time.
#[utoipa::path(get, path = "/api/sessions/{id}/attempt", tag = "challenges", params(SessionPath),
    operation_id = "attempt", responses((status = 200, body = AttemptReport), NotFound, OutOfRange, Unavailable))]
pub async fn attempt(
    State(server): State<Arc<Server>>,
    Path(SessionPath { id }): Path<SessionPath>,
) -> Result<Json<AttemptReport>, Problem> {
    let played = find(&server, &id)?.session.played().await.map_err(|error| Problem::from(&error))?;
    let report = server.work_at(&server.ghosts, RUN_WAITS, move |server| {
        let ghosts = server.contests.ghosts_of(&played.challenge, &server.gpu)?;
        Ok::<_, NoGhosts>(AttemptReport::of(&played, &ghosts))
    });
    Ok(Json(report.await??))
}

/// Puts an attempt on the board, after its log was run again. It must be the one that was just played in the session.
#[utoipa::path(post, path = "/api/challenges/{name}/attempts", tag = "challenges", params(ChallengePath),
    operation_id = "add_attempt", request_body = AttemptQuery,
    responses((status = 201, body = AttemptAnswer), NotFound, Conflict, OutOfRange, TooMany, Unavailable))]
pub async fn add(
    State(server): State<Arc<Server>>,
    Path(ChallengePath { name }): Path<ChallengePath>,
    WholeBody(body): WholeBody,
) -> Result<(StatusCode, Json<AttemptAnswer>), Problem> {
    let name = named(&name)?;
    let AttemptQuery { session, seat, player, class, attempt } = parse(&body)?;
    let hub = server.sessions.find(&session);
    let hub = hub.ok_or_else(|| refused("unknown_session", "session", format!("there is no session {session:?}")))?;
    let played = hub.session.played().await.map_err(|error| Problem::from(&error).field("session"))?;
    if played.challenge.name != name {
        let detail = format!("session {session:?} plays {}, not {name}", played.challenge.name);
        return Err(refused("other_challenge", "session", detail));
    }
    if !hub.is_player(&seat) {
        let detail = format!("seat is not that of the browser that began the attempt in session {session:?}");
        return Err(refused("other_player", "seat", detail));
    }
    if let Some(why) = played.void {
        return Err(refused("does_not_count", "session", format!("the attempt does not count: {why}")));
    }
    let Some(Ended::Delivered(own)) = played.ended else {
        return Err(refused("not_delivered", "session", "the attempt in the session has no delivery".to_owned()));
    };
    if own.log != attempt.log {
        let detail = format!("attempt.log is not what was played in session {session:?}");
        return Err(refused("other_log", "attempt.log", detail));
    }
    let signature = Signature { player, class, at: now() };
    let answer = server.work_at(&server.judge, RUN_WAITS, move |server| {
        let mut camera = Camera::of(&server.gpu, played.challenge.arena.static_scene()).map_err(Problem::internal)?;
        let run = played.challenge.judge(&attempt, &mut camera)?;
        let total_s = run.score.total_s();
        let is_kept = server.contests.boards.add(&name, signature.clone(), &attempt, run)?;
        let board = server.contests.boards.of(&name);
        let is_own = |other: &Signature| other.player == signature.player && other.class == signature.class;
        let place = board.iter().position(|entry| is_own(&entry.signature)).map(|index| index + 1);
        Ok::<_, Problem>(AttemptAnswer { total_s, is_kept, place, entries: board.len() })
    });
    Ok((StatusCode::CREATED, Json(answer.await??)))
}

/// To the second.
fn now() -> String {
    let second = Timestamp::from_second(Timestamp::now().as_second());
    second.unwrap_or_default().to_string()
}

fn refused(code: &str, field: &str, detail: String) -> Problem {
    Problem::new(StatusCode::UNPROCESSABLE_ENTITY, code, detail).field(field)
}

impl From<AttemptError> for Problem {
    fn from(error: AttemptError) -> Self {
        match error {
            AttemptError::Trial(error) => Self::internal(error),
            error => refused("attempt_refused", &format!("attempt.{}", error.field()), format!("attempt.{error}")),
        }
    }
}

impl From<BoardError> for Problem {
    fn from(error: BoardError) -> Self {
        let detail = error.to_string();
        match error {
            BoardError::Name { field, .. } => refused("out_of_range", field, detail),
            BoardError::Again => Self::new(StatusCode::CONFLICT, "again", detail).field("attempt.log"),
            BoardError::Full => Self::new(StatusCode::TOO_MANY_REQUESTS, "too_many_boards", detail),
            BoardError::Io(_) => Self::new(StatusCode::INSUFFICIENT_STORAGE, "not_kept", detail),
        }
    }
}
