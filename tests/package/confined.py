"""Run Python under the filter of system calls of docs/deploy/seccomp.json.

    python -m tests.package.confined SCRIPT

Rules for capabilities do not apply, because the container has none. With
SVSA_WITHOUT=bubblewrap the filter is Docker's default.
"""

import ctypes
import errno
import json
import os
import platform
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from svsa.teaching.isolation.system_calls import find_number

PROFILE = Path(__file__).parents[2] / "docs" / "deploy" / "seccomp.json"
_ARCHITECTURES = {"x86_64": "amd64", "aarch64": "arm64"}
_NEW_NETWORK, _ALGORITHMS = 0x40000000, 38
_ARGUMENTS = {
    "clone": (_NEW_NETWORK,),
    "unshare": (_NEW_NETWORK,),
    "mount": (b"none", b"/tmp", b"tmpfs", 0, None),
    "umount2": (b"/proc", 0),
    "ptrace": (16, 1),  # attach to process 1
    "socket": (_ALGORITHMS, 5, 0),
}


def list_rules(leave_out: str = "?") -> Iterator[dict[str, Any]]:
    """Yield the rules for this processor and a container without capabilities."""
    processor = _ARCHITECTURES[platform.machine()]
    for rule in json.loads(PROFILE.read_bytes())["syscalls"]:
        needed, others = rule.get("includes", {}), rule.get("excludes", {})
        if needed.get("caps") or processor not in needed.get("arches", [processor]):
            continue
        if processor in others.get("arches", ()) or leave_out in rule.get("comment", ""):
            continue
        yield rule


def load_profile(leave_out: str) -> None:
    """Load the profile permanently into this process."""
    import pyseccomp

    actions = {"SCMP_ACT_ALLOW": lambda _: pyseccomp.ALLOW, "SCMP_ACT_ERRNO": pyseccomp.ERRNO}
    compiled = pyseccomp.SyscallFilter(pyseccomp.ERRNO(1))
    for rule in list_rules(leave_out):
        arguments = [
            pyseccomp.Arg(
                arg["index"],
                getattr(pyseccomp, arg["op"].removeprefix("SCMP_CMP_")),
                arg["value"],
                arg.get("valueTwo", 0),
            )
            for arg in rule.get("args", ())
        ]
        for name in rule["names"]:
            # As Docker does: calls that this version of libseccomp does not know stay denied.
            if (number := find_number(name)) is not None:
                compiled.add_rule(
                    actions[rule["action"]](rule.get("errnoRet", 1)), number, *arguments
                )
    compiled.load()


def list_permitted(names: Sequence[str]) -> list[str]:
    """Make each of these calls; return those that do not fail with EPERM."""
    libc = ctypes.CDLL(None, use_errno=True)
    permitted = []
    for name in names:
        number = find_number(name)
        assert number is not None, name
        done = libc.syscall(number, *_ARGUMENTS.get(name, (0, 0, 0, 0, 0)))
        if name == "clone" and done == 0:
            os._exit(1)
        if done != -1 or ctypes.get_errno() != errno.EPERM:
            permitted.append(f"{name}: {errno.errorcode.get(ctypes.get_errno())}")
    return permitted


if __name__ == "__main__":
    load_profile(os.environ.get("SVSA_WITHOUT", "?"))
    exec(sys.argv[1])  # noqa: S102
