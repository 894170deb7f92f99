#!/usr/bin/python3
"""split_files.py MAN COMPLETION DEBIAN: puts man pages and completion into the folders of the packages: what begins with
the name of a program that has a package of its own into that one, the rest into swarmsmith's."""
import pathlib
import shutil
import sys

import programs

#: Programs with a package of their own; swarmsmith has the others.
PACKAGES = tuple(program for program in programs.PROGRAMS if program not in ("swarmsmith", "swarmsmith-worker"))


def package_of(name):
    stem = name.lstrip("_").split(".")[0]
    return next((package for package in PACKAGES if stem == package or stem.startswith(package + "-")), "swarmsmith")


def put(path, place, debian):
    folder = debian / package_of(path.name) / "usr" / place
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, folder / path.name)


def main(man, completion, debian):
    for path in sorted(man.glob("*.1")):
        put(path, "share/man/man1", debian)
    for path in sorted(completion.rglob("*")):
        if path.is_file():
            put(path, path.parent.relative_to(completion), debian)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*map(pathlib.Path, sys.argv[1:]))
