"""A TOML file that a person has written, read with the error that a person can act on."""

import re
import tomllib
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from svsa.errors import ParameterError, Violation

_TABLE = re.compile(r"\s*(\[\[?)([^\[\]]+)\]")
_KEY = re.compile(r"\s*([\w.\-\s\"']+?)\s*=")


def read_toml(path: Path | str, kind: str) -> dict[str, Any]:
    """What is in a file; raises `ParameterError` that calls it by its kind, as "bench file"."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise _refuse(kind, path, error) from None
    return parse_toml(text, kind, path)


def parse_toml(text: str, kind: str, name: Path | str) -> dict[str, Any]:
    """What is in the text of a file of this name or path; raises `ParameterError`."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _refuse(kind, name, error) from None
    except RecursionError:
        # tomllib parses nested arrays and tables by recursion.
        raise _refuse(kind, name, "its values are nested too deeply") from None


def _refuse(kind: str, name: Path | str, error: Exception | str) -> ParameterError:
    return ParameterError(Violation(kind, name, "", f"a readable TOML file ({error})"))


def find_lines(text: str, names: Iterable[str]) -> list[int]:
    """The lines where values stand in a readable TOML text, by paths as `vary[1].low`; from 1 on.

    Of a value that is not there the line of what should hold it; of none of both no line.
    """
    lines: dict[str, int] = {}
    counts: Counter[str] = Counter()
    table = ""
    for number, line in enumerate(text.splitlines(), 1):
        if found := _TABLE.match(line):
            table = _follow(_strip(found[2]), counts)
            if found[1] == "[[":
                counts[table] += 1
                table = f"{table}[{counts[table] - 1}]"
            lines[table] = number
        elif found := _KEY.match(line):
            key = _strip(found[1])
            lines.setdefault(f"{table}.{key}" if table else key, number)
    return [line for name in names if (line := _find_nearest(lines, name)) is not None]


def _follow(table: str, counts: Counter[str]) -> str:
    """A table's path, within the last item of each list that it lies in."""
    *outer, last = table.split(".")
    path = ""
    for part in outer:
        path += part
        path += f"[{counts[path] - 1}]." if counts[path] else "."
    return path + last


def describe_place(place: str, text: str, names: Iterable[str]) -> str:
    """Where these values stand in a text, as an error tells it: "mine.toml, lines 3 and 7".

    place: the name of its file, or "".
    """
    lines = sorted(set(find_lines(text, names)))
    reported = f"{'lines' if len(lines) > 1 else 'line'} {' and '.join(map(str, lines))}"
    return ", ".join(filter(None, (place, reported if lines else "")))


def _find_nearest(lines: dict[str, int], name: str) -> int | None:
    while name and name not in lines:
        name = name[: max(name.rfind("."), name.rfind("["), 0)]
    return lines.get(name)


def _strip(key: str) -> str:
    return re.sub(r"[\s\"']", "", key)
