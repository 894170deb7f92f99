"""What remains of an import that was killed, or whose disk was full: all of a run or nothing."""
import pathlib
import resource
import signal
import sqlite3
import subprocess
import time
import unittest

from filmed_lab import TRACK, FilmedLab, call, runs_in

LAB = None


def setUpModule():
    global LAB
    LAB = FilmedLab()
    LAB.film("run")


def words_for(store):
    return ["score", "--run", str(LAB.film("run")), "--arena", str(LAB.lab / "arena.toml"),
            "--into", str(store)]


def parts_of(store):
    """How many rows each table of real runs has."""
    with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as base:
        tables = [name for name, in base.execute(
            "SELECT name FROM sqlite_master WHERE type = 'table' AND name LIKE 'real_%'"
            " OR name = 'calibration'")]
        counts = {name: base.execute(f"SELECT count(*) FROM {name}").fetchone()[0]
                  for name in sorted(tables)}
        return counts, base.execute("PRAGMA integrity_check").fetchone()[0]


def size_of(file):
    """-1 when it is not there, or no longer."""
    try:
        return file.stat().st_size
    except FileNotFoundError:
        return -1


class Import(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole_store = LAB.folder / "whole.db"
        started = time.monotonic()
        done = call(TRACK, *words_for(cls.whole_store))
        cls.seconds = time.monotonic() - started
        assert done.returncode == 0, done.stdout + done.stderr
        cls.whole, _ = parts_of(cls.whole_store)

    def assert_all_or_nothing(self, store):
        """True when all of the run is there."""
        if not store.exists() or store.stat().st_size == 0:
            return False
        counts, integrity = parts_of(store)
        self.assertEqual(integrity, "ok")
        if counts.get("real_run", 0) == 0:
            self.assertEqual(set(counts.values()) - {0}, set(), counts)
            return False
        self.assertEqual(counts, self.whole)
        return True

    def assert_can_be_done_again(self, store):
        again = call(TRACK, *words_for(store))
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(len(runs_in(store)), 1)
        self.assertEqual(parts_of(store), (self.whole, "ok"))

    def test_killed_at_several_moments(self):
        # Most moments near the end, where the store is written.
        moments = [0.02, 0.3, 0.6, 0.8, 0.9, 0.95, 0.98, 1.0, 1.02]
        for number, share in enumerate(moments):
            store = LAB.folder / f"killed{number}.db"
            process = subprocess.Popen([str(TRACK), *words_for(store)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            try:
                process.wait(share * self.seconds)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
            process.wait()
            self.assert_all_or_nothing(store)
            self.assert_can_be_done_again(store)

    def test_killed_as_soon_as_the_store_is_written(self):
        self.kill_when_written(0, 3)

    def test_killed_while_the_store_is_written(self):
        self.kill_when_written(1, 2, 4, 5)

    def kill_when_written(self, *moments):
        for number in moments:
            store = LAB.folder / f"written{number}.db"
            log = pathlib.Path(f"{store}-wal")
            process = subprocess.Popen([str(TRACK), *words_for(store)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            # The log of the second opening is the one that takes the run; it grows as it does.
            until = time.monotonic() + 60 + 10 * self.seconds
            while process.poll() is None and time.monotonic() < until:
                if size_of(log) > number * 20_000:
                    break
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assert_all_or_nothing(store)
            self.assert_can_be_done_again(store)

    def test_disk_that_is_full(self):
        whole = self.whole_store.stat().st_size
        for share in (0.02, 0.3, 0.6, 0.9):
            store = LAB.folder / f"full{share}.db"

            def little_room():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (int(share * whole),) * 2)

            done = call(TRACK, *words_for(store), preexec_fn=little_room)
            self.assertIn(done.returncode, (1, 3), done.stdout)
            self.assertIn(store.name, done.stderr)
            self.assertFalse(self.assert_all_or_nothing(store))
            self.assert_can_be_done_again(store)


if __name__ == "__main__":
    unittest.main()
