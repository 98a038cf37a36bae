"""References with a start and an end: steps, minimum jerk, chirp, series."""

import math

import numpy as np
import pytest

import svsa
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES, compute_start_value, get_range
from svsa.simulation.reference.kinds.reference import AnyPosition
from svsa.simulation.reference.kinds.series import MAX_ROWS
from svsa.simulation.reference.preview import sample_reference
from svsa.simulation.reference.series_csv import parse_series
from svsa.simulation.reference.transition import (
    Stack,
    build_stack,
    compute_trajectory,
    push_trajectory,
)
from tests.actuators.prototype import differentiate

TIMES = np.linspace(0.0, 4.0, 81)
OMEGA = 0.75 * math.pi
SERIES = svsa.SeriesPosition(
    time_s=tuple(TIMES.tolist()), position_rad=tuple((0.4 * np.sin(OMEGA * TIMES) ** 4).tolist())
)
STEPS = svsa.StepsPosition(time_s=(0.0, 1.0, 2.0), position_rad=(0.1, 0.5, -0.3), rise_s=0.5)
JERK = svsa.MinimumJerkPosition(start_rad=0.1, end_rad=0.9, duration_s=1.5)
CHIRP = svsa.ChirpPosition(
    offset_rad=0.1, amplitude_rad=0.3, start_hz=0.2, end_hz=2.0, duration_s=5.0, taper_s=0.5
)
ALL = {"series": SERIES, "steps": STEPS, "minimum jerk": JERK, "chirp": CHIRP}


def follow(stack, times):
    return np.array([compute_trajectory(stack, float(t)) for t in times])


@pytest.mark.parametrize("reference", ALL.values(), ids=ALL)
def test_each_derivative_is_the_derivative_of_the_previous_one(reference):
    stack = build_stack(reference)
    inside = np.arange(0.0137, 4.9, 0.0411)
    scale = np.abs(follow(stack, inside)).max(axis=0)
    edges = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 4.0, 4.5, *TIMES]
    for t in inside:
        if min(abs(t - edge) for edge in edges) < 2e-3:
            continue
        slopes = differentiate(lambda s: np.array(compute_trajectory(stack, s)), t, 2e-4)[:4]
        found = np.array(compute_trajectory(stack, t))[1:]
        assert np.all(np.abs(slopes - found) <= 2e-6 * scale[1:]), t


@pytest.mark.parametrize(
    ("reference", "continuous"), [(SERIES, 4), (STEPS, 5), (JERK, 3), (CHIRP, 5)], ids=ALL
)
def test_number_of_continuous_derivatives_is_as_documented(reference, continuous):
    """Also at the start and the end; the jerk of minimum jerk jumps by 60 Δ/T³."""
    stack = build_stack(reference)
    scale = np.abs(follow(stack, np.linspace(0.0, 5.0, 1001))).max(axis=0)
    for edge in (0.0, 1.0, 1.5, 2.5, 4.0, 5.0):
        left, right = follow(stack, (edge - 1e-7, edge + 1e-7))
        assert np.all(np.abs(right - left)[:continuous] <= 1e-4 * scale[:continuous]), edge
    if reference is JERK:
        jump = follow(stack, (1e-9,))[0, 3] - follow(stack, (-1e-9,))[0, 3]
        assert jump == pytest.approx(60.0 * 0.8 / 1.5**3, rel=1e-6)


def compute_sine_to_the_fourth(times):
    """0.4 sin⁴(ωt) = 0.05 (3 − 4 cos 2ωt + cos 4ωt) and four derivatives, (times, 5)."""
    orders = np.arange(5)
    angle = OMEGA * times[:, None]
    slow = (2.0 * OMEGA) ** orders * np.cos(2.0 * angle + orders * math.pi / 2.0)
    fast = (4.0 * OMEGA) ** orders * np.cos(4.0 * angle + orders * math.pi / 2.0)
    return 0.05 * (3.0 * (orders == 0) - 4.0 * slow + fast)


def test_series_interpolates_its_points_with_the_derivatives_of_the_sampled_function():
    """The spline of degree 7 approximates all four from the values alone, up to its ends."""
    stack = build_stack(SERIES)
    np.testing.assert_allclose(follow(stack, TIMES)[:, 0], SERIES.position_rad, atol=1e-12)
    between = np.linspace(0.0, 4.0, 777)[1:-1]
    true = compute_sine_to_the_fourth(between)
    error = np.abs(follow(stack, between) - true).max(axis=0) / np.abs(true).max(axis=0)
    assert np.all(error <= [1e-7, 1e-6, 1e-5, 2e-4, 5e-3]), error


