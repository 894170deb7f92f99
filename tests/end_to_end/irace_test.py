"""`swarmsmith irace` as irace's users know it: their files, their scripts, their target-runner."""
import csv
import io
import json
import os
import pathlib
import random
import re
import signal
import sqlite3
import subprocess
import tempfile
import time
import unittest

from programs import SWARMSMITH, call, ended_well, send, start, wait_for

PARAMETERS = """\
# name  switch   type  domain    condition
x       "--x "   i     (0,100)
mode    "--"     c     (slow,fast)
y       "--y "   r     (0,1)   | mode == "fast"
"""

# Costs are whole numbers, so that a shell is enough. The instances' files hold a number.
RUNNER = """\
#!/bin/sh
id=$1; instance=$2; seed=$3; file=$4; bound=$5
shift 4
echo "$id $instance $seed $file $*" >> calls.txt
x=0; mode=10
while [ $# -gt 0 ]; do
  case $1 in
    --x) x=$2; shift ;;
    --fast) mode=0 ;;
  esac
  shift
done
read -r bias < "$file"
cost=$(( (x - 30) * (x - 30) + mode + seed % 50 + bias ))
"""
PRINT = "echo $cost"
# No call beyond the limit ends while the limit is there.
WAIT = 'while [ -e limit ] && [ "$(wc -l < calls.txt)" -gt "$(cat limit)" ]; do sleep 0.05; done\n'

DEFAULTS = {"parameterFile": "parameters.txt", "trainInstancesDir": "Instances",
            "maxExperiments": 180, "seed": 42}


def scenario_text(options):
    lines = []
    for name, value in options.items():
        text = f'"{value}"' if isinstance(value, str) else value
        lines.append(f"{name} = {text}\n")
    return "# A scenario\n" + "".join(lines)


