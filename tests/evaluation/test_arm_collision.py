"""The collision of the tip with a wall: force and energy over stiffness, and its command."""

import json
import math

import numpy as np
import pytest
from rich.console import Console
from typer.testing import CliRunner

from svsa.actuators.arm.parameters import RODS
from svsa.cli import app
from svsa.evaluation.arm_collision import (
    _build_table,
    build_collision,
    draw_collisions,
    measure_collision,
)
from svsa.simulation.arm.contact import check_wall


@pytest.mark.parametrize("direction", [1, -1])
def test_peak_force_work_and_holding_force_rise_with_the_stiffness(direction):
    """The impact itself does not: the links are decoupled from the motors at every stiffness."""
    found = [measure_collision("pd", sigma, direction) for sigma in (10.0, 40.0, 80.0, 140.0)]
    for name in ("peak_n", "work_j", "holding_n"):
        values = [getattr(one, name) for one in found]
        assert np.all(np.diff(values) > 0.1 * values[0]), (name, values)
    for name in ("speed_m_per_s", "impact_n"):
        values = [getattr(one, name) for one in found]
        assert max(values) < 1.03 * min(values), (name, values)


def test_elastic_wall_stores_the_energy_of_the_deepest_penetration():
    one = measure_collision("pd", 40.0, 1, damping_ns_per_m=0.0)
    assert one.peak_n == pytest.approx(2000.0 * one.depth_m.max(), rel=1e-9)
    assert one.work_j == pytest.approx(0.5 * 2000.0 * one.depth_m.max() ** 2, rel=1e-3)


def test_run_that_ends_before_the_wall_has_no_force():
    one = measure_collision("ndobc", 10.0, 1)
    assert one.fault is not None
    assert np.isnan(one.peak_n) and np.isnan(one.work_j) and not len(one.force_n)


def test_collision_without_contact_is_no_fault(monkeypatch):
    """The wall is out of reach."""
    monkeypatch.setattr("svsa.evaluation.arm_collision._WALL_M", 0.3)
    one = measure_collision("pd", 80.0, 1)
    assert one.fault is None and np.isnan(one.peak_n)
    console = Console(width=150)
    with console.capture() as capture:
        console.print(_build_table("pd", [one]))
    assert "no contact" in capture.get() and "fault" not in capture.get()


def test_collisions_are_drawn_by_direction(tmp_path):
    found = [measure_collision("pd", 80.0, direction) for direction in (1, -1)]
    figure = draw_collisions(found)
    assert [len(axes.lines) for axes in figure.axes] == [1] * 4
    figure.savefig(tmp_path / "collision.png")


def test_command_prints_the_collisions_as_json():
    answer = CliRunner().invoke(app, ["arm-collision", "--json"])
    assert answer.exit_code == 0, answer.output
    found = json.loads(answer.stdout)
    assert len(found) == 10
    last = next(one for one in found if one["stiffness_nm_per_rad"] == 140.0)
    assert last["peak_n"] == pytest.approx(34.1, abs=0.05)


def test_largest_damping_of_the_command_is_one_that_the_steps_can_follow():
    """The command cannot set more steps, so it accepts no damping that needs them."""
    _, wall = build_collision(1, 100.0, 200.0)
    check_wall(wall, RODS.build(), 0.001)
    refused = CliRunner().invoke(app, ["arm-collision", "--damping", "201"])
    assert refused.exit_code == 2
    assert "200" in refused.output


def test_unknown_law_is_named_in_the_error():
    answer = CliRunner().invoke(app, ["arm-collision", "flx"])
    assert answer.exit_code == 2
    assert "flx" in answer.output


@pytest.mark.parametrize("direction", [1, -1])
def test_impact_on_an_elastic_wall_is_that_of_the_effective_mass(direction):
    """v √(k m) of a mass m that hits a spring k with the speed v."""
    collision = measure_collision("pd", 10.0, direction, damping_ns_per_m=0.0)
    expected = collision.speed_m_per_s * math.sqrt(2000.0 * collision.effective_mass_kg)
    assert collision.impact_n == pytest.approx(expected, rel=0.03)
