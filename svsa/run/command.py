"""Commands: what may change a run, as values that can be written down and given again."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Annotated, Any, NamedTuple

import numpy as np
from pydantic import Field, TypeAdapter, ValidationError

from svsa.checked import Whole
from svsa.control.gains import Gains
from svsa.control.installed import LawName, ParametersByLaw
from svsa.errors import ParameterError, StateError, Violation
from svsa.explanation import explain
from svsa.observer.disturbance import ObserverBandwidth
from svsa.parameters import ActuatorParameters
from svsa.plant.disturbances import Load, ScheduledLoad, follow_loads
from svsa.plant.effects import Effects
from svsa.reference.trajectories import PositionReference, StiffnessReference
from svsa.run.configuration import Configuration, Lane, LaneSetting
from svsa.run.run import Run
from svsa.signals import CHANNELS

STRETCH_TICKS = 10_000


class CommandKind(NamedTuple):
    """How a command acts on a run, what its argument is, and how an event reads."""

    apply: Callable[[Run, Any], object]
    argument: TypeAdapter[Any]
    label: str


KINDS: dict[str, CommandKind] = {
    "position": CommandKind(Run.set_position, TypeAdapter(PositionReference), "Motion changed"),
    "stiffness": CommandKind(
        Run.set_stiffness, TypeAdapter(StiffnessReference), "Stiffness changed"
    ),
    "law": CommandKind(Run.set_law, TypeAdapter(LawName), "Law changed"),
    "laws": CommandKind(
        Run.set_laws,
        TypeAdapter(Annotated[tuple[LawName, ...], Field(min_length=1)]),
        "Laws changed",
    ),
    "gains": CommandKind(Run.set_gains, TypeAdapter(Gains), "Gains changed"),
    "parameters": CommandKind(
        Run.set_parameters, TypeAdapter(ParametersByLaw), "Parameters changed"
    ),
    "observer": CommandKind(Run.set_observer, TypeAdapter(ObserverBandwidth), "Observer changed"),
    "actuator": CommandKind(Run.set_actuator, TypeAdapter(ActuatorParameters), "Plant changed"),
    "nominal": CommandKind(
        Run.set_nominal, TypeAdapter(ActuatorParameters), "Nominal model changed"
    ),
    "effects": CommandKind(Run.set_effects, TypeAdapter(Effects), "Effects changed"),
    "rivals": CommandKind(Run.set_rivals, TypeAdapter(tuple[Lane, ...]), "Lanes changed"),
    "lane": CommandKind(Run.set_lane, TypeAdapter(LaneSetting), "A lane changed"),
    "load": CommandKind(Run.add_load, TypeAdapter(Load), "Load applied"),
    "unload": CommandKind(Run.remove_load, TypeAdapter(Whole), "Load taken off"),
}


class Command(NamedTuple):
    """A change of a run at the beginning of a tick. argument: of the type of its kind."""

    tick: int
    kind: str
    argument: Any

    def apply(self, run: Run) -> object:
        """Do it to a run that has reached the tick; returns what the run's method returns."""
        return KINDS[self.kind].apply(run, self.argument)

    def to_json(self) -> dict[str, Any]:
        """As a dict that JSON can hold."""
        argument = KINDS[self.kind].argument.dump_python(self.argument, mode="json")
        return {"tick": self.tick, "kind": self.kind, "argument": argument}


def build_command(tick: int, kind: str, argument: Any) -> Command:
    """A checked command; raises `ParameterError` for an unknown kind or a wrong argument."""
    if kind not in KINDS:
        raise ParameterError(Violation("kind", kind, "", "one of " + ", ".join(KINDS)))
    try:
        return Command(tick, kind, KINDS[kind].argument.validate_python(argument))
    except ValidationError as error:
        violations = [
            replace(violation, name=kind) if violation.value is argument else violation
            for violation in explain(error)
        ]
        raise ParameterError(*violations) from None


def read_command(written: Any) -> Command:
    """A command from `Command.to_json`; raises `ParameterError` for anything else."""
    if not isinstance(written, dict):
        raise ParameterError(Violation("command", written, "", "an object with named fields"))
    kind, tick = written.get("kind"), written.get("tick")
    if not isinstance(kind, str):
        raise ParameterError(Violation("kind", kind, "", "one of " + ", ".join(KINDS)))
    if not isinstance(tick, int) or isinstance(tick, bool) or tick < 0:
        raise ParameterError(Violation("tick", tick, "", "a whole number from 0 on"))
    return build_command(tick, kind, written.get("argument"))


def replay(
    configuration: Configuration, commands: Iterable[Command], end_tick: int
) -> Iterator[tuple[Run, np.ndarray]]:
    """Simulate a run again from its start; see `play`."""
    return play(Run(configuration), commands, end_tick)


def play(
    run: Run, commands: Iterable[Command], end_tick: int, room: np.ndarray | None = None
) -> Iterator[tuple[Run, np.ndarray]]:
    """Go on with a run, each command given at its tick.

    Yields the run after every stretch, with the stretch's samples (lanes, ticks, channels),
    until `end_tick` or the run's fault. Same configuration and commands: same bits. room:
    (lanes, ticks, channels), where the samples are to stand one after the other.
    """
    later, first = list(commands), run.tick
    while True:
        while later and later[0].tick <= run.tick:
            later.pop(0).apply(run)
        end = min([end_tick, run.tick + STRETCH_TICKS, *(command.tick for command in later[:1])])
        if run.fault is not None or run.tick >= end:
            return
        if room is None:
            samples = np.empty((len(run.lanes), end - run.tick, len(CHANNELS)))
        else:
            samples = room[:, run.tick - first : end - first]
        yield run, samples[:, : run.advance(samples)]


def list_loads(configuration: Configuration, commands: Iterable[Command]) -> list[ScheduledLoad]:
    """Every load of a run, with the ticks at which it came and went."""
    changes = [(one.tick, one.argument) for one in commands if one.kind in ("load", "unload")]
    return follow_loads(configuration.loads, changes, configuration.sampling.period_s)


def build_run_at(configuration: Configuration, commands: Iterable[Command], tick: int) -> Run:
    """The run as it stood at the beginning of `tick`, commands of that tick not yet given.

    Raises `StateError` where the run ended before.
    """
    run = Run(configuration)
    for reached, _ in replay(configuration, [c for c in commands if c.tick < tick], tick):
        run = reached
    if run.tick < tick:
        raise StateError(f"The run ended before tick {tick}, at tick {run.tick}.")
    return run


def simulate_again(
    configuration: Configuration, commands: Iterable[Command], first_tick: int, ticks: int
) -> Iterator[np.ndarray]:
    """The samples of a recorded run once more, bit for bit: stretches (lanes, ticks, channels).

    first_tick: where the record begins. ticks: how many it holds.
    """
    for run, samples in replay(configuration, commands, first_tick + ticks):
        skipped = max(0, first_tick - (run.tick - samples.shape[1]))
        if skipped < samples.shape[1]:
            yield samples[:, skipped:]
