"""page_files.py PAGE FOLDER: writes the files that a page shows in its blocks of code to FOLDER.

A block belongs to a file when the paragraph before it ends with the file's path in backquotes and a
colon. Files that are as they should be are left alone, so that nothing is built again for them."""
import pathlib
import re
import sys

BLOCK = re.compile(r"`([\w./]+)`:\n\n```\w+\n(.*?)^```$", re.S | re.M)


def files_of(page):
    """Path and text of each block, in the page's order."""
    return BLOCK.findall(pathlib.Path(page).read_text())


def main(page, folder):
    for name, text in files_of(page):
        path = pathlib.Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text() != text:
            path.write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
