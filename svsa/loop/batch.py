"""Many runs at once: the loop's functions on eight lanes side by side, and of each run a summary.

What one run computes of its samples is summed up as it goes, and nothing is kept. A lane has the
bits of the same run alone, see `svsa.lanes.number`. The law is compiled in, for itself once and
for which effects are on: what is off in all lanes is no part of the machine code.
"""

import hashlib
import math
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import count
from typing import Any, NamedTuple

import numpy as np

from svsa.compilation import compiled, find_fingerprint, specialize
from svsa.control.limits import limit_torque
from svsa.errors import ParameterError, Violation
from svsa.lanes.choice import choose, greatest, some
from svsa.lanes.memory import store
from svsa.lanes.number import WIDTH
from svsa.lanes.record import Column, Shared, Word, build_reader, build_record
from svsa.loop.lane import Blocks, Inputs, LaneState, borrow_inputs
from svsa.loop.loop import act, move, read_reference
from svsa.model.domain import INSIDE, NOT_FINITE, check_domain
from svsa.model.dynamics import Actuator, compute_deflection, compute_internal_torque
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.packed import pack_all
from svsa.signals import Disturbance, Reference, State, Torque


class Start(NamedTuple):
    """A `LaneState` without the law's memory."""

    x: State
    known: State
    estimate: Disturbance
    torque: Torque
    applied: Torque
    asked: tuple[float, ...]


class Beginning(NamedTuple):
    """What a run is made of. constants: of its law."""

    blocks: Blocks
    constants: tuple[Any, ...]
    start: Start


class Batch(NamedTuple):
    """Runs of one law under the same inputs, eight to a group; the last group repeats its last.

    control: of the law. memory: its layout, see `lay_out_record`. layout: a `Beginning` of
    `svsa.lanes.record`, see `build_reader`. rows: (groups, rows, 8), what it stands for. memories:
    (groups, numbers, 8), where the law begins. lanes: how many runs there are.
    """

    control: Any
    memory: Any
    layout: Beginning
    rows: np.ndarray
    memories: np.ndarray
    inputs: Inputs
    lanes: int


class Tally(NamedTuple):
    """Of a run's measured ticks: sums of squares and sizes, peaks and what came last, SI."""

    position_squares: float
    stiffness_squares: float
    torque1_squares: float
    torque2_squares: float
    position_absolute: float
    position_peak: float
    stiffness_peak: float
    torque1_peak: float
    torque2_peak: float
    position_last: float
    stiffness_last: float


SUMMARY = np.dtype(
    [("code", np.int64), ("ticks", np.int64)]
    + [(name, np.float64) for name in (*Tally._fields, *State._fields)]
)
"""Of each run: `INSIDE` or why it ended, after how many ticks, `Tally`, and the state reached."""


def build_batch(
    control: Any,
    blocks: Sequence[Blocks],
    constants: Sequence[tuple[Any, ...]],
    lanes: Sequence[LaneState],
    memory: Any,
    inputs: Inputs,
) -> Batch:
    """Runs with these blocks, constants of the law `control` and states, one of each a run.

    Raises `ParameterError` where the period or a whole number, but for the seed, is not the same
    in all of them.
    """
    starts = [Start(*lane[:-1]) for lane in lanes]
    runs = [Beginning(*parts) for parts in zip(blocks, constants, starts, strict=True)]
    numbers = pack_all(runs).view(np.float64).reshape(len(runs), -1)
    layout = _lay_out(runs[0], "", iter(numbers.view(np.int64).T), count())
    memories = np.array([lane.memory for lane in lanes])
    return Batch(control, memory, layout, _group(numbers), _group(memories), inputs, len(runs))


def _lay_out(values: Any, name: str, columns: Iterator[np.ndarray], rows: Iterator[int]) -> Any:
    """The layout of one run's numbers. columns: of each number its bits in all lanes."""
    if isinstance(values, tuple):
        names = getattr(values, "_fields", ("",) * len(values))
        inner = [f"{name}.{one}" for one in names]
        parts = [
            _lay_out(value, one, columns, rows) for value, one in zip(values, inner, strict=True)
        ]
        return type(values)(*parts) if hasattr(values, "_fields") else tuple(parts)
    row, bits = next(rows), next(columns)
    if not bits.any() and (".bench" in name or name.endswith(".decay")):
        return type(values)(0)
    if name.endswith(".seed"):
        return Word(row)
    is_shared = isinstance(values, int) or name.endswith(".period")
    if is_shared and np.any(bits != bits[0]):
        raise ParameterError(Violation(name[1:], values, "", "the same in every run of a batch"))
    if isinstance(values, int):
        return values
    return Shared(row) if is_shared else Column(row)


