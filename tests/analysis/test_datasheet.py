"""The datasheet of an actuator against what its energy says in closed form."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

from svsa.actuators.installed import get_mechanism
from svsa.analysis.datasheet.measure import NOMINAL_SHARE, measure_datasheet
from svsa.cli import app


def test_torque_and_energy_of_the_leaf_spring_are_those_of_its_formula():
    """τ = c φ/s³ = σ φ, U = ½ σ φ²; the torque of motor 1, 60 N·m, ends the stiff presets."""
    found = measure_datasheet("leaf_spring")
    assert found.stiffness_range_nm_per_rad == (1.0, 500.0)
    assert found.peak_torque_nm == pytest.approx(60.0)
    assert found.nominal_torque_nm == pytest.approx(NOMINAL_SHARE * 60.0)
    for preset in found.presets:
        sigma, limit = preset.stiffness_nm_per_rad, preset.deflection_rad[-1]
        assert limit == pytest.approx(min(0.8, 60.0 / sigma))
        assert preset.torque_nm == pytest.approx(sigma * np.array(preset.deflection_rad))
        assert preset.stiffness_at_nm_per_rad == pytest.approx([sigma] * 41)
        assert preset.energy_j == pytest.approx(0.5 * sigma * limit**2)
    # A torque τ needs σ ≥ τ/0.8 rad.
    for torque, least, greatest in found.torque_stiffness:
        assert least == pytest.approx(max(1.0, torque / 0.8), rel=1e-6)
        assert greatest == pytest.approx(500.0)


def test_stiffness_of_qbmove_under_torque_is_above_a_times_the_torque():
    found = measure_datasheet("qbmove")
    rate = get_mechanism("qbmove").prototype.rate_per_rad
    assert found.peak_torque_nm == 12.0
    assert len(found.torque_stiffness) > 10
    for torque, least, greatest in found.torque_stiffness:
        assert rate * torque <= least <= greatest
        assert greatest == pytest.approx(math.hypot(15.0, rate * torque), rel=0.02)


def test_stiffness_variation_takes_as_long_as_torque_2_needs():
    """A minimum-jerk movement needs B2 Δθ2 · 5.77/T²: with unlimited time less than the limit."""
    found = measure_datasheet("leaf_spring")
    mechanism = get_mechanism("leaf_spring")
    change = found.variation_unloaded
    assert change is not None
    start, end = change.start_nm_per_rad, change.end_nm_per_rad
    assert start == pytest.approx(500.0**0.1)
    assert end == pytest.approx(500.0**0.9)
    c, kappa = mechanism.prototype.bending_nm_m3, mechanism.prototype.roller_m_per_rad
    turn = ((c / start) ** (1 / 3) - (c / end) ** (1 / 3)) / kappa
    # No movement of motor 2 between the two is faster than full torque forth and back.
    inertia = mechanism.prototype.motor2_inertia_kg_m2
    fastest = 2.0 * math.sqrt(turn * inertia / mechanism.limits.torque2_nm)
    assert fastest < change.time_s < 5.0 * fastest


def test_an_actuator_without_a_stiffness_motor_has_no_variation():
    found = measure_datasheet("sea")
    assert found.stiffness_range_nm_per_rad == (60.0, 60.0)
    assert found.variation_unloaded is None
    assert found.elastic_energy_max_j == pytest.approx(0.5 * 60.0 * 0.5**2)


def test_the_command_prints_json_and_draws_a_page(tmp_path):
    page = tmp_path / "page.pdf"
    done = CliRunner().invoke(app, ["datasheet", "maccepa", "--json", "--plot", str(page)])
    assert done.exit_code == 0, done.output
    found = json.loads(done.output)
    assert found == measure_datasheet("maccepa").model_dump(mode="json")
    assert page.read_bytes().startswith(b"%PDF")
    assert "link_inertia_kg_m2" in found["assumed"]
    assert "spring_stiffness_n_per_m" not in found["assumed"]
    unknown = CliRunner().invoke(app, ["datasheet", "nowhere"])
    assert unknown.exit_code != 0
