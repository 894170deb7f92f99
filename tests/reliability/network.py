"""Networks that tests may break: a proxy before a coordinator, hosts made of namespaces."""
import contextlib
import itertools
import queue
import secrets
import socket
import subprocess
import threading
import time
import unittest

from rig import need, need_root
from wire import COMMAND, GREETING, Frames, packed


class Proxy:
    """Passes TCP connections on to `target`, late, slowly, changed, or recorded.

    delay(direction) gives the seconds that a piece waits ("up": from the one who connected);
    pieces of a connection stay in order, those of different connections do not. rewrite(direction,
    body) gives the frame to send in place of one of ZMTP's message frames; it needs mechanism NULL.
    """

    def __init__(self, test, target, delay=None, rewrite=None):
        host, port = target.rsplit(":", 1)
        self.target = (host, int(port))
        self.delay = delay
        self.rewrite = rewrite
        self.numbers = itertools.count()
        self.recorded = {}  # (connection, direction) -> bytes
        self.sockets = []
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self.listener.getsockname()[1]
        self.thread(self.accept)
        test.addCleanup(self.close)

    @staticmethod
    def thread(work, *arguments):
        threading.Thread(target=work, args=arguments, daemon=True).start()

    def close(self):
        """Ends all connections; new ones are refused."""
        with contextlib.suppress(OSError):
            self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.cut()

    def cut(self):
        """Ends all connections; new ones are passed on."""
        ended, self.sockets = self.sockets, []
        for it in ended:
            with contextlib.suppress(OSError):
                it.shutdown(socket.SHUT_RDWR)
            it.close()

    def accept(self):
        with contextlib.suppress(OSError):
            while True:
                near, _ = self.listener.accept()
                try:
                    far = socket.create_connection(self.target, 5)
                    far.settimeout(None)
                except OSError:
                    near.close()
                    continue
                self.sockets += [near, far]
                number = next(self.numbers)
                for it in (near, far):
                    it.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                ends = itertools.count(1)
                self.pass_on(number, "up", near, far, ends)
                self.pass_on(number, "down", far, near, ends)

    def pass_on(self, number, direction, source, sink, ends):
        pieces = queue.Queue(maxsize=1000)
        self.recorded[number, direction] = bytearray()

        def read():
            frames = Frames()
            with contextlib.suppress(OSError):
                while some := source.recv(65536):
                    self.recorded[number, direction] += some
                    if self.rewrite:
                        some = self.rewritten(frames, direction, some)
                        if not some:
                            continue  # a part of a frame
                    wait = self.delay(direction) if self.delay else 0
                    pieces.put((time.monotonic() + wait, some))
            pieces.put((0, b""))

        def write():
            with contextlib.suppress(OSError):
                while True:
                    when, some = pieces.get()
                    time.sleep(max(0, when - time.monotonic()))
                    if not some:
                        break
                    sink.sendall(some)
            for it in (source, sink):
                with contextlib.suppress(OSError):
                    it.shutdown(socket.SHUT_RDWR)
            if next(ends) == 2:  # both ways: a test of hundreds of kills would run out of descriptors
                for it in (source, sink):
                    with contextlib.suppress(ValueError):
                        self.sockets.remove(it)
                    it.close()

        self.thread(read)
        self.thread(write)

    def rewritten(self, frames, direction, some):
        # Greetings are sent in pieces, each an answer to the other side's: passed on as they come.
        greeting = max(0, len(GREETING) - frames.passed)
        frames.passed += len(some)
        out = some[:greeting]
        for flags, body in frames.feed(some):
            if flags is None:
                continue
            if flags & COMMAND:
                out += packed(body, COMMAND)
            else:
                out += packed(self.rewrite(direction, body), flags & 1)
        return out


