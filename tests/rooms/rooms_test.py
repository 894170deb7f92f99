"""No library includes what it does not link, no room includes a later one, and what is used is included.

Libraries are read from the CMakeLists.txt files (swarmsmith_component, swarmsmith_program), the order of the rooms
from the table "Rooms" of docs/architecture.md.
"""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TOP = ("base", "irace_core", "programs", "sim", "proto", "storage", "worker", "robot", "analysis", "coordinator", "console",
       "cli", "tracking", "web")
WORDS = ("SOURCES", "HEADERS", "PUBLIC", "PRIVATE", "LATE")


# Standard headers, and names that only they are sure to bring. Another version of the library has them somewhere else.
STANDARD = {
    "algorithm": "all_of any_of clamp copy_n fill_n find_if lower_bound max_element min_element none_of nth_element sort "
                 "stable_sort transform upper_bound",
    "array": "array", "atomic": "atomic atomic_bool atomic_flag", "bit": "bit_cast bit_ceil countr_zero endian popcount",
    "bitset": "bitset", "charconv": "from_chars to_chars", "chrono": "chrono",
    "condition_variable": "condition_variable condition_variable_any",
    "cstdint": "int8_t int16_t int32_t int64_t intmax_t intptr_t uint8_t uint16_t uint32_t uint64_t uintmax_t uintptr_t",
    "deque": "deque", "exception": "current_exception exception_ptr terminate", "filesystem": "filesystem",
    "fstream": "fstream ifstream ofstream", "functional": "bind function hash reference_wrapper",
    "future": "async future promise", "iostream": "cerr cin clog cout", "limits": "numeric_limits", "list": "list",
    "map": "map multimap", "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag scoped_lock unique_lock", "numbers": "numbers",
    "numeric": "accumulate inner_product iota partial_sum", "optional": "make_optional nullopt optional",
    "queue": "priority_queue queue", "random": "mt19937 mt19937_64 normal_distribution uniform_int_distribution",
    "ranges": "views", "regex": "regex smatch sregex_iterator", "set": "multiset set", "span": "span",
    "sstream": "istringstream ostringstream stringstream", "stdexcept": "invalid_argument logic_error out_of_range runtime_error",
    "string": "getline stod stoi string to_string", "string_view": "string_view",
    "system_error": "errc error_code generic_category system_category", "thread": "jthread this_thread thread",
    "tuple": "make_tuple tie tuple", "unordered_map": "unordered_map", "unordered_set": "unordered_set",
    "utility": "exchange forward move pair swap", "variant": "get_if holds_alternative monostate variant visit",
    "vector": "vector"}
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}


def sets_of(texts):
    """Variable -> words of every `set` of it: a list of sources may depend on a package."""
    found = {}
    for text in texts:
        for name, words in re.findall(r"\bset\((\w+)\s+([^)$]*)\)", text):
            found.setdefault(name, []).extend(words.split())
    return found


def libraries(texts):
    """Name -> (files, linked names) of the libraries in {folder: text of its CMakeLists.txt}."""
    found = {}
    for folder, text in texts.items():
        text = re.sub(r"#[^\n]*", "", text)
        variables = sets_of([text])
        for kind, arguments in re.findall(r"swarmsmith_(component|program|late_program)\(([^)]*)\)", text):
            name, *words = re.sub(r"\$\{(\w+)\}", lambda found: " ".join(variables.get(found[1], [])), arguments).split()
            lists = {word: [] for word in WORDS}
            kept = None
            for word in words:
                if word in WORDS:
                    kept = lists[word]
                else:
                    kept.append(word)
            files = {(folder / file).as_posix() for file in lists["SOURCES"] + lists["HEADERS"]}
            linked = set(lists["PUBLIC"] + lists["PRIVATE"])
            known = found.setdefault("swarmsmith_" + name if kind == "component" else name, (set(), set()))
            known[0].update(files)  # one that has other sources where a package is missing is there twice
            known[1].update(linked)
        # Kinds belong to the folder's library: a header each, and a source where there is one.
        for kinds in re.findall(r"swarmsmith_kinds\(([^)]*)\)", text):
            _, place, *words = re.sub(r"\$\{(\w+)\}", lambda found: " ".join(variables.get(found[1], [])), kinds).split()
            owner = "swarmsmith_" + re.search(r"swarmsmith_component\((\w+)", text)[1]
            found[owner][0].update((folder / place / (kind + ending)).as_posix()
                                   for kind in words for ending in (".h", ".cpp"))
        for name, arguments in re.findall(r"target_link_libraries\(([\w-]+)([^)]*)\)", text):
            if name in found:
                found[name][1].update(set(arguments.split()) - set(WORDS))
    return found


def includes_of(text):
    return re.findall(r'^#include "([^"]+)"', text, re.M)


