"""The mechanism of the emulator: the plant of the simulation, with end stops."""

import math

import numpy as np
import pytest

from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.signals import State, Torque
from svsa.errors import ParameterError
from svsa.hardware.emulator.mechanics import GRID_US, Mechanics
from svsa.hardware.emulator.parameters import EmulatorParameters, read_emulator_parameters
from svsa.runs.definition.design_file import load_prototype
from svsa.simulation.plant.effects import Effects, build_effect_constants
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.integration import Stops, coast, hit_stops, integrate_period
from svsa.simulation.plant.load_table import build_load_table, schedule_load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from tests.actuators.prototype import PLANT

PERIOD = GRID_US * 1e-6
WIDE = Stops(-100.0, 100.0, 1.5)
AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
FREE = EmulatorParameters(friction=None, current_lag=None)


@pytest.mark.parametrize("count", [0, 1, 37])
def test_coasting_equals_periods_of_the_simulated_plant(count):
    """One compiled call gives the bits that `integrate_period` gives period by period."""
    effects = Effects(friction=Friction(), current_lag=CurrentLag())
    bench = build_effect_constants(effects, 0, load_prototype().actuator, PERIOD)
    table = build_load_table(
        (schedule_load(1, ConstantLoad(torque_nm=(1.0, 0.0, 0.0)), 5, PERIOD),)
    )
    target = Torque(1.0, 0.2)
    x = AT_REST
    for tick in range(count):
        x = integrate_period(PLANT, bench, x, target, target, table, tick, PERIOD, 1)
    found, made = coast(PLANT, bench, WIDE, AT_REST, target, target, table, 0, PERIOD, count)
    assert found == x
    assert made == target


def test_one_long_advance_equals_many_short_ones():
    """Readings do not change the motion: lockstep depends on it."""
    ends = []
    for step in (100, 300, 50_000):
        mechanics = Mechanics(EmulatorParameters())
        mechanics.set_target(0, Torque(1.0, 0.3))
        for time_us in range(0, 150_001, step):
            mechanics.read(time_us)
        ends.append(mechanics.read(150_000))
    assert ends[0] == ends[1] == ends[2]


def test_target_acts_from_the_next_point_of_the_grid():
    mechanics = Mechanics(FREE)
    mechanics.set_target(130, Torque(2.0, 0.0))
    assert mechanics.read(200).dtheta1 == 0.0
    assert mechanics.read(300).dtheta1 == pytest.approx(2.0 * PERIOD / 0.0234, rel=1e-3)


def test_angles_continue_with_their_velocities_between_grid_points():
    mechanics = Mechanics(FREE)
    mechanics.set_target(0, Torque(2.0, 0.0))
    here, between = mechanics.read(5000), mechanics.read(5050)
    assert between.theta1 == pytest.approx(here.theta1 + 50e-6 * here.dtheta1, rel=1e-12)
    assert between.dtheta1 == here.dtheta1


def test_loads_start_and_end_at_their_times():
    mechanics = Mechanics(FREE)
    mechanics.add_load(0, ConstantLoad(torque_nm=(1.0, 0.0, 0.0), start_s=0.01))
    assert mechanics.read(10_000).dq == 0.0
    assert mechanics.read(11_000).dq > 0.0
    mechanics.clear_loads(11_000)
    assert mechanics.load_count == 0


def test_hanging_mass_oscillates_and_comes_to_rest():
    """Displaced and released, m g r sin q accelerates it back, friction of the motor stops it."""
    mechanics = Mechanics(EmulatorParameters())
    mechanics.add_load(0, MassLoad())
    mechanics.add_load(0, PulseLoad(torque_nm=(1.0, 0.0, 0.0), duration_s=0.1))
    assert mechanics.read(100_000).q > 0.005
    x = mechanics.read(20_000_000)
    assert abs(x.dq) < 0.02


@pytest.mark.parametrize("torques", [(27.0, 5.0), (-27.0, -5.0), (27.0, -5.0)])
def test_mechanism_stays_between_its_stops_under_any_command(torques):
    """A runaway ends at the stops with finite numbers, which do not stop the emulator."""
    p = EmulatorParameters()
    mechanics = Mechanics(p)
    mechanics.set_target(0, Torque(*torques))
    mechanics.add_load(0, ConstantLoad(torque_nm=(-50.0, 0.0, 0.0)))
    for time_us in range(0, 2_000_000, 10_000):
        x = mechanics.read(time_us)
        assert all(map(math.isfinite, x))
        assert abs(x.q - x.theta1) <= p.deflection_max_rad + 1e-9
        mu = compute_lever_ratio(x.theta2, p.lever_ratio, p.actuator.spiral_reduction)
        assert p.lever_ratio_min - 1e-9 <= mu <= p.lever_ratio_max + 1e-9


def test_impact_conserves_momentum_and_adds_no_energy():
    x = State(0.9, 2.0, 0.0, -1.0, 0.0, 0.0)
    after = hit_stops(Stops(-1.0, 1.0, 0.75), x, 0.01, 0.02)
    assert after.q - after.theta1 == pytest.approx(0.75)
    assert 0.01 * after.q + 0.02 * after.theta1 == pytest.approx(0.01 * 0.9)
    assert 0.01 * after.dq + 0.02 * after.dtheta1 == pytest.approx(0.01 * 2.0 - 0.02)
    assert after.dq == after.dtheta1
    assert hit_stops(Stops(-1.0, 1.0, 0.75), AT_REST, 0.01, 0.02) == AT_REST


def test_home_is_at_rest_with_the_stiffness_of_the_bench_file():
    mechanics = Mechanics(EmulatorParameters())
    mechanics.set_target(0, Torque(1.0, 0.5))
    mechanics.read(100_000)
    mechanics.home(100_000)
    assert mechanics.read(100_000) == AT_REST
    assert EmulatorParameters().lever_ratio == pytest.approx(0.62733965, abs=1e-8)


def test_rig_file_is_validated(tmp_path):
    path = tmp_path / "rig.toml"
    path.write_text("[friction]\ncoulomb1_nm = 0.0\n[gravity]\nmoment_nm = 0.4\n")
    assert read_emulator_parameters(path).gravity is not None
    for text, name in (
        ("lever_ratio = 0.9", "lever_ratio"),
        ("typo = 1", "typo"),
        ("= broken", "rig file"),
        ("[motor2]\nnumber=1\ntorque_constant_nm_per_a=0.02\nphase_s=0.0", "motor2.number"),
    ):
        path.write_text(text)
        with pytest.raises(ParameterError) as refused:
            read_emulator_parameters(path)
        assert name in str(refused.value)
    with pytest.raises(ParameterError, match="rig file"):
        read_emulator_parameters(tmp_path / "missing.toml")
    assert np.isfinite(EmulatorParameters().motor1.torque_nm_per_a)
