"""Stores as files: copied while a campaign runs, merged, and recovered from damage."""
import json
import os
import pathlib
import random
import shutil
import sqlite3
import unittest

from programs import ProgramTest, call, ended_well, used, wait_for

PAGE = 8192
SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])


class Stores(ProgramTest):
    budget = 1400
    tests = 10

    def made(self, name, seed):
        """A finished store of the test's campaign with another seed."""
        store = self.folder / name
        ended_well(self.run_campaign(store, "--workers", "2", "--seed", seed))
        return store

    def answer(self, *arguments):
        done = ended_well(call(*arguments, "--json"))
        return json.loads(done.stdout)


class OldStores(Stores):
    def test_a_copy_of_an_old_store_can_be_drawn_and_the_original_stays(self):
        for schema in (1, 2, 3, 4, 6):
            with self.subTest(schema=schema):
                kept = SOURCE / f"tests/golden/stores/schema-{schema}.sqlite"
                old, copy = self.folder / f"old-{schema}.db", self.folder / f"new-{schema}.db"
                shutil.copy(kept, old)
                itself = call("figure", "machine", old)
                if schema < 4:  # lacks tables that the views need
                    self.assertIn("swarmsmith backup", itself.stderr)
                else:
                    self.assertIn("<svg", itself.stdout)
                self.assertEqual(self.answer("backup", old, copy)["from_schema"], schema)
                drawn = ended_well(call("figure", "machine", copy))
                self.assertIn("<svg", drawn.stdout)
                self.assertEqual(old.read_bytes(), kept.read_bytes())

    def test_a_copy_is_verified_where_the_engine_is_the_same_and_refused_where_it_is_not(self):
        for schema in (1, 2, 3, 4, 6):
            with self.subTest(schema=schema):
                copy = self.folder / f"new-{schema}.db"
                kept = SOURCE / f"tests/golden/stores/schema-{schema}.sqlite"
                shutil.copy(kept, self.folder / f"old-{schema}.db")
                self.answer("backup", self.folder / f"old-{schema}.db", copy)
                done = call("verify", copy)
                if schema >= 4:
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    self.assertIn("0 with other bits", done.stdout)
                else:
                    self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
                    self.assertIn("another version of the engine", done.stderr)


class Backup(Stores):
    budget = 10000

    def test_a_copy_that_is_made_while_a_campaign_runs_goes_on_to_the_same_answer(self):
        store, copy = self.folder / "running.db", self.folder / "copy.db"
        process = self.start_campaign(store, "--workers", "2")
        wait_for(lambda: used(store) > 500, "no progress", 120)
        made = self.answer("backup", store, copy)
        self.assertEqual(self.digest(copy), made["digest"])
        self.assert_clean(copy)
        self.assertEqual(process.wait(timeout=200), 0)
        self.assertNotEqual(self.digest(store), made["digest"], "the campaign was over before it was copied")
        self.assertEqual(self.run_campaign(copy, "--workers", "2").returncode, 0)
        self.assertEqual(self.digest(copy), self.digest(store))

    def test_nothing_is_overwritten(self):
        kept = self.folder / "kept"
        kept.write_text("mine")
        done = call("backup", self.folder / "none.db", kept)
        self.assertIn("nothing is overwritten", done.stderr)
        self.assertEqual((done.returncode, kept.read_text()), (1, "mine"))
        self.assertEqual(call("backup", self.folder / "none.db", self.folder / "x").returncode, 3)
        self.assertEqual(call("backup", "one").returncode, 2)


class Merge(Stores):
    def setUp(self):
        super().setUp()
        self.first, self.second = self.made("first.db", 7), self.made("second.db", 8)
        self.merged = self.folder / "merged.db"
        self.told = self.answer("merge", self.first, self.second, "-o", self.merged)

    def test_commands_read_it_with_the_new_numbers(self):
        self.assert_clean(self.merged)
        digests = self.answer("digest", self.merged)
        self.assertEqual(digests["digest"], self.told["digest"])
        self.assertEqual([each["digest"] for each in digests["campaigns"]],
                         [self.digest(self.first), self.digest(self.second)])
        self.assertEqual(len(self.answer("status", self.merged)["campaigns"]), 2)
        self.assertEqual([row["design"] for row in self.answer("ls", "designs", self.merged)["rows"]],
                         ["d1", "d2"])
        self.assertEqual(self.answer("show", "d2", self.merged)["design"]["campaign"], 2)
        for store, design in (self.first, 1), (self.second, 2):
            own = self.query(store, "SELECT id, score FROM v_evaluations WHERE purpose = 'test'"
                                    " ORDER BY pair")[0]
            there = self.query(self.merged, "SELECT id, score FROM v_evaluations WHERE purpose ="
                                            f" 'test' AND design = {design} ORDER BY pair")[0]
            self.assertEqual(there["score"], own["score"])
            self.assertEqual(there["id"] == own["id"], design == 1)
            self.assertTrue(self.answer("replay", there["id"], self.merged)["same_bits"])
            self.assertEqual(self.answer("explain", there["id"], self.merged)["id"], there["id"])
        machines = self.answer("export", self.merged, "--format", "json")["machines"]
        own = self.answer("export", self.second, "--format", "json")["machines"]
        self.assertEqual(machines[1]["fsm_config"], own[0]["fsm_config"])
        best = machines[1]["candidate"]
        ended_well(call("evaluate", best, "--store", self.merged, "--seeds", "1-2"))

    def test_it_is_there_to_be_read(self):
        digest = self.told["digest"]
        for words in (["run", self.file, "--store", self.merged], ["pause", self.merged],
                      ["extend", self.merged, "d1", "--budget", 100]):
            done = call(*words)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertIn("the store holds 2 campaigns", done.stderr)
        self.assertEqual(self.answer("digest", self.merged)["digest"], digest)

    def test_a_score_that_was_changed_is_told_with_its_campaign(self):
        with sqlite3.connect(self.merged) as store:
            store.execute("UPDATE evaluation SET score = score + 1 WHERE candidate > 1000000"
                          " AND purpose = 0 AND pair = 1")
        store.close()
        done = call("verify", self.merged)
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("campaign 2, survival: d1", done.stdout)
        self.assertNotIn("campaign 1", done.stdout)

    def test_a_campaign_is_merged_once(self):
        done = call("merge", self.merged, self.first, "-o", self.folder / "x.db")
        self.assertEqual(done.returncode, 3)
        self.assertIn("a campaign is merged once", done.stderr)
        self.assertFalse((self.folder / "x.db").exists())


