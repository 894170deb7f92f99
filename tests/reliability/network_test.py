"""Networks that are cut, lossy, slow, or narrow: hosts are namespaces, delays a proxy."""
import random
import signal
import subprocess
import time
import unittest

from network import Hosts, Proxy
from rig import SWARMSMITH, WORKER, FaultTest, ended_well, events, rows, stored, wait_for


class HostsTest(FaultTest):
    """A coordinator and two workers on hosts of their own."""
    budget = 12000
    port = 5555

    def fleet(self, first=800):
        self.hosts = Hosts(self, ["w1", "w2"])
        # Off loopback, so with keys.
        keys = self.keygen(self.folder / "keys")
        address = f"10.77.0.1:{self.port}"
        self.coordinator = self.serve("--keys", keys, bind=address, prefix=self.hosts.at("c"))
        self.workers = [self.worker(address, "--key", keys / "worker.key",
                                    prefix=self.hosts.at(name)) for name in ("w1", "w2")]
        if first:
            self.wait_stored(first)

    def lost(self):
        return events(self.store, "worker lost")

    def wait_lost(self, number, seconds=12):
        began = time.monotonic()
        wait_for(lambda: len(self.lost()) >= number, f"the loss of {number} workers", seconds)
        return time.monotonic() - began

    def connected(self):
        return self.coordinator.progress().get("workers", 0)

    def finish_all(self):
        numbers = self.finish(self.coordinator, self.workers)
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        return numbers

class Namespaces(HostsTest):
    def test_partition(self):
        """Both cables are pulled: found within seconds, and healed without a restart."""
        self.fleet()
        for name in ("w1", "w2"):
            self.hosts.link(name, "down")
        took = self.wait_lost(2)
        self.assertLess(took, 9)
        self.count("worker partitioned", 2)
        before = stored(self.store)
        for name in ("w1", "w2"):
            self.hosts.link(name, "up")
        began = time.monotonic()
        wait_for(lambda: stored(self.store) > before + 50, "work after the repair", 20)
        print(f"\n  found after {took:.1f} s, at work {time.monotonic() - began:.1f} s after the "
              "repair", end="")
        numbers = self.finish_all()
        self.assertEqual({event["how"] for event in self.lost()}, {"silent"})
        self.assertEqual(numbers["lost_workers"], 2)

    def one_way(self, rule):
        self.fleet()
        for name in ("w1", "w2"):
            self.hosts.nft(name, rule)
        self.wait_lost(2)
        self.count("worker cut in one direction", 2)
        before = stored(self.store)
        time.sleep(2)
        self.assertLess(stored(self.store) - before, 500, "work goes on over a cut")
        for name in ("w1", "w2"):
            self.hosts.nft(name)
        self.finish_all()

    def test_what_workers_say_is_lost(self):
        self.one_way("output drop")

    def test_what_workers_are_told_is_lost(self):
        self.one_way("input drop")

    def test_flapping(self):
        """Cables that are out for 0.2 to 3 s, sixteen times."""
        self.fleet(first=200)
        rng = random.Random(1)
        for _ in range(16):
            if not self.coordinator.alive():
                break
            name = rng.choice(("w1", "w2"))
            self.hosts.link(name, "down")
            time.sleep(rng.uniform(0.2, 3))
            self.hosts.link(name, "up")
            self.count("link down and up")
            time.sleep(rng.uniform(0.05, 0.5))
        # Not the workers: a cable may have been out when they were sent home.
        numbers = self.finish(self.coordinator)
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        self.assertGreater(self.tried["link down and up"], 3)

    def test_coordinator_is_cut_off(self):
        self.fleet()
        self.hosts.link("c", "down")
        self.wait_lost(2)
        self.hosts.link("c", "up")
        self.count("coordinator partitioned")
        self.finish_all()

    def test_loss(self):
        """5 of 100 packets, in both directions."""
        self.fleet(first=0)
        for name in ("w1", "w2"):
            self.hosts.loss(name, 5)
        self.finish_all()
        self.count("campaign with 5 % loss")

    def test_narrow(self):
        self.fleet(first=0)
        for name in ("c", "w1", "w2"):
            self.hosts.tc(name, "tbf", "rate", "1mbit", "burst", "16k", "latency", "300ms")
        self.finish_all()
        self.count("campaign over 1 Mbit/s")

    def test_small_packets(self):
        self.fleet(first=0)
        for name in ("c", "w1", "w2"):
            self.hosts.on(self.hosts.host(name), "ip", "link", "set", "e0", "mtu", "600")
        self.finish_all()
        self.count("campaign with an MTU of 600")


