"""Attacks on files and file-like objects. See `memory` for the form."""

import ctypes
import os
import sys
from pathlib import Path

libc = ctypes.CDLL(None, use_errno=True)


def read_the_secret(clue):
    return Path(clue["file"]).read_bytes()


def read_the_machines_users(clue):
    return Path("/etc/passwd").read_bytes()


def list_homes(clue):
    return repr([*os.listdir("/home"), *os.listdir(clue["folder"])]).encode()


def leave_by_a_link(clue):
    os.symlink(clue["file"], "link")
    return Path("link").read_bytes()


def leave_by_dots(clue):
    return Path("../" * 20 + clue["file"].lstrip("/")).read_bytes()


def leave_by_another_root(clue):
    os.chroot(".")
    return b"chroot"


def write_outside(clue):
    path = Path(clue["folder"]) / "written"
    path.write_text("I was here")
    return path.read_bytes()


def write_over_its_own_keeper(clue):
    Path(sys.argv[0]).write_text("")
    return b"written"


def write_into_the_interpreter(clue):
    path = Path(os.__file__).with_name("svsa_was_here.py")
    path.write_text("")
    path.unlink()
    return b"written"


def read_shared_memory(clue):
    return Path("/dev/shm", clue["shared"]).read_bytes()


def make_shared_memory(clue):
    Path("/dev/shm/svsa_attack").write_text("")
    Path("/dev/shm/svsa_attack").unlink()
    return b"made"


def make_shared_memory_of_system_v(clue):
    private, create = 0, 0o1600
    number = libc.shmget(private, 4096, create)
    if number < 0:
        raise OSError(ctypes.get_errno(), "shmget")
    libc.shmctl(number, 0, None)
    return b"made"


def read_what_was_inherited(clue):
    found = b""
    for descriptor in range(3, 256):
        try:
            found += os.pread(descriptor, 100, 0)
        except OSError:
            continue
    if not found:
        raise OSError("nothing was inherited")
    return found


def make_a_device(clue):
    os.mknod("disk", 0o060600, os.makedev(8, 0))
    return b"made"


def make_a_file_without_a_name(clue):
    return str(os.memfd_create("hidden")).encode()


def fill_the_disk(clue):
    """Write up to 64 MiB, many times its limit."""
    written = 0
    try:
        for number in range(1024):
            with open(f"{number}", "wb", buffering=0) as file:
                written += file.write(bytes(1 << 16))
    except OSError:
        if written <= clue["folder_bytes"]:
            raise
    return str(written).encode()


def fill_a_file(clue):
    with open("one", "wb", buffering=0) as file:
        written = sum(file.write(bytes(1 << 12)) for _ in range(1 << 13))
    return str(written).encode()


def print_gigabytes(clue):
    for _ in range(1 << 14):
        os.write(1, bytes(1 << 16))
    return b"printed"
