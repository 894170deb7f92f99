"""A campaign on a real Slurm of four nodes gives the answer of a laptop, whatever happens."""
import signal
import subprocess
import unittest

from campaigns import PATIENCE, SWARMSMITH, SlurmTest, send, wait_for


class Campaign(SlurmTest):
    def test_half_of_the_jobs_cancelled_and_the_coordinator_killed(self):
        process = self.run_on_slurm()
        jobs = wait_for(lambda: len(self.running()) == 4 and self.running(), "four jobs")
        self.wait_for_stored(1500, process)
        for job in jobs[:2]:
            self.slurm.call("scancel", job)
        cancelled = wait_for(lambda: len(self.slurm.jobs("CANCELLED")) == 2, "their end", 20)
        self.assertTrue(cancelled)
        self.wait_for_stored(4000, process)
        # A person who cancels jobs wants fewer of them.
        self.assertEqual(len(self.live()), 2)

        send(process.pid, signal.SIGKILL)
        process.wait()
        self.assertEqual(len(self.running()), 2, "workers wait for their coordinator")
        process = self.run_on_slurm()
        self.wait_for_stored(5000, process)
        # The two that were still there are found, and two more submitted.
        wait_for(lambda: len(self.live()) == 4, "four jobs again")
        self.assertEqual(set(jobs[2:]) - set(self.live()), set())
        self.finish(process)
        rows = self.query(self.store, "select host, job, cpu from worker")
        self.assertLessEqual({row["host"] for row in rows}, set(self.slurm.nodes))
        self.assertLessEqual(set(jobs), {row["job"] for row in rows})
        self.assertTrue(all(row["cpu"] for row in rows), rows)

    def test_cancelled_workers_say_goodbye_and_more_may_come_by_hand(self):
        process = self.run_on_slurm(workers="slurm:2x1")
        jobs = wait_for(lambda: len(self.running()) == 2 and self.running(), "two jobs")
        self.wait_for_stored(500, process)
        script = self.folder / "a store.db.slurm/worker.sh"
        self.slurm.call("sbatch", "--array=0-1", str(script))
        wait_for(lambda: len(self.running()) == 4, "two more by hand")
        for job in jobs:
            self.slurm.call("scancel", job)
        wait_for(lambda: len(self.running()) == 2, "the end of the first two", 20)
        # A drained worker is not a lost one.
        wait_for(lambda: self.workers_by_state().get("left") == 2, "two goodbyes", 20)
        self.assertNotIn("lost", self.workers_by_state())
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        wait_for(lambda: not self.live(), "the end of all jobs", 20)

    def workers_by_state(self):
        rows = self.query(self.store, "select state, count(*) as n from worker group by state")
        return {row["state"]: row["n"] for row in rows}


class Refusals(SlurmTest):
    nodes = 1

    def refused(self, workers, **environment):
        self.file.write_text(self.text(workers))
        done = subprocess.run([SWARMSMITH, "run", str(self.file), "--store",
                               str(self.store)], capture_output=True, text=True, timeout=60,
                              env={**self.slurm.environment, **environment})
        self.assertEqual(done.returncode, 5, done.stderr)
        return done.stderr

    def test_what_slurm_refuses_is_said_in_its_words(self):
        self.assertIn("slurm: Slurm refuses jobs: invalid partition specified: nowhere",
                      self.refused('launcher = "slurm"\n[workers.slurm]\npartition = "nowhere"\n'))
        self.assertIn("unrecognized option '--colour=red'", self.refused(
            'launcher = "slurm"\n[workers.slurm]\noptions = ["--colour=red"]\n'))
        self.assertIn("sbatch: this host has no such program",
                      self.refused('launcher = "slurm"\n', PATH="/nonexistent"))

    def test_jobs_that_can_never_start_are_pointed_out(self):
        process = self.run_on_slurm(workers="slurm:1x99")
        wait_for(lambda: "Slurm holds jobs back (PartitionConfig)" in self.said.read_text(),
                 "the reason")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        wait_for(lambda: not self.live(), "the end of all jobs", 20)

    def test_a_full_cluster_is_waited_for(self):
        blocker = self.slurm.call("sbatch", "--parsable", "--cpus-per-task=2", "--wrap",
                                  "exec sleep 600")
        wait_for(lambda: blocker in self.running(), "the job of another user")
        process = self.run_on_slurm(workers="slurm:1x2")
        wait_for(lambda: self.slurm.jobs("PENDING"), "our job in the queue")
        self.assertIsNone(process.poll())
        self.slurm.call("scancel", blocker)
        self.wait_for_stored(100, process)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 143, self.said.read_text())
        wait_for(lambda: not self.live(), "the end of all jobs", 20)


if __name__ == "__main__":
    unittest.main()
