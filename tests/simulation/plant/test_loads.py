"""Loads: the torque of each kind over time, and the effect of a hanging mass on Eq 1."""

import math
import re

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import ExternalLoad, compute_acceleration, compute_internal_torque
from svsa.actuators.signals import CHANNEL_INDEX, Torque
from svsa.runs.definition.configuration import MAX_LOADS
from svsa.runs.execution.run import Run
from svsa.simulation.plant.load_table import build_load_table, compute_load, schedule_load
from svsa.simulation.plant.loads import LOADS
from tests.actuators.prototype import PLANT, build_state, record

T = 0.001
TRIPLE = (0.5, -0.25, 0.125)


def read_load(loads, time, tick=None):
    """Return the torque on the plant at `time` from these loads, added at t = 0."""
    table = build_load_table(tuple(schedule_load(i, load, 0, T) for i, load in enumerate(loads)))
    return compute_load(table, math.floor(time / T + 1e-9) if tick is None else tick, T, time)


def test_no_load_has_zero_torque():
    assert read_load([], 1.0) == ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)


def test_paper_load_is_two_newton_metres_on_all_channels_from_its_onset():
    load = svsa.PaperLoad(start_s=5.0)
    assert read_load([load], 4.9995) == ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)
    for time in (5.0, 5.0005, 19.0):
        assert read_load([load], time) == ExternalLoad(2.0, 2.0, 2.0, 0.0, 0.0)


def test_constant_load_is_a_step():
    load = svsa.ConstantLoad(torque_nm=TRIPLE, start_s=0.1)
    assert read_load([load], 0.0999)[:3] == (0.0, 0.0, 0.0)
    assert read_load([load], 0.1)[:3] == TRIPLE
    assert read_load([load], 1e5)[:3] == TRIPLE


def test_pulse_ends_after_its_duration():
    load = svsa.PulseLoad(torque_nm=TRIPLE, duration_s=0.02, start_s=0.1)
    assert read_load([load], 0.1195)[:3] == TRIPLE
    assert read_load([load], 0.12)[:3] == (0.0, 0.0, 0.0)


def test_pulse_shorter_than_a_sample_lasts_one_sample():
    """It is not lost between two samples."""
    load = svsa.PulseLoad(torque_nm=TRIPLE, duration_s=1e-5, start_s=0.1)
    assert read_load([load], 0.1)[:3] == TRIPLE
    assert read_load([load], 0.101)[:3] == (0.0, 0.0, 0.0)


def test_sine_load_has_zero_phase_at_its_onset():
    load = svsa.SineLoad(torque_nm=TRIPLE, frequency_hz=4.0, phase_rad=0.3, start_s=0.1)
    for time in (0.1, 0.1375, 0.2212):
        shape = math.sin(8.0 * math.pi * (time - 0.1) + 0.3)
        expected = tuple(shape * torque for torque in TRIPLE)
        assert read_load([load], time)[:3] == pytest.approx(expected, rel=1e-12)


def test_series_is_linear_between_its_points_and_zero_outside():
    points = ((0.0, 0.0, 0.0), (1.0, -2.0, 4.0), (1.0, 0.0, 0.0))
    load = svsa.SeriesLoad(time_s=(0.01, 0.03, 0.05), torque_nm=points, start_s=0.1)
    expected = {
        0.105: (0.0, 0.0, 0.0),
        0.11: (0.0, 0.0, 0.0),
        0.115: (0.25, -0.5, 1.0),
        0.13: (1.0, -2.0, 4.0),
        0.14: (1.0, -1.0, 2.0),
        0.16: (0.0, 0.0, 0.0),
    }
    for time, torque in expected.items():
        assert read_load([load], time)[:3] == pytest.approx(torque, abs=1e-12), time


def test_two_series_use_their_own_points():
    ramps = [
        svsa.SeriesLoad(time_s=(0.0, 1.0), torque_nm=((0.0, 0.0, 0.0), (a, 0.0, 0.0)))
        for a in (1.0, 10.0)
    ]
    assert read_load(ramps, 0.5).w2 == pytest.approx(5.5)
    assert read_load(ramps[1:], 0.5).w2 == pytest.approx(5.0)


def test_hanging_mass_adds_inertia_and_gravity():
    """m r² and m g r: 3 kg at 68 mm is 2 N·m, the paper's figure for it."""
    load = read_load([svsa.MassLoad()], 0.0)
    assert load == pytest.approx((0.0, 0.0, 0.0, 3.0 * 0.068**2, 3.0 * 9.81 * 0.068))
    assert load.gravity_moment == pytest.approx(2.0, abs=2e-3)


