"""Workers behind a real sshd: whichever end dies, nothing stays behind, and the answer is the same."""
import contextlib
import os
import pathlib
import signal
import subprocess
import unittest

import campaigns
from campaigns import PATIENCE, SWARMSMITH, ProgramTest, call, send, wait_for
import one_host_ssh


def processes(word, parent=None):
    """Ids of processes with this word on their command line."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            status = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except (OSError, IndexError):
            continue
        if status[0] != "Z" and any(word.encode() in w for w in words):
            if parent is None or int(status[1]) == parent:
                found.append(int(entry.name))
    return found


class Ssh(ProgramTest):
    def setUp(self):
        why = one_host_ssh.why_not()
        if why:
            self.skipTest(why)
        super().setUp()
        self.ssh = one_host_ssh.OneHostSsh(self.folder)
        self.addCleanup(self.ssh.stop)
        # A name of its own, by which this test's workers are told from others.
        self.worker = self.folder / "the worker"
        self.worker.symlink_to(pathlib.Path(SWARMSMITH).parent / "swarmsmith-worker")
        self.hosts = self.folder / "hosts"
        self.store = self.folder / "ssh.db"
        self.said = self.folder / "said.txt"
        keys = self.folder / "keys"
        done = call("keygen", keys)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.environment = {**os.environ, "SWARMSMITH_WORKER": str(self.worker),
                            "SWARMSMITH_KEYS": str(keys)}

    def campaign(self, hosts, budget=1500):
        self.hosts.write_text(hosts)
        self.file.write_text(campaigns.CAMPAIGN.format(
            repetitions=1, budget=budget, duration_s=240,
            workers='launcher = "ssh"\n[workers.ssh]\nhosts = "hosts"\n'
                    f'options = ["-F", "{self.ssh.client_config}"]\n'))

    def run_by_ssh(self):
        with open(self.said, "a") as said:
            process = subprocess.Popen(
                [SWARMSMITH, "run", self.file, "--store", self.store], stderr=said,
                stdout=subprocess.DEVNULL, start_new_session=True,
                env=self.environment)
        self.addCleanup(self._end, process)
        return process

    def started(self):
        """The workers' program: the workers, and the coordinator's own referee."""
        found = []
        for pid in processes(str(self.worker)):
            with contextlib.suppress(FileNotFoundError):  # it ended meanwhile
                if os.path.basename(os.readlink(f"/proc/{pid}/exe")) == "swarmsmith-worker":
                    found.append(pid)
        return found

    def workers(self):
        referees = processes("--referee")
        return [pid for pid in self.started() if pid not in referees]

    def wait_for_workers(self, count):
        wait_for(lambda: len(self.workers()) == count, f"{count} workers\n", 30)

    def wait_for_nobody(self):
        wait_for(lambda: not self.started(), "the end of all workers and the referee\n", 30)

    def finish(self, process):
        self.assertEqual(process.wait(timeout=200 * PATIENCE), 0, self.said.read_text())
        self.wait_for_nobody()
        self.assert_clean(self.store)
        local = self.folder / "local.db"
        done = self.run_campaign(local, "--workers", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.digest(self.store), self.digest(local))

    def test_hosts_that_do_not_answer_and_workers_and_ssh_that_are_killed(self):
        # Long enough to be running still when the second worker has come back.
        self.campaign("node1 slots=1\nnode2 slots=1 # the same host\nsilent\nclosed\n", 5000)
        process = self.run_by_ssh()
        self.wait_for_workers(2)
        # A worker that dies is started again.
        worker = self.workers()[0]
        send(worker, signal.SIGKILL)
        wait_for(lambda: len(self.workers()) == 2 and worker not in self.workers(),
                 "another worker", 30)
        # An ssh that dies takes its worker with it, and both come back.
        ssh = processes("node2", parent=process.pid)
        self.assertEqual(len(ssh), 1)
        before = set(self.workers())
        send(ssh[0], signal.SIGKILL)
        wait_for(lambda: len(self.workers()) == 2 and set(self.workers()) != before,
                 "another worker", 30)
        self.assertIsNone(process.poll(), self.said.read_text())
        wait_for(lambda: "silent: cannot be reached" in self.said.read_text()
                 or "closed: cannot be reached" in self.said.read_text(), "a word about the hosts")
        self.finish(process)
        states = {row["state"] for row in self.query(self.store, "select state from worker")}
        self.assertIn("left", states)

    def test_a_killed_coordinator_leaves_no_worker_behind(self):
        self.campaign("node1 slots=1\nnode2 slots=1\n")
        process = self.run_by_ssh()
        self.wait_for_workers(2)
        send(process.pid, signal.SIGKILL)
        process.wait()
        self.wait_for_nobody()
        process = self.run_by_ssh()
        self.wait_for_workers(2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        self.wait_for_nobody()

    def test_mistakes_are_named(self):
        self.campaign("node1 slot=1\n")
        done = self.run_to_its_end()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f"{self.hosts}:1:7: `slot=1` is none of slots=N", done.stderr)
        done = self.run_to_its_end("--workers", "ssh:nowhere")
        self.assertIn("nowhere: there is no such host file", done.stderr)
        self.assertNotEqual(done.returncode, 0)
        del self.environment["SWARMSMITH_KEYS"]
        self.environment["HOME"] = str(self.folder)
        done = self.run_to_its_end()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("`swarmsmith keygen`", done.stderr)

    def run_to_its_end(self, *words):
        return subprocess.run([SWARMSMITH, "run", self.file, "--store", self.store, *words],
                              env=self.environment, capture_output=True, text=True, timeout=60 * PATIENCE)


if __name__ == "__main__":
    unittest.main()
