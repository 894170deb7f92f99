"""Texts of others (in stores, files, names) are shown by every command, and steer no terminal.

The commands are those of the program's own help: one that is added is tried as well."""
import concurrent.futures
import csv
import io
import json
import os
import pty
import re
import shutil
import sqlite3
import subprocess
import unittest

from every_command import ARGUMENTS, commands, invocations
from programs import SWARMSMITH, ProgramTest, call, campaign_text, ended_well

LEAST = 1350  # what the whole space needs

# A title of the window, colours, a bell, a return, DEL, C1 in UTF-8, letters from right to left,
# a byte that is not UTF-8; a line of its own, and what HTML and a spreadsheet would obey.
HOSTILE = (b"\x1b]0;mine\x07\x1b[31m\r\x00\x7f\xc2\x9b1m\xe2\x80\xae\xe2\x81\xa6\x9b\nswarmsmith: all is well\t"
           b"<script>'\"&\\")


def controls_in(output, allowed=b"\n\t"):
    """What a terminal would obey, or a reader be misled by."""
    found = [byte for byte in output if (byte < 0x20 or byte == 0x7f) and byte not in allowed]
    try:
        text = output.decode()
    except UnicodeDecodeError as error:
        return found + [error.reason]
    return found + re.findall("[\x80-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]", text)


def forged_lines_in(output):
    """Lines that look as if the program had said them."""
    return [line for line in output.splitlines() if line.startswith(b"swarmsmith: all is well")]


def run(*arguments, cwd=None):
    return subprocess.run([SWARMSMITH, *arguments], capture_output=True, timeout=120, cwd=cwd,
                          stdin=subprocess.DEVNULL, env={**os.environ, "SWARMSMITH_LOG": "debug"})


def on_a_terminal(*arguments):
    """What it writes when standard output is a terminal."""
    leader, follower = pty.openpty()
    with subprocess.Popen([SWARMSMITH, *arguments], stdin=subprocess.DEVNULL, stdout=follower,
                          stderr=follower, env={**os.environ, "TERM": "xterm"}) as process:
        os.close(follower)
        written = b""
        try:
            while piece := os.read(leader, 65536):
                written += piece
        except OSError:  # that is how a terminal ends
            pass
        process.wait(timeout=120)
    os.close(leader)
    return written


def tables_of(store):
    """Each table with its columns (name, type) as the store has them."""
    with sqlite3.connect(store) as connection:
        names = [name for name, in connection.execute(
            "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")]
        return {name: [(row[1], row[2]) for row in
                       connection.execute(f'PRAGMA table_info("{name}")')] for name in names}


def change(store, statements):
    connection = sqlite3.connect(store, isolation_level=None)
    connection.execute("PRAGMA ignore_check_constraints = ON")
    connection.execute("PRAGMA foreign_keys = OFF")
    for sql, values in statements:
        try:
            connection.execute(sql, values)
        except sqlite3.IntegrityError:
            pass  # a text that may be there once only
    connection.close()


def rows_for_empty_tables(store):
    """Statements that give each table without rows one: numbers 1, texts hostile."""
    with sqlite3.connect(store) as connection:
        empty = [(name, columns) for name, columns in tables_of(store).items()
                 if not connection.execute(f'SELECT 1 FROM "{name}" LIMIT 1').fetchone()]
    for name, columns in empty:
        values = ["CAST(? AS TEXT)" if kind == "TEXT" else "1" for _, kind in columns]
        yield (f'INSERT INTO "{name}" VALUES ({",".join(values)})',
               [HOSTILE] * values.count("CAST(? AS TEXT)"))


def hostile(table, column):
    """Its texts keep their begin, so that what is read by its first letters still is."""
    return (f'UPDATE "{table}" SET "{column}" = CAST(CAST("{column}" AS BLOB) || ? AS TEXT)'
            f' WHERE typeof("{column}") = \'text\'', [HOSTILE])