def test_gravity_pulls_the_link_towards_zero_and_its_inertia_slows_the_link_only():
    """(M + m r²) q̈ = F − m g r sin q + w2; the equations of the motors are unchanged."""
    x, u = build_state(0.5, 0.1, q=0.7, dq=0.3, dtheta1=-0.2, dtheta2=0.4), Torque(0.6, -0.3)
    load = ExternalLoad(0.2, 0.1, -0.1, 0.014, 2.0)
    F, found = compute_internal_torque(PLANT, x), compute_acceleration(PLANT, x, u, load)
    ddq = (F.link - 2.0 * math.sin(0.7) + 0.2) / (PLANT.M + 0.014)
    assert found.ddq == pytest.approx(ddq, rel=1e-14)
    assert found.ddtheta1 == pytest.approx((F.motor1 + 0.6 + 0.1) / PLANT.B1, rel=1e-14)
    assert found.ddtheta2 == pytest.approx((F.motor2 - 0.3 - 0.1) / PLANT.B2, rel=1e-14)


def test_overlapping_loads_add():
    loads = [
        svsa.PaperLoad(start_s=0.1),
        svsa.ConstantLoad(torque_nm=TRIPLE, start_s=0.05),
        svsa.MassLoad(mass_kg=1.0, arm_m=0.1),
        svsa.MassLoad(mass_kg=2.0, arm_m=0.1),
    ]
    found = read_load(loads, 0.2)
    assert found == pytest.approx((2.5, 1.75, 2.125, 0.03, 0.3 * 9.81))
    assert read_load(loads, 0.07)[:3] == TRIPLE


def test_onset_is_rounded_to_the_nearest_sample():
    """A step inside an RK4 step would reduce its order, so loads switch at ticks only."""
    early = svsa.ConstantLoad(torque_nm=TRIPLE, start_s=0.1004)
    late = svsa.ConstantLoad(torque_nm=TRIPLE, start_s=0.1006)
    assert schedule_load(1, early, 0, T).start_tick == 100
    assert schedule_load(1, late, 0, T).start_tick == 101
    assert read_load([late], 0.1009)[:3] == (0.0, 0.0, 0.0)
    end_of_the_last_sample_before = read_load([late], 0.101, tick=100)
    assert end_of_the_last_sample_before[:3] == (0.0, 0.0, 0.0)


def test_onset_in_the_past_is_now():
    past = svsa.PulseLoad(torque_nm=TRIPLE, duration_s=0.02, start_s=0.1)
    scheduled = schedule_load(1, past, 500, T)
    assert (scheduled.start_tick, scheduled.end_tick) == (500, 520)
    assert schedule_load(1, svsa.PaperLoad(), 500, T).start_tick == 500


def test_load_acts_from_the_sample_of_its_onset():
    """The recorded true disturbance of an exact model is the load, from its tick on."""
    configuration = svsa.paper.get_figure("4b").build_configuration(load=False)
    run = Run(configuration.changed(nominal=configuration.actuator))
    run.add_load(svsa.PulseLoad(torque_nm=TRIPLE, duration_s=0.01, start_s=0.02))
    link = record(run, 40)[:, CHANNEL_INDEX["disturbance_link_nm"]]
    expected = np.where((np.arange(40) >= 20) & (np.arange(40) < 30), 0.5, 0.0)
    np.testing.assert_allclose(link, expected, atol=1e-11)


def test_repeated_manual_load_is_one_load_that_changes_and_continues():
    """No gap and no overlap: each torque from its tick on, until updates stop."""
    configuration = svsa.paper.get_figure("4b").build_configuration(load=False)
    run = Run(configuration.changed(nominal=configuration.actuator))
    link = []
    for torque in (0.5, 0.8, -0.3):
        run.add_load(svsa.PushLoad(torque_nm=(torque, 0.0, 0.0), hold_s=0.02))
        link.append(record(run, 10)[:, CHANNEL_INDEX["disturbance_link_nm"]])
    link.append(record(run, 20)[:, CHANNEL_INDEX["disturbance_link_nm"]])
    expected = np.repeat([0.5, 0.8, -0.3, -0.3, 0.0], 10)
    np.testing.assert_allclose(np.concatenate(link), expected, atol=1e-11)
    (push,) = run.loads
    assert (push.number, push.start_tick, push.end_tick) == (1, 0, 40)
    again = run.add_load(svsa.PushLoad(torque_nm=TRIPLE))
    assert (again.number, again.start_tick) == (4, 50), "that one had ended: another begins"


