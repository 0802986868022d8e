//! Comparisons: they continue from a moment under several controllers, beside the session and at low priority.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::frames::json;
use super::hub::Hub;
use crate::protocol::{Branch, ComparisonMessage, JobKind, JobStage, JobSummary, ServerMessage};
use crate::session::{BranchPoint, CommandError};
use ferry_camera::{Camera, Gpu};
use ferry_core::image::CameraError;
use ferry_core::scenario::ControllerName;
use ferry_core::session::Recalled;
use ferry_core::trial::TrialError;
use ferry_lab::jobs::{Lane, Life, Queue, Stage, Ticket, gentle_device, gentle_thread};
use ferry_lab::program::ProgramError;

/// Interval of progress messages.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);
/// Number of ended comparisons that are kept.
const KEPT: usize = 16;
/// The kind of work of a branch, for its pace, and the first guess of it: with a software graphics driver on two cores.
const WORK: &str = "comparison";
const GUESS_S: f64 = 2.0;

/// A comparison as a job. It does not wait in a lane: what it finds is shown at once.
pub struct Comparison {
    pub id: String,
    session: String,
    map: String,
    ticket: Ticket,
    /// The share that is done.
    pub life: Life<f64>,
}

/// The comparisons of a server, one at a time in each session.
pub struct Comparisons {
    gpu: Arc<Gpu>,
    /// Opened by the first one, on a thread with low priority.
    device: Mutex<Option<Arc<Gpu>>>,
    queue: Arc<Queue>,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    jobs: Vec<Arc<Comparison>>,
    /// Number of jobs so far, for their ids.
    made: u64,
}

impl Comparisons {
    /// Comparisons that are listed with the jobs of a queue; their device will be like `gpu`.
    pub fn new(gpu: Arc<Gpu>, queue: Arc<Queue>) -> Self {
        queue.paces.guess(WORK, GUESS_S);
        Self { gpu, device: Mutex::default(), queue, kept: Mutex::default() }
    }

