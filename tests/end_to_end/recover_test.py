"""`recover` of an undamaged store gives its answer again, whatever is in it."""
import contextlib
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import unittest

from programs import ProgramTest, call, campaign_text, ended_well, used, wait_for

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
STORES = SOURCE / "tests" / "golden" / "stores"

FURTHER_PROFILES = '\n[tests]\nprofiles = ["rvr", "pseudo-reality"]\n'
#: Searches of each kind.
METHODS = {
    "machine": "",
    "random": "",
    "evostick": "[method.evolution]\npopulation = 10\nruns = 3\nfinal_runs = 5",
    "cma-es": "[method.cma-es]\npopulation = 10\nruns = 3\nfinal_runs = 5",
    "icepop": "",
    "maple": "",
}

SCENARIO = """\
targetRunner = "./target-runner"
targetEvaluator = "./target-evaluator"
trainInstancesFile = "train.txt"
testInstancesFile = "test.txt"
parameterFile = "parameters.txt"
maxExperiments = 180
seed = 42
testIterationElites = 1
"""

TUNER = """
import swarmsmith
swarmsmith.tune(lambda trial: abs(trial.configuration["x"] - 0.3), {"x": swarmsmith.Real(0, 1)},
                max_experiments=150, seed=1, store="tuned.db")
"""


#: What another program did to a store, and what becomes of it: "right" at once, after evaluations are made again, or doubted.
CHANGES = {
    "UPDATE evaluation SET score = score + 1 WHERE pair = 2": "evaluated",
    "UPDATE evaluation SET score = score + 1 WHERE purpose = 2 AND pair = 3": "evaluated",
    "UPDATE evaluation SET state_digest = state_digest + 1 WHERE purpose = 0": "evaluated",
    "UPDATE evaluation SET status = 1, score = NULL WHERE pair = 3": "evaluated",
    "UPDATE evaluation SET pair = pair + 100 WHERE pair = 2": "evaluated",
    "DELETE FROM evaluation WHERE pair = 2": "evaluated",
    "UPDATE evaluation SET iteration = NULL WHERE pair = 2": "right",
    "UPDATE evaluation SET iteration = iteration + 1": "right",
    "UPDATE evaluation SET wall_us = wall_us + 1 WHERE pair = 2": "evaluated",
    "UPDATE evaluation SET source = source + 1": "doubted",
    "UPDATE source SET name = 'another profile'": "doubted",
    "UPDATE campaign SET state = 'stopped'": "doubted",
    "UPDATE candidate SET machine = (SELECT machine FROM candidate WHERE id = 3), parameters = (SELECT parameters FROM"
    " candidate WHERE id = 3), code = (SELECT code FROM candidate WHERE id = 3) WHERE id = 1": "right",
    "UPDATE candidate SET iteration = iteration + 1": "right",
    "UPDATE candidate SET parent = 1 WHERE parent IS NOT NULL": "right",
    "UPDATE candidate SET states = states + 1": "right",
    "DELETE FROM candidate WHERE id = 2": "right",
    "UPDATE phrase SET machine = 'MACHINE' WHERE machine <> ''": "right",
    "UPDATE pair SET seed = seed + 1 WHERE purpose = 0": "right",
    "UPDATE pair SET seed = seed + 1 WHERE purpose = 2": "right",
    "UPDATE pair SET instance = instance + 1": "right",
    "UPDATE iteration SET configurations = configurations + 1": "right",
    "UPDATE race_step SET mean_best = mean_best + 1": "right",
    "UPDATE elimination SET step = step + 1": "right",
    "UPDATE elite SET candidate = 1": "right",
    "UPDATE candidate_totals SET score_sum = score_sum + 1": "right",
    "UPDATE design SET best = 1, best_mean = 7": "right",
    "UPDATE design SET state = 0, used = 3": "right",
    "DELETE FROM design": "right",
}


