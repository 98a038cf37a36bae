"""A run: a configuration, its current state, and the changes so far."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.signals import State
from svsa.control.installed import get_law
from svsa.control.observers.spring import Spring
from svsa.errors import Fault, ParameterError, StateError, Violation
from svsa.numerics.packed import pack
from svsa.runs.definition.command import (
    NO_ARM,
    ApplyLoad,
    Command,
    RemoveLoad,
    Set,
    check_joint,
    fold,
)
from svsa.runs.definition.configuration import MAX_LOADS, Configuration
from svsa.runs.definition.run_checks import check_joint_laws, check_lasting_loads
from svsa.runs.execution.blocks import Bind, Connection, bind_law, compute_start_ratio, connect_lane
from svsa.runs.execution.fault import build_fault
from svsa.runs.timeline.lane_origins import find_lane_origins
from svsa.runs.timeline.loads import Loads, give_load
from svsa.simulation.loop.lane import AT_REST, Inputs, LaneState, build_lane_state
from svsa.simulation.loop.loop import advance
from svsa.simulation.loop.slices import advance_in_slices
from svsa.simulation.loop.stepwise import Controller, advance_stepwise
from svsa.simulation.plant.load_table import ScheduledLoad, build_load_table
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import TIP
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness
from svsa.simulation.reference.transition import Stack, build_stack, push_trajectory


class Start(NamedTuple):
    """The start of a run from a measured state of the actuator.

    Attributes:
        mu0: Lever ratio at θ2 = 0, which depends on the assembly of the actuator, 1.
        x: `State` at t = 0.
    """

    mu0: float
    x: State


class Reached(NamedTuple):
    """What an advance of one plant reached.

    Attributes:
        lanes: `LaneState` of each joint.
        coupled: What else the plant carries; None for a single joint.
        ticks: Ticks done.
        codes: Of each joint; other than `INSIDE` says why the run ends.
    """

    lanes: tuple[LaneState, ...]
    coupled: Any
    ticks: int
    codes: tuple[int, ...]


class Run:
    """A simulated run of a single joint from t = 0, tick by tick, in one to four lanes.

    `svsa.runs.execution.arm_run.build_run` builds that of any configuration.

    `configuration` is the current one; a change takes effect at the next tick. The run starts at x
    = 0 with the μ0 for which σ(0) = σ_d(0); with `start` it starts there, and the references blend
    in from the current q and σ. `blocks`, `laws` (one per lane) and `inputs` are the arguments of
    the compiled loop.

    Args:
        configuration: Configuration at tick 0.
        steps: Runge–Kutta steps per period.
        controller: A controller in plain Python instead of the first lane's law.
        bind: Binds the law of a lane.
        start: Measured initial state.
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
        check_joint_laws(configuration)
        for joint in configuration.joints:
            check_lasting_loads(joint)
        self.configuration = configuration
        self.steps = steps
        self._bind = bind
        self._controller = controller
        self.tick = 0
        self.fault: Fault | None = None
        self._load_count = 0
        self.loads: Loads = ()
        self._connections: list[Connection] = []
        joints = configuration.joints
        if start is None:
            self._ratios = [compute_start_ratio(joint) for joint in joints]
            x = AT_REST
            self._positions = [build_stack(joint.position) for joint in joints]
            self._stiffnesses = [build_stack(joint.stiffness) for joint in joints]
        else:
            self._ratios = [start.mu0]
            x = start.x
            position, stiffness = _build_stacks(configuration, start)
            self._positions, self._stiffnesses = [position], [stiffness]
        self.lanes = [
            build_lane_state(get_law(lane.law).start_memory(), x) for lane in configuration.lanes
        ]
        for number, joint in enumerate(joints, start=1):
            for load in joint.loads:
                self._schedule(load, number)
        self._connect(configuration, [None] * len(configuration.lanes))
        self._renew_inputs()
        self._begin()

    def _begin(self) -> None:
        """Check that it is of a single joint."""
        if self.configuration.arm is not None:
            bound = "None: this is computed for a single joint"
            raise ParameterError(Violation("arm", "an arm", "", bound))

    @property
    def mu0(self) -> float:
        """Lever ratio at θ2 = 0 of the first joint."""
        return self._ratios[0]

    @property
    def period_s(self) -> float:
        """Control period T, s."""
        return self.configuration.sampling.period_s

    @property
    def time_s(self) -> float:
        """Time of the next tick, s."""
        return self.tick * self.period_s

    def advance(self, samples: np.ndarray) -> int:
        """Advance as many ticks as `samples` (lanes, ticks, channels) has; return the number done.

        A smaller number means that the run has ended: `fault` contains the reason. All lanes end
        with the first of them that leaves the domain of the model.
        """
        if self.fault is not None:
            return 0
        width, done = len(self.configuration.joints), samples.shape[1]
        reached: dict[int, Reached] = {}
        for plant in reversed(range(len(self.lanes) // width)):
            first = plant * width
            rows = samples[first : first + width, :done]
            reached[plant] = plant_state = self._advance_plant(plant, rows)
            for lane, code in enumerate(plant_state.codes, start=first):
                if code != INSIDE and plant_state.ticks < done:
                    done, x = plant_state.ticks, plant_state.lanes[lane - first].x
                    name, tick = self._name_lane(lane), self.tick + plant_state.ticks
                    self.fault = build_fault(code, lane, tick, self.blocks[lane], x, name)
        for plant, plant_state in reached.items():
            if plant_state.ticks > done:
                first = plant * width
                rows = samples[first : first + width, :done]
                reached[plant] = self._advance_plant(plant, rows)
        self._keep([reached[plant] for plant in sorted(reached)])
        self.tick += done
        return done

    def _keep(self, reached: list[Reached]) -> None:
        """Take over the states that the plants have reached."""
        self.lanes = [lane for plant_state in reached for lane in plant_state.lanes]

    def _name_lane(self, number: int) -> str:
        """Name a lane's law, with a number if another has the same; "" for a single lane."""
        laws = [get_law(lane.law).title for lane in self.configuration.lanes]
        if len(laws) == 1:
            return ""
        law = laws[number]
        return f"{law} ({number + 1})" if laws.count(law) > 1 else law

    def _advance_plant(self, number: int, rows: np.ndarray) -> Reached:
        """Advance one plant from the current tick on; the first one is last, so that it is called
        once. rows: (joints, ticks, channels), written.
        """
        lane, ticks, code = self._advance_lane(number, rows[0])
        return Reached((lane,), None, ticks, (code,))

    def _advance_lane(self, number: int, rows: np.ndarray) -> tuple[LaneState, int, int]:
        blocks, inputs, law = self.blocks[number], self.inputs, self.laws[number]
        own = None if number else self._controller
        kind = law.function if own is None else "own", blocks.steps

        def run(lane: LaneState, first: int, rows: np.ndarray) -> tuple[LaneState, int, int]:
            if own is None:
                return advance(blocks, law, inputs, lane, first, rows)
            return advance_stepwise(blocks, inputs, lane, first, rows, own)

        return advance_in_slices(run, kind, self.lanes[number], self.tick, rows)

    def change(self, command: Command) -> ScheduledLoad | None:
        """Apply a command at the current tick, not at its own; if rejected, nothing changes.

        A reference is blended. A new law starts with its initial memory, the same law keeps its
        memory, and the plant of its lane keeps its state; μ0 stays with another plant. An existing
        comparison continues; a new one starts with the state of the first lane.

        Args:
            command: The command.

        Returns:
            The load of the command, otherwise None.

        Raises:
            ParameterError: If the value is invalid for the run.
            StateError: If too many loads or references are active, or there is no such load.
        """
        match command:
            case ApplyLoad():
                return self.add_load(command.argument, command.joint or 1)
            case RemoveLoad():
                return self.remove_load(command.argument)
            case Set():
                self._set(command)
        return None

    def _set(self, command: Set) -> None:
        before, after = self.configuration, fold(self.configuration, command, self.is_bench)
        match command.kind:
            case "position" | "stiffness" as kind:
                self._push(kind, after, command.joint)
            case kind:
                check_joint_laws(after)
                origins: Sequence[int | None] = range(len(before.lanes))
                if kind == "comparisons":
                    origins = find_lane_origins(before, after)
                self._connect(after, origins)
                width = len(after.joints)
                begun = [
                    at % width if origin is None else origin for at, origin in enumerate(origins)
                ]
                self.lanes = [
                    _follow_law(self.lanes[begin], before.lanes[begin].law, lane.law)
                    for begin, lane in zip(begun, after.lanes, strict=True)
                ]
                if kind in ("nominal", "spring"):
                    self.lanes = [lane._replace(spring=pack(Spring())) for lane in self.lanes]
                self._rearrange(after, origins)
        self.configuration = after

    def _push(self, kind: str, after: Configuration, joint: int | None) -> None:
        """Blend in a reference of one joint, or of each."""
        for number, setup in enumerate(after.joints):
            if joint in (None, number + 1):
                if kind == "position":
                    stack = push_trajectory(self._positions[number], setup.position, self.time_s)
                    self._positions[number] = stack
                else:
                    stack = push_trajectory(self._stiffnesses[number], setup.stiffness, self.time_s)
                    self._stiffnesses[number] = stack
        self._renew_inputs()

    def _rearrange(self, after: Configuration, origins: Sequence[int | None]) -> None:
        """Give what the plants carry next to their lanes to the plants that continue them."""

    def add_load(self, load: Load, joint: int = 1) -> ScheduledLoad:
        """Apply a load now or at its `start_s`, to a joint, by default the first.

        A push while another one is active changes that one, which is returned. Each command counts,
        so that a load's number is that of its command.

        Raises:
            ParameterError: If the load is not one for this run.
            StateError: If there are too many loads.
        """
        check_joint(self.configuration, joint)
        self._check_load(load, joint)
        scheduled = self._schedule(load, joint)
        self._renew_inputs()
        return scheduled

    def _check_load(self, load: Load, joint: int) -> None:
        if load.acts_as == TIP:
            raise StateError(NO_ARM)

    def _schedule(self, load: Load, joint: int) -> ScheduledLoad:
        """`add_load` without the table that the loop reads."""
        lasting = tuple(kept for kept in self.loads if kept.end_tick >= self.tick)
        number = self._load_count + 1
        scheduled, loads = give_load(lasting, number, load, self.tick, self.period_s, joint)
        if len(loads) > MAX_LOADS:
            raise StateError(f"{MAX_LOADS} loads are applied or planned: clear one first.")
        self._load_count = number
        self.loads = loads
        return scheduled

    def remove_load(self, number: int) -> ScheduledLoad:
        """Remove a load.

        Raises:
            StateError: If there is no load of that number.
        """
        for load in self.loads:
            if load.number == number:
                self.loads = tuple(kept for kept in self.loads if kept is not load)
                self._renew_inputs()
                return load
        numbers = ", ".join(str(load.number) for load in self.loads) or "none"
        raise StateError(f"There is no load {number}; loads here: {numbers}.")

    def _connect(self, c: Configuration, origins: Sequence[int | None]) -> None:
        """Update the loop's constants for a configuration; if a law fails, nothing changes.

        `origins` contains for every lane the one that it continues.
        """
        held = [None if lane is None else self._connections[lane] for lane in origins]
        joints = list(zip(c.joints, self._ratios, strict=True))
        self._connections = [
            connect_lane(connection, *joints[number % len(joints)], lane, self.steps, self._bind)
            for number, (connection, lane) in enumerate(zip(held, c.lanes, strict=True))
        ]
        self.blocks = [connection.blocks for connection in self._connections]
        self.laws = [connection.law for connection in self._connections]

    def _renew_inputs(self) -> None:
        table = build_load_table(self.loads)
        self.inputs = Inputs(self._positions[0], self._stiffnesses[0], table)


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
