"""Eight runs with a controller in plain Python equal single runs, bit for bit."""

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.evaluation.metrics import summarize_result
from svsa.runs.execution.batch import run_group
from svsa.runs.execution.blocks import compute_start_ratio
from svsa.simulation.loop.tally import Tally
from tests.runs.session.sessions import EVERY_EFFECT, build_configuration

DURATION_S, BEGIN_S = 1.2, 0.1
PARTS = (Reference, State, Disturbance, Torque, Positions)


def build_law(configuration, pull_nm):
    """Feedback linearization with an integral; a torque drives it to a fault from 0.5 s on."""
    model = build_actuator(configuration.nominal, compute_start_ratio(configuration))
    total = 0.0

    def law(time_s, reference, x, w, applied, measured):
        nonlocal total
        now = compute_linearization(model, x)
        total += measured.q - reference.q
        errors = (now.q - reference.q, now.dq, now.ddq, now.dddq)
        gains = (40.0**4, 4 * 40.0**3, 6 * 40.0**2, 4 * 40.0)
        y1 = -sum(gain * error for gain, error in zip(gains, errors, strict=True)) - total
        u1, u2 = solve_decoupling(now, y1, 1600.0 * (reference.sigma - now.sigma))
        pulled = pull_nm if time_s > 0.5 else 0.0
        return u1 + pulled + 0.01 * applied.u1, u2

    return law


@pytest.fixture
def configurations():
    loads = [svsa.ConstantLoad(torque_nm=(size, 0.0, 0.0)) for size in (-1.0, 0.5, 1.5)]
    changes = {"effects": EVERY_EFFECT}
    return [build_configuration(one, seed=i, **changes) for i, one in enumerate(loads)]


@pytest.mark.exhaustive
def test_each_run_of_a_group_equals_a_single_run(configurations):
    """The middle one leaves the domain of the model, and its controller is not called
    afterwards.
    """
    pulls, asked = (0.0, 60.0, 0.0), []
    laws = [build_law(*one) for one in zip(configurations, pulls, strict=True)]

    def control(time_s, is_asked, reported):
        asked.append((time_s, *is_asked[:3]))
        torques = np.zeros((8, 2))
        for number, law in enumerate(laws):
            if is_asked[number]:
                parts = iter(reported[number].tolist())
                given = [part(*(next(parts) for _ in part._fields)) for part in PARTS]
                torques[number] = law(time_s, *given)
        return torques

    found = run_group(configurations, control, DURATION_S, BEGIN_S)
    for number, configuration in enumerate(configurations):
        alone = svsa.simulate(
            configuration, build_law(configuration, pulls[number]), duration_s=DURATION_S
        )
        expected = summarize_result(alone, BEGIN_S, DURATION_S)[0]
        # For an ended run, a batch keeps the torque that ended it.
        names = {"code", "ticks", *Tally._fields} - {"torque1_last"}
        differ = [name for name in names if found[number][name] != expected[name]]
        assert differ == [], (number, found[number], expected)
    assert found["ticks"][1] < found["ticks"][0] == round(1e3 * DURATION_S)
    assert [one[0] for one in asked] == [tick * 1e-3 for tick in range(len(asked))]
    assert asked[-1][1:] == (True, False, True)


@pytest.mark.exhaustive
def test_exception_of_a_controller_ends_the_group_and_is_raised(configurations):
    calls = []

    def control(time_s, is_asked, reported):
        calls.append(time_s)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return np.zeros((8, 2))

    with pytest.raises(KeyboardInterrupt):
        run_group(configurations, control, DURATION_S)
    assert len(calls) == 5
