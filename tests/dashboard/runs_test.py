"""Runs: a click on a cell of the race simulates it again, to the stored bits, and plays it."""
import json
import re
import shutil
import unittest

from dashboards import CHECKS, DashboardTest, add_real_run, finished_store, needs_browser, query, shared_folder
from programs import call

#: Seconds that the player's clock shows.
CLOCK = "parseFloat(document.querySelector('.player .time').textContent)"


@needs_browser
class Runs(DashboardTest):
    @classmethod
    def setUpClass(cls):
        cls.store = shared_folder() / "runs.db"
        shutil.copy(finished_store(), cls.store)
        cls.best = query(cls.store, "SELECT best_candidate AS best FROM v_designs WHERE design = 1")[0]["best"]
        add_real_run(cls.store, f"c{cls.best}")
        add_real_run(cls.store, f"c{cls.best}", 2, "run02", checks=CHECKS)
        cls.run_id, cls.score, cls.digest = query(
            cls.store, f"SELECT id, score, printf('%016x', state_digest) AS digest FROM v_evaluations WHERE candidate = {cls.best} "
                       "AND purpose = 'race' ORDER BY pair LIMIT 1")[0].values()

    def test_a_click_on_any_cell_plays_that_run_with_the_stored_bits(self):
        serving = self.dashboard(self.store)
        page = self.page(serving, "#/c1/d1/race/1", "document.querySelector('.race-map canvas')")
        race = serving.get("c1/designs/d1/race?iteration=1")
        # Cells all over the matrix: the best and the worst row, the first and the last column that they have.
        rows, steps = len(race["candidates"]), len(race["steps"])
        cells = [(row, step) for row in (0, rows // 2, rows - 1) for step in (0, steps - 1)
                 if row < len(race["scores"][step]) and race["scores"][step][row] is not None]
        self.assertGreater(len(cells), 2)
        stored = {row["id"]: row for row in query(self.store, "SELECT id, score FROM v_evaluations WHERE design = 1 AND iteration = 1")}
        for row, step in cells:
            page.js(f"location.hash = '#/c1/d1/race/1?cell=c{race['candidates'][row]},{race['steps'][step]}'")
            page.wait("document.querySelector('.side button.main')")
            page.click(".side button.main")
            page.wait("document.querySelector('[data-run] .good')")
            run_id = page.js("document.querySelector('[data-run]').dataset.run")
            with self.subTest(run=run_id):
                self.assertEqual(run_id, f"e{race['candidates'][row] * 100000 + race['pairs'][step]}")
                self.assertEqual(page.js("document.querySelector('[data-run] .good').innerText"), "✓ same bits")
                answer = serving.get(f"c1/runs/{run_id}/trajectory")
                self.assertIs(answer["same_bits"], True)
                self.assertEqual(answer["score"], stored[run_id]["score"])
                self.assertEqual(answer["digest"], answer["stored_digest"])
                page.wait(f"{CLOCK} > 1")  # it plays by itself
            page.js("location.hash = '#/c1/d1/race/1'")
            page.wait("document.querySelector('.race-map canvas')")
        self.assert_quiet(page, serving)

    def test_a_real_run_lists_its_checks_or_says_that_none_were_recorded(self):
        serving = self.dashboard(self.store)
        page = self.page(serving, "#/c1/runs/r2?t=0", "document.querySelector('[aria-label=checks] tbody')")
        text = page.js("document.querySelector('main').innerText")
        self.assertIn("not checked: cameras agree", text)
        rows = page.js("[...document.querySelectorAll('[aria-label=checks] tbody tr')].map((row) => row.innerText)")
        self.assertEqual(len(rows), 2)
        for said in ("not run", "rvr1", "no two cameras saw it at the same time"):
            self.assertIn(said, rows[0])
        for said in ("passed", "30 frames/s", "10 frames/s", "gaps between frames"):
            self.assertIn(said, rows[1])
        self.keep(page, "checks-of-a-real-run")
        self.assertIsNone(serving.get("c1/runs/r1/trajectory")["checks"])
        page.js("location.hash = '#/c1/runs/r1?t=0'")
        page.wait("document.querySelector('main').innerText.includes('Not recorded')")
        self.assert_quiet(page, serving)

    def test_the_pointer_chooses_the_cell_below_it(self):
        page = self.page(self.dashboard(self.store), "#/c1/d1/race/1", "document.querySelector('.race-map canvas')")
        page.click(".race-map canvas", right=0.12, down=0.5)
        cell = page.wait("new URLSearchParams(location.hash.split('?')[1]).get('cell')")
        self.assertRegex(cell, r"^c\d+,\d+$")
        page.key("ArrowDown")
        page.wait(f"new URLSearchParams(location.hash.split('?')[1]).get('cell') !== '{cell}'")
        page.key("Enter")
        page.wait("location.hash.includes('/runs/e')")

    def test_the_address_holds_the_instant_and_keys_move_it(self):
        page = self.page(self.dashboard(self.store), f"#/c1/runs/{self.run_id}?t=42", "document.querySelector('[data-run] .good')")
        self.assertEqual(page.js(CLOCK), 42)
        for key, clock in (("ArrowRight", 43), (".", 43.1), (",", 43), ("ArrowLeft", 42), ("End", 120), ("Home", 0)):
            page.key(key)
            page.wait(f"{CLOCK} === {clock}")
        page.key("ArrowRight")
        page.wait("location.hash.includes('t=1')")
        page.key("]")
        page.wait("location.hash.includes('speed=10')")
        page.key(" ")
        page.wait(f"{CLOCK} > 3")
        page.key(" ")
        page.wait("document.querySelector('.player .play').innerText === 'Play'")
        clock = page.js(CLOCK)
        page.call("Page.reload")
        page.wait(f"document.querySelector('[data-run] .good') && {CLOCK} === {clock}")

    def test_the_score_so_far_ends_with_the_score(self):
        page = self.page(self.dashboard(self.store), f"#/c1/runs/{self.run_id}?t=120", "document.querySelector('[data-run] .good')")
        self.assertEqual(float(page.js("document.querySelector('[data-what=score]').innerText")), self.score)

    def test_what_is_lit_is_the_state_that_acts(self):
        serving = self.dashboard(self.store)
        page = self.page(serving, f"#/c1/runs/{self.run_id}?t=0", "document.querySelector('.svg g.lit')")
        robots = serving.get(f"c1/runs/{self.run_id}/trajectory")["robots"]
        for instant in (0, 13.7, 60, 119.9):
            page.js(f"location.hash = '#/c1/runs/{self.run_id}?t={instant}'")
            states = {[state for cycle, state in robot["state"] if cycle <= round(10 * instant)][-1] for robot in robots}
            page.wait(f"{CLOCK} === {instant}")
            page.wait("JSON.stringify([...document.querySelectorAll('.svg g.lit')].map(g => Number(g.dataset.state)).sort()) === "
                      f"'{json.dumps(sorted(states), separators=(',', ':'))}'")

    def test_runs_beside_each_other_have_one_clock(self):
        address = f"#/c1/runs/{self.run_id}?t=10&beside=c{self.best}-7,r1"
        page = self.page(self.dashboard(self.store), address, "document.querySelectorAll('[data-run] canvas').length === 3")
        page.key("ArrowRight")
        page.wait("[...document.querySelectorAll('.run summary')].filter(one => one.innerText.includes('11.0')).length === 3")
        self.assertEqual(page.js("document.querySelector('[data-run=r1] .facts').innerText.includes('VALID')"), True)
        page.js(f"location.hash = '#/c1/runs/r1?t=5'")
        page.wait("[...document.querySelectorAll('[data-run=r1] td')].some(one => one.innerText === 'degraded')")
        page.js(f"location.hash = '#/c1/runs/r1?t=0.5'")
        page.wait("[...document.querySelectorAll('[data-run=r1] td')].some(one => one.innerText === 'interpolated')")
        page.js("document.querySelector('input[name=beside]').focus()")
        for letter in f"c{self.best}-9":
            page.key(letter)
        page.key("Enter")
        page.wait(f"document.querySelector('[data-run=\"c{self.best}-9\"] canvas')")
        page.click("[aria-label='take c%d-9 away']" % self.best)
        page.wait("document.querySelectorAll('[data-run]').length === 1")

    def test_the_table_has_the_bytes_of_the_command_line(self):
        serving = self.dashboard(self.store)
        page = self.page(serving, f"#/c1/runs/{self.run_id}?t=0", "document.querySelector('[data-run] .good')")
        link = page.js("document.querySelector('a[download]').href")
        status, _, body = serving.ask(link.removeprefix(serving.address))
        self.assertEqual(status, 200)
        self.assertEqual(body.decode(), call("replay", self.run_id, self.store, "--csv", "-").stdout)

    def test_without_motion_nothing_plays_by_itself(self):
        page = self.page(self.dashboard(self.store), f"#/c1/runs/{self.run_id}", "document.querySelector('[data-run] .good')", calm=True)
        page.wait("location.hash.includes('t=0')")
        self.assertEqual(page.js("document.querySelector('.player .play').innerText"), "Play")

    def test_what_cannot_be_played_says_why(self):
        page = self.page(self.dashboard(self.store), "#/c1/runs/e999900001", "document.querySelector('.failure')")
        self.assertRegex(page.js("document.querySelector('.failure').innerText"), "e999900001")

    def test_a_brush_chooses_candidates_and_the_address_keeps_it(self):
        serving = self.dashboard(self.store)
        page = self.page(serving, "#/c1/d1/space?p=NumStates,S0", "document.querySelector('.canvas canvas')")
        sample = serving.get("c1/designs/d1/parameters?sample=1000")
        x, y, width, height = page.js("(() => { const b = document.querySelector('.canvas canvas').getBoundingClientRect(); return [b.x, b.y, b.width, b.height] })()")
        axis = x + 74
        page.mouse("mouseMoved", axis, y + 30)
        page.mouse("mousePressed", axis, y + 30)
        page.mouse("mouseMoved", axis, y + 80)
        page.mouse("mouseReleased", axis, y + 80)
        page.wait("location.hash.includes('b=NumStates:4:4')")
        chosen = sum(states == 4 for states in sample["parameters"]["NumStates"])
        self.assertEqual(page.js("document.querySelector('[data-what=chosen]').innerText"), str(chosen))
        page.call("Page.reload")
        page.wait(f"document.querySelector('[data-what=chosen]')?.innerText === '{chosen}'")
        self.assertIn(f"{len(sample['candidates'])} of {sample['total']}", re.sub("\u2009", "", page.js("document.querySelector('main').innerText")))


if __name__ == "__main__":
    unittest.main()
