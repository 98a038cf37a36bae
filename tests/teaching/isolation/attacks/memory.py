"""Attacks on what is in memory: its own, and that of the process that asks.

`clue` gives an attacker all useful information except the secret, including the place of the
secret. Each attack returns the data that it got, or raises an error.
"""

import ctypes
import gc
import os
import re
import sys

libc = ctypes.CDLL(None, use_errno=True)


def search(objects):
    found = (re.findall("canary-[0-9a-f]{32}", repr(thing)) for thing in objects)
    return "".join(text for texts in found for text in texts).encode()


def walk_frames(clue):
    frame, seen = sys._getframe(1), []
    while frame is not None:
        seen += [*frame.f_locals.values(), *frame.f_globals.values()]
        frame = frame.f_back
    return search(thing for thing in seen if thing is not clue)


def search_what_is_collected(clue):
    return search(thing for thing in gc.get_objects() if isinstance(thing, dict | list | tuple))


def import_the_grader(clue):
    from svsa.teaching.isolation import process

    return repr(process.LawProcess).encode()


def import_the_scenarios(clue):
    from svsa.evaluation.ranking import test_set

    return repr(test_set.build_test_trial("A", 0, 0)).encode()


def patch_the_loop(clue):
    import svsa.simulation.loop.loop

    svsa.simulation.loop.loop.limit_torque = lambda torque, *_: torque
    return b"patched"


def patch_the_plant(clue):
    import svsa.simulation.plant.effects

    svsa.simulation.plant.effects.RIG = svsa.simulation.plant.effects.IDEAL
    return b"patched"


def read_environment(clue):
    return os.environ["SVSA_CANARY"].encode()


def read_environment_of_c(clue):
    libc.getenv.restype = ctypes.c_char_p
    found = libc.getenv(b"SVSA_CANARY")
    if found is None:
        raise KeyError("SVSA_CANARY")
    return found


def read_memory_of_the_asker(clue):
    class Piece(ctypes.Structure):
        _fields_ = (("base", ctypes.c_void_p), ("length", ctypes.c_size_t))

    buffer = ctypes.create_string_buffer(clue["length"])
    here = Piece(ctypes.cast(buffer, ctypes.c_void_p), clue["length"])
    there = Piece(clue["address"], clue["length"])
    libc.process_vm_readv.argtypes = (
        ctypes.c_int, ctypes.c_void_p, ctypes.c_ulong, ctypes.c_void_p, ctypes.c_ulong,
        ctypes.c_ulong,
    )  # fmt: skip
    got = libc.process_vm_readv(
        clue["pid"], ctypes.addressof(here), 1, ctypes.addressof(there), 1, 0
    )
    if got < 0:
        raise OSError(ctypes.get_errno(), "process_vm_readv")
    return buffer.raw


def read_memory_through_proc(clue):
    with open(f"/proc/{clue['pid']}/mem", "rb", buffering=0) as memory:
        memory.seek(clue["address"])
        return memory.read(clue["length"])


def read_environment_through_proc(clue):
    with open(f"/proc/{clue['child']}/environ", "rb") as file:
        return next(part for part in file.read().split(b"\0") if b"canary-" in part)


def read_descriptors_through_proc(clue):
    with open(f"/proc/{clue['pid']}/fd/{clue['descriptor']}", "rb") as file:
        return file.read()


def read_what_is_mounted(clue):
    with open("/proc/self/mountinfo", "rb") as file:
        return file.read(2000)


def trace_the_asker(clue):
    attach, detach = 16, 17
    if libc.ptrace(attach, clue["child"], None, None) != 0:
        raise OSError(ctypes.get_errno(), "ptrace")
    os.waitpid(clue["child"], 0)
    libc.ptrace(detach, clue["child"], None, None)
    return b"attached"
