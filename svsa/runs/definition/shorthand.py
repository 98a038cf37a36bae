"""Abbreviated settings in scripts, and their conversion to validated values.

Unambiguous abbreviations are accepted: a number for a constant, one load for a list, some fields of
parameters. Files and REST accept the full form only.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias, TypedDict

from pydantic import TypeAdapter, ValidationError

from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import Limits, MechanismParameters
from svsa.actuators.reach import find_only_stiffness
from svsa.control.gains import Gains
from svsa.control.law_names import AnyLaw, KnownLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked
from svsa.inputs.explanation import explain
from svsa.inputs.nearest import suggest
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane, Sampling
from svsa.simulation.plant.effects import PRESETS, Effects
from svsa.simulation.plant.effects.effect import PresetName
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import AnyLoad
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

Part: TypeAlias = Mapping[str, Any]
"""Changed fields by name; the others stay."""
LawChoice: TypeAlias = KnownLaw | AnyLaw
GivenPosition: TypeAlias = PositionReference | Part | float
"""A reference, or a constant angle, rad."""
GivenStiffness: TypeAlias = StiffnessReference | Part | float
"""A reference, or a constant stiffness, N·m/rad."""
GivenEffects: TypeAlias = Effects | Part | PresetName
GivenActuator: TypeAlias = MechanismParameters | Part
GivenGains: TypeAlias = Gains | Part
GivenObserver: TypeAlias = ObserverBandwidth | Part | float
"""Bandwidths, or one for all three channels, rad/s."""
GivenSpring: TypeAlias = SpringEstimation | Part | bool
"""The spring estimator, its changed fields, or whether it is on."""
GivenLanes: TypeAlias = Lane | LawChoice | Sequence[Lane | LawChoice]


class Settings(TypedDict, total=False):
    """Fields of a configuration, as keywords of `svsa.simulate` and its relatives."""

    comparisons: GivenLanes
    effects: GivenEffects
    seed: int
    position: GivenPosition
    stiffness: GivenStiffness
    loads: Load | Part | Sequence[Load | Part]
    actuator: GivenActuator | str
    nominal: GivenActuator
    gains: GivenGains
    observer: GivenObserver
    spring: GivenSpring
    limits: Limits | Part
    sampling: Sampling | Part


class _Form:
    """The expected form of a setting, for an error message."""

    def __init__(self, kind: Any, cure: str, is_partial: bool = False) -> None:
        self.kind, self.cure, self.is_partial = kind, cure, is_partial
        self.read = TypeAdapter(kind).validate_python


_PLANT = _Form(
    MechanismParameters,
    'the name of an actuator, such as "qbmove", svsa.ActuatorParameters, or a dict of the fields'
    ' that are different, such as {"link_inertia_kg_m2": 0.05}',
    is_partial=True,
)
_FORMS = {
    "position": _Form(
        PositionReference, "a reference, such as svsa.SinePosition(…), or an angle in rad"
    ),
    "stiffness": _Form(
        StiffnessReference,
        "a reference, such as svsa.SineStiffness(…), or a stiffness in N·m/rad",
    ),
    "effects": _Form(Effects, f"svsa.Effects(…), or one of {', '.join(PRESETS)}"),
    "actuator": _PLANT,
    "nominal": _PLANT,
    "gains": _Form(
        Gains,
        "svsa.Gains, such as svsa.Gains.from_poles([-60] * 4, [-60] * 2), poles in rad/s",
        is_partial=True,
    ),
    "observer": _Form(
        ObserverBandwidth,
        "svsa.ObserverBandwidth(bandwidth_rad_per_s=(β2, β4, β6)), or one bandwidth in rad/s",
        is_partial=True,
    ),
    "spring": _Form(
        SpringEstimation,
        "True, False, svsa.SpringEstimation(…), or a dict of the fields that are different",
        is_partial=True,
    ),
    "limits": _Form(
        Limits, "svsa.Limits, or a dict of the fields that are different", is_partial=True
    ),
    "sampling": _Form(Sampling, 'a dict, such as {"period_s": 0.001}', is_partial=True),
}
_OTHERS = ("law", "comparisons", "loads", "seed")
_LISTED = str | Mapping | Checked


def change_configuration(
    configuration: Configuration, settings: Mapping[str, Any], keywords: Iterable[str] = ()
) -> Configuration:
    """Return the configuration with these settings.

    Args:
        configuration: The configuration to change.
        settings: As `Settings`, and `law`, whose value may be a `Lane` with parameters of its own.
        keywords: Further keywords of the caller, which the error message may suggest.

    Raises:
        ParameterError: If there is no such setting, or its value is invalid.
    """
    known = [*_FORMS, *_OTHERS]
    unknown = [name for name in settings if name not in known]
    if unknown:
        raise ParameterError(
            *(
                Violation(
                    name,
                    settings[name],
                    "",
                    "",
                    finding=f"there is no such keyword{suggest(name, [*keywords, *known])}",
                )
                for name in unknown
            )
        )
    present = dict(configuration)
    if isinstance(lane := settings.get("law"), Lane):
        settings = {**settings, **_read_controller(lane, configuration.parameters)}
    if isinstance(name := settings.get("actuator"), str):
        mechanism = read_mechanism(name)
        present |= mechanism
        settings = mechanism | {key: value for key, value in settings.items() if key != "actuator"}
    return configuration.changed(
        **{name: read_setting(name, value, present[name]) for name, value in settings.items()}
    )


def _read_controller(lane: Lane, parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Convert the controller of the first lane to fields of a configuration."""
    written = {"law": lane.law, "gains": lane.gains, "observer": lane.observer}
    if lane.parameters is not None:
        written["parameters"] = {**parameters, lane.law: lane.parameters}
    return {name: value for name, value in written.items() if value is not None}


