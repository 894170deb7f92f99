"""What others do to a store with ordinary tools: it is noticed and reported, with a way out that works."""
import signal
import subprocess
import unittest

from rig import FaultTest, call, ended_well, need, stored, wait_for

REFUSED = 3  # exit code: the store cannot be used


class Others(FaultTest):
    budget = 1500
    designs = 2

    def sqlite(self, store, sql):
        """As a person types it."""
        need("sqlite3", "sqlite3")
        done = ended_well(subprocess.run(["sqlite3", "-cmd", ".timeout 20000", store, sql], capture_output=True, text=True,
                                         timeout=60))
        return done.stdout

    def assert_stopped(self, run, *words):
        self.assertEqual(run.wait(60), REFUSED, run.tail())
        self.assertIn("was changed by another program while the campaign ran", run.log())
        for word in words:
            self.assertIn(word, run.log())
        self.assertNotIn("internal error", run.log())
        self.count("campaign stopped with a sentence")

    def changed_while_it_runs(self, sql, *words):
        run = self.run_local("--workers", "2")
        self.wait_stored(300)
        before = stored(self.store)
        self.sqlite(self.store, sql)
        self.assert_stopped(run, *words)
        return before

    def test_a_column_added_while_it_runs(self):
        self.hold()
        before = self.changed_while_it_runs("alter table evaluation add note text",
                                            "table evaluation (column note added)")
        self.assertGreaterEqual(stored(self.store), before, "stored results are gone")
        again = call("run", self.file, "--store", self.store, "--no-dashboard")
        self.assertEqual(again.returncode, REFUSED, again.stderr)
        self.assertIn("swarmsmith backup", again.stderr)
        self.go_on_from_a_backup()

    def test_rows_deleted_while_it_runs(self):
        self.hold()
        self.changed_while_it_runs("delete from evaluation where candidate % 3 = 0", "evaluation (")
        again = call("run", self.file, "--store", self.store, "--no-dashboard")
        self.assertEqual(again.returncode, REFUSED, again.stderr)
        self.assertIn("swarmsmith recover", again.stderr)
        self.assertEqual(call("digest", self.store).returncode, REFUSED)
        self.assertEqual(call("verify", self.store).returncode, REFUSED)
        recovered = self.folder / "recovered.db"
        ended_well(call("recover", self.store, "-o", recovered))
        self.finish_as(recovered)

    def go_on_from_a_backup(self):
        copy = self.folder / "copy.db"
        ended_well(call("backup", self.store, copy))
        self.finish_as(copy)

    def finish_as(self, store):
        self.store = store
        self.finish(self.run_local("--workers", "2"))

    def test_what_is_not_ours_at_rest(self):
        self.hold()
        run = self.run_local("--workers", "2")
        self.wait_stored(300)
        run.send(signal.SIGINT)
        self.assertEqual(run.wait(), 130, run.tail())
        self.sqlite(self.store, "create trigger negate after insert on evaluation begin"
                                " update evaluation set score = -score where candidate = new.candidate; end;"
                                "drop view v_designs; create view v_designs as with recursive n(design) as"
                                " (select 1 union all select design + 1 from n) select count(*) as design from n;")
        for command in (("run", self.file, "--store", self.store, "--no-dashboard"), ("resume", self.store, "d2")):
            done = call(*command)
            with self.subTest(command[0]):
                self.assertEqual(done.returncode, REFUSED, done.stdout + done.stderr)
                self.assertIn("trigger negate", done.stderr)
                self.assertIn("view v_designs (another text)", done.stderr)
        done = ended_well(call("ls", "designs", self.store, timeout=20))  # our view answers, and theirs never would
        self.assertIn("aggregation", done.stdout)
        self.go_on_from_a_backup()

    def test_a_reader_that_folds_the_log_in_is_no_writer(self):
        self.hold()
        run = self.run_local("--workers", "2")
        for number in (200, 400, 600):
            self.wait_stored(number)
            self.sqlite(self.store, "pragma wal_checkpoint(truncate); select count(*) from v_evaluations")
        wait_for(lambda: run.alive(), "the campaign", 1)
        self.finish(run)


if __name__ == "__main__":
    unittest.main()
