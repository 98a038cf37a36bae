"""A run: a configuration, its present state, and the changes so far."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE, build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.reach import check_reach
from svsa.actuators.signals import State
from svsa.control.installed import check_installed, get_law
from svsa.errors import Fault, ParameterError, StateError
from svsa.runs.blocks import Bind, Connection, bind_law, compute_start_ratio, connect_lane
from svsa.runs.command import ApplyLoad, Command, RemoveLoad, Set, fold
from svsa.runs.configuration import MAX_LOADS, Configuration, Lane
from svsa.runs.fault import build_fault
from svsa.runs.loads import Loads, give_load
from svsa.simulation.loop.lane import AT_REST, Inputs, LaneState, build_lane_state
from svsa.simulation.loop.loop import advance
from svsa.simulation.loop.slices import advance_in_slices
from svsa.simulation.loop.stepwise import Controller, advance_stepwise
from svsa.simulation.plant.load_table import ScheduledLoad, build_load_table
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import TORQUE, W2, D
from svsa.simulation.reference.kinds import get_range
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness
from svsa.simulation.reference.transition import Stack, build_stack, push_trajectory


class Start(NamedTuple):
    """The start of a run from a measured state of the actuator.

    mu0: lever ratio at θ2 = 0, a fact of how the actuator was assembled. x: `State` at t = 0.
    """

    mu0: float
    x: State


class Run:
    """A simulated run from t = 0, tick by tick, in one to four lanes.

    `configuration` is the present one; a change takes effect at the next tick. The run
    starts at x = 0 with the μ0 that makes σ(0) = σ_d(0); with a `start`, from there, and the
    references fade in from q and σ as they are. steps: Runge–Kutta steps a period.
    controller: one's own in plain Python, in place of the first lane's law. bind: binds the law of
    a lane. `blocks`, `laws` (one a lane) and `inputs` are what the compiled loop is given.
    """

    is_bench = False
    """Whether the first lane is a bench, and the second one its twin; see `fold`."""

    def __init__(
        self,
        configuration: Configuration,
        steps: int = 1,
        controller: Controller | None = None,
        start: Start | None = None,
        bind: Bind = bind_law,
    ) -> None:
        check_laws(configuration)
        check_lasting_loads(configuration)
        self.configuration = configuration
        self.steps = steps
        self._bind = bind
        self._controller = controller
        self.tick = 0
        self.fault: Fault | None = None
        self._load_count = 0
        self.loads: Loads = ()
        self._connections: list[Connection] = []
        if start is None:
            self.mu0 = compute_start_ratio(configuration)
            x = AT_REST
            self._position = build_stack(configuration.position)
            self._stiffness = build_stack(configuration.stiffness)
        else:
            self.mu0 = start.mu0
            x = start.x
            self._position, self._stiffness = _build_stacks(configuration, start)
        self.lanes = [
            build_lane_state(get_law(lane.law).start_memory(), x) for lane in configuration.lanes
        ]
        for load in configuration.loads:
            self._schedule(load)
        self._connect(configuration, [None] * len(configuration.lanes))
        self._renew_inputs()

    @property
    def period_s(self) -> float:
        """T, s."""
        return self.configuration.sampling.period_s

    @property
    def time_s(self) -> float:
        """Time of the next tick, s."""
        return self.tick * self.period_s

    def advance(self, samples: np.ndarray) -> int:
        """Advance as many ticks as `samples` (lanes, ticks, channels) has; return the number done.

        Fewer than asked means that the run has ended: `fault` says why. All lanes end with
        the first of them that leaves the domain of the model.
        """
        if self.fault is not None:
            return 0
        done, reached = samples.shape[1], list(self.lanes)
        ticks = [0] * len(self.lanes)
        for number in reversed(range(len(self.lanes))):
            rows = samples[number, :done]
            reached[number], ticks[number], code = self._advance_lane(number, rows)
            if code != INSIDE:
                done, x = ticks[number], reached[number].x
                name = self._name_lane(number)
                self.fault = build_fault(
                    code, number, self.tick + done, self.blocks[number], x, name
                )
        for number in range(len(self.lanes)):
            if ticks[number] > done:
                reached[number], _, _ = self._advance_lane(number, samples[number, :done])
        self.lanes = reached
        self.tick += done
        return done

    def _name_lane(self, number: int) -> str:
        """Name a lane's law, with a number if another has the same; "" for a single lane."""
        laws = [get_law(lane.law).title for lane in self.configuration.lanes]
        if len(laws) == 1:
            return ""
        law = laws[number]
        return f"{law} ({number + 1})" if laws.count(law) > 1 else law

    def _advance_lane(self, number: int, rows: np.ndarray) -> tuple[LaneState, int, int]:
        """Advance one lane from the present tick on; the first lane is last, so that it is
        called once.
        """
        blocks, inputs, law = self.blocks[number], self.inputs, self.laws[number]
        own = None if number else self._controller
        kind = law.function if own is None else "own", blocks.steps

        def run(lane: LaneState, first: int, rows: np.ndarray) -> tuple[LaneState, int, int]:
            if own is None:
                return advance(blocks, law, inputs, lane, first, rows)
            return advance_stepwise(blocks, inputs, lane, first, rows, own)

        return advance_in_slices(run, kind, self.lanes[number], self.tick, rows)

    def change(self, command: Command) -> ScheduledLoad | None:
        """Apply a command now, whatever its tick; if rejected, nothing changes.

        Args:
            command: A reference is faded over. A law that comes remembers nothing, the same law
                remembers, and the plant of its lane stays as it is; μ0, a fact of how the actuator
                was assembled, stays with another plant. A comparison that ran before goes on, a
                new one begins where the first lane is.

        Returns:
            The load that a command is about, else None.

        Raises:
            ParameterError: If the run cannot have the value.
            StateError: If too many loads or references are on, or there is no such load.
        """
        match command:
            case ApplyLoad():
                return self.add_load(command.argument)
            case RemoveLoad():
                return self.remove_load(command.argument)
            case Set():
                self._set(command)
        return None

    def _set(self, command: Set) -> None:
        before, after = self.configuration, fold(self.configuration, command, self.is_bench)
        match command.kind:
            case "position":
                self._position = push_trajectory(self._position, after.position, self.time_s)
                self._renew_inputs()
            case "stiffness":
                self._stiffness = push_trajectory(self._stiffness, after.stiffness, self.time_s)
                self._renew_inputs()
            case kind:
                check_laws(after)
                origins: Sequence[int | None] = range(len(before.lanes))
                if kind == "comparisons":
                    origins = find_origins(before.comparisons, after.comparisons)
                self._connect(after, origins)
                self.lanes = [
                    _follow_law(self.lanes[origin or 0], before.lanes[origin or 0].law, lane.law)
                    for origin, lane in zip(origins, after.lanes, strict=True)
                ]
        self.configuration = after

    def add_load(self, load: Load) -> ScheduledLoad:
        """Apply a load now or at its `start_s`; raises `StateError` if there are too many.

        A push sent while one is on changes that one, which is returned. Each command counts,
        so that a load's number is that of its command.
        """
        scheduled = self._schedule(load)
        self._renew_inputs()
        return scheduled

    def _schedule(self, load: Load) -> ScheduledLoad:
        """`add_load` without the table that the loop reads."""
        lasting = tuple(kept for kept in self.loads if kept.end_tick >= self.tick)
        given, loads = give_load(lasting, self._load_count + 1, load, self.tick, self.period_s)
        if len(loads) > MAX_LOADS:
            raise StateError(f"{MAX_LOADS} loads are applied or planned: clear one first.")
        self._load_count += 1
        self.loads = loads
        return given

    def remove_load(self, number: int) -> ScheduledLoad:
        """Remove a load; raises `StateError` if there is none of that number."""
        for load in self.loads:
            if load.number == number:
                self.loads = tuple(kept for kept in self.loads if kept is not load)
                self._renew_inputs()
                return load
        numbers = ", ".join(str(load.number) for load in self.loads) or "none"
        raise StateError(f"There is no load {number}; loads here: {numbers}.")

    def _connect(self, c: Configuration, origins: Sequence[int | None]) -> None:
        """Update the loop's constants for a configuration; if a law fails, nothing changes.

        origins: of every lane the one that it continues.
        """
        held = [None if lane is None else self._connections[lane] for lane in origins]
        self._connections = [
            connect_lane(connection, c, lane, self.mu0, self.steps, self._bind)
            for connection, lane in zip(held, c.lanes, strict=True)
        ]
        self.blocks = [one.blocks for one in self._connections]
        self.laws = [one.law for one in self._connections]

    def _renew_inputs(self) -> None:
        self.inputs = Inputs(self._position, self._stiffness, build_load_table(self.loads))


