"""Peers that are let in: workers that lie, and builds of other versions."""
import contextlib
import random
import struct
import time
import unittest

from network import Proxy
from rig import FaultTest, events, rows, wait_for
from visited import Visited
from wire import MAJOR, MINOR, Peer, frame, message, varint


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
        """It holds leases and stays alive: they expire or are copied, and others do the work."""
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
        copies = rows(self.store, "select count(*) from attempt where outcome = 'second copy'")
        self.assertGreater(numbers["expired"] + copies[0][0], 0)

    def test_results_that_were_not_asked_for(self):
        peer, welcome = self.enter()
        known = rows(self.store, "select candidate, pair, score, state_digest from evaluation "
                                 "where purpose = 0 limit 50")
        scenario = welcome["scenario"]
        results = [{"key": {"candidate": candidate, "purpose": 0, "pair": pair}, "attempt": 1,
                    "score": score + 1.0, "state_digest": 77}
                   for candidate, pair, score, _ in known]
        self.say(peer, 2, results={"scenario": scenario, "results": results})
        stray = [{"key": {"candidate": 900000 + n, "purpose": 0, "pair": 1}, "attempt": 1,
                  "score": 99.0, "state_digest": 1} for n in range(100)]
        self.say(peer, 3, results={"scenario": scenario, "results": stray})
        wait_for(lambda: self.coordinator.progress().get("unleased", 0) >= 150
                 or not self.coordinator.alive(), "results that are refused", 15)
        self.say(peer, 4, results={"scenario": 1234, "results": results})
        self.count("lie about what is known", 50)
        self.count("result of a task that is none", 100)
        peer.close()
        self.finish_undisturbed()
        # Who was given nothing has no say, and makes no work.
        self.assertEqual(rows(self.store, "select * from conflict"), [])
        self.assertEqual(rows(self.store, "select count(*) from evaluation where score = 99"),
                         [(0,)])

    def test_plausible_scores(self):
        """It answers all that it is asked, and invents. That others of this host have proved
        themselves says nothing of it: the referee finds it at its first words, and none of them is
        stored."""
        peer, welcome = self.enter()
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
                heard = message("ToWorker", peer.receive(1) or bytes(8))
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
        self.finish_undisturbed()
        self.count("invented score", told)
        [found] = events(self.store, "workers in quarantine")
        self.assertEqual(found["who"], "loopback")
        self.assertGreater(found["worker"], 0, "one process of this host")

    def test_leases_of_another_worker(self):
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
