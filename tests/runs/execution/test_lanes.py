"""Lanes: controllers in parallel, each on its own plant, all under the same conditions."""

import re

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.definition.command import Set
from svsa.runs.definition.design import Lane, LaneSetting
from svsa.runs.execution.run import Run
from svsa.runs.metrics.metrics import compute_metrics
from tests.runs.session.sessions import (
    EVERY_EFFECT,
    PULSE,
    advance,
    build_configuration,
    build_session,
    read_samples,
)

FL, NDOBC = svsa.Lane(law="fl"), svsa.Lane(law="ndobc")
SLOW = svsa.Lane(law="ndobc", gains=svsa.Gains.from_poles([-30.0] * 4, [-20.0] * 2))
WIDE = svsa.Lane(
    law="ndobc", observer=svsa.ObserverBandwidth(bandwidth_rad_per_s=(90.0, 90.0, 90.0))
)
FRAGILE = svsa.Lane(law="fl", gains=svsa.Gains.from_poles([-900.0] * 4, [-900.0] * 2))
SHARED = [CHANNEL_INDEX[name] for name in ("time_s", "position_reference_rad")]
SHARED += [CHANNEL_INDEX["stiffness_reference_nm_per_rad"]]
NOISY = {"effects": EVERY_EFFECT, "seed": 11}


def test_same_law_twice_gives_the_same_bits():
    """Noise, load and reference are one realisation for all lanes."""
    run = Run(build_configuration(PULSE, comparisons=(NDOBC, NDOBC, NDOBC), **NOISY))
    samples = advance(run, 300)
    for lane in samples[1:]:
        np.testing.assert_array_equal(lane, samples[0])


def test_different_laws_share_time_reference_and_load():
    samples = advance(Run(build_configuration(PULSE, comparisons=(FL,), **NOISY)), 300)
    np.testing.assert_array_equal(samples[0][:, SHARED], samples[1][:, SHARED])
    assert np.any(samples[0] != samples[1])


@pytest.mark.parametrize("effects", [svsa.IDEAL, EVERY_EFFECT], ids=["ideal", "every effect"])
def test_fl_and_ndobc_in_lanes_equal_two_single_runs_bit_for_bit(effects):
    """An additional lane changes nothing; Figure 4A including its load."""
    both = svsa.simulate("4a", "ndobc", comparisons=(FL,), effects=effects, duration_s=6.0)
    (fl,) = both.comparisons
    for result in (both, fl):
        alone = svsa.simulate("4a", result.law, effects=effects, duration_s=6.0)
        assert alone.comparisons == ()
        np.testing.assert_array_equal(result.samples, alone.samples)
    assert (both.law, fl.law) == ("ndobc", "fl")
    errors = [result.metrics.rms_position_error_rad for result in (both, fl)]
    assert errors[1] > 2.0 * errors[0]


def test_lane_has_its_own_gains_and_observer_or_those_of_the_run():
    """Each lane equals the run with its settings."""
    lanes = (SLOW, WIDE, FL)
    together = svsa.simulate(
        build_configuration(PULSE, comparisons=lanes), duration_s=0.3
    ).comparisons
    for lane, result in zip(lanes, together, strict=True):
        own = {key: value for key, value in lane if value is not None}
        alone = svsa.simulate(build_configuration(PULSE, **own), duration_s=0.3)
        np.testing.assert_array_equal(result.samples, alone.samples)


def test_gains_of_the_run_apply_to_lanes_without_their_own():
    """A change during the run affects lanes without their own gains, and no other."""
    run = Run(build_configuration(PULSE, comparisons=(NDOBC, SLOW)))
    advance(run, 40)
    run.change(Set("gains", SLOW.gains))
    samples = advance(run, 100)
    np.testing.assert_array_equal(samples[0], samples[1])
    run = Run(build_configuration(PULSE, comparisons=(SLOW,)))
    unchanged = advance(run, 140)[1]
    np.testing.assert_array_equal(samples[2], unchanged[40:])


