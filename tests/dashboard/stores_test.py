"""Pages of other stores than those of one iterated race: rival methods, failures, merged and imported ones."""
import functools
import os
import pathlib
import shutil
import sqlite3
import unittest

import looks
from dashboards import MARKUP, DashboardTest, needs_browser, query, shared_folder
from programs import call

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])

#: A network by a genetic algorithm and by CMA-ES, a tree, and machines by random search, one race, annealing.
RIVALS = """\
format = 1
[campaign]
name = "rivals"
seed = 7
[[mission]]
name = "aggregation"
duration = "10 s"
  [mission.instances]
  test = { count = 4 }
""" + "".join(f"""
[[method]]
name = "{name}"
method = "{method}"
{options}""" for name, method, options in (
    ("evostick", "evostick", "[method.evolution]\npopulation = 20\nruns = 5\nfinal_runs = 10"),
    ("cma", "cma-es", "[method.cma-es]\npopulation = 20\nruns = 5\nfinal_runs = 10"),
    ("random", "random", "[method.random]\nfinal_runs = 10"),
    ("vanilla", "vanilla", ""), ("icepop", "icepop", ""), ("maple", "maple", ""))) + """
[race]
max_experiments = 1350
"""

#: Before the example's own lines: one run in 23 fails, one in 61 says that its configuration is bad.
FAILS = """case $(( ($3 + $1) % 23 )) in 0) echo "no <b>licence</b> today" >&2; exit 3;; esac
case $(( $3 % 61 )) in 0) echo Inf; exit 0;; esac
shift 2
"""


def made(*arguments):
    done = call(*arguments)
    if done.returncode != 0:
        raise AssertionError(done.stderr)


@functools.cache
def rival_store():
    file = shared_folder() / "rivals.toml"
    file.write_text(RIVALS)
    store = shared_folder() / "rivals.db"
    made("run", file, "--store", store, "--no-dashboard")
    return store


@functools.cache
def failing_store():
    folder = shared_folder() / "target"
    shutil.copytree(SOURCE / "examples" / "target", folder)
    runner, file = folder / "target-runner", folder / "campaign.toml"
    runner.write_text(runner.read_text().replace("shift 2\n", FAILS, 1))
    file.write_text(file.read_text() + '\n[workers]\non_failure = "reject"\nretries = 0\n')
    store = shared_folder() / "failing.db"
    made("run", file, "--store", store, "--no-dashboard")
    return store


@functools.cache
def imported_store():
    """A log of irace."""
    store = shared_folder() / "imported.db"
    made("import", SOURCE / "tests" / "golden" / "irace" / "log-acotsp", "--into", store)
    return store


@functools.cache
def machines_store():
    """Texts of machines, without a score."""
    store = shared_folder() / "machines.db"
    made("import", SOURCE / "tests" / "golden" / "argos" / "argos-fsms.csv", "--flavour", "watermelon-argos3",
         "--mission", "aggregation", "--into", store)
    return store


@functools.cache
def merged_store():
    store = shared_folder() / "merged.db"
    made("merge", rival_store(), failing_store(), imported_store(), "-o", store)
    return store


def bests(store):
    return {row["method"]: row["best"] for row in query(store, "SELECT method, best_candidate AS best FROM v_designs")}


def run_of(store, candidate):
    return query(store, f"SELECT id FROM v_evaluations WHERE candidate = {candidate} AND purpose = 'race' LIMIT 1")[0]["id"]


class Stores(DashboardTest):
    def look_at(self, store, pages):
        """Each page: what must be there, and all that every page must be. Returns what they say, by name."""
        serving, said = self.dashboard(store), {}
        for name, address, expression in pages:
            page = self.page(serving, address, expression)
            said[name] = page.js("document.querySelector('main').innerText").replace("\u2009", "")
            with self.subTest(page=name):
                self.assertEqual(page.js("[...document.querySelectorAll('.failure')].map(one => one.innerText)"), [])
            self.assert_for_everybody(page, serving, f"{pathlib.Path(store).stem} {name}", tabs=False)
            page.close()
        return said


