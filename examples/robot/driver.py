#!/usr/bin/python3
"""A driver of a robot without ROS (Debian: python3-zmq): sends sensors, obeys speeds, and stops the treads when they
stop coming. Put your robot into the three functions; the frames are in docs/robot-messages.md.

    driver.py tcp://127.0.0.1:5570 [worker.key]
"""
import sys
import time
import tomllib

import zmq

def ranges_m():  # eight distances; -inf: too near, inf: nothing there, nan: the sensor is off
    return [float("inf")] * 8

def ground_color():  # 0 to 255 each
    return [127, 127, 127]

def drive(left_mps, right_mps):
    print(f"{left_mps:.3f} {right_mps:.3f}", flush=True)

node = zmq.Context().socket(zmq.DEALER)
if len(sys.argv) > 2:  # the key's file, as `swarmsmith keygen` makes it
    with open(sys.argv[2], "rb") as file:
        key = tomllib.load(file)
    node.curve_secretkey, node.curve_publickey = key["secret"].encode(), key["public"].encode()
    node.curve_serverkey = key["server"].encode()
node.connect(sys.argv[1])
due = heard = time.monotonic()
driven = 0, 0

def obey(left_mps, right_mps):
    global driven
    drive(left_mps, right_mps)
    driven = left_mps, right_mps

while True:
    node.send_string("hello driver")  # again and again: a node that was restarted does not know us
    # `driven` is what the treads do: without it no run is VALID
    for topic, values in ("ranges", ranges_m()), ("ground_color", ground_color()), ("driven", driven):
        node.send_string(f"{topic} {time.time_ns()} " + " ".join(map(repr, values)))
    due += 0.1
    while node.poll(max(0, 1000 * (due - time.monotonic()))):
        words = node.recv_string().split()
        if words[0] == "wheels":  # wheels STAMP LEFT RIGHT
            heard = time.monotonic()
            obey(float(words[2]), float(words[3]))
    if time.monotonic() - heard > 0.3:
        obey(0, 0)
