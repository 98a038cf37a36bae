"""The datasheet of an actuator compared with closed forms of its energy."""

import json
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from typer.testing import CliRunner

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import ExternalLoad, build_actuator, compute_acceleration
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_torques
from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import Published
from svsa.actuators.reach import find_deflection
from svsa.actuators.signals import State, Torque
from svsa.analysis.datasheet import measure
from svsa.analysis.datasheet.measure import NOMINAL_SHARE, _compare, _list_speeds
from svsa.analysis.datasheet.rows import list_published, list_rows, write_figure
from svsa.cli import app
from svsa.errors import ParameterError
from tests.exhaustive import exhaust

measure_datasheet = cache(measure.measure_datasheet)


@pytest.mark.exhaustive
def test_torque_and_energy_of_the_leaf_spring_match_its_formula():
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


@pytest.mark.exhaustive
def test_stiffness_of_qbmove_under_torque_is_above_a_times_the_torque():
    found = measure_datasheet("qbmove")
    rate = get_mechanism("qbmove").prototype.rate_per_rad
    assert found.peak_torque_nm == 12.0
    assert len(found.torque_stiffness) > 10
    for torque, least, greatest in found.torque_stiffness:
        assert rate * torque <= least <= greatest
        assert greatest == pytest.approx(math.hypot(15.0, rate * torque), rel=0.02)


def test_stiffness_variation_time_follows_from_torque_2():
    """A minimum-jerk movement needs B2 Δθ2 · 5.77/T²; without a time limit the torque is below its
    limit.
    """
    found = measure_datasheet("leaf_spring")
    mechanism = get_mechanism("leaf_spring")
    change = found.variation_unloaded
    assert change is not None
    start, end = change.start_nm_per_rad, change.end_nm_per_rad
    assert start == pytest.approx(500.0**0.1)
    assert end == pytest.approx(500.0**0.9)
    c, kappa = mechanism.prototype.bending_nm_m3, mechanism.prototype.roller_m_per_rad
    turn = ((c / start) ** (1 / 3) - (c / end) ** (1 / 3)) / kappa
    # No movement of motor 2 between the two is faster than full torque in both directions.
    inertia = mechanism.prototype.motor2_inertia_kg_m2
    fastest = 2.0 * math.sqrt(turn * inertia / mechanism.limits.torque2_nm)
    assert fastest < change.time_s < 5.0 * fastest


@pytest.mark.parametrize("name", exhaust(["maccepa", "qbmove", "leaf_spring"], ["qbmove"]))
def test_motor_at_its_limit_keeps_the_speeds_of_the_workspace(name):
    """At each point the plant is in equilibrium: with a torque below the spring's only at u1."""
    found, mechanism = measure_datasheet(name), get_mechanism(name)
    plant = build_actuator(mechanism.prototype, 0.0)
    domain = build_domain(mechanism.prototype, mechanism.limits)
    assert found.speed_max_rad_per_s == found.torque_speed[-1][0] == mechanism.speed_max_rad_per_s
    stiffest = max(found.presets, key=lambda preset: preset.torque_nm[-1])
    s = float(compute_coordinate_for_stiffness(plant, stiffest.stiffness_nm_per_rad))
    plant = plant._replace(mu0=s)
    for speed, torque in found.torque_speed:
        elastic = torque + plant.D * speed
        phi = -find_deflection(plant, domain, s, elastic)
        x = State(phi, speed, 0.0, speed, 0.0, 0.0)
        u = Torque(elastic + plant.D1 * speed, compute_torques(plant, s, phi).reaction)
        load = ExternalLoad(-torque, 0.0, 0.0, 0.0, 0.0)
        assert compute_acceleration(plant, x, u, load) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
        at_limit = u.u1 == pytest.approx(mechanism.largest_torque_nm)
        assert at_limit or u.u1 < mechanism.largest_torque_nm
        assert at_limit or elastic == pytest.approx(found.peak_torque_nm)


def test_rows_have_three_digits_and_no_exponent():
    figures = [0.12345, 15.0, 999.4, 999.6, 1000.0, 1234.5]
    assert [*map(write_figure, figures)] == ["0.123", "15", "999", "1000", "1000", "1234"]
    rows = dict(list_rows(measure_datasheet("awas2")))
    assert rows["Stiffness range, unloaded"] == "5 to 1000 N·m/rad"
    assert rows["Maximum speed, unloaded"] == "3.12 rad/s"


def test_workspace_of_torque_and_speed_needs_a_stated_speed_limit():
    mechanism = get_mechanism("maccepa")
    found = _list_speeds(replace(mechanism, speed_max_rad_per_s=None), 6.0)
    assert found == []
    with pytest.raises(ParameterError, match="missing: speed_max_rad_per_s"):
        sources = {key: text for key, text in mechanism.sources.items() if "speed" not in key}
        replace(mechanism, sources=sources)
    damped = mechanism.prototype.changed(link_damping_nms_per_rad=10.0)
    stalled = _list_speeds(replace(mechanism, prototype=damped), 2.0)
    assert stalled[-1] == pytest.approx((0.2, 0.0))


@pytest.mark.parametrize("name", ["mass_kg", "presets", "stiffness_range_nm_per_rad"])
def test_published_figure_that_is_none_of_the_datasheet_is_rejected(name):
    member, found = get_mechanism("sea"), measure_datasheet("sea")
    with pytest.raises(ParameterError, match=f"published is .*{name}.* by the field"):
        _compare(found, replace(member, published={name: Published((1.0,), "a paper")}))


def test_name_of_the_mechanism_is_no_assumed_parameter(monkeypatch):
    member = get_mechanism("sea")
    sources = {**member.sources, "mechanism": "assumed"}
    own = replace(member, sources=sources)
    monkeypatch.setattr(measure, "get_mechanism", lambda _: own)
    assert "mechanism" not in measure.measure_datasheet("sea").assumed


def test_actuator_without_stiffness_motor_has_no_variation():
    found = measure_datasheet("sea")
    assert found.stiffness_range_nm_per_rad == (60.0, 60.0)
    assert found.variation_unloaded is None
    assert found.elastic_energy_max_j == pytest.approx(0.5 * 60.0 * 0.5**2)


@pytest.mark.exhaustive
@pytest.mark.long
def test_command_prints_json_and_draws_a_page(tmp_path):
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


def test_published_figures_are_compared_with_the_measured_ones():
    """The relative deviation of each number, and the source; none of an actuator without any."""
    mechanism = get_mechanism("svsa")
    found = measure_datasheet("svsa")
    stiffness, deflection = found.published
    assert (stiffness.field, stiffness.published) == ("stiffness_range_nm_per_rad", [1.7, 150.56])
    assert stiffness.measured == [*found.stiffness_range_nm_per_rad]
    assert deflection.measured == [found.deflection_max_rad]
    assert deflection.deviation == pytest.approx([found.deflection_max_rad / 0.75 - 1.0])
    other = replace(
        mechanism,
        published={
            "peak_torque_nm": Published((2.0 * found.peak_torque_nm,), "a test"),
            "variation_loaded": Published((1.0,), "a test"),
        },
    )
    halved, missing = _compare(found.changed(variation_loaded=None), other)
    assert halved.deviation == pytest.approx([-0.5])
    assert (missing.measured, missing.deviation) == ([], [])
    rows = list_published(found.changed(published=[halved]))
    assert rows[0][2:] == (f"{2.0 * found.peak_torque_nm:.4g} N·m", "-50.0 %", "a test")
    assert measure_datasheet("leaf_spring").published == []