def _group(values: np.ndarray) -> np.ndarray:
    """(lanes, n) → (groups, n, 8)."""
    groups = -(-len(values) // WIDTH)
    filled = np.concatenate([values, np.repeat(values[-1:], groups * WIDTH - len(values), axis=0)])
    return np.ascontiguousarray(filled.reshape(groups, WIDTH, -1).transpose(0, 2, 1))


def run_batch(batch: Batch, ticks: int, begin: int = 0) -> np.ndarray:
    """Run so many ticks from the start; an array (lanes,) of `SUMMARY`.

    begin: the tick at which measuring begins. Does not hold the GIL.
    """
    names = SUMMARY.names or ()
    results = np.zeros((len(batch.rows), len(names), WIDTH))
    advance = _specialize(batch.control, batch.memory, batch.layout)
    advance(batch.rows, batch.memories.copy(), batch.inputs, ticks, begin, results)
    columns = results.transpose(1, 0, 2).reshape(len(names), -1)
    summaries = np.empty(batch.lanes, dtype=SUMMARY)
    for name, column in zip(names, columns, strict=True):
        summaries[name] = column[: batch.lanes]
    return summaries


@cache
def _specialize(control: Any, memory: Any, layout: Beginning) -> Any:
    """`advance_groups` with this law and this layout."""
    law = control.py_func
    text = repr((law.__module__, law.__qualname__, find_fingerprint(law), memory, layout))
    name = f"advance_groups_{hashlib.sha256(text.encode()).hexdigest()[:16]}"
    reader, record = build_reader(layout), build_record(memory)
    return specialize(advance_groups, name, control=control, read=reader, remember=record)


control: Any = None
read: Any = None
remember: Any = None
"""Of `advance_groups`: the law, and what reads a group's numbers and its memory."""


def advance_groups(
    rows: np.ndarray,
    memories: np.ndarray,
    inputs: Inputs,
    ticks: int,
    begin: int,
    results: np.ndarray,
) -> None:
    """Run every group. rows, memories: see `Batch`. results: (groups, fields, 8), written."""
    inputs = borrow_inputs(inputs)
    for group in range(rows.shape[0]):
        blocks, constants, start = read(rows[group])
        memory = remember(memories[group])
        x, known, estimate = start.x, start.known, start.estimate
        lane = LaneState(x, known, estimate, start.torque, start.applied, start.asked, memory)
        nothing = choose(lane.x.q < math.inf, 0.0, 0.0)
        runs, left = nothing == 0.0, False
        code, ended, tally = nothing, nothing + ticks, start_tally(nothing)
        F = compute_internal_torque(blocks.nominal, lane.known)
        for tick in range(ticks):
            reference = read_reference(inputs, tick * blocks.period)
            asked = control(
                blocks.nominal,
                constants,
                memory,
                lane.known,
                reference,
                lane.estimate,
                lane.applied,
                blocks.period,
            )
            torque = limit_torque(asked, blocks.torque1_max, blocks.torque2_max)
            found = check_domain(blocks.domain, blocks.plant, lane.x)
            is_torque = abs(torque.u1 + torque.u2) < math.inf
            found = choose((found != INSIDE) | is_torque, found, NOT_FINITE)
            leaves = runs & (found != INSIDE)
            if some(leaves):
                left, runs = True, runs & (found == INSIDE)
                code, ended = choose(leaves, found, code), choose(leaves, tick, ended)
                if not some(runs):
                    break
            action = act(blocks, inputs, lane, torque, tick)
            tally = measure(
                tally, runs & (tick >= begin), blocks.plant, reference, lane.x, action.made
            )
            reached, F = move(blocks, inputs, lane, F, action, tick)
            lane = hold(runs, reached, lane) if left else reached
        result = results[group]
        write(result, 0, (code, ended))
        write(result, 2, tally)
        write(result, 2 + len(tally), lane.x)


@compiled
def hold(runs: bool, reached: LaneState, lane: LaneState) -> LaneState:
    """`LaneState` of lanes that run, and of those that have ended as they were."""
    return LaneState(
        choose(runs, reached.x, lane.x),
        choose(runs, reached.known, lane.known),
        choose(runs, reached.estimate, lane.estimate),
        choose(runs, reached.torque, lane.torque),
        choose(runs, reached.applied, lane.applied),
        choose(runs, reached.asked, lane.asked),
        lane.memory,
    )


@compiled
def start_tally(nothing: float) -> Tally:
    """`Tally` before the first tick. nothing: 0."""
    n = nothing
    return Tally(n, n, n, n, n, n, n, n, n, n, n)


@compiled
def measure(
    tally: Tally, counts: bool, plant: Actuator, reference: Reference, x: State, torque: Torque
) -> Tally:
    """`Tally` with the tick that begins at x. counts: whether it does, of each lane."""
    t = tally
    mu = compute_lever_ratio(x.theta2, plant.mu0, plant.gamma)
    sigma = compute_stiffness(mu, compute_deflection(x), plant.K)
    position, stiffness = reference.q - x.q, reference.sigma - sigma
    e, s = choose(counts, abs(position), 0.0), choose(counts, abs(stiffness), 0.0)
    u1, u2 = choose(counts, abs(torque.u1), 0.0), choose(counts, abs(torque.u2), 0.0)
    return Tally(
        t.position_squares + e * e,
        t.stiffness_squares + s * s,
        t.torque1_squares + u1 * u1,
        t.torque2_squares + u2 * u2,
        t.position_absolute + e,
        greatest(t.position_peak, e),
        greatest(t.stiffness_peak, s),
        greatest(t.torque1_peak, u1),
        greatest(t.torque2_peak, u2),
        choose(counts, position, t.position_last),
        choose(counts, stiffness, t.stiffness_last),
    )


@compiled
def write(rows: np.ndarray, first: int, values: tuple[float, ...]) -> None:
    """Write a tuple of lanes into rows (n, 8) from `first` on."""
    for i in range(len(values)):
        store(rows, first + i, values[i])
