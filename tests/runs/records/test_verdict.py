"""A run matches another within tolerances of value and time, or the first mismatch is reported."""

import json

import numpy as np
import pytest
from pydantic import TypeAdapter
from typer.testing import CliRunner

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.cli import app
from svsa.errors import ParameterError
from svsa.runs.records.header import RecordError
from svsa.runs.records.reader import Record, build_record, open_record
from svsa.runs.records.verdict import MAX_OUTSIDE, Tolerance, Verdict, judge
from svsa.runs.records.writer import write_record
from tests.runs.records.records import PERIOD_S, build_header, build_samples

ERROR, TORQUE = "position_error_rad", "torque1_nm"
TICKS = 200


def build(run_id: str = "run-1", ticks: int = TICKS, lanes: int = 2, **changes: object) -> Record:
    """A record with these values in some channels of the second lane."""
    samples = build_samples(ticks, lanes)
    for name, values in changes.items():
        samples[:, 1, CHANNEL_INDEX[name]] = values
    names = tuple(f"lane{number + 1}" for number in range(lanes))
    return build_record(build_header(run_id, lanes=names), [], 0, samples)


def find(verdict, lane, channel):
    return next(one for one in verdict.channels if (one.lane, one.channel) == (lane, channel))


def test_run_matches_itself_without_tolerance():
    verdict = judge(build(), build("run-2"), {})
    assert verdict.held
    assert (verdict.ticks, verdict.own_ticks, verdict.other_ticks) == (TICKS, TICKS, TICKS)
    assert {one.excess for one in verdict.channels} == {0.0}


def test_one_different_bit_is_reported_with_lane_channel_and_time():
    values = np.linspace(1.0, 2.0, TICKS)
    nudged = values.copy()
    nudged[120] = np.nextafter(values[120], np.inf)
    verdict = judge(build(**{ERROR: nudged}), build(**{ERROR: values}), {})
    (wrong,) = [one for one in verdict.channels if not one.held]
    assert (wrong.lane, wrong.channel, wrong.unit) == ("lane2", ERROR, "rad")
    assert (wrong.worst_s, wrong.value) == (pytest.approx(120 * PERIOD_S), nudged[120])
    assert not verdict.held


@pytest.mark.parametrize(
    ("tolerance", "held"),
    [
        (Tolerance(absolute=0.11), True),
        (Tolerance(absolute=0.09), False),
        (Tolerance(relative=0.051), True),
        (Tolerance(relative=0.049), False),
        (Tolerance(absolute=0.05, relative=0.026), True),
    ],
)
def test_absolute_and_relative_tolerance_are_added(tolerance, held):
    """2.1 compared with 2.0."""
    verdict = judge(build(**{ERROR: 2.1}), build(**{ERROR: 2.0}), {ERROR: tolerance})
    assert find(verdict, "lane2", ERROR).held is held
    assert verdict.held is held
    if not held:
        assert find(verdict, "lane2", ERROR).excess == pytest.approx(
            0.1 - tolerance.absolute - 2.0 * tolerance.relative
        )


@pytest.mark.parametrize(("late", "held"), [(3, True), (4, False)])
def test_step_may_be_later_by_the_time_tolerance_only(late, held):
    ticks = np.arange(TICKS)
    step, later = (np.where(ticks >= at, 1.0, 0.0) for at in (100, 100 + late))
    tolerance = {ERROR: Tolerance(time_s=3 * PERIOD_S)}
    for one, other in ((step, later), (later, step)):
        verdict = judge(build(**{ERROR: one}), build(**{ERROR: other}), tolerance, None)
        assert [one.channel for one in verdict.channels] == [ERROR, ERROR]
        assert verdict.held is held


def test_value_missing_in_one_run_is_a_mismatch_and_in_both_a_match():
    unknown = np.where(np.arange(TICKS) == 7, np.nan, 1.0)
    loose = {TORQUE: Tolerance(absolute=100.0)}
    verdict = judge(build(**{TORQUE: unknown}), build(**{TORQUE: 1.0}), loose, None)
    assert find(verdict, "lane2", TORQUE).worst_s == pytest.approx(7 * PERIOD_S)
    assert not verdict.held
    assert judge(build(**{TORQUE: unknown}), build(**{TORQUE: unknown}), loose, None).held


def test_unknown_values_are_null_in_the_answer_and_in_the_output_of_the_command(tmp_path):
    folder, samples = tmp_path / "a", np.full_like(build_samples(TICKS), np.nan)
    write_record(folder, build_header("a"), [], 0, samples)
    verdict = judge(open_record(folder), open_record(folder), {})
    for text in (TypeAdapter(Verdict).dump_json(verdict), run(folder, folder, "--json").stdout):
        assert {(c["value"], c["excess"]) for c in json.loads(text)["channels"]} == {(None, None)}


def test_missing_value_does_not_remove_the_band_of_its_neighbours():
    unknown = np.where(np.arange(TICKS) == 7, np.nan, 1.0)
    near = {TORQUE: Tolerance(time_s=3 * PERIOD_S)}
    assert judge(build(**{TORQUE: 1.0}), build(**{TORQUE: unknown}), near, None).held
    assert judge(build(**{TORQUE: unknown}), build(**{TORQUE: unknown}), near, None).held
    assert not judge(build(**{TORQUE: 1.1}), build(**{TORQUE: unknown}), near, None).held
    never = build(**{TORQUE: np.nan})
    verdict = judge(build(**{TORQUE: 1.0}), never, near, None)
    assert (verdict.held, find(verdict, "lane2", TORQUE).outside_s) == (False, TICKS * PERIOD_S)