def owner_of(file, owners, by_stem):
    """A header that no list names, such as an internal one, belongs to the library of its source or of its folder."""
    if file in owners:
        return owners[file]
    path = pathlib.PurePosixPath(file)
    if (stem := path.with_suffix("").as_posix()) in by_stem:
        return by_stem[stem]
    folder = path.parent
    while True:
        near = {library for other, library in owners.items() if pathlib.PurePosixPath(other).parent == folder}
        if len(near) == 1:
            return near.pop()
        if near or folder.name != "internal":
            return None
        folder = folder.parent


def unlinked(found, text_of):
    """What is included without being linked, a line each. `text_of`: file -> text."""
    owners = {file: name for name, (files, _) in found.items() for file in files}
    by_stem = {pathlib.PurePosixPath(file).with_suffix("").as_posix(): name for file, name in owners.items()}
    lines = set()
    for file, text in text_of.items():
        library = owner_of(file, owners, by_stem)
        if library is None:
            continue
        for included in includes_of(text):
            other = owner_of(included, owners, by_stem)
            if other is not None and other != library and other not in found[library][1]:
                lines.add(f"{file} includes {included}, and {library} does not link {other}")
    return sorted(lines)


def rooms_of(page):
    """The folders of the table "Rooms", first to last."""
    table = page.split("## Rooms", 1)[1].split("\n## ", 1)[0]
    return [folder.rstrip("/") for row in re.findall(r"^\| (`[^|]*) \|", table, re.M)
            for folder in re.findall(r"`([^`]+)`", row)]


def room_of(file, rooms):
    """The innermost room that the file is in."""
    return max((room for room in rooms if file.startswith(room + "/")), key=len, default=None)


def upward(rooms, text_of):
    """Includes of later rooms, a line each, and files in no room."""
    lines = []
    for file, text in sorted(text_of.items()):
        room = room_of(file, rooms)
        if room is None:
            lines.append(f"{file} is in no room of docs/architecture.md")
            continue
        for included in includes_of(text):
            other = room_of(included, rooms)
            if other is not None and rooms.index(other) > rooms.index(room):
                lines.append(f"{file} ({room}) includes {included} of a later room ({other})")
    return lines


def not_included(text_of):
    """Standard names that a file uses, and includes neither itself nor through our headers, a line each."""
    ours = {file: includes_of(text) for file, text in text_of.items()}
    standard = {file: set(re.findall(r"^#include <([a-z_]+)>", text, re.M)) for file, text in text_of.items()}
    lines = []
    for file, text in sorted(text_of.items()):
        reached, open_files, there = set(), [file], set()
        while open_files:
            next_file = open_files.pop()
            if next_file in ours and next_file not in reached:
                reached.add(next_file)
                there |= standard[next_file]
                open_files += ours[next_file]
        if "filesystem" in there:
            there.add("system_error")  # its functions take them
        code = re.sub(r'//[^\n]*|"(?:\\.|[^"\\\n])*"', "", text)
        for name in sorted(set(re.findall(r"\bstd::(\w+)", code))):
            if name in HEADER_OF and HEADER_OF[name] not in there:
                lines.append(f"{file} uses std::{name} without <{HEADER_OF[name]}>")
        # Files of one unit would bring it for each other.
        if "SWARMSMITH_ASSERT(" in text and '"base/assert.h"' not in text and "define SWARMSMITH_ASSERT" not in text:
            lines.append(f"{file} uses SWARMSMITH_ASSERT without base/assert.h")
    return lines


def told_twice(text_of):
    """Classes of one full name in several files, a line each: the linker takes one of their functions for both."""
    found = {}
    for file, text in sorted(text_of.items()):
        spaces = []
        for line in text.splitlines():
            if opened := re.match(r"namespace(?:\s+([\w:]+))?\s*\{", line):
                spaces.append(opened[1] or "")
            elif re.match(r"\}\s*// namespace", line):
                spaces.pop()
            elif (made := re.match(r"(?:struct|class|enum class|enum|union) (\w+)(?: final)?(?: :[^:;][^;]*)? \{", line)) \
                    and "" not in spaces:
                found.setdefault("::".join([*spaces, made[1]]), []).append(file)
    return [f"{name} is in {' and '.join(files)}" for name, files in sorted(found.items()) if len(files) > 1]


