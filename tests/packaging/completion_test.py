"""Completion: what the programs offer, and what bash, zsh and fish make of it."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from man_pages_test import commands_in, options_in

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))
sys.path[:0] = [str(SOURCE / "packaging"), str(SOURCE / "packaging/completion")]
import programs  # noqa: E402
import write as completion  # noqa: E402

CAMPAIGN = """\
format = 1
[campaign]
store = "{store}"
[[mission]]
name = "aggregation"
  [mission.instances]
  test = {{ count = 2 }}
[[method]]
name       = "{method}"
baseline   = "--nstates 1 --s0 0 --rwm0 10"
flavour    = "watermelon"
[race]
max_experiments = 2000
"""


class CompletionTest(unittest.TestCase):
    """Tests in a folder with two stores, a damaged one and a folder."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-completion-")
        cls.addClassCleanup(folder.cleanup)
        cls.prefix = pathlib.Path(folder.name) / "usr"
        completion.write_scripts(cls.prefix)
        cls.folder = pathlib.Path(folder.name) / "work"
        (cls.folder / "runs").mkdir(parents=True)
        cls.environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "HOME": folder.name, "LC_ALL": "C.UTF-8"}
        cls.environment.pop("SWARMSMITH_STORE", None)
        for store, method in (("first", "wander"), ("second", "stroll")):
            (cls.folder / "campaign.toml").write_text(CAMPAIGN.format(store=f"{store}.db", method=method))
            cls.said("swarmsmith", "run", "campaign.toml", "--no-dashboard", "--workers", "1")
        whole = (cls.folder / "first.db").read_bytes()
        (cls.folder / "damaged.db").write_bytes(whole[:100] + b"\xff" * 8000)

    @classmethod
    def said(cls, *words, check=True, **environment):
        done = subprocess.run([str(word) for word in words], cwd=cls.folder, env={**cls.environment, **environment},
                              capture_output=True, text=True, timeout=60 * PATIENCE, stdin=subprocess.DEVNULL)
        if check and (done.returncode != 0 or (words[1] == "--complete" and done.stderr)):
            raise AssertionError(f"{words}\n{done.stdout}{done.stderr}")
        return done.stdout

    def offered(self, *words, program="swarmsmith", **environment):
        """Words that may come next, without what they mean."""
        return [line.split("\t")[0] for line in self.said(program, "--complete", *words, **environment).splitlines()]


class EveryOffer(CompletionTest):
    def test_every_command_and_option_of_the_help(self):
        tried = 0
        for program in programs.built(BIN):
            overview = self.said(program, "--help")
            if "Commands:" not in overview:
                self.assertLessEqual(options_in(overview), set(self.offered("-", program=program)))
                continue
            for command in commands_in(overview):
                words = command.split()
                self.assertIn(words[-1], self.offered(*words[:-1], words[-1][:1], program=program))
                help_text = self.said(program, *words, "--help")
                if "Commands:" in help_text:  # becomes another program
                    continue
                options = options_in(help_text)
                self.assertLessEqual(options, set(self.offered(*words, "-", program=program)), command)
                tried += len(options)
        self.assertGreater(tried, 300)


