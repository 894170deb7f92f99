"""One campaign, disturbed in every way that a lab knows, gives one answer."""
import os
import random
import signal
import time
import unittest

from programs import ProgramTest, children_of, send

LONG = os.environ.get("SWARMSMITH_LONG") == "1"


class Survival(ProgramTest):
    budget = 5000
    reference = None

    def expected(self):
        """Digest of the undisturbed campaign with one worker, computed once."""
        if Survival.reference is None:
            store = self.folder / "reference.db"
            done = self.run_campaign(store, "--workers", "1")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assert_clean(store)
            Survival.reference = self.digest(store)
        return Survival.reference

    def assert_same(self, store):
        self.assert_clean(store)
        self.assertEqual(self.digest(store), self.expected())

    def test_three_workers_give_the_answer_of_one(self):
        store = self.folder / "three.db"
        done = self.run_campaign(store, "--workers", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(store)

    def test_a_worker_killed_every_second_changes_nothing(self):
        store = self.folder / "killed.db"
        process = self.start_campaign(store, "--workers", "2")
        killed = 0
        while process.poll() is None:
            try:
                process.wait(timeout=0.3 if killed == 0 else 1)
            except Exception:
                workers = children_of(process.pid)
                if workers:
                    send(random.choice(workers), signal.SIGKILL)
                    killed += 1
        self.assertEqual(process.returncode, 0)
        self.assertGreater(killed, 0, "the campaign ended before a worker could be killed")
        self.assert_same(store)

    def test_a_coordinator_killed_twenty_times_goes_on_where_it_was(self):
        store = self.folder / "coordinator.db"
        rng = random.Random(1)
        acknowledged = 0
        for _ in range(20):
            process = self.start_campaign(store, "--workers", "2")
            try:
                process.wait(timeout=rng.uniform(0.05, 0.6))
            except Exception:
                send(process.pid, signal.SIGKILL)
                process.wait()
            if store.exists():
                stored = self.stored(store)
                self.assertGreaterEqual(stored, acknowledged, "a stored result was lost")
                acknowledged = stored
        done = self.run_campaign(store, "--workers", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(store)

    def stored(self, store):
        """Evaluations on disk; 0 while the killed process had not made the schema yet."""
        from programs import call
        import json
        done = call("query", store, "select count(*) as n from evaluation", "--json")
        return json.loads(done.stdout)["rows"][0]["n"] if done.returncode == 0 else 0

    def test_a_stopped_worker_is_waited_for_or_replaced(self):
        store = self.folder / "stopped.db"
        process = self.start_campaign(store, "--workers", "2")
        deadline = time.monotonic() + 20
        while process.poll() is None and not children_of(process.pid):
            if time.monotonic() > deadline:
                self.fail("no worker was started")
            time.sleep(0.01)
        time.sleep(0.3)
        workers = children_of(process.pid)
        for worker in workers[:1]:
            send(worker, signal.SIGSTOP)
        # Long enough to be taken for dead (5 s), so that its leases go to the other one.
        try:
            process.wait(timeout=10 if LONG else 6)
        except Exception:
            pass
        for worker in workers[:1]:
            send(worker, signal.SIGCONT)
        self.assertEqual(process.wait(timeout=300), 0)
        self.assert_same(store)

    def test_interrupted_and_run_again_gives_the_same_answer(self):
        store = self.folder / "interrupted.db"
        process = self.start_campaign(store, "--workers", "2")
        try:
            process.wait(timeout=0.7)
        except Exception:
            send(process.pid, signal.SIGINT)
        self.assertIn(process.wait(timeout=60), (130, 0))
        done = self.run_campaign(store, "--workers", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(store)
        again = self.run_campaign(store)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("--nstates", again.stdout)


if __name__ == "__main__":
    unittest.main()