class Rooms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        lists = {file.parent.relative_to(SOURCE): file.read_text() for top in TOP
                 for file in sorted((SOURCE / top).rglob("CMakeLists.txt"))}
        cls.libraries = libraries(lists)
        cls.texts = {file.relative_to(SOURCE).as_posix(): file.read_text() for top in TOP
                     for file in (SOURCE / top).rglob("*") if file.suffix in (".h", ".cpp")}

    def test_what_is_included_is_linked(self):
        self.assertGreater(len(self.libraries), 40)
        self.assertEqual(unlinked(self.libraries, self.texts), [])

    def test_no_room_includes_a_later_one(self):
        rooms = rooms_of((SOURCE / "docs/architecture.md").read_text())
        self.assertGreater(len(rooms), 30)
        for room in rooms:
            self.assertTrue((SOURCE / room).is_dir(), f"docs/architecture.md: there is no {room}")
        self.assertEqual(upward(rooms, self.texts), [])

    def test_every_file_is_in_a_list(self):
        listed = {file for files, _ in self.libraries.values() for file in files}
        self.assertEqual(sorted({file for file in self.texts if file.endswith(".cpp")} - listed), [])
        # A kind that is a header alone, such as a condition, is nowhere without its line.
        self.assertEqual(sorted(file for file in self.texts
                                if file.endswith(".h") and "/internal/" not in file and file not in listed), [])


    def test_each_class_is_one(self):
        self.assertEqual(told_twice(self.texts), [])


class Includes(unittest.TestCase):
    def test_what_is_used_is_included(self):
        texts = {file.relative_to(SOURCE).as_posix(): file.read_text() for top in (*TOP, "tests", "benchmarks")
                 for file in (SOURCE / top).rglob("*") if file.suffix in (".h", ".cpp")}
        self.assertGreater(len(texts), 1000)
        self.assertEqual(not_included(texts), [])


class TheChecks(unittest.TestCase):
    """They find what they are for."""

    LISTS = {pathlib.PurePosixPath("a"): "swarmsmith_component(a\n  SOURCES a.cpp # one\n  HEADERS a.h)",
             pathlib.PurePosixPath("b"): "swarmsmith_component(b\n  SOURCES b.cpp internal/c.cpp\n  PRIVATE {})"}

    def test_of_links(self):
        texts = {"a/a.cpp": '#include "a/a.h"\n', "a/a.h": "", "b/b.cpp": "", "b/internal/c.cpp": "",
                 "b/internal/d.h": '#include <vector>\n#include "a/a.h"\n'}
        lists = {folder: text.format("swarmsmith_a") for folder, text in self.LISTS.items()}
        self.assertEqual(unlinked(libraries(lists), texts), [])
        lists = {folder: text.format("") for folder, text in self.LISTS.items()}
        self.assertEqual(unlinked(libraries(lists), texts),
                         ["b/internal/d.h includes a/a.h, and swarmsmith_b does not link swarmsmith_a"])

    def test_of_rooms(self):
        page = "## Rooms\n\n| folder | is for |\n| --- | --- |\n| `a/` | x |\n| `b/`, `b/c/` | uses `a/` |\n\n## Then\n"
        self.assertEqual(rooms_of(page), ["a", "b", "b/c"])
        texts = {"a/x.h": '#include "b/y.h"\n', "b/y.h": '#include "b/c/z.h"\n', "b/c/z.h": '#include "a/x.h"\n',
                 "d/w.h": ""}
        self.assertEqual(upward(["a", "b", "b/c"], texts),
                         ["a/x.h (a) includes b/y.h of a later room (b)", "b/y.h (b) includes b/c/z.h of a later room (b/c)",
                          "d/w.h is in no room of docs/architecture.md"])

    def test_of_classes(self):
        texts = {"a.h": "namespace s {\nstruct X {\n};\nclass Y final : public Z {\n};\n}  // namespace s\n",
                 "b.h": "namespace s {\nnamespace {\nstruct X {\n};\n}  // namespace\nenum class Y : int {\n};\n"
                        "struct Y::Part {\n};\n}  // namespace s\nnamespace t {\nstruct X {\n};\n}  // namespace t\n"}
        self.assertEqual(told_twice(texts), ["s::Y is in a.h and b.h"])

    def test_of_variables(self):
        lists = {pathlib.PurePosixPath("a"): "set(one b.cpp)\nset(one c.cpp)\nswarmsmith_component(a\n  SOURCES a.cpp ${one})"}
        self.assertEqual(libraries(lists)["swarmsmith_a"][0], {"a/a.cpp", "a/b.cpp", "a/c.cpp"})

    def test_of_kinds(self):
        lists = {pathlib.PurePosixPath("a"): "set(ones x y)\nswarmsmith_kinds(ones each ${ones})\n"
                                             "swarmsmith_component(a\n  SOURCES ${ones_sources} a.cpp)"}
        self.assertEqual(libraries(lists)["swarmsmith_a"][0],
                         {"a/a.cpp", "a/each/x.h", "a/each/x.cpp", "a/each/y.h", "a/each/y.cpp"})

    def test_of_includes(self):
        texts = {"a.h": "#include <vector>\n#include <cstdint>\nstd::vector<std::uint8_t> bytes;  // no std::map\n",
                 "b.h": '#include "a.h"\nstd::uint8_t byte; const char* word = "std::set";\n',
                 "c.h": '#include <string>\nstd::uint8_t byte;\n'}
        self.assertEqual(not_included(texts), ["c.h uses std::uint8_t without <cstdint>"])


if __name__ == "__main__":
    unittest.main()
