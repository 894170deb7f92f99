"""write_files.py FOLDER: the files of C++ that how-tos add, as their pages show them."""
import pathlib
import sys

from page_files import files_of

SOURCE = pathlib.Path(__file__).resolve().parents[2]

if __name__ == "__main__":
    for page in ("flavours", "methods", "missions"):
        for path, text in files_of(SOURCE / f"docs/{page}.md"):
            if path.endswith((".h", ".cpp")) and not (SOURCE / path).exists():
                file = pathlib.Path(sys.argv[1]) / path
                file.parent.mkdir(parents=True, exist_ok=True)
                if not file.exists() or file.read_text() != text:
                    file.write_text(text)