def read_mechanism(name: str, field: str = "actuator") -> dict[str, Any]:
    """Convert the name of an actuator to fields of a configuration.

    Args:
        name: Name of an installed actuator.
        field: Name of the value in the error.

    Returns:
        Plant, nominal model, limits, gains and observer, and the stiffness if it has only one.

    Raises:
        ParameterError: If no actuator of that name is installed.
    """
    mechanism = get_mechanism(name, field)
    (position, stiffness), beta = mechanism.poles_rad_per_s, mechanism.observer_rad_per_s
    read: dict[str, Any] = {
        "actuator": mechanism.prototype,
        "nominal": mechanism.nominal,
        "limits": mechanism.limits,
        "gains": Gains.from_poles([-position] * 4, [-stiffness] * 2),
        "observer": ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta)),
    }
    only = find_only_stiffness(mechanism.nominal)
    if only is not None:
        read["stiffness"] = ConstantStiffness(stiffness_nm_per_rad=only)
    return read


def read_setting(name: str, written: Any, present: Any) -> Any:
    """Convert an abbreviated setting to its validated value.

    Args:
        name: Name of the setting, such as "stiffness".
        written: The value in the script.
        present: The current value, which a partial value changes.

    Raises:
        ParameterError: If the value is invalid; the message describes valid ones.
    """
    if name in ("loads", "comparisons"):
        return _read_each(written, name, read_load if name == "loads" else read_lane)
    form = _FORMS.get(name)
    if form is None:
        return written
    value = _spell_out(name, written)
    if form.is_partial and isinstance(value, Mapping):
        try:
            return present.changed(**value)
        except ParameterError as error:
            raise error.within(name) from None
    return _check(name, value, written, form)


def _spell_out(name: str, value: Any) -> Any:
    """Replace a number or a name by the value that it abbreviates."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    try:
        match name:
            case "position" if is_number:
                return ConstantPosition(position_rad=value)
            case "stiffness" if is_number:
                return ConstantStiffness(stiffness_nm_per_rad=value)
            case "observer" if is_number:
                return ObserverBandwidth(bandwidth_rad_per_s=(value, value, value))
            case "spring" if isinstance(value, bool):
                return {"is_on": value}
            case "effects" if isinstance(value, str):
                return next((preset for key, preset in PRESETS.items() if key == value), value)
    except ParameterError as error:
        raise error.within(name) from None
    return value


def _check(name: str, value: Any, written: Any, form: _Form) -> Any:
    if not isinstance(value, Checked | Mapping):
        raise ParameterError(Violation(name, written, "", form.cure))
    try:
        return form.read(value)
    except ParameterError as error:
        raise error.within(name) from None
    except ValidationError as error:
        if isinstance(value, Checked):
            raise ParameterError(Violation(name, written, "", form.cure)) from None
        raise ParameterError(*explain(error)).within(name) from None


_LOAD = _Form(Load, 'a load, such as svsa.PaperLoad() or {"kind": "paper"}')
_LANE = _Form(Lane, 'svsa.Lane(law="fl"), or the name of a law')


def _read_each(values: Any, name: str, read: Callable[[Any, str], Any]) -> tuple[Any, ...]:
    """Read each element of a list; anything else is a list of one element."""
    if isinstance(values, _LISTED) or not isinstance(values, Iterable):
        values = (values,)
    return tuple(read(value, f"{name}[{number}]") for number, value in enumerate(values))


def read_loads(loads: Any, name: str) -> tuple[AnyLoad, ...]:
    """Return loads from one load or several, also from dicts.

    Raises:
        ParameterError: If one is not a load; the message contains `name` and its number.
    """
    return _read_each(loads, name, read_load)


def read_load(load: Any, name: str = "load") -> AnyLoad:
    """Return a load, also from a dict.

    Raises:
        ParameterError: If it is neither; the message contains `name`.
    """
    return _check(name, load, load, _LOAD)


def read_lane(lane: Any, name: str) -> Lane:
    """Return a lane, also from the name of a law.

    Raises:
        ParameterError: If it is neither; the message contains `name`.
    """
    return _check(name, {"law": lane} if isinstance(lane, str) else lane, lane, _LANE)
