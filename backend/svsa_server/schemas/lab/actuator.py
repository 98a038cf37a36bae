"""What goes over the wire about actuators: what each file says of itself."""

from functools import cache
from typing import Any

from pydantic import BaseModel, Field

from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import Limits
from svsa.actuators.reach import find_only_stiffness
from svsa.analysis.datasheet.measure import Datasheet, Preset, Variation
from svsa.analysis.datasheet.rows import list_rows
from svsa.runs.experiment import build_default_load, choose_stiffness
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa_server.schemas.lab.parameter import ParameterState, list_parameters

ASSUMED = "assumed"


class ActuatorParameterState(ParameterState):
    """A parameter of an actuator. `default` is null: `value` is the prototype's."""

    value: float | str = Field(description="Of the simulated plant")
    nominal: float | str = Field(description="Of the model that the control laws get")
    source: str = Field(description="Publication of the value, or what it was assumed from")
    assumed: bool = Field(description="Without a published source")


class ActuatorSummary(BaseModel):
    """Which actuator a session simulates, and what its references and loads have to respect."""

    name: str
    title: str
    stiffness_nm_per_rad: float = Field(description="Default stiffness, N·m/rad")
    only_stiffness_nm_per_rad: float | None = Field(
        description="The only stiffness of an actuator without a stiffness motor, else null"
    )
    load: ConstantLoad = Field(description="Default load: the default stiffness holds it")


class ActuatorState(ActuatorSummary):
    """An actuator that is installed."""

    source: str = Field(description="Publication of the mechanism")
    antagonistic: bool = Field(description="Two motors pull against each other")
    limits: Limits
    parameters: list[ActuatorParameterState]
    limit_sources: dict[str, str] = Field(description="Source of each limit, by its name")
    datasheet: str = Field(description="Address of its datasheet, below /api/v1")


class DatasheetState(BaseModel):
    """A datasheet (Grioli et al., IJRR 2015), measured on the simulated plant.

    Variations and the range at nominal torque are null where the actuator does not reach them.
    """

    name: str
    title: str
    source: str
    peak_torque_nm: float = Field(description="Largest torque that spring and motor 1 hold")
    nominal_torque_nm: float = Field(description="Half of the peak torque, assumed")
    stiffness_range_nm_per_rad: tuple[float, float]
    stiffness_range_at_nominal_nm_per_rad: tuple[float, float] | None
    variation_unloaded: Variation | None
    variation_loaded: Variation | None
    deflection_max_rad: float
    elastic_energy_max_j: float
    presets: list[Preset]
    torque_stiffness: list[tuple[float, float, float]] = Field(
        description="Torque, N·m, least and greatest stiffness at it, N·m/rad"
    )
    assumed: list[str] = Field(description="Parameters and limits without a published source")
    rows: list[tuple[str, str]] = Field(description="Its numbers in words: quantity, value")


def describe_datasheet(found: Datasheet) -> DatasheetState:
    """A datasheet, with its numbers in words."""
    return DatasheetState(**vars(found), rows=list_rows(found))


@cache
def summarize_actuator(mechanism: Mechanism) -> ActuatorSummary:
    """Which actuator it is, and its default stiffness and load."""
    return ActuatorSummary(**_summarize(mechanism))


def list_actuators() -> list[ActuatorState]:
    """Every actuator that is installed, the SVSA first."""
    return [describe_actuator(get_mechanism(name)) for name in list_mechanism_names()]


def describe_actuator(mechanism: Mechanism) -> ActuatorState:
    """An actuator in the words of its file."""
    sources = mechanism.sources
    return ActuatorState(
        **_summarize(mechanism),
        source=mechanism.source,
        antagonistic=mechanism.antagonistic,
        limits=mechanism.limits,
        parameters=[
            ActuatorParameterState(
                **one.model_dump(),
                value=getattr(mechanism.prototype, one.name),
                nominal=getattr(mechanism.nominal, one.name),
                source=sources[one.name],
                assumed=sources[one.name].startswith(ASSUMED),
            )
            for one in list_parameters(mechanism.parameters)
            if one.name != "mechanism"
        ],
        limit_sources={name: sources[name] for name in Limits.model_fields},
        datasheet=f"/actuators/{mechanism.name}/datasheet",
    )


def _summarize(mechanism: Mechanism) -> dict[str, Any]:
    return {
        "name": mechanism.name,
        "title": mechanism.title,
        "stiffness_nm_per_rad": choose_stiffness(mechanism),
        "only_stiffness_nm_per_rad": find_only_stiffness(mechanism.nominal),
        "load": build_default_load(mechanism),
    }
