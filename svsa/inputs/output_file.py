"""Check of the files that a command writes at its end."""

import os
from pathlib import Path

from svsa.errors import ParameterError, Violation
from svsa.inputs.extras import require_extra

_PICTURES = (".png", ".pdf", ".svg")


def check_writable(option: str, path: Path) -> None:
    """Raise `ParameterError` if a file cannot be written, before a long computation.

    Args:
        option: Option of the command that names the file, such as "--save".
        path: The file.

    Raises:
        ParameterError: If the path is a folder, is in no existing folder, or is read-only.
    """
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        bound = "a file that can be written, in an existing folder"
        raise ParameterError(Violation(option, path, "", bound))


def check_picture(option: str, path: Path | None) -> None:
    """Raise an error if a picture cannot be drawn into a file, before a long computation.

    Args:
        option: Option of the command that names the file, such as "--plot".
        path: The file; None if no picture is drawn.

    Raises:
        MissingExtraError: If Matplotlib is not installed.
        ParameterError: If the file cannot be written, or its name has an unknown ending.
    """
    if path is None:
        return
    require_extra("plot")
    check_writable(option, path)
    if path.suffix.lower() not in _PICTURES:
        bound = f"a file name that ends with one of {', '.join(_PICTURES)}"
        raise ParameterError(Violation(option, path, "", bound))
