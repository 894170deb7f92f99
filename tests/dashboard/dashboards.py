"""Real dashboards in a real browser: what the tests of this folder share."""
import atexit
import csv
import functools
import http.client
import io
import json
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "end_to_end"))
import browser  # noqa: E402
import looks  # noqa: E402
from programs import PATIENCE, SWARMSMITH, ProgramTest, call, campaign_text  # noqa: E402

#: Screenshots are kept here, where it is set.
PICTURES = os.environ.get("SWARMSMITH_PICTURES")

#: What HTML would obey.
MARKUP = "<img src=x onerror=alert(1)><b>\"'&amp;"

TWO_MISSIONS = """
[[mission]]
name = "color_selection"
  [mission.instances]
  test = { count = 5 }
"""


def needs_browser(test):
    """Skips a class of tests, by name, where they cannot run."""
    if browser.program() is None:
        return unittest.skip("no chromium-headless-shell and no chromium: apt-get install chromium-headless-shell")(test)
    return test


@functools.cache
def shared_browser():
    """One browser for all tests of a process."""
    one = browser.Browser()
    atexit.register(one.close)
    return one


@functools.cache
def shared_folder():
    folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
    atexit.register(folder.cleanup)
    return pathlib.Path(folder.name)


@functools.cache
def finished_store():
    """Two missions, 1,350 experiments each, seed 7: made once for all tests of a process."""
    file = shared_folder() / "finished.toml"
    file.write_text(campaign_text(1350, seed=7, tests=20) + TWO_MISSIONS)
    store = shared_folder() / "finished.db"
    done = call("run", file, "--store", store, "--no-dashboard")
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return store


def query(store, sql):
    done = call("query", store, sql, "--json")
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)["rows"]


#: As of real_check, without the run.
CHECKS = ((1, "frame rate", "ceiling", "passed", 30, 10, "frames/s", "gaps between frames", ""),
          (2, "cameras agree", "rvr1", "not run", None, None, "mm", "a clock that is wrong", "no two cameras saw it at the same time"))


def add_real_run(store, candidate, number=1, name="run01", seed=7, verdict="VALID", checks=()):
    """A run as tracking stores it: the candidate's own simulation, as if a camera had seen it, with a gap and an estimate."""
    rows = list(csv.DictReader(io.StringIO(call("replay", candidate, store, "--seed", seed, "--csv", "-").stdout)))
    score = json.loads(call("replay", candidate, store, "--seed", seed, "--json").stdout)["score"]
    kinds = {5: 1, 6: 1, 50: 2, 51: 2}
    with sqlite3.connect(store) as connection:
        connection.execute("INSERT INTO real_run (id, candidate, key, source, mission, name, recorded, duration, robots, cycles, mission_file, "
                           "arena_file, log) VALUES (?, ?, ?, 'real', 'aggregation', ?, '2026-11-21T10:00:00Z', 120, 3, ?, ?, '', '')",
                           (number, int(candidate[1:]), f"key {number}", name, len(rows) // 3,
                            'format = 1\nname = "aggregation"\npreset = "aggregation"\n'))
        connection.execute("INSERT INTO real_score (run, number, score, verdict, biased, program, reasons, report) "
                           "VALUES (?, 1, ?, ?, 0, 'swarmsmith-track', '[]', '{}')", (number, score, verdict))
        for robot in range(3):
            connection.execute("INSERT INTO real_robot VALUES (?, ?, ?, ?, '', 1190, 4, 2, 0, 0.2, 0, 1, 0, 0, 0, NULL, 0)",
                               (number, robot, f"rvr{robot + 1}", robot + 1))
        connection.executemany("INSERT INTO real_check VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", [(number, *check) for check in checks])
        connection.execute("UPDATE real_run SET checks = ? WHERE id = ?", (len(checks), number))
        connection.executemany("INSERT INTO real_cycle VALUES (?, ?, ?, ?, ?, ?, ?)",
                               [(number, row["cycle"], row["robot"], row["x"], row["y"], row["theta"], kinds.get(int(row["cycle"]), 0))
                                for row in rows])


