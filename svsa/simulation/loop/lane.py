"""A lane of the loop: its blocks, its inputs, and its state."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.domain import Domain
from svsa.actuators.dynamics import Actuator, ExternalLoad
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.call import BoundLaw
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
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

    plant, nominal: `Actuator`. shares: of the observer, see `compute_shares`. torque1_max,
    torque2_max: N·m, infinite where not limited. decay: e^(−ωT) of the state estimator, 0 where
    velocities are known. period: s. steps: Runge–Kutta steps a period.
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


class Inputs(NamedTuple):
    """Inputs of a lane: both references and the table of loads."""

    position: Stack
    stiffness: Stack
    loads: LoadTable


class LaneState(NamedTuple):
    """What one lane, a controller and its plant, carries from tick to tick.

    x: the plant's state. known: x̂, what the controller knows of it. estimate: ŵ, N·m.
    actual: what the motors make now, N·m. applied: mean actual torque of the last period,
    N·m. limited: the limited torques of the last samples, newest first, (u1, u2) one after the
    other, for the delay. memory: what the law remembers, see `Law.start_memory`.
    """

    x: State
    known: State
    estimate: Disturbance
    actual: Torque
    applied: Torque
    limited: tuple[float, ...]
    memory: np.ndarray


class Action(NamedTuple):
    """The effects of a torque in a tick.

    limited: the delay's queue with it. delayed: what is due of it now. actual: what the motors make
    of that at once, N·m. load: `ExternalLoad`. rate: ẋ under both.
    """

    limited: tuple[float, ...]
    delayed: Torque
    actual: Torque
    load: ExternalLoad
    rate: State


def build_lane_state(memory: np.ndarray, x: State = AT_REST) -> LaneState:
    """Build the initial state of a lane. memory: of its law. x: known state of its plant."""
    # The length is part of the type: with a queue as long as the delay, each delay would compile
    # the loop again.
    limited = (0.0,) * (2 * MAX_DELAY_SAMPLES + 2)
    return LaneState(x, x, UNDISTURBED, NO_TORQUE, NO_TORQUE, limited, memory)


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
def remember(lane: LaneState, memory: np.ndarray) -> LaneState:
    """Return the lane with another memory of its law."""
    return LaneState(
        lane.x, lane.known, lane.estimate, lane.actual, lane.applied, lane.limited, memory
    )
