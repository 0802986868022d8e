//! The graphics device: opened once, shared by every camera.

use std::str::FromStr;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::{CameraError, MAX_PX, Quality};

/// Which graphics drivers may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The fastest adapter of any driver. An adapter that renders on the CPU is used only if there is no other.
    #[default]
    Auto,
    /// Vulkan only.
    Vulkan,
    /// OpenGL (ES) only.
    Gl,
}

impl AdapterChoice {
    fn backends(self) -> wgpu::Backends {
        use wgpu::Backends;
        match self {
            Self::Auto => Backends::VULKAN | Backends::GL | Backends::METAL | Backends::DX12,
            Self::Vulkan => Backends::VULKAN,
            Self::Gl => Backends::GL,
        }
    }
}

impl FromStr for AdapterChoice {
    type Err = CameraError;

    /// `auto`, `vulkan` or `gl`, case-insensitive.
    fn from_str(text: &str) -> Result<Self, CameraError> {
        match text.to_ascii_lowercase().as_str() {
            "auto" => Ok(Self::Auto),
            "vulkan" => Ok(Self::Vulkan),
            "gl" => Ok(Self::Gl),
            _ => Err(CameraError::UnknownAdapter { given: text.into() }),
        }
    }
}

/// An open graphics device, shared between sessions. All calls are safe from any thread.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    adapter_name: String,
    quality: Quality,
    choice: AdapterChoice,
    /// Opened by the first camera that finds this device lost, and used by all others.
    successor: Mutex<Option<Arc<Self>>>,
    /// The driver's message. Set once by the driver, from any thread that uses the device.
    lost: Arc<OnceLock<String>>,
}

impl Gpu {
    /// Opens the best adapter that `choice` allows. Blocks for a moment.
    ///
    /// # Errors
    /// [`CameraError::NoAdapter`] if there is no driver, [`CameraError::DeviceRefused`] if a driver exists but fails.
    pub fn open(choice: AdapterChoice) -> Result<Arc<Self>, CameraError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = choice.backends();
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|error| CameraError::NoAdapter { reason: error.to_string() })?;
        let info = adapter.get_info();
        let adapter_name = format!("{} ({:?})", info.name, info.backend);
        let quality = if info.device_type == wgpu::DeviceType::Cpu { Quality::Economy } else { Quality::Fine };
        // Nothing beyond the WebGL 2 limits is used, so that every driver is sufficient.
        let required_limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("camera"),
            required_limits,
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request)
            .map_err(|error| CameraError::DeviceRefused { adapter: adapter_name.clone(), reason: error.to_string() })?;

        let lost = Arc::new(OnceLock::new());
        let flag = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, message| {
            // Only the first loss is recorded.
            let _ = flag.set(format!("{reason:?}: {message}"));
        });
        Ok(Arc::new(Self { device, queue, adapter_name, quality, choice, successor: Mutex::default(), lost }))
    }

    /// A second device of the same kind, for work that must not delay this one.
    ///
    /// # Errors
    /// Those of [`Gpu::open`].
    pub fn another(&self) -> Result<Arc<Self>, CameraError> {
        Self::open(self.choice)
    }

    /// This device or, if it is lost, its replacement. A driver that restarts loses all its devices; all cameras then
    /// share one new device. Blocks while it is opened.
    ///
    /// # Errors
    /// Those of [`Gpu::open`].
    pub fn current(self: &Arc<Self>) -> Result<Arc<Self>, CameraError> {
        let mut gpu = Arc::clone(self);
        while gpu.check_alive().is_err() {
            let next = {
                let mut successor = gpu.successor.lock().unwrap_or_else(PoisonError::into_inner);
                match &*successor {
                    Some(next) => Arc::clone(next),
                    None => Arc::clone(successor.insert(Self::open(gpu.choice)?)),
                }
            };
            gpu = next;
        }
        Ok(gpu)
    }

    /// Destroys the device, as a restarting driver does. Cameras that use it continue on a new one.
    pub fn destroy(&self) {
        self.device.destroy();
    }

    /// Name of the adapter and of its driver interface, for example `llvmpipe (LLVM 19.1.7, 256 bits) (Vulkan)`.
    pub fn adapter_name(&self) -> &str {
        &self.adapter_name
    }

    /// The default quality for this adapter.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Largest side of an image, in pixels.
    pub(super) fn max_px(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d.min(MAX_PX)
    }

    /// Fails if the device is lost.
    pub(super) fn check_alive(&self) -> Result<(), CameraError> {
        match self.lost.get() {
            Some(reason) => Err(CameraError::DeviceLost { reason: reason.clone() }),
            None => Ok(()),
        }
    }

    /// [`Self::check_alive`] after polling the device. Without a poll the device does not report its loss.
    pub(super) fn check_lost(&self) -> Result<(), CameraError> {
        // If the poll fails, the device is lost and has already reported it.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.check_alive()
    }

    /// Runs `work` and returns errors that the device reports as [`CameraError`]. Without this the library would panic.
    pub(super) fn checked<T>(&self, what: &'static str, work: impl FnOnce() -> T) -> Result<T, CameraError> {
        use wgpu::ErrorFilter;
        self.check_alive()?;
        let memory = self.device.push_error_scope(ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(ErrorFilter::Internal);
        let validation = self.device.push_error_scope(ErrorFilter::Validation);
        let done = work();
        // Scopes nest: the innermost is popped first.
        let errors = [validation, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        self.check_alive()?;
        let Some(error) = errors.into_iter().flatten().next() else { return Ok(done) };
        self.check_lost()?;
        Err(CameraError::Rejected { what, reason: error.to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_choices_and_names_unknown_ones() {
        assert_eq!("auto".parse::<AdapterChoice>().unwrap(), AdapterChoice::Auto);
        assert_eq!("GL".parse::<AdapterChoice>().unwrap(), AdapterChoice::Gl);
        let error = "cuda".parse::<AdapterChoice>().unwrap_err();
        assert!(error.to_string().contains("\"cuda\""), "{error}");
    }

    #[test]
    fn a_missing_driver_error_names_the_package_to_install() {
        let error = CameraError::NoAdapter { reason: "none".into() };
        assert!(error.to_string().contains("mesa-vulkan-drivers"));
    }

    #[test]
    fn a_destroyed_device_is_reported_as_lost() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        gpu.device.destroy();
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        let error = gpu.checked("a test", || ()).unwrap_err();
        assert!(matches!(error, CameraError::DeviceLost { .. }), "{error}");
    }

    #[test]
    fn a_lost_device_has_one_replacement() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        assert!(Arc::ptr_eq(&gpu.current().unwrap(), &gpu));
        gpu.device.destroy();
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        let next = gpu.current().unwrap();
        assert!(!Arc::ptr_eq(&next, &gpu) && Arc::ptr_eq(&next, &gpu.current().unwrap()));
        next.device.destroy();
        let _ = next.device.poll(wgpu::PollType::Poll);
        assert!(gpu.current().unwrap().check_alive().is_ok());
    }

    #[test]
    fn a_refused_request_is_an_error_and_not_a_panic() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        let error = gpu
            .checked("a shader", || {
                gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: None,
                    source: wgpu::ShaderSource::Wgsl("not a shader".into()),
                })
            })
            .unwrap_err();
        let CameraError::Rejected { what, .. } = error else {
            panic!("{error}");
        };
        assert_eq!(what, "a shader");
    }
}
