"""What a gate's verdict is about, the same in every clone. Run at the root of the repository, with build-asan
configured and its generated headers made.

digests.py units            the units of build-asan that clang-tidy looks at, a line each
digests.py command UNIT     the compiler's options for a unit, a line each
digests.py tidy UNIT        a unit's name, and the digest of its text after the preprocessor, its command, its NOLINT
                            comments, .clang-tidy, tidy_one and clang-tidy's version
digests.py program NAME...  a line NAME DIGEST for each of these programs of build-asan: of the same texts and commands
                            of all units that they are made of

Neither comments nor the place of the clone change a digest.
"""
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

ROOT = os.getcwd()
BUILD = Path("build-asan")


def name_of(unit):
    """A short name: build-asan/base/CMakeFiles/swarmsmith_base.dir/Unity/unity_swarmsmith_base_0_cxx.cxx is
    base/swarmsmith_base_0."""
    path = os.path.relpath(unit, ROOT).removeprefix(f"{BUILD}/")
    return re.sub(r"CMakeFiles/.*/unity_(.*)_cxx\.cxx$", r"\1", path)


def commands():
    """The words of each unit's command without the compiler, its launcher, the input and the output."""
    found = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        words = words[next(i for i, word in enumerate(words) if word.startswith("-")):]
        del words[words.index("-o"):]
        found[entry["file"]] = words
    return found


COMMANDS = commands()


def digest_of(*texts):
    return hashlib.sha256("\0".join(texts).replace(ROOT + "/", "").replace(ROOT, ".").encode()).hexdigest()[:16]


@cache
def read_by_the_compiler(unit):
    """The digest of a unit's text and command, and the files of the repository that it is made of."""
    text = subprocess.run(["clang++", *COMMANDS[unit], "-E", "-dD", unit], check=True, capture_output=True,
                          text=True).stdout
    lines, files = [], set()
    for line in text.splitlines():
        if place := re.match(r'# \d+ "(.*?)"', line):
            if place[1].startswith(ROOT + "/"):
                files.add(place[1])
        elif line and not line.isspace():
            lines.append(line)
    return digest_of(shlex.join(COMMANDS[unit]), *lines), sorted(files)


def tidy_line(unit):
    digest, files = read_by_the_compiler(unit)
    suppressed = [line for file in files for line in Path(file).read_text(errors="replace").splitlines()
                  if "NOLINT" in line]
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True, text=True).stdout
    how = [re.search("version.*", version)[0], Path(".clang-tidy").read_text(),
           Path("tests/gates/tidy_one").read_text()]
    return f"{name_of(unit)} {digest_of(digest, *how, *suppressed)}"


def is_tidied(unit):
    path = os.path.relpath(unit, ROOT)
    return not ("_verify_interface_" in path or "/generated/" in path or path.startswith(("tests/", f"{BUILD}/tests/")))


def units_of(program):
    inputs = subprocess.run(["ninja", "-C", BUILD, "-t", "inputs", f"bin/{program}"], check=True, capture_output=True,
                            text=True).stdout
    paths = {os.path.normpath(BUILD.absolute() / line) for line in inputs.splitlines()}
    return sorted(paths & COMMANDS.keys())


def program_lines(programs):
    units = {program: units_of(program) for program in programs}
    with ThreadPoolExecutor(int(os.environ.get("SWARMSMITH_JOBS", os.cpu_count()))) as pool:
        list(pool.map(read_by_the_compiler, sorted({unit for of_one in units.values() for unit in of_one})))
    return [f"{program} {digest_of(*(read_by_the_compiler(unit)[0] for unit in units[program]))}" for program in programs]


match sys.argv[1:]:
    case ["units"]:
        lines = sorted(filter(is_tidied, COMMANDS))
    case ["command", unit]:
        lines = COMMANDS[unit]
    case ["tidy", unit]:
        lines = [tidy_line(unit)]
    case ["program", *programs]:
        lines = program_lines(programs)
    case _:
        sys.exit(__doc__)
print(*lines, sep="\n")
