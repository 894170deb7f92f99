"""What happens to a store in ordinary life, an act each. An act leaves a store to go on with, which may be another file
than before. After `harmless` acts alone nothing may be refused."""
import contextlib
import os
import pathlib
import shutil
import signal
import sqlite3
import subprocess

from copying import WHOLE, copy
from ends import end_of, what_is_wrong_with
from foreign_schemas import FOREIGN, make_foreign
from rig import SWARMSMITH, Coordinator, children_of, send, stored, wait_for

REFUSED = 3
#: What a campaign ends with that stops in good order: by itself, by Ctrl-C, by a store that is not as it was.
ENDS = (0, 130, REFUSED)
OLD_STORE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden/stores/schema-9.sqlite"


class Life:
    """A store, the campaign that may be running on it, and where it has been. `test` is a FaultTest."""

    def __init__(self, test, folder, rng):
        self.test = test
        self.rng = rng
        self.folder = folder
        self.folder.mkdir()
        self.store = self.folder / "campaign.db"
        self.running = None
        self.places = 0
        self.harmed = False
        self.wrong = []

    # --- parts of acts ---

    def beside(self, name):
        return pathlib.Path(f"{self.store}{name}")

    def place(self):
        """A new folder."""
        self.places += 1
        folder = self.folder / f"place-{self.places}"
        folder.mkdir()
        return folder

    def run(self, env=None):
        if self.running is None or not self.running.alive():
            self.running = self.test.start(
                "run", SWARMSMITH, "run", self.test.file, "--store", self.store, "--json", "--no-dashboard", "--workers", "2",
                env=env, kind=Coordinator)
            before = stored(self.store) if self.is_readable() else 0
            wait_for(lambda: not self.running.alive() or (self.is_readable() and stored(self.store) > before),
                     lambda: f"a campaign that goes on; {self.running.state()}: {self.running.tail()}")

    def is_readable(self):
        """Whether an ordinary client reads rows of it."""
        try:
            stored(self.store)
        except sqlite3.Error:
            return False
        return self.store.exists()

    def later(self):
        """Some experiments later, or at the end of the campaign."""
        if self.running is None or not self.running.alive():
            return
        wanted = stored(self.store) + self.rng.randrange(20, 200)
        wait_for(lambda: not self.running.alive() or stored(self.store) >= wanted, f"{wanted} evaluations")

    def rest(self, how=signal.SIGINT):
        """No program writes it any more."""
        if self.running is None:
            return
        if how == signal.SIGKILL:
            self.running.kill()
        else:
            self.running.send(how)
        self.ended(self.running)
        self.running = None

    def ask(self, *words):
        """Whether this was done; it may be refused only after harm."""
        end = end_of(*words)
        wrong = what_is_wrong_with(end)
        if not wrong and end.code != 0 and not self.harmed:
            wrong = f"`{words[0]}` was refused without harm: {end.err}{end.out}"
        if wrong:
            self.wrong.append(wrong)
        return end.code == 0

    def ended(self, program):
        code = program.wait(60)
        if code not in (*ENDS, -signal.SIGKILL) or "internal error" in program.log():
            self.wrong.append(f"`run` ended with {code}: {program.tail()}")

    def at_rest(self):
        self.rest(self.rng.choice((signal.SIGINT, signal.SIGKILL)))

    def sql(self, *statements):
        """An ordinary client; what SQLite refuses is not done."""
        with contextlib.suppress(sqlite3.Error), contextlib.closing(sqlite3.connect(self.store, isolation_level=None)) as db:
            for each in statements:
                db.execute(each).fetchall()


# --- harmless ---

def go_on(life):
    life.run()
    life.later()


def kill(life):
    life.run()
    life.later()
    life.rest(signal.SIGKILL)


def interrupt(life):
    life.run()
    life.later()
    life.rest(signal.SIGINT)


def kill_a_worker(life):
    life.run()
    life.later()
    for worker in children_of(life.running.pid)[:1]:
        send(worker, signal.SIGKILL)


def stand_still(life):
    """As a laptop that sleeps."""
    life.run()
    life.running.send(signal.SIGSTOP)
    life.ask("status", life.store)
    life.running.send(signal.SIGCONT)


