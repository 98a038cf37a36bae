"""The control loop, in the order of the block diagram.

                       ┌─────────────────────────── ŵ ───────────────────────────┐
                       ▼                                                         │
    reference ──▶ controller ──▶ limits ──▶ plant.write ▸ plant ▸ plant.read ──▶ observer
                       ▲                                     │
                       └────────────────── x ────────────────┘      ──▶ publish

A motor torque has one name at each stage (N·m, at the gearbox output):

    name        set by                     meaning
    commanded   control law                output of the law
    limited     limits                     within ± torque_max; the law's output if no limit acts
    delayed     delay of the loop          limited torque of `delay_samples` ticks ago
    actual      lag of the current loop    torque that acts on the plant at this moment
    applied     plant                      mean of the actual torque over the period, for observers

On a bench `sent` is the limited torque after the guard of the drives (`hardware/safety`).

`advance` runs many ticks in one compiled call that does not hold the GIL. It is compiled once,
because it receives the law as a compiled function.
"""

import math

import numpy as np

from svsa.actuators.domain import INSIDE, NOT_FINITE, check_domain
from svsa.actuators.dynamics import InternalTorque, compute_internal_torque
from svsa.actuators.signals import Disturbance, Measurement, Positions, Reference, State, Torque
from svsa.control.call import BoundLaw, Call, build_call, compute_law
from svsa.control.limits import limit_motors
from svsa.control.observers.disturbance import (
    correct_disturbance_estimate,
    update_disturbance_estimate,
)
from svsa.control.observers.state import build_measured_state, update_state_estimate
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.loop.lane import (
    Action,
    Blocks,
    Inputs,
    LaneState,
    borrow_inputs,
    borrow_law,
    remember,
)
from svsa.simulation.loop.publish import publish
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque, compute_mean_torque
from svsa.simulation.plant.integration import compute_first_rate, integrate_from
from svsa.simulation.plant.load_table import compute_load
from svsa.simulation.plant.sensors import are_inexact, build_positions, read_positions, read_sensors
from svsa.simulation.reference.transition import compute_trajectory


@compiled
def read_reference(inputs: Inputs, time: float) -> Reference:
    """q_d to the 4th derivative and σ_d to the 2nd at `time` (s), as `Reference`."""
    p = compute_trajectory(inputs.position, time)
    s = compute_trajectory(inputs.stiffness, time)
    return Reference(p.d0, p.d1, p.d2, p.d3, p.d4, s.d0, s.d1, s.d2)


@compiled
def open_call(law: BoundLaw, memory: np.ndarray, runs: bool) -> Call:
    """Build the `Call` of a law for this tick; `runs` (the lane is running) is always true here."""
    return build_call(law, memory)


@compiled
def delay(
    effects: EffectConstants, limited: tuple[float, ...], torque: Torque
) -> tuple[tuple[float, ...], Torque]:
    """Append this torque to the queue of limited torques; return queue and due torque."""
    limited = (torque.u1, torque.u2) + limited[:-2]  # noqa: RUF005  numba knows no unpacking here
    # Without a delay the queue is not read. This is one of the changes that reduced a run from 3.8
    # to 1.2 times the time of C.
    if effects.delay_samples == 0:
        return limited, torque
    return limited, Torque(
        limited[2 * effects.delay_samples], limited[2 * effects.delay_samples + 1]
    )


@compiled
def decide(
    blocks: Blocks,
    call: Call,
    inputs: Inputs,
    known: State,
    estimate: Disturbance,
    applied: Torque,
    measured: Positions,
    tick: int,
) -> tuple[Reference, Torque]:
    """The first half of a tick: reference and controller.

    Args:
        blocks: `Blocks`.
        call: `Call` of the law.
        inputs: `Inputs`.
        known: x̂, `State`.
        estimate: ŵ, `Disturbance`, N·m.
        applied: Mean `Torque` of the last period, N·m.
        measured: `Positions` of this tick.
        tick: Number of the tick.

    Returns:
        `Reference`, and `Torque` after the limits, N·m.
    """
    reference = read_reference(inputs, tick * blocks.period)
    commanded = compute_law(call, known, reference, estimate, applied, blocks.period, measured)
    most = Torque(blocks.torque1_max, blocks.torque2_max)
    return reference, limit_motors(blocks.plant, commanded, most)


