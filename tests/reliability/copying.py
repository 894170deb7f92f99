"""Ways in which people and their tools copy a store that a campaign writes at that moment."""
import contextlib
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess

from rig import FaultTest, call, stored, wait_for

#: What SQLite keeps beside the file, and what a program of ours does.
WHOLE = ("", "-wal", "-shm", ".lock")
PIECE = 1 << 14


class Moving(FaultTest):
    """A campaign that goes on while the test lets it, and stands still else: whatever happens in the middle of a
    copy is a condition, and no campaign is over before it is copied."""

    budget = 3000

    def setUp(self):
        super().setUp()
        self.rng = random.Random(45)

    def begin(self):
        """A campaign from its start, in a folder of its own."""
        self.begun = getattr(self, "begun", 0) + 1
        self.store = self.folder / f"live-{self.begun}" / "campaign.db"
        self.store.parent.mkdir()
        self.serving = self.serve()
        self.working = self.worker(self.serving.address())
        self.later(self.budget // 10)

    def later(self, number):
        """So many evaluations later."""
        wanted = min(stored(self.store) + number, 0.9 * self.budget)
        with self.going_on():
            wait_for(lambda: stored(self.store) >= wanted or not self.serving.alive(), f"{wanted} evaluations")

    @contextlib.contextmanager
    def going_on(self):
        self.working.send(signal.SIGCONT)
        yield
        self.working.send(signal.SIGSTOP)

    def fold(self, how="restart"):
        """The log goes into the main file, as it does by itself every 8 MB, and the next commit writes its begin anew."""
        with contextlib.closing(sqlite3.connect(self.store, timeout=30)) as client:
            client.execute(f"pragma wal_checkpoint({how})").fetchone()

    def end(self):
        """The campaign that was copied is none the worse for it."""
        with self.going_on():
            pass
        self.working.send(signal.SIGCONT)
        self.finish(self.serving, [self.working])

    def beside(self, suffix):
        return pathlib.Path(f"{self.store}{suffix}")


def copy(moving, to, names, pause=lambda: None, at=None, temporary=False):
    """File by file and piece by piece, as slow tools do; `pause` at the place `at`: (file, whether in its middle).
    `temporary`: each under another name first, as rsync does."""
    for name in names:
        with contextlib.suppress(FileNotFoundError), moving.beside(name).open("rb") as source:
            half = os.fstat(source.fileno()).st_size // 2
            made = to / (".part" if temporary else f"campaign.db{name}")
            with made.open("wb") as target:
                while piece := source.read(PIECE):
                    target.write(piece)
                    if at == (name, True) and target.tell() >= half:
                        at = None
                        target.flush()
                        pause()
            made.rename(to / f"campaign.db{name}")
        if at == (name, False):
            pause()


def by(moving, *command):
    """With a tool, while the campaign goes on."""
    with moving.going_on():
        subprocess.run([*map(str, command)], check=True, capture_output=True)


def with_cp(*options):
    return lambda moving, to: by(moving, "cp", "-r", *options, f"{moving.store.parent}/.", to)


def with_rsync(moving, to):
    if shutil.which("rsync"):
        by(moving, "rsync", "-a", f"{moving.store.parent}/", to)
    else:
        copy(moving, to, WHOLE, lambda: moving.later(100), ("", False), temporary=True)


def with_tar(moving, to):
    by(moving, "sh", "-c", 'tar -C "$0" -cf - . | tar -C "$1" -xf -', moving.store.parent, to)


def with_dd(*options):
    def make(moving, to):
        for name in ("", "-wal"):
            by(moving, "dd", f"if={moving.beside(name)}", f"of={to}/campaign.db{name}", *options)
    return make


def slowly(names, at, *events):
    """In this order of the files, with a pause there."""
    def make(moving, to):
        def pause():
            for event in events:
                event(moving)
        copy(moving, to, names, pause, at)
    return make


def more(moving):
    moving.later(moving.rng.randrange(moving.budget // 40, moving.budget // 13))


def fold(moving):
    moving.fold(moving.rng.choice(("restart", "restart", "full", "passive")))


def truncate(moving):
    moving.fold("truncate")


def two_at_once(moving, to):
    """Both files in turns, a piece each."""
    with moving.beside("").open("rb") as db, moving.beside("-wal").open("rb") as log, \
            (to / "campaign.db").open("wb") as new_db, (to / "campaign.db-wal").open("wb") as new_log:
        pieces = [True, True]
        n = 0
        while any(pieces):
            pieces = [new_db.write(db.read(PIECE)), new_log.write(log.read(PIECE))]
            n += 1
            if n == 3:
                more(moving)


def with_backup_of_sqlite(moving, to):
    """In steps, as its shell does, while the campaign writes: SQLite begins anew then."""
    with contextlib.closing(sqlite3.connect(f"file:{moving.store}?mode=ro", uri=True)) as source, \
            contextlib.closing(sqlite3.connect(to / "campaign.db")) as target:
        steps = []

        def progress(*_):
            steps.append(0)
            if len(steps) == 2:
                more(moving)
        source.backup(target, pages=4, progress=progress, sleep=0.001)


def with_vacuum_into(moving, to):
    with moving.going_on(), contextlib.closing(sqlite3.connect(moving.store)) as source:
        source.execute("vacuum into ?", (str(to / "campaign.db"),))


def with_swarmsmith(moving, to):
    with moving.going_on():
        done = call("backup", moving.store, to / "campaign.db")
    moving.assertEqual(done.returncode, 0, done.stderr)


def with_the_shell_dump(moving, to):
    """All rows as SQL, and back: what is not a row is lost."""
    with contextlib.closing(sqlite3.connect(f"file:{moving.store}?mode=ro", uri=True)) as source, \
            contextlib.closing(sqlite3.connect(to / "campaign.db")) as target:
        target.execute("pragma foreign_keys = off")
        target.executescript("\n".join(source.iterdump()))


def at_one_moment(moving, to):
    """All files while no program writes."""
    copy(moving, to, ("", "-wal", ".lock"))


def of_a_copy(moving, to):
    """A slow copy, which a client opens: its log is folded in. Then that is copied."""
    first = to.with_name(to.name + "-first")
    first.mkdir()
    copy(moving, first, ("", "-wal"), lambda: (fold(moving), more(moving)), ("", False))
    with contextlib.suppress(sqlite3.Error), contextlib.closing(sqlite3.connect(first / "campaign.db")) as client:
        client.execute("select count(*) from sqlite_schema").fetchone()
    shutil.copytree(first, to, dirs_exist_ok=True)
    shutil.rmtree(first)


def cut_at_a_page(moving, to):
    copy(moving, to, ("", "-wal"))
    file = to / "campaign.db"
    os.truncate(file, file.stat().st_size // 8192 * 3 // 4 * 8192)


def with_a_cut_log(moving, to):
    """Frames have 24 bytes and a page of 8192."""
    copy(moving, to, ("", "-wal"))
    file = to / "campaign.db-wal"
    os.truncate(file, 32 + max(file.stat().st_size - 32, 0) // 8216 // 2 * 8216)


def the_newer_files_again(moving, to):
    """A second time, and only what has changed by then in size: the main file may not have."""
    copy(moving, to, ("", "-wal", "-shm"))
    before = {name: moving.beside(name).stat().st_size for name in ("", "-wal")}
    moving.later(moving.budget // 20)
    fold(moving)
    moving.later(moving.budget // 20)
    copy(moving, to, [name for name in before if moving.beside(name).stat().st_size != before[name]])


def renamed(moving, to):
    """A copy whose main file gets another name, and back, with the log of a later copy."""
    copy(moving, to, ("", "-wal"))
    (to / "campaign.db").rename(to / "monday.db")
    fold(moving)
    more(moving)
    copy(moving, to, ("", "-wal"))
    (to / "monday.db").rename(to / "campaign.db")


def renamed_without_its_log(moving, to):
    copy(moving, to, ("", "-wal"))
    (to / "campaign.db-wal").rename(to / "monday.db-wal")


#: Whatever is done, that gives a store of one moment.
SOUND = {
    "sqlite's backup": with_backup_of_sqlite,
    "vacuum into": with_vacuum_into,
    "swarmsmith backup": with_swarmsmith,
    "all files at one moment": at_one_moment,
}
#: These may give anything.
OTHERS = {
    "db, folded, log": slowly(("", "-wal"), ("", False), fold, more),
    "log, folded, db": slowly(("-wal", ""), ("-wal", False), fold, more),
    "cp -r": with_cp(),
    "db alone": slowly(("",), None),
    "db alone, folded in its middle": slowly(("",), ("", True), more, fold, more),
    "db, more, log": slowly(("", "-wal"), ("", False), more),
    "log, more, db": slowly(("-wal", ""), ("-wal", False), more),
    "half of the db, more": slowly(("", "-wal"), ("", True), more),
    "half of the db, folded": slowly(("", "-wal"), ("", True), fold, more),
    "half of the db, more, folded, more": slowly(WHOLE, ("", True), more, fold, more),
    "half of the log, more": slowly(("", "-wal"), ("-wal", True), more),
    "half of the log, folded": slowly(("", "-wal"), ("-wal", True), fold, more),
    "db, truncated log": slowly(("", "-wal"), ("", False), truncate, more),
    "with -shm": slowly(WHOLE, ("-wal", False), more),
    "with -shm, folded": slowly(("", "-wal", "-shm"), ("-wal", False), fold, more),
    "-shm first": slowly(("-shm", "-wal", ""), ("-shm", False), fold, more),
    "db with -shm alone": slowly(("", "-shm"), ("", False), fold, more),
    "cp -a": with_cp("-a"),
    "cp --sparse=always": with_cp("--sparse=always"),
    "cp --reflink=auto": with_cp("--reflink=auto"),
    "rsync": with_rsync,
    "tar": with_tar,
    "dd by pages": with_dd("bs=8192"),
    "dd with padding": with_dd("bs=64k", "conv=sync"),
    "both at once": two_at_once,
    "dump of the shell": with_the_shell_dump,
    "copy of a copy": of_a_copy,
    "cut at a page": cut_at_a_page,
    "cut log": with_a_cut_log,
    "changed files again": the_newer_files_again,
    "older db, newer log": renamed,
    "log with another name": renamed_without_its_log,
}