class Serving:
    """A program that serves a dashboard: its process, address and token."""

    def __init__(self, process, port, token, lines):
        self.process, self.port, self.token, self.lines = process, port, token, lines
        self.address = f"http://127.0.0.1:{port}/"

    def ask(self, path, method="GET", headers=None, host=None):
        """Status, headers and body of an answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30 * PATIENCE)
        try:
            connection.putrequest(method, "/" + path, skip_host=True, skip_accept_encoding=True)
            connection.putheader("Host", host or f"127.0.0.1:{self.port}")
            for name, value in (headers or {}).items():
                connection.putheader(name, value)
            connection.endheaders()
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def get(self, path):
        status, _, body = self.ask("api/v1/" + path)
        while status == 202:
            time.sleep(0.05)  # it is being computed, on a loaded machine
            status, _, body = self.ask("api/v1/" + path)
        if status != 200:
            raise AssertionError(f"{path}: {status} {body[:300]}")
        return json.loads(body)


@needs_browser
class DashboardTest(ProgramTest):
    """A test with programs that serve dashboards, and pages of one browser that look at them."""

    def start_serving(self, *arguments, cwd=None):
        process = subprocess.Popen([SWARMSMITH, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True, cwd=cwd, env={**os.environ, "SWARMSMITH_LOG": "info"})
        self.addCleanup(process.stderr.close)
        self.addCleanup(self._end, process)
        lines, found = [], None
        while found is None:
            line = process.stderr.readline()
            lines.append(line)
            if line == "":
                self.fail(f"it served no dashboard: {lines}")
            found = re.search(r"http://127\.0\.0\.1:(\d+)/?(?:#t=(\w+))?", line)
        # What else it says must not fill the pipe.
        threading.Thread(target=lambda: lines.extend(process.stderr), daemon=True).start()
        return Serving(process, int(found[1]), found[2], lines)

    def dashboard(self, *stores):
        """`swarmsmith dashboard` of stores at rest."""
        return self.start_serving("dashboard", *stores, "--http", "127.0.0.1:*")

    def page(self, serving, fragment="#/", expression="true", width=1440, **media):
        page = shared_browser().page(width)
        self.addCleanup(page.close)
        page.media(**media)
        page.open((serving if isinstance(serving, str) else serving.address) + fragment,
                  f"document.querySelector('main h1') && !document.querySelector('.waiting') && ({expression})")
        return page

    def keep(self, page, name):
        if PICTURES:
            pathlib.Path(PICTURES).mkdir(parents=True, exist_ok=True)
            page.shot(str(pathlib.Path(PICTURES) / f"{name}.png"))

    def assert_for_everybody(self, page, serving, name, tabs=True):
        """Contrast, width, names, the way of the Tab key, and silence, at each width, light and dark."""
        for dark in (False, True):
            page.media(dark=dark)
            page.wait(f"document.documentElement.dataset.theme === '{'dark' if dark else 'light'}'")
            with self.subTest(page=name, dark=dark):
                self.assertEqual(page.js(looks.CONTRAST), [])
            for width in (1440, 390, 2560):
                page.viewport(width)
                with self.subTest(page=name, dark=dark, width=width):
                    self.assertEqual(page.js(looks.OVERFLOW), [])
                if width != 2560:
                    self.keep(page, f"{name}-{'dark' if dark else 'light'}-{width}")
        page.viewport(1440)
        with self.subTest(page=name):
            self.assertEqual(looks.nameless(page), [])
            if tabs:
                self.assertEqual(looks.unreached(page), [])
            self.assert_quiet(page, serving)

    def assert_quiet(self, page, serving, but=()):
        """No complaint of page or browser, no request to anywhere else."""
        said = [text for text in page.errors() if not any(words in text for words in but)]
        self.assertEqual(said, [])
        self.assertLessEqual(page.hosts(), {f"127.0.0.1:{serving.port}"})
