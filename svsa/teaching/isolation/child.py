"""The law's process: an interpreter in empty namespaces, connected by two pipes.

    python -I -S -B -u child.py LAW FILTER ANSWERS NAMES MEMORY_BYTES CPU_S OUTPUT_BYTES

LAW: the law's file. FILTER: the compiled filter of system calls, or "-" for none. ANSWERS: number
of the pipe for answers; requests come on standard input. NAMES: number of files and folders that
the working folder may have, or 0 for any. The law is read only when every limit is set. Imports
nothing of the lab except for `frames`, `plain_law` and the modules that a law may use.
"""

import ctypes
import math
import os
import resource
import struct
import sys
import traceback
from pathlib import Path
from types import ModuleType
from typing import Any

NICENESS = 10
"""The same as its grader's in a job: with a lower priority a busy machine would delay it."""
_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP, _SECCOMP_MODE_FILTER = 38, 22, 2
_PR_CAP_AMBIENT, _PR_CAP_AMBIENT_CLEAR_ALL, _CAPABILITIES_OF_64_BITS = 47, 4, 0x20080522
_MS_NOSUID, _MS_NODEV, _MS_REMOUNT = 2, 4, 32
_INSTRUCTION_BYTES = 8
libc = ctypes.CDLL(None, use_errno=True)


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("filter", ctypes.c_void_p))


def limit(memory_bytes: int, cpu_s: int, output_bytes: int) -> None:
    """Limit memory, processor time and file size permanently; disable core dumps."""
    os.nice(max(0, NICENESS - os.nice(0)))
    for kind, bound in (
        (resource.RLIMIT_AS, memory_bytes),
        (resource.RLIMIT_CPU, cpu_s),
        (resource.RLIMIT_FSIZE, output_bytes),
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_NOFILE, 32),
        (resource.RLIMIT_MEMLOCK, 0),
        (resource.RLIMIT_MSGQUEUE, 0),
    ):
        resource.setrlimit(kind, (bound, bound))


def limit_names(names: int) -> None:
    """Limit the number of files and folders in the working folder, then drop every capability."""
    # The root of the folder is one of them. Other options of the file system stay as they are.
    options = b"nr_inodes=%d" % (names + 1)
    flags = _MS_REMOUNT | _MS_NOSUID | _MS_NODEV
    call(libc.mount, b"tmpfs", bytes(Path.cwd()), b"tmpfs", flags, options)
    call(libc.prctl, _PR_CAP_AMBIENT, _PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0)
    call(libc.capset, struct.pack("Ii", _CAPABILITIES_OF_64_BITS, 0), bytes(24))


def call(function: Any, *arguments: Any) -> None:
    """Call a function of the C library.

    Raises:
        OSError: If the call fails.
    """
    if function(*arguments) != 0:
        code = ctypes.get_errno()
        raise OSError(code, f"{function.__name__} failed: {os.strerror(code)}")


