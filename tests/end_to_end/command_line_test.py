"""What a shell sees of the program: exit codes, standard output and error, its whole command line."""
import json
import os
import subprocess
import unittest

from programs import SWARMSMITH, ProgramTest, call, campaign_text, ended_well

EXPLORE = ["--nstates", "1", "--s0", "0", "--rwm0", "10"]


class CommandLine(ProgramTest):
    budget = 2000

    def assert_exits(self, code, sentence, *arguments):
        done = call(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(done.stdout, "")

    def test_wrong_usage_exits_with_two_and_suggests(self):
        self.assert_exits(2, "Commands:")
        self.assert_exits(2, 'did you mean "check"?', "chekc")
        self.assert_exits(2, 'did you mean "--json"?', "check", "campaign.toml", "--jsno")
        self.assert_exits(2, "FILE is required", "check")

    def test_a_wrong_campaign_file_exits_with_two_and_tells_every_place(self):
        text = campaign_text(200, seed=1, tests=1).replace("seed", "sead")
        self.file.write_text(text.replace('"argos3"\nflavour', '"argos3"\nflavur'))
        done = call("check", "campaign.toml", cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2, done.stderr)
        self.assertIn('campaign.toml:5:1: [campaign] has no key `sead` (did you mean "seed"?)',
                      lines[0])
        self.assertIn('[[method]] has no key `flavur` (did you mean "flavour"?)', lines[1])

    def test_a_budget_that_is_too_small_names_the_smallest(self):
        self.file.write_text(campaign_text(200, seed=1, tests=1))
        self.assert_exits(2, "1350", "check", "campaign.toml")

    def test_a_missing_campaign_file_exits_with_two(self):
        self.assert_exits(2, "no.toml: there is no such campaign file", "check", "no.toml")

    def test_a_store_that_is_not_there_exits_with_three(self):
        for command in ("digest", "status", "query", "export"):
            self.assert_exits(3, "no.db: there is no such store", command, "no.db")

    def test_check_answers_on_standard_output(self):
        done = ended_well(call("check", self.file, "--json"))
        self.assertEqual(json.loads(done.stdout)["experiments"], 2000)

    def test_a_campaign_of_chocolate_checks_and_runs(self):
        text = campaign_text(2000, seed=1, tests=2)
        self.file.write_text(text.replace("watermelon-argos3", "chocolate").replace(
            "max_experiments", "nb_iterations = 2\nmax_experiments"))
        check = ended_well(call("check", self.file, "--json"))
        self.assertIn("has no light", json.loads(check.stdout)["warnings"][0])
        store = self.folder / "chocolate.db"
        ended_well(self.run_campaign(store))
        self.assert_clean(store)
        tried = self.query(store, "SELECT count(*) AS n FROM v_candidates "
                                  "WHERE modules LIKE '%phototaxis%'")
        self.assertGreater(tried[0]["n"], 0)

    def test_workers_take_no_more_cores_than_was_said(self):
        for number, (words, slots) in enumerate([(["--workers", "1"], [1]), (["--workers", "2"], [1, 1]),
                                                 (["--slots", "3"], [3]), (["--workers", "2", "--slots", "4"], [2, 2]),
                                                 (["--workers", "3", "--slots", "1"], [1])]):
            store = self.folder / f"slots{number}.db"
            self.assertEqual(self.run_campaign(store, *words).returncode, 0)
            rows = self.query(store, "SELECT slots FROM v_workers ORDER BY worker")
            self.assertEqual([row["slots"] for row in rows], slots, words)
        done = self.run_campaign(self.folder / "far.db", "--workers", "slurm:2x4", "--slots", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--slots: applies to workers on this host", done.stderr)

    def test_evaluate_takes_the_words_of_a_machine_as_they_are(self):
        done = ended_well(call("evaluate", *EXPLORE, "--flavour", "watermelon", "--mission", "aggregation", "--seeds", "1-3",
                               "--json"))
        runs = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([run["seed"] for run in runs], [1, 2, 3])
        again = call("evaluate", "--flavour", "watermelon", "--mission", "aggregation", "--seeds", "1-3", "--json", "--",
                     *EXPLORE)
        self.assertEqual(again.stdout, done.stdout)

    def test_evaluate_measures_turns_by_the_clock_that_is_named(self):
        words = ("--profile", "pseudo-reality", "--mission", "grid_exploration", "--seeds", "1-3", "--json")
        scores = [call("evaluate", *EXPLORE, "--flavour", "watermelon", *words, *clock).stdout
                  for clock in ((), ("--turn-clock", "cycles"), ("--turn-clock", "seconds"))]
        self.assertEqual(scores[0], scores[1])
        self.assertNotEqual(scores[0], scores[2])
        head = '#: format = 1\n#: flavour = "watermelon"\n#: turn_clock = "cycles"\n'
        (self.folder / "best.fsm").write_text(head + " ".join(EXPLORE) + "\n")
        other = call("evaluate", self.folder / "best.fsm", *words, "--turn-clock", "seconds")
        self.assertEqual(other.returncode, 2)
        self.assertIn("--turn-clock: the machine was designed with the turn clock cycles", other.stderr)

    def test_init_check_and_help_work_in_an_empty_folder(self):
        self.assertEqual(call("init", "mine", cwd=self.folder).returncode, 0)
        self.assertEqual(call("check", "mine/campaign.toml", cwd=self.folder).returncode, 0)
        self.assertIn("Examples:", call("evaluate", "--help").stdout)

    def test_errors_have_colour_only_on_a_terminal(self):
        self.assertNotIn("\x1b", call("nothing").stderr)
        script = [SWARMSMITH, "nothing"]
        for environment, colour in (({}, True), ({"NO_COLOR": "1"}, False)):
            try:
                primary, secondary = os.openpty()
            except OSError as error:
                self.skipTest(f"skipped: this system gives no pseudo-terminal: {error}")
            process = subprocess.Popen(script, stderr=secondary, stdout=subprocess.DEVNULL,
                                       env={**os.environ, "TERM": "xterm", "NO_COLOR": "",
                                            **environment})
            process.wait(timeout=60)
            os.close(secondary)
            text = os.read(primary, 4096).decode()
            os.close(primary)
            self.assertEqual("\x1b[" in text, colour, text)


if __name__ == "__main__":
    unittest.main()
