"""Disks that fill up, are slow, lose their power, or hold damaged files."""
import contextlib
import http.client
import os
import pathlib
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import time
import unittest

from beside import Beside
from rig import (BIN, LONG, SWARMSMITH, WORKER, FaultTest, call, calls_in, need, need_root, rows,
                 stored, wait_for)

PRELOAD = str(BIN / "faulty_calls.so")
REFUSED = 3  # exit code: the store cannot be used


class Full(Beside):
    budget = 3000

    def mount(self):
        """A tmpfs of 700 KiB in the test's own folder."""
        need_root("mounting a tmpfs")
        disk = self.folder / "disk"
        disk.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=700k", "tmpfs", str(disk)],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.skipTest("skipped: no tmpfs can be mounted: " + done.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", str(disk)], check=True)
        return disk

    def resize(self, disk, size):
        subprocess.run(["mount", "-o", f"remount,size={size}", str(disk)], check=True)

    @staticmethod
    def readiness(serve):
        """Status and text of /readyz, as Kubernetes asks for it."""
        [address] = set(re.findall(r"http://([^\s/\"]+)", serve.log()))
        connection = http.client.HTTPConnection(address, timeout=10)
        try:
            connection.request("GET", "/readyz")
            answer = connection.getresponse()
            return answer.status, answer.read().decode()
        finally:
            connection.close()

    def test_it_waits_for_room_and_goes_on(self):
        disk = self.mount()
        self.store = disk / "campaign.db"
        serve = self.serve("--http", "127.0.0.1:0")
        workers = [self.worker(serve.address()) for _ in range(2)]
        wait_for(lambda: "store cannot be written" in serve.log() or not serve.alive(),
                 "the word that the disk is full", 90)
        self.assertTrue(serve.alive(), "it ended on a full disk: " + serve.tail())
        self.assertIn("full", serve.log())
        wait_for(lambda: serve.progress().get("trouble"), "trouble in the numbers", 10)
        done = serve.progress()["done"]
        self.assertEqual(self.readiness(serve)[0], 503, "it says that it is ready")
        self.assertIn("full", self.readiness(serve)[1])
        # Without room nothing new is handed out: what was held comes in, and that is all.
        time.sleep(2)
        later = serve.progress()["done"]
        time.sleep(2)
        self.assertEqual(serve.progress()["done"], later, f"it goes on without a disk ({done})")
        self.resize(disk, "64m")
        numbers = self.finish(serve, workers)
        self.assertIn("store writes again", serve.log())
        self.assertEqual((numbers["failed"], numbers["conflicts"]), (0, 0))
        self.count("disk full")

    def test_killed_while_the_disk_is_full(self):
        disk = self.mount()
        self.store = disk / "campaign.db"
        run = self.run_local("--workers", "2")
        wait_for(lambda: "store cannot be written" in run.log() or not run.alive(),
                 "the word that the disk is full", 90)
        run.kill()
        self.resize(disk, "64m")
        self.finish(self.run_local("--workers", "2"))
        self.count("killed on a full disk")


class Slow(Beside):
    budget = 8000

    def test_every_sync_takes_50_to_500_ms(self):
        log = self.folder / "calls"
        serve = self.serve(env={"LD_PRELOAD": PRELOAD, "SWARMSMITH_FAULT": "slow=50-500:1",
                                "SWARMSMITH_FAULT_LOG": str(log)})
        workers = [self.worker(serve.address()) for _ in range(2)]
        numbers = self.finish(serve, workers)
        calls = calls_in(log)
        self.assertGreater(calls["sync"], 3)
        self.count("slow sync", calls["sync"])
        self.assert_none(numbers, "failed", "lost_workers", "expired")


