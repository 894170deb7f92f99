"""Keys, roles and the list of clients, with the real programs."""
import os
import re
import signal
import stat
import subprocess
import unittest

from programs import PATIENCE, SWARMSMITH, ProgramTest, call, ended_well, wait_for

DEADLINE_S = 60 * PATIENCE


class Security(ProgramTest):
    budget = 2000

    def setUp(self):
        super().setUp()
        self.keys = self.folder / "keys"
        ended_well(call("keygen", self.keys))
        self.store = self.folder / "s.db"
        self.where = self.folder / "s.db.coordinator"

    def start(self, name, *arguments):
        """Starts a program whose log can be read while it runs."""
        log = self.folder / (name + ".log")
        with open(log, "w") as stream:
            process = subprocess.Popen([SWARMSMITH, *map(str, arguments)], stderr=stream,
                                       stdout=subprocess.DEVNULL, start_new_session=True,
                                       cwd=self.folder)
        self.addCleanup(self._end, process)
        return process, log

    def serve(self, *arguments, bind="127.0.0.1:0"):
        started = self.start("serve", "serve", self.file, "--store", self.store, "--bind", bind,
                             *arguments)
        wait_for(lambda: "waiting for workers" in started[1].read_text() or
                 started[0].poll() is not None, "the address")
        return started

    def worker(self, name, *arguments):
        return self.start(name, "worker", "--coordinator", self.where, "--slots", "1", *arguments)

    def expected(self):
        plain = self.folder / "plain.db"
        ended_well(self.run_campaign(plain))
        return self.digest(plain)

    def stored(self):
        return self.query(self.store, "select count(*) as n from evaluation")[0]["n"]

    def assert_no_secret_in(self, *texts):
        for file in self.keys.glob("*.key"):
            secret = re.search(r'secret = "(.*)"', file.read_text()).group(1)
            for text in texts:
                self.assertNotIn(secret, text)

    def test_keys_are_private_and_never_overwritten(self):
        self.assertEqual(stat.S_IMODE(self.keys.stat().st_mode), 0o700)
        before = {file: file.read_bytes() for file in self.keys.iterdir()}
        self.assertEqual(len(before), 5)
        for file in before:
            self.assertEqual(stat.S_IMODE(file.stat().st_mode), 0o600, file)
        done = call("keygen", self.keys)
        self.assertEqual(done.returncode, 2)
        self.assertIn("never overwritten", done.stderr)
        done = call("keygen", self.keys, "--client", "guest", "--expires", "31.1.2027")
        self.assertEqual(done.returncode, 2)
        self.assertIn("2027-01-31", done.stderr)
        self.assertEqual(before, {file: file.read_bytes() for file in self.keys.iterdir()})

    def test_a_worker_with_a_key_comes_to_the_answer_of_a_plain_run(self):
        server, log = self.serve("--keys", self.keys)
        self.assertIn("key = ", self.where.read_text())
        address = re.search(r"tcp://(\S+)\"", self.where.read_text()).group(1)
        stranger, strangers_log = self.start("stranger", "worker", "--connect", address)
        wait_for(lambda: "connection refused" in log.read_text(), "the stranger's refusal")
        worker, workers_log = self.worker("worker", "--key", self.keys / "worker.key")
        self.assertEqual(worker.wait(timeout=DEADLINE_S), 0, workers_log.read_text())
        self.assertEqual(server.wait(timeout=DEADLINE_S), 0, log.read_text())
        self.assert_clean(self.store)
        self.assertEqual(self.digest(self.store), self.expected())
        rows = self.query(self.store, "select client, done > 0 as worked from worker")
        self.assertEqual(rows, [{"client": "worker", "worked": 1}])
        self.assertFalse(self.where.exists(), "a coordinator that ended takes its file away")
        stranger.send_signal(signal.SIGTERM)
        self.assertEqual(stranger.wait(timeout=DEADLINE_S), 0, strangers_log.read_text())
        self.assert_no_secret_in(log.read_text(), workers_log.read_text(),
                                 strangers_log.read_text())

    def test_local_workers_show_the_workers_key(self):
        ended_well(self.run_campaign(self.store, "--keys", self.keys, "--workers", "2"))
        self.assertEqual(self.digest(self.store), self.expected())
        rows = self.query(self.store, "select distinct client from worker")
        self.assertEqual(rows, [{"client": "worker"}])

    def test_commands_want_an_operators_key(self):
        server, log = self.serve("--keys", self.keys)
        for role, code in (("reader", 1), ("worker", 1), ("operator", 0)):
            done = call("pause", self.store, "--key", self.keys / f"{role}.key")
            self.assertEqual(done.returncode, code, role + ": " + done.stdout + done.stderr)
        ended_well(call("status", self.store, "--key", self.keys / "reader.key", "--json"))
        worker, workers_log = self.worker("worker", "--key", self.keys / "worker.key")
        wait_for(lambda: self.query(self.store, "select * from worker"), "the worker")
        self.assertEqual(self.stored(), 0, "what is paused is not leased")
        ended_well(call("resume", self.store, "--key", self.keys / "operator.key"))
        self.assertEqual(worker.wait(timeout=DEADLINE_S), 0, workers_log.read_text())
        self.assertEqual(server.wait(timeout=DEADLINE_S), 0, log.read_text())
        self.assertEqual(self.digest(self.store), self.expected())
        asked = self.query(self.store, "select kind from v_commands order by number")
        self.assertEqual([row["kind"] for row in asked], ["pause", "resume"])

    def test_a_list_that_changes_while_it_runs(self):
        clients = self.keys / "clients.toml"
        full = clients.read_text()
        server, log = self.serve("--keys", self.keys, "--budget", "100000")
        worker, workers_log = self.worker("worker", "--key", self.keys / "worker.key")
        wait_for(self.stored, "a result")
        # A mistake changes nothing.
        clients.write_text(full + "[[client]]\nname = 3\n")
        wait_for(lambda: "list of clients refused" in log.read_text(), "the complaint")
        self.assertRegex(log.read_text(), r"clients.toml:\d+:\d+")
        self.assertNotIn("cut_off", log.read_text())
        # Who is taken out is cut off, and stays out.
        clients.write_text(full.replace('name = "worker"\n',
                                        'name = "worker"\nexpires = 2020-01-01\n'))
        os.kill(server.pid, signal.SIGHUP)
        wait_for(lambda: "cut_off=1" in log.read_text(), "the cut")
        wait_for(lambda: "expired key" in log.read_text(), "the refusal")
        wait_for(lambda: "refuses this worker's key" in workers_log.read_text(),
                 "the worker's word")
        self.assertIsNone(worker.poll(), "a worker that is refused tries on")
        # And comes back when it is listed again.
        before = self.stored()
        clients.write_text(full)
        wait_for(lambda: self.stored() > before + 100, "its work")
        failed = self.query(self.store, "select * from evaluation where status <> 0")
        self.assertEqual(failed, [], "no worker is blamed for a cut")
        server.send_signal(signal.SIGTERM)
        self.assertEqual(server.wait(timeout=DEADLINE_S), 143)
        self.assertFalse(self.where.exists())

    def test_a_coordinator_that_moved_is_found(self):
        server, _ = self.serve("--keys", self.keys, "--budget", "100000")
        first = self.where.read_text()
        worker, workers_log = self.worker("worker", "--key", self.keys / "worker.key")
        wait_for(self.stored, "a result")
        os.killpg(server.pid, signal.SIGKILL)
        server.wait()
        count = self.stored()
        self.serve("--keys", self.keys, "--budget", "100000")
        self.assertNotEqual(self.where.read_text(), first)
        wait_for(lambda: self.stored() > count + 100, "work at the new address")
        self.assertIsNone(worker.poll(), workers_log.read_text())

    def test_beyond_loopback_there_are_keys_or_a_warning(self):
        empty = dict(os.environ, SWARMSMITH_KEYS=str(self.folder / "none"))
        done = subprocess.run([SWARMSMITH, "serve", self.file, "--store", self.store, "--bind",
                               "0.0.0.0:0"], env=empty, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("swarmsmith keygen", done.stderr)
        server, log = self.serve("--insecure-plaintext", "--advertise", "127.0.0.1",
                                 bind="0.0.0.0:0")
        self.assertIn("without encryption", log.read_text())
        self.assertIn("insecure_plaintext = true", self.where.read_text())
        server.send_signal(signal.SIGTERM)
        server.wait(timeout=DEADLINE_S)
        _, log = self.serve("--keys", self.keys, "--advertise", "127.0.0.1", bind="0.0.0.0:0")
        self.assertIn('endpoint = "tcp://127.0.0.1:', self.where.read_text())
        self.assertNotIn("without encryption", log.read_text())

    def test_secrets_that_others_may_read_are_refused(self):
        for name, words in (("server.key", ("serve", self.file, "--keys", self.keys)),
                            ("worker.key", ("worker", "--connect", "127.0.0.1:1", "--key",
                                            self.keys / "worker.key"))):
            os.chmod(self.keys / name, 0o640)
            done = call(*words, cwd=self.folder, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("chmod 600", done.stderr)
            self.assert_no_secret_in(done.stderr)
            os.chmod(self.keys / name, 0o600)


if __name__ == "__main__":
    unittest.main()
