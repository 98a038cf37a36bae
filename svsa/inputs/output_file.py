"""Check of the files that a command writes at its end."""

import os
from pathlib import Path

from svsa.errors import ParameterError, Violation


def check_writable(option: str, path: Path) -> None:
    """Raise `ParameterError` if a file cannot be written, before a long computation.

    Args:
        option: Option of the command that names the file, such as "--plot".
        path: The file.

    Raises:
        ParameterError: If the path is a folder, is in no existing folder, or is read-only.
    """
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        bound = "a file that can be written, in an existing folder"
        raise ParameterError(Violation(option, path, "", bound))
