"""The same loop tick by tick from Python, for a controller that is not compiled.

The pieces are those of `svsa.loop.loop`, and so are the samples.
"""

import math
from collections.abc import Callable

import numpy as np

from svsa.control.limits import limit_torque
from svsa.errors import ParameterError, Violation
from svsa.loop.lane import Blocks, Inputs, LaneState
from svsa.loop.loop import apply_torque, read_reference
from svsa.model.domain import INSIDE, NOT_FINITE, check_domain
from svsa.model.dynamics import compute_internal_torque
from svsa.signals import Disturbance, Reference, State, Torque

Controller = Callable[[float, Reference, State, Disturbance], tuple[float, float]]


def advance_stepwise(
    blocks: Blocks,
    inputs: Inputs,
    lane: LaneState,
    first: int,
    samples: np.ndarray,
    controller: Controller,
) -> tuple[LaneState, int, int]:
    """As `svsa.loop.loop.advance`, with the torque from `controller`.

    controller: time (s), `Reference`, x̂ (`State`), ŵ (`Disturbance`) → (u1, u2), N·m. Raises
    `ParameterError` where it returns anything but two numbers.
    """
    F = compute_internal_torque(blocks.nominal, lane.known)
    for k, sample in enumerate(samples):
        tick = first + k
        code = check_domain(blocks.domain, blocks.plant, lane.x)
        if code != INSIDE:
            return lane, k, code
        time = tick * blocks.period
        reference = read_reference(inputs, time)
        asked = _read_torque(controller(time, reference, lane.known, lane.estimate))
        torque = limit_torque(asked, blocks.torque1_max, blocks.torque2_max)
        if not math.isfinite(torque.u1 + torque.u2):
            return lane, k, NOT_FINITE
        estimate = lane.estimate
        lane, F = apply_torque(blocks, inputs, lane, F, reference, torque, estimate, tick, sample)
    return lane, len(samples), INSIDE


def _read_torque(answer: object) -> Torque:
    try:
        u1, u2 = answer  # pyright: ignore[reportGeneralTypeIssues]
        return Torque(float(u1), float(u2))
    except (TypeError, ValueError):
        bound = "two torques (u1, u2) in N·m"
        raise ParameterError(Violation("the controller's answer", answer, "", bound)) from None
