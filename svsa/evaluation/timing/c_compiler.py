"""The machine's C compiler, for comparisons with C."""

import os
import shutil

FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math")


def find_c_compiler() -> str | None:
    """Return $CC, or cc if it exists."""
    return os.environ.get("CC") or shutil.which("cc")
