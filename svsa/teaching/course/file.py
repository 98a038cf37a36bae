"""Exercise files, Markdown with TOML front matter, and the exercises of the package."""

import os
import re
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.inputs.toml_file import describe_place, parse_toml
from svsa.teaching.course.exercise import Exercise

EXERCISE_FILE = "exercise file"
FENCE = "+++"
MAX_KEPT = 64
"""Cache of exercises, read again only when their files change."""
FOLDER_VARIABLE = "SVSA_COURSE"
_BUILT_IN = Path(__file__).parent / "exercises"
_HEADING = re.compile(r"##\s+(\S+)\s*")
_CODE_FENCE = re.compile(r"\s*(```|~~~)")


class _Section(NamedTuple):
    line: int
    text: str


def find_course_folder() -> Path | None:
    """Return the folder in `SVSA_COURSE`, whose exercises extend the course; None if not set."""
    named = os.environ.get(FOLDER_VARIABLE)
    return Path(named) if named else None


def list_exercise_files(folder: Path | None = None) -> list[Path]:
    """List the files of the course; a file in `folder` replaces the package's of the same name.

    Raises:
        ParameterError: If the folder does not exist.
    """
    files = {path.stem: path for path in _BUILT_IN.glob("*.md")}
    if folder is not None:
        if not folder.is_dir():
            raise ParameterError(Violation("course", folder, "", "a folder with exercises (.md)"))
        files |= {path.stem: path for path in folder.glob("*.md")}
    return list(files.values())


def read_course(folder: Path | None = None) -> list[Exercise]:
    """Read every exercise of the course, by number.

    Raises:
        ParameterError: If a file is invalid.
    """
    exercises = [read_exercise(path) for path in list_exercise_files(folder)]
    return sorted(exercises, key=lambda exercise: (exercise.number, exercise.name))


def read_exercise(path: Path | str) -> Exercise:
    """Read the exercise in a file; the exercise has the name of the file.

    Raises:
        ParameterError: If it is invalid, with file and lines.
    """
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        bound = f"a readable Markdown file ({error})"
        raise ParameterError(Violation(EXERCISE_FILE, path, "", bound)) from None
    return parse_exercise(text, Path(path).stem, str(path))


@lru_cache(MAX_KEPT)
def parse_exercise(text: str, name: str, place: str = "") -> Exercise:
    """Parse an exercise; `place` is the file in error messages.

    The front matter is between two lines `+++`, followed by the text of the exercise, and that of
    each step under a heading `## NAME`.

    Raises:
        ParameterError: As `read_exercise`.
    """
    lines = text.splitlines()
    fences = [number for number, line in enumerate(lines) if line.strip() == FENCE][:2]
    if len(fences) < 2 or any(line.strip() for line in lines[: fences[0]]):
        bound = f"TOML between two lines {FENCE} at its beginning, then Markdown"
        raise ParameterError(Violation(EXERCISE_FILE, place or name, "", bound))
    first, last = fences
    front = "\n" * (first + 1) + "\n".join(lines[first + 1 : last])
    values = parse_toml(front, EXERCISE_FILE, place or name)
    intro, sections = _split(lines, last + 1)
    try:
        return _build(values, name, intro, sections)
    except ParameterError as error:
        raise _locate(error, place, front) from None


def _split(lines: list[str], first: int) -> tuple[str, dict[str, _Section]]:
    """Split a file into the text before the first heading and the text of each `## NAME`."""
    sections: dict[str, _Section] = {}
    intro: list[str] = []
    present, at, name, is_code = intro, 0, "", False
    for number, line in enumerate(lines[first:], first + 1):
        if _CODE_FENCE.match(line):
            is_code = not is_code
        if not is_code and (heading := _HEADING.fullmatch(line)):
            if name:
                sections[name] = _Section(at, "\n".join(present).strip())
            name, at, present = heading[1], number, []
        else:
            present.append(line)
    if name:
        sections[name] = _Section(at, "\n".join(present).strip())
    return "\n".join(intro).strip(), sections


def _build(
    values: dict[str, Any], name: str, intro: str, sections: dict[str, _Section]
) -> Exercise:
    steps = values.get("steps")
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        raise ParameterError(Violation("steps", steps, "", "tables [[steps]]"))
    known = [str(step.get("name")) for step in steps]
    for number, step in enumerate(known):
        if step in known[:number]:
            raise ParameterError(Violation(f"steps[{number}].name", step, "", "given once"))
    for section, (line, _) in sections.items():
        if section not in known:
            bound = f"one of the steps: {', '.join(known)}"
            raise ParameterError(Violation(f"line {line}: ## heading", section, "", bound))
    for number, step in enumerate(steps):
        if "text" in step:
            bound = "omitted: the text belongs under its heading"
            raise ParameterError(Violation(f"steps[{number}].text", step["text"], "", bound))
        section = sections.get(known[number])
        if section is None or not section.text:
            finding = f"there is no text under a heading '## {known[number]}'"
            raise ParameterError(Violation(f"steps[{number}]", None, "", "", {}, finding))
    written = [step | {"text": sections[step["name"]].text} for step in steps]
    return Exercise(**values | {"name": name, "text": intro, "steps": written})


def _locate(error: ParameterError, place: str, front: str) -> ParameterError:
    """Add line numbers to the violations of an error that have none."""
    first = error.violations[0]
    if first.name.startswith("line "):
        line, _, name = first.name.partition(": ")
        where = ", ".join(filter(None, (place, line)))
        return ParameterError(replace(first, name=name), file=where)
    names = [violation.name for violation in error.violations]
    return ParameterError(*error.violations, file=describe_place(place, front, names))
