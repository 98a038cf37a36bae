"""Files of the falsifier: adversaries, scenarios, and interrupted searches.

Scenarios are stored by name in the folder of the runs, so that any law can be run in them.
"""

from pathlib import Path
from typing import Any

import tomli_w

from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.journal import Journal, define_search
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.evaluation.search import Method
from svsa.evaluation.studies.store import check_name
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.toml_file import build_checked, parse_toml, read_checked, read_toml
from svsa.runs.records.header import replace_file

ADVERSARY_FILE, SCENARIO_FILE = "adversary file", "scenario file"
ADVERSARY_FOLDER = Path(__file__).parent / "builtin"
EXAMPLES = Path(__file__).parent / "examples"
"""A scenario that a search found, in the package: `make examples` searches it."""
_SUFFIX = ".toml"
SEARCH_SUFFIX = ".search"


def list_adversaries() -> dict[str, str]:
    """List the built-in adversaries: name and title, fewest terms first."""
    paths = sorted(ADVERSARY_FOLDER.glob("*.toml"))
    read = {path.stem: read_toml(path, ADVERSARY_FILE) for path in paths}
    simplest = sorted(read, key=lambda name: len(read[name]["terms"]))
    return {name: str(read[name]["title"]) for name in simplest}


def read_adversary(source: str | Path, **changes: Any) -> Adversary:
    """Read an adversary from a .toml file, or a built-in one by its name.

    Args:
        source: Path of a .toml file, or name of a built-in adversary.
        **changes: Fields that replace those of the file.

    Returns:
        The adversary.

    Raises:
        ParameterError: If the file is missing or invalid, with file and lines.
    """
    path = Path(source)
    if path.suffix != ".toml":
        path = ADVERSARY_FOLDER / f"{path}.toml"
        if not path.exists():
            bound = f"a file that ends in .toml, or one of {', '.join(list_adversaries())}"
            raise ParameterError(Violation("adversary", str(source), "", bound))
    return read_checked(Adversary, path, ADVERSARY_FILE, changes)


def parse_adversary(text: str, **changes: Any) -> Adversary:
    """Parse an adversary in TOML; `changes` replace fields."""
    return build_checked(Adversary, parse_toml(text, ADVERSARY_FILE, ""), text, "", changes)


def read_scenario(path: str | Path) -> LoadScenario:
    """Read a saved scenario.

    Args:
        path: Path of the .toml file.

    Returns:
        The scenario.

    Raises:
        ParameterError: If the file is missing or invalid, with file and lines.
    """
    return read_checked(LoadScenario, Path(path), SCENARIO_FILE)


def write_scenario(path: str | Path, scenario: LoadScenario) -> None:
    """Save a scenario for `read_scenario`.

    Args:
        path: Path of the .toml file.
        scenario: The scenario.
    """
    Path(path).write_text(format_scenario(scenario), encoding="utf-8")


def format_scenario(scenario: LoadScenario) -> str:
    """A scenario as TOML."""
    return tomli_w.dumps(scenario.model_dump(exclude_none=True))


def find_scenarios_folder() -> Path:
    """Return the folder of saved scenarios."""
    return find_data_folder() / "scenarios"


def list_scenarios(folder: Path | None = None) -> dict[str, LoadScenario]:
    """List the readable scenarios of a folder, by name.

    folder: None for that of the saved scenarios; `EXAMPLES` for the scenario in the package.
    """
    scenarios = {}
    for path in sorted((folder or find_scenarios_folder()).glob(f"*{_SUFFIX}")):
        try:
            scenarios[path.stem] = read_scenario(path)
        except ParameterError:
            continue
    return scenarios


def keep_scenario(name: str, scenario: LoadScenario) -> Path:
    """Save a scenario under a name; return its file.

    Raises:
        ParameterError: If the name is invalid, or another scenario has it.
    """
    path = _locate(name)
    content = format_scenario(scenario).encode()
    if path.exists() and path.read_bytes() != content:
        raise ParameterError(Violation("name", name, "", "a free name: another scenario has it"))
    path.parent.mkdir(parents=True, exist_ok=True)
    replace_file(path, content)
    return path


def is_kept(name: str) -> bool:
    """Return whether a scenario is saved under this name.

    Raises:
        ParameterError: If the name is invalid.
    """
    return _find(name).exists()


def open_scenario(source: str) -> LoadScenario:
    """Read a scenario from a .toml file, or a saved one by its name.

    Raises:
        ParameterError: If there is none, or its content is invalid, with file and lines.
    """
    if source.endswith(_SUFFIX):
        return read_scenario(source)
    if not is_kept(source):
        known = ", ".join(list_scenarios()) or "there is none"
        bound = f"a file that ends in {_SUFFIX}, or the name of a saved one: {known}"
        raise ParameterError(Violation("scenario", source, "", bound))
    return read_scenario(_find(source))


def is_example(name: str) -> bool:
    """Whether a name is that of the scenario in the package, and no saved one has it."""
    return _find(name).parent == EXAMPLES


def forget_scenario(name: str) -> bool:
    """Delete a saved scenario; return whether it existed."""
    path = _locate(name)
    is_there = path.exists()
    path.unlink(missing_ok=True)
    return is_there


def _locate(name: str) -> Path:
    check_name(name)
    return find_scenarios_folder() / f"{name}{_SUFFIX}"


def _find(name: str) -> Path:
    """Find the file of a saved scenario, or that of the example of this name."""
    path, example = _locate(name), EXAMPLES / f"{name}{_SUFFIX}"
    return example if example.exists() and not path.exists() else path


def open_search(path: Path, adversary: Adversary, seed: int, method: Method) -> Journal:
    """Open the journal of a search that writes to `path`: the severities of each generation."""
    definition = define_search(
        adversary.law, seed=seed, method=method, adversary=adversary.model_dump(mode="json")
    )
    return Journal(path.with_name(path.name + SEARCH_SUFFIX), definition)
