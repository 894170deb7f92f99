"""Who lied is cut out of a store, and who is in quarantine is seen, and can be forgiven."""
import base64
import gzip
import json
import re
import signal
import unittest

from programs import BIN
from rig import FaultTest, call, rows, wait_for

LIAR = str(BIN / "liar")


class Trust(FaultTest):
    budget = 1500
    designs = 2

    def liar(self, address, honest, every, *key):
        return self.start("liar", LIAR, address, honest, every, *key)

    def said(self, name, *words, code=0):
        """What a command wrote, which must end with that code."""
        done = call(name, *words)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def quarantine(self, *words):
        return json.loads(call("status", self.store, "--json", *words).stdout)["quarantine"]


class CutOut(Trust):
    """A liar with a listed key is caught late: the store is mended, and the campaign ends as it should."""
    budget = 3000

    def setUp(self):
        super().setUp()
        self.keys = self.keygen(self.folder / "keys")
        self.keygen(self.keys, "--client", "liar")

    def caught(self):
        """A campaign that a lie has turned, and that has stopped for it."""
        serving = self.serve("--keys", self.keys)
        liar = self.liar(serving.address(), 150, 3, self.keys / "liar.key")
        self.wait_stored(100)
        honest = self.worker(serving.address(), "--key", self.keys / "worker.key")
        self.assertEqual(serving.wait(), 3, serving.tail())
        self.assertIn('recover STORE --without-key "liar" -o NEW.db', serving.log())
        for worker in (liar, honest):
            worker.kill()
        found = rows(self.store, "select count(*) from evaluation as e join worker as w on w.id = e.worker"
                     " where w.client = 'liar'")[0][0]
        self.assertGreater(found, 100, "the liar was not believed at first")

    def test_the_store_without_the_liar_goes_on_to_the_right_answer(self):
        self.caught()
        # Neither the same command nor a copy makes it a sound one.
        again = self.serve("--keys", self.keys, wait=False)
        self.assertEqual(again.wait(60), 3, again.tail())
        self.assertIn(f'recover {self.store} --without-key "liar"', again.log())
        copy = self.folder / "copy.db"
        self.said("recover", self.store, "-o", copy, code=3)
        self.assertIn("wrong, or may be", self.said("verify", copy, "--sample", 0, code=3))
        honest = self.folder / "honest.db"
        self.assertRegex(self.said("recover", self.store, "--without-key", "nokey", "-o", honest, code=4), "are: .*liar")
        self.assertFalse(honest.exists())
        self.assertRegex(self.said("recover", self.store, "--without-key", "liar", "-o", honest),
                         r"[1-9]\d* evaluations of 1 worker were removed")
        self.store = honest
        self.assertEqual(self.quarantine()[0]["who"], "liar")
        serving = self.serve("--keys", self.keys)
        wait_for(lambda: "liar is in quarantine since" in serving.log(), "why the key is turned away")
        turned_away = self.liar(serving.address(), 0, 1, self.keys / "liar.key")
        self.assertEqual(turned_away.wait(60), 8, turned_away.tail())
        self.assertIn("in quarantine since", turned_away.log())
        worker = self.worker(serving.address(), "--key", self.keys / "worker.key")
        self.finish(serving, [worker])
        self.assertEqual(rows(self.store, "select count(*) from evaluation as e join worker as w on"
                              " w.id = e.worker where w.client = 'liar'"), [(0,)])


