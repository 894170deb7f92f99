"""A campaign's report and supplement, by the real program."""
import hashlib
import html.parser
import json
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

from programs import SWARMSMITH, ProgramTest, call, ended_well


class Page(html.parser.HTMLParser):
    """What a browser would make of a page: tags, and what it would fetch."""

    FETCHING = {"src", "srcset", "href", "xlink:href", "action", "poster", "data", "background"}

    def __init__(self, text):
        super().__init__()
        self.tags = []
        self.fetched = []
        self.headings = []
        self.unnamed = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        values = dict(attributes)
        for name in self.FETCHING & set(values):
            if not values[name].startswith(("#", "data:")):
                self.fetched.append((tag, name, values[name]))
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        if tag == "th" and "scope" not in values:
            self.unnamed.append(self.get_starttag_text())
        if tag == "table" and "aria-labelledby" not in values:
            self.unnamed.append(self.get_starttag_text())


class Report(ProgramTest):
    budget = 1400
    tests = 5
    stores = {}

    def setUp(self):
        super().setUp()
        self.store = self.folder / "campaign.db"
        if "campaign" not in Report.stores:
            text = self.file.read_text().replace("seed = 7\n", "seed = 7\nrepetitions = 2\n")
            self.file.write_text(text)
            ended_well(self.run_campaign(self.store, "--workers", "2"))
            Report.stores["campaign"] = self.store.read_bytes()
        self.store.write_bytes(Report.stores["campaign"])

    def answer(self, *arguments, code=0, cwd=None):
        """Standard output, or the error: where everything is slow, there is progress beside the output."""
        done = call(*arguments, timeout=120, cwd=cwd)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def json_answer(self, *arguments, cwd=None):
        return json.loads(self.answer(*arguments, "--json", cwd=cwd))

    def test_the_report_is_one_page_that_asks_no_server(self):
        file = self.folder / "r.html"
        self.assertIn("r.html", self.answer("report", self.store, "-o", file))
        text = file.read_text()
        self.assertLess(len(text.encode()), 2_000_000)
        xml.etree.ElementTree.fromstring(text)
        page = Page(text)
        self.assertEqual(page.fetched, [])
        self.assertNotIn("script", page.tags)
        self.assertNotIn("link", page.tags)
        self.assertIn("svg", page.tags)
        self.assertEqual(page.unnamed, [])
        # Headings begin at the top and leave out no level.
        self.assertEqual(page.headings[0], 1)
        for before, after in zip(page.headings, page.headings[1:]):
            self.assertLessEqual(after, before + 1)
        for drawing in re.findall("<svg.*?</svg>", text, re.DOTALL):
            self.assertIn("<title>", drawing)
            self.assertIn("<desc>", drawing)
        self.assertEqual(self.answer("report", self.store, "-o", "-"), text)

    def test_the_report_says_what_the_store_says(self):
        text = self.answer("report", self.store, "-o", "-")
        self.assertIn(self.digest(self.store), text)
        for row in self.query(self.store, "SELECT design, best_candidate FROM v_designs"):
            self.assertIn(f"Design d{row['design']}:", text)
            self.assertIn(f"c{row['best_candidate']}", text)
        for row in self.query(self.store, "SELECT fsm_config FROM v_candidates AS c JOIN "
                                          "v_designs AS d ON d.best_candidate = c.candidate"):
            self.assertIn(row["fsm_config"], text)

    def test_the_report_refuses_what_it_cannot_write(self):
        self.assertIn("d9", self.answer("report", self.store, "--design", "d9", code=4))
        self.assertIn("such as d3", self.answer("report", self.store, "--design", "c1", code=2))
        self.assertIn("no such", self.answer("report", self.folder / "none.db", code=3))
        place = self.folder / "nowhere" / "r.html"
        self.assertIn("nowhere", self.answer("report", self.store, "-o", place, code=1))
        answer = self.json_answer("report", self.store, cwd=self.folder)
        self.assertEqual(answer["bytes"], (self.folder / answer["file"]).stat().st_size)
        self.assertIn("standard output",
                      self.answer("report", self.store, "--json", "-o", "-", code=2))

    def files_of(self, folder):
        return {str(path.relative_to(folder)): path.read_bytes()
                for path in sorted(folder.rglob("*")) if path.is_file()}

    def test_the_supplement_is_whole_and_the_same_each_time(self):
        first, second = self.folder / "first", self.folder / "second"
        self.answer("supplement", self.store, "-o", first)
        copy = self.folder / "copy.db"
        shutil.copy(self.store, copy)
        answer = self.json_answer("supplement", copy, "-o", f"{second}/")
        files = self.files_of(first)
        self.assertEqual(files, self.files_of(second))
        self.assertEqual(answer["files"], len(files))
        self.assertEqual(answer["pdfs"], shutil.which("rsvg-convert") is not None)
        for name in ("README.md", "SHA256SUMS", "campaign.toml", "report.html", "results.csv"):
            self.assertIn(name, files)
        self.assertEqual(len([name for name in files if name.startswith("controllers/")
                              and name.endswith(".txt")]), 2)
        drawings = [name for name in files if name.endswith(".svg")]
        self.assertTrue(drawings)
        if answer["pdfs"]:
            for name in drawings:
                self.assertTrue(files[name[:-3] + "pdf"].startswith(b"%PDF"), name)
        # Nothing but whole files under their own names.
        self.assertEqual({path.name for path in self.folder.iterdir() if path.is_dir()},
                         {"first", "second"})

    def test_checksums_cover_every_file(self):
        folder = self.folder / "supplement"
        self.answer("supplement", self.store, "-o", folder)
        ended_well(subprocess.run(["sha256sum", "-c", "--strict", "SHA256SUMS"], cwd=folder,
                                  capture_output=True, text=True, timeout=60))
        listed = dict(reversed(line.split("  ", 1))
                      for line in (folder / "SHA256SUMS").read_text().splitlines())
        files = self.files_of(folder)
        self.assertEqual(set(listed), set(files) - {"SHA256SUMS"})
        for name, checksum in listed.items():
            self.assertEqual(hashlib.sha256(files[name]).hexdigest(), checksum, name)

    def test_what_the_readme_says_works(self):
        folder = self.folder / "supplement"
        self.answer("supplement", self.store, "-o", folder)
        readme = (folder / "README.md").read_text()
        self.assertIn(self.digest(self.store), readme)
        self.assertIn("swarmsmith run campaign.toml", readme)
        ended_well(call("run", "campaign.toml", "--workers", "2", "-q", cwd=folder))
        self.assertEqual(self.digest(folder / "campaign.db"), self.digest(self.store))
        machines = sorted((folder / "controllers").glob("*.txt"))
        self.assertGreater(len(machines), 1)
        for machine in machines:
            design = re.match(r"d(\d+)-", machine.name).group(1)
            stored = [row["score"] for row in self.query(
                self.store, f"SELECT score FROM v_design_scores WHERE design = {design} AND purpose = 'test' "
                            "ORDER BY pair")]
            self.assertGreater(len(stored), 0)
            again = ended_well(call("evaluate", machine, "--json"))
            self.assertEqual([json.loads(line)["score"] for line in again.stdout.splitlines()], stored)

    def test_nothing_is_overwritten(self):
        there = self.folder / "there"
        there.mkdir()
        (there / "mine.txt").write_text("mine")
        for folder in (there, f"{there}/", self.file):
            self.assertIn("already exists",
                          self.answer("supplement", self.store, "-o", folder, code=2))
        self.assertEqual([path.name for path in there.iterdir()], ["mine.txt"])
        link = self.folder / "link"
        link.symlink_to(self.folder / "not-there")
        self.assertIn("already exists",
                      self.answer("supplement", self.store, "-o", link, code=2))

    def test_without_rsvg_convert_there_are_no_pdfs_and_that_is_said(self):
        programs = self.folder / "bin"
        programs.mkdir()
        done = ended_well(subprocess.run([SWARMSMITH, "supplement",
                                          str(self.store), "-o", str(self.folder / "plain")],
                                         capture_output=True, text=True, timeout=120,
                                         env={"PATH": str(programs)}))
        self.assertIn("librsvg2-bin", done.stderr)
        names = self.files_of(self.folder / "plain")
        self.assertFalse([name for name in names if name.endswith(".pdf")])
        self.assertNotIn(".pdf", names["README.md"].decode())


if __name__ == "__main__":
    unittest.main()