class Irace(unittest.TestCase):
    """A folder with a scenario, and the checks that the tests share."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("Instances", "Tests"):
            (self.folder / name).mkdir()
            for number in range(1, 7):
                (self.folder / name / f"i{number}").write_text(f"{number}\n")
        (self.folder / "parameters.txt").write_text(PARAMETERS)
        self.write_runner(PRINT)
        self.write_scenario()

    def write_program(self, name, text):
        file = self.folder / name
        file.write_text(text)
        file.chmod(0o755)

    def write_runner(self, last):
        self.write_program("target-runner", RUNNER + last + "\n")

    def write_scenario(self, **options):
        (self.folder / "scenario.txt").write_text(scenario_text({**DEFAULTS, **options}))

    def irace(self, *words, code=0, timeout=120):
        done = call("irace", *words, cwd=self.folder, timeout=timeout)
        self.assertEqual(done.returncode, code, done.stdout[-3000:] + done.stderr[-3000:])
        return done

    def calls(self):
        file = self.folder / "calls.txt"
        return file.read_text().splitlines() if file.exists() else []

    def digest(self, store="irace.db"):
        done = ended_well(call("digest", self.folder / store))
        return done.stdout.strip()

    def assert_clean(self, store="irace.db"):
        ended_well(call("verify", self.folder / store))

    def query(self, sql, store="irace.db"):
        done = ended_well(call("query", self.folder / store, sql, "--json"))
        return json.loads(done.stdout)["rows"]

    def best_lines(self, output):
        """What scripts do: everything below the headline, up to the first empty line."""
        text = output.split("# Best configurations as commandlines", 1)[1].split("\n", 1)[1]
        lines = []
        for line in text.splitlines():
            if not line or line.startswith("#"):
                break
            lines.append(line)
        return lines


class Usual(Irace):
    def test_a_run_ends_with_the_report_that_scripts_read(self):
        done = self.irace("--scenario", "scenario.txt")
        lines = self.best_lines(done.stdout)
        self.assertGreaterEqual(len(lines), 1)
        for line in lines:
            self.assertRegex(line, r"^\d+ +  --x \d+ --(slow|fast)( --y [0-9.]+)?$|"
                                   r"^\d+  --x \d+ --(slow|fast)( --y [0-9.]+)?$")
        best = int(re.search(r"--x (\d+)", lines[0]).group(1))
        self.assertLess(abs(best - 30), 12, done.stdout)
        for text in ("# nbIterations: 3\n", "# seed: 42\n", "# budget: 180\n",
                     "|x|          1|", "Best-so-far configuration: ",
                     "# Best configurations (first number is the configuration ID; listed from "
                     "best to worst according to the sum of ranks):\n"):
            self.assertIn(text, done.stdout)
        self.assertLessEqual(len(self.calls()), 180)
        self.assertGreater(len(self.calls()), 90)
        self.assertEqual(len(set(self.calls())), len(self.calls()), "a run was made twice")
        self.assert_clean()

    def test_the_target_is_called_as_irace_calls_it(self):
        self.irace()
        for line in self.calls():
            number, instance, seed, file, rest = line.split(" ", 4)
            self.assertEqual(file, str(self.folder / "Instances" / f"i{instance}"))
            self.assertTrue(1 <= int(seed) <= 2147483647)
            self.assertRegex(rest, r"^--x \d+ --(slow|fast --y [01](\.\d{1,4})?)$")
        pairs = {tuple(line.split()[1:3]) for line in self.calls()}
        self.assertEqual(len({seed for _, seed in pairs}), len(pairs))

    def test_a_finished_store_prints_the_report_again(self):
        first = self.irace()
        made = len(self.calls())
        self.assertNotIn("Nothing was run", first.stdout)
        # Another target: the answer says that the results are those of the old one.
        self.write_runner("echo 1")
        with sqlite3.connect(self.folder / "irace.db") as store:
            store.execute("UPDATE campaign SET finished = '2024-02-03T12:00:00.123Z'")
        again = self.irace()
        self.assertEqual(self.best_lines(first.stdout), self.best_lines(again.stdout))
        self.assertEqual(len(self.calls()), made)
        self.assertRegex(again.stdout, r"(?m)^# Nothing was run: these are the results of 2024-02-0\d \d\d:00:00 \S+, "
                                       r"which .*/irace\.db holds\. Move that file away")
        told = self.irace("--json")
        self.assertIn("Nothing was run: these are the results of 2024-02-0", told.stderr)
        self.assertEqual(json.loads(told.stdout.splitlines()[-1])["event"], "done")
        # What an extension runs is not an old result.
        self.assertEqual(call("extend", self.folder / "irace.db", "d1", "--budget", "60").returncode, 0)
        extended = self.irace().stdout
        self.assertNotIn("Nothing was run", extended)
        self.assertGreater(len(self.calls()), made)
        used, left = re.findall(r"# experimentsUsed: (\d+)\n# remainingBudget: (\d+)\n", extended)[-1]
        self.assertEqual(int(used) + int(left), 180 + 60)

    def test_calls_run_on_all_cores_unless_a_number_is_given(self):
        self.assertEqual(call("import", "scenario.txt", "-o", "campaign.toml", cwd=self.folder).returncode, 0)
        cores = json.loads(call("check", "campaign.toml", "--json", cwd=self.folder).stdout)["slots"]
        for words, slots in (((), cores), (("--parallel", "3"), 3), (("--workers", "1"), 1)):
            done = self.irace("--json", "--log-file=", *words)
            events = [json.loads(line) for line in done.stdout.splitlines()]
            self.assertEqual({event["slots"] for event in events if event["event"] == "worker"}, {slots}, words)

    def test_without_a_seed_the_store_keeps_one(self):
        self.write_scenario(seed="")
        first = self.irace()
        again = self.irace()
        self.assertEqual(self.best_lines(first.stdout), self.best_lines(again.stdout))
        self.assertEqual(first.stdout.count("# seed: "), 1)

    def test_another_scenario_is_refused_with_what_differs(self):
        self.irace()
        refused = self.irace("--first-test", "6", code=1)
        self.assertIn("first_test", refused.stderr)
        self.assertIn("--log-file", refused.stderr)
        self.assertNotIn("# seed:", refused.stdout)
        self.irace("--first-test", "6", "--log-file", "other.Rdata")
        self.assertTrue((self.folder / "other.db").exists())

    def test_without_a_log_file_nothing_stays(self):
        before = sorted(os.listdir(self.folder))
        done = self.irace("--log-file=")
        self.assertEqual(sorted(os.listdir(self.folder)), sorted([*before, "calls.txt"]))
        self.assertIn("nothing is kept", done.stderr)

    def test_quiet_prints_nothing(self):
        done = self.irace("-q")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_json_is_a_line_an_event_and_the_result(self):
        done = self.irace("--json")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertTrue(all(event["v"] == 1 for event in events))
        result = events[-1]
        self.assertEqual(result["event"], "done")
        self.assertEqual(result["experiments"], len(self.calls()))
        best = result["best"][0]
        self.assertEqual(best["parameters"]["x"], int(best["command_line"].split()[1]))
        self.assertGreaterEqual(best["mean_cost"], 0)
        steps = [event for event in events if event["event"] == "race_step"]
        self.assertGreaterEqual(min(step["mean_best"] for step in steps), 0)

    def test_other_commands_read_the_store(self):
        self.irace()
        rows = self.query("SELECT count(*) AS n FROM v_evaluations")
        self.assertEqual(rows[0]["n"], len(self.calls()))
        shown = ended_well(call("show", "c1", self.folder / "irace.db"))
        self.assertIn("--x", shown.stdout)
        for words in (("ls", "elites"), ("ls", "candidates"), ("show", "d1"), ("status",)):
            ended_well(call(*words, self.folder / "irace.db"))

    def test_what_is_wrong_is_said_and_exits_with_1(self):
        unknown = self.irace("--max-experiment", "100", code=1)
        self.assertIn("--max-experiments", unknown.stderr)
        self.write_scenario(maxExperiment=5)
        self.assertIn("scenario.txt:", self.irace(code=1).stderr)
        self.write_scenario(maxExperiments=20)
        self.assertRegex(self.irace(code=1).stderr,
                         r"scenario\.txt:\d+:1: .* too small: .* at least \d\d\d?\b")
        self.write_scenario()
        self.assertIn("--workers: must be 1 or more", self.irace("--workers", "0", code=1).stderr)
        self.assertIn("Usage: swarmsmith irace", self.irace("--help").stdout)
        self.assertIn("swarmsmith", self.irace("--version").stdout)


class Survival(Irace):
    def test_any_number_of_workers_gives_one_answer(self):
        answers = set()
        for parallel in (1, 2, 4):
            store = f"{parallel}.db"
            self.irace("--parallel", parallel, "--log-file", store)
            self.assert_clean(store)
            answers.add(self.digest(store))
        self.irace("--workers", "3", "--log-file", "w.db")
        answers.add(self.digest("w.db"))
        self.assertEqual(len(answers), 1)
        self.assertLessEqual(len(self.calls()), 4 * 180)

    def test_killed_at_any_moment_it_goes_on_where_it_was(self):
        self.irace("--log-file", "reference.db")
        undisturbed = len(self.calls())
        (self.folder / "calls.txt").unlink()
        self.write_runner(WAIT + PRINT)
        limit = self.folder / "limit"
        rng = random.Random(3)
        kills = 0
        for _ in range(8):
            moment = len(self.calls()) + rng.randrange(40)
            limit.write_text(f"{moment + 20}\n")  # it must not be over before it is killed
            process = start("irace", "--parallel", "2", cwd=self.folder)
            wait_for(lambda: len(self.calls()) >= moment or process.poll() is not None, f"{moment} calls", pause=0.005)
            if process.poll() is not None:
                break
            send(process.pid, signal.SIGKILL)
            process.wait()
            kills += 1
        self.assertGreater(kills, 0)
        limit.unlink()
        done = self.irace()
        self.assert_clean()
        self.assertEqual(self.digest(), self.digest("reference.db"))
        # What two slots ran when it was killed, and what was on its way to the disk: calls of this
        # target take about as long as a commit.
        self.assertLessEqual(len(self.calls()), undisturbed + kills * 10)
        self.assertGreaterEqual(len(self.best_lines(done.stdout)), 1)

    def test_nothing_that_was_started_outlives_it(self):
        self.write_runner("sleep 600 & echo $! >> children.txt; wait; echo $cost")
        process = start("irace", "--parallel", "2", cwd=self.folder)
        children = self.folder / "children.txt"
        wait_for(lambda: children.exists() and len(children.read_text().split()) >= 2, "two children")
        send(process.pid, signal.SIGKILL)
        process.wait()
        wait_for(lambda: not any(map(self.is_alive, children.read_text().split())), "the end of the children of targets", 20)

    @staticmethod
    def is_alive(pid):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return False
        return state != "Z"

    def test_interrupted_it_says_how_to_go_on(self):
        process = subprocess.Popen([SWARMSMITH, "irace"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        wait_for(lambda: len(self.calls()) >= 20, "20 calls")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("the same command continues", errors)
        done = self.irace()
        self.assertIn(": Continuing after ", done.stdout)
        self.assertEqual(len(set(self.calls())), len(self.query(
            "SELECT * FROM v_evaluations")))


class Failures(Irace):
    def fails(self, last, *words, **options):
        self.write_runner(last)
        if options:
            self.write_scenario(**options)
        return self.irace(*words, code=1).stderr

    def test_a_failing_target_is_shown_and_nothing_is_lost(self):
        errors = self.fails('if [ $(wc -l < calls.txt) -gt 40 ]; then echo oops; echo bad >&2; '
                            'exit 3; fi; echo $cost', "--parallel", "1")
        for text in ("exit", "3", "target-runner ", " --x ", "oops", "bad", "the same command"):
            self.assertIn(text, errors)
        # What a worker had in hand when the run ended may have been called.
        self.assertIn(len(self.calls()), (41, 42))
        failed = self.calls()[40:]
        self.write_runner(PRINT)
        done = self.irace()
        self.assertIn("Continuing after", done.stdout)
        again = [line for line in set(self.calls()) if self.calls().count(line) > 1]
        self.assertEqual(set(again), set(failed))
        self.assert_clean()
        self.assertGreaterEqual(self.query("SELECT count(*) AS n FROM v_failures")[0]["n"], 1)

    def test_output_that_is_no_cost_is_shown(self):
        for last in ("echo cost: $cost", "echo 1 2 3", "true", "echo NaN"):
            errors = self.fails(last, f"--log-file={len(self.calls())}.db")
            self.assertIn("target-runner ", errors, last)

    def test_a_target_that_takes_too_long_is_ended(self):
        began = time.monotonic()
        errors = self.fails("sleep 600", targetRunnerTimeout=1)
        self.assertLess(time.monotonic() - began, 60)
        self.assertRegex(errors, r"1 s")

    def test_failures_reject_their_configuration_when_asked_for(self):
        self.write_runner("if [ $x -gt 60 ]; then exit 3; fi; echo $cost")
        self.assertIn("stop or reject", self.irace("--on-failure", "drop", code=1).stderr)
        done = self.irace("--on-failure", "reject")
        self.assertTrue(self.best_lines(done.stdout))
        self.assert_clean()
        rejected = self.query("SELECT count(*) AS n FROM v_evaluations WHERE status = 'rejected'")
        self.assertGreater(rejected[0]["n"], 0)

    def test_a_failed_call_is_repeated_when_asked_for(self):
        self.write_runner('if [ $(wc -l < calls.txt) -eq 30 ]; then exit 1; fi; echo $cost')
        self.irace("--target-runner-retries", "1", "--parallel", "1")
        self.assertEqual(len(set(self.calls())), len(self.calls()) - 1)

    def test_an_infinite_cost_rejects_the_configuration(self):
        self.write_runner("if [ $x -gt 60 ]; then echo Inf; else echo $cost; fi")
        self.irace()
        self.assert_clean()
        tried = {}
        for line in self.calls():
            number, x = re.match(r"(\d+) .*--x (\d+)", line).groups()
            tried.setdefault((number, int(x)), 0)
            tried[number, int(x)] += 1
        rejected = [count for (_, x), count in tried.items() if x > 60]
        self.assertGreater(len(rejected), 0)
        self.assertEqual(set(rejected), {1})

    def test_rejecting_all_configurations_is_an_error(self):
        self.write_runner("echo Inf")
        for _ in range(2):  # the second time it is the store that says so
            done = self.irace(code=1)
            self.assertIn("every configuration was rejected", done.stderr)
            self.assertNotIn("Best configurations", done.stdout)
        done = self.irace("--json", code=1)
        self.assertEqual(json.loads(done.stdout.splitlines()[-1])["best"], [])


class Parts(Irace):
    def test_check_tries_the_target_and_prints_each_call(self):
        (self.folder / "configurations.txt").write_text("x mode y\n7 fast 0.5\n")
        self.write_scenario(configurationsFile="configurations.txt")
        done = self.irace("--check")
        calls = self.calls()
        self.assertEqual(len(calls), 3)
        self.assertIn("--x 7 --fast --y 0.5", calls[0])
        self.assertTrue(all(line.split()[2] == "1234567" for line in calls))
        self.assertIn("--x 7 --fast --y 0.5", done.stdout)
        self.assertIn("Check successful", done.stdout)
        self.assertFalse((self.folder / "irace.db").exists())
        self.write_runner("echo oops")
        self.assertIn("oops", self.irace("--check", code=1).stderr)

    def test_debug_level_2_shows_each_call_and_what_came_of_it(self):
        done = self.irace("--debug-level", "2", "--log-file=")
        shown = re.findall(r"(?m)^# [-0-9]+ [:0-9]+ \S+: \S*/target-runner (.*)\n"
                           r"# .*: DONE \(\d+\) Elapsed wall-clock seconds: \d+\.\d\d\n\d+$", done.stdout)
        self.assertEqual(sorted(re.sub(" +", " ", words) for words in shown), sorted(self.calls()))
        self.assertGreater(len(shown), 90)
        self.assertNotIn("Results for the race", done.stdout)
        # The highest one of R, and what is above it.
        more = self.irace("--debug-level", "5", "--log-file=").stdout
        self.assertEqual(more.count("DONE ("), len(shown))
        self.assertIn(": Results for the race of iteration 1 (from best to worst, according to the sum of ranks):", more)
        self.assertNotIn("DONE (", self.irace("--log-file=").stdout)

    def test_init_writes_what_runs(self):
        folder = self.folder / "new"
        folder.mkdir()
        ended_well(call("irace", "--init", cwd=folder))
        written = {file: (folder / file).read_text() for file in os.listdir(folder)
                   if (folder / file).is_file()}
        self.assertIn("scenario.txt", written)
        again = call("irace", "--init", cwd=folder)
        self.assertIn("scenario.txt", again.stdout + again.stderr)
        for file, text in written.items():
            self.assertEqual((folder / file).read_text(), text)
        ended_well(call("irace", "--check", cwd=folder))
        done = call("irace", "--max-experiments", "200", "--seed", "1", cwd=folder)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        self.assertGreaterEqual(len(self.best_lines(done.stdout)), 1)

    def test_only_test_evaluates_a_file_of_configurations(self):
        (self.folder / "two.txt").write_text("x mode y\n30 fast 0.5\n90 slow NA\n")
        self.write_scenario(testInstancesDir="Tests")
        done = self.irace("--only-test", "two.txt")
        self.assertEqual(len(self.calls()), 12)
        self.assertEqual({line.split()[1] for line in self.calls()},
                         {f"{number}t" for number in range(1, 7)})
        table = done.stdout.split("Testing results", 1)[1].splitlines()[1:8]
        self.assertEqual(table[0].split(), ["1", "2"])
        self.assertEqual(table[1].split()[0], "1t")
        self.assertTrue(all(float(line.split()[2]) - float(line.split()[1]) == 3600 + 10
                            for line in table[1:7]), table)
        again = self.irace("--only-test", "two.txt")
        self.assertEqual(len(self.calls()), 12)
        self.assertIn(table[1], again.stdout)
        self.assertRegex(again.stdout, "# Nothing was run: .*irace-test.db")
        # Another file, and other instances, are tested for themselves, with the same seeds; the first is kept.
        (self.folder / "one.txt").write_text("x mode y\n30 slow NA\n")
        done = self.irace("--only-test", "one.txt")
        self.assertIn("irace-test-2.db", done.stderr)
        self.assertEqual(len(self.calls()), 18)
        self.assertEqual({line.split()[2] for line in self.calls()[12:]}, {line.split()[2] for line in self.calls()[:12]})
        (self.folder / "Tests" / "i7").write_text("7\n")
        self.irace("--only-test", "two.txt")
        self.assertEqual(len(self.calls()), 32)
        self.assertTrue((self.folder / "irace-test-3.db").exists())
        (self.folder / "Tests" / "i7").unlink()
        for name, words in (("irace-test.db", ("two.txt",)), ("irace-test-2.db", ("one.txt",))):
            self.assertRegex(self.irace("--only-test", *words).stdout, "# Nothing was run: .*" + name)
        self.assertEqual(len(self.calls()), 32)
        (self.folder / "irace-test.db").unlink()
        done = self.irace("--only-test", "two.txt", "--json")
        tests = json.loads(done.stdout.splitlines()[-1])["tests"]
        self.assertEqual([test["cost"] for test in tests], [float(line.split()[i]) for i in (1, 2) for line in table[1:7]])


class Variants(Irace):
    """One small run each; the rules themselves are tested in irace_core."""

    def runs(self, *words, **options):
        self.write_scenario(**options)
        done = self.irace(*words)
        self.assert_clean()
        self.assertGreaterEqual(len(self.best_lines(done.stdout)), 1)
        return done.stdout

    def test_test_instances(self):
        text = self.runs(testInstancesDir="Tests", testNbElites=2, testIterationElites=1)
        self.assertIn("# Testing of elite configurations: 2\n", text)
        table = text.split("# Testing iteration configurations: TRUE\n")[1].splitlines()
        self.assertRegex(table[1], r"^ +\d+ +\d+")
        self.assertRegex(table[2], r"^1t +\d+")
        tests = [line for line in self.calls() if "/Tests/" in line]
        self.assertEqual(len(tests), 6 * len(table[1].split()))

    def test_other_test_instances_of_a_finished_run_are_tests_of_its_winners(self):
        best = self.best_lines(self.runs())[0].split("  ", 1)[1].strip()
        made, digest = len(self.calls()), self.digest()
        self.write_scenario(testInstancesDir="Tests", testNbElites=2)
        done = self.irace()
        tests = self.calls()[made:]
        self.assertEqual({line.split()[1] for line in tests}, {f"{number}t" for number in range(1, 7)})
        self.assertIn("# 1 here is configuration ", done.stdout)
        self.assertIn(best, {line.split(" ", 4)[4] for line in tests if line.startswith("1 ")})
        self.assertEqual(self.digest(), digest)
        self.assert_clean("irace-test.db")
        # The same command again, and one with more instances.
        self.assertRegex(self.irace().stdout, "# Nothing was run: .*irace-test.db")
        (self.folder / "Tests" / "i7").write_text("7\n")
        self.irace("--test-num-elites", "1")
        more = self.calls()[made + len(tests):]
        self.assertEqual(len(more), 7)
        # With the seeds that were drawn for those that are in both.
        self.assertEqual([line.split()[1:3] for line in sorted(more)][:6],
                         [line.split()[1:3] for line in sorted(tests) if line.startswith("1 ")])

    def write_small_space(self):
        """Six configurations: a run samples some of them twice."""
        (self.folder / "parameters.txt").write_text('x "--x " i (0,2)\nmode "--" c (slow,fast)\n')

    def equal_candidates(self):
        """The numbers of configurations with equal values, smallest first, and one of other values."""
        alike = {}
        for row in self.query("SELECT candidate, fsm_config FROM v_candidates ORDER BY candidate"):
            alike.setdefault(row["fsm_config"], []).append(int(str(row["candidate"]).lstrip("c")))
        twice = next(ids for ids in alike.values() if len(ids) > 1)
        return twice, next(ids[0] for ids in alike.values() if ids is not twice)

    def test_configurations_that_were_sampled_twice_are_raced_again_once(self):
        self.write_small_space()
        self.irace()
        (first, second, *_), other = self.equal_candidates()
        words = ("--psrace", "--psrace-max-experiments", "40", "--psrace-ids")
        done = self.irace(*words, f"{first},{second},{other}")
        self.assertIn(f"# 1 here is configuration {first} of the run\n# 2 here is configuration {other} of the run\n",
                      done.stdout)
        self.assertNotIn("# 3 here", done.stdout)
        self.assertIn("two configurations or more", self.irace(*words, f"{first},{second}", code=1).stderr)

    def test_winners_that_were_sampled_twice_are_tested_again_once(self):
        self.write_small_space()
        # Costs by chance, so that other configurations win in each race.
        self.write_runner("echo $(( (id * 7919 + seed) % 97 ))")
        self.write_scenario(minNbSurvival=2)
        self.irace()
        elites = self.query("SELECT c.candidate, c.fsm_config FROM elite AS e JOIN v_candidates AS c "
                            "ON c.candidate = e.candidate")
        texts = {row["fsm_config"] for row in elites}
        self.assertGreater(len({row["candidate"] for row in elites}), len(texts), "none was sampled twice")
        self.write_scenario(minNbSurvival=2, testInstancesDir="Tests", testNbElites=99,
                            testIterationElites=1)
        done = self.irace()
        self.assertEqual(done.stdout.count(" here is configuration "), len(texts))

    def test_a_finished_run_may_have_no_tests(self):
        self.irace()
        made = len(self.calls())
        self.write_scenario(testInstancesDir="Tests", testNbElites=0)
        self.assertIn("testNbElites is 0", self.irace().stdout)
        self.assertEqual(len(self.calls()), made)

    def test_races_without_elites_that_are_kept(self):
        self.assertIn("# Non-elitist race\n", self.runs(elitist=0, maxExperiments=300))

    def test_t_tests(self):
        self.assertIn("according to the mean value)", self.runs(testType="t-test"))

    def test_blocks(self):
        self.runs(blockSize=2, firstTest=2, mu=4, maxExperiments=400)

    def test_deterministic_targets(self):
        self.write_runner("echo $(( (x - 30) * (x - 30) + mode + bias ))")
        self.runs(deterministic=1)
        for line in self.calls():
            self.assertEqual(sum(1 for other in self.calls()
                                 if other.split()[:2] == line.split()[:2]), 1)

    def test_initial_configurations_come_first(self):
        (self.folder / "first.txt").write_text("x mode y\n30 fast 0.5\n31 slow NA\n")
        text = self.runs(configurationsFile="first.txt")
        self.assertRegex(self.best_lines(text)[0], r"^\d+ +--x (2[789]|3[0123])")
        self.assertTrue(any(re.match(r"1 .* --x 30 --fast --y 0.5$", line)
                            for line in self.calls()))

    def test_a_budget_of_time_with_capping(self):
        self.write_runner("time=$(( 1 + cost % 7 )); [ $time -le $bound ] || time=$bound; "
                          "echo $cost $time")
        text = self.runs(maxExperiments=0, maxTime=2000, boundMax=8, capping=1)
        self.assertIn("|   Bound|", text)
        self.assertIn("# capping: median", text)
        status = call("status", self.folder / "irace.db").stdout
        self.assertRegex(status, r"experiments [0-9]+  time budget 2000 a design\n")
        self.assertRegex(status, r"[0-9]/time 2000 .* cost [0-9]")
        # There is no number of experiments that anything could be a part of.
        report = self.folder / "report.html"
        self.assertEqual(call("report", self.folder / "irace.db", "--design", "all", "-o", report).returncode, 0)
        words = re.sub(r"<[^>]+>", " ", report.read_text())
        self.assertNotRegex(words, r"\b(of|used) 0\b|\b0 experiments|design's 0")

    def test_one_with_a_budget_of_time_goes_on_with_any_number_of_runs_at_a_time(self):
        self.write_runner("echo $cost $(( 1 + cost % 7 ))")
        self.write_scenario(maxExperiments=0, maxTime=1500)
        whole = self.irace("--parallel", "3", "--log-file=whole.db")
        self.write_runner('if [ $(wc -l < calls.txt) -gt 480 ]; then exit 3; fi; '
                          "echo $cost $(( 1 + cost % 7 ))")
        self.irace("--parallel", "3", code=1)
        self.write_runner("echo $cost $(( 1 + cost % 7 ))")
        done = self.irace("--parallel", "1")
        self.assertIn("started with --parallel 3", done.stderr)
        self.assertEqual(self.best_lines(done.stdout), self.best_lines(whole.stdout))
        self.assertEqual(self.digest(), self.digest("whole.db"))

    def test_wrappers_of_aclib_are_called_as_irace_calls_them(self):
        (self.folder / "parameters.txt").write_text(
            'x "x" i (0, 100)\nalg "alg" c (as, mmas)\ny "y" r (0.00001, 1) | alg == "mmas"\n')
        self.write_program("target-runner", """\
