"""Citations ("tracking facts, section 5") lead to a page of docs/reference and a section that it has; relative links of
Markdown pages lead to a file, and to a heading of it; files that pages and comments name by their path are there."""
import functools
import os
import pathlib
import re
import subprocess
import unittest
import urllib.parse
from collections import Counter

SOURCE = pathlib.Path(os.environ.get("SWARMSMITH_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
REFERENCE = "docs/reference"
# Words before "facts" that are pages, there or not; other words ("the facts") are prose unless a section follows.
PAGES = {"irace", "thesis", "simulator", "rvr-automode", "tracking", "orchestration", "methods", "ros", "epuck"}
SUFFIXES = {".h", ".cpp", ".py", ".proto", ".sql", ".md", ".R", ".cmake", ".toml", ".txt", ".sh", ".in"}
# Wrong citations stand in here to show that they are found.
OWN = pathlib.Path(__file__).name


# Which sections a page has.

def outside_fences(text):
    """The lines of a Markdown text with their numbers, without fenced blocks."""
    fence = None
    for number, line in enumerate(text.split("\n"), 1):
        mark = re.match(r"\s*(?:[-*]\s+)?(`{3,}|~{3,})", line)
        if mark and fence is None:
            fence = mark[1]
        elif mark and mark[1].startswith(fence) and line.strip() == mark[1]:
            fence = None
        elif fence is None:
            yield number, line


def sections_of(text):
    """Numbers of headings (`## 9. The race`, `### 9.3 One task`), of rules that begin with their whole number
    (`9.3.2 ...`, `- **9.3.2** ...`), and of lists below a numbered heading: `2. ...` under 9.3 is 9.3.2."""
    sections = set()
    above = ""
    for _, line in outside_fences(text):
        heading = re.match(r"#{1,6}\s+(.*)", line)
        if heading:
            number = re.match(r"(\d+(?:\.\d+)*)\.?(?=\s|$)", heading[1])
            above = number[1] if number else ""
            if number:
                sections.add(number[1])
            continue
        rule = re.match(r"\s*(?:\|\s*)?(?:[-*]\s+)?(?:\*\*|__)?(\d+(?:\.\d+)+)\.?(?:\*\*|__)?(?=[\s:|])", line)
        if rule:
            sections.add(rule[1])
        item = re.match(r"(\d+)[.)]\s", line)
        if item and above:
            sections.add(f"{above}.{item[1]}")
    return sections


# What a text cites.

NUMBER = r"\d+(?:\.\d+)*(?!\.?\d|[A-Za-z_%])"
QUOTED = r'(?:\s+"[^"]*")?'
# "sections 5 to 8 and 14", "6.1, 7", '5 "Order" and 10'; not a number that goes on with a unit or is half of "10 x 10".
LIST = rf"{NUMBER}{QUOTED}(?:(?:\s*,?\s*and\s+|\s*,\s*|\s+to\s+){NUMBER}{QUOTED}(?!\s*(?:x|mm|m|s|%)\b))*"
CITATION = re.compile(rf"(?<![\w-])(?:([A-Za-z][\w-]*)\s+)?facts\b(?:,\s+(sections?\s+)?({LIST}))?", re.I)


def without_comment_marks(text):
    """The same text with blanks for what begins a comment's line, so that a sentence goes on over lines; as long as
    before, so that places stay."""
    return re.sub(r"(?m)^[ \t]*(?:///?<?|#+(?= )|--|>)", lambda mark: " " * len(mark[0]), text)


def numbers_of(listed):
    """"5 to 8 and 14" as 5, 6, 7, 8, 14; "3.1 to 3.3" as 3.1, 3.2, 3.3."""
    words = re.findall(rf"{NUMBER}|\bto\b", re.sub(r'"[^"]*"', "", listed))
    numbers = []
    for i, word in enumerate(words):
        if word == "to":
            first, last = words[i - 1].split("."), words[i + 1].split(".")
            if first[:-1] == last[:-1]:
                numbers += [".".join([*first[:-1], str(n)]) for n in range(int(first[-1]) + 1, int(last[-1]))]
        else:
            numbers.append(word)
    return numbers


def citations_of(text):
    """(line, name or "", sections) of each citation."""
    plain = without_comment_marks(text)
    for found in CITATION.finditer(plain):
        name, section, listed = found[1] or "", found[2], found[3]
        is_page = name.lower() in PAGES
        if is_page or section:
            yield plain.count("\n", 0, found.start()) + 1, name.lower(), numbers_of(listed) if listed else []


def wrong_citations(text, page_sections):
    """(line, what was not found); `page_sections(name)` gives a page's sections, or None without a page."""
    for line, name, cited in citations_of(text):
        if name not in PAGES:
            yield line, f'"{name} facts" with a section names no page: one of {", ".join(sorted(PAGES))}'
            continue
        sections = page_sections(name)
        if sections is None:
            yield line, f"{name} facts: there is no {REFERENCE}/{name}.md"
            continue
        for number in cited:
            if number not in sections:
                yield line, f"{name} facts, {number}: {REFERENCE}/{name}.md has no such section"


# Where links lead to.

def without_code(line):
    """A line with blanks for what stands between backticks."""
    return re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", lambda code: " " * len(code[0]), line)


def anchors_of(text):
    """The anchors that GitHub gives to the headings of a Markdown text, and those of HTML."""
    anchors = set()
    given = {}
    for _, line in outside_fences(text):
        anchors.update(re.findall(r'<\w+\s[^>]*?\b(?:id|name)="([^"]+)"', line))
        heading = re.match(r" {0,3}#{1,6}\s+(.*?)(?:\s+#+)?\s*$", line)
        if not heading:
            continue
        title = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading[1])
        slug = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
        anchor = slug
        while anchor in given:
            given[slug] += 1
            anchor = f"{slug}-{given[slug]}"
        given[anchor] = 0
        anchors.add(anchor)
    return anchors


def links_of(text):
    """(line, target) of each link and picture of a Markdown text."""
    lines = [""] * (text.count("\n") + 1)
    for number, line in outside_fences(text):
        lines[number - 1] = without_code(line)
    plain = "\n".join(lines)
    inline = re.compile(r"\]\(\s*<?([^()\s<>]*(?:\([^()\s]*\)[^()\s]*)*)>?(?:\s+\"[^\"]*\")?\s*\)")
    defined = re.compile(r"(?m)^ {0,3}\[[^\]\n]+\]:\s+<?(\S+?)>?(?:\s+\"[^\"]*\")?\s*$")
    for pattern in (inline, defined):
        for found in pattern.finditer(plain):
            yield plain.count("\n", 0, found.start(1)) + 1, found[1]


def wrong_links(page, text, exists, read):
    """(line, what was not found) for the relative links of `page`, a path from the root; `exists` and `read` take
    such paths."""
    for line, link in links_of(text):
        if re.match(r"[a-zA-Z][\w+.-]*:|//", link):
            continue
        path, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), urllib.parse.unquote(path))) if path else page
        if target.startswith("..") or os.path.isabs(target) or not exists(target):
            yield line, f"{link}: there is no {target}"
        elif anchor and target.endswith(".md"):
            there = anchors_of(text if target == page else read(target))
            if urllib.parse.unquote(anchor) not in there:
                yield line, f"{link}: {target} has no heading #{anchor}"


