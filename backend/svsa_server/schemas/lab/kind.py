"""Answers about kinds of effects, loads and references, described by their own files."""

from collections.abc import Mapping

from pydantic import BaseModel, Field

from svsa.actuators.faults import FAULTS
from svsa.inputs.checked import Checked
from svsa.runs.definition.paper import FIGURES
from svsa.simulation.plant.effects import EFFECTS, PRESETS, Effects, describe_preset
from svsa.simulation.plant.effects.effect import Effect, PresetName
from svsa.simulation.plant.loads import LOADS
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from svsa_server.schemas.lab.lab import FigureState
from svsa_server.schemas.lab.parameter import ParameterState, describe_parameter, list_parameters
from svsa_server.schemas.runs.fault import FaultKindState


class EffectState(BaseModel):
    """A non-ideal effect."""

    name: str
    meaning: str
    value: ParameterState | None = Field(
        description="Current value; null if an effect with parameters is off"
    )
    parameters: list[ParameterState] = Field(description="Parameters while it is on")


class EffectsPreset(BaseModel):
    """A preset of the non-ideal effects."""

    name: PresetName
    summary: str
    effects: Effects


class FormField(BaseModel):
    """A number field of a form."""

    parameter: ParameterState
    first: float = Field(description="Default value")


class KindState(BaseModel):
    """A kind of load or reference."""

    kind: str
    title: str
    hint: str = Field(description="Hint for a form, or empty")
    form: list[FormField] | None = Field(
        description="Further fields of a load; null if no form offers it"
    )


class Kinds(BaseModel):
    """All kinds of this lab, except for laws."""

    effects: list[EffectState]
    presets: list[EffectsPreset]
    loads: list[KindState]
    position: list[KindState] = Field(description="References of q_d")
    stiffness: list[KindState] = Field(description="References of σ_d")
    figures: list[FigureState] = Field(description="The paper's simulated figures")
    faults: list[FaultKindState] = Field(description="All kinds of faults")


def list_kinds() -> Kinds:
    """List every kind of this lab."""
    return Kinds(
        effects=[_describe_effect(effect) for effect in EFFECTS],
        presets=[
            EffectsPreset(name=name, summary=describe_preset(name), effects=effects)
            for name, effects in PRESETS.items()
        ],
        loads=[_describe_kind(load, load.first) for load in LOADS],
        position=[
            _describe_kind(reference, reference.first, reference.hint) for reference in POSITIONS
        ],
        stiffness=[
            _describe_kind(reference, reference.first, reference.hint) for reference in STIFFNESSES
        ],
        figures=[FigureState.model_validate(figure) for figure in FIGURES.values()],
        faults=[FaultKindState(code=code, **kind._asdict()) for code, kind in FAULTS.items()],
    )


def _describe_effect(effect: Effect) -> EffectState:
    value = describe_parameter(Effects, effect.name, Effects.model_fields[effect.name])
    parameters = type(effect.on)
    has_own = issubclass(parameters, Checked)
    return EffectState(
        name=effect.name,
        meaning=value.meaning,
        value=None if has_own else value,
        parameters=list_parameters(parameters) if has_own else [],
    )


def _describe_kind(
    model: type[Checked], first: Mapping[str, float] | None, hint: str = ""
) -> KindState:
    field = model.model_fields["kind"]
    kind = str(field.default)
    title = field.title or kind
    if first is None:
        return KindState(kind=kind, title=title, hint=hint, form=None)
    fields = [
        FormField(parameter=describe_parameter(model, name, model.model_fields[name]), first=number)
        for name, number in first.items()
    ]
    return KindState(kind=kind, title=title, hint=hint, form=fields)
