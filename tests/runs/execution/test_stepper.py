"""`svsa.Stepper`: the samples of `simulate`, bit for bit, from torques of the caller."""

import numpy as np
import pytest

import svsa

EFFECTS = {"ideal": svsa.IDEAL, "rig": svsa.RIG}


def law(time_s, reference, x, w, measured):
    """A law that uses all inputs of a controller."""
    u1 = 40.0 * (reference.q - x.q) - 2.0 * x.dtheta1 - 0.3 * w.w2 + 0.5 * measured.theta1
    return u1, 0.2 * (reference.sigma - 15.0) - 0.5 * measured.theta2 - 0.02 * x.dtheta2


@pytest.mark.parametrize("name", EFFECTS)
def test_steps_have_the_bits_of_a_run_under_the_same_law(name):
    settings = {"effects": EFFECTS[name], "loads": (svsa.PaperLoad(start_s=0.05),), "seed": 3}
    run = svsa.simulate("4a", law, duration_s=0.2, **settings)
    stepper = svsa.Stepper("4a", **settings)
    for again in range(2):
        seen, rows = stepper.reset(), []
        for _ in range(200):
            seen = stepper.step(law(*seen[:4], measured=seen.measured))
            rows.append(stepper.sample)
        assert np.array(rows).tobytes() == run.samples.tobytes(), again
    assert seen.time_s == pytest.approx(0.2)


def test_held_torque_and_true_errors_are_those_of_the_samples():
    stepper = svsa.Stepper("5", effects=svsa.RIG)
    stepper.step((0.3, -0.01), ticks=20)
    errors = stepper.compute_errors()
    stepper.step((0.3, -0.01))
    sample = stepper.sample
    assert sample.torque1_nm == 0.3
    assert errors == (sample.position_error_rad, sample.stiffness_error_nm_per_rad)


def test_fault_is_that_of_the_run_and_ends_it_until_reset():
    run = svsa.simulate("4a", lambda *_: (10.0, 0.0), duration_s=1.0, loads=())
    stepper = svsa.Stepper("4a", loads=())
    while stepper.fault is None:
        stepper.step((10.0, 0.0))
    assert stepper.fault == run.fault
    with pytest.raises(svsa.FaultError, match="passed its limit"):
        stepper.step((0.0, 0.0))
    assert stepper.reset(seed=5).x.q == 0.0
    assert stepper.configuration.seed == 5
    stepper.step((0.0, 0.0), ticks=10)
    assert stepper.fault is None


@pytest.mark.parametrize("torque", [1.0, (1.0,), (np.nan, 0.0), "12x"])
def test_invalid_torque_is_rejected_with_the_valid_form(torque):
    stepper = svsa.Stepper()
    with pytest.raises(svsa.ParameterError, match=r"torque is .*two finite numbers \(u1, u2\)"):
        stepper.step(torque)
    assert stepper.sample is None
