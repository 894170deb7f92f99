"""Lines of text that were added and have one of CONTRIBUTING's ten odd words: `plain_words.py [BASE]`. Since BASE, a commit;
else since the branch left its upstream; without one, since the last commit. Lines of code are looked at in their comments
and texts, and tests are not."""
import pathlib
import re
import subprocess
import sys

PAGE = "CONTRIBUTING.md"
TEXTS = ["*.h", "*.cpp", "*.py", "*.ts", "*.tsx", "*.sql", "*.md", "dev"]
#: Facts and decisions are quoted as they were written; the page has the words themselves.
OTHERS = (PAGE, "CHANGELOG.md", "tests/", "docs/reference/", "docs/decisions/")


def words_of(page):
    """The table's odd words and what to say in place of each."""
    rows = re.findall(r"^\| `([^`|]+)` \| (.+?) \|$", page.split("## Plain words", 1)[1].split("\n## ", 1)[0], re.M)
    return {odd: plain for odd, plain in rows}


def prose_of(file, line):
    """What people read of a line."""
    if file.endswith((".h", ".cpp", ".ts", ".tsx")):
        return " ".join(re.findall(r"//.*|\"(?:[^\"\\]|\\.)*\"", line))
    return line


def flagged(diff, words):
    """Of a diff without context: file, line and word."""
    odd = {word: re.compile(rf"\b{re.escape(word)}\b", re.I) for word in words}
    file, number = "", 0
    for line in diff.splitlines():
        if line.startswith("+++ "):
            file = line[6:]
        elif line.startswith("@@"):
            number = int(re.search(r"\+(\d+)", line)[1])
        elif line.startswith("+"):
            if not file.startswith(OTHERS):
                yield from ((file, number, word) for word, what in odd.items() if what.search(prose_of(file, line[1:])))
            number += 1


def git(*words):
    return subprocess.run(["git", *words], capture_output=True, text=True, errors="replace")


def main():
    base = sys.argv[1] if len(sys.argv) > 1 else git("merge-base", "HEAD", "@{upstream}").stdout.strip() or "HEAD"
    words = words_of(pathlib.Path(PAGE).read_text())
    found = list(flagged(git("diff", "-U0", "--no-renames", base, "--", *TEXTS).stdout, words))
    for file, number, word in found:
        print(f"{file}:{number}: `{word}`: {words[word]}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
