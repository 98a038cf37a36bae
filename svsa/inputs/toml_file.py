"""TOML files of users, with errors that name file, line and remedy."""

import re
import tomllib
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeVar

from svsa.errors import ParameterError, Violation
from svsa.inputs.nearest import suggest
from svsa.inputs.nesting import DEEPEST, is_too_deep

_Kind = TypeVar("_Kind")
_TOO_DEEP = f"its values are nested too deeply: at most {DEEPEST} levels"
_TABLE = re.compile(r"\s*(\[\[?)([^\[\]]+)\]")
_PLACE = re.compile(r"\(at line (\d+), column \d+\)$")
_COMMA = re.compile(r"=\s*([+-]?\d+,\d+)\s*(?:#|$)")
_KEY = re.compile(r"\s*([\w.\-\s\"']+?)\s*=")


def read_toml(path: Path | str, kind: str) -> dict[str, Any]:
    """Read a TOML file.

    Args:
        path: The file.
        kind: Kind of file for the error message, such as "bench file".

    Returns:
        Its sections.

    Raises:
        ParameterError: If the file cannot be read or parsed.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        there = [str(each) for each in Path(path).parent.glob("*.toml")]
        finding = f"there is no file {path}{suggest(str(path), there)}"
        raise ParameterError(Violation(kind, path, "", "", finding=finding)) from None
    except (OSError, UnicodeDecodeError) as error:
        raise _refuse(kind, path, error) from None
    return parse_toml(text, kind, path)


def parse_toml(text: str, kind: str, name: Path | str) -> dict[str, Any]:
    """Parse the text of a TOML file.

    Args:
        text: The text.
        kind: Kind of file for the error message.
        name: Name of the file for the error message.

    Returns:
        Its sections.

    Raises:
        ParameterError: If the text cannot be parsed.
    """
    try:
        sections = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _refuse(kind, name, _describe_comma(error, text) or error) from None
    except RecursionError:
        # tomllib parses nested arrays and tables by recursion.
        raise _refuse(kind, name, _TOO_DEEP) from None
    except ValueError as error:
        # Such as an integer of more digits than Python converts.
        raise _refuse(kind, name, error) from None
    if is_too_deep(sections):
        raise _refuse(kind, name, _TOO_DEEP)
    return sections


def build_checked(
    kind: type[_Kind], sections: dict[str, Any], text: str, place: str, changes: dict[str, Any]
) -> _Kind:
    """Build a validated value from the sections of a TOML text.

    Args:
        kind: Class of the value.
        sections: Content of the text.
        text: Text in which the lines of invalid values are found.
        place: Path of the text's file; empty without a file.
        changes: Fields that replace those of the text.

    Raises:
        ParameterError: With path and lines of the invalid values.
    """
    try:
        return kind(**sections | changes)
    except ParameterError as error:
        names = [violation.name for violation in error.violations if violation.name not in changes]
        there = describe_place(place, text, names) if names else ""
        raise ParameterError(*error.violations, file=there) from None


def read_checked(
    kind: type[_Kind], path: Path, called: str, changes: dict[str, Any] | None = None
) -> _Kind:
    """Build a validated value from a TOML file, as `build_checked`.

    Args:
        kind: Class of the value.
        path: The file.
        called: Kind of file for the error message, such as "study file".
        changes: Fields that replace those of the file.

    Returns:
        The value.

    Raises:
        ParameterError: With path and lines of the invalid values.
    """
    sections = read_toml(path, called)
    return build_checked(kind, sections, path.read_text("utf-8"), str(path), changes or {})


def _refuse(kind: str, name: Path | str, error: Exception | str) -> ParameterError:
    return ParameterError(Violation(kind, name, "", f"a readable TOML file ({error})"))


def _describe_comma(error: tomllib.TOMLDecodeError, text: str) -> str | None:
    """Return advice on a decimal comma in an invalid line; None for another cause."""
    place = _PLACE.search(str(error))
    line = text.splitlines()[int(place[1]) - 1] if place else ""
    comma = _COMMA.search(line)
    if place is None or comma is None:
        return None
    number, point = comma[1], comma[1].replace(",", ".")
    return f"line {place[1]}: {number} has a decimal comma; write a decimal point: {point}"


def find_lines(text: str, names: Iterable[str]) -> list[int]:
    """Find the line numbers of values in a TOML text, by paths such as `vary[1].low`.

    A missing value has the line of its table; without a table it has no line.
    """
    lines: dict[str, int] = {}
    counts: Counter[str] = Counter()
    table = ""
    for number, line in enumerate(text.splitlines(), 1):
        if match := _TABLE.match(line):
            table = _follow(_strip(match[2]), counts)
            if match[1] == "[[":
                counts[table] += 1
                table = f"{table}[{counts[table] - 1}]"
            lines[table] = number
        elif match := _KEY.match(line):
            key = _strip(match[1])
            lines.setdefault(f"{table}.{key}" if table else key, number)
    return [line for name in names if (line := _find_nearest(lines, name)) is not None]


def _follow(table: str, counts: Counter[str]) -> str:
    """Return a table's path, within the last item of each list on it."""
    *outer, last = table.split(".")
    path = ""
    for part in outer:
        path += part
        path += f"[{counts[path] - 1}]." if counts[path] else "."
    return path + last


def describe_place(place: str, text: str, names: Iterable[str]) -> str:
    """Describe where values are in a text, for an error: "mine.toml, lines 3 and 7".

    Args:
        place: Name of the file, or "".
        text: The TOML text.
        names: Paths of the values.

    Returns:
        The description.
    """
    lines = sorted(set(find_lines(text, names)))
    numbers = f"{'lines' if len(lines) > 1 else 'line'} {' and '.join(map(str, lines))}"
    return ", ".join(filter(None, (place, numbers if lines else "")))


def _find_nearest(lines: dict[str, int], name: str) -> int | None:
    while name and name not in lines:
        name = name[: max(name.rfind("."), name.rfind("["), 0)]
    return lines.get(name)


def _strip(key: str) -> str:
    return re.sub(r"[\s\"']", "", key)
