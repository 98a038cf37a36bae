"""Processes of a lab under test, found by the module that they run."""

import contextlib
from pathlib import Path


def find_child(parent: int, module: str) -> int:
    """Return the child of this process that runs a module."""
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        with contextlib.suppress(OSError):
            command = (folder / "cmdline").read_bytes().split(b"\0")
            found = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            if found == parent and module.encode() in command:
                return int(folder.name)
    raise AssertionError(f"{module} does not run")
