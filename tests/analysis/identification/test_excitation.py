"""The identification excitation can be played and stays within the limits."""

import numpy as np
import pytest

from svsa.analysis.identification.excitation import (
    EXCITATION,
    EXCITATION_DURATION_S,
    build_commands,
)
from svsa.runs.definition.command import build_command
from svsa.runs.session.simulated import SimulatedSession

from .excited_run import DESIGN, build_configuration, get, play

LIMITS = DESIGN.limits
HEAVY = {"motor1_inertia_kg_m2": 0.028, "motor2_inertia_kg_m2": 0.017, "link_inertia_kg_m2": 0.013}
LIGHT = {"motor1_inertia_kg_m2": 0.019, "motor2_inertia_kg_m2": 0.011, "link_inertia_kg_m2": 0.008}
SOFT, HARD = {"spring_stiffness_n_per_m": 1600.0}, {"spring_stiffness_n_per_m": 2200.0}
RMS_TORQUE2_NM = 1.2  # continuous rating of an RE25 with a 50:1 gear


@pytest.mark.parametrize("changes", [{}, HEAVY, LIGHT, SOFT, HARD], ids=str)
def test_excitation_stays_far_from_every_limit(changes):
    # It is played before the parameters are known, so it must not need them.
    actuator = DESIGN.actuator.changed(**changes)
    samples, fault = play(build_configuration(actuator=actuator))
    assert fault is None
    assert len(samples) == EXCITATION_DURATION_S * 1000
    deflection = np.abs(get(samples, "deflection_rad"))
    assert np.max(deflection / get(samples, "deflection_limit_rad")) < 0.25
    assert np.abs(get(samples, "torque1_nm")).max() < 0.5 * LIMITS.torque1_nm
    assert np.abs(get(samples, "torque2_nm")).max() < 0.8 * LIMITS.torque2_nm
    assert np.std(get(samples, "torque2_nm")) < RMS_TORQUE2_NM
    assert np.abs(get(samples, "position_rad")).max() < 1.1
    for motor in ("motor1", "motor2"):
        assert np.abs(get(samples, f"{motor}_velocity_rad_per_s")).max() < 8.0


def test_excitation_ends_at_rest_in_its_initial_position():
    samples, _ = play(build_configuration())
    last = samples[-200:]
    assert np.abs(get(last, "position_rad")).max() < 1e-3
    assert np.abs(get(last, "velocity_rad_per_s")).max() < 0.02
    assert get(last, "stiffness_nm_per_rad")[-1] == pytest.approx(30.0, abs=0.2)


def test_session_plays_the_excitation():
    # A bench session takes the same kinds and references.
    session = SimulatedSession("bench", build_configuration())
    for cue in EXCITATION[:4]:
        session.step(round(cue.time_s * 1000) - session.run.tick or 1)
        session.change(build_command(0, cue.kind, cue.reference))
    assert session.run.fault is None


def test_commands_are_ordered_and_start_at_the_present_tick():
    ticks = [command.tick for command in build_commands(0.002, first_tick=70)]
    assert ticks == sorted(ticks)
    assert ticks[0] == 70
    assert ticks[-1] == 70 + round(EXCITATION[-1].time_s / 0.002)
