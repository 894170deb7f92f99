"""irace for a Python function: ask and tell by the Python module."""
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from programs import call

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
MODULE = SOURCE / "analysis" / "python"
sys.path.insert(0, str(MODULE))
import swarmsmith  # noqa: E402

SPACE = {"x": swarmsmith.Real(0, 1), "m": [None, (1, 2)], "size": swarmsmith.Ordinal(["small", "large"]),
         "n": swarmsmith.Integer(1, 50, log=True, when='m == "None"')}
OPTIONS = {"max_experiments": 200, "seed": 3}

# Tunes x, and writes down each trial.
PROGRAM = """
import sys, time
import swarmsmith
def cost(trial):
    with open("calls.txt", "a") as file:
        print(trial.seed, trial.configuration["x"], file=file)
    time.sleep(0.01)
    return abs(trial.configuration["x"] - 0.3)
best = swarmsmith.tune(cost, {"x": swarmsmith.Real(0, 1)}, max_experiments=150, seed=1, store="x.db")
print(best[0]["configuration"]["x"])
"""


def cost(trial):
    values = trial.configuration
    return (values["x"] - 0.3) ** 2 + (0.1 * abs(values["n"] - 4) if values["m"] is None else 3)


class TunerTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.store = self.folder / "x.db"

    def count(self, sql):
        with swarmsmith.Store(self.store) as store:
            return store.query(sql)[0]["n"]

    def test_a_function_is_tuned(self):
        trials = []

        def counted(trial):
            trials.append(trial)
            return cost(trial)
        best = swarmsmith.tune(counted, SPACE, store=self.store, instances=["one", {"two": 2}],
                               initial=[{"x": 0.5, "m": (1, 2), "size": "large"}], forbidden=["x > 0.9"], **OPTIONS)
        self.assertLess(best[0]["cost"], 1)
        self.assertIsNone(best[0]["configuration"]["m"])
        self.assertIsInstance(best[0]["configuration"]["n"], int)
        self.assertEqual(trials[0].configuration, {"x": 0.5, "m": (1, 2), "size": "large"})
        self.assertLessEqual(max(trial.configuration["x"] for trial in trials), 0.9)
        self.assertEqual([trial.instance for trial in trials if trial.instance not in ("one", {"two": 2})], [])
        self.assertEqual(self.count("SELECT count(*) AS n FROM v_evaluations"), len(trials))
        self.assertEqual(call("verify", self.store).returncode, 0)
        # Over: nothing is asked again.
        made = len(trials)
        again = swarmsmith.tune(counted, SPACE, store=self.store, instances=["one", {"two": 2}],
                                initial=[{"x": 0.5, "m": (1, 2), "size": "large"}], forbidden=["x > 0.9"], **OPTIONS)
        self.assertEqual((again, len(trials)), (best, made))

    def test_several_at_a_time_give_the_same(self):
        most = 0
        with swarmsmith.Tuner(SPACE, parallel=4, **OPTIONS) as tuner:
            waiting = []
            while trials := tuner.ask():
                waiting += trials
                most = max(most, len(waiting))
                # The newest first, and not all of them at once.
                for trial in reversed(waiting):
                    tuner.tell(trial.id, cost(trial))
                waiting = []
            best = tuner.best
        self.assertLessEqual(most, 4)
        self.assertEqual(best, swarmsmith.tune(cost, SPACE, **OPTIONS))

    def test_an_exception_ends_the_run_and_the_same_call_goes_on(self):
        made = []

        def breaks(trial):
            if len(made) == 60:
                raise ZeroDivisionError
            made.append(trial)
            return cost(trial)
        with self.assertRaises(ZeroDivisionError):
            swarmsmith.tune(breaks, SPACE, store=self.store, **OPTIONS)
        more = []
        best = swarmsmith.tune(lambda trial: more.append(trial) or cost(trial), SPACE, store=self.store, **OPTIONS)
        self.assertEqual(best, swarmsmith.tune(cost, SPACE, **OPTIONS))
        seen = [(trial.seed, str(trial.configuration)) for trial in made + more]
        self.assertLessEqual(len(seen) - len(set(seen)), 1, "at most the last one was not stored")

    def test_killed_it_goes_on(self):
        words = [sys.executable, "-c", PROGRAM]
        around = {**os.environ, "PYTHONPATH": str(MODULE)}
        first = subprocess.Popen(words, cwd=self.folder, env=around, start_new_session=True)
        calls = self.folder / "calls.txt"
        while not calls.exists() or len(calls.read_text().splitlines()) < 40:
            self.assertIsNone(first.poll())
            time.sleep(0.01)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        again = subprocess.run(words, cwd=self.folder, env=around, capture_output=True, text=True, check=False)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertLess(abs(float(again.stdout) - 0.3), 0.1)
        lines = calls.read_text().splitlines()
        self.assertLessEqual(len(lines) - len(set(lines)), 1)
        self.assertLess(len(lines), 153)
        self.assertEqual(call("verify", self.store).returncode, 0)

    def test_rejections_times_and_failures(self):
        best = swarmsmith.tune(lambda trial: (math.inf if trial.configuration["m"] else cost(trial), 0.5), SPACE, **OPTIONS)
        self.assertIsNone(best[0]["configuration"]["m"])
        with swarmsmith.Tuner(SPACE, **OPTIONS) as tuner:
            trial = tuner.ask()[0]
            with self.assertRaisesRegex(swarmsmith.Error, "not a number"):
                tuner.tell(trial.id, math.nan)
            tuner.fail(trial.id, "out of memory")
            with self.assertRaisesRegex(swarmsmith.Error, "told already"):
                tuner.tell(trial.id, 1)
            with self.assertRaisesRegex(swarmsmith.Error, "out of memory"):
                tuner.ask()

    def test_what_is_wrong_is_said(self):
        for space, options, sentence in (({"a b": [1]}, {}, "no name of a parameter"),
                                         ({"a": ["x y", "x,y"]}, {}, "written alike"),
                                         (SPACE, {**OPTIONS, "test_instances": ["a"]}, "has no effect here"),
                                         (SPACE, {"max_experiments": 10}, "too small"),
                                         (SPACE, {**OPTIONS, "frist_test": 3}, "firstTest")):
            with self.assertRaisesRegex(swarmsmith.Error, sentence):
                swarmsmith.tune(cost, space, **options)

    def test_over_a_pipe(self):
        process = subprocess.Popen([sys.executable, "-m", "swarmsmith"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   text=True, env={**os.environ, "PYTHONPATH": str(MODULE)})
        with process:
            def send(message):
                process.stdin.write(json.dumps(message) + "\n")
                process.stdin.flush()
            send({"space": {"x": {"type": "real", "lower": 0, "upper": 1}, "m": {"type": "categorical", "values": [1, 2]}},
                  "max_experiments": 180, "seed": 1, "parallel": 2})
            for line in process.stdout:
                message = json.loads(line)
                if "best" in message:
                    break
                for trial in message["ask"]:
                    send({"tell": [{"id": trial["id"], "cost": abs(trial["configuration"]["x"] - 0.3)}]})
        self.assertEqual(process.returncode, 0)
        self.assertLess(message["best"][0]["cost"], 0.1)

    def test_the_example(self):
        done = subprocess.run([sys.executable, SOURCE / "examples" / "tuner.py", "x.db"], cwd=self.folder, text=True,
                              capture_output=True, check=False, env={**os.environ, "PYTHONPATH": str(MODULE)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'kernel': 'rbf'", done.stdout)


if __name__ == "__main__":
    unittest.main()