class Ipv6(FaultTest):
    """Hosts without any address of IPv4."""
    budget = 2000

    def test_a_campaign(self):
        hosts = Hosts(self, ["w1", "w2"], six=True)
        keys = self.keygen(self.folder / "keys")
        key = ("--key", keys / "worker.key")
        coordinator = self.serve("--keys", keys, bind="[::]:5555", prefix=hosts.at("c"))
        # What it prints, and what its file has, is what others take.
        self.assertEqual(coordinator.address(), "[fd00:77::1]:5555")
        file = self.folder / "campaign.db.coordinator"
        self.assertIn('endpoint = "tcp://[fd00:77::1]:5555"', file.read_text())
        workers = [self.worker(coordinator.address(), *key, prefix=hosts.at("w1")),
                   self.start("worker", WORKER, "--coordinator", file, "--slots", "1", *key, prefix=hosts.at("w2"))]
        self.wait_stored(50)
        ended_well(subprocess.run([*hosts.at("w1"), SWARMSMITH, "status", "--connect", "[fd00:77::1]:5555", "--json",
                                   "--key", keys / "reader.key"], capture_output=True, text=True, timeout=60, check=False))
        self.finish(coordinator, workers)
        self.assertEqual(rows(self.store, "select count(*) from worker"), [(2,)])
        self.count("campaign over IPv6")

    def test_an_address_of_one_interface_and_link_local_ones(self):
        hosts = Hosts(self, ["w1"], six=True)
        keys = self.keygen(self.folder / "keys")
        coordinator = self.serve("--keys", keys, bind="[fd00:77::1]:5555", prefix=hosts.at("c"))
        self.assertEqual(coordinator.address(), "[fd00:77::1]:5555")
        coordinator.kill()
        local = hosts.run("ip", "-n", hosts.host("c"), "-o", "-6", "addr", "show", "scope", "link").stdout
        local = local.split("inet6 ")[1].split("/")[0]
        # Still being looked for in the network, if it is new.
        wait_for(lambda: "tentative" not in hosts.run("ip", "-n", hosts.host("c"), "-o", "-6", "addr").stdout,
                 "the link-local address")
        coordinator = self.serve("--keys", keys, bind=f"[{local}%e0]:5555", prefix=hosts.at("c"))
        key = ("--key", keys / "worker.key")
        nowhere = self.worker(f"[{local}]:5555", *key, prefix=hosts.at("w1"))
        wait_for(lambda: "needs the interface of this host" in nowhere.log(), "the worker's word")
        nowhere.send(signal.SIGTERM)
        self.assertEqual(nowhere.wait(), 0, nowhere.tail())
        worker = self.worker(f"[{local}%e0]:5555", *key, prefix=hosts.at("w1"))
        self.finish(coordinator, [worker])


class Names(FaultTest):
    """Hosts that know their own names, and not each other's."""
    budget = 2000

    def campaign(self, address, *arguments):
        hosts = Hosts(self, ["w1"])
        keys = self.keygen(self.folder / "keys")
        coordinator = self.serve("--keys", keys, *arguments, bind="0.0.0.0:5555",
                                 prefix=hosts.known_as("c", "debian12", address))
        worker = self.start("worker", WORKER, "--coordinator", self.folder / "campaign.db.coordinator", "--slots", "1",
                            "--key", keys / "worker.key", prefix=hosts.at("w1"))
        return coordinator, worker

    def test_a_name_of_loopback_is_not_advertised(self):
        """As Debian's installer writes it: 127.0.1.1 debian12."""
        coordinator, worker = self.campaign("127.0.1.1")
        self.assertEqual(coordinator.address(), "10.77.0.1:5555")
        self.finish(coordinator, [worker])

    def test_the_numbers_of_a_name_that_others_do_not_know_are_told_too(self):
        coordinator, worker = self.campaign("10.77.0.1")
        self.assertEqual(coordinator.address(), "debian12:5555")
        self.finish(coordinator, [worker])

    def test_a_worker_says_which_name_it_does_not_know(self):
        coordinator, worker = self.campaign("127.0.1.1", "--advertise", "debian12")
        began = time.monotonic()
        wait_for(lambda: "the name `debian12`" in worker.log(), "the worker's word", 20)
        print(f"\n  said after {time.monotonic() - began:.1f} s", end="")
        self.assertTrue(worker.alive(), "it tries on")
        worker.send(signal.SIGTERM)
        self.assertEqual(worker.wait(), 0, worker.tail())
        coordinator.send(signal.SIGTERM)
        coordinator.wait()


class Netem(HostsTest):
    """Delay, jitter and reordering by the kernel, where it can."""

    def test_late_and_out_of_order(self):
        self.fleet(first=0)
        if not self.hosts.has_netem():
            self.coordinator.kill()
            self.skipTest("skipped: this kernel has no netem (the proxy's delays are tested)")
        for name in ("w1", "w2"):
            self.hosts.tc(name, "netem", "delay", "50ms", "30ms", "reorder", "25%", "50%")
        self.finish_all()
        self.count("campaign with netem")


class Delays(FaultTest):
    """A proxy holds bytes back: in order within a connection, out of order between them."""
    budget = 6000

    def late(self, delay, goodbyes_may_be_lost=False):
        serve = self.serve()
        rng = random.Random(2)
        proxies = [Proxy(self, serve.address(), delay=lambda direction: delay(rng))
                   for _ in range(3)]
        workers = [self.worker(proxy.address) for proxy in proxies]
        numbers = self.finish(serve, [] if goodbyes_may_be_lost else workers)
        self.count("campaign with late bytes")
        self.assert_none(numbers, "failed", "rejected", "conflicts")
        return numbers

    def test_50_ms_and_jitter(self):
        numbers = self.late(lambda rng: rng.uniform(0.02, 0.08))
        self.assertEqual((numbers["lost_workers"], numbers["expired"]), (0, 0))

    def test_sometimes_seconds(self):
        # Whose goodbye was on its way when the coordinator left looks for it for ten minutes.
        self.late(lambda rng: rng.uniform(1, 7) if rng.random() < 0.01 else 0.001,
                  goodbyes_may_be_lost=True)

    def test_connections_are_broken_again_and_again(self):
        serve = self.serve()
        proxy = Proxy(self, serve.address())
        workers = [self.worker(proxy.address) for _ in range(2)]
        rng = random.Random(3)
        while serve.alive() and self.tried.get("connection broken", 0) < 30:
            time.sleep(rng.uniform(0.05, 0.6))
            proxy.cut()
            self.count("connection broken", 2)
        self.finish(serve, workers)


if __name__ == "__main__":
    unittest.main()
