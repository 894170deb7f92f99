"""Strangers, liars and broken frames on the coordinator's port, while honest workers go on."""
import contextlib
import os
import random
import socket
import struct
import time
import unittest

from network import Proxy
from rig import LONG, FaultTest, call, events, rows, stored, wait_for
from wire import (COMMAND, GREETING, LONG_SIZE, MAJOR, MINOR, Frames, Peer,
                  frame, message, varint)


def connect(address, timeout=5):
    host, port = address.rsplit(":", 1)
    return socket.create_connection((host, int(port)), timeout)


def closed(it, seconds):
    """Whether the other side ends the connection within this time."""
    limit = time.monotonic() + seconds
    with contextlib.suppress(ConnectionError):
        while True:
            it.settimeout(max(0.01, limit - time.monotonic()))
            try:
                if not it.recv(65536):
                    return True
            except TimeoutError:
                return False
    return True


class Visited(FaultTest):
    """A coordinator with two honest workers, and visitors."""
    budget = 20000

    def setUp(self):
        super().setUp()
        self.coordinator = self.serve()
        self.address = self.coordinator.address()
        # One of them is heard, for what its messages look like.
        self.proxy = Proxy(self, self.address)
        self.workers = [self.worker(self.address), self.worker(self.proxy.address)]
        self.wait_stored(300)

    def rate(self, seconds=1.5):
        """Evaluations a second that reach the disk."""
        before, began = stored(self.store), time.monotonic()
        time.sleep(seconds)
        return (stored(self.store) - before) / (time.monotonic() - began)

    def heard(self, direction="up"):
        """The messages of the worker that is heard, as frames of the project."""
        frames = Frames()
        return [body for flags, body in frames.feed(bytes(self.proxy.recorded[0, direction]))
                if flags is not None and not flags & COMMAND]

    def hello(self, **changes):
        """What an honest worker says first, from another one."""
        honest = next(message("ToCoordinator", body) for body in self.heard()
                      if "hello" in message("ToCoordinator", body))
        hello = {**honest["hello"], "worker_id": os.urandom(16), "host": "stranger", "pid": 1, **changes}
        hello.pop("holds", None)
        return frame("ToCoordinator", {"sequence": 1, "incarnation": 1, "hello": hello})

    def malformed(self):
        return self.coordinator.progress().get("malformed", 0)

    def finish_undisturbed(self):
        """The answer is the usual one, and no honest worker was lost or blamed."""
        numbers = self.finish(self.coordinator, self.workers)
        honest = {worker.pid for worker in self.workers}
        for event in events(self.store, "worker lost"):
            [[pid]] = rows(self.store, f"select pid from worker where id = {event['worker']}")
            self.assertNotIn(pid, honest, "an honest worker was lost")
        return numbers


class Malformed(Visited):
    """All of it at one coordinator, since it must stand all of it."""

    def test_frames(self):
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
        good = next(body for body in self.heard() if "results" in message("ToCoordinator", body))
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
            peer.socket.settimeout(1)
            with contextlib.suppress(TimeoutError):
                self.assertFalse(peer.receive(), "a refused peer was answered")
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
        wait_for(lambda: len(events(self.store, "worker refused")) == 2, "refusals in the store", 10)
        self.count("other build", 2)


class Strangers(Visited):
    """Bounded in count and time, on loopback only."""

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

        for _ in range(3):
            with connect(self.address) as it:
                it.sendall(b"GET / HTTP/1.1\r\nHost: coordinator\r\n\r\n")
                self.assertTrue(closed(it, 5), "an HTTP request is not closed")
            self.count("HTTP request")
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
        for _ in range(20 if LONG else 5):
            self.replay(self.heard())
        numbers = self.finish_undisturbed()
        self.assertEqual(numbers["conflicts"], 0)
        self.assertEqual(len(rows(self.store, "select id from worker")), 2)

    def test_after_the_worker_has_gone(self):
        """The dead worker's words again: whoever it is, it has nothing that counts twice."""
        words = self.heard()
        self.workers.pop().kill()
        wait_for(lambda: events(self.store, "worker lost"), "its loss", 10)
        for _ in range(5):
            self.replay(words)
        numbers = self.finish(self.coordinator, self.workers)
        self.assertEqual(numbers["conflicts"], 0)


