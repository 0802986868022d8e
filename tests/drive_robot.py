"""Commands a robot with ur_rtde in every way that Ferry carries out, and prints what it saw as JSON.

    drive_robot.py ADDRESS
"""

import json
import sys
import time

import dashboard_client
import rtde_control
import rtde_receive

address = sys.argv[1]
control = rtde_control.RTDEControlInterface(address, 125.0)
receivers = [rtde_receive.RTDEReceiveInterface(address, 125.0) for _ in range(2)]
receive = receivers[0]
dashboard = dashboard_client.DashboardClient(address)
dashboard.connect()
start = receive.getActualTCPPose()
found = {"runs": control.isProgramRunning(), "state": dashboard.programState()}


def apart(pose, other):
    """How far two places of the tool are apart; a rotation vector of 180 degrees has two signs."""
    return max(abs(a - b) for a, b in zip(pose[:3], other[:3]))


def aside(x_m, y_m):
    return [start[0] + x_m, start[1] + y_m, *start[2:]]


def upload():
    """The program needs a moment to begin."""
    is_sent = control.reuploadScript()
    time.sleep(0.2)
    return is_sent


def settle():
    time.sleep(1.0)
    return receive.getActualTCPPose()


found["moveL"] = [control.moveL(aside(0.03, 0.0), 0.1, 0.5), apart(settle(), aside(0.03, 0.0))]
joints = control.getInverseKinematics(start)
found["moveJ"] = [control.moveJ(joints, 0.5, 1.0), apart(settle(), start)]
found["moveJ_IK"] = [control.moveJ_IK(aside(0.0, 0.02), 0.5, 1.0), apart(settle(), aside(0.0, 0.02))]

found["speedL"] = [control.speedL([0.03, 0, 0, 0, 0, 0], 0.5), time.sleep(1.0), receive.getActualTCPSpeed()[0]]
control.speedStop(2.0)
found["stopped"] = max(map(abs, (settle() and receive.getActualTCPSpeed())))

servo = control.getInverseKinematics(aside(0.0, 0.0))
for _ in range(200):
    begun = control.initPeriod()
    now = receive.getTargetQ()
    step = max(abs(a - b) for a, b in zip(servo, now))
    share = min(1.0, 0.02 / max(step, 1e-9))
    ok = control.servoJ([a + share * (b - a) for a, b in zip(now, servo)], 0, 0, 0.008, 0.1, 300)
    control.waitPeriod(begun)
control.servoStop()
found["servoJ"] = [ok, apart(settle(), start)]

control.moveL(aside(0.05, 0.0), 0.02, 0.5, True)
time.sleep(0.6)
found["asynchronous"] = [control.getAsyncOperationProgress(), receive.getActualTCPSpeed()[0]]
control.stopL(1.0)
found["steady"] = [control.isSteady(), control.getAsyncOperationProgress() < 0]
found["tcp_offset"] = control.getTCPOffset()

# A limit: too low. The arm stops, and only the dashboard frees it.
low = aside(0.0, 0.0)
low[2] = 0.05
found["low"] = [control.moveL(low, 0.1, 0.5), settle()[2], receive.isProtectiveStopped()]
found["stopped_state"] = [dashboard.safetymode(), upload(), control.isProgramRunning()]
dashboard.unlockProtectiveStop()
found["freed"] = [dashboard.safetymode(), upload(), control.moveL(start, 0.1, 0.5), apart(settle(), start)]

# What is out of reach ends the program, and nothing moves.
far = list(start)
far[0] = 2.0
found["far"] = [control.moveL(far, 0.1, 0.5), control.isProgramRunning(), apart(settle(), start)]
found["again"] = [upload(), control.isProgramRunning()]
# A program of the user's own.
script = "movel(p[%s], a=0.5, v=0.1)" % ",".join(map(str, aside(0.01, 0.0)))
found["custom"] = [control.sendCustomScriptFunction("MINE", script), apart(settle(), aside(0.01, 0.0))]
control.stopScript()
time.sleep(0.2)
found["stopScript"] = [control.isProgramRunning(), dashboard.programState()]
control.disconnect()
control.reconnect()
found["reconnected"] = [control.isProgramRunning(), control.moveL(start, 0.1, 0.5)]
found["receivers"] = max(abs(a - b) for a, b in zip(receivers[0].getActualQ(), receivers[1].getActualQ()))
control.stopScript()
for connection in [control, *receivers, dashboard]:
    connection.disconnect()
print(json.dumps(found))