@pytest.mark.parametrize("reference", ALL.values(), ids=ALL)
def test_series_is_constant_outside_its_points_and_starts_after_the_fade(reference):
    """A run that changes to it follows all of it, from its first value on."""
    old = build_stack(svsa.ConstantPosition(position_rad=-0.2))
    changed = reference.changed(transition_s=0.8)
    stack, alone = push_trajectory(old, changed, 10.0), build_stack(reference)
    later = np.linspace(0.003, 6.2, 300)
    shifted = follow(stack, 10.8 + later)
    np.testing.assert_allclose(shifted, follow(alone, later), rtol=1e-9, atol=1e-7)
    assert follow(alone, (-3.0,))[0].tolist() == [compute_start_value(reference), 0, 0, 0, 0]
    last = follow(alone, (50.0, 5000.0))
    assert np.all(last[:, 1:] == 0.0)
    assert last[0, 0] == last[1, 0]
    low, high = get_range(reference)
    seen = follow(alone, np.linspace(0.0, 6.0, 999))[:, 0]
    assert low - 1e-4 <= seen.min() <= low + 0.02
    assert high - 0.02 <= seen.max() <= high + 1e-4


def test_finished_curves_are_removed_and_running_ones_keep_their_points():
    """The memory of a session does not grow with the number of its series."""
    stack: Stack = build_stack(SERIES)
    for number in range(5):
        reference = (STEPS, SERIES)[number % 2].changed(transition_s=0.5)
        stack = push_trajectory(stack, reference, 10.0 * (number + 1))
    assert len(stack.rows) == 2
    assert len(stack.breaks) == len(stack.coefficients) == len(TIMES) + 5
    expected = follow(build_stack(STEPS), np.linspace(0.0, 3.0, 50))
    found = follow(stack, np.linspace(50.5, 53.5, 50))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-7)


def write(values, name="position_rad", times=None):
    times = times or [0.1 * number for number in range(len(values))]
    return f"time_s,{name}\n" + "\n".join(f"{t},{v}" for t, v in zip(times, values, strict=True))


def test_csv_in_degrees_is_the_series_in_radians():
    """With a byte order mark, spaces, and an empty line, as spreadsheets write it."""
    degrees = parse_series("\ufeff time_s , position_deg\r\n0,0\r\n0.5, 30\r\n\r\n1,-30\r\n")
    assert isinstance(degrees, svsa.SeriesPosition)
    assert degrees.position_rad == pytest.approx((0.0, math.pi / 6, -math.pi / 6))
    assert parse_series(write([15.0, 20.0], "stiffness_nm_per_rad")).kind == "series"


BAD = {
    "no head": ("0,1\n1,2", ["head of the CSV", "time_s and one of position_rad"]),
    "unit unknown": ("time_s,position\n0,1\n1,2", ["position_deg"]),
    "nothing": ("", ["head of the CSV"]),
    "one row": (write([1.0]), ["number of rows is 1", "from 2 to 2000"]),
    "too many": (write([0.0] * (MAX_ROWS + 1)), ["2001", "from 2 to 2000"]),
    "no number": (write([0.0, "fast", 1.0]), ["position_rad in row 3 is 'fast'", "finite"]),
    "NaN": (write([0.0, 1.0, "nan"]), ["position_rad in row 4 is 'nan'", "finite number"]),
    "semicolons": ("time_s;position_deg\n0;0\n0,5;30", ["head", "separated by a comma"]),
    "decimal commas": ("time_s,position_deg\n0,0\n0,5,30", ["row 3 is '0,5,30'", "decimal point"]),
    "a quoted comma": (
        'time_s,position_deg\n0,0\n1,"1,5"',
        ["row 3 is '1,5'", "decimal point"],
    ),
    "digit groups": ("time_s,position_deg\n0,0\n1,1_0", ["row 3 is '1_0'", "decimal point"]),
    "a cell too many": ("time_s,position_rad\n0,1\n1,2,3", ["row 3", "two cells"]),
    "time goes back": (
        write([0.0, 0.1, 0.2], times=[0.0, 0.5, 0.4]),
        ["time_s in row 4 is 0.4 s", "at least 0.001 s after the one before, 0.5 s"],
    ),
    "an empty line before": (
        "time_s,position_rad\n0,0\n\n1,0\n0.5,0",
        ["time_s in row 5 is 0.5 s"],
    ),
    "before zero": (write([0.0, 0.1], times=[-1.0, 0.5]), ["row 2 is -1.0 s", "at least 0 s"]),
    "in the unit that was typed": (
        write([0.0, 9999.0], "position_deg"),
        ["position_deg in row 3 is 9999.0 deg", "from -360 to 360 deg"],
    ),
    "too fast": (
        write([0.0, 0.0, 90.0, 0.0, 0.0], "position_deg", [0.0, 0.01, 0.02, 0.03, 0.04]),
        ["of position_deg at 0.0", "deg/s", "at most"],
    ),
    "no stiffness": (write([15.0, 0.0], "stiffness_nm_per_rad"), ["row 3", "N·m/rad"]),
}


@pytest.mark.parametrize(("text", "words"), BAD.values(), ids=BAD)
def test_invalid_csv_is_rejected_with_row_value_unit_and_bound(text, words):
    with pytest.raises(svsa.ParameterError) as refused:
        parse_series(text)
    for word in words:
        assert word in str(refused.value)


