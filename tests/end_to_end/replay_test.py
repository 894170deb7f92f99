"""Evaluations that worker processes have made, simulated again from the store alone."""
import csv
import json
import sqlite3
import unittest
import xml.etree.ElementTree as xml

from programs import ProgramTest, call, ended_well

SVG = "{http://www.w3.org/2000/svg}"


class Replay(ProgramTest):
    budget = 1400
    tests = 3

    def setUp(self):
        super().setUp()
        self.store = self.folder / "campaign.db"
        ended_well(self.run_campaign(self.store, "--workers", "2"))

    def winner_test(self):
        """Id, seed and score of the winner's first test evaluation."""
        sql = "SELECT id, seed, score FROM v_evaluations WHERE purpose = 'test' ORDER BY pair"
        row = self.query(self.store, sql)[0]
        return row["id"], row["seed"], row["score"]

    def test_what_workers_scored_comes_out_again_bit_by_bit(self):
        done = ended_well(call("replay", "--sample", 60, self.store, "--json"))
        self.assertEqual(json.loads(done.stdout),
                         {"replayed": 60, "same_bits": 60, "different": []})

    def test_a_run_is_written_down_as_table_and_picture(self):
        name, seed, score = self.winner_test()
        table, picture = self.folder / "run.csv", self.folder / "run.svg"
        done = ended_well(call("replay", name, self.store, "--csv", table, "--readings", "proximity",
                               "--svg", picture, "--json"))
        answer = json.loads(done.stdout)
        self.assertTrue(answer["same_bits"])
        self.assertEqual((answer["score"], answer["seed"]), (score, seed))
        with open(table, newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(len(rows), 3 * 1201)
        # Aggregation: robots on the black disc of 1 m at the end.
        inside = sum(float(row["x"]) ** 2 + float(row["y"]) ** 2 <= 0.25 for row in rows[-3:])
        self.assertEqual(inside, score)
        root = xml.parse(picture).getroot()
        texts = [element.text for element in root.iter(SVG + "text")]
        self.assertIn("aggregation", texts)
        self.assertTrue(any(f"seed {seed}" in text for text in texts), texts)
        self.assertLess(picture.stat().st_size, 200_000)

    def test_a_score_that_was_changed_is_found(self):
        name, _, score = self.winner_test()
        with sqlite3.connect(self.store) as store:
            store.execute("UPDATE evaluation SET score = score + 1 WHERE purpose = 2 AND pair = 1")
        store.close()
        done = call("replay", name, self.store)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"gives score {score:g}", done.stderr)
        self.assertIn(f"holds score {score + 1:g}", done.stderr)


if __name__ == "__main__":
    unittest.main()
