"""Campaigns under faults: the real programs, disturbed from outside, and what must hold at the end.

A test makes a Disturbed campaign, does something to its processes, files or network, and calls
`finish`: the campaign ends, its digest is that of an undisturbed run, `verify` finds nothing, and
no process is left. Nothing here waits without a limit.
"""
import contextlib
import fcntl
import hashlib
import json
import os
import pathlib
import secrets
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import unittest

from programs import (BIN, PATIENCE, SWARMSMITH, call, campaign_text, children_of, ended_well, free_ports,  # noqa: F401
                      send, wait_for)

WORKER = str(BIN / "swarmsmith-worker")
LONG = os.environ.get("SWARMSMITH_LONG") == "1"
#: Memory is several times as much then, and says nothing.
SANITIZED = "SWARMSMITH_SANITIZER" in os.environ
#: Every process that a test starts has this in its environment, its own children too.
MARK = "SWARMSMITH_TEST_MARK"


def marked(mark):
    """Process ids whose environment has the mark; zombies have none any more."""
    wanted = f"{MARK}={mark}".encode()
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        with contextlib.suppress(OSError):
            if wanted in (folder / "environ").read_bytes().split(b"\0"):
                found.append(int(folder.name))
    return found


def rows(store, sql):
    """Rows of a store that may be written meanwhile; nothing while it has no schema yet."""
    with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True, timeout=10)) as db:
        return db.execute(sql).fetchall()


def stored(store):
    """Evaluations on disk; 0 as long as there is no store, or an empty one. Whatever else keeps it from
    being read is an error."""
    try:
        return rows(store, "select count(*) from evaluation")[0][0]
    except sqlite3.OperationalError as error:
        if store.exists() and "no such table" not in str(error):
            raise
        return 0


def events(store, kind):
    """Texts of the store's events of a kind, as objects, in order."""
    return [json.loads(text) for text, in
            rows(store, f"select text from event where kind = '{kind}' order by seq")]


def calls_in(log):
    """What faulty_calls wrote into its log: the number of calls of each kind."""
    return {name: int(n) for name, n in (line.split() for line in log.read_text().splitlines())}


class Program:
    """A started program whose output goes to files; ended at the latest with its test."""

    def __init__(self, test, name, command, env=None, prefix=()):
        self.name = name
        self.out = test.folder / f"{name}.out"
        self.err = test.folder / f"{name}.err"
        with self.out.open("wb") as out, self.err.open("wb") as err:
            self.process = subprocess.Popen(
                [*prefix, *map(str, command)], stdin=subprocess.DEVNULL, stdout=out, stderr=err,
                start_new_session=True, env={**os.environ, MARK: test.mark, **(env or {})})
        self.pid = self.process.pid
        test.addCleanup(self.kill)

    def alive(self):
        return self.process.poll() is None

    def state(self):
        """What the kernel tells of it: running, sleeping, and in what."""
        folder = pathlib.Path(f"/proc/{self.pid}")
        with contextlib.suppress(OSError):
            state = (folder / "stat").read_text().rpartition(")")[2].split()[0]
            return f"{state}, in {(folder / 'wchan').read_text()}"
        return "gone"

    def send(self, what):
        if self.alive():
            send(self.pid, what)

    def kill(self):
        self.send(signal.SIGCONT)
        self.send(signal.SIGKILL)
        self.process.wait()

    def wait(self, seconds=180):
        try:
            return self.process.wait(timeout=seconds * PATIENCE)
        except subprocess.TimeoutExpired:
            raise AssertionError(
                f"{self.name} did not end in {seconds} s:\n{self.tail()}") from None

    def log(self):
        return self.err.read_text(errors="replace")

    def tail(self):
        return "\n".join(self.log().splitlines()[-15:])


class Coordinator(Program):
    """`swarmsmith serve` (or `run`) with its stream of JSON events."""

    def progress(self):
        """The numbers that it said last; nothing before the first."""
        last = {}
        for line in self.out.read_text(errors="replace").splitlines():
            if '"event":"progress"' in line and line.endswith("}"):
                last = json.loads(line)
        return last

    def address(self):
        """host:port, once it listens."""
        words = [line for line in self.log().splitlines() if "--connect " in line]
        return words[0].split("--connect ")[1].split()[0] if words else None


