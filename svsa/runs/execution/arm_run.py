"""A run of an arm from t = 0."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.signals import State
from svsa.control.arm_feedforward import Known
from svsa.control.arm_payload import NO_ADAPTATION, Payload
from svsa.errors import ParameterError, StateError, Violation
from svsa.runs.definition.arm_experiment import reject_position
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Reached, Run
from svsa.simulation.arm.contact import check_wall
from svsa.simulation.arm.lane import ArmBlocks, ArmInputs, ArmState
from svsa.simulation.arm.loop import adapt_blocks, advance_arm, plan, shift_estimate
from svsa.simulation.arm.tip_loads import build_tip_table
from svsa.simulation.loop.lane import Inputs
from svsa.simulation.loop.slices import cut
from svsa.simulation.plant.load_table import ScheduledLoad, build_load_table
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import MASS, TIP
from svsa.simulation.plant.loads.tip import Wall
from svsa.simulation.reference.transition import build_shape_stack


class Coupled(NamedTuple):
    """What an arm carries next to the lanes of its joints: `ArmState` without them."""

    known: tuple[Known, ...]
    payload: Payload


class ArmRun(Run):
    """A simulated run of an arm, tick by tick, of one or two arms: a lane for each joint.

    It begins on the references: links and principal motors at q_d(0) with q̇_d(0), springs relaxed,
    and the lever ratios that make σ(0) = σ_d(0).

    Attributes:
        arms: `ArmBlocks` of each arm.
        arm_inputs: References and loads of all arms.
    """

    def _begin(self) -> None:
        arm = self.configuration.require_arm()
        if arm.tip is not None:
            self._positions = [build_shape_stack(shape) for shape in arm.tip.build_path()]
            self._renew_inputs()
        self._coupled: list[Coupled] = []
        self._join_blocks(self.configuration)
        for number, arm_blocks in enumerate(self.arms):
            known = plan(arm_blocks, self.arm_inputs, 0)
            for lane, planned in enumerate(known, start=number * self._count):
                r = planned.reference
                x = State(r.q, r.dq, r.q, r.dq, 0.0, 0.0)
                begun = self.lanes[lane]._replace(x=x, known=x)
                self.lanes[lane] = shift_estimate(begun, planned.w)
            self._coupled.append(Coupled(known, Payload()))

    @property
    def payloads_kg(self) -> list[float]:
        """Estimated mass at the tip of each arm, kg; 0 without adaptation."""
        return [coupled.payload.mass for coupled in self._coupled]

    @property
    def states(self) -> list[ArmState]:
        """`ArmState` of each arm at the current tick."""
        return [
            ArmState(tuple(lanes), *coupled)
            for lanes, coupled in zip(self._split(self.lanes), self._coupled, strict=True)
        ]

    @property
    def _count(self) -> int:
        """Number of joints."""
        return len(self.configuration.joints)

    def _split(self, lanes: Sequence[Any]) -> list[Sequence[Any]]:
        """What belongs to the lanes of each arm."""
        return [lanes[at : at + self._count] for at in range(0, len(lanes), self._count)]

    def _advance_plant(self, number: int, rows: np.ndarray) -> Reached:
        state, laws = self.states[number], tuple(self._split(self.laws)[number])
        blocks, done, codes = self.arms[number], 0, (INSIDE,) * self._count
        kind = "arm", *(law.function for law in laws), blocks.joints[0].steps
        for begin, stop in cut(kind, rows.shape[1]):
            samples = tuple(rows[:, begin:stop])
            state, count, codes = advance_arm(
                blocks, laws, self.arm_inputs, state, self.tick + done, samples
            )
            done += count
            if any(code != INSIDE for code in codes):
                break
        return Reached(state.joints, Coupled(state.known, state.payload), done, codes)

    def _keep(self, reached: list[Reached]) -> None:
        super()._keep(reached)
        self._coupled = [plant_state.coupled for plant_state in reached]

    def _name_lane(self, number: int) -> str:
        arm, joint = divmod(number, self._count)
        return f"Joint {joint + 1}{' of the comparison' if arm else ''}"

    def _push(self, kind: str, after: Configuration, joint: int | None) -> None:
        tip = self.configuration.require_arm().tip
        if kind == "position" and tip is not None:
            raise reject_position(tip)
        super()._push(kind, after, joint)

    def _rearrange(self, after: Configuration, origins: Sequence[int | None]) -> None:
        """The model of the feedforward acts from this tick on.

        ŵ2 stays: it estimates the whole w2, which does not depend on what of it the laws know.
        """
        count = self._count
        self._coupled = [self._coupled[(origin or 0) // count] for origin in origins[::count]]
        self._join_blocks(after)
        for number, (blocks, coupled) in enumerate(zip(self.arms, self._coupled, strict=True)):
            payload = coupled.payload if blocks.adaptation.share > 0.0 else Payload()
            known = plan(adapt_blocks(blocks, payload.mass), self.arm_inputs, self.tick)
            self._coupled[number] = Coupled(known, payload)

    def _join_blocks(self, c: Configuration) -> None:
        """Build the `ArmBlocks` of each arm."""
        arm = c.require_arm()
        elbow = arm.tip.sign if arm.tip else 0.0
        adaptation = arm.adaptation.build(self.period_s) if arm.adaptation else NO_ADAPTATION
        shared = arm.links.build(), arm.model.build(), arm.feedforward, elbow, adaptation
        self.arms = [ArmBlocks(*shared, tuple(joints)) for joints in self._split(self.blocks)]

    def _schedule(self, load: Load, joint: int) -> ScheduledLoad:
        if isinstance(load, Wall):
            links = self.configuration.require_arm().links
            check_wall(load, links.build(), self.period_s / self.steps)
        return super()._schedule(load, joint)

    def _check_load(self, load: Load, joint: int) -> None:
        if load.acts_as == MASS:
            bound = "a torque, or tip_mass: a mass hangs at the tip of an arm"
            raise ParameterError(Violation("kind", load.kind, "", bound))
        for held in self.loads if load.is_push and load.acts_as != TIP else ():
            is_active = type(held.load) is type(load) and held.is_on(self.tick)
            if is_active and held.joint != joint:
                raise StateError(f"A push acts on joint {held.joint} already: wait until it ends.")

    def _renew_inputs(self) -> None:
        on_joints = [held for held in self.loads if held.load.acts_as != TIP]
        tables = [
            build_load_table(tuple(held for held in on_joints if held.joint == number))
            for number in range(1, self._count + 1)
        ]
        stacks = zip(self._positions, self._stiffnesses, tables, strict=True)
        inputs = tuple(Inputs(*parts) for parts in stacks)
        self.arm_inputs = ArmInputs(inputs, build_tip_table(self.loads, self.period_s))


def build_run(configuration: Configuration) -> Run:
    """Build the run of a configuration, of a single joint or an arm.

    Args:
        configuration: Configuration at tick 0.

    Returns:
        The run at t = 0.

    Raises:
        ParameterError: If the configuration is impossible.
        LawError: If the code of a law fails.
    """
    return Run(configuration) if configuration.arm is None else ArmRun(configuration)
