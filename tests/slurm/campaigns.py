"""Campaigns whose workers come from Slurm."""
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))
sys.dont_write_bytecode = True

import one_host
from one_host import OneHostSlurm, wait_for
from programs import PATIENCE, SWARMSMITH, ProgramTest, call, campaign_text, ended_well, send


def cluster_text(budget, repetitions, duration_s, workers):
    """Two missions whose evaluations last, and who evaluates them."""
    return campaign_text(budget, seed=11, tests=None, name="cluster", repetitions=repetitions, store=None,
                         missions=("aggregation", "grid_exploration"), duration=f"{duration_s} s",
                         methods=['name = "watermelon"'], more=f"[workers]\n{workers}\n")


class SlurmTest(ProgramTest):
    """A cluster of four nodes, a campaign file, and the answer of a laptop."""

    budget = 3000
    repetitions = 2
    nodes = 4
    workers = ""
    duration_s = 240

    def setUp(self):
        why = one_host.why_not()
        if why:
            self.skipTest(why)
        super().setUp()
        self.file.write_text(self.text(self.workers))
        self.slurm = OneHostSlurm(self.nodes)
        self.addCleanup(self.slurm.stop)
        self.slurm.start()
        # As a lab does it: keys, all interfaces, and a free port each time, which the coordinator's
        # file tells. A blank in every path of the batch script.
        self.keys = self.folder / "the keys"
        ended_well(call("keygen", self.keys))
        self.slurm.environment["SWARMSMITH_KEYS"] = str(self.keys)
        self.store = self.folder / "a store.db"

    def text(self, workers):
        return cluster_text(self.budget, self.repetitions, self.duration_s, workers)

    def expected(self):
        """Digest of the same campaign on this host alone."""
        local = self.folder / "local.db"
        ended_well(self.run_campaign(local, "--workers", "2"))
        return self.digest(local)

    def start_coordinator(self, *words):
        """`swarmsmith WORDS`, with the cluster's environment, its errors in `said`."""
        self.said = self.folder / "said.txt"
        with open(self.said, "a") as said:
            process = subprocess.Popen([SWARMSMITH, *map(str, words)], stderr=said,
                                       stdout=subprocess.DEVNULL,
                                       env=self.slurm.environment, start_new_session=True)
        self.addCleanup(self._end, process)
        return process

    def run_on_slurm(self, *words, workers="slurm:4x1"):
        return self.start_coordinator("run", self.file, "--store", self.store, "--workers",
                                      workers, *words)

    def stored(self):
        """Evaluations on disk; 0 as long as there is no schema."""
        done = call("query", "--store", self.store, "--json",
                    "select count(*) as n from evaluation")
        return json.loads(done.stdout)["rows"][0]["n"] if done.returncode == 0 else 0

    def query(self, store, sql):
        done = ended_well(call("query", "--store", store, "--json", sql))
        return json.loads(done.stdout)["rows"]

    def wait_for_stored(self, count, process, limit_s=120):
        def there():
            self.assertIsNone(process.poll(), "it ended too early:\n" + self.said.read_text())
            return self.stored() >= count
        wait_for(there, f"{count} evaluations in the store\n{self.said.read_text()}", limit_s, 0.2)

    def running(self):
        return self.slurm.jobs("RUNNING")

    def live(self):
        return self.slurm.jobs("RUNNING", "PENDING", "CONFIGURING")

    def finish(self, process, limit_s=240):
        """To the end: the answer of a laptop, and no job left."""
        self.assertEqual(process.wait(timeout=limit_s * PATIENCE), 0, self.said.read_text())
        self.assert_clean(self.store)
        self.assertEqual(self.digest(self.store), self.expected())
        wait_for(lambda: not self.live(), "the end of all jobs", 20)
