"""units.py TARGETS: which sources are compiled in which unit of their target, a line TARGET=UNIT=FILE each: at most
24 in one, and never two with the same name in an unnamed namespace, unless they are functions whose parameters have
different types of ours, or the same alias. A file with all names of an enumeration (`using enum`) is alone. TARGETS is a
file with a line TARGET;FOLDER;FILE;FILE... for each target."""
import os
import re
import sys

UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
# Our code is formatted, so declarations at namespace level begin in the first column.
NAME = re.compile(
    r"^(?P<template>template <.*> *)?(?:using (?=\w+ =)|(?:struct|class|enum(?: class)?) |"
    r"(?!namespace|using|template|struct|class|enum|static_assert|return|public|private|[A-Z_]+\()\w[^(={;\n]*?[ &*>])(?P<name>\w+)"
    r"(?=[({=\[;]|$| [={:]| final)(?:\((?P<parameters>[^)]*)| (?P<alias>= .*;))?", re.MULTILINE)
USED = re.compile(r"^using ((?:\w+::)+(\w+);)", re.MULTILINE)
LOCAL = re.compile(r"^ +(?:static )?constexpr [^=({]*?(k[A-Z]\w*)\b", re.MULTILINE)
OUR_TYPE = re.compile(r"\b[A-Z]\w*[a-z]\w*")

FILES_IN_A_UNIT = 24
FULL = [None] * FILES_IN_A_UNIT


def names_of(text):
    """What the unnamed namespaces of a text declare: each name with our types in a function's parameters, or with what it
    stands for."""
    names = {name: {"= " + whole} for whole, name in USED.findall(text)}
    for part in UNNAMED.findall(text):
        for found in NAME.finditer(part):
            parameters = re.sub("=[^,]*", "", found["parameters"] or "")  # without default values
            more = " ".join(OUR_TYPE.findall(parameters))
            if found[0].startswith("using ") and found["alias"]:
                more = found["alias"]
            names.setdefault(found["name"], set()).add("" if found["template"] else more)
    return names


def clash(some, others):
    for name in some.keys() & others.keys():
        both = some[name] | others[name]
        is_alias = any(more.startswith("=") for more in both)
        if "" in both or (len(both) > 1 if is_alias else some[name] & others[name]):
            return True
    return False


def unit_of(path, units):
    """The number of a file's unit, to which it is added."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if "\nusing enum " in text:
        units.append((FULL, {}))
        return len(units) - 1
    names = names_of(text)
    local = LOCAL.findall(text)  # must not hide names of earlier files
    for number, (files, taken) in enumerate(units):
        if len(files) < FILES_IN_A_UNIT and not clash(names, taken) and not taken.keys() & local:
            break
    else:
        number, files, taken = len(units), [], {}
        units.append((files, taken))
    files.append(path)
    for name, types in names.items():
        taken.setdefault(name, set()).update(types)
    return number


with open(sys.argv[1], encoding="utf-8") as targets:
    for line in targets:
        target, folder, *files = line.rstrip("\n").split(";")
        units = []
        for path in (os.path.join(folder, file) for file in files):
            print(f"{target}={unit_of(path, units)}={path}")
