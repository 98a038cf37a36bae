"""`svsa ranking bench`: twelve numbers per law on the emulator, next to those of a baseline."""

import json
import os

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.errors import Fault, FaultError
from svsa.evaluation.campaign.results_file import write_results_file
from svsa.evaluation.ranking.bench_runs import (
    NUMBERS,
    BenchRun,
    BenchRuns,
    load_published_bench_runs,
    read_bench_runs,
)
from svsa.evaluation.ranking.bench_table import build_section
from svsa.evaluation.ranking.measure_bench import measure_on_bench, measure_run
from svsa.evaluation.ranking.row import RecoveryErrors
from svsa.runs.definition.paper import BENCH_FIGURES
from svsa.runs.result.simulate import simulate
from tests.exhaustive import exhaust
from tests.hardware.emulator.in_process_emulator import start_in_process

SIMULATED = {"6a": "4a", "6b": "4b", "7": "5"}
PAPERS = (0.02, 4.0, 0.02, 0.2)


def call(*arguments: str) -> str:
    return CliRunner().invoke(app, ["ranking", "bench", *arguments], catch_exceptions=False).stdout


def build_run(law: str, figure: str, numbers: tuple[float | None, ...], fault: str | None = None):
    errors = RecoveryErrors(**dict(zip(NUMBERS, numbers, strict=True)))
    return BenchRun(law=law, figure=figure, version="0", fault=fault, errors=errors)


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    """A simulated run replaces the one on the rig, but PD ends in a fault; returns the requested
    runs.
    """
    asked = []

    def play(figure, law, duration_s, progress):
        asked.append((law, figure.key))
        progress(0.5)
        if law == "pd":
            raise FaultError(Fault("vibration", 0, 100, 0.1, "It shakes."))
        return simulate(SIMULATED[figure.key], law)

    monkeypatch.setattr("svsa.hardware.emulator.experiment.run_on_emulator", play)
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    return asked


def test_law_is_reported_next_to_its_baseline_in_every_figure(played):
    """FL recovers in none; the numbers are those of the run, and a fault has its name and no
    numbers.
    """
    reported = json.loads(call("fl", "pd", "--json"))
    assert played == [(law, key) for law in ("ndobc", "fl", "pd") for key in BENCH_FIGURES]
    papers, fl, pd = reported["laws"]
    assert [one["law"] for one in reported["laws"]] == ["ndobc", "fl", "pd"]
    assert (papers["no_worse"], fl["no_worse"], pd["no_worse"]) == (12, 0, 0)
    assert {one["numbers"] for one in reported["laws"]} == {12}
    assert fl["figures"]["6a"]["peak_deg"] == pytest.approx(12.06, rel=0.01)
    assert fl["figures"]["7"]["recovery_s"] is None
    assert fl["figures"]["6b"]["fault"] is None
    assert pd["figures"]["6b"] == {**dict.fromkeys(NUMBERS), "fault": "vibration"}


def test_reported_progress_only_increases(played):
    shares = []
    measure_on_bench(["ndobc", "pd"], ["6a"], shares.append)
    assert shares == [0.25, 0.5, 0.75, 1.0]


def test_saved_results_are_updated_and_shown_again(played, tmp_path):
    path = tmp_path / "runs.json"
    call("ndobc", "--save", str(path))
    write_results_file(path, read_bench_runs(path).renew(BenchRuns(runs=(
        build_run("pid", "6a", PAPERS), build_run("fl", "6b", PAPERS),
    ))))  # fmt: skip
    call("fl", "--figure", "6B", "--save", str(path))
    kept = read_bench_runs(path)
    assert kept.laws == ("ndobc", "pid", "fl")
    assert kept.list_runs("fl")[0].errors.peak_deg == pytest.approx(11.18, rel=0.01)
    played.clear()
    shown = call("fl", "--results", str(path))
    assert not played
    assert "fault" not in shown
    assert "0 of 4" in shown
    assert shown.count("never") == 1
    assert "…" not in shown
    heading, rule, *rows = call("fl", "--results", str(path), "--markdown").splitlines()
    assert heading.count("|") == rule.count("|") == rows[1].count("|")
    assert rows[1].startswith("| FL |  | 0.")
    assert rows[1].endswith(" / never |  | 0 of 4 |")
    with pytest.raises(svsa.ParameterError, match="svsa ranking bench --save"):
        call("--results", str(tmp_path / "nothing.json"))


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [(["fl", "--figure", "4a"], "one of 6a, 6b, 7"), (["missing"], "installed here"),
     (["fl", "--comparison", "missing"], "installed here")],
)  # fmt: skip
def test_unknown_names_are_rejected_before_anything_runs(played, arguments, reported):
    with pytest.raises(svsa.ParameterError, match=reported):
        call(*arguments)
    assert not played


def test_missing_number_is_worse_than_any_number():
    papers = build_run("ndobc", "6a", PAPERS)
    mine = build_run("fl", "6a", (0.02, 4.1, 0.01, None))
    assert [mine.is_no_worse(papers, name) for name in NUMBERS] == [True, False, True, False]
    assert papers.is_no_worse(mine, "recovery_s")
    assert not mine.is_no_worse(mine, "recovery_s")
    assert BenchRuns(runs=(papers, mine)).count_no_worse("fl", "ndobc") == (2, 4)


def test_page_of_a_law_reports_runs_that_ended_early():
    ended = build_run("pd", "6a", (None,) * 4, "vibration")
    runs = BenchRuns(runs=(build_run("ndobc", "6a", PAPERS), ended))
    section = "\n".join(build_section(runs, "pd"))
    assert "| Figure 6A: peak | fault | 4° |" in section
    assert "Ended early by the bench: figure 6a: vibration." in section
    assert "No worse than NDOBC in 0 of 4." in section
    assert build_section(runs, "fl") == []


KEPT = {f"{run.law} {run.figure}": run for run in load_published_bench_runs().runs}


@pytest.mark.parametrize("name", exhaust(KEPT, []))
def test_saved_results_of_the_rig_are_reproduced(name, monkeypatch):
    """The rig in this process, which gives the same bits as through its sockets."""
    monkeypatch.setattr(
        "svsa.hardware.emulator.experiment.start_emulator", lambda *_: start_in_process()
    )
    kept = KEPT[name]
    found = measure_run(0, (kept.law, kept.figure), lambda number, done: None)
    assert found.fault == kept.fault
    for number in NUMBERS:
        one, other = (getattr(run.errors, number) for run in (found, kept))
        assert (one is None) == (other is None)
        assert one is None or one == pytest.approx(other, rel=1e-6)


def test_ndobc_and_both_successors_are_measured_in_every_figure():
    kept = load_published_bench_runs()
    for law in ("ndobc", "ndobc_s", "ndobc_w"):
        assert [run.figure for run in kept.list_runs(law)] == list(BENCH_FIGURES)
