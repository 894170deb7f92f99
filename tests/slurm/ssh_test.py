"""Workers behind a real sshd: whichever end dies, nothing stays behind, and the answer is the same."""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import unittest

import campaigns
from campaigns import PATIENCE, SWARMSMITH, ProgramTest, call, ended_well, send, wait_for
import bundle_test
import one_host_ssh


def program_of(pid):
    return pathlib.Path(os.readlink(f"/proc/{pid}/exe"))


def processes(word, parent=None, program=None):
    """Ids of processes with this word on their command line."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            status = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            if program is not None and program_of(entry.name) != pathlib.Path(program):
                continue
        except (OSError, IndexError):
            continue
        if status[0] != "Z" and any(word.encode() in w for w in words):
            if parent is None or int(status[1]) == parent:
                found.append(int(entry.name))
    return found


class SshTest(ProgramTest):
    max_startups = "100"

    def setUp(self):
        why = one_host_ssh.why_not()
        if why:
            self.skipTest(why)
        super().setUp()
        self.ssh = one_host_ssh.OneHostSsh(self.folder, self.max_startups)
        self.addCleanup(self.ssh.stop)
        # A name of its own, which tells this test's workers from others.
        self.worker = self.folder / "the worker"
        self.worker.symlink_to(pathlib.Path(SWARMSMITH).parent / "swarmsmith-worker")
        self.hosts = self.folder / "hosts"
        self.store = self.folder / "ssh.db"
        self.said = self.folder / "said.txt"
        keys = self.folder / "keys"
        ended_well(call("keygen", keys))
        self.environment = {**os.environ, "SWARMSMITH_WORKER": str(self.worker),
                            "SWARMSMITH_KEYS": str(keys)}

    def campaign(self, hosts, budget=1_000_000):
        """Without a budget, one that is interrupted long before its end, on any machine."""
        self.hosts.write_text(hosts)
        self.file.write_text(campaigns.cluster_text(
            budget, 1, 240, 'launcher = "ssh"\n[workers.ssh]\nhosts = "hosts"\n'
                            f'options = ["-F", "{self.ssh.client_config}"]\n'))

    def run_by_ssh(self, *words):
        with open(self.said, "a") as said:
            process = subprocess.Popen(
                [SWARMSMITH, "run", self.file, "--store", self.store, *words], stderr=said,
                stdout=subprocess.DEVNULL, start_new_session=True,
                env=self.environment)
        self.addCleanup(self._end, process)
        return process

    def started(self):
        """The workers' program: the workers, and the coordinator's own referee."""
        found = []
        for pid in processes(str(self.worker)):
            with contextlib.suppress(FileNotFoundError):  # it ended meanwhile
                if program_of(pid).name == "swarmsmith-worker":
                    found.append(pid)
        return found

    def workers(self):
        referees = processes("--referee")
        return [pid for pid in self.started() if pid not in referees]

    def wait_for_workers(self, count):
        wait_for(lambda: len(self.workers()) == count, f"{count} workers\n", 30)

    def wait_for_no_process(self):
        wait_for(lambda: not self.started(), "the end of all workers and the referee\n", 30)

    def finish(self, process):
        self.assertEqual(process.wait(timeout=200 * PATIENCE), 0, self.said.read_text())
        self.wait_for_no_process()
        self.assert_clean(self.store)
        local = self.folder / "local.db"
        ended_well(self.run_campaign(local, "--workers", "2"))
        self.assertEqual(self.digest(self.store), self.digest(local))


class Ssh(SshTest):
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
        self.wait_for_no_process()
        process = self.run_by_ssh()
        self.wait_for_workers(2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        self.wait_for_no_process()

    def test_mistakes_are_named(self):
        self.campaign("node1 slot=1\n")
        done = self.run_to_its_end()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f"{self.hosts}:1:7: `slot=1` is not one of slots=N", done.stderr)
        done = self.run_to_its_end("--workers", "ssh:nowhere")
        self.assertIn("nowhere: there is no such host file", done.stderr)
        self.assertNotEqual(done.returncode, 0)
        del self.environment["SWARMSMITH_KEYS"]
        self.environment["HOME"] = str(self.folder)
        done = self.run_to_its_end()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("`swarmsmith keygen`", done.stderr)

    def test_hosts_without_the_program_are_sent_it_even_if_sending_is_interrupted(self):
        if why := bundle_test.why_not():
            self.skipTest(why)
        bundles = self.folder / "the bundles"
        archive = bundle_test.pack(bundles)
        # The first time, half of it is unpacked, and then nothing comes for a long while.
        half, go_on = self.folder / "half", self.folder / "go on"
        os.mkfifo(go_on)
        xz = self.folder / "bin/xz"
        xz.parent.mkdir()
        xz.write_text(f"""#!/bin/sh
