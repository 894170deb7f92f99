"""Nodes, a simulated world and operators as the programs that people run, over a transport of the test's choice."""
import csv
import json
import os
import pathlib
import re
import resource
import selectors
import signal
import subprocess
import tempfile
import time
import unittest

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
ROBOT = BIN / "swarmsmith-robot"
#: How much longer than usual a program may take: more than 1 under sanitizers.
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))
#: Looks at everything but light, and mostly drives.
MACHINE = ("--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.8 "
           "--s1 4 --att1 2 --n1 1 --n1x0 0 --c1x0 5 --p1x0 0.1")


class Program:
    """A started program whose lines are waited for."""

    def __init__(self, words, environment, limits=None):
        self.words = [str(word) for word in words]

        def limit():
            if limits:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limits, limits))
        self.process = subprocess.Popen(self.words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        env=environment, preexec_fn=limit, start_new_session=True)
        self.text = {"out": "", "err": ""}
        self.selector = selectors.DefaultSelector()
        self.selector.register(self.process.stdout, selectors.EVENT_READ, "out")
        self.selector.register(self.process.stderr, selectors.EVENT_READ, "err")

    def read(self, until):
        """Takes what comes until then; false when both outputs have ended."""
        if not self.selector.get_map():
            return False
        for key, _ in self.selector.select(max(0, until - time.monotonic())):
            piece = os.read(key.fd, 65536)
            if not piece:
                self.selector.unregister(key.fileobj)
            self.text[key.data] += piece.decode(errors="replace")
        return True

    def wait_for(self, pattern, seconds=30):
        """The match of a pattern in its error output."""
        until = time.monotonic() + seconds * PATIENCE
        while not (found := re.search(pattern, self.text["err"])):
            if not self.read(until) or time.monotonic() > until:
                raise AssertionError(f"no {pattern!r} from {self.words}:\n{self.text}")
        return found

    def finish(self, seconds=60):
        """Its exit code; what it wrote is in `text`."""
        until = time.monotonic() + seconds * PATIENCE
        while self.read(until):
            if time.monotonic() > until:
                raise AssertionError(f"still runs: {self.words}:\n{self.text}")
        return self.process.wait(seconds * PATIENCE)

    def json(self):
        return json.loads(self.text["out"].splitlines()[-1])

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            stream.close()
        self.selector.close()


def read_log(folder, run, robot):
    """Rows of a robot's log, numbers as such, without one that was being written."""
    text = (folder / f"{run}.{robot}.log.csv").read_text()
    rows = list(csv.DictReader(text[:text.rfind("\n") + 1].splitlines()))
    for row in rows:
        for name in ("cycle", "state", "drawn"):
            row[name] = int(row[name])
        for name in ("time_s", "clock_s", "late_ms", "left_mps", "right_mps"):
            row[name] = float(row[name])
    return rows


def speed(row):
    return max(abs(row["left_mps"]), abs(row["right_mps"]))


class SwarmTest(unittest.TestCase):
    """A folder with a machine, and programs that are gone after the test."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="swarm-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.machine = self.folder / "best.fsm"
        self.machine.write_text(MACHINE + "\n")
        self.environment = dict(os.environ)
        self.nodes = {}
        self.places = []

    def start(self, *words, limits=None):
        program = Program([ROBOT, *words], self.environment, limits)
        self.addCleanup(program.kill)
        return program

    def start_node(self, number, *words, limits=None):
        robot = f"rvr{number}"
        node = self.start("run", "--robot", number, "--machine", self.machine, "--flavour", "watermelon", "--color-scale",
                          "255", "--logs", self.folder, "--transport", "zeromq", "--bind", "tcp://127.0.0.1:*", *words,
                          limits=limits)
        place = node.wait_for(rf"{robot} listens at (tcp://\S+)").group(1)
        self.nodes[robot] = node
        self.places += ["--at", f"{robot}={place}"]
        return node

    def place_of(self, robot):
        """NAME=ADDRESS, for --at."""
        return next(word for word in self.places if word.startswith(robot + "="))

    def start_nodes(self, *words):
        for number in (1, 2, 3):
            self.start_node(number, *words)

    def start_world(self, *words):
        world = self.start("world", "--mission", "aggregation", "--real-time", "--json", "--csv", self.folder / "true.csv",
                           *words, "--transport", "zeromq", *self.places)
        return world

    def start_run(self, seconds, *words, run="run07"):
        return self.start("start", "--run", run, "--robots", "1-3", "--seconds", seconds, "--in", "0.7", "--json",
                          "--patience", 20, "--write", self.folder / f"{run}.toml", "--transport", "zeromq", *self.places,
                          *words)

    def replay_all(self):
        """No command of any log differs from what the machine gives."""
        logs = sorted(self.folder.glob("*.log.csv"))
        replay = self.start("replay", *logs)
        self.assertEqual(replay.finish(), 0, replay.text)
        return len(logs)

    def end_of(self, robot, run="run07"):
        """What the head of its log says of the end."""
        text = (self.folder / f"{run}.{robot}.toml").read_text()
        parts = text.split("[end]")
        return parts[1] if len(parts) == 2 else None
