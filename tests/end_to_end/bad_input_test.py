"""Every mistake is answered with what is wrong, where, and what to do, and nothing is damaged."""
import json
import os
import re
import signal
import socket
import sqlite3
import struct
import subprocess
import unittest

import programs
from programs import SWARMSMITH, ProgramTest, call, campaign_text, ended_well, wait_for

LEAST = 1350  # what the whole space needs
EXPLORE = ["--nstates", "1", "--s0", "0", "--rwm0", "10"]
DEADLINE_S = 60 * programs.PATIENCE


class BadInput(ProgramTest):
    budget = LEAST
    tests = 3
    finished = None

    def store(self, name="campaign.db"):
        """A copy of a finished store of the campaign, which is made once."""
        if BadInput.finished is None:
            file = self.folder / "first.toml"
            file.write_text(campaign_text(LEAST, seed=7, tests=3))
            first = self.folder / "first.db"
            ended_well(call("run", file, "--store", first))
            BadInput.finished = first.read_bytes()
        path = self.folder / name
        path.write_bytes(BadInput.finished)
        return path

    def assert_refused(self, code, sentence, *arguments, **keywords):
        """One line that says it, nothing on standard output, the exit code."""
        done = call(*arguments, cwd=self.folder, **keywords)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def start_logged(self, *arguments, name="log"):
        log = self.folder / name
        with log.open("w") as stream:
            process = subprocess.Popen([SWARMSMITH, *map(str, arguments)], stderr=stream,
                                       stdout=subprocess.DEVNULL, start_new_session=True,
                                       cwd=self.folder)
        self.addCleanup(self._end, process)
        return process, log

    def serve(self, store, *arguments):
        """A coordinator on a port that the system has chosen, and its address."""
        process, log = self.start_logged("serve", self.file, "--store", store,
                                         *(arguments or ("--bind", "127.0.0.1:0")))
        said = wait_for(lambda: re.search(r"--connect (\S+)\n", log.read_text()), "the address")
        return process, said.group(1)


