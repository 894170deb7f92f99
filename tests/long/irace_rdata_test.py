"""irace.Rdata out: R's own irace works on it, what iraceplot reads is there, and import reads it back the same."""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
TO_TABLES = SOURCE / "cli/commands/irace_log.R"
TO_LOG = SOURCE / "cli/commands/irace_rdata.R"
SWARMSMITH = pathlib.Path(os.environ["SWARMSMITH_BIN"]) / "swarmsmith"
TABLES = ["log", "parameters", "domains", "configurations", "pairs", "runs", "elites", "tests", "instances",
          "scenario"]

PARAMETERS = """\
algorithm "--alg="   c     (as, "mm as", eas)
ls        "--ls "    o     (0, 1, 2)
alpha     "--alpha " r     (0.00, 5.00)
beta      "--beta "  r,log (0.01, 10.00)
ants      "--ants "  i,log (5, 100)
rank      "--rank "  i     (1, "min(ants, 10)") | algorithm == "eas"
q0        "--q0 "    r     (0, 1)               | ls %in% c("1", "2") & alpha > 1
fixed     "--fixed " c     (yes)
"""
FORBIDDEN = """\
[forbidden]
alpha == 0 & ants > 50
algorithm == "as" & ls == "0"
[global]
digits = 3
"""
SCENARIO = """\
parameterFile = "parameters.txt"
trainInstancesFile = "instances.txt"
testInstancesFile = "tests.txt"
targetRunner = "./target-runner"
maxExperiments = 250
testNbElites = 2
testIterationElites = 1
seed = 7
"""
# Costs are whole numbers, so that a shell is enough; every seventh configuration is rejected.
RUNNER = """\
#!/bin/sh
id=$1; instance=$2; seed=$3
shift 4
ants=0
while [ $# -gt 0 ]; do
  case $1 in --ants) ants=$2; shift ;; esac
  shift
done
if [ $((id % 7)) -eq 6 ]; then echo Inf; else echo $(( (ants - 30) * (ants - 30) + seed % 50 + ${instance%t} )) 0.5; fi
"""
# Costs are times; the bound is the fifth word.
TIMED = """\
#!/bin/sh
seed=$3; bound=$5
shift 5
while [ $# -gt 0 ]; do
  case $1 in --ants) ants=$2; shift ;; esac
  shift
done
off=$((ants > 30 ? ants - 30 : 30 - ants))
time=$((1 + off / 8 + seed % 2))
[ $time -gt $bound ] && time=$bound
echo $time $time
"""
CAMPAIGN = """\
format = 1
[campaign]
name = "machines"
seed = 7
[[mission]]
name = "aggregation"
  [mission.instances]
  test = { count = 4 }
[[method]]
name = "small"
flavour = "watermelon-argos3"
max_states = 2
max_transitions = 1
[race]
max_experiments = 600
[simulator]
profile = "argos3"
"""

# R's irace, on its own functions.
WITH_IRACE = """
suppressMessages(library(irace))
words <- commandArgs(TRUE)
log <- read_logfile(words[1])
stopifnot(irace:::valid_iracelog(log))
final <- getFinalElites(log)
stopifnot(setequal(final$.ID., log$allElites[[length(log$allElites)]]),
          identical(names(removeConfigurationsMetaData(final)), log$parameters$names),
          identical(names(getFinalElites(words[1], drop.metadata = TRUE)), log$parameters$names),
          identical(getConfigurationById(log, ids = 2)$.ID., 2L),
          nrow(getConfigurationByIteration(log, iterations = 1)) > 1)
invisible(checkParameters(log$parameters))
capture.output(printParameters(log$parameters), printScenario(log$scenario), configurations.print(final),
               configurations.print.command(final, log$parameters)) -> shown
lines <- vapply(seq_len(nrow(log$allConfigurations)), function(i)
  buildCommandLine(log$allConfigurations[i, log$parameters$names, drop = FALSE], log$parameters$switches), "")
# The elites and their costs, as people see them in the store.
for (i in seq_along(log$allElites)) for (id in log$allElites[[i]]) {
  of <- log$experimentLog[log$experimentLog[, "configuration"] == id & log$experimentLog[, "iteration"] <= i, , drop = FALSE]
  cat(i, id, sprintf("%.10g", mean(log$experiments[cbind(of[, "instance"], match(id, colnames(log$experiments)))])), "\\n")
}
for (i in seq_along(lines)) cat("line", log$allConfigurations$.ID.[i], lines[i], "\\n")
"""

