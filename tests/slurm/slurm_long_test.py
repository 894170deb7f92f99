"""What takes Slurm minutes: a dead node and its requeue, jobs that are preempted, a coordinator
that is a job itself, workers that are sent along."""
import os
import pathlib
import subprocess
import unittest

from campaigns import SWARMSMITH, SlurmTest, wait_for
import bundle_test

EXAMPLES = pathlib.Path(os.environ.get("SWARMSMITH_SOURCE", ".")) / "examples/cluster"


class DeadNode(SlurmTest):
    budget = 2000
    repetitions = 1

    def test_the_only_worker_comes_back_two_minutes_after_its_node_died(self):
        process = self.run_on_slurm(workers="slurm:1x2")
        job = wait_for(self.running, "a job")[0]
        self.wait_for_stored(300, process)
        node = self.slurm.node_of(job)
        self.slurm.kill_node(node)
        self.slurm.call("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=test")
        wait_for(lambda: job in self.slurm.jobs("PENDING"), "the job in the queue again", 60)
        wait_for(lambda: job in self.running(), "its second start", 240, 1)
        # Slurm puts it back by itself; none is submitted beside it.
        self.assertEqual(self.live(), [job])
        other = self.slurm.node_of(job)
        self.finish(process)
        rows = self.query(self.store, "select host, job from worker")
        self.assertEqual({(row["host"], row["job"]) for row in rows},
                         {(node, job), (other, job + " restart 1")})


class Preempted(SlurmTest):
    budget = 3000
    repetitions = 1
    duration_s = 900
    # The signal that comes a minute before the time limit comes at once: jobs of some seconds.
    workers = ('launcher = "slurm"\n[workers.slurm]\njobs = 2\ncpus_per_task = 1\ntime = "1"\n'
               'options = ["--signal=B:TERM@45"]\n')

    def test_jobs_that_end_before_the_work_does_are_followed_by_others(self):
        process = self.start_coordinator("run", self.file, "--store", self.store)
        first = wait_for(lambda: len(self.running()) == 2 and self.running(), "two jobs")
        wait_for(lambda: set(first) <= set(self.slurm.jobs("COMPLETED")) or process.poll() is not
                 None, "their end, in good order", 90, 0.5)
        self.assertIsNone(process.poll(), "the campaign was too short for this test")
        second = wait_for(lambda: set(self.running()) - set(first), "others", 90, 0.5)
        self.assertTrue(second)
        self.finish(process, 600)  # jobs live a quarter of the time: a busy machine needs many
        rows = self.query(self.store, "select state, count(*) as n from worker group by state")
        self.assertNotIn("lost", {row["state"] for row in rows}, rows)


class SentAlong(SlurmTest):
    budget = 1500
    repetitions = 1
    nodes = 1
    duration_s = 20

    def test_workers_are_sent_along(self):
        if why := bundle_test.why_not():
            self.skipTest(why)
        bundles, cache = self.folder / "the bundles", self.folder / "a cache"
        bundle_test.pack(bundles)
        self.slurm.environment |= {"SWARMSMITH_BUNDLES": str(bundles), "XDG_CACHE_HOME": str(cache)}
        self.finish(self.run_on_slurm("--ship", workers="slurm:2x1"))
        place, = (cache / "swarmsmith").iterdir()
        script = (self.folder / "a store.db.slurm/worker.sh").read_text()
        self.assertIn(place.name, script)
        self.assertNotIn(str(pathlib.Path(SWARMSMITH).parent), script)
        # A node that does not see the cache says so.
        place.rename(self.folder / "elsewhere")
        done = subprocess.run(["sh", self.folder / "a store.db.slurm/worker.sh"], capture_output=True, text=True, timeout=60)
        self.assertIn(f"{place.parent} on {os.uname().nodename} has no worker for {os.uname().machine}", done.stderr)


class CoordinatorAsAJob(SlurmTest):
    budget = 3000
    repetitions = 1

    def test_it_goes_on_where_it_was_after_a_requeue_and_a_kill(self):
        shared = self.folder / "shared"
        shared.mkdir()
        self.keys.rename(shared / "keys")
        del self.slurm.environment["SWARMSMITH_KEYS"]
        bin_folder = str(pathlib.Path(SWARMSMITH).parent)
        self.slurm.environment.update(
            PATH=bin_folder + ":" + self.slurm.environment["PATH"], CAMPAIGN=str(self.file),
            STORE=str(self.store), SHARED=str(shared))
        coordinator = self.slurm.call("sbatch", "--parsable", "--nodelist=n1", "--output",
                                      str(self.folder / "coordinator.log"),
                                      str(EXAMPLES / "coordinator.sbatch"))
        log = self.folder / "coordinator.log"
        # Workers wait for the coordinator's file, if they come first.
        workers = self.slurm.call("sbatch", "--parsable", "--array=0-1", "--cpus-per-task=1",
                                  "--output", str(self.folder / "worker-%a.log"),
                                  str(EXAMPLES / "worker.sbatch"))
        wait_for(lambda: self.stored() >= 600, "600 evaluations", 120, 0.5)
        address = (shared / "coordinator").read_text()

        self.slurm.call("scontrol", "requeue", coordinator)
        wait_for(lambda: coordinator in self.running() and self.restarts(coordinator) == "1",
                 "its second start", 300, 1)
        before = self.stored()
        wait_for(lambda: self.stored() >= before + 300, "more evaluations: " + log.read_text(),
                 120, 0.5)
        self.assertNotEqual((shared / "coordinator").read_text(), address)

        # A signal before its time limit: it puts itself back into the queue.
        self.slurm.call("scancel", "--signal=USR1", "--batch", coordinator)
        wait_for(lambda: self.restarts(coordinator) == "2" and coordinator in self.running(),
                 "its third start", 300, 1)
        wait_for(lambda: coordinator in self.slurm.jobs("COMPLETED"), "its end", 300, 1)
        wait_for(lambda: not self.live(), "the end of the workers, which it sends home", 30)
        self.assertEqual({job for job in self.slurm.jobs("COMPLETED")},
                         {coordinator, workers + "_0", workers + "_1"})
        self.assert_clean(self.store)
        self.assertEqual(self.digest(self.store), self.expected())

    def restarts(self, job):
        shown = self.slurm.call("scontrol", "show", "job", job)
        return shown.split("Restarts=")[1].split()[0]


if __name__ == "__main__":
    unittest.main()