# The tree.

ROOMS = ("analysis", "base", "benchmarks", "cli", "console", "coordinator", "docs", "examples", "irace_core", "programs",
         "proto", "sim", "storage", "tests", "tracking", "worker")
# Decisions and the changelog tell of their time; builds, readers of how-tos and tests make some files.
HISTORY = ("docs/decisions/", "docs/reference/", "CHANGELOG.md")
MADE = re.compile(r".*\.pb\.h|sim/mission/scores/(spread|KIND)\.|sim/mission/score_rule\.h|storage/internal/schema_files\.h|storage/schema/NNNN_name\.sql|cli/commands/simulated_figures\.h|irace_core/search/searches\.h|sim/control/modules?\.h|sim/control/conditions/obstacle_ahead\.h|irace_core/search/halving\.(cpp|h)|examples/missions/x\.toml")


def wrong_paths(text, files):
    """(line, path) of files that a text names from the root of the repository, and that are not there."""
    names = re.compile(r"(?<![\w./-])(?:" + "|".join(ROOMS) + r")/[\w./-]*\.(?:cpp|h|py|md|proto|sql|toml|R)\b")
    for number, line in enumerate(text.split("\n"), 1):
        for name in names.findall(line):
            if name not in files and not MADE.match(name):
                yield number, name


