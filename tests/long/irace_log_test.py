"""The converter of irace's logs, run by R itself: the example of Debian's irace, which is a log of 3.5 in Debian 12 and of
4.2 in 13, and the layout of irace 4."""
import csv
import json
import os
import math
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
SCRIPT = SOURCE / "cli/commands/irace_log.R"
FIXTURE = SOURCE / "tests/golden/irace/log-acotsp"
SWARMSMITH = pathlib.Path(os.environ["SWARMSMITH_BIN"]) / "swarmsmith"

# The same log in the layout of irace 4: costs beside the runs, instances and log in the state,
# parameters in the scenario.
TO_FOUR = """
load(commandArgs(TRUE)[1])
old <- iraceResults
runs <- as.data.frame(old$experimentLog)
runs$cost <- old$experiments[cbind(runs$instance, runs$configuration)]
pairs <- old$state$.irace$instancesList
names(pairs)[names(pairs) == "instance"] <- "instanceID"
iraceResults <- list(
  scenario = c(old$scenario, list(parameters = old$parameters)), irace_version = "4.2",
  allElites = old$allElites, allConfigurations = old$allConfigurations,
  experiments = old$experiments, iterationElites = old$iterationElites,
  softRestart = old$softRestart, testing = old$testing,
  state = list(experiment_log = runs, instances_log = pairs, completed = old$state$completed,
               nbIterations = old$state$nbIterations))
save(iraceResults, file = commandArgs(TRUE)[2])
"""

# The same log with why it ended as a list, as irace 3.4 wrote it.
TO_LIST = """
load(commandArgs(TRUE)[1])
iraceResults$state$completed <- list(flag = TRUE, msg = iraceResults$state$completed)
save(iraceResults, file = commandArgs(TRUE)[2])
"""

# A run of irace with a budget of time: runs that estimate it come first, in an iteration 0.
TIMED = {
    "parameters.txt": 'x "--x " i (0,100)\nm "--m " c (a,b)\n',
    "instances.txt": "one\ntwo\nthree\n",
    "scenario.txt": 'trainInstancesFile = "instances.txt"\ntrainInstancesDir = ""\nmaxTime = 200\nseed = 3\n',
    "target-runner": '#!/bin/sh\nset -- "$3" $(echo "$*" | sed "s/.*--x \\([0-9]*\\).*/\\1/")\n'
                     'echo $(( ($2 - 30) * ($2 - 30) + $1 % 50 )) $(( 1 + $2 / 50 ))\n',
}
# Iterations, runs in each, their costs' sum, and the last elites, as R has them.
TIMED_HOLDS = """
load(commandArgs(TRUE)[1])
log <- iraceResults$state$experiment_log
runs <- as.data.frame(if (is.null(log)) iraceResults$experimentLog else log)
costs <- iraceResults$experiments[cbind(runs$instance, match(runs$configuration, colnames(iraceResults$experiments)))]
cat(min(runs$iteration), nrow(runs), format(sum(costs), digits = 15), tail(iraceResults$allElites, 1)[[1]])
"""

# What irace 4 itself reads of its log: configurations, runs, the sum of their costs, elites of the last iteration.
WHAT_IT_HOLDS = """
log <- irace::read_logfile(commandArgs(TRUE)[1])
runs <- as.data.frame(log$state$experiment_log)
costs <- log$experiments[cbind(runs$instance, match(runs$configuration, colnames(log$experiments)))]
cat(nrow(log$allConfigurations), nrow(runs), format(sum(costs), digits = 15), tail(log$allElites, 1)[[1]])
"""


def version():
    """The first number of irace's version."""
    done = subprocess.run(["Rscript", "-e", 'cat(as.character(packageVersion("irace")))'], capture_output=True, text=True)
    return int(done.stdout.split(".")[0])


def example():
    if shutil.which("Rscript") is None:
        return None
    found = subprocess.run(
        ["Rscript", "-e", 'cat(system.file("exdata/irace-acotsp.Rdata", package = "irace"))'],
        capture_output=True, text=True).stdout.strip()
    return pathlib.Path(found) if found else None