# The same of irace 4, and what calls the target-runner from a log.
WITH_IRACE_4 = """
suppressMessages(library(irace))
words <- commandArgs(TRUE)
log <- read_logfile(words[1])
space <- log$scenario$parameters
final <- getFinalElites(log)
stopifnot(setequal(final$.ID., log$allElites[[length(log$allElites)]]),
          identical(names(getFinalElites(words[1], drop.metadata = TRUE)), space$names),
          identical(getConfigurationById(log, ids = 2)$.ID., 2L),
          nrow(getConfigurationByIteration(log, iterations = 1)) > 1, has_testing_data(log),
          nrow(get_instanceID_seed_pairs(log, instances = TRUE)) >= nrow(log$experiments))
capture.output(printParameters(space), printScenario(log$scenario), configurations_print(final),
               configurations_print_command(final, space), print(irace_summarise(log))) -> shown
again <- readParameters(text = space$as_character())
stopifnot(identical(again$names, space$names), identical(again$types, space$types),
          isTRUE(all.equal(again$domains, space$domains)), identical(again$switches, space$switches),
          length(again$forbidden) == length(space$forbidden))
for (i in seq_along(log$allElites)) for (id in log$allElites[[i]]) {
  of <- as.data.frame(log$state$experiment_log)
  of <- of[of$configuration == id & of$iteration <= i, ]
  cat(i, id, sprintf("%.10g", mean(of$cost)), "\n")
}
invisible(file.copy(words[1], "tested.Rdata"))
capture.output(testing_fromlog("tested.Rdata", testNbElites = 1, testIterationElites = FALSE)) -> shown
tested <- read_logfile("tested.Rdata")$testing$experiments
stopifnot(nrow(tested) == 2, as.character(final$.ID.[1]) %in% colnames(tested))
capture.output(way <- ablation(words[1], src = 1, target = final$.ID.[1])) -> shown
pdf("way.pdf")
plotAblation(way)
"""

# The object of irace's own reader, and forbidden code as irace compiles it.
SAME_PARAMETERS = """
suppressMessages(library(irace))
words <- commandArgs(TRUE)
log <- read_logfile(words[1])
own <- readParameters(words[2], digits = 3)
for (name in names(own)) {
  same <- all.equal(own[[name]], log$parameters[[name]])
  if (!isTRUE(same)) { print(name); print(same); quit(status = 1) }
}
stopifnot(identical(names(own), names(log$parameters)))
code <- log$scenario$parameters$forbidden
stopifnot(length(code) == 2,
          identical(attr(code[[1]], "source"), "alpha == 0 & ants > 50"),
          !eval(code[[1]], list(alpha = 0, ants = 60)), eval(code[[1]], list(alpha = 1, ants = 60)),
          eval(code[[1]], list(alpha = NA, ants = 60)))
"""

# All of a log against another one, which R's irace wrote.
SAME_AS_ORIGINAL = """
words <- commandArgs(TRUE)
read <- function(file) { load(file); iraceResults }
ours <- read(words[1])
theirs <- read(words[2])
same <- function(what, a, b) {
  equal <- all.equal(a, b)
  if (!isTRUE(equal)) { print(what); print(equal); quit(status = 1) }
}
for (name in setdiff(names(theirs), c("state", "scenario", "parameters"))) same(name, theirs[[name]], ours[[name]])
for (name in names(theirs$parameters)) same(name, theirs$parameters[[name]], ours$parameters[[name]])
for (name in names(theirs$scenario)) same(name, theirs$scenario[[name]], ours$scenario[[name]])
for (name in c("completed", "nbIterations", "remainingBudget", "experimentsUsedSoFar", "indexIteration"))
  same(name, theirs$state[[name]], ours$state[[name]])
same("pairs", theirs$state$.irace$instancesList, ours$state$.irace$instancesList)
"""

