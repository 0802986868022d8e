//! Tests of the whole, in one binary so that a small machine links once.

mod answers;
mod calculator;
mod cases;
mod commands;
mod crashes;
mod determinism;
mod disturbances;
mod evaluations;
mod examples;
mod forks;
mod golden;
mod house;
mod laboratory;
mod learned;
mod logs;
mod recordings;
mod reference;
mod rendering;
mod sights;
mod viewer;
