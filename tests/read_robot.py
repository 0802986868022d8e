"""Reads a robot with ur_rtde and prints what the test compares as JSON.

    read_robot.py ADDRESS SECONDS
"""

import json
import sys
import time

import dashboard_client
import rtde_receive

address, seconds = sys.argv[1], float(sys.argv[2])
dashboard = dashboard_client.DashboardClient(address)
dashboard.connect()
found = {"version": dashboard.polyscopeVersion(), "mode": dashboard.robotmode(), "model": dashboard.getRobotModel()}
dashboard.disconnect()

receivers = [rtde_receive.RTDEReceiveInterface(address, 125.0) for _ in range(2)]
times = []
begun = time.monotonic()
while time.monotonic() - begun < seconds:
    times.append(receivers[0].getTimestamp())
    time.sleep(0.001)
found |= {
    "seconds": time.monotonic() - begun,
    "frames": len(set(times)),
    "simulated_s": times[-1] - times[0],
    "q": [receiver.getActualQ() for receiver in receivers],
    "tool": receivers[0].getActualTCPPose(),
    "force": receivers[0].getActualTCPForce(),
    "robot_mode": receivers[0].getRobotMode(),
    "safety_mode": receivers[0].getSafetyMode(),
    "protective_stop": receivers[0].isProtectiveStopped(),
}
receivers[0].disconnect()
found["reconnected"] = receivers[0].reconnect() and len(receivers[0].getActualQ()) == 6
for receiver in receivers:
    receiver.disconnect()
print(json.dumps(found))
