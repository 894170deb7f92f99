"""Programs of another Debian beside those of this one: the same bits, one campaign that moves from one to the other, and
workers of both in one campaign. SWARMSMITH_OTHER_ROOT is that system's root, SWARMSMITH_OTHER_BIN the place of the programs
in it, such as /home/swarmsmith/build/bin; the gate debian13 sets both. Its programs are started by its own loader."""
import os
import pathlib
import shlex
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/end_to_end"))
import robots  # noqa: E402
from bundle_test import serve  # noqa: E402
from programs import BIN, PATIENCE, SWARMSMITH, ProgramTest, call, ended_well, used, wait_for  # noqa: E402

ROOT = os.environ.get("SWARMSMITH_OTHER_ROOT")


@unittest.skipUnless(ROOT, "skipped: SWARMSMITH_OTHER_ROOT names no other system; ./dev gate debian13 makes one")
class TwoSystems(ProgramTest):
    budget = 6000

    def setUp(self):
        super().setUp()
        root, place = pathlib.Path(ROOT), os.environ["SWARMSMITH_OTHER_BIN"]
        libraries = [root / "usr/lib/x86_64-linux-gnu", *(root / "usr/lib/x86_64-linux-gnu").glob("*/")]
        self.other = {}
        for name in ("swarmsmith", "swarmsmith-worker"):
            words = [root / "lib64/ld-linux-x86-64.so.2", "--argv0", name, "--library-path", ":".join(map(str, libraries)),
                     f"{root}{place}/{name}"]
            self.other[name] = self.folder / f"other-{name}"
            self.other[name].write_text(f'#!/bin/sh\nexec {shlex.join(map(str, words))} "$@"\n')
            self.other[name].chmod(0o755)

    def call_other(self, *words, timeout=600):
        return subprocess.run([self.other["swarmsmith"], *map(str, words)], capture_output=True, text=True, timeout=timeout * PATIENCE,
                              env={**os.environ, "SWARMSMITH_WORKER": str(self.other["swarmsmith-worker"])})

    def both(self, *words):
        """What both say to a command, which is the same."""
        ours, theirs = call(*words), self.call_other(*words)
        self.assertEqual((ours.returncode, ours.stderr), (0, ""), ours.stderr)
        self.assertEqual((theirs.returncode, theirs.stderr), (0, ""), theirs.stderr)
        self.assertEqual(ours.stdout, theirs.stdout)
        return ours.stdout

    def test_it_is_another_system(self):
        def libc(bin_folder):
            return subprocess.run(["readelf", "-V", bin_folder / "swarmsmith"], capture_output=True, text=True).stdout
        self.assertNotEqual(libc(BIN), libc(pathlib.Path(ROOT + os.environ["SWARMSMITH_OTHER_BIN"])))

    def test_scores_are_the_same(self):
        for mission in ("aggregation", "color_selection", "grid_exploration"):
            machine = SOURCE / "examples/lab/run01.fsm"
            self.assertIn('"score"', self.both("evaluate", machine, "--mission", mission, "--seeds", "1-100", "--json"))

    def test_campaigns_have_the_same_digest(self):
        for name in ("aggregation", "color_selection", "grid_exploration", "own_missions"):
            with self.subTest(name):
                file = SOURCE / f"examples/{name}.toml"
                ours, theirs = self.folder / f"{name}-ours.db", self.folder / f"{name}-theirs.db"
                for run, store in ((call, ours), (self.call_other, theirs)):
                    ended_well(run("run", file, "--store", store, "--no-dashboard", "--workers", "2", "--seed", "77",
                                   "--budget", "1500", timeout=900))
                self.assertEqual(self.digest(ours), self.digest(theirs))
                self.assertEqual(self.both("digest", ours), self.both("digest", theirs))

    def test_a_campaign_moves_from_one_to_the_other(self):
        whole, moved = self.folder / "whole.db", self.folder / "moved.db"
        self.assertEqual(self.run_campaign(whole, "--workers", "2").returncode, 0)
        for turn in range(6):
            before = used(moved)
            program = SWARMSMITH if turn % 2 else str(self.other["swarmsmith"])
            worker = str(BIN / "swarmsmith-worker") if turn % 2 else str(self.other["swarmsmith-worker"])
            process = subprocess.Popen([program, "run", str(self.file), "--store", str(moved), "--no-dashboard", "--workers", "2"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                                       env={**os.environ, "SWARMSMITH_WORKER": worker})
            self.addCleanup(self._end, process)
            wait_for(lambda: used(moved) > before + 200 or process.poll() is not None, f"turn {turn}")
            self._end(process)
        ended_well(self.call_other("run", self.file, "--store", moved, "--no-dashboard", "--workers", "2"))
        self.assertEqual(self.digest(moved), self.digest(whole))
        self.assert_clean(moved)

    def test_workers_of_both_in_one_campaign(self):
        keys = self.folder / "keys"
        self.assertEqual(call("keygen", keys).returncode, 0)
        store, alone = self.folder / "both.db", self.folder / "alone.db"
        coordinator, port = serve(self, store, "--keys", keys)
        workers = [robots.Process(self, [str(program), "--connect", f"tcp://127.0.0.1:{port}", "--key", str(keys / "worker.key"),
                                         "--slots", "1"])
                   for program in (BIN / "swarmsmith-worker", self.other["swarmsmith-worker"])]
        self.assertEqual(coordinator.end(), 0, coordinator.said())
        for worker in workers:
            self.assertEqual(worker.end(), 0, worker.said())
        rows = self.query(store, "SELECT done > 50 AS worked FROM worker")
        self.assertEqual(rows, [{"worked": 1}, {"worked": 1}])
        self.assertEqual(self.run_campaign(alone, "--workers", "1").returncode, 0)
        self.assertEqual(self.digest(store), self.digest(alone))


if __name__ == "__main__":
    unittest.main()