class Forgiven(Trust):
    """Quarantine is shown everywhere, lasts, and ends when a person says so."""

    def setUp(self):
        super().setUp()
        self.keys = self.keygen(self.folder / "keys")
        self.keygen(self.keys, "--client", "node7")
        self.key = ("--key", self.keys / "node7.key")

    def lie(self):
        """A coordinator whose only worker lies from the start: nothing of it is stored, and nothing goes on."""
        serving = self.serve("--keys", self.keys)
        liar = self.liar(serving.address(), 0, 1, self.keys / "node7.key")
        wait_for(lambda: "is in quarantine since" in serving.log() or not serving.alive(), serving.tail)
        self.assertEqual(rows(self.store, "select count(*) from evaluation where worker <> 0"), [(0,)])
        return serving, liar

    def assert_shown(self, *words):
        [one] = self.quarantine(*words)
        self.assertEqual(one["who"].split("@")[0], "node7")
        self.assertIn("it gave", one["reason"])
        self.assertRegex(one["since"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d")
        self.assertRegex(self.said("status", self.store, *words), "node7@.* in quarantine since .*it gave(.|\n)*forgive")
        self.assertRegex(self.said("ls", "workers", self.store), r"quarantined(.|\n)*it gave")

    def test_by_the_running_coordinator(self):
        serving, liar = self.lie()
        reader = ("--key", self.keys / "operator.key")
        wait_for(lambda: self.quarantine(*reader), "quarantine in the status")
        self.assert_shown(*reader)
        self.assertIn("swarmsmith forgive", serving.log())
        wait_for(lambda: "in quarantine" in liar.log(), "the worker's own message")
        liar.kill()
        honest = self.worker(serving.address(), *self.key)
        self.assertEqual(honest.wait(60), 8, honest.tail())
        self.assertIn("swarmsmith forgive", honest.log())
        self.assertIn("these are: node7@", self.said("forgive", self.store, "node8", *reader, code=4))
        self.assertIn("no longer in quarantine", self.said("forgive", self.store, "node7", *reader))
        # The status is that of the coordinator's last look, some tenths of a second ago.
        wait_for(lambda: self.quarantine(*reader) == [], "a status without a quarantine")
        honest = self.worker(serving.address(), *self.key)
        self.finish(serving, [honest])
        self.assertEqual(rows(self.store, "select text ->> '$.by' from event where kind = 'workers forgiven'")[0][0]
                         .count("@"), 1)

    def test_at_rest_and_across_restarts(self):
        serving, liar = self.lie()
        serving.send(signal.SIGINT)
        self.assertEqual(serving.wait(), 130, serving.tail())
        liar.kill()
        self.assert_shown()
        page = self.folder / "page.html"
        self.said("dashboard", self.store, "--export", page)
        shown = re.search(r'id="snapshot"[^>]*>([^<]+)<', page.read_text())[1]
        looks = re.findall(r'"text":"([^"]*)"', gzip.decompress(base64.b64decode(shown)).decode())
        self.assertRegex("\n".join(looks), r"node7@.* is in quarantine since .*it gave")
        # It lasts, and the coordinator that waits for workers says why none comes.
        serving = self.serve("--keys", self.keys)
        wait_for(lambda: "node7" in serving.log(), "why it waits")
        self.assertRegex(serving.log(), "node7@.* is in quarantine since .*: it gave .*swarmsmith forgive")
        refused = self.worker(serving.address(), *self.key)
        self.assertEqual(refused.wait(60), 8, refused.tail())
        serving.send(signal.SIGINT)
        self.assertEqual(serving.wait(), 130, serving.tail())
        self.assertIn("no longer in quarantine", self.said("forgive", self.store, "node7"))
        self.assertEqual(self.quarantine(), [])
        self.said("forgive", self.store, "node7", code=4)
        # Forgiven is forgiven after a restart too.
        serving = self.serve("--keys", self.keys)
        honest = self.worker(serving.address(), *self.key)
        self.finish(serving, [honest])

    def test_without_keys_one_process_is_blamed(self):
        """The others of this host go on, and so does one that comes later."""
        serving = self.serve()
        first = self.worker(serving.address())
        self.wait_stored(20)
        liar = self.liar(serving.address(), 0, 1)
        wait_for(lambda: "in quarantine" in liar.log() or not serving.alive(), serving.tail)
        # The worker hears of it before the row is on disk.
        wait_for(lambda: self.quarantine() or not serving.alive(), serving.tail)
        if serving.alive():
            [one] = self.quarantine()
            self.assertEqual(one["who"], "loopback")
            self.assertGreater(one["worker"], 0)
        liar.kill()
        second = self.worker(serving.address())
        self.finish(serving, [first, second])
        states = dict(rows(self.store, "select state, count(*) from worker group by state"))
        self.assertEqual(states.get("quarantined"), 1)


if __name__ == "__main__":
    unittest.main()
