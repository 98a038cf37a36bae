"""Vectorised runs: the loop's tick for eight runs in parallel, with a summary of each.

The metrics of a run are accumulated tick by tick, and no samples are stored. A run has the same
bits as alone, see `svsa.numerics.simd.number`. The law is compiled into the batch, once for each
law and each set of active effects: effects that are off in all runs are not part of the machine
code.
"""

import hashlib
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import count
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.dynamics import compute_internal_torque
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.control.call import BoundLaw, is_measuring
from svsa.control.law import Law
from svsa.errors import ParameterError, Violation
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled, find_fingerprint, specialize
from svsa.numerics.packed import pack_all
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.simd.memory import load, store
from svsa.numerics.simd.number import WIDTH
from svsa.numerics.simd.record import (
    Column,
    Shared,
    Word,
    build_reader,
    build_record,
    lay_out_record,
)
from svsa.simulation.loop.batch_inputs import (
    group,
    pick_inputs,
    read_first_reference,
    slice_inputs,
)
from svsa.simulation.loop.batch_law import (
    GroupLaw,
    PythonLaw,
    compute_in_python,
    compute_one_by_one,
    compute_side_by_side,
    find_addresses,
    open_group_call,
)
from svsa.simulation.loop.lane import Blocks, Inputs, LaneState, build_lane_state
from svsa.simulation.loop.loop import decide, run_tick
from svsa.simulation.loop.slices import cut
from svsa.simulation.loop.tally import (
    SUMMARY,
    Tally,
    TallyState,
    build_window,
    publish_tally,
    start_tally,
)

_TALLY = slice(2, 2 + len(Tally._fields))
"""Position of the tally in `SUMMARY`."""
_GROUPS_AT_ONCE = 128
"""Number of groups whose state is kept between two slices."""


class Start(NamedTuple):
    """A `LaneState` without the memories of the law and of the spring estimator."""

    x: State
    known: State
    estimate: Disturbance
    actual: Torque
    applied: Torque
    limited: tuple[float, ...]


class RunSetup(NamedTuple):
    """The components of a run.

    Attributes:
        blocks: `Blocks` of the run.
        constants: Constants of its law.
        start: State at t = 0.
    """

    blocks: Blocks
    constants: tuple[Any, ...]
    start: Start


class Batch(NamedTuple):
    """Runs of one law, eight per group; the last group repeats its last run.

    Attributes:
        control: Function of the law; None if it is called by its address.
        memory: Layout of the law's memory, see `lay_out_record`.
        layout: A `RunSetup` of `svsa.numerics.simd.record`, see `build_reader`.
        rows: Values of the layout, shape (groups, rows, 8).
        memories: Initial memory of the law, shape (groups, numbers, 8), or (groups, 8, numbers)
            without a control.
        inputs: See `join_inputs`.
        runs: Number of runs.
        laws: Owners of the addresses in the rows.
    """

    control: Any
    memory: Any
    layout: RunSetup
    rows: np.ndarray
    memories: np.ndarray
    inputs: Inputs
    runs: int
    laws: tuple[BoundLaw, ...] = ()


def build_batch(
    law: Law,
    blocks: Sequence[Blocks],
    constants: Sequence[tuple[Any, ...]],
    laws: Sequence[BoundLaw],
    inputs: Inputs,
) -> Batch:
    """Build runs of a law from blocks and constants, one of each per run.

    Args:
        law: The law.
        blocks: `Blocks` of each run.
        constants: Constants of the law of each run; none if it is not `is_for_vectors`.
        laws: The bound law of each run, if it is not `is_for_vectors`.
        inputs: Inputs of all runs, see `join_inputs`.

    Returns:
        The batch.

    Raises:
        ParameterError: If the period or an integer, except for the seed, differs between runs.
    """
    given = [find_addresses(one) for one in laws] or constants
    layout, rows = pack_setups(blocks, given, law.start_memory())
    memories = group(np.tile(law.start_memory(), (len(blocks), 1)))
    if laws:
        memories = np.ascontiguousarray(memories.transpose(0, 2, 1))
    control, memory = (None, None) if laws else (law.control, lay_out_record(law.memory()))
    return Batch(control, memory, layout, rows, memories, inputs, len(blocks), tuple(laws))


