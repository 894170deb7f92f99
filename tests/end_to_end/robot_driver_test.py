"""The driver of examples/robot drives a robot's node over ZeroMQ, with a key and without, and stands still when the node is
gone."""
import os
import pathlib
import signal
import subprocess
import sys
import unittest

import robots
from programs import ProgramTest, call, ended_well
from robots import ROBOT, Process, ZeroMq, machine_file

DRIVER = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "examples" / "robot" / "driver.py"
FORWARD = "--nstates 1 --s0 0 --rwm0 1"


def python_with_zmq():
    for python in (sys.executable, "/usr/bin/python3"):
        try:
            if subprocess.run([python, "-c", "import zmq"], capture_output=True, timeout=60).returncode == 0:
                return python
        except OSError:
            pass
    return None


PYTHON = python_with_zmq()


@unittest.skipIf(PYTHON is None, "no python3 with zmq is here (python3-zmq)")
@robots.by_the_clock
class Driver(ProgramTest):
    def driven(self, way, key=()):
        node = way.node(self, 1, machine_file(self, FORWARD), "--flavour", "watermelon-argos3", "--logs", self.folder)
        place = way.places[0].split("=")[1]
        driver = Process(self, [PYTHON, DRIVER, place, *key])
        driver.wait_for(r"0\.000 0\.000")
        operator = ["--transport", "zeromq", "--at", way.places[0]]
        if way.keys:
            operator += ["--key", f"{way.keys}/operator.key"]
        robots.wait_for(lambda: subprocess.run([ROBOT, "check", "--robots", "1", *operator],
                                               capture_output=True).returncode == 0, "a robot that is ready")
        start = Process(self, [ROBOT, "start", "--run", "r1", "--robots", "1", "--seconds", "30", "--in", "0.6",
                               "--write", self.folder / "r1.toml", *operator])
        driver.wait_for(r"0\.300 0\.300")
        node.signal(signal.SIGKILL)
        before = len(driver.out)
        robots.wait_for(lambda: "0.000 0.000\n" in driver.out[before:], "treads that stop")
        self.assertNotEqual(start.end(), 0, start.said())

    def test_without_keys(self):
        self.driven(ZeroMq())

    def test_with_a_workers_key(self):
        keys = self.folder / "keys"
        ended_well(call("keygen", keys))
        self.driven(ZeroMq(keys), [keys / "worker.key"])


if __name__ == "__main__":
    unittest.main()
