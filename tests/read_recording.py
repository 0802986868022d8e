"""Reads recordings with Rerun's own reader and prints what they show, as a JSON list."""

import json
import sys

import numpy as np
from rerun.experimental import RrdReader


def read(path):
    entities, rows, timelines, tool, ticks, trials = set(), {}, set(), [], [], []
    views, opens = 0, {}
    reader = RrdReader(path)
    for chunk in reader.stream():
        entities.add(chunk.entity_path)
        rows[chunk.entity_path] = rows.get(chunk.entity_path, 0) + chunk.num_rows
        batch = chunk.to_record_batch()
        timelines |= set(batch.schema.names) & {"tick", "sim_time", "recording_time", "log_tick", "log_time"}
        if "tick" in batch.schema.names:
            ticks += [tick for tick in batch.column("tick").to_pylist() if tick is not None]
        if chunk.entity_path == "/trial":
            times_ns = batch.column("recording_time").cast("int64").to_pylist()
            trials += zip(times_ns, (name[0] for name in batch.column("StateChange:state").to_pylist()))
        if chunk.entity_path == "/world/tool" and "tick" in batch.schema.names:
            tool += [(tick, np.array(place[0])) for tick, place in zip(
                batch.column("tick").to_pylist(), batch.column("Points3D:positions").to_pylist()) if place]
    for entry in reader.blueprints():
        paths = {str(chunk.entity_path) for chunk in reader.stream(store=entry)}
        for chunk in reader.stream(store=entry):
            if chunk.entity_path == "/time_panel":
                panel = chunk.to_record_batch()
                opens = {name: panel.column(f"TimePanelBlueprint:{name}").to_pylist()[0][0]
                         for name in ("timeline", "play_state")}
        views = max(views, len({path.split("/")[2] for path in paths if path.startswith("/view/")}))
    tool = np.array([place for _, place in sorted(tool, key=lambda pair: pair[0])])
    steps = np.linalg.norm(np.diff(tool, axis=0), axis=1) if len(tool) > 1 else np.zeros(1)
    return {
        "entities": sorted(entities),
        "timelines": sorted(timelines),
        "tool_path_m": float(steps.sum()),
        "camera_frames": rows.get("/camera", 0),
        "last_tick": max(ticks, default=0),
        "blueprint_views": views,
        "trials": [[time_ns / 1e9, name] for time_ns, name in sorted(trials)],
        "opens": opens,
    }


print(json.dumps([read(path) for path in sys.argv[1:]]))
