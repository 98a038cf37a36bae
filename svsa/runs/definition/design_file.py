"""Parameter files: a design as TOML, every value with its source."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import tomli_w

from svsa.control.installed import check_installed
from svsa.errors import ParameterError
from svsa.inputs.toml_file import parse_toml, read_toml
from svsa.runs.definition.design import Design

PARAMETER_FILE = "parameter file"
PROTOTYPE_FILE = Path(__file__).parents[2] / "actuators" / "prototype.toml"


def read_design(path: Path | str) -> Design:
    """Read a parameter file in the format of `prototype.toml`; a value may be a plain number.

    The parameters of a law are in a separate table, such as `[parameters.fl_integral]`.

    Args:
        path: The TOML file.

    Returns:
        Actuator, nominal model, limits, gains, observer and parameters of laws, in SI units.

    Raises:
        ParameterError: If the file cannot be read or a value is invalid; the message has the name
            of the file.
    """
    return _build_design(read_toml(path, PARAMETER_FILE), str(path))


def parse_design(text: str, name: str = "") -> Design:
    """Parse the text of a parameter file called `name`.

    Raises:
        ParameterError: If a value is invalid.
    """
    return _build_design(parse_toml(text, PARAMETER_FILE, name), name)


def _build_design(sections: dict[str, Any], file: str) -> Design:
    plain = {name: _strip_sources(section) for name, section in sections.items()}
    laws = plain.get("parameters", {})
    if isinstance(laws, dict):
        plain["parameters"] = {law: _strip_sources(table) for law, table in laws.items()}
    try:
        design = Design(**plain)
        for law in design.parameters:
            _check_law(law)
    except ParameterError as error:
        raise ParameterError(*error.violations, file=file) from None
    return design


def _check_law(law: str) -> None:
    try:
        check_installed(law)
    except ParameterError as error:
        raise error.within("parameters") from None


def write_design(path: Path | str, design: Design, source: str) -> None:
    """Write a parameter file in which every value has the same source.

    Args:
        path: The file to write.
        design: Actuator, nominal model, limits, gains, observer and parameters of laws.
        source: Source of the values, as text.

    Raises:
        OSError: If the file cannot be written.
    """
    Path(path).write_text(format_design(design, lambda _: source), encoding="utf-8")


def format_design(design: Design, describe_source: Callable[[str], str]) -> str:
    """Format a parameter file.

    Args:
        design: The values.
        describe_source: Source of a section's values, by its name, such as "gains" or
            "parameters.esp".

    Returns:
        The text of the file.
    """
    sections = design.model_dump(mode="json")
    laws = {
        law: _add_source(table, describe_source(f"parameters.{law}"))
        for law, table in sections.pop("parameters").items()
    }
    written = {name: _add_source(table, describe_source(name)) for name, table in sections.items()}
    return tomli_w.dumps(written | ({"parameters": laws} if laws else {}))


@cache
def load_prototype() -> Design:
    """Read the parameters of the paper's prototype, `svsa/actuators/prototype.toml`, once.

    Returns:
        The paper's actuator, nominal model and limits, and the lab's gains and observer.

    Raises:
        ParameterError: If the file of the package contains an invalid value.
    """
    return read_design(PROTOTYPE_FILE)


def _add_source(section: dict[str, Any], source: str) -> dict[str, Any]:
    return {key: {"value": value, "source": source} for key, value in section.items()}


def _strip_sources(section: Any) -> Any:
    if not isinstance(section, dict):
        return section
    plain = {
        key: entry["value"] if isinstance(entry, dict) and "value" in entry else entry
        for key, entry in section.items()
    }
    return {key: tuple(value) if isinstance(value, list) else value for key, value in plain.items()}
