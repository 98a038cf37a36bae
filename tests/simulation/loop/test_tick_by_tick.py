"""One loop: in one compiled call, tick by tick, or step by step from Python, the same bits."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.domain import INSIDE, check_domain
from svsa.actuators.dynamics import build_actuator, compute_internal_torque
from svsa.actuators.signals import CHANNELS
from svsa.control.call import build_call, compute_law
from svsa.control.installed import get_law
from svsa.control.laws.feedback_linearization import build_gains, compute_feedback_linearization
from svsa.control.laws.ndobc import compute_ndobc
from svsa.control.limits import limit_torque
from svsa.control.observers.disturbance import update_disturbance_estimate
from svsa.runs.execution.blocks import bind_law, build_blocks
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import Action, Inputs, LaneState, build_lane_state
from svsa.simulation.loop.loop import advance as advance_lane
from svsa.simulation.loop.loop import (
    delay,
    measure,
    read_reference,
    sense,
)
from svsa.simulation.loop.publish import publish
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque, compute_mean_torque
from svsa.simulation.plant.integration import compute_plant_rate, integrate_period
from svsa.simulation.plant.load_table import build_load_table, compute_load, schedule_load
from svsa.simulation.reference.transition import build_stack
from tests.runs.session.sessions import EVERY_EFFECT, PULSE, advance, build_configuration

TICKS = 300
CASES = {
    f"{law}, {name}": {"law": law, "effects": effects, "seed": 5}
    for law in ("fl", "ndobc")
    for name, effects in (
        ("ideal", svsa.IDEAL),
        ("every effect", EVERY_EFFECT),
        ("rig, late and unlimited", svsa.RIG.changed(delay_samples=3, torque_limits=False)),
    )
}
LOADS = (PULSE, svsa.MassLoad(mass_kg=0.5, start_s=0.1))


@pytest.fixture(scope="module", params=CASES)
def configuration(request):
    return build_configuration(*LOADS, **CASES[request.param])


@pytest.fixture
def result(configuration):
    return advance(Run(configuration), TICKS)[0]


@pytest.fixture
def parts(configuration):
    """(blocks, law, inputs) of the only lane of the configuration, built outside a run."""
    scheduled = tuple(
        schedule_load(number, load, 0, 0.001)
        for number, load in enumerate(configuration.loads, start=1)
    )
    stacks = build_stack(configuration.position), build_stack(configuration.stiffness)
    blocks = build_blocks(configuration, configuration.lanes[0], Run(configuration).mu0)
    law = bind_law(configuration, configuration.lanes[0], blocks)
    return blocks, law, Inputs(*stacks, build_load_table(scheduled))


@pytest.fixture
def initial(configuration):
    """The initial state of the lane."""
    return build_lane_state(get_law(configuration.law).start_memory())


def compose_tick(blocks, law, inputs, lane, tick, sample):
    """A tick of the loop, composed in Python from the same compiled functions."""
    assert check_domain(blocks.domain, blocks.plant, lane.x) == INSIDE
    effects, period, time = blocks.effects, blocks.period, tick * blocks.period
    call = build_call(law, lane.memory)
    measured = measure(blocks, call, lane.x, tick)
    reference = read_reference(inputs, time)
    commanded = compute_law(
        call, lane.known, reference, lane.estimate, lane.applied, period, measured
    )
    torque = limit_torque(commanded, blocks.torque1_max, blocks.torque2_max)
    assert math.isfinite(torque.u1 + torque.u2)
    limited, delayed = delay(effects, lane.limited, torque)
    load = compute_load(inputs.loads, tick, period, time)
    actual = compute_lagged_torque(lane.actual, delayed, effects.current_lag, 0.0)
    rate = compute_plant_rate(blocks.plant, effects, lane.x, actual, load)
    action = Action(limited, delayed, actual, load, rate)
    F = compute_internal_torque(blocks.nominal, lane.known)
    publish(True, blocks, reference, lane, F, call, action, tick, sample)
    x = integrate_period(
        blocks.plant,
        effects,
        lane.x,
        lane.actual,
        delayed,
        inputs.loads,
        tick,
        period,
        blocks.steps,
    )
    actual = compute_lagged_torque(lane.actual, delayed, effects.current_lag, period)
    applied = compute_mean_torque(lane.actual, delayed, effects.current_lag, period)
    known = sense(blocks, lane, x, applied, tick + 1)
    estimate = update_disturbance_estimate(
        blocks.nominal, blocks.shares, lane.estimate, lane.known, known, applied, period
    )
    return LaneState(x, known, estimate, actual, applied, limited, lane.memory, lane.spring)


def test_one_call_equals_a_run(parts, initial, result):
    """The run adds nothing to the compiled loop: no state is stored outside `LaneState`."""
    samples = np.empty_like(result)
    _, done, code = advance_lane(*parts, initial, 0, samples)
    assert (done, code) == (TICKS, INSIDE)
    np.testing.assert_array_equal(samples, result)


@pytest.mark.exhaustive
def test_step_by_step_calls_from_python_give_the_same_bits(parts, initial, result):
    """Compiled alone or inlined into the loop, an equation rounds identically."""
    samples, lane = np.empty_like(result), initial
    for tick in range(TICKS):
        lane = compose_tick(*parts, lane, tick, samples[tick])
    np.testing.assert_array_equal(samples, result)


@pytest.mark.parametrize("sizes", [(1,), (2, 3, 5, 7), (1, 99), (150,)])
def test_any_split_into_calls_gives_the_same_bits(configuration, result, sizes):
    run, pieces, turn = Run(configuration), [], 0
    while run.tick < TICKS:
        ticks = min(sizes[turn % len(sizes)], TICKS - run.tick)
        pieces.append(advance(run, ticks)[0])
        turn += 1
    np.testing.assert_array_equal(np.vstack(pieces), result)


def build_python_law(configuration):
    """The law of the configuration as a controller in plain Python, without limits."""
    nominal = build_actuator(configuration.nominal, Run(configuration).mu0)
    gains = build_gains(configuration.gains)

    def control(time, reference, x, estimate):
        if configuration.law == "ndobc":
            return compute_ndobc(nominal, gains, x, reference, estimate)
        return compute_feedback_linearization(nominal, gains, x, reference)

    return control


def test_controller_in_python_with_the_same_law_gives_the_same_bits(configuration, result):
    """Limits, delay, drive, plant and observer are those of the compiled loop."""
    own = svsa.simulate(configuration, build_python_law(configuration), duration_s=0.3)
    assert own.law == "own"
    np.testing.assert_array_equal(own.samples, result)


def test_controller_in_python_is_called_once_per_tick():
    """One that remembers (an integrator, a log) must see each tick once, in order.

    This also holds if another lane ends the run early.
    """
    fragile = svsa.Lane(law="fl", gains=svsa.Gains.from_poles([-900.0] * 4, [-900.0] * 2))
    configuration = build_configuration(comparisons=(fragile,), effects=svsa.RIG)
    control, times = build_python_law(configuration), []

    def remember(time, reference, x, estimate):
        times.append(time)
        return control(time, reference, x, estimate)

    run = Run(configuration, controller=remember)
    samples = np.empty((2, 2000, len(CHANNELS)))
    done = run.advance(samples)
    assert run.fault is not None
    assert run.fault.lane == 1
    assert len(times) == len(set(times)), "asked twice for the same tick"
    np.testing.assert_array_equal(times[:done], samples[0, :done, 0])


@pytest.mark.parametrize(
    "answer", [None, 1.0, (1.0,), (1.0, 2.0, 3.0), ("a", "b"), (1.0, 2.0j), (None, 1.0)]
)
def test_controller_that_returns_no_two_torques_is_rejected_with_reason(answer):
    with pytest.raises(svsa.ParameterError, match=r"two torques \(u1, u2\)"):
        svsa.simulate("4b", lambda *_: answer, duration_s=0.01)


def test_controller_that_returns_nan_ends_the_run_in_a_fault():
    """NaN must cause neither a traceback nor a torque."""
    result = svsa.simulate("4b", lambda t, *_: (0.0, math.nan if t > 0.005 else 0.0))
    assert result.fault is not None
    assert result.fault.code == "not_finite"
    assert len(result.samples) == 6