# What iraceplot (1 on logs of irace 3.5, 2 on those of irace 4) reads of a log, and who reads it.
IRACEPLOT = [
    ("is.list(x) && 'scenario' %in% names(x)", "read_logfile"),
    ("package_version(sub('[.][^.]*$', '', x$irace_version)) >= '3.9.0'", "ablation of irace 4"),
    ("is.data.frame(all) && is.numeric(all$.ID.) && is.numeric(all$.PARENT.)", "parallel_coord, sampling_distance"),
    ("identical(names(all), c('.ID.', p$names, '.PARENT.'))", "parallel_coord, sampling_distance"),
    ("identical(all$.ID., seq_len(nrow(all)))", "sampling_distance, plot_model: ids are places"),
    ("all(vapply(p$names[p$types %in% c('i', 'r')], function(n) class(all[[n]]) == 'numeric', NA))",
     "parallel_coord, sampling_frequency"),
    ("all(vapply(p$names[p$types %in% c('c', 'o')], function(n) class(all[[n]]) == 'character', NA))",
     "parallel_coord, sampling_frequency"),
    ("is.list(x$allElites) && all(unlist(x$allElites) %in% all$.ID.)", "boxplot_training, sampling_heatmap"),
    ("length(x$iterationElites) == length(x$allElites)", "summarise_by_iteration"),
    ("all(x$iterationElites == vapply(x$allElites, `[`, 1, 1))", "boxplot_performance: the best is the first"),
    ("is.logical(x$softRestart) && length(x$softRestart) == length(x$allElites)", "irace_summarise"),
    ("is.matrix(x$experiments) && is.numeric(x$experiments)", "plot_experiments_matrix, boxplot_performance"),
    ("identical(colnames(x$experiments), as.character(all$.ID.))", "boxplot_performance, scatter_performance"),
    ("identical(rownames(x$experiments), as.character(seq_len(nrow(x$experiments))))", "plot_experiments_matrix"),
    ("is.matrix(x$experimentLog)", "parallel_cat and sampling_heatmap of iraceplot 1"),
    ("all(c('iteration', 'instance', 'configuration', 'time', 'bound') %in% colnames(x$experimentLog))",
     "configurations_display, summarise_by_iteration of iraceplot 1"),
    ("inherits(log, 'data.table') && is.data.frame(log)", "plot_model, parallel_cat of iraceplot 2"),
    ("all(c('iteration', 'instance', 'configuration', 'cost', 'time', 'bound') %in% names(log))",
     "configurations_display, summarise_by_instance"),
    ("!anyNA(log$iteration) && setequal(log$iteration, seq_along(x$allElites))", "summarise_by_iteration"),
    ("all(x$experiments[cbind(log$instance, log$configuration)] == log$cost)", "configurations_display"),
    ("all(log$instance %in% seq_len(nrow(x$experiments)))", "summarise_by_instance"),
    ("is.data.frame(old) && nrow(old) >= nrow(x$experiments) && all(c('instance', 'seed') %in% names(old))",
     "scatter_training of iraceplot 1"),
    ("is.data.frame(new) && nrow(new) >= nrow(x$experiments) && all(c('instanceID', 'seed') %in% names(new))",
     "get_instanceID_seed_pairs"),
    ("is.character(x$scenario$instances) && max(new$instanceID) <= length(x$scenario$instances)",
     "summarise_by_instance, scatter_training"),
    ("is.character(x$scenario$trainInstancesDir)", "summarise_by_instance"),
    ("is.logical(x$scenario$testIterationElites) && is.numeric(x$scenario$testNbElites)", "boxplot_test"),
    ("is.logical(x$scenario$elitist)", "plot_model"),
    ("is.character(x$scenario$testInstances) && length(x$scenario$testInstances) == nrow(x$testing$experiments)",
     "has_testing_data, scatter_test"),
    ("is.matrix(x$testing$experiments) && all(colnames(x$testing$experiments) %in% all$.ID.)",
     "boxplot_test, summarise_by_configuration"),
    ("identical(names(x$testing$seeds), rownames(x$testing$experiments))", "boxplot_test"),
    ("is.character(x$state$completed) && x$state$completed != 'Incomplete'", "report, ablation"),
    ("identical(sort(x$state$rejected_ids), sort(unique(log$configuration[is.infinite(log$cost)])))"
     " || (is.null(x$state$rejected_ids) && !any(is.infinite(log$cost)))", "report, irace_summarise"),
    ("identical(names(p$types), p$names) && identical(names(p$switches), p$names)", "distance_config"),
    ("is.list(p$domain) && identical(names(p$domain), p$names)", "parallel_coord, sampling_pie of iraceplot 1"),
    ("identical(s$names, p$names) && identical(s$types, p$types)", "subset_param_names, plot_model"),
    ("is.list(s$domains) && identical(names(s$domains), p$names)", "plot_model, sampling_heatmap"),
    ("all(lengths(s$domains[p$types %in% c('i', 'r')]) == 2)", "plot_model, sampling_pie"),
    ("all(vapply(s$domains[p$types %in% c('c', 'o')], is.character, NA))", "plot_model, sampling_heatmap"),
    ("is.logical(s$isFixed) && identical(names(s$isFixed), p$names)", "subset_param_names"),
    ("s$nbVariable == sum(!s$isFixed) && s$nbParameters == length(s$names)", "plot_model"),
    ("is.list(s$depends) && identical(names(s$depends), p$names)", "parameters_tree"),
    ("identical(names(s$get()), p$names)", "parallel_cat of iraceplot 2"),
    ("all(vapply(s$get(), function(one) inherits(one, 'Parameter') && one$type %in% c('c', 'o', 'i', 'r'), NA))",
     "parallel_cat of iraceplot 2"),
    ("setequal(names(s$get_ordered()), p$names)", "sampling of irace 4"),
    ("inherits(s, 'ParameterSpace')", "checks of irace 4"),
]
CHECK_FIELDS = """
load(commandArgs(TRUE)[1])
x <- iraceResults
all <- x$allConfigurations; p <- x$parameters; s <- x$scenario$parameters
log <- x$state$experiment_log; old <- x$state$.irace$instancesList; new <- x$state$instances_log
checks <- readLines(commandArgs(TRUE)[2])
for (check in checks) if (!isTRUE(eval(parse(text = check)))) { cat(check, "\\n"); quit(status = 1) }
"""


