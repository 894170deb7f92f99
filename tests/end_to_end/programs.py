"""Starting the real programs from tests. Each test has a temporary folder of its own."""
import contextlib
import json
import os
import pathlib
import random
import signal
import socket
import sqlite3
import subprocess
import tempfile
import time
import unittest

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
SWARMSMITH = str(BIN / "swarmsmith")
#: How much longer than usual a program may take: more than 1 under sanitizers.
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))

# A shell that starts the tests in the background lets them ignore Ctrl-C, and so would each program that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)

#: The lines of a method whose races are short.
ARGOS3 = 'name = "argos3"\nflavour = "watermelon-argos3"'


def campaign_text(budget, *, seed=7, tests=20, name="survival", repetitions=1, missions=("aggregation",), duration=None,
                  methods=(ARGOS3,), profile="argos3", store="unused.db", more=""):
    """A campaign file. Each of `methods` is its lines; `more` comes at the end. Without tests, duration, profile or store
    the file does not name them."""
    lines = ["format = 1", "", "[campaign]", f'name = "{name}"', f"seed = {seed}"]
    lines += [f"repetitions = {repetitions}"] * (repetitions > 1) + [f'store = "{store}"'] * bool(store)
    for mission in missions:
        lines += ["", "[[mission]]", f'name = "{mission}"'] + [f'duration = "{duration}"'] * bool(duration)
        lines += ["  [mission.instances]", f"  test = {{ count = {tests} }}"] * bool(tests)
    for method in methods:
        lines += ["", "[[method]]", method.rstrip("\n")]
    lines += ["", "[race]", f"max_experiments = {budget}"]
    lines += ["", "[simulator]", f'profile = "{profile}"'] * bool(profile)
    return "\n".join(lines) + "\n" + more


def wait_for(condition, what, seconds=60, pause=0.02):
    """Polls until `condition()` is true and returns it; an AssertionError names what never came: `what`, or what
    it returns then."""
    limit = time.monotonic() + seconds * PATIENCE
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > limit:
            raise AssertionError(f"waited {seconds} s in vain: {what() if callable(what) else what}")
        time.sleep(pause)


def free_ports(count):
    """Free ports that the system never gives to a program that asks for any port. A test needs such a port when it
    starts a program later, or again: the tests beside it make connections all the time."""
    first_of_any = int(pathlib.Path("/proc/sys/net/ipv4/ip_local_port_range").read_text().split()[0])
    ports = set()
    for port in random.sample(range(first_of_any // 2, first_of_any), 1000):
        with contextlib.suppress(OSError), socket.socket() as holder:
            holder.bind(("127.0.0.1", port))
            ports.add(port)
        if len(ports) == count:
            return sorted(ports)
    raise AssertionError(f"no {count} free ports below {first_of_any}")


def call(*arguments, timeout=300, cwd=None):
    """Runs swarmsmith to its end; returns the finished process with its output as text."""
    return subprocess.run([SWARMSMITH, *map(str, arguments)], capture_output=True, text=True,
                          errors="replace", timeout=timeout * PATIENCE, cwd=cwd)


def ended_well(done):
    """The finished process, which has to have exit code 0."""
    assert done.returncode == 0, f"{done.args}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done


def start(*arguments, cwd=None):
    """Starts swarmsmith in a process group of its own, output thrown away."""
    return subprocess.Popen([SWARMSMITH, *map(str, arguments)], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL, start_new_session=True, cwd=cwd)


def children_of(pid):
    """Process ids of the worker processes that `pid` has started and that are alive."""
    try:
        text = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return []
    workers = []
    for child in map(int, text.split()):
        try:
            if pathlib.Path(f"/proc/{child}/comm").read_text().startswith("swarmsmith-work"):
                workers.append(child)
        except (FileNotFoundError, ProcessLookupError):
            pass
    return workers


def send(pid, what):
    try:
        os.kill(pid, what)
    except ProcessLookupError:
        pass


def designs_of(store):
    """State and experiments of each design; nothing while the store is not there yet. Not by the program, which takes so
    long to start under load that the campaign is over then."""
    try:
        with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as db:
            rows = db.execute("SELECT design, state, used, reason FROM v_designs").fetchall()
    except sqlite3.OperationalError:
        return {}
    return {row[0]: dict(zip(("design", "state", "used", "reason"), row)) for row in rows}


def used(store, design=1):
    return designs_of(store).get(design, {"used": 0})["used"]


class ProgramTest(unittest.TestCase):
    """A test with a folder, a campaign file in it, and the checks that they share."""

    budget = 1000
    seed = 7
    tests = 20

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "campaign.toml"
        self.file.write_text(campaign_text(self.budget, seed=self.seed, tests=self.tests))

    def run_campaign(self, store, *arguments, timeout=300):
        return call("run", self.file, "--store", store, "--no-dashboard", *arguments,
                    timeout=timeout)

    def start_campaign(self, store, *arguments):
        process = start("run", self.file, "--store", store, "--no-dashboard", *arguments)
        self.addCleanup(self._end, process)
        return process

    @staticmethod
    def _end(process):
        if process.poll() is None:
            send(-process.pid, signal.SIGKILL)
        process.wait()

    def digest(self, store):
        done = ended_well(call("digest", store))
        return done.stdout.strip()

    def assert_clean(self, store):
        ended_well(call("verify", store))

    def query(self, store, sql):
        done = ended_well(call("query", store, sql, "--json"))
        return json.loads(done.stdout)["rows"]