def pack_setups(
    blocks: Sequence[Blocks], constants: Sequence[tuple[Any, ...]], memory: np.ndarray
) -> tuple[RunSetup, np.ndarray]:
    """Return the layout of runs, and their numbers, shape (groups, rows, 8); `memory` is the
    initial memory of the law.
    """
    start = Start(*build_lane_state(memory)[:-2])
    runs = [RunSetup(*parts, start) for parts in zip(blocks, constants, strict=True)]
    numbers = pack_all(runs).view(np.float64).reshape(len(runs), -1)
    return _lay_out(runs[0], "", iter(numbers.view(np.int64).T), count()), group(numbers)


def _lay_out(values: Any, name: str, columns: Iterator[np.ndarray], rows: Iterator[int]) -> Any:
    """Return the layout of one run's numbers; `columns` contains the bits of each number in all
    runs.
    """
    if isinstance(values, tuple):
        names = getattr(values, "_fields", ("",) * len(values))
        inner = [f"{name}.{one}" for one in names]
        parts = [
            _lay_out(value, one, columns, rows) for value, one in zip(values, inner, strict=True)
        ]
        return type(values)(*parts) if hasattr(values, "_fields") else tuple(parts)
    row, bits = next(rows), next(columns)
    # A literal 0 removes the effect from the machine code: 0.49 times the speed of C, instead of
    # 0.37 with a run-time switch.
    if not bits.any() and (".effects" in name or name.endswith(".decay")):
        return type(values)(0)
    # Whole numbers of 64 bits, which a double cannot hold exactly.
    if name.endswith((".seed", "_address")):
        return Word(row)
    is_shared = isinstance(values, int) or name.endswith(".period")
    if is_shared and np.any(bits != bits[0]):
        raise ParameterError(Violation(name[1:], values, "", "the same in every run of a batch"))
    if isinstance(values, int):
        return values
    return Shared(row) if is_shared else Column(row)


def run_batch(batch: Batch, ticks: int, begin: int = 0) -> np.ndarray:
    """Run the batch from the start, without the GIL; handles signals between slices.

    Args:
        batch: The runs.
        ticks: Number of ticks.
        begin: Tick at which measuring begins.

    Returns:
        An array (runs,) of `SUMMARY`.
    """
    names = SUMMARY.names or ()
    results = np.zeros((len(batch.rows), len(names), WIDTH))
    results[:, 1] = ticks
    results[:, _TALLY] = np.array(start_tally(0.0))[:, None]
    advance = _specialize(batch.control, batch.memory, batch.layout)
    start: Any = batch.layout.start
    for first in range(0, len(batch.rows), _GROUPS_AT_ONCE):
        part = slice(first, first + _GROUPS_AT_ONCE)
        rows, memories = batch.rows[part].copy(), batch.memories[part].copy()
        given, found = slice_inputs(batch.inputs, part), results[part]
        for tick, stop in cut((advance, len(rows)), ticks):
            advance(rows, memories, given, tick, stop, begin, ticks, start.x.q.row, found)
    columns = results.transpose(1, 0, 2).reshape(len(names), -1)
    summaries = np.empty(batch.runs, dtype=SUMMARY)
    for name, column in zip(names, columns, strict=True):
        summaries[name] = column[: batch.runs]
    return summaries