def two_at_once(life):
    life.run()
    end = end_of("run", life.test.file, "--store", life.store, "--no-dashboard", "--workers", "1")
    if end.code not in (0, REFUSED) or what_is_wrong_with(end):
        life.wrong.append(f"a second `run`: {end}")


def look(life):
    life.run()
    for words in (("status", life.store), ("ls", "elites", life.store), ("digest", life.store), ("verify", life.store)):
        life.ask(*words)


def rename_at_rest(life):
    """With all that belongs to it."""
    life.at_rest()
    new = life.place() / f"{life.rng.choice(('monday', 'a b', 'ä'))}.db"
    for name in WHOLE:
        with contextlib.suppress(FileNotFoundError):
            life.beside(name).rename(f"{new}{name}")
    life.store = new


def rename_while_it_runs(life):
    """The campaign stops and says how to go on; that is done."""
    life.run()
    life.running.send(signal.SIGSTOP)
    away = life.place() / "away.db"
    if not life.running.alive() or not life.store.exists():
        return
    life.store.rename(away)
    life.running.send(signal.SIGCONT)
    life.ended(life.running)
    life.running = None
    saved = life.beside(".saved")
    (saved if saved.exists() else away).rename(life.store)


def copy_at_rest(life):
    life.at_rest()
    new = life.place()
    subprocess.run(["cp", life.rng.choice(("-r", "-a")), f"{life.store.parent}/.", str(new)], check=False, capture_output=True)
    copy(life, new, ("", "-wal"))
    life.store = new / "campaign.db"


def backup(life):
    life.run()
    new = life.place() / "backup.db"
    done = life.ask("backup", life.store, new)
    life.at_rest()
    if done:
        life.store = new


def backup_of_sqlite(life):
    life.run()
    new = life.place() / "backup.db"
    with contextlib.closing(sqlite3.connect(life.store)) as source, contextlib.closing(sqlite3.connect(new)) as target:
        source.backup(target)
    life.at_rest()
    life.store = new


def recover(life):
    life.at_rest()
    new = life.place() / "recovered.db"
    if life.store.exists() and life.ask("recover", life.store, "-o", new, "--campaign", life.test.file):
        life.store = new


def touch(life):
    life.at_rest()
    if life.store.exists():
        os.utime(life.store, (life.rng.randrange(2 * 10**9),) * 2)


def change_mode(life):
    """Not to be read and not to be written, then as before: root may all the same."""
    life.at_rest()
    if life.store.exists():
        life.store.chmod(0o444)
        end_of("run", life.test.file, "--store", life.store, "--no-dashboard", "--workers", "1")
        life.store.chmod(0o644)


def without_shm(life):
    life.at_rest()
    life.beside("-shm").unlink(missing_ok=True)
    life.beside(".lock").unlink(missing_ok=True)


def clean_up(life):
    """What people do to make a file smaller, or faster."""
    life.at_rest()
    life.sql(*life.rng.choice((("vacuum",), ("reindex",), ("analyze",), ("pragma wal_checkpoint(truncate)",),
                               ("pragma journal_mode = delete",), ("pragma optimize",), ("pragma incremental_vacuum",))))


def fold(life):
    life.run()
    life.sql("pragma wal_checkpoint(restart)")


