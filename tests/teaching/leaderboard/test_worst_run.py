"""An entry's worst run is replayed bit for bit without running submitted code."""

import numpy as np
import pytest

from svsa.actuators.dynamics import build_actuator
from svsa.control.installed import get_title
from svsa.errors import ParameterError, StateError
from svsa.evaluation.ranking.entry import DECLARED
from svsa.evaluation.ranking.entry import build_entry as build_ranking_entry
from svsa.evaluation.ranking.scenarios import build_fixed_scenarios, find_scenario
from svsa.runs.execution.blocks import compute_start_ratio
from svsa.runs.result.simulate import simulate
from svsa.teaching.grading.law_runs import run_law
from svsa.teaching.isolation import process
from svsa.teaching.isolation.process import LawProcess
from svsa.teaching.leaderboard.board import (
    Board,
    Entry,
    build_entry,
    measure_missing,
    submit,
)
from svsa.teaching.leaderboard.standing import WorstRun
from svsa.teaching.leaderboard.worst_run import replay_worst
from svsa.teaching.submission import digest_law
from tests.teaching.grading.submissions import GOOD
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401
from tests.teaching.leaderboard.test_leaderboard import short_season  # noqa: F401

SINGLE = build_fixed_scenarios()[0].variants[0]
REMOVAL = "load_removal.positive.0"
STOPS = GOOD.replace(
    b"        nonlocal integral\n",
    b"""        nonlocal integral
        if time_s > 2.0:
            raise ValueError("enough")
""",
)


@pytest.mark.exhaustive
@pytest.mark.usefixtures("short_season")
def test_worst_run_of_a_submitted_law_is_the_measured_one(tmp_path, monkeypatch):
    board = Board(tmp_path)
    entry = submit(board, "Ada's", GOOD, author="Ada")
    assert entry is not None
    scenario = find_scenario(entry.standing.worst.scenario)
    configuration = scenario.build_configuration("ndobc")
    model = build_actuator(configuration.nominal, compute_start_ratio(configuration))
    with LawProcess(GOOD, model) as law:
        once = simulate(configuration, law, duration_s=scenario.duration_s)

    monkeypatch.setattr(process.subprocess, "Popen", None)
    scenario, lanes, result, alone = replay_worst(board, entry)
    assert lanes == ("Ada's", "NDOBC, declared gains")
    assert alone == ""
    assert entry.author == "Ada"
    np.testing.assert_array_equal(result.samples, once.samples)
    papers = build_ranking_entry(DECLARED).build_configuration(scenario)
    ndobc = simulate(papers, duration_s=scenario.duration_s)
    np.testing.assert_array_equal(result.comparisons[0].samples, ndobc.samples)
    measured = result.measure(scenario.measured_s, scenario.duration_s).rms_position_error_rad
    assert entry.standing.worst.rms_deg == pytest.approx(np.degrees(measured))


@pytest.mark.usefixtures("short_season")
def test_law_of_the_lab_is_simulated_next_to_ndobc_with_the_declared_gains(tmp_path):
    board = Board(tmp_path)
    measure_missing(board)
    lanes = {one.key: replay_worst(board, one).lanes for one in board.list()}
    assert lanes == {
        "fl": (get_title("fl"), "NDOBC, declared gains"),
        "ndobc": ("NDOBC", "NDOBC, declared gains"),
    }


@pytest.mark.usefixtures("short_season")
def test_run_of_a_law_that_stops_early_is_shown_until_then(tmp_path):
    board, run = Board(tmp_path), run_law(STOPS, SINGLE)
    assert "error" in run.problem
    measure_missing(board)
    worst = WorstRun(scenario=run.scenario, title="", rms_deg=None, problem=run.problem)
    standing = board.get("fl").standing.changed(worst=worst)
    entry = board.keep(build_entry("stops", "Stops", False, standing), run.torques)
    result = replay_worst(board, entry).result
    assert len(result.samples) == 2001
    assert result.fault is None


@pytest.mark.usefixtures("short_season")
def test_run_in_which_ndobc_faults_is_shown_alone_to_its_end(tmp_path):
    board, scenario = Board(tmp_path), find_scenario(REMOVAL)
    measure_missing(board)
    fl, worst = (
        board.get("fl"),
        WorstRun(scenario=REMOVAL, title="", rms_deg=None, problem=""),
    )
    entry = fl.changed(standing=fl.standing.changed(worst=worst))
    own = simulate(
        build_ranking_entry("fl").build_configuration(scenario), duration_s=scenario.duration_s
    )
    shown = replay_worst(board, entry)
    assert shown.lanes == (get_title("fl"),)
    assert "declared gains: At" in shown.alone
    np.testing.assert_array_equal(shown.result.samples, own.samples)
    submitted = build_entry("good", "Good", False, entry.standing)
    run = run_law(GOOD, scenario)
    shown = replay_worst(board, board.keep(submitted, run.torques))
    assert (run.problem, shown.lanes) == ("", ("Good",))
    assert len(shown.result.samples) == round(
        scenario.duration_s / own.configuration.sampling.period_s
    )


@pytest.mark.usefixtures("short_season")
def test_worst_run_reveals_no_hidden_trial(tmp_path):
    """Two seasons with different secrets show the same run: a public one."""
    one, other = Board(tmp_path / "one"), Board(tmp_path / "other")
    assert (one.folder / "secret").read_bytes() != (other.folder / "secret").read_bytes()
    shown = []
    for board in (one, other):
        measure_missing(board)
        entry = board.get("fl")
        scenario, _, result, _ = replay_worst(board, entry)
        assert scenario == SINGLE
        shown.append(result)
    np.testing.assert_array_equal(shown[0].samples, shown[1].samples)
    assert shown[0].configuration == shown[1].configuration


def test_deleted_run_is_reported(tmp_path):
    board = Board(tmp_path)
    entry = Entry.model_construct(key=digest_law(b"old"), name="Old")
    with pytest.raises(StateError, match="are not saved"):
        board.read_torques(entry)
    (board.folder / "torques" / entry.key).write_bytes(b"0123456")
    with pytest.raises(StateError, match="are not saved"):
        board.read_torques(entry)


@pytest.mark.parametrize("key", ["../secret", "secret/", "", "a" * 65, "FL", "none_such"])
def test_entry_is_found_by_its_key_alone(tmp_path, key):
    with pytest.raises(ParameterError, match="key of an entry"):
        Board(tmp_path).get(key)
