"""A lane of the loop: its blocks, its inputs, and its state."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import Domain
from svsa.actuators.dynamics import Actuator, ExternalLoad
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.call import BoundLaw
from svsa.control.observers.spring import Spring, SpringConstants
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES
from svsa.simulation.plant.load_table import LoadTable
from svsa.simulation.reference.transition import Stack

AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNDISTURBED = Disturbance(0.0, 0.0, 0.0)
NO_TORQUE = Torque(0.0, 0.0)
UNMOVED = Positions(0.0, 0.0, 0.0)
NO_REFERENCE = Reference(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Blocks(NamedTuple):
    """The blocks of the diagram as constants of the compiled loop.

    Attributes:
        plant: `Actuator` of the true plant.
        nominal: `Actuator` of the nominal model.
        shares: Gains of the observer, see `compute_shares`.
        torque1_max: Torque limit of motor 1, N·m, infinite without a limit.
        torque2_max: Torque limit of motor 2, N·m, infinite without a limit.
        effects: `EffectConstants`.
        decay: e^(−ωT) of the state estimator; 0 if velocities are known.
        domain: `Domain`.
        period: Control period T, s.
        steps: Runge–Kutta steps per period.
        spring: `SpringConstants` of the spring estimator.
    """

    plant: Actuator
    nominal: Actuator
    shares: tuple[float, float, float]
    torque1_max: float
    torque2_max: float
    effects: EffectConstants
    decay: float
    domain: Domain
    period: float
    steps: int
    spring: SpringConstants


class Inputs(NamedTuple):
    """Inputs of a lane: both references and the table of loads."""

    position: Stack
    stiffness: Stack
    loads: LoadTable


class LaneState(NamedTuple):
    """The state of one lane (controller and plant) between two ticks.

    Attributes:
        x: State of the plant.
        known: x̂, the state that the controller knows.
        estimate: ŵ, N·m.
        actual: Current torque of the motors, N·m.
        applied: Mean actual torque of the last period, N·m.
        limited: Limited torques of the last samples for the delay, newest first, as (u1, u2) pairs
            in sequence.
        memory: Memory of the law, see `Law.start_memory`.
        spring: State of the spring estimator, one packed `Spring`.
    """

    x: State
    known: State
    estimate: Disturbance
    actual: Torque
    applied: Torque
    limited: tuple[float, ...]
    memory: np.ndarray
    spring: np.ndarray


class Action(NamedTuple):
    """The effects of a torque in a tick.

    Attributes:
        limited: Queue of the delay, including the new torque.
        delayed: Output of the delay, N·m.
        actual: Torque of the motors at the beginning of the tick, N·m.
        load: `ExternalLoad`.
        rate: ẋ under both.
    """

    limited: tuple[float, ...]
    delayed: Torque
    actual: Torque
    load: ExternalLoad
    rate: State


def build_lane_state(memory: np.ndarray, x: State = AT_REST) -> LaneState:
    """Build the initial state of a lane from the memory of its law and the known state x of its
    plant.
    """
    # The length is part of the type: with a queue as long as the delay, each delay would compile
    # the loop again.
    limited = (0.0,) * (2 * MAX_DELAY_SAMPLES + 2)
    spring = pack(Spring())
    return LaneState(x, x, UNDISTURBED, NO_TORQUE, NO_TORQUE, limited, memory, spring)


@compiled
def borrow_inputs(inputs: Inputs) -> Inputs:
    """The same `Inputs` without owning their arrays, see `svsa.numerics.borrowed`."""
    p, s, loads = inputs.position, inputs.stiffness, inputs.loads
    return Inputs(
        Stack(borrow(p.rows), borrow(p.breaks), borrow(p.coefficients)),
        Stack(borrow(s.rows), borrow(s.breaks), borrow(s.coefficients)),
        LoadTable(borrow(loads.rows), borrow(loads.points), loads.changing),
    )


@compiled
def borrow_law(law: BoundLaw) -> BoundLaw:
    """The same `BoundLaw` without owning its arrays."""
    nominal, constants = borrow(law.nominal), borrow(law.constants)
    return BoundLaw(law.function, nominal, constants, law.is_own, law.is_measuring)


@compiled
def remember(lane: LaneState, memory: np.ndarray, spring: np.ndarray) -> LaneState:
    """Return the lane with other memories of its law and of the spring estimator."""
    return LaneState(
        lane.x, lane.known, lane.estimate, lane.actual, lane.applied, lane.limited, memory, spring
    )
