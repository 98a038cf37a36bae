"""References with a start, in a session, a record and the loop of the bench."""

import json

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.hardware.realtime.configuration import check_takes_no_time
from svsa.runs.definition.command import build_command, read_command
from svsa.runs.execution.replay import simulate_again
from svsa.simulation.reference.kinds.series import MAX_ROWS

from .sessions import build_configuration, build_session, read_samples

TIMES = [0.01 * number for number in range(60)]
CHANGES = [
    (
        10,
        "position",
        {"kind": "steps", "time_s": [0.0, 0.06], "position_rad": [0.0, 0.02], "rise_s": 0.05},
    ),
    (
        150,
        "position",
        {
            "kind": "series",
            "time_s": TIMES,
            "position_rad": [
                0.02 * (1.0 - np.cos(2.0 * np.pi * time / TIMES[-1])) for time in TIMES
            ],
            "transition_s": 0.05,
        },
    ),
    (
        160,
        "stiffness",
        {
            "kind": "chirp",
            "offset_nm_per_rad": 60.0,
            "amplitude_nm_per_rad": 1.0,
            "start_hz": 0.5,
            "end_hz": 4.0,
            "duration_s": 1.0,
        },
    ),
    (400, "position", {"kind": "minimum_jerk", "end_rad": 0.05, "duration_s": 0.3}),
]


def test_session_with_every_kind_of_reference_is_reproduced_bit_for_bit():
    """From its commands alone, read back from JSON, while earlier references are fading."""
    session = build_session()
    for tick, kind, argument in CHANGES:
        session.step(tick - session.run.tick)
        session.change(build_command(0, kind, argument))
    session.step(300)
    live = read_samples(session)
    written = json.loads(json.dumps([command.to_json() for command in session.journal.commands]))
    again = list(simulate_again(session.journal.initial, map(read_command, written), 0, len(live)))
    np.testing.assert_array_equal(np.concatenate(again, axis=1)[0], live)
    position = live[:, CHANNEL_INDEX["position_reference_rad"]]
    assert np.ptp(position) > 0.03, "it has moved"


def test_longest_permitted_series_runs():
    times = 0.01 * np.arange(MAX_ROWS)
    series = svsa.SeriesPosition(
        time_s=tuple(times.tolist()),
        position_rad=tuple((0.3 * (1.0 - np.cos(0.1 * np.pi * times))).tolist()),
    )
    result = svsa.simulate(build_configuration(position=series), duration_s=19.0)
    assert result.fault is None
    at = np.arange(0, 19_000, 10)
    np.testing.assert_allclose(
        result.position_reference_rad[at], np.array(series.position_rad)[: len(at)], atol=1e-9
    )


def test_longer_series_is_rejected_with_its_bound():
    many = tuple(0.01 * number for number in range(MAX_ROWS + 1))
    with pytest.raises(svsa.ParameterError, match=f"at most {MAX_ROWS}"):
        svsa.SeriesPosition(time_s=many, position_rad=many)


def test_moving_bench_rejects_references_that_would_delay_its_loop():
    times = tuple(0.01 * number for number in range(201))
    series = svsa.SeriesPosition(time_s=times, position_rad=(0.1,) * 201)
    with pytest.raises(svsa.StateError, match=r"201 points.*200 at most: stop it"):
        check_takes_no_time(series)
    check_takes_no_time(series.changed(time_s=times[:200], position_rad=(0.1,) * 200))
    check_takes_no_time(svsa.ConstantPosition())
