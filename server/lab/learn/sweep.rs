//! The camera's images from every place of a map (paper, §IV-A), taken by the same code as a live trial's images and
//! kept on disk.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use ferry_camera::{Camera, Gpu};
use ferry_core::control::TargetStep;
use ferry_core::geometry::{Band, Point2, Point3, Rect};
use ferry_core::image::{CameraError, CameraMount, Subject, VIEW_PX};
use ferry_core::map::READER;
use ferry_core::perception::{OBSERVATION_SIZE_PX, Observation, Percept};
use ferry_core::plant::{BEAD_RADIUS_M, Positioner, PositionerKind};
use ferry_core::policy::Action;
use ferry_core::scenario::Parameters;
use ferry_core::trial::Arena;

/// Step of the policy, and distance between two places in training (paper, §IV-A).
pub const STEP_M: f64 = 0.01;
/// Bytes per image.
pub const IMAGE_BYTES: usize = OBSERVATION_SIZE_PX * OBSERVATION_SIZE_PX;
/// Must be increased when the same map gives different images: new colours, another observation, another file layout.
const VERSION: u32 = 3;
/// Largest number of sweeps in a folder; one has about 13 MB.
const KEPT: usize = 32;
/// A sweep has no bead: it is placed out of view.
const OUT_OF_SIGHT_M: f64 = 100.0;

/// Why a sweep has no result.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// `progress` has stopped it.
    #[error("the images of the map were not all taken: it was stopped")]
    Stopped,
}

/// Called after each image; it may stop the sweep.
pub type Progress<'a> = &'a (dyn Fn() -> ControlFlow<()> + Sync);

/// One image for each cell of the workspace, taken above the cell's centre.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// Side of a cell.
    pub spacing_m: f64,
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Whether the obstacle test is positive; row by row from the lower left, like all fields here.
    pub obstacle: Vec<bool>,
    /// Steps of 1 cm that [`Limits::step`] admits from the cell, decided from the cell's image: bit `i` for
    /// `Action::ALL[i]`.
    ///
    /// [`Limits::step`]: ferry_core::control::limits::Limits::step
    pub steps: Vec<u8>,
    /// Distance from the tool to the nearest wall in the image, in tenths of a millimetre; 255 if it is more.
    pub wall_distance: Vec<u8>,
    /// `[rows · columns][84][84]`, flat: channel 0 of the observation.
    pub images: Vec<u8>,
}

impl std::fmt::Debug for Sweep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Sweep of {} × {}", self.columns, self.rows)
    }
}

impl Sweep {
    /// Takes all images on all CPU cores, one every `spacing_m`. `wave_m` says how far the walls have closed in at the
    /// lumen's knots; it is empty for walls at rest.
    ///
    /// # Errors
    /// [`SweepError`].
    pub fn take(
        arena: &Arena,
        gpu: &Arc<Gpu>,
        spacing_m: f64,
        wave_m: &[f64],
        progress: Progress<'_>,
    ) -> Result<Self, SweepError> {
        let (columns, rows) = cells(arena, spacing_m);
        let moved_walls = moved_walls(arena, wave_m);
        let views = (0..rows)
            .into_par_iter()
            .map_init(
                || None,
                |kept, row| {
                    let camera = match kept {
                        Some(camera) => camera,
                        None => kept.insert(Camera::of(gpu, arena.static_scene())?),
                    };
                    (0..columns)
                        .map(|column| {
                            let tool = center(arena.map.workspace(), spacing_m, column, row);
                            let view = take_view(arena, camera, tool, moved_walls.clone())?;
                            if progress().is_break() {
                                return Err(SweepError::Stopped);
                            }
                            Ok(view)
                        })
                        .collect::<Result<Vec<_>, SweepError>>()
                },
            )
            .collect::<Result<Vec<_>, SweepError>>()?;
        let cells = columns * rows;
        let mut sweep = Self {
            spacing_m,
            columns,
            rows,
            obstacle: Vec::with_capacity(cells),
            steps: Vec::with_capacity(cells),
            wall_distance: Vec::with_capacity(cells),
            images: Vec::with_capacity(cells * IMAGE_BYTES),
        };
        for view in views.into_iter().flatten() {
            sweep.obstacle.push(view.obstacle);
            sweep.steps.push(view.steps);
            sweep.wall_distance.push(view.wall_distance);
            sweep.images.extend(view.image);
        }
        Ok(sweep)
    }