@pytest.mark.parametrize("number", [0, 1, 2])
def test_fault_in_one_lane_ends_all_at_its_tick_and_names_the_lane(number):
    """Gains that the delay makes unstable, in the first lane or in another."""
    lanes = [NDOBC, NDOBC, NDOBC]
    lanes[number] = FRAGILE
    changes = {"law": lanes[0].law, "comparisons": tuple(lanes[1:]), "effects": svsa.RIG}
    if number == 0:
        changes["gains"] = FRAGILE.gains
        changes["comparisons"] = (SLOW, SLOW)
    run = Run(build_configuration(**changes))
    samples = advance(run, 2000)
    fault = run.fault
    assert fault is not None
    assert fault.lane == number
    assert 0 < fault.tick == run.tick == samples.shape[1] < 2000
    assert re.match(r"FL( \(1\))?: At ", fault.message), "lanes are named by law, not by number"
    assert np.all(np.isfinite(samples))
    again = Run(build_configuration(**changes))
    np.testing.assert_array_equal(advance(again, fault.tick), samples)
    assert again.fault is None
    assert again.lanes == run.lanes, "every lane stands where it stood at that tick"
    assert advance(run, 10).shape[1] == 0


def test_added_comparison_starts_at_the_state_of_the_first_lane():
    run = Run(build_configuration(PULSE, **NOISY))
    advance(run, 100)
    run.change(Set("comparisons", (FL, NDOBC)))
    assert run.lanes == [run.lanes[0]] * 3
    samples = advance(run, 200)
    np.testing.assert_array_equal(samples[2], samples[0])
    assert np.any(samples[1] != samples[0])
    changed = Run(build_configuration(PULSE, **NOISY))
    advance(changed, 100)
    changed.change(Set("law", "fl"))
    np.testing.assert_array_equal(samples[1], advance(changed, 200)[0])


def test_remaining_comparison_continues_from_its_state():
    """Adding one after it or removing one after it does not reset it."""
    whole = advance(Run(build_configuration(PULSE, comparisons=(FL,))), 300)[1]
    run = Run(build_configuration(PULSE, comparisons=(FL,)))
    advance(run, 100)
    run.change(Set("comparisons", (FL, SLOW)))
    advance(run, 100)
    run.change(Set("comparisons", (FL,)))
    np.testing.assert_array_equal(advance(run, 100)[1], whole[200:])


def test_replaced_comparison_leaves_the_third_lane_unchanged():
    """(FL, slow) → (wide, slow): the new one starts at the state of the first, slow continues."""
    run = Run(build_configuration(PULSE, comparisons=(FL, SLOW)))
    advance(run, 100)
    first, _, slow = run.lanes
    run.change(Set("comparisons", (WIDE, SLOW)))
    assert run.lanes == [first, first, slow]


def test_four_lanes_are_the_maximum():
    """Rejected at the start and during a run, which continues unchanged."""
    with pytest.raises(svsa.ParameterError, match="comparisons"):
        build_configuration(comparisons=(FL,) * 4)
    run = Run(build_configuration(comparisons=(FL,) * 3))
    advance(run, 10)
    before = run.configuration, list(run.lanes)
    with pytest.raises(svsa.ParameterError, match="comparisons"):
        run.change(Set("comparisons", (FL,) * 4))
    assert (run.configuration, run.lanes) == before
    assert advance(run, 10).shape[0] == 4


def test_every_lane_has_its_metrics_since_the_start_and_since_the_load():
    session = build_session(PULSE, comparisons=(FL, SLOW))
    session.step(130)
    for lane in range(3):
        samples = read_samples(session, lane)
        for running, first in (
            (session.journal.metrics.since_start, 0),
            (session.journal.metrics.since_load, 30),
        ):
            expected = vars(compute_metrics(samples[first:], 0.001))
            assert vars(running[lane].summarize()) == pytest.approx(expected)
    peaks = [m.summarize().peak_position_error_rad for m in session.journal.metrics.since_load]
    assert len(set(peaks)) == 3


def test_new_lane_has_no_past_and_all_metrics_start_together():
    """The past of the first lane is not that of the new one."""
    session = build_session(PULSE)
    session.step(60)
    session.change(Set("comparisons", (FL,)))
    session.step(40)
    first, second = read_samples(session, 0), read_samples(session, 1)
    assert np.all(np.isnan(second[:60]))
    assert np.all(np.isfinite(second[60:]) == np.isfinite(first[60:]))
    metrics = session.journal.metrics
    assert [m.summarize().duration_s for m in metrics.in_window] == pytest.approx([0.04, 0.04])
    for running, duration in ((metrics.since_start, 0.1), (metrics.since_load, 0.03)):
        assert running[0].summarize().duration_s == pytest.approx(duration)
        assert running[1] is None