def test_shorter_run_does_not_match():
    verdict = judge(build(ticks=150), build(), {})
    assert all(one.held for one in verdict.channels)
    assert (verdict.held, verdict.ticks) == (False, 150)


def test_segments_outside_are_reported_with_their_total_duration():
    """Two of 5 ticks; adjacent segments one tick apart are merged, including the tick between."""
    values = np.zeros(TICKS)
    values[[20, 21, 22, 24, 25, 100, 101, 102, 103, 104]] = 2.0
    verdict = judge(build(**{ERROR: values}), build(**{ERROR: 0.0}), {ERROR: Tolerance(absolute=1)})
    one = find(verdict, "lane2", ERROR)
    stretches = [(20, 22), (24, 25), (100, 104)]
    assert [pytest.approx(stretch) for stretch in one.outside] == [
        (begin * PERIOD_S, end * PERIOD_S) for begin, end in stretches
    ]
    assert one.outside_s == pytest.approx(10 * PERIOD_S)
    assert find(verdict, "lane1", ERROR).outside == ()


def test_number_of_reported_segments_is_limited():
    ticks = 40 * MAX_OUTSIDE
    values = np.where(np.arange(ticks) % 2, 2.0, 0.0)
    long, flat = build(ticks=ticks, **{ERROR: values}), build(ticks=ticks, **{ERROR: 0.0})
    one = find(judge(long, flat, {ERROR: Tolerance(absolute=1)}, None), "lane2", ERROR)
    assert one.outside == ((pytest.approx(PERIOD_S), pytest.approx((ticks - 1) * PERIOD_S)),)
    assert one.outside_s == pytest.approx(ticks / 2 * PERIOD_S)


def test_runs_are_aligned_at_the_given_samples():
    """A pulse that comes 50 samples later in a run that started 50 samples earlier."""
    ticks = np.arange(TICKS)
    pulse = np.where(ticks == 60, 1.0, 0.0)
    later = np.where(np.arange(TICKS + 50) == 110, 1.0, 0.0)
    run, other = build(ticks=TICKS + 50, **{ERROR: later}), build(**{ERROR: pulse})
    tolerance = {ERROR: Tolerance()}
    assert find(judge(run, other, tolerance, None, (50, 0)), "lane2", ERROR).held
    verdict = judge(run, other, tolerance, None, (49, 0))
    assert find(verdict, "lane2", ERROR).outside == (
        (pytest.approx(109 * PERIOD_S), pytest.approx(110 * PERIOD_S)),
    )
    with pytest.raises(RecordError, match="nothing to compare"):
        judge(run, other, tolerance, None, (TICKS + 50, 0))


def test_incomparable_runs_are_rejected():
    with pytest.raises(RecordError, match=r"2 lanes at .*, and 1 at"):
        judge(build(), build(lanes=1), {})
    with pytest.raises(ParameterError, match=r"channel is 'speed': it must be a channel of both"):
        judge(build(), build(), {"speed": Tolerance()})


def run(*arguments):
    return CliRunner().invoke(app, ["compare", *map(str, arguments)], catch_exceptions=False)


def test_exit_code_of_the_command_reports_the_match(tmp_path):
    for run_id, offset in (("a", 0.0), ("b", 0.5)):
        samples = build_samples(TICKS)
        samples[:, :, CHANNEL_INDEX[ERROR]] = 1.0 + offset
        write_record(tmp_path / run_id, build_header(run_id), [], 0, samples)
    a, b = tmp_path / "a", tmp_path / "b"
    assert run(a, a).exit_code == 0
    outcome = run(b, a, "--channel", ERROR, "--json")
    assert outcome.exit_code == 1
    reported = json.loads(outcome.stdout)
    assert [one["excess"] for one in reported["channels"]] == [0.5, 0.5]
    file = tmp_path / "tolerances.toml"
    file.write_text(f"[{ERROR}]\nabsolute = 0.6\n")
    assert run(b, a, "--tolerances", file).exit_code == 0
    file.write_text(f"{TORQUE} = 3\n[{ERROR}]\nabsolute = -1\n")
    refused = run(b, a, "--tolerances", file)
    assert refused.exit_code == 2
    reported = " ".join(refused.stderr.split())
    assert ", lines 1 and 3: torque1_nm is 3" in reported, (
        "after the file, which may be cut anywhere"
    )
    assert "position_error_rad.absolute is -1" in reported
    assert run(b, tmp_path / "nothing").exit_code == 2


def test_command_first_reports_different_durations(tmp_path):
    for run_id, ticks in (("a", TICKS), ("b", TICKS - 50)):
        write_record(tmp_path / run_id, build_header(run_id), [], 0, build_samples(ticks))
    outcome = run(tmp_path / "b", tmp_path / "a")
    assert outcome.exit_code == 1
    reported = " ".join(outcome.stdout.split())
    assert reported.endswith("Not held: not as long: 150 and 200 ticks. All held over 150 ticks.")
