"""The blocks of commands in a page. A block of `sh` is run by a test, in the page's order, in a folder where the blocks
of `... file=NAME` have been written; or a comment above it says why not:

    <!-- not run: needs Slurm -->

What only looks like a command, such as a summary of options, is a block of `text`."""
import os
import pathlib
import re
from typing import NamedTuple

SOURCE = pathlib.Path(os.environ.get("SWARMSMITH_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
FENCE = re.compile(r"^(?:<!-- not run: (?P<reason>[^\n]*?) -->\n)?^(?P<fence>`{3,})(?P<language>[\w+]*)(?: file=(?P<file>\S+))?\n"
                   r"(?P<text>.*?)^(?P=fence)$", re.M | re.S)
#: What begins a line that a person would type.
COMMAND = re.compile(r"(?:\$ )?(?:swarmsmith|irace|\./dev|build/bin/|benchmarks/|ssh|scp|sbatch|curl|sudo|apt-get|cmake|ctest|man) ")


class Block(NamedTuple):
    line: int
    language: str
    file: str      # that it is written to, or ""
    text: str
    reason: str    # why it is not run, or ""


def blocks_of(text):
    return [Block(text.count("\n", 0, found.start("fence")) + 1, found["language"], found["file"] or "", found["text"],
                  found["reason"] or "") for found in FENCE.finditer(text)]


def blocks_to_run(page):
    """Blocks of a page that are run or written, first to last; `page` is a path from the root."""
    return [block for block in blocks_of((SOURCE / page).read_text())
            if block.file or (block.language in ("sh", "bash", "console") and not block.reason)]


def unmarked_commands(text):
    """(line, text) of commands in blocks that are not run: without a language, or indented."""
    for block in blocks_of(text):
        if not block.language and COMMAND.match(block.text):
            yield block.line, block.text.split("\n")[0]
    # A block that is indented begins behind an empty line; what is fenced is left out, lines stay.
    plain = FENCE.sub(lambda found: "\n" * found[0].count("\n"), text)
    lines = plain.split("\n")
    for number, line in enumerate(lines[1:], 2):
        if line.startswith("    ") and not lines[number - 2].strip() and COMMAND.match(line.strip()):
            yield number, line.strip()