def test_exchanged_laws_move_no_plant():
    """Lane 1 continues with the law of lane 2 from its state, and vice versa."""
    run = Run(build_configuration(PULSE, comparisons=(FL, SLOW), **NOISY))
    advance(run, 60)
    before = list(run.lanes)
    run.change(Set("laws", ("fl", "ndobc")))
    assert run.lanes == before
    assert [lane.law for lane in run.configuration.lanes] == ["fl", "ndobc", "ndobc"]
    assert run.configuration.comparisons[1] == SLOW
    changed = Run(build_configuration(PULSE, **NOISY))
    advance(changed, 60)
    changed.change(Set("law", "fl"))
    np.testing.assert_array_equal(advance(run, 40)[0], advance(changed, 40)[0])


@pytest.mark.parametrize(
    ("laws", "bound"), [((), r"a list of at least 1"), (("fl", "fl", "fl"), r"1 to 2 laws")]
)
def test_laws_are_limited_to_the_number_of_lanes(laws, bound):
    run = Run(build_configuration(comparisons=(FL,)))
    with pytest.raises(svsa.ParameterError, match=bound):
        run.change(Set("laws", laws))


def test_reset_with_comparisons_starts_them_from_rest():
    session = build_session(PULSE, comparisons=(FL,))
    session.step(80)
    samples = [read_samples(session, lane) for lane in (0, 1)]
    session.reset()
    session.step(80)
    for lane in (0, 1):
        np.testing.assert_array_equal(read_samples(session, lane), samples[lane])


def build_integral(pole: float) -> Lane:
    return Lane(law="fl_integral", parameters={"position_pole_rad_per_s": pole})


def test_reconfigured_lane_keeps_its_plant_and_the_memory_of_its_law():
    """The same samples as a run whose law has these parameters, changed at that tick."""
    run = Run(build_configuration(PULSE, comparisons=(build_integral(40.0), FL), **NOISY))
    advance(run, 90)
    before = list(run.lanes)
    run.change(Set("lane", LaneSetting(lane=2, setting=build_integral(60.0))))
    assert run.lanes == before
    assert np.any(before[1].memory != 0.0), "the law has something to remember"
    alone = Run(
        build_configuration(
            PULSE, law="fl_integral", parameters={"fl_integral": build_integral(40.0).parameters}
        ).changed(**NOISY)
    )
    advance(alone, 90)
    alone.change(Set("parameters", {"fl_integral": build_integral(60.0).parameters}))
    samples = advance(run, 100)
    np.testing.assert_array_equal(samples[1], advance(alone, 100)[0])
    run.change(Set("lane", LaneSetting(lane=3, setting=build_integral(60.0))))
    assert not np.any(run.lanes[2].memory), "another law begins without a past"


@pytest.mark.parametrize(
    ("comparisons", "lane", "bound"), [((), 2, "none: one lane runs"), ((FL,), 3, "2 to 2")]
)
def test_only_a_running_lane_is_reconfigured(comparisons, lane, bound):
    run = Run(build_configuration(comparisons=comparisons))
    with pytest.raises(svsa.ParameterError, match=f"lane is {lane}: it must be {bound}"):
        run.change(Set("lane", LaneSetting(lane=lane, setting=NDOBC)))
    with pytest.raises(svsa.ParameterError, match="lane"):
        LaneSetting(lane=1, setting=NDOBC)


def test_reconfigured_lane_keeps_its_past_and_gets_its_own_name():
    """The earlier curve keeps the name and color of its law."""
    session = build_session(PULSE, law="fl_integral", comparisons=(Lane(law="fl_integral"),))
    session.step(60)
    (second_id,) = session.journal.timeline.lane_ids[1:]
    session.change(Set("lane", LaneSetting(lane=2, setting=build_integral(40.0))))
    session.step(40)
    assert session.journal.timeline.lane_ids[1] == second_id
    assert np.all(np.isfinite(read_samples(session, 1)))
    lanes = session.journal.timeline.list_segments()
    names = session.journal.timeline.name_segments(lanes)
    reported = [[(names[s.number], s.first_tick, s.end_tick) for s in lane] for lane in lanes]
    assert reported == [
        [("FL + I a 54.6", 0, None)],
        [("FL + I a 54.6 (2)", 0, 60), ("FL + I a 40", 60, None)],
    ]
    assert len({s.line_style for lane in lanes for s in lane}) == 3
    assert session.journal.timeline.window.label == "FL + I set"
