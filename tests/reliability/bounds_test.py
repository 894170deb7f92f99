"""What a coordinator holds in memory: bounded, whatever comes and however much is evaluated."""
import contextlib
import unittest

from programs import CAMPAIGN
from rig import FaultTest, stored, wait_for
from visited import Visited
from wire import Peer, frame, varint

MB = 1 << 20
#: Of the coordinator, in bytes, at its highest.
MOST_MEMORY = 200 * MB


def memory(pid, what="VmHWM"):
    """Of a process, in bytes: at its highest, or as it is (VmRSS)."""
    with open(f"/proc/{pid}/status") as status:
        [line] = [line for line in status if line.startswith(what)]
    return int(line.split()[1]) * 1024


class EmptyParts(Visited):
    """A megabyte of empty results would be a hundred of objects."""
    budget = 4000000

    def test_messages_of_nothing_but_parts(self):
        empty = b"\x12\x00" * 400000
        said = 0
        for _ in range(20):
            with Peer(self.address) as peer, contextlib.suppress(OSError):
                for field in (3, 4, 5, 6):
                    head = frame("ToCoordinator", {"sequence": 1, "incarnation": 1})
                    peer.send(head + bytes([field << 3 | 2]) + varint(len(empty)) + empty)
                    said += 1
        wait_for(lambda: self.malformed() >= said, "the count of bad messages")
        self.count("message of empty parts", said)
        most = memory(self.coordinator.pid)
        print(f"\n  memory {most / MB:.0f} MB", end="")
        self.assertLess(most, MOST_MEMORY)
        self.assertTrue(self.coordinator.alive(), self.coordinator.tail())
        self.assertGreater(self.rate(), 0)


class ManyEvaluations(FaultTest):
    """Memory that does not grow with what a design has evaluated."""
    budget = 320000
    tests = 1

    def campaign_text(self):
        short = CAMPAIGN.replace('name = "aggregation"', 'name = "aggregation"\nduration = "1 s"')
        return short.format(seed=self.seed, budget=self.budget, tests=self.tests)

    def test_a_design_of_three_hundred_thousand(self):
        run = self.run_local("--workers", "2")
        marks = {}
        for mark in (100000, 300000):
            wait_for(lambda: stored(self.store) >= mark or not run.alive(),
                     f"{mark} evaluations", 1500, 0.5)
            self.assertTrue(run.alive(), run.tail())
            marks[mark] = memory(run.pid, "VmRSS")
        print(f"\n  memory {marks[100000] / MB:.0f} MB at 100,000 evaluations, "
              f"{marks[300000] / MB:.0f} MB at 300,000", end="")
        self.assertLess(marks[300000] - marks[100000], 20 * MB)


if __name__ == "__main__":
    unittest.main()
