"""Hostile peers beside honest workers, in numbers: strangers without a key, liars with one.

The answer is that of an undisturbed run, or the campaign ends with exit code 3 and a sentence that
says why there is none.
"""
import json
import os
import pathlib
import re
import time
import unittest

from rig import LONG, PATIENCE, FaultTest, call, ended_well, rows, stored, wait_for
from mixes import LIES, MIXES
from programs import BIN

HOSTILE = BIN / "hostile"
#: Honest results that arrive meanwhile, at least one for so many hostile messages. How many a second it is,
#: `./dev bench strangers` measures.
MESSAGES_A_RESULT = 200


class Hostile(FaultTest):
    budget = 20000 if LONG else 3000
    messages = 5000 if LONG else 1000
    connections = 200 if LONG else 30
    per_second = 2500 if LONG else 1500

    apart = ()

    def setUp(self):
        super().setUp()
        # Attackers come from hosts of their own: what they compute is not taken from honest workers.
        cores = sorted(os.sched_getaffinity(0))
        if LONG and len(cores) > 1:
            self.addCleanup(os.sched_setaffinity, 0, cores)
            os.sched_setaffinity(0, cores[:-1])
            self.apart = ("taskset", "--cpu-list", cores[-1])

    def sizes(self, coordinator):
        """Bytes of the store with its log, and of what was logged."""
        [[store]] = rows(self.store, "select page_count * page_size from pragma_page_count, "
                                     "pragma_page_size")
        return store, coordinator.err.stat().st_size

    def watch(self, coordinator, hostile=None):
        """Waits for the end. Results that were stored while `hostile` was there, and most memory in kB."""
        memory, first, last = 0, stored(self.store), 0
        limit = time.monotonic() + 400 * PATIENCE
        while coordinator.alive():
            self.assertLess(time.monotonic(), limit, "the campaign does not end")
            if hostile is None or hostile.alive():
                last = stored(self.store)
            memory = max(memory, self.memory_kb(coordinator.pid))
            time.sleep(0.1)
        return last - first, memory

    @staticmethod
    def memory_kb(pid):
        try:
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
        except OSError:
            return 0
        found = re.search(r"VmHWM:\s+(\d+)", status)
        return int(found.group(1)) if found else 0

    def honest(self):
        """The same campaign with honest workers only: bytes of store and log."""
        if "honest" not in type(self).__dict__.get("known", {}):
            store, self.store = self.store, self.folder / "honest.db"
            coordinator = self.begin()
            self.watch(coordinator)
            self.finish(coordinator, self.workers)
            type(self).known = {"honest": self.sizes(coordinator)}
            self.store = store
        return type(self).known["honest"]

    def visit(self, name, misdeeds, key=None, **more):
        """The campaign beside hostile peers, and what must hold."""
        store_size, log_size = self.honest()
        coordinator = self.begin()
        self.wait_stored(100)
        address = self.address_of(coordinator)
        words = {"messages": self.messages, "connections": self.connections,
                 "rate": self.per_second, **more}
        hostile = self.start("hostile", *self.apart, HOSTILE, address, 1 + len(name), words["messages"],
                             words["connections"], words["rate"], misdeeds,
                             *([key] if key else []))
        meanwhile, memory = self.watch(coordinator, hostile)
        end = coordinator.wait()
        hostile_left_first = not hostile.alive()
        hostile.wait(60)
        done = json.loads(hostile.out.read_text())
        sizes = self.sizes(coordinator)
        growth = [sizes[0] - store_size, sizes[1] - log_size]
        print(f"\n  {name}: {done['messages']} messages over {done['connections']} connections, "
              f"{done['acts']}; exit code {end}; {meanwhile} results meanwhile; "
              f"{memory} kB; store and log grew by {growth[0]} and {growth[1]} bytes", end="")
        self.count("hostile message", done["messages"])
        self.count("hostile connection", done["connections"])
        self.assert_memory(memory, 200_000)
        self.assertLess(sum(growth), 1_000_000, "store and log")
        # A campaign may end before its visitors do: by then all results have arrived.
        if end == 0 and hostile_left_first:
            self.assertGreaterEqual(meanwhile, done["messages"] // MESSAGES_A_RESULT, "honest workers starve")
        return coordinator, end, done

    def assert_right(self, coordinator):
        """The answer, and every score in the store is what this build gives."""
        self.finish(coordinator, self.workers)
        ended_well(call("verify", self.store, "--sample", 2000 if LONG else 500, "--seed", 1))

    def assert_says_why(self, coordinator):
        self.assertRegex(coordinator.log(), "(score|store|worker)[^\n]*(wrong|believed|trust|new store)",
                         coordinator.tail())
        done = call("verify", self.store)
        self.assertNotEqual(done.returncode, 0, "a store with lies is called clean")


class Strangers(Hostile):
    """On loopback, without keys: the workers are those that the coordinator started itself."""
    workers = ()

    def begin(self):
        return self.run_local("--workers", "1")

    def address_of(self, coordinator):
        file = self.store.with_name(self.store.name + ".coordinator")
        text = wait_for(lambda: file.exists() and file.read_text(), "the coordinator's file", 20)
        return re.search(r"(127\.0\.0\.1:\d+)", text).group(1)

    def mix(self, name):
        coordinator, end, _ = self.visit(name, MIXES[name])
        self.assertEqual(end, 0, coordinator.tail())
        self.assert_right(coordinator)


def mix_test(name):
    def test(self):
        self.mix(name)
    return test


for mix_name in MIXES:
    if LONG or mix_name in ("rejections", "any order"):
        setattr(Strangers, "test_" + mix_name.replace(" ", "_"), mix_test(mix_name))


class Liars(Hostile):
    """With keys: who lies is on the list of clients."""
    workers = ()

    def setUp(self):
        super().setUp()
        self.keys = self.keygen(self.folder / "keys")
        self.keygen(self.keys, "--client", "liar")

    def begin(self):
        coordinator = self.serve("--keys", self.keys)
        self.workers = [self.worker(coordinator.address(), "--key", self.keys / "worker.key")]
        return coordinator

    def address_of(self, coordinator):
        return coordinator.address()

    def lie(self, name, **more):
        coordinator, end, done = self.visit(name, LIES[name], self.keys / "liar.key", **more)
        self.count("lie", sum(done["acts"].values()))
        if end == 3:
            self.assert_says_why(coordinator)
        else:
            self.assertEqual(end, 0, coordinator.tail())
            self.assert_right(coordinator)

    def test_of_their_own_leases(self):
        self.lie("liars")

    if LONG:
        def test_under_ever_new_names(self):
            self.lie("liars who change their names")

    def test_of_anything(self):
        """50,000 at least."""
        self.lie("liars with guessed keys", messages=4000 if LONG else 300, rate=400)


if __name__ == "__main__":
    unittest.main()
