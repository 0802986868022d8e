//! Why a camera takes no picture.

#[derive(Debug, thiserror::Error)]
pub enum CameraError {
    /// No driver offers an adapter, not even one that renders on the CPU.
    #[error(
        "no graphics adapter was found: install a Vulkan driver; the Debian package \
         mesa-vulkan-drivers has one that needs no GPU ({reason})"
    )]
    NoAdapter {
        /// The answer of each backend.
        reason: String,
    },
    #[error("the graphics adapter {adapter} could not be opened: {reason}")]
    DeviceRefused {
        adapter: String,
        /// The driver's message.
        reason: String,
    },
    #[error("unknown adapter {given:?}: must be auto, vulkan or gl")]
    UnknownAdapter {
        /// The parsed text.
        given: String,
    },
    /// A camera parameter is out of range.
    #[error("camera {name} is {value}: must be {expected}")]
    Parameter {
        /// Field of [`CameraMount`](super::CameraMount).
        name: &'static str,
        value: f64,
        /// The accepted range.
        expected: &'static str,
    },
    /// The camera would be inside or below the walls.
    #[error("camera height_m is {height_m}: must be more than the wall height {wall_height_m}")]
    BelowWalls {
        /// Above the table.
        height_m: f64,
        wall_height_m: f64,
    },
    /// The camera would see the horizon, or table points too far away.
    #[error(
        "camera tilt_rad {tilt_rad:?} with field_of_view_rad {field_of_view_rad}: the camera would see the horizon"
    )]
    Horizon {
        /// Tilt toward +x and +y.
        tilt_rad: [f64; 2],
        /// Angle across the image.
        field_of_view_rad: f64,
    },
    /// The image has no pixels, or too many.
    #[error("image size {width_px} x {height_px} pixels: each side must be 1 to {max_px}")]
    Size {
        /// Requested columns.
        width_px: u32,
        /// Requested rows.
        height_px: u32,
        /// Largest side that this adapter and this crate allow.
        max_px: u32,
    },
    /// The static geometry cannot be drawn.
    #[error("the scene cannot be drawn: {what}")]
    StaticScene {
        /// The wrong value and its name.
        what: String,
    },
    /// The state cannot be drawn.
    #[error("the state cannot be drawn: {what} is not finite")]
    Subject {
        /// Field of [`Subject`](super::Subject).
        what: &'static str,
    },
    /// The device refused an operation.
    #[error("the graphics device refused {what}: {reason}")]
    Rejected {
        /// The operation.
        what: &'static str,
        /// The library's message.
        reason: String,
    },
    #[error("the image could not be read back: {reason}")]
    Readback {
        /// The library's message.
        reason: String,
    },
    /// The device is lost; a new device and new cameras are needed.
    #[error("the graphics device was lost: {reason}")]
    DeviceLost {
        /// The driver's message.
        reason: String,
    },
}
