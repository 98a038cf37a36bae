"""Step response of an output: rise time, overshoot, settling time."""

import math
from typing import NamedTuple

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.simulation.loop.tally import STEADY_STATE_S, follow_recovery

LONGEST_STEP_S = 2.0
SMALLEST_POSITION_STEP_RAD = math.radians(1.0)
SMALLEST_STIFFNESS_STEP_NM_PER_RAD = 1.0
RISE_FROM, RISE_TO = 0.1, 0.9
REST_SHARE = 1e-4
"""If the first change is a larger share of the step, the reference was already moving."""

_UNSETTLED, _CONSTANT, _MOVING, _FOLLOWED, _OVER = 0.0, 1.0, 2.0, 3.0, 4.0


class _State(NamedTuple):
    """State of the search for a step, and of the response.

    Attributes:
        phase: Whether the reference is not yet constant for 0.5 s, is constant, moves, has made a
            step, or the response is over.
        reference: Last known reference.
        output: Last known output.
        held: Number of ticks for which the reference has been constant.
        moved: Number of ticks since its first change.
        start: Level before the step.
        target: Level after the step.
        first: First change of the reference.
        low: Smallest reference since then.
        high: Greatest reference since then.
        followed: Number of ticks of the response.
        rise_from: Tick of 10 %, −1 before.
        rise_to: Tick of 90 %, −1 before.
        highest: Largest excess over the target, as a share of the step.
        inside: As in the 2 % rule.
        recovered: As in the 2 % rule.
    """

    phase: float
    reference: float
    output: float
    held: float
    moved: float
    start: float
    target: float
    first: float
    low: float
    high: float
    followed: float
    rise_from: float
    rise_to: float
    highest: float
    inside: float
    recovered: float


_BEGUN = _State(
    _CONSTANT, math.nan, math.nan, held=0.0, moved=0.0, start=0.0, target=0.0, first=0.0,
    low=0.0, high=0.0, followed=0.0, rise_from=-1.0, rise_to=-1.0, highest=0.0,
    inside=0.0, recovered=-1.0,
)  # fmt: skip


class _Bounds(NamedTuple):
    """Limits of the search.

    Attributes:
        settled: Number of ticks in 0.5 s.
        longest: Duration of the longest step, ticks.
        smallest: Smallest step, in the unit of the output.
    """

    settled: float
    longest: float
    smallest: float


@compiled
def _follow_output(state: _State, output: float, settled: float) -> _State:
    """Update the response with the next tick."""
    s = state
    share = (output - s.start) / (s.target - s.start)
    rise_from, rise_to = s.rise_from, s.rise_to
    if rise_from < 0.0 and share >= RISE_FROM:
        rise_from = s.followed
    if rise_to < 0.0 and share >= RISE_TO:
        rise_to = s.followed
    passed = s.followed + 1.0
    inside, recovered = follow_recovery(
        True, abs(share - 1.0), 1.0, passed, settled, s.inside, s.recovered
    )
    return _State(
        _OVER if recovered >= 0.0 else _FOLLOWED,
        s.reference, s.output, s.held, s.moved, s.start, s.target, s.first, s.low, s.high,
        passed, rise_from, rise_to, max(s.highest, share - 1.0), inside, recovered,
    )  # fmt: skip


@compiled
def _follow_reference(state: _State, reference: float, output: float, bounds: _Bounds) -> _State:
    """Update the search for a step with the next tick."""
    s, phase, held, moved = state, state.phase, state.held + 1.0, state.moved + 1.0
    start, first, low, high = s.start, s.first, s.low, s.high
    if reference != s.reference:
        held = 1.0
        if phase == _CONSTANT and not math.isnan(s.reference):
            phase, moved, start, first = _MOVING, 1.0, s.reference, abs(reference - s.reference)
            low, high = min(s.reference, reference), max(s.reference, reference)
    if phase == _MOVING:
        low, high = min(low, reference), max(high, reference)
        if held >= bounds.settled:
            size, ticks = abs(reference - start), moved - held + 1.0
            # A large first change is a jump; a smooth rise begins with a small one.
            began_at_rest = ticks == 1.0 or first <= REST_SHARE * size
            stayed = high - low <= size * (1.0 + REST_SHARE)
            is_step = size >= bounds.smallest and ticks <= bounds.longest
            phase = _FOLLOWED if is_step and began_at_rest and stayed else _CONSTANT
        elif moved >= bounds.longest + bounds.settled:
            phase = _UNSETTLED
    elif phase == _UNSETTLED and held >= bounds.settled:
        phase = _CONSTANT
    return _State(
        phase, reference, output, held, moved, start, reference, first, low, high,
        s.followed, s.rise_from, s.rise_to, s.highest, s.inside, s.recovered,
    )  # fmt: skip


