"""A law's rank follows from hidden trials, is computed once, and is listed with the lab's laws."""

import json

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.errors import StateError
from svsa.evaluation.metrics import find_held
from svsa.evaluation.ranking.entry import build_entry
from svsa.evaluation.ranking.measure import TrialSet
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.inputs.extras import __version__
from svsa.teaching.grading.law_runs import LawRun, run_installed
from svsa.teaching.isolation import confinement
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa.teaching.leaderboard import board as boards
from svsa.teaching.leaderboard.board import Board, measure_missing, rank_entries, submit
from svsa.teaching.leaderboard.standing import Season, build_season, measure_standing
from tests.teaching.grading.submissions import GOOD, LAZY
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401


def build_short_season(seed):
    whole = build_season(seed)
    return Season(whole.singles[:1], whole.trials[:4])


@pytest.fixture
def short_season(monkeypatch):
    monkeypatch.setattr(boards, "build_season", build_short_season)
    monkeypatch.setattr(boards, "list_law_names", lambda: ("fl", "ndobc"))


def run(*arguments):
    words = ["ranking", *map(str, arguments)]
    return CliRunner().invoke(app, words, catch_exceptions=False, env={"COLUMNS": "200"})


def get_standing(season, go):
    """Return the standing of a law that is not cancelled."""
    found = measure_standing(season, go)
    assert found is not None
    return found.standing


def complete_except(results):
    """Every run is completed with an error of 0.5° except the named ones."""

    def go(scenario):
        return results.get(scenario.name, LawRun(scenario.name, True, 0.5, tick_us=3.0))

    return go


def test_season_has_the_public_scenarios_and_its_own_trials():
    season, other = build_season(5), build_season(6)
    assert season.singles == other.singles
    assert not {one.seed for one in season.trials} & {one.seed for one in other.trials}
    names = [run.name for run in (*season.singles, *season.trials)]
    assert len(set(names)) == len(names) == season.run_count


@pytest.mark.exhaustive
def test_public_seed_gives_the_success_of_the_ranking():
    season = build_season(PUBLIC_SEED)
    season = season._replace(singles=season.singles[:1], trials=season.trials[:16])
    standing = get_standing(season, lambda one: run_installed("fl", one))
    trials = TrialSet(PUBLIC_SEED, 8).run(build_entry("fl"), lambda done: None)
    assert (standing.trials, standing.trials_held) == (16, int(find_held(trials).sum()))
    assert standing.tick_us is not None
    assert standing.tick_us > 0


def test_equal_rates_share_a_place_and_the_next_place_is_skipped():
    shown = get_standing(build_short_season(5), complete_except({}))
    entries = [
        boards.build_entry("fl", "fl", True, shown.changed(success=rate))
        for rate in (0.9, 0.7, 0.7, 0.2)
    ]
    assert rank_entries(entries) == [1, 2, 2, 4]


def test_interval_is_wilsons():
    """Wilson for 100 of 200: 0.431 to 0.569."""
    season = build_season(5)
    failed = {one.name: LawRun(one.name, False, 2.0, tick_us=3.0) for one in season.trials[:100]}
    standing = get_standing(season, complete_except(failed))
    assert standing.success == 0.5
    assert (standing.low, standing.high) == pytest.approx((0.4313, 0.5687), abs=1e-4)
    assert standing.median_rms_deg == 1.25
    assert standing.trials_ended == 0


def test_worst_run_ended_early_or_has_the_largest_error():
    season = build_season(5)
    large, ended = (season.singles[number].name for number in (2, 4))
    found = {large: LawRun(large, False, 9.0, tick_us=3.0)}
    assert get_standing(season, complete_except(found)).worst.rms_deg == 9.0
    found[ended] = LawRun(ended, False, None, "Too far", tick_us=3.0)
    worst = get_standing(season, complete_except(found)).worst
    assert (worst.scenario, worst.rms_deg, worst.problem) == (ended, None, "Too far")


def test_law_that_fails_in_its_first_run_is_rejected_with_its_output():
    season = build_season(5)
    name = season.singles[0].name
    failed = LawRun(name, False, None, "error: it raised", "Traceback\nNameError: spring\n")
    with pytest.raises(
        StateError, match="it raised\nThe law printed:\nTraceback\nNameError: spring"
    ):
        measure_standing(season, complete_except({name: failed}))


def test_cancelled_measurement_has_no_standing_and_reports_its_progress():
    reported = []
    season = build_season(5)
    assert (
        measure_standing(
            season,
            complete_except({}),
            lambda done, total: reported.append((done, total)),
            lambda: len(reported) == 3,
        )
        is None
    )
    assert reported == [(count, season.run_count) for count in (1, 2, 3)]


@pytest.mark.long
@pytest.mark.usefixtures("short_season")
def test_law_is_measured_once_and_listed_with_those_of_the_lab(tmp_path):
    file, folder = tmp_path / "mine.py", tmp_path / "board"
    file.write_bytes(GOOD)
    (first,) = [
        one
        for one in json.loads(run("submit", file, "--board", folder, "--json").stdout)
        if not one["is_installed"]
    ]
    again = run("submit", file, "--name", "Another", "--board", folder, "--json").stdout
    entries = json.loads(again)
    assert first in entries, "measured again, or another name for the same law"
    assert first["name"] == "mine"
    assert {one["key"] for one in entries if one["is_installed"]} == {"fl", "ndobc"}
    rates = [one["standing"]["success"] for one in entries]
    assert rates == sorted(rates, reverse=True)
    assert first["standing"]["trials"] == 4
    assert (folder / "secret").stat().st_mode & 0o077 == 0
    table = run("leaderboard", "--board", folder).stdout
    assert "mine *" in table
    assert "NDOBC" in table


@pytest.mark.usefixtures("short_season")
def test_installed_law_is_measured_again_in_another_version_of_the_lab(tmp_path, monkeypatch):
    board = Board(tmp_path)
    assert measure_missing(board)
    assert board.list_missing() == []
    monkeypatch.setattr(boards, "__version__", __version__ + "+1")
    assert board.list_missing() == ["fl", "ndobc"]
    assert not measure_missing(board, is_cancelled=lambda: True)
    assert board.list() == []


@pytest.mark.usefixtures("short_season")
def test_board_of_an_earlier_suite_is_empty(tmp_path, monkeypatch):
    board = Board(tmp_path)
    measure_missing(board)
    monkeypatch.setattr(boards, "PROTOCOL", "another")
    assert board.list() == []


@pytest.mark.exhaustive
@pytest.mark.usefixtures("short_season")
def test_submission_needs_isolation_and_practice_reports_its_absence(tmp_path, monkeypatch):
    file = tmp_path / "law.py"
    file.write_bytes(LAZY)
    monkeypatch.setattr("svsa.teaching.leaderboard.cli.build_season", build_short_season)
    check_isolation.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(confinement.shutil, "which", lambda name: None)
        with pytest.raises(NotIsolatedError, match="cannot be isolated"):
            submit(Board(tmp_path / "board"), "law", LAZY)
        shown = run("submit", file, "--practice", "--board", tmp_path / "board").stdout
    check_isolation.cache_clear()
    assert "not isolated" in shown
    assert Board(tmp_path / "board").list() == []


@pytest.mark.parametrize("name", ["", " ", "two\nlines", "n" * 61])
def test_name_is_one_line_of_letters(name):
    with pytest.raises(svsa.ParameterError, match="name"):
        boards.build_entry("key", name, False, get_standing(build_season(5), complete_except({})))
