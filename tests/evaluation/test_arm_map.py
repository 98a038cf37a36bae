"""The map of an arm's errors over tip mass and stiffness, and its command."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.evaluation.arm_map import ArmMap, draw_arm_maps, measure_arm_map

HEAVY = {"observer": 40.0, "gains": svsa.Gains.from_poles([-40] * 4, [-40] * 2)}
ADAPTIVE = {**HEAVY, "feedforward": True, "adaptation": True}


def measure(law, settings):
    return measure_arm_map(law, settings, law, (0.1, 0.3), (80.0,)).errors_deg


def test_ndobc_faults_under_a_payload_that_fl_carries_and_both_carry_it_if_known():
    """0.1 and 0.3 kg at σ = 80."""
    fl, ndobc = measure("fl", {}), measure("ndobc", {})
    assert ndobc[0, 0] < 0.2 * fl[0, 0]
    assert math.isinf(ndobc[0, 1]) and fl[0, 1] < 6.0
    assert np.all(measure("fl", ADAPTIVE) < 0.1)
    assert np.all(measure("ndobc", ADAPTIVE) < 0.1)


def test_map_is_drawn_with_its_faults(tmp_path):
    one = ArmMap("FL", np.array([[0.1, 2.0, math.inf]]), (0.0, 0.1, 0.3), (80.0,))
    figure = draw_arm_maps([one] * 4)
    assert [axis.get_title() for axis in figure.axes[:4]] == ["FL"] * 4
    axis = figure.axes[3]
    assert len(axis.lines) == 1
    assert [label.get_text() for label in axis.get_xticklabels()] == ["0", "0.1", "0.3"]
    assert [label.get_text() for label in axis.get_yticklabels()] == ["80"]
    figure.savefig(tmp_path / "map.png")


@pytest.mark.exhaustive
def test_command_prints_the_map_as_json():
    answer = CliRunner().invoke(app, ["arm-map", "fl", "--json"])
    assert answer.exit_code == 0, answer.output
    found = json.loads(answer.stdout)
    rows = found["rms_position_error_deg"]["FL"]
    assert len(rows) == len(found["stiffness_nm_per_rad"])
    column = found["tip_mass_kg"].index(0.3)
    row = rows[found["stiffness_nm_per_rad"].index(80.0)]
    assert row[column] == pytest.approx(5.06, abs=0.01)


@pytest.mark.parametrize(
    "arguments",
    [["arm-map", "fl", "--plot"], ["arm-collision", "--plot"], ["ranking", "arm", "fl", "--save"]],
)
def test_file_that_cannot_be_written_is_rejected_at_once(arguments, tmp_path):
    answer = CliRunner().invoke(app, [*arguments, str(tmp_path / "missing" / "file.png")])
    assert isinstance(answer.exception, svsa.ParameterError)
    assert "in an existing folder" in str(answer.exception)


COMMANDS = [["arm-map", "fl"], ["arm-collision"], ["datasheet", "sea"], ["stability"]]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command[0])
def test_picture_of_unknown_kind_is_rejected_at_once(command, tmp_path):
    answer = CliRunner().invoke(app, [*command, "--plot", str(tmp_path / "map.txt")])
    assert isinstance(answer.exception, svsa.ParameterError)
    assert ".png, .pdf, .svg" in str(answer.exception)


def test_unknown_law_is_named_in_the_error():
    answer = CliRunner().invoke(app, ["arm-map", "flx"])
    assert answer.exit_code == 2
    assert "flx" in answer.output
