"""Tests of winners under further profiles: one answer, clean, and the figures and tables right."""
import csv
import io
import unittest
from collections import defaultdict
from statistics import fmean

from programs import ProgramTest, call, campaign_text, ended_well

EVOSTICK = 'name = "evostick"\nmethod = "evostick"\n  [method.evolution]\n  population = 20\n  runs = 5\n  final_runs = 10'


class Transfer(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file.write_text(campaign_text(
            1500, seed=5, tests=12, name="gap", repetitions=2, missions=("aggregation", "color_selection"), duration="10 s",
            methods=['name = "machine"', EVOSTICK], profile=None,
            more='\n[tests]\nprofiles = ["rvr", "pseudo-reality"]\n'))
        self.store = self.folder / "one.db"
        ended_well(self.run_campaign(self.store, "--workers", "1"))

    def test_one_answer_and_clean(self):
        other = self.folder / "three.db"
        ended_well(self.run_campaign(other, "--workers", "3"))
        self.assertEqual(self.digest(self.store), self.digest(other))
        ended_well(call("verify", other, "--sample", "50"))
        self.runs_are_paired()
        self.one_can_be_looked_at()
        self.table_is_right()
        self.figure_has_pairs()
        self.casual_evaluations_change_no_figure()

    def runs_are_paired(self):
        rows = self.query(self.store, "SELECT design, candidate, seed, purpose, source, pair"
                          " FROM v_evaluations WHERE purpose IN ('test', 'transfer')")
        by_source = defaultdict(set)
        for row in rows:
            by_source[row["source"]].add((row["design"], row["candidate"], row["seed"]))
            self.assertEqual(row["source"] == "rvr", row["purpose"] == "test")
            self.assertEqual(row["pair"] > 12, row["purpose"] == "transfer")
        self.assertEqual(len(by_source["rvr"]), 8 * 12)
        self.assertEqual(by_source["rvr"], by_source["pseudo-reality"])

    def one_can_be_looked_at(self):
        evaluation = self.query(self.store, "SELECT id, score FROM v_evaluations"
                                " WHERE purpose = 'transfer' ORDER BY candidate, pair LIMIT 1")[0]
        done = ended_well(call("replay", evaluation["id"], "--store", self.store))
        self.assertIn("same bits as stored", done.stdout)
        done = call("explain", evaluation["id"], "--store", self.store)
        self.assertIn("under a further profile", done.stdout)

    def table_is_right(self):
        rows = self.query(self.store, "SELECT mission, method, design, source, score"
                          " FROM v_design_scores")
        runs = defaultdict(list)
        for row in rows:
            runs[row["mission"], row["method"], row["design"], row["source"]].append(row["score"])
        drops = defaultdict(list)
        for (mission, method, design, source), scores in runs.items():
            if source == "rvr":
                there = runs[mission, method, design, "pseudo-reality"]
                drops[mission, method].append(fmean(there) - fmean(scores))
        done = ended_well(call("compare", self.store, "--by", "source", "--csv"))
        pairs = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual(len(pairs), 4)
        for pair in pairs:
            self.assertEqual((pair["first"], pair["second"]), ("pseudo-reality", "rvr"))
            self.assertAlmostEqual(float(pair["mean_difference"]),
                                   fmean(drops[pair["mission"], pair["method"]]))

    def figure_has_pairs(self):
        picture = self.folder / "box.svg"
        ended_well(call("figure", "box", self.store, "--by", "method", "-o", picture))
        svg = picture.read_text()
        self.assertIn("narrow boxes: rvr; wide boxes: pseudo-reality", svg)
        self.assertEqual(svg.count(">evostick<"), 2, "one name below the two boxes of a mission")

    def casual_evaluations_change_no_figure(self):
        def told():
            table = self.folder / "told.csv"
            texts = [call("compare", self.store, "--by", "source", "--csv").stdout]
            for kind in ("box", "gap"):
                ended_well(call("figure", kind, self.store, "-o", table))
                texts.append(table.read_text())
            return texts
        before = told()
        for profile in ("rvr", "pseudo-reality"):
            ended_well(call("evaluate", "best", self.store, "--profile", profile, "--seeds", "501-503"))
        later = self.query(self.store, "SELECT count(*) AS n FROM v_evaluations WHERE purpose = 'score'")
        self.assertEqual(later, [{"n": 8 * 2 * 3}])
        self.assertEqual(told(), before)


if __name__ == "__main__":
    unittest.main()
