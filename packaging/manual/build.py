#!/usr/bin/python3
"""build.py BIN SITE: writes the manual as pages of HTML, for a browser and from a disk: the pages of docs/ in the order
of docs/README.md, and pages made of what the programs in BIN and the store's schema declare. Needs mkdocs and its theme
material; nothing is fetched from anywhere."""
import contextlib
import json
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
sys.path.insert(0, str(HERE.parent))
import programs  # noqa: E402

#: Pages from elsewhere, and where they are in the manual. Others keep their places below docs/.
MOVED = {"README.md": "readme.md", "CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md",
         "docs/README.md": "index.md"}
FENCE = re.compile(r"\s*(?:[-*]\s+)?(`{3,}|~{3,})(.*)")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(\s*([^()\s]+)((?:\s+\"[^\"]*\")?)\s*\)")


# Converts Markdown for GitHub to Markdown for mkdocs.

def anchor_of(title, given):
    """The anchor of a heading, as GitHub gives it; `given` counts those of the page."""
    title = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", title)
    slug = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
    anchor = slug
    while anchor in given:
        given[slug] += 1
        anchor = f"{slug}-{given[slug]}"
    given[anchor] = 0
    return anchor


def relinked(text, relink):
    """The page with `relink` of each link that is not code. A link may go over two lines."""
    code = re.compile(r"^ *(?:[-*] +)?(`{3,}|~{3,})[^\n]*\n.*?^ *\1 *$|^ {4}[^\n]*$|(`+)(?!`)[^\n]*?(?<!`)\2(?!`)", re.M | re.S)
    kept = []

    def aside(found):
        kept.append(found[0])
        return f"\0{len(kept) - 1}\0"
    whole = LINK.sub(relink, code.sub(aside, text))
    return re.sub("\0(\\d+)\0", lambda place: kept[int(place[1])], whole)


def converted(text, relink):
    """The page with GitHub's anchors, lists and tables after an empty line, and `relink`ed links."""
    lines = []
    given = {}
    fence = None
    in_list = False
    for line in relinked(text, relink).split("\n"):
        mark = FENCE.match(line)
        if fence is not None:
            if mark and mark[1].startswith(fence) and not mark[2].strip():
                fence = None
            lines.append(line)
            continue
        if mark:
            fence = mark[1]
            # "toml file=x.toml" is information for tests: the file in which they write the block.
            language = (mark[2].split() or ["text"])[0]
            lines.append(line[:mark.start(2)] + {"sh": "bash"}.get(language, language))
            continue
        before = lines[-1] if lines else ""
        item = re.match(r"( *)(?:[-*]|\d+[.)]) ", line)
        nested = item and item[1]
        if line.strip() and not line.startswith(" "):
            in_list = bool(item)
        elif in_list and re.match(r" {2,3}\S", line):  # text or a list inside an item
            line = "    " + line.lstrip()
        if before.strip() and not before.startswith((" ", "|", ">", "#")):
            is_list = item and not nested and not re.match(r"(?:[-*]|\d+[.)]) ", before)
            if is_list or (line.startswith("|") and not before.startswith("|")):
                lines.append("")
        heading = re.match(r" {0,3}(#{1,6})\s+(.*?)(?:\s+#+)?\s*$", line)
        if heading:
            line = f"{heading[1]} {heading[2]} {{#{anchor_of(heading[2], given)}}}"
        lines.append(line)
    return "\n".join(lines)


def title_of(text):
    return re.sub(r"[`*]", "", re.search(r"^# (.*?)(?: \{#.*\})?$", text, re.M)[1])


class Stage:
    """A folder with the pages as mkdocs wants them."""

    def __init__(self, folder):
        self.folder = folder
        self.pages = {f"docs/{path.relative_to(SOURCE / 'docs').as_posix()}":
                      path.relative_to(SOURCE / "docs").as_posix() for path in sorted((SOURCE / "docs").rglob("*.md"))}
        self.pages.update(MOVED)
        self.titles = {place: title_of((SOURCE / page).read_text()) for page, place in self.pages.items()}
        self.made = []
        self.made_after = {}  # by the page after which they come

    def place_of(self, target):
        """Where a file of the repository is in the manual, copied there if it is not a page; None for a folder."""
        if target in self.pages:
            return self.pages[target]
        if target.rstrip("/") == "docs/decisions":
            return "decisions/index.md"
        source = SOURCE / target
        if not source.is_file():
            return None
        place = target.removeprefix("docs/") if target.startswith("docs/") else f"files/{target}"
        (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, self.folder / place)
        return place

    def relink(self, page):
        here = os.path.dirname(self.pages[page])

        def changed(link):
            picture, text, target, title = link.groups()
            if re.match(r"[a-zA-Z][\w+.-]*:|//|#", target):
                return link[0]
            path, _, anchor = target.partition("#")
            place = self.place_of(os.path.normpath(os.path.join(os.path.dirname(page), path)))
            if place is None:  # a folder of the repository, which is not part of the manual
                return text
            new = os.path.relpath(place, here or ".") + (f"#{anchor}" if anchor else "")
            if re.fullmatch(r"[\w/.-]+\.md", text):  # the name of a file is less informative than the title of the page
                text = self.titles[place]
            return f"{picture}[{text}]({new}{title})"
        return changed

    def write(self, place, text):
        (self.folder / place).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / place).write_text(text)
        self.titles[place] = title_of(text)

    def write_pages(self):
        for page, place in self.pages.items():
            text = (SOURCE / page).read_text()
            self.write(place, converted(text, self.relink(page)))
        decisions = sorted(place for place in self.pages.values() if place.startswith("decisions/"))
        rows = "\n".join(f"- [{self.titles[place]}]({os.path.basename(place)})" for place in decisions)
        self.write("decisions/index.md", f"# Decisions\n\nWhy things are as they are, oldest first.\n\n{rows}\n")

    def navigation(self):
        """The sections of docs/README.md with their pages, first to last."""
        sections = []
        seen = set()
        for line in (SOURCE / "docs/README.md").read_text().split("\n"):
            heading = re.match(r"##+ (.*)", line)
            if heading:
                sections.append((heading[1], []))
            for text, target in re.findall(r"\[([^\]]*)\]\(([^)#\s]+)\)", line if sections else ""):
                place = self.place_of(os.path.normpath(os.path.join("docs", target)))
                if place and place.endswith(".md") and place not in seen:
                    seen.add(place)
                    sections[-1][1].append((text, place))
                    if place in self.made_after:
                        sections[-1][1].append(self.made_after[place])
        seen.update(self.made)
        # Decisions come below their list.
        listed = [(title, [*pages]) for title, pages in sections if pages]
        for _, pages in listed:
            at = next((i for i, (_, place) in enumerate(pages) if place == "decisions/index.md"), None)
            if at is not None:
                rest = sorted(place for place in self.titles if re.match(r"decisions/\d", place))
                seen.update(rest)
                pages[at] = ("Decisions", [("All", "decisions/index.md"), *((self.titles[p], p) for p in rest)])
        lost = set(self.titles) - seen - {"index.md", "readme.md"}
        if lost:
            raise SystemExit(f"build.py: in no section of docs/README.md: {', '.join(sorted(lost))}")
        return listed


# Generated pages.

def cell(text):
    return re.sub(r"\s+", " ", text).replace("|", "\\|").replace("<", "&lt;").strip()


def prose(text):
    """Help as Markdown: filled paragraphs, and blocks whose lines stay."""
    blocks = []
    for kind, block in programs.paragraphs(text):
        blocks.append(re.sub(r"([*_<])", r"\\\1", block) if kind == "text"
                      else "```text\n" + "\n".join(block) + "\n```")
    return "\n\n".join(blocks)


def option_rows(options):
    rows = ["| option | means |", "| --- | --- |"]
    for option in options:
        names = ", ".join(option["names"])
        value = f" {option['value']}" if option["value"] else ""
        notes = [note for note, is_so in (("must be given", option["required"] and not option["word"]),
                                          ("repeatable", option["repeats"])) if is_so]
        help_text = cell(option["help"]).replace("*", "\\*").replace("_", "\\_")
        rows.append(f"| `{cell(names + value)}` | {help_text}{' (' + ', '.join(notes) + ')' if notes else ''} |")
    return "\n".join(rows)


def program_page(tells):
    parts = [f"# {tells['program'].replace(' ', '-')}", prose(tells["purpose"]), prose(tells["begin"]),
             "This page is made of the options that the program declares, like its `--help` and its man pages."]
    common = None
    for command in tells["commands"]:
        if command["name"]:
            parts.append(f"## {command['name']}\n\n{cell(command['summary'])}.")
        if command["another_program"]:
            name = programs.page_name(tells["program"], command["name"])
            parts.append(f"This command becomes the program [{name}]({name}.md).")
            continue
        parts.append("```text\n" + " ".join(programs.synopsis(tells["program"], command)) + "\n```")
        options = [option for option in command["options"] if option["names"][-1] != "--help"]
        if common is None and command["name"]:
            common = [option for option in options
                      if option["names"][-1] in ("--json", "--quiet", "--verbose", "--no-color")]
        rows = [option for option in options if option not in (common or [])]
        if rows:
            parts.append(option_rows(rows))
        before, examples, after = programs.examples_of(command["details"])
        parts += [prose(before), "```bash\n" + "\n".join(examples) + "\n```" if examples else "", prose(after)]
    if common:
        parts.insert(4, "Every command takes these as well, but `irace`, which has its own:\n\n" + option_rows(common)
                     if "irace" in [command["name"] for command in tells["commands"]]
                     else "Every command takes these as well:\n\n" + option_rows(common))
    return "\n\n".join(part for part in parts if part) + "\n"


def schema(bin_folder):
    """The schema of a store, as the program makes it."""
    connection = sqlite3.connect(":memory:")
    with tempfile.TemporaryDirectory() as folder:
        machine, store = pathlib.Path(folder, "machine.txt"), pathlib.Path(folder, "one.db")
        machine.write_text("--nstates 1 --s0 1\n")
        subprocess.run([pathlib.Path(bin_folder, "swarmsmith"), "import", machine, "--into", store, "--flavour", "watermelon",
                        "--mission", "aggregation"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with contextlib.closing(sqlite3.connect(store)) as made:
            made.backup(connection)
    return connection


def views_page(bin_folder):
    """The public views with their columns and definitions."""
    connection = schema(bin_folder)
    parts = ["# Views of the store",
             "This page is made of the schema that the programs carry. [The store](storage.md#views) "
             "explains the columns; `swarmsmith query` prints the same list."]
    views = connection.execute("SELECT name, sql FROM sqlite_schema WHERE type = 'view' AND name LIKE 'v\\_%' ESCAPE '\\' "
                               "ORDER BY name").fetchall()
    for name, sql in views:
        columns = [row[1] for row in connection.execute(f"PRAGMA table_info({name})")]
        parts.append(f"## {name}\n\n" + ", ".join(f"`{column}`" for column in columns) + f"\n\n```sql\n{sql};\n```")
    return "\n\n".join(parts) + "\n"


def write_made_pages(stage, bin_folder):
    pages = []
    for program in programs.built(bin_folder):
        pages.append((program, f"{program}.md"))
        stage.write(pages[-1][1], converted(program_page(programs.declared(bin_folder, program)), lambda link: link[0]))
    stage.write("views.md", converted(views_page(bin_folder), lambda link: link[0]))
    stage.made = [*[place for _, place in pages], "views.md"]
    stage.made_after = {"command-line.md": ("Options", pages), "storage.md": ("Views", "views.md")}


# The site.

def yaml_of(navigation):
    """mkdocs' `nav`; JSON is YAML."""
    def entry(title, what):
        return {title: what if isinstance(what, str) else [entry(*page) for page in what]}
    return json.dumps([{"Home": "index.md"}, *(entry(*section) for section in navigation)], indent=1)


def make_search_work_from_disk(site):
    """Index and worker as scripts that pages load; see search_from_disk.js."""
    worker = next((site / "assets/javascripts/workers").glob("search.*.js")).read_text()
    worker = json.dumps(re.sub(r"//# sourceMappingURL=.*", "", worker))
    script = (HERE / "search_from_disk.js").read_text().replace("WORKER", worker)
    (site / "search/from_disk.js").write_text(script)
    (site / "search/search_index.js").write_text("var __index = " + (site / "search/search_index.json").read_text())


def name_first_page(site):
    """Links to the first page name a folder; from a disk that would list it."""
    for path in site.rglob("*.html"):
        path.write_text(re.sub(r'href="(\.|\.\.(?:/\.\.)*)"', r'href="\1/index.html"', path.read_text()))


def build(bin_folder, site):
    with tempfile.TemporaryDirectory(prefix="swarmsmith-manual-") as name:
        work = pathlib.Path(name)
        stage = Stage(work / "docs")
        stage.folder.mkdir()
        write_made_pages(stage, bin_folder)
        stage.write_pages()
        (work / "mkdocs.yml").write_text(
            f"INHERIT: {HERE / 'mkdocs.yml'}\ndocs_dir: {stage.folder}\nsite_dir: {work / 'site'}\n"
            f"theme: {{custom_dir: {HERE / 'theme'}}}\ncopyright: Swarmsmith {programs.version(bin_folder)}\nnav: {yaml_of(stage.navigation())}\n")
        done = subprocess.run(["mkdocs", "build", "-f", work / "mkdocs.yml"], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stdout + done.stderr)
        make_search_work_from_disk(work / "site")
        name_first_page(work / "site")
        # Site maps are for servers, and contain the time of the build.
        for site_map in (work / "site").glob("sitemap.xml*"):
            site_map.unlink()
        shutil.rmtree(site, ignore_errors=True)
        shutil.copytree(work / "site", site)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    build(sys.argv[1], pathlib.Path(sys.argv[2]))