def filter_calls(program: bytes) -> None:
    """Install a kernel filter that rejects every system call outside this program."""
    code = ctypes.create_string_buffer(program, len(program))
    length = len(program) // _INSTRUCTION_BYTES
    packed = _Program(length, ctypes.cast(code, ctypes.c_void_p))
    # Without this flag the kernel accepts a filter from privileged processes only.
    call(libc.prctl, _PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    call(libc.prctl, _PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.byref(packed), 0, 0)


def offer_equations() -> None:
    """Make `svsa.actuators` importable as plain Python, without compiled functions."""
    # Neither numba nor numpy is imported in the child: with numpy the process of a law takes five
    # times as long to start.
    words: dict[str, dict[str, Any]] = {
        "numerics.compilation": {"compiled": lambda function: function},
        "numerics.fused": {"fma": lambda a, b, c: a * b + c},
        "numerics.simd.choice": {
            "choose": lambda condition, a, b: a if condition else b,
            "least": lambda a, b: b if b < a else a,
            "greatest": lambda a, b: b if b > a else a,
            "some": lambda condition: condition,
        },
        "numerics.simd.power": {
            "raise_two": lambda exponent: math.ldexp(1.0, int(exponent)),
            "take_fraction": lambda number: math.frexp(number)[0],
            "take_exponent": lambda number: float(math.frexp(number)[1]),
        },
        "numerics.simd.rounding": {
            "floor": lambda x: float(math.floor(x)) if math.isfinite(x) else x,
        },
        "actuators.parameters": {
            "ActuatorParameters": object,
            "Limits": object,
            "MechanismParameters": object,
            "get_mechanism_name": None,
        },
        # A law in a process of its own uses the SVSA, whose equations need no compiler.
        "actuators.kinds": {
            "choose_kind": lambda of_svsa, of_energy: of_svsa,
            "find_margin": None,
            "find_state": None,
            "find_torques": None,
        },
        "actuators.energy": {"compile_energy": None},
        "actuators.installed": {"get_mechanism": None},
        "actuators.mechanism": {"MAX_ELASTIC": 6},
    }
    for name, names in words.items():
        module = ModuleType(f"svsa.{name}")
        vars(module).update(names)
        sys.modules[module.__name__] = module


def load_law(text: str, constants: tuple[float, ...]) -> Any:
    """Load the law of a file: `law`, or the result of `build` for the nominal model."""
    from svsa.actuators.dynamics import Actuator

    names: dict[str, Any] = {"__name__": "law"}
    exec(compile(text, "law.py", "exec"), names)  # noqa: S102  the law, behind every limit
    if "build" in names:
        model = Actuator._make(constants[: len(Actuator._fields)])
        return names["build"](model._replace(reaction=int(model.reaction)))
    if callable(names.get("law")):
        return names["law"]
    raise TypeError("law.py must define law(time_s, reference, x, w), or build(model) → law")


def read_torque(answer: Any) -> tuple[float, float]:
    """Read (u1, u2), N·m, from a law's return value.

    Raises:
        TypeError: Unless it is two numbers.
    """
    try:
        u1, u2 = answer
        return float(u1), float(u2)
    except (TypeError, ValueError):
        message = f"law must return two torques (u1, u2) in N·m, not {answer!r:.60}"
        raise TypeError(message) from None


def read(length: int) -> bytes:
    """Read `length` bytes of the requests; fewer at the end of the stream."""
    got = b""
    while len(got) < length and (more := os.read(0, length - len(got))):
        got += more
    return got


def print_in_law(error: BaseException) -> None:
    """Print an error with its location in the law's file, without the frames of this module."""
    frame = error.__traceback__
    while frame is not None and frame.tb_frame.f_code.co_filename == __file__:
        frame = frame.tb_next
    traceback.print_exception(type(error), error, frame)
    sys.stderr.flush()


def serve(path: Path, answers: int) -> None:
    """Load the law for each run, then answer requests with torques until the stream ends.

    The file is executed once for each run, so that each has a separate law.
    """
    from frames import ANSWER, ASK, FAILED, PAIR, READY, ROW, TICK, TORQUE
    from plain_law import find_named  # pyright: ignore[reportMissingImports]

    from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque

    _, number, runs = ASK.unpack(read(ASK.size))
    length = ASK.size + runs * ROW.size
    try:
        text, laws = path.read_text("utf-8"), []
        for row in ROW.iter_unpack(read(runs * ROW.size)):
            law = load_law(text, row)
            laws.append((law, find_named(law)))
        os.write(answers, ANSWER.pack(READY, number) + bytes(runs * PAIR.size))
        while len(asked := read(length)) == length:
            kind, number, _ = ASK.unpack_from(asked)
            if kind != TICK:
                break
            torques = bytearray(runs * PAIR.size)
            for run, row in enumerate(ROW.iter_unpack(memoryview(asked)[ASK.size :])):
                if row[0] != row[0]:
                    continue
                law, named = laws[run]
                always = Reference(*row[1:9]), State(*row[9:15]), Disturbance(*row[15:18])
                optional = {"applied": Torque(*row[18:20]), "measured": Positions(*row[20:23])}
                answer = law(row[0], *always, **{name: optional[name] for name in named})
                PAIR.pack_into(torques, run * PAIR.size, *read_torque(answer))
            os.write(answers, ANSWER.pack(TORQUE, number) + torques)
    except BaseException as error:
        print_in_law(error)
        os.write(answers, ANSWER.pack(FAILED, number) + bytes(runs * PAIR.size))
        # After a failure neither `atexit` functions nor destructors of the law run.
        os._exit(1)


def main(law: str, program: str, answers: str, names: str, *bounds: str) -> None:
    """Apply the limits, then serve."""
    here = Path(__file__).parent
    sys.path[:0] = [str(here), str(here / "packages")]
    offer_equations()
    import frames  # noqa: F401
    import plain_law  # noqa: F401  # pyright: ignore[reportMissingImports]

    import svsa.actuators.dynamics  # noqa: F401

    # Read before the limits and the filter apply; the file of the law is read afterwards.
    compiled = b"" if program == "-" else Path(program).read_bytes()
    limit(*map(int, bounds))
    if int(names):
        limit_names(int(names))
    if compiled:
        filter_calls(compiled)
    serve(Path(law), int(answers))


main(*sys.argv[1:])
