"""A simulated result is saved, opened, exported and compared like a recorded run."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import scipy.io

import svsa
from svsa.actuators.signals import CHANNELS
from svsa.errors import Fault
from svsa.runs.records.header import RecordError
from svsa.runs.records.reader import open_record
from tests.runs.session.sessions import build_configuration

TICKS = 400


def simulate(**changes: object) -> svsa.Result:
    return svsa.simulate(
        build_configuration(comparisons=(svsa.Lane(law="fl"),), **changes),
        duration_s=0.4,
        commands=[svsa.Change(at_s=0.1, law="fl"), svsa.Change(at_s=0.2, load=svsa.PaperLoad())],
    )


@pytest.fixture(scope="module")
def result() -> svsa.Result:
    return simulate()


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SVSA_DATA", str(tmp_path / "data"))
    return tmp_path / "data"


def hold(time_s, reference, x, w):
    return 8.0 * (reference.q - x.theta1) - 0.4 * x.dtheta1, -40.0 * x.theta2 - 0.8 * x.dtheta2


def expect_same(opened: svsa.Result, result: svsa.Result) -> None:
    for one, other in zip(
        (opened, *opened.comparisons), (result, *result.comparisons), strict=True
    ):
        np.testing.assert_array_equal(one.samples, other.samples)
        assert (one.law, one.commands) == (other.law, other.commands)
    assert (opened.fault, opened.plant, opened.steps) == (result.fault, result.plant, result.steps)


def test_saved_result_opens_unchanged_and_is_resimulated(
    result: svsa.Result, tmp_path: Path
) -> None:
    folder = svsa.save_run(result, tmp_path / "mine", name="Mine", tags=("a",), notes="Why")
    opened = svsa.open_run(folder)
    expect_same(opened, result)
    assert opened.configuration == result.configuration
    header = open_record(folder).header
    assert (header.run_id, header.name, header.tags, header.notes) == (
        "mine",
        "Mine",
        ("a",),
        "Why",
    )
    assert svsa.resimulate(folder) == svsa.resimulate(result)
    assert svsa.resimulate(folder).identical
    with pytest.raises(RecordError, match="There is a record mine already"):
        svsa.save_run(result, folder)


def test_default_folder_is_that_of_the_runs_of_this_machine(
    result: svsa.Result, data: Path
) -> None:
    folder = svsa.save_run(result, name="Mine")
    (run,) = svsa.list_runs().runs
    assert folder == data / "runs" / run.id
    assert (run.name, run.session, run.state, run.ticks) == ("Mine", "script", "complete", TICKS)
    assert run.metrics is not None
    expect_same(svsa.open_run(run.id), result)


@pytest.mark.parametrize("kind", ["csv", "parquet", "mat", "mcap", "html"])
def test_result_is_exported_as_its_record(result: svsa.Result, tmp_path: Path, kind: str) -> None:
    svsa.export_run(result, kind, tmp_path / "result")
    assert (tmp_path / "result").stat().st_size > 10_000


def test_export_contains_the_samples(result: svsa.Result, tmp_path: Path) -> None:
    svsa.export_run(result, "mat", tmp_path / "run.mat")
    read = scipy.io.loadmat(tmp_path / "run.mat", simplify_cells=True)
    np.testing.assert_array_equal(read["lane2"]["torque1_nm"], result.comparisons[0].torque1_nm)
    with pytest.raises(svsa.ParameterError, match="one of csv, parquet, mat, mcap, html"):
        svsa.export_run(result, "xls", tmp_path / "run.xls")


def test_result_is_compared_within_tolerances(result: svsa.Result, tmp_path: Path) -> None:
    folder = svsa.save_run(result, tmp_path / "mine")
    assert svsa.compare_runs(folder, result).held
    other = simulate(observer=svsa.ObserverBandwidth(bandwidth_rad_per_s=(50.0,) * 3))
    assert not svsa.compare_runs(other, folder).held
    verdict = svsa.compare_runs(other, folder, channels=["position_rad"], absolute=1.0)
    assert verdict.held
    assert {one.channel for one in verdict.channels} == {"position_rad"}
    exact = {"position_rad": svsa.Tolerance()}
    assert not svsa.compare_runs(other, folder, absolute=1e3, tolerances=exact).held


def test_fault_is_saved(result: svsa.Result, tmp_path: Path) -> None:
    fault = Fault("position", 0, TICKS, 0.4, "q is beyond its limit.")
    ended = dataclasses.replace(result, fault=fault)
    assert svsa.open_run(svsa.save_run(ended, tmp_path / "mine")).fault == fault


def test_run_of_a_function_is_not_resimulated_and_states_it(tmp_path: Path) -> None:
    result = svsa.simulate("4a", hold, duration_s=0.05)
    opened = svsa.open_run(svsa.save_run(result, tmp_path / "mine"))
    expect_same(opened, result)
    assert repr(opened).startswith("mine: own controller, 0.05 s")
    with pytest.raises(RecordError, match="controlled by a function of a script"):
        svsa.resimulate(result)


def test_run_with_finer_integration_is_not_resimulated(tmp_path: Path) -> None:
    result = svsa.simulate("4a", duration_s=0.05, steps=4)
    expect_same(svsa.open_run(svsa.save_run(result, tmp_path / "mine")), result)
    with pytest.raises(RecordError, match="integrated with 4 steps"):
        svsa.resimulate(result)


def test_joint_of_an_arm_is_not_saved_alone(tmp_path: Path) -> None:
    """Without the other joint it would not be reproduced."""
    arm = svsa.simulate_arm(duration_s=0.05)
    with pytest.raises(svsa.StateError, match="one joint of an arm"):
        svsa.save_run(arm.joints[0], tmp_path / "mine")
    svsa.save_run(arm, tmp_path / "mine")


def test_one_arm_of_two_is_not_saved_alone(tmp_path: Path) -> None:
    """Its record would contain the law of the first arm and the samples of the second one."""
    arm = svsa.simulate_arm(comparisons="fl", duration_s=0.05)
    for one in (arm.comparisons[0], dataclasses.replace(arm, comparisons=())):
        with pytest.raises(svsa.StateError, match="one arm of a run"):
            svsa.save_run(one, tmp_path / "mine")
    svsa.save_run(arm, tmp_path / "mine")


def test_incomplete_run_is_not_saved(result: svsa.Result, tmp_path: Path) -> None:
    with pytest.raises(svsa.StateError, match="one lane of a run"):
        svsa.save_run(result.comparisons[0], tmp_path / "mine")
    empty = svsa.Result(build_configuration(), np.empty((0, len(CHANNELS))))
    with pytest.raises(svsa.StateError, match="no samples"):
        svsa.save_run(empty, tmp_path / "mine")
