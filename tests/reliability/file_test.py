"""The store's file: who has it open, what it is called, and what happens when it goes away."""
import contextlib
import os
import pathlib
import shutil
import signal
import sqlite3
import unittest

from beside import Beside
from rig import BIN, SWARMSMITH, FaultTest, call, ended_well, rows, stored, wait_for

PRELOAD = str(BIN / "faulty_calls.so")
REFUSED = 3  # exit code: the store cannot be used


def has_lock(pid, store):
    """Whether a process has SQLite's shared lock on the store: it has lost it when a part of it has
    closed the file besides SQLite, and the next ordinary client that leaves takes the log away."""
    about = os.stat(store)
    place = f"{os.major(about.st_dev):02x}:{os.minor(about.st_dev):02x}:{about.st_ino}"
    for line in pathlib.Path("/proc/locks").read_text().splitlines():
        words = line.split()
        if words[1] == "POSIX" and words[4:6] == [str(pid), place] and words[6] == "1073741826":
            return True
    return False


class Locks(FaultTest):
    """The coordinator is known to be there, after every kind of start and whatever it is asked."""
    budget = 100000  # never done while it is asked, however fast the machine

    def assert_known(self, program, what):
        self.assertTrue(program.alive(), program.tail())
        self.assertTrue(has_lock(program.pid, self.store), f"its lock is lost {what}")
        log = pathlib.Path(f"{self.store}-wal")
        inode = log.stat().st_ino
        with contextlib.closing(sqlite3.connect(self.store)) as db:
            db.execute("select count(*) from evaluation").fetchone()
        self.assertEqual(log.stat().st_ino, inode, f"an ordinary client took the log away {what}")
        self.count("ordinary client came and went")

    def test_after_every_kind_of_start(self):
        serve = self.serve()
        self.assert_known(serve, "in a new store")
        serve.send(signal.SIGINT)
        serve.wait()
        serve = self.serve()
        self.assert_known(serve, "after a tidy end")
        for n in range(3):
            worker = self.worker(serve.address())
            self.wait_stored(stored(self.store) + 200)
            serve.kill()
            worker.kill()
            serve = self.serve("--http", "127.0.0.1:0")
            self.assert_known(serve, f"after kill {n + 1}")

    def test_whatever_it_is_asked(self):
        serve = self.serve("--http", "127.0.0.1:0")
        self.worker(serve.address())
        self.wait_stored(300)
        out = self.folder / "out"
        out.mkdir()
        for words in (("status", self.store), ("pause", self.store, "d1"),
                      ("resume", self.store, "d1"), ("extend", self.store, "d1", "--budget", "9"),
                      ("backup", self.store, out / "copy.db"), ("report", self.store, "-o", out / "r.html"),
                      ("verify", self.store), ("digest", self.store), ("check", self.store),
                      ("recover", self.store, "-o", out / "recovered.db"),
                      ("run", self.file, "--store", self.store)):
            call(*words)
            self.assert_known(serve, f"after `{words[0]}`")
        serve.send(signal.SIGINT)
        self.assertEqual(serve.wait(), 130, serve.tail())


