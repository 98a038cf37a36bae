"""Margins of the sampled loop compared with closed forms, the continuous model and simulations."""

import math
from importlib.metadata import EntryPoint

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import Disturbance, Positions, State, Torque
from svsa.analysis.design.closed_loop import linearize_loop
from svsa.analysis.design.linear_model import linearize
from svsa.analysis.design.margins import (
    JOINT,
    compute_margins,
    compute_sensitivity,
    find_joint_error,
)
from svsa.analysis.design.sampled_loop import linearize_tick
from svsa.control import installed
from svsa.control.call import build_call
from svsa.control.installed import list_law_names
from svsa.control.law import Law
from svsa.numerics.compilation import compiled
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import build_lane_state
from svsa.simulation.loop.loop import decide, observe
from svsa.simulation.plant.integration import integrate_period
from svsa.simulation.plant.sensors import read_sensors
from tests.exhaustive import exhaust

SMOOTH_RIG = svsa.RIG.changed(encoders=None, torque_limits=False)
SHORT_S = 1e-4


def build(law: str = "ndobc", **changes: object) -> Configuration:
    figure = svsa.paper.get_figure("4a").build_configuration(law, load=False)
    return figure.changed(
        position=svsa.ConstantPosition(),
        stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=15.0),
        **({"effects": SMOOTH_RIG} | changes),
    )


def shorten(configuration: Configuration) -> Configuration:
    sampling = configuration.sampling.changed(period_s=SHORT_S)
    return configuration.changed(sampling=sampling, effects=svsa.IDEAL)


def grow(
    configuration: Configuration, late: int = 0, gains: tuple[float, float] = (1.0, 1.0)
) -> float:
    """By how much a nudge of 0.01 mrad has grown from 0.8 to 2 s, in the nonlinear loop.

    The plant gets the torque `late` samples later and multiplied by `gains`. The observer gets the
    torque without this change.
    """
    run = Run(configuration)
    blocks, law, inputs, period = run.blocks[0], run.laws[0], run.inputs, run.period_s
    lane = build_lane_state(run.lanes[0].memory.copy(), State(1e-5, 0.0, 0.0, 0.0, 1e-5, 0.0))
    x, known, estimate, applied = lane.x, lane.x, Disturbance(0.0, 0.0, 0.0), Torque(0.0, 0.0)
    queue = [applied] * (1 + blocks.effects.delay_samples + late)
    size = []
    for tick in range(2000):
        call, measured = build_call(law, lane.memory), Positions(x.q, x.theta1, x.theta2)
        _, torque = decide(blocks, call, inputs, known, estimate, applied, measured, tick)
        queue = [torque, *queue[:-1]]
        applied = queue[blocks.effects.delay_samples]
        acting = Torque(gains[0] * queue[-1].u1, gains[1] * queue[-1].u2)
        x = integrate_period(
            blocks.plant, blocks.effects, x, acting, acting, inputs.loads, tick, period, 1
        )
        measurement = read_sensors(blocks.effects, x, tick + 1)
        known, estimate = observe(blocks, known, estimate, applied, measurement)
        size.append(max(abs(x.q), abs(x.theta2)))
        if size[-1] > 0.1:
            return math.inf
    return max(size[-200:]) / max(size[600:800])


@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_fl_with_the_exact_model_has_the_sensitivity_of_its_pole_placement(sigma):
    """State feedback that moves the poles: S = p_plant(s)/p_placed(s) at each motor."""
    c = shorten(build("fl", actuator=build().nominal))
    loop = linearize_tick(c, sigma)
    omega = np.geomspace(1.0, 2000.0, 200)
    S = np.abs(compute_sensitivity(loop, omega * SHORT_S))
    A = linearize(sigma, actuator=c.nominal).A
    plants = np.poly(A[:4, :4]), np.poly(A[4:, 4:])
    placed = np.poly(c.gains.position_roots), np.poly(c.gains.stiffness_roots)
    expected = [
        np.abs(np.polyval(open_, 1j * omega) / np.polyval(closed, 1j * omega))
        for open_, closed in zip(plants, placed, strict=True)
    ]
    for motor in (0, 1):
        np.testing.assert_allclose(S[:, motor, motor], expected[motor], rtol=0.03)
    assert np.max(S[:, [0, 1], [1, 0]]) < 1e-6
    margins = compute_margins(c, sigma, seeks_error=False)
    assert margins.modulus == pytest.approx(1.0, rel=0.02), "of |S| ≤ 1: full state feedback"
    assert np.max(expected) < 1.0