PATH=${{PATH#*:}}
if test "$1" = -dc && mkdir '{half}'; then xz "$@" | head -c 5000000; read line <'{go_on}'; fi
exec xz "$@"
""")
        xz.chmod(0o755)
        self.environment |= {"SWARMSMITH_BUNDLES": str(bundles), "PATH": f"{xz.parent}:{os.environ['PATH']}"}
        self.campaign("node1 slots=1\n")
        cache = self.ssh.cache / "swarmsmith"
        process = self.run_by_ssh("--ship")
        wait_for(lambda: half.exists() and list(cache.glob("new.*/*/lib/libc.so.6")), "half a bundle", 30)
        sending, = processes("mktemp", program=shutil.which("ssh"))
        send(sending, signal.SIGKILL)
        go_on.write_text("\n")
        wait_for(lambda: "the worker cannot be sent there" in self.said.read_text(), "a word about that")
        worker, = wait_for(self.sent, "a worker", 30)
        self.assertEqual([program_of(worker)], [path / "lib/ld.so" for path in cache.iterdir()])
        self.assertEqual([path.name.rsplit("-", 1)[0] for path in cache.iterdir()], [archive.name.removesuffix(".tar.xz")])
        self.interrupt(process)
        # What is there is not sent again.
        xz.write_text(f"#!/bin/sh\ntest \"$1\" = -tq || touch '{self.folder}/again'\n")
        self.file.write_text(self.file.read_text().replace("[workers]", "[workers]\nship = true"))
        process = self.run_by_ssh()
        wait_for(self.sent, "a worker", 30)
        self.interrupt(process)
        self.assertFalse((self.folder / "again").exists())

    def interrupt(self, process):
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        wait_for(lambda: not self.sent(), "the end of all workers", 30)

    def sent(self):
        """Workers of a bundle, by its loader: before that, the same process is the bundle's launcher."""
        found = []
        for pid in processes(str(self.ssh.cache / "swarmsmith")):
            with contextlib.suppress(FileNotFoundError):  # it ended meanwhile
                if (pathlib.Path(f"/proc/{pid}/comm").read_text() == "swarmsmith-work\n"
                        and program_of(pid).name == "ld.so"):
                    found.append(pid)
        return found

    def test_what_cannot_be_sent_is_said_at_once(self):
        self.environment["SWARMSMITH_BUNDLES"] = str(self.folder)
        self.campaign("node1\n")
        done = self.run_to_its_end("--ship")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn(f"{self.folder}: there is no bundle to send: `./dev bundle` makes swarmsmith-worker-", done.stderr)
        done = self.run_to_its_end("--ship", "--workers", "2")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--ship: applies to workers on other hosts", done.stderr)

    def run_to_its_end(self, *words):
        return subprocess.run([SWARMSMITH, "run", self.file, "--store", self.store, *words],
                              env=self.environment, capture_output=True, text=True, timeout=60 * PATIENCE)


class ManyHosts(SshTest):
    """One sshd for 24 hosts, as where all are reached through a login node, which lets three log in at a time."""
    max_startups = "3:100:3"

    def test_all_come_though_few_may_log_in_at_a_time(self):
        self.campaign("".join(f"node{i} slots=1\n" for i in range(24)))
        process = self.run_by_ssh()
        seen = []

        def all_run():
            done = call("status", self.store, "--json", "--key", self.folder / "keys/reader.key")
            live = json.loads(done.stdout) if done.returncode == 0 else {}
            if "launcher" not in live:
                return False
            seen.append((live["launcher"]["running"], live["workers"]))
            return live["launcher"]["running"] == 24

        wait_for(all_run, "24 workers", 120)
        # Workers count, not processes of ssh; both numbers are of the same moment, but for a tenth of a second.
        self.assertEqual(seen[-1], (24, 24), seen)
        for running, connected in seen:
            self.assertLessEqual(running, connected + 2, seen)
        print(f"\n  {self.ssh.turned_away()} logins turned away", end="")
        self.assertLessEqual(self.ssh.turned_away(), 12)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60 * PATIENCE), 130, self.said.read_text())
        self.wait_for_no_process()


if __name__ == "__main__":
    unittest.main()
