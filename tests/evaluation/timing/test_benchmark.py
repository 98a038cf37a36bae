"""`svsa benchmark`: a C loop that does the same work, and the reported figures."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import svsa
from svsa.actuators.installed import list_mechanism_names
from svsa.actuators.signals import CHANNEL_INDEX, TORQUES
from svsa.cli import app
from svsa.evaluation.timing import batch_rates, bench_tick, benchmark, scipy_comparison
from svsa.runs.execution.run import Run
from tests.exhaustive import exhaust

RUNNER = CliRunner()
TICKS = 8000


@pytest.fixture(scope="module")
def c_loop(tmp_path_factory: pytest.TempPathFactory) -> benchmark.CLoop:
    if shutil.which("cc") is None:
        pytest.skip("no C compiler on this machine")
    loop = benchmark.build_c_loop(tmp_path_factory.mktemp("c"))
    assert loop is not None
    return loop


@pytest.fixture(scope="module")
def loop_samples() -> np.ndarray:
    return svsa.simulate(benchmark.FIGURE, benchmark.LAW, duration_s=TICKS * 0.001).samples


def test_c_loop_computes_every_channel_of_the_same_run(
    c_loop: benchmark.CLoop, loop_samples: np.ndarray
) -> None:
    run = Run(benchmark.get_figure(benchmark.FIGURE).build_configuration(benchmark.LAW))
    samples = np.full((TICKS, len(c_loop.channels)), np.nan)
    assert benchmark.run_c(c_loop, run, samples) == TICKS
    columns = [CHANNEL_INDEX[name] for name in c_loop.channels]
    assert_allclose(samples, loop_samples[:, columns], rtol=1e-10, atol=1e-11)


def test_lanes_of_the_c_loop_are_equal(c_loop: benchmark.CLoop, loop_samples: np.ndarray) -> None:
    run = Run(benchmark.get_figure(benchmark.FIGURE).build_configuration(benchmark.LAW))
    squares, peaks = benchmark.run_c_lanes(c_loop, run, TICKS)
    error = loop_samples[:, CHANNEL_INDEX["position_error_rad"]]
    assert_allclose(squares, np.sum(error**2), rtol=1e-9)
    assert_allclose(peaks, np.abs(error).max(), rtol=1e-9)


@pytest.mark.exhaustive
def test_command_prints_costs_and_ratios_to_c(c_loop: benchmark.CLoop) -> None:
    answer = RUNNER.invoke(app, ["benchmark", "--json", "--repeats", "3", "--no-start"])
    assert answer.exit_code == 0, answer.output
    costs = json.loads(answer.stdout)
    numbers = (
        "ratio_to_c",
        "kernel_ratio_to_c",
        "arm_ratio_to_kernel",
        "batch_ratio_to_c",
        "single_run_realtime_factor",
        "batch_runs_per_second_1_core",
        "bench_tick_cpu_us",
        "two_cores_over_one",
    )
    assert all(costs[name] > 0.0 for name in numbers)
    ratios = costs["actuator_ratio_to_kernel"]
    assert list(ratios) == [name for name in list_mechanism_names() if name != "svsa"]
    assert all(0.0 < ratio < 2.0 for ratio in ratios.values())  # 1.25 or less on quiet cores
    assert costs["solvers"]["svsa"]["ratio"] == 1.0
    assert costs["solvers"]["scipy"]["ratio"] > 1.0
    rates = costs["runs_per_second_1_core_by_effects"]
    assert list(rates) == list(batch_rates.SWITCHED)
    assert rates["ideal"] > rates["every"] > 0.0


def test_run_that_ends_in_a_fault_counts_its_executed_part(monkeypatch) -> None:
    """Otherwise an early fault would increase the reported rate."""
    monkeypatch.setattr(
        batch_rates, "measure_in_turns", lambda works, repeats: dict.fromkeys(works, 1.0)
    )
    monkeypatch.setattr(batch_rates, "SWITCHED", {"ideal": svsa.IDEAL})
    figure = benchmark.get_figure("4a").build_configuration("ndobc")
    load = svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.5)
    rates = batch_rates.measure_effects(figure.changed(loads=(load,)), 8, 2.0, 1)
    assert 0.25 * 8 < rates["ideal"] < 0.4 * 8
    assert batch_rates.measure_effects(figure, 8, 2.0, 1)["ideal"] == 8.0


@pytest.mark.exhaustive
def test_ratios_without_the_c_loop_are_unknown_with_a_reason(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """As in an installed package, which has no tests."""
    monkeypatch.setattr(benchmark, "C_LOOP", tmp_path / "loop.c")
    one = {"ideal": svsa.IDEAL}
    monkeypatch.setattr(batch_rates, "SWITCHED", one)  # Each is compiled, which is not tested here.
    monkeypatch.setattr(scipy_comparison, "METHODS", ())
    answer = RUNNER.invoke(app, ["benchmark", "--json", "--repeats", "1", "--no-start"])
    costs = json.loads(answer.stdout)
    assert costs["ratio_to_c"] is None
    assert costs["batch_ratio_to_c"] is None
    assert costs["batch_runs_per_second_1_core"] > 0.0
    assert "tests/benchmarks/loop.c" in answer.stderr


@pytest.mark.parametrize("law", exhaust(["ndobc", "nmpc"], ["ndobc"]))
def test_reported_outcome_is_that_of_the_timed_ticks(law: str) -> None:
    """So that the timed ticks are those of a working law."""
    samples = svsa.simulate("4a", law, duration_s=6.0).samples
    run = Run(benchmark.get_figure("4a").build_configuration(law))
    ticks, limits = bench_tick.BenchTicks(run, samples), [15.0, 5.0]
    assert limits == [run.blocks[0].torque1_max, run.blocks[0].torque2_max]
    asked = np.empty((len(samples), 2))
    for tick in range(len(samples)):
        assert ticks.run_tick(tick) > 0.0
        asked[tick] = ticks.limited
    assert_allclose(np.clip(asked, np.negative(limits), limits), samples[:, TORQUES], atol=1e-9)


def test_command_prints_the_ticks_of_every_law(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bench_tick, "list_law_names", lambda: ("ndobc", "ilc"))
    answer = RUNNER.invoke(app, ["benchmark", "--laws", "--json", "--repeats", "1"])
    assert answer.exit_code == 0, answer.output
    costs = json.loads(answer.stdout)
    assert list(costs) == ["ndobc", "ilc"]
    for cost in costs.values():
        assert 0.0 < cost["loop_us"] < cost["worst_us"]
        assert cost["median_us"] <= cost["worst_us"]
    assert "ilc" in RUNNER.invoke(app, ["benchmark", "--laws", "--repeats", "1"]).stdout
