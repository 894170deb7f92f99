"""The files that a page shows in its blocks of code. A block belongs to a file when the paragraph before it ends with
the file's path in backquotes and a colon."""
import pathlib
import re

BLOCK = re.compile(r"`([\w./]+)`:\n\n```\w+\n(.*?)^```$", re.S | re.M)


def files_of(page):
    """Path and text of each block, in the page's order."""
    return BLOCK.findall(pathlib.Path(page).read_text())
