"""Drivers of a robot's node as processes of their own, from docs/robot-messages.md alone: ROS 1 by its wire protocol, ZeroMQ
by libzmq's C interface. Neither has code of ours in it.

    drivers.py sensors|treads|quiet|second|joystick ros NAME | zeromq ENDPOINT

`treads` does what a driver must: obeys one publisher, stops after 300 ms without a command, and says what the treads do.
It prints what they do, "T LEFT RIGHT", by CLOCK_MONOTONIC. A line on its input spoils it: `slow SECONDS`; `half` (the
right tread stands), `reversed`, `weak` (half of the speed), `foreign` (obeys another one), `stuck` (does the last command
for ever), `deaf` (hears no speeds), `stutters` (does nothing for 0.6 s, again and again); `invented` (says what was never
commanded, and does what was); or `operator` (over ZeroMQ: says another hello and hears no speeds any more). `quiet` is
such a driver that does not say what the treads do. `second` says that it drives them, too; `joystick` sends speeds of its
own, over ROS. `SWARMSMITH_DRIVER` is its name in ROS.
"""
import ctypes
import os
import socket
import struct
import sys
import threading
import time

INFINITY = float("inf")
#: What a driver that is spoiled makes of a command.
SPOILED = {"half": lambda left, right: (left, 0.0), "reversed": lambda left, right: (-left, -right),
           "weak": lambda left, right: (left / 2, right / 2), "foreign": lambda left, right: (0.123, 0.045)}


class ZeroMq:
    DEALER, LINGER, RCVTIMEO = 5, 17, 27

    def __init__(self, endpoint):
        self.zmq = ctypes.CDLL("libzmq.so.5")
        for function in ("zmq_ctx_new", "zmq_socket"):
            getattr(self.zmq, function).restype = ctypes.c_void_p
        self.socket = ctypes.c_void_p(self.zmq.zmq_socket(ctypes.c_void_p(self.zmq.zmq_ctx_new()), self.DEALER))
        for option, value in ((self.LINGER, 0), (self.RCVTIMEO, 10)):
            self.zmq.zmq_setsockopt(self.socket, option, ctypes.byref(ctypes.c_int(value)), 4)
        if self.zmq.zmq_connect(self.socket, endpoint.encode()) != 0:
            sys.exit("no connection to " + endpoint)
        self.role = "driver"

    def say_hello(self):
        self.send("hello " + self.role)

    def send(self, text):
        self.zmq.zmq_send(self.socket, text.encode(), len(text.encode()), 0)

    def send_numbers(self, topic, numbers):
        self.send(f"{topic} {time.time_ns()} " + " ".join(map(repr, numbers)))

    def ranges(self, metres):
        self.send_numbers("ranges", metres)

    def driven(self, left, right):
        self.send_numbers("driven", (left, right))

    def speeds(self):
        """Those that came, with who sent them; waits 10 ms for them."""
        buffer = ctypes.create_string_buffer(100000)
        while True:
            size = self.zmq.zmq_recv(self.socket, buffer, len(buffer), 0)
            if size < 0:
                return
            words = buffer.raw[:size].decode().split()
            if words[0] == "wheels":
                yield "node", float(words[2]), float(words[3])


def read_exactly(connection, size):
    data = b""
    while len(data) < size:
        more = connection.recv(size - len(data))
        if not more:
            raise OSError("closed")
        data += more
    return data


def header_of(fields):
    rows = b"".join(struct.pack("<I", len(row)) + row for row in (f"{k}={v}".encode() for k, v in fields.items()))
    return struct.pack("<I", len(rows)) + rows


def read_header(connection):
    rows = read_exactly(connection, struct.unpack("<I", read_exactly(connection, 4))[0])
    fields = {}
    while rows:
        size = struct.unpack("<I", rows[:4])[0]
        key, _, value = rows[4:4 + size].decode().partition("=")
        fields[key] = value
        rows = rows[4 + size:]
    return fields


