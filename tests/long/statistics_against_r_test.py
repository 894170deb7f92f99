"""Our statistics beside R itself (base packages): the golden file made again, other random samples, and the tables of
`compare` on a real campaign. SEED in the environment changes the other samples.
"""
import csv
import io
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"]).resolve()
GOLDEN = pathlib.Path(__file__).resolve().parent.parent / "golden" / "statistics"
SEED = os.environ.get("SEED", "2026")

CAMPAIGN = """\
format = 1
[campaign]
name = "compared"
seed = 11
repetitions = 4
store = "c.db"
[[mission]]
name = "aggregation"
duration = "20 s"
  [mission.instances]
  test = { count = 5 }
[[mission]]
name = "color_selection"
duration = "20 s"
  [mission.instances]
  test = { count = 5 }
[[method]]
name = "two"
flavour = "watermelon"
max_states = 2
[[method]]
name = "one"
flavour = "watermelon"
max_states = 1
[race]
max_experiments = 1100
[simulator]
profile = "rvr"
"""

R_TESTS = """
scores <- read.csv("scores.csv")
means <- aggregate(score ~ design + method + mission, scores, mean)
here <- means[means$mission == "aggregation", ]
one <- here$score[here$method == "one"]
two <- here$score[here$method == "two"]
test <- suppressWarnings(wilcox.test(one, two))
friedman <- friedman.test(tapply(means$score, list(means$mission, means$method), mean))
cat(sprintf("%.15g\\n", c(test$statistic, test$p.value, mean(one) - mean(two), mean(outer(one, two, ">")) +
  mean(outer(one, two, "==")) / 2, sd(one), quantile(two, 0.25), friedman$statistic, friedman$p.value)), sep = "")
"""


def run(*command, cwd=None, env=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=cwd,
                          env={**os.environ, **(env or {})}, timeout=1200)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


@unittest.skipIf(shutil.which("Rscript") is None, "needs R (Debian's r-base-core)")
class StatisticsAgainstR(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_golden_file_is_what_r_says(self):
        made = self.folder / "statistics.json"
        run("Rscript", GOLDEN / "make.R", made)
        ours = (GOLDEN / "statistics.json").read_text().splitlines()
        theirs = made.read_text().splitlines()
        if ours[1] != theirs[1]:
            self.skipTest(f"golden file of {ours[1]}, here is {theirs[1]}")
        self.assertEqual(ours, theirs)

    def test_other_samples_agree_too(self):
        made = self.folder / "statistics.json"
        run("Rscript", GOLDEN / "make.R", made, SEED, 400, 200, 0.03)
        print(run(BIN / "statistics_golden_test", env={"SWARMSMITH_STATISTICS": str(made)}))

    def test_compare_says_what_r_says_of_the_same_store(self):
        (self.folder / "c.toml").write_text(CAMPAIGN)
        program = BIN / "swarmsmith"
        run(program, "run", "c.toml", "--workers", "1", "-q", cwd=self.folder)
        scores = run(program, "query", "c.db", "SELECT design, mission, method, score FROM v_design_scores", "--csv",
                     cwd=self.folder)
        (self.folder / "scores.csv").write_text(scores)
        theirs = [float(line) for line in run("Rscript", "-e", R_TESTS, cwd=self.folder).split()]

        def table(name):
            text = run(program, "compare", "c.db", "--by", "method", "--csv", "--table", name, cwd=self.folder)
            return list(csv.DictReader(io.StringIO(text)))

        pair, = (pair for pair in table("pairs") if pair["mission"] == "aggregation")
        groups = {group["method"]: group for group in table("groups") if group["mission"] == "aggregation"}
        ranks = table("ranks")
        self.assertEqual((pair["first"], pair["second"], pair["n_first"]), ("one", "two", "4"))
        ours = [pair["statistic"], pair["p"], pair["mean_difference"], pair["a12"], groups["one"]["sd"],
                groups["two"]["lower_quartile"], ranks[0]["chi_squared"], ranks[0]["p"]]
        for our, their in zip(ours, theirs, strict=True):
            self.assertAlmostEqual(float(our), their, delta=1e-9 * max(1, abs(their)))


if __name__ == "__main__":
    unittest.main()
