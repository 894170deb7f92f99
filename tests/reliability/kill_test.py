"""kill -9 of workers and coordinator, at any moment and beside an ordinary client of the store: the
same answer, and every promise is kept."""
import json
import random
import signal
import subprocess
import unittest

from beside import Beside, Onlookers
from rig import (BIN, LONG, SWARMSMITH, FaultTest, calls_in, children_of, ended_well, events, rows,
                 send, stored, wait_for)

PRELOAD = str(BIN / "faulty_calls.so")


class Kill(Beside):
    budget = 8000 if LONG else 2000
    designs = 2
    kills = 24 if LONG else 8

    def setUp(self):
        super().setUp()
        self.hold()

    def moments(self, rng):
        """At most so many moments of the campaign, each after some results of its first design."""
        step = self.budget // (self.kills + 3)
        before = 0
        while before < self.budget - 3 * step:
            self.wait_stored(before + rng.randrange(1, 2 * step))
            yield
            before = max(before + step, stored(self.store))

    def test_workers_at_random(self):
        """Each dead one is replaced at once, as a batch system would."""
        serve = self.serve()
        workers = [self.worker(serve.address()) for _ in range(3)]
        rng = random.Random(1)
        killed = 0
        for _ in self.moments(rng):
            one = rng.randrange(len(workers))
            workers[one].kill()
            workers[one] = self.worker(serve.address())
            killed += 1
        self.count("worker killed", killed)
        numbers = self.finish(serve)
        self.assertEqual(events(self.store, "evaluation rejected"), [], "a task was blamed")
        # Not the workers: one that came too late finds no coordinator, and looks on for ten minutes.
        self.assert_killed(killed, numbers)

    def test_local_workers_at_random(self):
        run = self.run_local("--workers", "2")
        rng = random.Random(7)
        killed = 0
        for _ in self.moments(rng):
            workers = children_of(run.pid)
            if workers:
                send(rng.choice(workers), signal.SIGKILL)
                killed += 1
        self.count("local worker killed", killed)
        self.assert_killed(killed, self.finish(run))

    def assert_killed(self, killed, numbers):
        lost = events(self.store, "worker lost")
        self.assertGreater(len(lost), 0)
        self.assertLessEqual(len(lost), killed)
        self.assertEqual(numbers["lost_workers"], len(lost))
        self.assertEqual({event["how"] for event in lost}, {"connection closed"})
        self.assertEqual(numbers["rejected"], 0, "a task was blamed")

    def test_leases_of_a_dead_worker_come_back_at_once(self):
        serve = self.serve()
        workers = [self.worker(serve.address()) for _ in range(2)]
        self.wait_stored(500)
        workers[0].kill()
        # By its connection, not by its silence: no wait for a lease's end.
        [lost] = wait_for(lambda: events(self.store, "worker lost"), "the loss of a killed worker")
        self.assertEqual(lost["how"], "connection closed")
        self.count("worker killed", 1)
        numbers = self.finish(serve, workers[1:])
        self.assertEqual(numbers["expired"], 0)

    def test_coordinator_at_random(self):
        serve = self.serve()
        address = serve.address()
        proxy = self.overhear(address)
        workers = [self.worker(proxy.address) for _ in range(2)]
        rng = random.Random(2)
        before = 0
        for _ in self.moments(rng):
            serve.kill()
            self.count("coordinator killed")
            self.assert_promises_are_kept()
            now = stored(self.store)
            self.assertGreaterEqual(now, before, "a stored result was lost")
            before = now
            serve = self.serve(bind=address)
        # Who is away at the end looks on for ten minutes: nothing ends before both are back.
        wait_for(lambda: serve.progress().get("workers") == 2, "both workers", 30)
        self.finish(serve, workers)
        self.assert_promises_are_kept()
        self.assertEqual({row[0] for row in rows(self.store, "select pid from worker")},
                         {worker.pid for worker in workers}, "a worker did not reconnect")

    def test_both_at_once(self):
        rng = random.Random(3)
        before = 0
        for _ in range(10 if LONG else 3):
            run = self.run_local("--workers", "2")
            self.wait_stored(min(before + rng.randrange(1, 600), 0.9 * self.budget))
            for pid in [run.pid, *children_of(run.pid)]:
                send(pid, signal.SIGKILL)
            run.kill()
            self.count("coordinator and workers killed")
            self.assertGreaterEqual(stored(self.store), before, "a stored result was lost")
            before = stored(self.store)
        self.finish(self.run_local("--workers", "2"))

    def test_interrupted_and_run_again(self):
        run = self.run_local("--workers", "2")
        self.wait_stored(500)
        run.send(signal.SIGINT)
        self.assertEqual(run.wait(60), 130)
        self.count("interrupted", 1)
        done = subprocess.run([str(SWARMSMITH), "status", str(self.store), "--json"], text=True,
                              capture_output=True, timeout=60, check=True)
        status = json.loads(done.stdout)
        self.assertEqual(status["campaign"]["state"], "interrupted")
        self.assertEqual(status["workers"], 0)
        self.assertFalse({"racing", "testing"} & {d["state"] for d in status["designs"]})
        self.finish(self.run_local("--workers", "3"))
        again = self.run_local()
        self.assertEqual(again.wait(60), 0)
        self.assertIn("--nstates", again.out.read_text())


