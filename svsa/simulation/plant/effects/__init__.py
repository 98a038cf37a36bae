"""Non-ideal effects, one switch and one file each.

An effect that is left out is off. A parameter error is the difference between the actuator and the
nominal model; a hanging mass is a load.
"""

from collections import namedtuple
from typing import TYPE_CHECKING, Any

from pydantic import create_model

from svsa.actuators.parameters import ActuatorParameters
from svsa.inputs.checked import Checked
from svsa.inputs.registration import import_modules
from svsa.simulation.plant.effects.effect import Effect, PresetName, Surroundings

EFFECTS: tuple[Effect, ...] = tuple(
    sorted(
        (module.EFFECT for module in import_modules(__name__) if hasattr(module, "EFFECT")),
        key=lambda effect: (effect.place, effect.name),
    )
)
"""Every effect of a file in this folder."""

if TYPE_CHECKING:

    class Effects(Checked):
        """The non-ideal effects of a bench."""

        def __init__(self, /, **values: Any) -> None: ...

        def __getattr__(self, name: str) -> Any: ...

else:
    Effects = create_model(
        "Effects",
        __base__=Checked,
        __module__=__name__,
        __doc__="Everything that a bench has and an ideal simulation does not have.",
        **{effect.name: (effect.kind, effect.field) for effect in EFFECTS},
    )


def _build_preset(*presets: PresetName) -> Effects:
    return Effects(**{effect.name: effect.on for effect in EFFECTS if effect.preset in presets})


IDEAL = Effects()
RIG = _build_preset("rig")
EVERY = _build_preset("rig", "full")

PRESETS: dict[PresetName, Effects] = {"ideal": IDEAL, "rig": RIG, "full": EVERY}
"""Three selections of effects, by name."""


def find_preset(effects: Effects) -> PresetName | None:
    """Find the preset with the same active effects, with any values; None for a mixture."""
    kind = _list_kinds(effects)
    return next((name for name, preset in PRESETS.items() if _list_kinds(preset) == kind), None)


def _list_kinds(effects: Effects) -> list[object]:
    """List for each effect whether it is on; for one without parameters its value."""
    values = (getattr(effects, effect.name) for effect in EFFECTS)
    return [True if isinstance(value, Checked) else value for value in values]


def describe_preset(name: PresetName) -> str:
    """Describe the effects of a preset in a sentence."""
    if name == "ideal":
        return "Every state known exactly, torque at once. The model's parameters still differ."
    phrases = ", ".join(effect.phrase for effect in EFFECTS if effect.preset == name)
    return f"{phrases[:1].upper()}{phrases[1:]}." if name == "rig" else f"Also {phrases}."


_IN_LOOP = [effect for effect in EFFECTS if effect.off is not None]
EffectConstants = namedtuple("EffectConstants", [effect.name for effect in _IN_LOOP])
"""The effects as constants of the compiled loop, one field each; `off` for an effect that is off.
"""
NO_EFFECTS = EffectConstants(*(effect.off for effect in _IN_LOOP))


def build_effect_constants(
    effects: Effects, seed: int, actuator: ActuatorParameters, period_s: float
) -> EffectConstants:
    """Build the constants of all effects, on or off."""
    surroundings = Surroundings(seed, actuator, period_s)
    return EffectConstants(*(_build_constants(one, effects, surroundings) for one in _IN_LOOP))


def _build_constants(effect: Effect, effects: Effects, surroundings: Surroundings) -> Any:
    value = getattr(effects, effect.name)
    is_on = effect.build is not None and value != effect.field.default
    return effect.build(value, surroundings) if is_on and effect.build else effect.off
