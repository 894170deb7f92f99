#!/usr/bin/python3
"""man_pages.py BIN FOLDER: writes man pages of the programs in BIN, a page a program and a page a command:
swarmsmith.1, swarmsmith-run.1, ..., swarmsmith-track-calibrate-camera.1."""
import os
import pathlib
import re
import sys
import time

import programs

MANUAL = pathlib.Path(__file__).resolve().parents[1] / "docs" / "command-line.md"


def roff(text):
    """Plain text as roff: no character has a meaning."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga").replace("~", "\\(ti")
    text = text.replace("^", "\\(ha")
    return "\n".join("\\&" + line if line.startswith((".", "\\(aq")) else line for line in text.split("\n"))


def marked(text):
    """The same with `code` in bold."""
    return re.sub(r"\\\(ga([^\n]*?)\\\(ga", r"\\fB\1\\fR", roff(text))


def table_of(heading):
    """The two columns of a table of docs/command-line.md, without its links and marks."""
    section = MANUAL.read_text().split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    for first, second in re.findall(r"^\| ([^|]*?) \| (.*?) \|$", section, re.M)[2:]:
        second = re.sub(r"[;,]? ?\(?\[[^\]]*\]\([^)]*\)\)?", "", second)
        yield first.replace("`", ""), second


class Page:
    def __init__(self, name, summary, version):
        seconds = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
        date = time.strftime("%Y-%m-%d", time.gmtime(seconds))
        self.name = name
        self.lines = [f'.TH {roff(name.upper())} 1 {date} "Swarmsmith {version}" "Swarmsmith manual"', ".nh", ".ad l", ".SH NAME",
                      f"{roff(name)} \\- {roff(summary)}"]

    def section(self, title):
        self.lines.append(f".SH {title.upper()}" if " " not in title else f'.SH "{title.upper()}"')

    def prose(self, text):
        first = True
        for kind, block in programs.paragraphs(text):
            if not first:
                self.lines.append(".PP")
            first = False
            if kind == "text":
                self.lines.append(marked(block))
            else:
                self.block(block)

    def block(self, lines):
        self.lines += [".nf", *[roff(line) if line else "\\&" for line in lines], ".fi"]

    def item(self, head, text):
        self.lines += [".TP", head, marked(text)]

    def synopsis(self, program, command):
        head, *rest = programs.synopsis(program, command)
        self.lines += [".PP" if self.lines[-1] != ".SH SYNOPSIS" else ".\\\"",
                       f"\\fB{roff(head)}\\fR " + " ".join(roff(part) for part in rest)]

    def options(self, command):
        for word in programs.words_of(command):
            self.item(f"\\fI{roff(word['names'][0])}\\fR", word["help"])
        for option in programs.options_of(command):
            names = ", ".join(f"\\fB{roff(name)}\\fR" for name in option["names"])
            value = f" \\fI{roff(option['value'])}\\fR" if option["value"] else ""
            self.item(names + value, option["help"])

    def write(self, folder):
        lines = [line for line in self.lines if line != ".\\\""]
        (folder / f"{self.name}.1").write_text("\n".join(lines) + "\n")


def see_also(page, names):
    page.section("See also")
    names = sorted(set(names) - {page.name})
    page.lines += [f".BR {roff(name)} (1)" + ("," if name != names[-1] else "") for name in names]


def add_command(page, program, command, title="Options"):
    before, examples, after = programs.examples_of(command["details"])
    if before or after:
        page.section("Description")
        page.prose("\n\n".join(filter(None, (before, after))))
    page.section(title)
    page.options(command)
    if examples:
        page.section("Examples")
        page.block(examples)


def add_surroundings(page):
    for title, heading in (("Exit status", "Exit codes"), ("Environment", "Environment")):
        page.section(title)
        for name, meaning in table_of(heading):
            page.item(f"\\fB{name}\\fR", meaning)


def write_pages(bin_folder, folder):
    folder.mkdir(parents=True, exist_ok=True)
    version = programs.version(bin_folder)
    known = {program: programs.declared(bin_folder, program) for program in programs.built(bin_folder)}
    # `swarmsmith worker` starts swarmsmith-worker, so one page describes both.
    started = {}
    for program, tells in known.items():
        for command in tells["commands"]:
            name = programs.page_name(tells["program"], command["name"])
            if name in known and name != program:
                started[name] = (tells["program"], command)
    for program, tells in known.items():
        name = programs.page_name(tells["program"])
        nameless = [command for command in tells["commands"] if not command["name"]]
        page = Page(name, tells["purpose"].split("\n")[0].rstrip("."), version)
        page.section("Synopsis")
        if nameless:
            page.synopsis(tells["program"], nameless[0])
        else:
            page.lines.append(f"\\fB{roff(tells['program'])}\\fR \\fICOMMAND\\fR [OPTIONS]")
        starter = started.get(program)
        if starter and not starter[1]["another_program"]:
            page.synopsis(starter[0], starter[1])
        page.section("Description")
        page.prose("\n\n".join(filter(None, (tells["purpose"], tells["begin"]))))
        if nameless:
            page.section("Options")
            page.options(nameless[0])
        if starter and not starter[1]["another_program"]:
            add_command(page, *starter, f"Options of {starter[0]} {starter[1]['name']}")
        if not nameless:
            page.section("Commands")
            for command in tells["commands"]:
                page.item(f"\\fB{roff(command['name'])}\\fR", command["summary"])
        add_surroundings(page)
        pages = [programs.page_name(tells["program"], command["name"]) for command in tells["commands"]]
        see_also(page, [*pages, *[programs.page_name(other["program"]) for other in known.values()]])
        page.write(folder)
        for command in tells["commands"]:
            own = programs.page_name(tells["program"], command["name"])
            if not command["name"] or own in known or command["another_program"]:
                continue
            page = Page(own, command["summary"], version)
            page.section("Synopsis")
            page.synopsis(tells["program"], command)
            add_command(page, tells["program"], command)
            see_also(page, [name])
            page.write(folder)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write_pages(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
