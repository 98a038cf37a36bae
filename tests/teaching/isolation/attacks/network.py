"""Attacks over sockets of every kind. See `memory` for the form."""

import ctypes
import socket


def _read(family, address):
    with socket.socket(family, socket.SOCK_STREAM) as line:
        line.settimeout(2.0)
        line.connect(address)
        return line.recv(100)


def call_the_lab(clue):
    return _read(socket.AF_INET, ("127.0.0.1", clue["port"]))


def call_the_lab_by_its_file(clue):
    return _read(socket.AF_UNIX, clue["socket"])


def call_the_lab_by_its_hidden_name(clue):
    return _read(socket.AF_UNIX, "\0" + clue["hidden"])


def listen(clue):
    with socket.socket() as line:
        line.bind(("127.0.0.1", 0))
        line.listen()
        return repr(line.getsockname()).encode()


def send_a_datagram(clue):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as line:
        return str(line.sendto(b"x", ("127.0.0.1", clue["port"]))).encode()


def ask_the_kernel(clue):
    with socket.socket(socket.AF_NETLINK, socket.SOCK_RAW) as line:
        line.bind((0, 0))
        return repr(line.getsockname()).encode()


def make_a_pair(clue):
    one, other = socket.socketpair()
    one.close()
    other.close()
    return b"pair"


def call_without_python(clue):
    number = ctypes.CDLL(None, use_errno=True).socket(2, 1, 0)
    if number < 0:
        raise OSError(ctypes.get_errno(), "socket")
    return str(number).encode()
