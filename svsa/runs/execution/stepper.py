"""The plant tick by tick, with external motor torques, for a controller or an agent."""

import math
from pathlib import Path
from typing import Any, NamedTuple, Unpack

import numpy as np

from svsa.actuators.domain import INSIDE, check_domain
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.signals import (
    CHANNELS,
    Disturbance,
    Positions,
    Reference,
    Sample,
    State,
    Torque,
)
from svsa.control.call import BoundLaw, bind
from svsa.control.law import Nothing
from svsa.errors import Fault, FaultError, ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.definition.shorthand import Settings, change_configuration
from svsa.runs.execution.fault import build_fault
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import Blocks
from svsa.simulation.loop.loop import read_reference
from svsa.simulation.plant.sensors import read_positions

MAX_STEP_TICKS = 1_000_000


class Observation(NamedTuple):
    """The inputs of a controller at the beginning of a tick: arguments of a law in plain Python.

    Attributes:
        time_s: Time of the run, s.
        reference: q_d to its fourth derivative, σ_d to its second.
        x: x̂, the state from sensors and state estimator.
        w: ŵ of the disturbance observer, N·m.
        measured: Positions from the encoders, rad.
        applied: Mean actual torque of the last period, N·m.
    """

    time_s: float
    reference: Reference
    x: State
    w: Disturbance
    measured: Positions
    applied: Torque


@compiled
def _return_held(
    nominal: Any,
    constants: Any,
    memory: Any,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
) -> Torque:
    """Return the torque in the memory, as `svsa.control.law.Law.control`."""
    return Torque(memory.u1, memory.u2)


def _bind_held(configuration: Configuration, lane: Lane, blocks: Blocks) -> BoundLaw:
    return bind(_return_held, pack(blocks.nominal), pack(Nothing()), pack(Torque(0.0, 0.0)), False)


class Stepper:
    """A simulated run in which the caller is the controller.

        stepper = svsa.Stepper("4a", effects=svsa.RIG)
        seen = stepper.reset()
        while stepper.fault is None and seen.time_s < 10.0:
            seen = stepper.step(law(*seen[:4]))

    Limits, effects, loads, plant, sensors and observers are those of `svsa.simulate`, compiled from
    the same functions: the same torques give bit-identical samples.

    Attributes:
        configuration: Configuration of the current run.
        fault: Fault that ended the run, or None.
        sample: Channels of the previous tick, as in a `Result`; None at t = 0.
    """

    def __init__(
        self,
        experiment: str | Configuration = "4a",
        *,
        steps: int = 1,
        parameters: Design | Path | str | None = None,
        **changes: Unpack[Settings],
    ) -> None:
        """Build the plant and begin a run.

        Args:
            experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`, whose law and
                comparisons are not used.
            steps: Runge–Kutta steps per period.
            parameters: A parameter file or its `Design`, instead of the experiment's own.
            **changes: Fields of the configuration, as for `simulate`: effects, loads, position, …

        Raises:
            ParameterError: If a value is out of range.
        """
        self.configuration = build_experiment(experiment, parameters, changes, Stepper)
        self._steps = steps
        self.reset()

    @property
    def period_s(self) -> float:
        """Control period T, s."""
        return self.configuration.sampling.period_s

    @property
    def torque_limits_nm(self) -> Torque:
        """Largest torque of either motor, N·m; it acts if the effect `torque_limits` is on."""
        limits = self.configuration.limits
        return Torque(limits.torque1_nm, limits.torque2_nm)

    def reset(self, **changes: Unpack[Settings]) -> Observation:
        """Begin a run from rest at t = 0.

        Args:
            **changes: Fields of the configuration to change from now on, such as a seed of the
                sensor noise or loads.

        Returns:
            The `Observation` at t = 0.

        Raises:
            ParameterError: If a value is out of range; the current run stays.
        """
        configuration = change_configuration(self.configuration, changes).changed(comparisons=())
        self._run = Run(configuration, self._steps, bind=_bind_held)
        self.configuration = configuration
        self.fault: Fault | None = None
        self.sample: Sample | None = None
        return self._observe()

    def step(self, torque: tuple[float, float], ticks: int = 1) -> Observation:
        """Apply motor torques for one or several control periods.

        Args:
            torque: (u1, u2) at the gearbox outputs, N·m, as commanded by a law: before limits,
                delay and lag.
            ticks: Number of control periods with this torque.

        Returns:
            The `Observation` after it; `fault` is set if the run ended before.

        Raises:
            FaultError: If the run had already ended: call `reset`.
            ParameterError: If the torque is not two finite numbers; nothing is simulated.
        """
        if self.fault is not None:
            raise FaultError(self.fault)
        u1, u2 = _read_torque(torque)
        check_number("ticks", ticks, "", 1, MAX_STEP_TICKS)
        run, samples = self._run, np.empty((1, ticks, len(CHANNELS)))
        run.lanes = [run.lanes[0]._replace(memory=np.array([u1, u2]))]
        done = run.advance(samples)
        if done:
            self.sample = Sample(*samples[0, done - 1].tolist())
        self.fault = run.fault or self._find_fault()
        return self._observe()

    def compute_errors(self) -> tuple[float, float]:
        """Compute the true errors at this tick.

        Returns:
            q_d − q in rad, and σ_d − σ in N·m/rad.
        """
        x, plant = self._run.lanes[0].x, self._run.blocks[0].plant
        reference = read_reference(self._run.inputs, self._run.time_s)
        mu = compute_coordinate(plant, x.theta2)
        return reference.q - x.q, reference.sigma - compute_stiffness_of(plant, mu, x.q - x.theta1)

    def _find_fault(self) -> Fault | None:
        """Return the fault at the beginning of the next tick, or None."""
        run, blocks, x = self._run, self._run.blocks[0], self._run.lanes[0].x
        code = check_domain(blocks.domain, blocks.plant, x)
        return None if code == INSIDE else build_fault(code, 0, run.tick, blocks, x)

    def _observe(self) -> Observation:
        run, lane = self._run, self._run.lanes[0]
        reference = read_reference(run.inputs, run.time_s)
        measured = read_positions(run.blocks[0].effects, lane.x, run.tick)
        return Observation(run.time_s, reference, lane.known, lane.estimate, measured, lane.applied)


def _read_torque(torque: Any) -> tuple[float, float]:
    try:
        u1, u2 = torque
        numbers = float(u1), float(u2)
    except (TypeError, ValueError):
        numbers = math.nan, math.nan
    if not all(map(math.isfinite, numbers)):
        raise ParameterError(Violation("torque", torque, "N·m", "two finite numbers (u1, u2)"))
    return numbers
