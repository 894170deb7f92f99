"""./dev release: what it refuses, what it leaves in the clone, and that its archives are the same bytes for everybody.
The repository here is a small one whose ./dev builds nothing but files of a few bytes."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SWARMSMITH_SOURCE"])
CHANGELOG = "# Changelog\n\nWhat a user notices, newest first.\n\n## Unreleased\n{}\n## 0.1.0 - 2025-01-02\n\n- Begun.\n"
#: What the release calls, with the version that it finds.
DEV = """#!/bin/bash
set -euo pipefail
env | sort >build-environment
version=$(sed -n 's/^project(swarmsmith VERSION \\([0-9.]*\\).*/\\1/p' CMakeLists.txt)
echo "$1" >>build-steps
case $1 in
  build) mkdir build; ! grep -q breaks CHANGELOG.md ;;
  package)
    mkdir -p build/packages build/manual/b
    echo "$version" >build/packages/swarmsmith_${version}_amd64.deb
    for name in z a b/c; do echo "$version" >build/manual/$name; done
    ;;
  bundle) mkdir build/bundle; echo "$version" >build/bundle/swarmsmith-worker-$version-x86_64.tar.xz
    echo "$version" >build/bundle/swarmsmith-$version-py3-none-manylinux1_x86_64.whl ;;
