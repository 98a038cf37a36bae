"""Scenarios that are kept by name, beside the runs, so that any law can be put through them."""

from pathlib import Path

from svsa.errors import ParameterError, Violation
from svsa.evaluation.falsifier.file import format_scenario, read_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.studies.store import check_name
from svsa.runs.records.catalogue.runs import find_data_folder
from svsa.runs.records.header import replace_file

_SUFFIX = ".toml"


def find_scenarios_folder() -> Path:
    """Where scenarios are kept."""
    return find_data_folder() / "scenarios"


def list_scenarios() -> dict[str, LoadScenario]:
    """Those that are kept and can be read, by name."""
    found = {}
    for path in sorted(find_scenarios_folder().glob(f"*{_SUFFIX}")):
        try:
            found[path.stem] = read_scenario(path)
        except ParameterError:
            continue
    return found


def keep_scenario(name: str, scenario: LoadScenario) -> Path:
    """Keep a scenario by a name; the file that it is in.

    Raises `ParameterError` for a name that is none, and where another scenario has it.
    """
    path = _locate(name)
    content = format_scenario(scenario).encode()
    if path.exists() and path.read_bytes() != content:
        raise ParameterError(Violation("name", name, "", "free: another scenario is kept by it"))
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, content)
    return path


def is_kept(name: str) -> bool:
    """Whether a scenario is kept by this name; raises `ParameterError` for one that is none."""
    return _locate(name).exists()


def open_scenario(source: str) -> LoadScenario:
    """The scenario of a file that ends in .toml, or the one that is kept by this name.

    Raises `ParameterError` where there is none, and with file and lines for what is wrong in it.
    """
    if source.endswith(_SUFFIX):
        return read_scenario(source)
    if not is_kept(source):
        known = ", ".join(list_scenarios()) or "there is none"
        bound = f"a file that ends in {_SUFFIX}, or kept by its name: {known}"
        raise ParameterError(Violation("scenario", source, "", bound))
    return read_scenario(_locate(source))


def forget_scenario(name: str) -> bool:
    """Delete what is kept by a name; whether there was anything."""
    path = _locate(name)
    is_there = path.exists()
    path.unlink(missing_ok=True)
    return is_there


def _locate(name: str) -> Path:
    check_name(name)
    return find_scenarios_folder() / f"{name}{_SUFFIX}"
