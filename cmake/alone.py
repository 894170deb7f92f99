"""alone.py FILE...: which of the sources of a target cannot be compiled in one unit with the others,
a line each: those with a name in an unnamed namespace that a file before them has as well."""
import re
import sys

UNNAMED = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.DOTALL | re.MULTILINE)
# Our code is formatted: what is declared at the level of the namespace begins in the first column.
NAME = re.compile(
    r"^(?:template <.*> *|using (?=\w+ =)|(?:struct|class|enum(?: class)?) |"
    r"(?!namespace|using|template|struct|class|enum|static_assert|return|public|private|[A-Z_]+\()\w[^(={;\n]*?[ &*>])(?P<name>\w+)"
    r"(?=[({=\[;]|$| [={:]| final)", re.MULTILINE)

taken = set()
for path in sys.argv[1:]:
    with open(path, encoding="utf-8") as file:
        names = {found["name"] for part in UNNAMED.findall(file.read()) for found in NAME.finditer(part)}
    if names & taken:
        print(path)
    taken |= names