esac
"""


@unittest.skipUnless(shutil.which("git") and shutil.which("xz"), "git or xz is not there")
class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="swarmsmith-release-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.environment = {**os.environ, "HOME": folder.name, "GIT_CONFIG_NOSYSTEM": "1", "LC_ALL": "C.UTF-8"}
        self.clone = self.folder / "clone"
        (self.clone / "packaging").mkdir(parents=True)
        shutil.copy(SOURCE / "packaging/release", self.clone / "packaging")
        (self.clone / "dev").write_text(DEV)
        (self.clone / "dev").chmod(0o755)
        (self.clone / "CMakeLists.txt").write_text("project(swarmsmith VERSION 0.1.0 LANGUAGES CXX)\n")
        (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format("\n- One thing.\n- Another.\n"))
        for name in ("CITATION.cff", "codemeta.json"):
            shutil.copy(SOURCE / name, self.clone)
        (self.clone / ".gitignore").write_text("/build*/\n")
        (self.folder / ".gitconfig").write_text("[user]\nname = Anna\nemail = anna@example.org\n")
        self.git("init", "-q", "-b", "main")
        self.commit("Begin")
        self.git("tag", "v0.1.0")

    def git(self, *words, where=None):
        done = subprocess.run(["git", *words], cwd=where or self.clone, env=self.environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def commit(self, message):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)

    def release(self, *words, where=None, umask=0o022, **environment):
        return subprocess.run(["packaging/release", *words], cwd=where or self.clone, env={**self.environment, **environment},
                              capture_output=True, text=True, umask=umask)

    def made(self, version, where=None):
        """The files of a release by name; their checksums are right."""
        files = {path.name: path.read_bytes() for path in ((where or self.clone) / "build/release" / version).iterdir()}
        listed = dict(reversed(line.split("  ")) for line in files.pop("SHA256SUMS").decode().splitlines())
        self.assertEqual(listed, {name: hashlib.sha256(data).hexdigest() for name, data in files.items()})
        return files

    def assert_refused(self, done, said):
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(said, done.stderr)

    def test_is_a_commit_with_a_tag_and_its_files(self):
        before = self.git("rev-parse", "HEAD")
        done = self.release("0.2.0")
        self.assertEqual(done.returncode, 0, done.stderr)
        files = self.made("0.2.0")
        self.assertEqual(sorted(files), ["swarmsmith-0.2.0-py3-none-manylinux1_x86_64.whl", "swarmsmith-0.2.0.tar.xz",
                                         "swarmsmith-manual-0.2.0.tar.xz",
                                         "swarmsmith-worker-0.2.0-x86_64.tar.xz", "swarmsmith_0.2.0_amd64.deb"])
        self.assertEqual(files["swarmsmith_0.2.0_amd64.deb"], b"0.2.0\n")
        self.assertEqual(self.git("rev-parse", "HEAD^"), before)
        self.assertEqual(self.git("log", "-1", "--format=%s %D"), "Swarmsmith 0.2.0 HEAD -> main, tag: v0.2.0")
        self.assertEqual(self.git("diff", "--name-only", "HEAD^", "HEAD").split(), ["CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "codemeta.json"])
        self.assertRegex((self.clone / "CHANGELOG.md").read_text(),
                         r"first\.\n\n## Unreleased\n\n## 0\.2\.0 - 20\d\d-\d\d-\d\d\n\n- One thing\.\n- Another\.\n\n## 0\.1\.0")
        self.assertIn("VERSION 0.2.0 LANGUAGES", (self.clone / "CMakeLists.txt").read_text())
        self.assertEqual(self.git("status", "--porcelain"), "")
        self.assertEqual(len(self.git("worktree", "list").splitlines()), 1)
        self.assertIn("git push origin main v0.2.0", done.stderr)

    def test_is_cited_by_its_version_and_date(self):
        for version in ("0.2.0", "0.3.0"):  # the second finds a date that is there
            (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format("\n- A thing.\n"))
            self.commit("Changes")
            self.assertEqual(self.release(version).returncode, 0)
            date = re.search(rf"^## {version} - (.*)$", (self.clone / "CHANGELOG.md").read_text(), re.M)[1]
            citation = (self.clone / "CITATION.cff").read_text()
            self.assertEqual(re.findall(r"^(?:version|date-released): .*$", citation, re.M),
                             [f"version: {version}", f"date-released: {date}"])
            described = json.loads((self.clone / "codemeta.json").read_text())
            self.assertEqual((described["version"], described["dateModified"]), (version, date))

    def test_the_files_here_agree(self):
        """Those of this repository have the version of its CMakeLists.txt."""
        version = re.search(r"^project\(swarmsmith VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        self.assertIn(f"\nversion: {version}\n", (SOURCE / "CITATION.cff").read_text())
        self.assertEqual(json.loads((SOURCE / "codemeta.json").read_text())["version"], version)

    def test_has_the_sources_and_the_manual_of_its_commit(self):
        (self.clone / "build").mkdir()
        (self.clone / "build/of_the_developer").write_text("x")
        self.assertEqual(self.release("0.2.0").returncode, 0)
        release = self.clone / "build/release/0.2.0"
        with tarfile.open(release / "swarmsmith-0.2.0.tar.xz") as archive:
            names = archive.getnames()
            self.assertEqual(archive.extractfile("swarmsmith-0.2.0/CHANGELOG.md").read(), (self.clone / "CHANGELOG.md").read_bytes())
        self.assertEqual(sorted(name.partition("/")[2] for name in names),
                         ["", ".gitignore", "CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "codemeta.json", "dev", "packaging", "packaging/release"])
        with tarfile.open(release / "swarmsmith-manual-0.2.0.tar.xz") as archive:
            self.assertEqual(archive.getnames(), [f"swarmsmith-manual-0.2.0{name}" for name in ("", "/a", "/b", "/b/c", "/z")])
            self.assertEqual({(entry.uid, entry.gid, entry.uname) for entry in archive.getmembers()}, {(0, 0, "")})

    def test_is_made_again_with_the_same_bytes(self):
        self.assertEqual(self.release("0.2.0").returncode, 0)
        other = self.folder / "elsewhere/a folder"
        self.git("clone", "-q", str(self.clone), str(other))
        (self.folder / ".gitconfig").write_text("[user]\nname = Bob\nemail = bob@example.org\n[tar]\numask = 0\n")
        self.commit("Later")
        self.git("switch", "-q", "--detach", "v0.2.0", where=other)
        done = self.release(where=other, umask=0o077, LC_ALL="C", TZ="Asia/Tokyo", XZ_DEFAULTS="-0", TAR_OPTIONS="--sort=none",
                            CXXFLAGS="-O0", SWARMSMITH_BUILD_TYPE="Debug", SWARMSMITH_JOBS="7")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.made("0.2.0", other), self.made("0.2.0"))
        self.assertEqual(self.git("status", "--porcelain", where=other), "")

    def test_is_built_in_an_environment_of_its_own(self):
        (self.clone / "dev").write_text(DEV + "[ $1 != bundle ] || cp build-environment build-steps \"$HOME\"\n")
        self.commit("Keep the environment")
        self.assertEqual(self.release("0.2.0", CXXFLAGS="-O0", SWARMSMITH_BUILD_TYPE="Debug", SWARMSMITH_JOBS="3").returncode, 0)
        names = {line.split("=")[0] for line in (self.folder / "build-environment").read_text().splitlines()}
        self.assertLessEqual(names - {"_", "SHLVL", "PWD", "OLDPWD"},
                             {"HOME", "LC_ALL", "PATH", "SOURCE_DATE_EPOCH", "SWARMSMITH_JOBS", "TZ", "USER", "TERM", "CCACHE_DIR",
                              "CCACHE_DISABLE", "CCACHE_MAXSIZE", "http_proxy", "https_proxy", "no_proxy"})
        self.assertEqual((self.folder / "build-steps").read_text().split(), ["build", "package", "bundle"])

    def test_refuses_with_a_reason_and_leaves_all_as_it_was(self):
        for version, said in (("0.1.0", "tag v0.1.0 already exists"), ("0.0.9", "CMakeLists.txt already has version 0.1.0"),
                              ("v0.2.0", "three numbers"), ("0.2", "three numbers"), ("00.2.0", "three numbers")):
            self.assert_refused(self.release(version), said)
        self.assert_refused(self.release("0.2.0", "0.3.0"), "at most one version")
        self.git("tag", "-d", "v0.1.0")
        self.assert_refused(self.release("0.1.0"), "CHANGELOG.md already has a section for 0.1.0")
        (self.clone / "notes.txt").write_text("x")
        self.assert_refused(self.release("0.2.0"), "there are uncommitted changes; commit them, or start in a fresh clone: ?? notes.txt")
        (self.clone / "notes.txt").unlink()
        (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format(""))
        self.assert_refused(self.release("0.2.0"), "M CHANGELOG.md")
        self.commit("No entries")
        self.assert_refused(self.release("0.2.0"), "CHANGELOG.md has nothing below '## Unreleased'")
        self.git("switch", "-q", "--detach")
        self.assert_refused(self.release("0.2.0"), "no branch is checked out")
        self.assertEqual(self.git("log", "-1", "--format=%s"), "No entries")
        self.assertFalse((self.clone / "build/release").exists())

    def test_refuses_to_make_again_what_is_no_release(self):
        (self.clone / "CMakeLists.txt").write_text("project(swarmsmith VERSION 0.2.0 LANGUAGES CXX)\n")
        self.commit("Version by hand")
        self.assert_refused(self.release(), "this commit is not a release: CHANGELOG.md has no section for 0.2.0")

    def assert_finished_by_what_it_says(self, said):
        done = self.release("0.2.0")
        self.assert_refused(done, said)
        self.assertIn("swarmsmith_0.2.0_amd64.deb", self.made("0.2.0"))
        (self.folder / ".gitconfig").write_text("[user]\nname = Anna\nemail = anna@example.org\n")
        subprocess.run(["bash", "-ec", done.stderr.split("finish with: ")[1]], cwd=self.clone, env=self.environment, check=True,
                       capture_output=True)
        self.assertEqual(self.git("rev-parse", "main"), self.git("rev-parse", "v0.2.0^{commit}"))
        self.assertEqual(self.git("log", "-1", "--format=%s", "main"), "Swarmsmith 0.2.0")

    def test_goes_to_its_own_branch_alone(self):
        (self.clone / "dev").write_text(DEV + "[ $1 != bundle ] || git -C ../../.. switch -q -c other\n")
        self.commit("Another branch meanwhile")
        self.assert_finished_by_what_it_says("main is no longer checked out")
        self.assertEqual(self.git("log", "-1", "--format=%s", "other"), "Another branch meanwhile")

    def test_says_how_to_finish_when_git_makes_no_tag(self):
        (self.folder / ".gitconfig").write_text("[user]\nname = Anna\nemail = anna@example.org\n"
                                                "[tag]\ngpgSign = true\n[gpg]\nprogram = false\n")
        self.assert_finished_by_what_it_says("git could not make the tag")

    def test_keeps_other_worktrees(self):
        other = self.folder / "other"
        self.git("worktree", "add", "-q", "-b", "other", str(other))
        other.rename(self.folder / "away")  # as a disk that is not there
        self.assertEqual(self.release("0.2.0").returncode, 0)
        (self.folder / "away").rename(other)
        self.assertEqual(self.git("branch", "--show-current", where=other), "other")

    def test_that_fails_leaves_the_branch_as_it_was(self):
        (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format("\n- It breaks.\n"))
        self.commit("Break it")
        self.assertNotEqual(self.release("0.2.0").returncode, 0)
        self.assertEqual(self.git("log", "-1", "--format=%s"), "Break it")
        self.assertEqual(self.git("tag"), "v0.1.0")
        self.assertEqual(self.git("status", "--porcelain"), "")
        # The same command begins anew, whatever became of the folder of the run that failed.
        work = self.clone / "build/release/work"
        for number, spoil in enumerate((lambda: None, lambda: shutil.rmtree(work), lambda: (work / ".git").unlink()), 2):
            (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format("\n- It breaks.\n"))
            self.commit("Break it")
            self.assertNotEqual(self.release(f"0.{number}.0").returncode, 0)
            spoil()
            (self.clone / "CHANGELOG.md").write_text(CHANGELOG.format("\n- It works.\n"))
            self.commit("Mend it")
            done = self.release(f"0.{number}.0")
            self.assertEqual(done.returncode, 0, done.stderr)


class Changelog(unittest.TestCase):
    def test_of_the_project_is_as_a_release_wants_it(self):
        text = (SOURCE / "CHANGELOG.md").read_text()
        self.assertEqual(len(re.findall(r"^## Unreleased$", text, re.M)), 1)
        for heading in re.findall(r"^## (.*)$", text, re.M):
            self.assertRegex(heading, r"^Unreleased$|^\d+\.\d+\.\d+ - \d{4}-\d\d-\d\d$")


if __name__ == "__main__":
    unittest.main()
