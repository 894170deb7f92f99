"""Strangers and broken frames on the coordinator's port, while honest workers go on."""
import contextlib
import random
import struct
import time
import unittest

from rig import LONG, events, rows, stored, wait_for
from visited import Visited, closed, connect
from wire import GREETING, LONG_SIZE, MAJOR, Peer, frame, message


class Malformed(Visited):
    """All of it at one coordinator, since it must stand all of it."""
    budget = 1500
    designs = 2

    def test_frames(self):
        self.frame_with("results")
        self.frames_that_are_none()
        self.two_frames_are_not_one()
        self.too_long()
        self.a_peer_is_refused_after_ten()
        self.wrong_major_version()
        self.wrong_build_and_self_test()
        numbers = self.finish_undisturbed()
        self.assertEqual((numbers["rejected"], numbers["conflicts"]), (0, 0))

    def frames_that_are_none(self):
        rng = random.Random(1)
        good = self.frame_with("results")
        bad = [b"", b"SWRM", b"XXXX" + good[4:], rng.randbytes(200), good[:20],
               good[:8] + b"\xff" * 40, good[:8] + rng.randbytes(500),
               frame("ToCoordinator", {"hello": {"worker_id": b"short", "slots": 1}}),
               frame("ToCoordinator", {"hello": {"worker_id": bytes(16), "slots": 1 << 31}}),
               frame("ToCoordinator", {"results": {"results": [
                   {"key": {"candidate": 1}, "score": float("nan")}]}}),
               frame("ToCoordinator", {"results": {"results": [
                   {"key": {"candidate": -5}, "score": 1.0}]}}),
               frame("ToCoordinator", {"returned": {"keys": [{"candidate": 1}] * 5000}})]
        before = self.malformed()
        peers = [Peer(self.address) for _ in bad]
        for peer, body in zip(peers, bad):
            peer.send(body)
        wait_for(lambda: self.malformed() >= before + len(bad), "the count of bad frames", 10)
        for peer in peers:
            peer.close()
        self.assertEqual(self.malformed(), before + len(bad))
        self.count("malformed frame", len(bad))

    def a_peer_is_refused_after_ten(self):
        with Peer(self.address) as peer:
            for _ in range(10):
                peer.send(b"nonsense")
            wait_for(lambda: events(self.store, "peer refused"), "the refusal of a peer", 10)
            peer.send(self.hello())
            with contextlib.suppress(TimeoutError):
                self.assertFalse(peer.receive(1), "a refused peer was answered")
        self.count("peer refused")

    def two_frames_are_not_one(self):
        before = self.malformed()
        with Peer(self.address) as peer:
            peer.send(self.hello(), flags=1)
            peer.send(b"more")
            wait_for(lambda: self.malformed() > before, "the count of a bad message", 10)
        self.count("message of two frames")

    def too_long(self):
        """Closed before a megabyte is read; the size alone is enough."""
        for size in (2 << 20, 1 << 40, (1 << 63) - 1):
            with Peer(self.address) as peer:
                peer.socket.sendall(struct.pack(">BQ", LONG_SIZE, size))
                self.assertTrue(peer.is_closed(10), f"{size} bytes are waited for")
            self.count("oversize frame")

    def wrong_major_version(self):
        with Peer(self.address) as peer:
            hello = message("ToCoordinator", self.hello())
            peer.send(frame("ToCoordinator", hello, major=MAJOR + 1))
            answer = message("ToWorker", peer.receive())
            self.assertIn("version", answer["reject"]["sentence"])
        self.count("other major version")

    def wrong_build_and_self_test(self):
        for change, word in (({"self_test": "0123456789abcdef"}, "self test"),
                             ({"engine_version": 9999}, "version")):
            with Peer(self.address) as peer:
                peer.send(self.hello(**change))
                answer = message("ToWorker", peer.receive())
                self.assertIn(word, answer["reject"]["sentence"])
        wait_for(lambda: len(events(self.store, "worker refused")) == 2, "two refusals", 10)
        self.count("other build", 2)