class PowerCut(Beside):
    """The client is away: the power that goes is its own, too."""
    budget = 3000

    def setUp(self):
        super().setUp()
        self.client.send(signal.SIGSTOP)

    def assert_acknowledged_are_kept(self):
        with contextlib.suppress(FileNotFoundError):
            (self.folder / "campaign.db-shm").unlink()  # memory: a power cut takes it
        # Opening it for writing repairs what the cut left, as the next run would.
        self.assert_promises_are_kept()

    def test_at_the_nth_change(self):
        """What was not synced when the power went is there in part, or not at all."""
        log = self.folder / "calls"
        self.play({"SWARMSMITH_FAULT_LOG": str(log)})
        self.assert_same_answer()
        calls = calls_in(log)
        changes = calls["write"] + calls["sync"]
        rng = random.Random(5)
        cuts = sorted({1, 2, 3, 5, 8, 13, 21, changes - 1} |
                      {rng.randrange(1, changes) for _ in range(15)})
        for n in cuts:
            with self.subTest(n=n):
                for suffix in ("", "-wal", "-shm", ".lock"):
                    (self.folder / f"campaign.db{suffix}").unlink(missing_ok=True)
                self.forget()
                ended = self.play({"SWARMSMITH_FAULT": f"power={n}:{n}"})
                self.assertIn(ended, (-signal.SIGKILL, 0))
                self.count("power cut", int(ended != 0))
                self.assert_acknowledged_are_kept()
                self.assertEqual(self.play({}), 0)
                self.assert_same_answer()
        self.assertGreater(self.tried["power cut"], 10)

    def play(self, env):
        if env:
            env = {**env, "LD_PRELOAD": PRELOAD}
        serve = self.serve(env=env, wait=False)
        wait_for(lambda: serve.address() or not serve.alive(), "a coordinator")
        worker = proxy = None
        if serve.alive():
            proxy = self.overhear(serve.address())
            worker = self.worker(proxy.address, slots=2)
        ended = serve.wait(60)
        if worker is not None:
            worker.kill()
            proxy.close()
        return ended

    def test_files_copied_at_a_random_moment(self):
        serve = self.serve()
        worker = self.worker(serve.address(), slots=2)
        copies = []
        rng = random.Random(6)
        before = 0
        while len(copies) < 8 and serve.alive():
            before += rng.randrange(50, 500)
            if before > self.budget:
                break
            wait_for(lambda: stored(self.store) >= before or not serve.alive(), "evaluations")
            serve.send(signal.SIGSTOP)  # so that all files are of one moment
            folder = self.folder / f"copy-{len(copies)}"
            folder.mkdir()
            for suffix in ("", "-wal", ".lock"):
                with contextlib.suppress(FileNotFoundError):
                    shutil.copy(f"{self.store}{suffix}", folder)
            copies.append(folder / self.store.name)
            serve.send(signal.SIGCONT)
        self.finish(serve, [worker])
        self.assertGreater(len(copies), 3)
        for copy in copies:
            with self.subTest(copy=copy.name):
                self.store = copy
                self.finish(self.run_local("--workers", "2"))
                self.count("copy taken up")


