"""The installed actuators, as the tests use them."""

import math

import svsa
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.mechanism import (
    MAX_ELASTIC,
    PAPERS_DAMPING_NMS_PER_RAD,
    PAPERS_INERTIA,
    Mechanism,
    perturb,
)

NAMES = list_mechanism_names()
STIFFNESS = {
    "svsa": 60.0,
    "bavs": 15.0,
    "qbmove": 4.0,
    "maccepa": 0.8,
    "awas2": 60.0,
    "leaf_spring": 20.0,
    "sea": 60.0,
}


def follow(name, law, sigma, load, amplitude, **changes):
    """Simulate 20 s on A cos ωt − A, which has the errors of A sin ωt and starts at rest.

    Every actuator has the gains and the observer of the known answers, not its own defaults.
    """
    prototype = get_mechanism(name).prototype
    motion = svsa.SinePosition(
        amplitude_rad=amplitude,
        frequency_hz=0.25,
        phase_rad=math.pi / 2,
        offset_rad=-amplitude,
        transition_s=1.0,
    )
    given = {
        "actuator": name,
        "nominal": perturb(prototype, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
        "gains": svsa.Gains.from_poles([-60] * 4, [-40] * 2),
        "observer": 60.0,
        "stiffness": sigma,
        "position": motion,
        "loads": svsa.ConstantLoad(torque_nm=(load, 0.0, 0.0), start_s=5.0),
        "effects": svsa.IDEAL.changed(torque_limits=False),
        "duration_s": 20.0,
    }
    return svsa.simulate("4a", law, **(given | changes))


def list_values(mechanism):
    return [*mechanism.list_elastic(mechanism.prototype), *[0.0] * MAX_ELASTIC][:MAX_ELASTIC]


def build_wrong(energy, **changes):
    member = get_mechanism("leaf_spring")
    fields = {name: getattr(member, name) for name in Mechanism.__dataclass_fields__}
    return Mechanism(**(fields | {"name": "wrong", "energy": energy} | changes))
