"""The folder that R's irace runs: configurations put together as irace does score as ours do."""
import json
import random
import re
import subprocess
import unittest

from programs import ProgramTest, call


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

    def test_the_target_runner_prints_minus_the_score_of_the_words(self):
        folder = self.folder / "irace"
        done = call("export", self.file, "--format", "irace", "-o", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        parameters = read_parameters((folder / "parameters.txt").read_text())
        self.assertEqual(len(parameters), 149)
        rng = random.Random(11)
        scores = set()
        for number in range(20):
            words = random_words(parameters, rng)
            seed = rng.randint(1, 2**31 - 1)
            run = subprocess.run([folder / "target-runner", str(number), "1", str(seed), "aggregation", *words],
                                 capture_output=True, text=True, timeout=60, cwd="/")
            self.assertEqual(run.returncode, 0, run.stderr)
            machine = self.folder / "machine.fsm"
            machine.write_text(" ".join(words))
            ours = call("evaluate", machine, "--flavour", "watermelon-argos3", "--profile", "argos3",
                        "--mission", "aggregation", "--seeds", seed, "--json")
            score = json.loads(ours.stdout)["score"]
            self.assertEqual(float(run.stdout), -score, words)
            scores.add(score)
        self.assertGreater(len(scores), 1)

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