class Liars(Visited):
    """Workers that are let in and then misbehave, short of plausible scores: only the audit can
    tell those."""

    def enter(self):
        peer = Peer(self.address)
        self.addCleanup(peer.close)
        peer.send(self.hello())
        welcome = message("ToWorker", peer.receive())["welcome"]
        return peer, welcome

    @staticmethod
    def say(peer, sequence, **body):
        peer.send(frame("ToCoordinator", {"sequence": sequence, "incarnation": 1, **body}))

    def test_takes_and_never_answers(self):
        """It holds leases and stays alive: they expire, and others do the work."""
        peer, _ = self.enter()
        self.say(peer, 2, credit={"tasks": 64})
        got = wait_for(lambda: message("ToWorker", peer.receive()).get("tasks"), "tasks", 20)
        self.count("lease held for nothing", len(got["tasks"]))
        sequence = 3
        limit = time.monotonic() + 120
        while self.coordinator.alive() and time.monotonic() < limit:
            with contextlib.suppress(OSError):
                self.say(peer, sequence, heartbeat={"credit": 0, "held": 1})
            sequence += 1
            time.sleep(0.5)
        numbers = self.finish_undisturbed()
        self.assertGreater(numbers["expired"], 0)

    def test_results_that_nobody_asked_for(self):
        peer, welcome = self.enter()
        known = rows(self.store, "select candidate, pair, score, state_digest from evaluation "
                                 "where purpose = 0 limit 50")
        scenario = welcome["scenario"]
        results = [{"key": {"candidate": candidate, "purpose": 0, "pair": pair}, "attempt": 1,
                    "score": score + 1.0, "state_digest": 77}
                   for candidate, pair, score, _ in known]
        self.say(peer, 2, results={"scenario": scenario, "results": results})
        wait_for(lambda: self.coordinator.progress().get("conflicts", 0) >= 50
                 or not self.coordinator.alive(), "conflicts that are seen", 15)
        stray = [{"key": {"candidate": 900000 + n, "purpose": 0, "pair": 1}, "attempt": 1,
                  "score": 99.0, "state_digest": 1} for n in range(100)]
        self.say(peer, 3, results={"scenario": scenario, "results": stray})
        self.say(peer, 4, results={"scenario": 1234, "results": results})
        self.count("lie about what is known", 50)
        self.count("result of a task that is none", 100)
        peer.close()
        self.assertEqual(self.coordinator.wait(), 0, self.coordinator.tail())
        self.assertEqual(self.digest(self.store), self.expected())
        # A store with two words about one evaluation is never called clean.
        self.assertIn("a worker is wrong", call("verify", self.store).stdout)
        self.assertEqual(len(rows(self.store, "select * from conflict")), 50)
        self.assertEqual(len(events(self.store, "not deterministic")), 50)
        self.assertEqual(rows(self.store, "select count(*) from evaluation where score = 99"),
                         [(0,)])

    def test_plausible_scores(self):
        """It answers all that it is asked, and invents: the audit finds it, and it is asked no more.
        What it said before is in the store, which is not called clean."""
        peer, welcome = self.enter()
        peer.socket.settimeout(1)
        rng = random.Random(4)
        told = 0
        sequence = 2
        beat = 0
        while self.coordinator.alive():
            if time.monotonic() > beat + 0.5:
                beat = time.monotonic()
                sequence += 1
                with contextlib.suppress(OSError):
                    self.say(peer, sequence, heartbeat={"credit": 8})
            try:
                heard = message("ToWorker", peer.receive() or bytes(8))
            except OSError:
                continue
            results = [{"key": task["key"], "attempt": task.get("attempt", 0), "wall_us": 300,
                        "score": float(rng.randrange(4)), "state_digest": rng.getrandbits(63)}
                       for task in heard.get("tasks", {}).get("tasks", [])]
            if not results:
                continue
            sequence += 1
            told += len(results)
            with contextlib.suppress(OSError):
                self.say(peer, sequence, results={"scenario": welcome["scenario"],
                                                  "results": results})
        self.assertEqual(self.coordinator.wait(), 0, self.coordinator.tail())
        self.count("invented score", told)
        [found] = events(self.store, "worker in quarantine")
        print(f"\n  found after {found['results in the store']} of its scores", end="")
        self.assertEqual(found["host"], "stranger")
        self.assertIn("a worker is wrong", call("verify", self.store).stdout)
        self.assertEqual(rows(self.store, "select count(*) from worker where state = 'quarantined'"),
                         [(1,)])

    def test_somebody_elses_leases(self):
        """It returns and fails what others hold, says old words, and leaves again."""
        peer, welcome = self.enter()
        keys = [{"candidate": c, "purpose": 0, "pair": p} for c in range(1, 200) for p in (1, 2)]
        self.say(peer, 2, returned={"keys": keys})
        self.say(peer, 3, results={"scenario": welcome["scenario"], "results": [
            {"key": key, "attempt": 1, "failure": b"because"} for key in keys]})
        self.say(peer, 2, credit={"tasks": 4096})
        self.say(peer, 4, goodbye={})
        self.count("return or failure of another's lease", 2 * len(keys))
        peer.close()
        numbers = self.finish_undisturbed()
        self.assertEqual((numbers["failed"], numbers["rejected"]), (0, 0))