@compiled
def observe(
    blocks: Blocks, known: State, estimate: Disturbance, applied: Torque, measurement: Measurement
) -> tuple[State, Disturbance]:
    """The second half of a tick: x̂, estimated if velocities are not measured, and ŵ.

    Args:
        blocks: `Blocks`.
        known: x̂ of the previous period, `State`.
        estimate: ŵ of the previous period, `Disturbance`, N·m.
        applied: Mean `Torque` since, N·m.
        measurement: Current `Measurement`.

    Returns:
        `State` and `Disturbance`.
    """
    x = observe_state(blocks, known, estimate, applied, measurement)
    w = update_disturbance_estimate(
        blocks.nominal, blocks.shares, estimate, known, x, applied, blocks.period
    )
    return x, w


@compiled
def observe_state(
    blocks: Blocks, known: State, estimate: Disturbance, applied: Torque, measurement: Measurement
) -> State:
    """Compute x̂ from the current `Measurement`; arguments as in `observe`."""
    measured, estimates = build_measured_state(measurement), blocks.decay > 0.0
    # `some` skips the estimator if no run needs it; in a vector `choose` decides for each run.
    if not some(estimates):
        return measured
    x = update_state_estimate(
        blocks.nominal, blocks.decay, known, estimate, applied, measurement, blocks.period
    )
    return choose(estimates, x, measured)


@compiled
def sense(blocks: Blocks, lane: LaneState, x: State, applied: Torque, tick: int) -> State:
    """Compute x̂ at `tick` from the plant's state x: x itself with perfect sensors."""
    # Perfect sensors return x itself: θ1 + (q − θ1) would differ from q in the last bit.
    differs = (blocks.decay > 0.0) | are_inexact(blocks.effects)
    if not some(differs):
        return x
    measurement = read_sensors(blocks.effects, x, tick)
    known = observe_state(blocks, lane.known, lane.estimate, applied, measurement)
    return choose(differs, known, x)


@compiled
def measure(blocks: Blocks, call: Call, x: State, tick: int) -> Positions:
    """Compute measured `Positions` for a law that takes them; otherwise those of x."""
    if call.is_measuring:
        return read_positions(blocks.effects, x, tick)
    return build_positions(x)


@compiled
def run_tick(
    blocks: Blocks,
    law: BoundLaw,
    inputs: Inputs,
    lane: LaneState,
    F: InternalTorque,
    code: int,
    tick: int,
    kept: np.ndarray,
) -> tuple[LaneState, InternalTorque, int, np.ndarray]:
    """One tick: reference, controller, write, plant, read, observer, publish.

    This is the only definition of the order: a batch compiles this function for eight lanes, with
    its own `open_call`, `decide` and `publish` (`svsa.simulation.loop.batch`).

    Args:
        blocks: `Blocks`.
        law: `BoundLaw`.
        inputs: `Inputs`.
        lane: `LaneState` at the start of the tick; the law writes to its memory.
        F: F_n(x̂) at the start of the tick, `InternalTorque`, N·m.
        code: `INSIDE`, or the reason for the end of the lane.
        tick: Number of the tick.
        kept: Sample, shape (channels,), written.

    Returns:
        (lane, F, code, kept) at the end of the tick. A lane that has ended does not change.
    """
    code = choose(code != INSIDE, code, check_domain(blocks.domain, blocks.plant, lane.x))
    runs = code == INSIDE
    if not some(runs):
        return lane, F, code, kept
    call = open_call(law, lane.memory, runs)
    measured = measure(blocks, call, lane.x, tick)
    reference, torque = decide(
        blocks, call, inputs, lane.known, lane.estimate, lane.applied, measured, tick
    )
    # The sum is finite only if both torques are: one test instead of two. `math.isfinite` has no
    # vector form.
    is_torque = abs(torque.u1 + torque.u2) < math.inf
    code = choose(is_torque | (code != INSIDE), code, NOT_FINITE)
    runs = code == INSIDE
    if not some(runs):
        return lane, F, code, kept
    action = act(blocks, inputs, lane, torque, tick)
    # Before the plant moves: the sample of a tick has state, torque and rate at its beginning.
    kept = publish(runs, blocks, reference, lane, F, call, action, tick, kept)
    reached, F = move(blocks, inputs, lane, F, action, tick)
    # `hold` copies the whole state, which is not needed until a lane of a batch has ended.
    lane = hold(runs, reached, lane) if some(code != INSIDE) else reached
    return lane, F, code, kept


