"""The ranking of an arm's controllers, and its command."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.control.installed import get_law
from svsa.evaluation.metrics import find_held
from svsa.evaluation.ranking.arm import (
    ArmProtocol,
    ArmRow,
    Median,
    build_arm_test,
    format_arm_markdown,
    format_median,
    list_arm_cells,
    list_arm_controllers,
    list_arm_headings,
    measure_arm_row,
    order_arm_rows,
)
from svsa.evaluation.tuning.arm import ArmController, run_arm_trials
from svsa.evaluation.tuning.judge import LOUD
from svsa.evaluation.tuning.search_space import build_space
from svsa.runs.definition.design_file import load_prototype

SMALL = ArmProtocol(budget=4, training=2, validation=2, trials=6)
OPTIONS = ["--budget", "4", "--training", "2", "--validation", "2", "--trials", "6"]


def build_row(law, held, after=0.0):
    median = Median(value=1.0, low=0.5, high=2.0)
    return ArmRow(
        law=law, feedforward=False, adaptive=False, values={}, before=0.0, after=after,
        held=held, faults=0, outputs=(median,) * 4,
    )  # fmt: skip


def test_only_laws_that_take_the_feedforward_have_rows_with_it():
    found = list_arm_controllers()
    assert len({one.key for one in found}) == len(found)
    assert ArmController("fl", True, True) in found
    assert ArmController("adrc") in found
    for one in found:
        assert not one.feedforward or get_law(one.law).takes_feedforward


@pytest.mark.exhaustive
def test_row_is_that_of_the_tuned_parameters_on_the_test_trials():
    controller, test = ArmController("pd", True), build_arm_test(SMALL)
    seen = []
    row = measure_arm_row(controller, test, seen.append)
    assert len([one for one in seen if one.stage == "search"]) == 4
    design = build_space("pd").set_design(load_prototype(), tuple(row.values.values()))
    summaries = run_arm_trials(test.trials, controller, design)
    held = find_held(summaries.ravel()).reshape(6, 2)
    assert row.held == tuple(held.all(axis=1).tolist())
    errors = np.degrees(np.sqrt(summaries["position_squares"][:, 1] / 4000))
    assert row.outputs[1].value == pytest.approx(np.sort(errors)[2])


def test_arm_of_four_joints_has_trials_and_columns_for_each():
    protocol = SMALL.changed(arm="chain")
    trials = build_arm_test(protocol).trials
    assert {len(trial.sigmas) for trial in trials} == {4}
    assert {len(trial.configuration.joints) for trial in trials} == {4}
    headings = list_arm_headings(order_arm_rows([], protocol))
    assert headings[-5:] == [
        "joint 4: e [°]", *(f"joint {joint}: e_σ [%]" for joint in (1, 2, 3, 4)),
    ]  # fmt: skip
    with pytest.raises(svsa.ParameterError, match="arm is 'three': it must be one of rods"):
        ArmProtocol(arm="three")


def test_rows_that_do_not_differ_significantly_share_a_rank():
    trials = 40
    held = {"pd": 38, "fl": 36, "ndobc": 10}
    rows = [build_row(law, (True,) * n + (False,) * (trials - n)) for law, n in held.items()]
    results = order_arm_rows(rows, ArmProtocol(trials=trials))
    cells = list_arm_cells(results)
    assert [row[0] for row in cells] == ["1", "1", "3"]
    assert cells[0][2] == "95 (83–99)"
    assert [row[4] for row in cells] == ["< 0.001", "< 0.001", ""]
    assert format_arm_markdown(results).count("\n") == 4


def test_row_without_feasible_parameters_is_marked():
    rows = [build_row("pd", (True,)), build_row("lqi", (False,), after=LOUD)]
    cells = list_arm_cells(order_arm_rows(rows, ArmProtocol(trials=1)))
    assert [row[1] for row in cells] == ["PD", "LQI †"]


def test_median_that_is_a_fault_is_named():
    assert format_median(Median(value=None, low=0.1, high=None)) == "fault (0.1–fault)"
    assert format_median(Median(value=0.25, low=0.1, high=2.0)) == "0.25 (0.1–2)"


@pytest.mark.exhaustive
def test_command_adds_rows_to_its_result_file(tmp_path):
    file = tmp_path / "arm.json"
    command = ["ranking", "arm", "fl+ff", *OPTIONS, "--save", str(file), "--json"]
    answer = CliRunner().invoke(app, command)
    assert answer.exit_code == 0, answer.output
    assert [row["law"] for row in json.loads(answer.stdout)["rows"]] == ["fl"]
    command[2] = "pd"
    answer = CliRunner().invoke(app, command)
    rows = json.loads(file.read_text())["rows"]
    assert {(row["law"], row["feedforward"]) for row in rows} == {("fl", True), ("pd", False)}
    assert all(math.isfinite(row["after"]) for row in rows)


def test_unknown_controller_is_named():
    answer = CliRunner().invoke(app, ["ranking", "arm", "adrc+ff"])
    assert answer.exit_code != 0
    assert "adrc+ff" in str(answer.exception)
