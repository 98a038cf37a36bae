"""Attacks by system calls that no law needs. See `memory` for the form."""

import ctypes
import os

libc = ctypes.CDLL(None, use_errno=True)
NUMBERS = {
    "x86_64": {"keyctl": 250, "add_key": 248, "bpf": 321, "perf_event_open": 298,
               "userfaultfd": 323, "clone3": 435, "seccomp": 317, "open_by_handle_at": 304},
    "aarch64": {"keyctl": 219, "add_key": 217, "bpf": 280, "perf_event_open": 241,
                "userfaultfd": 282, "clone3": 435, "seccomp": 277, "open_by_handle_at": 265},
}  # fmt: skip
IO_URING_SETUP, PIDFD_OPEN, PIDFD_GETFD = 425, 434, 438
NEW_USER, NEW_NETWORK = 0x10000000, 0x40000000


def call(name, result):
    if result < 0:
        raise OSError(ctypes.get_errno(), name)
    return name.encode()


def call_by_name(name, *arguments):
    number = NUMBERS[os.uname().machine][name]
    return call(name, libc.syscall(number, *arguments))


def mount(clue):
    return call("mount", libc.mount(b"proc", b"/work", b"proc", 0, None))


def unmount(clue):
    return call("umount2", libc.umount2(b"/lab/law.py", 2))


def take_a_world_of_its_own(clue):
    return call("unshare", libc.unshare(NEW_USER | NEW_NETWORK))


def enter_another_world(clue):
    return call("setns", libc.setns(0, 0))


def read_a_key(clue):
    session, read = -3, 11
    buffer = ctypes.create_string_buffer(100)
    return call_by_name("keyctl", read, session, buffer, 100)


def keep_a_key(clue):
    return call_by_name("add_key", b"user", b"svsa", b"x", 1, -2)


def load_a_program_into_the_kernel(clue):
    return call_by_name("bpf", 0, ctypes.create_string_buffer(72), 72)


def watch_the_processor(clue):
    attributes = ctypes.create_string_buffer(b"\1\0\0\0\x40\0\0\0", 64)
    return call_by_name("perf_event_open", attributes, -1, 0, -1, 0)


def handle_its_own_page_faults(clue):
    return call_by_name("userfaultfd", 0)


def work_in_a_ring(clue):
    ring = ctypes.create_string_buffer(120)
    return call("io_uring_setup", libc.syscall(IO_URING_SETUP, 4, ring))


def hold_the_asker(clue):
    return call("pidfd_open", libc.syscall(PIDFD_OPEN, clue["pid"], 0))


def take_a_descriptor_of_the_asker(clue):
    return call("pidfd_getfd", libc.syscall(PIDFD_GETFD, 0, clue["descriptor"], 0))


def open_by_number(clue):
    handle = ctypes.create_string_buffer(16)
    return call_by_name("open_by_handle_at", -100, handle, 0)


def type_on_the_terminal(clue):
    typed = 0x5412
    return call("ioctl", libc.ioctl(0, typed, b"x"))