def find_origins(before: Sequence[Lane], after: Sequence[Lane]) -> list[int | None]:
    """Return for each lane the number of the lane that it continues, from 0; None for a new one.

    before, after: the comparisons of a run.
    """
    left: list[Lane | None] = [None, *before]
    origins: list[int | None] = [0]
    for comparison in after:
        origin = left.index(comparison) if comparison in left else None
        if origin is not None:
            left[origin] = None
        origins.append(origin)
    return origins


def check_laws(configuration: Configuration) -> None:
    """Raise `ParameterError` if a lane's law is not installed."""
    for number, lane in enumerate(configuration.lanes):
        try:
            check_installed(lane.law)
        except ParameterError as error:
            raise error.within(f"comparisons[{number - 1}].law" if number else "law") from None


def check_lasting_loads(configuration: Configuration) -> None:
    """Raise `ParameterError` for a stiffness that is impossible under the lasting loads."""
    c, torque = configuration, 0.0
    for load in c.loads:
        if load.acts_as == TORQUE and load.factor is None and math.isinf(load.get_duration()):
            row = np.zeros(D + 1)
            load.fill(row)
            torque += float(row[W2])
    check_reach(c.actuator, build_domain(c.actuator, c.limits), torque, *get_range(c.stiffness))


def _follow_law(lane: LaneState, before: str, law: str) -> LaneState:
    """Return the lane under another law, with that law's initial memory."""
    return lane if law == before else lane._replace(memory=get_law(law).start_memory())


def _build_stacks(configuration: Configuration, start: Start) -> tuple[Stack, Stack]:
    """Build both references, faded in from the actuator's position; σ from inside its range."""
    c, x = configuration, start.x
    plant = build_actuator(c.actuator, start.mu0)
    sigma = compute_stiffness_of(plant, compute_coordinate(plant, x.theta2), x.q - x.theta1)
    sigma = min(max(sigma, c.limits.stiffness_min_nm_per_rad), c.limits.stiffness_max_nm_per_rad)
    position = build_stack(ConstantPosition(position_rad=x.q))
    stiffness = build_stack(ConstantStiffness(stiffness_nm_per_rad=sigma))
    return (
        push_trajectory(position, c.position, 0.0),
        push_trajectory(stiffness, c.stiffness, 0.0),
    )
