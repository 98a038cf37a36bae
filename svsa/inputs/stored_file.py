"""Files of the data folder, which may be damaged in any way."""

import contextlib
import json
from pathlib import Path
from typing import Any

from svsa.inputs.nesting import DEEPEST, is_too_deep


def load_json(text: str | bytes) -> Any:
    """Parse the JSON of a stored file, which may be damaged.

    Args:
        text: The content of the file.

    Returns:
        Its value.

    Raises:
        ValueError: If it is not JSON, or is nested too deeply.
    """
    with contextlib.suppress(RecursionError):
        value = json.loads(text)
        if not is_too_deep(value):
            return value
    raise ValueError(f"nested in more than {DEEPEST} levels")


def read_json(path: Path) -> Any:
    """Read a stored file of JSON, which may be damaged.

    Args:
        path: The file.

    Returns:
        Its value.

    Raises:
        OSError: If it cannot be read.
        ValueError: If it is not JSON, is nested too deeply, or is a pipe or device, which could
            block.
    """
    return load_json(read_file(path))


def read_file(path: Path) -> bytes:
    """Read a stored file.

    Args:
        path: The file.

    Returns:
        Its content.

    Raises:
        OSError: If it cannot be read.
        ValueError: If it is a pipe or device, which could block.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise ValueError("it is not a file")
    return path.read_bytes()
