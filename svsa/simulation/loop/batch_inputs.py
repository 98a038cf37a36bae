"""References and loads of vectorised runs, as arrays."""

from collections.abc import Sequence

import numpy as np

from svsa.actuators.signals import Reference
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.number import WIDTH
from svsa.simulation.loop.lane import Inputs
from svsa.simulation.plant.load_table import LoadTable
from svsa.simulation.plant.loads import load
from svsa.simulation.reference.shape import CURVE
from svsa.simulation.reference.transition import A, Stack, compute_row


def group(values: np.ndarray) -> np.ndarray:
    """Reshape (runs, …) to (groups, …, 8); the last group repeats its last run."""
    groups = -(-len(values) // WIDTH)
    filled = np.concatenate([values, np.repeat(values[-1:], groups * WIDTH - len(values), axis=0)])
    grouped = filled.reshape(groups, WIDTH, *values.shape[1:])
    return np.ascontiguousarray(np.moveaxis(grouped, 1, -1))


def join_inputs(runs: Sequence[Inputs]) -> Inputs:
    """Join the `Inputs` of runs from t = 0: rows (groups, n, columns, 8).

    A stack or table that several runs share is stored once.
    """
    position, *position_curves = _join([run.position for run in runs], CURVE, A)
    stiffness, *stiffness_curves = _join([run.stiffness for run in runs], CURVE, A)
    loads, points = _join([run.loads for run in runs], load.SERIES, load.A)
    changing = any(run.loads.changing for run in runs)
    return Inputs(
        Stack(position, *position_curves),
        Stack(stiffness, *stiffness_curves),
        LoadTable(loads, points, changing),
    )


def _join(parts: Sequence[Stack] | Sequence[LoadTable], kind: int, first: int) -> list[np.ndarray]:
    """Join rows of every run, and concatenate the arrays that they point into.

    A row of the kind `kind` (its first number) points into the arrays by its column `first`. Runs
    with fewer rows get rows of zeros.
    """
    length = max(len(part.rows) for part in parts)
    known: dict[int, np.ndarray] = {}
    pointed: list[list[np.ndarray]] = []
    count = 0
    for part in parts:
        if id(part) not in known:
            arrays = [one for one in part[1:] if isinstance(one, np.ndarray)]
            rows = known[id(part)] = np.zeros((length, part.rows.shape[1]))
            rows[: len(part.rows)] = part.rows
            # The index of the first point refers to the joined array.
            rows[rows[:, 0] == kind, first] += count
            pointed.append(arrays)
            count += len(arrays[0])
    table = group(np.array([known[id(part)] for part in parts]))
    return [table, *(np.concatenate(arrays) for arrays in zip(*pointed, strict=True))]


def slice_inputs(inputs: Inputs, groups: slice) -> Inputs:
    """Return the `Inputs` of some groups of runs (see `join_inputs`)."""
    p, s, loads = inputs.position, inputs.stiffness, inputs.loads
    return Inputs(
        p._replace(rows=p.rows[groups]),
        s._replace(rows=s.rows[groups]),
        loads._replace(rows=loads.rows[groups]),
    )


@compiled
def pick_inputs(inputs: Inputs, group: int) -> Inputs:
    """Return the `Inputs` of one group, borrowed from those of all (see `join_inputs`)."""
    p, s, loads = inputs.position, inputs.stiffness, inputs.loads
    return Inputs(
        Stack(borrow(p.rows[group]), borrow(p.breaks), borrow(p.coefficients)),
        Stack(borrow(s.rows[group]), borrow(s.breaks), borrow(s.coefficients)),
        LoadTable(borrow(loads.rows[group]), borrow(loads.points), loads.changing),
    )


@compiled
def read_first_reference(inputs: Inputs, time: float) -> Reference:
    """Compute `Reference` at `time` (s) of runs whose references are on since t = 0."""
    p, s = compute_row(inputs.position, 0, time), compute_row(inputs.stiffness, 0, time)
    return Reference(p.d0, p.d1, p.d2, p.d3, p.d4, s.d0, s.d1, s.d2)
