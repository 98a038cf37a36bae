"""`simulate` and its result: units, exports, rejections, and the samples of tick-by-tick calls."""

import copy
import pickle

import numpy as np
import pandas
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_NAMES, CHANNELS
from svsa.runs.definition.command import Set
from svsa.runs.execution.run import Run


@pytest.fixture(scope="module")
def result():
    return svsa.simulate("5", "ndobc", duration_s=0.5)


def test_result_has_every_channel_as_an_attribute_with_its_unit(result):
    assert result.samples.shape == (500, len(CHANNELS))
    assert result.units["stiffness_nm_per_rad"] == "N·m/rad"
    assert set(result.units) == set(CHANNEL_NAMES)
    for index, name in enumerate(CHANNEL_NAMES):
        np.testing.assert_array_equal(getattr(result, name), result.samples[:, index])
    with pytest.raises(AttributeError, match="no channel 'speed'; there are time_s"):
        _ = result.speed


def test_dependent_channels_agree(result):
    """The columns are in the order of their names: no two are exchanged."""
    r = result
    np.testing.assert_allclose(r.time_s, np.arange(500) * 0.001, atol=1e-12)
    np.testing.assert_array_equal(r.position_error_rad, r.position_reference_rad - r.position_rad)
    np.testing.assert_array_equal(
        r.stiffness_error_nm_per_rad, r.stiffness_reference_nm_per_rad - r.stiffness_nm_per_rad
    )
    np.testing.assert_array_equal(r.deflection_rad, r.position_rad - r.motor1_position_rad)
    lever = r.lever_ratio[0] + r.motor2_position_rad / (2.0 * np.pi)
    np.testing.assert_allclose(r.lever_ratio, lever, rtol=1e-14)
    for angle in ("position", "motor1_position", "motor2_position"):
        rate = np.gradient(getattr(r, f"{angle}_rad"), 0.001)[5:-5]
        name = angle.replace("_position", "_velocity").replace("position", "velocity")
        velocity = getattr(r, f"{name}_rad_per_s")[5:-5]
        assert np.abs(rate - velocity).max() < 0.02 * np.abs(velocity).max(), angle


def test_result_can_be_copied_and_pickled(result):
    """Its attribute look-up must not recurse on an uninitialized object."""
    for twin in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):  # noqa: S301
        np.testing.assert_array_equal(twin.samples, result.samples)
        assert twin.configuration == result.configuration


def test_dataframe_has_a_column_per_channel(result):
    frame = result.to_dataframe()
    assert list(frame.columns) == list(CHANNEL_NAMES)
    np.testing.assert_array_equal(frame.to_numpy(), result.samples)
    assert frame.attrs["units"]["torque1_nm"] == "N·m"


def test_dataset_has_units_and_is_unchanged_by_a_file(result, tmp_path):
    data = result.to_xarray()
    assert data.torque1_nm.attrs["units"] == "N·m"
    assert data.time_s.attrs["units"] == "s"
    assert (
        svsa.runs.definition.configuration.Configuration.model_validate_json(
            data.attrs["configuration"]
        )
        == result.configuration
    )
    for name, values in data.variables.items():
        np.testing.assert_array_equal(values, getattr(result, name))
    late = data.sel(time_s=slice(0.01, None))
    assert late.sizes["time_s"] == len(result.samples) - 10


def test_csv_names_each_column_with_its_unit_and_is_read_back(result, tmp_path):
    path = tmp_path / "run.csv"
    result.to_csv(path)
    frame = pandas.read_csv(path)
    assert list(frame.columns) == [f"{channel.name} [{channel.unit}]" for channel in CHANNELS]
    np.testing.assert_allclose(frame.to_numpy(), result.samples, rtol=1e-8, atol=1e-30)


def test_plot_is_a_figure_with_labelled_axes(result):
    picture = result.plot()
    labels = [axes.get_ylabel() for axes in picture.axes]
    assert len(labels) == 5
    assert all("[" in label for label in labels), "every axis says its unit"
    assert all(axes.lines for axes in picture.axes)


def test_metrics_are_those_of_the_samples(result):
    rms = np.sqrt(np.mean(result.position_error_rad**2))
    assert result.metrics.rms_position_error_rad == pytest.approx(rms, rel=1e-12)
    part = result.measure(0.1, 0.3)
    assert part.duration_s == pytest.approx(0.2)
    peak = np.abs(result.torque1_nm[100:300]).max()
    assert part.peak_torque1_nm == peak


@pytest.mark.parametrize(
    "stretch",
    [(0.4, 0.4), (0.4, 0.3), (-0.1, 0.3), (0.6, 0.9), (float("nan"), 0.3), (0.1, float("inf"))],
)
def test_empty_interval_is_rejected(result, stretch):
    with pytest.raises(svsa.ParameterError, match=r"start_s|end_s"):
        result.measure(*stretch)


