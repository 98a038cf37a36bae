"""Requests and answers about the settings of a session."""

from typing import Annotated, Any, ClassVar

from pydantic import BaseModel, Field, WithJsonSchema, create_model

from svsa.actuators.arm.parameters import ArmParameters
from svsa.actuators.installed import InstalledActuator, get_mechanism, list_mechanism_names
from svsa.actuators.parameters import Limits
from svsa.control.arm_payload import PayloadAdaptation
from svsa.control.installed import InstalledLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.errors import ParameterError
from svsa.inputs.checked import Checked, quantity
from svsa.runs.definition.design import MAX_LANES, Lane
from svsa.simulation.arm.tip_reference import TipReference
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.effects.effect import PresetName
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa_server.schemas.lab.gain import GainsState
from svsa_server.schemas.lab.law import InstalledLane

LONGEST_PARAMETER_FILE = 100_000


class LawRequest(Checked):
    """The law of lane 1, and those of the comparison lanes; every plant keeps its state."""

    law: InstalledLaw = quantity("", "Name of an installed law: see GET /laws")
    comparison_laws: tuple[InstalledLaw, ...] = quantity(
        "",
        "Laws of the comparison lanes in order; omitted lanes keep their laws",
        max_length=MAX_LANES - 1,
        default=(),
    )


class _Patch(Checked):
    """Changes of a section, which errors name: two sections may have the same fields."""

    section: ClassVar[str] = ""

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ParameterError as error:
            raise error.within(self.section) from None


def build_patch(section: str) -> type[Checked]:
    """Build a PATCH model of the parameters of every installed actuator, each optional.

    Units, descriptions and bounds are those of the first actuator that has the field; the actuator
    of the session validates its own. A value must be given: the model rejects null.
    """
    fields: dict[str, Any] = {}
    for mechanism in map(get_mechanism, list_mechanism_names()):
        for name, field in mechanism.parameters.model_fields.items():
            if name != "mechanism" and name not in fields:
                fields[name] = (field.annotation, field.merge_field_infos(field, default=None))
    patch = create_model(f"{section.title()}Patch", __base__=_Patch, **fields)
    patch.section = section
    return patch


class LanesRequest(Checked):
    """The controllers of the comparison lanes."""

    comparisons: tuple[InstalledLane, ...] = quantity(
        "", "Comparison lanes, up to three", max_length=MAX_LANES - 1
    )


class ParameterFileRequest(Checked):
    """A parameter file as `svsa identify` writes it."""

    toml: Annotated[str, Field(max_length=LONGEST_PARAMETER_FILE)] = quantity(
        "", "The text of the file"
    )


ActuatorValues = Annotated[
    InstalledActuator,
    WithJsonSchema(
        {
            "type": "object",
            "additionalProperties": {"anyOf": [{"type": "number"}, {"type": "string"}]},
            "description": "Parameters by name: see GET /actuators",
        },
        mode="serialization",
    ),
]


class ArmSetupState(BaseModel):
    """The arm of a session."""

    links: ArmParameters
    model: ArmParameters = Field(description="The links in the model of the feedforward")
    feedforward: bool = Field(description="Whether the laws get the arm feedforward")
    adaptation: PayloadAdaptation | None = Field(description="Estimate of the mass at the tip")
    tip: TipReference | None = Field(
        description="Reference of the tip, in place of those of the joints"
    )
    other_joints: list["ConfigurationState"] = Field(description="Joints from the second on")


class ConfigurationState(BaseModel):
    """All settings of a session; for an arm those of joint 1."""

    law: str
    position: PositionReference
    stiffness: StiffnessReference
    gains: GainsState
    parameters: dict[str, dict[str, Any]] = Field(
        description="Parameters by law: those that were set, and those of the laws that control"
        " lanes"
    )
    observer: ObserverBandwidth
    spring: SpringEstimation
    limits: Limits
    actuator: ActuatorValues
    nominal: ActuatorValues
    comparisons: tuple[Lane, ...]
    effects: Effects
    effects_preset: PresetName | None = Field(
        description="The preset with the same effects, with any values; null for a mixture"
    )
    seed: int
    arm: ArmSetupState | None = Field(description="Null for a single joint")


ArmSetupState.model_rebuild()
