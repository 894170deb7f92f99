"""People pause, resume, cancel and extend designs of a campaign that runs, or that is at rest."""
import signal
import unittest

from programs import ProgramTest, call, campaign_text, children_of, designs_of, ended_well, send, used, wait_for


class Commands(ProgramTest):
    budget = 6000
    tests = 5
    references = {}

    def setUp(self):
        super().setUp()
        text = self.file.read_text().replace("seed = 7\n", "seed = 7\nrepetitions = 2\n")
        self.file.write_text(text)
        self.store = self.folder / "campaign.db"

    def expected(self):
        """Digest of the campaign without any command, computed once."""
        if "plain" not in Commands.references:
            store = self.folder / "reference.db"
            ended_well(self.run_campaign(store, "--workers", "2"))
            Commands.references["plain"] = self.digest(store)
        return Commands.references["plain"]

    def ask(self, *arguments, code=0):
        done = call(*arguments, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def ask_running(self, process, *arguments):
        """The same while its workers stand still: under load the race would be over before the
        program that asks has started."""
        workers = children_of(process.pid)
        self.assertTrue(workers)
        for worker in workers:
            send(worker, signal.SIGSTOP)
        try:
            return self.ask(*arguments)
        finally:
            for worker in workers:
                send(worker, signal.SIGCONT)

    def until_coordinated_by(self, process):
        """Until this program has said where it is, not one that was killed before it."""
        file = self.folder / "campaign.db.coordinator"
        wait_for(lambda: file.exists() and f"pid = {process.pid}" in file.read_text().splitlines(),
                 "no coordinator")

    def designs(self):
        return designs_of(self.store)

    def used(self, design):
        return used(self.store, design)

    def begin(self, least=100):
        """Runs the campaign until both of its designs have come some way."""
        process = self.start_campaign(self.store, "--workers", "2")
        wait_for(lambda: min(self.used(1), self.used(2)) >= least or process.poll() is not None,
                 "the campaign does not begin")
        self.assertIsNone(process.poll(), "the campaign was over too soon")
        return process

    def stop(self, process):
        send(process.pid, signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130)

    def go_on(self):
        ended_well(self.run_campaign(self.store, "--workers", "2"))
        self.assert_clean(self.store)

    def test_a_paused_design_stands_still_and_goes_on_to_the_same_answer(self):
        process = self.begin()
        self.assertIn("paused: d2", self.ask_running(process, "pause", self.store, "d2"))
        # What was leased when the command came ends, and counts.
        wait_for(lambda: self.designs()[1]["state"] == "finished", "d1 does not end")
        stands = self.used(2)
        self.assertEqual(self.designs()[2]["state"], "racing")
        self.assertIsNone(process.poll(), "a campaign with a paused design is not over")
        # All that is left is paused: it waits, also after the coordinator was killed.
        send(process.pid, signal.SIGKILL)
        process.wait()
        process = self.start_campaign(self.store, "--workers", "2")
        self.until_coordinated_by(process)
        self.assertIn("nothing to do", self.ask("pause", self.store, "d2"))
        self.assertEqual(self.used(2), stands)
        self.assertIn("d2", self.ask("status", self.store))
        self.assertIn("resumed: d2", self.ask("resume", self.store))
        self.assertEqual(process.wait(timeout=120), 0)
        self.assert_clean(self.store)
        self.assertEqual(self.digest(self.store), self.expected())

    def test_a_pause_at_rest_holds_until_it_is_resumed(self):
        self.stop(self.begin())
        self.assertIn("paused: d1, d2", self.ask("pause", self.store))
        before = self.used(1)
        process = self.start_campaign(self.store, "--workers", "2")
        self.until_coordinated_by(process)
        self.assertIn("nothing to do", self.ask("pause", self.store))
        self.assertEqual(self.used(1), before)
        self.stop(process)
        self.ask("resume", self.store)
        self.go_on()
        self.assertEqual(self.digest(self.store), self.expected())

    def test_a_cancelled_design_stops_where_it_is_whatever_happens_then(self):
        process = self.begin()
        self.assertIn("d2 is cancelled",
                      self.ask_running(process, "cancel", self.store, "d2"))
        send(process.pid, signal.SIGKILL)
        process.wait()
        # What was confirmed is on disk: the same campaign, undisturbed from here, and killed again.
        twin = self.folder / "twin.db"
        self.query(self.store, "SELECT 1 AS one")  # folds nothing in, but sees the log
        for suffix in ("", "-wal"):
            part = self.store.with_name(self.store.name + suffix)
            if part.exists():
                twin.with_name(twin.name + suffix).write_bytes(part.read_bytes())
        process = self.start_campaign(self.store, "--workers", "1")
        wait_for(lambda: self.used(1) >= 1000, "d1 does not go on")
        send(process.pid, signal.SIGKILL)
        process.wait()
        self.go_on()
        ended_well(self.run_campaign(twin, "--workers", "2"))
        self.assertEqual(self.digest(self.store), self.digest(twin))
        designs = self.designs()
        self.assertEqual((designs[2]["state"], designs[2]["reason"]), ("stopped", "cancelled"))
        self.assertEqual(designs[1]["state"], "finished")
        self.assertNotEqual(self.digest(self.store), self.expected())
        # The row says when, for good.
        commands = self.query(self.store, "SELECT kind, design, step, who FROM v_commands")
        self.assertEqual([row["kind"] for row in commands], ["cancel"])
        self.assertIsNotNone(commands[0]["step"])
        self.assertIn("@", commands[0]["who"])
        self.assertIn("cancelled before", self.ask("cancel", self.store, "d2", code=1))

    def test_no_coordinator_file_stays_if_another_one_cannot_be_written(self):
        for name, seed in (("a", 7), ("b", 8)):
            (self.folder / f"{name}.toml").write_text(
                campaign_text(self.budget, seed=seed, tests=self.tests, store=f"{name}.db"))
        (self.folder / "b.db.coordinator").mkdir()
        done = call("run", "a.toml", "b.toml", "--no-dashboard", "--workers", "1", cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("b.db.coordinator", done.stderr)
        self.assertFalse((self.folder / "a.db.coordinator").exists(), "nothing listens there")

    def test_an_extension_goes_on_from_the_end_by_the_next_run(self):
        self.file.write_text(self.file.read_text().replace("= 6000", "= 1400"))
        self.go_on()
        plain = self.digest(self.store)
        self.assertIn("too few for another iteration",
                      self.ask("extend", self.store, "d1", "--budget", "1", code=1))
        self.assertIn("no design given", self.ask("extend", self.store, "--budget", "900", code=2))
        self.assertIn("no such design", self.ask("extend", self.store, "d9", "--budget", "900",
                                                 code=4))
        self.assertIn("more experiments when",
                      self.ask("extend", self.store, "d1", "--budget", "900"))
        before = self.used(1)
        self.assertIn("extend", self.ask("status", self.store))
        self.go_on()
        self.assertGreater(self.used(1), before)
        self.assertLessEqual(self.used(1), 2300)
        self.assertNotEqual(self.digest(self.store), plain)
        self.assertIn("extend", self.ask("show", "d1", self.store))
        extended = self.digest(self.store)
        self.go_on()
        self.assertEqual(self.digest(self.store), extended)

    def test_an_extension_while_running_acts_at_the_end_of_the_race(self):
        process = self.begin()
        self.assertIn("gets 900", self.ask_running(process, "extend", self.store, "d1", "--budget",
                                                   "900"))
        send(process.pid, signal.SIGKILL)
        process.wait()
        self.go_on()
        self.assertGreater(self.used(1), self.budget)
        at_rest = self.folder / "rest.db"
        ended_well(self.run_campaign(at_rest, "--workers", "2"))
        self.ask("extend", at_rest, "d1", "--budget", "900")
        ended_well(self.run_campaign(at_rest, "--workers", "2"))
        # An extension acts at the end of the race, whenever it was asked for.
        self.assertEqual(self.digest(self.store), self.digest(at_rest))


if __name__ == "__main__":
    unittest.main()
