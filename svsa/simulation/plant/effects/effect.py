"""The description of a non-ideal effect in its own file, read by the lab."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from svsa.actuators.parameters import ActuatorParameters

PresetName = Literal["ideal", "rig", "full"]


class Surroundings(NamedTuple):
    """Inputs of an effect's constants: seed of the run, plant, period (s)."""

    seed: int
    actuator: ActuatorParameters
    period_s: float


@dataclass(frozen=True, kw_only=True)
class Effect:
    """A non-ideal effect, as `EFFECT` of a file in this folder.

    Attributes:
        name: Name of the field of `Effects`, and of its constants in `EffectConstants`.
        place: Sort key in lists, ascending.
        kind: Type of the field: `Parameters | None` for an effect with parameters, which is off as
            None, or `Whole`, `Number` or `Flag`.
        field: A `quantity` with its meaning; for a number also unit and bounds. Its default is off.
        words: Text for a list of runs if the effect is on; {} is its value.
        preset: The first preset in which it is on; None for none.
        on: Its value in that preset, also used to test it alone; None for an effect that can only
            be switched off.
        phrase: Text about the effect in the description of that preset.
        off: Its constants in the compiled loop while it is off: a number or a named tuple of
            numbers; None for an effect that needs none there.
        build: Computes the constants from a value that is on.
        resist: Compiled, (effects, x, load) -> load: an effect that acts as a force on link and
            motors adds it to the `ExternalLoad`; its constants are the field of its name in
            `effects`. The plant calls it in each Runge–Kutta stage.
    """

    name: str
    place: int
    kind: Any
    field: Any
    words: str
    preset: PresetName | None = None
    on: Any = None
    phrase: str = ""
    off: Any = None
    build: Callable[[Any, Surroundings], Any] | None = None
    resist: Any = None

    def describe(self, value: Any) -> str:
        """Describe its value; empty if it is off."""
        return "" if value == self.field.default else self.words.format(value)
