"""Runs in a batch: each has the bits of the single run, whatever runs next to it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import svsa
from svsa.actuators.domain import DEFLECTION_LIMIT, INSIDE
from svsa.actuators.faults import FAULT_CODES
from svsa.actuators.signals import CHANNELS, State
from svsa.control.laws.ilc import Learning
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.batch import build_run_batch, run_configurations
from svsa.runs.execution.run import Run
from svsa.runs.metrics.metrics import compute_metrics
from svsa.simulation.loop.batch import Batch
from svsa.simulation.loop.tally import SUMMARY
from svsa.simulation.reference.transition import build_stack
from tests.runs.session.scripts import actuators, gains, loads, observers, positions, stiffnesses
from tests.runs.session.sessions import EVERY_EFFECT

pytestmark = pytest.mark.long

TICKS, BEGIN = 400, 150
LOADS = (
    svsa.ConstantLoad(torque_nm=(0.5, 0.0, 0.1), start_s=0.1),
    svsa.SineLoad(torque_nm=(0.3, 0.2, 0.0), frequency_hz=3.0, start_s=0.2),
    svsa.MassLoad(mass_kg=0.5, start_s=0.3),
)
CRASH = svsa.ConstantLoad(torque_nm=(30.0, 0.0, 0.0), start_s=0.2)

effects = st.builds(
    lambda kept: EVERY_EFFECT.changed(
        **{name: None for name, is_kept in kept.items() if not is_kept}
    ),
    st.fixed_dictionaries(
        dict.fromkeys(
            ("encoders", "estimation", "friction", "current_lag", "noise", "gravity"), st.booleans()
        )
    ),
)
changes = st.fixed_dictionaries(
    {
        "actuator": actuators,
        "gains": gains,
        "observer": observers,
        "effects": effects,
        "seed": st.integers(0, 2**63 - 1),
    }
)
CHIRP = svsa.ChirpPosition(amplitude_rad=0.2, start_hz=0.5, end_hz=2.0, duration_s=0.6)
STEPS = svsa.StepsStiffness(time_s=(0.0, 0.2), stiffness_nm_per_rad=(50.0, 70.0), rise_s=0.1)
MOVE = svsa.MinimumJerkPosition(end_rad=0.2, duration_s=0.3)
what_is_asked = st.fixed_dictionaries(
    {
        "position": positions | st.sampled_from([CHIRP, MOVE]),
        "stiffness": stiffnesses | st.just(STEPS),
        "loads": st.lists(loads, max_size=3).map(tuple),
    }
)


def build(law: str, **chosen: object) -> Configuration:
    return svsa.paper.get_figure("4a").build_configuration(law).changed(**chosen)


def assert_is_run_alone(summary: np.void, configuration: Configuration) -> None:
    run = Run(configuration)
    samples = np.empty((1, TICKS, len(CHANNELS)))
    done = run.advance(samples)
    assert FAULT_CODES.get(summary["code"]) == (run.fault.code if run.fault else None)
    assert summary["ticks"] == done
    assert tuple(summary[name] for name in State._fields) == run.lanes[0].x
    if done <= BEGIN:
        return
    metrics = compute_metrics(samples[0, BEGIN:done], run.period_s)
    count = done - BEGIN
    assert summary["position_peak"] == metrics.peak_position_error_rad
    assert summary["stiffness_peak"] == metrics.peak_stiffness_error_nm_per_rad
    assert summary["torque1_peak"] == metrics.peak_torque1_nm
    assert summary["torque2_peak"] == metrics.peak_torque2_nm
    sums = {
        "position_squares": count * metrics.rms_position_error_rad**2,
        "stiffness_squares": count * metrics.rms_stiffness_error_nm_per_rad**2,
        "position_absolute": metrics.integral_position_error_rad_s / run.period_s,
    }
    for name, value in sums.items():
        assert summary[name] == pytest.approx(value, rel=1e-12)
    effort = summary["torque1_squares"] + summary["torque2_squares"]
    assert effort * run.period_s == pytest.approx(metrics.effort_n2m2_s, rel=1e-12)
    last = run_last_errors(samples[0, done - 1])
    assert (summary["position_last"], summary["stiffness_last"]) == last


def run_last_errors(sample: np.ndarray) -> tuple[float, float]:
    names = [channel.name for channel in CHANNELS]
    position, stiffness = (
        names.index("position_error_rad"),
        names.index("stiffness_error_nm_per_rad"),
    )
    return sample[position], sample[stiffness]


def compare(configurations: list[Configuration]) -> np.ndarray:
    period = configurations[0].sampling.period_s
    summaries = run_configurations(configurations, TICKS * period, BEGIN * period)
    assert (summaries.dtype, summaries.shape) == (SUMMARY, (len(configurations),))
    for summary, configuration in zip(summaries, configurations, strict=True):
        assert_is_run_alone(summary, configuration)
    return summaries


@settings(max_examples=8, deadline=None)
@given(drawn=st.lists(changes, min_size=1, max_size=10))
def test_every_run_equals_the_single_run_with_any_parameters_effects_and_seed(drawn: list) -> None:
    """One with every effect among them, so that the same machine code computes all."""
    first = build("ndobc", effects=EVERY_EFFECT, seed=7, loads=LOADS)
    compare([first, *(build("ndobc", loads=LOADS, **one) for one in drawn)])


@pytest.mark.exhaustive
def test_law_keeps_its_memory_in_each_run() -> None:
    """Also without effects, with an incomplete last group."""
    design = svsa.load_prototype()
    shares = np.linspace(0.7, 1.3, 11)
    plants = [
        design.actuator.changed(link_inertia_kg_m2=share * design.actuator.link_inertia_kg_m2)
        for share in shares
    ]
    summaries = compare([build("fl_integral", actuator=plant, loads=LOADS) for plant in plants])
    assert len(np.unique(summaries["q"])) == len(shares)


@pytest.mark.exhaustive
def test_ended_run_keeps_its_last_state_and_other_runs_continue() -> None:
    """Each at its own tick; a completed run has no fault of its neighbours."""
    masses = np.linspace(0.6, 1.4, 8)
    design = svsa.load_prototype()
    plants = [
        design.actuator.changed(link_inertia_kg_m2=share * design.actuator.link_inertia_kg_m2)
        for share in masses
    ]
    crashing = [build("fl_integral", actuator=plant, loads=(CRASH,)) for plant in plants]
    summaries = compare(crashing)
    assert set(summaries["code"]) == {DEFLECTION_LIMIT}
    assert len(set(summaries["ticks"])) > 1


@pytest.mark.exhaustive
@settings(max_examples=12, deadline=None)
@given(drawn=st.lists(what_is_asked, min_size=2, max_size=11))
def test_every_run_has_its_own_references_and_loads(drawn: list) -> None:
    """In one group, of every kind, and each equals the single run."""
    compare([build("fl_integral", **one) for one in drawn])


@pytest.mark.exhaustive
def test_common_values_of_runs_are_stored_once() -> None:
    points = {"time_s": (0.0, 0.1, 0.2), "torque_nm": ((0.0, 0.0, 0.0), (0.2, 0, 0), (0.1, 0, 0))}
    shared, other = (svsa.SeriesLoad(start_s=start, **points) for start in (0.05, 0.1))
    chosen = [shared, shared, other, shared]
    configurations = [build("fl_integral", position=MOVE, loads=(load,)) for load in chosen]
    batch = build_run_batch(configurations)
    assert len(batch.inputs.loads.points) == 2 * len(points["time_s"])
    assert len(batch.inputs.position.breaks) == len(build_stack(MOVE).breaks)
    summaries = compare(configurations)
    assert summaries["q"][0] == summaries["q"][1] == summaries["q"][3] != summaries["q"][2]


@pytest.mark.exhaustive
def test_runs_with_other_references_are_returned_in_their_order() -> None:
    angles = (0.1, -0.2, 0.1, 0.3)
    laws = ("fl_integral", "ndobc", "fl_integral", "fl_integral")
    configurations = [
        build(law, position=svsa.ConstantPosition(position_rad=angle))
        for law, angle in zip(laws, angles, strict=True)
    ]
    summaries = compare(configurations)
    assert summaries["q"][1] < summaries["q"][0] == summaries["q"][2] < summaries["q"][3]


def is_at_once(batch: Batch) -> bool:
    return batch.control is not None


@pytest.mark.exhaustive
def test_law_that_branches_on_its_state_is_called_for_one_run_after_the_other() -> None:
    """Other parameters, including integers, in each; one ends before the others."""
    configurations = [
        build(
            "ilc",
            effects=svsa.RIG,
            parameters={"ilc": Learning(period_s=1.0, position_lead_s=lead)},
            loads=LOADS if lead < 0.1 else (CRASH,),
        )
        for lead in (0.02, 0.04, 0.06, 0.2)
    ]
    assert not is_at_once(build_run_batch(configurations))
    summaries = compare(configurations)
    assert summaries["code"].tolist() == [INSIDE, INSIDE, INSIDE, DEFLECTION_LIMIT]


def test_values_common_to_all_lanes_are_rejected_if_they_differ() -> None:
    rig = svsa.RIG
    mixed = [build("ndobc", effects=rig.changed(delay_samples=delay)) for delay in (1, 2)]
    with pytest.raises(svsa.ParameterError, match=r"blocks\.effects\.delay.*every run of a batch"):
        build_run_batch(mixed)


@pytest.mark.exhaustive
@pytest.mark.parametrize("law", ["ndobc_w", "lqi"])
def test_laws_with_tuples_and_records_in_their_memory_run_in_a_batch(law: str) -> None:
    """Each equals the single run, on the rig, where a motor saturates."""
    design = svsa.load_prototype()
    plants = [
        design.actuator.changed(link_inertia_kg_m2=share * design.actuator.link_inertia_kg_m2)
        for share in (0.8, 1.0, 1.2)
    ]
    configurations = [build(law, actuator=plant, effects=svsa.RIG, loads=LOADS) for plant in plants]
    assert is_at_once(build_run_batch(configurations))
    compare(configurations)
