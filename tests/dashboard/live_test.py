"""A campaign that runs, seen in a browser: numbers grow, equal what the command line says, survive a kill, obey who may act."""
import http.client
import http.server
import json
import os
import pathlib
import re
import shutil
import signal
import threading
import unittest

import looks
from dashboards import DashboardTest, add_real_run, finished_store, needs_browser, query, shared_browser, shared_folder
from pages_test import pages_of
from programs import call, campaign_text, ended_well

#: Experiments used, as the page of all campaigns says it.
USED = r"parseInt(document.querySelector('main').innerText.match(/experiments\s+([\d\u2009]+)/)[1].replace(/\u2009/g, ''))"


class Proxy(http.server.BaseHTTPRequestHandler):
    """A reverse proxy of one's own, that serves the dashboard under a prefix."""
    prefix = "/x/y/"

    def do_GET(self):
        if not self.path.startswith(self.prefix):
            self.send_error(404)
            return
        connection = http.client.HTTPConnection("127.0.0.1", self.server.target, timeout=30)
        headers = {name: value for name, value in self.headers.items() if name.lower() not in ("host", "connection")}
        connection.request("GET", self.path[len(self.prefix) - 1:], headers={**headers, "Host": f"127.0.0.1:{self.server.target}"})
        answer = connection.getresponse()
        body = answer.read()
        self.send_response(answer.status)
        for name, value in answer.getheaders():
            if name.lower() not in ("connection", "transfer-encoding", "content-length", "keep-alive"):
                self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)
        connection.close()

    def log_message(self, *_):
        pass


