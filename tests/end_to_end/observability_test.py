"""A running coordinator seen from outside: pages, status, the history of one evaluation."""
import contextlib
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import time
import unittest

from programs import SWARMSMITH, ProgramTest, call, ended_well, send, wait_for


class Observability(ProgramTest):
    # More than a test takes: it lasts for minutes on two fast processors.
    budget = 1_000_000
    TOKEN = "0123456789abcdef0123456789abcdef"

    def serve(self, *arguments, workers=2, http="127.0.0.1:*"):
        """Starts a coordinator and workers; returns its process when its pages are there."""
        self.store = self.folder / "watched.db"
        self.log = self.folder / "serve.log"
        with open(self.log, "w") as log:
            process = subprocess.Popen(
                [SWARMSMITH, "serve", str(self.file), "--store", str(self.store), "--bind",
                 "127.0.0.1:*", "--http", http, *arguments],
                stdout=subprocess.DEVNULL, stderr=log, start_new_session=True,
                env={**os.environ, "SWARMSMITH_LOG": "debug,json"})
        self.addCleanup(self._end, process)
        self.port = int(self.eventually(self.said(r"http://[^ ]*:(\d+)")))
        self.wires = self.eventually(self.said(r"worker --connect ([^ \n]+)\n"))
        self.workers = []
        for _ in range(workers):
            self.start_worker()
        return process

    def start_worker(self):
        worker = subprocess.Popen([SWARMSMITH, "worker", "--connect", self.wires, "--slots", "1"],
                                  stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(self._end, worker)
        self.workers.append(worker)

    def until_all_work(self):
        """Waits until all workers have come, and a hundred results, some of them committed. The workers come one by one, and
        the first may have sent hundreds by then."""
        self.eventually(lambda: self.metric("swarmsmith_workers") == len(self.workers))
        self.eventually(lambda: self.metric("swarmsmith_done_total") > 100)
        self.eventually(lambda: self.metric("swarmsmith_commit_seconds_count") > 0)

    def said(self, pattern):
        def found():
            match = re.search(pattern, self.log.read_text())
            return match and match.group(1)
        return found

    def eventually(self, get, timeout=60):
        return wait_for(get, lambda: self.log.read_text()[-2000:], timeout, 0.05)

    def get(self, path, method="GET", headers=None, host=None, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        try:
            connection.putrequest(method, path, skip_host=True)
            connection.putheader("Host", host or f"127.0.0.1:{self.port}")
            for name, value in (headers or {}).items():
                connection.putheader(name, value)
            if body is not None:
                connection.putheader("Content-Length", str(len(body)))
            connection.endheaders(body)
            answer = connection.getresponse()
            return answer.status, answer.read().decode(), dict(answer.getheaders())
        finally:
            connection.close()

    def metric(self, name):
        """Sum of the metric's samples."""
        text = self.get("/metrics")[1]
        values = re.findall(rf"^{name}(?:\{{.*\}})? (\S+)$", text, re.M)
        return sum(map(float, values))

    def test_pages_show_what_happens_and_only_to_whom_they_should(self):
        self.serve()
        self.until_all_work()
        self.assertEqual(self.get("/healthz")[:2], (200, "ok\n"))
        self.assertEqual(self.get("/readyz")[:2], (200, "ok\n"))
        self.assertGreater(self.metric("swarmsmith_received_bytes_total"), 1000)
        self.assertGreater(self.metric("swarmsmith_evaluation_seconds_count"), 100)
        self.eventually(lambda: self.metric("swarmsmith_step_seconds_count") > 0)
        status, text, headers = self.get("/status")
        self.assertEqual((status, headers["Content-Type"]), (200, "application/json"))
        self.assertNotIn("Access-Control-Allow-Origin", headers)
        live = json.loads(text)
        self.assertEqual(len(live["fleet"]), 2)
        self.assertEqual(live["campaigns"][0]["designs"][0]["state"], "racing")
        # Idle time by cause adds up, by real workers' heartbeats.
        def slot_times():
            times = json.loads(self.get("/status")[1])["slot_times"]
            return times if times["slots_s"] > 3 else None
        times = self.eventually(slot_times)
        self.assertAlmostEqual(times["slots_s"], times["busy_s"] + sum(times["idle_s"].values()),
                               places=6)
        self.assertGreater(times["busy_s"], 0.1)
        # Strangers.
        self.assertEqual(self.get("/status", host="evil.example")[0], 421)
        self.assertEqual(self.get("/status", method="POST", body=b"")[0], 405)
        self.assertEqual(self.get("/status", method="OPTIONS")[0], 405)
        self.assertEqual(self.get("/nothing")[0], 404)
        self.assertIn(self.get("/status", method="POST", body=b"x" * 1000)[0], (405, 413))

    def test_slow_clients_are_cut_off_and_hold_up_no_other(self):
        self.serve(workers=0)
        slow = [socket.create_connection(("127.0.0.1", self.port)) for _ in range(4)]
        for one in slow:
            one.sendall(b"GET /healthz HTT")
        self.assertEqual(self.get("/healthz")[0], 200)
        begin = time.monotonic()
        for one in slow:
            one.settimeout(20)
            while one.recv(1000):
                pass
            one.close()
        self.assertLess(time.monotonic() - begin, 15, "a slow client was not cut off")
        # A header without end is not a request.
        with socket.create_connection(("127.0.0.1", self.port)) as endless:
            endless.settimeout(20)
            try:
                for _ in range(100):
                    endless.sendall(b"X: " + b"a" * 1000 + b"\r\n")
                answer = endless.recv(100)
            except OSError:
                answer = b""
            self.assertNotIn(b"200", answer)
        self.assertEqual(self.get("/healthz")[0], 200)

    def test_a_token_is_asked_for(self):
        token = self.folder / "token"
        token.write_text(self.TOKEN + "\n")
        token.chmod(0o600)
        self.serve("--http-token-file", str(token), workers=0)
        self.assertEqual(self.get("/metrics")[0], 401)
        self.assertEqual(self.get("/metrics", headers={"Authorization": "Bearer wrong"})[0], 401)
        good = {"Authorization": "Bearer " + self.TOKEN}
        self.eventually(lambda: self.get("/metrics", headers=good)[0] == 200)
        self.assertEqual(self.get("/healthz")[:2], (200, "ok\n"))

    def test_pages_beyond_loopback_need_a_token_that_is_secret(self):
        store = self.folder / "beyond.db"
        refused = call("serve", self.file, "--store", store, "--bind", "127.0.0.1:*", "--http",
                       "0.0.0.0:*", timeout=60)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--http-token-file", refused.stderr)
        token = self.folder / "open"
        token.write_text(self.TOKEN)
        token.chmod(0o644)
        refused = call("serve", self.file, "--store", store, "--bind", "127.0.0.1:*", "--http",
                       "0.0.0.0:*", "--http-token-file", token, timeout=60)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("chmod 600", refused.stderr)

    def test_a_port_that_a_person_chose_is_not_replaced(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            refused = call("serve", self.file, "--store", self.folder / "t.db", "--bind",
                           "127.0.0.1:*", "--http", f"127.0.0.1:{taken.getsockname()[1]}",
                           timeout=60)
        self.assertEqual(refused.returncode, 5)
        self.assertIn("another program listens on this port", refused.stderr)

    def test_status_asks_the_coordinator_that_the_store_names(self):
        process = self.serve()
        self.until_all_work()
        done = ended_well(call("status", self.store, "--json"))
        live = json.loads(done.stdout)
        self.assertEqual(live["workers"], 2)
        self.assertGreater(live["done"], 100)
        text = call("status", self.store).stdout
        self.assertRegex(text, r"campaign survival  running  designs 0/1  experiments \d+/1000000")
        self.assertIn("workers 2  slots 2", text)
        # On a pipe, lines.
        watch = subprocess.Popen([SWARMSMITH, "status", str(self.store), "--watch"],
                                 stdout=subprocess.PIPE, text=True)
        self.addCleanup(watch.stdout.close)
        self.addCleanup(self._end, watch)
        line = watch.stdout.readline()
        self.assertRegex(line, r"^experiments \d+/1000000 .* workers 2  slots 2")
        send(watch.pid, signal.SIGINT)
        watch.wait(timeout=20)
        # Without a coordinator, from the store.
        send(process.pid, signal.SIGTERM)
        process.wait(timeout=60)
        stored = json.loads(call("status", self.store, "--json").stdout)
        self.assertIn("campaign", stored)

    def test_a_run_tells_of_its_workers_of_pauses_and_of_audits(self):
        self.file.write_text(self.file.read_text() + "[workers]\naudit_every = 3\n")
        store = self.folder / "run.db"
        process = self.start_campaign(store, "--workers", "2", "--http", "127.0.0.1:*")

        def live():
            done = call("status", store, "--json")
            status = json.loads(done.stdout) if done.returncode == 0 else {}
            return status if "fleet" in status else None

        def once(holds):
            return wait_for(lambda: (status := live()) and holds(status) and status, live, pause=0.1)

        status = once(lambda s: s["workers"] == 2 and s["done"] > 100
                      and 6 * s["audits"] > s["done"] / 2)
        launcher = status["launcher"]
        self.assertEqual((launcher["name"], launcher["wanted"]), ("local", 2))
        self.assertIn("launcher local: 2 of 2 workers run", call("status", store).stdout)
        self.assertFalse(status["campaigns"][0]["designs"][0]["paused"])
        paused = ended_well(call("pause", store))
        before = once(lambda s: s["campaigns"][0]["designs"][0]["paused"] and s["leased"] == 0)
        held = before["slot_times"]["idle_s"]["held"]
        after = once(lambda s: s["slot_times"]["idle_s"]["held"] > held + 1)
        self.assertEqual(after["slot_times"]["idle_s"]["commit"], 0)
        self.assertRegex(call("status", store).stdout, r"d1 +paused")
        self.assertEqual(call("resume", store).returncode, 0)
        once(lambda s: s["done"] > after["done"] + 100)
        send(process.pid, signal.SIGTERM)
        process.wait(timeout=60)

    def test_an_evaluation_that_was_lost_with_its_worker_tells_its_history(self):
        process = self.serve()
        self.until_all_work()
        # That a race wanted, and that another worker has done since.
        lost = ("select a.id from v_attempts as a join v_evaluations as e on e.id = a.id "
                "where a.outcome = 'lost' and e.iteration is not null and e.worker <> a.worker "
                "order by a.at limit 1")
        rows = []
        # A worker may hold nothing when it dies, or the other one may have had a copy of it.
        for kills in range(1, 11):
            send(-self.workers.pop(0).pid, signal.SIGKILL)
            self.start_worker()
            self.eventually(lambda kills=kills:
                            self.log.read_text().count('"worker lost"') >= kills)
            with contextlib.suppress(AssertionError):
                rows = self.eventually(lambda: self.query(self.store, lost), timeout=1)
                break
        self.assertTrue(rows, "nothing was lost in ten kills")
        evaluation = rows[0]["id"]
        history = json.loads(call("explain", evaluation, self.store, "--json").stdout)
        self.assertEqual(history["id"], evaluation)
        lost = next(one for one in history["attempts"] if one["outcome"] == "lost")
        self.assertIn("race of iteration", history["asked_for"])
        self.assertNotEqual(history["worker"]["worker"], lost["worker"])
        text = call("explain", evaluation, self.store).stdout
        self.assertIn("lost", text)
        self.assertIn(f"swarmsmith replay {evaluation}", text)
        self.assertEqual(call("explain", "e99999999900001", self.store).returncode, 4)
        self.assertEqual(call("explain", "c1", self.store).returncode, 2)
        # The log said so, an object a line.
        lines = [json.loads(line) for line in self.log.read_text().splitlines()
                 if line.startswith("{")]
        events = {line["event"] for line in lines}
        self.assertIn("worker lost", events)
        self.assertIn("worker connected", events)
        lost_line = next(line for line in lines if line["event"] == "worker lost")
        self.assertEqual(lost_line["level"], "warning")
        self.assertIsInstance(lost_line["worker"], int)
        self.eventually(lambda: '"race step"' in self.log.read_text())
        # Quieter by signal: steps are logged at the level debug, which is off then.
        send(process.pid, signal.SIGUSR2)
        send(process.pid, signal.SIGUSR2)

        def is_quiet():
            before = self.log.read_text().count('"race step"')
            seen = self.metric("swarmsmith_step_seconds_count")
            self.eventually(lambda: self.metric("swarmsmith_step_seconds_count") > seen + 3)
            return self.log.read_text().count('"race step"') == before

        self.eventually(is_quiet)


if __name__ == "__main__":
    unittest.main()
