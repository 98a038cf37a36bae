"""Homing by hand: link, motor 1 and motor 2, each confirmed at its mark.

A drive's zero is its position at the reset, so the marks are confirmed after every arming: the
mechanism must be at its marks when the drives are reset. Only the deflection encoder's zero
survives a power cycle, in the calibration record.
"""

from typing import Literal, NamedTuple

from svsa.errors import ParameterError, StateError, Violation
from svsa.hardware.bench.settings import AXIS_WORDS

Axis = Literal["link", "motor1", "motor2"]


class HomingStep(NamedTuple):
    """An axis, and the instruction before it is confirmed."""

    name: Axis
    instruction: str


STEPS = (
    HomingStep("link", "Set the link to its zero mark by hand, spring relaxed: q = 0, φ = 0."),
    HomingStep("motor1", "Check that motor 1 is at its zero mark."),
    HomingStep("motor2", "Check that motor 2 is at its zero mark."),
)
DONE = "All axes are at home."


class Homing:
    """The axes confirmed since the drives were last reset."""

    def __init__(self) -> None:
        self.confirmed: dict[str, str] = {}

    @property
    def next_step(self) -> Axis | None:
        """Return the axis to confirm next, or None if all are confirmed."""
        return next((step.name for step in STEPS if step.name not in self.confirmed), None)

    def confirm(self, step: str, by: str) -> None:
        """Confirm that `by` has seen this axis at its mark.

        Raises:
            StateError: If another axis is next.
        """
        names = [known.name for known in STEPS]
        if step not in names:
            raise ParameterError(Violation("step", step, "", "one of " + ", ".join(names)))
        if not by.strip():
            raise ParameterError(
                Violation("by", by, "", "the name of the user who checked the mark")
            )
        if step != self.next_step:
            expected = AXIS_WORDS[self.next_step] if self.next_step else "nothing is left"
            raise StateError(
                f"The next mark to confirm is not that of {AXIS_WORDS[step]}: {expected}."
            )
        self.confirmed[step] = by

    def reset(self) -> None:
        """Discard all confirmations: the drives have been reset."""
        self.confirmed.clear()


def get_instruction(step: str | None) -> str:
    """Return the instruction of a step."""
    return next((known.instruction for known in STEPS if known.name == step), DONE)
