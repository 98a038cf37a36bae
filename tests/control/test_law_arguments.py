"""A law receives the measured encoder values: compiled, in a batch, in plain Python, in a separate
process and on a bench.
"""

from importlib.metadata import EntryPoint
from typing import NamedTuple

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.signals import CHANNELS, Disturbance, Measurement, Positions, Torque
from svsa.control import installed
from svsa.control.call import build_call
from svsa.control.law import Law
from svsa.control.observers.state import predict_state
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack
from svsa.numerics.simd.choice import choose
from svsa.runs.execution.batch import build_run_batch, run_configurations
from svsa.runs.execution.blocks import compute_start_ratio
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import AT_REST
from svsa.simulation.loop.measured import (
    Actuation,
    BenchConstants,
    BenchLoopState,
    follow_and_decide,
    pass_ticks,
    publish_and_predict,
)
from svsa.simulation.plant.sensors import read_sensors
from svsa.teaching.isolation.confinement import leave_open
from svsa.teaching.isolation.process import LawProcess
from tests.runs.session.sessions import EVERY_EFFECT, PULSE, advance, build_configuration

TICKS = 60
LINK_LOAD = Disturbance(0.3, 0.0, 0.0)
KP, KD = 30.0, 2.0
"""N·m/rad and N·m·s/rad of a spring and a damper on motor 1."""


class Received(NamedTuple):
    """The values that the law received last, and θ1 of the previous call."""

    q: float = 0.0
    theta1: float = 0.0
    theta2: float = 0.0
    before: float = 0.0


@compiled
def store_measurement(
    nominal, constants, memory, x, reference, estimate, applied, period, measured
):
    memory.before = memory.theta1
    memory.q, memory.theta1, memory.theta2 = measured.q, measured.theta1, measured.theta2
    velocity = (memory.theta1 - memory.before) / period
    u1 = KP * (reference.q - measured.theta1) - KD * velocity - 0.1 * applied.u1
    return Torque(choose(abs(u1) < 8.0, u1, 0.0), 0.0)


@compiled
def store_measurement_by_branches(
    nominal, constants, memory, x, reference, estimate, applied, period, measured
):
    torque = store_measurement(
        nominal, constants, memory, x, reference, estimate, applied, period, measured
    )
    if measured.q > 1e3:
        return Torque(0.0, 0.0)
    return torque


def build_in_python():
    """The same law as a function in plain Python."""
    before = 0.0

    def law(time_s, reference, x, w, *, measured, applied):
        nonlocal before
        velocity, before = (measured.theta1 - before) / 0.001, measured.theta1
        u1 = 30.0 * (reference.q - measured.theta1) - 2.0 * velocity - 0.1 * applied.u1
        return (u1 if abs(u1) < 8.0 else 0.0), 0.0

    return law


AS_A_FILE = b"""
before = 0.0

def law(time_s, reference, x, w, measured, applied):
    global before
    velocity, before = (measured.theta1 - before) / 0.001, measured.theta1
    u1 = 30.0 * (reference.q - measured.theta1) - 2.0 * velocity - 0.1 * applied.u1
    return (u1 if abs(u1) < 8.0 else 0.0), 0.0
"""
STORED = Law("stored", "Stored measurement", "", "", "", store_measurement, memory=Received)
STORED_BY_BRANCHES = Law(
    "stored_by_branches",
    "Stored measurement",
    "",
    "",
    "",
    store_measurement_by_branches,
    memory=Received,
)
EFFECTS = {"ideal": svsa.IDEAL, "rig": svsa.RIG, "every": EVERY_EFFECT}


@pytest.fixture(autouse=True)
def _install(monkeypatch):
    for law in ("STORED", "STORED_BY_BRANCHES"):
        entry = EntryPoint(law.lower(), f"{__name__}:{law}", installed.GROUP)
        monkeypatch.setitem(installed._find_entries(), law.lower(), entry)
    installed._load_law.cache_clear()
    yield
    installed._load_law.cache_clear()


def build(law="stored", effects=svsa.RIG, **changes):
    return build_configuration(PULSE, law=law, effects=effects, seed=3, **changes)


@pytest.mark.parametrize("effects", EFFECTS)
def test_law_receives_the_measurement_of_the_tick_with_quantization_and_noise(effects):
    run = Run(build(effects=EFFECTS[effects]))
    reported, said, estimated = [], [], []
    for tick in range(TICKS):
        lane = run.lanes[0]
        y = read_sensors(run.blocks[0].effects, lane.x, tick)
        said.append((y.theta1 + y.phi, y.theta1, y.theta2))
        estimated.append((lane.known.q, lane.known.theta1, lane.known.theta2))
        run.advance(np.empty((1, 1, len(CHANNELS))))
        reported.append(run.lanes[0].memory[:3])
    tolerance = 1e-15 if effects == "ideal" else 0.0
    np.testing.assert_allclose(reported, said, rtol=0.0, atol=tolerance)
    is_another = np.any(np.array(estimated)[1:] != np.array(reported)[1:])
    assert is_another == (effects != "ideal"), "x̂ itself between exact sensors"


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    ("law", "effects"),
    [
        ("stored", "ideal"),
        ("stored", "rig"),
        ("stored_by_branches", "rig"),
        ("stored", "every"),
        ("stored_by_branches", "every"),
    ],
)
def test_law_in_a_batch_receives_the_same_as_alone(law, effects):
    configurations = [build(law, EFFECTS[effects]).changed(seed=seed) for seed in (3, 4, 5)]
    assert (build_run_batch(configurations).control is None) == (law == "stored_by_branches")
    summaries = run_configurations(configurations, 0.2)
    for configuration, summary in zip(configurations, summaries, strict=True):
        run = Run(configuration)
        advance(run, 200)
        assert tuple(run.lanes[0].x) == tuple(summary[name] for name in run.lanes[0].x._fields)


