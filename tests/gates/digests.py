"""What a gate's verdict is about, the same in every clone. Run at the root of the repository, with BUILD configured
and its generated headers made.

digests.py units              the units of build-asan that clang-tidy looks at, a line each: its short name, its path
digests.py command UNIT       the compiler's options for a unit of build-asan, a line each
digests.py tidy UNIT          a unit's name, and the digest of its text after the preprocessor, its command, its NOLINT
                              comments, .clang-tidy, tidy_one and clang-tidy's version
digests.py programs NAME...   a line NAME DIGEST for each of these programs of build-asan: of the same texts and commands
                              of all units that they are made of
digests.py tests BUILD TREE [CTEST-ARGUMENT...]
                              a line DIGEST PROGRAM NAME for each test, the longest first: that of its program and of
                              tests/golden; for what reads other files of the repository, or starts other programs of
                              it, that of all files but UNREAD ones. TREE for the tests that read these too. PROGRAM
                              is - for scripts. Test programs need not be built; all others do

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
BUILD = Path(sys.argv[2] if sys.argv[1:2] == ["tests"] else "build-asan")


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def commands():
    """The words of each unit's command, from the compiler to its last option: no launcher, input and output, and not
    where the clone is."""
    found = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        first = next(i for i, word in enumerate(words) if word.startswith("-"))
        found[entry["file"]] = [word for word in words[first - 1:words.index("-o")]
                                if not word.startswith("-ffile-prefix-map=")]
    return found


COMMANDS = commands()


def digest_of(*texts):
    return hashlib.sha256("\0".join(texts).replace(ROOT + "/", "").replace(ROOT, ".").encode()).hexdigest()[:16]


@cache
def read_by_the_compiler(unit):
    """The digest of a unit's text and command, the files of the repository that it is made of, and whether it has
    paths of the repository in it, other than that of tests/golden."""
    lines, files, has_paths = [], set(), False
    for line in output_of(*COMMANDS[unit], "-E", "-dD", unit).splitlines():
        if place := re.match(r'# \d+ "(.*?)"', line):
            if place[1].startswith(ROOT + "/"):
                files.add(place[1])
        elif line and not line.isspace():
            lines.append(line)
            has_paths = has_paths or (not line.startswith("#") and
                                      re.search(f'"{ROOT}(/{BUILD}/bin)?"', line) is not None)
    return digest_of(shlex.join(COMMANDS[unit]), *lines), sorted(files), has_paths


def name_of(unit):
    """build-asan/base/CMakeFiles/swarmsmith_base.dir/Unity/unity_swarmsmith_base_0_cxx.cxx is base/swarmsmith_base_0."""
    path = os.path.relpath(unit, ROOT).removeprefix(f"{BUILD}/")
    return re.sub(r"CMakeFiles/.*/unity_(.*)_cxx\.cxx$", r"\1", path)


def tidy_line(unit):
    digest, files, _ = read_by_the_compiler(unit)
    suppressed = [line for file in files for line in Path(file).read_text(errors="replace").splitlines()
                  if "NOLINT" in line]
    how = [re.search("version.*", output_of("clang-tidy", "--version"))[0], Path(".clang-tidy").read_text(),
           Path("tests/gates/tidy_one").read_text()]
    return f"{name_of(unit)} {digest_of(digest, *how, *suppressed)}"


def is_tidied(unit):
    path = os.path.relpath(unit, ROOT)
    return not ("_verify_interface_" in path or "/generated/" in path or path.endswith(".S") or
                path.startswith(("tests/", f"{BUILD}/tests/")))


def units_of(program):
    inputs = output_of("ninja", "-C", BUILD, "-t", "inputs", f"bin/{program}").splitlines()
    return sorted({os.path.normpath(BUILD.absolute() / line) for line in inputs} & COMMANDS.keys())


def programs_digests(programs):
    """Of each program: its digest, and whether it has paths of the repository in it."""
    units = {program: units_of(program) for program in programs}
    with ThreadPoolExecutor(int(os.environ.get("SWARMSMITH_JOBS", os.cpu_count()))) as pool:
        list(pool.map(read_by_the_compiler, sorted(set().union(*units.values()))))
    read = {program: [read_by_the_compiler(unit) for unit in units[program]] for program in programs}
    return {program: (digest_of(*(one[0] for one in parts)), any(one[2] for one in parts))
            for program, parts in read.items()}


#: Files that change no test's verdict but its own, and those of the folders of tests that read all that there is: each
#: citation, each include, the archive of a release. How tests are declared counts by the commands that come of it. What
#: ThreadSanitizer leaves out is among them: whoever changes that runs again what it was changed for.
UNREAD = re.compile(r".*_test\.(py|cpp)|tests/(gates/.*|thread_sanitizer\.supp|(.*/)?CMakeLists\.txt)|"
                    r"(CHANGELOG|CONTRIBUTING|docs/(performance|reliability))\.md")
READ_ALL = ("tests/docs/", "tests/how_to/", "tests/packaging/", "tests/rooms/")


@cache
def files_in_git():
    return output_of("git", "ls-files", "-s").splitlines()


@cache
def scripts():
    """The paths of all tests that are scripts, by their names without a folder."""
    found = {}
    for line in files_in_git():
        if (path := Path(line.split("\t")[1])).match("*_test.py"):
            found.setdefault(path.stem, set()).add(str(path))
    return found


def with_imports(paths):
    """These scripts, and the tests that they import, in whatever folder."""
    found, left = set(), set(paths)
    while left := left - found:
        found |= left
        imports = (re.findall(r"^\s*(?:from|import) (\w+_test)\b", Path(path).read_text(), re.M) for path in left)
        left = set().union(*(scripts().get(name, ()) for names in imports for name in names))
    return found


def script_of(test):
    """That of a path, or that which is a module."""
    words = " ".join(os.path.relpath(word, ROOT) if os.path.isabs(word) else word for word in test["command"])
    paths = set(re.findall(r"\S+_test\.py\b", words))
    modules = re.findall(r"\b\w+_test\b", words) if "-m" in test["command"] else ()
    return paths or set().union(*(scripts().get(name, ()) for name in modules))


def digest_of_files(test, tree):
    """Of all files that count for a test that is a script, or that reads files."""
    own = with_imports(script_of(test))
    if tree == "changed" or any(path.startswith(READ_ALL) for path in own):
        return tree
    return digest_of(how_programs_are_made(), *property_of(test, "ENVIRONMENT", ()),
                     *(line for line in files_in_git()
                       if (path := line.split("\t")[1]) in own or not UNREAD.fullmatch(path)))


@cache
def how_programs_are_made():
    """The digest of the commands that make all programs but the tests', from generated code to linking."""
    made = re.findall(r"^(bin/(?!fuzz_)[^:]*(?<!_test)):", output_of("ninja", "-C", BUILD, "-t", "targets", "all"), re.M)
    return digest_of(output_of("ninja", "-C", BUILD, "-t", "commands", *sorted(made)))