    /// In the order in which they began.
    pub fn all(&self) -> Vec<Arc<Comparison>> {
        self.lock().jobs.clone()
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts a comparison of a session in place of its last one. It sends its own messages. No controllers are all.
    ///
    /// # Errors
    /// The moment is not kept, or has no goal.
    pub async fn start(
        self: &Arc<Self>,
        hub: &Arc<Hub>,
        tick: u64,
        controllers: &[ControllerName],
    ) -> Result<(), CommandError> {
        let point = hub.session.recall(tick, Recalled::Present).await?;
        let mut asked = ControllerName::OFFERED.to_vec();
        asked.extend(point.program().map(|_| ControllerName::Program));
        asked.retain(|name| controllers.is_empty() || controllers.contains(name));
        if !point.point.has_goal() {
            return Err(CommandError::NoGoal { tick });
        }
        let trial = hub.session.watch().borrow().scenery.trial;
        let job = self.add(&hub.id, point.point.arena().map.name(), asked.len());
        let (all, hub) = (self.clone(), hub.clone());
        tokio::spawn(async move {
            // The previous one stops at its next tick.
            let Ok(place) = hub.comparing().acquire_owned().await else { return };
            let comparing = tokio::task::spawn_blocking(move || {
                let _place = place;
                let failed = job.clone();
                let work = move || all.run(&job, &hub, trial, &point, &asked);
                let ran = gentle_thread(Lane::Short, "comparison".to_owned(), work).map(std::thread::JoinHandle::join);
                if !matches!(ran, Ok(Ok(()))) {
                    failed.life.end(Stage::Failed("its thread ended".to_owned()));
                }
            });
            // The function catches panics.
            let _ = comparing.await;
        });
        Ok(())
    }

    fn add(&self, session: &str, map: &str, branches: usize) -> Arc<Comparison> {
        let estimate_s = branches as f64 * self.queue.paces.each_s(WORK);
        let ticket = Ticket { owner: Some(session.to_owned()), lane: Lane::Short, estimate_s };
        let mut kept = self.lock();
        for before in kept.jobs.iter().filter(|before| before.session == session) {
            before.life.cancel();
        }
        let ended = kept.jobs.iter().filter(|job| job.life.stage().is_final()).count();
        for _ in KEPT..=ended {
            if let Some(oldest) = kept.jobs.iter().position(|job| job.life.stage().is_final()) {
                kept.jobs.remove(oldest);
            }
        }
        kept.made += 1;
        let id = format!("comparison-{}", kept.made);
        let (session, map) = (session.to_owned(), map.to_owned());
        let job = Arc::new(Comparison { id, session, map, ticket, life: Life::new(0.0) });
        job.life.report_to(&self.queue.changes);
        kept.jobs.push(job.clone());
        drop(kept);
        self.queue.changes.note();
        job
    }

    /// The device of all comparisons.
    fn device(&self) -> Result<Arc<Gpu>, CameraError> {
        let mut device = self.device.lock().unwrap_or_else(PoisonError::into_inner);
        match &*device {
            Some(opened) => Ok(opened.clone()),
            None => Ok(device.insert(gentle_device(&self.gpu)?).clone()),
        }
    }

    fn run(&self, job: &Arc<Comparison>, hub: &Hub, trial: u64, point: &BranchPoint, controllers: &[ControllerName]) {
        if !job.life.begin() {
            return;
        }
        let is_closing = hub.closing();
        let is_wanted = || !job.life.stop().load(Ordering::Relaxed) && !*is_closing.borrow();
        let branches = controllers.len() as f64;
        let send = |message: ComparisonMessage, share: f64| {
            job.life.update(|done| *done = share);
            let kept = self.lock();
            // One that was replaced sends no more.
            if kept.jobs.iter().rfind(|one| one.session == job.session).is_some_and(|last| Arc::ptr_eq(last, job)) {
                hub.send_comparison(json(&ServerMessage::Comparison(Box::new(message))));
            }
        };
        let failed = compare(point, trial, controllers, || self.device(), &is_wanted, &send);
        if failed.is_none() && is_wanted() {
            self.queue.paces.measure(WORK, branches, job.life.spent_s());
        }
        job.life.end(match failed {
            Some(reason) => Stage::Failed(reason),
            None if is_wanted() => Stage::Done,
            None => Stage::Cancelled,
        });
    }
}

impl From<&Comparison> for JobSummary {
    fn from(job: &Comparison) -> Self {
        let (stage, share) = job.life.read(|stage, &share| (JobStage::of(stage), share));
        let left_s = match share > 0.0 {
            true => job.life.spent_s() * (1.0 / share - 1.0),
            false => job.ticket.estimate_s,
        };
        Self::new((&job.id, JobKind::Comparison, job.map.clone()), &job.ticket, stage, [share, 1.0], left_s)
    }
}

/// Blocks until all branches have ended, or until `is_wanted` returns false, and returns why it failed, if it did. `send`
/// gets each message and the share that is done.
fn compare(
    point: &BranchPoint,
    trial: u64,
    controllers: &[ControllerName],
    device: impl FnOnce() -> Result<Arc<Gpu>, CameraError>,
    is_wanted: &dyn Fn() -> bool,
    send: &dyn Fn(ComparisonMessage, f64),
) -> Option<String> {
    let mut comparison = ComparisonMessage::begin(trial, &point.point);
    send(comparison.clone(), 0.0);
    let each = 1.0 / controllers.len() as f64;
    let (from, until) = (comparison.tick, comparison.until_tick);
    let mut share = 0.0;
    let run = || -> Result<(), ProgramError> {
        let scene = point.point.arena().static_scene();
        let mut camera = device().and_then(|gpu| Camera::of(&gpu, scene)).map_err(TrialError::from)?;
        for (&controller, before) in controllers.iter().zip(0..) {
            comparison.branches.push(Branch::begin(controller, point.program().map(|program| &**program)));
            let mut told = Instant::now();
            point.branch(controller, &mut camera, &mut |progress| {
                let tick = progress.record.moment.tick;
                share = each * (f64::from(before) + (tick - from) as f64 / until.saturating_sub(from).max(1) as f64);
                if let Some(branch) = comparison.branches.last_mut() {
                    branch.follow(&point.point, &progress);
                }
                if !is_wanted() {
                    return ControlFlow::Break(());
                }
                if told.elapsed() >= PROGRESS_INTERVAL {
                    told = Instant::now();
                    send(comparison.clone(), share);
                }
                ControlFlow::Continue(())
            })?;
            if !is_wanted() {
                break;
            }
            share = each * f64::from(before + 1);
        }
        Ok(())
    };
    // A panic in a controller only ends the comparison, with a message.
    let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
    comparison.running = false;
    comparison.failed = match outcome {
        Ok(Ok(())) => None,
        Ok(Err(error)) => Some(error.to_string()),
        Err(_) => Some("a controller failed; see the server's log".to_owned()),
    };
    let failed = comparison.failed.clone();
    send(comparison, share);
    failed
}
