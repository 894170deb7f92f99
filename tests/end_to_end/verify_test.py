"""What `verify` finds by evaluating again: stores that were changed by hand."""
import contextlib
import json
import sqlite3
import unittest

from programs import ProgramTest, call, ended_well

ALL = 1_000_000


class Verify(ProgramTest):
    budget = 1400
    tests = 30

    @classmethod
    def setUpClass(cls):
        cls.kept = None

    def setUp(self):
        super().setUp()
        self.store = self.folder / "campaign.db"
        if type(self).kept is None:
            ended_well(self.run_campaign(self.store, "--workers", "2"))
            with contextlib.closing(sqlite3.connect(self.store)) as db:
                db.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            type(self).kept = self.store.read_bytes()
        else:
            self.store.write_bytes(type(self).kept)

    def change(self, sql):
        """By a person who knows of the sums over rows."""
        with contextlib.closing(sqlite3.connect(self.store)) as db, db:
            self.assertGreater(db.execute(sql).rowcount, 0, sql)
            db.execute("DELETE FROM meta WHERE key = 'row_sums'")

    def verify(self, *arguments):
        done = call("verify", self.store, *arguments, "--json")
        answer = json.loads(done.stdout)
        self.assertEqual(answer["clean"], done.returncode == 0)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        return answer

    def different(self, *arguments):
        return self.verify(*arguments)["evaluated_again"]["different"]

    def ids(self, condition):
        rows = self.query(self.store, f"SELECT id FROM v_evaluations WHERE {condition}")
        return {row["id"] for row in rows}

    def test_what_workers_gave_is_clean(self):
        answer = self.verify("--sample", ALL)
        self.assertTrue(answer["clean"], answer)
        stored = self.ids("status = 'ok'")
        self.assertEqual(answer["evaluated_again"]["evaluations"], len(stored))
        usual = self.verify()
        self.assertTrue(usual["clean"])
        self.assertEqual(usual["evaluated_again"]["evaluations"], 64)
        # Some of the race, and all tests.
        self.assertEqual(self.verify("--sample", 10)["evaluated_again"]["evaluations"], 40)
        self.assertIsNone(self.verify("--sample", 0)["evaluated_again"])
        self.assertIn("64 evaluations were made again (--seed ", call("verify", self.store).stdout)

    def test_a_score_that_decides_nothing(self):
        """Digits that no race looks at: only who evaluates again can know."""
        self.change("UPDATE evaluation SET state_digest = state_digest + 1 "
                    "WHERE candidate = 3 AND purpose = 0 AND pair = 1")
        self.assertTrue(self.verify("--sample", 0)["clean"])
        self.assertEqual(self.different("--sample", ALL), ["e300001"])
        [complaint] = self.verify("--sample", ALL)["complaints"]
        [worker] = self.query(self.store, "SELECT e.worker, w.host FROM v_evaluations AS e JOIN "
                                          "v_workers AS w USING (worker) WHERE e.id = 'e300001'")
        self.assertIn(f"given by worker {worker['worker']} on {worker['host']}", complaint)

    def test_a_test_of_the_winner(self):
        self.change("UPDATE evaluation SET score = score + 1 WHERE purpose = 2 AND pair = 7")
        self.assertTrue(self.verify("--sample", 0)["clean"])
        changed = self.ids("purpose = 'test' AND pair = 7")
        self.assertEqual(set(self.different("--sample", 1)), changed)

    def test_a_score_made_a_rejection(self):
        """All rejections are looked at, however few scores are."""
        self.change("UPDATE evaluation SET status = 1, score = NULL "
                    "WHERE candidate = 5 AND purpose = 0 AND pair = 1")
        self.assertIn("e500001", self.different())
        self.assertIn("e500001", self.different("--sample", 1))
        self.assertIn("the store holds a rejection", call("verify", self.store).stdout)

    def test_two_results_of_one_evaluation(self):
        """A complaint, as long as it is not known which one is right."""
        self.change("INSERT INTO conflict (candidate, purpose, pair, kept_score, other_score, other_state_digest, "
                    "other_worker) SELECT candidate, purpose, pair, score, score + 1, 7, 1 FROM evaluation "
                    "WHERE candidate = 3 AND purpose = 0 AND pair = 1")
        [complaint] = self.verify()["complaints"]
        self.assertRegex(complaint, "^evaluation e300001: the score .* is kept, and worker 1 gave ")
        self.change("INSERT INTO attempt (candidate, purpose, pair, attempt, worker, held_ms, outcome) "
                    "VALUES (3, 0, 1, 1, 0, 1, 'audited')")
        self.assertTrue(self.verify()["clean"])

    def test_a_seed_names_the_sample(self):
        self.change("UPDATE evaluation SET state_digest = state_digest + 1 WHERE purpose = 0")
        one = self.different("--sample", 50, "--seed", 3)
        self.assertEqual(len(one), 50)
        self.assertEqual(self.different("--sample", 50, "--seed", 3), one)
        self.assertNotEqual(self.different("--sample", 50, "--seed", 4), one)
        # The sample of the next call cannot be known.
        self.assertNotEqual(self.different("--sample", 50), self.different("--sample", 50))

    def test_each_key_and_host_has_its_turn(self):
        """One that gave five results among a thousand is looked at like the others."""
        self.change("INSERT INTO worker SELECT 99, 'liar', 'far', 1, 1, build, state, 5, 0, "
                    "first_seen, last_seen, job, cpu, 'liar', connections, 'liar@10.0.0.9' "
                    "FROM worker LIMIT 1")
        self.change("UPDATE evaluation SET worker = 99, state_digest = state_digest + 1 "
                    "WHERE candidate = 4 AND purpose = 0 AND pair = 1")
        self.assertEqual(self.different("--sample", 8), ["e400001"])
        self.assertIn("on far (liar@10.0.0.9)", "".join(self.verify("--sample", 8)["complaints"]))


if __name__ == "__main__":
    unittest.main()