class CampaignFile(BadInput):
    def changed(self, *changes, **values):
        text = campaign_text(**{"seed": 7, "budget": LEAST, "tests": 3, **values})
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.file.write_text(text)

    def test_one_thing_wrong_is_one_line_with_its_place(self):
        cases = [
            (('[campaign]', '[campain]'), ':3:2: the file has no key `campain`'),
            (('seed = 7', 'seed = "7"'), ":5:8: `seed` must be an integer, not a text"),
            (('seed = 7', 'seed = -7'), ":5:8: `seed` must be at least 0, not -7"),
            (('"aggregation"', '"agregation"'), 'did you mean "aggregation"?'),
            (('"watermelon-argos3"', '"watermelo"'), 'did you mean "watermelon"?'),
            (('flavour =', 'behaviours = ["exploraton"]\nflavour ='), 'did you mean "exploration"?'),
            (('profile = "argos3"', 'profile = "argos"'), 'did you mean "argos3"?'),
            (('max_experiments = 1350', 'max_experiments = 1e4'), "must be an integer"),
            (('max_experiments = 1350', 'max_experiments = 1000000000000'), "from 1 to 100000000"),
            (('"aggregation"', '"aggregation"\nrobots = 60'), "arena too small for 60 robots"),
            (('format = 1', 'format = 2'), "newer than this program"),
        ]
        for change, sentence in cases:
            with self.subTest(sentence):
                self.changed(change)
                self.assertRegex(self.assert_refused(2, sentence, "check", "campaign.toml"),
                                 r"campaign\.toml:\d+:\d+: ")
                self.assert_refused(2, sentence, "run", "campaign.toml", "--store", "no.db")
        self.assertFalse((self.folder / "no.db").exists())

    def test_missions_and_profiles_in_files_are_told_by_their_own_place(self):
        mission = self.folder / "mine.toml"
        profile = self.folder / "my_rvr.toml"
        good = 'format = 1\npreset = "aggregation"\n'
        missions = [
            ('[arena]\nshape = "polygon"\nwalls = [[0, 0, 1, 0], [1, 0, 0, 1], [0, 1, 0, 0.5]]\n',
             "mine.toml:5:9: the walls are not closed: wall 3 ends at (0, 0.5)"),
            ('[arena]\nshape = "polygon"\ncorners = [[0, 0], [2, 2], [2, 0], [0, 2]]\n',
             "mine.toml:5:11: these walls do not make an arena: side 1"),
            ('[arena]\nshape = "square"\nside = nan\n', "mine.toml:5:8: `side` must be from"),
            ('[arena]\nshape = "square"\nside = -3\n', "mine.toml:5:8: `side` must be from"),
            ('robots = 90\n', "mine.toml:3:10: mission \"mine\": arena too small for 90 robots"),
            ('arena.spots = [{ shape = "image", x = 0, y = 0, width = 1, height = 1, '
             'file = "my_rvr.toml" }]\n', "my_rvr.toml: this is not a PNG image"),
            ('arena.spots = [{ shape = "image", x = 0, y = 0, width = 1, height = 1, '
             'file = "none.png" }]\n', "none.png: there is no such image file"),
        ]
        profile.write_text('format = 1\nbase = "rvr"\n')
        evaluate = ["evaluate", *EXPLORE, "--flavour", "watermelon", "--mission", mission.name, "--profile", profile.name]
        for keys, sentence in missions:
            with self.subTest(sentence):
                mission.write_text(good + keys)
                self.assert_refused(2, sentence, *evaluate)
                self.changed(('name = "aggregation"', 'preset = "mine.toml"'))
                self.assert_refused(2, sentence, "check", "campaign.toml")
        mission.write_text(good)
        for keys, sentence in [
                ('[proximity]\nsd = -1\n', "my_rvr.toml:4:6: `sd` must be from 0 to 1, not -1"),
                ('[timing]\njiter = 0\n', 'my_rvr.toml:4:1: [timing] has no key `jiter` (did you'),
                ('[timing]\ndelays = [{ time = "20 ms", probability = 0.5 }]\n',
                 "my_rvr.toml:4:10: the probabilities of `delays` must sum to 1")]:
            with self.subTest(sentence):
                profile.write_text('format = 1\nbase = "rvr"\n' + keys)
                self.assert_refused(2, sentence, *evaluate)
                self.changed(('profile = "argos3"', 'profile = "my_rvr.toml"'))
                self.assert_refused(2, sentence, "check", "campaign.toml")

    def test_everything_wrong_is_told_at_once_in_the_order_of_the_file(self):
        self.changed(("seed = 7", "seed = 1.5"), ('"aggregation"', '"aggregation"\nrobots = 0'),
                     ("max_experiments", "fist_test = 5\nmax_experiments"),
                     ('profile = "argos3"', "profile = 3"))
        done = call("check", "campaign.toml", cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        places = [int(line.split(":")[2]) for line in done.stderr.splitlines()]
        self.assertEqual(places, [5, 10, 19, 23], done.stderr)

    def test_what_is_no_campaign_file(self):
        self.file.write_bytes(b"")
        done = call("check", "campaign.toml", cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("campaign.toml:1:1: the file must begin with its format: format = 1",
                      done.stderr)
        self.file.write_bytes(bytes(range(256)) * 20)
        self.assert_refused(2, "this is not TOML", "check", "campaign.toml")
        (self.folder / "folder").mkdir()
        self.assert_refused(2, "folder: this is a folder; name the campaign file in it", "check",
                            "folder")

    def test_the_smallest_budget_is_named_and_works(self):
        self.changed(budget=10)
        said = self.assert_refused(2, "must be at least", "check", "campaign.toml")
        least = int(re.search(r"at least (\d+)", said).group(1))
        self.assertEqual(least, LEAST)
        self.changed(budget=least)
        self.assertEqual(self.run_campaign(self.folder / "least.db").returncode, 0)

    def test_a_flag_wins_over_a_budget_that_is_too_small(self):
        self.changed(budget=10)
        store = self.folder / "flag.db"
        ended_well(self.run_campaign(store, "--budget", LEAST))
        self.assertEqual(self.digest(store), self.digest(self.store_of_file(LEAST)))
        self.assert_refused(2, "--budget: method", "run", "campaign.toml", "--budget", 11)

    def store_of_file(self, budget):
        self.changed(budget=budget)
        store = self.folder / "file.db"
        self.assertEqual(self.run_campaign(store).returncode, 0)
        return store

    def test_a_design_has_the_budget_that_min_experiments_makes(self):
        self.changed(("max_experiments = 1350", "max_experiments = 10\nmin_experiments = 1500"))
        plan = json.loads(call("check", self.file, "--json").stdout)
        self.assertEqual(plan["experiments"], 1500)
        store = self.folder / "min.db"
        done = ended_well(self.run_campaign(store, "--json"))
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual({e["budget"] for e in events if e["event"] == "progress"}, {1500})
        self.assertEqual(events[-1]["event"], "done")
        rows = self.query(store, "SELECT budget, used FROM v_designs")
        self.assertEqual(rows[0]["budget"], 1500)
        self.assertGreater(rows[0]["used"], 1350)

    def test_absurd_numbers_on_the_command_line(self):
        for option, value in (("--workers", "0"), ("--workers", "-1"), ("--workers", "1" * 30),
                              ("--budget", "0"), ("--budget", "9" * 12), ("--seed", "x"),
                              ("--seed", "-1")):
            with self.subTest(option + value):
                self.assert_refused(2, option + ": Value " + value, "run", "campaign.toml", option,
                                    value)


class BadStore(BadInput):
    reading = (["digest"], ["verify"], ["query"], ["ls", "designs"], ["show", "d1"], ["status"],
               ["export"])

    def assert_unusable(self, path, sentence, writing=True):
        before = path.read_bytes() if path.is_file() else None
        for command in self.reading:
            with self.subTest(command[0] + " " + path.name):
                self.assert_refused(3, sentence, *command, "--store", path)
        if writing:
            self.assert_refused(3, sentence, "run", self.file, "--store", path)
        self.assertEqual(path.read_bytes() if path.is_file() else None, before)

    def test_files_that_are_no_store(self):
        whole = self.store().read_bytes()
        path = self.folder / "bad.db"
        path.write_bytes(whole[:20000])
        self.assert_unusable(path, "the store is truncated")
        path.write_bytes(os.urandom(9000))
        self.assert_unusable(path, "not a store")
        path.write_bytes(b"")
        self.assert_unusable(path, "no campaign has begun in it", writing=False)
        path.unlink()
        self.assert_unusable(path, "there is no such store", writing=False)
        self.assert_refused(3, "make it first", "run", self.file, "--store", "nowhere/x.db")
        self.assert_refused(3, "this is a folder", "run", self.file, "--store", ".")

    def test_databases_that_cannot_be_used(self):
        newer = self.store("newer.db")
        self.change(newer, "PRAGMA user_version = 99")
        self.assert_unusable(newer, "has schema 99")
        other = self.folder / "other.db"
        self.change(other, "CREATE TABLE t (a)")
        self.assert_unusable(other, "of another program")
        hollow = self.store("hollow.db")
        self.change(hollow, "DROP TABLE evaluation")
        for command in ("digest", "verify"):
            self.assert_refused(3, "hollow.db: the store's table evaluation is not as Swarmsmith made it",
                                command, hollow)
        without = self.store("without.db")
        self.change(without, "DELETE FROM campaign")
        self.assert_refused(3, "campaign (0 rows for 1)", "digest", without)
        self.change(without, "DELETE FROM meta WHERE key = 'row_sums'")
        self.assert_refused(3, "the table campaign has no row", "digest", without)

    def test_a_store_that_is_damaged_inside(self):
        path = self.store()
        content = bytearray(path.read_bytes())
        content[3 * 8192:-8192] = b"Z" * (len(content) - 4 * 8192)
        path.write_bytes(content)
        for command in ("digest", "verify"):
            done = call(command, path)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertNotIn("internal error", done.stderr)

    @staticmethod
    def change(path, sql):
        connection = sqlite3.connect(path)
        connection.execute(sql)
        connection.commit()
        connection.close()

    def test_another_campaign_is_refused_with_the_keys_that_differ(self):
        store = self.store()
        before = self.digest(store)
        self.assert_refused(3, '"campaign.seed" is 7 in the store and 8 in the campaign', "run",
                            self.file, "--store", store, "--seed", 8)
        self.assertEqual(self.digest(store), before)

    def test_a_store_that_is_written_names_who_does_it(self):
        store = self.folder / "held.db"
        process, _ = self.serve(store)
        said = self.assert_refused(3, "another process is writing this store", "run", self.file,
                                   "--store", store)
        self.assertIn(f"pid={process.pid} host={socket.gethostname()}", said)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=DEADLINE_S), 143)
        self.assertEqual(self.run_campaign(store).returncode, 0)
        self.assertEqual(self.digest(store), self.digest(self.store()))

    def test_a_read_only_file(self):
        store = self.store()
        store.chmod(0o444)
        self.folder.chmod(0o777)
        nobody = {"user": 65534} if os.geteuid() == 0 else {}  # root may write everything
        try:
            done = subprocess.run([SWARMSMITH, "run", str(self.file), "--store", str(store)],
                                  capture_output=True, text=True, timeout=DEADLINE_S, **nobody)
        except PermissionError:
            return  # the program lies where only root may go
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("may not be written", done.stderr)

    def test_a_folder_that_may_not_be_entered(self):
        store = self.store()
        self.folder.chmod(0o700)
        if os.geteuid() != 0:
            self.skipTest("skipped: only root can become another user")
        for words in (("check", self.file), ("run", self.file, "--store", store), ("status", store),
                      ("init", self.folder / "new.toml"), ("profile", "rvr", "-o", self.folder / "p.toml"),
                      ("pause", store), ("report", store, "-o", self.folder / "r.html"),
                      ("backup", store, self.folder / "b.db"), ("figure", "scores", store),
                      ("export", store, "-o", self.folder / "machine.fsm"),
                      ("track", "check", self.folder / "arena.toml")):
            with self.subTest(words[0]):
                try:
                    done = subprocess.run([SWARMSMITH, *map(str, words)], capture_output=True, user=65534,
                                          text=True, timeout=DEADLINE_S, cwd="/")
                except PermissionError:
                    self.skipTest("skipped: the program lies where only root may go")
                self.assertIn(done.returncode, (1, 2, 3, 4), done.stderr)
                self.assertIn(str(self.folder), done.stderr)
                self.assertNotIn("filesystem error", done.stderr)

    def test_verify_finds_what_was_changed_by_hand(self):
        one = "purpose = 0 AND candidate = 5 AND pair = 1"
        changes = [f"UPDATE evaluation SET score = score + 1 WHERE {one}",
                   f"DELETE FROM evaluation WHERE {one}",
                   "DELETE FROM evaluation WHERE purpose = 2 AND pair = 1",
                   "DELETE FROM race_step WHERE step = 3", "DELETE FROM elite WHERE rank = 1",
                   "DELETE FROM candidate WHERE id = 5", "DELETE FROM pair WHERE number = 2",
                   "DELETE FROM design"]
        for sql in changes:
            with self.subTest(sql):
                store = self.store()
                self.assert_clean(store)
                self.change(store, sql)
                done = call("verify", store, "--json")
                self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
                found = json.loads(done.stdout)
                self.assertFalse(found["clean"])
                self.assertTrue([text for text in found["complaints"] if text.startswith("d1: ")],
                                found["complaints"])

    def test_ids_that_are_not_there(self):
        store = self.store()
        for name in ("c999999", "d2", "e1"):
            self.assert_refused(4, name, "show", name, store)
        self.assert_refused(2, '"xyz" is not an id', "show", "xyz", store)
        self.assert_refused(4, "c999999", "evaluate", "c999999", "--store", store)

    def test_sql_that_writes_or_is_none(self):
        store = self.store()
        before = store.read_bytes()
        for sql in ("DELETE FROM design", "ATTACH 'x' AS y", "SELECT 1; SELECT 2", "DROP TABLE meta",
                    "PRAGMA journal_mode = DELETE", "VACUUM INTO 'copy.db'", "SELEKT 1",
                    "WITH a AS (SELECT 1) DELETE FROM meta"):
            with self.subTest(sql):
                self.assert_refused(2, ": ", "query", store, sql)
        self.assert_refused(2, "one statement at a time", "ls", "designs", store, "--where",
                            "1; DROP TABLE x")
        self.assertEqual(store.read_bytes(), before)

    def test_a_finished_store_gives_its_result_again(self):
        store = self.store()
        before = self.digest(store)
        done = ended_well(self.run_campaign(store))
        self.assertIn("finished after", done.stdout)
        self.assertEqual(self.digest(store), before)