@needs_browser
class Rivals(Stores):
    def test_each_page_of_rival_methods(self):
        best = bests(rival_store())
        network, tree = best["evostick"], best["maple"]
        said = self.look_at(rival_store(), [
            ("campaigns", "#/", "document.querySelectorAll('.card').length === 6 && document.querySelector('.svg svg')"),
            ("design of a network", "#/c1/d1", "document.querySelectorAll('.svg svg').length === 2"),
            ("design by annealing", "#/c1/d5", "document.querySelectorAll('.svg svg').length === 2"),
            ("generation", "#/c1/d1/race/4", "document.querySelector('.race-map canvas')"),
            ("random search", "#/c1/d3/race", "document.querySelector('.race-map canvas')"),
            ("one race", "#/c1/d4/race", "document.querySelector('.race-map canvas')"),
            ("annealing", "#/c1/d5/race/2", "document.querySelector('.race-map canvas')"),
            ("space of a network", "#/c1/d1/space", "document.querySelector('.empty')"),
            ("space of a tree", "#/c1/d6/space", "document.querySelectorAll('.svg svg').length >= 2"),
            ("network", f"#/c1/c{network}", "document.querySelector('.svg svg')"),
            ("tree", f"#/c1/c{tree}", "document.querySelector('.svg svg')"),
            ("machines", "#/c1/machines", "document.querySelectorAll('.svg svg').length === 6"),
            ("modules", "#/c1/modules", "document.querySelector('table')"),
            ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 3"),
        ])
        # What is not a race says so in a sentence; one that is one does not.
        for name in ("generation", "random search", "annealing"):
            self.assertIn("This is not a race", said[name], name)
        self.assertNotIn("This is not a race", said["one race"])
        self.assertIn("Generation 4", said["generation"])
        self.assertIn("final stage", said["design of a network"])
        self.assertNotIn("states, transitions", said["network"] + said["tree"])

    def test_rows_of_the_table_of_p_values_are_lines(self):
        """Notes in a narrow column would make them as tall as a page."""
        serving = self.dashboard(rival_store())
        table = "[...document.querySelectorAll('caption')].find(one => one.textContent === 'tests by method')?.parentNode"
        for width in (390, 1440, 2560):
            page = self.page(serving, "#/c1/results", table, width=width)
            heights = page.js(f"[...{table}.querySelectorAll('tr')].map(one => one.offsetHeight)")
            line = page.js("parseFloat(getComputedStyle(document.body).lineHeight)")
            self.assertEqual(len(heights), 16, "six methods are fifteen pairs")
            self.assertLess(max(heights), 5 * line, width)
            page.close()

    def test_p_values_and_the_matrix_are_seen_without_scrolling(self):
        serving = self.dashboard(rival_store())
        page = self.page(serving, "#/c1/results", "document.querySelector('[aria-label^=\"tests by\"] th') && document.querySelector('.matrix td button')", width=1280)
        right = page.js("[...document.querySelectorAll('[aria-label^=\"tests by\"] th')].find(one => one.innerText.startsWith('p_holm')).getBoundingClientRect().right")
        self.assertLess(right, 1280)
        # Six methods in one mission: a mean, its rank and letters each, and a click leads to the designs.
        rows = page.js("[...document.querySelectorAll('.matrix tbody tr')].map(one => one.innerText)")
        self.assertEqual(len(rows), 6)
        page.click(".matrix td button")
        page.wait("document.querySelector('[aria-label^=\"designs of aggregation\"] td')")
        page.close()

    def test_runs_of_a_tree_and_of_a_network_have_the_stored_bits(self):
        best = bests(rival_store())
        serving = self.dashboard(rival_store())
        for method in ("maple", "evostick"):
            run = run_of(rival_store(), best[method])
            with self.subTest(run=run):
                page = self.page(serving, f"#/c1/runs/{run}?t=3", "document.querySelector('[data-run] .good')")
                self.assertEqual(page.js("document.querySelector('[data-run] .good').innerText"), "✓ same bits")
                answer = serving.get(f"c1/runs/{run}/trajectory")
                self.assertIs(answer["same_bits"], True)
                self.assertEqual(answer["digest"], answer["stored_digest"])
                page.wait("document.querySelector('[data-run] .svg svg')")
                if method == "maple":
                    page.wait("document.querySelector('.svg g.lit')")
                self.assert_for_everybody(page, serving, f"run of {method}", tabs=False)
                page.close()


    def test_long_names_of_methods_fit_a_phone(self):
        store = self.folder / "names.db"
        shutil.copy(rival_store(), store)
        with sqlite3.connect(store) as connection:
            connection.execute("UPDATE design SET method = ? || method", [f"{MARKUP} {'with weights of its own ' * 3}"])
        serving = self.dashboard(store)
        for address in ("#/", "#/c1/d1", "#/c1/machines", "#/c1/modules", "#/c1/results", "#/c1/d6/space"):
            with self.subTest(page=address):
                page = self.page(serving, address, width=390)
                page.wait("document.querySelector('.svg svg')")
                self.assertEqual(page.js(looks.OVERFLOW), [])
                page.close()