    /// Reads the sweep from `folder`, or takes a new one and writes it there. The file name is a hash of everything
    /// that determines the images. A damaged file or one of another version is replaced. A sweep that cannot be written
    /// is only logged.
    ///
    /// # Errors
    /// [`SweepError`].
    pub fn open(
        arena: &Arena,
        gpu: &Arc<Gpu>,
        folder: &Path,
        spacing_m: f64,
        wave_m: &[f64],
        progress: Progress<'_>,
    ) -> Result<Self, SweepError> {
        if let Some(kept) = Self::kept(arena, folder, spacing_m, wave_m) {
            return Ok(kept);
        }
        let sweep = Self::take(arena, gpu, spacing_m, wave_m, progress)?;
        prune(folder);
        let path = path_of(arena, folder, spacing_m, wave_m);
        // The sweep is usable even if it cannot be kept.
        if let Err(error) = sweep.write(folder, &path) {
            tracing::warn!(%error, path = %path.display(), "sweep not kept");
        }
        Ok(sweep)
    }

    /// The images of a map, if the folder has them.
    pub fn kept(arena: &Arena, folder: &Path, spacing_m: f64, wave_m: &[f64]) -> Option<Self> {
        read(&path_of(arena, folder, spacing_m, wave_m), cells(arena, spacing_m))
    }

    /// The image above a cell.
    pub fn image(&self, cell: usize) -> &[u8] {
        &self.images[cell * IMAGE_BYTES..(cell + 1) * IMAGE_BYTES]
    }

    /// The cells whose image is free of obstacles and keeps `clearance_m`.
    pub fn free(&self, clearance_m: f64) -> Vec<usize> {
        let keeps = |cell: usize| f64::from(self.wall_distance[cell]) * 1e-4 >= clearance_m;
        (0..self.columns * self.rows).filter(|&cell| !self.obstacle[cell] && keeps(cell)).collect()
    }

    /// Writes to a temporary name first, so that no reader finds half a file.
    fn write(&self, folder: &Path, path: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        let part = path.with_extension("part");
        let bytes = postcard::to_stdvec(self).map_err(std::io::Error::other)?;
        let mut file = BufWriter::new(File::create(&part)?);
        file.write_all(&xxhash_rust::xxh3::xxh3_64(&bytes).to_le_bytes())?;
        file.write_all(&bytes)?;
        file.into_inner()?.sync_all()?;
        std::fs::rename(part, path)
    }
}

fn path_of(arena: &Arena, folder: &Path, spacing_m: f64, wave_m: &[f64]) -> PathBuf {
    folder.join(format!("{:016x}.sweep", content_hash(arena, spacing_m, wave_m)))
}

/// Makes room for one more sweep by removing the oldest. Does nothing if the folder cannot be read.
fn prune(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let is_sweep = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "sweep" || ending == "part");
    let mut kept: Vec<_> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()).filter(is_sweep))
        .map(|path| (std::fs::metadata(&path).and_then(|data| data.modified()).ok(), path))
        .collect();
    kept.sort();
    for (_, path) in kept.iter().take((kept.len() + 1).saturating_sub(KEPT)) {
        let _ = std::fs::remove_file(path);
    }
}

/// A sweep from a file; `None` if it is damaged or has another version or shape.
fn read(path: &Path, (columns, rows): (usize, usize)) -> Option<Sweep> {
    let mut bytes = Vec::new();
    BufReader::new(File::open(path).ok()?).read_to_end(&mut bytes).ok()?;
    let (hash, bytes) = bytes.split_at_checked(8)?;
    if xxhash_rust::xxh3::xxh3_64(bytes).to_le_bytes() != hash {
        return None;
    }
    let sweep: Sweep = postcard::from_bytes(bytes).ok()?;
    let cells = columns * rows;
    let numbers = [sweep.obstacle.len(), sweep.steps.len(), sweep.wall_distance.len()];
    let fits = numbers == [cells; 3] && sweep.images.len() == cells * IMAGE_BYTES;
    (fits && (sweep.columns, sweep.rows) == (columns, rows)).then_some(sweep)
}

