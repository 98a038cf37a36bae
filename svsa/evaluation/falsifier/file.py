"""Adversaries and scenarios as TOML files, and the adversaries that come with the package."""

from pathlib import Path
from typing import Any, TypeVar

import tomli_w

from svsa.errors import ParameterError, Violation
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.inputs.checked import Checked
from svsa.inputs.toml_file import describe_place, parse_toml, read_toml

ADVERSARY_FILE, SCENARIO_FILE = "adversary file", "scenario file"
ADVERSARY_FOLDER = Path(__file__).parent / "builtin"
_Kind = TypeVar("_Kind", bound=Checked)


def list_adversaries() -> dict[str, str]:
    """The adversaries that come with the package: name and title, fewest terms first."""
    paths = sorted(ADVERSARY_FOLDER.glob("*.toml"))
    read = {path.stem: read_toml(path, ADVERSARY_FILE) for path in paths}
    simplest = sorted(read, key=lambda name: len(read[name]["terms"]))
    return {name: str(read[name]["title"]) for name in simplest}


def read_adversary(source: str | Path, **changes: Any) -> Adversary:
    """The adversary of a file that ends in .toml, or one of the package's by its name.

    changes: fields in place of the file's. Raises `ParameterError` with file and lines.
    """
    path = Path(source)
    if path.suffix != ".toml":
        path = ADVERSARY_FOLDER / f"{path}.toml"
        if not path.exists():
            bound = f"a file that ends in .toml, or one of {', '.join(list_adversaries())}"
            raise ParameterError(Violation("adversary", str(source), "", bound))
    return _read(Adversary, path, ADVERSARY_FILE, changes)


def parse_adversary(text: str, **changes: Any) -> Adversary:
    """The adversary of a TOML text; changes: fields in place of its own."""
    return _build(Adversary, parse_toml(text, ADVERSARY_FILE, ""), text, "", changes)


def read_scenario(path: str | Path) -> LoadScenario:
    """A scenario that was kept; raises `ParameterError` with file and lines."""
    return _read(LoadScenario, Path(path), SCENARIO_FILE, {})


def write_scenario(path: str | Path, scenario: LoadScenario) -> None:
    """Keep a scenario where `read_scenario` finds it."""
    Path(path).write_text(format_scenario(scenario), encoding="utf-8")


def format_scenario(scenario: LoadScenario) -> str:
    """A scenario as TOML."""
    return tomli_w.dumps(scenario.model_dump(exclude_none=True))


def _read(kind: type[_Kind], path: Path, called: str, changes: dict[str, Any]) -> _Kind:
    sections = read_toml(path, called)
    return _build(kind, sections, path.read_text(encoding="utf-8"), str(path), changes)


def _build(
    kind: type[_Kind], sections: dict[str, Any], text: str, place: str, changes: dict[str, Any]
) -> _Kind:
    """place: the file that the text is of; empty for one of none."""
    try:
        return kind(**sections | changes)
    except ParameterError as error:
        names = [violation.name for violation in error.violations if violation.name not in changes]
        there = describe_place(place, text, names) if names else ""
        raise ParameterError(*error.violations, file=there) from None