@pytest.mark.parametrize("figure", ["4c", "", None, 8])
def test_unknown_figure_is_rejected_with_the_known_ones(figure):
    with pytest.raises(svsa.ParameterError, match=r"figure .* one of 4a, 4b, 5"):
        svsa.simulate(figure)


def test_bench_figure_is_not_simulated_as_an_ideal_plant():
    with pytest.raises(svsa.ParameterError, match=r'"6b".*"4b", effects=svsa.RIG'):
        svsa.simulate("6B")


@pytest.mark.parametrize("duration", [0.0, -1.0, 1e-9, 1e9, float("nan"), float("inf"), "20", None])
def test_invalid_duration_is_rejected(duration):
    with pytest.raises(svsa.ParameterError, match="duration_s"):
        svsa.simulate("4a", duration_s=duration)


@pytest.mark.parametrize("steps", [0, -1, 1001, 1.5, "4"])
def test_invalid_number_of_steps_is_rejected(steps):
    with pytest.raises(svsa.ParameterError, match="steps"):
        svsa.simulate("4a", duration_s=0.01, steps=steps)


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        ({"law": "no_law"}, "law"),
        ({"observer": {"bandwidth_rad_per_s": (60.0, float("nan"), 60.0)}}, "bandwidth_rad_per_s"),
        ({"sampling": {"period_s": "fast"}}, "period_s"),
        ({"sampling": {"period_s": 1.0}}, "period_s"),
        ({"loads": (svsa.PaperLoad(),) * 17}, "loads"),
        ({"position": {"kind": "square"}}, "kind"),
        ({"friction": 1.0}, "friction"),
    ],
)
def test_invalid_change_is_rejected_by_name(changes, name):
    with pytest.raises(svsa.ParameterError, match=name):
        svsa.simulate("4a", duration_s=0.01, **changes)


def test_run_that_faults_immediately_returns_a_result():
    """With plant limits of a user: a deflection limit too narrow for the initial motion."""
    limits = svsa.load_prototype().limits.changed(deflection_max_rad=1e-4)
    ended = svsa.simulate("4a", duration_s=1.0, limits=limits)
    assert ended.fault is not None
    assert ended.fault.code == "deflection_limit"
    assert ended.plot().axes


def test_result_without_a_sample_reports_it():
    """A run may fault at its first tick, for example at a bound of the lever ratio."""
    empty = svsa.Result(
        svsa.paper.get_figure("4a").build_configuration(), np.empty((0, len(CHANNELS)))
    )
    with pytest.raises(svsa.SvsaError, match="sample"):
        _ = empty.metrics
    assert len(empty.to_dataframe()) == 0
    assert empty.plot().axes


@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_one_call_equals_tick_by_tick_bit_for_bit(law):
    """No split of a run into calls (wake-ups, steps, load onsets) changes a bit."""
    loads = (svsa.PaperLoad(start_s=0.11), svsa.MassLoad(start_s=0.2))
    whole = svsa.simulate("4b", law, duration_s=0.4, loads=loads).samples
    run = Run(svsa.paper.get_figure("4b").build_configuration(law).changed(loads=loads))
    single = np.empty((1, *whole.shape))
    for row in range(len(whole)):
        assert run.advance(single[:, row : row + 1]) == 1
    np.testing.assert_array_equal(single[0], whole)


def test_same_commands_at_the_same_ticks_give_the_same_samples():
    """A session is a value: configuration and commands determine every bit."""

    def play():
        run = Run(svsa.paper.get_figure("4a").build_configuration("fl"))
        samples = np.empty((1, 600, len(CHANNELS)))
        run.advance(samples[:, :150])
        run.change(Set("law", "ndobc"))
        run.change(Set("position", svsa.ConstantPosition(position_rad=0.2)))
        run.advance(samples[:, 150:300])
        run.add_load(svsa.PulseLoad(torque_nm=(1.0, 0.0, 0.0), duration_s=0.05))
        run.change(Set("gains", svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2)))
        run.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=25.0)))
        run.advance(samples[:, 300:])
        return samples

    np.testing.assert_array_equal(play(), play())


def test_change_takes_effect_at_the_next_tick():
    """Up to the tick of the change both runs are equal; after it they differ."""
    plain = svsa.simulate("4a", "fl", duration_s=0.3).samples
    run = Run(svsa.paper.get_figure("4a").build_configuration("fl"))
    changed = np.empty((1, *plain.shape))
    run.advance(changed[:, :100])
    run.change(Set("nominal", run.configuration.nominal.changed(link_inertia_kg_m2=0.02)))
    run.advance(changed[:, 100:])
    np.testing.assert_array_equal(changed[0, :100], plain[:100])
    assert np.any(changed[0, 100] != plain[100])
