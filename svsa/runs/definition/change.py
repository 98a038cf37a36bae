"""Changes of a run at known times, as typed values."""

from collections.abc import Iterable
from typing import Self

from pydantic import model_validator

from svsa.actuators.installed import InstalledActuator
from svsa.control.gains import Gains
from svsa.control.installed import LawName, ParametersByLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, Number, Whole, check_number, quantity
from svsa.runs.definition.command import OF_ARM, Command, build_command
from svsa.runs.definition.configuration import MAX_JOINTS
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference

_PLACE = ("at_s", "joint")


class Change(Checked):
    """The changes at a time of a run; omitted fields keep their values.

    A law, gains, parameters of laws, an observer, a reference, the true plant, the nominal model or
    effects are in effect from the first tick at or after `at_s`; a load has its onset then.
    """

    at_s: Number = quantity("s", "Time of the run", ge=0, le=1e6)
    law: LawName | None = quantity("", "Name of an installed law", default=None)
    gains: Gains | None = None
    parameters: ParametersByLaw | None = quantity(
        "", "Parameters of laws that have their own, by the law's name", default=None
    )
    observer: ObserverBandwidth | None = None
    spring: SpringEstimation | None = None
    position: PositionReference | None = None
    stiffness: StiffnessReference | None = None
    actuator: InstalledActuator | None = None
    nominal: InstalledActuator | None = None
    effects: Effects | None = None
    load: Load | None = None
    feedforward: Flag | None = quantity("", "Whether the arm feedforward is on", default=None)
    joint: Whole | None = quantity(
        "",
        "Joint of an arm; None: all, and joint 1 for a torque",
        ge=1,
        le=MAX_JOINTS,
        default=None,
    )

    @model_validator(mode="after")
    def _check_some(self) -> Self:
        if not self.list_given():
            names = ", ".join(name for name in type(self).model_fields if name not in _PLACE)
            raise ParameterError(Violation("change", {}, "", f"of {names}"))
        of_arm = [name for name in self.list_given() if name in OF_ARM]
        if self.joint is not None and of_arm:
            bound = f"omitted with {of_arm[0]}, which acts on all joints"
            raise ParameterError(Violation("joint", self.joint, "", bound))
        return self

    def list_given(self) -> dict[str, object]:
        """List the changes.

        Returns:
            The new value by kind of command.
        """
        return {name: value for name, value in self if name not in _PLACE and value is not None}


def build_commands(
    changes: Iterable[Change], period_s: float, duration_s: float
) -> tuple[Command, ...]:
    """Build the commands of these changes, ordered by time, at integer ticks of `period_s`.

    Raises:
        ParameterError: If a time is after the end of the run, or an element is no `Change`.
    """
    commands: list[Command] = []
    if not isinstance(changes, Iterable):
        raise ParameterError(Violation("commands", changes, "", "a list of svsa.Change"))
    for change in changes:
        if not isinstance(change, Change):
            raise ParameterError(Violation("commands", change, "", "a list of svsa.Change"))
        check_number("at_s", change.at_s, "s", 0.0, duration_s)
        tick = round(change.at_s / period_s)
        values = change.list_given()
        commands += [
            build_command(tick, kind, value, None if kind in OF_ARM else change.joint)
            for kind, value in values.items()
        ]
    return tuple(sorted(commands, key=lambda command: command.tick))
