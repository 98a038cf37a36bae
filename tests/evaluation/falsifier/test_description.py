"""Descriptions of an adversary's actions."""

from svsa.evaluation.falsifier.description import describe_attack
from svsa.evaluation.falsifier.scenario import Attack
from svsa.simulation.plant.loads.sine import SineLoad


def test_negative_number_has_a_minus_sign_and_no_hyphen():
    load = SineLoad(torque_nm=(-3.5, 0.0, 2.0), start_s=1.0, frequency_hz=2.0, phase_rad=-0.5)
    reported = describe_attack(Attack((load,), {"position.offset_rad": -0.25}))
    assert "−3.5 N·m on the link" in reported
    assert "phase −0.5 rad" in reported
    assert "position.offset_rad = −0.25" in reported
    assert "-" not in reported