def clock_step(life):
    """A year forwards, or back, for one run."""
    found = list(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
    if not found:
        raise NotHere("no libfaketime (Debian package libfaketime)")
    life.at_rest()
    life.run({"LD_PRELOAD": str(found[0]), "FAKETIME": life.rng.choice(("+365d", "-365d", "-1h")),
              "DONT_FAKE_MONOTONIC": "1"})
    life.later()
    life.at_rest()


def full_disk(life):
    """Until something else is removed, or the campaign is killed."""
    if life.test.disk is None:
        raise NotHere("no disk that can be filled: mounting a tmpfs needs root")
    life.run()
    ballast = life.test.disk / "ballast"
    with ballast.open("wb", buffering=0) as file, contextlib.suppress(OSError):
        while True:
            file.write(bytes(1 << 12))
    try:
        wait_for(lambda: not life.running.alive() or "store cannot be written" in life.running.log(), "the word of a full disk")
        if life.rng.random() < 0.5:
            life.at_rest()
    finally:
        ballast.unlink()


def second_user(life):
    """Another user tries."""
    if life.test.programs is None:
        raise NotHere("another user needs root and setpriv")
    life.run()
    for words in (("status", life.store), ("run", life.test.file, "--store", life.store, "--no-dashboard")):
        done = subprocess.run(["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups",
                               life.test.programs / "swarmsmith", *words], capture_output=True, text=True, timeout=60, check=False)
        if done.returncode not in (0, 1, REFUSED) or (done.returncode != 0 and len(done.stderr) < 30):
            life.wrong.append(f"`{words[0]}` of another user: {done}")


def hard_link(life):
    life.at_rest()
    other = life.place() / "other.db"
    if life.store.exists():
        other.hardlink_to(life.store)
        end = end_of("run", life.test.file, "--store", life.store, "--no-dashboard", "--workers", "1")
        if end.code != REFUSED:
            life.wrong.append(f"`run` of a store with two names: {end}")
        other.unlink()


def another_store_in_its_place(life):
    """A person puts an older one there, of another campaign, tries it, and puts ours back."""
    life.at_rest()
    if not life.store.exists():
        return
    aside = life.place()
    for name in WHOLE:
        with contextlib.suppress(FileNotFoundError):
            life.beside(name).rename(aside / f"campaign.db{name}")
    shutil.copy(OLD_STORE, life.store)
    end = end_of("run", life.test.file, "--store", life.store, "--no-dashboard", "--workers", "1")
    if end.code == 0 or what_is_wrong_with(end):
        life.wrong.append(f"`run` of another campaign's store: {end}")
    for name in WHOLE:
        life.beside(name).unlink(missing_ok=True)
        with contextlib.suppress(FileNotFoundError):
            (aside / f"campaign.db{name}").rename(life.beside(name))


# --- harmful: what comes may be refused ---

def mend(life):
    """A store that is refused goes on by what its refusal says, where that can be done."""
    life.at_rest()
    ways = [("recover", life.store, "-o"), ("backup", life.store)]
    life.rng.shuffle(ways)
    for words in ways:
        new = life.place() / "mended.db"
        if life.store.exists() and life.ask(*words, new):
            life.store = new
            return


def copy_while_it_runs(life):
    life.run()
    new = life.place()
    names = life.rng.sample(("", "-wal"), 2) + life.rng.choice(([], ["-shm"], [".lock"]))

    def pause():
        life.later()
        if life.rng.random() < 0.5:
            life.sql("pragma wal_checkpoint(restart)")
        life.later()
    copy(life, new, names, pause, (life.rng.choice(("", "-wal")), life.rng.random() < 0.5))
    life.at_rest()
    life.store = new / "campaign.db"


def without_its_log(life):
    life.at_rest()
    life.beside("-wal").unlink(missing_ok=True)


def rename_the_main_file(life):
    life.at_rest()
    new = life.place() / "renamed.db"
    with contextlib.suppress(FileNotFoundError):
        life.store.rename(new)
        life.store = new


def change_the_schema(life):
    life.at_rest()
    name = life.rng.choice(sorted(FOREIGN))
    if not life.store.exists():
        return
    life.test.count(name)
    with contextlib.suppress(sqlite3.Error):
        make_foreign(life.store, FOREIGN[name][1])


def change_the_schema_while_it_runs(life):
    life.run()
    name = life.rng.choice(("a column more", "a table more", "an index more", "a view more", "trigger after insert"))
    life.test.count(name)
    with contextlib.suppress(sqlite3.Error):
        make_foreign(life.store, FOREIGN[name][1])
    life.later()


def delete_rows(life):
    if life.rng.random() < 0.5:
        life.run()
    else:
        life.at_rest()
    life.sql(life.rng.choice(("delete from evaluation where candidate % 7 = 0",
                              "delete from race_step where step > 3", "delete from elite", "delete from candidate_totals",
                              "update evaluation set score = score + 1 where pair = 2")))


HARMLESS = (go_on, kill, interrupt, kill_a_worker, stand_still, two_at_once, look, rename_at_rest, rename_while_it_runs,
            copy_at_rest, backup, backup_of_sqlite, recover, touch, change_mode, without_shm, clean_up, fold, clock_step,
            full_disk, second_user, hard_link, another_store_in_its_place)
HARMFUL = (copy_while_it_runs, without_its_log, rename_the_main_file, change_the_schema, change_the_schema_while_it_runs,
           delete_rows)


class NotHere(Exception):
    """An act that cannot be done on this machine, and why."""