class FaultTest(unittest.TestCase):
    """A test with a folder and a campaign; see the module's comment."""

    budget = 20000
    seed = 7
    tests = 20
    #: Designs of the campaign; two for one that is held.
    designs = 1
    #: Further lines of the campaign file.
    more = ""

    def assert_memory(self, used, most):
        """Of a process, in any unit."""
        if not SANITIZED:
            self.assertLess(used, most, "memory")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-faults-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.mark = secrets.token_hex(8)
        # After the programs' own clean-ups have run, and before the folder goes.
        self.addCleanup(self.assert_nothing_runs)
        self.file = self.folder / "campaign.toml"
        self.file.write_text(self.campaign_text())
        self.store = self.folder / "campaign.db"
        self.started = 0
        self.tried = {}
        self.held = None

    def campaign_text(self):
        return campaign_text(self.budget, seed=self.seed, tests=self.tests, repetitions=self.designs, more=self.more)

    def count(self, what, number=1):
        """Counts faults for the line that the test prints at its end."""
        self.tried[what] = self.tried.get(what, 0) + number

    def tearDown(self):
        for what, number in self.tried.items():
            print(f"\n  tried: {number} x {what}", end="", flush=True)

    # --- programs ---

    def start(self, name, *command, env=None, prefix=(), kind=Program):
        self.started += 1
        return kind(self, f"{self.started}-{name}", command, env, prefix)

    def serve(self, *arguments, bind=None, env=None, prefix=(), wait=True):
        """A coordinator that listens; with `wait`, its address is known. Another one can be started there later."""
        bind = bind or f"127.0.0.1:{free_ports(1)[0]}"
        it = self.start("serve", SWARMSMITH, "serve", self.file, "--store", self.store, "--json",
                        "--bind", bind, *arguments, env=env, prefix=prefix, kind=Coordinator)
        if wait:
            wait_for(lambda: it.address() or not it.alive(),
                     lambda: f"a coordinator that listens; {it.state()}:\n{it.tail()}")
            self.assertTrue(it.alive(), it.tail())
        return it

    def keygen(self, folder, *arguments):
        ended_well(call("keygen", folder, *arguments))
        return folder

    def run_local(self, *arguments, env=None, prefix=()):
        """A coordinator with local workers."""
        return self.start("run", SWARMSMITH, "run", self.file, "--store", self.store, "--json",
                          "--no-dashboard", *arguments, env=env, prefix=prefix, kind=Coordinator)

    def worker(self, address, *arguments, slots=1, program=WORKER, env=None, prefix=()):
        return self.start("worker", program, "--connect", f"tcp://{address}", "--slots",
                          slots, *arguments, env=env, prefix=prefix)

    def hold(self, env=None):
        """Makes the store, and pauses the last of two designs until `finish`: without it, the campaign could
        be over before it is disturbed, if the machine is fast or the test gets no processor."""
        self.assertEqual(self.designs, 2)
        serve = self.serve(env=env)
        self.command("pause", "d2")
        serve.send(signal.SIGINT)
        self.assertEqual(serve.wait(), 130, serve.tail())
        self.held = "d2"

    def wait_stored(self, number, seconds=90):
        wait_for(lambda: stored(self.store) >= number, f"{number} evaluations in the store",
                 seconds)

    # --- what must hold ---

    def reference(self):
        """The store of the undisturbed campaign on one worker. Made once for each text and each build,
        and kept in the build folder."""
        text = self.campaign_text()
        key = hashlib.sha256(text.encode())
        for program in (SWARMSMITH, WORKER):
            key.update(pathlib.Path(program).read_bytes())
        cache = pathlib.Path(os.environ.get("SWARMSMITH_REFERENCES", self.folder))
        cache.mkdir(parents=True, exist_ok=True)
        kept = cache / f"{key.hexdigest()[:24]}.db"
        with (cache / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not kept.exists():
                with tempfile.TemporaryDirectory(dir=cache) as folder:
                    self.undisturbed(pathlib.Path(folder) / "reference.db").rename(kept)
        return kept

    def undisturbed(self, store):
        file = store.with_suffix(".toml")
        file.write_text(self.campaign_text())
        ended_well(call("run", file, "--store", store, "--workers", "1", "--no-dashboard"))
        self.assert_clean(store)
        return store

    def expected(self):
        """Digest of the undisturbed campaign."""
        return self.digest(self.reference())

    def digest(self, store):
        done = ended_well(call("digest", store))
        return done.stdout.strip()

    def assert_clean(self, store):
        ended_well(call("verify", store))

    def assert_none(self, numbers, *names):
        """None of these was counted."""
        self.assertEqual({name: numbers[name] for name in names}, dict.fromkeys(names, 0))

    def assert_same_answer(self, store=None):
        store = store or self.store
        self.assert_clean(store)
        self.assertEqual(self.digest(store), self.expected())

    def command(self, name, *words):
        """Something of the coordinator, as a person does."""
        ended_well(call(name, self.store, *words))

    def finish(self, coordinator, workers=(), seconds=180):
        """The campaign ends by itself, once nothing holds it; its workers go home, and the answer is the usual one."""
        if self.held:
            self.command("resume", self.held)
            self.held = None
        self.assertEqual(coordinator.wait(seconds), 0, coordinator.tail())
        for worker in workers:
            self.assertEqual(worker.wait(30), 0, worker.tail())
        self.assert_same_answer()
        return coordinator.progress()

    def assert_nothing_runs(self):
        try:
            wait_for(lambda: not marked(self.mark), "the end of all processes", seconds=10)
        except AssertionError:
            left = marked(self.mark)
            names = [pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ")
                     for pid in left if pathlib.Path(f"/proc/{pid}").exists()]
            for pid in left:
                send(pid, signal.SIGKILL)
            raise AssertionError(f"processes are left: {names}") from None


def need(program, package):
    if shutil.which(program) is None:
        raise unittest.SkipTest(f"skipped: {program} is not there (Debian package {package})")


def need_root(what):
    if os.geteuid() != 0:
        raise unittest.SkipTest(f"skipped: {what} needs root")
