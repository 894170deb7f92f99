"""Reference pages have all that the programs know, and nothing else: docs/campaign-file.md with methods.md and
profiles.md the keys of campaign files, docs/http-api.md the paths and parameters of the dashboard, docs/storage.md the
schema and its views."""
import collections
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))

#: A key that no table has: what complains about it says which keys the table has.
STRANGER = "zzzzzzzz9"
ROUND = "shape = 'circle', diameter = 1"

#: The searches that have a table of their own, from their list.
SEARCHES = [name.replace("_", "-") for name in re.search(
    r"set\(searches\s+([^)]*)\)", (SOURCE / "irace_core/search/CMakeLists.txt").read_text())[1].split() if name != "irace"]
#: Evolution and CMA-ES search networks alone.
OF_SEARCHES = "".join(f'''[[method]]
name = "by-{name}"
architecture = "network"
search = "{name}"
{name} = {{ ? }}
''' for name in SEARCHES)

#: Files that lead the reader into each of its branches; a stranger goes into every table.
FILES = {
    "simulator": """
? [campaign]
[[mission]]
name = "x"
?
robot = { shape = "polygon", ? }
  [mission.arena]
  ?
  spots = [ { shape = "circle", x = 0, y = 0, ? }, { shape = "square", ? }, { shape = "rectangle", ? }, { shape = "image", ? } ]
  shuffled = { places = [ { side = 1, ? }, { width = 1, ? } ], colors = { red = 1 }, ? }
  obstacles = [ { shape = "circle", ? }, { shape = "square", ? }, { shape = "box", ? }, { shape = "polygon", ? } ]
  objects = [ { shape = "circle", ? } ]
  lights = [ { x = 0, y = 0, ? } ]
  [mission.score]
  kind = "robots_on"
  ?
  [mission.instances]
  ?
  training = { placement = "uniform", ? }
  test = { ? }
[[mission]]
name = "y"
  [mission.score]
  kind = "coverage"
  ?
  [mission.instances]
  training = { placement = "rectangle", ? }
[[mission]]
name = "z"
  [mission.score]
  kind = "color_reward"
  ?
  [mission.instances]
  training = { placement = "fixed", poses = [ { x = 0, y = 0, ? } ], ? }
[[mission]]
name = "objects"
score = { kind = "objects_on", ? }
[[mission]]
name = "foraging"
score = { kind = "foraging", ? }
[[mission]]
name = "fullest"
score = { kind = "most_on", ? }
[[mission]]
name = "formula"
score = { kind = "formula", ? }
[[method]]
name = "machines"
?
parameters = { exploration = { tau = { ? } } }
[[method]]
name = "networks"
architecture = "network"
network = { ? }
@SEARCHES@
[race]
?
[simulator]
?
[simulator.profile]
name = "own"
?
proximity = { ? }
ground_color = { labels = ["red"], ? }
light = { ? }
lidar = { ? }
neighbours = { ? }
timing = { delays = [ { time = "10 ms", ? } ], ? }
treads = { sd = { run = [0, 0.1], ? }, ? }
tracking = { ? }
[tests]
?
[[tests.profile]]
name = "other"
[workers]
?
slurm = { ? }
ssh = { ? }
[dashboard]
?
""",
    "programs": """
[simulator]
kind = "command"
?
[[mission]]
name = "a"
?
  [mission.instances]
  ?
[[mission]]
name = "b"
instances = { test = { ? } }
[[method]]
name = "m"
parameters_text = 'x "" r (0, 1)'
?
""",
}


def known_keys():
    """The keys that the reader knows, by table: "" of the whole file, "mission.arena", ..."""
    known = collections.defaultdict(set)
    with tempfile.TemporaryDirectory(prefix="swarmsmith-reference-") as folder:
        for name, text in FILES.items():
            text = text.replace("? [campaign]", f"{STRANGER} = 1\n[campaign]\n?").replace("@SEARCHES@\n", OF_SEARCHES)
            asked = text.count("?") + text.count(f"{STRANGER} = 1")
            file = pathlib.Path(folder) / f"{name}.toml"
            file.write_text("format = 1\n" + text.replace("?", f"{STRANGER} = 1"))
            done = subprocess.run([BIN / "swarmsmith", "check", file], capture_output=True, text=True, timeout=60 * PATIENCE)
            said = re.findall(rf"(\S+) has no key `{STRANGER}`; known are: (.*)$", done.stderr, re.M)
            if len(said) != asked:
                raise AssertionError(f"{name}: {asked} tables were asked for their keys, {len(said)} told:\n{done.stderr}")
            for table, keys in said:
                known["" if table == "file" else table.strip("[]")].update(keys.split(", "))
    return known


