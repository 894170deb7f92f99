"""The dashboard's answers from real processes: while a campaign runs, after a crash, at rest, and as a file."""
import base64
import gzip
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import threading
import time
import unittest

from programs import SWARMSMITH, ProgramTest, call, ended_well, wait_for


class Dashboard(ProgramTest):
    # More than a test takes: it lasts for minutes on two fast processors.
    budget = 1_000_000

    def begin(self, *words, env=None):
        """Starts a command that prints where its dashboard is."""
        process = subprocess.Popen([SWARMSMITH, *map(str, words)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True,
                                   env={**os.environ, **(env or {})})
        self.addCleanup(process.stderr.close)
        self.addCleanup(self._end, process)
        self.said = []
        address = re.compile(r"dashboard: http://127\.0\.0\.1:(\d+)/$")
        for line in process.stderr:
            self.said.append(line)
            if found := address.search(line.strip()):
                self.port = int(found[1])
                break
        else:
            self.fail("no dashboard:\n" + "".join(self.said))
        threading.Thread(target=lambda: self.said.extend(process.stderr), daemon=True).start()
        return process

    def ask(self, path, method="GET", headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        try:
            connection.request(method, "/api/v1/" + path, headers=headers or {})
            answer = connection.getresponse()
            if answer.status != 202:
                return answer.status, json.loads(answer.read())
        finally:
            connection.close()
        time.sleep(0.05)  # it is being computed, on a loaded machine
        return self.ask(path, method, headers)

    def live(self):
        status, live = self.ask("live")
        self.assertEqual(status, 200, live)
        return live

    def eventually(self, get, timeout=60):
        return wait_for(get, lambda: "".join(self.said)[-2000:], timeout, 0.05)

    def watch_campaign(self):
        self.store = self.folder / "watched.db"
        return self.begin("run", self.file, "--store", self.store, "--workers", "1", "--http", "127.0.0.1:*")

    def bearer(self, store=None):
        token = pathlib.Path(str(store or self.store) + ".token")
        self.assertEqual(token.stat().st_mode & 0o777, 0o600)
        return {"Authorization": "Bearer " + token.read_text().strip()}

    def commands(self):
        return self.query(self.store, "SELECT kind, who FROM v_commands ORDER BY number")

    def test_a_running_campaign(self):
        process = self.watch_campaign()
        first = self.eventually(lambda: (live := self.live())["running"] and live["campaigns"][0]["used"] > 0 and live)
        self.assertEqual(first["pid"], process.pid)
        self.assertGreater(self.eventually(lambda: (used := self.live()["campaigns"][0]["used"]) >
                                           first["campaigns"][0]["used"] and used), 0)
        # Workers, and where their time goes.
        workers = self.eventually(lambda: self.ask("workers")[1]["workers"])
        self.assertEqual({w["state"] for w in workers}, {"connected"})
        history = self.eventually(lambda: len((h := self.ask("history")[1])["t_s"]) > 1 and h)
        self.assertEqual(len({len(column) for name, column in history.items() if name != "v"}), 1)
        # The race grows; what came before stays.
        self.eventually(lambda: self.live()["campaigns"][0]["designs"][0]["version"] > 3)
        race = self.ask("c1/designs/d1/race?iteration=1")[1]
        later = self.eventually(lambda: len((r := self.ask("c1/designs/d1/race?iteration=1")[1])["steps"]) >
                                len(race["steps"]) and r or r["ended"] and r)
        self.assertEqual(later["steps"][:len(race["steps"])], race["steps"])

        # Acts: with the secret alone, recorded as this person's, and they act.
        self.assertEqual(self.ask("c1/designs/d1/pause", "POST")[0], 401)
        status, done = self.ask("c1/designs/d1/pause", "POST", self.bearer())
        self.assertEqual(status, 200, done)
        self.assertEqual((done["command"], done["design"]), ("pause", "d1"))
        self.eventually(lambda: self.live()["campaigns"][0]["designs"][0]["paused"])
        status, done = self.ask("c1/resume", "POST", self.bearer())
        self.assertEqual(status, 200, done)
        self.eventually(lambda: not self.live()["campaigns"][0]["designs"][0]["paused"])
        rows = self.commands()
        self.assertEqual([row["kind"] for row in rows], ["pause", "resume"])
        for row in rows:
            self.assertRegex(row["who"], r"dashboard .+@127\.0\.0\.1")
        status, refused = self.ask("c1/designs/d9/pause", "POST", self.bearer())
        self.assertEqual((status, refused["error"]["kind"]), (404, "not_found"))

        # A statement that would need a gigabyte does not stop the race.
        status, refused = self.ask("c1/query?sql=SELECT%20length(hex(zeroblob(300000000)))")
        self.assertEqual(status, 400, refused)
        used = self.live()["campaigns"][0]["used"]
        self.eventually(lambda: self.live()["campaigns"][0]["used"] > used)

        # Killed, and started again: another process, the same campaign, never fewer experiments on disk.
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.begin("run", self.file, "--store", self.store, "--workers", "2", "--http", "127.0.0.1:*")
        again = self.eventually(lambda: (live := self.live())["running"] and live)
        self.assertNotEqual(again["boot"], first["boot"])
        self.assertEqual(again["campaigns"][0]["digest"], first["campaigns"][0]["digest"])

    def test_who_looks_hears_of_the_end(self):
        """A page asks once a second: its last answer says "finished", and the last words how to come back."""
        self.file.write_text(self.file.read_text().replace(f"{self.budget}", "1400"))
        process = self.watch_campaign()
        last = None
        while process.poll() is None:
            try:
                last = self.live()
            except (ConnectionError, http.client.HTTPException):
                break  # it has gone
            time.sleep(0.3)
        self.assertEqual(process.wait(), 0)
        self.assertEqual(last["campaigns"][0]["state"], "finished")
        self.assertEqual(last["campaigns"][0]["left"], 0)
        words = self.eventually(lambda: (text := "".join(self.said)).endswith("\n") and "How to continue" in text and text)
        self.assertIn(f"swarmsmith dashboard {self.store}\n", words)
        self.assertIn(f"swarmsmith report {self.store} -o report.html\n", words)
        self.assertNotIn("init mine", words)  # it was a campaign of one's own

    def test_two_coordinators_have_two_ports(self):
        self.watch_campaign()
        port = self.port
        self.store = self.folder / "second.db"
        self.begin("run", self.file, "--store", self.store, "--workers", "1", "--http", "127.0.0.1:*")
        self.assertNotEqual(self.port, port)

    def test_a_campaign_that_is_run_elsewhere(self):
        self.watch_campaign()
        coordinator = self.port
        self.begin("dashboard", self.store, "--http", "127.0.0.1:*")
        self.assertNotEqual(self.port, coordinator)
        self.eventually(lambda: (live := self.live())["running"] and live["status"]["workers"] == 1)
        self.assertGreater(len(self.eventually(lambda: self.ask("workers")[1]["workers"])), 0)
        # It has the secret of the coordinator, and leaves it where it is.
        status, done = self.ask("c1/designs/d1/pause", "POST", self.bearer())
        self.assertEqual(status, 200, done)
        self.assertEqual([row["kind"] for row in self.commands()], ["pause"])
        self.port = coordinator
        self.assertEqual(self.ask("c1/resume", "POST", self.bearer())[0], 200)

    def test_at_rest(self):
        store = self.folder / "rest.db"
        self.store = store
        done = ended_well(call("run", self.file, "--store", store, "--workers", "2", "--no-dashboard", "--budget", "1500", "-q"))
        process = self.begin("dashboard", store, "--http", "127.0.0.1:*")
        live = self.live()
        self.assertFalse(live["running"])
        self.assertEqual(live["campaigns"][0]["state"], "finished")
        status = json.loads(call("status", store, "--json").stdout)
        self.assertEqual(live["campaigns"][0]["used"], status["campaign"]["used"])
        listed = json.loads(call("ls", "designs", store, "--json").stdout)["rows"]
        for design, row in zip(live["campaigns"][0]["designs"], listed, strict=True):
            self.assertEqual((design["id"], design["state"], design["used"], design["best"], design["best_mean"]),
                             (row["design"], row["state"], row["used"], row["best_candidate"], row["best_mean"]))
        # Behind a cell of a race: the very run, to the last bit.
        race = self.ask("c1/designs/d1/race?iteration=1")[1]
        evaluation = race["candidates"][0] * 100000 + race["pairs"][0]
        run = self.ask(f"c1/runs/e{evaluation}/trajectory")[1]
        self.assertIs(run["same_bits"], True)
        self.assertEqual(run["score"], race["scores"][0][0])
        # An extension waits for the next run.
        status, done = self.ask("c1/designs/d1/extend?budget=100", "POST", self.bearer())
        self.assertEqual(status, 200, done)
        self.assertIn("when the campaign is run again", done["done"])
        self.assertEqual([row["kind"] for row in self.commands()], ["extend"])
        process.terminate()
        self.assertEqual(process.wait(timeout=30), 0)
        self.assertFalse(os.path.exists(f"{store}.token"), "the secret ends with its process")

    def test_an_imported_campaign_takes_no_commands(self):
        self.store = self.folder / "imported.db"
        log = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden/argos/argos-fsms.csv"
        ended_well(call("import", log, "--flavour", "watermelon-argos3", "--mission", "aggregation", "--into", self.store))
        self.begin("dashboard", self.store, "--http", "127.0.0.1:*")
        live = self.live()
        self.assertTrue(live["may_act"], "who serves the pages may act")
        self.assertIs(live["campaigns"][0]["may_act"], False)
        self.assertEqual(live["campaigns"][0]["state"], "imported")
        for path in ("c1/pause", "c1/designs/d1/cancel", "c1/designs/d1/extend?budget=100"):
            status, answer = self.ask(path, "POST", self.bearer())
            self.assertEqual((status, answer["error"]["kind"]), (409, "conflict"), path)
            self.assertIn("imported", answer["error"]["message"])
        self.assertEqual(self.commands(), [])

    def test_a_store_that_is_too_old_is_refused_with_the_way_out(self):
        old = self.folder / "old.db"
        shutil.copy(pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden/stores/schema-3.sqlite", old)
        for words in ([], ["--export", self.folder / "old.html"]):
            done = call("dashboard", old, "--http", "127.0.0.1:*", *words)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("`swarmsmith backup", done.stderr)
        self.assertFalse((self.folder / "old.html").exists())
        new = self.folder / "new.db"
        self.assertEqual(call("backup", old, new).returncode, 0)
        self.begin("dashboard", new, "--http", "127.0.0.1:*")
        self.assertEqual(self.live()["campaigns"][0]["state"], "finished")

    def test_an_export_that_cannot_be_written_does_not_begin(self):
        kept = self.folder / "kept.txt"
        kept.write_text("precious")
        store = self.folder / "small.db"
        ended_well(call("import", pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden/irace/log-acotsp", "--into", store))
        for file in (kept, self.folder, self.folder / "nowhere" / "page.html", store):
            done = call("dashboard", store, "--export", file)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertNotIn("made ", done.stderr)
        self.assertEqual(kept.read_text(), "precious")

    def test_a_score_that_no_axis_can_hold_is_damage_and_is_said_at_once(self):
        store = self.folder / "forged.db"
        ended_well(call("import", pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden/irace/log-acotsp", "--into", store))
        with sqlite3.connect(store) as connection:
            connection.execute("UPDATE evaluation SET score = 9e999")
        self.begin("dashboard", store, "--http", "127.0.0.1:*")
        for kind in ("scores", "box", "training", "gap", "ranks"):
            status, refused = self.ask(f"c1/figures/{kind}.svg")
            self.assertEqual((status, refused["error"]["kind"]), (409, "corrupt"), kind)
            self.assertIn("not finite", refused["error"]["message"])
        for path in ("live", "c1/designs/d1", "c1/designs/d1/race", "c1/candidates/c155", "c1/leaderboard"):
            self.assertEqual(self.ask(path)[0], 200, path)

    def test_a_file_to_send(self):
        store = self.folder / "sent.db"
        ended_well(call("run", self.file, "--store", store, "--workers", "2", "--no-dashboard", "--budget", "1500", "-q"))
        page = self.folder / "sent.html"
        done = call("dashboard", store, "--export", page, "--json")
        if "built without its pages" in done.stderr:
            self.skipTest("built without pages")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = page.read_text()
        self.assertEqual(json.loads(done.stdout)["bytes"], page.stat().st_size)
        self.assertLess(page.stat().st_size, 1_000_000)
        blob = re.search(r'<script id="snapshot" type="text/plain">([A-Za-z0-9+/=]+)</script>', text)[1]
        answers = json.loads(gzip.decompress(base64.b64decode(blob)))
        # The same answers as a server's.
        self.store = store
        self.begin("dashboard", store, "--http", "127.0.0.1:*")
        for path in ("c1/designs/d1", "c1/designs/d1/race?iteration=1", "c1/leaderboard", "c1/designs/d1/steps"):
            self.assertEqual(answers[path], self.ask(path)[1], path)
        runs = [answers[path] for path in answers if path.endswith("/trajectory")]
        self.assertGreater(len(runs), 1)
        for run in runs:
            self.assertIs(run["same_bits"], True)
        self.assertTrue(any(path.startswith("c1/figures/machine.svg?candidate=c") for path in answers))
        # Nothing of where it was made, and nothing to load. The campaign's file is as the store keeps it.
        self.assertFalse(str(self.folder) in text)
        for path, answer in answers.items():
            self.assertFalse(path != "c1" and str(self.folder) in json.dumps(answer), path)
        self.assertEqual(answers["live"]["user"], "")
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)[^"]*"', text.split('<script id="snapshot"')[0]), [])
        again = self.folder / "again.html"
        self.assertEqual(call("dashboard", store, "--export", again).returncode, 0)
        self.assertEqual(again.read_bytes(), page.read_bytes())
        wrong = call("dashboard", store, "--export", again, "--design", "d7")
        self.assertEqual(wrong.returncode, 4)
        self.assertEqual(call("dashboard", store, "--design", "d1").returncode, 2)
        self.assertEqual(call("dashboard").returncode, 2)
        self.assertEqual(call("dashboard", self.folder / "none.db").returncode, 3)


if __name__ == "__main__":
    unittest.main()