@needs_browser
class Live(DashboardTest):
    budget = 60000

    def setUp(self):
        super().setUp()
        # Four designs, so that it does not end while it is looked at; many short races, so that the first soon has steps.
        self.file.write_text(self.file.read_text().replace("[campaign]", "[campaign]\nrepetitions = 4")
                             .replace("[race]", "[race]\nnb_iterations = 60"))

    def running(self, http="127.0.0.1:*"):
        self.store = self.folder / "live.db"
        return self.start_serving("run", self.file, "--store", self.store, "--workers", "1", "--http", http)

    def test_numbers_grow_without_a_reload_and_the_focus_stays(self):
        serving = self.running()
        page = self.page(serving, "#/", f"{USED} > 0")
        page.js("window.mark = 1")
        used = page.js(USED)
        page.wait(f"{USED} > {used + 200}")
        page.js("location.hash = '#/c1/d1/race'")
        page.wait("document.querySelector('.race-map canvas') && document.querySelector('main input[type=search]')")
        page.js("document.querySelector('main input[type=search]').focus()")
        page.key("c")
        page.js("window.field = document.activeElement; window.renewals = 0; new MutationObserver(() => ++window.renewals)"
                ".observe(document.querySelector('.head'), {characterData: true, childList: true, subtree: true})")
        steps = "document.querySelector('#iteration').max * 1e6 + Number(document.querySelector('#step').max)"
        before = page.js(steps)
        page.wait("window.renewals >= 5", timeout=40)
        page.wait(f"{steps} > {before}")
        self.assertEqual(page.js("[document.activeElement === window.field, window.field.value, window.mark]"), [True, "c", 1])
        self.assert_quiet(page, serving)

    def test_every_page_of_a_running_campaign_is_quiet(self):
        serving = self.running()
        self.page(serving, "#/", f"{USED} > 1500").close()
        for address in ("#/", "#/c1/d1", "#/c1/d1/race", "#/c1/d1/space", "#/c1/machines", "#/c1/modules", "#/c1/results", "#/fleet", "#/c1/sql"):
            with self.subTest(page=address):
                page = self.page(serving, address)
                page.wait("document.querySelector('main .panel, main .empty')")
                self.assertEqual(page.js(looks.CONTRAST), [])
                self.assertEqual(looks.nameless(page), [])
                self.keep(page, "running-" + (re.sub(r"\W+", "-", address).strip("-") or "campaigns"))
                self.assert_quiet(page, serving)
                page.close()

    def test_the_numbers_are_those_of_the_command_line(self):
        store = finished_store()
        serving = self.dashboard(store)
        plain = lambda page: page.js("document.querySelector('main').innerText").replace("\u2009", "")
        rows = query(store, "SELECT * FROM v_designs")
        text = plain(self.page(serving, "#/", "document.querySelector('.svg svg')"))
        self.assertEqual(len(rows), 2)
        self.assertIn(str(sum(row["used"] for row in rows)), text)
        live = serving.get("live")["campaigns"][0]
        self.assertEqual([(one["used"], one["budget"], one["best"], one["best_mean"], one["state"]) for one in live["designs"]],
                         [(row["used"], row["budget"], f"c{row['best_candidate']}", row["best_mean"], row["state"]) for row in rows])
        self.assertEqual(live["used"], json.loads(call("status", store, "--json").stdout)["campaign"]["used"])
        self.assertEqual([row["used"] for row in json.loads(call("ls", "designs", store, "--json").stdout)["rows"]],
                         [one["used"] for one in live["designs"]])
        # A race: each of its cells.
        race = serving.get("c1/designs/d1/race?iteration=1")
        scores = {(row["step"], row["candidate"]): row["score"] for row in query(
            store, "SELECT step, candidate, score FROM v_race_matrix WHERE design = 1 AND iteration = 1")}
        mine = {(step, race["candidates"][at]): score for step, column in zip(race["steps"], race["scores"])
                for at, score in enumerate(column) if score is not None}
        self.assertEqual(mine, scores)
        # The fleet.
        workers = query(store, "SELECT worker, host, slots, done FROM v_workers")
        text = plain(self.page(serving, "#/fleet", "document.querySelector('table')"))
        for worker in workers:
            self.assertRegex(text, rf"{worker['host']}(.|\n)*{worker['done']}")
        # A candidate.
        best = rows[0]["best_candidate"]
        shown = plain(self.page(serving, f"#/c1/c{best}", "document.querySelector('.svg svg')"))
        known = query(store, f"SELECT runs, mean FROM v_candidates WHERE candidate = {best}")[0]
        self.assertRegex(shown, rf"runs\s+{known['runs']}\s")
        self.assertIn(f"{known['mean']:.4g}", shown)
        # Any statement.
        table = serving.get("c1/query?sql=SELECT%20design,used%20FROM%20v_designs")
        self.assertEqual(table["rows"], [[row["design"], row["used"]] for row in rows])

    def test_after_a_kill_the_page_says_so_and_goes_on_with_the_next_process(self):
        serving = self.running()
        page = self.page(serving, "#/", f"{USED} > 100")
        boot = serving.get("live")["boot"]
        os.killpg(serving.process.pid, signal.SIGKILL)
        serving.process.wait()
        page.wait("document.querySelector('.banner.warn')?.innerText.includes('No answer since')")
        self.assertTrue(page.js("document.body.classList.contains('stale')"))
        used = page.js(USED)
        again = self.running(f"127.0.0.1:{serving.port}")
        page.wait(f"!document.querySelector('.banner.warn') && document.querySelector('.banner')?.innerText.includes('Another process')", timeout=60)
        self.assertNotEqual(again.get("live")["boot"], boot)
        page.wait(f"{USED} > {used}", timeout=60)

    def test_only_clients_with_the_token_may_act(self):
        serving = self.running()
        token = serving.token or pathlib.Path(f"{self.store}.token").read_text().strip()
        pause = "api/v1/c1/designs/d1/pause"
        own = {"Authorization": f"Bearer {token}", "Content-Length": "0"}
        for status, method, headers, host in (
                (401, "POST", {"Content-Length": "0"}, None),
                (401, "POST", {"Authorization": "Bearer wrong", "Content-Length": "0"}, None),
                (403, "POST", {**own, "Origin": "http://example.org"}, None),
                (403, "POST", {**own, "Sec-Fetch-Site": "cross-site"}, None),
                (405, "GET", own, None), (405, "PUT", own, None), (405, "DELETE", own, None),
                (421, "POST", own, "example.org")):
            with self.subTest(method=method, headers=headers, host=host):
                self.assertEqual(serving.ask(pause, method, headers, host)[0], status)
        for path in ("", "api/v1/live", "main.js"):
            self.assertEqual(serving.ask(path, host="example.org:80")[0], 421, path)
        self.assertEqual(query(self.store, "SELECT count(*) AS n FROM v_commands"), [{"n": 0}])
        # Without the token the page has no way to act.
        page = self.page(serving, "#/c1/d1", "document.querySelector('.facts')")
        page.wait("[...document.querySelectorAll('button')].some(one => one.innerText === 'Pause')")
        self.act(page, "Pause")
        self.assertEqual(page.js("document.querySelector('dialog .main, dialog .danger').disabled"), True)
        page.close()
        page = shared_browser().page()
        self.addCleanup(page.close)
        page.open(f"{serving.address}#t={token}", "document.querySelector('main h1')")
        self.assertNotIn(token, page.js("location.href"))
        page.js("location.hash = '#/c1/d1'")
        page.wait("[...document.querySelectorAll('button')].some(one => one.innerText === 'Pause')")
        for label, row in (("Pause", "pause"), ("Resume", "resume"), ("Extend", "extend"), ("Cancel", "cancel")):
            page.wait(f"[...document.querySelectorAll('main button')].some(one => one.innerText === '{label}')")
            self.act(page, label)
            if label == "Cancel":  # the page hears of the end before it hears the answer
                page.js("""{
                    const ask = window.fetch;
                    const offers = () => [...document.querySelectorAll('main button')].some(one => one.innerText === 'Pause');
                    window.fetch = async (...words) => {
                        const answer = await ask(...words);
                        while (words[1]?.method === 'POST' && offers()) await new Promise(go => setTimeout(go, 20));
                        return answer;
                    };
                }""")
            page.click("dialog[open] .main, dialog[open] .danger:not([disabled])")
            page.wait("document.querySelector('dialog[open] .done')")
            page.click("dialog[open] .tools button")
            self.assertEqual(query(self.store, "SELECT kind, design, who FROM v_commands ORDER BY number DESC LIMIT 1")[0]["kind"], row)
        who = query(self.store, "SELECT DISTINCT who FROM v_commands")
        self.assertEqual(len(who), 1)
        self.assertRegex(who[0]["who"], r"^dashboard \w+@127\.0\.0\.1")
        self.assert_quiet(page, serving)

    def act(self, page, label):
        page.js(f"[...document.querySelectorAll('main button')].find(one => one.innerText === '{label}').click()")
        page.wait("document.querySelector('dialog[open]')")

    def test_all_pages_work_under_the_prefix_of_a_proxy(self):
        store = shared_folder() / "prefix.db"
        shutil.copy(finished_store(), store)
        add_real_run(store, "c%d" % query(store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"])
        serving = self.dashboard(store)
        proxy = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Proxy)
        self.addCleanup(proxy.server_close)
        self.addCleanup(proxy.shutdown)
        proxy.target = serving.port
        threading.Thread(target=proxy.serve_forever, daemon=True).start()
        for name, address, expression in pages_of(store):
            with self.subTest(page=name):
                page = self.page(f"http://127.0.0.1:{proxy.server_port}/x/y/", address, expression)
                self.assertEqual(page.errors(), [])
                self.assertEqual(page.hosts(), {f"127.0.0.1:{proxy.server_port}"})
                page.close()

    def test_an_exported_file_opens_from_disk_and_asks_no_server(self):
        store = finished_store()
        file = self.folder / "export.html"
        ended_well(call("dashboard", store, "--export", file))
        self.assertLess(file.stat().st_size, 500_000)
        used = query(store, "SELECT sum(used) AS used FROM v_designs")[0]["used"]
        address = file.as_uri()
        best = query(store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"]
        for fragment, expression in (("#/", f"{USED} === {used}"), ("#/c1/d1", "document.querySelectorAll('.svg svg').length >= 2"),
                                     ("#/c1/d1/race/1", "document.querySelector('.race-map canvas')"), ("#/c1/d1/space", "document.querySelector('.canvas canvas')"),
                                     (f"#/c1/c{best}", "document.querySelector('.svg svg')"), ("#/c1/machines", "document.querySelectorAll('.svg svg').length === 2")):
            with self.subTest(page=fragment):
                page = self.page(address, fragment, expression)
                self.assertEqual(page.errors(), [])
                self.assertEqual(page.hosts(), set())
                self.assertNotIn("@", page.js("document.querySelector('.head').innerText"))  # of who wrote it
                # No process is there that could answer SQL.
                self.assertEqual(page.js("document.querySelectorAll('textarea, [href*=\"/sql\"]').length"), 0)
                page.close()

    def test_a_hidden_page_asks_nothing(self):
        serving = self.running()
        asked = "performance.getEntriesByType('resource').length"
        hide = "Object.defineProperty(document, 'hidden', {value: true, configurable: true}); document.dispatchEvent(new Event('visibilitychange')); 0"
        page = self.page(serving, "#/fleet", "document.querySelector('.canvas canvas')")
        other = self.page(serving, "#/", f"{USED} > 0")
        page.js(hide)
        # What was on its way has come when the other page has asked twice.
        other.wait(f"{asked} >= {other.js(asked) + 2}")
        before = page.js(asked)
        other.wait(f"{asked} >= {other.js(asked) + 4}")
        self.assertEqual(page.js(asked), before)
        page.js("delete document.hidden; document.dispatchEvent(new Event('visibilitychange')); 0")
        page.wait(f"{asked} > {before + 2}")
        self.assert_quiet(page, serving)

    def test_ten_tabs_of_one_browser_stay_alive(self):
        serving = self.running()
        pages = [self.page(serving, "#/", f"{USED} > 0") for _ in range(10)]
        for page, used in [(page, page.js(USED)) for page in pages]:
            page.wait(f"{USED} > {used}")

    def test_two_coordinators_have_two_ports(self):
        first = self.running()
        self.file.write_text(campaign_text(self.budget, seed=8, tests=5))
        self.store = self.folder / "other.db"
        second = self.start_serving("run", self.file, "--store", self.store, "--workers", "1", "--http", "127.0.0.1:*")
        self.assertNotEqual(first.port, second.port)
        self.assertEqual(len({first.get("live")["boot"] for _ in range(6)}), 1)
        self.assertNotEqual(first.get("live")["boot"], second.get("live")["boot"])


if __name__ == "__main__":
    unittest.main()
