"""The Python module reads stores and calls the program."""
import os
import pathlib
import sqlite3
import sys
import unittest

from programs import ProgramTest, call, ended_well

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
sys.path.insert(0, str(SOURCE / "analysis" / "python"))
import swarmsmith  # noqa: E402


class PythonModule(ProgramTest):
    budget = 1400
    tests = 4

    def setUp(self):
        super().setUp()
        self.store = self.folder / "a.db"
        ended_well(self.run_campaign(self.store, "--workers", "1", "--quiet"))

    def test_its_means_are_those_of_the_program(self):
        with swarmsmith.Store(self.store) as store:
            means = store.design_means()
        rows = self.query(self.store, "SELECT design, test_mean, test_runs FROM v_leaderboard")
        self.assertEqual([(row["design"], row["mean"], row["runs"]) for row in means],
                         [(row["design"], row["test_mean"], row["test_runs"]) for row in rows])

    def test_a_machine_scores_as_stored(self):
        file = self.folder / "best.fsm"
        self.assertEqual(call("export", self.store, "-o", file).returncode, 0)
        with swarmsmith.Store(self.store) as store:
            stored = {row["seed"]: row["score"] for row in store.query(
                "SELECT seed, score FROM v_design_scores WHERE purpose = ?", "test")}
            text = store.machine(store.design_means()[0]["candidate"])
        self.assertEqual(swarmsmith.evaluate(file), stored)
        seed = next(iter(stored))
        self.assertEqual(swarmsmith.evaluate(text, seed, "--flavour", "watermelon-argos3", "--profile", "argos3",
                                             "--mission", "aggregation"), {seed: stored[seed]})

    def test_it_writes_nothing(self):
        with swarmsmith.Store(self.store) as store:
            with self.assertRaises(sqlite3.OperationalError):
                store.query("DELETE FROM evaluation")
        self.assert_clean(self.store)

    def test_errors_say_what_is_wrong(self):
        for name, text, sentence in (("none.db", None, "no such store"), ("text.db", "text", "not a database"),
                                     ("empty.db", "", "not a store of Swarmsmith")):
            path = self.folder / name
            if text is not None:
                path.write_text(text * 1000)
            with self.assertRaises(swarmsmith.Error) as raised:
                swarmsmith.Store(path)
            self.assertIn(sentence, str(raised.exception))
        with swarmsmith.Store(self.store) as store, self.assertRaises(swarmsmith.Error):
            store.machine("c999999")
        with swarmsmith.Store(self.store) as store:
            for candidate in ("d1", "", None, 1.5, True):
                with self.assertRaisesRegex(swarmsmith.OptionError, "is not a candidate"):
                    store.machine(candidate)
            for purpose in ("tset", "transfer", None, ["test"]):
                with self.assertRaisesRegex(swarmsmith.OptionError, "one of test, score"):
                    store.design_means(purpose)
        with self.assertRaisesRegex(swarmsmith.Error, "the path of a store"):
            swarmsmith.Store(3)
        with self.assertRaisesRegex(swarmsmith.Error, "cannot be started"):
            swarmsmith.evaluate("best.fsm", program="/nowhere/swarmsmith")
        with self.assertRaises(swarmsmith.Error) as raised:
            swarmsmith.evaluate("--nstates 1 --s0 1")
        self.assertIn("--flavour", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