class Strangers(Visited):
    """Bounded in count and time, on loopback only."""
    budget = 60000

    def visit(self, seconds, *visitors):
        """Visits for so long; the honest rate meanwhile, over the rate before."""
        before = self.rate()
        until = time.monotonic() + seconds
        count, began = stored(self.store), time.monotonic()
        while time.monotonic() < until and self.coordinator.alive():
            for visitor in visitors:
                visitor()
        during = (stored(self.store) - count) / (time.monotonic() - began)
        print(f"\n  honest workers: {before:.0f}/s before, {during:.0f}/s meanwhile", end="")
        # Visitors and coordinator share the machine's cores with the workers.
        if self.coordinator.alive():
            self.assertGreater(during, before / 5, "honest workers starve")

    def test_scans_garbage_and_http(self):
        rng = random.Random(2)

        def scan():
            connect(self.address).close()
            self.count("connection opened and closed")

        def garbage():
            with connect(self.address) as it, contextlib.suppress(OSError):
                it.sendall(rng.randbytes(rng.randrange(1, 3000)))
            self.count("garbage")

        with contextlib.ExitStack() as stack:
            browsers = [stack.enter_context(connect(self.address)) for _ in range(3)]
            for browser in browsers:
                browser.sendall(b"GET / HTTP/1.1\r\nHost: coordinator\r\n\r\n")
                self.count("HTTP request")
            for browser in browsers:
                self.assertTrue(closed(browser, 5), "an HTTP request is not closed")
        self.visit(2, scan, garbage)
        self.finish_undisturbed()

    def test_half_open_and_slow(self):
        """Connections that say nothing, or a byte now and then, are closed after 3 s."""
        silent = [connect(self.address) for _ in range(200)]
        self.count("half-open connection", len(silent))
        slow = [connect(self.address) for _ in range(50)]
        self.count("slow connection", len(slow))

        def drip():
            for it in slow:
                with contextlib.suppress(OSError):
                    it.send(GREETING[:1])
            time.sleep(0.3)

        self.visit(4, drip)
        for it in silent + slow:
            self.assertTrue(closed(it, 5), "a silent connection stays")
            it.close()
        self.finish_undisturbed()

    def test_more_connections_than_descriptors(self):
        """Five hundred that stay open as long as they may, again and again."""
        held = []
        for _ in range(500):
            with contextlib.suppress(OSError):
                held.append(connect(self.address))
        self.count("connection held", len(held))
        late = self.worker(self.address)
        self.workers.append(late)
        for it in held:
            it.close()
        wait_for(lambda: (late.pid,) in rows(self.store, "select pid from worker"),
                 "the welcome of an honest worker", 20)
        self.finish_undisturbed()


class Connects(Visited):
    budget = 60000

    def test_ten_thousand_connects(self):
        def connects():
            some = []
            for _ in range(100):
                with contextlib.suppress(OSError):
                    some.append(connect(self.address))
            for it in some:
                it.close()
            self.count("connection", len(some))

        before = self.rate()
        count, began = stored(self.store), time.monotonic()
        while self.tried.get("connection", 0) < 10000 and time.monotonic() < began + 100 \
                and self.coordinator.alive():
            connects()
        if self.coordinator.alive():
            during = (stored(self.store) - count) / (time.monotonic() - began)
            print(f"\n  honest workers: {before:.0f}/s before, {during:.0f}/s meanwhile", end="")
        self.assertEqual(self.tried["connection"], 10000)
        self.finish_undisturbed()


class Replays(Visited):
    def replay(self, words):
        """Says them again on a new connection, and hears what comes."""
        with contextlib.suppress(OSError), Peer(self.address) as peer:
            for body in words:
                peer.send(body)
            peer.is_closed(0.3)
        self.count("capture replayed")

    def test_captures_played_again(self):
        """All that a worker said, while it lives and works."""
        self.frame_with("results")
        for _ in range(20 if LONG else 5):
            self.replay(self.heard())
        numbers = self.finish_undisturbed()
        self.assertEqual(numbers["conflicts"], 0)
        self.assertEqual(len(rows(self.store, "select id from worker")), 2)

    def test_after_the_worker_has_gone(self):
        """The dead worker's words again: under any name, it has nothing that counts twice."""
        self.frame_with("results")
        words = self.heard()
        self.workers.pop().kill()
        wait_for(lambda: events(self.store, "worker lost"), "its loss", 10)
        for _ in range(5):
            self.replay(words)
        numbers = self.finish(self.coordinator, self.workers)
        self.assertEqual(numbers["conflicts"], 0)


if __name__ == "__main__":
    unittest.main()
