"""Commands to the loop of a bench, and the ticks at which they take effect."""

import time
from collections.abc import Callable
from typing import Any

from svsa.errors import StateError
from svsa.hardware.realtime.configuration import check_loads, check_takes_no_time
from svsa.hardware.realtime.launch import Rest
from svsa.hardware.session.run import TWIN
from svsa.runs.definition.command import ApplyLoad, Command, Set, is_held
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.runs.session.journal import Journal

CHANGING_S = 0.001
_REFERENCES = ("position", "stiffness")
LONGEST_CHANGES_S = 10.0
"""Maximum time that a command waits for the loop's answers to earlier ones, s."""

Ask = Callable[[str, object], dict[str, Any]]
"""Sends a request to the loop and returns its answer."""


class BenchCommands:
    """Sends commands to the loop, and logs each at the tick reported by the loop.

    Args:
        journal: Journal of the current run.
        ask: Sends a request; raises the loop's rejection.
        is_moving: Returns whether the bench moves.
        rest: Lets time pass.
    """

    def __init__(
        self, journal: Journal, ask: Ask, is_moving: Callable[[], bool], rest: Rest
    ) -> None:
        self._journal, self._ask, self._is_moving, self._rest = journal, ask, is_moving, rest
        self._pending = 0

    @property
    def is_pending(self) -> bool:
        """Whether the loop has not answered yet: later samples are not read meanwhile."""
        return self._pending > 0

    def change(self, command: Command) -> Command:
        """Send a command, and return it with the tick of the loop."""
        self._journal.check(command)
        if isinstance(command, ApplyLoad):
            check_loads((command.argument,))
        return self._journal.enter(self._give(self._complete(command)))

    def patch(self, build: Callable[[Configuration], Command]) -> None:
        """Call `change` after the loop has answered earlier changes; no effect if nothing would
        change.

        Raises:
            StateError: If it has not answered all of them within `LONGEST_CHANGES_S`.
        """
        self._wait()
        configuration = self._journal.run.configuration
        command = self._complete(build(configuration))
        if not is_held(configuration, command):
            self.change(command)

    def _wait(self) -> None:
        end = time.monotonic() + LONGEST_CHANGES_S
        while self.is_pending:
            if time.monotonic() > end:
                raise StateError(
                    f"The change was not applied: the loop of the bench has {self._pending} earlier"
                    f" changes to answer, for more than {LONGEST_CHANGES_S:g} s. Send it again."
                )
            self._rest(CHANGING_S)

    def _complete(self, command: Command) -> Command:
        """Adapt the command for a bench: lane 2 is its twin in any case."""
        if command.kind == "lane" and command.argument.lane == TWIN + 1:
            raise StateError(
                f"Lane {TWIN + 1} is the bench's simulated twin, which has the law and the gains"
                " of the bench: set those, or a lane after it."
            )
        if command.kind == "comparisons":
            self._wait()
            twin = Lane(law=self._journal.run.configuration.law)
            others = tuple(lane for lane in command.argument if lane != twin)
            return command.changed(argument=(twin, *others))
        return command

    def _give(self, command: Command) -> Command:
        """Apply the command at the tick reported by the loop."""
        if isinstance(command, Set) and command.kind in _REFERENCES and self._is_moving():
            check_takes_no_time(command.argument)
        self._pending += 1
        try:
            tick = self._ask("change", command.to_json())["tick"]
        finally:
            self._pending -= 1
        # Another run may have started; its samples are not those up to this tick.
        self._journal.advance(tick - self._journal.run.tick)
        return command.at(self._journal.run.tick)