class HostileTexts(ProgramTest):
    budget = LEAST
    tests = 3
    finished = None

    def finished_store(self, name):
        if HostileTexts.finished is None:
            first = self.folder / "first.db"
            ended_well(call("run", self.file, "--store", first, "--no-dashboard", "--workers", "2"))
            HostileTexts.finished = first.read_bytes()
        path = self.folder / name
        path.write_bytes(HostileTexts.finished)
        return path

    def assert_all_shown(self, invocations):
        """Runs all of them; those whose output had something hostile, as escapes."""
        invocations = list(invocations)
        with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
            written = list(pool.map(lambda words: run(*words, cwd=self.folder), invocations))
        complaints = []
        for words, done in zip(invocations, written):
            found = controls_in(done.stdout) + controls_in(done.stderr)
            if words[0] != "export":  # its answer is a file
                found += forged_lines_in(done.stdout + done.stderr)
            if found:
                complaints.append((words, found[:5], done.stdout[:300], done.stderr[:300]))
        self.assertEqual(complaints, [])
        shown = [words for words, done in zip(invocations, written)
                 if b"\\u001b]0;mine\\u0007" in done.stdout + done.stderr]
        print(f"{len(shown)} of {len(invocations)} showed something", end=" ", flush=True)
        return shown

    def test_every_command_knows_what_it_is_tried_with(self):
        self.assertEqual([name for name in ARGUMENTS if name not in commands()], [])

    def test_texts_of_a_store_are_shown_by_every_command(self):
        store = self.finished_store("all.db")
        change(store, rows_for_empty_tables(store))
        change(store, [hostile(table, column) for table, columns in tables_of(store).items()
                       for column, _ in columns if table != "meta"])
        self.assertTrue(self.assert_all_shown(invocations(store, self.file, self.folder)))

    def test_texts_of_each_table_are_shown(self):
        """What is hostile elsewhere keeps no command from coming to this table."""
        showed = set()
        tables = tables_of(self.finished_store("plain.db"))
        for table, columns in tables.items():
            store = self.folder / f"{table}.db"
            shutil.copyfile(self.folder / "plain.db", store)
            change(store, rows_for_empty_tables(store))
            change(store, [hostile(table, column) for column, _ in columns])
            # Not `compare`: it reads the campaigns, and so refuses stores that others have changed.
            readers = ("status", "ls", "show", "explain", "query", "verify")
            showed.update(words[0] for words in self.assert_all_shown(
                words for words in invocations(store, self.file, self.folder)
                if words[0] in readers and words[-1] != "--json"))
        self.assertEqual(showed, set(readers))

    def test_names_of_files_are_shown_by_every_command(self):
        name = self.folder / os.fsdecode(HOSTILE.replace(b"/", b"").replace(b"\0", b""))
        self.assertTrue(self.assert_all_shown(invocations(name, name, self.folder)))

    def test_keys_and_values_of_files_are_shown(self):
        escapes = r"\u001b[31m\u0007\u009b\u202e\u007f\n"
        texts = [f'"{escapes}" = 1\n', f'["{escapes}"]\nx = 1\n', f'["a"."{escapes}"]\nx = 1\n',
                 "\x1b[31m = 1\n", "x = \x9b\n", "x = '\u202e\n"]
        texts += [campaign_text(LEAST, seed=1, tests=3).replace(old, f'"{escapes}"')
                  for old in ('"aggregation"', '"argos3"', '"watermelon-argos3"', '"survival"')]
        for number, text in enumerate(texts):
            file = self.folder / f"{number}.toml"
            file.write_text(text)
            self.assert_all_shown([[command, file] for command in
                                   ("check", "run", "serve", "import", "track")])

    def test_machine_readable_answers_are_exact_and_a_terminal_gets_none_of_it(self):
        store = self.finished_store("exact.db")
        text = "\x1b[31m\r\x7f\x9b\u202e\n\t\"'\\,=1"
        sql = "SELECT CAST(X'" + text.encode().hex() + "' AS TEXT) AS a, '=1+1' AS b, -1.5 AS c"
        done = run("query", store, sql, "--json")
        self.assertEqual(json.loads(done.stdout)["rows"], [{"a": text, "b": "=1+1", "c": -1.5}])
        self.assertEqual(controls_in(done.stdout), [])
        done = run("query", store, sql, "--csv")
        self.assertEqual(list(csv.reader(io.StringIO(done.stdout.decode(), newline=""))),
                         [["a", "b", "c"], [text, "'=1+1", "-1.5"]])
        self.assertNotIn(b"\r\n", done.stdout)
        for form in ("--csv", "--json"):
            self.assertEqual(controls_in(on_a_terminal("query", store, sql, form), b"\r\n\t"), [])

    def formulas_in(self, table):
        """Cells that a spreadsheet would calculate; and there are cells."""
        self.assertNotIn(b"\r", table)
        rows = list(csv.reader(io.StringIO(table.decode(), newline="")))
        self.assertTrue(rows)
        return [cell for row in rows for cell in row
                if re.match("[=+@\t\r\n-]", cell) and not re.fullmatch("-[0-9.e+-]+|-inf", cell)
                and not re.fullmatch("--?[a-zA-Z][a-zA-Z0-9 ._/:,-]*", cell)]

    def test_no_table_has_a_formula(self):
        store = self.finished_store("formulas.db")
        change(store, [(f"UPDATE design SET {column} = '=1+1'", [])
                       for column in ("mission", "method", "reason")] +
               [("DELETE FROM meta WHERE key = 'row_sums'", [])])
        guarded = 0
        for words in (["query", store, "SELECT * FROM v_designs", "--csv"],
                      ["query", store, "SELECT * FROM v_design_scores", "--csv"],
                      ["query", store, "SELECT '=1', '-2+3', '@x', char(9) || '=1'", "--csv"],
                      ["compare", "--by", "mission", store, "--csv"]):
            done = ended_well(run(*words))
            self.assertEqual(self.formulas_in(done.stdout), [])
            guarded += done.stdout.count(b"'=")
        ended_well(run("supplement", store, "-o", self.folder / "supplement"))
        tables = list((self.folder / "supplement").rglob("*.csv"))
        self.assertGreater(len(tables), 10)
        for table in tables:
            self.assertEqual(self.formulas_in(table.read_bytes()), [], table)
            guarded += table.read_bytes().count(b"'=")
        self.assertGreater(guarded, 100)
        # What was written is read again as what it was.
        scores = self.folder / "scores.csv"
        scores.write_bytes(run("query", store, "SELECT * FROM v_design_scores", "--csv").stdout)
        ended_well(run("import", scores, "--into", store))


if __name__ == "__main__":
    unittest.main()