#!/bin/sh
echo "$*" >> calls.txt
x=0
while [ "$1" != --config ]; do shift; done
shift
while [ $# -gt 0 ]; do
  case $1 in
    -x) x=$2 ;;
    -alg | -y) ;;
    *) exit 3 ;;
  esac
  shift 2
done
echo "some words of the wrapper"
echo "Result of this algorithm run: {\\"status\\": \\"SUCCESS\\", \\"cost\\": $(( (x - 30) * (x - 30) )), \\"runtime\\": 1.5}"
""")
        text = self.runs(aclib=1)
        for line in self.calls():
            self.assertRegex(line, r"^--instance \S+ --seed \d+ --config -x \d+ -alg (as|mmas -y \S+)$")
        # The report has the configurations as R's has them: switches and values without a blank.
        self.assertRegex(self.best_lines(text)[0], r"^\d+ +x(2[5-9]|3[0-5]) alg")

    def test_parameters_of_smac_and_configspace(self):
        (self.folder / "parameters.txt").unlink()
        (self.folder / "space.pcs").write_text(
            "-x [0, 100] [60]i\nmode {slow, fast}[slow]\ny [0.001, 1] [0.5]l\ny | mode in {fast}\n")
        (self.folder / "space.json").write_text(json.dumps({
            "hyperparameters": [
                {"name": "x", "type": "uniform_int", "lower": 0, "upper": 100, "default": 60},
                {"name": "mode", "type": "categorical", "choices": ["slow", "fast"], "default": "slow"},
                {"name": "y", "type": "uniform_float", "lower": 0.001, "upper": 1, "log": True, "default": 0.5}],
            "conditions": [{"child": "y", "parent": "mode", "type": "EQ", "value": "fast"}]}))
        calls = 0
        for name, mark in (("space.pcs", "-"), ("space.json", "--")):
            done = self.irace("--check", "-p", name)
            self.assertIn(f'"{mark}mode " c (slow, fast)', done.stdout)
            calls = len(self.calls())
            done = self.irace("-p", name, "--log-file", name + ".db")
            # The calls of one step are made at the same time, in any order.
            self.assertIn(f"--x 60 {mark}mode slow", "\n".join(self.calls()[calls:calls + 4]))
            self.assertLess(abs(int(re.search(r"--x (\d+)", self.best_lines(done.stdout)[0]).group(1)) - 30), 12)
            self.assert_clean(name + ".db")
        (self.folder / "space.pcs").write_text("x [0, 100] [60]i\n{x * 2 > 10}\n")
        self.assertIn("space.pcs:2: formulas", self.irace("-p", "space.pcs", code=1).stderr)

    def test_a_finished_run_is_raced_again(self):
        self.assertIn("irace.db", self.irace("--psrace", "--psrace-max-experiments", "60", code=1).stderr)
        self.irace()
        made = len(self.calls())
        self.assertIn("--psrace-max-experiments N", self.irace("--psrace", code=1).stderr)
        words = ("--psrace", "--psrace-elites", "--psrace-max-experiments", "60")
        done = self.irace(*words)
        lines = self.best_lines(done.stdout)
        self.assertEqual(len(lines), 1)
        self.assertIn("# 1 here is configuration ", done.stdout)
        again = self.calls()[made:]
        self.assertTrue(6 <= len(again) <= 60, len(again))
        # Other seeds than those of the run, and no configuration that it did not have.
        self.assertFalse({line.split()[2] for line in again} & {line.split()[2] for line in self.calls()[:made]})
        self.assertLessEqual({line.split(" ", 4)[4] for line in again},
                             {line.split(" ", 4)[4] for line in self.calls()[:made]})
        self.assert_clean("irace-psrace.db")
        # It is kept, and told again.
        self.assertEqual(self.best_lines(self.irace(*words).stdout), lines)
        self.assertEqual(len(self.calls()), made + len(again))
        # Those that are named.
        done = self.irace("--psrace", "--psrace-ids", "2,5", "--psrace-max-experiments", "30")
        self.assertIn("irace-psrace-2.db", done.stderr)
        self.assertRegex(self.irace(*words).stdout, "# Nothing was run: .*irace-psrace.db")
        self.assertIn("# 2 here is configuration 5 of the run", done.stdout)
        self.assertIn("no configuration 999", self.irace(
            "--psrace", "--psrace-ids", "2,999", "--psrace-max-experiments", "30", code=1).stderr)
        self.assertIn("--psrace-max-experiments: a budget of 3", self.irace(
            "--psrace", "--psrace-ids", "2,5", "--psrace-max-experiments", "3", code=1).stderr)
        self.irace("--psrace", "--psrace-ids", "2,5", "--psrace-max-experiments", "0.2")
        with sqlite3.connect(self.folder / "irace-psrace-3.db") as store:
            self.assertEqual(store.execute("SELECT budget FROM design").fetchall(), [(36,)])
        for budget in ("1.5", "-3", "0", "nan", "inf", "many", "60x"):
            self.assertIn("--psrace-max-experiments: must be a whole number", self.irace(
                "--psrace", "--psrace-ids", "2,5", "--psrace-max-experiments", budget, code=1).stderr, budget)
        for ids in ("3.5,2", "2,1e300", "2,nan", "2,-1", "2,", "two,2", "2,99999999999999999999"):
            self.assertIn("3,17,20", self.irace("--psrace", "--psrace-ids", ids, "--psrace-max-experiments", "30",
                                                code=1).stderr, ids)

    def test_ablation_finds_the_change_that_matters(self):
        (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
        self.write_scenario(configurationsFile="first.txt")
        self.irace()
        made = len(self.calls())
        done = self.irace("--ablation", "--ablation-csv", "ablation.csv", "--ablation-target", "1", code=1)
        self.assertIn("are the same", done.stderr)
        done = self.irace("--ablation", "--ablation-csv", "ablation.csv")
        self.assertRegex(done.stdout, r"# Step 1: x: 90 -> (2|3)\d\n")
        self.assertEqual(len(self.best_lines(done.stdout)), 1)
        rows = list(csv.reader(io.StringIO((self.folder / "ablation.csv").read_text())))
        self.assertEqual(rows[0], ["configuration", "step", "on_path", "changed", "pair", "instance", "seed", "cost"])
        self.assertEqual(len(rows) - 1, len(self.calls()) - made)
        pairs = {tuple(row[-3:-1]) for row in rows[1:]}
        self.assertEqual(len(pairs), 5, "firstTest pairs, the same for all")
        ended_well(call("figure", "ablation", "irace-ablation.db", "-o", "ablation.svg", cwd=self.folder))
        ended_well(call("figure", "ablation", "irace-ablation.db", "-o", "way.csv", cwd=self.folder))
        way = [(row["step"], row["change"], row["pair"], float(row["cost"]))
               for row in csv.DictReader(io.StringIO((self.folder / "way.csv").read_text()))]
        self.assertEqual(way, [(step, changed, pair, float(cost))
                               for _, step, on_path, changed, pair, _, _, cost in rows[1:] if on_path == "1"])
        self.assertIn(way[-1][1].split(":")[0], (self.folder / "ablation.svg").read_text())
        self.assertIn("no ablation", call("figure", "ablation", "irace.db", cwd=self.folder).stderr)
        # The same again, and more instances.
        again = self.irace("--ablation", "--parallel", "1")
        self.assertEqual([line for line in again.stdout.splitlines() if "Step" in line],
                         [line for line in done.stdout.splitlines() if "Step" in line])
        before = len(self.calls())
        self.irace("--ablation", "--ablation-instances", "2", "-q")
        self.assertEqual(len(self.calls()) - before, 2 * (len(rows) - 1))
        # The race of the changes: those that are worse are dropped, and run on fewer pairs.
        before = len(self.calls())
        done = self.irace("--ablation", "--ablation-type", "racing", "--ablation-csv", "ablation.csv")
        self.assertRegex(done.stdout, r"# Step 1: x: 90 -> (2|3)\d\n")
        rows = [line.split(",") for line in (self.folder / "ablation.csv").read_text().splitlines()][1:]
        self.assertEqual(len(rows), len(self.calls()) - before)
        self.assertEqual(len({tuple(row[-3:-1]) for row in rows}), 6, "each training instance once")
        self.assertIn("--ablation-instances", self.irace(
            "--ablation", "--ablation-type", "racing", "--ablation-instances", "2", code=1).stderr)
        self.assertIn("full", self.irace("--ablation", "--ablation-type", "half", code=1).stderr)
        (self.folder / "irace-ablation.db").unlink()
        self.write_runner("exit 3")
        self.assertIn("exit", self.irace("--ablation", code=1).stderr)

    # As the version before it was a campaign printed it.
    ABLATION = """\