def tracked_files():
    """Paths from the root: what git knows, or, in a copy without git, what lies there."""
    done = subprocess.run(["git", "-C", str(SOURCE), "ls-files", "-z"], capture_output=True, check=False)
    if done.returncode == 0 and done.stdout:
        names = done.stdout.decode().split("\0")
        return sorted(name for name in names if name and (SOURCE / name).is_file())
    names = []
    for folder, folders, files in os.walk(SOURCE):
        folders[:] = [name for name in folders if not name.startswith((".", "build"))]
        names += [os.path.relpath(os.path.join(folder, name), SOURCE) for name in files]
    return sorted(names)


def text_of(name):
    return (SOURCE / name).read_text(encoding="utf-8", errors="replace")


@functools.lru_cache(maxsize=None)
def sections_of_page(name):
    page = SOURCE / REFERENCE / f"{name}.md"
    return sections_of(page.read_text(encoding="utf-8")) if page.is_file() else None


class Tree(unittest.TestCase):
    def assert_nothing_wrong(self, wrong):
        if wrong:
            self.fail(f"{len(wrong)} not found:\n" + "\n".join(wrong))

    def test_citations_lead_to_sections(self):
        wrong = []
        cited = Counter()
        for name in tracked_files():
            is_text = os.path.splitext(name)[1] in SUFFIXES or name == "dev"
            if not is_text or os.path.basename(name) == OWN:
                continue
            text = text_of(name)
            cited.update(page for _, page, _ in citations_of(text))
            wrong += [f"{name}:{line}: {what}" for line, what in wrong_citations(text, sections_of_page)]
        # Guards the search itself.
        for page in ("irace", "thesis", "rvr-automode", "simulator", "tracking", "orchestration"):
            self.assertGreater(cited[page], 4, f"{page} facts")
        self.assert_nothing_wrong(wrong)

    def test_paths_lead_to_files(self):
        files = set(tracked_files())
        found = {name: list(wrong_paths(text_of(name), files)) for name in sorted(files)
                 if pathlib.Path(name).suffix in SUFFIXES and not name.startswith(HISTORY)
                 and pathlib.Path(name).name not in (OWN, "debian_examples_test.cpp")}
        self.assertEqual({name: wrong for name, wrong in found.items() if wrong}, {})

    def test_links_lead_to_files_and_headings(self):
        wrong = []
        links = 0
        for name in tracked_files():
            if name.endswith(".md"):
                text = text_of(name)
                links += len(list(links_of(text)))
                found = wrong_links(name, text, lambda path: (SOURCE / path).exists(), text_of)
                wrong += [f"{name}:{line}: {what}" for line, what in found]
        self.assertGreater(links, 100)
        self.assert_nothing_wrong(wrong)


PAGE = """# Tracking facts
## 5. Offset
### 5.2 Spin
1. measure
2. solve
- **5.2.7** a rule
```
## 6. in a fence
```
## 7. Time
## 8. Gaps
10. the tenth
## Sources
3. none
"""


class Paths(unittest.TestCase):
    def test_what_is_not_there_is_reported_with_its_line(self):
        text = "see\n`docs/a.md`, tests/coordinator/gone_test.cpp and /usr/docs/b.md"
        self.assertEqual(list(wrong_paths(text, {"docs/a.md"})), [(2, "tests/coordinator/gone_test.cpp")])


