"""One campaign, and all that say how far it is: `run --json`, `status`, `ls`, `/status`, `/metrics`, the dashboard and the
store. Every number that two of them have is the same, whether the campaign runs, rests, is finished, extended, cancelled,
or has no race."""
import http.client
import json
import re
import signal
import subprocess
import threading
import unittest

from programs import PATIENCE, SWARMSMITH, ProgramTest, call, ended_well, wait_for

TWO_DESIGNS = "repetitions = 2\n"
NUMBERS = ("designs", "designs_finished", "used", "budget", "left")


class Said:
    """Numbers by who said them: {"used": {"status": 2997, "live": 2997}}."""

    def __init__(self):
        self.by_name = {}

    def add(self, who, numbers):
        for name, value in numbers.items():
            self.by_name.setdefault(name, {})[who] = value


def designs_said(rows, key):
    return {f"{row[key]}.{name}": row[name] for row in rows for name in ("state", "used", "budget", "iteration") if name in row}


class OneState(ProgramTest):
    budget = 1500
    tests = 5

    def setUp(self):
        super().setUp()
        self.store = self.folder / "one.db"
        self.file.write_text(self.file.read_text().replace('store = "unused.db"\n', 'store = "unused.db"\n' + TWO_DESIGNS))
        self.events = []

    def begin(self, *words):
        """A program that prints where its dashboard is; what it writes as JSON is kept."""
        process = subprocess.Popen([SWARMSMITH, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        events = self.events = []
        reader = threading.Thread(target=lambda: events.extend(line for line in process.stdout), daemon=True)
        reader.start()
        self.addCleanup(reader.join)
        self.addCleanup(self._end, process)  # first of all
        said = []
        for line in process.stderr:
            said.append(line)
            if found := re.search(r"dashboard: http://127\.0\.0\.1:(\d+)/$", line.strip()):
                self.port = int(found[1])
                break
        else:
            self.fail("no dashboard:\n" + "".join(said))
        threading.Thread(target=process.stderr.read, daemon=True).start()
        return process

    def run_it(self, *words):
        return self.begin("run", self.file, "--store", self.store, "--workers", "1", "--json", "--http", "127.0.0.1:*", *words)

    def get(self, path):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request("GET", path)
            return connection.getresponse().read().decode()
        finally:
            connection.close()

    def ended(self, process, code=0):
        self.assertEqual(process.wait(timeout=120 * PATIENCE), code)

    # --- who says how far it is ---

    def of_the_run(self, said):
        progress = [json.loads(line) for line in list(self.events) if '"event":"progress"' in line][-1]
        said.add("run --json", {name: progress[name] for name in NUMBERS + ("in_step",)})

    def of_status(self, said, text):
        status = json.loads(text)
        [campaign] = status["campaigns"]
        totals = {name: campaign[name] for name in NUMBERS + ("in_step", "state", "designs_stopped", "designs_paused") if name != "designs"}
        said.add("status --json", {**totals, "designs": len(campaign["designs"])})
        said.add("status --json, designs", designs_said([{**one, "id": f"d{one['id']}"} for one in campaign["designs"]], "id"))
        for name in ("used", "budget", "left"):
            said.add("status --json, sum of designs", {name: sum(one[name] for one in campaign["designs"])})
        return status

    def of_others(self, said):
        line = call("status", self.store).stdout
        found = re.search(r"campaign survival  (\w+)  designs (\d+)/(\d+)  experiments (\d+)/(\d+) \((.*)\)", line)
        self.assertIsNotNone(found, line)
        said.add("status", {"state": found[1], "designs_finished": int(found[2]), "designs": int(found[3]), "used": int(found[4]),
                            "budget": int(found[5])})
        if int(found[5]) > 0:
            left = next(iter(said.by_name["left"].values()))
            self.assertEqual(found[6], f"{round(100 * (int(found[5]) - left) / int(found[5]))} %")
        rows = json.loads(call("ls", "designs", self.store, "--json").stdout)["rows"]
        said.add("ls designs", {"designs": len(rows), **{name: sum(row[name] for row in rows) for name in ("used", "budget")},
                                **designs_said(rows, "design")})
        [head] = self.query(self.store, "SELECT * FROM v_campaign_status")
        said.add("v_campaign_status", {name: head[name] for name in ("designs", "designs_finished", "designs_stopped", "used", "budget")})

    def of_pages(self, said):
        live = json.loads(self.get("/api/v1/live"))
        [campaign] = live["campaigns"]
        said.add("dashboard", {**{name: campaign[name] for name in ("used", "budget", "left", "state")}, "designs": len(campaign["designs"])})
        said.add("dashboard, designs", designs_said(campaign["designs"], "id"))
        return live

    def of_metrics(self, said):
        values = dict(re.findall(r'^swarmsmith_campaign_(used|budget|left)\{.*\} (\S+)$', self.get("/metrics"), re.MULTILINE))
        said.add("metrics", {name: int(float(value)) for name, value in values.items()})
        [paused] = re.findall(r"^swarmsmith_paused_designs\{.*\} (\S+)$", self.get("/metrics"), re.MULTILINE)
        said.add("metrics", {"designs_paused": int(float(paused))})

    def assert_one(self, said, least):
        """All said the same, and each of `least` was said by so many."""
        different = {name: by for name, by in said.by_name.items() if len(set(map(str, by.values()))) > 1}
        self.assertEqual(different, {})
        for name, number in least.items():
            self.assertGreaterEqual(len(said.by_name[name]), number, said.by_name[name])

    def at_rest(self, with_run=True):
        """Who says what, while no coordinator runs it."""
        said = Said()
        if with_run:
            self.of_the_run(said)
        self.of_status(said, call("status", self.store, "--json").stdout)
        self.of_others(said)
        process = self.begin("dashboard", self.store, "--http", "127.0.0.1:*")
        self.of_pages(said)
        process.terminate()
        process.wait(timeout=60 * PATIENCE)
        self.assert_one(said, {"used": 6, "budget": 6, "left": 3, "state": 3, "d1.state": 3, "designs_finished": 3})
        return {name: next(iter(by.values())) for name, by in said.by_name.items()}

    # --- campaigns ---

    def test_that_is_finished_extended_and_finished_again(self):
        self.ended(self.run_it())
        first = self.at_rest()
        self.assertEqual((first["state"], first["left"], first["designs_finished"], first["budget"]), ("finished", 0, 2, 3000))
        self.assertLessEqual(first["used"], 3000)
        ended_well(call("extend", self.store, "d1", "--budget", "400"))
        self.at_rest(with_run=False)
        self.ended(self.run_it())
        again = self.at_rest()
        self.assertEqual((again["state"], again["left"], again["budget"]), ("finished", 0, 3400))
        self.assertGreater(again["used"], first["used"])

    def test_that_runs_and_is_interrupted(self):
        self.file.write_text(self.file.read_text().replace(f"max_experiments = {self.budget}", "max_experiments = 1000000"))
        process = self.run_it()
        wait_for(lambda: (self.query(self.store, "SELECT sum(used) AS n FROM v_designs") if self.store.exists() else [{"n": 0}])[0]["n"] > 300,
                 "no experiments")
        self.assertEqual(call("pause", self.store).returncode, 0)
        wait_for(lambda: (status := json.loads(call("status", self.store, "--json").stdout))["leased"] == 0
                 and status["campaigns"][0]["designs_paused"] == 2 and status["uncommitted"] == 0, "no pause")
        status = ""

        def is_told():  # once a second
            nonlocal status
            status = call("status", self.store, "--json").stdout
            said = Said()
            self.of_the_run(said)
            return said.by_name["in_step"]["run --json"] == json.loads(status)["campaigns"][0]["in_step"]
        wait_for(is_told, "the run says no more")
        said = Said()
        self.of_the_run(said)
        live = self.of_status(said, status)
        self.assertEqual((live["running"], live["v"]), (True, 2))
        self.of_others(said)
        self.of_metrics(said)
        self.assertTrue(self.of_pages(said)["running"])
        self.of_status(said, self.get("/status"))
        self.assert_one(said, {"used": 7, "budget": 7, "left": 5, "state": 3, "designs_paused": 2, "d1.used": 3})
        process.send_signal(signal.SIGINT)
        self.ended(process, 130)
        rest = self.at_rest()
        self.assertEqual((rest["state"], rest["d1.state"], rest["in_step"]), ("interrupted", "interrupted", 0))
        self.assertGreater(rest["left"], 1_900_000)

    def test_of_which_a_design_is_cancelled(self):
        self.file.write_text(self.file.read_text().replace(f"max_experiments = {self.budget}", "max_experiments = 100000"))
        process = self.run_it()
        for design in ("d1", "d2"):
            wait_for(lambda: self.store.exists() and call("cancel", self.store, design).returncode == 0, "no cancelling")
        process.wait(timeout=120 * PATIENCE)
        rest = self.at_rest()
        self.assertEqual((rest["designs_stopped"], rest["left"], rest["d2.state"]), (2, 0, "stopped"))

    def test_that_has_no_race(self):
        self.file.write_text(self.file.read_text().replace(
            'flavour = "watermelon-argos3"\n', 'flavour = "watermelon-argos3"\nbaseline = "random"\n'))
        self.ended(self.run_it())
        rest = self.at_rest()
        self.assertEqual((rest["state"], rest["used"], rest["budget"], rest["left"]), ("finished", 0, 0, 0))


if __name__ == "__main__":
    unittest.main()
