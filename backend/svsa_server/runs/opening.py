"""The request that opens a private session in which a script can repeat a run."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from svsa.actuators.parameters import get_mechanism_name
from svsa.actuators.reach import find_only_stiffness
from svsa.runs.definition.arm_experiment import ARMS
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa_server.schemas.lab.arm import FromArm
from svsa_server.schemas.lab.opening import FromActuator, FromFigure

GREATEST_SEED = 2**53
"""The greatest seed that a browser reads exactly from JSON."""


class Opening(NamedTuple):
    """A request for a private session.

    Attributes:
        request: Body of `POST /sessions`, without law and seed.
        defaults: The configuration of the session, without loads.
        problem: Why the settings of the session cannot become those of the run; None if they can.
    """

    request: dict[str, Any]
    defaults: Configuration
    problem: str | None


def choose_opening(configuration: Configuration, design: Design) -> Opening:
    """Choose the request whose session a script can set to a configuration.

    Args:
        configuration: Configuration of a run at tick 0.
        design: Design of the lab, which its figures have.

    Returns:
        The first request without a problem, otherwise the first one.
    """
    openings = [
        Opening(request, defaults, _find_problem(configuration, defaults))
        for request, defaults in _list_requests(configuration, design)
    ]
    return next((opening for opening in openings if opening.problem is None), openings[0])


def _list_requests(
    c: Configuration, design: Design
) -> Iterator[tuple[dict[str, Any], Configuration]]:
    names = [get_mechanism_name(joint.actuator) for joint in c.joints]
    if c.arm is not None:
        links, joints = c.arm.links, len(names)
        long = [name for name, arm in ARMS.items() if len(arm.links.chain) >= joints]
        has_same = {name: ARMS[name].build_links(joints) == links for name in long}
        arm = max(long, key=lambda name: (has_same[name], ARMS[name].actuator == names[0]))
        request: dict[str, Any] = {"from": "arm", "arm": arm}
        if names != [ARMS[arm].actuator] * len(ARMS[arm].links.chain):
            request["actuators"] = names
        yield request, FromArm(**request).build_configuration()
        return
    if names == [get_mechanism_name(design.actuator)]:
        request = {"from": "figure", "figure": "4a", "load": False}
        yield request, FromFigure(**request).build_configuration(design)
    request = {"from": "actuator", "actuator": names[0], "load": False}
    yield request, FromActuator(**request).build_configuration()


def _find_problem(c: Configuration, defaults: Configuration) -> str | None:
    """Describe the first value of the run that no request to a session can set."""
    if c.seed > GREATEST_SEED:
        return f"The seed {c.seed} exceeds 2^53, up to which a browser reads numbers exactly."
    for number, (joint, default) in enumerate(zip(c.joints, defaults.joints, strict=True), start=1):
        of_joint = f" of joint {number}" if c.arm is not None else ""
        fixed = {
            "limits": (joint.limits, default.limits),
            "control period": (joint.sampling, default.sampling),
            "seed": (joint.seed, c.seed),
            "stiffness of the nominal spring": tuple(
                find_only_stiffness(configured.nominal) for configured in (joint, default)
            ),
            "law parameters": (default.parameters.keys() - joint.parameters.keys(), set()),
        }
        for name, (own, expected) in fixed.items():
            if own != expected:
                return (
                    f"No request sets the {name}{of_joint} as in this run, so no script can"
                    " repeat it."
                )
    return None
