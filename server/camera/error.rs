//! Everything that can go wrong between a state and its image.

/// Why no image could be taken.
#[derive(Debug, thiserror::Error)]
pub enum CameraError {
    /// No driver offers an adapter, not even one that renders on the CPU.
    #[error(
        "no graphics adapter was found: install a Vulkan driver; the Debian package \
         mesa-vulkan-drivers has one that needs no GPU ({reason})"
    )]
    NoAdapter {
        /// What each backend answered.
        reason: String,
    },
    /// The adapter was found but would not open.
    #[error("the graphics adapter {adapter} did not open: {reason}")]
    DeviceRefused {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
    /// No such [`AdapterChoice`](super::AdapterChoice).
    #[error("unknown adapter choice {given:?}: it must be auto, vulkan or gl")]
    UnknownAdapter {
        /// The text that was parsed.
        given: String,
    },
    /// A camera parameter is absurd.
    #[error("camera {name} is {value}: it must be {expected}")]
    Parameter {
        /// The field of [`CameraMount`](crate::image::CameraMount).
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
    /// The camera would sit inside or below the walls.
    #[error("camera height {height_m} m is not above the walls, which are {wall_height_m} m high")]
    BelowWalls {
        /// Height of the camera above the table.
        height_m: f64,
        /// Height of the walls.
        wall_height_m: f64,
    },
    /// The camera would see the horizon, or table so far off that nothing can be made out.
    #[error("camera tilt {tilt_rad:?} rad with field_of_view_rad {field_of_view_rad}: it would see the horizon")]
    Horizon {
        /// Tilt toward +x and +y.
        tilt_rad: [f64; 2],
        /// Angle across the image.
        field_of_view_rad: f64,
    },
    /// The image has no pixels, or too many.
    #[error("an image of {width_px} x {height_px} pixels: each side must be 1 to {most_px}")]
    Size {
        /// Columns asked for.
        width_px: u32,
        /// Rows asked for.
        height_px: u32,
        /// Largest side that this adapter and this crate allow.
        most_px: u32,
    },
    /// The static geometry cannot be drawn.
    #[error("the stage cannot be drawn: {what}")]
    StaticScene {
        /// Which number is wrong, and its value.
        what: String,
    },
    /// The state cannot be drawn.
    #[error("the state cannot be drawn: {what} is not finite")]
    Subject {
        /// The field of [`Subject`](super::Subject).
        what: &'static str,
    },
    /// The device refused to build or to draw something.
    #[error("the graphics device refused {what}: {reason}")]
    Rejected {
        /// What was being done.
        what: &'static str,
        /// The library's words.
        reason: String,
    },
    /// The finished image could not be read.
    #[error("the image could not be read back: {reason}")]
    Readback {
        /// The library's words.
        reason: String,
    },
    /// The device is gone for good; a new [`Gpu`](super::Gpu) and new cameras are needed.
    #[error("the graphics device was lost: {reason}")]
    DeviceLost {
        /// The driver's words.
        reason: String,
    },
}
