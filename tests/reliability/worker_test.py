"""Clocks that jump, slow workers, programs that fail, wrong builds, storms and crowds."""
import os
import pathlib
import random
import shutil
import signal
import sys
import time
import unittest

from rig import BIN, FaultTest, children_of, events, rows, send, stored, wait_for


class Clocks(FaultTest):
    """libfaketime between the program and the clock; leases must not care."""
    budget = 8000

    def setUp(self):
        super().setUp()
        found = list(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
        if not found:
            self.skipTest("skipped: no libfaketime (Debian package libfaketime)")
        self.time = self.folder / "time"
        self.env = {"LD_PRELOAD": str(found[0]), "FAKETIME_TIMESTAMP_FILE": str(self.time),
                    "FAKETIME_NO_CACHE": "1"}
        self.set(0)

    def set(self, seconds):
        """The clock's distance from the true one; the file is read all the time."""
        new = self.folder / "time.new"
        new.write_text(f"{seconds:+d}\n")
        new.rename(self.time)

    def jump(self, env, of_workers):
        """The fleet under a clock that jumps by hours, forwards and back."""
        serve = self.serve(env=None if of_workers else env)
        workers = [self.worker(serve.address(), env=env if of_workers else None) for _ in range(2)]
        for n, hours in enumerate((5, -7, 0, 30, -2)):
            self.wait_stored(300 + n * 1000)
            self.set(hours * 3600)
            self.count("clock jump")
            time.sleep(0.5)
        numbers = self.finish(serve, workers)
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        return numbers

    def test_wall_clock_of_the_coordinator(self):
        numbers = self.jump({**self.env, "DONT_FAKE_MONOTONIC": "1"}, of_workers=False)
        self.assert_none(numbers, "expired", "lost_workers")

    def test_wall_clock_of_the_workers(self):
        numbers = self.jump({**self.env, "DONT_FAKE_MONOTONIC": "1"}, of_workers=True)
        self.assert_none(numbers, "expired", "lost_workers")


class SlowWorkers(FaultTest):
    budget = 12000

    def test_a_hundred_times_slower(self):
        """One of two runs 5 ms of every 500: it is alive, and late with all that it does. The other
        one is given second copies of its tasks, so that steps do not wait: how much sooner the
        end comes, tests/cluster tells by a simulated clock."""
        serve = self.serve()
        slow, fast = (self.worker(serve.address()) for _ in range(2))
        self.wait_stored(300)
        began = time.monotonic()
        while serve.alive() and time.monotonic() < began + 100:
            slow.send(signal.SIGSTOP)
            time.sleep(0.495)
            slow.send(signal.SIGCONT)
            time.sleep(0.005)
        slow.send(signal.SIGCONT)
        self.count("slow worker")
        numbers = self.finish(serve, [slow, fast])
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        took = time.monotonic() - began
        [[copies]] = rows(self.store,
                          "select count(*) from v_attempts where outcome = 'second copy'")
        print(f"\n  {took:.1f} s, {copies} second copies", end="")
        self.assertGreater(copies, 0)


RUNNER = """\
#!/bin/sh
# The example's target-runner, with faults: once for each call that is to fail, or always.
key=$(( ($1 * 7 + ${2%t} * 3 + $3) % 40 ))
call="$PLANTED/$1-$2-$3"
if [ -n "$PLANTED" ] && [ $key -lt 5 ] && mkdir "$call" 2>/dev/null; then
  case $key in
    0) kill -SEGV $$ ;;
    1) echo NaN; exit 0 ;;
    2) echo "out of luck" >&2; exit 3 ;;
    3) ulimit -v 400000; exec {python} -c 'x = bytearray(1 << 30)' ;;
    4) sleep 1000 ;;
  esac
fi
if [ -n "$PLANTED_FOR_GOOD" ] && [ $(( $1 % 9 )) -eq 4 ]; then kill -ABRT $$; fi
exec ./example-runner "$@"
"""


class Programs(FaultTest):
    """Evaluations by programs that crash, hang, take all memory, or say nonsense."""

    def setUp(self):
        super().setUp()
        self.programs = self.folder / "programs"
        shutil.copytree(pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "examples" / "target",
                        self.programs)
        (self.programs / "target-runner").rename(self.programs / "example-runner")
        runner = self.programs / "target-runner"
        runner.write_text(RUNNER.replace("{python}", sys.executable))
        runner.chmod(0o755)
        self.file = self.programs / "campaign.toml"
        self.file.write_text(self.file.read_text().replace("max_experiments = 400",
                                                           "max_experiments = 300")
                             + 'retries = 2\ntimeout = "3 s"\n[workers]\non_failure = "reject"\n')
        self.planted = self.folder / "planted"
        self.planted.mkdir()

    def expected(self):
        """With the same faults for good, if any, and none besides, on one worker."""
        keep, self.store = self.store, self.folder / "undisturbed.db"
        run = self.run_local("--workers", "1", env=self.for_good)
        self.assertEqual(run.wait(), 0, run.tail())
        self.assert_clean(self.store)
        digest = self.digest(self.store)
        self.store = keep
        return digest

    for_good = {}

    def test_what_fails_once_leaves_no_trace(self):
        run = self.run_local("--workers", "2", env={"PLANTED": str(self.planted)})
        self.finish(run)
        failed = len(list(self.planted.iterdir()))
        self.count("call that crashed, hung, took all memory or printed no number", failed)
        self.assertGreater(failed, 10)

    def test_what_fails_always_is_rejected_and_the_rest_goes_on(self):
        self.for_good = {"PLANTED_FOR_GOOD": "1"}
        run = self.run_local("--workers", "3", env=self.for_good)
        numbers = self.finish(run)
        self.assertGreater(numbers["rejected"], 0)
        self.count("evaluation rejected", numbers["rejected"])
        reasons = rows(self.store, "select distinct reason from failure")
        self.assertTrue(all("SIGABRT" in reason for [reason] in reasons), reasons)

    def test_worker_killed_while_programs_run(self):
        run = self.run_local("--workers", "2")
        rng = random.Random(1)
        while run.alive() and self.tried.get("worker killed", 0) < 6:
            before = stored(self.store)
            wait_for(lambda: not run.alive() or stored(self.store) > before + 20, "evaluations")
            workers = children_of(run.pid)
            if workers:
                send(rng.choice(workers), signal.SIGKILL)
                self.count("worker killed")
        self.finish(run)


class Builds(FaultTest):
    budget = 4000

    def test_a_worker_of_another_build_is_sent_away(self):
        serve = self.serve()
        other = self.worker(serve.address(), program=str(BIN / "swarmsmith-worker-other"))
        self.assertEqual(other.wait(30), 7, other.tail())
        self.assertIn("self test", other.log())
        self.count("worker of another build")
        self.finish(serve, [self.worker(serve.address())])
        self.assertEqual(len(events(self.store, "worker refused")), 1)
        self.assertEqual(len(rows(self.store, "select id from worker")), 1)


class Drain(FaultTest):
    budget = 40000

    def test_sixty_four_workers_are_told_to_end_at_once(self):
        """As when an array is cancelled: all that they hold comes back at once."""
        serve = self.serve()
        workers = [self.worker(serve.address()) for _ in range(64)]
        wait_for(lambda: serve.progress().get("workers", 0) == 64 or not serve.alive(),
                 "64 workers", 120)
        self.assertTrue(serve.alive(), "it ended before all workers had come")
        for worker in workers:
            worker.send(signal.SIGTERM)
        for worker in workers:
            self.assertEqual(worker.wait(60), 0, worker.tail())
        self.count("worker drained", len(workers))
        wait_for(lambda: serve.progress().get("workers") == 0, "no worker", 10)
        numbers = serve.progress()
        self.assert_none(numbers, "leased", "expired", "lost_workers")
        numbers = self.finish(serve, [self.worker(serve.address(), slots=2)], seconds=600)
        self.assert_none(numbers, "expired", "lost_workers")
        self.assertEqual(events(self.store, "worker lost"), [])


class Crowd(FaultTest):
    budget = 20000
    size = 1000

    def memory_kb(self, pid, what="VmRSS"):
        text = pathlib.Path(f"/proc/{pid}/status").read_text()
        return next(int(line.split()[1]) for line in text.splitlines() if line.startswith(what))

    def cpu_s(self, pid):
        words = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(") ", 1)[1].split()
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def test_a_thousand_workers(self):
        serve = self.serve()
        alone = self.memory_kb(serve.pid)
        crowd = self.start("crowd", BIN / "crowd", serve.address(), self.size, 100)
        wait_for(lambda: serve.progress().get("workers", 0) == self.size or not serve.alive()
                 or not crowd.alive(), "a thousand workers", 120)
        self.assertTrue(serve.alive() and crowd.alive(), serve.tail() + crowd.tail())
        memory = self.memory_kb(serve.pid, "VmHWM")
        cpu = 0
        while serve.alive():
            try:
                cpu = self.cpu_s(serve.pid)
            except (OSError, IndexError):
                break
            time.sleep(0.1)
        numbers = self.finish(serve, [crowd])
        print(f"\n  coordinator: {alone} kB alone, {memory} kB with {self.size} workers, "
              f"{cpu:.1f} s of CPU for {numbers['done']} evaluations", end="")
        self.count("worker in a crowd", self.size)
        self.assertEqual((numbers["failed"], numbers["lost_workers"]), (0, 0))
        # 30 kB of buffers a connection, and room for a busy machine.
        self.assert_memory(memory - alone, 150 * self.size)


if __name__ == "__main__":
    unittest.main()