class Offers(CompletionTest):
    def test_what_is_given_already_is_not_offered_again(self):
        self.assertIn("--budget", self.offered("run", "--"))
        self.assertNotIn("--budget", self.offered("run", "--budget", "10", "--"))
        self.assertIn("--design", self.offered("report", "--design", "d1", "--"))  # may be repeated

    def test_values(self):
        self.assertEqual(self.offered("compare", "--by", ""), ["source", "method", "mission"])
        self.assertEqual(self.offered("compare", "--by", "m"), ["method", "mission"])
        self.assertEqual(self.offered("compare", "--by=m"), ["--by=method", "--by=mission"])
        self.assertEqual(self.offered("compare", "--by", "=", "m"), ["method", "mission"])  # as bash cuts it
        self.assertEqual(self.offered("figure", "b"), ["box"])
        self.assertEqual(self.offered("profile", "p"), ["pseudo-reality", ":files"])
        self.assertEqual(self.offered("help", "ver"), ["verify", "version"])
        self.assertEqual(self.offered("--v"), ["--version"])
        self.assertIn("--scenario", self.offered("irace", "--s"))
        self.assertEqual(self.offered("irace", "--elitist", ""), ["0", "1"])

    def test_files(self):
        self.assertEqual(self.offered("status", ""), [":stores"])
        self.assertEqual(self.offered("run", ""), [":files"])
        self.assertEqual(self.offered("supplement", "-o", ""), [":folders"])
        self.assertEqual(self.offered("run", "--budget", ""), [])

    def test_of_the_store_that_the_words_name(self):
        for words in (("show", "--store", "first.db", ""), ("show", "--store=first.db", ""), ("pause", "first.db", "")):
            self.assertIn("d1", self.offered(*words))
        self.assertEqual(self.offered("compare", "first.db", "--method", ""), ["wander"])
        self.assertEqual(self.offered("compare", "second.db", "--method", ""), ["stroll"])
        self.assertEqual(self.offered("compare", "--method", "", SWARMSMITH_STORE="second.db"), ["stroll"])
        self.assertEqual(self.offered("compare", "--method", ""), [])  # of several stores, none
        self.assertIn("d1\taggregation, wander", self.said("swarmsmith", "--complete", "figure", "box", "first.db", "--design", ""))

    def test_of_stores_and_what_is_built_in_by_every_program(self):
        wanted = {"DESIGN": "d1", "MISSION": "aggregation", "PROFILE": "rvr", "FLAVOUR": "watermelon"}
        asked = set()
        for program in programs.built(BIN):
            for command in programs.declared(BIN, program)["commands"]:
                for option in programs.options_of(command):
                    for kind in set(option["value"].split("|")) & set(wanted):
                        words = (*command["name"].split(), option["names"][-1])
                        offered = self.offered(*words, "", program=program, SWARMSMITH_STORE="first.db")
                        self.assertIn(wanted[kind], offered, (program, *words))
                        asked.add((program, kind))
        for program in ("swarmsmith", "swarmsmith-robot"):
            for kind in ("DESIGN", "MISSION", "FLAVOUR"):
                self.assertIn((program, kind), asked)

    def test_nothing_of_a_store_that_cannot_be_read(self):
        for store in ("damaged.db", "gone.db", "campaign.toml", "runs"):
            self.assertEqual(self.offered("figure", "box", "--store", store, "--design", ""), [], store)

    def test_nothing_of_words_that_mean_nothing(self):
        for words in (("nonsense", ""), ("run", "--nonsense="), ("version", "x", ""), ("-",), ("show", "d1", "first.db", "y", "")):
            self.assertEqual([word for word in self.offered(*words) if not word.startswith("--")], [], words)
        self.assertEqual(self.said("swarmsmith", "--complete").count("\n"), len(self.offered("")))

    def test_commands_of_another_program(self):
        if not (BIN / "swarmsmith-track").exists():
            self.skipTest("swarmsmith-track is not built")
        self.assertEqual(self.offered("track", "calibrate", ""), ["camera", "arena", "robot"])
        self.assertEqual(self.offered("calibrate", "", program="swarmsmith-track"), ["camera", "arena", "robot"])
        self.assertEqual(self.offered("track", "score", SWARMSMITH_TRACK="/nowhere"), [])


