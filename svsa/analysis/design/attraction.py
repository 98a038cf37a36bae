"""Region of attraction, sampled: initial states from which the simulated loop comes to rest.

A map contains samples of a slice of the state space. It does not prove stability between the
samples or outside the slice.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS, State
from svsa.control.installed import get_law
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import LaneState, build_lane_state
from svsa.simulation.loop.loop import advance
from svsa.simulation.loop.slices import advance_in_slices
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

MAX_POSITION_RAD = math.pi / 2.0
MAX_VELOCITY_RAD_PER_S = 20.0
MAX_DEFLECTION_RAD = 0.3
MAX_DEFLECTION_RATE_RAD_PER_S = 5.0
DURATION_S = 2.0
LAST_S = 0.2
CLOSE_RAD = math.radians(1.0)

Outcome = Literal["rest", "fault", "unsettled"]


class Cell(NamedTuple):
    """A cell of the map: row of the velocity and column of the position."""

    row: int
    column: int


class StartOutcome(NamedTuple):
    """The outcome of an initial state.

    Attributes:
        outcome: Settled, not settled, or fault.
        after_s: Settling time, or time of the fault, s.
    """

    outcome: Outcome
    after_s: float


Slice = Literal["rigid", "deflected"]


class Map(NamedTuple):
    """The initial states of a map.

    Attributes:
        positions: q0, rad, one per column.
        velocities: q̇0, rad/s, one per row.
        deflections: φ0 of each initial state, rad, shape (rows, columns).
        rates: φ̇0 of each initial state, rad/s, shape (rows, columns).
    """

    positions: np.ndarray
    velocities: np.ndarray
    deflections: np.ndarray
    rates: np.ndarray


def build_map(count: int, chosen: Slice = "rigid") -> Map:
    """Build initial states in `count` rows and columns: q0 within ±90°, q̇0 within ±20 rad/s.

    Args:
        count: Number of rows and of columns.
        chosen: "rigid" has φ0 = φ̇0 = 0, link and motor 1 as one body; "deflected" has for each
            initial state a random deflection within ±0.3 rad and a rate within ±5 rad/s, uniformly
            distributed, the same in every map of this size.

    Returns:
        The initial states.
    """
    share = 1.0 if chosen == "deflected" else 0.0
    random = np.random.default_rng(0).uniform(-share, share, (2, count, count))
    return Map(
        np.linspace(-MAX_POSITION_RAD, MAX_POSITION_RAD, count),
        np.linspace(-MAX_VELOCITY_RAD_PER_S, MAX_VELOCITY_RAD_PER_S, count),
        MAX_DEFLECTION_RAD * random[0],
        MAX_DEFLECTION_RATE_RAD_PER_S * random[1],
    )


def order_cells(count: int) -> list[Cell]:
    """Return every cell once, ordered from a coarse to a fine grid."""
    ordered: dict[Cell, None] = {}
    stride = 1 << max(0, (count - 1).bit_length() - 2)
    while stride >= 1:
        for row in range(0, count, stride):
            for column in range(0, count, stride):
                ordered.setdefault(Cell(row, column))
        stride //= 2
    return list(ordered)


def find_start_outcomes(
    configuration: Configuration, sigma: float, starts: Map, cells: Sequence[Cell]
) -> Iterator[tuple[Cell, StartOutcome]]:
    """Simulate each initial state with the compiled loop, and yield its outcome.

    The link starts at q0 with q̇0, motor 1 at q0 − φ0 with q̇0 − φ̇0, the lever where the nominal σ
    at φ = 0 is σ_d = `sigma`, N·m/rad; the reference is q_d = 0. The loop has come to rest if |e| <
    1° in the last 0.2 of 2 s. A run that leaves the domain of the model is a fault. The first lane,
    limits and effects are those of the configuration.
    """
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            comparisons=(),
            loads=(),
        )
    )
    blocks, law, period = run.blocks[0], run.laws[0], run.period_s
    samples = np.empty((round(DURATION_S / period), len(CHANNELS)))
    column = CHANNEL_INDEX["position_error_rad"]

    def follow(lane: LaneState, first: int, rows: np.ndarray) -> tuple[LaneState, int, int]:
        return advance(blocks, law, run.inputs, lane, first, rows)

    last = round(LAST_S / period)
    for cell in cells:
        q, dq = float(starts.positions[cell.column]), float(starts.velocities[cell.row])
        memory = get_law(configuration.law).start_memory()
        theta1, dtheta1 = q - float(starts.deflections[cell]), dq - float(starts.rates[cell])
        lane = build_lane_state(memory, State(q, dq, theta1, dtheta1, 0.0, 0.0))
        kind = law.function, blocks.steps
        _, done, _ = advance_in_slices(follow, kind, lane, 0, samples)
        if done < len(samples):
            yield cell, StartOutcome("fault", done * period)
            continue
        far = np.flatnonzero(np.abs(samples[:, column]) >= CLOSE_RAD)
        settled = int(far[-1]) + 1 if len(far) else 0
        is_rest = settled <= done - last
        yield cell, StartOutcome("rest" if is_rest else "unsettled", settled * period)


def compute_share(outcomes: Sequence[StartOutcome]) -> float:
    """Compute the share of initial states that come to rest."""
    return sum(start.outcome == "rest" for start in outcomes) / len(outcomes)