class Recover(ProgramTest):
    budget = 1400

    def done(self, *arguments, cwd=None):
        process = ended_well(call(*arguments, cwd=cwd))
        return process.stdout

    def run_kinds(self, store, methods, repetitions=1, budget=1400):
        tables = [f'name = "{name}"\n' + (f'method = "{name}"\n' if name != "machine" else "") + METHODS[name]
                  for name in methods]
        self.file.write_text(campaign_text(budget, seed=5, tests=6, name="kinds", repetitions=repetitions, duration="5 s",
                                           methods=tables, profile=None, more=FURTHER_PROFILES))
        ended_well(self.run_campaign(store, "--workers", "2"))

    def count(self, store):
        """Rows of each table; what programs say of themselves is not in it."""
        tables = [row["name"] for row in self.query(store, "SELECT name FROM sqlite_master WHERE type = 'table'"
                                                           " AND name NOT LIKE 'sqlite_%' AND name <> 'meta'")]
        return {table: self.query(store, f"SELECT count(*) AS n FROM {table}")[0]["n"] for table in tables}

    def recovered(self, store, replayed=True, sample=("--sample", "10")):
        """The same answer, all rows, and as clean as before; `replayed`: this version plays its races."""
        out = store.with_name("recovered-" + store.name)
        said = json.loads(self.done("recover", store, "-o", out, "--json"))
        self.assertEqual(said["orphans"], 0, said)
        if replayed:
            self.assertEqual(said["complaints"], [])
        self.assertEqual(sum(design["unasked"] for design in said["designs"]), 0, said)
        self.assertEqual(self.digest(out), self.digest(store))
        if replayed:
            self.assertEqual(self.count(out), self.count(store))
            self.done("verify", out, *sample)
        return out

    def test_of_every_search_under_further_profiles(self):
        store = self.folder / "kinds.db"
        self.run_kinds(store, METHODS)
        self.done("evaluate", "best", store, "--seeds", "1-3")
        found = {row["purpose"] for row in self.query(store, "SELECT DISTINCT purpose FROM v_evaluations")}
        self.assertLessEqual({"race", "test", "transfer", "score"}, found)
        self.recovered(store)
        self.a_test_under_a_further_profile_is_found(store)

    def a_test_under_a_further_profile_is_found(self, store):
        """Its id is that of the views, in what evaluates it again and in what misses it."""
        [one] = self.query(store, "SELECT id, candidate, seed, score FROM v_evaluations WHERE purpose = 'transfer'"
                                  " ORDER BY pair LIMIT 1")
        again = json.loads(self.done("evaluate", f"c{one['candidate']}", store, "--profile", "pseudo-reality",
                                     "--seeds", one["seed"], "--json").splitlines()[0])
        self.assertEqual(again["score"], one["score"])
        with contextlib.closing(sqlite3.connect(store)) as db:
            db.execute("DELETE FROM evaluation WHERE purpose = 6 AND candidate = ? AND pair = ?",
                       (one["candidate"], int(one["id"][1:-1]) % 100_000))
            db.commit()
        done = call("verify", store, "--sample", "0")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn(one["id"], done.stdout + done.stderr)

    def test_after_commands_and_merged(self):
        one, two, both = (self.folder / name for name in ("one.db", "two.db", "both.db"))
        for words in ((), ("extend", one, "d1", "--budget", "200")):
            if words:
                self.done(*words)
            ended_well(self.run_campaign(one, "--workers", "1"))
        self.recovered(one)
        self.run_kinds(two, ["random"], repetitions=2)
        self.done("merge", one, two, "-o", both)
        self.recovered(both)

    def test_of_a_cancelled_design(self):
        store = self.folder / "cancelled.db"
        self.file.write_text(self.file.read_text().replace("seed = 7\n", "seed = 7\nrepetitions = 2\n"))
        process = self.start_campaign(store, "--workers", "1")
        wait_for(lambda: used(store, 2) > 0 or process.poll() is not None, "no campaign")
        self.done("cancel", store, "d2")
        process.wait(60)
        self.recovered(store)

    def test_of_rows_that_another_program_changed(self):
        """What follows from scores is derived anew, a score of another value is evaluated again; what can be neither is said."""
        whole, store = self.folder / "whole.db", self.folder / "changed.db"
        ended_well(self.run_campaign(whole, "--workers", "2"))
        with contextlib.closing(sqlite3.connect(whole)) as db:
            db.execute("PRAGMA journal_mode = DELETE")
            machine, = db.execute("SELECT machine FROM phrase WHERE machine <> '' ORDER BY id DESC").fetchone()
        right = self.digest(whole)
        for change, becomes in CHANGES.items():
            with self.subTest(change):
                for old in self.folder.glob("changed*"):
                    old.unlink()
                shutil.copy(whole, store)
                with contextlib.closing(sqlite3.connect(store, isolation_level=None)) as db:
                    self.assertGreater(db.execute(change.replace("MACHINE", machine)).rowcount, 0)
                out = store.with_name("changed-out.db")
                said = call("recover", store, "-o", out)
                if becomes == "doubted":
                    self.assertEqual(said.returncode, 3, said.stdout + said.stderr)
                    self.assertIn("not reliable", said.stderr)
                    self.assertEqual(call("verify", out, "--sample", "0").returncode, 3)
                    self.assertEqual(self.run_campaign(out).returncode, 3)
                    # Nor does that end with a second copy.
                    self.assertEqual(call("recover", out, "-o", store.with_name("changed-again.db")).returncode, 3)
                    continue
                self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
                if becomes == "evaluated":
                    self.assertRegex(said.stdout, r"d1: \d+ evaluations? (is|are) missing")
                    ended_well(self.run_campaign(out, "--workers", "2"))
                self.assertEqual(self.digest(out), right)
                self.done("verify", out, "--sample", "0")

    def test_of_results_from_elsewhere(self):
        store = self.folder / "imported.db"
        self.done("import", SOURCE / "tests/golden/argos/argos-thesis-designs.csv", "--flavour", "watermelon-argos3",
                  "--mission", "grid=grid_exploration", "--mission", "color=color_selection", "--into", store)
        self.recovered(store)
        log = self.folder / "log.db"
        self.done("import", SOURCE / "tests/golden/irace/log-acotsp", "--into", log)
        self.recovered(log)

    def test_of_irace_with_an_evaluator(self):
        for name, last in (("target-runner", "exit 0"), ("target-evaluator", "echo $(( ($3 + $1 * 7) % 101 ))")):
            file = self.folder / name
            file.write_text(f"#!/bin/sh\n{last}\n")
            file.chmod(0o755)
        (self.folder / "parameters.txt").write_text('x "--x " i (0,100)\n')
        (self.folder / "train.txt").write_text("1\n2\n3\n")
        (self.folder / "test.txt").write_text("4\n5\n")
        (self.folder / "scenario.txt").write_text(SCENARIO)
        self.done("irace", "--scenario", "scenario.txt", "--store", "irace.db", cwd=self.folder)
        store = self.folder / "irace.db"
        self.assertIn({"purpose": "evaluator"}, self.query(store, "SELECT DISTINCT purpose FROM v_evaluations"))
        self.recovered(store, sample=())

    def test_of_a_tuned_function(self):
        ended_well(subprocess.run([sys.executable, "-c", TUNER], cwd=self.folder, capture_output=True, text=True, timeout=120,
                                  env={**os.environ, "PYTHONPATH": str(SOURCE / "analysis" / "python")}))
        self.recovered(self.folder / "tuned.db", sample=())

    def test_of_stores_of_earlier_versions(self):
        for golden in sorted(STORES.glob("*.sqlite")):
            with self.subTest(golden.name):
                store = self.folder / golden.name
                for ending in ("", "-wal", "-shm"):
                    if pathlib.Path(f"{golden}{ending}").exists():
                        shutil.copy(f"{golden}{ending}", f"{store}{ending}")
                self.recovered(store, replayed=False)


if __name__ == "__main__":
    unittest.main()