# DATE: Starting ablation from 1 to 20
# Seed: 42
# Source: --x 90 --slow
# Target: --x 29 --fast --y 0.0529
# 5 pairs of instance and seed; columns: number, runs, mean cost, change
     1     5          3635.4  source
# Step 0: source
     2     5            36.4  x: 90 -> 29
     3     5          3625.4  mode: slow -> fast, y: NA -> 0.0529
# Step 1: x: 90 -> 29
     4     5            26.4  mode: slow -> fast, y: NA -> 0.0529
# Step 2: mode: slow -> fast, y: NA -> 0.0529
# DATE: Final best configuration (first number is its number in the ablation):
   x mode      y
4 29 fast 0.0529
# Best configurations as commandlines (first number is the configuration ID; same order as above):
4  --x 29 --fast --y 0.0529
"""
    ABLATION_CSV = """\
configuration,step,on_path,changed,pair,instance,seed,cost
1,0,1,source,1,3,25277278,3641
1,0,1,source,2,6,1595559908,3624
1,0,1,source,3,2,1900644715,3627
1,0,1,source,4,1,1004693638,3649
1,0,1,source,5,4,958447822,3636
2,1,1,x: 90 -> 29,1,3,25277278,42
"""

    def test_a_rejected_source_has_no_mean_in_the_figure(self):
        # Rejected at once, or on the third pair: then the first two runs have costs.
        for least, costs in (("1", 0), ("3", 2)):
            self.write_runner(f'[ $x -eq 90 ] && [ $instance -ge {least} ] && cost=Inf\n' + PRINT)
            (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
            self.write_scenario(configurationsFile="first.txt", sampleInstances=0)
            log = ("-l", f"run{least}.Rdata")
            self.irace(*log)
            done = self.irace("--ablation", "--ablation-source", "first.txt", *log)
            self.assertRegex(done.stdout, " 1 +\\d+ +inf  source\n")
            store, = self.folder.glob(f"run{least}-ablation*.db")
            ended_well(call("figure", "ablation", store, "-o", "way.csv", cwd=self.folder))
            rows = list(csv.DictReader(io.StringIO((self.folder / "way.csv").read_text())))
            source = [row for row in rows if row["change"] == "source"]
            self.assertEqual({row["mean_cost"] for row in source}, {"inf"})
            self.assertEqual(sum(row["cost"] != "inf" for row in source), costs)
            self.assertEqual(sum(row["cost"] == "inf" for row in source), 1)
            self.assertNotIn("inf", {row["cost"] for row in rows if row["change"] != "source"})
            ended_well(call("figure", "ablation", store, "-o", "way.svg", cwd=self.folder))
            text = (self.folder / "way.svg").read_text()
            self.assertIn("source (rejected)", text)
            self.assertNotIn("source: 0.", text)

    def test_ablation_is_a_campaign_that_goes_on_where_it_was(self):
        (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
        self.write_scenario(configurationsFile="first.txt")
        self.irace()
        before = len(self.calls())

        def ablate(*words, code=0):
            done = self.irace("--ablation", "--ablation-csv", "ablation.csv", *words, code=code)
            return re.sub(r"# 20[-0-9]+ [:0-9]+ \w+:", "# DATE:", re.sub(r"# Nothing was run: .*\n", "", done.stdout))

        self.assertEqual(ablate(), self.ABLATION)
        self.assertTrue((self.folder / "ablation.csv").read_text().startswith(self.ABLATION_CSV))
        self.assert_clean("irace-ablation.db")
        reference, whole = self.digest("irace-ablation.db"), (self.folder / "ablation.csv").read_text()
        # It is printed again, without another run.
        self.assertEqual(ablate(), self.ABLATION)
        self.assertEqual(len(self.calls()) - before, 20)
        # Killed where a target hangs: what was over stays, and any number of workers goes on.
        self.write_runner('[ ! -e hang ] || [ "$(wc -l < calls.txt)" -lt "$(cat hang)" ] || sleep 600\n' + PRINT)
        (self.folder / "irace-ablation.db").unlink()
        made = len(self.calls())
        for more in (4, 11, 18):
            (self.folder / "hang").write_text(f"{made + more}\n")
            process = start("irace", "--ablation", "--parallel", "2", cwd=self.folder)
            wait_for(lambda: len(self.calls()) >= made + more, f"{made + more} calls")
            send(process.pid, signal.SIGKILL)
            process.wait()
        (self.folder / "hang").unlink()
        self.assertEqual(ablate("--workers", "2", "--parallel", "4"), self.ABLATION)
        self.assertEqual((self.folder / "ablation.csv").read_text(), whole)
        self.assertEqual(self.digest("irace-ablation.db"), reference)
        self.assertLessEqual(len(self.calls()) - made, 20 + 3 * 4, "what was in hand is run again, no more")

    def test_workers_from_elsewhere_can_help_with_an_ablation(self):
        (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
        self.write_scenario(configurationsFile="first.txt")
        self.irace()
        self.irace("--ablation")
        reference = self.digest("irace-ablation.db")
        campaign, = self.query("SELECT file FROM v_campaigns", "irace-ablation.db")
        (self.folder / "ablation.toml").write_text(campaign["file"])
        (self.folder / "irace-ablation.db").unlink()
        made = len(self.calls())
        process = start("serve", "ablation.toml", "--store", "there.db", "--bind", "127.0.0.1:0", "--http", "none",
                        "--coordinator-file", "there", cwd=self.folder)
        worker = start("worker", "--coordinator", "there", "--slots", "2", "--allow",
                       self.folder / "target-runner", cwd=self.folder)
        for one in (process, worker):
            self.addCleanup(send, -one.pid, signal.SIGKILL)
        self.assertEqual(process.wait(timeout=120), 0)
        worker.wait(timeout=60)
        self.assertEqual(self.digest("there.db"), reference)
        self.assertEqual(len(self.calls()) - made, 20)

    def test_an_ablation_of_another_run_is_kept_beside_the_first(self):
        self.irace()
        self.irace("--ablation")
        made = len(self.calls())
        (self.folder / "irace.db").unlink()
        self.irace("--seed", "7")
        before = (self.folder / "irace-ablation.db").read_bytes()
        done = self.irace("--ablation", "--seed", "7")
        self.assertIn("irace-ablation-2.db", done.stderr)
        self.assertIn("# Source", done.stdout)
        self.assertGreater(len(self.calls()), made)
        self.assertEqual((self.folder / "irace-ablation.db").read_bytes(), before)

    def test_ablation_takes_configurations_from_files_and_the_switches_of_r(self):
        (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
        (self.folder / "last.txt").write_text("x mode y\n30 slow NA\n")
        (self.folder / "two.txt").write_text("x mode y\n30 slow NA\n31 slow NA\n")
        self.irace()
        done = self.irace("ablation", "-l", "irace.Rdata", "-S", "first.txt", "--target=last.txt", "-n", "1")
        self.assertIn("Starting ablation from first.txt to last.txt", done.stdout)
        self.assertIn("# Step 1: x: 90 -> 30\n", done.stdout)
        self.assertTrue((self.folder / "irace-ablation-x1-from-first-to-last.db").exists())
        self.assertIn("irace-ablation-from1-to-last.db", self.irace("ablation", "-S", "1", "-T", "last.txt").stderr)
        self.assertIn("has 2 configurations, and --ablation-target takes one", self.irace("ablation", "-T", "two.txt", code=1).stderr)
        self.assertIn("a file with one", self.irace("ablation", "-T", "none.txt", code=1).stderr)
        for words, advice in ((("-o", "log.Rdata"), "--ablation-csv"), (("--plot", "x.pdf"), "swarmsmith figure ablation"), (("-P", "x"), "leave it out")):
            self.assertIn(advice, self.irace("ablation", *words, code=1).stderr)

    def test_ablation_destroys_nothing_and_loses_nothing(self):
        (self.folder / "first.txt").write_text("x mode y\n90 slow NA\n")
        self.write_scenario(configurationsFile="first.txt")
        self.irace()
        made = len(self.calls())
        before = {file: (self.folder / file).read_bytes() for file in
                  ("irace.db", "scenario.txt", "parameters.txt", "first.txt")}
        for file in [*before, "nowhere/ablation.csv", "."]:
            done = self.irace("--ablation", "--ablation-csv", file, code=1)
            self.assertIn(file.split("/")[0], done.stderr)
        self.assertEqual(len(self.calls()), made, "refused before the first run")
        for file, text in before.items():
            self.assertEqual((self.folder / file).read_bytes(), text, file)
        for words in (("--ablation-instances", "0"), ("--ablation-source", "999")):
            self.irace("--ablation", *words, code=1)
        self.assertEqual(len(self.calls()), made)
        # A target that fails later on: what was run is there.
        (self.folder / "count").write_text("")
        self.write_runner("echo >>count; [ $(wc -l <count) -le 12 ] || exit 3; echo $cost")
        self.irace("--ablation", "--ablation-csv", "ablation.csv", code=1)
        rows = (self.folder / "ablation.csv").read_text().splitlines()
        self.assertGreaterEqual(len(rows) - 1, 10)
        # Mended, it goes on after them.
        made = len(self.calls())
        self.write_runner(PRINT)
        self.irace("--ablation", "--ablation-csv", "ablation.csv")
        self.assertEqual(len(self.calls()) - made, 20 - (len(rows) - 1))
        self.assertFalse([file for file in self.folder.iterdir() if ".part" in file.name])

    def test_import_destroys_nothing(self):
        self.irace()
        for file in ("scenario.txt", "parameters.txt", "irace.db"):
            before = (self.folder / file).read_bytes()
            done = call("import", "scenario.txt", "-o", file, cwd=self.folder)
            self.assertNotEqual(done.returncode, 0, file)
            self.assertIn(file, done.stderr)
            self.assertEqual((self.folder / file).read_bytes(), before)
        self.assertEqual(call("import", "scenario.txt", "-o", "campaign.toml", cwd=self.folder).returncode, 0)

    def test_ablation_with_a_target_evaluator(self):
        self.write_runner("echo $cost > cost-$id-$seed")
        self.write_program("target-evaluator", "#!/bin/sh\necho $* >> evaluator.txt; cat cost-$1-$3\n")
        self.write_scenario(targetEvaluator="./target-evaluator")
        self.irace()
        made, evaluated = len(self.calls()), len((self.folder / "evaluator.txt").read_text().splitlines())
        for kind in ("full", "racing"):
            done = self.irace("ablation", "--ablation-type", kind, "--ablation-csv", f"{kind}.csv", "--parallel", "2")
            self.assertIn("# Step 1: ", done.stdout)
            costs = [line.rsplit(",", 1)[1] for line in (self.folder / f"{kind}.csv").read_text().splitlines()[1:]]
            calls = (self.folder / "evaluator.txt").read_text().splitlines()
            self.assertGreaterEqual(len(calls) - evaluated, len(costs))
            self.assertEqual(len(self.calls()) - made, len(costs))
            self.assertTrue(all(float(cost) >= 0 for cost in costs))
            # The runs print no cost of their own: the figure has those of the evaluator, too.
            store = {"full": "irace-ablation.db", "racing": "irace-ablation-racing.db"}[kind]
            ended_well(call("figure", "ablation", store, "-o", "way.csv", cwd=self.folder))
            way = {}
            with open(self.folder / "way.csv", encoding="utf-8") as file:
                for row in csv.DictReader(file):
                    way.setdefault((row["step"], float(row["mean_cost"])), []).append(float(row["cost"]))
            self.assertGreater(len(way), 1)
            for (step, mean), of_runs in way.items():
                self.assertGreater(max(of_runs), 0, step)
                self.assertAlmostEqual(mean / (sum(of_runs) / len(of_runs)), 1, places=6, msg=step)
            made, evaluated = len(self.calls()), len(calls)

    def test_more_initial_configurations_than_a_race_has_room_for(self):
        rows = "".join(f"{x} slow NA\n" for x in range(60))
        (self.folder / "first.txt").write_text("x mode y\n" + rows)
        self.write_scenario(configurationsFile="first.txt")
        self.assertRegex(self.irace().stdout, r"only \d+ of the 60 initial configurations take part")

    def test_a_larger_budget_is_an_extension(self):
        self.runs()
        refused = self.irace("--max-experiments", "240", code=1)
        self.assertIn("`swarmsmith extend", refused.stderr)
        self.assertIn("--budget 60`", refused.stderr)

    def test_a_target_evaluator(self):
        self.write_runner("echo $cost > cost-$id-$seed; echo 1")
        self.write_program("target-evaluator", "#!/bin/sh\ncat cost-$1-$3\n")
        self.runs(targetEvaluator="./target-evaluator")

    def test_calls_of_a_target_evaluator_do_not_meet(self):
        self.write_runner("echo $cost > cost-$id-$seed; echo 1")
        self.write_program("target-evaluator", """\
#!/bin/sh
mkdir lock || exit 1
cat cost-$1-$3
rmdir lock
""")
        self.runs("--workers", "2", "--parallel", "4", targetEvaluator="./target-evaluator")

    def test_repair_by_a_program(self):
        # Two lines, names and values: odd values of x become even.
        self.write_program("repair.sh", """\
#!/bin/sh
exec awk 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^"?x"?$/) x = i }
          NR == 2 { $x -= $x % 2 }
          { print }'
""")
        self.runs(repairConfiguration="./repair.sh")
        self.assertTrue(all(int(re.search(r"--x (\d+)", line).group(1)) % 2 == 0
                            for line in self.calls()))


if __name__ == "__main__":
    unittest.main()
