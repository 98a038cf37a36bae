"""Schemas of the actuators: parameters, limits, sources and datasheets."""

from functools import cache
from typing import Any

from pydantic import BaseModel, Field

from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import Limits
from svsa.actuators.reach import find_only_stiffness
from svsa.analysis.datasheet.measure import Datasheet
from svsa.analysis.datasheet.rows import list_published, list_rows
from svsa.control.installed import PAPERS_LAW
from svsa.runs.definition.experiment import build_default_load, choose_stiffness
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa_server.compiled_loops import find_compiling_s, is_compiled_for
from svsa_server.schemas.lab.parameter import ParameterState, list_parameters

ASSUMED = "assumed"


class ActuatorParameterState(ParameterState):
    """A parameter of an actuator. `default` is null: `value` is the prototype's."""

    value: float | str = Field(description="Value of the simulated plant")
    nominal: float | str = Field(
        description="Value of the nominal model, which the control laws use"
    )
    source: str = Field(description="Publication of the value, or the assumption")
    assumed: bool = Field(description="Whether the value has no published source")


class ActuatorSummary(BaseModel):
    """The actuator that a session simulates, with its default stiffness and load."""

    name: str
    title: str
    stiffness_nm_per_rad: float = Field(description="Default stiffness, N·m/rad")
    only_stiffness_nm_per_rad: float | None = Field(
        description="The only stiffness of an actuator without a stiffness motor, otherwise null"
    )
    load: ConstantLoad = Field(
        description="Default load; the actuator holds it at the default stiffness"
    )
    antagonistic: bool = Field(
        description="Whether two motors a and b pull against each other: u1 = ua + ub and u2 ="
        " ua − ub, and the torque limits are those of ua and ub"
    )


class ActuatorState(ActuatorSummary):
    """An installed actuator."""

    source: str = Field(description="Publication of the mechanism")
    is_compiled: bool = Field(
        description="Whether a session with NDOBC opens at once; otherwise the first session"
        " compiles its loop in a separate process, and the request waits"
    )
    compiling_s: float | None = Field(
        description="How long the first session has waited for the compiler, s: about 10 s; null"
        " if none waits"
    )
    limits: Limits
    parameters: list[ActuatorParameterState]
    limit_sources: dict[str, str] = Field(description="Source of each limit, by its name")
    datasheet: str = Field(description="Address of its datasheet, below /api/v1")


class DatasheetState(Datasheet):
    """A datasheet with its table for display."""

    rows: list[tuple[str, str]] = Field(description="Quantity, and value with unit")
    published_rows: list[tuple[str, str, str, str, str]] = Field(
        description="Quantity, simulated and published value with unit, deviation, source"
    )


def describe_datasheet(datasheet: Datasheet) -> DatasheetState:
    """Build the answer: a datasheet with its table for display."""
    return DatasheetState(
        **dict(datasheet), rows=list_rows(datasheet), published_rows=list_published(datasheet)
    )


@cache
def summarize_actuator(mechanism: Mechanism) -> ActuatorSummary:
    """Summarize an actuator: name, default stiffness and load."""
    return ActuatorSummary(**_summarize(mechanism))


def list_actuators() -> list[ActuatorState]:
    """List the installed actuators, the SVSA first."""
    return [describe_actuator(get_mechanism(name)) for name in list_mechanism_names()]


def describe_actuator(mechanism: Mechanism) -> ActuatorState:
    """Describe an installed actuator."""
    sources = mechanism.sources
    return ActuatorState(
        **_summarize(mechanism),
        source=mechanism.source,
        is_compiled=is_compiled_for(mechanism.name, PAPERS_LAW),
        compiling_s=find_compiling_s(),
        limits=mechanism.limits,
        parameters=[
            ActuatorParameterState(
                **parameter.model_dump(),
                value=getattr(mechanism.prototype, parameter.name),
                nominal=getattr(mechanism.nominal, parameter.name),
                source=sources[parameter.name],
                assumed=sources[parameter.name].startswith(ASSUMED),
            )
            for parameter in list_parameters(mechanism.parameters)
            if parameter.name != "mechanism"
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
        "antagonistic": mechanism.antagonistic,
    }