class Upgrade(FaultTest):
    """Peers of the next minor version, made from real ones by rewriting all that they say."""
    budget = 4000

    @staticmethod
    def newer(body, minor=MINOR + 1):
        """Another version in the header, and a field that this version does not have."""
        field = varint(1000 << 3 | 2) + varint(5) + b"later"
        return body[:6] + struct.pack("<H", minor) + body[8:] + field

    def campaign(self, rewrite):
        serve = self.serve()
        proxy = Proxy(self, serve.address(), rewrite=rewrite)
        worker = self.worker(proxy.address)
        return serve, worker

    def test_newer_workers(self):
        serve, worker = self.campaign(lambda way, body: self.newer(body) if way == "up" else body)
        numbers = self.finish(serve, [worker])
        self.assertEqual(numbers["malformed"], 0)
        self.count("campaign of newer workers")

    def test_newer_coordinator(self):
        serve, worker = self.campaign(lambda way, body: self.newer(body) if way == "down" else body)
        self.finish(serve, [worker])
        self.count("campaign of a newer coordinator")

    def test_an_unknown_kind_of_message(self):
        """A body that this version does not have is a sign of life, and no fault."""
        serve = self.serve()
        worker = self.worker(serve.address())
        with Peer(serve.address()) as peer:
            for _ in range(30):
                peer.send(frame("ToCoordinator", {"sequence": 1, "incarnation": 1}, minor=MINOR + 1)
                          + varint(500 << 3 | 2) + varint(3) + b"new")
            self.assertIn("who_are_you", message("ToWorker", peer.receive()))
            self.count("message of a later version", 30)
        numbers = self.finish(serve, [worker])
        self.assertEqual(numbers["malformed"], 0)

    def test_another_major_version_is_told_and_leaves(self):
        """Either way; the worker ends with 7, and the others go on."""
        for way in ("up", "down"):
            self.store = self.folder / f"{way}.db"
            serve = self.serve()
            proxy = Proxy(self, serve.address(), rewrite=lambda at, body, way=way:
                          body[:4] + struct.pack("<H", MAJOR + 1) + body[6:] if at == way else body)
            other = self.worker(proxy.address)
            self.assertEqual(other.wait(30), 7, other.tail())
            self.assertIn("version", other.log())
            self.count("worker of another major version")
            self.finish(serve, [self.worker(serve.address())])


if __name__ == "__main__":
    unittest.main()