@pytest.mark.parametrize("effects", EFFECTS)
def test_law_in_plain_python_receives_the_same_by_parameter_name(effects):
    configuration = build(effects=EFFECTS[effects])
    compiled_samples = advance(Run(configuration), 200)[0]
    own = svsa.simulate(configuration, build_in_python(), duration_s=0.2)
    np.testing.assert_allclose(own.samples, compiled_samples, rtol=1e-6, atol=1e-9)
    assert np.abs(own.torque1_nm).max() > 0.5


def test_law_in_a_separate_process_receives_the_same():
    configuration = build()
    model = build_actuator(configuration.nominal, compute_start_ratio(configuration))
    with LawProcess(AS_A_FILE, model, place=leave_open) as law:
        there = svsa.simulate(configuration, law, duration_s=0.1)
    here = svsa.simulate(configuration, build_in_python(), duration_s=0.1)
    np.testing.assert_array_equal(there.samples, here.samples)


@pytest.mark.long
def test_law_on_a_bench_receives_the_measurement_also_after_missed_ticks():
    run = Run(build())
    call = build_call(run.laws[0], run.lanes[0].memory)
    constants = pack(BenchConstants(run.blocks[0], Actuation(0.0, 0.0), call))
    carried = pack(BenchLoopState())
    for missed in (0, 7, 0):
        if missed:
            pass_ticks(constants, run.inputs, carried, run.lanes[0].spring, 0, missed)
        y = Measurement(0.01 * (missed + 1), -0.02, 0.003, 0.0, 0.0, 0.0)
        carried["measured"].view(float).reshape(-1)[:] = y
        follow_and_decide(constants, run.inputs, carried, 0)
        reported = Positions(*run.lanes[0].memory[:3])
        assert reported == Positions(y.theta1 + y.phi, y.theta1, y.theta2)


def follow_figure(law, missed):
    """û1 and ŵ of a law tick by tick, of a plant as its model is but for a torque on the link.

    missed: number of missed ticks before 1.25 s, when the link decelerates most.
    """
    run = Run(build_configuration(law=law, effects=svsa.RIG))
    call = build_call(run.laws[0], run.lanes[0].memory)
    constants = pack(BenchConstants(run.blocks[0], Actuation(0.0, 0.0), call))
    carried, row = pack(BenchLoopState()), np.empty(len(CHANNELS))
    x, torque, found = AT_REST, Torque(0.0, 0.0), {}
    for tick in range(1600):
        if 1250 - missed <= tick < 1250:
            if tick == 1249:
                pass_ticks(
                    constants, run.inputs, carried, run.lanes[0].spring, 1250 - missed, missed
                )
        else:
            y = x.theta1, x.theta2, x.q - x.theta1, x.dq, x.dtheta1, x.dtheta2
            carried["measured"].view(float).reshape(-1)[:] = y
            follow_and_decide(constants, run.inputs, carried, tick)
            torque = Torque(*carried["limited"][0].tolist())
            publish_and_predict(constants, carried, run.lanes[0].spring, *torque, tick, row)
            found[tick] = (*torque, *carried["believed"][0].tolist())
        x = predict_state(run.blocks[0].nominal, x, LINK_LOAD, torque, run.period_s)
    return found


@pytest.mark.parametrize("law", ["eso_saturated", "pi_observer", "backstepping", "nmpc"])
def test_missed_bench_ticks_are_not_taken_for_a_load(law):
    """Its own observer would attribute the motion of several ticks to a load in one."""
    whole, missed = follow_figure(law, 0), follow_figure(law, 8)
    off = [np.abs(np.subtract(missed[tick], whole[tick])).max() for tick in range(1250, 1600)]
    assert max(off) < 0.02, "N·m"


@compiled
def take_seven_arguments(nominal, constants, memory, x, reference, estimate, applied):
    return Torque(0.0, 0.0)


def test_compiled_law_with_another_signature_is_rejected_with_the_required_one():
    with pytest.raises(svsa.ParameterError, match=r"7 arguments.*applied, period\[, measured\]"):
        Law("seven", "Seven", "", "", "", take_seven_arguments)


@pytest.mark.parametrize(
    "law",
    [
        lambda time_s, reference, x: (0.0, 0.0),
        lambda time_s, reference, x, w, wind: (0.0, 0.0),
        lambda time_s, reference, x, w, *, period: (0.0, 0.0),
    ],
)
def test_python_law_with_another_signature_is_rejected_with_the_required_one(law):
    with pytest.raises(svsa.ParameterError, match=r"law\(time_s, reference, x, w\).*measured"):
        svsa.simulate("4b", law, duration_s=0.01)


def test_law_in_a_process_with_another_signature_reports_the_required_one():
    model = build_actuator(build().nominal, 0.5)
    with pytest.raises(svsa.SvsaError) as raised:
        LawProcess(b"def law(time_s): return 0, 0", model, place=leave_open)
    assert "law(time_s) must be law(time_s, reference, x, w)" in raised.value.output


@pytest.mark.parametrize(
    "law",
    [
        lambda *reported: (0.1 * len(reported), 0.0),
        lambda measured, applied, x, w: (0.4 + 0.0 * (measured + applied.q), 0.0),
        lambda t, r, x, w, gain=0.4: (gain, 0.0),
    ],
)
def test_law_with_fewer_arguments_works_without_measurement(law):
    samples = svsa.simulate("4b", law, duration_s=0.002, effects=svsa.IDEAL)
    np.testing.assert_allclose(samples.torque1_nm, 0.4)
