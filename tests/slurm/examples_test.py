"""The files of examples/cluster, as far as they can be checked without a cluster."""
import configparser
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["SWARMSMITH_BIN"])
EXAMPLES = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "examples/cluster"

try:
    import yaml
except ImportError:
    yaml = None


def help_of(words):
    """What the program says of itself, after the words that name its command."""
    program = words[0].rsplit("/", 1)[-1]
    command = [BIN / program] + ([words[1]] if program == "swarmsmith" else [])
    return subprocess.run([*command, "--help"], capture_output=True, text=True, check=True).stdout


class Commands(unittest.TestCase):
    """Every option in an example is one that the programs have."""

    def assert_known(self, words, where):
        known = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", help_of(words)))
        used = [word.split("=")[0] for word in words if word.startswith("-")]
        self.assertTrue(used, where)
        for option in used:
            self.assertIn(option, known, f"{where}: {shlex.join(words)}")

    def test_of_the_batch_scripts(self):
        scripts = sorted(EXAMPLES.glob("*.sbatch"))
        self.assertEqual(len(scripts), 2)
        for script in scripts:
            text = script.read_text().replace("\\\n", " ")
            subprocess.run(["sh", "-n", script], check=True)
            lines = re.findall(r"^(?:exec )?(swarmsmith(?:-worker)? .*?)(?: &)?$", text, re.M)
            self.assertEqual(len(lines), 1, script)
            self.assert_known(shlex.split(lines[0]), script)

    def test_of_the_units(self):
        for unit in sorted(EXAMPLES.glob("systemd/*.service")):
            self.assert_known(shlex.split(read_unit(unit)["Service"]["ExecStart"]), unit)

    @unittest.skipIf(yaml is None, "Debian's package python3-yaml is missing")
    def test_of_the_containers(self):
        count = 0
        for thing in read_manifest():
            for container in pod_of(thing).get("containers", []):
                self.assert_known(container["command"] + container["args"], container["name"])
                count += 1
        self.assertEqual(count, 2)

    def test_of_the_campaign(self):
        done = subprocess.run([BIN / "swarmsmith", "check", EXAMPLES / "thesis.toml"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


def read_unit(file):
    unit = configparser.ConfigParser(interpolation=None, strict=False)
    unit.optionxform = str
    unit.read(file)
    return unit


class Units(unittest.TestCase):
    KNOWN = {
        "Unit": {"Description", "Documentation", "Wants", "After"},
        "Service": {"User", "Group", "StateDirectory", "RuntimeDirectory", "ExecStart",
                    "ExecReload", "Environment", "Restart", "RestartSec", "SuccessExitStatus",
                    "RestartPreventExitStatus", "TimeoutStopSec", "Nice", "NoNewPrivileges",
                    "ProtectSystem", "ProtectHome", "PrivateTmp"},
        "Install": {"WantedBy"},
    }

    def test_have_known_keys_and_end_in_order(self):
        units = sorted(EXAMPLES.glob("systemd/*.service"))
        self.assertEqual(len(units), 2)
        for file in units:
            unit = read_unit(file)
            for section in unit.sections():
                self.assertLessEqual(set(unit[section]), self.KNOWN[section], file)
            # Longer than a drain takes, which is 5 s.
            self.assertGreaterEqual(int(unit["Service"]["TimeoutStopSec"]), 10)
            self.assertNotEqual(unit["Service"]["User"], "root")

    @unittest.skipIf(shutil.which("systemd-analyze") is None, "there is no systemd-analyze")
    def test_are_taken_by_systemd(self):
        with tempfile.TemporaryDirectory(prefix="swarmsmith-units-") as folder:
            for file in sorted(EXAMPLES.glob("systemd/*.service")):
                unit = pathlib.Path(folder) / file.name
                # The programs are not installed where the units have them.
                unit.write_text(file.read_text().replace("/usr/bin/swarmsmith", f"{BIN}/swarmsmith"))
                done = subprocess.run(["systemd-analyze", "verify", "--man=no", unit],
                                      capture_output=True, text=True)
                about = [line for line in done.stderr.splitlines() if file.stem in line]
                self.assertEqual(about, [], done.stderr)


def read_manifest():
    text = (EXAMPLES / "kubernetes/swarmsmith.yaml").read_text()
    return [thing for thing in yaml.safe_load_all(text) if thing]


def pod_of(thing):
    return thing["spec"].get("template", {}).get("spec", {})


@unittest.skipIf(yaml is None, "Debian's package python3-yaml is missing")
class Manifest(unittest.TestCase):
    """What the API server would refuse, and what it would take although it cannot work."""

    VERSIONS = {"Service": "v1", "StatefulSet": "apps/v1", "Deployment": "apps/v1"}
    # Fields of the API that the manifest may have; a wrong name is a field that is dropped.
    FIELDS = {
        "Service": {"clusterIP", "selector", "publishNotReadyAddresses", "ports"},
        "StatefulSet": {"serviceName", "replicas", "selector", "template", "volumeClaimTemplates"},
        "Deployment": {"replicas", "selector", "template"},
        "pod": {"terminationGracePeriodSeconds", "securityContext", "initContainers", "containers",
                "volumes"},
        "container": {"name", "image", "command", "args", "env", "ports", "livenessProbe",
                      "readinessProbe", "resources", "volumeMounts"},
        "probe": {"httpGet", "periodSeconds", "failureThreshold"},
        "volume": {"name", "configMap", "secret", "emptyDir"},
    }

    def setUp(self):
        self.things = {(t["kind"], t["metadata"]["name"]): t for t in read_manifest()}

    def of_kind(self, *kinds):
        return [t for (kind, _), t in self.things.items() if kind in kinds]

    def assert_fields(self, thing, name):
        self.assertLessEqual(set(thing), self.FIELDS[name], name)

    def test_has_known_kinds_and_fields(self):
        self.assertEqual({kind for kind, _ in self.things}, set(self.VERSIONS))
        for thing in self.things.values():
            self.assertEqual(set(thing), {"apiVersion", "kind", "metadata", "spec"})
            self.assertEqual(thing["apiVersion"], self.VERSIONS[thing["kind"]])
            self.assertRegex(thing["metadata"]["name"], r"^[a-z0-9]([-a-z0-9]*[a-z0-9])?$")
            self.assert_fields(thing["spec"], thing["kind"])

    def test_selectors_find_their_pods(self):
        for thing in self.of_kind("StatefulSet", "Deployment"):
            labels = thing["spec"]["template"]["metadata"]["labels"]
            self.assertEqual(thing["spec"]["selector"]["matchLabels"], labels)
        for service in self.of_kind("Service"):
            found = [t for t in self.of_kind("StatefulSet", "Deployment")
                     if service["spec"]["selector"].items() <=
                     t["spec"]["template"]["metadata"]["labels"].items()]
            self.assertEqual([t["spec"]["serviceName"] for t in found],
                             [service["metadata"]["name"]])
            ports = {p["name"]: p["containerPort"]
                     for c in pod_of(found[0])["containers"] for p in c["ports"]}
            for port in service["spec"]["ports"]:
                self.assertEqual(ports[port["targetPort"]], port["port"])

    def test_pods_are_whole(self):
        for thing in self.of_kind("StatefulSet", "Deployment"):
            pod = pod_of(thing)
            self.assert_fields(pod, "pod")
            self.assertGreaterEqual(pod["terminationGracePeriodSeconds"], 10)
            self.assertTrue(pod["securityContext"]["runAsNonRoot"])
            volumes = {v["name"] for v in pod["volumes"]}
            for volume in pod["volumes"]:
                self.assert_fields(volume, "volume")
            volumes |= {claim["metadata"]["name"]
                        for claim in thing["spec"].get("volumeClaimTemplates", [])}
            mounted = set()
            for container in pod["containers"] + pod["initContainers"]:
                self.assert_fields(container, "container")
                self.assertTrue(container["image"])
                self.assertTrue(all(isinstance(w, str) for w in container.get("args", [])))
                mounted |= {mount["name"] for mount in container["volumeMounts"]}
                ports = {port["name"] for port in container.get("ports", [])}
                for probe in ("livenessProbe", "readinessProbe"):
                    if probe in container:
                        self.assert_fields(container[probe], "probe")
                        self.assertIn(container[probe]["httpGet"]["port"], ports)
            self.assertEqual(mounted, volumes)

    def test_one_coordinator_is_alive_and_ready_by_its_own_words(self):
        coordinator, = self.of_kind("StatefulSet")
        self.assertEqual(coordinator["spec"]["replicas"], 1)
        container, = pod_of(coordinator)["containers"]
        self.assertEqual(container["livenessProbe"]["httpGet"]["path"], "/healthz")
        self.assertEqual(container["readinessProbe"]["httpGet"]["path"], "/readyz")
        args = container["args"]
        # Pages beyond loopback: the kubelet asks at the pod's address.
        pages, = [p["containerPort"] for p in container["ports"] if p["name"] == "http"]
        self.assertEqual(args[args.index("--http") + 1], f"0.0.0.0:{pages}")
        token = pathlib.PurePath(args[args.index("--http-token-file") + 1])
        self.assertIn(str(token.parent), {m["mountPath"] for m in container["volumeMounts"]})
        self.assertIn(f"--from-file=keys/{token.name}",
                      (EXAMPLES / "kubernetes/swarmsmith.yaml").read_text())
        store = args[args.index("--store") + 1]
        mounts = {m["mountPath"] for m in container["volumeMounts"] if m["name"] == "store"}
        self.assertIn(str(pathlib.PurePath(store).parent), mounts)
        worker, = self.of_kind("Deployment")
        container, = pod_of(worker)["containers"]
        self.assertIn(f"tcp://{coordinator['spec']['serviceName']}:5555", container["args"])


if __name__ == "__main__":
    unittest.main()