@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_ndobc_has_the_modulus_margin_of_its_continuous_model(sigma):
    """u is read from the motors' rows of the closed loop: B u = ẋ − A_plant x without w."""
    c = shorten(build())
    loop, plant = linearize_loop(c, sigma), linearize(sigma)
    inertia = np.array([plant.B[3, 0], plant.B[5, 1]])[:, np.newaxis]
    rows = loop.A[[3, 5]].copy()
    rows[:, :6] -= plant.A[[3, 5]]
    C, unit = rows / inertia, np.eye(len(loop.A))
    worst = max(
        np.linalg.norm(np.eye(2) + C @ np.linalg.solve(1j * w * unit - loop.A, loop.B[:, 1:]), 2)
        for w in np.geomspace(0.1, 3000.0, 2000)
    )
    margins = compute_margins(c, sigma, seeks_error=False)
    assert margins.modulus == pytest.approx(1.0 / worst, rel=0.02)


@pytest.mark.parametrize("law", ["ndobc", "pi_observer", "super_twisting"])
def test_simulation_is_stable_only_within_the_delay_margin(law):
    c = build(law)
    margins = compute_margins(c, 15.0, seeks_error=False)
    assert margins.delay_s is not None
    samples = margins.delay_s / c.sampling.period_s
    assert grow(c, late=math.floor(samples)) < 1.0
    assert grow(c, late=math.floor(samples) + 1) > 1.0


@pytest.mark.parametrize("motor", [0, 1])
@pytest.mark.parametrize("side", ["low", "high"])
def test_simulation_is_stable_only_within_the_gain_margins(motor, side):
    c = build()
    margins = compute_margins(c, 15.0, seeks_error=False)
    end = getattr((margins.gain1, margins.gain2)[motor], side)
    assert end is not None
    inward = 1.03 if side == "low" else 1.0 / 1.03

    def grow_with(gain: float) -> float:
        return grow(c, gains=(gain, 1.0) if motor == 0 else (1.0, gain))

    assert grow_with(end * inward) < 1.0
    assert grow_with(end / inward) > 1.0


@pytest.mark.long
def test_joint_error_is_at_the_stability_boundary_of_the_linearized_tick():
    c = build()
    found = find_joint_error(c, 15.0)
    assert found is not None

    def compute_radius(share: float) -> float:
        changed = {
            name: (1.0 + share * error) * getattr(c.nominal, name)
            for name, error in zip(JOINT, found.errors, strict=True)
        }
        return linearize_tick(c.changed(actuator=c.nominal.changed(**changed)), 15.0).radius

    assert compute_radius(0.98) < 1.0
    assert compute_radius(1.02) > 1.0
    random = np.random.default_rng(1)
    for errors in random.normal(size=(100, 4)):
        errors *= 0.97 * found.norm / np.linalg.norm(errors)
        changed = {
            name: (1.0 + error) * getattr(c.nominal, name)
            for name, error in zip(JOINT, errors.tolist(), strict=True)
        }
        loop = linearize_tick(c.changed(actuator=c.nominal.changed(**changed)), 15.0)
        assert loop.radius < 1.0


@pytest.mark.parametrize("law", exhaust(list_law_names(), ["ndobc", "fl", "eso_saturated"]))
def test_every_law_has_margins_or_is_unstable(law):
    """One function for all control laws: none of them switches at rest."""
    margins = compute_margins(build(law), 15.0, seeks_error=False)
    if not margins.is_stable:
        assert (margins.modulus, margins.delay_s, margins.error) == (0.0, 0.0, None)
        return
    assert 0.0 < margins.modulus <= 1.0
    assert margins.delay_s is not None
    assert margins.delay_s > 0.0
    assert not margins.is_switching


@compiled
def damp_to_one_side(nominal, constants, memory, x, reference, estimate, applied, period):
    damping = 1.0 if x.dtheta1 < 0.0 else 2.0
    return Torque(-x.q - damping * x.dtheta1, -0.1 * x.theta2 - 0.1 * x.dtheta2)


LOPSIDED = Law("lopsided", "Two dampings", "", "", "", damp_to_one_side)


def test_law_that_switches_at_rest_is_reported(monkeypatch):
    entry = EntryPoint("lopsided", f"{__name__}:LOPSIDED", installed.GROUP)
    monkeypatch.setitem(installed._find_entries(), "lopsided", entry)
    installed._load_law.cache_clear()
    try:
        assert compute_margins(build("lopsided"), 15.0, seeks_error=False).is_switching
    finally:
        installed._load_law.cache_clear()
