"""Every block of commands in the README and in docs/ is run here or by another test, or says why it is not."""
import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from command_blocks import SOURCE, blocks_of, blocks_to_run, unmarked_commands

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))

#: Pages whose blocks another program runs. It names the page.
RUN_BY = {
    "README.md": "tests/end_to_end/readme_test.py",
    "docs/getting-started.md": "tests/end_to_end/readme_test.py",
    "docs/tracking.md": "tests/end_to_end/tracking_page_test.py",
    "docs/thesis.md": "examples/thesis/make",  # which writes the page; takes half an hour
}
#: Pages that begin in an empty folder, and those with the stores demo.db and campaign.db.
FROM_NOTHING = ("assessment", "cluster", "flavours", "missions", "profiles", "tutorial-cluster", "tutorial-mission",
                "tutorial-paper")
WITH_STORES = ("figures", "machines", "report", "storage", "trajectories")
ALONE = ("coming-from-irace", "tutorial-real-run")
CAMPAIGN = """\
format = 1
[campaign]
name        = "campaign"
store       = "campaign.db"
repetitions = 2
[[mission]]
name = "aggregation"
  [mission.instances]
  test = { count = 5 }
[[method]]
name    = "watermelon"
flavour = "watermelon"
[[method]]
name       = "two_states"
flavour    = "watermelon"
max_states = 2
[race]
max_experiments = 3000
"""
TARGET_RUNNER = """\
#!/bin/sh
# irace: ID INSTANCE-ID SEED INSTANCE --x X --y Y
shift 4
awk -v x="${2}" -v y="${4}" 'BEGIN { printf "%.6f\\n", (x - 0.3) ^ 2 + (y - 0.7) ^ 2 }'
"""


def call(script, folder, environment):
    """Runs a text of the shell as a person types it: a failing line is the end, and what it left running ends with it."""
    with tempfile.TemporaryFile("w+") as said:
        process = subprocess.Popen(["bash", "-c", "set -eu -o pipefail\n" + script], cwd=folder, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=said, stderr=said, start_new_session=True)
        try:
            code = process.wait(timeout=300 * PATIENCE)
        except subprocess.TimeoutExpired:
            code = "none"
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        said.seek(0)
        if code != 0:
            raise AssertionError(f"exit code {code}\n{said.read()[-3000:]}")


def pages():
    found = ["README.md", "CONTRIBUTING.md"]
    found += [path.relative_to(SOURCE).as_posix() for path in sorted((SOURCE / "docs").rglob("*.md"))]
    return found


class EveryBlock(unittest.TestCase):
    def test_is_run_or_says_why_not(self):
        wrong = []
        for page in pages():
            text = (SOURCE / page).read_text()
            wrong += [f"{page}:{line}: a command in no block of sh: {command}" for line, command in unmarked_commands(text)]
            wrong += [f"{page}:{block.line}: no reason" for block in blocks_of(text) if block.reason.strip(" .") == ""
                      and "<!-- not run:" in text.split("\n")[block.line - 2]]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_of_other_pages_is_run_by_what_names_the_page(self):
        for page, program in RUN_BY.items():
            self.assertIn(pathlib.Path(page).name, (SOURCE / program).read_text(), page)

    def test_of_other_pages_is_run_here(self):
        for page in pages():
            commands = [block for block in blocks_to_run(page) if not block.file]
            if commands and page not in RUN_BY:
                self.assertIn(pathlib.Path(page).stem, FROM_NOTHING + WITH_STORES + ALONE, f"{page}:{commands[0].line}")

    def test_reasons_name_tests_that_are_there(self):
        for page in pages():
            for block in blocks_of((SOURCE / page).read_text()):
                for name in re.findall(r"\b(?:tests|docs)/[\w/.-]*\w", block.reason):
                    self.assertTrue((SOURCE / name).exists(), f"{page}:{block.line}: {name}")


class Commands(unittest.TestCase):
    """Pages whose blocks are run here, each in a folder of its own that looks as its reader's may."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-commands-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "home").mkdir()
        cls.environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "HOME": str(cls.folder / "home")}
        for name in ("SWARMSMITH_STORE", "SWARMSMITH_KEYS", "SWARMSMITH_KEY", "XDG_CONFIG_HOME"):
            cls.environment.pop(name, None)

    def call(self, command, folder):
        call(command, folder, self.environment)

    def follow(self, page, folder):
        """All blocks of a page, in one shell."""
        blocks = blocks_to_run(page)
        self.assertGreater(len(blocks), 0, page)
        script = ""
        for block in blocks:
            if block.file:
                (folder / block.file).write_text(block.text)
            else:
                script += f"echo '== {page}:{block.line}'\n{block.text}"
        with self.subTest(page):
            self.call(script, folder)

    def test_of_pages_that_begin_with_nothing(self):
        for page in FROM_NOTHING:
            folder = self.folder / page
            folder.mkdir()
            self.follow(f"docs/{page}.md", folder)

    def test_of_pages_about_stores(self):
        begin = self.folder / "stores"
        begin.mkdir()
        (begin / "campaign.toml").write_text(CAMPAIGN)
        self.call("swarmsmith run --no-dashboard\nswarmsmith run campaign.toml --no-dashboard\n"
                  "swarmsmith export demo.db --design d1 -o best.fsm", begin)
        (begin / "analysis").symlink_to(SOURCE / "analysis")
        for page in WITH_STORES:
            folder = self.folder / page
            shutil.copytree(begin, folder, symlinks=True)
            self.follow(f"docs/{page}.md", folder)

    def test_of_the_page_about_irace(self):
        folder = self.folder / "irace"
        (folder / "Instances").mkdir(parents=True)
        for number in range(3):
            (folder / "Instances" / f"{number}").touch()
        (folder / "scenario.txt").write_text("maxExperiments = 300\nseed = 1\ntestInstancesDir = \"Instances\"\n")
        (folder / "parameters.txt").write_text('x "--x " r (0, 1)\ny "--y " r (0, 1)\n')
        (folder / "configurations.txt").write_text("x y\n0.1 0.2\n0.3 0.6\n")
        (folder / "target-runner").write_text(TARGET_RUNNER)
        (folder / "target-runner").chmod(0o755)
        self.follow("docs/coming-from-irace.md", folder)

    def test_of_the_first_real_run(self):
        folder = self.folder / "first-run"
        folder.mkdir()
        shutil.copytree(SOURCE / "examples", folder / "examples")
        self.follow("docs/tutorial-real-run.md", folder)
        page = (folder / "lab" / "run01.html").read_text()
        self.assertIn("<h1>run01: VALID</h1>", page)
        self.assertIn("score 1", page)


class TheCheck(unittest.TestCase):
    def test_finds_what_is_not_run(self):
        text = ("```\nswarmsmith a\n```\n\n    ssh node1\n\n```text\nswarmsmith run [FILE]\n```\n- item\n    swarmsmith b\n\n"
                "<!-- not run: needs luck -->\n```sh\nswarmsmith c\n```\n```sh\nswarmsmith d\n```\n")
        self.assertEqual(list(unmarked_commands(text)), [(1, "swarmsmith a"), (5, "ssh node1")])
        self.assertEqual([(block.text, block.reason) for block in blocks_of(text) if block.language == "sh"],
                         [("swarmsmith c\n", "needs luck"), ("swarmsmith d\n", "")])


if __name__ == "__main__":
    unittest.main()
