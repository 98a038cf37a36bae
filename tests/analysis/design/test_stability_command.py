"""`svsa stability`: results as text and JSON, and the picture."""

import json

import pytest
from typer.testing import CliRunner

from svsa.cli import app
from svsa.errors import ParameterError


def run(*options: str) -> str:
    result = CliRunner().invoke(app, ["stability", *options], env={"COLUMNS": "120"})
    assert result.exit_code == 0, result.output
    return result.stdout


@pytest.mark.exhaustive
def test_command_prints_json():
    reported = json.loads(run("--json", "--starts", "3"))
    at_15, at_60 = reported["stability"]
    assert reported["law"] == "ndobc"
    assert at_15["slowest_rad_per_s"] == pytest.approx(-20.1, abs=0.05)
    assert at_60["slowest_rad_per_s"] == pytest.approx(-20.3, abs=0.05)
    assert at_15["error_deg_per_nm_per_s"]["formula"] == pytest.approx(0.168, abs=5e-4)
    assert at_15["fastest_observer_rad_per_s"]["1_samples_of_delay"] == pytest.approx(249, rel=0.01)
    assert at_15["fastest_observer_rad_per_s"]["0_samples_of_delay"] is None
    assert 0.0 < at_15["share_that_comes_to_rest"] < at_60["share_that_comes_to_rest"] <= 1.0


@pytest.mark.exhaustive
@pytest.mark.long
def test_command_writes_the_tables_and_the_picture(tmp_path):
    picture = tmp_path / "stability.png"
    text = run("--stiffness", "15", "--starts", "0", "--plot", str(picture))
    assert "-20.07" in text
    assert "0.23 – 3.84" in text
    assert "up to 4.39" in text
    assert picture.stat().st_size > 10_000


def test_command_prints_the_margins_of_the_selected_laws():
    result = CliRunner().invoke(
        app, ["margins", "fl", "eso_saturated", "--stiffness", "15", "--json"]
    )
    assert result.exit_code == 0, result.output
    fl, eso = json.loads(result.stdout)["margins"]
    assert fl["modulus"] == pytest.approx(0.367, abs=0.002)
    assert fl["torque2_gain"]["low"] is None
    assert (eso["is_stable"], eso["joint_error"]) == (False, None)
    table = CliRunner().invoke(app, ["margins", "fl", "--stiffness", "15"], env={"COLUMNS": "140"})
    assert "0.50 (M −39%, B1 +26%, Ks +18%)" in table.stdout


def test_law_without_an_observer_has_no_fastest_observer():
    text = run("--law", "fl", "--stiffness", "15", "--starts", "0")
    assert "none: w itself stays" in text
    fastest = next(line for line in text.splitlines() if "fastest β on the rig" in line)
    assert "–" in fastest


def test_poles_and_observer_are_those_of_the_arguments():
    reported = json.loads(
        run("--json", "--starts", "0", "--stiffness", "15", "--observer", "120", "--pole", "45")
    )["stability"][0]
    assert reported["share_that_comes_to_rest"] is None
    faster = reported["error_deg_per_nm_per_s"]["formula"]
    assert faster == pytest.approx(reported["error_deg_per_nm_per_s"]["simulated"][0], rel=0.01)


def test_stiffness_outside_its_range_is_rejected():
    result = CliRunner().invoke(app, ["stability", "--stiffness", "500", "--starts", "0"])
    assert isinstance(result.exception, ParameterError)
    assert "500" in str(result.exception)
