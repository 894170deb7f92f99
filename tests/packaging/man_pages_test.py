"""Man pages: every command and option of --help is in one, and they render without a warning."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))
sys.path.insert(0, str(SOURCE / "packaging"))
import man_pages  # noqa: E402
import programs  # noqa: E402


def said(*words, **keywords):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=100 * PATIENCE, **keywords)


def options_in(help_text):
    """The options that a help lists: those at the beginnings of its lines."""
    found = set()
    for line in re.split(r"Examples?:", help_text)[0].split("\n"):
        if head := re.match(r" {2,6}((?:-\w|--[\w-]+)(?:, ?(?:-\w|--[\w-]+))*)(?: |$|=)", line):
            found.update(re.split(r", ?", head[1]))
    return found


def commands_in(help_text):
    listed = help_text.split("Commands:\n")[1].split("\n\n")[0] if "Commands:" in help_text else ""
    return re.findall(r"^  ([a-z]+(?: [a-z]+)*)  ", listed, re.M)


class Written(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-man-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        man_pages.write_pages(BIN, cls.folder)


class EveryPage(Written):
    def shown(self, name):
        """A page as `man` shows it, in one line."""
        if not shutil.which("man"):
            self.skipTest("man is not there; install man-db")
        done = said("man", "--warnings", "-E", "UTF-8", "-l", self.folder / f"{name}.1",
                    env={**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8"})
        self.assertEqual((done.returncode, done.stderr), (0, ""), name)
        return re.sub(r"\s+", " ", done.stdout)

    def test_every_command_and_option_of_the_help_is_in_one(self):
        tried = 0
        for program in programs.built(BIN):
            name = programs.declared(BIN, program)["program"]
            overview = said(BIN / program, "--help").stdout
            page = self.shown(programs.page_name(name))
            for option in options_in(overview):
                self.assertIn(f" {option}", page)
            for command in commands_in(overview):
                self.assertIn(f" {command} ", page)
                own = programs.page_name(name, command)
                help_text = said(BIN / program, *command.split(), "--help").stdout
                if "Commands:" in help_text:  # becomes another program
                    continue
                options = options_in(help_text)
                self.assertGreater(len(options), 2, own)
                page_of_command = self.shown(own)
                for option in options:
                    self.assertIn(f" {option}", page_of_command, own)
                    tried += 1
        self.assertGreater(tried, 300)


class ManPages(Written):
    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not there")
    def test_mandoc_has_nothing_to_say(self):
        # Lines longer than 80 bytes are left as they are.
        done = said("mandoc", "-T", "lint", "-W", "warning", *sorted(self.folder.glob("*.1")))
        self.assertEqual(done.stdout, "")

    def test_are_the_same_each_time(self):
        again = self.folder / "again"
        for seed in ("1", "2"):  # of the order that sets have
            subprocess.run([SOURCE / "packaging/man_pages.py", BIN, again], check=True,
                           env={**os.environ, "PYTHONHASHSEED": seed})
            for path in again.iterdir():
                self.assertEqual(path.read_bytes(), (self.folder / path.name).read_bytes())

    def test_exit_codes_and_environment_are_those_of_the_manual(self):
        page = (self.folder / "swarmsmith.1").read_text()
        for word in ("EXIT STATUS", "ENVIRONMENT", "SWARMSMITH_STORE", "130, 143"):
            self.assertIn(word, page)

    def test_no_character_is_taken_for_a_command(self):
        self.assertEqual(man_pages.roff(".x\n'y\\z-"), "\\&.x\n\\&\\(aqy\\ez\\-")


if __name__ == "__main__":
    unittest.main()
