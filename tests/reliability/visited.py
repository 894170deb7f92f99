"""A coordinator with honest workers, for others to visit."""
import contextlib
import os
import socket
import time

from network import Proxy
from rig import FaultTest, events, rows, stored, wait_for
from wire import COMMAND, Frames, frame, message


def connect(address, timeout=5):
    host, port = address.rsplit(":", 1)
    return socket.create_connection((host, int(port)), timeout)


def closed(it, seconds):
    """Whether the other side ends the connection within this time."""
    limit = time.monotonic() + seconds
    with contextlib.suppress(ConnectionError):
        while True:
            it.settimeout(max(0.01, limit - time.monotonic()))
            try:
                if not it.recv(65536):
                    return True
            except TimeoutError:
                return False
    return True


class Visited(FaultTest):
    """A coordinator with two honest workers, and visitors."""
    budget = 20000

    def setUp(self):
        super().setUp()
        if self.designs == 2:
            self.hold()
        self.coordinator = self.serve()
        self.address = self.coordinator.address()
        # One of them is heard, for what its messages look like.
        self.proxy = Proxy(self, self.address)
        self.workers = [self.worker(self.address), self.worker(self.proxy.address)]
        self.wait_stored(300)

    def rate(self, seconds=1.5):
        """Evaluations a second that reach the disk."""
        before, began = stored(self.store), time.monotonic()
        time.sleep(seconds)
        return (stored(self.store) - before) / (time.monotonic() - began)

    def heard(self, direction="up"):
        """The messages of the worker that is heard, as frames of the project."""
        frames = Frames()
        return [body for flags, body in frames.feed(bytes(self.proxy.recorded[0, direction]))
                if flags is not None and not flags & COMMAND]

    def frame_with(self, what):
        """The first frame of the worker that is heard that has this; the other one may have done all so far."""
        return wait_for(lambda: next((body for body in self.heard() if what in message("ToCoordinator", body)), None),
                        f"a frame with {what} of the worker that is heard", 30)

    def hello(self, **changes):
        """What an honest worker says first, from another one."""
        honest = message("ToCoordinator", self.frame_with("hello"))
        hello = {**honest["hello"], "worker_id": os.urandom(16), "host": "stranger", "pid": 1,
                 **changes}
        hello.pop("holds", None)
        return frame("ToCoordinator", {"sequence": 1, "incarnation": 1, "hello": hello})

    def malformed(self):
        return self.coordinator.progress().get("malformed", 0)

    def finish_undisturbed(self):
        """The answer is the usual one, and no honest worker was lost or blamed."""
        numbers = self.finish(self.coordinator, self.workers)
        honest = {worker.pid for worker in self.workers}
        for event in events(self.store, "worker lost"):
            [[pid]] = rows(self.store, f"select pid from worker where id = {event['worker']}")
            self.assertNotIn(pid, honest, "an honest worker was lost")
        return numbers
