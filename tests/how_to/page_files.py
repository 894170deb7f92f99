"""The files that a page shows in its blocks of code. A block belongs to a file when the paragraph before it ends with
the file's path in backquotes and a colon. A block of diff shows a place in a file: lines that stay, come (+) and go
(-)."""
import pathlib
import re

BLOCK = re.compile(r"`([\w./]+)`:\n\n```(\w+)\n(.*?)^```$", re.S | re.M)


def blocks_of(page):
    """Path, language and text of each block, in the page's order."""
    return BLOCK.findall(pathlib.Path(page).read_text())


def files_of(page):
    """Path and text of each whole file."""
    return [(path, text) for path, language, text in blocks_of(page) if language != "diff"]


def edits_of(page):
    """Path, old and new text of each place that changes. A line's end is left out of the last ones, so that a line
    may be shown up to some word."""
    edits = []
    for path, language, text in blocks_of(page):
        if language == "diff":
            lines = text.splitlines()
            old, new = ("\n".join(line[1:] for line in lines if line[:1] != other) for other in "+-")
            edits.append((path, old, new))
    return edits


def follow(page, folder):
    """Does to the tree what the page shows."""
    for path, text in files_of(page):
        (folder / path).write_text(text)
    for path, old, new in edits_of(page):
        text = (folder / path).read_text()
        if text.count(old) != 1:
            raise ValueError(f"{page}: {path} has {text.count(old)} places like\n{old}")
        (folder / path).write_text(text.replace(old, new))
