"""A secret that trials come from: drawn once, and readable by nobody else."""

import os
import secrets
from pathlib import Path

from svsa.errors import ParameterError, Violation

SECRET_BYTES = 32


def keep_secret(path: Path) -> bytes:
    """The secret in this file, drawn if there is none yet.

    Raises `ParameterError` for a file that holds something else, `OSError` where it cannot be
    written or read.
    """
    if not path.exists():
        _write_new(path, secrets.token_bytes(SECRET_BYTES))
    secret = path.read_bytes()
    if len(secret) != SECRET_BYTES:
        raise ParameterError(Violation("secret", path, "", f"of {SECRET_BYTES} bytes"))
    return secret


def _write_new(path: Path, text: bytes) -> None:
    """The first of two who begin at once decides."""
    try:
        opened = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        return
    with os.fdopen(opened, "wb") as file:
        file.write(text)