class Hosts:
    """A coordinator's host "c" and workers' hosts on one switch, all of them network namespaces.

    The switch has a namespace of its own, so that nothing outside of them is touched.
    """

    def __init__(self, test, names, six=False):
        """`six`: the hosts have addresses of IPv6 alone, fd00:77::1 for "c"."""
        need_root("a network namespace")
        for program, package in (("ip", "iproute2"), ("nft", "nftables"), ("tc", "iproute2")):
            need(program, package)
        self.test = test
        self.prefix = "sw" + secrets.token_hex(3)
        self.switch = self.prefix + "-switch"
        self.names = ["c", *names]
        test.addCleanup(self.close)
        try:
            self.run("ip", "netns", "add", self.switch)
        except subprocess.CalledProcessError as error:
            raise unittest.SkipTest(f"skipped: no namespaces here: {error.stderr}") from None
        self.on(self.switch, "ip", "link", "add", "b0", "type", "bridge")
        self.on(self.switch, "ip", "link", "set", "b0", "up")
        for number, name in enumerate(self.names, start=1):
            host = self.host(name)
            self.run("ip", "netns", "add", host)
            self.run("ip", "-n", self.switch, "link", "add", f"v-{name}", "type", "veth", "peer",
                     "name", "e0", "netns", host)
            self.run("ip", "-n", self.switch, "link", "set", f"v-{name}", "master", "b0", "up")
            # Without a look for who else has it, which takes a second.
            address = [f"fd00:77::{number}/64", "nodad"] if six else [f"10.77.0.{number}/24"]
            try:
                self.run("ip", "-n", host, "addr", "add", *address, "dev", "e0")
            except subprocess.CalledProcessError as error:
                raise unittest.SkipTest(f"skipped: no such addresses here: {error.stderr}") from None
            for link in ("lo", "e0"):
                self.run("ip", "-n", host, "link", "set", link, "up")

    @staticmethod
    def run(*command):
        return subprocess.run(command, check=True, capture_output=True, text=True, timeout=30)

    def host(self, name):
        return f"{self.prefix}-{name}"

    def on(self, host, *command):
        return self.run("ip", "netns", "exec", host, *command)

    def at(self, name):
        """What to put before a command to run it on a host."""
        return ("ip", "netns", "exec", self.host(name))

    def known_as(self, name, host_name, address):
        """As `at`, on a host that knows its own name by this address, as /etc/hosts of Debian's installer has it."""
        hosts = self.test.folder / f"hosts-{name}"
        hosts.write_text(f"127.0.0.1 localhost\n{address} {host_name}\n")
        return (*self.at(name), "unshare", "--uts", "--mount", "sh", "-c",
                f"mount --bind '{hosts}' /etc/hosts && hostname {host_name} && exec \"$@\"", "sh")

    def close(self):
        for host in [self.switch, *map(self.host, self.names)]:
            subprocess.run(["ip", "netns", "del", host], capture_output=True, check=False)
        left = self.run("ip", "netns", "list").stdout
        self.test.assertNotIn(self.prefix, left, "a namespace is left")

    # --- faults ---

    def link(self, name, state):
        """"down" cuts the host off without a word: the switch's end of its cable."""
        self.run("ip", "-n", self.switch, "link", "set", f"v-{name}", state)

    def nft(self, name, *rules):
        """Replaces the host's rules by these; each is "input ..." or "output ..."."""
        text = "flush ruleset\ntable inet faults {\n"
        for chain in ("input", "output"):
            text += f"chain {chain} {{ type filter hook {chain} priority 0;\n"
            text += "".join(rule.split(" ", 1)[1] + "\n" for rule in rules
                            if rule.startswith(chain + " "))
            text += "}\n"
        subprocess.run([*self.at(name), "nft", "-f", "-"], input=text + "}\n", text=True,
                       check=True, capture_output=True, timeout=30)

    def loss(self, name, percent):
        rule = f"numgen random mod 100 < {percent} counter drop"
        self.nft(name, "input " + rule, "output " + rule)

    def tc(self, name, *words):
        self.on(self.host(name), "tc", "qdisc", "replace", "dev", "e0", "root", *words)

    def has_netem(self):
        try:
            self.tc("c", "netem", "delay", "1ms")
        except subprocess.CalledProcessError:
            return False
        self.on(self.host("c"), "tc", "qdisc", "del", "dev", "e0", "root")
        return True