@unittest.skipUnless(example(), "needs Rscript and irace with its example (r-base-core, r-cran-irace)")
class IraceLog(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def r(self, *words):
        done = subprocess.run(["Rscript", "--vanilla", *map(str, words)], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def tables(self, log, name):
        folder = self.folder / name
        folder.mkdir()
        self.r(SCRIPT, log, folder)
        tables = {file.name: file.read_text() for file in folder.iterdir()}
        # Where its author kept the files is not in the fixture.
        tables["scenario.csv"] = "".join(line for line in tables["scenario.csv"].splitlines(keepends=True)
                                         if '"""/' not in line)
        return tables

    def wanted(self):
        return {file.name: file.read_text() for file in FIXTURE.iterdir() if file.suffix == ".csv"}

    def test_the_example_of_irace_4_gives_what_irace_reads_of_it(self):
        if version() < 4:
            self.skipTest("skipped: the example of irace 3.5 has tables of its own below")
        done = subprocess.run(["Rscript", "-e", WHAT_IT_HOLDS, example()], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        configurations, runs, costs, *elites = done.stdout.split()
        tables = {name: list(csv.DictReader(text.splitlines())) for name, text in self.tables(example(), "four").items()}
        self.assertEqual(len(tables["configurations.csv"]), int(configurations))
        self.assertEqual(len(tables["runs.csv"]), int(runs))
        self.assertTrue(math.isclose(sum(float(row["cost"]) for row in tables["runs.csv"]), float(costs), rel_tol=1e-12))
        last = max(int(row["iteration"]) for row in tables["elites.csv"])
        self.assertEqual([row["configuration"] for row in tables["elites.csv"] if int(row["iteration"]) == last], elites)

    def test_the_example_gives_the_tables_of_the_fixture(self):
        if version() >= 4:
            self.skipTest("skipped: the fixture is of the example of irace 3.5")
        self.assertEqual(self.tables(example(), "three"), self.wanted())

    def test_the_layout_of_irace_4_gives_the_same(self):
        if version() >= 4:
            self.skipTest("skipped: the fixture is of the example of irace 3.5")
        script = self.folder / "to_four.R"
        script.write_text(TO_FOUR)
        self.r(script, example(), self.folder / "four.Rdata")
        tables = self.tables(self.folder / "four.Rdata", "four")
        tables["log.csv"] = tables["log.csv"].replace('"4.2"', '"3.5.6863679"')
        self.assertEqual(tables, self.wanted())

    def test_a_list_of_reasons_is_read(self):
        if version() >= 4:
            self.skipTest("skipped: the fixture is of the example of irace 3.5")
        script = self.folder / "to_list.R"
        script.write_text(TO_LIST)
        self.r(script, example(), self.folder / "list.Rdata")
        self.assertEqual(self.tables(self.folder / "list.Rdata", "list"), self.wanted())

    def test_logs_of_each_version_are_read(self):
        logs = sorted(FIXTURE.parent.glob("logs-*/*.Rdata"))
        self.assertEqual(len(logs), 6)
        for log in logs:
            with self.subTest(log=f"{log.parent.name}/{log.name}"):
                store = self.folder / f"{log.parent.name}-{log.stem}.db"
                first, runs, costs, *elites = self.held(log)
                self.assertEqual(first, "0" if log.stem == "time" else "1")
                self.imported(log, store, runs, costs, elites)
                [design] = self.rows(store, "SELECT state, reason FROM v_designs")
                self.assertEqual(design["state"], "finished")
                self.assertIn("Not enough budget to ", design["reason"])

    def held(self, log):
        """What R finds in a log: first iteration, number of runs, the sum of their costs, the last elites."""
        done = subprocess.run(["Rscript", "-e", TIMED_HOLDS, log], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()

    def rows(self, store, sql):
        return json.loads(subprocess.run([SWARMSMITH, "query", store, sql, "--json"], capture_output=True, text=True,
                                         check=True).stdout)["rows"]

    def imported(self, log, store, runs, costs, elites):
        done = subprocess.run([SWARMSMITH, "import", log, "--into", store], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        [found] = self.rows(store, "SELECT count(*) AS n, -sum(score) AS costs, min(iteration) AS first FROM v_evaluations "
                                   "WHERE purpose = 'race'")
        self.assertEqual((found["n"], found["first"]), (int(runs), 1))
        self.assertTrue(math.isclose(found["costs"], float(costs), rel_tol=1e-12))
        last = self.rows(store, "SELECT candidate FROM v_convergence WHERE iteration = (SELECT max(iteration) FROM v_convergence) "
                                "ORDER BY rank")
        self.assertEqual([int(row["candidate"]) % 1000000 for row in last], list(map(int, elites)))

    def test_a_log_of_a_budget_of_time_is_read(self):
        for name, text in TIMED.items():
            (self.folder / name).write_text(text)
        (self.folder / "target-runner").chmod(0o755)
        done = subprocess.run(["Rscript", "-e", 'irace::irace.cmdline("--scenario scenario.txt --log-file timed.Rdata")'],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        first, runs, costs, *elites = self.held(self.folder / "timed.Rdata")
        self.assertEqual(first, "0")
        self.imported(self.folder / "timed.Rdata", self.folder / "timed.db", runs, costs, elites)
        [time] = self.rows(self.folder / "timed.db", "SELECT sum(time) AS sum FROM v_evaluations")
        self.assertGreater(time["sum"], 100)

    def test_the_program_runs_the_converter_itself(self):
        digests = []
        self.tables(example(), "tables")
        for name, log in [("log.db", example()), ("folder.db", self.folder / "tables")]:
            store = self.folder / name
            subprocess.run([SWARMSMITH, "import", log, "--into", store], check=True,
                           stdout=subprocess.DEVNULL)
            digests.append(subprocess.run([SWARMSMITH, "digest", store], check=True,
                                          capture_output=True, text=True).stdout)
        self.assertEqual(digests[0], digests[1])

    def test_what_is_no_log_is_refused_with_the_reason(self):
        other = self.folder / "other.Rdata"
        for make, sentence in [(lambda: other.write_text("no log"), "this is not an R file"),
                               (lambda: self.r("-e", f'x <- 1; save(x, file = "{other}")'),
                                "it has no iraceResults")]:
            make()
            done = subprocess.run([SWARMSMITH, "import", other, "--into", self.folder / "x.db"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(sentence, done.stderr)
            self.assertFalse((self.folder / "x.db").exists())


if __name__ == "__main__":
    unittest.main()