@needs_browser
class Failures(Stores):
    def test_each_page_of_a_store_with_failures_and_rejections(self):
        store = failing_store()
        best = bests(store)["all"]
        rejected = query(store, "SELECT e.id, e.candidate, s.step FROM v_evaluations AS e JOIN v_race_steps AS s ON s.pair = e.pair "
                                "AND s.iteration = 1 WHERE e.status = 'rejected' AND e.iteration = 1 LIMIT 1")[0]
        cell = f"c{rejected['candidate']},{rejected['step']}"
        said = self.look_at(store, [
            ("campaigns", "#/", "document.querySelector('.svg svg')"),
            ("design", "#/c1/d1", "document.querySelector('.svg svg')"),
            ("race", f"#/c1/d1/race/1?cell={cell}", "document.querySelector('.side dl')"),
            ("space", "#/c1/d1/space", "document.querySelectorAll('.svg svg').length === 2"),
            ("machines", "#/c1/machines", "document.querySelector('.empty')"),
            ("candidate", f"#/c1/c{rejected['candidate']}", "document.querySelectorAll('table').length >= 2"),
            ("winner", f"#/c1/c{best}", "document.querySelectorAll('table').length >= 3"),
            ("run", f"#/c1/runs/{rejected['id']}", "document.querySelector('.empty')"),
            ("modules", "#/c1/modules", "document.querySelector('.empty')"),
            ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 2"),
            ("fleet", "#/fleet", "document.querySelector('table')"),
        ])
        count = query(store, "SELECT count(*) AS n FROM v_evaluations WHERE status = 'rejected' AND purpose = 'race'")[0]["n"]
        self.assertIn(f"{count} evaluations rejected", said["campaigns"])
        # A rejected cell was evaluated, and says so.
        self.assertIn("rejected", said["race"])
        self.assertNotIn("not evaluated", said["race"])
        # No run of a program can be watched: nothing leads to one, and its address says why.
        self.assertNotIn("watch", said["candidate"] + said["winner"])
        self.assertIn("a program scored it", said["run"])
        self.assertNotIn("states, transitions", said["winner"])

    def test_each_failure_is_an_event_once(self):
        events = self.dashboard(failing_store()).get("c1/events?limit=1000")["events"]
        kinds = [one["kind"] for one in events]
        failures = query(failing_store(), "SELECT count(*) AS n FROM v_failures")[0]["n"]
        self.assertGreater(failures, 0)
        self.assertEqual(kinds.count("failure"), failures)
        self.assertEqual(set(kinds) & {"attempt", "evaluation failed"}, set())


