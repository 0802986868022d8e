//! The device that draws: found once, shared by every camera.

use std::str::FromStr;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::{CameraError, MOST_PX, Quality};

/// Which drivers may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The fastest adapter of any driver; one that renders on the CPU if there is no other.
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

    /// `auto`, `vulkan` or `gl`, in any case.
    fn from_str(text: &str) -> Result<Self, CameraError> {
        match text.to_ascii_lowercase().as_str() {
            "auto" => Ok(Self::Auto),
            "vulkan" => Ok(Self::Vulkan),
            "gl" => Ok(Self::Gl),
            _ => Err(CameraError::UnknownAdapter { given: text.into() }),
        }
    }
}

/// An open graphics device. Shared between sessions: each call on it is safe from any thread.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    adapter_name: String,
    quality: Quality,
    choice: AdapterChoice,
    /// Opened by whoever first finds this device lost; locked by every camera that does.
    successor: Mutex<Option<Arc<Self>>>,
    /// Set once, by the driver, from whichever thread is talking to the device.
    lost: Arc<OnceLock<String>>,
}

impl Gpu {
    /// Opens the best adapter that `choice` allows. Takes a moment; blocks.
    ///
    /// # Errors
    /// [`CameraError::NoAdapter`] where there is no driver, [`CameraError::DeviceRefused`] where
    /// there is one that fails.
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
        // Nothing beyond the WebGL 2 limits is used, so that every driver will do.
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
            // Only the first loss is news.
            let _ = flag.set(format!("{reason:?}: {message}"));
        });
        Ok(Arc::new(Self { device, queue, adapter_name, quality, choice, successor: Mutex::default(), lost }))
    }

    /// A second device of the same kind, for work that must not hold this one up.
    ///
    /// # Errors
    /// Those of [`Gpu::open`].
    pub fn another(&self) -> Result<Arc<Self>, CameraError> {
        Self::open(self.choice)
    }

    /// This device, or the one that has taken its place since it was lost: a driver that restarts takes
    /// every device with it, and all cameras then share one new one. Blocks while it is opened.
    ///
    /// # Errors
    /// Those of [`Gpu::open`].
    pub fn living(self: &Arc<Self>) -> Result<Arc<Self>, CameraError> {
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

    /// Gives the device up, as a driver does that restarts: whoever draws on it goes on with another.
    pub fn destroy(&self) {
        self.device.destroy();
    }

    /// Name of the adapter and of its driver's interface, such as
    /// `llvmpipe (LLVM 19.1.7, 256 bits) (Vulkan)`.
    pub fn adapter_name(&self) -> &str {
        &self.adapter_name
    }

    /// What the adapter can afford.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Largest side of an image.
    pub(super) fn most_px(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d.min(MOST_PX)
    }

    /// Fails when the device is gone.
    pub(super) fn check_alive(&self) -> Result<(), CameraError> {
        match self.lost.get() {
            Some(reason) => Err(CameraError::DeviceLost { reason: reason.clone() }),
            None => Ok(()),
        }
    }

    /// [`Self::check_alive`] after asking the device for news, without which it does not say that it is lost.
    pub(super) fn check_lost(&self) -> Result<(), CameraError> {
        // A device that cannot be asked is lost, and has said so.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.check_alive()
    }

    /// Does `work`, and turns what the device says against it into an error. Without this the
    /// library would panic.
    pub(super) fn checked<T>(&self, what: &'static str, work: impl FnOnce() -> T) -> Result<T, CameraError> {
        use wgpu::ErrorFilter;
        self.check_alive()?;
        let memory = self.device.push_error_scope(ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(ErrorFilter::Internal);
        let validation = self.device.push_error_scope(ErrorFilter::Validation);
        let done = work();
        // Scopes nest, the innermost is popped first.
        let said = [validation, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        self.check_alive()?;
        let Some(error) = said.into_iter().flatten().next() else { return Ok(done) };
        self.check_lost()?;
        Err(CameraError::Rejected { what, reason: error.to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_parse_and_others_are_named() {
        assert_eq!("auto".parse::<AdapterChoice>().unwrap(), AdapterChoice::Auto);
        assert_eq!("GL".parse::<AdapterChoice>().unwrap(), AdapterChoice::Gl);
        let error = "cuda".parse::<AdapterChoice>().unwrap_err();
        assert!(error.to_string().contains("\"cuda\""), "{error}");
    }

    #[test]
    fn a_missing_driver_names_the_remedy() {
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
    fn a_lost_device_has_one_successor() {
        let gpu = Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter");
        assert!(Arc::ptr_eq(&gpu.living().unwrap(), &gpu));
        gpu.device.destroy();
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        let next = gpu.living().unwrap();
        assert!(!Arc::ptr_eq(&next, &gpu) && Arc::ptr_eq(&next, &gpu.living().unwrap()));
        next.device.destroy();
        let _ = next.device.poll(wgpu::PollType::Poll);
        assert!(gpu.living().unwrap().check_alive().is_ok());
    }

    #[test]
    fn a_refused_request_is_an_error_and_no_panic() {
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