class Recover(Stores):
    def setUp(self):
        super().setUp()
        self.store = self.made("whole.db", self.seed)
        self.wanted = self.digest(self.store)
        self.bytes = self.store.read_bytes()
        self.damaged, self.new = self.folder / "damaged.db", self.folder / "new.db"

    def recover(self, data, *arguments):
        """What `recover` says of a store of these bytes."""
        self.new.unlink(missing_ok=True)
        self.damaged.write_bytes(data)
        return self.answer("recover", self.damaged, "-o", self.new, *arguments)

    def assert_goes_on_to_the_same_answer(self):
        ended_well(self.run_campaign(self.new, "--workers", "2"))
        self.assertEqual(self.digest(self.new), self.wanted)
        self.assert_clean(self.new)

    def lost(self, told):
        return sum(table["lost_pages"] + table["broken"] + table["tree_lost"]
                   for table in told["tables"])

    def test_a_damaged_header_costs_nothing(self):
        for damage in 16, 100, PAGE:
            told = self.recover(bytes(damage) + self.bytes[damage:])
            self.assertTrue(told["header_damaged"])
            self.assertEqual((told["digest"], self.lost(told)), (self.wanted, 0))
            self.assert_clean(self.new)

    def test_what_is_cut_off_is_evaluated_again(self):
        for part in 0.9, 0.6, 0.3:
            told = self.recover(self.bytes[:int(len(self.bytes) * part)], "--campaign",
                                self.file)
            self.assertGreater(self.lost(told), 0)
            self.assert_goes_on_to_the_same_answer()

    def test_pages_that_were_overwritten_are_evaluated_again(self):
        generator = random.Random(1)
        missing = 0
        for _ in range(8):
            data = bytearray(self.bytes)
            for _ in range(generator.randint(3, 12)):
                page = generator.randrange(len(data) // PAGE)
                data[page * PAGE:(page + 1) * PAGE] = generator.randbytes(PAGE)
            told = self.recover(data, "--campaign", self.file)
            missing += told["designs"][0]["missing"]
            done = call("verify", self.new)
            if done.returncode != 0:
                self.assertIn("run the campaign on this store", done.stdout)
            self.assert_goes_on_to_the_same_answer()
        self.assertGreater(missing, 0, "the damage never met a score")

    def test_candidates_whose_phrases_are_lost_are_derived_again(self):
        store = sqlite3.connect(f"file:{self.store}?mode=ro", uri=True)
        root, = store.execute("SELECT rootpage FROM sqlite_schema WHERE name = 'phrase'").fetchone()
        leaf, = store.execute("SELECT max(rootpage) FROM sqlite_schema WHERE name = 'pair'").fetchone()
        store.close()
        # Only its root: the phrases are on other pages, and found without it.
        data = bytearray(self.bytes)
        data[(root - 1) * PAGE:root * PAGE] = bytes(PAGE)
        self.recover(data)
        self.assert_goes_on_to_the_same_answer()
        # And with a score missing, so that candidates stay which nothing derives yet.
        data[(leaf - 1) * PAGE:leaf * PAGE] = bytes(PAGE)
        data = data[:len(data) * 8 // 10]
        self.recover(data, "--campaign", self.file)
        self.assert_goes_on_to_the_same_answer()

    def test_a_score_that_was_changed_is_said(self):
        def changed(columns):
            copy = self.folder / "changed.db"
            shutil.copy(self.store, copy)
            with sqlite3.connect(copy) as store:
                store.execute(f"UPDATE evaluation SET {columns} WHERE purpose = 0 AND candidate = 7 AND pair = 2")
            store.close()
            return copy

        # The row's own check shows it, and the score is left out; without one the race shows it.
        told = self.recover(changed("score = score + 100").read_bytes())
        self.assertEqual(told["changed"], 1)
        self.assert_goes_on_to_the_same_answer()
        self.new.unlink()
        done = call("recover", changed("score = score + 100, row_check = NULL"), "-o", self.new)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("a score in it, or before it, was changed", done.stdout)

    def test_errors_say_that_it_can_be_done(self):
        self.damaged.write_bytes(self.bytes[:len(self.bytes) // 2])
        done = call("digest", self.damaged)
        self.assertEqual(done.returncode, 3)
        self.assertIn("swarmsmith recover", done.stderr)
        self.assertEqual(call("recover", self.file, "-o", self.new).returncode, 3)
        self.assertEqual(call("recover", self.damaged).returncode, 2)
        self.assertEqual(call("recover", self.damaged, "-o", self.store).returncode, 1)
        self.assertEqual(self.digest(self.store), self.wanted)


if __name__ == "__main__":
    unittest.main()
