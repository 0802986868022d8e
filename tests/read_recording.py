"""Reads a recording with Rerun's own reader and prints what it shows, as JSON."""

import json
import sys

import numpy as np
from rerun.experimental import RrdReader

entities, rows = set(), {}
for chunk in RrdReader(sys.argv[1]).stream():
    entities.add(chunk.entity_path)
    rows[chunk.entity_path] = rows.get(chunk.entity_path, 0) + chunk.num_rows
    if chunk.entity_path == "/world/tool":
        batch = chunk.to_record_batch()
        places = [(tick, np.array(place[0])) for tick, place in zip(
            batch.column("tick").to_pylist(), batch.column("Points3D:positions").to_pylist()) if place]
        rows.setdefault("tool", []).extend(places)

tool = np.array([place for _, place in sorted(rows.get("tool", []), key=lambda pair: pair[0])])
steps = np.linalg.norm(np.diff(tool, axis=0), axis=1) if len(tool) > 1 else np.zeros(1)
print(json.dumps({
    "entities": sorted(entities),
    "tool_path_m": float(steps.sum()),
    "camera_frames": rows.get("/camera", 0),
}))
