"""Several campaigns on one pool of workers give the answers that each gives alone."""
import json
import signal
import unittest

from programs import ProgramTest, call, campaign_text, ended_well, send, start


class Pool(ProgramTest):
    budget = 1400
    tests = 5

    def setUp(self):
        super().setUp()
        self.files = [self.write(name, seed) for name, seed in (("first", 11), ("second", 12))]

    def write(self, name, seed, store=None):
        text = campaign_text(self.budget, seed=seed, tests=self.tests)
        text = text.replace('"survival"', f'"{name}"')
        text = text.replace("unused.db", str(store or self.folder / f"{name}.db"))
        file = self.folder / f"{name}.toml"
        file.write_text(text)
        return file

    def alone(self, file):
        store = self.folder / (file.stem + "-alone.db")
        ended_well(call("run", file, "--store", store))
        return self.digest(store)

    def assert_as_alone(self):
        for file in self.files:
            store = self.folder / f"{file.stem}.db"
            self.assert_clean(store)
            self.assertEqual(self.digest(store), self.alone(file))

    def test_two_campaigns_give_what_each_gives_alone(self):
        done = ended_well(call("run", *self.files, "--workers", "2", "--json"))
        events = [json.loads(line) for line in done.stdout.splitlines()]
        of_designs = [event for event in events if event["event"] in ("design", "race_step")]
        self.assertEqual({event["campaign"] for event in of_designs}, {"first", "second"})
        ends = [event["campaign"] for event in events if event["event"] == "done"]
        self.assertEqual(ends, ["first", "second"])
        # A worker is of the pool: its row is in both stores, and told once.
        come = [event for event in events
                if event["event"] == "worker" and event["state"] == "connected"]
        self.assertEqual(len(come), 2)
        self.assertNotIn("campaign", come[0])
        self.assert_as_alone()

    def test_a_killed_coordinator_goes_on_with_both(self):
        for pause in (0.4, 0.6):
            process = start("run", *self.files, "--workers", "2")
            self.addCleanup(self._end, process)
            try:
                process.wait(timeout=pause)
            except Exception:
                send(process.pid, signal.SIGKILL)
                process.wait()
        ended_well(call("run", *self.files, "--workers", "2"))
        self.assert_as_alone()

    def test_a_finished_one_prints_its_result_and_stops_no_other(self):
        self.assertEqual(call("run", self.files[0]).returncode, 0)
        done = ended_well(call("run", *self.files))
        self.assertIn("campaign first\nd1", done.stdout)
        self.assertIn("campaign second\nd1", done.stdout)

    def test_campaigns_of_one_name_have_those_of_their_stores(self):
        files = []
        for name in ("a", "b"):
            file = self.folder / name / "campaign.toml"
            file.parent.mkdir()
            file.write_text(f"""format = 1
[[mission]]
name = "{name}"
[[method]]
name = "m"
parameters_text = 'x "" r (0, 1)'
[race]
max_experiments = 200
[simulator]
kind = "command"
command = ["/bin/false"]
""")
            files.append(file)
        done = call("run", *files, "--workers", "2")
        self.assertEqual(done.returncode, 6, done.stderr)
        for file in files:
            self.assertIn(f"{file.with_suffix('.db')}: ", done.stderr)
        self.assertNotIn(": campaign: ", done.stderr)

    def assert_refused(self, sentence, *arguments):
        done = call("run", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(sentence, done.stderr)

    def test_what_makes_no_sense_is_refused(self):
        self.assert_refused("names one store", *self.files, "--store", self.folder / "x.db")
        self.assert_refused("is given twice", self.files[0], self.files[0])
        third = self.write("third", 13, store=self.folder / "first.db")
        self.assert_refused("two of the campaigns have this store", self.files[0], third)
        self.assertEqual(list(self.folder.glob("*.db")), [])


if __name__ == "__main__":
    unittest.main()