class Ros:
    ARRAY = ("std_msgs/Float64MultiArray", "4b7d974086d4060e7db4613a7e6c3ba4")
    RANGES = ("teraranger_array/RangeArray", "4c1d9b3ff03219d31e41c86817a72ba8")

    def __init__(self, name, robot):
        import xmlrpc.client
        import xmlrpc.server
        self.client = xmlrpc.client.ServerProxy
        self.name, self.space = name, "/" + robot
        self.readers, self.came = {}, []
        self.lock = threading.Lock()
        self.server = socket.create_server(("localhost", 0))
        slave = xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False, allow_none=True)
        slave.register_function(lambda *_: [1, "", os.getpid()], "getPid")
        slave.register_function(lambda *_: [1, "", 0], "paramUpdate")
        slave.register_function(lambda *_: [1, "", 0], "shutdown")
        slave.register_function(lambda *_: [1, "", ["TCPROS", "localhost", self.server.getsockname()[1]]], "requestTopic")
        slave.register_function(self.publishers_are, "publisherUpdate")
        self.place = f"http://localhost:{slave.server_address[1]}/"
        self.master = self.client(os.environ["ROS_MASTER_URI"], allow_none=True)
        self.known = set()
        for work in (slave.serve_forever, self.serve):
            threading.Thread(target=work, daemon=True).start()

    def say_hello(self):
        pass

    def publish(self, topic, kind):
        self.readers[f"{self.space}/{topic}"] = (kind, [])
        self.master.registerPublisher(self.name, f"{self.space}/{topic}", kind[0], self.place)

    def serve(self):
        while True:
            connection, _ = self.server.accept()
            try:
                asked = read_header(connection)
                kind, readers = self.readers[asked["topic"]]
                connection.sendall(header_of({"callerid": self.name, "topic": asked["topic"], "type": kind[0],
                                              "md5sum": kind[1], "message_definition": "", "latching": "0"}))
                readers.append(connection)
            except (OSError, KeyError):
                connection.close()

    def send(self, topic, data):
        _, readers = self.readers[f"{self.space}/{topic}"]
        for connection in readers[:]:
            try:
                connection.sendall(struct.pack("<I", len(data)) + data)
            except OSError:
                readers.remove(connection)

    def subscribe(self, topic):
        answer = self.master.registerSubscriber(self.name, f"{self.space}/{topic}", self.ARRAY[0], self.place)
        self.publishers_are("/master", f"{self.space}/{topic}", answer[2])

    def publishers_are(self, _, topic, places):
        for place in places:
            if place != self.place and (topic, place) not in self.known:
                self.known.add((topic, place))
                threading.Thread(target=self.read, args=(topic, place), daemon=True).start()
        return [1, "", 0]

    def read(self, topic, place):
        try:
            answer = self.client(place).requestTopic(self.name, topic, [["TCPROS"]])
            connection = socket.create_connection(tuple(answer[2][1:]))
            connection.sendall(header_of({"callerid": self.name, "topic": topic, "type": self.ARRAY[0],
                                          "md5sum": self.ARRAY[1], "tcp_nodelay": "1"}))
            sender = read_header(connection)["callerid"]
            while True:
                data = read_exactly(connection, struct.unpack("<I", read_exactly(connection, 4))[0])
                with self.lock:
                    self.came.append((sender, *struct.unpack("<dd", data[-16:])))
        except OSError:
            self.known.discard((topic, place))

    def speeds(self):
        time.sleep(0.01)
        with self.lock:
            came, self.came = self.came, []
        yield from came

    def array(self, topic, numbers):
        self.send(topic, struct.pack(f"<III{len(numbers)}d", 0, 0, len(numbers), *numbers))

    def driven(self, left, right):
        self.array("driven", (left, right))

    def ranges(self, metres):
        def header(frame):
            return struct.pack("<III", 0, *divmod(time.time_ns(), 10**9)) + struct.pack("<I", len(frame)) + frame
        one = [header(b"range") + struct.pack("<Bffff", 1, 0.3, 0.05, 2.0, value) for value in metres]
        self.send("ranges", header(b"hub") + struct.pack("<I", len(one)) + b"".join(one))


class Treads:
    """A driver: what came, when, and what the treads do. `say` is called when they do something else."""

    def __init__(self, way, say):
        self.way, self.say, self.fault, self.late_s = way, say, "", 0
        self.heard, self.waiting, self.now = {}, [], (0.0, 0.0)
        threading.Thread(target=self.read_faults, daemon=True).start()

    def read_faults(self):
        for line in sys.stdin:
            fault, *late_s = line.split()
            if fault == "operator":
                self.way.role = "operator"
            self.late_s = float(late_s[0]) if late_s else 0
            self.fault = fault
            print("fault", time.monotonic(), flush=True)

    def set(self, left, right):
        if self.fault == "stuck":
            return
        speeds = SPOILED.get(self.fault, lambda *same: same)(left, right)
        if speeds != self.now:
            self.now = speeds
            print(time.monotonic(), *speeds, flush=True)
            self.say()

    def said(self):
        return (-0.21, 0.17) if self.fault == "invented" else self.now

    def turn(self):
        for sender, left, right in self.way.speeds():
            if self.fault == "deaf":
                continue
            self.heard[sender] = time.monotonic()
            self.waiting.append((time.monotonic() + self.late_s, (left, right)))
        now = time.monotonic()
        while self.waiting and self.waiting[0][0] <= now:
            speeds = self.waiting.pop(0)[1]
            self.set(*(speeds if sum(now - heard < 1 for heard in self.heard.values()) < 2 else (0.0, 0.0)))
        if now - max(self.heard.values(), default=0) > 0.3 + self.late_s:
            self.set(0.0, 0.0)


def main():
    role, kind, place = sys.argv[1:4]
    way = ZeroMq(place) if kind == "zeromq" else Ros(os.environ.get("SWARMSMITH_DRIVER", f"/{role}_{os.getpid()}"), place)
    if kind == "ros":
        for topic, of, what in (("sensors", "ranges", Ros.RANGES), ("treads", "driven", Ros.ARRAY),
                                ("second", "driven", Ros.ARRAY), ("joystick", "wheels", Ros.ARRAY)):
            if role == topic:
                way.publish(of, what)
        if role in ("treads", "quiet", "second"):
            way.subscribe("wheels")
    elif role == "sensors":
        way.role = role
    drives = role in ("treads", "quiet", "second")
    treads = Treads(way, lambda: role == "quiet" or way.driven(*treads.said()))
    due, count = time.monotonic(), 0
    print("begins", flush=True)
    while os.getppid() != 1:
        due, count = due + 0.1, count + 1
        way.say_hello()
        if role == "sensors":  # something in front, now and then: the robot turns
            way.ranges([INFINITY] * 8 if count % 17 < 9 else [0.1] * 3 + [INFINITY] * 5)
        elif role == "joystick":
            way.array("wheels", (0.2, 0.2))
        elif role != "quiet":
            way.driven(*treads.said())
        while drives and time.monotonic() < due:
            treads.turn()
        if treads.fault == "stutters" and count % 8 == 0:
            time.sleep(0.6)
            due = time.monotonic()
        time.sleep(max(0, due - time.monotonic()))


if __name__ == "__main__":
    main()