def zmtp(address, *messages):
    """Speaks ZMTP 3.0 as a DEALER: sends the messages, returns the socket."""
    host, port = address.split(":")
    peer = socket.create_connection((host, int(port)), timeout=DEADLINE_S)
    peer.sendall(b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\0") + bytes(32))
    receive(peer, 64)
    ready = b"\x05READY" + b"\x0bSocket-Type" + struct.pack(">I", 6) + b"DEALER"
    peer.sendall(b"\x04" + bytes([len(ready)]) + ready)
    flags, size = receive(peer, 2)
    receive(peer, size)
    for message in messages:
        peer.sendall(b"\x02" + struct.pack(">Q", len(message)) + message)
    return peer


def receive(peer, size):
    data = b""
    while len(data) < size:
        part = peer.recv(size - len(data))
        if not part:
            raise ConnectionError("closed")
        data += part
    return data


def answer(peer):
    """One message; short and long frames, commands (heartbeats) are skipped."""
    while True:
        flags = receive(peer, 1)[0]
        size = struct.unpack(">Q", receive(peer, 8))[0] if flags & 2 else receive(peer, 1)[0]
        body = receive(peer, size)
        if not flags & 4 and body:  # an empty one only asks whether the connection stands
            return body


def field(number, value):
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    return varint(number << 3 | 2) + varint(len(value)) + value


def varint(value):
    out = b""
    while value > 127:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


class BadPeers(BadInput):
    def test_strangers_do_not_disturb_a_campaign(self):
        store = self.folder / "strangers.db"
        process, address = self.serve(store)
        host, port = address.split(":")
        held = []
        for noise in (b"GET / HTTP/1.1\r\n\r\n", os.urandom(4096), b"\xff" * 100, b""):
            peer = socket.create_connection((host, int(port)))
            held.append(peer)
            self.addCleanup(peer.close)
            try:
                peer.sendall(noise)
            except OSError:
                pass  # thrown out already
        current = b"SWRM" + struct.pack("<HH", 4, 0)
        future = zmtp(address, b"SWRM" + struct.pack("<HH", 99, 0) + b"\x01")
        self.addCleanup(future.close)
        self.assertIn(b"SWRM", answer(future))
        for frames in ([b"nonsense"] * 30, [current + os.urandom(200)] * 30, [bytes((1 << 20) + 1)],
                       [current]):
            try:
                self.addCleanup(zmtp(address, *frames).close)
            except OSError:
                pass
        worker, _ = self.start_logged("worker", "--connect", address, name="worker")
        self.assertEqual(process.wait(timeout=120), 0)
        self.assertEqual(worker.wait(timeout=DEADLINE_S), 0)
        self.assert_clean(store)
        self.assertEqual(self.digest(store), self.digest(self.store()))

    def test_a_worker_of_another_build_is_told_so(self):
        store = self.folder / "builds.db"
        process, address = self.serve(store)
        engine = json.loads(call("version", "--json").stdout)["engine"]
        for version in (engine, engine + 1):
            hello = (field(1, os.urandom(16)) + field(2, b"other") + field(3, version) +
                     field(4, b"0123456789abcdef") + field(5, 1) + field(6, b"host") + field(7, 1))
            message = field(1, 1) + field(2, 1) + field(3, hello)
            peer = zmtp(address, b"SWRM" + struct.pack("<HH", 4, 0) + message)
            self.addCleanup(peer.close)
            self.assertRegex(answer(peer), rb"self.test|version \d+ of the simulator")
        worker, _ = self.start_logged("worker", "--connect", address, name="worker")
        self.assertEqual(process.wait(timeout=120), 0)
        self.assertEqual(self.digest(store), self.digest(self.store()))

    def local_worker(self, code):
        program = self.folder / "worker.sh"
        program.write_text(f"#!/bin/sh\nexit {code}\n")
        program.chmod(0o755)
        return subprocess.run([SWARMSMITH, "run", str(self.file), "--store", "x.db"], text=True,
                              capture_output=True, timeout=DEADLINE_S, cwd=self.folder,
                              env={**os.environ, "SWARMSMITH_WORKER": str(program)})

    def test_local_workers_that_cannot_work(self):
        for code, sentence in ((7, "own workers were refused"), (8, "exit code 8"), (1, "as soon as they are started"),
                               (0, "is it swarmsmith-worker?")):
            done = self.local_worker(code)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn(sentence, done.stderr)
        ended_well(self.run_campaign(self.folder / "x.db"))
        self.assertEqual(self.digest(self.folder / "x.db"), self.digest(self.store()))

    def test_addresses_that_are_none(self):
        for address in ("foo", "127.0.0.1", ":5", "127.0.0.1:99999", "127.0.0.1:x", "ipc:///x", "::1:5555",
                        "[::1]", "[node1]:5555"):
            with self.subTest(address):
                self.assert_refused(2, "invalid address", "worker", "--connect", address)
                self.assert_refused(2, "invalid address", "serve", self.file, "--bind", address)
        for address in ("0.0.0.0:0", "*:5555", "192.0.2.1:5555", "[::]:0", "[fd00::1]:5555"):
            self.assert_refused(2, "swarmsmith keygen", "serve", self.file, "--bind", address,
                                "--keys", self.folder / "no-keys")

    def test_a_worker_without_a_coordinator_says_so(self):
        with socket.socket() as unused:
            unused.bind(("127.0.0.1", 0))
            address = "127.0.0.1:%d" % unused.getsockname()[1]
            worker, log = self.start_logged("worker", "--connect", address)
            wait_for(lambda: "no coordinator answers" in log.read_text(), "the warning")
            self.assertIn(address, log.read_text())
        worker.send_signal(signal.SIGTERM)
        self.assertEqual(worker.wait(timeout=DEADLINE_S), 0)

    def test_a_port_that_is_taken(self):
        with socket.socket() as other:
            other.bind(("127.0.0.1", 0))
            other.listen()
            address = "127.0.0.1:%d" % other.getsockname()[1]
            done = call("serve", self.file, "--store", self.folder / "p.db", "--bind", address)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertIn("another program listens on this port", done.stderr)

    def test_two_coordinators_on_the_default_port_take_two(self):
        addresses = []
        for name in ("one", "two"):
            process, log = self.start_logged("serve", self.file, "--store", name + ".db", name=name)
            said = wait_for(lambda: re.search(r"--connect (\S+)\n", log.read_text()), "the address")
            addresses.append(said.group(1))
        self.assertEqual(len(set(addresses)), 2, addresses)


class Endings(BadInput):
    budget = 20000

    def test_signals_end_a_campaign_that_can_go_on(self):
        store = self.folder / "signals.db"
        for sent, codes in (((signal.SIGTERM,), (143,)), ((signal.SIGINT,), (130,)),
                            ((signal.SIGINT, signal.SIGINT), (130,))):
            process = self.start_campaign(store, "--workers", "1")
            wait_for(lambda: programs.children_of(process.pid), "a worker")
            for one in sent:
                programs.send(process.pid, one)
            self.assertIn(process.wait(timeout=DEADLINE_S), codes)
        self.assertEqual(call("verify", store).returncode, 0)

    def test_a_reader_that_goes_away(self):
        self.file.write_text(campaign_text(LEAST, seed=7, tests=3))
        store = self.store()
        for arguments in (["query", store, "SELECT * FROM v_evaluations"],
                          ["ls", "candidates", store, "--json"],
                          ["run", self.file, "--store", self.folder / "r.db", "--json"]):
            process = subprocess.Popen([SWARMSMITH, *map(str, arguments)], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            process.stdout.read(10)
            process.stdout.close()
            trace = process.stderr.read()
            process.stderr.close()
            self.assertIn(process.wait(timeout=DEADLINE_S), (0, 1, -signal.SIGPIPE))
            self.assertNotRegex(trace, "terminate|Assert|internal error|core")
        ended_well(self.run_campaign(self.folder / "r.db"))
        self.assertEqual(self.digest(self.folder / "r.db"), self.digest(store))

    def test_an_answer_that_cannot_be_written_is_no_success(self):
        store = self.store()
        for command in (["digest", store], ["query", store, "SELECT * FROM v_evaluations"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run([SWARMSMITH, *map(str, command)], stdout=full,
                                      stderr=subprocess.PIPE, text=True, timeout=DEADLINE_S)
            self.assertEqual(done.returncode, 1)
            self.assertIn("could not be written", done.stderr)

    def test_json_is_json_whatever_is_in_it(self):
        sql = "SELECT x'ff00' AS b, 9e999 AS i, char(1, 34, 55296) AS c, NULL AS n"
        done = subprocess.run([SWARMSMITH, "query", str(self.store()), sql, "--json"],
                              capture_output=True, timeout=DEADLINE_S)
        row = json.loads(done.stdout.decode("utf-8"))["rows"][0]
        self.assertIsNone(row["i"])
        self.assertTrue(row["c"].startswith('\x01"'))
        for command in (["status"], ["ls", "designs"], ["ls", "elites"], ["show", "c5"],
                        ["export"], ["digest"], ["verify"]):
            json.loads(call(*command, "--store", self.store(), "--json").stdout)


class Evaluate(BadInput):
    def refused(self, sentence, *arguments):
        if "--flavour" not in arguments:
            arguments = (*arguments, "--flavour", "watermelon")
        self.assert_refused(2, sentence, "evaluate", *arguments)

    def test_machines_that_are_none(self):
        on = ["--mission", "aggregation"]
        self.refused("MACHINE, token 2, column 11", "--nstates", "x", *on)
        self.refused("MACHINE, token 4, column 18", "--nstates", "1", "--s0", "9", *on)
        self.refused("not a machine", "nofile", *on)
        self.refused("--mission: there is no mission", *EXPLORE, "--mission", "agg")
        self.refused("--flavour", *EXPLORE, *on, "--flavour", "f")
        self.refused("--profile", *EXPLORE, *on, "--profile", "f")
        for seeds in ("5-1", "0", "1-", "a", "1,,2", "2147483648"):
            self.refused("--seeds: seeds are written like", *EXPLORE, *on, "--seeds", seeds)
        self.refused("--seeds: seed 3 occurs twice", *EXPLORE, *on, "--seeds", "3,3,3")

    def test_tables_that_are_wrong(self):
        good = ["1,0,0,0,0", "1,1,0.5,0,0", "1,2,0,0.5,0"]
        cases = [(good, "the starts have no row for seed 2"),
                 (["1,0,abc,0,0"], 'starts.csv:2: column x must be a number, not `abc`'),
                 (["1,0,nan,0,0"], 'starts.csv:2: column x must be a finite number, not `nan`'),
                 (["1,0,0"], "starts.csv:2: expected 5 cells as in the header, found 3"),
                 (["1,3,0,0,0"], "starts.csv:2: column robot must be robot 0 of this seed"),
                 (["1,0,9,9,0"] + good[1:], "seed 1: robot 0 is outside the arena")]
        for lines, sentence in cases:
            with self.subTest(sentence):
                table = self.folder / "starts.csv"
                table.write_text("\n".join(["seed,robot,x,y,theta", *lines, ""]))
                self.refused(sentence, *EXPLORE, "--mission", "aggregation", "--seeds", "1-2",
                             "--starts", table)
        table.write_text("")
        self.refused("starts.csv:1: there is no column `seed`", *EXPLORE, "--mission",
                     "aggregation", "--starts", table)
        for line, sentence in (("1,5,5,red", "there is no free place for a patch at (5"),
                               ("1,5,5,rd", "column color must be the name of a colour, or #rrggbb, not `rd`")):
            table.write_text("seed,x,y,color\n" + line + "\n")
            self.refused(sentence, *EXPLORE, "--mission", "color_selection", "--patches", table)
        table.write_text("seed,x,y,color\n1,0.75,0.25,red\n")
        self.refused("patches, seed 1: the mission has 4 green patches, the file 0; 4 red patches, the file 1; "
                     "4 yellow patches, the file 0", *EXPLORE, "--mission", "color_selection", "--patches", table)


if __name__ == "__main__":
    unittest.main()
