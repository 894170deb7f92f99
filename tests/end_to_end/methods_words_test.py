"""Each search is described in its own words, and what does not fit it is refused in one sentence."""
import json
import unittest

from programs import ProgramTest, call, ended_well

HEAD = """\
format = 1

[campaign]
name = "words"
seed = 5
store = "unused.db"

[[mission]]
name = "aggregation"
  [mission.instances]
  test = {{ count = 2 }}

{methods}
[race]
max_experiments = {budget}
"""
METHODS = {
    "random": "",
    "vanilla": "",
    "evostick": "[method.evolution]\npopulation = 10\nruns = 2\nfinal_runs = 5\n",
    "cma-es": "[method.cma-es]\npopulation = 10\nruns = 2\nfinal_runs = 5\n",
    "icepop": "",
}
DESIGNS = {name: f"d{i}" for i, name in enumerate(METHODS, 1)}
WITHOUT_TESTS = ("random", "evostick", "cma-es", "icepop")


def method(preset, table="", name=None):
    return f'[[method]]\nname = "{name or preset}"\nmethod = "{preset}"\n{table}\n'


class Words(ProgramTest):
    finished = None

    def store(self):
        """A finished store of all searches, which is made once."""
        path = self.folder / "words.db"
        if Words.finished is None:
            file = self.folder / "words.toml"
            file.write_text(HEAD.format(
                budget=600, methods="".join(method(*one) for one in METHODS.items())))
            done = ended_well(call("run", file, "--store", path, "-v"))
            Words.finished = path.read_bytes(), done.stdout, done.stderr
        path.write_bytes(Words.finished[0])
        return path

    def answer(self, *arguments):
        done = ended_well(call(*arguments))
        return done.stdout

    def refused(self, sentence, *arguments):
        done = call(*arguments, cwd=self.folder)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_progress(self):
        self.store()
        said = Words.finished[2]
        self.assertIn("d3 generation 1 of 27: 10 members, 2 runs each", said)
        self.assertIn("d3 final stage: 10 members, 6 runs each", said)
        self.assertIn("d1 configurations 1 to 50 of 50: 10 runs each", said)
        self.assertIn("d2 one race: 30 configurations", said)
        self.assertIn("d5 scale of the scores: 21 configurations, 10 runs each", said)
        self.assertIn('event="design searching" campaign=words design=d4', said)
        self.assertIn('event="design racing" campaign=words design=d2', said)
        self.assertNotIn('event="iteration begun"', said)
        self.assertNotIn("\nd3 iteration", said)

    def test_result(self):
        self.store()
        said = Words.finished[1].splitlines()
        winners = [line for line in said if line.startswith("  best ")]
        self.assertEqual(len(winners), len(METHODS))
        for name, line in zip(METHODS, winners):
            self.assertIn("in the race" if name == "vanilla" else "in the final stage", line)

    def test_status_show_and_ls(self):
        store = self.store()
        for command in (("status",), ("ls", "designs")):
            text = self.answer(*command, store)
            self.assertIn("stage", text)
            self.assertIn("final stage: 10 of 10 members", text)
            self.assertIn("one race: ", text)
            self.assertNotIn("iteration", text)
        text = self.answer("status", store)
        self.assertTrue("one configuration is left" in text or "does not fit" in text or
                        "budget exhausted" in text, text)
        designs = json.loads(self.answer("status", store, "--json"))["designs"]
        self.assertEqual([one["stage"].split(":")[0] for one in designs],
                         ["final stage", "one race", "final stage", "final stage", "final stage"])
        self.assertIn("generation 27", self.answer("show", "d3", store))

    def test_explain(self):
        store = self.store()
        text = self.answer("explain", "d3", store)
        self.assertIn("search      evolution", text)
        self.assertRegex(text, r"winner      c\d+, made in generation \d+; mean \S+ over 6 runs in "
                               r"the final stage, .* the best mean before it")
        self.assertIn("generation 27 of 27: 10 members, 2 runs each; best c", text)
        self.assertIn("one race", self.answer("explain", "d2", store))
        # The walk's last iterations are reported, although the final stage ended them.
        parts = self.answer("explain", "d5", store).split("\n\n")[1].splitlines()
        self.assertEqual([part.split(":")[0].split(";")[0].split(" ")[0] for part in parts],
                         ["scale"] + ["iterations"] * (len(parts) - 2) + ["final"], parts)
        self.assertRegex(parts[-2], r"^iterations \d+ to \d+$")
        told = json.loads(self.answer("explain", "d4", store, "--json"))
        self.assertEqual(told["search"], "cma-es")
        self.assertEqual(told["stages"][-1]["stage"], "final stage")
        evaluation = self.query(store, "SELECT id FROM v_evaluations WHERE design = 3")[0]["id"]
        text = self.answer("explain", evaluation, store)
        self.assertIn("asked for   generation 1, first in step 1", text)
        self.assertIn("\nnetwork ", text)
        self.refused("has no d9", "explain", "d9", store)

    def test_experiment_files_are_of_machines_alone(self):
        store = self.store()
        self.refused("the control software is a network, and .argos files of RVRs can hold only state "
                     "machines", "export", store, "--design", "d3", "--format", "argos")
        done = ended_well(call("export", store, "--format", "argos", "-o", self.folder / "experiments"))
        self.assertIn("2 of 5 are left out: .argos files can hold state machines, and for e-pucks trees", done.stderr)
        written = sorted(path.name[:2] for path in (self.folder / "experiments").iterdir())
        self.assertEqual(written, ["d1", "d2", "d5"])

    def test_figure_race(self):
        store = self.store()
        drawn = self.folder / "race.svg"
        for name in WITHOUT_TESTS:
            self.refused("has no races to draw", "figure", "race", store, "--design", DESIGNS[name],
                         "-o", drawn)
        self.answer("figure", "race", store, "--design", DESIGNS["vanilla"], "-o", drawn)

    def check(self, methods, budget=2400):
        file = self.folder / "checked.toml"
        file.write_text(HEAD.format(methods=methods, budget=budget))
        return call("check", file)

    def test_figures_of_modules_and_parameters(self):
        store = self.store()
        picture = self.folder / "figure.svg"
        self.answer("figure", "modules", store, "--method", "random", "-o", picture)
        self.refused("they are neural networks", "figure", "modules", store, "--method", "evostick",
                     "-o", picture)
        for kind in ("sampling", "parallel", "importance"):
            self.refused("weights of a neural network", "figure", kind, store, "--design",
                         DESIGNS["evostick"], "-o", picture)

    def test_unknown_names(self):
        for words, sentence in (('method = "evostik"', '"evostick"'),
                                ('search = "cmaes"', '"cma-es"'),
                                ('architecture = "netwrk"', '"network"')):
            done = self.check(f'[[method]]\nname = "m"\n{words}\n')
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(sentence, done.stderr)

    def test_keys_of_another_search(self):
        done = self.check(method("evostick", "[method.cma-es]\npopulation = 10\n"))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("[method.cma-es] is for the search cma-es", done.stderr)
        done = self.check(method("evostick", "[method.evolution]\nwindow = 10\n"))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("window", done.stderr)

    def test_spaces_that_do_not_fit(self):
        for search in ("evolution", "cma-es"):
            done = self.check(f'[[method]]\nname = "m"\nsearch = "{search}"\n')
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("needs reals without conditions", done.stderr)

    def test_the_least_budget_works(self):
        for name, table in METHODS.items():
            small = self.check(method(name, table), budget=3)
            self.assertEqual(small.returncode, 2, small.stdout)
            self.assertIn("must be at least ", small.stderr)
            least = int(small.stderr.split("must be at least ")[1].split()[0].strip(".,;"))
            self.assertEqual(self.check(method(name, table), budget=least).returncode, 0, name)
            self.assertEqual(self.check(method(name, table), budget=least - 1).returncode, 2, name)
            file = self.folder / "checked.toml"
            file.write_text(HEAD.format(methods=method(name, table), budget=least))
            ended_well(call("run", file, "--store", self.folder / f"{name}.db"))


if __name__ == "__main__":
    unittest.main()
