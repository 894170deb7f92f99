"""An sshd on loopback for one test: its own configuration, host key, client key and free port."""
import os
import pathlib
import shutil
import socket
import subprocess

from one_host import _end_with_the_test, wait_for
from programs import free_ports

SERVER = """\
ListenAddress 127.0.0.1
Port {port}
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/client_key.pub
PidFile {folder}/sshd.pid
StrictModes no
PasswordAuthentication no
KbdInteractiveAuthentication no
UsePAM no
PrintMotd no
MaxStartups {max_startups}
LogLevel VERBOSE
SetEnv XDG_CACHE_HOME={folder}/cache
"""

CLIENT = """\
Host node*
  HostName 127.0.0.1
  Port {port}
Host silent
  HostName 127.0.0.1
  Port {silent}
  ConnectTimeout 1
Host closed
  HostName 127.0.0.1
  Port {closed}
Host *
  IdentityFile {folder}/client_key
  IdentitiesOnly yes
  UserKnownHostsFile {folder}/known_hosts
  StrictHostKeyChecking yes
  LogLevel ERROR
"""


def why_not():
    """Why there can be no sshd here, or nothing."""
    for program, package in (("sshd", "openssh-server"), ("ssh", "openssh-client"),
                             ("ssh-keygen", "openssh-client")):
        if not _program(program):
            return f"{program} of Debian's package {package} is missing"
    if os.geteuid() != 0:
        return "only root may run an sshd that lets users in"
    return None


def _program(name):
    return shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin")


class OneHostSsh:
    """Hosts node1, node2 and so on are this one; `silent` takes connections and says nothing; `closed`
    has no program that listens. `client_config` is what ssh -F takes. Accounts keep things in `cache`."""

    def __init__(self, folder, max_startups="100"):
        self.folder = pathlib.Path(folder)
        self.cache = self.folder / "cache"
        port, closed = free_ports(2)
        self.quiet = socket.socket()
        self.quiet.bind(("127.0.0.1", 0))
        self.quiet.listen()
        for name in ("host_key", "client_key"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f",
                            self.folder / name], check=True)
        (self.folder / "known_hosts").write_text(
            f"[127.0.0.1]:{port} " + (self.folder / "host_key.pub").read_text())
        self.client_config = self.folder / "ssh_config"
        self.client_config.write_text(CLIENT.format(
            port=port, closed=closed, silent=self.quiet.getsockname()[1], folder=self.folder))
        server = self.folder / "sshd_config"
        server.write_text(SERVER.format(port=port, folder=self.folder, max_startups=max_startups))
        pathlib.Path("/run/sshd").mkdir(mode=0o755, exist_ok=True)  # where sshd locks itself in
        # Started again for each connection, so by its whole path.
        with open(self.folder / "sshd.log", "w") as log:
            self.sshd = subprocess.Popen([_program("sshd"), "-D", "-e", "-f", server], stderr=log,
                                         stdin=subprocess.DEVNULL, preexec_fn=_end_with_the_test)
        wait_for(lambda: "listening" in (self.folder / "sshd.log").read_text(), "sshd")

    def turned_away(self):
        """Connections that came while too many others had not logged in yet."""
        return (self.folder / "sshd.log").read_text().count("drop connection")

    def stop(self):
        self.quiet.close()
        self.sshd.terminate()
        self.sshd.wait()