def property_of(test, name, default):
    return next((one["value"] for one in test.get("properties", ()) if one["name"] == name), default)


def with_command(test):
    """ctest knows no command of a program that is not built yet."""
    name = re.sub(r"^fuzz\.", "fuzz_", test["name"])
    path = BUILD.absolute() / "bin" / (name if name.startswith("fuzz_") else f"{name}_test")
    return {"command": [str(path)], **test}


def test_lines(tree, arguments):
    tests = [with_command(test) for test in
             json.loads(output_of("ctest", "--test-dir", BUILD, "--show-only=json-v1", *arguments))["tests"]]
    program_of = {test["name"]: os.path.basename(test["command"][0]) for test in tests
                  if os.path.dirname(test["command"][0]) == str(BUILD.absolute() / "bin")}
    digests = programs_digests(sorted(set(program_of.values())))
    golden = output_of("git", "ls-files", "-s", "tests/golden")
    lines = []
    for test in sorted(tests, key=lambda test: property_of(test, "COST", 0), reverse=True):
        program = program_of.get(test["name"], "-")
        digest, has_paths = digests.get(program, ("", True))
        read = digest_of_files(test, tree) if has_paths else golden
        lines.append(f"{read if read == tree else digest_of(digest, read, *test['command'])} {program} {test['name']}")
    # Those whose lines the next commit ends come last.
    return sorted(lines, key=lambda line: line.startswith(tree))


match sys.argv[1:]:
    case ["units"]:
        lines = sorted(f"{name_of(unit)} {unit}" for unit in COMMANDS if is_tidied(unit))
    case ["command", unit]:
        lines = COMMANDS[unit][1:]
    case ["tidy", unit]:
        lines = [tidy_line(unit)]
    case ["programs", *programs]:
        lines = [f"{program} {digest}" for program, (digest, _) in programs_digests(programs).items()]
    case ["tests", _, tree, *arguments]:
        lines = test_lines(tree, arguments)
    case _:
        sys.exit(__doc__)
print(*lines, sep="\n")