class Shells(CompletionTest):
    def test_bash(self):
        if not shutil.which("bash"):
            self.skipTest("bash is not there")

        def completed(*words, program="swarmsmith", **environment):
            quoted = " ".join(f"'{word}'" for word in words)
            script = (f"source {self.prefix}/share/bash-completion/completions/{program}; COMP_WORDS=({program} {quoted}); "
                      f"COMP_CWORD={len(words)}; _swarmsmith_complete; printf '%s\\n' \"${{COMPREPLY[@]}}\"; "
                      f"complete -p {program} >/dev/null")
            return self.said("bash", "-c", script, **environment).split("\n")[:-1]
        self.check(completed)
        self.assertEqual(completed("compare", "--by", "=", "me"), ["method"])

    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not there")

        def completed(*words, program="swarmsmith", **environment):
            # A shell in a pseudo-terminal, which types the words and Tab, and shows the list. It is ready when its line
            # editor is: before, the terminal itself takes ^U for "forget what was typed".
            script = f"""
zmodload zsh/zpty
zpty shell "cd {self.folder}; PATH=$PATH zsh -f -i"
zpty -w shell 'PS1=; PROMPT=; fpath=({self.prefix}/share/zsh/vendor-completions $fpath); autoload -Uz compinit; compinit -u -d {self.folder}/.zcompdump'
zpty -w shell 'bindkey "^I" complete-word; zstyle ":completion:*" list-prompt ""; zstyle ":completion:*" list-rows-first true; LISTMAX=10000; setopt no_list_beep'
zpty -w shell 'compadd () {{ builtin compadd -O shown_words "$@"; print -rl -- "<" "${{shown_words[@]}}" ">" >> {self.folder}/zsh.out; builtin compadd "$@" }}'
zpty -w shell 'zle-line-init () {{ print re""ady }}; zle -N zle-line-init'
zpty -r shell got '*ready*'
zpty -w -n shell '{program} {" ".join(words)}'$'\\t'
zpty -w -n shell $'\\x15echo do""ne\\n'
zpty -r shell got '*done*'
zpty -d shell
"""
            (self.folder / "zsh.out").unlink(missing_ok=True)
            self.said("zsh", "-f", "-c", script, **environment)
            text = (self.folder / "zsh.out").read_text() if (self.folder / "zsh.out").exists() else ""
            # What it asked about twice is listed once.
            return list(dict.fromkeys(line for line in text.split("\n") if line not in ("<", ">", "")))
        self.check(completed)

    def test_fish(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not there")

        def completed(*words, program="swarmsmith", **environment):
            line = " ".join([program, *words])
            done = self.said("fish", "--no-config", "-c", f"source {self.prefix}/share/fish/vendor_completions.d/{program}.fish; "
                             f"complete -C '{line}'", **environment)
            return [row.split("\t")[0] for row in done.splitlines()]
        self.check(completed)

    def check(self, completed):
        self.assertEqual(completed("ver"), ["verify", "version"])
        self.assertEqual(completed("compare", "first.db", "--by", "me"), ["method"])
        self.assertEqual(completed("compare", "second.db", "--method", "s"), ["stroll"])
        self.assertEqual(completed("show", "--store", "first.db", "d"), ["d1"])
        self.assertEqual(completed("run", "--insec"), ["--insecure-plaintext"])
        self.assertEqual(completed("status", "fi"), ["first.db"])
        self.assertEqual([word.rstrip("/") for word in completed("supplement", "-o", "r")], ["runs"])
        self.assertEqual(completed("run", "camp"), ["campaign.toml"])
        robot = {"program": "swarmsmith-robot", "SWARMSMITH_STORE": "first.db"}
        self.assertEqual(completed("start", "--design", "d", **robot), ["d1"])
        self.assertEqual(completed("world", "--mission", "ag", **robot), ["aggregation"])

    def test_every_program_has_a_script_for_each_shell(self):
        for place in completion.PLACES.values():
            for program in programs.PROGRAMS:
                text = (self.prefix / place.format(program)).read_text()
                self.assertIn(program, text)
                self.assertNotIn("PROGRAM", text)
        declared = re.search(r"add_custom_target\(programs DEPENDS ([^)]*)\)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertLessEqual(set(declared.split()), set(programs.PROGRAMS))


if __name__ == "__main__":
    unittest.main()
