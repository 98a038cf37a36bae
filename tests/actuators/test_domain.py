"""The domain: each bound ends a run in a named fault with finite values, never in NaN."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.actuators.domain import (
    DEFLECTION_LIMIT,
    INSIDE,
    LEVER_END,
    NOT_FINITE,
    SINGULAR_DECOUPLING,
    build_domain,
    check_domain,
    compute_deflection_limit,
    compute_relative_determinant,
)
from svsa.actuators.lever import compute_zero_stiffness_deflection
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.signals import CHANNELS, State
from svsa.runs.execution.run import Run

from .prototype import DESIGN, NOMINAL, PLANT, build_state, drawn, lever_ratios, move_plant, springs

DOMAIN = build_domain(DESIGN.actuator, DESIGN.limits)
PUSH_LINK = svsa.ConstantLoad(torque_nm=(20.0, 0.0, 0.0), start_s=0.05)
PUSH_LEVER = svsa.ConstantLoad(torque_nm=(0.0, 0.0, 20.0), start_s=0.05)
PULL_LEVER = svsa.ConstantLoad(torque_nm=(0.0, 0.0, -20.0), start_s=0.05)
EARLY_SINGULAR = DESIGN.limits.changed(singularity_fraction=0.9, deflection_fraction=1.0)

FAULTS = {
    "deflection_limit": {"loads": (PUSH_LINK,)},
    "lever_end": {"loads": (PUSH_LEVER,)},
    "singular_decoupling": {"loads": (PUSH_LINK,), "limits": EARLY_SINGULAR},
}
NAMED_VALUES = {
    "deflection_limit": {"deflection_limit_rad", "zero_stiffness_deflection_rad", "lever_ratio"},
    "lever_end": {"lever_ratio", "lever_ratio_min", "lever_ratio_max"},
    "singular_decoupling": {"relative_determinant", "stiffness_nm_per_rad", "deflection_rad"},
}


@pytest.mark.parametrize("code", FAULTS)
def test_run_that_leaves_the_domain_ends_in_the_named_fault(code):
    """The samples end before the fault, which reports place and reason in finite numbers."""
    result = svsa.simulate("4a", "ndobc", duration_s=2.0, **FAULTS[code])
    fault = result.fault
    assert fault is not None
    assert fault.code == code
    assert 50 < fault.tick == len(result.samples) < 2000
    assert fault.time_s == pytest.approx(fault.tick * 0.001)
    assert np.all(np.isfinite(result.samples))
    assert set(fault.values) >= NAMED_VALUES[code]
    assert all(math.isfinite(value) for value in fault.values.values())
    assert json.loads(json.dumps(fault.values, allow_nan=False)) == fault.values
    assert f"{fault.time_s:.3f} s" in fault.message


def test_lever_range_has_a_lower_and_an_upper_bound():
    """A load in the opposite direction reaches the lower bound; the reported value shows which."""
    result = svsa.simulate("4a", "fl", duration_s=2.0, loads=(PULL_LEVER,))
    assert result.fault is not None
    assert result.fault.code == "lever_end"
    assert result.fault.values["lever_ratio"] < result.fault.values["lever_ratio_min"]


def test_fault_is_at_first_state_outside_domain():
    """No tick runs beyond the bound, and no sample before it is discarded."""
    result = svsa.simulate("4a", "ndobc", duration_s=2.0, loads=(PUSH_LINK,))
    fault = result.fault
    assert abs(result.deflection_rad[-1]) <= result.deflection_limit_rad[-1]
    assert abs(fault.values["deflection_rad"]) > fault.values["deflection_limit_rad"]


@pytest.mark.parametrize("broken", [float("nan"), float("inf"), 1e200])
@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_non_finite_state_ends_the_run_immediately(broken, law):
    """NaN and ∞ in the state, and a velocity at which the control law overflows."""
    run = Run(svsa.paper.get_figure("4b").build_configuration(law))
    samples = np.full((1, 20, len(CHANNELS)), -1.0)
    run.advance(samples[:, :10])
    move_plant(run, dq=broken)
    assert run.advance(samples[:, 10:]) == 0
    assert run.fault is not None
    assert run.fault.code == "not_finite"
    assert run.fault.tick == run.tick == 10
    assert np.all(samples[:, 10:] == -1.0), "nothing may be written for a tick that was not run"
    assert all(math.isfinite(value) for value in run.fault.values.values())


@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_non_finite_measurement_ends_the_run_immediately(law):
    """The plant is valid but its measurement is not: no torque may be computed from it."""
    run = Run(svsa.paper.get_figure("4b").build_configuration(law))
    lane = run.lanes[0]
    run.lanes[0] = lane._replace(known=lane.known._replace(dtheta2=float("nan")))
    assert run.advance(np.empty((1, 5, len(CHANNELS)))) == 0
    assert run.fault.code == "not_finite"
    assert run.lanes[0].x == lane.x


def test_ended_run_computes_no_further_ticks():
    run = Run(svsa.paper.get_figure("4a").build_configuration().changed(loads=(PUSH_LINK,)))
    samples = np.empty((1, 2000, len(CHANNELS)))
    done = run.advance(samples)
    before = list(run.lanes), run.tick, run.fault
    assert done < 2000
    assert run.advance(samples) == 0
    assert (run.lanes, run.tick, run.fault) == before


@drawn
@given(springs(), st.sampled_from([-1.0, 1.0]))
def test_stiffness_is_positive_inside_the_deflection_limit(spring, sign):
    """The limit is below the angle of zero stiffness, which is below the 0.75 rad of Table 1."""
    mu, _ = spring
    limit = compute_deflection_limit(DOMAIN, PLANT, mu)
    assert 0.0 < limit < compute_zero_stiffness_deflection(mu) < 0.75
    inside = build_state(mu, sign * limit * 0.999)
    outside = build_state(mu, sign * limit * 1.001)
    assert compute_linearization(PLANT, inside).sigma > 0.0
    assert check_domain(DOMAIN, PLANT, inside) in (INSIDE, SINGULAR_DECOUPLING)
    assert check_domain(DOMAIN, PLANT, outside) == DEFLECTION_LIMIT


@drawn
@given(springs())
def test_relative_determinant_is_that_of_the_decoupling_matrix(spring):
    """det A(x) relative to det A at φ = 0, from the matrix that the control laws invert."""
    mu, phi = spring

    def compute_determinant(at):
        lie = compute_linearization(NOMINAL, build_state(mu, at))
        return lie.a11 * lie.a22 - lie.a12 * lie.a21

    share = compute_determinant(phi) / compute_determinant(0.0)
    assert compute_relative_determinant(mu, phi) == pytest.approx(share, rel=1e-9, abs=1e-12)


@drawn
@given(lever_ratios, st.floats(-1.5, 1.5))
def test_decoupling_matrix_is_regular_for_lever_ratios_between_zero_and_one(mu, phi):
    """det A = 2K²μ³ μ' (1 − μc³)/(M B1 B2 (1 − μc)⁶) > 0, where σ = 0 and beyond it too.

    (σ σ_μ − τ_e,μ σ_φ, with cos 2φ (cos 2φ − μc) + 4s²c² − μs²c = 1 − μc³.) It vanishes only if μ
    does. Its size decreases with the deflection, down to 5 % at μ = 0.79 and 0.75 rad.
    """
    assert 0.0 < compute_relative_determinant(mu, phi) <= 1.0 + 1e-12
    assert compute_relative_determinant(0.7904, 0.75) == pytest.approx(0.05, abs=5e-4)


@pytest.mark.parametrize("mu", [-0.05, 0.0, 1.0, 1.03])
def test_accepted_limits_keep_the_lever_ratio_between_zero_and_one(mu):
    """At μ = 0 A(x) = 0, at μ = 1 the spring's energy is infinite: the domain ends before both."""
    wide = DESIGN.limits.changed(
        stiffness_min_nm_per_rad=0.01, stiffness_max_nm_per_rad=1e4, lever_ratio_margin=0.1
    )
    domain = build_domain(DESIGN.actuator, wide)
    for phi in (0.0, 0.1):
        assert check_domain(domain, PLANT, build_state(mu, phi)) != INSIDE


def test_bounds_are_checked_in_the_order_of_their_causes():
    """NaN first; then the lever ratio; then the deflection, whose limit depends on the ratio."""
    nan = State(float("nan"), 0.0, 0.0, 0.0, 0.0, 0.0)
    assert check_domain(DOMAIN, PLANT, nan) == NOT_FINITE
    assert check_domain(DOMAIN, PLANT, build_state(0.9, 0.6)) == LEVER_END
    assert check_domain(DOMAIN, PLANT, build_state(0.25, 0.0)) == LEVER_END
    assert check_domain(DOMAIN, PLANT, build_state(0.5, 0.6)) == DEFLECTION_LIMIT
    assert check_domain(DOMAIN, PLANT, build_state(0.5, 0.1)) == INSIDE