class Damaged(FaultTest):
    """A damaged or forbidden store is refused with a sentence, or it gives the usual answer."""
    budget = 3000

    def half_done(self):
        """The files of a campaign that was killed half-way, in a folder."""
        folder = self.folder / "half"
        folder.mkdir()
        self.store = folder / "campaign.db"
        run = self.run_local("--workers", "2")
        self.wait_stored(1500)
        run.kill()
        wait_for(lambda: not pathlib.Path(f"/proc/{run.pid}").exists(), "its end")
        return folder

    @staticmethod
    def folded(folder):
        """With the log folded into the main file, which is the whole store then."""
        with contextlib.closing(sqlite3.connect(folder / "campaign.db")) as db:
            db.execute("pragma wal_checkpoint(truncate)")
        return folder

    def resume(self, folder, name):
        """Exit code and words of the same command on a changed copy of the files."""
        self.store = folder / "campaign.db"
        done = call("run", self.file, "--store", self.store, "--workers", "2", "--no-dashboard")
        self.count(name)
        return done.returncode, done.stderr

    def copy(self, folder, name):
        return pathlib.Path(shutil.copytree(folder, self.folder / name))

    def assert_refused(self, code, words, *parts):
        self.assertEqual(code, REFUSED, words)
        for part in parts:
            self.assertIn(part, words)
        self.assertGreater(len(words.strip().splitlines()[0]), 30, "no sentence")

    def test_flipped_bytes_are_never_silent(self):
        """Whatever is flipped: the store is refused, or the campaign says that it cannot go on, or
        its answer is the usual one, or `verify` says what is wrong. Left out is what no other row
        depends on: the bits of an evaluation's state digest and of a score in the tests."""
        half = self.half_done()
        whole = self.folded(self.copy(half, "whole"))
        rng = random.Random(8)
        sound = self.copy(half, "sound")
        self.assertEqual(self.resume(sound, "copy taken up")[0], 0)
        self.assert_same_answer()
        ends = {}
        for n in range(80 if LONG else 6):
            # In the log, or in the main file where the log is folded into it.
            folder = self.copy(half if n % 4 == 0 else whole, f"flip-{n}")
            path = folder / ("campaign.db-wal" if n % 4 == 0 else "campaign.db")
            data = bytearray(path.read_bytes())
            begin = rng.randrange(len(data))
            for at in range(begin, min(begin + rng.choice([1, 8, 512]), len(data))):
                data[at] ^= rng.randrange(1, 256)
            path.write_bytes(data)
            code, words = self.resume(folder, "bytes flipped")
            with self.subTest(n=n, file=path.name, at=begin):
                end = self.end_of(code, words, sound / "campaign.db")
                ends[end] = ends.get(end, 0) + 1
            shutil.rmtree(folder)
        print("\n  " + ", ".join(f"{end}: {n}" for end, n in sorted(ends.items())), end="")

    def end_of(self, code, words, sound):
        """How a damaged store ended, in a word; fails when that was silence."""
        self.assertIn(code, (0, 1, REFUSED), words)
        if code != 0:
            self.assertTrue(words.strip(), "refused without a word")
            return "refused"
        if call("verify", self.store).returncode != 0:
            return "found by verify"
        if self.digest(self.store) == self.expected():
            return "same answer"
        columns = "candidate, purpose, pair, iteration, status, iif(purpose = 2, 0, score)"
        # What was computed ahead and never used is not part of an answer.
        used = "purpose <> 0 or iteration is not null"
        raced = "purpose <> 0 or (design, number) in (select design, pair from race_step)"
        for table, what, where in (("evaluation", columns, used), ("candidate", "*", "true"),
                                   ("pair", "*", raced), ("race_step", "*", "true"),
                                   ("elimination", "*", "true"), ("elite", "*", "true")):
            query = f"select {what} from {table} where {where}"
            self.assertEqual(rows(self.store, query), rows(sound, query),
                             "another answer, silently")
        return "bits of a state digest"

    def test_a_damaged_header_or_page_is_refused(self):
        half = self.folded(self.half_done())
        for name, at, bytes_ in (("magic", 0, b"garbage!"), ("page", 8192, os.urandom(4096))):
            folder = self.copy(half, name)
            with (folder / "campaign.db").open("r+b") as file:
                file.seek(at)
                file.write(bytes_)
            with self.subTest(name):
                self.assert_refused(*self.resume(folder, "store damaged"), str(self.store))

    def test_a_truncated_store_is_refused(self):
        half = self.folded(self.half_done())
        size = (half / "campaign.db").stat().st_size
        for part in (0.1, 0.5, 0.99):
            folder = self.copy(half, f"short-{part}")
            os.truncate(folder / "campaign.db", int(size * part))
            with self.subTest(part=part):
                self.assert_refused(*self.resume(folder, "store truncated"), "truncated")

    def test_a_truncated_log_gives_the_usual_answer(self):
        """What the lost commits held is evaluated again."""
        half = self.half_done()
        size = (half / "campaign.db-wal").stat().st_size
        rng = random.Random(9)
        for n in range(8 if LONG else 2):
            folder = self.copy(half, f"log-{n}")
            os.truncate(folder / "campaign.db-wal", rng.randrange(size))
            code, words = self.resume(folder, "log truncated")
            self.assertEqual(code, 0, words)
            self.assert_same_answer()

    def test_what_may_not_be_written_is_refused(self):
        """As another user, since root may write anything."""
        need_root("running as another user")
        need("setpriv", "util-linux")
        half = self.half_done()
        programs = self.folder / "bin"
        programs.mkdir()
        for program in (SWARMSMITH, WORKER):
            shutil.copy(program, programs)
        self.folder.chmod(0o755)

        def run(store, name):
            self.count(name)
            return subprocess.run(
                ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups",
                 programs / "swarmsmith", "run", self.file, "--store", store, "--no-dashboard"],
                capture_output=True, text=True, timeout=60, check=False)

        folder = self.copy(half, "read-only-folder")
        done = run(folder / "campaign.db", "read-only folder")
        self.assert_refused(done.returncode, done.stderr, str(folder))

        folder = self.copy(half, "wrong-owner")
        folder.chmod(0o777)
        done = run(folder / "campaign.db", "wrong owner")
        self.assert_refused(done.returncode, done.stderr, str(folder))

        done = run(self.folder / "new.db", "read-only folder")
        self.assert_refused(done.returncode, done.stderr, str(self.folder))
        self.assertEqual(stored(half / "campaign.db"), stored(folder / "campaign.db"))


if __name__ == "__main__":
    unittest.main()