@compiled
def hold(runs: bool, reached: LaneState, lane: LaneState) -> LaneState:
    """Select the new `LaneState` of active runs and the old one of ended runs."""
    return LaneState(
        choose(runs, reached.x, lane.x),
        choose(runs, reached.known, lane.known),
        choose(runs, reached.estimate, lane.estimate),
        choose(runs, reached.actual, lane.actual),
        choose(runs, reached.applied, lane.applied),
        choose(runs, reached.limited, lane.limited),
        lane.memory,
        lane.spring,
    )


@compiled
def act(blocks: Blocks, inputs: Inputs, lane: LaneState, torque: Torque, tick: int) -> Action:
    """Compute the `Action` of a limited torque, N·m: delay, drive and loads."""
    effects, time = blocks.effects, tick * blocks.period
    limited, delayed = delay(effects, lane.limited, torque)
    load = compute_load(inputs.loads, tick, blocks.period, time)
    actual = compute_lagged_torque(lane.actual, delayed, effects.current_lag, 0.0)
    # Computed once for two uses: the sample, and the first Runge–Kutta stage in `move`.
    rate = compute_first_rate(blocks.plant, effects, lane.x, actual, load)
    return Action(limited, delayed, actual, load, rate)


@compiled
def move(
    blocks: Blocks, inputs: Inputs, lane: LaneState, F: InternalTorque, action: Action, tick: int
) -> tuple[LaneState, InternalTorque]:
    """Complete the tick: plant, read, observer. Returns `LaneState` and F_n(x̂) at its end."""
    plant, effects, period, steps = blocks.plant, blocks.effects, blocks.period, blocks.steps
    start, delayed, load = lane.actual, action.delayed, action.load
    x = integrate_from(
        plant, effects, lane.x, action.rate, start, delayed, inputs.loads, load, tick, period, steps
    )
    return follow(blocks, lane, F, action, x, tick)


@compiled
def follow(
    blocks: Blocks, lane: LaneState, F: InternalTorque, action: Action, x: State, tick: int
) -> tuple[LaneState, InternalTorque]:
    """The part of `move` after the plant has reached x, `State`: read, observer."""
    nominal, effects, period = blocks.nominal, blocks.effects, blocks.period
    start, delayed = lane.actual, action.delayed
    actual = compute_lagged_torque(start, delayed, effects.current_lag, period)
    applied = compute_mean_torque(start, delayed, effects.current_lag, period)
    known = sense(blocks, lane, x, applied, tick + 1)
    # Returned for the next tick, which needs it at its beginning. Computing it once made a run
    # faster.
    F_known = compute_internal_torque(nominal, known)
    observed = correct_disturbance_estimate(
        nominal, blocks.shares, lane.estimate, lane.known, F, known, F_known, applied, period
    )
    reached = LaneState(
        x, known, observed, actual, applied, action.limited, lane.memory, lane.spring
    )
    return reached, F_known


@compiled
def advance(
    blocks: Blocks, law: BoundLaw, inputs: Inputs, lane: LaneState, first: int, samples: np.ndarray
) -> tuple[LaneState, int, int]:
    """Run many ticks without the GIL: one per row of `samples`.

    Args:
        blocks: `Blocks`.
        law: `BoundLaw`.
        inputs: `Inputs`.
        lane: `LaneState` at the tick `first`, not modified.
        first: First tick.
        samples: Shape (ticks, channels), written.

    Returns:
        (lane, ticks done, code); a code other than `INSIDE` is the reason why the lane ended at the
        tick first + ticks done.
    """
    # The caller's lane must not change: replays and branches start from it again. Borrowed arrays
    # are not reference-counted; counting would take most of the time of a tick.
    memory, spring, rows = lane.memory.copy(), lane.spring.copy(), borrow(samples)
    lane = remember(lane, borrow(memory), borrow(spring))
    law, inputs = borrow_law(law), borrow_inputs(inputs)
    F = compute_internal_torque(blocks.nominal, lane.known)
    # Not the constant itself: numba would compile `run_tick` for it, and again for the integer.
    done, code = 0, int(INSIDE)
    while done < rows.shape[0] and code == INSIDE:
        lane, F, code, _ = run_tick(blocks, law, inputs, lane, F, code, first + done, rows[done])
        done += code == INSIDE
    return remember(lane, memory, spring), done, code
