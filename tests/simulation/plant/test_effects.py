"""Non-ideal effects: one switch each, no effect on any bit when off, and the rig's
accuracy limits.
"""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.runs.definition.command import Set
from svsa.runs.execution.run import Run
from svsa.simulation.plant.effects import EFFECTS
from svsa.simulation.plant.effects.effect import Surroundings
from svsa.simulation.plant.effects.encoders import Encoders
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity
from svsa.simulation.plant.effects.noise import SensorNoise
from tests.runs.session.sessions import EVERY_EFFECT, advance, build_configuration

FIGURES = ("4a", "4b", "5")
ALONE = {one.name: not one.field.default if one.on is None else one.on for one in EFFECTS}
WITHOUT_SIZE = {
    "friction": Friction(coulomb1_nm=0.0, coulomb2_nm=0.0),
    "noise": SensorNoise(motor_std_rad=0.0, deflection_std_rad=0.0),
    "gravity": LinkGravity(moment_nm=0.0),
    "delay_samples": 0,
}
LOADED = {"duration_s": 0.5, "loads": (svsa.PaperLoad(start_s=0.1),)}


@pytest.fixture(scope="module")
def ideal():
    return svsa.simulate("4a", **LOADED)


@pytest.fixture(scope="module")
def rig():
    return {figure: svsa.simulate(figure, effects=svsa.RIG) for figure in FIGURES}


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.name)
def test_each_effect_describes_itself(effect):
    """Off it has no description; on it has one. Its constants have the same form in both."""
    assert effect.describe(getattr(svsa.IDEAL, effect.name)) == ""
    assert effect.describe(ALONE[effect.name])
    assert effect.field.description
    if effect.build is not None:
        surroundings = Surroundings(7, svsa.load_prototype().actuator, 0.001)
        constants = effect.build(ALONE[effect.name], surroundings)
        assert type(constants) is type(effect.off)


@pytest.mark.parametrize("name", ALONE)
def test_each_effect_alone_changes_the_run(name, ideal):
    """The switch acts alone, and the run continues."""
    result = svsa.simulate("4a", effects=svsa.Effects(**{name: ALONE[name]}), **LOADED)
    assert result.fault is None
    assert np.any(result.position_rad != ideal.position_rad)


@pytest.mark.parametrize("name", WITHOUT_SIZE)
def test_effect_of_zero_size_is_the_ideal_run_bit_for_bit(name, ideal):
    result = svsa.simulate("4a", effects=svsa.Effects(**{name: WITHOUT_SIZE[name]}), **LOADED)
    np.testing.assert_array_equal(result.samples, ideal.samples)


def test_all_switches_off_is_the_ideal_run_bit_for_bit(ideal):
    """Omitted, set to none, and switched on and off again before the first tick."""
    off = dict.fromkeys(ALONE) | {"delay_samples": 0, "torque_limits": True}
    assert svsa.Effects(**off) == svsa.IDEAL == ideal.configuration.effects
    run = Run(ideal.configuration)
    run.change(Set("effects", EVERY_EFFECT))
    run.change(Set("effects", svsa.IDEAL))
    np.testing.assert_array_equal(advance(run, 500)[0], ideal.samples)


def test_switching_every_effect_on_preserves_earlier_samples():
    """The same bits up to the tick of the switch, different ones after it, and no jump of x."""
    plain, run = svsa.simulate("4a", **LOADED), Run(svsa.simulate("4a", **LOADED).configuration)
    before = advance(run, 50)[0]
    state = run.lanes[0].x
    run.change(Set("effects", EVERY_EFFECT))
    assert run.lanes[0].x == state
    after = advance(run, 50)[0]
    np.testing.assert_array_equal(before, plain.samples[:50])
    assert np.any(after != plain.samples[50:100])
    assert run.fault is None


@pytest.mark.parametrize("figure", FIGURES)
def test_ndobc_recovers_with_the_effects_of_the_rig(figure, rig):
    """The limits: ≤ 0.012° and ≤ 0.01 N·m/rad in 8–20 s; not better than the effects permit."""
    steady = rig[figure].measure(8.0, 20.0)
    assert rig[figure].fault is None
    assert 0.002 < math.degrees(steady.rms_position_error_rad) <= 0.012
    assert 0.0005 < steady.rms_stiffness_error_nm_per_rad <= 0.01


