"""Campaigns whose evaluations are programs: the example, kill -9, stores without their files."""
import json
import os
import pathlib
import random
import shutil
import signal
import unittest

from programs import SWARMSMITH, ProgramTest, call, ended_well, send, used, wait_for

EXAMPLE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "examples" / "target"

SCENARIO = """\
targetRunner = "./target-runner"
trainInstancesFile = "instances.txt"
parameterFile = "parameters.txt"
maxExperiments = 400
seed = 42
"""

REJECTS = """\
format = 1
[[mission]]
name = "rejects"
[[method]]
name = "m"
search = "{search}"
parameters_text = 'x "--x " r (0, 1)'
[method.{search}]
{settings}
[race]
max_experiments = 150
[simulator]
kind = "command"
command = ["./rejects"]
"""

MACHINES = """\
format = 1
[campaign]
seed = 5
[[mission]]
name = "aggregation"
[[method]]
name = "small"
flavour = "watermelon"
max_states = 2
max_transitions = 1
behaviours = ["stop", "exploration"]
conditions = ["black_floor"]
[race]
max_experiments = 200
[simulator]
kind = "command"
command = ["./evaluate.sh"]
"""

EVALUATE = """\
#!/bin/sh
# configuration, instance id, seed, instance, machine
shift 2
seed=$1
mission=$2
shift 2
score=$("{swarmsmith}" evaluate --mission "$mission" --flavour watermelon --profile rvr \\
    --seeds "$seed-$seed" --json "$*" | sed -n 's/.*"score":\\([-0-9.e+]*\\).*/\\1/p' | head -1)
echo "$score" | awk '{{ printf "%.17g\\n", -$1 }}'
"""


