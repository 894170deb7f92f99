"""Results that come after the races: later scores, robots' scores, machines and logs from elsewhere."""
import csv
import json
import os
import pathlib
import signal
import sqlite3
import unittest

from programs import ProgramTest, call, ended_well, wait_for

GOLDEN = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "tests/golden"
ARGOS = GOLDEN / "argos"
RENAMED = ["--mission", "grid=grid_exploration", "--mission", "color=color_selection"]

# rvr-automode facts, section 11: the thesis' tables 7.1 to 7.3 (mean count / winners that have the
# module), with the rows in which the thirty machine files differ from them as counted in the files.
MODULES = {
    "aggregation": {
        "exploration": (1.5, 80), "stop": (1.2, 100), "attraction": (0.2, 20),
        "repulsion": (0.4, 40), "black_floor": (2.5, 100), "gray_floor": (1.3, 80),
        "white_floor": (0.8, 50), "neighbour_count": (0.6, 40),
        "inverted_neighbour_count": (0.4, 30), "fixed_probability": (0.8, 60),
        "color_detection": (1.3, 60)},
    "grid_exploration": {
        "exploration": (2.4, 100), "stop": (0.0, 0), "attraction": (0.0, 0),
        "repulsion": (0.1, 10), "black_floor": (0.6, 50), "gray_floor": (0.7, 60),
        "white_floor": (0.4, 40), "neighbour_count": (1.2, 70),
        "inverted_neighbour_count": (1.8, 90), "fixed_probability": (1.9, 90),
        "color_detection": (0.7, 40)},
    "color_selection": {
        "exploration": (1.6, 100), "stop": (1.1, 100), "attraction": (0.2, 20),
        "repulsion": (0.5, 40), "black_floor": (0.9, 70), "gray_floor": (1.9, 100),
        "white_floor": (1.6, 100), "neighbour_count": (1.2, 80),
        "inverted_neighbour_count": (1.0, 70), "fixed_probability": (0.9, 70),
        "color_detection": (0.9, 70)},
}