class OpenedBeside(FaultTest):
    """No program opens a store besides SQLite, at rest or while a campaign runs."""
    budget = 1500
    designs = 2

    def setUp(self):
        super().setUp()
        self.log = self.folder / "beside"
        self.env = {"LD_PRELOAD": str(BIN / "opened_beside.so"), "SWARMSMITH_BESIDE_LOG": str(self.log)}

    def commands(self, store, out):
        yield from (("status", store), ("verify", store), ("digest", store), ("ls", "designs", store),
                    ("show", "d1", "--store", store), ("pause", store, "d1"),
                    ("resume", store, "d1"), ("query", store, "select 1"),
                    ("backup", store, out / "copy.backup"), ("recover", store, "-o", out / "new.recovered"),
                    ("merge", store, "-o", out / "merged.backup"), ("report", store, "-o", out / "r.html"),
                    ("supplement", store, "-o", out / "supplement"),
                    ("export", store, "-o", out / "best.fsm"), ("evaluate", store, "--seeds", "1-2"),
                    ("evaluate", "best", "--store", store, "--seeds", "1-2"),
                    ("figure", "machine", store, "-o", out / "m.svg"), ("compare", store),
                    ("run", self.file, "--store", store, "--no-dashboard"))

    def assert_opened_by_sqlite_alone(self, what):
        said = self.log.read_text() if self.log.exists() else ""
        self.assertEqual(said, "", f"opened besides SQLite {what}")

    def ask_everything(self, store, name):
        out = self.folder / name
        out.mkdir()
        for words in self.commands(store, out):
            with self.subTest(name, words=words[:2]):
                self.start(words[0], SWARMSMITH, *words, env=self.env).wait()
                self.assert_opened_by_sqlite_alone(f"by `{words[0]}`")
                self.count("command looked at")

    def test_by_no_command(self):
        self.hold(env=self.env)
        serve = self.serve("--http", "127.0.0.1:0", env=self.env)
        worker = self.worker(serve.address())
        self.wait_stored(300)
        serve.kill()
        address = serve.address()
        serve = self.serve("--http", "127.0.0.1:0", bind=address, env=self.env)
        self.assert_opened_by_sqlite_alone("after a crash")
        self.ask_everything(self.store, "running")
        self.finish(serve, [worker])
        self.assert_opened_by_sqlite_alone("by a whole campaign")
        self.ask_everything(self.store, "at-rest")