/// Hash of the map's drawing, its reader, the motion of walls, the camera, the places and this module's version. Equal hashes mean equal images.
fn content_hash(arena: &Arena, spacing_m: f64, wave_m: &[f64]) -> u64 {
    let CameraMount {
        height_m,
        offset_m: [x_m, y_m],
        tilt_rad: [tilt_x_rad, tilt_y_rad],
        field_of_view_rad,
        sees_magnet,
    } = CameraMount::default();
    let mount = [height_m, x_m, y_m, tilt_x_rad, tilt_y_rad, field_of_view_rad, f64::from(u8::from(sees_magnet))];
    let numbers = mount.into_iter().chain([f64::from(VIEW_PX), spacing_m, f64::from(VERSION), f64::from(READER)]);
    let numbers = numbers.chain(wave_m.iter().copied());
    let mut hash = xxhash_rust::xxh3::Xxh3::new();
    for number in numbers {
        hash.update(&number.to_bits().to_le_bytes());
    }
    hash.update(arena.map.svg().as_bytes());
    hash.digest()
}

/// Columns and rows of whole cells.
pub fn cells(arena: &Arena, spacing_m: f64) -> (usize, usize) {
    let size_m = arena.map.workspace().size_m();
    let count = |side_m: f64| (side_m / spacing_m + 1e-6).floor().max(1.0) as usize;
    (count(size_m.x), count(size_m.y))
}

/// Centre of a cell.
pub fn center(workspace: &Rect, spacing_m: f64, column: usize, row: usize) -> Point2<f64> {
    let along = |index: usize| (index as f64 + 0.5) * spacing_m;
    Point2::new(workspace.x_min_m + along(column), workspace.y_min_m + along(row))
}

/// The results from one image.
struct View {
    obstacle: bool,
    steps: u8,
    wall_distance: u8,
    image: Vec<u8>,
}

/// What the walls cover beyond their drawn place; `None` at rest.
fn moved_walls(arena: &Arena, wave_m: &[f64]) -> Option<Arc<[Band]>> {
    let nowhere = Point2::new(OUT_OF_SIGHT_M, OUT_OF_SIGHT_M);
    (!wave_m.is_empty()).then(|| arena.lumen().bands(wave_m, nowhere).into())
}