def test_loads_are_numbered_removed_and_limited_in_number():
    run = Run(svsa.paper.get_figure("4a").build_configuration())
    added = [run.add_load(svsa.ConstantLoad(torque_nm=TRIPLE)) for _ in range(MAX_LOADS - 1)]
    assert len({load.number for load in run.loads}) == MAX_LOADS
    with pytest.raises(svsa.StateError, match=f"{MAX_LOADS} loads"):
        run.add_load(svsa.PaperLoad())
    run.remove_load(added[0].number)
    with pytest.raises(svsa.StateError, match=f"no load {added[0].number}"):
        run.remove_load(added[0].number)
    assert run.add_load(svsa.PaperLoad()).number > added[-1].number


REFUSED = {
    "mass_kg": (lambda: svsa.MassLoad(mass_kg=-1.0), -1.0, "kg", "greater than 0 kg"),
    "arm_m": (lambda: svsa.MassLoad(arm_m=2.0), 2.0, "m", "at most 1 m"),
    "start_s": (lambda: svsa.PaperLoad(start_s=-1.0), -1.0, "s", "at least 0 s"),
    "duration_s": (lambda: svsa.PulseLoad(torque_nm=TRIPLE, duration_s=0.0), 0.0, "s", "greater"),
    "frequency_hz": (
        lambda: svsa.SineLoad(torque_nm=TRIPLE, frequency_hz=101.0),
        101.0,
        "Hz",
        "at most 100 Hz",
    ),
    "torque_nm[1]": (
        lambda: svsa.ConstantLoad(torque_nm=(0.0, 51.0, 0.0)),
        51.0,
        "N·m",
        "at most 50 N·m",
    ),
    "torque_nm[0]": (
        lambda: svsa.ConstantLoad(torque_nm=("2", 0.0, 0.0)),
        "2",
        "N·m",
        "a number",
    ),
    "torque_nm": (
        lambda: svsa.SeriesLoad(time_s=(0.0, 1.0, 2.0), torque_nm=(TRIPLE, TRIPLE)),
        2,
        "points",
        "3 points",
    ),
    "time_s": (
        lambda: svsa.SeriesLoad(time_s=(0.0, 0.0), torque_nm=(TRIPLE, TRIPLE)),
        [0.0, 0.0],
        "s",
        "increasing",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_rejected_load_names_field_value_unit_and_bound(name):
    build, value, unit, bound = REFUSED[name]
    with pytest.raises(svsa.ParameterError) as refused:
        build()
    (violation,) = refused.value.violations
    assert (violation.name, violation.value, violation.unit) == (name, value, unit)
    assert bound in violation.bound
    assert name in str(refused.value)


@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), "3", True, None])
def test_load_accepts_finite_numbers_only(wrong):
    with pytest.raises(svsa.ParameterError, match="mass_kg"):
        svsa.MassLoad(mass_kg=wrong)


def test_series_from_a_function_of_time():
    load = svsa.SeriesLoad.from_function(lambda t: (math.sin(3.0 * t), 0.0, t), 0.5, start_s=0.1)
    w2, w4, w6 = read_load([load], 0.35)[:3]
    assert (w2, w4, w6) == pytest.approx((math.sin(0.75), 0.0, 0.25), abs=1e-6)
    with pytest.raises(svsa.ParameterError, match="20000"):
        svsa.SeriesLoad.from_function(lambda t: (t, t, t), 1e6)


@pytest.mark.parametrize("kind", LOADS, ids=lambda kind: kind.__name__)
def test_each_kind_of_load_describes_itself_and_runs_with_its_defaults(kind):
    assert getattr(svsa, kind.__name__) is kind
    name = re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__.removesuffix("Load")).lower()
    assert name == kind.model_fields["kind"].default
    if kind.first is not None:
        load = kind(torque_nm=TRIPLE, **kind.first)
        assert load.describe()
        assert read_load([load], 0.013)[:3] != (0.0, 0.0, 0.0)
        factor = 1.0 if kind.factor is None else read_load([load], 0.013).w2 / TRIPLE[0]
        assert read_load([load], 0.013)[:3] == pytest.approx([factor * torque for torque in TRIPLE])


def test_paper_load_is_torques_without_a_hanging_mass():
    """A view with 3 kg on a cord would show another plant than the simulated one."""
    assert svsa.PaperLoad().get_hung_mass() == 0.0
    assert svsa.MassLoad().get_hung_mass() == 3.0