class Target(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "target"
        shutil.copytree(EXAMPLE, self.scenario)
        self.file = self.scenario / "campaign.toml"

    def test_every_search_outlives_programs_that_reject(self):
        """Costs of Inf, which no mean of a store can hold."""
        options = {"random": "runs = 2\nfinalists = 3\nfinal_runs = 4",
                   "f-race": "configurations = 20",
                   "evolution": "population = 10\nruns = 1\nfinal_runs = 2",
                   "cma-es": "population = 10\nruns = 1\nfinal_runs = 2",
                   "annealing": "window = 2\nfinal_runs = 4"}
        program = self.scenario / "rejects"
        for search, settings in options.items():
            for rejected in ("$2 > 0.4", "1"):
                with self.subTest(search, rejected=rejected):
                    program.write_text("#!/bin/sh\nshift 4\n"
                                       f'awk "BEGIN {{ print ({rejected}) ? \\"Inf\\" : $2 }}"\n')
                    program.chmod(0o755)
                    self.file.write_text(REJECTS.format(search=search, settings=settings))
                    store = self.folder / f"{search}{len(rejected)}.db"
                    done = self.run_campaign(store)
                    said = done.stdout + done.stderr
                    if rejected == "1":
                        self.assertIn("every configuration was rejected", said)
                    else:
                        self.assertEqual(done.returncode, 0, said)
                        self.assertIn("best c", said)
                    self.assert_clean(store)
                    self.assertIn(f"search      {search}",
                                  call("explain", "d1", store).stdout)

    def test_the_example_runs_and_is_found_clean_without_its_files(self):
        store = self.folder / "example.db"
        done = ended_well(self.run_campaign(store))
        self.assertIn("mean cost", done.stdout)
        self.assertIn("--effort ", done.stdout)
        [best] = self.query(store, "SELECT c.parameters FROM v_designs AS d JOIN v_candidates AS c "
                                   "ON c.candidate = d.best_candidate")
        self.assertEqual(json.loads(best["parameters"])["method"], "tabu")
        tests = self.query(store, "SELECT instance, score FROM v_design_scores ORDER BY instance")
        self.assertEqual([row["instance"] for row in tests], [1, 2, 3])
        digest = self.digest(store)
        shutil.rmtree(self.scenario)
        self.assert_clean(store)
        self.assertEqual(self.digest(store), digest)
        for what in (["ls", "elites"], ["show", "d1"], ["export"], ["status"]):
            ended_well(call(*what, "--store", store))
        self.assertNotIn("--fsm-config", call("export", store).stdout)
        refused = call("replay", "e100001", store)
        self.assertIn("a program scored it", refused.stderr)
        for command in ("verify", "replay"):
            refused = call(command, "--sample", 5, store)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn("programs scored this store", refused.stderr)
        self.assertIn("nothing was evaluated again", call("verify", store).stdout)

    def test_check_runs_no_program_and_names_a_missing_one(self):
        done = ended_well(call("check", self.file))
        self.assertIn("by " + str(self.scenario / "target-runner"), done.stdout)
        (self.scenario / "target-runner").unlink()
        for command in ("check", "run"):
            done = call(command, self.file)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("there is no such program", done.stderr)

    def test_killed_at_any_moment_it_comes_to_the_same_answer(self):
        whole = self.folder / "whole.db"
        ended_well(self.run_campaign(whole, "--workers", "1"))
        store = self.folder / "killed.db"
        rng = random.Random(3)
        for _ in range(6):
            moment = used(store) + rng.randrange(1, 50)  # of 400
            process = self.start_campaign(store, "--workers", "2")
            wait_for(lambda: used(store) >= moment or process.poll() is not None, "no progress")
            self.assertIsNone(process.poll(), "it ended before it could be killed")
            send(process.pid, signal.SIGKILL)
            process.wait()
        ended_well(self.run_campaign(store, "--workers", "2"))
        self.assert_clean(store)
        self.assertEqual(self.digest(store), self.digest(whole))

    def test_a_program_that_fails_stops_the_campaign_and_is_kept(self):
        runner = self.scenario / "target-runner"
        runner.write_text("#!/bin/sh\necho no licence >&2\nexit 3\n")
        store = self.folder / "failed.db"
        done = self.run_campaign(store)
        self.assertEqual(done.returncode, 6, done.stdout + done.stderr)
        failures = self.query(store, "SELECT reason, command, errors FROM v_failures")
        self.assertGreaterEqual(len(failures), 1)
        self.assertIn("no licence", failures[0]["errors"])
        self.assertIn(str(runner), failures[0]["command"])

    def test_an_imported_scenario_is_the_same_race(self):
        (self.scenario / "scenario.txt").write_text(SCENARIO)
        made = self.scenario / "imported.toml"
        ended_well(call("import", self.scenario / "scenario.txt", "-o", made))
        store = self.folder / "imported.db"
        self.assertEqual(call("run", made, "--store", store).returncode, 0)
        self.assert_clean(store)
        refused = call("import", "machines.csv")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no store given", refused.stderr)

    def test_machines_by_a_program_have_the_scores_of_the_simulator(self):
        runner = self.scenario / "evaluate.sh"
        runner.write_text(EVALUATE.format(swarmsmith=SWARMSMITH))
        runner.chmod(0o755)
        self.file = self.scenario / "machines.toml"
        self.file.write_text(MACHINES)
        store = self.folder / "machines.db"
        ended_well(self.run_campaign(store))
        rows = self.query(store, "SELECT c.fsm_config, e.seed, e.score FROM v_evaluations AS e "
                                 "JOIN v_candidates AS c ON c.candidate = e.candidate "
                                 "WHERE e.score <> 0 LIMIT 5")
        self.assertEqual(len(rows), 5)
        for row in rows:
            alone = call("evaluate", row["fsm_config"], "--flavour", "watermelon", "--mission", "aggregation", "--seeds",
                         f"{row['seed']}-{row['seed']}", "--json")
            self.assertEqual(json.loads(alone.stdout.splitlines()[0])["score"], row["score"])


if __name__ == "__main__":
    unittest.main()
