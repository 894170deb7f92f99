"""Who has no key, an old one, or another server's, is kept out and counted."""
import re
import unittest

from rig import FaultTest, rows, wait_for
from wire import Peer


class Keys(FaultTest):
    budget = 1500

    def setUp(self):
        super().setUp()
        self.keys = self.keygen(self.folder / "keys")

    def key_of_unlisted(self):
        """A key of this server that is not on its list any more."""
        self.keygen(self.keys, "--client", "gone")
        listed = self.keys / "clients.toml"
        text = listed.read_text()
        kept = [part for part in text.split("[[client]]") if 'name = "gone"' not in part]
        self.assertEqual(len(kept), text.count("[[client]]"))
        listed.write_text("[[client]]".join(kept))
        return self.keys / "gone.key"

    def refusals(self):
        """Connections refused, by reason."""
        found = {}
        for reason, times in re.findall(
                r'event="?connection refused"? reason="?([^"=]*?)"? times=(\d+)',
                self.serving.log()):
            found[reason] = found.get(reason, 0) + int(times)
        return found

    def test_only_listed_keys_come_in(self):
        unlisted = self.key_of_unlisted()
        self.keygen(self.keys, "--client", "late", "--expires", "2020-01-01")
        self.keygen(self.folder / "others")
        self.serving = self.serve("--keys", self.keys)
        address = self.serving.address()
        # It must not end while they knock.
        self.command("pause", "--key", self.keys / "operator.key")
        honest = self.worker(address, "--key", self.keys / "worker.key")
        wait_for(lambda: self.serving.progress().get("workers") == 1, "the honest worker", 30)
        kept_out = [self.worker(address, "--key", unlisted),
                    self.worker(address, "--key", self.keys / "late.key"),
                    self.worker(address, "--key", self.folder / "others" / "worker.key"),
                    self.worker(address)]
        for reason in ("unlisted key", "expired key", "wrong server key", "plaintext"):
            wait_for(lambda reason=reason: self.refusals().get(reason, 0) > 0
                     or not self.serving.alive(), f"the refusal of an {reason}", 30)
            self.assertGreater(self.refusals().get(reason, 0), 0, self.serving.tail())
            self.count(reason)
        with self.assertRaises((ConnectionError, TimeoutError)):
            Peer(address, timeout=5)
        self.count("stranger without encryption")
        for worker in kept_out:
            worker.kill()
        self.command("resume", "--key", self.keys / "operator.key")
        numbers = self.finish(self.serving, [honest])
        self.assertEqual(rows(self.store, "select pid from worker"), [(honest.pid,)])
        self.assertEqual(numbers["lost_workers"] if "lost_workers" in numbers else 0, 0)


if __name__ == "__main__":
    unittest.main()
