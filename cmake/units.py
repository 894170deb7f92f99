"""units.py TARGETS: which sources are compiled in which unit of their target, a line TARGET=UNIT=FILE each: at most
sixteen in one, and never two with the same name in an unnamed namespace, declared there or brought there from two places
(`using a::Name;`). A file with all names of an enumeration (`using enum`) is alone. TARGETS is a file with a line TARGET;FOLDER;FILE;FILE... for each target."""
import os
import re
import sys

UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
# Our code is formatted: what is declared at the level of the namespace begins in the first column.
NAME = re.compile(
    r"^(?:template <.*> *|using (?=\w+ =)|(?:struct|class|enum(?: class)?) |"
    r"(?!namespace|using|template|struct|class|enum|static_assert|return|public|private|[A-Z_]+\()\w[^(={;\n]*?[ &*>])(?P<name>\w+)"
    r"(?=[({=\[;]|$| [={:]| final)", re.MULTILINE)

USED = re.compile(r"^using ([\w:]*::(\w+));$", re.MULTILINE)

FILES_IN_A_UNIT = 16
FULL = [None] * FILES_IN_A_UNIT


def unit_of(path, units):
    """The number of a file's unit, to which it is added."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if "\nusing enum " in text:
        units.append((FULL, {}))
        return len(units) - 1
    # Each name with what it stands for: what this file declares, or the place that it is brought from.
    names = {}
    for part in UNNAMED.findall(text):
        names |= {found["name"]: path for found in NAME.finditer(part)}
        names |= {name: place for place, name in USED.findall(part)}
    for number, (files, taken) in enumerate(units):
        if len(files) < FILES_IN_A_UNIT and all(taken.get(name, meaning) == meaning for name, meaning in names.items()):
            break
    else:
        number, files, taken = len(units), [], {}
        units.append((files, taken))
    files.append(path)
    taken |= names
    return number


with open(sys.argv[1], encoding="utf-8") as targets:
    for line in targets:
        target, folder, *files = line.rstrip("\n").split(";")
        units = []
        for path in (os.path.join(folder, file) for file in files):
            print(f"{target}={unit_of(path, units)}={path}")
