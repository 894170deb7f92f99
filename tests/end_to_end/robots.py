"""Nodes of robots, a simulated world and a ROS master as real processes, each test with its own."""
import functools
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time

import programs
from programs import BIN, PATIENCE, wait_for

ROBOT = str(BIN / "swarmsmith-robot")
DEADLINE_S = 60 * PATIENCE
#: A stand-still that a robot does not notice: sensors come every 0.1 s, and may be silent for 0.3 s.
SHORT_S = 0.15


def why_no_ros():
    """Why tests over ROS cannot run here, or nothing."""
    version = subprocess.run([ROBOT, "version", "--json"], capture_output=True, text=True, timeout=60)
    if version.returncode != 0:
        return "swarmsmith-robot cannot be started"
    if not json.loads(version.stdout)["ros"]:
        return "swarmsmith-robot was built without ROS (libroscpp-dev)"
    if shutil.which("rosmaster") is None:
        return "rosmaster is not here (python3-rosmaster)"
    return None


def machine_file(test, text):
    """A file with the machine, as `run` and `world` take it."""
    file = test.folder / f"machine{abs(hash(text))}.fsm"
    file.write_text(text + "\n")
    return file


#: A robot that nodes can drive: wider and slower than the RVR, its sensors in another order.
ROVER = ("format = 1\n[drive]\ntrack = 0.2\nmax_speed = 0.25\n[proximity]\n"
         "rays = [0, 45, 90, 135, 180, -135, -90, -45]\n")


def mission_of_rovers(test, count=3, seconds=20):
    """The files of the rover, and of a mission with it."""
    robot = test.folder / "rover.toml"
    robot.write_text(ROVER)
    mission = test.folder / "rovers.toml"
    mission.write_text(f'format = 1\nname = "rovers"\npreset = "aggregation"\nrobots = {count}\n'
                       f'duration = "{seconds} s"\nrobot = "rover.toml"\n')
    return robot, mission


class Standstill(threading.Thread):
    """The longest time for which this machine did not let a sleeping thread go on, seconds."""

    def __init__(self):
        super().__init__(daemon=True)
        self.longest_s = 0
        self.over = threading.Event()

    def run(self):
        before = time.monotonic()
        while not self.over.wait(0.01):
            now = time.monotonic()
            self.longest_s = max(self.longest_s, now - before - 0.01)
            before = now

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.join()


def repeated(test):
    @functools.wraps(test)
    def run(self):
        for _ in range(2):
            with Standstill() as machine:
                try:
                    return test(self)
                except AssertionError as error:
                    if machine.longest_s < SHORT_S:
                        raise
                    print(f"the machine stood still for {machine.longest_s:.2f} s, once more: {error}", file=sys.stderr)
            self.doCleanups()
            self.setUp()
        return test(self)
    return run


def by_the_clock(tests):
    """A class of tests of runs in real time. Robots that get no sensors stand still, also where it is the machine that stood
    still: what fails then is done again, twice at most."""
    for name in [name for name in dir(tests) if name.startswith("test_")]:
        setattr(tests, name, repeated(getattr(tests, name)))
    return tests


class Process:
    """A program whose output is collected while it runs."""

    def __init__(self, test, words, variables=None, limit=None):
        """`limit`: bytes that a file may have; more is an error of writing it, as on a full disk."""
        self.words = [str(word) for word in words]
        self.process = subprocess.Popen(self.words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        errors="replace", start_new_session=True, stdin=subprocess.PIPE,
                                        env={**os.environ, **(variables or {})},
                                        preexec_fn=limit and (lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                                         (limit, limit))))
        self.out, self.err = [], []
        self.readers = [threading.Thread(target=self._read, args=pair, daemon=True)
                        for pair in ((self.process.stdout, self.out), (self.process.stderr, self.err))]
        for reader in self.readers:
            reader.start()
        test.addCleanup(self.kill)

    @staticmethod
    def _read(stream, lines):
        for line in stream:
            lines.append(line)
        stream.close()

    def said(self):
        return "".join(self.out) + "".join(self.err)

    def wait_for(self, text):
        """Until it has said so; a regular expression. The match."""
        def look():
            if self.process.poll() is not None:
                for reader in self.readers:
                    reader.join(DEADLINE_S)
                if not re.search(text, self.said()):
                    raise AssertionError(f"{self.words} ended with {self.process.returncode} without saying "
                                         f"`{text}`:\n{self.said()}")
            return re.search(text, self.said())
        return wait_for(look, f"`{text}` from {self.words}; it said:\n{self.said()}")

    def end(self, timeout=DEADLINE_S):
        """Waits for its end; its exit code."""
        try:
            code = self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"{self.words} does not end; it said:\n{self.said()}") from None
        for reader in self.readers:
            reader.join(timeout)
        return code

    def signal(self, number):
        programs.send(self.process.pid, number)

    def kill(self):
        if self.process.poll() is None:
            programs.send(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.process.stdin.close()
        for reader in self.readers:
            reader.join(DEADLINE_S)

    def rows(self):
        return [json.loads(line) for line in self.out]


class Master(Process):
    """rosmaster on a free port, which stands in its log alone."""

    def __init__(self, test, folder):
        home = pathlib.Path(folder) / f"master{len(list(pathlib.Path(folder).iterdir()))}"
        home.mkdir()
        log = home / "master.log"
        place = {"ROS_HOME": str(home), "ROS_LOG_DIR": str(home), "ROS_HOSTNAME": "localhost"}
        super().__init__(test, ["rosmaster", "--core", "-p", "0", f"__log:={log}"], place)
        found = wait_for(lambda: log.exists() and re.search(r"uri\[(http://[^\]]+)\]", log.read_text()),
                         "the port of rosmaster")
        self.variables = {**place, "ROS_MASTER_URI": found.group(1)}

    def node(self, test, robot, machine, *words, limit=None):
        return Process(test, [ROBOT, "run", "--robot", robot, "--machine", machine, *words], self.variables, limit)

    def nodes(self, test, count, machine, *words):
        return [self.node(test, i + 1, machine, *words) for i in range(count)]

    def program(self, test, *words, key=None):
        del key  # ROS knows none
        return Process(test, [ROBOT, *words], self.variables)


class ZeroMq:
    """The same without a master: each node has an address of its own. `command`: what starts the program."""

    def __init__(self, keys=None, command=(ROBOT,)):
        self.places = []
        self.command = command
        self.keys = keys
        self.variables = {}

    def node(self, test, robot, machine, *words, limit=None):
        keys = ["--keys", self.keys] if self.keys else []
        node = Process(test, [*self.command, "run", "--robot", robot, "--machine", machine, "--transport", "zeromq", "--bind",
                              "tcp://127.0.0.1:*", *keys, *words], limit=limit)
        place = node.wait_for(r"(\w+) listens at (tcp://\S+)")
        self.places.append(f"{place.group(1)}={place.group(2)}")
        return node

    def nodes(self, test, count, machine, *words):
        return [self.node(test, i + 1, machine, *words) for i in range(count)]

    def program(self, test, command, *words, key="worker", of=""):
        places = [word for place in self.places if place.startswith(of) for word in ("--at", place)]
        key = ["--key", f"{self.keys}/{key}.key"] if self.keys else []
        return Process(test, [*self.command, command, "--transport", "zeromq", *places, *key, *words])
