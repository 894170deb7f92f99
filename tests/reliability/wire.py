"""The wire as a stranger speaks it: ZeroMQ's frames and the project's messages, by hand.

Nothing of the programs' own code is used, so that this is a second opinion on the protocol. The
messages' fields are read from proto/wire.proto.
"""
import os
import pathlib
import re
import socket
import struct
import time

SCHEMA = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "proto" / "wire.proto"
HEADER = pathlib.Path(os.environ["SWARMSMITH_SOURCE"]) / "proto" / "wire.h"


# --- ZMTP 3.0 (rfc.zeromq.org/spec/23), mechanism NULL ---

GREETING = (b"\xff" + bytes(8) + b"\x7f" + b"\x03\x00" + b"NULL".ljust(20, b"\0") + b"\0"
            + bytes(31))
MORE, LONG_SIZE, COMMAND = 1, 2, 4


def packed(body, flags=0):
    """A frame of ZMTP."""
    if len(body) > 255:
        return struct.pack(">BQ", flags | LONG_SIZE, len(body)) + body
    return struct.pack("BB", flags, len(body)) + body


def ready(kind=b"DEALER"):
    return packed(b"\x05READY\x0bSocket-Type" + struct.pack(">I", len(kind)) + kind, COMMAND)


class Frames:
    """Takes the bytes of one direction apart: the greeting, then frames."""

    def __init__(self):
        self.buffer = b""
        self.greeted = False
        self.passed = 0  #: bytes that a proxy has let through

    def feed(self, some):
        """The complete pieces so far: (flags, body), with None for the greeting's flags."""
        self.buffer += some
        while True:
            if not self.greeted:
                if len(self.buffer) < len(GREETING):
                    return
                self.greeted = True
                yield None, self.take(len(GREETING))
                continue
            if len(self.buffer) < 2:
                return
            flags = self.buffer[0]
            begin = 9 if flags & LONG_SIZE else 2
            if len(self.buffer) < begin:
                return
            size = (struct.unpack(">Q", self.buffer[1:9])[0] if flags & LONG_SIZE
                    else self.buffer[1])
            if len(self.buffer) < begin + size:
                return
            yield flags, self.take(begin + size)[begin:]

    def take(self, size):
        taken, self.buffer = self.buffer[:size], self.buffer[size:]
        return taken


class Peer:
    """A DEALER that is not ours. Everything ends after `timeout` seconds, also while pings come."""

    def __init__(self, address, timeout=10, greet=True):
        host, port = address.rsplit(":", 1)
        self.socket = socket.create_connection((host, int(port)), timeout)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.timeout = timeout
        self.frames = Frames()
        self.waiting = []
        self.is_ready = False
        if greet:
            self.socket.sendall(GREETING + ready())
            # A peer that speaks before both are ready is cut off.
            limit = time.monotonic() + timeout
            try:
                while not self.is_ready:
                    self.read(limit)
            except OSError:
                self.close()
                raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.socket.close()

    def send(self, body, flags=0):
        self.socket.sendall(packed(body, flags))

    def receive(self, seconds=None):
        """The next message; b"" when the other side has closed. Answers pings."""
        limit = time.monotonic() + (self.timeout if seconds is None else seconds)
        while not self.waiting:
            if not self.read(limit):
                return b""
        return self.waiting.pop(0)

    def read(self, limit):
        """Takes what comes until then; False when the other side has closed."""
        left = limit - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self.socket.settimeout(left)
        try:
            some = self.socket.recv(65536)
        finally:
            self.socket.settimeout(self.timeout)
        for flags, body in self.frames.feed(some):
            if flags is None:
                continue
            if not flags & COMMAND:
                if body:  # an empty one asks whether this connection stands
                    self.waiting.append(body)
            elif body.startswith(b"\x05READY"):
                self.is_ready = True
            elif body.startswith(b"\x04PING"):
                self.socket.sendall(packed(b"\x04PONG" + body[7:], COMMAND))
        if not some and not self.is_ready:
            raise ConnectionError("closed before it was ready")
        return bool(some)

    def is_closed(self, seconds=10):
        """Whether the other side closes the connection within this time."""
        limit = time.monotonic() + seconds
        try:
            while self.receive(limit - time.monotonic()):
                pass
            return True
        except TimeoutError:
            return False
        except ConnectionError:
            return True


# --- protobuf ---

def read_schema():
    """Name of each message -> {field: (number, type, repeated)}."""
    text = re.sub(r"//[^\n]*", "", SCHEMA.read_text())
    text = re.sub(r"enum \w+ \{[^}]*\}", "", text)
    text = re.sub(r"oneof \w+ \{([^}]*)\}", r"\1", text)
    messages = {}
    for name, body in re.findall(r"message (\w+) \{([^}]*)\}", text):
        messages[name] = {
            field: (int(number), kind, bool(repeated)) for repeated, kind, field, number in
            re.findall(r"(repeated )?(\w+) (\w+) = (\d+)", body)}
    return messages


MESSAGES = read_schema()
VARINTS = {"int32", "int64", "uint32", "uint64", "bool", "Reason", "Kind"}


def constant(name):
    return int(re.search(rf"{name} = (\d+);", HEADER.read_text()).group(1))


MAJOR, MINOR = constant("kProtocolMajor"), constant("kProtocolMinor")


def varint(value):
    value &= (1 << 64) - 1
    out = b""
    while value > 127:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


def encoded_value(kind, value):
    """Wire type and bytes of a value."""
    if kind in MESSAGES:
        return 2, encode_message(kind, value)
    if kind in ("string", "bytes"):
        return 2, value.encode() if isinstance(value, str) else value
    if kind == "double":
        return 1, struct.pack("<d", value)
    if kind == "fixed64":
        return 1, struct.pack("<Q", value)
    return 0, varint(int(value))


def encode_message(name, fields):
    out = b""
    for field, value in fields.items():
        number, kind, repeated = MESSAGES[name][field]
        for one in value if repeated else [value]:
            wire_type, body = encoded_value(kind, one)
            if wire_type == 2:
                body = varint(len(body)) + body
            out += varint(number << 3 | wire_type) + body
    return out


def read_varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def raw_fields(data):
    """(number, wire type, value) of each field as it comes."""
    at = 0
    while at < len(data):
        tag, at = read_varint(data, at)
        if tag & 7 == 0:
            value, at = read_varint(data, at)
        elif tag & 7 == 1:
            value, at = data[at:at + 8], at + 8
        elif tag & 7 == 2:
            size, at = read_varint(data, at)
            value, at = data[at:at + size], at + size
        else:
            raise ValueError("wire type")
        yield tag >> 3, tag & 7, value


def decode_message(name, data):
    known = {number: (field, kind, repeated)
             for field, (number, kind, repeated) in MESSAGES[name].items()}
    out = {}
    for number, wire_type, value in raw_fields(data):
        if number not in known:
            continue
        field, kind, repeated = known[number]
        if kind in MESSAGES:
            value = decode_message(kind, value)
        elif kind == "string":
            value = value.decode()
        elif kind == "double":
            value = struct.unpack("<d", value)[0]
        elif kind == "fixed64":
            value = struct.unpack("<Q", value)[0]
        elif wire_type == 0 and value >> 63 and kind.startswith("int"):
            value -= 1 << 64
        if repeated:
            out.setdefault(field, []).append(value)
        else:
            out[field] = value
    return out


def frame(name, fields, major=MAJOR, minor=MINOR):
    """A whole frame: header and message."""
    return b"SWRM" + struct.pack("<HH", major, minor) + encode_message(name, fields)


def message(name, whole):
    return decode_message(name, whole[8:])