def has_irace():
    if shutil.which("Rscript") is None:
        return False
    done = subprocess.run(["Rscript", "-e", 'cat(requireNamespace("irace", quietly = TRUE))'],
                          capture_output=True, text=True)
    return done.stdout.strip() == "TRUE"


def needs_irace_35(test):
    """What is compared with objects of irace 3.5, or calls its functions by their names of then."""
    def run(self):
        if self.r('cat(packageVersion("irace") >= "4")') == "TRUE":
            self.skipTest("skipped: for the functions of irace 3.5, and this is irace 4")
        test(self)
    return run


@unittest.skipUnless(has_irace(), "needs Rscript and irace (r-base-core, r-cran-irace)")
class IraceRdata(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def call(self, *words, code=0):
        done = subprocess.run([SWARMSMITH, *map(str, words)], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr[-2000:])
        return done

    def r(self, script, *words):
        """Runs a script, or its text; its output."""
        if not isinstance(script, pathlib.Path):
            file = self.folder / "script.R"
            file.write_text(script)
            script = file
        done = subprocess.run(["Rscript", "--vanilla", script, *map(str, words)], capture_output=True, text=True,
                              cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return done.stdout

    def tables(self, folder):
        """Rows of each table, without the apostrophes that keep a spreadsheet from calculating."""
        plain = re.compile(r"^'(?='*[=+@\t\r\n-])")
        return {name: [[plain.sub("", cell) for cell in row] for row in csv.reader(io.StringIO((folder / f"{name}.csv").read_text()))]
                for name in TABLES}

    def tables_of_log(self, log, name):
        folder = self.folder / name
        folder.mkdir()
        self.r(TO_TABLES, log, folder)
        return self.tables(folder)

    def exported(self, store, name):
        """Tables that `export` writes."""
        self.call("export", store, "--format", "rdata", "-o", f"{name}/")
        return self.tables(self.folder / name)

    def assert_same(self, one, other):
        for name in TABLES:
            self.assertEqual(sorted(one[name]) if name == "scenario" else one[name],
                             sorted(other[name]) if name == "scenario" else other[name], name)

    def checks_of_iraceplot(self, log):
        (self.folder / "checks.txt").write_text("\n".join(check for check, _ in IRACEPLOT) + "\n")
        self.r(CHECK_FIELDS, log, self.folder / "checks.txt")

    def tune(self, scenario=SCENARIO, runner=RUNNER, instances="in/a b\nin/ä\nin/c\nin/d\nin/e\n"):
        for name, text in [("parameters.txt", PARAMETERS + FORBIDDEN), ("scenario.txt", scenario),
                           ("instances.txt", instances), ("tests.txt", "t/1\nt/2\n"), ("target-runner", runner)]:
            (self.folder / name).write_text(text)
        (self.folder / "target-runner").chmod(0o755)
        self.call("irace", "--scenario", "scenario.txt")
        return self.folder / "irace.db"

    def rows(self, store, sql):
        return json.loads(self.call("query", store, sql, "--json").stdout)["rows"]

    def assert_elites(self, lines, store):
        """Of each iteration, with their mean costs."""
        elites = [line.split() for line in lines if not line.startswith("line")]
        ours = self.rows(store, "SELECT iteration, candidate, mean FROM v_convergence ORDER BY iteration, rank")
        self.assertEqual([(int(i), int(c)) for i, c, _ in elites], [(row["iteration"], row["candidate"]) for row in ours])
        for (_, _, cost), row in zip(elites, ours):
            self.assertAlmostEqual(float(cost), -row["mean"], places=6)

    @needs_irace_35
    def test_functions_of_irace_find_our_elites_and_their_costs(self):
        store = self.tune()
        done = self.call("export", store, "--format", "rdata", "-o", "irace.Rdata", "--json")
        told = json.loads(done.stdout)
        self.assertEqual((told["file"], told["design"]), ("irace.Rdata", "d1"))
        lines = self.r(WITH_IRACE, "irace.Rdata").splitlines()
        self.assert_elites(lines, store)
        # Command lines, too: switches, values and what is not active.
        commands = {int(line.split()[1]): line.split()[2:] for line in lines if line.startswith("line")}
        candidates = self.rows(store, "SELECT number, fsm_config FROM v_candidates")
        self.assertEqual(told["configurations"], len(candidates))
        self.assertEqual(commands, {row["number"]: row["fsm_config"].replace("'", "").split() for row in candidates})
        (self.folder / "parameters35.txt").write_text(PARAMETERS)
        self.r(SAME_PARAMETERS, "irace.Rdata", "parameters35.txt")

    def test_functions_of_irace_4_work_on_our_log(self):
        if self.r('cat(packageVersion("irace") < "4")') == "TRUE":
            self.skipTest("skipped: for the functions of irace 4, and this is irace 3")
        store = self.tune()
        self.call("export", store, "--format", "rdata", "-o", "irace.Rdata")
        said = self.r(WITH_IRACE_4, "irace.Rdata").splitlines()
        self.assert_elites([line for line in said if line[:1].isdigit()], store)  # irace says a line with "#"

    def test_what_iraceplot_reads_is_there(self):
        store = self.tune()
        self.call("export", store, "--format", "rdata", "-o", "irace.Rdata")
        self.checks_of_iraceplot("irace.Rdata")
        rejected = self.rows(store, "SELECT count(*) AS n FROM v_evaluations WHERE status = 'rejected'")[0]["n"]
        self.assertGreater(rejected, 0)

    def test_a_log_that_went_out_comes_in_again_the_same(self):
        store = self.tune()
        tables = self.exported(store, "tables")
        self.call("export", store, "--format", "rdata", "-o", "irace.Rdata")
        self.call("import", "irace.Rdata", "--into", "again.db")
        self.call("import", "tables", "--into", "tables.db", "--name", "irace")
        again = self.exported("again.db", "again")
        # Options are the same numbers in other words.
        numbers = {"1e-04": "0.0001"}
        tables["scenario"] = [[numbers.get(cell, cell) for cell in row] for row in tables["scenario"]
                              if row != ["cappingAfterFirstTest", "FALSE"]]  # irace 4 refuses it: left out
        self.assert_same(tables, again)
        for sql in ["SELECT number, iteration, parent, parameters, fsm_config, runs, mean FROM v_candidates",
                    "SELECT candidate, purpose, pair, instance, seed, iteration, status, score, "
                    "iif(purpose = 'race', time, NULL) FROM v_evaluations",  # a log has none of tests
                    "SELECT iteration, rank, candidate, mean, n FROM v_convergence"]:
            self.assertEqual(self.rows(store, sql + " ORDER BY 1, 2, 3"), self.rows("again.db", sql + " ORDER BY 1, 2, 3"))
            self.assertEqual(self.rows("tables.db", sql + " ORDER BY 1, 2, 3"),
                             self.rows("again.db", sql + " ORDER BY 1, 2, 3"))

    @needs_irace_35
    def test_a_log_of_r_comes_out_as_it_went_in(self):
        example = self.r('cat(system.file("exdata/irace-acotsp.Rdata", package = "irace"))')
        if not example:
            self.skipTest("this irace has no example")
        self.call("import", example, "--into", "acotsp.db")
        self.call("export", "acotsp.db", "--format", "rdata", "-o", "again.Rdata")
        self.assert_same(self.tables_of_log(example, "before"), self.tables_of_log("again.Rdata", "after"))
        self.r(SAME_AS_ORIGINAL, "again.Rdata", example)
        self.checks_of_iraceplot_of_35("again.Rdata")

    def checks_of_iraceplot_of_35(self, log):
        """All but the version, which stays that of the log."""
        (self.folder / "checks.txt").write_text(
            "\n".join(check for check, _ in IRACEPLOT if "irace_version" not in check) + "\n")
        self.r(CHECK_FIELDS, log, self.folder / "checks.txt")

    @needs_irace_35
    def test_a_campaign_of_machines(self):
        (self.folder / "machines.toml").write_text(CAMPAIGN)
        self.call("run", "machines.toml", "--store", "machines.db")
        self.call("export", "machines.db", "--format", "rdata", "--design", "d1", "-o", "machines.Rdata")
        self.checks_of_iraceplot("machines.Rdata")
        tables = self.tables_of_log("machines.Rdata", "after")
        ours = self.exported("machines.db", "before")
        for name in TABLES[:-1]:
            self.assertEqual(tables[name], ours[name], name)
        lines = self.r(WITH_IRACE, "machines.Rdata").splitlines()
        self.assert_elites(lines, "machines.db")

    @needs_irace_35
    def test_a_race_that_caps_with_a_budget_of_time(self):
        scenario = SCENARIO.replace("maxExperiments = 250", "maxTime = 700\ncapping = 1\nboundMax = 9\nboundPar = 2")
        store = self.tune(scenario, TIMED, "i1\ni2\ni3\ni4\ni5\n")
        self.call("export", store, "--format", "rdata", "-o", "irace.Rdata")
        self.assert_elites(self.r(WITH_IRACE, "irace.Rdata").splitlines(), store)
        runs = self.tables_of_log("irace.Rdata", "after")["runs"][1:]
        self.assertTrue(all(float(time) > 0 and float(bound) > 0 for *_, time, bound in runs))
        self.assertTrue(any(float(cost) != float(time) for _, _, _, cost, time, _ in runs), "none was capped")

    def test_the_same_store_gives_the_same_bytes_and_other_files_stay(self):
        store = self.tune()
        self.call("export", store, "--format", "rdata", "-o", "one.Rdata")
        first = (self.folder / "one.Rdata").read_bytes()
        self.call("export", store, "--format", "rdata", "-o", "one.Rdata")
        self.assertEqual((self.folder / "one.Rdata").read_bytes(), first)
        self.assertIn("is a text", self.call("export", store, "--format", "rdata", "-o", "tests.txt", code=2).stderr)
        # The tables make the same file where R is.
        self.exported(store, "tables")
        self.r(TO_LOG, "tables", "two.Rdata")
        self.assertEqual((self.folder / "two.Rdata").read_bytes(), first)
        (self.folder / "tables/runs.csv").unlink()
        done = subprocess.run(["Rscript", "--vanilla", TO_LOG, "tables", "three.Rdata"], cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the folder has no table runs.csv", done.stderr)


if __name__ == "__main__":
    unittest.main()