@compiled
def _follow(
    state: _State, outputs: np.ndarray, references: np.ndarray, errors: np.ndarray, bounds: _Bounds
) -> _State:
    """Update the state with samples; `outputs`, those since the reference moves, is written."""
    for i in range(references.shape[0]):
        if state.phase == _OVER:
            break
        reference, output = references[i], references[i] - errors[i]
        if math.isnan(output):
            reference, output = state.reference, state.output
        if math.isnan(reference):
            continue
        if state.phase == _FOLLOWED:
            if reference != state.target:
                # Another step: later samples do not belong to this response.
                state = _stop(state)
                break
            state = _follow_output(state, output, bounds.settled)
            continue
        state = _follow_reference(state, reference, output, bounds)
        if state.phase == _MOVING or state.phase == _FOLLOWED:
            outputs[int(state.moved) - 1] = output
        if state.phase == _FOLLOWED:
            for k in range(int(state.moved)):
                if state.phase == _FOLLOWED:
                    state = _follow_output(state, outputs[k], bounds.settled)
    return state


@compiled
def _stop(state: _State) -> _State:
    s = state
    return _State(
        _OVER, s.reference, s.output, s.held, s.moved, s.start, s.target, s.first, s.low, s.high,
        s.followed, s.rise_from, s.rise_to, s.highest, s.inside, s.recovered,
    )  # fmt: skip


class StepResponse:
    """The response to the first step of the reference in a segment of samples.

    A step is a change of a constant reference to another level within 2 s, without leaving the
    range between both, after which the reference is constant for 0.5 s. Its size is that of the
    reference. Time begins with the first change, so that the blend of the reference is part of the
    response. At the start of a run the level before is the output. A sine and a ramp have no step.

    Samples after the response has settled do not change the numbers. Another step before that ends
    the response, which then has no settling time.
    """

    def __init__(self, period_s: float, smallest: float) -> None:
        self._period = period_s
        settled = math.ceil(STEADY_STATE_S / period_s - 1e-9)
        longest = round(LONGEST_STEP_S / period_s)
        self._bounds = _Bounds(float(settled), float(longest), smallest)
        self._outputs = np.empty(settled + longest + 1)
        self._state = _BEGUN

    @property
    def rise_time_s(self) -> float | None:
        """From 10 % to 90 % of the step, s; None before, and without a step."""
        state = self._state
        return None if state.rise_to < 0.0 else (state.rise_to - state.rise_from) * self._period

    @property
    def overshoot_share(self) -> float | None:
        """Largest excess over the new level until settled, relative to the step; None before 90
        %.
        """
        return None if self._state.rise_to < 0.0 else self._state.highest

    @property
    def settling_time_s(self) -> float | None:
        """Time until the output stays within 2 % of the step around the new level for 0.5 s, s."""
        recovered = self._state.recovered
        return None if recovered < 0.0 else recovered * self._period

    def update(self, references: np.ndarray, errors: np.ndarray, is_start: bool) -> None:
        """Update with more samples; a missed one (NaN) counts as the previous one.

        Args:
            references: Shape (ticks,).
            errors: Reference − output, shape (ticks,).
            is_start: Whether the first sample is that of a run at t = 0.
        """
        if self._state.phase == _OVER:
            return
        if is_start and abs(errors[0]) >= self._bounds.smallest:
            # Initial value: the output equals the reference before t = 0.
            output = float(references[0] - errors[0])
            self._state = self._state._replace(reference=output, output=output)
        self._state = _follow(self._state, self._outputs, references, errors, self._bounds)
