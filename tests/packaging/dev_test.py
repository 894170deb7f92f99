"""./dev on systems that have other packages: what it installs, leaves out and says. apt and dpkg are scripts here, which
know the packages in two files and note what they are asked to do."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
TOOLS = {
    "dpkg-query": 'grep -qx "${@: -1}" "$FAKE/installed" && echo "install ok installed"',
    "apt-cache": 'grep -qx "${@: -1}" "$FAKE/known"',
    "apt-get": 'echo "$*" >>"$FAKE/asked"; case "$*" in *update*) cp "$FAKE/in-the-archive" "$FAKE/known" ;; esac',
    "sudo": 'exec "$@"',
}


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-dev-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, text in TOOLS.items():
            (self.folder / name).write_text(f"#!/bin/bash\n{text}\n")
            (self.folder / name).chmod(0o755)
        self.system(installed="", known="")

    def system(self, installed, known, in_the_archive=""):
        for name, words in (("installed", installed), ("known", known), ("in-the-archive", in_the_archive), ("asked", "")):
            (self.folder / name).write_text("".join(word + "\n" for word in words.split()))

    def dev(self, command, *words):
        """The end of `./dev`, with this command in place of its own."""
        done = subprocess.run(["bash", "-c", f". ./dev help >/dev/null && {command}", "dev", *words], cwd=SOURCE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60,
                              env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "FAKE": str(self.folder)})
        return done.returncode, done.stdout, done.stderr, (self.folder / "asked").read_text()

    def test_what_a_system_lacks_is_left_out_and_said(self):
        self.system(installed="cmake", known="g++ libpng-dev")
        code, out, said, asked = self.dev('can_be_had cmake libpng-dev libroscpp-dev && echo "${had[*]}"')
        self.assertEqual((code, out), (0, "cmake libpng-dev\n"))
        self.assertIn("no package libroscpp-dev; going on without", said)
        self.assertEqual(asked, "", "there are lists; nothing has to be fetched")

    def test_a_new_system_gets_its_lists_first(self):
        self.system(installed="", known="", in_the_archive="g++ libpng-dev")
        code, out, _, asked = self.dev('can_be_had libpng-dev && echo "${had[*]}"')
        self.assertEqual((code, out), (0, "libpng-dev\n"))
        self.assertIn("update", asked)

    def test_programs_are_built_without_ros_where_there_is_none(self):
        self.system(installed="", known="g++ libbox2d-dev")
        code, _, said, asked = self.dev("build_packages=(libbox2d-dev) && install_build_packages cmake")
        self.assertEqual(code, 0, said)
        self.assertIn("libroscpp-dev", said)
        install = asked.splitlines()[-1]
        self.assertIn("install", install)
        self.assertTrue(install.endswith("libbox2d-dev cmake"), install)

    def test_one_package_that_is_not_there_keeps_no_other_from_tests(self):
        self.system(installed="", known="g++ slurmd")
        code, _, said, asked = self.dev("install_for_tests slurmd chromium-headless-shell")
        self.assertEqual(code, 0, said)
        self.assertIn("chromium-headless-shell", said)
        self.assertTrue(asked.splitlines()[-1].endswith("slurmd"), asked)

    def test_wrong_words_are_refused(self):
        for words in (["build", "swarmsmith-x"], ["bundle", "--target", "vax"], ["gate", "nothing"], ["nothing"]):
            done = subprocess.run(["./dev", *words], cwd=SOURCE, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words[-1].removeprefix("--"), done.stderr)


class Gates(unittest.TestCase):
    """A gate of real tests: which of them run, and what is remembered."""
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-gate-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for words in (["init", "-q"], ["config", "user.name", "a"], ["config", "user.email", "a@b"]):
            subprocess.run(["git", *words], cwd=self.folder, check=True)
        (self.folder / ".gitignore").write_text("/build*\n/marks\n")
        (self.folder / "source.cpp").write_text("int a;\n")
        (self.folder / "build").mkdir()
        (self.folder / "marks").mkdir()
        (self.folder / "build/CTestTestfile.cmake").write_text("".join(
            f"add_test(\"{name}\" \"sh\" \"-c\" \"echo >>'{self.folder}/marks/{name}'; {words}\")\n" for name, words in
            (("one", "true"), ("two words", f"test -e {self.folder}/marks/mended"), ("three", "true"),
             ("reporting", "test ! -e ../marks/leak || echo leak >${ASAN_OPTIONS#log_path=}"))))
        subprocess.run("git add -A && git commit -qm one", shell=True, cwd=self.folder, check=True)

    def gate(self):
        """`gate here`, a gate of the tests of build/, by the functions of ./dev."""
        done = subprocess.run(
            ["bash", "-c", f"cd {SOURCE} && . ./dev help >/dev/null && cd {self.folder} && set +e && jobs=1\n"
             "packages_for() { :; }; what_runs() { echo these; }; gate_here() { tests_gate build; }; gate here"],
            capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout

    def runs(self):
        return {mark.name: len(mark.read_text()) for mark in (self.folder / "marks").iterdir() if mark.name not in ("mended", "leak")}

    def test_goes_on_where_it_stopped_for_the_same_tree(self):
        code, table = self.gate()
        self.assertNotEqual(code, 0)
        self.assertIn("3 of 4 tests", table)
        self.assertIn("RED", table)
        (self.folder / "marks/mended").touch()
        code, table = self.gate()
        self.assertEqual((code, "4 of 4 tests" in table, "RED" in table), (0, True, False), table)
        self.assertEqual(self.runs(), {"one": 1, "two words": 2, "three": 1, "reporting": 1})
        code, table = self.gate()
        self.assertEqual((code, "green" in table), (0, True), table)
        self.assertEqual(self.runs()["two words"], 2)

    def test_another_tree_begins_anew_also_before_it_is_in_a_commit(self):
        (self.folder / "marks/mended").touch()
        self.assertEqual(self.gate()[0], 0)
        (self.folder / "source.cpp").write_text("int b;\n")
        self.assertEqual(self.gate()[0], 0)
        self.assertEqual(set(self.runs().values()), {2})

    def test_a_report_of_a_sanitizer_is_red_whatever_the_tests_say(self):
        (self.folder / "marks/mended").touch()
        (self.folder / "marks/leak").touch()
        code, table = self.gate()
        self.assertNotEqual(code, 0)
        self.assertIn("RED", table)


if __name__ == "__main__":
    unittest.main()
