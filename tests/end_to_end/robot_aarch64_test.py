"""The programs for 64-bit ARM, under emulation: their runs have the bits of those of this machine."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import bundle_test
import robots
from programs import ProgramTest, call, ended_well
from robot_lock_step_test import WATERMELON
from robots import Process, ZeroMq, machine_file

FOLDER = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "build-aarch64"
EMULATOR = "qemu-aarch64-static"


def emulated(program):
    return [EMULATOR, "-L", FOLDER / "sysroot", FOLDER / "bin" / program]


def emulated_bundle(bundle):
    """Its worker where there is nothing but the bundle: a kernel that lets a namespace say how programs of another kind are
    run (6.7) starts it, as one of that kind does. Without that, what it would start: its own loader."""
    script = (f"mount -t binfmt_misc none /proc/sys/fs/binfmt_misc && "
              f"cat /usr/lib/binfmt.d/qemu-aarch64.conf >/proc/sys/fs/binfmt_misc/register && "
              f"exec unshare --root '{bundle}' --wd / /swarmsmith-worker \"$@\"")
    words = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script, "sh"]
    if subprocess.run([*words, "--version"], capture_output=True).returncode == 0:
        return words
    print("the launcher of bundles for aarch64 is not tried: this kernel lets no namespace start such programs")
    return [EMULATOR, bundle / "lib/ld.so", "--inhibit-cache", "--library-path", bundle / "lib", bundle / "lib/swarmsmith-worker"]


def why_not():
    if not shutil.which(EMULATOR):
        return f"skipped: {EMULATOR} is not here (qemu-user-static)"
    if not (FOLDER / "bin" / "swarmsmith-robot").exists():
        return "skipped: the programs for aarch64 are not built (./dev build --target aarch64)"
    return None


@unittest.skipIf(why_not(), why_not() or "")
class Aarch64(ProgramTest):
    budget = 1500
    tests = 10

    def test_nodes_of_a_run_decide_the_same(self):
        self.compared(node_program=emulated("swarmsmith-robot"))

    def test_a_simulated_world_has_the_same_score_and_last_state(self):
        rows = self.compared(world_program=emulated("swarmsmith-robot"))
        self.assertEqual(rows, self.compared())

    def compared(self, node_program=(robots.ROBOT,), world_program=(robots.ROBOT,)):
        """What the world says of a run with three nodes; `--compare` runs it in the world's process, too."""
        way = ZeroMq(command=node_program)
        words = ("--flavour", "watermelon")
        machine = machine_file(self, WATERMELON)
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        nodes = way.nodes(self, 3, machine, *words, "--lock-step", "senses", "--logs", folder)
        way.command = world_program
        world = way.program(self, "world", "--mission", "aggregation", "--seeds", "4", "--lock-step", "--compare",
                            "--machine", machine, *words, "--json")
        self.assertEqual(world.end(), 0, world.said() + "".join(node.said() for node in nodes))
        rows = world.rows()
        self.assertTrue(all(row["same_in_process"] for row in rows), rows)
        done = call("evaluate", machine, *words, "--mission", "aggregation", "--seeds", "4", "--json")
        self.assertEqual(rows[0]["score"], json.loads(done.stdout)["score"])
        for node in nodes:
            self.assertEqual(node.end(), 0, node.said())
        logs = sorted(folder.glob("*.log.csv"))
        self.assertEqual(len(logs), 3)
        for program in (node_program, world_program):
            replay = Process(self, [*program, "replay", *logs])
            self.assertEqual(replay.end(), 0, replay.said())
        return rows

    def test_a_campaign_with_bundles_of_both_kinds_has_one_digest(self):
        """The coordinator takes no worker whose self test has other bits."""
        if why := bundle_test.why_not():
            self.skipTest(why)
        local = self.folder / "local.db"
        ended_well(self.run_campaign(local, "--workers", "2"))
        store = self.folder / "both.db"
        coordinator, port = bundle_test.serve(self, store)
        where = ["--connect", f"tcp://127.0.0.1:{port}", "--slots", "1"]
        slow = bundle_test.unpacked(bundle_test.pack(self.folder, "aarch64", FOLDER), self.folder)
        fast = bundle_test.unpacked(bundle_test.pack(self.folder), self.folder)
        Process(self, [*emulated_bundle(slow), *where])
        # The slow one begins.
        robots.wait_for(lambda: self.query(store, "SELECT count(*) AS n FROM evaluation")[0]["n"], "an evaluation")
        Process(self, [fast / "swarmsmith-worker", *where])
        self.assertEqual(coordinator.end(), 0, coordinator.said())
        self.assertEqual(self.digest(store), self.digest(local))
        shares = self.query(store, "SELECT worker, count(*) AS n FROM evaluation WHERE worker IS NOT NULL GROUP BY worker")
        self.assertEqual(len([share for share in shares if share["n"] > 0]), 2, shares)


if __name__ == "__main__":
    unittest.main()
