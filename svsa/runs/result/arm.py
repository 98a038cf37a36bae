"""The result of an arm's run: a result for each joint, and the tip."""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from svsa.actuators.arm.dynamics import compute_tip_position, compute_tip_velocity, turn
from svsa.actuators.arm.tip_stiffness import compute_tip_stiffness
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.errors import Fault
from svsa.runs.definition.arm_experiment import split_joints
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.result.law_style import name_law
from svsa.runs.result.result import Result
from svsa.runs.timeline.events import find_law
from svsa.runs.timeline.loads import list_loads
from svsa.simulation.arm.tip_loads import build_tip_table, compute_wall_force
from svsa.simulation.plant.loads.tip import Wall


@dataclass(frozen=True, repr=False)
class ArmResult:
    """A finished run of an arm.

    Attributes:
        configuration: At t = 0, that of joint 1 with the arm.
        samples: (joints, ticks, channels), SI, columns as `svsa.actuators.signals.CHANNELS`.
        fault: Why the run ended early, or None; its `lane` is the number of the joint, from 0.
        steps: Runge–Kutta steps per control period.
        commands: Changes during the run.
        comparisons: Results of the second arm, if there is one.
        number: Number of the arm, from 0; 1 is the comparison.
    """

    configuration: Configuration
    samples: np.ndarray = field(repr=False)
    fault: Fault | None = None
    steps: int = 1
    commands: tuple[Command, ...] = ()
    comparisons: "tuple[ArmResult, ...]" = field(default=(), repr=False)
    number: int = 0

    @cached_property
    def joints(self) -> tuple[Result, ...]:
        """Result of each joint: channels, metrics, tables, plot."""
        each = zip(split_joints(self.configuration), self.samples, self._laws, strict=True)
        return tuple(
            Result(
                configuration, rows, self.fault, law=law, commands=self._list_commands(number),
                name=f"Joint {number}", steps=self.steps, joint=number,
            )
            for number, (configuration, rows, law) in enumerate(each, start=1)
        )  # fmt: skip

    @property
    def _laws(self) -> list[str]:
        """Law of each joint of this arm at the beginning."""
        return [joint.controllers[self.number].law for joint in self.configuration.joints]

    def _list_commands(self, joint: int) -> tuple[Command, ...]:
        """List the changes of a joint, of the comparison without those of the first arm's law."""
        return tuple(
            command
            for command in self.commands
            if command.joint in (None, joint) and (self.number == 0 or find_law(command) is None)
        )

    @property
    def time_s(self) -> np.ndarray:
        """Time of every sample, (ticks,), s."""
        return self.samples[0, :, CHANNEL_INDEX["time_s"]]

    @property
    def payload_kg(self) -> np.ndarray:
        """Estimated mass at the tip, (ticks,), kg; 0 without adaptation."""
        return self.samples[0, :, CHANNEL_INDEX["payload_estimate_kg"]]

    @property
    def tip_position_m(self) -> np.ndarray:
        """Tip, (ticks, 2), m: x horizontal, y up, from joint 1."""
        angles = np.cumsum(self._read("position_rad"), 1)
        up = -self._lengths_m * np.cos(angles)
        return np.stack([np.sum(self._lengths_m * np.sin(angles), 1), np.sum(up, 1)], 1)

    @property
    def tip_stiffness_n_per_m(self) -> np.ndarray:
        """Stiffness of the tip at rest, (ticks, 2, 2), N/m: see `compute_tip_stiffness`."""
        stiffness = self._read("stiffness_nm_per_rad")
        return compute_tip_stiffness(self._lengths_m, self._read("position_rad"), stiffness)

    @cached_property
    def wall_force_n(self) -> np.ndarray:
        """Force of the walls on the tip, (ticks, 2), N; zero without a wall.

        Computed from positions and velocities of the joints, by the function of the loop.
        """
        force = np.zeros((self.samples.shape[1], 2))
        loads = list_loads(self.configuration, self.commands)
        walls = [held for held in loads if isinstance(held.load, Wall)]
        if not walls:
            return force
        table = build_tip_table(walls, self.configuration.sampling.period_s)
        arm = self.configuration.require_arm().links.build()
        q, dq = self._read("position_rad"), self._read("velocity_rad_per_s")
        for tick, (angles, rates) in enumerate(zip(q.tolist(), dq.tolist(), strict=True)):
            at = turn(tuple(angles))
            tip = compute_tip_position(arm, at)
            moves = compute_tip_velocity(arm, at, tuple(rates))
            force[tick] = compute_wall_force(table, tick, tip, moves)
        return force

    @property
    def _lengths_m(self) -> np.ndarray:
        return np.array([link.length_m for link in self.configuration.require_arm().links.chain])

    def _read(self, channel: str) -> np.ndarray:
        """A channel of all joints, (ticks, joints)."""
        return self.samples[:, :, CHANNEL_INDEX[channel]].T

    def measure(self, start_s: float, end_s: float) -> tuple[float, ...]:
        """Compute the rms position error of all joints between two times of the run.

        Args:
            start_s: First time of the window, s.
            end_s: Last time of the window, s.

        Returns:
            Of each joint, rad. `joints[0].measure` has all metrics.

        Raises:
            ParameterError: For a window without a sample.
        """
        metrics = (joint.measure(start_s, end_s) for joint in self.joints)
        return tuple(window.rms_position_error_rad for window in metrics)

    def __repr__(self) -> str:
        c, arm = self.configuration, self.configuration.require_arm()
        laws = " and ".join(dict.fromkeys(map(name_law, self._laws)))
        options = {
            "arm feedforward": arm.feedforward,
            "adaptive payload": arm.adaptation is not None,
        }
        on = "".join(f" + {name}" for name, is_on in options.items() if is_on)
        ticks = self.samples.shape[1]
        lines = [f"Arm: {laws}{on}, {ticks * c.sampling.period_s:g} s"]
        if ticks:
            lines += [
                f"Joint {number}: position error {math.degrees(m.rms_position_error_rad):.4g}° rms,"
                f" {math.degrees(m.peak_position_error_rad):.4g}° peak"
                for number, m in enumerate((joint.metrics for joint in self.joints), 1)
            ]
        if self.fault is not None:
            lines.append(f"Ended early: {self.fault.message}")
        return "\n".join(lines)


def build_arm_results(
    configuration: Configuration,
    samples: np.ndarray,
    fault: Fault | None,
    steps: int,
    commands: tuple[Command, ...] = (),
) -> ArmResult:
    """Build the result of a run of one or two arms.

    Args:
        configuration: At t = 0.
        samples: (lanes, ticks, channels), a lane for each joint of each arm.
        fault: Why the run ended early, or None.
        steps: Runge–Kutta steps per control period.
        commands: Changes during the run.

    Returns:
        The result of the first arm; the second one is its comparison.
    """
    arms = np.split(samples, len(samples) // len(configuration.joints))
    first, *others = (
        ArmResult(configuration, own, fault, steps, commands, number=number)
        for number, own in enumerate(arms)
    )
    return replace(first, comparisons=tuple(others))
