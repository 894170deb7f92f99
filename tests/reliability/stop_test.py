"""SIGSTOP, a while, SIGCONT: no worker is blamed, nothing is lost, and no storm follows."""
import pathlib
import signal
import time
import unittest

from beside import Beside
from rig import events, wait_for


def connections_to(address):
    """How many TCP connections the port of the address has."""
    port = f":{int(address.rsplit(':', 1)[1]):04X}"
    rows = [line.split() for line in pathlib.Path("/proc/net/tcp").read_text().splitlines()[1:]]
    return sum(local.endswith(port) and state == "01" for _, local, _, state, *_ in rows)


class Stopping(Beside):
    budget = 2000
    designs = 2

    def fleet(self):
        self.hold()
        serve = self.serve()
        workers = [self.worker(serve.address()) for _ in range(2)]
        self.wait_stored(500)
        return serve, workers

    def stop(self, programs, seconds):
        for program in programs:
            program.send(signal.SIGSTOP)
        time.sleep(seconds)
        for program in programs:
            program.send(signal.SIGCONT)
            self.count(f"{program.name.split('-')[1]} stopped for {seconds} s")

    def finish_unblamed(self, serve, workers):
        # One that waits before it tries again would not hear that the campaign is over.
        wait_for(lambda: connections_to(serve.address()) == len(workers), "the return of all workers", 60)
        numbers = self.finish(serve, workers)
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        # What was held when it stopped may come twice; more would be a storm.
        self.assertLess(numbers["duplicates"], 500)
        self.assertLess(numbers["requeued"], 1500)
        return numbers


class Stop(Stopping):
    def test_coordinator_then_workers(self):
        """The workers for longer than the 5 s after which they are taken for dead."""
        serve, workers = self.fleet()
        self.stop([serve], 2)
        self.wait_stored(1500)
        self.stop(workers, 6)
        self.finish_unblamed(serve, workers)
        lost = events(self.store, "worker lost")
        self.assertEqual([event["how"] for event in lost], ["silent", "silent"])


class StopLong(Stopping):
    """Shorter and longer than the 5 s after which a silent worker is taken for dead."""
    times = (1, 10, 60)

    def test_workers(self):
        for seconds in self.times:
            with self.subTest(seconds=seconds):
                self.store = self.folder / f"workers-{seconds}.db"
                serve, workers = self.fleet()
                self.stop(workers, seconds)
                self.finish_unblamed(serve, workers)
                lost = events(self.store, "worker lost")
                if seconds > 5:
                    self.assertEqual({event["how"] for event in lost}, {"silent"})
                    self.assertEqual(len(lost), 2)

    def test_coordinator(self):
        for seconds in self.times:
            with self.subTest(seconds=seconds):
                self.store = self.folder / f"coordinator-{seconds}.db"
                serve, workers = self.fleet()
                self.stop([serve], seconds)
                numbers = self.finish_unblamed(serve, workers)
                self.assertEqual(numbers["expired"], 0, "leases expired while it slept")


class StopOne(Stopping):
    """One of two is stopped: the other one does its work, and its late results are welcome."""
    budget = 20000
    times = (1, 10)

    def test_workers(self):
        for seconds in self.times:
            with self.subTest(seconds=seconds):
                self.store = self.folder / f"one-{seconds}.db"
                serve, workers = self.fleet()
                self.stop(workers[:1], seconds)
                numbers = self.finish_unblamed(serve, workers)
                self.assertEqual(numbers["lost_workers"], 1 if seconds > 5 else 0)


if __name__ == "__main__":
    unittest.main()
