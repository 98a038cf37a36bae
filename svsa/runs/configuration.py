"""The configuration of a run: parameters, design, references and loads, with TOML files."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Self

import tomli_w
from pydantic import ValidationInfo, field_validator, model_validator

from svsa.actuators.installed import InstalledActuator
from svsa.actuators.parameters import Limits, get_mechanism_name
from svsa.actuators.reach import check_only_stiffness
from svsa.control.gains import Gains
from svsa.control.installed import (
    PAPERS_LAW,
    LaneParameters,
    LawName,
    ParametersByLaw,
    check_installed,
    get_law,
    has_own_parameters,
    is_usable,
    read_parameters,
)
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.inputs.toml_file import parse_toml, read_toml
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference, get_range

MAX_LOADS = 16
PARAMETER_FILE = "parameter file"
MAX_LANES = 4
PROTOTYPE_FILE = Path(__file__).parents[1] / "actuators" / "prototype.toml"


class Sampling(Checked):
    """The sampling of the loop."""

    period_s: Number = quantity("s", "Control period T, zero-order hold", ge=1e-4, le=0.02)


class Design(Checked):
    """The content of a parameter file: plant, nominal model, gains, laws, observer, limits,
    sampling.
    """

    actuator: InstalledActuator
    nominal: InstalledActuator
    gains: Gains
    parameters: ParametersByLaw = quantity(
        "",
        "Parameters of laws that have their own, by the law's name; else its defaults",
        default={},
    )
    observer: ObserverBandwidth
    limits: Limits
    sampling: Sampling

    @model_validator(mode="after")
    def _check_mechanism(self) -> Self:
        of_plant, of_model = map(get_mechanism_name, (self.actuator, self.nominal))
        if of_plant != of_model:
            bound = f"{of_plant}, as that of the actuator"
            raise ParameterError(Violation("nominal.mechanism", of_model, "", bound))
        return self

    def find_parameters(self, lane: "Lane") -> LawParameters | None:
        """Return the parameters that were set for a lane's law: the lane's or the design's;
        None.
        """
        if has_own_parameters(lane.law):
            return lane.parameters or self.parameters.get(lane.law)
        return lane.gains or self.gains

    def get_parameters(self, lane: "Lane") -> LawParameters:
        """Return the parameters of a lane's law: the lane's, the design's, or the defaults.

        Raises `ParameterError` for a law that is not installed and not set either.
        """
        given = self.find_parameters(lane)
        return get_law(lane.law).parameters() if given is None else given


class Lane(Checked):
    """A controller with its own plant: same references, loads and noise as the others."""

    law: LawName = quantity("", "Name of a law that is installed")
    gains: Gains | None = quantity(
        "", "Gains of a law that uses them (FL, NDOBC); by default those of the run", default=None
    )
    parameters: LaneParameters = quantity(
        "", "Parameters of a law that has its own; by default those of the run", default=None
    )
    observer: ObserverBandwidth | None = quantity(
        "", "Observer bandwidth; by default that of the run", default=None
    )

    @field_validator("parameters")
    @classmethod
    def _read_parameters(cls, given: Any, info: ValidationInfo) -> LawParameters | None:
        law = info.data.get("law")
        return given if given is None or law is None else read_parameters(law, given)

    def controlled_by(self, law: str) -> Self:
        """Return the lane with another law: gains and observer are kept, parameters are not."""
        return self if law == self.law else self.changed(law=law, parameters=None)


class LaneSetting(Checked):
    """The controller of a comparison lane."""

    lane: Whole = quantity("", "Number of the lane; 1 is the run's own", ge=2, le=MAX_LANES)
    setting: Lane


class Configuration(Design):
    """Everything that determines a run, except the commands during it."""

    law: LawName = quantity("", "Name of a law that is installed", default=PAPERS_LAW)
    comparisons: tuple[Lane, ...] = quantity(
        "",
        "Controllers of the comparison lanes, each on a plant of its own",
        default=(),
        max_length=MAX_LANES - 1,
    )
    effects: Effects = quantity(
        "", "What separates the simulation from a bench", symbol="Effects", default=IDEAL
    )
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)
    position: PositionReference
    stiffness: StiffnessReference
    loads: tuple[Load, ...] = quantity(
        "", "Loads from the start on", default=(), max_length=MAX_LOADS
    )

    @model_validator(mode="after")
    def _check_stiffness_range(self) -> Self:
        low, high = get_range(self.stiffness)
        check_only_stiffness(self.nominal, low, high)
        self.limits.check_stiffness("stiffness", low, high)
        return self

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """All lanes: the run's own controller and its comparisons."""
        return (Lane(law=self.law), *self.comparisons)

    def list_parameters(self) -> dict[str, LawParameters]:
        """List the parameters by law: those that were set, and those of the lanes' laws."""
        laws = dict.fromkeys((*(lane.law for lane in self.lanes), *self.parameters))
        own = (law for law in laws if is_usable(law) and has_own_parameters(law))
        return {law: self.get_parameters(Lane(law=law)) for law in own}

    def with_design(self, design: Design) -> Self:
        """Return the configuration with another design; unnamed laws keep their parameters."""
        parameters = {**self.parameters, **design.parameters}
        return self.changed(**(dict(design) | {"parameters": parameters}))


def read_design(path: Path | str) -> Design:
    """Read a parameter file in the format of `prototype.toml`; a value may be a plain number.

    The parameters of a law are in its own table, such as `[parameters.fl_integral]`.

    Args:
        path: The file, TOML.

    Returns:
        Actuator, nominal model, limits, gains, observer and parameters of laws, in SI units.

    Raises:
        ParameterError: For a file that cannot be read, and for every wrong value, with the name of
            the file.
    """
    return _build_design(read_toml(path, PARAMETER_FILE), str(path))


def parse_design(text: str, name: str = "") -> Design:
    """The design in the text of a parameter file called `name`; raises `ParameterError`."""
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
    """Write a parameter file. Every value has the same source.

    Args:
        path: The file to write.
        design: Actuator, nominal model, limits, gains, observer and parameters of laws.
        source: Where the values come from, as text.

    Raises:
        OSError: If the file cannot be written.
    """
    Path(path).write_text(format_design(design, lambda _: source), encoding="utf-8")


def format_design(design: Design, describe_source: Callable[[str], str]) -> str:
    """The text of a parameter file. describe_source: what stands as the source of a section's
    values, of a name as "gains" or "parameters.esp".
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
        ParameterError: If the file of the package was changed to a wrong value.
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