@pytest.mark.parametrize("law", ["fl", "ndobc"])
@pytest.mark.parametrize("figure", FIGURES)
def test_run_with_every_effect_stays_inside_the_domain(figure, law):
    """Friction, noise, lag, gravity, encoders, estimation and delay: 20 s with the load."""
    result = svsa.simulate(figure, law, effects=EVERY_EFFECT)
    assert result.fault is None
    assert np.all(np.isfinite(result.samples))
    assert len(result.samples) == 20_000


def test_controller_receives_quantized_positions():
    """The link is the sum of motor and deflection: multiples of neither count, but of both."""
    encoders = Encoders(motor_counts_per_rev=8, gear_ratio=25.0, deflection_counts_per_rev=200)
    configuration = build_configuration(effects=svsa.Effects(encoders=encoders))
    run, step = Run(configuration), 2.0 * math.pi / 200.0
    for _ in range(20):
        advance(run, 10)
        x, known = run.lanes[0].x, run.lanes[0].known
        for true, seen in ((x.q, known.q), (x.theta1, known.theta1), (x.theta2, known.theta2)):
            assert seen / step == pytest.approx(round(seen / step), abs=1e-9)
            assert abs(true - seen) <= step
        assert (known.dq, known.dtheta1, known.dtheta2) == (x.dq, x.dtheta1, x.dtheta2)


def test_estimate_is_recorded_next_to_the_true_state():
    """The channels of the controller are those of x̂, those of the error are true values."""
    result = svsa.simulate("4b", effects=svsa.RIG, duration_s=0.5)
    r = result
    np.testing.assert_array_equal(r.position_error_rad, r.position_reference_rad - r.position_rad)
    assert np.any(r.position_estimate_rad != r.position_rad)
    assert np.abs(r.position_estimate_rad - r.position_rad).max() < 2e-3


def test_gravity_and_friction_are_disturbances_of_the_plant():
    """With an exact model w is the weight on the link and the friction of the motors."""
    effects = svsa.Effects(gravity=LinkGravity(moment_nm=0.5), friction=Friction())
    exact = svsa.load_prototype().actuator
    r = svsa.simulate("4b", nominal=exact, effects=effects, loads=(), duration_s=1.0)
    np.testing.assert_allclose(r.disturbance_link_nm, -0.5 * np.sin(r.position_rad), atol=1e-10)
    fast = np.abs(r.motor1_velocity_rad_per_s) > 0.5
    assert fast.sum() > 300
    drag = -0.2 * np.sign(r.motor1_velocity_rad_per_s[fast])
    np.testing.assert_allclose(r.disturbance_motor1_nm[fast], drag, atol=1e-9)


def test_parameter_error_is_the_difference_of_plant_and_model():
    """It has no switch: the same loop with another model is disturbed by the difference."""
    c = build_configuration()
    exact = svsa.simulate(c.changed(nominal=c.actuator), duration_s=0.5)
    wrong = svsa.simulate(c, duration_s=0.5)
    assert build_actuator(c.actuator, 0.5) != build_actuator(c.nominal, 0.5)
    assert np.abs(exact.disturbance_link_nm).max() < 1e-9
    assert np.abs(wrong.disturbance_link_nm).max() > 1e-4


def test_noise_depends_on_the_seed_alone():
    noise = svsa.Effects(noise=SensorNoise())
    runs = [svsa.simulate("4b", effects=noise, seed=s, duration_s=0.2).samples for s in (5, 5, 6)]
    np.testing.assert_array_equal(runs[0], runs[1])
    assert np.any(runs[0] != runs[2])
    ideal = [svsa.simulate("4b", seed=seed, duration_s=0.2).samples for seed in (5, 6)]
    np.testing.assert_array_equal(*ideal)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("delay_samples", 6),
        ("delay_samples", -1),
        ("delay_samples", 1.5),
        ("seed", -1),
        ("seed", 2**63),
        ("encoders", {"motor_counts_per_rev": 0}),
        ("noise", {"motor_std_rad": float("nan")}),
        ("current_lag", {"time_constant_s": float("inf")}),
        ("backlash", 1.0),
    ],
)
def test_effect_out_of_range_is_rejected_by_name(name, wrong):
    words = next(iter(wrong)) if isinstance(wrong, dict) else name
    with pytest.raises(svsa.ParameterError, match=words):
        if name == "seed":
            svsa.simulate("4a", duration_s=0.01, seed=wrong)
        else:
            svsa.Effects(**{name: wrong})
