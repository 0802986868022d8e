"""Sends servo targets at 125 Hz for a time, and prints the rates as JSON.

    pace_robot.py ADDRESS SECONDS
"""

import json
import math
import sys
import time

import rtde_control
import rtde_receive

address, seconds = sys.argv[1], float(sys.argv[2])
control = rtde_control.RTDEControlInterface(address, 125.0)
receive = rtde_receive.RTDEReceiveInterface(address, 125.0)
start = receive.getActualQ()
time.sleep(0.5)
begun, first = time.monotonic(), receive.getTimestamp()
sent = 0
while time.monotonic() - begun < seconds:
    period = control.initPeriod()
    target = list(start)
    turn = 0.05 * math.sin(time.monotonic() - begun)
    target[0] += turn
    target[5] += turn  # the tool keeps its direction
    sent += control.servoJ(target, 0, 0, 0.008, 0.1, 300)
    control.waitPeriod(period)
elapsed = time.monotonic() - begun
simulated = receive.getTimestamp() - first
control.servoStop()
control.stopScript()
print(json.dumps({"sent_hz": sent / elapsed, "ticks_hz": simulated / 0.008 / elapsed}))