@needs_browser
class Merged(Stores):
    def test_each_campaign_of_a_merged_store_is_reached(self):
        store = merged_store()
        designs = query(store, "SELECT d.design, d.mission, d.method, d.best_candidate AS best, c.name AS campaign FROM v_designs AS d "
                               "JOIN v_campaigns AS c USING (campaign) ORDER BY d.design")
        self.assertEqual(len({one["campaign"] for one in designs}), 3)
        program, irace = designs[6], designs[7]
        said = self.look_at(store, [
            ("campaigns", "#/", "document.querySelectorAll('.card').length === 8 && document.querySelector('.svg svg')"),
            ("network", "#/c1/d1", "document.querySelectorAll('.svg svg').length === 2"),
            ("program", f"#/c1/d{program['design']}", "document.querySelector('.svg svg')"),
            ("race of the program", f"#/c1/d{program['design']}/race/1", "document.querySelector('.race-map canvas')"),
            ("imported race", f"#/c1/d{irace['design']}/race/2", "document.querySelector('.race-map canvas')"),
            ("imported candidate", f"#/c1/c{irace['best']}", "document.querySelectorAll('table').length >= 2"),
            ("machines", "#/c1/machines", "document.querySelectorAll('.svg svg').length === 6"),
            ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 2"),
        ])
        cards = self.dashboard(store)
        page = self.page(cards, "#/", "document.querySelectorAll('.card').length === 8")
        for one in designs:
            self.assertIn(one["campaign"], said["campaigns"])
            card = page.js(f"(one => one.innerText + one.getAttribute('aria-label'))(document.querySelector('.card[href$=\"/d{one['design']}\"]'))")
            self.assertEqual(card.count(one["campaign"]), 2, card)
        # A digest is of one campaign.
        self.assertEqual(cards.get("live")["campaigns"][0]["digest"], "")
        self.assertEqual(page.js("[...document.querySelectorAll('.facts dt')].find(one => one.innerText === \"campaign's digest\").nextSibling.innerText"), "–")
        # It is for reading: nothing is offered that would be refused.
        for name in ("campaigns", "network", "program"):
            for act in ("Extend", "Pause", "Cancel"):
                self.assertNotIn(act, said[name], name)
        best = bests(store)["evostick"]
        answer = self.dashboard(store).get(f"c1/runs/{run_of(store, best)}/trajectory")
        self.assertIs(answer["same_bits"], True)


@needs_browser
class Older(Stores):
    def test_results_of_a_store_from_before_real_runs(self):
        """One that has scores of a real swarm, as schema 4 keeps them."""
        store = self.folder / "older.db"
        shutil.copy(SOURCE / "tests" / "golden" / "stores" / "schema-4.sqlite", store)
        best = bests(store)["small"]
        with sqlite3.connect(store) as connection:
            source = connection.execute("INSERT INTO source (name) VALUES ('real')").lastrowid
            changed = connection.execute("UPDATE evaluation SET source = ? WHERE candidate = ? AND purpose = 2 AND pair = (SELECT min(pair) "
                                         "FROM evaluation WHERE candidate = ? AND purpose = 2)", [source, best, best]).rowcount
        self.assertEqual(changed, 1)
        said = self.look_at(store, [
            ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 2"),
            ("candidate", f"#/c1/c{best}", "document.querySelectorAll('table').length >= 2"),
            ("design", "#/c1/d1", "document.querySelector('.svg svg')"),
        ])
        self.assertIn("No real run", said["results"])
        self.assertIn("real", said["candidate"])
        columns = self.dashboard(store).get("c1/real-runs")
        self.assertEqual((columns["run"], columns["verdict"], columns["reasons"]), ([], [], []))


@needs_browser
class Imported(Stores):
    def test_each_page_of_an_imported_log_of_irace(self):
        best = bests(imported_store())["irace"]
        said = self.look_at(imported_store(), [
            ("campaigns", "#/", "document.querySelector('.svg svg')"),
            ("design", "#/c1/d1", "document.querySelector('.svg svg')"),
            ("race", "#/c1/d1/race/3", "document.querySelector('.race-map canvas')"),
            ("space", "#/c1/d1/space", "document.querySelectorAll('.svg svg').length === 2"),
            ("candidate", f"#/c1/c{best}", "document.querySelectorAll('table').length >= 3"),
            ("run", f"#/c1/runs/c{best}-7", "document.querySelector('.empty')"),
            ("results", "#/c1/results", "document.querySelectorAll('.svg svg').length >= 2"),
        ])
        self.assertNotIn("Extend", said["design"])
        self.assertIn("not a machine", said["run"])

    def test_each_page_of_imported_machines(self):
        said = self.look_at(machines_store(), [
            ("campaigns", "#/", "document.querySelectorAll('.card').length === 20"),
            ("design", "#/c1/d1", "document.querySelector('.svg svg')"),
            ("race", "#/c1/d1/race", "document.querySelector('.empty')"),
            ("candidate", "#/c1/c1", "document.querySelector('.svg svg')"),
            ("machines", "#/c1/machines", "document.querySelectorAll('.svg svg').length === 20"),
            ("results", "#/c1/results", "document.querySelector('.empty')"),
        ])
        # Nothing is promised that will not come.
        for name, text in said.items():
            self.assertNotIn("No iteration has ended yet", text, name)
        self.assertNotIn("drawn from the whole space", said["candidate"])


if __name__ == "__main__":
    unittest.main()
