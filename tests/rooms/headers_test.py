"""Each header compiles by itself, and without a precompiled one, with the words that sources near it are compiled with.
SWARMSMITH_BUILD names the folder that was built. Takes some minutes."""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BUILD = pathlib.Path(os.environ["SWARMSMITH_BUILD"])
# Words of a compile command that stand for one file: they, and what follows them, are left out.
OF_ONE_FILE = ("-o", "-c", "-include", "-MF", "-MT", "-MQ")


def words_by_folder():
    """Folder of the source tree -> compiler and words that its sources are compiled with, and where."""
    found = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words, kept = shlex.split(entry["command"]), []
        place = re.match(r"((?:[\w-]+/)*)CMakeFiles/[\w-]+\.dir/", words[words.index("-o") + 1])
        if not place or "_verify_interface_" in entry["file"]:
            continue
        skip = False
        for word in words:
            if skip or word in OF_ONE_FILE:
                skip = not skip
            elif word not in ("-MD", "-Winvalid-pch", entry["file"]) and not word.endswith(("ccache", "by_clang")):
                kept.append(word)
        found.setdefault(place[1].rstrip("/"), []).append((kept, entry["directory"]))
    return found


def fault_of(header, commands):
    """What the compiler says, if each way in which the header's folder is compiled says something."""
    near = next((commands[folder.as_posix()] for folder in pathlib.PurePosixPath(header).parents
                 if folder.as_posix() in commands), None)
    if near is None:  # for all the tests
        top = header.split("/")[0] + "/"
        near = [command for folder, ways in commands.items() if folder.startswith(top) for command in ways]
    said = ""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as unit:
        unit.write(f'#include "{header}"\n')
        unit.flush()
        for words, where in near:
            done = subprocess.run([*words, f"-I{SOURCE}", "-fsyntax-only", "-w", unit.name], cwd=where, text=True,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
            if done.returncode == 0:
                return None
            said = done.stdout
    return f"{header}: {said[:1000]}"


class Headers(unittest.TestCase):
    def test_each_compiles_by_itself(self):
        commands = words_by_folder()
        headers = [file.relative_to(SOURCE).as_posix() for file in SOURCE.rglob("*.h")]
        headers = [header for header in headers if not header.startswith("build")]
        self.assertGreater(len(headers), 500)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
            faults = [fault for fault in workers.map(lambda header: fault_of(header, commands), sorted(headers)) if fault]
        self.assertEqual(faults, [])


if __name__ == "__main__":
    unittest.main()
