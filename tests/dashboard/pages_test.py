"""Each page of a finished campaign, of an empty store and of a hostile one: quiet, for everybody, at each width, light and dark."""
import pathlib
import shutil
import sqlite3
import unittest

import looks
from browser import BrowserError
from dashboards import MARKUP, DashboardTest, add_real_run, finished_store, needs_browser, query, shared_browser, shared_folder


def pages_of(store):
    """Name, address and what must be there, of every page."""
    best = query(store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"]
    run, cell = query(store, f"SELECT id, candidate FROM v_evaluations WHERE candidate = {best} AND purpose = 'race' LIMIT 1")[0].values()
    return [
        ("campaigns", "#/", "document.querySelector('.svg svg')"),
        ("design", "#/c1/d1", "document.querySelectorAll('.svg svg').length >= 2"),
        ("race", f"#/c1/d1/race/2?cell=c{cell}", "document.querySelector('.race-map canvas')"),
        ("space", "#/c1/d1/space", "document.querySelectorAll('.svg svg').length >= 2"),
        ("candidate", f"#/c1/c{best}", "document.querySelector('.svg svg')"),
        ("run", f"#/c1/runs/{run}?t=42", "document.querySelector('.svg g.lit')"),
        ("runs beside each other", f"#/c1/runs/{run}?t=42&beside=c{best}-7,r1", "document.querySelectorAll('[data-run]').length === 3"),
        ("machines", "#/c1/machines", "document.querySelectorAll('.svg svg').length === 2"),
        ("modules", "#/c1/modules", "document.querySelector('table')"),
        ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 3 && document.querySelectorAll('table').length >= 2"),
        ("fleet", "#/fleet", "document.querySelector('table')"),
        ("data", "#/c1/sql?q=SELECT * FROM v_designs", "document.querySelectorAll('table').length"),
    ]


@needs_browser
class Pages(DashboardTest):
    @classmethod
    def setUpClass(cls):
        cls.store = shared_folder() / "pages.db"
        shutil.copy(finished_store(), cls.store)
        best = query(cls.store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"]
        add_real_run(cls.store, f"c{best}")

    def test_each_page_is_quiet_and_for_everybody_at_each_width_light_and_dark(self):
        serving = self.dashboard(self.store)
        for name, address, expression in pages_of(self.store):
            page = self.page(serving, address, expression)
            self.assert_for_everybody(page, serving, name)
            page.close()

    def test_the_checks_of_this_file_find_what_is_wrong(self):
        page = shared_browser().page(390)
        self.addCleanup(page.close)
        page.open("data:text/html,<p style='color:%23999'>pale</p><svg><rect width=90 height=40 fill='orange' /><text x=9 y=20 fill='white'>pale</text></svg><button></button><div style='width:500px'>wide</div>"
                  "<a href='x' tabindex=2>b</a><a href='y' tabindex=1>a</a><script>fetch('http://127.0.0.1:1/').catch(() => 0)</script>")
        self.assertEqual(len(page.js(looks.CONTRAST)), 2)
        self.assertNotEqual(page.js(looks.OVERFLOW), [])
        self.assertEqual(len(looks.nameless(page)), 1)
        self.assertNotEqual(looks.unreached(page), [])
        self.assertEqual(page.hosts(), {"127.0.0.1:1"})
        self.assertRaises(BrowserError, page.wait, "false", timeout=0.1)
        self.assertNotEqual(page.errors(), [])

    def test_keys_alone_lead_from_page_to_page_and_show_themselves(self):
        page = self.page(self.dashboard(self.store), "#/")
        for letter, words in (("r", "/race"), ("p", "/space"), ("m", "/machines"), ("e", "/results"), ("f", "fleet"), ("o", "#/")):
            page.key("g")
            page.key(letter)
            page.wait(f"location.hash.includes('{words}') && document.querySelector('main h1')")
        page.key("?")
        page.wait("document.querySelector('dialog[open]')")
        page.key("Escape")
        page.wait("!document.querySelector('dialog[open]')")

    def test_a_store_without_anything_says_so_on_each_page(self):
        empty = self.folder / "empty.db"
        shutil.copy(self.store, empty)
        with sqlite3.connect(empty) as connection:
            connection.execute("PRAGMA foreign_keys = OFF")
            tables = [name for name, in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")]
            for name in tables:
                if name not in ("store", "meta", "campaign"):
                    connection.execute(f'DELETE FROM "{name}"')
        serving = self.dashboard(empty)
        for address in ("#/", "#/c1", "#/c1/results", "#/c1/machines", "#/c1/modules", "#/fleet", "#/c1/sql?q=SELECT 1 WHERE 0", "#/c1/d1", "#/c9", "#/nowhere"):
            with self.subTest(page=address):
                page = shared_browser().page()
                page.open(serving.address + address, "document.querySelector('main .empty')")
                self.assertEqual(page.js("[...document.querySelectorAll('.failure')].map(e => e.innerText)"), [])
                self.assert_quiet(page, serving)
                page.close()

    def test_markup_in_every_text_of_a_store_stays_text(self):
        hostile = self.folder / "hostile.db"
        shutil.copy(self.store, hostile)
        with sqlite3.connect(hostile, isolation_level=None) as connection:
            connection.execute("PRAGMA foreign_keys = OFF")
            connection.execute("PRAGMA ignore_check_constraints = ON")
            for table, column in (("campaign", "name"), ("design", "reason"), ("worker", "host"), ("worker", "job"), ("event", "data"),
                                  ("real_run", "name"), ("real_run", "recorded"), ("real_robot", "name"), ("command", "who")):
                columns = {row[1] for row in connection.execute(f'PRAGMA table_info("{table}")')}
                self.assertTrue(columns, table)
                if column in columns:
                    connection.execute(f'UPDATE "{table}" SET "{column}" = ?', [MARKUP])
        serving = self.dashboard(hostile)
        shown = ""
        for name, address, expression in pages_of(self.store):
            with self.subTest(page=name):
                page = self.page(serving, address, expression)
                self.assertEqual(page.js("document.querySelectorAll('img, script:not([src]), [onerror]').length"), 0)
                shown += page.js("document.body.innerText + document.title")
                self.assert_quiet(page, serving)
                page.close()
        self.assertGreater(shown.count(MARKUP), 10)


if __name__ == "__main__":
    unittest.main()