class Citations(unittest.TestCase):
    def wrong(self, text, page=PAGE):
        pages = {"tracking": sections_of(page)}
        return [(line, what.split(":")[0]) for line, what in wrong_citations(text, pages.get)]

    def test_headings_and_rules_are_sections(self):
        self.assertEqual(sections_of(PAGE), {"5", "5.2", "5.2.1", "5.2.2", "5.2.7", "7", "8", "8.10"})

    def test_a_right_citation_is_found(self):
        for text in ("(tracking facts, section 5).", "Tracking facts, sections 5 and 8, measured", "tracking facts, 5.2.7)",
                     '// x (tracking facts, 5 "Limits" and 7). Not', "(tracking facts, sections 5, 7 and 8)",
                     "/// tracking\n/// facts, 5.2", "# tracking facts,\n# section 7", "tracking facts, the scene of [M]",
                     "tracking facts, 7 to 8: what"):
            with self.subTest(text):
                self.assertEqual(len(list(citations_of(text))), 1)
                self.assertEqual(self.wrong(text), [])

    def test_a_wrong_section_is_reported_with_its_line(self):
        for text, missing in (("(tracking facts, section 6)", "6"), ("tracking facts, 5.3", "5.3"),
                              ("tracking facts, sections 5 and 9", "9"), ("tracking facts, 5 to 8", "6"),
                              ('tracking facts, 5 "Limits" and 10', "10"), ("tracking facts, 5.2.3)", "5.2.3"),
                              ("tracking\n    /// facts, 55", "55"), ("tracking facts,\n  // section 80", "80"),
                              ("tracking facts, sections 5 and\n/// 81", "81"), ("TRACKING FACTS, section 4", "4")):
            with self.subTest(text):
                self.assertEqual(self.wrong("one\n/// " + text), [(2, f"tracking facts, {missing}")])

    def test_all_wrong_sections_of_one_citation_are_reported(self):
        self.assertEqual([what for _, what in self.wrong("tracking facts, sections 1 to 3, 5 and 6.1")],
                         [f"tracking facts, {number}" for number in ("1", "2", "3", "6.1")])

    def test_a_page_that_is_not_there_is_reported(self):
        self.assertEqual(self.wrong("/// thesis\n/// facts, 3"), [(1, "thesis facts")])
        self.assertEqual(self.wrong("as in the irace facts"), [(1, "irace facts")])

    def test_a_section_of_nothing_known_is_reported(self):
        for text in ("the simulation facts, section 3", "table 5.1 and facts, section 5)", "(facts, sections 1 and 2)"):
            with self.subTest(text):
                self.assertEqual(len(self.wrong(text)), 1)

    def test_prose_and_code_are_no_citations(self):
        for text in ("the same facts for logs", "scenario_reply_of(facts, 1)", "const PoolFacts& facts, 12",
                     "its facts: `worker`", "artifacts, section 3"):
            with self.subTest(text):
                self.assertEqual(list(citations_of(text)), [])


class Links(unittest.TestCase):
    FILES = {"README.md": "# A\n", "docs/a.md": "# Top\n## The `x_y` file, 2.5 m\n## Same\n## Same\n<a id=\"own\"></a>\n",
             "docs/figures/p.png": ""}

    def wrong(self, text):
        files = {**self.FILES, "docs/page.md": text}
        folders = {"docs", "docs/figures"}
        return [(line, what.split(":")[0]) for line, what
                in wrong_links("docs/page.md", text, lambda path: path in files or path in folders, files.get)]

    def test_anchors_are_those_of_github(self):
        self.assertEqual(anchors_of(self.FILES["docs/a.md"]),
                         {"top", "the-x_y-file-25-m", "same", "same-1", "own"})
        self.assertEqual(anchors_of("## *Who* is [blamed](x.md)? - Ärger & Co.\n```\n# no\n```\n## `--psrace`\n"),
                         {"who-is-blamed---ärger--co", "--psrace"})
        self.assertEqual(anchors_of("# a\n# a\n# a-1\n"), {"a", "a-1", "a-1-1"})

    def test_right_links_are_right(self):
        self.assertEqual(self.wrong("[a](a.md) [b](../README.md#a) ![p](figures/p.png) [own](#here)\n## Here\n"
                                    "[t](a.md#the-x_y-file-25-m \"title\") [two](a.md#same-1) [f](figures/)\n"
                                    "[web](https://example.org/x.md#y) `[code](gone.md)` [r][ref]\n\n[ref]: a.md#own\n"
                                    "```\n[fenced](gone.md)\n```\n[over\nlines](a.md)\n"), [])

    def test_wrong_links_are_reported_with_their_lines(self):
        for link in ("gone.md", "../docs/gone.md", "a.md#gone", "a.md#same-2", "#nowhere", "figures/q.png", "../../x",
                     "/etc/hosts", "README.md"):
            with self.subTest(link):
                self.assertEqual(self.wrong(f"one\n\n[x]({link})\n"), [(3, link)])
                self.assertEqual(self.wrong(f"one\n\n[x]: {link}\n"), [(3, link)])


if __name__ == "__main__":
    unittest.main()