def names_in(text):
    """The names between backticks, or before "=" in code between braces."""
    names = set()
    for code in re.findall(r"`([^`]+)`", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)):
        if "{" in code:
            code = re.sub(r'"[^"]*"|\([^)]*\)', "", code)
            names.update(re.findall(r"(?:^|[{,])\s*([a-z_]+)\s*(?=[=,}]|$)", code))
        else:
            names.update(re.findall(r"^\.?([a-z][\w-]*)(?: ?= ?.*)?$", code))
    return names


class Page:
    """A page's sections by heading, and the keys of its tables by the table of the file."""

    def __init__(self, name):
        text = (SOURCE / "docs" / name).read_text()
        parts = re.split(r"^##+ (.*)$", text, flags=re.M)
        self.sections = dict(zip(parts[1::2], parts[2::2]))
        self.keys = collections.defaultdict(set)
        for heading, section in self.sections.items():
            own = re.match(r"`\[+([\w.]+)\]+`", heading)
            self.read_tables(own[1] if own else "", section)

    def read_tables(self, table, section):
        for header, rows in re.findall(r"^\| (.*) \|\n\|[ |-]*\|\n((?:\|.*\n)+)", section, re.M):
            columns = header.split(" | ")
            named = re.match(r"key of `\[+([\w.-]+)\]+`", columns[0])
            if named or "key" in columns:
                column = 0 if named else columns.index("key")
                for row in rows.splitlines():
                    self.read_cell(named[1] if named else table, re.split(r" ?\| ?", row)[column + 1])

    def read_cell(self, table, cell):
        """`a`, `b`, or, of tables within the table, `training.x`, `.y`."""
        inner = ""
        for key in re.findall(r"`([\w.-]+)`", cell):
            if "." in key:
                inner = key.rpartition(".")[0] or inner
                key = key.rpartition(".")[2]
            self.keys[f"{table}.{inner}" if inner else table].add(key)


class CampaignFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = known_keys()
        cls.page = Page("campaign-file.md")

    def assert_same(self, table, documented, *within):
        """`within`: tables in it that have headings, or pages, of their own."""
        self.assertEqual(sorted(self.known[table]), sorted(documented | set(within)), f"[{table}]")

    def test_of_the_tables_with_tables(self):
        keys = self.page.keys
        headings = [re.match(r"`\[+([\w.]+)\]+`", heading) for heading in self.page.sections]
        tables = {heading[1] for heading in headings if heading}
        self.assert_same("", keys[""] | {table for table in tables if "." not in table})
        for table in ("campaign", "race"):
            self.assert_same(table, keys[table])
        self.assert_same("mission", keys["mission"], "arena", "score", "instances")
        self.assert_same("mission.arena", keys["mission.arena"])
        self.assert_same("mission.score", keys["mission.score"], "kind", "maximize")
        self.assert_same("mission.instances.test", keys["mission.instances.test"])
        self.assert_same("mission.instances.training", keys["mission.instances.training"])
        self.assert_same("method", keys["method"], "parameters", "parameters_text", "configurations", "configurations_text",
                         "network", *SEARCHES)
        self.assert_same("simulator", keys["simulator"])
        self.assert_same("tests", keys["tests"])
        self.assert_same("workers", keys["workers"])

    def test_of_instances_of_programs(self):
        # Tables of one name are two kinds of tables: the page has both.
        self.assert_same("mission.instances", {"training", "training_file", "test", "test_file"})
        for key in self.known["mission.instances"]:
            self.assertRegex(self.page.sections["Programs that evaluate"], rf"\n\| `{key}` \|")

    def test_of_what_is_told_in_sentences(self):
        arena = names_in(self.page.sections["`[mission.arena]`"])
        within = [table for table in self.known if table.startswith("mission.arena.")] + ["mission.robot"]
        self.assertEqual(len(within), 7)
        for table in within:
            self.assertLessEqual(self.known[table], arena, table)
        # And of the sentences nothing is made up.
        told = set().union(*(names_in(code) for code in re.findall(r"`[^`]*\{[^`]*\}`", self.page.sections["`[mission.arena]`"])))
        known = set().union(*(self.known[table] for table in within), {"red", "green", "shuffled"})
        self.assertGreater(len(told), 10)
        self.assertLessEqual(told, known)
        workers = self.page.sections["`[workers]`"]
        for table in ("slurm", "ssh"):
            row = re.search(rf"^\| `{table}` \|.*$", workers, re.M)[0]
            self.assertEqual(self.known[f"workers.{table}"], names_in(row) - {table}, table)
        self.assertEqual(self.known["dashboard"], names_in(self.page.sections["`[dashboard]`"]) - {"run", "serve"})
        poses = re.search(r"^\| `training.poses` \|.*$", self.page.sections["`[mission.instances]`"], re.M)[0]
        self.assertLessEqual(self.known["mission.instances.training.poses"] - {"theta"}, names_in(poses))

    def test_of_searches(self):
        keys = Page("methods.md").keys
        for search in SEARCHES:
            self.assert_same(f"method.{search}", keys[f"method.{search}"])
        network = re.search(r"\[method\.network\]\n((?:\w+ +=.*\n)+)", (SOURCE / "docs/methods.md").read_text())[1]
        self.assert_same("method.network", set(re.findall(r"^\w+", network, re.M)))

    def test_of_profiles(self):
        page = Page("profiles.md")
        rows = re.findall(r"^\| (`\[(\w+)\]`)? *\| ((?:`\w+`(?:, )?)+) \|", page.sections["Fields"], re.M)
        documented, table = collections.defaultdict(set), ""
        for _, begins, cell in rows:
            table = begins or table
            documented[table].update(re.findall(r"`(\w+)`", cell))
        self.assertGreater(len(documented), 6)
        for table in documented:
            if table:
                self.assert_same(f"simulator.profile.{table}", documented[table])
        self.assert_same("simulator.profile", documented[""] | set(documented) - {""}, "name", "base")
        delays = re.search(r"^\|.*\| `delays` \|.*$", page.sections["Fields"], re.M)[0]
        self.assertEqual(self.known["simulator.profile.timing.delays"], names_in(re.search(r"`\{.*?\}`", delays)[0]))

    def test_every_key_in_the_sources_was_asked_for(self):
        """The files above lead into every branch: no reader has a key that none of them came to."""
        calls = re.compile(r"(?:(?:\w\.|->)(?:boolean|integer|number|text|choice|seconds|date|texts|interval|number_rows|tables?|take|has)"
                           r"\(|\b(?:need\((?!field)|read_(?:color|program|word|instances)\()\w+,)\s*\"([a-z][\w-]*)\"")
        known = set().union(*self.known.values())
        found = {}
        for folder in ("coordinator/campaign", "sim/files"):
            for path in sorted((SOURCE / folder).rglob("*.cpp")):
                if path.name != "machine_file.cpp":
                    text = re.sub(r"#include.*", "", path.read_text())
                    found.update({key: path.name for key in calls.findall(text)})
        self.assertGreater(len(found), 70)
        self.assertEqual({key: name for key, name in found.items() if key not in known}, {})


