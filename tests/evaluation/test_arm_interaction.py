"""A soft spring, soft control and both, at a wall and under a hand."""

import json
import math

import pytest
from typer.testing import CliRunner

from svsa.cli import app
from svsa.evaluation.arm_interaction import (
    CONTROLLED,
    draw_interactions,
    measure_interactions,
    measure_push,
)

NEITHER, SPRING, CONTROL, BOTH = CONTROLLED


@pytest.fixture(scope="module")
def interactions():
    return measure_interactions()


def test_impact_depends_on_no_controller_and_the_peak_on_every_softness(interactions):
    for walls in zip(*(each.collisions for each in interactions), strict=True):
        assert max(wall.impact_n for wall in walls) < 1.03 * min(wall.impact_n for wall in walls)
        stiff, *soft = walls
        assert all(2.5 * wall.peak_n < stiff.peak_n for wall in soft)


def test_hand_feels_the_chosen_stiffness_of_the_joints(interactions):
    """To 7 %: the force is not small, and the springs harden."""
    for controlled, _, pushes in interactions:
        if controlled is not NEITHER:
            for push in pushes:
                assert push.stiffness_n_per_m == pytest.approx(push.expected_n_per_m, rel=0.07)


def test_link_damping_takes_less_energy_from_the_hand_than_an_undamped_spring(interactions):
    works = {controlled: [push.work_j for push in pushes] for controlled, _, pushes in interactions}
    for number in (0, 1):
        assert works[CONTROL][number] < 0.7 * works[SPRING][number]
        assert works[BOTH][number] < 0.7 * works[SPRING][number]


def test_push_of_a_controller_that_fails_has_no_numbers(monkeypatch):
    monkeypatch.setattr("svsa.evaluation.arm_interaction.PUSH_N", 60.0)
    push = measure_push(SPRING, 1)
    assert push.fault is not None and math.isnan(push.mean_displacement_m)


def test_interactions_are_drawn_and_printed(interactions, tmp_path):
    figure = draw_interactions(interactions)
    assert [len(axes.lines) for axes in figure.axes] == [len(CONTROLLED)] * 4
    figure.savefig(tmp_path / "interaction.png")
    answer = CliRunner().invoke(app, ["arm-interaction", "--json"])
    assert answer.exit_code == 0, answer.output
    rows = json.loads(answer.stdout)
    assert [row["title"] for row in rows] == [controlled.title for controlled in CONTROLLED]
    assert rows[0]["collisions"][0]["peak_n"] == pytest.approx(34.1, abs=0.05)
    shown = CliRunner().invoke(app, ["arm-interaction"], env={"COLUMNS": "200"})
    assert "both are soft" in shown.output and "fault" not in shown.output
