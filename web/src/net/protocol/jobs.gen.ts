// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

export type JobStage = "waiting" | "running" | "paused" | "done" | "cancelled" | "failed";