class Http(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = (SOURCE / "docs/http-api.md").read_text()
        cls.sources = {path.name: path.read_text() for path in (SOURCE / "cli/dashboard").glob("*.cpp")}
        cls.routes = {path for name, path in cls.routes_of(cls.sources["routes.cpp"] + cls.sources["dashboard.cpp"])}

    @staticmethod
    def routes_of(source):
        """("GET", "c1/designs/*") of each path that the dashboard answers."""
        listed = re.search(r"kRoutes = \{\{(.*?)\}\};", source, re.S)[1]
        for path in re.findall(r'\{"([^"]*)", \w+', listed):
            yield "GET", "c1/" + path if path else "c1"
        for path in re.findall(r'first == "(\w+)"', source):
            yield "GET", path
        for path in re.findall(r'if \(path == "(\w+)"\)', source):
            yield "GET", "c1/" + path

    @staticmethod
    def pattern_of(path):
        """As the sources write it: `c1/designs/d3/race?iteration=8` is c1/designs/*/race."""
        path = path.split("?")[0]
        path = re.sub(r"(?<=designs/)d3|(?<=candidates/)c812|(?<=evaluations/)e81200007|(?<=runs/)ID", "*", path)
        return re.sub(r"(?<=figures/)KIND\.(?:svg|csv)|(?<=comparison/)(?:\w+\.csv|matrix)", "*", path)

    def test_every_path_is_on_the_page(self):
        questions = self.text.split("## Questions: GET")[1].split("\n## ")[0]
        written = re.findall(r"^### .*$|^`c1/.*?`|^\| `c1/.*?` \|", questions, re.M)
        paths = {self.pattern_of(path) for line in written for path in re.findall(r"`([^`]+)`", line)}
        self.assertGreater(len(self.routes), 20)
        self.assertEqual(sorted(paths), sorted(self.routes))

    def test_every_act_is_on_the_page(self):
        words = re.search(r"for \(const CommandKind kind :\s*\{([^}]*)\}", self.sources["routes.cpp"])[1]
        acts = {word.lower() for word in re.findall(r"CommandKind::(\w+)", words)}
        self.assertEqual(len(acts), 4)
        table = self.text.split("## Acts: POST")[1].split("\n\n")[1]
        paths = {path.split("?")[0] for path in re.findall(r"`(c1/[^`]*)`", table)}
        of_all = {"pause", "resume"}
        self.assertEqual(paths, {f"c1/designs/d3/{act}" for act in acts} | {f"c1/{act}" for act in of_all})

    def test_every_parameter_is_on_the_page(self):
        asked = set()
        for text in self.sources.values():
            asked.update(re.findall(r'(?:question\.(?:text|integer)|integer_parameter)\((?:request\.parameters, )?"(\w+)"', text))
            asked.update(re.findall(r'parameters\.find\("(\w+)"\)', text))
        self.assertGreater(len(asked), 15)
        in_paths = {name for query in re.findall(r"`[^`\n]*\?([^`\s]*)`", self.text) for name in re.findall(r"(?:^|&)(\w+)=", query)}
        self.assertGreater(len(in_paths), 8)
        self.assertLessEqual(in_paths, asked | {"design", "by", "purpose", "per"})
        self.assertLessEqual(asked, in_paths | names_in(self.text))


class Storage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = (SOURCE / "docs/storage.md").read_text()

    def test_the_schema_is_the_present_one(self):
        version = re.search(r"kSchemaVersion = (\d+);", (SOURCE / "storage/internal/schema.h").read_text())[1]
        self.assertEqual(re.search(r"`PRAGMA user_version`, now (\d+)", self.text)[1], version)
        self.assertEqual(re.search(r"^\| schema \| brought \|\n.*\n\| (\d+) \|", self.text, re.M)[1], version)

    def test_every_column_of_every_view_is_on_the_page(self):
        listed = re.search(r"kColumns\{(.*?)^\};", (SOURCE / "tests/storage/views_test.cpp").read_text(), re.S | re.M)[1]
        sections = re.split(r"^###+ ", re.search(r"^## Views\n(.*?)^## ", self.text, re.S | re.M)[1], flags=re.M)
        missing = {}
        views = re.findall(r'\{"(v_\w+)",([^}]*)\}', listed)
        self.assertGreater(len(views), 30)
        for view, columns in views:
            told = " ".join(section for section in sections if re.search(rf"\b{view}\b", section))
            lacks = [column for column in re.findall(r"\w+", columns) if not re.search(rf"\b{column}\b", told)]
            missing.update({view: lacks} if lacks else {})
        self.assertEqual(missing, {})


if __name__ == "__main__":
    unittest.main()
