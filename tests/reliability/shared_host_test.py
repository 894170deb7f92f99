"""A host with other users: a campaign of user A on loopback, without keys and with the most ordinary settings, and user
B, who tries to see or change something of it. Both are users of the system; root makes them."""
import encodings.idna  # noqa: F401  another user may not be able to read Python's files
import http.client
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import threading
import traceback

import wire
from rig import SWARMSMITH, FaultTest, ended_well, need, need_root, rows, stored, wait_for

A, B = 20001, 20002


def as_user(user):
    """What to put before a command."""
    return ("setpriv", f"--reuid={user}", f"--regid={user}", "--clear-groups", "--")


def done_by(user, act):
    """What `act` returns, as JSON, in a process of that user; its exception is an AssertionError here."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            os.setgroups([])
            os.setgid(user)
            os.setuid(user)
            os.write(into, json.dumps(act()).encode())
            code = 0
        except BaseException:
            os.write(into, traceback.format_exc().encode())
        finally:
            os._exit(code)
    os.close(into)
    with os.fdopen(out, "rb") as stream:
        text = stream.read().decode()
    _, status = os.waitpid(child, 0)
    assert status == 0, text
    return json.loads(text)


def refused(act):
    """How the system refuses it; else what B got."""
    try:
        return f"got {act()!r}"
    except OSError as error:
        return type(error).__name__


class SharedHost(FaultTest):
    budget = 1_000_000  # it is ended by A

    def setUp(self):
        need_root("a second user")
        need("setpriv", "util-linux")
        super().setUp()
        # As a home folder of many systems: others may look into it.
        self.folder.chmod(0o755)
        for path in (self.folder, self.file):
            os.chown(path, A, A)
        if subprocess.run([*as_user(B), SWARMSMITH, "--version"], capture_output=True, check=False).returncode != 0:
            self.skipTest("skipped: other users cannot run the programs of this folder")
        self.addCleanup(os.umask, os.umask(0o022))
        self.home = {"HOME": str(self.folder)}

    def campaign(self):
        self.coordinator = self.serve("--http", "127.0.0.1:*", prefix=as_user(A), env=self.home)
        self.address = self.coordinator.address()
        self.pages = int(re.search(r"dashboard: http://127\.0\.0\.1:(\d+)/", self.coordinator.log()).group(1))
        self.own_worker = self.worker(self.address, prefix=as_user(A), env=self.home)
        self.wait_stored(50)

    def by(self, user, *words):
        """swarmsmith, to its end."""
        return subprocess.run([*as_user(user), SWARMSMITH, *map(str, words)], capture_output=True, text=True, timeout=120,
                              env={**os.environ, **self.home}, check=False)

    def say_raw(self, messages, patient):
        """A peer of the wire's own that says this, and hears the answers if it is patient; else it hangs up at once."""
        def act():
            heard = []
            try:
                with wire.Peer(self.address, timeout=5) as peer:
                    for fields in messages:
                        peer.send(wire.frame("ToCoordinator", fields))
                    while patient and (answer := peer.receive()):
                        heard.append(wire.message("ToWorker", answer))
            except (OSError, ConnectionError):
                pass
            return len(heard)
        return done_by(B, act)

    def ask_page(self, method, path, headers=()):
        def act():
            connection = http.client.HTTPConnection("127.0.0.1", self.pages, timeout=20)
            connection.request(method, path, headers=dict(headers))
            answer = connection.getresponse()
            return answer.status, answer.read().decode(errors="replace")
        return done_by(B, act)

    def assert_refused(self, done, way):
        self.assertNotEqual(done.returncode, 0, way)
        self.assertNotIn("survival", done.stdout, way)

    def test_another_user_sees_nothing_and_changes_nothing(self):
        self.campaign()
        ways = {
            "commands by the port": self.try_commands,
            "the status by the port": self.try_status,
            "a worker by the port": self.try_worker,
            "the coordinator's file": self.try_coordinator_file,
            "the store's commands": self.try_store,
            "files beside the store": self.try_files,
            "pages that show": self.try_pages,
            "pages that act": self.try_acts,
            "messages of one's own": self.try_messages,
            "messages before hanging up": self.try_hanging_up,
            "signals and /proc": self.try_process,
            "the folder": self.try_folder,
        }
        for way, attempt in ways.items():
            with self.subTest(way):
                attempt()
        self.count("way of another user", len(ways))
        # Nothing of that has had an effect.
        self.assertTrue(self.coordinator.alive(), self.coordinator.tail())
        self.assertEqual(rows(self.store, "select count(*) from command"), [(0,)])
        self.assertEqual(rows(self.store, "select count(*) from worker"), [(1,)])
        self.assertEqual(rows(self.store, "select state from v_designs"), [("racing",)])
        self.wait_stored(stored(self.store) + 50)
        self.assertRegex(self.coordinator.log(), r'reason="another user" .*last_from="user 20002"')
        self.own_tools()

    def own_tools(self):
        """Without typing anything more, A's own work."""
        for words in (("status", "--connect", self.address), ("status", self.store), ("digest", self.store),
                      ("pause", "d1", "--connect", self.address), ("resume", self.store)):
            done = self.by(A, *words)
            self.assertEqual(done.returncode, 0, f"{words}: {done.stdout}{done.stderr}")
        ask = f"http://127.0.0.1:{self.pages}/api/v1/live"
        page = subprocess.run([*as_user(A), "curl", "-sS", "--fail", ask], capture_output=True, text=True, timeout=60,
                              check=False)
        self.assertIn('"running":true', page.stdout, page.stderr)
        ended_well(self.by(A, "cancel", "d1", "--connect", self.address))
        self.assertEqual(self.coordinator.wait(), 0, self.coordinator.tail())
        self.assertEqual(self.own_worker.wait(), 0, self.own_worker.tail())
        self.assert_clean(self.store)

    # --- B's ways ---

    def try_commands(self):
        for words in (("cancel", "d1"), ("pause", "d1"), ("extend", "d1", "--budget", "10"), ("resume", "d1")):
            done = self.by(B, *words, "--connect", self.address)
            self.assert_refused(done, words)
            self.assertIn("belongs to another user of this host (20001)", done.stderr)

    def try_status(self):
        done = self.by(B, "status", "--connect", self.address, "--json")
        self.assert_refused(done, "status")
        self.assertIn("belongs to another user", done.stderr)

    def try_worker(self):
        worker = self.worker(self.address, prefix=as_user(B), env={"HOME": "/nonexistent"})
        wait_for(lambda: "belongs to another user" in worker.log() or not worker.alive(), "the worker's word", 20)
        self.assertTrue(worker.alive(), worker.tail())
        worker.send(signal.SIGTERM)
        self.assertEqual(worker.wait(), 0, worker.tail())

    def try_coordinator_file(self):
        file = f"{self.store}.coordinator"
        self.assertTrue(os.path.exists(file))
        done = self.by(B, "cancel", "d1", "--coordinator", file)
        self.assert_refused(done, "cancel")
        self.assertIn("Permission denied", done.stderr)

    def try_store(self):
        for words in (("status",), ("ls",), ("digest",), ("cancel", "d1"), ("report",), ("dashboard", "export")):
            self.assert_refused(self.by(B, words[0], *words[1:], self.store), words)
        self.assert_refused(self.by(B, "query", self.store, "select * from v_designs"), "query")
        self.assert_refused(self.by(B, "import", self.file, "--into", self.store), "import")

    def try_files(self):
        beside = [path for path in self.folder.iterdir() if path.name.startswith(self.store.name)]
        # The store, its log and its index, its lock, the address, the token.
        self.assertGreaterEqual(len(beside), 6, beside)
        for path in beside:
            for mode in ("rb", "r+b"):
                def act(path=path, mode=mode):
                    with open(path, mode) as stream:
                        return stream.read(16).hex()
                self.assertEqual(done_by(B, lambda act=act: refused(act)), "PermissionError", f"{path} {mode}")

    def try_pages(self):
        for path in ("/status", "/metrics", "/api/v1/live", "/api/v1/c1", "/api/v1/workers", "/api/v1/history",
                     "/api/v1/c1/query?sql=select+1"):
            status, text = self.ask_page("GET", path)
            self.assertEqual(status, 403, path)
            self.assertNotIn("survival", text)
        # Program files of the pages, which are the same for all, and whether the host is well.
        for path in ("/", "/healthz", "/readyz"):
            self.assertNotIn("survival", self.ask_page("GET", path)[1])

    def try_acts(self):
        for path in ("/api/v1/c1/pause", "/api/v1/c1/designs/d1/cancel", "/api/v1/c1/designs/d1/pause"):
            for headers in ({}, {"Authorization": "Bearer " + "0" * 64}):
                status, _ = self.ask_page("POST", path, headers)
                self.assertEqual(status, 403, path)

    WISH = {"sequence": 1, "incarnation": 1, "command": {"kind": 3, "design": 1, "who": "b"}}
    HELLO = {"sequence": 1, "incarnation": 1, "hello": {"worker_id": "0" * 32, "slots": 1}}

    def try_messages(self):
        for body in (self.WISH, {"sequence": 1, "want_status": {}}, self.HELLO, {"sequence": 1, "want_scenario": {}}):
            self.assertEqual(self.say_raw([body], patient=True), 0, body)

    def try_hanging_up(self):
        """A socket that no process holds any more is root's, as the kernel says."""
        for _ in range(20):
            self.say_raw([self.WISH] * 3, patient=False)

    def try_process(self):
        for pid in (self.coordinator.pid, self.own_worker.pid):
            self.assertEqual(done_by(B, lambda pid=pid: refused(lambda: os.kill(pid, signal.SIGTERM))), "PermissionError")
            for name in ("environ", "mem", "fd"):
                def act(pid=pid, name=name):
                    path = pathlib.Path(f"/proc/{pid}/{name}")
                    return os.listdir(path) if name == "fd" else path.read_bytes()[:16].hex()
                self.assertEqual(done_by(B, lambda act=act: refused(act)), "PermissionError", name)

    def try_folder(self):
        for act in (lambda: os.rename(self.store, f"{self.store}.b"), lambda: os.unlink(f"{self.store}.lock"),
                    lambda: open(f"{self.store}.stop", "w").close()):
            self.assertEqual(done_by(B, lambda act=act: refused(act)), "PermissionError")

    # --- the other way round ---

    def test_a_port_that_another_user_has_taken_hears_nothing(self):
        """The coordinator is killed, its file stays, and B listens at its port: A's programs do not even greet there."""
        self.campaign()
        host, port = self.address.rsplit(":", 1)
        self.coordinator.kill()
        heard = self.folder / "heard"
        heard.touch()
        os.chown(heard, B, B)
        listener = os.fork()
        if listener == 0:
            os.setgroups([])
            os.setgid(B)
            os.setuid(B)
            with socket.create_server((host, int(port))) as server:
                heard.write_text("listens\n")
                while True:
                    end, _ = server.accept()
                    threading.Thread(target=self.serve_as_b, args=(end, heard), daemon=True).start()
        self.addCleanup(os.waitpid, listener, 0)
        self.addCleanup(os.kill, listener, signal.SIGKILL)
        wait_for(lambda: "listens" in heard.read_text(), "B's server")
        wait_for(lambda: "belongs to another user" in self.own_worker.log(), "the worker's word")
        for words in (("status", "--connect", self.address), ("cancel", "d1", "--connect", self.address)):
            done = self.by(A, *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("belongs to another user of this host (20002)", done.stderr)
        self.assertEqual(heard.read_text(), "listens\n")
        self.assertTrue(self.own_worker.alive(), "it waits for its coordinator")
        self.own_worker.send(signal.SIGTERM)
        self.assertEqual(self.own_worker.wait(), 0, self.own_worker.tail())

    @staticmethod
    def serve_as_b(end, heard):
        """A ROUTER by hand that notes what it hears."""
        frames = wire.Frames()
        end.sendall(wire.GREETING + wire.ready(b"ROUTER"))
        while some := end.recv(65536):
            for flags, body in frames.feed(some):
                with heard.open("a") as out:
                    out.write(f"{flags} {body!r}\n")
