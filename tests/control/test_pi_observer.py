"""The PI observer uses measured positions only, not those of the estimator."""

import numpy as np

import svsa
from svsa.runs.execution.run import Run
from tests.runs.session.sessions import PULSE, advance, build_configuration

TICKS = 300


def compute_samples(law: str, corner_rad_per_s: float) -> svsa.Result:
    """A run on the rig whose x̂ comes from an estimator with this corner frequency."""
    estimation = svsa.RIG.estimation.changed(corner_rad_per_s=corner_rad_per_s)
    effects = svsa.RIG.changed(estimation=estimation)
    configuration = build_configuration(PULSE, law=law, effects=effects)
    return svsa.simulate(configuration, duration_s=TICKS * configuration.sampling.period_s)


def test_torque_does_not_depend_on_the_state_estimator():
    """No bit of its torque changes, while NDOBC, which uses x̂, computes another torque."""
    slow, fast = (compute_samples("pi_observer", corner) for corner in (150.0, 300.0))
    assert np.any(slow.position_estimate_rad != fast.position_estimate_rad)
    np.testing.assert_array_equal(slow.torque1_nm, fast.torque1_nm)
    np.testing.assert_array_equal(slow.torque2_nm, fast.torque2_nm)
    slow, fast = (compute_samples("ndobc", corner) for corner in (150.0, 300.0))
    assert np.any(slow.torque1_nm != fast.torque1_nm)


def test_estimate_converges_to_the_load():
    """1 N·m on the link is in ŵ2 to one per cent a quarter of a second after its onset."""
    load = svsa.ConstantLoad(torque_nm=(1.0, 0.0, 0.0), start_s=0.05)
    exact = svsa.load_prototype().actuator
    run = Run(build_configuration(load, law="pi_observer", effects=svsa.RIG, nominal=exact))
    advance(run, TICKS)
    assert abs(run.lanes[0].memory[0] - 1.0) < 0.01
