"""irace for a Python function: ask and tell by the Python module."""
import json
import math
import multiprocessing
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import warnings

from programs import call, ended_well

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
MODULE = SOURCE / "analysis" / "python"
sys.path.insert(0, str(MODULE))
import swarmsmith  # noqa: E402
import swarmsmith_space  # noqa: E402

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


class SpaceTest(unittest.TestCase):
    """What Python writes, without a run."""

    def lines(self, space):
        return list(swarmsmith_space.Space(space).parameter_lines())

    def refusal(self, space, kind=swarmsmith.SpaceError):
        with self.assertRaises(kind) as raised:
            swarmsmith_space.Space(space)
        return str(raised.exception)

    def test_a_tuple_of_two_numbers_is_a_range_and_a_list_a_choice(self):
        self.assertEqual(self.lines({"x": (0.0, 1.0), "n": (1, 8), "m": (0, 0.5), "c": [0.0, 1.0], "d": ("a", "b"), "e": (1, 2, 3)}),
                         ['x "x=" r (0.0, 1.0)', 'n "n=" i (1, 8)', 'm "m=" r (0.0, 0.5)', 'c "c=" c ("0.0", "1.0")',
                          'd "d=" c ("a", "b")', 'e "e=" c ("1", "2", "3")'])
        for domain in ("ab", 3, None, {"a": 1}):
            self.assertIn("a tuple of two numbers is a range, a list is a choice", self.refusal({"x": domain}))
        self.assertIn("x: the lower end of a range must be below the upper one", self.refusal({"x": (1, 0)}))
        for call in (lambda: swarmsmith.Real(0, 1, log=True), lambda: swarmsmith.Integer(1.5, 3), lambda: swarmsmith.Real(0, math.inf),
                     lambda: swarmsmith.Real("0.5", None), lambda: swarmsmith.Categorical([]),
                     lambda: swarmsmith.Real(0, 1, when=3), lambda: swarmsmith.Real(1, 2, log="yes"),
                     lambda: swarmsmith.Real(0, 10**400),
                     lambda: swarmsmith.Categorical("abc"), lambda: swarmsmith.Ordinal(3), lambda: swarmsmith.Ordinal(["a"], when=["b"])):
            self.assertRaises(swarmsmith.SpaceError, call)
            self.assertRaises(ValueError, call)

    def test_any_name_is_one(self):
        space = swarmsmith_space.Space({"learning-rate": (0.1, 1.0), "_k": ["a b"], "größe 2": (1, 3), "x.y_1": (1, 3)})
        self.assertEqual(list(space.names), ["learning_rate", "p_k", "gr__e_2", "x.y_1"])
        self.assertEqual(space.values({"learning_rate": "0.5", "p_k": "a_b", "gr__e_2": None}), {"learning-rate": 0.5, "_k": "a b"})
        self.assertEqual(space.expression("`learning-rate` > 0.5 & `_k` == 'a_b'"), "learning_rate > 0.5 & p_k == 'a_b'")
        with self.assertRaisesRegex(swarmsmith.SpaceError, "did you mean 'learning-rate'"):
            space.expression("`learning-rat` > 0.5")
        self.assertIn("'a-b' and 'a_b' are both a_b", self.refusal({"a-b": (0, 1), "a_b": (0, 1)}))
        self.assertIn("must be a text", self.refusal({3: (0, 1)}))

    def test_digits_fit_the_space(self):
        for domain, digits in (((0.0, 1.0), 4), ((0.0, 0.5), 4), ((0.0, 0.001), 6), ((0.123456, 2.0), 6), ((-1e6, 1e6), 4),
                               (swarmsmith.Real(1e-4, 1, log=True), 7), (swarmsmith.Real(1e-6, 1, log=True), 9),
                               (swarmsmith.Real(10, 1000, log=True), 4)):
            self.assertEqual(swarmsmith_space.Space({"x": domain}).digits(), digits, domain)
        with self.assertRaisesRegex(swarmsmith.SpaceError, "x: it needs 23 decimals, and irace has 15: tune its logarithm"):
            swarmsmith_space.Space({"x": swarmsmith.Real(1e-20, 1, log=True)}).digits()

    def test_whole_numbers_are_exact_or_refused(self):
        large = swarmsmith.Integer(0, 2**53 - 1)
        self.assertEqual(large.value(large.text(2**53 - 1)), 2**53 - 1)
        self.assertIn("exact up to 9007199254740991", self.refusal({"x": (0, 2**53)}))

    def test_configurations_are_checked(self):
        space = swarmsmith_space.Space({"x": (0.0, 1.0), "m": ["a", None]})
        self.assertEqual(space.configuration_line({"m": None, "x": 1}), '1.0 "None"')
        inactive = swarmsmith_space.Space({"x": (0.0, 1.0), "m": ["a", "b"]})
        self.assertEqual(inactive.configuration_line({"m": None, "x": None}), "NA NA")
        with self.assertRaisesRegex(swarmsmith_space.SpaceError, "x: the value must be a number, and finite, found 'abc'"):
            space.configuration_line({"x": "abc"})
        for configuration, sentence in (({"y": 1}, "'y' is not a parameter of the space: it has x, m"), ({"xx": 1}, "did you mean 'x'"),
                                        ({"x": 2}, "x: 2 is not between 0.0 and 1.0"), ({"x": "a"}, "x: .* a number"),
                                        ({"m": "b"}, "m: 'b' is not one of its values")):
            with self.assertRaisesRegex(swarmsmith.SpaceError, sentence):
                space.configuration_line(configuration)


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
        with self.assertWarnsRegex(UserWarning, "nothing was run: these are the results that .*x.db holds"):
            again = swarmsmith.tune(counted, SPACE, store=self.store, instances=["one", {"two": 2}],
                                    initial=[{"x": 0.5, "m": (1, 2), "size": "large"}], forbidden=["x > 0.9"], **OPTIONS)
        self.assertEqual((again, len(trials)), (best, made))
        # All that was run, as rows.
        self.assertEqual(len(best.trials), made)
        seen = {(str(trial.configuration), str(trial.instance), trial.seed): cost(trial) for trial in trials}
        for row in best.trials:
            self.assertAlmostEqual(row["cost"], seen[str(row["configuration"]), str(row["instance"]), row["seed"]], 12)
        self.assertEqual(again.trials, best.trials)

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

    def test_jobs_evaluate_at_a_time_and_give_the_same(self):
        # A call waits until four run at once, which they cannot one at a time.
        meet, met = multiprocessing.Barrier(4), multiprocessing.Value("i", 0)

        def waits(trial):
            with met.get_lock():
                met.value += 1
                first = met.value <= 4
            if first:
                meet.wait(timeout=100)
            return cost_of_x(trial)

        def cost_of_x(trial):
            return abs(trial.configuration["x"] - 0.3), 0.5
        told = []
        space, options = {"x": (0.0, 1.0)}, {"max_experiments": 72, "seed": 3, "first_test": 2, "mu": 2}
        best = swarmsmith.tune(waits, space, n_jobs=4, progress=told.append, **options)
        self.assertEqual(best, swarmsmith.tune(cost_of_x, space, progress=False, **options))
        self.assertEqual(told[-1].budget, 72)
        self.assertGreaterEqual(told[-1].trials, len(best.trials))
        self.assertAlmostEqual(told[-1].best, best[0]["value"], 6)
        self.assertEqual({row["time"] for row in best.trials}, {0.5})
        # The other direction.
        most = swarmsmith.tune(lambda trial: (-cost_of_x(trial)[0], 0.5), space, direction="maximize", **options)
        self.assertEqual([(one["id"], one["value"], one["cost"]) for one in most],
                         [(one["id"], -one["value"], one["value"]) for one in best])

    def test_a_job_that_fails_or_is_killed_ends_the_run(self):
        def breaks(trial):
            raise ZeroDivisionError("of mine")

        def dies(trial):
            os.kill(os.getpid(), signal.SIGKILL)
        with self.assertRaisesRegex(ZeroDivisionError, "of mine") as raised:
            swarmsmith.tune(breaks, SPACE, n_jobs=2, **OPTIONS)
        self.assertIn("in breaks", str(raised.exception.__cause__))
        for function, how in ((dies, "was killed by SIGKILL"), (lambda trial: os._exit(3), "ended itself with exit status 3")):
            with self.assertRaisesRegex(swarmsmith.Error, how + r"; its configuration is \{'x': [0-9.]+, "):
                swarmsmith.tune(function, SPACE, n_jobs=2, **OPTIONS)

    def test_what_is_no_cost_is_refused(self):
        for answer in (None, "0.5", math.nan, [1], 10**400, (), (1,), (1, 2, 3), (1, "a"), (1, -1), (1, math.nan)):
            for jobs in (1, 2):
                with self.subTest(answer, jobs=jobs), self.assertRaisesRegex(
                        swarmsmith.CostError, r"the (value|time) of trial \d is .*; its configuration is \{'x': [0-9.]+, "):
                    swarmsmith.tune(lambda trial: answer, SPACE, n_jobs=jobs, **OPTIONS)

    def test_a_store_of_the_other_direction_is_refused(self):
        space, options = {"x": (0.0, 1.0)}, {"max_experiments": 72, "seed": 3, "first_test": 2, "mu": 2, "store": self.store}

        def value(trial):
            return abs(trial.configuration["x"] - 0.3)
        for made, other in (("minimize", "maximize"), ("maximize", "minimize")):
            for trials in (20, 100):  # Broken off, and finished.
                left = iter(range(trials))
                try:
                    best = swarmsmith.tune(lambda trial: value(trial) + 0 * next(left), space, direction=made, **options)
                except StopIteration:
                    best = None
                with self.assertRaisesRegex(swarmsmith.OptionError, f'^direction: .*x.db was made with "{made}"'):
                    swarmsmith.tune(value, space, direction=other, **options)
            with self.assertWarnsRegex(UserWarning, "nothing was run"):
                self.assertEqual(swarmsmith.tune(value, space, direction=made, **options), best)
            self.store.unlink()

    def test_jobs_end_with_their_process(self):
        program = PROGRAM.replace("seed=1", "seed=1, n_jobs=3").replace("time.sleep(0.01)", "print(__import__('os').getpid(), "
                                                                        "file=open('pids.txt', 'a')); time.sleep(600)")
        first = subprocess.Popen([sys.executable, "-c", program], cwd=self.folder, env={**os.environ, "PYTHONPATH": str(MODULE)})
        file = self.folder / "pids.txt"
        while not file.exists() or len(file.read_text().split()) < 3:
            self.assertIsNone(first.poll())
            time.sleep(0.05)
        first.kill()
        first.wait()
        for pid in file.read_text().split():
            deadline = time.monotonic() + 60
            while pathlib.Path("/proc", pid).exists() and "Z" not in pathlib.Path("/proc", pid, "stat").read_text().split(")")[1][:3]:
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.05)

    def test_a_store_of_earlier_digits_goes_on(self):
        space = {"x": swarmsmith.Real(1e-4, 1, log=True)}
        function = lambda trial: abs(math.log10(trial.configuration["x"]) + 2)  # noqa: E731
        options = {"max_experiments": 72, "seed": 3, "first_test": 2, "mu": 2, "store": self.store}
        best = swarmsmith.tune(function, space, digits=4, **options)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertEqual(swarmsmith.tune(function, space, **options), best)

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
        again = ended_well(subprocess.run(words, cwd=self.folder, env=around, capture_output=True, text=True, check=False))
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
            with self.assertRaisesRegex(swarmsmith.CostError, "not a number"):
                tuner.tell(trial.id, math.nan)
            tuner.fail(trial.id, "out of memory")
            with self.assertRaisesRegex(swarmsmith.Error, "already told"):
                tuner.tell(trial.id, 1)
            with self.assertRaisesRegex(swarmsmith.Error, r"^trial 1 failed: out of memory; its configuration is \{'x': [^\n]*\}$"):
                tuner.ask()

    def test_what_is_wrong_is_said(self):
        names, options = {"learning-rate": (0.1, 1.0), "k": swarmsmith.Integer(1, 3, when="`learning-rate` > 0.5")}, OPTIONS
        wrong_space, wrong_option = swarmsmith.SpaceError, swarmsmith.OptionError
        for kind, space, more, sentence in (
                (wrong_space, {"a b": [1], "a_b": [2]}, {}, "are both a_b for irace"),
                (wrong_space, {"a": ["x y", "x,y"]}, {}, "have the same text"),
                (wrong_option, SPACE, {"test_instances": ["a"]}, "has no effect here"),
                (wrong_option, SPACE, {"max_experiments": 10}, "^max_experiments: a budget of 10 experiments is too small"),
                (wrong_option, SPACE, {"frist_test": 3}, '^frist_test: .*did you mean "first_test"'),
                (wrong_option, SPACE, {"seed": "one"}, "^seed: "),
                (wrong_option, SPACE, {"direction": "up"}, "direction"),
                (wrong_option, SPACE, {"n_jobs": 0}, "n_jobs"),
                (wrong_option, SPACE, {"n_jobs": True}, "n_jobs"),
                (wrong_option, SPACE, {"progress": "no"}, "^progress must be"),
                (wrong_option, SPACE, {"instances": "ab"}, "^instances: expected a list"),
                (wrong_option, SPACE, {"instances": 3}, "^instances: expected a list"),
                (wrong_option, SPACE, {"parallel": "two"}, "^parallel: expected a whole number"),
                (wrong_option, SPACE, {"digits": "4"}, "^digits: expected a whole number"),
                (wrong_option, SPACE, {"store": 3}, "^store: expected the path"),
                (wrong_option, SPACE, {"store": ""}, "^store: expected the path"),
                (wrong_option, SPACE, {"mu": [3]}, "^mu: expected a number"),
                (wrong_option, SPACE, {"mu": math.nan}, "^mu: expected a number"),
                (wrong_option, SPACE, {"mu": 10**400}, "^mu: expected a number"),
                (wrong_space, SPACE, {"initial": {"x": 0.2}}, "^initial: expected a list"),
                (wrong_space, SPACE, {"initial": [0.2]}, r"^initial\[0\]: a configuration must be a dictionary"),
                (wrong_space, SPACE, {"forbidden": "x > 0.9"}, "^forbidden: expected a list"),
                (wrong_space, SPACE, {"forbidden": [3]}, r"^forbidden\[0\]: a condition must be a text"),
                (wrong_space, SPACE, {"initial": [{"x": 0.5, "y": 1}]}, r"^initial\[0\]: 'y' is not a parameter"),
                (wrong_space, names, {"initial": [{"learning-rate": 0.6}]}, r"^initial\[0\]: .*'k'"),
                (wrong_space, names, {"forbidden": ["k > ["]}, r"^forbidden: k > \[: found"),
                (wrong_space, {"x": (0, 1), "y": swarmsmith.Real(0, 1, when="z > 3")}, {}, "^space: y: there is no parameter 'z'")):
            with self.subTest(sentence), self.assertRaisesRegex(kind, sentence) as raised:
                swarmsmith.tune(cost, space, **{**options, **more})
            self.assertNotRegex(str(raised.exception), r"\.txt|[a-z][A-Z]")
        with self.assertRaisesRegex(swarmsmith.Error, "SWARMSMITH_BIN"):
            swarmsmith.tune(cost, SPACE, program="/nowhere/swarmsmith", **OPTIONS)

    def test_whole_numbers_beyond_those_of_r_are_kept(self):
        space = {"n": (0, 2**53 - 1), "m": swarmsmith.Integer(1, 9, when="n > 3e9")}
        seen = []
        best = swarmsmith.tune(lambda trial: seen.append(trial.configuration) or abs(trial.configuration["n"] - 5e15) / 1e15, space,
                               max_experiments=96, seed=3, first_test=2, mu=2, store=self.store)
        self.assertIn(best[0]["configuration"], seen)
        self.assertGreater(best[0]["configuration"]["n"], 2**50)
        self.assertTrue(all(("m" in one) == (one["n"] > 3e9) for one in seen))
        with swarmsmith.Store(self.store) as store:
            kept = {row["value"] for row in store.query("SELECT value FROM v_parameters WHERE parameter = 'n'")}
        self.assertEqual(kept, {one["n"] for one in seen})

    def test_none_leaves_an_option_out(self):
        space = {"x": (0.0, 1.0)}
        swarmsmith.tune(lambda trial: trial.configuration["x"], space, max_experiments=72, first_test=2, mu=2, seed=None,
                        confidence=None, instances=None, initial=None)

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

    def test_errors_over_a_pipe_name_the_line(self):
        real = {"type": "real", "lower": 0, "upper": 1}
        first = {"space": {"x": real}, "max_experiments": 180, "seed": 1}
        for lines, sentence in (
                ([], "line 1: the input ended"), (["{"], "line 1: this is not JSON"), ([[1]], "line 1: expected a JSON object"),
                ([{"seed": 1}], "line 1: `space` is missing"), ([{"space": [1]}], "line 1: `space` must be an object"),
                ([{"space": {"x": 3}}], "line 1: x: expected an object with `type`"),
                ([{"space": {"x": {"type": "foo"}}}], "line 1: x: .*one of real, integer, categorical, ordinal"),
                ([{"space": {"x": {"type": "real", "lower": 0}}}], "line 1: x: `upper` is missing"),
                ([{"space": {"x": {**real, "uper": 1}}}], "line 1: x: `uper` is not known"),
                ([{"space": {"x": {**real, "when": 3}}}], "line 1: x: when: a condition must be a text"),
                ([{**first, "parallel": "a"}], "line 1: parallel: expected a whole number"),
                ([first], "line 2: the input ended before an answer to trial 1: the run is not over"),
                ([first, {"tel": []}], "line 2: `tell` is missing"), ([first, {"tell": [1]}], "line 2: `tell` must be a list of objects"),
                ([first, {"tell": [{"id": 1, "cost": math.nan}]}], "line 2: the cost of trial 1 is NaN: .* null"),
                ([first, {"tell": [{"id": [1], "cost": 1}]}], r"line 2: trial \[1\] was not asked"),
                ([first, {"tell": [{"id": 1, "cost": 1, "time": "a"}]}], "line 2: the time of trial 1 is 'a'")):
            text = "".join((line if isinstance(line, str) else json.dumps(line)) + "\n" for line in lines)
            done = subprocess.run([sys.executable, "-m", "swarmsmith"], input=text, text=True, capture_output=True, check=False,
                                  env={**os.environ, "PYTHONPATH": str(MODULE)})
            with self.subTest(sentence):
                self.assertRegex(done.stderr, "^swarmsmith: " + sentence)
                self.assertEqual(done.returncode, 1)

    def test_the_example(self):
        done = ended_well(subprocess.run([sys.executable, SOURCE / "examples" / "tuner.py", "x.db"], cwd=self.folder, text=True,
                                         capture_output=True, check=False, env={**os.environ, "PYTHONPATH": str(MODULE)}))
        self.assertIn("'kernel': 'rbf'", done.stdout)


if __name__ == "__main__":
    unittest.main()
