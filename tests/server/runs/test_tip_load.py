"""Loads at the tip of an arm through a run, as its replay draws them."""

import math

import pytest

import svsa
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.command import ApplyLoad, RemoveLoad
from svsa_scene.arm_pose import TipLoad, Wall
from svsa_server.runs.tip_load import sum_tip_loads, trace_tip_loads

WALL = svsa.Wall(normal_rad=math.pi, distance_m=-0.55, stiffness_n_per_m=500.0)
BEHIND = Wall(math.pi, -0.55)


def test_loads_at_the_tip_change_when_they_begin_end_and_are_sent_again() -> None:
    planned = svsa.TipMass(mass_kg=0.2, start_s=0.1)
    configuration = build_arm_experiment("rods", {}, {}, tip_loads=[planned])
    commands = [
        ApplyLoad(tick=50, argument=WALL),
        ApplyLoad(tick=200, argument=svsa.TipPush(force_n=(1.0, 0.0), hold_s=0.5)),
        ApplyLoad(tick=300, argument=svsa.TipPush(force_n=(0.0, 2.0), hold_s=0.5)),
        RemoveLoad(tick=900, argument=2),
    ]
    hung = TipLoad(0.2, (0.0, 0.0), BEHIND)
    assert trace_tip_loads(configuration, commands, first_tick=40) == [
        (0, TipLoad()),
        (10, TipLoad(0.0, (0.0, 0.0), BEHIND)),
        (60, hung),
        (160, TipLoad(0.2, (1.0, 0.0), BEHIND)),
        (260, TipLoad(0.2, (0.0, 2.0), BEHIND)),
        (760, hung),
        (860, TipLoad(0.2)),
    ]
    assert trace_tip_loads(configuration, commands, first_tick=250)[-4:] == [
        (0, TipLoad(0.2, (1.0, 0.0), BEHIND)),
        (50, TipLoad(0.2, (0.0, 2.0), BEHIND)),
        (550, hung),
        (650, TipLoad(0.2)),
    ]


def test_impulse_is_drawn_as_the_force_that_acts() -> None:
    impulse = svsa.TipImpulse(impulse_ns=(0.01, -0.02))
    assert sum_tip_loads([impulse]).force_n == pytest.approx((2.0, -4.0))
    assert sum_tip_loads([svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0))]) == TipLoad()