class KillBeside(Beside):
    """Coordinator and workers are killed again and again while people look at the store, and tell it
    to pause and to go on: whatever was acknowledged or confirmed is there after each kill."""

    budget = 16000 if LONG else 2000
    designs = 2
    kills = 50 if LONG else 8

    def setUp(self):
        super().setUp()
        self.hold()
        self.rng = random.Random(11)
        self.coordinator = self.serve()
        self.address = self.coordinator.address()
        self.proxy = self.overhear(self.address)
        self.workers = [self.worker(self.proxy.address) for _ in range(2)]

    def test_beside_an_ordinary_client(self):
        self.kill_all_the_time()

    def test_beside_backup_status_report_and_dashboard(self):
        with Onlookers(self) as people:
            self.kill_all_the_time()
        self.assertEqual(people.crashes, [])

    def kill_all_the_time(self):
        step = self.budget // (self.kills + 10)
        for n in range(self.kills):
            self.wait_stored(min(stored(self.store) + self.rng.randrange(1, step), 0.9 * self.budget))
            if n % 4 == 3:
                self.pause_or_resume()
            if n % 2 == 0 or n % 5 == 0:
                self.kill_coordinator()
            if n % 2 == 1:
                self.kill_worker()
        self.assert_promises_are_kept()
        self.finish(self.coordinator)
        self.assert_promises_are_kept()

    def kill_coordinator(self):
        self.coordinator.kill()
        self.count("coordinator killed")
        self.assert_promises_are_kept()
        self.coordinator = self.serve(bind=self.address)

    def kill_worker(self):
        one = self.rng.randrange(len(self.workers))
        self.workers[one].kill()
        self.count("worker killed")
        self.workers[one] = self.worker(self.proxy.address)

    def pause_or_resume(self):
        """Killed right after it has confirmed."""
        for kind in ("pause", "resume"):
            ended_well(self.ask(kind, "d1"))
            self.kill_coordinator()


class KillAfterCommands(Beside):
    """Commands that change the answer: whatever was confirmed acts, though the coordinator died."""
    budget = 2000
    designs = 2

    def wanted(self):
        """Not what the campaign without the commands asks for; the store says it in the end."""
        return set()

    def test_extend_and_cancel_outlive_the_coordinator(self):
        self.hold()
        serve = self.serve()
        address = serve.address()
        proxy = self.overhear(address)
        worker = self.worker(proxy.address, slots=2)
        for kind, words in (("extend", ("d1", "--budget", "500")), ("cancel", ("d2",))):
            self.wait_stored(min(stored(self.store) + 200, 0.9 * self.budget))
            ended_well(self.ask(kind, *words))
            serve.kill()
            self.count("coordinator killed")
            self.assert_promises_are_kept()
            serve = self.serve(bind=address)
        serve.wait()
        self.assertEqual(worker.wait(30), 0, worker.tail())
        self.assert_promises_are_kept()
        self.assert_clean(self.store)
        used = dict(rows(self.store, "select design, used from v_designs"))
        self.assertGreater(used[1], self.budget, "the extension was forgotten")
        self.assertLess(used[2], self.budget * 0.9, "the cancellation was forgotten")


class KillAtPoints(Beside):
    """At the n-th write, sync and message of the coordinator, before and after it: a commit is a
    sync, an acknowledgement a message, and the first and last ones are the birth of the store, the
    first leases, the winner and the end."""
    budget = 3000

    def test_at_calls(self):
        log = self.folder / "calls"
        self.once({"SWARMSMITH_FAULT_LOG": str(log)}, 0)
        self.assert_same_answer()
        calls = calls_in(log)
        rng = random.Random(4)
        for call in ("write", "sync", "send"):
            most = calls[call]
            self.assertGreater(most, 12, calls)
            points = {1, 2, 3, most // 2, most - 2, most - 1, most}
            points |= {rng.randrange(1, most) for _ in range(3)}
            for n in sorted(points):
                for when in ("before", "after"):
                    with self.subTest(call=call, n=n, when=when):
                        self.kill_at(f"kill-{when}={call}:{n}")

    def kill_at(self, fault):
        # A store of its own: the client may still have the last one open.
        self.store.unlink(missing_ok=True)
        self.store = self.folder / f"{fault.replace(':', '-')}.db"
        self.forget()
        ended = self.once({"SWARMSMITH_FAULT": fault}, None)
        # The last calls of another run may never come: then it ended well.
        self.assertIn(ended, (-signal.SIGKILL, 0))
        if ended != 0:
            self.count("coordinator killed at a call")
            if self.store.exists():
                self.assert_promises_are_kept()
            self.once({}, 0)
        self.assert_same_answer()

    def once(self, env, wanted):
        """A coordinator with the library, and a worker without."""
        if env:
            env = {**env, "LD_PRELOAD": PRELOAD}
        serve = self.serve(env=env, wait=False)
        worker = None
        wait_for(lambda: serve.address() or not serve.alive(), "a coordinator")
        if serve.alive():
            proxy = self.overhear(serve.address())
            worker = self.worker(proxy.address, slots=2)
        ended = serve.wait(60)
        if worker is not None:
            worker.kill()
            proxy.close()
        if wanted is not None:
            self.assertEqual(ended, wanted, serve.tail())
        return ended


class AnyNumberOfWorkers(FaultTest):
    budget = 4000

    def test_three_give_the_answer_of_one(self):
        self.finish(self.run_local("--workers", "3"))

    def test_they_may_come_late_and_leave_early(self):
        serve = self.serve()
        first = self.worker(serve.address())
        self.wait_stored(300)
        second = self.worker(serve.address(), slots=2)
        self.wait_stored(1000)
        first.send(signal.SIGTERM)
        self.assertEqual(first.wait(30), 0, first.tail())
        numbers = self.finish(serve, [second])
        self.assert_none(numbers, "expired", "lost_workers")


if __name__ == "__main__":
    unittest.main()