def test_csv_with_any_line_ending_is_read():
    rows = ["time_s,position_deg", "0,0", "0.5,30"]
    assert parse_series("\r".join(rows)) == parse_series("\r\n".join(rows))


@pytest.mark.parametrize("text", ["a" * 140_000, "time_s,position_deg\n0," + "1" * 140_000])
def test_other_file_is_rejected_with_reason(text):
    with pytest.raises(svsa.ParameterError, match=r"the CSV: field larger than .* in row"):
        parse_series(text)


@pytest.mark.parametrize("frequency_hz", [5e-324, 1e-300, 1e-9, 0.0])
def test_preview_of_a_slow_sine_is_finite(frequency_hz):
    slow = svsa.SineStiffness(
        offset_nm_per_rad=20.0, amplitude_nm_per_rad=2.0, frequency_hz=frequency_hz
    )
    times, values = sample_reference(slow)
    assert np.all(np.isfinite(times))
    assert np.all(np.isfinite(values))
    assert 0.0 < times[-1] <= 1e6


def test_invalid_reference_is_rejected_by_name():
    with pytest.raises(svsa.ParameterError, match=r"time_s\[1\] is 0\.05 s.*0\.2 s \(rise_s\)"):
        svsa.StepsPosition(time_s=(0.0, 0.05), position_rad=(0.0, 1.0))
    with pytest.raises(svsa.ParameterError, match=r"position_rad is 3 points.*2 points"):
        svsa.SeriesPosition(time_s=(0.0, 1.0), position_rad=(0.0, 1.0, 2.0))
    with pytest.raises(svsa.ParameterError, match=r"taper_s is 3\.0 s: .*half of duration_s"):
        CHIRP.changed(taper_s=3.0)
    with pytest.raises(svsa.ParameterError, match="velocity of the movement"):
        svsa.MinimumJerkPosition(start_rad=-6.0, end_rad=6.0, duration_s=0.05)


def test_stiffness_between_points_stays_in_the_range_or_is_rejected():
    """The spline may overshoot its points: its extreme values are checked."""
    wild = parse_series(write([2.0, 2.0, 140.0, 2.0, 2.0], "stiffness_nm_per_rad"))
    assert get_range(wild)[0] < 1.7
    with pytest.raises(svsa.ParameterError, match=r"from 1\.7 to 150\.56 N·m/rad"):
        svsa.simulate("4a", stiffness=wild)


def test_laws_follow_each_kind_of_reference():
    """All four derivatives are right: with an exact model no error remains."""
    exact = svsa.load_prototype().actuator
    for reference in (SERIES, STEPS, CHIRP):
        result = svsa.simulate(
            "4b", "fl", position=reference, nominal=exact, loads=(), duration_s=4.0
        )
        assert result.fault is None
        after_the_start = np.abs(result.position_error_rad[900:])
        assert after_the_start.max() < 2e-4, reference.kind


def test_stiffness_series_changes_the_stiffness():
    ramp = svsa.SeriesStiffness(time_s=(0.0, 1.0, 2.0), stiffness_nm_per_rad=(20.0, 40.0, 30.0))
    result = svsa.simulate("4a", stiffness=ramp, loads=(), duration_s=2.5)
    assert result.fault is None
    assert result.stiffness_nm_per_rad[[0, 1000, 2200]] == pytest.approx(
        [20.0, 40.0, 30.0], abs=0.2
    )


def test_steps_between_the_limits_are_in_the_range():
    """Rounding between two levels does not exceed them."""
    steps = svsa.StepsStiffness(time_s=(0.0, 0.3, 0.7), stiffness_nm_per_rad=(1.7, 150.56, 1.7))
    assert get_range(steps) == (1.7, 150.56)
    svsa.load_prototype().limits.check_stiffness("stiffness", *get_range(steps))


def test_steps_of_one_level_are_constant():
    assert get_range(svsa.StepsStiffness(time_s=(0.0,), stiffness_nm_per_rad=(20.0,))) == (20, 20)
    stack = build_stack(svsa.StepsPosition(time_s=(1.0,), position_rad=(0.3,)))
    assert follow(stack, (0.0, 2.0))[:, 0].tolist() == [0.3, 0.3]


@pytest.mark.parametrize("kind", (*POSITIONS, *STIFFNESSES), ids=lambda kind: kind.__name__)
def test_each_kind_of_reference_describes_itself_and_runs_with_its_defaults(kind):
    assert getattr(svsa, kind.__name__) is kind
    words = kind.model_fields["kind"].default.split("_")
    suffix = "Position" if issubclass(kind, AnyPosition) else "Stiffness"
    assert kind.__name__ == "".join(word.capitalize() for word in words) + suffix
    if kind.first is not None:
        reference = kind(**kind.first)
        assert reference.describe()
        assert kind.hint
        times, values = sample_reference(reference)
        assert times[-1] == reference.get_shape().duration
        low, high = reference.get_shape().range
        assert low < high
        assert np.all((values[:, 0] >= low - 1e-9) & (values[:, 0] <= high + 1e-9))
