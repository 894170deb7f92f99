#!/usr/bin/python3
"""stand_in.py COMPILER LIBRARY OUT NEEDING...: writes OUT, a library with LIBRARY's name, and with each function and variable
that the libraries NEEDING take from it: functions that return 0, variables of zeros. It needs no other library. For what
a program's libraries are linked with and the program never asks for, such as codecs of sound."""
import collections
import re
import subprocess
import sys
import tempfile

RETURN_0 = {"x86_64": "xor %eax, %eax\n  ret", "aarch64": "mov x0, #0\n  ret"}


def said_by(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout


def symbols(file):
    """Of a library: size, kind, section ("UND": it is another's), name, version."""
    for line in said_by("readelf", "--dyn-syms", "-W", file).splitlines():
        found = re.match(r"\s*\d+: \w+\s+(\S+) (\w+)\s+\w+\s+\w+\s+(\S+)\s+([^@ ]+)(?:@@?(\S+))?", line)
        if found:
            yield int(found[1], 0), found[2], *found.groups()[2:]


def main():
    compiler, library, out, *needing = sys.argv[1:]
    taken = {(name, version) for file in needing for _, _, section, name, version in symbols(file) if section == "UND"}
    text, versions = [], collections.defaultdict(list)
    machine = said_by(compiler, "-dumpmachine").split("-")[0]
    for size, kind, section, name, version in symbols(library):
        # A name may exist in several versions.
        if section in ("UND", "ABS") or (name, version) not in taken or name in versions[version]:
            continue
        versions[version].append(name)
        text.append(f"  .globl {name}\n")
        if kind in ("FUNC", "IFUNC"):
            text.append(f"  .text\n  .type {name}, %function\n{name}:\n  {RETURN_0[machine]}\n  .size {name}, . - {name}\n")
        else:
            text.append(f"  .bss\n  .balign 64\n  .type {name}, %object\n{name}:\n  .zero {size}\n  .size {name}, {size}\n")
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/a.s", "w", encoding="ascii") as file:
            file.write("".join(text) + '  .section .note.GNU-stack, "", %progbits\n')
        words = [compiler, "-shared", "-nostdlib", "-Wl,--build-id=none", "-Wl,-soname," + library.rsplit("/", 1)[-1], "-o", out,
                 f"{folder}/a.s"]
        if named := {version: names for version, names in versions.items() if version}:
            with open(f"{folder}/map", "w", encoding="ascii") as file:
                file.writelines(f"{version} {{ {'; '.join(names)}; }};\n" for version, names in sorted(named.items()))
            words.append(f"-Wl,--version-script,{folder}/map")
        subprocess.run(words, check=True)


if __name__ == "__main__":
    main()
