//! Learning from what the camera sees. The network and its training come later; what they look at is here.

pub mod sweep;
