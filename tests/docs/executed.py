"""Run the Python blocks of a page of the documentation, and compare what they print.

    python -m tests.docs.executed PAGE LAB_ADDRESS

A block ```python is run; a block ```text that follows one is what it prints. The blocks of a page
share their names. A process of its own, since examples interrupt it and start a cluster.
"""

import contextlib
import io
import signal
import sys
from pathlib import Path

from tests.docs.guide import LAB, read_blocks


def run_page(path: Path, address: str) -> int:
    """Run a page; return the number of its blocks. Raises `AssertionError` for another output."""
    names: dict[str, object] = {"__name__": "__main__"}
    printed, line, count = "", 0, 0
    for block in read_blocks(path):
        if block.language == "python":
            assert not printed, f"{path}:{line} prints what the page does not show:\n{printed}"
            line, count = block.line, count + 1
            stream = io.StringIO()
            # Lines in front, so that a traceback has the line of the page.
            text = "\n" * (line - 1) + block.text.replace(LAB, address)
            code = compile(text, str(path), "exec")
            with contextlib.redirect_stdout(stream):
                exec(code, names)  # noqa: S102
            printed = stream.getvalue()
        elif block.language == "text" and line:
            assert printed == block.text, f"{path}:{line} prints\n{printed}"
            printed, line = "", 0
    assert not printed, f"{path}:{line} prints what the page does not show:\n{printed}"
    return count


if __name__ == "__main__":
    # A shell starts what runs in the background with an interrupt that is ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    assert run_page(Path(sys.argv[1]), sys.argv[2]), "the page has no block to run"
