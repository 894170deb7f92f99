"""A Slurm cluster of virtual nodes on this host, for one test, in a folder of its own.

Nothing outside of the folder is read or written. The daemons run in the foreground as children of
the test. When it is killed itself, a guard, which waits for that, ends all that is left. Facts about Slurm on one host: several slurmd need
`-N`, a port each and %n in their paths; plugins that want cgroups are left out; `config_overrides`
lets a node have more CPUs than the machine.
"""
import contextlib
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

import programs
from programs import free_ports

PROGRAMS = {"munged": "munge", "slurmctld": "slurmctld", "slurmd": "slurmd",
            "sbatch": "slurm-client", "squeue": "slurm-client"}

CONFIGURATION = """\
ClusterName=onehost
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=30
MinJobAge=300
KillWait=5
NodeName=DEFAULT CPUs={cpus} Sockets=1 CoresPerSocket={cpus} ThreadsPerCore=1 RealMemory=1024
{nodes}
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """Why there can be no cluster here, or nothing."""
    for program, package in PROGRAMS.items():
        if shutil.which(program) is None and not pathlib.Path("/usr/sbin", program).exists():
            return f"Slurm is not installed: {program} of Debian's package {package} is missing"
    if os.geteuid() != 0:
        return "Slurm's daemons start jobs for other users: only root can run them"
    try:
        socket.gethostbyname(socket.gethostname())
    except OSError:
        return f"the name of this host ({socket.gethostname()}) has no address: see /etc/hosts"
    return None


def wait_for(condition, what, seconds=60, pause=0.1):
    """Slurm is asked less often than our own programs are."""
    return programs.wait_for(condition, what, seconds, pause)


def _end_with_the_test():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def processes_of(conf):
    """Processes of this cluster, its daemons, jobs and users: they all know its configuration."""
    mark = f"SLURM_CONF={conf}".encode()
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            if mark in (entry / "environ").read_bytes().split(b"\0"):
                found.append(int(entry.name))
        except OSError:
            pass
    return found


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def guard(folder):
    """Until the test ends, in whatever way; then nothing of its cluster is left."""
    sys.stdin.buffer.read()
    while pids := processes_of(pathlib.Path(folder) / "slurm.conf"):
        for pid in pids:
            kill(pid)
        time.sleep(0.1)
    shutil.rmtree(folder, ignore_errors=True)


class OneHostSlurm:
    """`with OneHostSlurm() as slurm:`, or `start()` and `stop()`."""

    def __init__(self, nodes=4, cpus=2):
        self.nodes = [f"n{i + 1}" for i in range(nodes)]
        self.cpus = cpus
        self.daemons = {}
        self.folder = None
        self.guard = None

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self):
        # Short: a socket's path has at most 107 letters. Root's alone, as munge wants it.
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="slurm-"))
        self.folder.chmod(0o755)
        for name in ["state", "munge"] + [f"spool-{node}" for node in self.nodes]:
            (self.folder / name).mkdir(mode=0o700)
        key = self.folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        control, *ports = free_ports(1 + len(self.nodes))
        host = socket.gethostname().split(".")[0]
        lines = [f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port}"
                 for node, port in zip(self.nodes, ports)]
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(CONFIGURATION.format(host=host, port=control, folder=self.folder,
                                                  cpus=self.cpus, nodes="\n".join(lines)))
        self.guard = subprocess.Popen([sys.executable, __file__, str(self.folder)],
                                      stdin=subprocess.PIPE, start_new_session=True)
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n")
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf),
                            "PATH": os.environ["PATH"] + ":/usr/sbin"}
        self._start("munged", "munged", "--foreground", "--force", "--num-threads=2",
                    f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                    f"--pid-file={self.folder}/munge/pid", f"--log-file={self.folder}/munge/log",
                    f"--seed-file={self.folder}/munge/seed")
        wait_for((self.folder / "munge.socket").exists, "munge's socket")
        self._start("slurmctld", "slurmctld", "-D", "-c", "-f", str(self.conf))
        for node in self.nodes:
            self.start_node(node, "-c")
        wait_for(lambda: self.states() == {node: "idle" for node in self.nodes},
                 "idle nodes; " + self.last_words())

    def _start(self, name, *words):
        log = open(self.folder / f"{name}.out", "w")
        self.daemons[name] = subprocess.Popen(words, env=self.environment, stdout=log, stderr=log,
                                              stdin=subprocess.DEVNULL, start_new_session=True,
                                              preexec_fn=_end_with_the_test)
        log.close()

    def start_node(self, node, *more):
        self._start(node, "slurmd", "-D", *more, "-N", node, "-f", str(self.conf))

    def last_words(self):
        return "\n".join(file.name + ": " + file.read_text(errors="replace")[-800:]
                         for file in sorted(self.folder.glob("*.log")))

    def call(self, *words, check=True, timeout=60):
        """Runs one of Slurm's programs; its output."""
        done = subprocess.run(words, env=self.environment, capture_output=True, text=True,
                              timeout=timeout)
        if check and done.returncode != 0:
            raise AssertionError(f"{words}: {done.stderr}{self.last_words()}")
        return done.stdout.strip()

    def states(self):
        lines = self.call("sinfo", "-h", "-N", "-o", "%N %t", check=False).splitlines()
        return dict(line.split() for line in lines if len(line.split()) == 2)

    def jobs(self, *states, name=None):
        """Ids of the jobs in these states, an id for each element of an array."""
        words = ["squeue", "-h", "-r", "-o", "%i", "--states=" + (",".join(states) or "all")]
        return self.call(*words, *([f"--name={name}"] if name else []), check=False).split()

    def node_of(self, job):
        return self.call("squeue", "-h", "-r", "-j", job, "-o", "%N")

    def kill_node(self, node):
        """As when its power fails: the daemon and all that ran there die at once."""
        mine = f"SLURMD_NODENAME={node}".encode()
        daemon = self.daemons.pop(node)
        daemon.kill()
        daemon.wait()
        steps, tasks = [], []
        for pid in processes_of(self.conf):
            try:
                environment = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
                parent = int(pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1]
                             .split()[1])
                if mine not in environment:
                    continue
                tasks.append(pid)
                if pathlib.Path(f"/proc/{parent}/comm").read_text().startswith("slurmstepd"):
                    steps.append(parent)
            except OSError:
                pass
        # Who would tell the controller of the others' end goes first.
        for pid in steps + tasks:
            kill(pid)

    def stop(self):
        """Ends everything that belongs to the cluster, and removes its folder."""
        if self.folder is None:
            return
        if "slurmctld" in self.daemons:
            try:
                self.call("scancel", "--user=root", check=False, timeout=10)
                wait_for(lambda: not self.jobs("RUNNING", "COMPLETING"), "end of jobs", seconds=8)
            except (AssertionError, subprocess.TimeoutExpired):
                pass  # killed below
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
        for daemon in self.daemons.values():
            try:
                daemon.wait(timeout=5)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.daemons.clear()
        if self.guard is not None:
            self.guard.stdin.close()
            self.guard.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder = None


if __name__ == "__main__":
    guard(sys.argv[1])
