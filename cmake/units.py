"""units.py FILE...: which sources of a target are compiled in which unit, a line FILE=UNIT each: at most
sixteen in one, and never two with the same name in an unnamed namespace. A file with all names of an enumeration
(`using enum`) is alone."""
import re
import sys

UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
# Our code is formatted: what is declared at the level of the namespace begins in the first column.
NAME = re.compile(
    r"^(?:template <.*> *|using (?=\w+ =)|(?:struct|class|enum(?: class)?) |"
    r"(?!namespace|using|template|struct|class|enum|static_assert|return|public|private|[A-Z_]+\()\w[^(={;\n]*?[ &*>])(?P<name>\w+)"
    r"(?=[({=\[;]|$| [={:]| final)", re.MULTILINE)

FILES_IN_A_UNIT = 16
FULL = [None] * FILES_IN_A_UNIT

units = []
for path in sys.argv[1:]:
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if "\nusing enum " in text:
        units.append((FULL, set()))
        print(f"{path}={len(units) - 1}")
        continue
    names = {found["name"] for part in UNNAMED.findall(text) for found in NAME.finditer(part)}
    for number, (files, taken) in enumerate(units):
        if len(files) < FILES_IN_A_UNIT and not names & taken:
            break
    else:
        number, files, taken = len(units), [], set()
        units.append((files, taken))
    files.append(path)
    taken |= names
    print(f"{path}={number}")
