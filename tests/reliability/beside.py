"""What stands beside a campaign: an ordinary client of its store, people who look at it, and an
observer that notes what it has promised."""
import contextlib
import functools
import sqlite3
import sys
import threading

from network import Proxy
from rig import FaultTest, call, rows
from wire import message

#: As people write them: opens for reading and writing, looks, closes. It is not part of the project.
CLIENT = """
import contextlib, pathlib, sqlite3, sys, time
folder, pause = pathlib.Path(sys.argv[1]), float(sys.argv[2])
while True:
    for store in folder.rglob("*.db"):
        with contextlib.suppress(sqlite3.Error):
            with contextlib.closing(sqlite3.connect(f"file:{store}?mode=rw", uri=True)) as db:
                print(*db.execute("select count(*) from evaluation").fetchone(), flush=True)
    time.sleep(pause)
"""

RESULTS = "select candidate, purpose, pair from evaluation"
#: Without those that were made ahead, and that no race asked for.
USED_RESULTS = f"{RESULTS} where purpose > 0 or iteration > 0"


class Beside(FaultTest):
    """Campaigns beside an ordinary client, with whatever they promise remembered."""

    #: Seconds between two visits.
    pause = 0.2

    def setUp(self):
        super().setUp()
        self.acknowledged = set()
        self.missing = set()
        self.confirmed = []
        self.cancelled = set()
        self.heard = threading.Lock()
        self.client = self.start("client", sys.executable, "-c", CLIENT, self.folder, self.pause)

    def tearDown(self):
        self.count("visit of an ordinary client", self.client.out.read_text().count("\n"))
        self.assertTrue(self.client.alive(), self.client.tail())
        self.client.kill()
        if self.acknowledged:
            self.count("acknowledged result looked for", len(self.acknowledged))
        if self.confirmed:
            self.count("confirmed command looked for", len(self.confirmed))
        super().tearDown()

    # --- what was promised ---

    def overhear(self, address):
        """An address that leads to the coordinator, and remembers what it acknowledges."""
        # Of the store of now: what comes late, after another one has begun, is not a promise of that.
        return Proxy(self, address, rewrite=functools.partial(self.hear, self.acknowledged))

    def hear(self, acknowledged, direction, body):
        if direction == "down":
            keys = message("ToWorker", body).get("acknowledged", {}).get("keys", [])
            with self.heard:
                acknowledged |= {(key["candidate"], key.get("purpose", 0), key.get("pair", 0))
                                 for key in keys
                                 if (key["candidate"] - 1) // 1_000_000 + 1 not in self.cancelled}
        return body

    def ask(self, kind, *words):
        """A command to the campaign; one that is confirmed is remembered."""
        if kind == "cancel":  # from then on the results of the design are not wanted
            self.cancelled.add(int(words[0][1:]))
        done = call(kind, self.store, *words)
        if done.returncode == 0:
            self.confirmed.append((kind, words[0] if words else None))
        return done

    def forget(self):
        """Another store begins."""
        self.acknowledged = set()
        self.missing = set()
        self.confirmed.clear()
        self.cancelled.clear()

    def wanted(self):
        """The results that the campaign asks for in the end, whatever happens on the way."""
        return set(rows(self.reference(), USED_RESULTS))

    def assert_promises_are_kept(self):
        """An acknowledged result is in the store. Only one that is not wanted is not: it was made
        ahead for a candidate that is out of its race, and is never asked for again."""
        with self.heard:
            acknowledged = set(self.acknowledged)
        if acknowledged:
            kept = set(rows(self.store, RESULTS))
            self.missing |= acknowledged - kept
            lost = self.missing & (self.wanted() | set(rows(self.store, USED_RESULTS)))
            self.assertFalse(lost, f"{len(lost)} of {len(acknowledged)} acknowledged results are lost")
            self.assertLess(len(self.missing), len(acknowledged) / 10 + 100)
        if self.confirmed:
            kept = rows(self.store, "select kind, 'd' || design from command order by number")
            for command in set(self.confirmed):
                self.assertGreaterEqual(kept.count(command), self.confirmed.count(command),
                                        f"a confirmed command is lost: {command}")


class Onlookers:
    """People and programs that look at a store all the time, one after the other, in a thread."""

    def __init__(self, test):
        self.test = test
        self.over = threading.Event()
        self.looks = 0
        self.crashes = []
        self.thread = threading.Thread(target=self.look, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        self.test.count("look of backup, status, report or dashboard", self.looks)

    def look(self):
        store, folder = self.test.store, self.test.folder
        while not self.over.is_set():
            copy = folder / f"copy-{self.looks}.backup"
            report = folder / f"report-{self.looks}.html"
            for words in (("backup", store, copy), ("status", store), ("report", store, "-o", report),
                          ("query", store, "select count(*) from v_evaluations"), ("verify", store)):
                done = call(*words)
                self.looks += 1
                if done.returncode < 0:
                    self.crashes.append((words[0], done.returncode, done.stderr))
            self.as_a_dashboard(store)
            copy.unlink(missing_ok=True)

    @staticmethod
    def as_a_dashboard(store):
        """Read-only, and several looks in one connection."""
        with contextlib.suppress(sqlite3.Error):
            with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as db:
                for view in ("v_progress", "v_candidates", "v_evaluations", "v_designs"):
                    with contextlib.suppress(sqlite3.OperationalError):
                        db.execute(f"select count(*) from {view}").fetchall()
