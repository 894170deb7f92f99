"""What a coordinator holds in memory: bounded, whatever comes and however much is evaluated."""
import contextlib
import os
import random
import resource
import struct
import time
import unittest
import zlib

from programs import campaign_text
from rig import FaultTest, rows, stored, wait_for
from visited import Visited
from wire import MORE, Peer, frame, message, packed, varint

MB = 1 << 20
#: Of the coordinator, in bytes, at its highest.
MOST_MEMORY = 200 * MB


def memory(pid, what="VmHWM"):
    """Of a process, in bytes: at its highest, or as it is (VmRSS)."""
    with open(f"/proc/{pid}/status") as status:
        [line] = [line for line in status if line.startswith(what)]
    return int(line.split()[1]) * 1024


def raise_descriptor_limit():
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))


class EmptyParts(Visited):
    """A megabyte of empty results would be a hundred of objects."""
    budget = 4000000

    def test_messages_of_nothing_but_parts(self):
        empty = b"\x12\x00" * 400000
        said = 0
        with contextlib.ExitStack() as connections:
            for _ in range(20):
                peer = connections.enter_context(Peer(self.address))
                with contextlib.suppress(OSError):
                    for field in (3, 4, 5, 6):
                        head = frame("ToCoordinator", {"sequence": 1, "incarnation": 1})
                        peer.send(head + bytes([field << 3 | 2]) + varint(len(empty)) + empty)
                        said += 1
            # What was not read of a connection that is closed is lost.
            wait_for(lambda: self.malformed() >= said, "the count of bad messages")
        self.count("message of empty parts", said)
        most = memory(self.coordinator.pid)
        print(f"\n  memory {most / MB:.0f} MB", end="")
        self.assert_memory(most, MOST_MEMORY)
        self.assertTrue(self.coordinator.alive(), self.coordinator.tail())
        self.assertGreater(self.rate(), 0)


class Memory(Visited):
    """One guest, who sends without an end, or reads nothing."""
    budget = 4000000

    def assert_bounded(self):
        most = memory(self.coordinator.pid)
        print(f"\n  memory {most / MB:.0f} MB", end="")
        self.assert_memory(most, MOST_MEMORY)
        self.assertTrue(self.coordinator.alive(), self.coordinator.tail())
        self.assertGreater(self.rate(), 0)

    def test_messages_without_an_end(self):
        """Parts and parts of one message, on several connections, until they are cut off."""
        part = packed(bytes(256 << 10), MORE)
        sent = 0
        for _ in range(4):
            with Peer(self.address) as peer, contextlib.suppress(OSError):
                for _ in range(4000):
                    peer.socket.sendall(part)
                    sent += len(part)
                self.fail("a gigabyte was taken")
        self.count("megabyte of parts", sent // MB)
        self.assert_bounded()

    def test_many_with_a_little_each(self):
        """What each has is allowed, what all have is not."""
        raise_descriptor_limit()
        part = packed(bytes(250 << 10), MORE)
        peers = []
        for _ in range(300):
            peer = Peer(self.address)
            peers.append(peer)
            with contextlib.suppress(OSError):
                for _ in range(4):
                    peer.socket.sendall(part)
        self.count("megabyte of parts", 300)
        self.assert_bounded()
        for peer in peers:
            peer.close()


def noise_png(side, seed):
    """A picture that does not shrink: side x side grey pixels."""
    rng = random.Random(seed)

    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body
                + struct.pack(">I", zlib.crc32(kind + body)))

    lines = b"".join(b"\0" + rng.randbytes(side) for _ in range(side))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(lines, 0)) + chunk(b"IEND", b""))


class LargeScenario(Visited):
    """Floors with pictures make a scenario of megabytes, for which a few bytes ask."""
    budget = 400000

    def campaign_text(self):
        text = super().campaign_text()
        for number in range(6):
            (self.folder / f"floor{number}.png").write_bytes(noise_png(980, number))
            text += (f'\n[[mission]]\nname = "pictured{number}"\npreset = "aggregation"\n'
                     f'  [mission.arena]\n  spots = [ {{ shape = "image", file = '
                     f'"floor{number}.png", x = 0, y = 0, width = 1, height = 1 }} ]\n')
        return text

    def test_readers_that_do_not_read(self):
        peers = []
        for _ in range(60):
            peer = Peer(self.address)
            peers.append(peer)
            peer.send(self.hello())
            for sequence in range(40):
                with contextlib.suppress(OSError):
                    peer.send(frame("ToCoordinator", {"sequence": sequence + 2, "incarnation": 1,
                                                      "want_scenario": {}}))
        time.sleep(6)
        self.count("scenario asked for", 60 * 40)
        most = memory(self.coordinator.pid)
        print(f"\n  memory {most / MB:.0f} MB", end="")
        self.assert_memory(most, MOST_MEMORY)
        # Who reads still gets it.
        late = self.worker(self.address)
        self.workers.append(late)
        wait_for(lambda: (late.pid,) in rows(
            self.store, "select pid from worker where id in (select worker from evaluation)"),
                 "the work of another honest worker", 60)
        for peer in peers:
            peer.close()


class ManyEvaluations(FaultTest):
    """Memory that does not grow with what a design has evaluated."""
    budget = 130000
    tests = 1

    def campaign_text(self):
        return campaign_text(self.budget, seed=self.seed, tests=self.tests, duration="1 s")

    def test_a_long_design(self):
        run = self.run_local("--workers", "2")
        marks = {}
        for mark in (40000, 120000):
            wait_for(lambda: stored(self.store) >= mark or not run.alive(),
                     f"{mark} evaluations", 1500, 0.5)
            self.assertTrue(run.alive(), run.tail())
            marks[mark] = memory(run.pid, "VmRSS")
        print(f"\n  memory {marks[40000] / MB:.0f} MB at 40,000 evaluations, "
              f"{marks[120000] / MB:.0f} MB at 120,000", end="")
        self.assert_memory(marks[120000] - marks[40000], 8 * MB)


if __name__ == "__main__":
    unittest.main()