class Names(FaultTest):
    """A store is its file, whatever it is called."""
    budget = 1500
    designs = 2

    def assert_refused(self, name, *words):
        done = call("run", self.file, "--store", name, "--no-dashboard")
        self.assertEqual(done.returncode, REFUSED, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.count("second coordinator refused")

    def test_no_second_coordinator_by_any_name(self):
        self.hold()
        serve = self.serve()
        worker = self.worker(serve.address())
        self.wait_stored(300)
        link = self.folder / "link.db"
        link.symlink_to(self.store.name)
        self.assert_refused(link, "another process is writing this store", f"pid={serve.pid}")
        other = self.folder / "hard.db"
        other.hardlink_to(self.store)
        self.assert_refused(other, "another process is writing this store", f"pid={serve.pid}")
        other.unlink()
        ended_well(call("pause", link))
        ended_well(call("resume", link))
        self.held = None
        self.finish(serve, [worker])

    def test_a_store_with_two_names_is_refused_at_rest(self):
        self.assertEqual(self.run_local("--workers", "2").wait(), 0)
        other = self.folder / "hard.db"
        other.hardlink_to(self.store)
        self.assert_refused(other, "second name")
        self.assert_refused(self.store, "second name")

    def test_a_renamed_store_gets_no_second_coordinator(self):
        serve = self.serve()
        serve.send(signal.SIGSTOP)  # before it notices
        renamed = self.folder / "renamed.db"
        self.store.rename(renamed)
        self.assert_refused(renamed, "another process is writing this store", f"pid={serve.pid}")
        serve.send(signal.SIGCONT)
        self.assertEqual(serve.wait(30), REFUSED, serve.tail())


class Lost(Beside):
    """The store goes away under a campaign: it stops at once, says so, and loses nothing."""
    budget = 60000

    def wanted(self):
        """What is lost is made again by the coordinator that goes on: the store says it."""
        return set()

    def happenings(self):
        away, text = self.folder / "away", "no store, and not to be overwritten"

        def replace():
            other = self.folder / "other"
            other.write_text(text)
            other.rename(self.store)

        yield "deleted", self.store.unlink, "was deleted"
        yield "renamed", lambda: self.store.rename(away), "was renamed"
        yield "replaced", replace, "another file has its name"
        yield "without its log", pathlib.Path(f"{self.store}-wal").unlink, "-wal, which SQLite needs"

    def begin(self, name):
        self.store = self.folder / name / "campaign.db"
        self.store.parent.mkdir()
        self.forget()

    def assert_lost(self, program, sentence):
        self.assertEqual(program.wait(60), REFUSED, program.tail())
        said = program.log() + program.out.read_text()
        self.assertIn(sentence, said)
        self.count("store lost")
        saved = pathlib.Path(f"{self.store}.saved")
        self.assertIn(f"mv {saved} {self.store}", said)
        self.assertTrue(saved.exists(), "nothing was saved")
        saved.rename(self.store)
        self.assert_promises_are_kept()

    def test_of_serve(self):
        for n, what in enumerate(("deleted", "renamed", "replaced", "without its log")):
            with self.subTest(what):
                self.begin(f"serve-{n}")
                serve = self.serve()
                address = serve.address()
                proxy = self.overhear(address)
                worker = self.worker(proxy.address)
                self.wait_stored(300)
                [[_, happen, sentence]] = [each for each in self.happenings() if each[0] == what]
                happen()
                self.assert_lost(serve, sentence)
                known = stored(self.store)
                self.assertGreaterEqual(known, 300)
                serve = self.serve(bind=address)
                self.wait_stored(known + 100)
                serve.kill()
                worker.kill()
                self.assert_promises_are_kept()
                self.assert_clean(self.store)
                proxy.close()

    def test_of_run(self):
        for n, what in enumerate(("deleted", "renamed", "replaced", "without its log")):
            with self.subTest(what):
                self.begin(f"run-{n}")
                run = self.run_local("--workers", "2")
                self.wait_stored(500)
                [[_, happen, sentence]] = [each for each in self.happenings() if each[0] == what]
                happen()
                self.assert_lost(run, sentence)
                self.assertGreaterEqual(stored(self.store), 500)

    def test_of_a_run_that_goes_on_to_the_same_answer(self):
        self.budget = 1500
        self.designs = 2
        self.file.write_text(self.campaign_text())
        self.begin("whole")
        self.hold()
        run = self.run_local("--workers", "2")
        self.wait_stored(300)
        self.store.unlink()
        self.assert_lost(run, "was deleted")
        self.finish(self.run_local("--workers", "2"))

    def test_of_irace(self):
        (self.folder / "Instances").mkdir()
        (self.folder / "Instances" / "one").write_text("1\n")
        (self.folder / "parameters.txt").write_text('x "" i (0,100)\n')
        runner = self.folder / "target-runner"
        runner.write_text('#!/bin/sh\necho $(( ($5 - 30) * ($5 - 30) + $3 % 50 ))\n')
        runner.chmod(0o755)
        (self.folder / "scenario.txt").write_text(
            'parameterFile = "parameters.txt"\ntrainInstancesDir = "Instances"\n'
            'maxExperiments = 20000\nseed = 42\n')
        for n, what in enumerate(("deleted", "renamed", "replaced", "without its log")):
            with self.subTest(what):
                self.begin(f"irace-{n}")
                irace = self.start("irace", SWARMSMITH, "irace", "--scenario",
                                   self.folder / "scenario.txt", "--store", self.store)
                wait_for(lambda: stored(self.store) > 50 or not irace.alive(), "runs", 60)
                [[_, happen, sentence]] = [each for each in self.happenings() if each[0] == what]
                happen()
                self.assert_lost(irace, sentence)
                self.assertNotIn("Give the options", irace.log())
                self.assertGreater(stored(self.store), 50)


class KilledCopies(FaultTest):
    """`backup`, `recover` and `merge` that are killed leave nothing that the next one does not clear."""
    budget = 1500

    def test_the_next_one_clears_what_was_left(self):
        self.assertEqual(self.run_local("--workers", "2").wait(), 0)
        folder = self.folder / "copies"
        folder.mkdir()
        for command in (("backup", self.store, folder / "b.db"),
                        ("recover", self.store, "-o", folder / "r.db"),
                        ("merge", self.store, "-o", folder / "m.db")):
            name = command[-1]
            for n in (1, 20, 60):
                with self.subTest(command=command[0], n=n):
                    program = self.start(command[0], SWARMSMITH, *command,
                                         env={"LD_PRELOAD": PRELOAD,
                                              "SWARMSMITH_FAULT": f"kill-after=write:{n}"})
                    self.assertEqual(program.wait(), -signal.SIGKILL, program.tail())
                    self.assertFalse(name.exists(), "half of a store has its name")
                    self.count(f"{command[0]} killed")
            self.assertTrue(list(folder.iterdir()), "nothing was left: the test shows nothing")
            ended_well(call(*command))
            self.assertEqual([file.name for file in folder.iterdir()], [name.name])
            shutil.rmtree(folder)
            folder.mkdir()


if __name__ == "__main__":
    unittest.main()
