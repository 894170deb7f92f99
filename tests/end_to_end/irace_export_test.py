"""The folder that R's irace runs: configurations put together as irace does score as ours do."""
import json
import random
import re
import subprocess
import unittest

from programs import ProgramTest, call, ended_well


def read_parameters(text):
    """(name, switch, type, domain, condition) of each line, as irace reads them."""
    line = re.compile(r'^(\w+)\s+"([^"]*)"\s+([cir])\s+\(([^|]*)\)\s*(?:\|\s*(.*))?$')
    return [line.match(one).groups() for one in text.split("[global]")[0].splitlines() if one]


def in_python(expression):
    """What the file uses of R."""
    return re.sub(r"%in% c\((.*?)\)", r"in (\1)", expression)


def random_words(parameters, rng):
    """One configuration as irace puts it on the command line, drawn in the order of the file."""
    values, words = {}, []
    for name, switch, kind, domain, condition in parameters:
        active = condition is None or all(
            values.get(other) is not None for other in re.findall(r"[A-Z]\w*", condition)
        ) and eval(in_python(condition), {}, values)
        if not active:
            values[name] = None
            continue
        if kind == "c":
            values[name] = rng.choice(domain.split(", "))
        else:
            low, high = (eval(bound.strip('"'), {"max": max}, values) for bound in domain.split(", ", 1))
            values[name] = rng.randint(low, high) if kind == "i" else round(rng.uniform(low, high), 2)
        words += (switch + str(values[name])).split()
    return words


class IraceExport(ProgramTest):
    budget = 2000

    def method(self, keys):
        """The campaign of the other tests, with another method and in the profile of its flavour."""
        text = self.file.read_text()
        self.assertIn('flavour = "watermelon-argos3"\n', text)
        self.file.write_text(text.replace('flavour = "watermelon-argos3"\n',
                                          f'flavour = "watermelon-argos3"\n{keys}\n'))

    def scores_are_those_of(self, variables, text_of=" ".join):
        """What the target-runner says of random words beside what `evaluate` says of their text."""
        folder = self.folder / "irace"
        ended_well(call("export", self.file, "--format", "irace", "-o", folder))
        parameters = read_parameters((folder / "parameters.txt").read_text())
        self.assertEqual(len(parameters), variables)
        rng = random.Random(11)
        scores = set()
        for number in range(20):
            words = random_words(parameters, rng)
            seed = rng.randint(1, 2**31 - 1)
            run = ended_well(subprocess.run([folder / "target-runner", str(number), "1", str(seed), "aggregation", *words],
                                            capture_output=True, text=True, timeout=60, cwd="/"))
            file = self.folder / "software.txt"
            file.write_text(text_of(words))
            ours = call("evaluate", file, "--flavour", "watermelon-argos3", "--profile", "argos3",
                        "--mission", "aggregation", "--seeds", seed, "--json")
            score = json.loads(ours.stdout)["score"]
            self.assertEqual(float(run.stdout), -score, words)
            scores.add(score)
        self.assertGreater(len(scores), 1)
        return (folder / "README").read_text()

    def test_the_target_runner_prints_minus_the_score_of_the_words(self):
        self.assertIn("from --nstates on", self.scores_are_those_of(149))

    def test_words_are_those_of_trees(self):
        self.method('method = "maple"')
        self.assertIn("from --nroot on", self.scores_are_those_of(66))

    def test_words_are_those_of_networks(self):
        self.method('method = "evostick"')
        said = self.scores_are_those_of(26, lambda words: "--network rvr --weights " + ",".join(words))
        self.assertIn("-- --network rvr --weights W1,W2,...", said)

    def test_words_that_are_no_machine_are_an_error_for_irace(self):
        folder = self.folder / "irace"
        call("export", self.file, "--format", "irace", "-o", folder)
        run = subprocess.run([folder / "target-runner", "1", "1", "7", "aggregation", "--nstates", "1", "--s0", "9"],
                             capture_output=True, text=True, timeout=60)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(run.stdout, "")
        self.assertIn("no module 9", run.stderr)


if __name__ == "__main__":
    unittest.main()