@cache
def _specialize(control: Any, memory: Any, layout: RunSetup) -> Any:
    """`advance_groups` and `run_tick` with this law and this layout."""
    uncompiled = (
        compute_in_python if isinstance(layout.constants, PythonLaw) else compute_one_by_one
    )
    source = (control or uncompiled).py_func
    # The name in the cache contains the layout, since its literals are part of the code.
    parts = map(find_fingerprint, (source, advance_groups))
    text = repr((source.__module__, source.__qualname__, *parts, memory, layout))
    name = hashlib.sha256(text.encode()).hexdigest()[:16]
    # Literals of the layout: `Addresses` are the constants of a law that is called by its address.
    addresses: Any = layout.constants
    is_reported = is_measuring(control) if control else bool(addresses.is_measuring)
    compute, view = uncompiled, borrow
    if control:
        compute = specialize(
            compute_side_by_side, f"compute_{name}", law=control, is_reported=is_reported
        )
        view = build_record(memory)
    decide_group = specialize(
        decide.py_func,
        f"decide_{name}",
        compute_law=compute,
        read_reference=read_first_reference,
    )
    run_group_tick = specialize(
        run_tick.py_func,
        f"run_tick_{name}",
        open_call=open_group_call,
        decide=decide_group,
        publish=publish_tally,
    )
    return specialize(
        advance_groups,
        f"advance_groups_{name}",
        run_group_tick=run_group_tick,
        is_reported=is_reported,
        read=build_reader(layout),
        view=view,
    )


read_tally = build_reader(Tally._make(map(Column, range(_TALLY.start, _TALLY.stop))))
run_group_tick: Any = None
is_reported: Any = None
read: Any = None
view: Any = None
"""Specialises `advance_groups`: the tick with its law, whether it receives the measured positions,
and the readers of a group's numbers and memory.
"""


def advance_groups(
    rows: np.ndarray,
    memories: np.ndarray,
    inputs: Inputs,
    first: int,
    stop: int,
    begin: int,
    end: int,
    start_row: int,
    results: np.ndarray,
) -> None:
    """Advance every group from the tick `first` to before `stop`.

    `rows` and `memories` (see `Batch`) are written, so that the next call continues at `stop`.
    `begin` and `end` bound the measured ticks, `start_row` is the row of `Start`, and `results`
    (groups, fields, 8) contains the summary before `first` and is updated.
    """
    for i in range(rows.shape[0]):
        blocks, constants, start = read(rows[i])
        memory, given = view(memories[i]), pick_inputs(inputs, i)
        x, known, estimate = start.x, start.known, start.estimate
        # No samples are stored, and so no spring is estimated: the last field is not used.
        limited = start.limited
        lane = LaneState(x, known, estimate, start.actual, start.applied, limited, memory, memory)
        law = GroupLaw(blocks.nominal, constants, is_reported)
        code, ended = load(results[i], 0), load(results[i], 1)
        kept = TallyState(read_tally(results[i]), build_window(begin, end, blocks.period))
        F = compute_internal_torque(blocks.nominal, lane.known)
        # A group whose eight runs have ended is skipped: with half of the groups ended, a batch
        # took 0.51 of the processor time.
        for tick in range(first, stop if some(code == INSIDE) else first):
            lane, F, now, kept = run_group_tick(blocks, law, given, lane, F, code, tick, kept)
            if some(now != code):
                code, ended = now, choose(now != code, tick, ended)
                if not some(code == INSIDE):
                    break
        row = write(results[i], 0, (code, ended))
        row = write(results[i], row, kept.tally)
        write(results[i], row, lane.x)
        row = write(rows[i], start_row, lane.x)
        row = write(rows[i], row, lane.known)
        row = write(rows[i], row, lane.estimate)
        row = write(rows[i], row, lane.actual)
        row = write(rows[i], row, lane.applied)
        write(rows[i], row, lane.limited)


@compiled
def write(rows: np.ndarray, first: int, values: tuple[float, ...]) -> int:
    """Write a tuple of vectors into rows (n, 8) from `first` on; return the next row."""
    for i in range(len(values)):
        store(rows, first + i, values[i])
    return first + len(values)
