"""A TOML file that a person has written, read with the error that a person can act on."""

import tomllib
from pathlib import Path
from typing import Any

from svsa.errors import ParameterError, Violation


def read_toml(path: Path | str, kind: str) -> dict[str, Any]:
    """What is in a file; raises `ParameterError` that calls it by its kind, as "bench file"."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise _refuse(kind, str(path), error) from None
    return parse_toml(text, kind, str(path))


def parse_toml(text: str, kind: str, name: str) -> dict[str, Any]:
    """What is in the text of a file called `name`; raises `ParameterError`."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _refuse(kind, name, error) from None


def _refuse(kind: str, name: str, error: Exception) -> ParameterError:
    return ParameterError(Violation(kind, name, "", f"a readable TOML file ({error})"))
