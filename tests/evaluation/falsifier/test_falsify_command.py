"""`svsa falsify`: the result is a file in which any law can run."""

import json

import pytest
from typer.testing import CliRunner

from svsa.cli import app
from svsa.errors import ParameterError
from svsa.evaluation.falsifier import falsification as finding
from svsa.evaluation.falsifier.file import list_adversaries, read_adversary, read_scenario
from svsa.evaluation.falsifier.measure import measure_attacks
from tests.evaluation.falsifier.test_scenario_files import GOOD
from tests.evaluation.falsifier.weak_law import install

pytestmark = pytest.mark.long


@pytest.fixture(autouse=True)
def weak(monkeypatch, tmp_path):
    install(monkeypatch)
    monkeypatch.chdir(tmp_path)


def run(*arguments, code=0):
    outcome = CliRunner().invoke(app, ["falsify", *arguments], catch_exceptions=False)
    assert outcome.exit_code == code, outcome.output
    return outcome


def search(*arguments, code=0):
    return run("search", "pulse.toml", "--runs", "2000", *arguments, code=code)


@pytest.mark.exhaustive
def test_result_is_saved_and_read_from_its_file(tmp_path):
    (tmp_path / "pulse.toml").write_text(GOOD)
    reported = json.loads(search("--json", "--picture", "found.png").stdout)
    assert reported["fault"]
    assert reported["complete"]
    assert reported["file"] == "pulse-weak.toml"
    assert (tmp_path / "found.png").stat().st_size > 10_000
    kept = read_scenario("pulse-weak.toml")
    assert kept.model_dump(mode="json", exclude_none=True) == reported["scenario"]
    assert kept.found.law == "weak"
    again = json.loads(run("run", "pulse-weak.toml", "--json").stdout)
    assert again["laws"] == reported["laws"]
    assert [law["law"] for law in again["laws"]] == ["weak", "ndobc"]
    assert [law["fault"] is None for law in again["laws"]] == [False, True]
    shown = run("run", "pulse-weak.toml", "--laws", "fl, weak").stdout
    assert "whole" in shown
    assert "Weak" in shown
    assert all(f"[{unit}]" in shown for unit in ("°", "s", "N·m/rad"))


def test_ctrl_c_saves_the_worst_run_and_the_command_continues_later(tmp_path, monkeypatch):
    (tmp_path / "pulse.toml").write_text(GOOD)
    search("--law", "fl", "--output", "whole.toml")
    left = [3]

    def measure(*arguments):
        left[0] -= 1
        if left[0] == 0:
            raise KeyboardInterrupt
        return measure_attacks(*arguments)

    monkeypatch.setattr(finding, "measure_attacks", measure)
    outcome = search("--law", "fl", "--output", "part.toml", code=130)
    reported = " ".join(outcome.stderr.split())
    assert "Interrupted after 32 of 2000 runs" in reported
    assert "The same command continues the search." in reported
    assert read_scenario("part.toml").found.runs == 32
    assert (tmp_path / "part.toml.search").exists()
    search("--law", "fl", "--output", "part.toml")
    assert (tmp_path / "part.toml").read_bytes() == (tmp_path / "whole.toml").read_bytes()
    assert not (tmp_path / "part.toml.search").exists()


@pytest.mark.parametrize("option", ["output", "picture"])
def test_unwritable_result_file_is_rejected_before_the_search(tmp_path, monkeypatch, option):
    (tmp_path / "pulse.toml").write_text(GOOD)
    monkeypatch.setattr(finding, "measure_attacks", None)
    for place in ("nowhere/found.toml", "."):
        with pytest.raises(ParameterError, match=f"--{option} is .*in an existing folder"):
            search(f"--{option}", place)


@pytest.mark.exhaustive
def test_search_is_compared_with_random_samples_seed_by_seed(tmp_path):
    (tmp_path / "pulse.toml").write_text(GOOD)
    reported = json.loads(
        run("compare", "pulse.toml", "--seeds", "2", "--runs", "640", "--json").stdout
    )
    assert [lap["seed"] for lap in reported["results"]] == [0, 1]
    faults = sum(lap["cma_run"] is not None for lap in reported["results"])
    assert f"CMA-ES found a fault with {faults}" in reported["message"]
    assert "seed" in run("compare", "pulse.toml", "--seeds", "1", "--runs", "64").stdout


def test_adversaries_of_the_package_are_listed():
    names = list_adversaries()
    assert {"impulse", "everything"} <= set(names)
    listed = " ".join(run("list").stdout.split())
    assert all(name in listed for name in names)
    with pytest.raises(ParameterError, match=r"adversary is 'missing': .*impulse"):
        read_adversary("missing")