class Results(ProgramTest):
    budget = 1400
    tests = 3

    def done(self, *arguments):
        """Standard output of a command that must succeed."""
        process = ended_well(call(*arguments))
        return process.stdout

    def refused(self, code, sentence, *arguments):
        process = call(*arguments)
        self.assertEqual(process.returncode, code, process.stdout + process.stderr)
        self.assertIn(sentence, process.stderr)

    def noted(self, *arguments):
        """Its standard error."""
        process = call(*arguments)
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        return process.stderr

    def imported(self, *arguments):
        return json.loads(self.done("import", *arguments, "--json"))

    def thesis(self):
        """A store with the thesis' thirty designs."""
        store = self.folder / "thesis.db"
        made = self.imported(ARGOS / "argos-thesis-designs.csv", "--flavour", "watermelon-argos3",
                             "--method", "thesis", *RENAMED, "--into", store)
        self.assertEqual(made["designs"], [f"d{number}" for number in range(1, 31)])
        return store

    def test_the_thesis_designs_have_the_modules_of_its_tables(self):
        store = self.thesis()
        rows = self.query(store, "SELECT * FROM v_module_frequency")
        self.assertEqual(len(rows), 33)
        for row in rows:
            occurrences, rate = MODULES[row["mission"]][row["module"]]
            self.assertEqual(row["method"], "thesis")
            self.assertAlmostEqual(row["avg_occurrences"], occurrences, 9, row)
            self.assertAlmostEqual(row["occurrence_rate"], rate / 100, 9, row)
        designs = self.query(store, "SELECT name, mission, repetition, state, flavour FROM v_designs")
        self.assertEqual(designs[13], {"name": "tG4", "mission": "grid_exploration", "repetition": 4,
                                       "state": "finished", "flavour": "watermelon-argos3"})
        # All machines are there, whole: what is exported is what was read.
        with open(ARGOS / "argos-thesis-designs.csv", newline="") as stream:
            given = [row["fsm"].split() for row in csv.DictReader(stream)]
        stored = self.query(store, "SELECT c.fsm_config FROM v_designs AS d JOIN v_candidates AS c "
                                   "ON c.candidate = d.best_candidate ORDER BY d.design")
        for ours, theirs in zip(stored, given):
            self.assertEqual(sorted(ours["fsm_config"].split()), sorted(theirs))

    def test_the_thesis_scores_come_with_them_once(self):
        store = self.thesis()
        words = [ARGOS / "argos-thesis-scores.csv", *RENAMED, "--cost-of", "grid_exploration",
                 "--source", "original", "--into", store]
        self.assertEqual(self.imported(*words),
                         {"imported": "scores", "added": 900, "replaced": 0, "known": 0})
        self.assertEqual(self.imported(*words),
                         {"imported": "scores", "added": 0, "replaced": 0, "known": 900})
        with open(ARGOS / "argos-thesis-scores.csv", newline="") as stream:
            given = [(row["fsm_id"], int(row["seed"]),
                      -float(row["score"]) if row["mission"] == "grid" else float(row["score"]))
                     for row in csv.DictReader(stream)]
        rows = self.query(store, "SELECT d.name, s.seed, s.score FROM v_design_scores AS s "
                                 "JOIN v_designs AS d ON d.design = s.design "
                                 "WHERE s.source = 'original' AND s.purpose = 'score'")
        self.assertEqual(sorted((row["name"], row["seed"], row["score"]) for row in rows),
                         sorted(given))

    def test_figure_table_and_test_have_the_same_values_and_one_colour_a_thing(self):
        store = self.thesis()
        self.imported(ARGOS / "argos-thesis-designs.csv", "--flavour", "watermelon-argos3",
                      "--method", "again", *RENAMED, "--into", store)
        for source, method in (("original", "thesis"), ("original", "again"), ("real", "thesis")):
            scores = self.folder / f"{source}-{method}.csv"
            with open(ARGOS / "argos-thesis-scores.csv", newline="") as stream:
                rows = [row for row in csv.DictReader(stream) if source != "real" or row["seed"] == "1"]
            self.assertTrue(rows)
            with open(scores, "w", newline="") as stream:
                writer = csv.writer(stream)
                writer.writerow(["mission", "method", "repetition", "score"] +
                                (["seed"] if source != "real" else []))
                for row in rows:
                    writer.writerow([row["mission"], method, row["fsm_id"][2:], row["score"]] +
                                    ([row["seed"]] if source != "real" else []))
            self.imported(scores, *RENAMED, "--cost-of", "grid_exploration", "--source", source,
                          "--into", store)
        counts = set()
        for by in ("source", "method"):
            for per in ("design", "run"):
                words = ("--by", by, "--per", per)
                groups = {(row["mission"], row["method"], row["source"]): int(row["n"])
                          for row in self.csv("compare", store, *words, "--csv", "--table", "groups")}
                drawn = {}
                for row in self.csv("figure", "box", store, *words, "-o", self.folder / "box.csv"):
                    key = (row["mission"], row["method"], row["source"])
                    drawn[key] = drawn.get(key, 0) + 1
                self.assertEqual(drawn, groups)
                counts |= set(groups.values())
                for row in self.csv("compare", store, *words, "--csv"):
                    for side in ("first", "second"):
                        key = ((row["mission"], row["method"], row[side]) if by == "source" else
                               (row["mission"], row[side], row["source"]))
                        # Of two sources only what both have is compared.
                        at_most = self.assertLessEqual if by == "source" else self.assertEqual
                        at_most(int(row[f"n_{side}"]), groups[key])
        self.assertEqual(counts, {10, 300})
        colours = {}
        for kind in ("box", "scores"):
            for mission in ("aggregation", "grid_exploration"):
                for source in ("original", "real"):
                    text = self.done("figure", kind, store, "--mission", mission, "--source", source,
                                     "--by", "source", "--method", "thesis")
                    found = {colour for colour in ("#0072b2", "#d55e00") if colour in text}
                    colours.setdefault(source, set()).update(found)
        self.assertEqual(colours, {"original": {"#0072b2"}, "real": {"#d55e00"}})

    def csv(self, *words):
        """Rows of what the command writes, to standard output or to the file after -o."""
        out = self.done(*words)
        text = pathlib.Path(words[words.index("-o") + 1]).read_text() if "-o" in words else out
        return list(csv.DictReader(text.splitlines()))

    def test_imported_machines_are_simulated_and_replayed(self):
        store = self.thesis()
        lines = [json.loads(line) for line in
                 self.done("evaluate", "best", "--store", store, "--profile", "argos3",
                           "--design", "d2", "--design", "d21", "--json").splitlines()]
        self.assertEqual([line["design"] for line in lines], ["d2", "d21"])
        self.assertEqual({line["seed"] for line in lines}, {lines[0]["seed"]})
        for line in lines:
            replayed = json.loads(self.done("replay", line["id"], store, "--json"))
            self.assertTrue(replayed["same_bits"])
        self.refused(2, "names no profile", "replay", "c1", "--seed", "3", store)

    def test_robots_scores_stand_beside_the_simulated_ones(self):
        store = self.folder / "campaign.db"
        self.assertEqual(self.run_campaign(store, "--workers", "1").returncode, 0)
        digest = self.digest(store)
        self.done("evaluate", "best", "--store", store)
        self.done("evaluate", "best", "--store", store, "--profile", "pseudo-reality")
        robots = self.folder / "robots.csv"
        robots.write_text("mission,method,repetition,score,time,note\n"
                          "aggregation,argos3,1,2,120,one robot slow\n")
        self.assertEqual(self.imported(robots, "--source", "real", "--into", store)["added"], 1)
        rows = self.query(store, "SELECT source, purpose, count(*) AS n, max(seed) AS seed "
                                 "FROM v_design_scores GROUP BY source, purpose ORDER BY 1, 2")
        self.assertEqual([(row["source"], row["purpose"], row["n"]) for row in rows],
                         [("argos3", "score", 1), ("argos3", "test", 3),
                          ("pseudo-reality", "score", 1), ("real", "score", 1)])
        self.assertIsNone(rows[3]["seed"])
        # Another score is refused and nothing is written; --replace takes it.
        robots.write_text(robots.read_text().replace(",2,120,", ",3,120,"))
        self.refused(2, "robots.csv:2: the score 3", "import", robots, "--source", "real",
                     "--into", store)
        self.assertEqual(self.imported(robots, "--source", "real", "--replace", "--into",
                                       store)["replaced"], 1)
        score = "SELECT id, score FROM v_evaluations WHERE source = 'real'"
        real = self.query(store, score)[0]
        self.assertEqual(real["score"], 3)
        self.refused(2, "it was filmed", "replay", real["id"], store)
        # None of it is part of the answer, and the campaign is as whole as before.
        self.assertEqual(self.digest(store), digest)
        self.assert_clean(store)
        self.done("replay", "--sample", 200, store)

    def test_what_query_writes_import_reads(self):
        first, second = self.folder / "campaign.db", self.folder / "again.db"
        for store in (first, second):
            self.assertEqual(self.run_campaign(store, "--workers", "1").returncode, 0)
        self.done("evaluate", "best", "--store", first, "--seeds", "1-4", "--profile",
                  "pseudo-reality")
        sql = "SELECT * FROM v_design_scores"
        table = self.folder / "scores.csv"
        table.write_text(self.done("query", first, sql, "--csv"), newline="")
        # The other store has the same tests already.
        self.assertEqual(self.imported(table, "--into", second),
                         {"imported": "scores", "added": 4, "replaced": 0, "known": 3})
        self.assertEqual(self.done("query", second, sql, "--csv"), table.read_text())

    def test_an_unfinished_campaign_goes_on_after_an_import(self):
        whole, store = self.folder / "whole.db", self.folder / "campaign.db"
        self.assertEqual(self.run_campaign(whole, "--workers", "1").returncode, 0)
        process = self.start_campaign(store, "--workers", "1")
        wait_for(lambda: store.exists() and self.evaluations(store) > 50, "the campaign to get on")
        # The one writer is the campaign; stopped, it does not end meanwhile.
        process.send_signal(signal.SIGSTOP)
        if process.poll() is None:
            self.refused(3, "import when the campaign has ended", "import",
                         ARGOS / "argos-thesis-designs.csv", "--flavour", "watermelon-argos3",
                         "--into", store)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.imported(ARGOS / "argos-thesis-designs.csv", "--flavour", "watermelon-argos3", *RENAMED,
                      "--into", store)
        ended_well(self.run_campaign(store, "--workers", "1"))
        rows = "SELECT candidate, pair, score FROM v_evaluations WHERE used AND design = 1"
        self.assertEqual(self.query(store, rows + " ORDER BY 1, 2"),
                         self.query(whole, rows + " ORDER BY 1, 2"))
        self.assertEqual(self.query(store, "SELECT count(*) AS n FROM v_designs")[0]["n"], 31)

    def test_machines_of_a_flavour_of_ones_own_work_like_all_others(self):
        """By a head that describes it, and by --flavour FILE."""
        flavour = self.folder / "mine.toml"
        flavour.write_text('format = 1\nbase = "watermelon"\nstates = 6\n[behaviours]\nstop = { number = 7 }\n')
        text = self.folder / "machines.txt"
        text.write_text("--nstates 1 --s0 7\n")
        store, again = self.folder / "one.db", self.folder / "two.db"
        made = self.imported(text, "--flavour", flavour, "--mission", "aggregation", "--into", store)
        self.assertEqual(made["designs"], ["d1"])
        self.done("export", store, "--design", "d1", "-o", self.folder / "d1.fsm")
        self.imported(self.folder / "d1.fsm", "--into", again)
        flavour.unlink()  # the store has all of it
        for each in (store, again):
            self.assertEqual(self.query(each, "SELECT flavour FROM v_designs"), [{"flavour": "mine"}])
            modules = "SELECT module, avg_occurrences FROM v_module_frequency"
            self.assertEqual(self.query(each, modules), [{"module": "stop", "avg_occurrences": 1}])
            with sqlite3.connect(each) as other_programs:
                self.assertEqual(other_programs.execute(modules).fetchall(), [("stop", 1)])
            self.done("evaluate", "best", each, "--seeds", "1-2")
            self.assertEqual(len(self.query(each, "SELECT * FROM v_design_scores")), 2)
            self.assertIn("mine", self.done("ls", "designs", each))
            drawing = self.folder / "d1.svg"
            self.done("figure", "machine", each, "--design", "d1", "-o", drawing)
            self.assertIn("Stop", drawing.read_text())
            self.done("export", each, "--design", "d1", "--format", "svg", "-o", drawing)
            self.done("report", each, "-o", self.folder / "report.html")
            self.assertIn("stop", self.done("show", "c1", each))
        texts = "SELECT file FROM v_campaigns"
        self.assertEqual(self.query(store, texts), self.query(again, texts))

    def test_a_store_has_one_flavour_of_a_name(self):
        flavour, text = self.folder / "mine.toml", self.folder / "machines.txt"
        text.write_text("--nstates 1 --s0 7\n")
        store, other = self.folder / "one.db", self.folder / "two.db"
        words = (text, "--flavour", flavour, "--mission", "aggregation", "--into")
        for into, speed in ((store, 0.2), (other, 0.1)):
            flavour.write_text(f'format = 1\nbase = "watermelon"\nspeed_mps = {speed}\n[behaviours]\nstop = {{ number = 7 }}\n')
            self.imported(*words, into)
        self.refused(3, "different flavours of the name mine", "import", *words, store)
        self.refused(3, "different flavours of the name mine", "merge", store, other, "-o", self.folder / "all.db")
        self.assertEqual(self.query(store, "SELECT module FROM v_modules"), [{"module": "stop"}])

    def test_a_store_has_one_profile_of_a_name(self):
        profile, text = self.folder / "mine.toml", self.folder / "machines.txt"
        store, other = self.folder / "one.db", self.folder / "two.db"
        for into, limit in ((store, 0.2), (other, 0.3)):
            text.write_text(f"--nstates 1 --s0 0 --rwm0 {10 * limit:.0f}\n")
            self.imported(text, "--flavour", "watermelon", "--mission", "aggregation", "--into", into)
            profile.write_text(f'format = 1\nbase = "rvr"\n[proximity]\nrange = {limit}\n')
            self.done("evaluate", "best", into, "--profile", profile, "--seeds", "1-2")
        self.refused(2, "another profile mine, whose scores would be mixed up", "evaluate", "best", store,
                     "--profile", profile, "--seeds", "3")
        self.done("evaluate", "best", other, "--profile", profile, "--seeds", "3")
        merged = self.folder / "merged.db"
        self.assertIn("two.db: candidates were evaluated under a profile mine that differs from the one",
                      self.noted("merge", store, other, "-o", merged))
        profile.unlink()  # the store has all of it
        first = self.query(merged, "SELECT id FROM v_evaluations WHERE source = 'mine' ORDER BY candidate, seed")[0]
        for each in (store, merged):
            self.assertIn("same bits", self.done("replay", first["id"], each))

    def test_missions_of_one_name_that_differ_are_told(self):
        mission, text = self.folder / "yard.toml", self.folder / "machines.txt"
        store, other, merged = (self.folder / name for name in ("one.db", "two.db", "merged.db"))
        for into, duration, machine in ((store, 10, 1), (other, 20, 1), (other, 20, 0), (other, 30, 0)):
            mission.write_text(f'format = 1\npreset = "aggregation"\nduration = "{duration} s"\n')
            text.write_text(f"--nstates 1 --s0 {machine}" + " --rwm0 5" * (machine == 0) + "\n")
            told = self.noted("import", text, "--flavour", "watermelon", "--mission", mission, "--into", into)
            self.assertEqual("different missions of the name yard" in told, duration == 30, told)
        self.assertIn("campaigns 1 and 2 have different missions of the name yard",
                      self.noted("merge", store, other, "-o", merged))
        for each in (store, merged):
            self.done("evaluate", "best", each, "--seeds", "1-3")
            self.assertEqual("different missions of the name yard" in self.done("compare", each, "--purpose", "score"),
                             each == merged)

    def evaluations(self, store):
        done = call("query", store, "SELECT count(*) AS n FROM v_evaluations", "--json")
        return json.loads(done.stdout)["rows"][0]["n"] if done.returncode == 0 else 0

    def test_a_log_of_irace_becomes_a_design(self):
        store = self.folder / "tuning.db"
        log = GOLDEN / "irace/log-acotsp"
        self.assertEqual(self.imported(log, "--into", store, "--mission", "acotsp"),
                         {"imported": "irace log", "designs": ["d1"]})
        self.assertEqual(self.imported(log, "--into", store, "--mission", "acotsp")["designs"], [])
        design = self.query(store, "SELECT * FROM v_designs")[0]
        self.assertEqual((design["used"], design["best_candidate"], design["mission"],
                          design["method"], design["seed"]),
                         (981, 155, "acotsp", "irace", 1406598565))
        with open(log / "runs.csv", newline="") as stream:
            costs = {(int(row["configuration"]), int(row["pair"])): float(row["cost"])
                     for row in csv.DictReader(stream)}
        runs = self.query(store, "SELECT candidate, pair, score FROM v_evaluations "
                                 "WHERE purpose = 'race'")
        self.assertEqual({(run["candidate"], run["pair"]): -run["score"] for run in runs}, costs)
        elite = self.query(store, "SELECT mean, n, experiments_used FROM v_convergence "
                                  "WHERE iteration = 7 AND rank = 1")[0]
        own = [cost for (configuration, _), cost in costs.items() if configuration == 155]
        self.assertEqual((elite["n"], elite["experiments_used"]), (len(own), 981))
        self.assertAlmostEqual(elite["mean"], -sum(own) / len(own), 6)
        self.assertEqual(len(self.query(store, "SELECT * FROM v_design_scores")), 10)
        # Every run is in the race matrix, where elites' earlier scores come again.
        matrix = self.query(store, "SELECT DISTINCT candidate, pair FROM v_race_matrix")
        self.assertEqual(len(matrix), 981)

    def test_bad_files_leave_everything_as_it_was(self):
        store = self.folder / "new.db"
        machines = self.folder / "machines.txt"
        machines.write_text("--nstates 1 --s0 1\n--nstates 9\n")
        self.refused(2, "machines.txt:2, token", "import", machines, "--flavour", "watermelon",
                     "--mission", "aggregation", "--into", store)
        self.refused(2, "flavour is unknown", "import", machines, "--into", store)
        self.assertFalse(store.exists())
        self.refused(2, "no store given", "import", ARGOS / "argos-scores.csv")
        self.refused(3, "there is no such store", "import", ARGOS / "argos-scores.csv", "--into",
                     store)
        store = self.thesis()
        table = self.folder / "scores.csv"
        table.write_text("fsm_id,source,seed,score\ntA1,real,1,3\ntA99,real,1,3\n")
        self.refused(2, "scores.csv:3: the store has no such design: name tA99", "import", table,
                     "--into", store)
        self.assertEqual(self.query(store, "SELECT * FROM v_evaluations"), [])
        table.write_text("fsm_id,source,seed,score\ntA1,real,1,3\n")
        copy = self.folder / "copy.db"
        copy.write_bytes(store.read_bytes())
        done = call("import", table, "--into", copy)
        self.assertIn("1 score imported into", done.stdout, done.stderr)
        table.write_text("a,b\n1,2\n")
        self.refused(2, "neither scores nor machines", "import", table, "--into", store)
        empty = self.folder / "bin"
        empty.mkdir()
        log = self.folder / "irace.Rdata"
        log.write_bytes(b"")
        path = os.environ["PATH"]
        os.environ["PATH"] = str(empty)
        try:
            self.refused(1, "Rscript cannot be started", "import", log, "--into", store)
        finally:
            os.environ["PATH"] = path


if __name__ == "__main__":
    unittest.main()
