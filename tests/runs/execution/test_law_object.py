"""Stateful laws in Python are restarted in each run."""

import numpy as np
import pytest

import svsa
from svsa.errors import StateError


class Integrating:
    """A PD on the motors with an integral, which is its state."""

    def __init__(self):
        self.integral = 0.0

    def __call__(self, time, reference, x, disturbance):
        self.integral += 0.001 * (reference.q - x.q)
        u1 = 8.0 * (reference.q - x.theta1) + 5.0 * self.integral
        return u1, -40.0 * x.theta2 - 0.8 * x.dtheta2


class Resetting(Integrating):
    def reset(self):
        self.integral = 0.0


class Stateless:
    gain = 8.0

    def __call__(self, time, reference, x, disturbance):
        return self.gain * (reference.q - x.theta1), -40.0 * x.theta2 - 0.8 * x.dtheta2


def run(law):
    return svsa.simulate("4a", law, duration_s=0.1).samples


@pytest.mark.parametrize("law", [Integrating, Resetting(), Stateless()])
def test_two_runs_of_a_law_are_equal(law):
    assert np.array_equal(run(law), run(law))


def test_object_with_the_state_of_a_run_is_rejected_with_instructions():
    law = Integrating()
    first = run(law)
    assert law.integral != 0.0, "it can be read after the run"
    with pytest.raises(StateError, match=r"Integrating object .* reset\(\)"):
        run(law)
    assert np.array_equal(run(Integrating()), first)