fn take_view(
    arena: &Arena,
    camera: &mut Camera,
    tool: Point2<f64>,
    moved_walls: Option<Arc<[Band]>>,
) -> Result<View, CameraError> {
    let parameters = Parameters::default();
    let tool_m = Point3::new(tool.x, tool.y, parameters.tool_height_m);
    let subject = Subject {
        tick: 0,
        tool_m: tool_m.coords.into(),
        turn_rad: 0.0,
        bead_m: [OUT_OF_SIGHT_M, OUT_OF_SIGHT_M, BEAD_RADIUS_M],
        goal_m: None,
        link_frames: None,
        block_size_m: [0.05, 0.025, 0.01],
        mount: CameraMount::default(),
        moved_walls,
    };
    let percept = Percept::of(&camera.capture(&subject)?, tool);
    let observation = Observation::new(&percept.gray, None, tool, arena.map.workspace());
    let limits = arena.limits(&parameters);
    let positioner = Positioner::home(PositionerKind::of(&arena.map), tool_m);
    let admits = |action: Action| {
        let target_m = tool + action.direction() * STEP_M;
        let step = TargetStep { target_m, speed_m_s: parameters.transport_speed_m_s };
        limits.step(tool_m, &step, &percept, &positioner).is_ok()
    };
    let steps = (0..4).filter(|&index| admits(Action::ALL[index])).map(|index| 1 << index).sum();
    let wall_distance =
        percept.wall_distance_m(tool, 0.0255).map_or(255, |distance_m| (distance_m * 1e4).floor() as u8);
    Ok(View { obstacle: percept.obstacle(), steps, wall_distance, image: observation.channel(0).pixels })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::*;
    use ferry_camera::AdapterChoice;
    use ferry_core::map::Map;

    fn arena() -> Arc<Arena> {
        let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 200 120 100">
            <rect x="-60" y="230" width="30" height="30"/></svg>"#;
        Arena::of(Map::from_svg("small", svg).unwrap())
    }

    #[test]
    fn a_sweep_matches_a_live_camera_and_is_taken_once() {
        let (arena, gpu) = (arena(), Gpu::open(AdapterChoice::Auto).unwrap());
        let folder = tempfile::tempdir().unwrap();
        let taken = AtomicU32::new(0);
        let progress = || {
            taken.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        let open = || Sweep::open(&arena, &gpu, folder.path(), STEP_M, &[], &progress).unwrap();
        let sweep = open();
        assert_eq!((sweep.columns, sweep.rows, taken.load(Ordering::Relaxed)), (12, 10, 120));
        let mut camera = Camera::of(&gpu, arena.static_scene()).unwrap();
        for (column, row) in [(0, 0), (5, 5), (11, 9)] {
            let tool = center(arena.map.workspace(), STEP_M, column, row);
            let view = take_view(&arena, &mut camera, tool, None).unwrap();
            let cell = row * 12 + column;
            assert_eq!((sweep.obstacle[cell], sweep.image(cell)), (view.obstacle, view.image.as_slice()));
            assert_eq!((sweep.steps[cell], sweep.wall_distance[cell]), (view.steps, view.wall_distance));
            assert_eq!(view.obstacle, !arena.map.is_free(tool));
        }
        // At a border no step leads out; left of the wall, none leads into it.
        assert_eq!(sweep.steps[0] & 0b1010, 0);
        assert_eq!(sweep.steps[5 * 12 + 3] & 0b0001, 0);
        assert_ne!(sweep.steps[5 * 12 + 2] & 0b0001, 0);
        let near = sweep.wall_distance[5 * 12 + 3];
        // To the middle of the wall's first pixel, which is about .4 mm wide.
        assert!((48..=55).contains(&near), "the wall begins 5 mm beside it: {near}");
        assert_eq!(open(), sweep);
        assert_eq!(taken.load(Ordering::Relaxed), 120, "read from disk");

        // A damaged file is not used.
        let path = std::fs::read_dir(folder.path()).unwrap().next().unwrap().unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
        assert_eq!(open(), sweep);
        assert_eq!(taken.load(Ordering::Relaxed), 240, "taken again");

        // A coarser sweep has different images.
        let coarse = Sweep::open(&arena, &gpu, folder.path(), 0.025, &[], &progress).unwrap();
        assert_eq!((coarse.columns, coarse.rows, taken.load(Ordering::Relaxed)), (4, 4, 256));
        let corner = arena.map.workspace();
        let last = center(corner, 0.025, 3, 3) - Point2::new(corner.x_min_m, corner.y_min_m);
        assert!((last.x - 0.0875).abs() < 1e-12 && (last.y - 0.0875).abs() < 1e-12, "{last}");
        assert_eq!(open(), sweep);
    }

    #[test]
    fn walls_that_have_closed_in_leave_fewer_cells() {
        let (arena, gpu) = (arena(), Gpu::open(AdapterChoice::Auto).unwrap());
        let progress = || ControlFlow::Continue(());
        let free = |wave_m: &[f64]| Sweep::take(&arena, &gpu, STEP_M, wave_m, &progress).unwrap().free(0.0);
        let wave_m = vec![0.012; arena.lumen().knots_m().count()];
        let (rest, closed) = (free(&[]), free(&wave_m));
        assert!(closed.iter().all(|cell| rest.contains(cell)));
        // 5 and 15 mm left of the wall.
        let [near, far] = [5 * 12 + 3, 5 * 12 + 2];
        assert!(rest.contains(&near) && !closed.contains(&near) && closed.contains(&far), "{rest:?} {closed:?}");
    }
}
